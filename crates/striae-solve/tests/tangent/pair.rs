//! A contact pair with a frozen traction field as a function of its unknowns.
//!
//! Longer than other files, as states, derivatives and statuses are of one function.

use nalgebra::{DMatrix, DVector};
use striae_contact::{
    complementarity::{Conditions, Iteration, Prescribed},
    configuration::Configuration,
    evaluation::{Evaluation, evaluate},
    placement::Placement,
    segment::Derivatives,
    selection::Selection,
    side::Side,
    unknown::Unknown,
    unknowns::{Label, Status, Tractions},
};
use striae_mesh::Vec3;
use striae_solve::assembly::StepContext;
use striae_surface::node::SurfaceNode;
use striae_verify::{Difference, Random, derivative::directional};

/// Positions of all nodes of a model and its rigid surface.
#[derive(Clone)]
pub struct Places {
    pub positions: Vec<Vec3>,
    pub placement: Placement,
}

/// Status wanted for the nodes of a state.
#[derive(Clone, Copy, PartialEq)]
pub enum Wanted {
    /// One in three each is open, sticks and slips.
    Mixed,
    /// Nearly all slip.
    Slip,
}

/// Pressure under which nodes stick whatever their slip.
const STICKING: f64 = 20.0;

/// Tension that opens the supports of nodes where surfaces overlap by some hundredths.
const OPENING: f64 = 1.0;

/// Pressures of nodes that may slip, over the usual ones: weak nodes are opened or held by
/// what the ramp brings from others, and the first pressure under which some slip is taken.
const PRESSURES: [f64; 6] = [1.0, 3.0, 10.0, 30.0, 100.0, 0.1];

/// Projections of friction before Newton's method takes over.
const PROJECTIONS: usize = 20;
/// Corrections of friction that depends on rate and state.
const CREEPING: usize = 200;

/// A pair between two configurations, with the roles of the first.
pub struct PairFunction<'a> {
    context: &'a StepContext<'a>,
    start: Places,
    now: Places,
    counts: [usize; 2],
    elapsed: f64,
    tau_n: [Vec<[f64; 2]>; 2],
    /// Status in the iteration before, by kept node.
    pub before: Vec<Status>,
    /// Number of times that nodes have begun to slip.
    pub begun: u32,
    /// Positions that are prescribed.
    pub prescribed: Prescribed,
    pub selection: Selection,
    pub iteration: Iteration,
}

