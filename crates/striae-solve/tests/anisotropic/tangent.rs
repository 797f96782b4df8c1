//! The tangent of a textured pair against finite differences.
//!
//! Slipping nodes satisfy their row exactly, `z = varpi K^-1 du/|K^-1 du|`: there
//! the globalised Jacobian is the exact one. All nodes slip, so no row is at its
//! kink.

use crate::{
    oblique::{Formula, uniform},
    scene::{Places, block, body, model, rubber, step},
    table::STRONG,
};
use nalgebra::{DMatrix, DVector};
use striae_contact::{
    complementarity::Iteration,
    configuration::Configuration,
    evaluation::{Evaluation, evaluate},
    frame::{Frames, frames},
    selection::{Role, Selection},
    texture::{Textures, textures},
    unknowns::{Status, Tractions},
};
use striae_law::friction::Textures as LawTextures;
use striae_mesh::{NodeId, Vec3, generate::Block};
use striae_solve::{
    assembly::StepContext,
    model::{Model, RigidShape},
    problem::Problem,
    state::State,
};
use striae_surface::texture::{Axis, Field, Lines, Paint};
use striae_verify::{Difference, Random, derivative::directional};

/// A slipping state of a pair: roles chosen at rest, everything moved since.
struct Slipping<'a> {
    context: StepContext<'a>,
    selection: Selection,
    at: DVector<f64>,
}

impl<'a> Slipping<'a> {
    fn new(problem: &'a Problem, state: &'a State, motion: impl Fn(usize, &Vec3) -> Vec3) -> Self {
        let context = StepContext::new(problem, 0, state);
        let selection = {
            let configuration = context.configuration(0, &state.positions, &state.rigid);
            Selection::new(&configuration, &state.pairs[0].kinematic)
        };
        let numbering = context.pairs[0].numbering();
        let mut at = DVector::zeros(numbering.balance(selection.patches.len()) as usize);
        let mut random = Random::new(7);
        for side in 0..2 {
            for node in 0..selection.roles[side].len() as u32 {
                let global = problem.surface_node(0, side, node).unwrap();
                let x = motion(side, &state.positions[global]);
                let first = numbering.position(side, node) as usize;
                at.fixed_rows_mut::<3>(first).copy_from(&x);
                let first = numbering.traction(side, node) as usize;
                if selection.roles[side][node as usize] != Role::Idle {
                    at[first] = random.uniform(0.8, 1.2);
                    at[first + 1] = random.uniform(-0.1, 0.1);
                    at[first + 2] = random.uniform(-0.1, 0.1);
                }
            }
        }
        for patch in 0..selection.patches.len() {
            for component in 0..6 {
                at[numbering.balance(patch) as usize + component] = random.uniform(-0.05, 0.05);
            }
        }
        let mut slipping = Self {
            context,
            selection,
            at,
        };
        slipping.satisfy_slip_rows();
        slipping
    }

