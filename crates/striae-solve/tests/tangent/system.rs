//! Tangent of the whole system under all kinds of loads: the error of central
//! differences falls with the square of the step.

use crate::{
    placed::{bumps, dome, on_rigid, two_blocks},
    scene::{Places, Run, coulomb, increments, plane, step},
};
use nalgebra::DVector;
use striae_contact::{
    complementarity::Iteration,
    selection::{Before, Selection},
    unknowns::Status,
};
use striae_law::friction::Friction;
use striae_linalg::{SparseMatrix, Structure, Supervariable};
use striae_mesh::Vec3;
use striae_solve::{
    assembly::{
        Assembled, Contact, Fault, Imposed, Setting, StepContext, Trial, assemble, assemble_contact,
    },
    layout::{Extent, Layout},
    model::{Curve, Freedom, LoadExtent, LoadKind, Model, RigidId, RigidMotion},
    newton::{Workspace, advance},
    problem::Problem,
    state::State,
};
use striae_verify::{Difference, Random, derivative::directional};

/// The whole system of a step as a function of all unknowns, after the converged state
/// `before`.
struct Whole<'a> {
    context: &'a StepContext<'a>,
    selections: Vec<Selection>,
    imposed: Imposed,
    layout: Layout,
    structure: Structure,
    before: &'a State,
    state: &'a State,
}

impl<'a> Whole<'a> {
    fn new(context: &'a StepContext<'a>, before: &'a State, state: &'a State) -> Self {
        let selections = selections(context, before, state);
        let layout = Layout::new(context.problem, Extent::default().with(&selections));
        let every: Vec<_> = (0..layout.offsets().len() - 1).map(Supervariable).collect();
        let structure = Structure::from_cliques(layout.offsets().to_vec(), &[&every])
            .and_then(|structure| structure.grown(&[&every]))
            .unwrap();
        Self {
            selections,
            imposed: context.imposed(1.0),
            context,
            layout,
            structure,
            before,
            state,
        }
    }

    fn trial(&self, u: &DVector<f64>) -> Trial {
        let mut trial = self.reference();
        self.each(&mut trial, |at, value| *value = u[at]);
        for (rigid, pose) in trial.rigid.iter_mut().enumerate() {
            if let Some(first) = self.layout.rigid(rigid) {
                let coordinates = std::array::from_fn(|at| u[first + at]);
                *pose = self.imposed.before[rigid].moved_to(&coordinates);
            }
        }
        trial
    }

    fn reference(&self) -> Trial {
        Trial {
            positions: self.state.positions.clone(),
            tractions: self
                .state
                .pairs
                .iter()
                .map(|p| p.tractions.clone())
                .collect(),
            rigid: self.state.rigid.clone(),
        }
    }

    fn each(&self, trial: &mut Trial, mut visit: impl FnMut(usize, &mut f64)) {
        for (node, x) in trial.positions.iter_mut().enumerate() {
            let first = self.layout.position(node);
            x.iter_mut()
                .enumerate()
                .for_each(|(axis, v)| visit(first + axis, v));
        }
        for (pair, tractions) in trial.tractions.iter_mut().enumerate() {
            for side in 0..2 {
                for (node, values) in tractions.nodes[side].iter_mut().enumerate() {
                    if let Some(first) = self.layout.traction(pair, side, node) {
                        values
                            .iter_mut()
                            .enumerate()
                            .for_each(|(at, v)| visit(first + at, v));
                    }
                }
            }
        }
    }

    fn unknowns(&self) -> DVector<f64> {
        let mut u = DVector::zeros(self.layout.unknowns());
        self.each(&mut self.reference(), |at, value| u[at] = *value);
        for (rigid, pose) in self.state.rigid.iter().enumerate() {
            if let Some(first) = self.layout.rigid(rigid) {
                u.rows_mut(first, 6).copy_from_slice(&pose.coordinates());
            }
        }
        u
    }