impl<'a> PairFunction<'a> {
    /// The pair on its way from `start` to `now`; roles look ahead.
    pub fn new(context: &'a StepContext<'a>, start: Places, now: Places, elapsed: f64) -> Self {
        let counts = Side::BOTH.map(|side| {
            let deformable = context.problem.pairs[0].bodies[side].is_some();
            let surface = context.pairs[0].sides[side].surface();
            surface.map_or(0, |s| if deformable { s.nodes().len() } else { 0 })
        });
        let free = Prescribed {
            components: counts.map(|count| vec![false; 3 * count]),
            ..Prescribed::default()
        };
        let selection = {
            let [from, to] = [&start, &now].map(|places| configuration(context, places));
            let kept = counts.map(|count| vec![false; count]);
            Selection::new(&from, Some(&to), &kept, &free)
        };
        let mut random = Random::new(3);
        let tau_n = counts.map(|count| {
            let components = |_| [random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)];
            (0..count).map(components).collect()
        });
        Self {
            context,
            start,
            now,
            counts,
            elapsed,
            tau_n,
            before: vec![Status::Slip; selection.kept().len()],
            begun: 0,
            prescribed: free,
            selection,
            iteration: Iteration::LATER,
        }
    }

    /// Numbers of the tangential unknowns of the kept nodes.
    pub fn tangential(&self) -> impl Iterator<Item = [usize; 2]> {
        let numbering = self.context.pairs[0].numbering();
        let kept = self.selection.kept().iter();
        kept.map(move |kept| {
            let first = numbering.traction(kept.side, kept.node) as usize;
            [first + 1, first + 2]
        })
    }

    fn len(&self) -> usize {
        self.context.pairs[0].numbering().count() as usize
    }

    fn configuration(&self, u: &DVector<f64>) -> Configuration<'_> {
        let numbering = self.context.pairs[0].numbering();
        let mut places = self.now.clone();
        for side in Side::BOTH {
            for node in SurfaceNode::all(self.counts[side]) {
                let global = self.context.problem.surface_node(0, side, node).unwrap();
                let first = numbering.position(side, node) as usize;
                places.positions[global] = u.fixed_rows::<3>(first).into();
            }
        }
        configuration(self.context, &places).lasting(self.elapsed)
    }

    fn tractions(&self, u: &DVector<f64>) -> Tractions {
        let numbering = self.context.pairs[0].numbering();
        let triple = |side: Side, node: SurfaceNode| {
            let first = numbering.traction(side, node) as usize;
            [u[first], u[first + 1], u[first + 2]]
        };
        let mut labels = self.counts.map(|count| vec![Label::default(); count]);
        for (kept, before) in self.selection.kept().iter().zip(&self.before) {
            labels[kept.side][kept.node].status = *before;
            labels[kept.side][kept.node].begun = self.begun;
        }
        Tractions {
            nodes: Side::BOTH.map(|side| {
                SurfaceNode::all(self.counts[side])
                    .map(|n| triple(side, n))
                    .collect()
            }),
            tau_n: self.tau_n.clone(),
            slipped: self.counts.map(|count| vec![false; count]),
            bedded: self.counts.map(|count| vec![0.5; count]),
            accumulated: self.counts.map(|count| vec![0.1; count]),
            worn: self.counts.map(|count| vec![0.0; count]),
            states: self.counts.map(|count| vec![0.7; count]),
            factors: None,
            labels,
        }
    }

    /// Contact of the pair.
    pub fn evaluation(&self, u: &DVector<f64>) -> Evaluation {
        evaluate(
            &self.configuration(u),
            &configuration(self.context, &self.start),
            &self.selection,
            &self.tractions(u),
            Conditions {
                friction: &self.context.plan.frictions[0],
                prescribed: &self.prescribed,
                iteration: self.iteration,
                wanted: None,
            },
            Derivatives::First,
        )
        .unwrap()
    }

    /// Residual by unknown.
    pub fn residual(&self, u: &DVector<f64>) -> DVector<f64> {
        self.sum(&self.evaluation(u))
    }

    fn sum(&self, evaluation: &Evaluation) -> DVector<f64> {
        let mut residual = DVector::zeros(self.len());
        for term in &evaluation.terms {
            for (row, value) in term.rows.iter().zip(&term.residual) {
                residual[*row as usize] += value;
            }
        }
        residual
    }

    /// Derivatives of the residual that the terms state.
    pub fn tangent(&self, u: &DVector<f64>) -> DMatrix<f64> {
        let mut tangent = DMatrix::zeros(self.len(), self.len());
        for term in &self.evaluation(u).terms {
            // A node that opposes nothing depends on nothing.
            let rows = term.tangent.chunks(term.columns.len().max(1));
            for (row, values) in term.rows.iter().zip(rows) {
                for (column, value) in term.columns.iter().zip(values) {
                    tangent[(*row as usize, *column as usize)] += value;
                }
            }
        }
        tangent
    }

    /// Unknowns away from the kinks; slip rows are satisfied, since only there is their
    /// Jacobian exact. Slip depends on friction where nodes are weak.
    pub fn state(&self, wanted: Wanted) -> DVector<f64> {
        self.found(wanted).expect("some node slips")
    }

    /// Positions with the wanted status; `None` if no node can be made to slip.
    pub fn found(&self, wanted: Wanted) -> Option<DVector<f64>> {
        let mut placed = PRESSURES.iter().map(|&pressure| {
            let mut u = self.placed(wanted, pressure);
            self.project(&mut u);
            u
        });
        let found = placed.find(|u| self.statuses(u).contains(&Status::Slip));
        self.settled(found?)
    }

    /// Positions, and tractions with pressures of nodes that may slip about `pressure`.
    fn placed(&self, wanted: Wanted, pressure: f64) -> DVector<f64> {
        let mut random = Random::new(17);
        let mut u = DVector::zeros(self.len());
        let numbering = self.context.pairs[0].numbering();
        for side in Side::BOTH {
            for node in SurfaceNode::all(self.counts[side]) {
                let global = self.context.problem.surface_node(0, side, node).unwrap();
                let first = numbering.position(side, node) as usize;
                let x = self.now.positions[global];
                u.fixed_rows_mut::<3>(first).copy_from(&x);
            }
        }
        let is_weak = |k: usize| {
            let mut ramp = self.selection.ramp().iter();
            ramp.any(|weak| weak.kept as usize == k)
        };
        let all_weak = (0..self.selection.kept().len()).all(is_weak);
        let mut strong = 0;
        for (k, kept) in self.selection.kept().iter().enumerate() {
            let first = numbering.traction(kept.side, kept.node) as usize;
            u[first] = match wanted {
                Wanted::Slip => random.uniform(0.8, 1.2),
                Wanted::Mixed => random.uniform(0.2, 0.4),
            } * pressure;
            u[first + 1] = random.uniform(-0.1, 0.1);
            u[first + 2] = random.uniform(-0.1, 0.1);
            // Friction of weak nodes without pressure would act through the ramp: others open
            // if there are any.
            let weak = is_weak(k);
            let turn = match (weak, all_weak) {
                (true, true) => k % 3,
                (true, false) => 1 + k % 2,
                (false, _) => strong % 3,
            };
            strong += usize::from(!weak);
            match turn {
                0 if wanted == Wanted::Mixed => u[first] = -OPENING,
                1 if wanted == Wanted::Mixed => u[first] = STICKING,
                _ => {}
            }
        }
        u
    }

    /// Unknowns of nodes that are pressed, with the friction at their slips by rate and state: where
    /// its rows are satisfied, their Jacobian is exact.
    pub fn crept(&self, pressure: f64) -> DVector<f64> {
        let mut u = self.placed(Wanted::Slip, pressure);
        let numbering = self.context.pairs[0].numbering();
        let kept = self.selection.kept().iter();
        let rows: Vec<usize> = kept
            .flat_map(|kept| {
                let first = numbering.traction(kept.side, kept.node) as usize;
                [first + 1, first + 2]
            })
            .collect();
        let mut off = f64::INFINITY;
        for made in 0..CREEPING {
            let residual = self.residual(&u).select_rows(&rows);
            off = residual.amax();
            if off < 1e-12 * pressure.max(1.0) {
                return u;
            }
            let slope = self.tangent(&u).select_rows(&rows).select_columns(&rows);
            let step = slope.lu().solve(&residual).expect("slip rows are regular");
            // At given slips nothing yields, so that friction can go round its solution.
            let step = step * if made < CREEPING / 4 { 1.0 } else { 0.3 };
            for (row, step) in rows.iter().zip(step.iter()) {
                u[*row] -= step;
            }
        }
        panic!("friction is off by {off:.1e}");
    }

    /// With the slip rows satisfied.
    fn settled(&self, mut u: DVector<f64>) -> Option<DVector<f64>> {
        for _ in 0..20 {
            let rows = self.slip_rows(&u);
            let off = self.residual(&u).select_rows(&rows);
            if rows.is_empty() || off.amax() < 1e-13 {
                return Some(u);
            }
            let slope = self.tangent(&u).select_rows(&rows).select_columns(&rows);
            let step = slope.lu().solve(&off)?;
            for (row, step) in rows.iter().zip(step.iter()) {
                u[*row] -= step;
            }
        }
        None
    }

    /// Repeats `z <- y` within the cap and `z <- varpi y/|y|` beyond it, which leads to the
    /// friction at given slips. A weak node whose friction holds it by what the ramp adds
    /// is made to stick far from its cap.
    fn project(&self, u: &mut DVector<f64>) {
        let numbering = self.context.pairs[0].numbering();
        for _ in 0..PROJECTIONS {
            let evaluation = self.evaluation(u);
            let residual = self.sum(&evaluation);
            for (k, kept) in self.selection.kept().iter().enumerate() {
                let status = evaluation.nodes[kept.side][kept.node].status;
                let first = numbering.traction(kept.side, kept.node) as usize;
                let [_, r_t] = self.selection.stiffness(k);
                // Slip rows state `z - varpi y/|y|`, stick rows `du`.
                let factor = match status {
                    Status::Slip => -1.0,
                    Status::Stick if u[first] != STICKING => r_t,
                    Status::Stick | Status::Open => continue,
                };
                for at in [first + 1, first + 2] {
                    u[at] += factor * residual[at];
                }
            }
        }
        for (kept, status) in self.selection.kept().iter().zip(self.statuses(u)) {
            if status == Status::Stick {
                u[numbering.traction(kept.side, kept.node) as usize] = STICKING;
            }
        }
    }

    /// Tangential rows of the slipping nodes.
    fn slip_rows(&self, u: &DVector<f64>) -> Vec<usize> {
        let numbering = self.context.pairs[0].numbering();
        let statuses = self.statuses(u);
        let kept = self.selection.kept().iter().zip(statuses);
        kept.filter(|(_, status)| *status == Status::Slip)
            .flat_map(|(kept, _)| {
                let first = numbering.traction(kept.side, kept.node) as usize;
                [first + 1, first + 2]
            })
            .collect()
    }

    /// Status of the kept nodes.
    pub fn statuses(&self, u: &DVector<f64>) -> Vec<Status> {
        let nodes = self.evaluation(u).nodes;
        let kept = self.selection.kept().iter();
        kept.map(|kept| nodes[kept.side][kept.node].status)
            .collect()
    }

    /// Asserts that the error of central differences falls with the square of the step.
    pub fn assert_order(&self, u: &DVector<f64>, name: &str) {
        let tangent = self.tangent(u);
        for seed in 0..2 {
            let direction = Random::new(seed).unit(u.len());
            let claimed = &tangent * &direction;
            let residual = |u: &DVector<f64>| self.residual(u);
            match directional(Difference::Central, residual, &claimed, u, &direction) {
                Ok(order) => assert!(order.is_some(), "{name}: no order"),
                // Points of supports open and close within larger steps.
                Err(wrong) if wrong.is_of_kinks() => {}
                Err(wrong) => panic!("{name}: {wrong}{}", self.worst(u, &tangent)),
            }
        }
    }

    /// The entries of the tangent that differ most from differences.
    fn worst(&self, u: &DVector<f64>, tangent: &DMatrix<f64>) -> String {
        let h = 1e-6;
        let mut differences = Vec::new();
        for column in 0..u.len() {
            let step = DVector::from_fn(u.len(), |at, _| if at == column { h } else { 0.0 });
            let slope = (self.residual(&(u + &step)) - self.residual(&(u - &step))) / (2.0 * h);
            for row in 0..u.len() {
                let claimed = tangent[(row, column)];
                differences.push(((slope[row] - claimed).abs(), row, column, claimed));
            }
        }
        differences.sort_by(|one, other| other.0.total_cmp(&one.0));
        let numbering = self.context.pairs[0].numbering();
        let statuses = self.statuses(u);
        let said = differences[..12]
            .iter()
            .map(|(error, row, column, claimed)| {
                let [row, column] = [row, column].map(|at| numbering.unknown(*at as u32));
                let status = match row {
                    Unknown::Traction { side, node, .. } => {
                        let k = self.selection.basis.index[side][node];
                        k.map(|k| statuses[k as usize])
                    }
                    Unknown::Position { .. } => None,
                };
                format!("{error:9.3e} of {claimed:10.3e}: {row:?} {status:?} by {column:?}\n")
            });
        said.collect()
    }
}

fn configuration<'a>(context: &'a StepContext, places: &Places) -> Configuration<'a> {
    let geometry = &context.problem.pairs[0];
    let of_side = |side: Side| -> Vec<Vec3> {
        if geometry.bodies[side].is_none() {
            return geometry.rigid_reference.clone();
        }
        let surface = context.pairs[0].sides[side].surface();
        let count = surface.map_or(0, |surface| surface.nodes().len());
        let global = |node| context.problem.surface_node(0, side, node).unwrap();
        SurfaceNode::all(count)
            .map(|n| places.positions[global(n)])
            .collect()
    };
    Configuration::new(
        &context.pairs[0],
        [of_side(Side::A), of_side(Side::B)],
        places.placement,
    )
}
