//! Steady sliding on a rigid textured plane: resultants, invariances.

use crate::{
    dissipation::dissipates,
    oblique::{Formula, Oblique, Sliding, along, angle_of_slip, irregular_block, uniform},
    scene::{Places, Run, block, body, increments, largest_distance, model, plane, rubber, step},
    table::{MEASURED, STRONG},
};
use nalgebra::Vector2;
use striae_contact::unknowns::Status;
use striae_mesh::{
    NodeId, Vec3,
    generate::{Block, Pivot, Rotation},
};
use striae_model::{Model, RigidShape};
use striae_solve::{report, state::State};
use striae_surface::texture::{Field, Lines, Paint};

const CONSTANTS: Formula = Formula::TwoTextures([0.3, 0.2, 0.15, 0.6]);

/// `integral N_I da` of all base nodes over what is in contact now.
fn nodal_areas(run: &Run, state: &State) -> Vec<f64> {
    let surface = run.problem.pairs[0].contact.sides[0].surface().unwrap();
    let mut areas = vec![0.0; surface.nodes().len()];
    for (facet, forces) in &state.pairs[0].facets[0] {
        for (corner, area) in surface.facets()[facet.index()].iter().zip(forces.area) {
            areas[*corner] += area;
        }
    }
    areas
}

/// The force on the block by the law at every slipping node that is kept equals the
/// resultant; tractions of other nodes are combinations of those.
fn check_nodal_law(run: &Run, law: Formula, floor: Option<f64>) {
    let across = |s: Vector2<f64>| Vector2::new(s.y, -s.x);
    let mut slipping = 0;
    for state in &run.states[1..] {
        let areas = nodal_areas(run, state);
        let mut sum = Vec3::zeros();
        let pair = &state.pairs[0];
        let nodes = pair.nodes[0].iter().zip(&pair.kept[0]);
        for ((node, kept), area) in nodes.zip(areas) {
            let tau = if *kept && node.status == Status::Slip {
                slipping += 1;
                let own = (node.texture != Vec3::zeros()).then(|| across(node.texture.xy()));
                let textures = [own, floor.map(|angle| across(along(angle)))];
                let d = node.slip.xy().normalize();
                law.traction(node.pressure, d, textures)
            } else {
                node.tau.xy()
            };
            sum += tau.push(node.pressure) * area;
        }
        let found = report::pairs(&run.problem, state)[0].sides[0].force;
        let error = (found - sum).norm() / found.norm();
        assert!(
            error < 1e-10,
            "{law:?}: resultant off by {error:.1e} at {}",
            state.time
        );
    }
    assert!(slipping > 0);
    dissipates(run);
}

/// Slides in 24 directions: states of steady sliding with the forces on the block.
fn in_24_directions(oblique: &Oblique) -> Vec<(Sliding, Vec3)> {
    let mut model = oblique.model(&block([0.0; 3], [1.0, 1.0, 0.6], [2, 2, 1]));
    let directions = (0..24).map(|at| oblique.sliding(15.0 * f64::from(at)));
    let directions: Vec<Sliding> = directions.collect();
    let mut place = Vector2::zeros();
    for sliding in &directions {
        for length in [1.0, 8.0, 8.0, 8.0] {
            place += sliding.direction * length;
            model.steps.push(sliding.step(&model, place, 1));
        }
    }
    let run = Run::completed(model);
    check_nodal_law(&run, oblique.law, oblique.angles[1]);
    let force = |at: usize| {
        let mut steps = run.progress.iter().map(|progress| progress.step);
        let settled = steps.rposition(|step| step == 4 * at + 3).unwrap();
        report::pairs(&run.problem, &run.states[settled + 1])[0].sides[0].force
    };
    let forces: Vec<Vec3> = (0..24).map(force).collect();
    directions.into_iter().zip(forces).collect()
}

#[test]
fn resultants_follow_the_law_in_24_directions() {
    for relative in [0.0, 50.0, 130.0] {
        let oblique = Oblique::new(CONSTANTS, [Some(20.0), Some(20.0 + relative)]);
        for (sliding, found) in in_24_directions(&oblique) {
            let error = (found - sliding.tau.push(sliding.pressure)).norm() / found.norm();
            let degrees = sliding.direction;
            assert!(error < 1e-6, "{relative}, {degrees}: off by {error:.1e}");
        }
    }
}

#[test]
fn resultants_are_those_of_the_table_in_24_directions() {
    for angles in [[Some(30.0), None], [None, Some(-45.0)]] {
        let oblique = Oblique::new(Formula::Tabulated(MEASURED), angles);
        let across = angles.map(|angle| angle.map(|angle: f64| along(angle - 90.0)));
        let mut hit = vec![0; MEASURED.len()];
        for (sliding, found) in in_24_directions(&oblique) {
            let d = sliding.direction;
            let angle = angle_of_slip(d, across).rem_euclid(360.0);
            let at = (angle / 15.0).round() as usize % 24;
            hit[at] += 1;
            let [_, mu] = MEASURED[at];
            let expected = (-mu * d).push(1.0) * sliding.pressure;
            let error = (found - expected).norm() / found.norm();
            assert!(error < 1e-6, "{angles:?}, {angle}: off by {error:.1e}");
        }
        assert_eq!(hit, [1; 24]);
    }
}

