//! Bodies that touch themselves, compared with pairs of their walls and closed forms.
//!
//! Longer than other files, as models that are compared share their steps.

use striae_contact::{side::Side, unknowns::Status};
use striae_law::friction::Friction;
use striae_mesh::{CellBlock, Mesh, NodeId, Vec3};
use striae_model::{LoadExtent, LoadKind, Model, Step};
use striae_solve::outcome::Ending;
use striae_surface::texture::{Field, Lines, Paint};

use crate::{
    scene::{
        Places, Run, block, body, coulomb, increments, largest_distance, model, pieces, rubber,
        step,
    },
    skins::{closing, jaw},
    strip::{folded, strip},
};

/// All outer faces of a mesh as a set.
pub fn with_skin(mut mesh: Mesh) -> Mesh {
    let skin = mesh.boundary_faces();
    mesh.facet_sets.insert("skin", skin);
    mesh
}

/// The jaw closed, and then its top moved sideways.
fn sheared() -> Model {
    let mut model = closing(0.9, 0.1);
    model.bodies[0].mesh = with_skin(jaw());
    let mut drag = step();
    drag.increments = increments(0.1, 1e-3);
    drag.displacements = vec![model.hold("jaw", "top", [Some(0.3), Some(0.1), Some(-0.9)])];
    model.steps.push(drag);
    model
}

fn completed(model: Model) -> Run {
    let run = Run::of(model);
    let cuts: Vec<String> = run.cuts.iter().map(|(_, cut)| cut.to_string()).collect();
    assert_eq!(run.ending, Ending::Completed, "{}\n{cuts:#?}", run.ending);
    run
}

/// Largest distance of nodes of two runs after every increment.
fn apart(found: &Run, named: &Run) -> Vec<f64> {
    let states = found.states.iter().zip(&named.states);
    states
        .map(|(found, named)| largest_distance(&found.positions, &named.positions))
        .collect()
}

#[test]
fn walls_found_by_themselves_are_those_named() {
    for mu in [0.0, 0.3] {
        let mut named = sheared();
        named.touch(("jaw", "lower"), ("jaw", "upper"), coulomb(mu));
        let named = completed(named);
        for sets in [&["lower", "upper"][..], &["skin"]] {
            let mut found = sheared();
            found.touch_itself("jaw", sets, coulomb(mu));
            let found = completed(found);
            let apart = apart(&found, &named);
            // Where both walls are flat there is no difference but round-off; where they bend, the
            // pivots of weak nodes are those of vectors rather than scalars. Without friction the
            // back of the slit is folded onto the lower wall in the end, which is not in the pair.
            let said = || format!("mu {mu}, {sets:?}: {apart:?}");
            assert!(apart[..8].iter().all(|apart| *apart < 1e-13), "{}", said());
            assert!(apart[..13].iter().all(|apart| *apart < 1e-6), "{}", said());
            let later = if mu == 0.0 { 2e-2 } else { 1e-6 };
            assert!(apart.iter().all(|apart| *apart < later), "{}", said());
            let iterations = |run: &Run| run.iterations[..12].iter().map(Vec::len).sum::<usize>();
            assert_eq!(iterations(&found), iterations(&named));
        }
    }
}

/// Both walls have the texture of the one surface that they belong to.
#[test]
fn textures_of_walls_that_touch_are_those_of_both() {
    let friction = || Friction::two_textures(0.2, 0.1, 0.1, 0.5).unwrap();
    let paint = || {
        Some(Paint::Field(Field {
            lines: Lines::Uniform(Vec3::new(1.0, 0.4, 0.0)),
            turn: 0.0,
        }))
    };
    let mut named = sheared();
    named.touch(("jaw", "lower"), ("jaw", "upper"), friction());
    named.pairs[0].textures = [paint(), paint()];
    let named = completed(named);
    let mut found = sheared();
    found.touch_itself("jaw", &["lower", "upper"], friction());
    found.pairs[0].textures[0] = paint();
    let found = completed(found);
    let apart = apart(&found, &named);
    assert!(apart.iter().all(|apart| *apart < 1e-5), "{apart:?}");
    let slips = found.last().pairs[0].nodes[Side::A].iter();
    assert!(slips.filter(|node| node.status == Status::Slip).count() > 10);
}

