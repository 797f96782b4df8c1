//! The whole system of a step as a function of all unknowns.

use nalgebra::DVector;
use striae_condensed::{Growth, Partition, Tangent};
use striae_contact::{
    complementarity::Iteration, segment::Derivatives, selection::Selection, side::Side,
    slip_freedom::SlipFreedom, traction_basis::Weak, unknowns::Status,
};
use striae_model::node::GlobalNode;
use striae_solve::{
    assembly::{
        Assembled, Contact, ElementPlaces, Imposed, Setting, StepContext, Trial, assemble,
        assemble_contact,
    },
    layout::{Extent, Layout},
    state::State,
};
use striae_sparse::{LinearOperator, Structure, Supervariable};
use striae_surface::node::SurfaceNode;
use striae_verify::{Difference, Random, derivative::directional};

/// The whole system of a step as a function of all unknowns, after the converged state
/// `before`.
pub struct Whole<'a> {
    context: &'a StepContext<'a>,
    selections: Vec<Selection>,
    pub imposed: Imposed,
    pub layout: Layout,
    partition: Partition,
    before: &'a State,
    state: &'a State,
}

impl<'a> Whole<'a> {
    pub fn new(context: &'a StepContext<'a>, before: &'a State, state: &'a State) -> Self {
        let selections = selections(context, before, state);
        let layout = Layout::new(context.problem, Extent::default().with(&selections));
        let every: Vec<_> = (0..layout.offsets().len() - 1).map(Supervariable).collect();
        let structure = Structure::from_cliques(layout.offsets().to_vec(), &[&every]);
        let partition = Partition::from(&structure.unwrap());
        Self {
            selections,
            imposed: context.imposed(1.0),
            context,
            layout,
            partition: partition.grown(&Growth::from_iter([every])).unwrap(),
            before,
            state,
        }
    }

    /// Gives all kept nodes a freedom to slip; without it they have a plane.
    pub fn let_slip(&mut self, freedom: SlipFreedom) {
        for selection in &mut self.selections {
            selection.slip_freedoms = vec![freedom; selection.kept().len()];
        }
    }

    /// Lets friction of every kept node but the first follow that of the one before it.
    pub fn let_follow(&mut self) {
        for selection in &mut self.selections {
            let basis = &selection.basis;
            let follow = |k: usize| {
                let [l, k] = [k as u32 - 1, k as u32];
                let [before, own] = [l, k].map(|k| basis.kept[k as usize].side);
                let sign = if before == own { 1.0 } else { -1.0 };
                Weak {
                    kept: k,
                    coefficient: basis.flexibility[k as usize] * basis.weights[k as usize],
                    row: vec![(l, -1.0), (k, 1.0)],
                    friction_row: vec![(l, -sign), (k, 1.0)],
                }
            };
            selection.following = (1..basis.kept.len()).map(follow).collect();
        }
    }

    fn trial(&self, u: &DVector<f64>) -> Trial {
        let mut trial = self.reference();
        self.each(&mut trial, |at, value| *value = u[at]);
        for (node, x) in trial.positions.iter_mut().enumerate() {
            *x = self.context.vector(GlobalNode(node), x);
        }
        for (rigid, pose) in trial.rigid.iter_mut().enumerate() {
            if let Some(first) = self.layout.rigid(rigid) {
                let coordinates = std::array::from_fn(|at| u[first + at]);
                *pose = self.imposed.before[rigid].moved_to(&coordinates);
            }
            let problem = self.context.problem;
            let placement = pose.placement(&problem.model.rigid_surfaces[rigid].reference);
            for &node in &problem.tied[rigid] {
                trial.positions[node] = placement.point(&problem.reference[node]);
            }
        }
        for (cavity, pressure) in trial.pressures.iter_mut().enumerate() {
            *pressure = u[self.layout.cavity(cavity)];
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
            pressures: self.state.pressures.clone(),
        }
    }

    fn each(&self, trial: &mut Trial, mut visit: impl FnMut(usize, &mut f64)) {
        for (node, x) in trial.positions.iter_mut().enumerate() {
            let first = self.layout.position(GlobalNode(node));
            x.iter_mut()
                .enumerate()
                .for_each(|(axis, v)| visit(first + axis, v));
        }
        for (pair, tractions) in trial.tractions.iter_mut().enumerate() {
            for side in Side::BOTH {
                for (node, values) in tractions.nodes[side].iter_mut().enumerate() {
                    if let Some(first) = self.layout.traction(pair, side, SurfaceNode::new(node)) {
                        values
                            .iter_mut()
                            .enumerate()
                            .for_each(|(at, v)| visit(first + at, v));
                    }
                }
            }
        }
    }

    pub fn unknowns(&self) -> DVector<f64> {
        let mut u = DVector::zeros(self.layout.unknowns());
        let mut reference = self.reference();
        for (node, x) in reference.positions.iter_mut().enumerate() {
            *x = self.context.components(GlobalNode(node), x);
        }
        self.each(&mut reference, |at, value| u[at] = *value);
        for (rigid, pose) in self.state.rigid.iter().enumerate() {
            if let Some(first) = self.layout.rigid(rigid) {
                u.rows_mut(first, 6).copy_from_slice(&pose.coordinates());
            }
        }
        for (cavity, pressure) in self.state.pressures.iter().enumerate() {
            u[self.layout.cavity(cavity)] = *pressure;
        }
        u
    }

