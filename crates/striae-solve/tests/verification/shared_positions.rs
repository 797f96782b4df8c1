//! Pairs that hold the same positions: faces of one body that stand on one surface in two pairs.

use striae_contact::{pair::Enforcement, side::Side};
use striae_mesh::{Face, NodeId, Vec3};
use striae_model::{ContactSurface, Curve, LoadExtent, LoadKind, Model, Pair, RigidShape};
use striae_solve::{outcome::Ending, problem::Problem, report::pairs, state::State};

use crate::scene::{
    Places, Run, block, body, coulomb, increments, model, plane, pressed_on_plane, rubber, step,
};

/// Divides the first pair in two, by what is left of `border` on a side.
fn divided(mut model: Model, side: Side, border: f64) -> Model {
    let whole = model.pairs.remove(0);
    let surfaces = [&whole.a, &whole.b];
    let ContactSurface::Deformable { body, faces } = surfaces[side.index()] else {
        panic!("the side deforms");
    };
    let mesh = &model.bodies[body.0].mesh;
    let is_left = |face: &Face| {
        let nodes = mesh.face_nodes(*face);
        nodes
            .map(|node| mesh.positions[node.index()].x)
            .iter()
            .sum::<f64>()
            < 4.0 * border
    };
    let parts = [true, false].map(|left| {
        let faces = faces.iter().copied().filter(|face| is_left(face) == left);
        let part = ContactSurface::Deformable {
            body: *body,
            faces: faces.collect(),
        };
        let mut pair = Pair {
            name: if left { "left" } else { "right" }.to_owned(),
            ..whole.clone()
        };
        match side {
            Side::A => pair.a = part,
            Side::B => pair.b = part,
        }
        pair
    });
    model.pairs = parts.into();
    model
}

/// Sum of the forces on side `a` and largest pressure in all states but the first.
fn forces(run: &Run) -> Vec<([f64; 3], f64)> {
    let of_state = |state: &State| {
        let of_pairs = pairs(&run.problem, state);
        let force: Vec3 = of_pairs.iter().map(|pair| pair.sides[0].force).sum();
        let nodes = state
            .pairs
            .iter()
            .flat_map(|pair| pair.nodes.iter().flatten());
        let largest = nodes.map(|node| node.pressure).fold(0.0, f64::max);
        (force.into(), largest)
    };
    run.states[1..].iter().map(of_state).collect()
}

/// Asserts that a run completes without cuts.
fn run(model: Model) -> Run {
    let run = Run::of(model);
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    assert!(run.cuts.is_empty(), "{:?}", run.cuts);
    run
}

/// A block pressed on a plane and slid, its top without rotation: pressures are far from uniform.
fn on_plane(divisions: [usize; 3]) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], divisions).mesh().unwrap();
    let mut model = pressed_on_plane(mesh, 0.3);
    let mut slide = step();
    slide.displacements = vec![model.hold("block", "zmax", [Some(0.05), Some(0.0), Some(-0.02)])];
    slide.increments = increments(0.2, 0.05);
    model.steps.push(slide);
    model
}

#[test]
fn two_pairs_on_one_plane_are_as_one() {
    for divisions in [[4, 4, 2], [6, 3, 2]] {
        let [one, two] = [
            on_plane(divisions),
            divided(on_plane(divisions), Side::A, 0.5),
        ]
        .map(|model| forces(&run(model)));
        for ((one, most), (two, most_of_two)) in one.iter().zip(&two) {
            let size = one[2].abs();
            for (one, two) in one.iter().zip(two) {
                assert!(
                    (one - two).abs() < 1e-2 * size,
                    "{divisions:?}: {one} and {two}"
                );
            }
            assert!(
                (most_of_two / most - 1.0).abs() < 0.25,
                "{most} and {most_of_two}"
            );
        }
    }
}