/// Directions at nodes of the mesh are those of all faces that meet there.
#[test]
fn nodes_on_edges_are_painted_on_all_their_faces() {
    let direction = Vec3::new(1.0, 0.4, 0.3);
    let textured = |paint: Paint| {
        let mut model = sheared();
        let friction = Friction::two_textures(0.2, 0.1, 0.1, 0.5).unwrap();
        model.touch_itself("jaw", &["skin"], friction);
        model.pairs[0].textures[0] = Some(paint);
        completed(model)
    };
    let field = textured(Paint::Field(Field {
        lines: Lines::Uniform(direction),
        turn: 0.0,
    }));
    let mesh = &field.problem.model.bodies[0].mesh;
    let nodes = mesh.nodes_of_faces(&mesh.boundary_faces());
    let nodal = textured(Paint::Nodal(vec![direction; nodes.len()]));
    assert!(apart(&nodal, &field).iter().all(|apart| *apart < 1e-12));
}

/// One wall, and all other faces of the body: what is behind a wall is no contact with it.
#[test]
fn a_wall_touches_the_rest_of_its_body_as_the_other_wall() {
    let mut named = sheared();
    named.touch(("jaw", "lower"), ("jaw", "upper"), coulomb(0.3));
    let named = completed(named);
    let mut found = sheared();
    let lower = found.faces("jaw", "lower");
    let mut rest = found.faces("jaw", "skin");
    rest.retain(|face| !lower.contains(face));
    found.bodies[0].mesh.facet_sets.insert("rest", rest);
    found.touch(("jaw", "lower"), ("jaw", "rest"), coulomb(0.3));
    found.pairs[0].feature_angle = Some(45.0);
    let found = completed(found);
    let apart = apart(&found, &named);
    assert!(apart.iter().all(|apart| *apart < 1e-12), "{apart:?}");
}

/// Steps that hold the first nodes, press the second ones by a way along `z`, and drag them.
fn pressed_and_dragged(model: &Model, [held, moved]: [(&str, &str); 2], way: f64) -> [Step; 2] {
    let mut press = step();
    press.increments = increments(0.25, 1e-3);
    press.displacements = vec![
        model.hold(held.0, held.1, [Some(0.0); 3]),
        model.hold(moved.0, moved.1, [Some(0.0), Some(0.0), Some(way)]),
    ];
    let mut drag = step();
    drag.increments = increments(0.25, 1e-3);
    drag.displacements = vec![model.hold(moved.0, moved.1, [Some(0.1), Some(0.03), Some(way)])];
    [press, drag]
}

#[test]
fn two_pieces_of_one_body_touch_as_two_bodies_do() {
    let blocks = [
        block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]),
        block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 2]),
    ];
    let meshes = blocks.map(|block| block.mesh().unwrap());
    // The load is on what the upper block leaves uncovered.
    let pressed = |mut model: Model, [base, top, face]: [(&str, &str); 3]| {
        let [press, mut drag] = pressed_and_dragged(&model, [base, top], -0.02);
        let pressure = LoadKind::Pressure(0.03);
        drag.loads = vec![model.load(face.0, face.1, pressure, LoadExtent::Exposed)];
        model.steps = vec![press, drag];
        completed(model)
    };
    let [lower, upper] = meshes.clone();
    let mut pair = model(vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    pair.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    let pair = pressed(
        pair,
        [("lower", "zmin"), ("upper", "zmax"), ("lower", "zmax")],
    );
    let mut one = model(vec![body(
        "both",
        with_skin(pieces(&meshes)),
        rubber(1.0, 0.3),
    )]);
    one.touch_itself("both", &["skin"], coulomb(0.3));
    let one = pressed(
        one,
        [("both", "0.zmin"), ("both", "1.zmax"), ("both", "0.zmax")],
    );
    let apart = apart(&one, &pair);
    assert!(apart.iter().all(|apart| *apart < 1e-7), "{apart:?}");
    let status = |run: &Run, wanted: Status| {
        let nodes = run.last().pairs[0].nodes.iter().flatten();
        nodes.filter(|node| node.status == wanted).count()
    };
    for wanted in [Status::Stick, Status::Slip] {
        assert_eq!(status(&one, wanted), status(&pair, wanted), "{wanted:?}");
    }
}