/// Force over pressure after sliding far along a direction.
fn friction(oblique: &Oblique, degrees: f64) -> Vector2<f64> {
    let mut model = oblique.model(&irregular_block());
    let sliding = oblique.sliding(degrees);
    let mut place = Vector2::zeros();
    for length in [1.0, 8.0, 8.0, 8.0] {
        place += sliding.direction * length;
        model.steps.push(sliding.step(&model, place, 1));
    }
    let run = Run::completed(model);
    let side = report::pairs(&run.problem, run.last())[0].sides[0];
    side.force.xy() / side.pressure
}

#[test]
fn with_against_and_across_the_nap() {
    // Scales of the block: a = n x s, n down. Scales of the floor point the other
    // way as seen from the block.
    let (forward, backward, lateral) = (0.1, 0.3, 0.2);
    let law = Formula::Nap([forward, backward, lateral]);
    for (angles, a) in [([Some(30.0), None], -60.0), ([None, Some(30.0)], -60.0)] {
        let oblique = Oblique::new(law, angles);
        let with = friction(&oblique, a + 180.0);
        assert!((with - along(a) * forward).norm() < 1e-8, "{with}");
        let against = friction(&oblique, a);
        assert!((against + along(a) * backward).norm() < 1e-8, "{against}");
        let across = friction(&oblique, a + 90.0);
        let expected = -along(a + 90.0) * lateral - along(a) * (0.5 * (backward - forward));
        assert!((across - expected).norm() < 1e-8, "{across}");
    }
}

#[test]
fn exchanged_textures_and_turned_scenes() {
    let found = friction(&Oblique::new(CONSTANTS, [Some(10.0), Some(75.0)]), 40.0);
    let exchanged = friction(&Oblique::new(CONSTANTS, [Some(75.0), Some(10.0)]), 40.0);
    assert!((found - exchanged).norm() < 1e-8, "{found} {exchanged}");
    let turned = friction(&Oblique::new(CONSTANTS, [Some(131.0), Some(196.0)]), 161.0);
    let expected = nalgebra::Rotation2::new(121f64.to_radians()) * found;
    assert!((turned - expected).norm() < 1e-8, "{turned} {expected}");
}

/// A block pressed down and dragged around a corner, its sides free.
fn dragged(body_block: &Block, law: Formula, turn: &Turn, floor: RigidShape) -> Model {
    let mesh = body_block.mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.touch_rigid(("block", "zmin"), floor, law.friction());
    model.pairs[0].textures = turn
        .textures
        .map(|angle| angle.map(|angle| turn.paint(angle)));
    let motions = [
        (2, Vec3::new(0.0, 0.0, -0.04)),
        (3, Vec3::new(0.3, 0.1, -0.04)),
        (3, Vec3::new(0.2, 0.4, -0.04)),
    ];
    for (count, motion) in motions {
        let mut step = step();
        step.increments = increments(1.0 / f64::from(count), 0.01);
        let motion = turn.rotation * motion;
        let components = [Some(motion.x), Some(motion.y), Some(motion.z)];
        step.displacements = vec![model.hold("block", "zmax", components)];
        model.steps.push(step);
    }
    model
}

/// Rotation of the frame in which a scene is described.
struct Turn {
    rotation: nalgebra::Rotation3<f64>,
    textures: [Option<f64>; 2],
}

impl Turn {
    fn none(textures: [Option<f64>; 2]) -> Self {
        let rotation = nalgebra::Rotation3::identity();
        Self { rotation, textures }
    }

    fn paint(&self, degrees: f64) -> Paint {
        let direction = self.rotation * along(degrees).push(0.0);
        let lines = Lines::Uniform(direction);
        Paint::Field(Field { lines, turn: 0.0 })
    }
}

const TEXTURES: [Option<f64>; 2] = [Some(15.0), Some(70.0)];

fn laws() -> [(Formula, [Option<f64>; 2]); 5] {
    [
        (CONSTANTS, TEXTURES),
        (Formula::TwoTextures([0.2, 0.3, 2.0, 0.5]), TEXTURES),
        (Formula::Associated([0.3, 0.15]), [Some(15.0), None]),
        (Formula::Nap([0.1, 0.3, 0.2]), [None, Some(70.0)]),
        (Formula::Tabulated(STRONG), [Some(15.0), None]),
    ]
}

fn horizontal() -> RigidShape {
    plane([0.0; 3], [0.0, 0.0, 1.0])
}

#[test]
fn resultants_sum_the_nodal_law() {
    for (law, textures) in laws() {
        let turn = Turn::none(textures);
        let run = Run::completed(dragged(&irregular_block(), law, &turn, horizontal()));
        check_nodal_law(&run, law, textures[1]);
    }
}