#[test]
fn a_border_between_collocated_pairs_is_refused() {
    for collocated in [[true, true], [true, false], [false, true]] {
        let mut model = divided(on_plane([4, 2, 2]), Side::A, 0.5);
        for (pair, is_collocated) in model.pairs.iter_mut().zip(collocated) {
            if is_collocated {
                pair.enforcement = Enforcement::Collocated;
            }
        }
        let refused = Problem::new(model).err();
        let told = refused.map_or_else(String::new, |error| error.to_string());
        let expected = "pairs `left` and `right` share node 2 of `block` and press it on the same \
                        surface";
        assert!(told.starts_with(expected), "{told}");
    }
}

#[test]
fn uniform_pressure_stays_uniform_in_two_pairs_on_one_plane() {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.0))]);
    let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
    model.touch_rigid(("block", "zmin"), floor, coulomb(0.0));
    let mut press = step();
    let load = LoadKind::Pressure(0.02);
    press.loads = vec![model.load("block", "zmax", load, LoadExtent::Whole)];
    press.displacements = vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), None])];
    model.steps = vec![press];
    let run = run(divided(model, Side::A, 0.5));
    let nodes = run.last().pairs.iter().flat_map(|pair| &pair.nodes[0]);
    let pressures: Vec<f64> = nodes
        .map(|node| node.pressure)
        .filter(|p| *p != 0.0)
        .collect();
    assert!(pressures.len() >= 25);
    for p in pressures {
        assert!((p / 0.02 - 1.0).abs() < 1e-9, "{p}");
    }
}

/// A block whose end lies by `over` beyond the border between facets of a floor, at 1.
fn beyond_the_border(over: f64) -> Model {
    let stands = block([over, 0.0, 0.0], [1.0, 1.0, 0.2], [1, 1, 1])
        .mesh()
        .unwrap();
    let floor = block([-1.0, -0.5, -0.2], [4.0, 2.0, 0.2], [8, 4, 1]).mesh();
    let bodies = [("block", stands), ("floor", floor.unwrap())];
    let bodies = bodies.map(|(name, mesh)| body(name, mesh, rubber(1e3, 0.3)));
    let mut model = model(bodies.into());
    model.touch(("block", "zmin"), ("floor", "zmax"), coulomb(0.4));
    let mut press = step();
    let load = LoadKind::Pressure(1.0);
    press.loads = vec![model.load("block", "zmax", load, LoadExtent::Whole)];
    press.displacements = vec![
        model.hold("floor", "zmin", [Some(0.0); 3]),
        model.hold("block", "zmax", [Some(0.0), Some(0.0), None]),
    ];
    let mut slide = step();
    slide.loads.clone_from(&press.loads);
    slide.loads[0].curve = Curve::Constant;
    slide.displacements = vec![
        model.hold("floor", "zmin", [Some(0.0); 3]),
        model.hold("block", "zmax", [Some(0.2), Some(0.0), None]),
    ];
    slide.increments = increments(0.2, 0.05);
    model.steps = vec![press, slide];
    model
}

#[test]
fn a_strip_in_the_next_pair_takes_no_more_pressure_than_what_lies_beside_it() {
    for over in [1e-3, 0.01, 0.1] {
        let one = beyond_the_border(over);
        let two = divided(beyond_the_border(over), Side::B, 1.0);
        let [(one, most), (two, most_of_two)] = [one, two].map(|model| {
            let run = Run::of(model);
            assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
            *forces(&run).last().unwrap()
        });
        assert!((one[2] - two[2]).abs() < 1e-6 * one[2].abs());
        assert!(most_of_two < 2.5 * most, "{over}: {most_of_two} for {most}");
    }
}

/// A rigid floor between two planes normal to x.
fn rigid_floor(from: f64, to: f64) -> RigidShape {
    let corners = [(from, -1.0), (to, -1.0), (to, 2.0), (from, 2.0)];
    RigidShape::Facets {
        positions: corners.map(|(x, y)| Vec3::new(x, y, 0.0)).into(),
        facets: vec![[0, 1, 2, 3].map(NodeId::new)],
    }
}