    fn assert_order(&self) {
        self.assert_order_at(self.unknowns());
    }

    fn assert_order_at(&self, u: DVector<f64>) {
        let (_, matrix) = self.assembled(&u);
        for seed in 0..2 {
            let direction = Random::new(seed).unit(u.len());
            let mut claimed = DVector::zeros(u.len());
            matrix.multiply(direction.as_slice(), claimed.as_mut_slice());
            let order = directional(
                Difference::Central,
                |u| self.assembled(u).0,
                &claimed,
                &u,
                &direction,
            );
            if let Err(wrong) = order {
                panic!("{wrong}");
            }
        }
    }

    /// The same with all but contact linearised at `u`.
    fn assert_order_of_contact(&self) {
        let u = self.unknowns();
        let (assembled, matrix) = self.evaluated(&u);
        let setting = self.setting();
        let direction = Random::new(2).unit(u.len());
        let mut claimed = DVector::zeros(u.len());
        matrix.multiply(direction.as_slice(), claimed.as_mut_slice());
        let contact = |v: &DVector<f64>| {
            let (trial, change) = (self.trial(v), v - &u);
            let mut matrix = matrix.clone();
            let found = assemble_contact(
                &setting,
                &assembled.background,
                (&trial, change.as_slice()),
                Iteration::LATER,
                &self.layout,
                &mut matrix,
            );
            DVector::from_vec(found.expect("the pattern is full").residual)
        };
        let here = contact(&u);
        let difference = here - DVector::from_vec(assembled.residual.clone());
        assert!(difference.amax() <= 1e-13, "{:e}", difference.amax());
        let order = directional(Difference::Central, contact, &claimed, &u, &direction);
        if let Err(wrong) = order {
            panic!("{wrong}");
        }
    }

    /// The unknowns with rows of slip satisfied, since only there is their Jacobian exact: an
    /// increment in which rigid points turn up chooses its field within itself, which is not
    /// found again here. The rows state `z - varpi y/|y|`, whose root attracts.
    fn settled(&self) -> DVector<f64> {
        let mut u = self.unknowns();
        for _ in 0..200 {
            let (assembled, _) = self.evaluated(&u);
            let nodes = assembled.contacts[0].nodes.iter().enumerate();
            let slipping = nodes.flat_map(|(side, nodes)| {
                let slipping = (0..nodes.len()).filter(|&n| nodes[n].status == Status::Slip);
                slipping.filter_map(move |node| self.layout.traction(0, side, node))
            });
            let rows: Vec<usize> = slipping.flat_map(|at| [at + 1, at + 2]).collect();
            let off = rows.iter().map(|&row| assembled.residual[row].abs());
            if off.fold(0.0, f64::max) < 1e-13 {
                return u;
            }
            rows.iter()
                .for_each(|&row| u[row] -= assembled.residual[row]);
        }
        panic!("friction does not settle");
    }

    fn setting(&self) -> Setting<'_> {
        Setting {
            context: self.context,
            state: self.before,
            selections: &self.selections,
            imposed: &self.imposed,
        }
    }

    fn assembled(&self, u: &DVector<f64>) -> (DVector<f64>, SparseMatrix) {
        let (assembled, matrix) = self.evaluated(u);
        (DVector::from_vec(assembled.residual), matrix)
    }

    fn evaluated(&self, u: &DVector<f64>) -> (Assembled, SparseMatrix) {
        let mut matrix = SparseMatrix::zero(&self.structure);
        let contact = Contact::Evaluated(Iteration::LATER);
        let trial = self.trial(u);
        let assembled = assemble(&self.setting(), &trial, contact, &self.layout, &mut matrix);
        match assembled {
            Ok(assembled) => (assembled, matrix),
            Err(Fault::CutBack(reason)) => panic!("{reason}"),
            Err(Fault::Pattern(_)) => panic!("the pattern is full"),
        }
    }
}

