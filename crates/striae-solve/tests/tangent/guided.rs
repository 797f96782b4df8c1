//! Tangent of nodes that guides let slip one way only.

use striae_contact::{complementarity::Prescribed, pair::Enforcement, unknowns::Status};
use striae_law::friction::{Friction, SlipRule};
use striae_mesh::Vec3;
use striae_model::Model;
use striae_solve::{assembly::StepContext, problem::Problem, state::State};
use striae_surface::texture::{Field, Lines, Paint};

use crate::{
    pair::{PairFunction, Places, Wanted},
    placed::{dependent, dome, of_bodies, of_rigid, on_rigid, two_blocks},
    scene::{coulomb, plane},
};

/// Nodes with prescribed `y` and `z`: all of them, or all but every fourth.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Guided {
    All,
    Most,
}

fn guides(pair: &PairFunction, guided: Guided) -> Prescribed {
    let components = pair.prescribed.components.each_ref().map(|of_side| {
        let is_guided = |node: usize| guided == Guided::All || !node.is_multiple_of(4);
        let components = 0..of_side.len();
        components
            .map(|at| at % 3 != 0 && is_guided(at / 3))
            .collect()
    });
    Prescribed {
        components,
        ..Prescribed::default()
    }
}

fn check(name: &str, model: Model, guided: Guided, places: impl Fn(&Problem) -> [Places; 2]) {
    for enforcement in [Enforcement::Weighted, Enforcement::Collocated] {
        let mut model = model.clone();
        model.pairs[0].enforcement = enforcement;
        let problem = Problem::new(model).unwrap();
        let state = State::undeformed(&problem);
        let context = StepContext::new(&problem, 0, &state);
        let [start, now] = places(&problem);
        let mut pair = PairFunction::new(&context, start, now, 0.5);
        pair.prescribed = guides(&pair, guided);
        let u = pair.state(Wanted::Mixed);
        let name = format!("{enforcement:?} {guided:?} {name}");
        let guided: Vec<Status> = pair
            .selection
            .kept()
            .iter()
            .zip(pair.statuses(&u))
            .filter(|(kept, _)| pair.prescribed.components[kept.side][3 * kept.node.index() + 1])
            .map(|(_, status)| status)
            .collect();
        for status in [Status::Stick, Status::Slip] {
            assert!(
                guided.contains(&status),
                "{name}: none {status:?}: {guided:?}"
            );
        }
        pair.assert_order(&u, &name);
    }
}

fn laws() -> [Friction; 3] {
    [
        coulomb(0.5),
        coulomb(0.5).with_decay(0.4, 0.15).expect("in range"),
        dependent(coulomb(0.5)),
    ]
}

#[test]
fn on_rigid_surfaces() {
    let inclined = plane([0.0, 0.0, 0.01], [0.02, -0.03, 1.0]);
    for (shape, bump) in [(inclined, 0.02), (dome(4), 0.1), (dome(3), 0.1)] {
        for friction in laws() {
            for guided in [Guided::All, Guided::Most] {
                let mut model = on_rigid(shape.clone());
                let name = format!("bump {bump}, {:?}", friction.coefficient());
                model.pairs[0].friction = friction.clone();
                check(&name, model, guided, |problem| of_rigid(problem, bump, 11));
            }
        }
    }
}

#[test]
fn on_a_textured_floor() {
    let mut model = on_rigid(dome(4));
    // Slip is not along `z`.
    model.pairs[0].friction = Friction::orthotropic(0.2, 0.5, SlipRule::Associated).unwrap();
    model.pairs[0].textures[0] = Some(Paint::Field(Field {
        lines: Lines::Uniform(Vec3::new(0.8, 0.6, 0.0)),
        turn: 0.0,
    }));
    for guided in [Guided::All, Guided::Most] {
        check("texture", model.clone(), guided, |problem| {
            of_rigid(problem, 0.1, 11)
        });
    }
}

#[test]
fn between_bodies() {
    for friction in laws() {
        let name = format!("bodies, {:?}", friction.coefficient());
        let model = two_blocks([1.0, 1.0], [3, 3], friction);
        check(&name, model, Guided::All, |problem| of_bodies(problem, 7));
    }
}