#[test]
fn rotated_scenes_give_rotated_answers() {
    let axis = Vec3::new(1.0, -2.0, 0.5);
    let angle = 73f64;
    let unit = nalgebra::Unit::new_normalize(axis);
    let rotation = nalgebra::Rotation3::from_axis_angle(&unit, angle.to_radians());
    for (law, textures) in laws() {
        let straight = Turn::none(textures);
        let straight = Run::completed(dragged(&irregular_block(), law, &straight, horizontal()));
        let rotated_block = Block {
            rotation: Some(Rotation {
                axis,
                degrees: angle,
                about: Pivot::Point(Vec3::zeros()),
            }),
            ..irregular_block()
        };
        let turn = Turn { rotation, textures };
        let floor = plane([0.0; 3], (rotation * Vec3::z()).into());
        let rotated = Run::completed(dragged(&rotated_block, law, &turn, floor));
        let expected: Vec<Vec3> = straight.positions(0).iter().map(|x| rotation * x).collect();
        let error = largest_distance(rotated.positions(0), &expected);
        assert!(error < 1e-9, "{law:?}: {error:.1e}");
    }
}

/// A flat floor of quadrilaterals or triangles, its nodes in the given order.
fn meshed_floor(divisions: usize, triangles: bool, order: impl Fn(usize) -> usize) -> RigidShape {
    let count = (divisions + 1) * (divisions + 1);
    let mut positions = vec![Vec3::zeros(); count];
    let number = |i: usize, j: usize| order(i + j * (divisions + 1));
    let mut facets = Vec::new();
    for j in 0..=divisions {
        for i in 0..=divisions {
            let [x, y] = [i, j].map(|at| -1.0 + 3.0 * at as f64 / divisions as f64);
            positions[number(i, j)] = Vec3::new(x, y, 0.0);
            if i < divisions && j < divisions {
                let [a, b] = [number(i, j), number(i + 1, j)];
                let [c, d] = [number(i + 1, j + 1), number(i, j + 1)];
                if triangles {
                    facets.extend([[a, b, c, c], [a, c, d, d]]);
                } else {
                    facets.push([b, c, d, a]);
                }
            }
        }
    }
    RigidShape::Facets {
        positions,
        facets: facets.iter().map(|facet| facet.map(NodeId::new)).collect(),
    }
}

#[test]
fn meshes_of_the_floor_do_not_matter() {
    for (law, textures) in [laws()[1], laws()[3]] {
        let turn = Turn::none(textures);
        let on_plane = Run::completed(dragged(&irregular_block(), law, &turn, horizontal()));
        let floors = [
            meshed_floor(1, false, |node| node),
            meshed_floor(4, false, |node| node),
            meshed_floor(5, true, |node| node),
            meshed_floor(5, true, |node| (7 * node + 11) % 36),
        ];
        for (at, floor) in floors.into_iter().enumerate() {
            let run = Run::completed(dragged(&irregular_block(), law, &turn, floor));
            let error = largest_distance(run.positions(0), on_plane.positions(0));
            // Where supports are partly closed, points lie elsewhere on cut facets.
            assert!(error < 2e-4, "{law:?}, floor {at}: {error:.1e}");
        }
    }
}

fn coarse_block() -> Block {
    Block {
        divisions: [2, 2, 1],
        ..irregular_block()
    }
}

/// A block dragged over another one, in either order of the pair.
fn two_blocks(law: Formula, textures: [Option<f64>; 2], order: [usize; 2]) -> Model {
    let lower = Block {
        irregularity: 0.15,
        ..block([-0.3, -0.3, -0.5], [1.6, 1.6, 0.5], [3, 3, 1])
    };
    let bodies = vec![
        body("lower", lower.mesh().unwrap(), rubber(2.0, 0.3)),
        body("upper", coarse_block().mesh().unwrap(), rubber(1.0, 0.3)),
    ];
    let mut model = model(bodies);
    let sides = [("lower", "zmax"), ("upper", "zmin")];
    model.touch(sides[order[0]], sides[order[1]], law.friction());
    model.pairs[0].textures = order.map(|side| textures[side].map(uniform));
    for motion in [[0.0, 0.0, -0.04], [0.15, 0.05, -0.04], [0.1, 0.2, -0.04]] {
        let mut step = step();
        step.increments = increments(0.5, 0.01);
        step.displacements = vec![
            model.hold("lower", "zmin", [Some(0.0); 3]),
            model.hold("upper", "zmax", motion.map(Some)),
        ];
        model.steps.push(step);
    }
    model
}

#[test]
fn the_order_of_the_sides_does_not_matter() {
    for (law, textures) in laws() {
        let [one, other] =
            [[0, 1], [1, 0]].map(|order| Run::completed(two_blocks(law, textures, order)));
        for body in 0..2 {
            let error = largest_distance(one.positions(body), other.positions(body));
            assert!(error < 1e-9, "{law:?}, body {body}: {error:.1e}");
        }
        dissipates(&one);
        let slips = one.last().pairs[0].nodes.iter().flatten();
        assert!(slips.filter(|node| node.status == Status::Slip).count() > 10);
    }
}
