//! The state that a step starts from.

use striae_mesh::Vec3;

use crate::{
    assembly::StepContext,
    dynamics::{scheme, wrenches},
    mass::kinetic_energy,
    newton::{Workspace, assembled_at_start},
    outcome::CutBack,
    problem::Problem,
    rigid::fitted_velocity,
    spring::add_dashpots,
    state::State,
};
use striae_model::{Mover, node::GlobalNode};

/// The state a step starts from: velocities as it states them, and the accelerations from `M a =
/// f_ext - f_int + f_con`; at rest if the step has no inertia. Work of sudden changes of velocity
/// is external, and actuation that changes suddenly does work at the present positions.
///
/// # Errors
/// When the mass is singular, as for a body without density.
pub fn begin(
    problem: &Problem,
    index: usize,
    state: &State,
    workspace: &mut Workspace,
) -> Result<State, CutBack> {
    let mut begun = state.clone();
    let context = StepContext::new(problem, index, state);
    let imposed = context.imposed(0.0);
    let nodes = state.positions.len();
    let (mut velocities, mut accelerations) = (vec![Vec3::zeros(); nodes], Vec::new());
    if scheme(problem, index).is_some() {
        velocities.clone_from(&state.velocities);
        for start in &problem.model.steps[index].velocities {
            let nodes: Vec<GlobalNode> = match start.body {
                Mover::Deformable(body) => problem.nodes_of(body.0).collect(),
                Mover::Rigid(rigid) => problem.tied[rigid.0].clone(),
            };
            for node in nodes {
                let arm = state.positions[node] - start.about;
                velocities[node] = start.velocity + start.spin.cross(&arm);
            }
        }
        follow_bodies(&context, &mut velocities);
        for rate in &imposed.rates {
            rate.put(&mut velocities, rate.velocity);
        }
        problem.ties.follow(&mut velocities);
        let assembled = assembled_at_start(&context, state, workspace)?;
        let mut forces = assembled.forces;
        let on = (&mut forces.tensions[..], &mut forces.internal[..]);
        add_dashpots(&problem.links, &state.positions, &velocities, on);
        let holding;
        (accelerations, holding) =
            workspace.accelerations(&context, state, &imposed, &velocities, &forces)?;
        for nodes in &problem.tied {
            nodes
                .iter()
                .for_each(|&node| forces.reaction[node] = holding[node]);
        }
        begun.forces.rigid = wrenches(problem, &state.positions, &state.rigid, &forces.reaction);
        for (whole, pushed) in begun.forces.rigid.iter_mut().zip(&forces.pushed) {
            whole.force += pushed.force;
            whole.torque += pushed.torque;
        }
        begun.forces.pushed = forces.pushed;
        begun.forces.reaction = forces.reaction;
        begun.forces.applied = forces.applied;
        if !problem.links.is_empty() {
            // Springs may be stretched at rest, and velocities that begin here drive dashpots.
            begun.forces.internal = forces.internal.clone();
            begun.forces.tensions = forces.tensions;
        }
        if imposed.actuations != state.actuations {
            begun.forces.internal = forces.internal;
            let stored = assembled.bodies.strain;
            begun.energies.actuation += stored - state.energies.strain;
            begun.energies.strain = stored;
            begun.actuations = imposed.actuations;
        }
    } else {
        accelerations.resize(nodes, Vec3::zeros());
    }
    let kinetic = kinetic_energy(problem, &velocities);
    begun.energies.external += kinetic - state.energies.kinetic;
    begun.energies.kinetic = kinetic;
    begun.velocities = velocities;
    begun.accelerations = accelerations;
    Ok(begun)
}

/// Gives tied nodes the velocities of their bodies: those that fit the nodes best,
/// with the prescribed components of the bodies.
fn follow_bodies(context: &StepContext, velocities: &mut [Vec3]) {
    let (problem, state) = (context.problem, context.start);
    for (rigid, rates) in context.rigid_rates(0.0).iter().enumerate() {
        let pose = &state.rigid[rigid];
        let point = problem.model.rigid_surfaces[rigid].reference + pose.displacement;
        let [mut velocity, mut spin] =
            fitted_velocity(&point, &problem.tied[rigid], &state.positions, velocities);
        for axis in 0..3 {
            if context.fixed_rigid[rigid][axis] {
                velocity[axis] = rates[axis][0];
            }
            if context.fixed_rigid[rigid][3 + axis] {
                spin[axis] = rates[3 + axis][0];
            }
        }
        for &node in &problem.tied[rigid] {
            velocities[node] = velocity + spin.cross(&(state.positions[node] - point));
        }
    }
}