    pub fn assert_order(&self) {
        self.assert_order_at(self.unknowns());
    }

    pub fn assert_order_at(&self, u: DVector<f64>) {
        let (assembled, tangent) = self.evaluated(&u);
        self.assert_rows_alone(&u, &assembled, &tangent);
        for seed in 0..2 {
            let direction = Random::new(seed).unit(u.len());
            let mut claimed = DVector::zeros(u.len());
            tangent.multiply(direction.as_slice(), claimed.as_mut_slice());
            let order = directional(
                Difference::Central,
                |u| self.assembled(u).0,
                &claimed,
                &u,
                &direction,
            );
            if let Err(wrong) = order
                && !wrong.is_of_kinks()
            {
                panic!("{wrong}");
            }
        }
    }

    /// Without derivatives rows and results are the same to the last bit, and the tangent stays
    /// unchanged.
    fn assert_rows_alone(&self, u: &DVector<f64>, whole: &Assembled, tangent: &Tangent) {
        let mut kept = tangent.clone();
        let alone = self.filled(u, Derivatives::None, &mut kept);
        assert_eq!(alone.residual, whole.residual);
        assert_eq!(alone.norms, whole.norms);
        assert_eq!(alone.forces, whole.forces);
        for (alone, whole) in alone.contacts.iter().zip(&whole.contacts) {
            assert_eq!(alone.nodes, whole.nodes);
            assert_eq!(alone.facets, whole.facets);
            assert_eq!(alone.carried, whole.carried);
            assert_eq!(alone.dissipated, whole.dissipated);
        }
        assert_eq!(kept.bodies.values(), tangent.bodies.values());
        assert_eq!(kept.contact, tangent.contact);
    }

    /// Asserts the order with everything but contact linearised at `u`.
    pub fn assert_order_of_contact(&self) {
        let u = self.unknowns();
        let (assembled, tangent) = self.evaluated(&u);
        let setting = self.setting();
        let direction = Random::new(2).unit(u.len());
        let mut claimed = DVector::zeros(u.len());
        tangent.multiply(direction.as_slice(), claimed.as_mut_slice());
        let contact = |v: &DVector<f64>| {
            let (trial, change) = (self.trial(v), v - &u);
            let mut tangent = tangent.clone();
            let found = assemble_contact(
                &setting,
                &assembled.background,
                (&trial, change.as_slice()),
                Iteration::LATER,
                &self.layout,
                (&self.partition, &mut tangent),
            );
            let found = found.expect("the state can be evaluated");
            DVector::from_vec(found.expect("the pattern is full").residual)
        };
        let here = contact(&u);
        let difference = here - DVector::from_vec(assembled.residual.clone());
        assert!(difference.amax() <= 1e-13, "{:e}", difference.amax());
        let order = directional(Difference::Central, contact, &claimed, &u, &direction);
        if let Err(wrong) = order
            && !wrong.is_of_kinks()
        {
            panic!("{wrong}");
        }
    }

    /// The unknowns with rows of slip satisfied, since only there is their Jacobian exact: an
    /// increment in which rigid points turn up chooses its field within itself, which is not
    /// found again here. The rows state `z - varpi y/|y|`, whose root attracts.
    pub fn settled(&self) -> DVector<f64> {
        let mut u = self.unknowns();
        for _ in 0..200 {
            let (assembled, _) = self.evaluated(&u);
            let nodes = Side::BOTH.into_iter().zip(&assembled.contacts[0].nodes);
            let slipping = nodes.flat_map(|(side, nodes)| {
                let slipping = (0..nodes.len()).filter(|&n| nodes[n].status == Status::Slip);
                slipping
                    .filter_map(move |node| self.layout.traction(0, side, SurfaceNode::new(node)))
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

    pub fn assembled(&self, u: &DVector<f64>) -> (DVector<f64>, Tangent) {
        let (assembled, tangent) = self.evaluated(u);
        (DVector::from_vec(assembled.residual), tangent)
    }

    fn evaluated(&self, u: &DVector<f64>) -> (Assembled, Tangent) {
        let mut tangent = Tangent::zero(self.partition.structure());
        let assembled = self.filled(u, Derivatives::First, &mut tangent);
        (assembled, tangent)
    }

    fn filled(
        &self,
        u: &DVector<f64>,
        derivatives: Derivatives,
        tangent: &mut Tangent,
    ) -> Assembled {
        let contact = Contact::Evaluated(Iteration::LATER);
        let trial = self.trial(u);
        let structure = self.partition.structure();
        let places = ElementPlaces::new(self.context.problem, &self.layout, structure);
        let mut partition = self.partition.clone();
        let parts = (&mut partition, &places, tangent);
        let (setting, layout) = (self.setting(), &self.layout);
        match assemble(&setting, &trial, contact, derivatives, layout, parts) {
            Ok(assembled) => assembled,
            Err(reason) => panic!("{reason}"),
        }
    }
}

/// The traction fields of the increment from `before` to `state`.
fn selections(context: &StepContext, before: &State, state: &State) -> Vec<Selection> {
    (0..state.pairs.len())
        .map(|pair| {
            let at = |state: &State| context.configuration(pair, &state.positions, &state.rigid);
            let had = &before.pairs[pair].kept;
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