/// The traction fields of the increment from `before` to `state`.
fn selections(context: &StepContext, before: &State, state: &State) -> Vec<Selection> {
    (0..state.pairs.len())
        .map(|pair| {
            let at = |state: &State| context.configuration(pair, &state.positions, &state.rigid);
            let of_pair = &before.pairs[pair];
            let had = Before {
                kept: &of_pair.kept,
                pointed: &state.pairs[pair].pointed,
                points: &state.pairs[pair].points,
            };
            let fixed = &context.fixed_on_pair[pair];
            let first = Selection::new(&at(before), None, had, fixed);
            if first.kept_nodes() == state.pairs[pair].kept {
                first
            } else {
                Selection::new(&at(before), Some(&at(state)), had, fixed)
            }
        })
        .collect()
}

#[test]
fn of_the_whole_system_under_all_loads() {
    let mut model = two_blocks([2.0, 1.0], [3, 3], Friction::frictionless());
    let mut step = step();
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "xmax", [Some(0.01), Some(0.0), None]),
    ];
    let follower = LoadKind::FollowerTraction(Vec3::new(0.01, 0.0, -0.02));
    step.loads = vec![
        model.load(
            "upper",
            "zmax",
            LoadKind::DeadTraction(Vec3::new(0.0, 0.01, -0.03)),
            LoadExtent::Whole,
        ),
        model.load("upper", "ymin", follower, LoadExtent::Whole),
        model.load(
            "upper",
            "zmin",
            LoadKind::Pressure(0.03),
            LoadExtent::Exposed,
        ),
        model.load(
            "lower",
            "zmax",
            LoadKind::Pressure(0.05),
            LoadExtent::Exposed,
        ),
        model.load("lower", "zmax", follower, LoadExtent::Exposed),
        model.load("lower", "xmin", LoadKind::Pressure(0.02), LoadExtent::Whole),
    ];
    model.steps = vec![step];
    assert_order(model);
}

#[test]
fn of_a_rigid_body_that_contact_pushes_under_loads() {
    let flat = plane([0.0; 3], [0.0, 0.0, 1.0]);
    let cases = [
        (dome(4), Friction::frictionless(), Status::Slip),
        (bumps(4, 0.02), coulomb(5.0), Status::Stick),
        (bumps(4, 0.02), coulomb(0.3), Status::Slip),
        (dome(4), coulomb(0.3), Status::Slip),
        (flat, coulomb(0.4), Status::Slip),
    ];
    for (shape, friction, status) in cases {
        let mut model = on_rigid(shape);
        model.pairs[0].friction = friction;
        let mut first = step();
        first.displacements = vec![model.hold("block", "zmax", [Some(0.0); 3])];
        let mut motion = RigidMotion {
            surface: RigidId(0),
            coordinates: [0.02, 0.01, 0.06, 0.03, -0.04, 0.2].map(Freedom::To),
            force: None,
            torque: None,
            curve: Curve::Ramp,
        };
        first.rigid_motions = vec![motion.clone()];
        first.loads = vec![
            model.load(
                "block",
                "zmin",
                LoadKind::Pressure(0.03),
                LoadExtent::Exposed,
            ),
            model.load(
                "block",
                "zmin",
                LoadKind::DeadTraction(Vec3::new(0.0, 0.01, -0.01)),
                LoadExtent::Exposed,
            ),
        ];
        // The step at whose end the system is looked at; nothing moves in it.
        let mut second = step();
        motion.coordinates = [Freedom::AsBefore; 6];
        motion.coordinates[1..].fill(Freedom::Free);
        second.rigid_motions = vec![motion];
        model.steps = vec![first, second];
        let problem = Problem::new(model).unwrap();
        let start = State::undeformed(&problem);
        let states = after_first(&problem, &start);
        let [before, state] = &states;
        let context = StepContext::new(&problem, 1, &start);
        let mut whole = Whole::new(&context, before, state);
        // Turns of the body compose from where the increment began.
        whole.imposed = context.imposed_after(before, 1.0, state.time);
        assert!(whole.layout.rigid(0).is_some());
        let found = state.pairs[0]
            .nodes
            .iter()
            .flatten()
            .map(|node| node.status);
        let found: Vec<Status> = found.filter(|found| *found != Status::Open).collect();
        assert!(found.contains(&status), "{found:?}");
        whole.assert_order_at(whole.settled());
    }
}