/// The thickness that tells what is inside follows the deformation: top and bottom of a block that
/// is pressed to less than half its height face away from each other all the same.
#[test]
fn a_block_that_is_pressed_flat_does_not_touch_through_itself() {
    let pressed = |touches: bool| {
        let cube = block([0.0; 3], [1.0; 3], [1, 1, 1]).mesh().unwrap();
        let mut model = model(vec![body("cube", with_skin(cube), rubber(1.0, 0.2))]);
        if touches {
            model.touch_itself("cube", &["skin"], coulomb(0.3));
        }
        let mut press = step();
        press.increments = increments(0.05, 1e-3);
        press.displacements = vec![
            model.hold("cube", "zmin", [Some(0.0); 3]),
            model.hold("cube", "xmin", [Some(0.0), None, None]),
            model.hold("cube", "ymin", [None, Some(0.0), None]),
        ];
        let pressure = LoadKind::Pressure(1.0);
        press.loads = vec![model.load("cube", "zmax", pressure, LoadExtent::Whole)];
        model.steps = vec![press];
        completed(model)
    };
    let [touching, bare] = [true, false].map(pressed);
    let height = bare
        .last()
        .positions
        .iter()
        .map(|x| x.z)
        .fold(0.0, f64::max);
    assert!(height < 0.45, "{height}");
    let apart = apart(&touching, &bare);
    assert!(apart.iter().all(|apart| *apart < 1e-12), "{apart:?}");
    let nodes = touching.last().pairs[0].nodes.iter().flatten();
    assert!(nodes.into_iter().all(|node| node.pressure == 0.0));
}

/// Nodes whose displacement is prescribed feel what touches them, be it of the same surface.
#[test]
fn a_prescribed_wall_is_touched_as_that_of_another_body() {
    let meshes = [
        block([0.0; 3], [1.0, 1.0, 0.5], [5, 5, 2]),
        block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 2]),
    ];
    let meshes = meshes.map(|block| block.mesh().unwrap());
    let pressed = |mut model: Model, ends: [(&str, &str); 2]| {
        model.steps = pressed_and_dragged(&model, ends, -0.05).into();
        completed(model)
    };
    let [lower, upper] = meshes.clone();
    let mut pair = model(vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    pair.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.3));
    let pair = pressed(pair, [("lower", "zmax"), ("upper", "zmax")]);
    let mut one = model(vec![body(
        "both",
        with_skin(pieces(&meshes)),
        rubber(1.0, 0.3),
    )]);
    one.touch_itself("both", &["skin"], coulomb(0.3));
    let one = pressed(one, [("both", "0.zmax"), ("both", "1.zmax")]);
    let apart = apart(&one, &pair);
    assert!(apart.iter().all(|apart| *apart < 1e-7), "{apart:?}");
    let kept = |run: &Run| {
        let nodes = run.last().pairs[0].nodes.iter().flatten();
        nodes.filter(|node| node.pressure > 0.0).count()
    };
    assert_eq!(kept(&one), kept(&pair));
}

