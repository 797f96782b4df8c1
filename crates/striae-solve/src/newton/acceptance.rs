//! From a converged trial to the next state: tractions, velocities, energies.
//!
//! With the displacements `d` of an increment, the forces at its ends 0 and 1
//! and the weight `a` of the start (`a_f` of the time integration, 1/2 in
//! quasi-static steps),
//!
//! ```text
//! external  += d . (a f_ext,0 + (1 - a) f_ext,1) + work of reactions and of moving surfaces
//!            + work of the forces and torques on rigid bodies, du . F + dt . M
//! friction  += sum A (-tau_1 . du) over the nodes at which friction is collocated
//! numerical += d . (a f_int,0 + (1 - a) f_int,1) - change of strain energy
//!            + d . M a_alpha - change of kinetic energy
//!            - d . f_con - friction
//!            + du . F + dt . M - d . h of the forces h at tied nodes
//! ```
//!
//! so that external work equals kinetic, strain, friction and numerical energy up
//! to the residual that Newton's method leaves. `f_con` are the contact forces
//! that balance the others: those at the end with inertia, else the mean. No
//! node can dissipate less than nothing, as the law holds there at the end.

use striae_contact::{
    evaluation::Evaluation,
    field::FacetForces,
    selection::{Role, Selection},
};
use striae_mesh::{FacetId, Vec3};

use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    dynamics::kinetic_energy,
    problem::Problem,
    state::{Energies, PairState, State},
};

/// The state that a converged increment leads to.
pub(super) fn accepted(
    context: &StepContext,
    state: &State,
    time: f64,
    trial: Trial,
    imposed: Imposed,
    selections: Vec<Selection>,
    assembled: Assembled,
) -> State {
    let (velocities, accelerations) = match &imposed.motion {
        Some(motion) => motion.at_end(&trial.positions, &imposed),
        None => (state.velocities.clone(), state.accelerations.clone()),
    };
    let dissipated: Vec<f64> = selections
        .iter()
        .zip(&assembled.contacts)
        .map(|(selection, evaluation)| dissipation(selection, evaluation))
        .collect();
    let kinetic = kinetic_energy(context.problem, &velocities);
    let work = Work::new(context, state, &trial, &imposed, &assembled);
    let energies = work.energies(state, assembled.strain, kinetic, dissipated.iter().sum());
    let pairs = trial
        .tractions
        .into_iter()
        .zip(selections)
        .zip(assembled.contacts)
        .zip(&state.pairs)
        .zip(dissipated)
        .map(
            |((((tractions, selection), evaluation), before), friction)| PairState {
                dissipated: before.dissipated + friction,
                kinematic: selection.kinematic(),
                selection: Some(selection),
                tractions,
                nodes: evaluation.nodes,
                facets: evaluation.facets,
            },
        )
        .collect();
    State {
        time,
        positions: trial.positions,
        velocities,
        accelerations,
        rigid: trial.rigid,
        pairs,
        forces: assembled.forces,
        energies,
    }
}

/// Frictional work of an increment from the kinematic nodes, each of whose
/// contributions `-tau . du` is not negative, scaled from the pressure they
/// carry to the whole normal force.
fn dissipation(selection: &Selection, evaluation: &Evaluation) -> f64 {
    let mut work = 0.0;
    let mut carried = 0.0;
    let mut whole = 0.0;
    let sides = evaluation
        .facets
        .iter()
        .filter(|side| !side.is_empty())
        .count();
    for side in 0..2 {
        let areas = &evaluation.nodal_areas[side];
        whole += evaluation.facets[side]
            .iter()
            .map(|(_, f)| f.pressure)
            .sum::<f64>();
        for (node, role) in selection.roles[side].iter().enumerate() {
            if matches!(role, Role::Kinematic(_)) {
                let result = &evaluation.nodes[side][node];
                work -= areas[node] * result.tau.dot(&result.slip);
                carried += areas[node] * result.pressure;
            }
        }
    }
    if carried > 0.0 {
        work * whole / (carried * sides as f64)
    } else {
        0.0
    }
}

/// Work of the forces of an increment on its displacements.
#[derive(Default)]
struct Work {
    external: f64,
    /// Of internal and inertia forces.
    taken_up: f64,
    /// Minus that of contact forces on all sides.
    contact: f64,
    /// Of the forces that hold tied nodes.
    ties: f64,
    /// Of the forces and torques on the bodies they are tied to.
    bodies: f64,
}

