//! Norms of the residual, field by field.

use striae_contact::evaluation::Evaluation;
use striae_mesh::Vec3;

use super::{System, Trial};
use crate::{
    norms::{Norms, Scales},
    problem::Problem,
};

impl System<'_> {
    /// Norms of all fields; notes the reactions. Collective.
    pub(super) fn norms(&mut self, trial: &Trial, contacts: &[Evaluation]) -> Norms {
        let problem = self.context.problem;
        let share = &problem.share;
        let mut free = match share.owns_bodies() {
            true => self.free_squares(),
            false => 0.0,
        };
        for node in problem.global_nodes() {
            if self.tie(node).is_some() {
                continue;
            }
            let first = self.layout.position(node);
            self.forces.reaction[node] = Vec3::from_column_slice(&self.residual[first..first + 3]);
            let rows = self.context.components(node, &self.forces.reaction[node]);
            for axis in (0..3).filter(|_| share.owns(node)) {
                if !self.context.fixed[node.component(axis)] {
                    free += rows[axis].powi(2);
                }
            }
        }
        let own_nodes = problem.own_nodes();
        let applied: f64 = own_nodes
            .map(|node| self.forces.applied[node].norm_squared())
            .sum();
        let [free, applied, squares] = share.sums([free, applied, self.square_of_forces]);
        let unavoidable = round_off(problem, &trial.positions, self.inertia.stiffness);
        // Where there are next to no forces, norms are those over what is just negligible.
        let smallest = unavoidable / problem.model.solver.tolerance;
        let force = squares.sqrt().max(applied.sqrt()).max(smallest);
        let mut norms = Norms {
            force: free.sqrt() / force,
            round_off: unavoidable / force,
            volume: self.volumes,
            ..Norms::default()
        };
        for (pair, evaluation) in contacts.iter().enumerate() {
            let scales = Scales {
                force,
                traction: self.context.pairs[pair].stress_scale(&evaluation.nodes),
            };
            let numbering = self.context.pairs[pair].numbering();
            for term in &evaluation.terms {
                for (row, field) in term.rows.iter().zip(&term.fields) {
                    let global = self.layout.global(problem, pair, numbering.unknown(*row));
                    if let Some((unknown, _)) = global {
                        norms.include(*field, self.residual[unknown], &scales);
                    }
                }
            }
        }
        norms
    }
}

/// Residual force that round-off of the positions leaves in bodies without stress: an
/// element gives `eps (k + m da_alpha/dx) |x|` with its mass `m` and the mean `k` of the
/// diagonal of its stiffness, `(lambda + 2 G)/8 sum_ga w |G_a|^2`, which is that of its
/// smallest height where it is flat; a spring gives `eps k |x|`. Collective.
fn round_off(problem: &Problem, positions: &[Vec3], inertia: f64) -> f64 {
    let extent = positions.iter().map(|x| x.norm()).fold(0.0, f64::max);
    let extent = problem.share.largest(extent);
    let bodies = problem.compositions.iter();
    let sum: f64 = bodies
        .map(|composition| {
            let elements = composition.resistances().iter();
            let squares = elements.map(|element| {
                let stiffness = element.stiffness + element.mass * inertia;
                (stiffness * extent).powi(2)
            });
            squares.sum::<f64>()
        })
        .sum();
    let points = problem.mass_points.iter();
    let points: f64 = points
        .map(|(_, mass)| (mass * inertia * extent).powi(2))
        .sum();
    let links = problem.links.iter();
    let links: f64 = links.map(|link| (link.stiffness * extent).powi(2)).sum();
    10.0 * f64::EPSILON * (problem.share.sum(sum) + points + links).sqrt()
}