/// Two blocks that are pressed on each other and dragged, touching with these faces.
fn dragged(faces: [&str; 2], feature_angle: Option<f64>) -> Model {
    let [lower, upper] = [
        block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]),
        block([0.2, 0.2, 0.5], [0.6, 0.6, 0.5], [3, 3, 2]),
    ]
    .map(|block| with_skin(block.mesh().unwrap()));
    let mut model = model(vec![
        body("lower", lower, rubber(3.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    let [a, b] = faces;
    model.touch(("lower", a), ("upper", b), coulomb(0.3));
    model.pairs[0].feature_angle = feature_angle;
    let moved = |x: f64, y: f64, z: f64| {
        let mut step = step();
        step.increments = increments(0.25, 1e-3);
        step.displacements = vec![
            model.hold("lower", "zmin", [Some(0.0); 3]),
            model.hold("upper", "zmax", [Some(x), Some(y), Some(z)]),
        ];
        step
    };
    model.steps = vec![moved(0.0, 0.0, -0.02), moved(0.1, 0.03, -0.02)];
    let pressure = LoadKind::Pressure(0.03);
    model.steps[1].loads = vec![model.load("lower", "zmax", pressure, LoadExtent::Exposed)];
    model
}

/// Whole skins find the faces that touch; edges do not smear normals, and nothing else touches.
#[test]
fn skins_with_faces_are_the_faces_that_touch() {
    let named = completed(dragged(["zmax", "zmin"], None));
    let found = completed(dragged(["skin", "skin"], Some(45.0)));
    let apart = apart(&found, &named);
    println!("{apart:?}");
    assert!(apart.iter().all(|apart| *apart < 1e-12), "{apart:?}");
    let smeared = completed(dragged(["skin", "skin"], None));
    let smeared = self::apart(&smeared, &named);
    println!("{smeared:?}");
}

/// A block with a slit of no width, whose walls are two faces: compressed, it is as one piece.
#[test]
fn a_closed_slit_is_as_if_it_were_none() {
    let cells = [6, 2, 4];
    let whole: Mesh = block([0.0; 3], [3.0, 1.0, 2.0], cells).mesh().unwrap();
    // Nodes in the plane z = 1 beyond x = 1 are there twice.
    let is_split = |p: &Vec3| p.z == 1.0 && p.x > 1.0;
    let mut positions = whole.positions.clone();
    let twin: Vec<usize> = (0..positions.len())
        .map(|node| {
            let p = positions[node];
            if is_split(&p) {
                positions.push(p);
                positions.len() - 1
            } else {
                node
            }
        })
        .collect();
    let cells = whole.elements().map(|corners| {
        let middle: Vec3 = corners
            .iter()
            .map(|n| whole.positions[n.index()])
            .sum::<Vec3>()
            / 8.0;
        let above = middle.z > 1.0;
        let corner = |at: usize| {
            let node = corners[at].index();
            NodeId::new(if above { twin[node] } else { node })
        };
        std::array::from_fn(corner)
    });
    let cells: Vec<[NodeId; 8]> = cells.collect();
    let mut mesh = with_skin(Mesh::new(positions, vec![CellBlock::hexahedra(cells)]).unwrap());
    for (name, z) in [("bottom", 0.0), ("top", 2.0)] {
        let nodes = mesh.positions.iter().enumerate();
        let nodes: Vec<NodeId> = nodes
            .filter(|(_, p)| p.z == z)
            .map(|(node, _)| NodeId::new(node))
            .collect();
        mesh.node_sets.insert(name, nodes);
    }
    for mu in [0.0, 0.3] {
        let mut model = model(vec![body("block", mesh.clone(), rubber(1.0, 0.3))]);
        model.touch_itself("block", &["skin"], coulomb(mu));
        let mut press = step();
        let sides = [
            model.pin("block", [0.0, 0.0, 0.0], [Some(0.0), Some(0.0), None]),
            model.pin("block", [0.0, 1.0, 0.0], [Some(0.0), None, None]),
        ];
        press.displacements = vec![
            model.hold("block", "bottom", [None, None, Some(0.0)]),
            model.hold("block", "top", [None, None, Some(-0.2)]),
        ];
        press.displacements.extend(sides);
        model.steps = vec![press];
        let run = completed(model);
        let state = run.last();
        let nodes = state.pairs[0].nodes[Side::A].iter();
        let pressures: Vec<f64> = nodes
            .map(|node| node.pressure)
            .filter(|p| *p > 0.0)
            .collect();
        let (least, most) = pressures
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(a, b), p| (a.min(*p), b.max(*p)));
        assert!(
            pressures.len() == 30 && most - least < 1e-12 * most,
            "{least} .. {most}"
        );
    }
}

#[test]
fn forces_on_a_body_that_touches_itself_cancel() {
    let mut model = sheared();
    model.touch_itself("jaw", &["skin"], coulomb(0.3));
    let run = completed(model);
    let facets = &run.last().pairs[0].facets[Side::A];
    let forces: Vec<Vec3> = facets.iter().flat_map(|(_, of)| of.force).collect();
    let sum: Vec3 = forces.iter().sum();
    let total: f64 = forces.iter().map(Vec3::norm).sum();
    assert!(total > 0.1, "{total}");
    assert!(sum.norm() < 1e-14 * total, "{sum} of {total}");
}

/// A strip that is folded once, its ends pressed together and then moved apart sideways.
fn closing_fold(size: f64, friction: f64) -> Model {
    let line = folded(1, 1.0, 0.32, size);
    let mut mesh = strip(&line, 0.12, 1, 0.2);
    let all = |wanted: &dyn Fn(&Vec3) -> bool| -> Vec<NodeId> {
        let nodes = mesh.positions.iter().enumerate();
        let nodes = nodes.filter(|(_, x)| wanted(x));
        nodes.map(|(node, _)| NodeId::new(node)).collect()
    };
    let sets = [
        ("lower", all(&|x| x.z < -0.05 && x.x < 0.3)),
        ("upper", all(&|x| x.z > 0.37 && x.x < 0.3)),
        ("whole", all(&|_| true)),
    ];
    for (name, nodes) in sets {
        mesh.node_sets.insert(name, nodes);
    }
    let mut model = model(vec![body("strip", mesh, rubber(1.0, 0.3))]);
    model.touch_itself("strip", &["skin"], coulomb(friction));
    let moved = |x: f64, z: f64| {
        let mut step = step();
        step.increments = increments(0.125, 1e-3);
        step.displacements = vec![
            model.hold("strip", "whole", [None, Some(0.0), None]),
            model.hold("strip", "lower", [Some(0.0), Some(0.0), Some(0.0)]),
            model.hold("strip", "upper", [Some(x), Some(0.0), Some(z)]),
        ];
        step
    };
    model.steps = vec![moved(0.0, -0.26), moved(-0.25, -0.26)];
    model
}

#[test]
fn a_strip_that_is_folded_closes_and_slides_on_itself() {
    for (size, most) in [(1.0 / 6.0, 25), (1.0 / 12.0, 10)] {
        let run = completed(closing_fold(size, 0.3));
        let iterations: Vec<usize> = run.iterations.iter().map(Vec::len).collect();
        assert!(
            iterations.iter().all(|count| *count <= most),
            "{iterations:?}"
        );
        let mut slipping = 0;
        for state in &run.states {
            let pair = &state.pairs[0];
            let nodes = pair.nodes[Side::A].iter().zip(&pair.kept[Side::A]);
            let slip = nodes.filter(|(node, kept)| **kept && node.status == Status::Slip);
            for (node, _) in slip {
                slipping += 1;
                assert!((node.tau.norm() - 0.3 * node.pressure).abs() < 1e-9 * node.pressure);
                assert!(node.tau.dot(&node.slip) < 0.0, "{node:?}");
            }
            let forces = pair.facets[Side::A].iter().flat_map(|(_, of)| of.force);
            assert!(forces.sum::<Vec3>().norm() < 1e-16);
        }
        assert!(slipping > 40, "{slipping}");
    }
}

/// Edges that a block is pressed to are sharp, but the body is between their sides.
#[test]
fn the_sharp_edges_of_a_bonded_block_do_not_touch_through_it() {
    let pressed = |touches: bool| {
        let whole = block([0.0; 3], [1.0; 3], [2, 2, 2]).mesh().unwrap();
        let mut model = model(vec![body("block", with_skin(whole), rubber(1.0, 0.45))]);
        if touches {
            model.touch_itself("block", &["skin"], coulomb(0.3));
        }
        let mut press = step();
        press.increments = increments(0.05, 1e-3);
        press.displacements = vec![
            model.hold("block", "zmin", [Some(0.0); 3]),
            model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.7)]),
        ];
        model.steps = vec![press];
        completed(model)
    };
    let [touching, bare] = [true, false].map(pressed);
    // The sides next to the sole stand at less than 45 degrees to it.
    let sharp = |x: &&Vec3| x.x < 0.0 && x.z < -x.x;
    let sharp = bare.last().positions.iter().filter(sharp).count();
    assert!(sharp > 0);
    let apart = apart(&touching, &bare);
    assert!(apart.iter().all(|apart| *apart < 1e-12), "{apart:?}");
}

