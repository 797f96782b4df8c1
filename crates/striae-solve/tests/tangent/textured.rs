//! Tangent of contact between textured surfaces that slip.

use striae_contact::{pair::Enforcement, placement::Placement, unknowns::Status};
use striae_mesh::{NodeId, Vec3, generate::Block};
use striae_model::{Model, RigidShape};
use striae_solve::{assembly::StepContext, problem::Problem, state::State};
use striae_surface::texture::{Axis, Field, Lines, Paint};

use crate::{
    oblique::{Formula, uniform},
    pair::{PairFunction, Places, Wanted},
    placed::dependent,
    scene::{Places as _, block, body, model, rubber, step},
    table::STRONG,
};

/// Time in which the slip came about.
const ELAPSED: f64 = 0.5;

const BOTH: [Option<f64>; 2] = [Some(15.0), Some(70.0)];

fn laws() -> [(Formula, [Option<f64>; 2]); 8] {
    [
        (Formula::TwoTextures([0.2, 0.1, 0.1, 0.5]), BOTH),
        (Formula::TwoTextures([0.2, 0.3, 2.0, 0.5]), BOTH),
        (Formula::Opposing([0.3, 0.15]), [None, Some(70.0)]),
        (Formula::Associated([0.3, 0.15]), [Some(15.0), None]),
        (Formula::Associated([0.3, 0.15]), [None, Some(70.0)]),
        (Formula::Nap([0.1, 0.3, 0.2]), [Some(15.0), None]),
        (Formula::Tabulated(STRONG), [Some(15.0), None]),
        (Formula::Tabulated(STRONG), [None, Some(70.0)]),
    ]
}

/// Circles about a point beside the contact, turned.
fn circles(degrees: f64) -> Paint {
    let axis = Axis {
        point: Vec3::new(-0.6, 1.7, 0.0),
        direction: Vec3::z(),
    };
    Paint::Field(Field {
        lines: Lines::Circumferential(axis),
        turn: degrees.to_radians(),
    })
}

fn upper() -> Block {
    Block {
        irregularity: 0.2,
        ..block([0.0; 3], [1.0, 1.0, 0.5], [2, 3, 1])
    }
}

/// A smooth map that bends the interface.
fn bent(x: &Vec3) -> Vec3 {
    let lift = 0.08 * (1.3 * x.x + 0.2).sin() - 0.06 * x.y * x.y + 0.05 * x.x * x.y;
    Vec3::new(
        x.x + 0.05 * x.y * x.y,
        1.04 * x.y - 0.03 * x.x * x.y,
        x.z + lift,
    )
}

fn slid(problem: &Problem) -> [Places; 2] {
    let shift = Vec3::new(0.031, 0.047, -0.004);
    let upper = problem.model.bodies[0].mesh.positions.len();
    let reference = problem.reference.iter().enumerate();
    let moved = reference.map(|(node, x)| if node < upper { x + shift } else { *x });
    let moved: Vec<Vec3> = moved.map(|x| bent(&x)).collect();
    [problem.reference.clone(), moved].map(|positions| Places {
        positions,
        placement: Placement::at_rest(),
    })
}

/// Checks a model unchanged, with friction that decays with the slip rate and with friction that
/// depends on both pressure and slip rate.
fn check(name: &str, mut model: Model) {
    model.steps.push(step());
    let mut decaying = model.clone();
    for pair in &mut decaying.pairs {
        pair.friction = pair.friction.clone().with_decay(0.4, 0.15).unwrap();
    }
    let mut depending = model.clone();
    for pair in &mut depending.pairs {
        pair.friction = dependent(pair.friction.clone());
    }
    for enforcement in [Enforcement::Weighted, Enforcement::Collocated] {
        for mut model in [model.clone(), decaying.clone(), depending.clone()] {
            model.pairs[0].enforcement = enforcement;
            let problem = Problem::new(model).unwrap();
            let state = State::undeformed(&problem);
            let context = StepContext::new(&problem, 0, &state);
            let [start, now] = slid(&problem);
            let pair = PairFunction::new(&context, start, now, ELAPSED);
            let name = format!("{name}, {enforcement:?}");
            for wanted in [Wanted::Slip, Wanted::Mixed] {
                let u = pair.state(wanted);
                let statuses = pair.statuses(&u);
                let slips = statuses.iter().filter(|s| **s == Status::Slip).count();
                let enough = match wanted {
                    Wanted::Slip => slips > 2,
                    Wanted::Mixed => slips > 0,
                };
                assert!(enough, "{name}: {statuses:?}");
                pair.assert_order(&u, &name);
            }
        }
    }
}

fn on_rigid(law: Formula, paints: [Option<Paint>; 2], floor: RigidShape) -> Model {
    let bodies = vec![body("upper", upper().mesh().unwrap(), rubber(1.0, 0.3))];
    let mut model = model(bodies);
    model.touch_rigid(("upper", "zmin"), floor, law.friction());
    model.pairs[0].textures = paints;
    model
}

#[test]
fn on_a_rigid_plane() {
    for (law, angles) in laws() {
        for paint in [uniform, circles] {
            let paints = angles.map(|angle| angle.map(paint));
            let floor = crate::scene::plane([0.0; 3], [0.05, -0.02, 1.0]);
            check(&format!("plane, {law:?}"), on_rigid(law, paints, floor));
        }
    }
}

/// A coarse curved floor of five by five facets from -1.1 on.
fn curved_floor(spacing: f64) -> RigidShape {
    let place = |at: usize| -1.1 + spacing * at as f64;
    let mut positions = Vec::new();
    let mut facets = Vec::new();
    for j in 0..6 {
        for i in 0..6 {
            positions.push(bent(&Vec3::new(place(i), place(j), 0.0)));
            if i < 5 && j < 5 {
                let a = i + 6 * j;
                facets.push([a, a + 1, a + 7, a + 6].map(NodeId::new));
            }
        }
    }
    RigidShape::Facets { positions, facets }
}

#[test]
fn on_rigid_facets() {
    for (law, angles) in laws() {
        for paint in [uniform, circles] {
            let paints = angles.map(|angle| angle.map(paint));
            // The second ends under the block.
            for spacing in [0.7, 0.37] {
                let model = on_rigid(law, paints.clone(), curved_floor(spacing));
                check(&format!("facets of {spacing}, {law:?}"), model);
            }
        }
    }
}

#[test]
fn between_curved_bodies() {
    for (law, angles) in [laws()[1], laws()[3], laws()[5], laws()[6]] {
        for paint in [uniform, circles] {
            // It ends under the upper body.
            let lower = Block {
                irregularity: 0.15,
                ..block([-0.37, -0.41, -0.5], [1.1, 1.8, 0.5], [3, 3, 1])
            };
            let mut model = model(vec![
                body("upper", upper().mesh().unwrap(), rubber(1.0, 0.3)),
                body("lower", lower.mesh().unwrap(), rubber(1.0, 0.3)),
            ]);
            model.touch(("upper", "zmin"), ("lower", "zmax"), law.friction());
            model.pairs[0].textures = angles.map(|angle| angle.map(paint));
            check(&format!("bodies, {law:?}"), model);
        }
    }
}
