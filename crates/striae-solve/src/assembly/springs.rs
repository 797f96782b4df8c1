//! Springs and their dashpots in the system, see [`crate::spring`].

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use super::{Imposed, OfBodies, System, Trial};
use crate::{
    outcome::CutBack,
    spring::{Length, Link},
    state::State,
};
use striae_model::node::GlobalNode;

/// Origin of the rates of elongation in an increment.
enum Rates<'a> {
    /// Nothing moves.
    AtRest,
    /// Mean rates since positions a time ago.
    Mean(&'a [Vec3], f64),
    /// Velocities of all nodes, and their derivative by the positions of free ones.
    Integrated(Vec<Vec3>, f64),
}

/// Tension of a link with its derivatives by the positions of both ends.
struct Tension {
    value: f64,
    slopes: [Vec3; 2],
}

impl System<'_> {
    /// Adds all links and their energies.
    pub(super) fn springs(
        &mut self,
        trial: &Trial,
        state: &State,
        imposed: &Imposed,
        bodies: &mut OfBodies,
    ) -> Result<(), CutBack> {
        let problem = self.context.problem;
        if problem.links.is_empty() {
            return Ok(());
        }
        let rates = self.rates(trial, state, imposed);
        for link in &problem.links {
            let length = link.length(&trial.positions);
            let length = length.ok_or_else(|| CutBack::Spring {
                spring: problem.model.springs[link.spring].name.clone(),
            })?;
            let tension = self.tension(link, &length, &rates);
            bodies.strain += link.stored(length.value);
            if let (Some(before), true) = (link.length(&state.positions), imposed.elapsed > 0.0) {
                let way = length.value - before.value;
                bodies.dissipated += link.damping * way * way / imposed.elapsed;
            }
            self.add_link(link, &length, &tension);
        }
        Ok(())
    }

    fn rates<'s>(&self, trial: &Trial, state: &'s State, imposed: &Imposed) -> Rates<'s> {
        let problem = self.context.problem;
        let is_damped = problem.links.iter().any(|link| link.damping > 0.0);
        match &imposed.motion {
            _ if !is_damped || imposed.elapsed.is_infinite() => Rates::AtRest,
            None => Rates::Mean(&state.positions, imposed.elapsed),
            Some(motion) => {
                let (mut velocities, _) = motion.at_end(&trial.positions, &imposed.rates);
                problem.ties.follow(&mut velocities);
                Rates::Integrated(velocities, motion.slope())
            }
        }
    }

    fn tension(&self, link: &Link, length: &Length, rates: &Rates) -> Tension {
        let g = length.gradient;
        let (stiffness, damping) = (link.stiffness, link.damping);
        match rates {
            Rates::AtRest => Tension {
                value: link.tension(length.value, 0.0),
                slopes: [g * stiffness, -g * stiffness],
            },
            Rates::Mean(positions, elapsed) => {
                let before = link.length(positions);
                let before = before.map_or(length.value, |before| before.value);
                let whole = stiffness + damping / elapsed;
                Tension {
                    value: link.tension(length.value, (length.value - before) / elapsed),
                    slopes: [g * whole, -g * whole],
                }
            }
            Rates::Integrated(velocities, slope) => {
                let turned = length.curvature * link.relative(velocities) * damping;
                let of_velocity = |node: Option<GlobalNode>| {
                    let free = node.map(|node| self.context.free(node) * g);
                    free.unwrap_or_else(Vec3::zeros) * (damping * slope)
                };
                let common = g * stiffness + turned;
                Tension {
                    value: link.tension(length.value, link.rate(length, velocities)),
                    slopes: [
                        common + of_velocity(Some(link.a)),
                        -common - of_velocity(link.second()),
                    ],
                }
            }
        }
    }

    fn add_link(&mut self, link: &Link, length: &Length, tension: &Tension) {
        let share = self.inertia.share_of_end;
        let force = length.gradient * tension.value;
        self.forces.tensions.push(tension.value);
        let nodes: Vec<GlobalNode> = std::iter::once(link.a).chain(link.second()).collect();
        let signs = [1.0, -1.0];
        let count = 3 * nodes.len();
        let mut forces = Vec::with_capacity(count);
        for (node, sign) in nodes.iter().zip(signs) {
            self.forces.internal[*node] += force * sign;
            forces.extend((force * (sign * share)).iter());
        }
        self.square_of_forces += nodes.len() as f64 * (force * share).norm_squared();
        let mut tangent = vec![0.0; count * count];
        for (a, row_sign) in signs[..nodes.len()].iter().enumerate() {
            for (b, column_sign) in signs[..nodes.len()].iter().enumerate() {
                let turning: Matrix3<f64> = length.curvature * (tension.value * column_sign);
                let block = length.gradient * tension.slopes[b].transpose() + turning;
                for (at, entry) in (0..9).map(|at| ((at / 3, at % 3), block[(at / 3, at % 3)])) {
                    let (row, column) = (3 * a + at.0, 3 * b + at.1);
                    tangent[row * count + column] = entry * row_sign * share;
                }
            }
        }
        let unknowns = self.unknowns(&nodes);
        self.add_dense(&nodes, &unknowns, &forces, &tangent);
    }
}