/// A sheet that is carried past another one by twice its thickness within an increment is found on
/// its other side, where nothing touches; smaller increments press it down.
#[test]
fn a_sheet_that_would_go_through_in_one_increment_is_pressed_in_smaller_ones() {
    let sheets = [
        block([0.0; 3], [2.0, 1.0, 0.05], [8, 2, 1]),
        block([0.6, 0.0, 0.08], [0.8, 1.0, 0.05], [3, 2, 1]),
    ];
    let meshes = sheets.map(|sheet| sheet.mesh().unwrap());
    let mut one = model(vec![body(
        "both",
        with_skin(pieces(&meshes)),
        rubber(1.0, 0.3),
    )]);
    one.touch_itself("both", &["skin"], coulomb(0.3));
    let mut press = step();
    press.increments = increments(1.0, 1e-3);
    press.displacements = vec![
        one.hold("both", "0.xmin", [Some(0.0); 3]),
        one.hold("both", "0.xmax", [Some(0.0); 3]),
        one.hold("both", "1.zmax", [Some(0.0), Some(0.0), Some(-0.18)]),
    ];
    one.steps = vec![press];
    let run = completed(one);
    assert!(run.progress.len() > 1, "{}", run.progress.len());
    // Wherever the upper sheet is, the lower one is below it.
    let upper = 9 * 3 * 2;
    let (lower, upper) = run.last().positions.split_at(upper);
    let highest = lower
        .iter()
        .filter(|x| (x.x - 1.0).abs() < 0.3)
        .map(|x| x.z)
        .fold(f64::NEG_INFINITY, f64::max);
    let least = upper.iter().map(|x| x.z).fold(f64::INFINITY, f64::min);
    assert!(highest < least + 0.01, "{highest} {least}");
}
