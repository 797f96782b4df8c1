//! Accelerations at the start of a step.
//!
//! `M a = f_ext - f_int + f_con` for what is free. Nodes tied to a rigid body with
//! the angular velocity `w` accelerate with it,
//!
//! ```text
//! a = c'' + w' x r + w x (w x r).
//! ```

use striae_condensed::Tangent;
use striae_mesh::{ElementId, Vec3};

use super::{Imposed, StepContext, System, Trial};
use crate::{
    layout::Layout, mass::mass_times, outcome::CutBack, rigid::fitted_velocity, state::NodalForces,
};

/// Accelerations of all nodes, and the forces that hold tied nodes, under the
/// `found` forces without inertia. `solve` solves the linear system for a correction.
///
/// # Errors
/// Returns the errors of `solve`.
#[allow(clippy::too_many_arguments)]
pub(crate) fn initial_accelerations(
    context: &StepContext,
    trial: &Trial,
    imposed: &Imposed,
    velocities: &[Vec3],
    found: &NodalForces,
    layout: &Layout,
    tangent: &mut Tangent,
    solve: impl FnOnce(&Tangent, &[f64]) -> Result<Vec<f64>, CutBack>,
) -> Result<(Vec<Vec3>, Vec<Vec3>), CutBack> {
    let mut accelerations = known(context, trial, imposed, velocities);
    let inertia = mass_times(context.problem, &accelerations);
    let forces: Vec<Vec3> = (0..trial.positions.len())
        .map(|node| found.internal[node] - found.applied[node] - found.contact[node])
        .collect();
    tangent.clear();
    let mut system = System::new(context, layout, &mut tangent.bodies, trial, imposed);
    system.forces.pushed.clone_from(&found.pushed);
    let at_nodes = context
        .problem
        .global_nodes()
        .zip(forces.iter().zip(&inertia));
    for (node, (force, inertia)) in at_nodes {
        let first = layout.position(node);
        for axis in 0..3 {
            system.residual[first + axis] = force[axis] + inertia[axis];
        }
    }
    system.masses();
    system.pass_on();
    system.condense_forces(imposed);
    system.turn_rows();
    system.hold_the_rest();
    let System { residual, ties, .. } = system;
    let correction = solve(tangent, &residual)?;
    for (node, acceleration) in context.problem.global_nodes().zip(&mut accelerations) {
        *acceleration += match ties.get(node.0).and_then(Option::as_ref) {
            Some(tie) => tie.followed_by(&correction),
            None => {
                let first = layout.position(node);
                context.vector(
                    node,
                    &Vec3::from_column_slice(&correction[first..first + 3]),
                )
            }
        };
    }
    context.problem.ties.follow(&mut accelerations);
    let inertia = mass_times(context.problem, &accelerations);
    let holding = forces.iter().zip(&inertia).map(|(f, m)| f + m);
    Ok((accelerations, holding.collect()))
}

/// Known accelerations: prescribed components, and those that rotating or driven rigid bodies
/// impose on tied nodes.
fn known(
    context: &StepContext,
    trial: &Trial,
    imposed: &Imposed,
    velocities: &[Vec3],
) -> Vec<Vec3> {
    let problem = context.problem;
    let mut accelerations = vec![Vec3::zeros(); problem.reference.len()];
    for rate in &imposed.rates {
        rate.put(&mut accelerations, rate.acceleration);
    }
    for (rigid, rates) in context.rigid_rates(0.0).iter().enumerate() {
        let pose = &trial.rigid[rigid];
        let point = problem.model.rigid_surfaces[rigid].reference + pose.displacement;
        let [_, spin] = fitted_velocity(&point, &problem.tied[rigid], &trial.positions, velocities);
        let linear = Vec3::from_fn(|axis, _| rates[axis][1]);
        let angular = Vec3::from_fn(|axis, _| rates[3 + axis][1]);
        for &node in &problem.tied[rigid] {
            let arm = trial.positions[node] - point;
            accelerations[node] = linear + angular.cross(&arm) + spin.cross(&spin.cross(&arm));
        }
    }
    problem.ties.follow(&mut accelerations);
    accelerations
}

impl System<'_> {
    /// The mass matrix.
    fn masses(&mut self) {
        let problem = self.context.problem;
        for (body, model) in problem.model.bodies.iter().enumerate() {
            for (at, corners) in model.mesh.elements().enumerate() {
                let mass = problem.masses[body].of_element(ElementId::new(at));
                if mass.is_empty() {
                    continue;
                }
                let nodes = problem.nodes(body, corners);
                let unknowns = self.unknowns(&nodes);
                let count = unknowns.len();
                let mut block = vec![0.0; count * count];
                for (at, entry) in block.iter_mut().enumerate() {
                    let (row, column) = (at / count, at % count);
                    let (b, axis) = (column / 3, column % 3);
                    let free = match self.context.turned.frame(nodes[b]) {
                        Some(frame) => frame.free()[(row % 3, axis)],
                        None if row % 3 != axis => 0.0,
                        None => f64::from(u8::from(!self.context.fixed[nodes[b].component(axis)])),
                    };
                    if free != 0.0 {
                        *entry = mass[row / 3 * nodes.len() + b] * free;
                    }
                }
                self.add_dense(&nodes, &unknowns, &vec![0.0; count], &block);
            }
        }
        for &(node, mass) in &problem.mass_points {
            self.add_point(node, &Vec3::zeros(), mass);
        }
    }

    /// Holds everything but free positions and coordinates at zero.
    fn hold_the_rest(&mut self) {
        let problem = self.context.problem;
        let mut held = vec![true; self.residual.len()];
        for node in problem.global_nodes() {
            let first = self.layout.position(node);
            for axis in 0..3 {
                let free = !self.context.fixed[node.component(axis)] && !problem.massless[node];
                // Tied positions are held when they are condensed.
                let follows = problem.ties.followed(node, axis).is_some();
                held[first + axis] = (!free || follows) && self.tie(node).is_none();
                if self.tie(node).is_some() {
                    self.residual[first + axis] = 0.0;
                }
            }
        }
        for rigid in 0..problem.tied.len() {
            if let Some(first) = self.layout.rigid(rigid) {
                held[first..first + 6].copy_from_slice(&self.context.fixed_rigid[rigid]);
                // Contact and springs alone give a body no mass.
                if !problem.has_mass(rigid) {
                    held[first..first + 6].fill(true);
                }
            }
        }
        for unknown in (0..held.len()).filter(|&unknown| held[unknown]) {
            self.hold(unknown, 0.0, 1.0);
        }
    }
}