/// A block that is pressed by a prescribed depth, without friction and lateral strain, then slides
/// from one rigid floor, up to x = 1.2, to the next.
fn over_a_border(divisions: usize, to: f64, count: f64) -> Model {
    let divisions = [divisions, divisions, 2];
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], divisions).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.0))]);
    for (name, from, to) in [("left", -2.0, 1.2), ("right", 1.2, 4.0)] {
        model.touch_rigid(("block", "zmin"), rigid_floor(from, to), coulomb(0.0));
        name.clone_into(&mut model.pairs.last_mut().unwrap().name);
        name.clone_into(&mut model.rigid_surfaces.last_mut().unwrap().name);
    }
    let mut press = step();
    press.displacements = vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.01)])];
    let mut slide = step();
    slide.displacements = vec![model.hold("block", "zmax", [Some(to), Some(0.0), Some(-0.01)])];
    slide.increments = increments(1.0 / count, 1.0 / count);
    model.steps = vec![press, slide];
    model
}

#[test]
fn a_pair_that_is_entered_bears_its_share_at_once() {
    // Parts of a facet from a fifth on; smaller ones are slivers.
    for (divisions, over, count) in [
        (3, 0.07, 1.0),
        (3, 0.1, 1.0),
        (3, 0.1, 8.0),
        (3, 0.6, 3.0),
        (6, 0.1, 1.0),
        (6, 0.3, 2.0),
    ] {
        let run = Run::completed(over_a_border(divisions, 0.2 + over, count));
        let reports = pairs(&run.problem, run.last());
        let whole: f64 = reports.iter().map(|pair| pair.sides[0].force.z).sum();
        let share = reports[1].sides[0].force.z / whole;
        assert!(
            (share - over).abs() < 1e-6,
            "{divisions} {over} {count}: {share}"
        );
        for pair in &reports {
            let most = pair.max_pressure;
            assert!(
                (most / whole - 1.0).abs() < 1e-4,
                "{divisions} {over} {count}: {most} for {whole}"
            );
        }
    }
}

/// Two blocks on each other, the upper one pressed and slid; the floor is far below the upper one,
/// but within the search distance of a pair of both.
fn above_the_floor(is_near: bool) -> Model {
    let lower = block([-0.2, -0.2, 0.0], [1.4, 1.4, 0.3], [5, 5, 1]);
    let upper = block([0.0, 0.0, 0.3], [1.0, 1.0, 0.5], [3, 3, 2]);
    let bodies = [("lower", lower), ("upper", upper)];
    let bodies = bodies.map(|(name, mesh)| body(name, mesh.mesh().unwrap(), rubber(1.0, 0.3)));
    let mut model = model(bodies.into());
    model.touch(("upper", "zmin"), ("lower", "zmax"), coulomb(0.3));
    if is_near {
        let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
        model.touch_rigid(("upper", "zmin"), floor, coulomb(0.3));
        model.pairs[1].search_distance = Some(1.0);
    }
    let held = model.hold("lower", "zmin", [Some(0.0); 3]);
    let mut press = step();
    press.displacements = vec![
        held.clone(),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.02)]),
    ];
    let mut slide = step();
    slide.displacements = vec![
        held,
        model.hold("upper", "zmax", [Some(0.1), Some(0.0), Some(-0.02)]),
    ];
    slide.increments = increments(0.25, 0.05);
    model.steps = vec![press, slide];
    model
}

#[test]
fn what_does_not_touch_changes_nothing() {
    let [alone, near] = [false, true].map(|is_near| forces(&run(above_the_floor(is_near))));
    for ((alone, most), (near, most_of_near)) in alone.iter().zip(&near) {
        for (alone, near) in alone.iter().zip(near) {
            assert!((alone - near).abs() < 1e-8 * most, "{alone} and {near}");
        }
        assert!((most - most_of_near).abs() < 1e-8 * most);
    }
}