/// A block and a rigid body, or another block, before they touch and while they do.
#[test]
fn of_stabilised_pairs() {
    for gap in [0.3, 0.0] {
        let mut blocks = two_blocks([2.0, 1.0], [3, 3], coulomb(0.3));
        let upper = blocks.body("upper");
        let positions = blocks.bodies[upper].mesh.positions.iter_mut();
        positions.for_each(|x| x.z += gap);
        let mut held = step();
        held.displacements = vec![
            blocks.hold("lower", "zmin", [Some(0.0); 3]),
            blocks.hold("upper", "zmax", [Some(0.01), Some(0.0), Some(-0.01)]),
        ];
        held.increments = increments(0.25, 1e-3);
        blocks.steps = vec![held];
        let mut rigid = on_rigid(dome(4));
        let mut lowered = step();
        lowered.displacements = vec![rigid.hold("block", "zmax", [Some(0.0); 3])];
        lowered.rigid_motions = vec![RigidMotion {
            surface: RigidId(0),
            coordinates: [
                Freedom::To(0.02),
                Freedom::To(0.01),
                Freedom::To(0.06 - gap),
                Freedom::To(0.03),
                Freedom::Free,
                Freedom::Free,
            ],
            force: None,
            torque: Some(Vec3::new(0.0, 1e-5, -1e-5)),
            curve: Curve::Ramp,
        }];
        lowered.increments = increments(0.25, 1e-3);
        rigid.steps = vec![lowered];
        for mut model in [blocks, rigid] {
            model.pairs[0].stabilised = true;
            let run = Run::of(model);
            let start = State::undeformed(&run.problem);
            let context = StepContext::new(&run.problem, 0, &start);
            let at = run.states.len() / 2;
            let [before, state] = [&run.states[at - 1], &run.states[at]];
            let mut whole = Whole::new(&context, before, state);
            whole.imposed = context.imposed_after(before, state.time, state.time);
            assert!(whole.imposed.dashpots.iter().any(|pair| !pair.is_empty()));
            let (residual, _) = whole.assembled(&whole.unknowns());
            assert!(residual.norm() < 1e-9, "{:e}", residual.norm());
            whole.assert_order();
            if whole.layout.moves_no_body() {
                whole.assert_order_of_contact();
            }
        }
    }
}

/// States at half the first step and at its end.
fn after_first(problem: &Problem, start: &State) -> [State; 2] {
    let context = StepContext::new(problem, 0, start);
    let mut workspace = Workspace::new(problem.model.solver.backend);
    let mut state = start.clone();
    [0.5, 1.0].map(|s| {
        let increment = advance(&context, &state, s, s, &mut workspace, &mut ());
        state = increment.unwrap_or_else(|cut| panic!("{cut}")).state;
        state.clone()
    })
}

/// Asserts the order at the end of a model of one step.
fn assert_order(model: Model) {
    let run = Run::completed(model);
    let start = State::undeformed(&run.problem);
    let context = StepContext::new(&run.problem, 0, &start);
    let [.., before, last] = &run.states[..] else {
        panic!("no increment");
    };
    let whole = Whole::new(&context, before, last);
    let (residual, _) = whole.assembled(&whole.unknowns());
    assert!(residual.norm() < 1e-9);
    whole.assert_order();
    if whole.layout.moves_no_body() {
        whole.assert_order_of_contact();
    }
}