impl Work {
    fn new(
        context: &StepContext,
        state: &State,
        trial: &Trial,
        imposed: &Imposed,
        assembled: &Assembled,
    ) -> Self {
        let problem = context.problem;
        let scheme = imposed.motion.as_ref().map(|motion| *motion.scheme());
        // Weights of the start in loads and internal forces, and in reactions and contact.
        let [start, holding] = scheme.map_or([0.5, 0.5], |scheme| [scheme.alpha_f, 0.0]);
        let mean = |weight: f64, a: Vec3, b: Vec3| a * weight + b * (1.0 - weight);
        let (before, after) = (&state.forces, &assembled.forces);
        let mut work = Self::default();
        for node in 0..problem.reference.len() {
            let d = trial.positions[node] - state.positions[node];
            let found = before.internal[node] - before.applied[node] - before.contact[node];
            let held = Vec3::from_fn(|axis, _| {
                let fixed = context.fixed[3 * node + axis];
                if fixed {
                    after.reaction[node][axis]
                } else {
                    0.0
                }
            });
            work.external += d.dot(&mean(start, before.applied[node], after.applied[node]));
            if problem.tie_of[node].is_some() {
                work.ties += d.dot(&mean(start, before.internal[node], after.internal[node]));
                work.ties -= d.dot(&mean(start, before.applied[node], after.applied[node]));
                work.ties -= d.dot(&mean(holding, before.contact[node], after.contact[node]));
                work.ties += d.dot(&after.inertia[node]);
            } else {
                work.external += d.dot(&mean(holding, found, held));
            }
            work.taken_up += d.dot(&mean(start, before.internal[node], after.internal[node]));
            work.taken_up += d.dot(&after.inertia[node]);
            work.contact -= d.dot(&mean(holding, before.contact[node], after.contact[node]));
        }
        for (pair, geometry) in problem.pairs.iter().enumerate() {
            if let Some(rigid) = geometry.rigid {
                let moved = |facets: &[(FacetId, FacetForces)], end: End| {
                    work_of_motion(problem, [pair, rigid], facets, (state, trial), end)
                };
                let of_start = moved(&state.pairs[pair].facets[0], End::Start);
                let of_end = moved(&assembled.contacts[pair].facets[0], End::End);
                let moved = of_start * holding + of_end * (1.0 - holding);
                work.external += moved;
                work.contact += moved;
            }
        }
        for (rigid, pose) in trial.rigid.iter().enumerate() {
            let (found, reached) = (before.rigid[rigid], after.rigid[rigid]);
            let way = pose.displacement - state.rigid[rigid].displacement;
            let turn = pose.turned - state.rigid[rigid].turned;
            work.bodies += way.dot(&mean(start, found.force, reached.force));
            work.bodies += turn.dot(&mean(start, found.torque, reached.torque));
        }
        work
    }

    fn energies(&self, state: &State, strain: f64, kinetic: f64, friction: f64) -> Energies {
        let before = &state.energies;
        let stored = strain - before.strain + kinetic - before.kinetic;
        Energies {
            kinetic,
            strain,
            external: before.external + self.external + self.bodies,
            friction: before.friction + friction,
            numerical: before.numerical + self.taken_up - self.ties + self.bodies - stored
                + self.contact
                - friction,
        }
    }
}

/// Which end of an increment forces belong to.
#[derive(Clone, Copy, PartialEq, Eq)]
enum End {
    Start,
    End,
}

/// Work of the contact forces of a pair on the motion of its rigid side, positive
/// where that pushes.
fn work_of_motion(
    problem: &Problem,
    [pair, rigid]: [usize; 2],
    facets: &[(FacetId, FacetForces)],
    (state, trial): (&State, &Trial),
    end: End,
) -> f64 {
    let reference = &problem.model.rigid_surfaces[rigid].reference;
    let placements =
        [&state.rigid[rigid], &trial.rigid[rigid]].map(|pose| pose.placement(reference));
    let (positions, present) = match end {
        End::Start => (&state.positions, &placements[0]),
        End::End => (&trial.positions, &placements[1]),
    };
    let Some(surface) = problem.pairs[pair].contact.sides[0].surface() else {
        return 0.0;
    };
    let mut work = 0.0;
    for (facet, forces) in facets {
        let corners = surface.facets()[facet.index()];
        for (corner, force) in corners.iter().zip(&forces.force) {
            if let Some(node) = problem.surface_node(pair, 0, *corner) {
                let material = present.back(&positions[node]);
                let [from, to] = placements.map(|placement| placement.point(&material));
                work += force.dot(&(to - from));
            }
        }
    }
    work
}
