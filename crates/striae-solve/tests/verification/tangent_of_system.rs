//! Tangent of the whole system under all kinds of loads: the error of central
//! differences falls with the square of the step.

use crate::{
    scene::{Places, Run, step},
    tangent::two_blocks,
};
use nalgebra::DVector;
use striae_contact::{complementarity::Iteration, selection::Selection};
use striae_law::friction::Friction;
use striae_linalg::{SparseMatrix, Structure, Supervariable};
use striae_mesh::Vec3;
use striae_solve::{
    assembly::{Fault, Imposed, StepContext, Trial, assemble},
    layout::{Extent, Layout},
    model::{LoadExtent, LoadKind},
    state::State,
};
use striae_verify::{Difference, Random, derivative::directional};

/// The whole system of a step as a function of all unknowns.
struct Whole<'a> {
    context: &'a StepContext<'a>,
    selections: Vec<Selection>,
    imposed: Imposed,
    layout: Layout,
    structure: Structure,
    state: &'a State,
}

impl<'a> Whole<'a> {
    fn new(context: &'a StepContext<'a>, state: &'a State) -> Self {
        let layout = Layout::new(context.problem, Extent::default().with(&state.pairs));
        let every: Vec<_> = (0..layout.offsets().len() - 1).map(Supervariable).collect();
        let structure = Structure::from_cliques(layout.offsets().to_vec(), &[&every])
            .and_then(|structure| structure.grown(&[&every]))
            .unwrap();
        let selections = state
            .pairs
            .iter()
            .map(|pair| pair.selection.clone().unwrap());
        Self {
            selections: selections.collect(),
            imposed: context.imposed(1.0),
            context,
            layout,
            structure,
            state,
        }
    }

    fn trial(&self, u: &DVector<f64>) -> Trial {
        let mut trial = self.reference();
        self.each(&mut trial, |at, value| *value = u[at]);
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
            for (patch, values) in tractions.balance.iter_mut().enumerate() {
                let first = self.layout.balance(pair, patch);
                values
                    .iter_mut()
                    .enumerate()
                    .for_each(|(at, v)| visit(first + at, v));
            }
        }
    }

    fn assembled(&self, u: &DVector<f64>) -> (DVector<f64>, SparseMatrix) {
        let mut matrix = SparseMatrix::zero(&self.structure);
        let assembled = assemble(
            self.context,
            &self.selections,
            &self.trial(u),
            &self.imposed,
            Iteration::Later,
            &self.layout,
            &mut matrix,
        );
        match assembled {
            Ok(assembled) => (DVector::from_vec(assembled.residual), matrix),
            Err(Fault::CutBack(reason)) => panic!("{reason}"),
            Err(Fault::Pattern(_)) => panic!("the pattern is full"),
        }
    }
}

#[test]
fn of_the_whole_system_under_all_loads() {
    let mut model = two_blocks(Friction::frictionless());
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
    let run = Run::completed(model);
    let start = State::undeformed(&run.problem);
    let context = StepContext::new(&run.problem, 0, &start);
    let whole = Whole::new(&context, run.last());
    let mut u = DVector::zeros(whole.layout.unknowns());
    whole.each(&mut whole.reference(), |at, value| u[at] = *value);
    let (residual, matrix) = whole.assembled(&u);
    assert!(residual.norm() < 1e-9);
    for seed in 0..2 {
        let direction = Random::new(seed).unit(u.len());
        let mut claimed = DVector::zeros(u.len());
        matrix.multiply(direction.as_slice(), claimed.as_mut_slice());
        let order = directional(
            Difference::Central,
            |u| whole.assembled(u).0,
            &claimed,
            &u,
            &direction,
        );
        if let Err(wrong) = order {
            panic!("{wrong}");
        }
    }
}