    fn configuration(&self, at: &DVector<f64>) -> Configuration<'_> {
        let mut positions = self.context.start.positions.clone();
        let numbering = self.context.pairs[0].numbering();
        for side in 0..2 {
            for node in 0..self.selection.roles[side].len() as u32 {
                let global = self.context.problem.surface_node(0, side, node).unwrap();
                let first = numbering.position(side, node) as usize;
                positions[global] = at.fixed_rows::<3>(first).into();
            }
        }
        let rigid = &self.context.start.rigid;
        self.context
            .configuration(0, &positions, rigid)
            .lasting(ELAPSED)
    }

    fn tractions(&self, at: &DVector<f64>) -> Tractions {
        let numbering = self.context.pairs[0].numbering();
        let mut tractions = self.context.start.pairs[0].tractions.clone();
        for side in 0..2 {
            for (node, unknowns) in tractions.nodes[side].iter_mut().enumerate() {
                let first = numbering.traction(side, node as u32) as usize;
                *unknowns = [at[first], at[first + 1], at[first + 2]];
            }
        }
        let patches = 0..self.selection.patches.len();
        let balance = |patch| {
            let first = numbering.balance(patch) as usize;
            std::array::from_fn(|component| at[first + component])
        };
        tractions.balance = patches.map(balance).collect();
        tractions
    }

    fn evaluation(&self, at: &DVector<f64>) -> Evaluation {
        let configuration = self.configuration(at);
        let prescribed = &self.context.fixed_on_pair[0];
        let tractions = self.tractions(at);
        evaluate(
            &configuration,
            &self.selection,
            &tractions,
            prescribed,
            Iteration::Later,
        )
        .unwrap()
    }

    fn residual(&self, at: &DVector<f64>) -> DVector<f64> {
        let mut residual = DVector::zeros(at.len());
        for term in self.evaluation(at).terms {
            for (row, value) in term.rows.iter().zip(&term.residual) {
                residual[*row as usize] += value;
            }
        }
        residual
    }

    fn jacobian(&self) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(self.at.len(), self.at.len());
        for term in self.evaluation(&self.at).terms {
            let rows = term.tangent.chunks(term.columns.len());
            for (row, values) in term.rows.iter().zip(rows) {
                for (column, value) in term.columns.iter().zip(values) {
                    jacobian[(*row as usize, *column as usize)] += value;
                }
            }
        }
        jacobian
    }

    fn satisfy_slip_rows(&mut self) {
        let nodes = self.evaluation(&self.at).nodes;
        let configuration = self.configuration(&self.at);
        let frames: Frames = frames(&configuration, &self.selection).unwrap();
        let textures: Textures = textures(&configuration, &self.selection, &frames).unwrap();
        let pair = &self.context.pairs[0];
        let mut at = self.at.clone();
        for side in 0..2 {
            for (node, role) in self.selection.roles[side].iter().enumerate() {
                if !matches!(role, Role::Kinematic(_)) {
                    continue;
                }
                let frame = frames[side][node].as_ref().unwrap();
                let of_node = &textures[side][node];
                let law_textures = LawTextures {
                    own: of_node.own.as_ref().map(|a| a.value),
                    opposite: of_node.opposite.as_ref().map(|a| a.value),
                };
                let kernel = pair.friction.kernel(&frame.n.value, &law_textures);
                let first = pair.numbering().traction(side, node as u32) as usize;
                let direction = (kernel.k_inverse * nodes[side][node].slip).normalize();
                let rate = nodes[side][node].slip.norm() / ELAPSED;
                let z = direction * pair.friction.cap(at[first], rate);
                at[first + 1] = z.dot(&frame.t[0].value);
                at[first + 2] = z.dot(&frame.t[1].value);
            }
        }
        self.at = at;
    }

    fn check(&self, name: &str) {
        let nodes = self.evaluation(&self.at).nodes;
        let roles = self.selection.roles.iter().flatten();
        let kinematic: Vec<Status> = roles
            .zip(nodes.iter().flatten())
            .filter(|(role, _)| matches!(role, Role::Kinematic(_)))
            .map(|(_, node)| node.status)
            .collect();
        assert!(kinematic.len() > 5, "{name}: {kinematic:?}");
        assert!(
            kinematic.iter().all(|status| *status == Status::Slip),
            "{name}: {kinematic:?}"
        );
        let jacobian = self.jacobian();
        let direction = Random::new(1).unit(self.at.len());
        let claimed = &jacobian * &direction;
        let residual = |x: &DVector<f64>| self.residual(x);
        let order = directional(
            Difference::Central,
            residual,
            &claimed,
            &self.at,
            &direction,
        );
        match order {
            Ok(order) => assert!(order.is_some(), "{name}: no order"),
            Err(wrong) => panic!("{name}: {wrong}"),
        }
    }
}

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

fn slide(side: usize, x: &Vec3) -> Vec3 {
    let shift = Vec3::new(0.031, 0.047, -0.004);
    if side == 0 {
        bent(&(x + shift))
    } else {
        bent(x)
    }
}

/// Checks a model as it is and with friction that decays with the slip rate.
fn check(name: &str, mut model: Model) {
    model.steps.push(step());
    let mut decaying = model.clone();
    for pair in &mut decaying.pairs {
        pair.friction = pair.friction.clone().with_decay(0.4, 0.15).unwrap();
    }
    for model in [model, decaying] {
        let problem = Problem::new(model).unwrap();
        let state = State::undeformed(&problem);
        Slipping::new(&problem, &state, slide).check(name);
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

/// A coarse curved floor.
fn curved_floor() -> RigidShape {
    let place = |at: usize| -1.1 + 0.7 * at as f64;
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
            let model = on_rigid(law, paints, curved_floor());
            check(&format!("facets, {law:?}"), model);
        }
    }
}

#[test]
fn between_curved_bodies() {
    for (law, angles) in [laws()[1], laws()[3], laws()[5], laws()[6]] {
        for paint in [uniform, circles] {
            let lower = Block {
                irregularity: 0.15,
                ..block([-0.37, -0.41, -0.5], [1.8, 1.8, 0.5], [4, 3, 1])
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
