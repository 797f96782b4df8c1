//! Balance of the energy of an increment.
//!
//! With the displacements `d` of an increment, the forces at its ends 0 and 1 and
//! the weight `a` of the start (`a_f` of the time integration, 1/2 in quasi-static
//! steps),
//!
//! ```text
//! external  += d . (a f_ext,0 + (1 - a) f_ext,1) + work of reactions and of moving surfaces
//!            + work of the forces and torques on rigid bodies, du . F + dt . M + m
//! actuation += dG . (a dW/dG,0 + (1 - a) dW/dG,1), the rates at given positions
//! inelastic += what viscous and plastic flow dissipate by the laws of the materials
//! friction  += sum A (-tau_1 . du) over the nodes at which friction is collocated
//! stabilisation += k |relative displacement|^2 over the dashpots
//! contact   += -d . (f_con + f_sta) on all sides - friction - stabilisation
//! numerical += d . (a f_int,0 + (1 - a) f_int,1) + actuation - change of strain energy
//!            - inelastic
//!            + dt v . M e + d' . M a_alpha
//!            - sum (1 - a) (dr - dt x r_1) . h_1 + a (dr - dt x r_0) . h_0 at tied nodes
//!            - sum (dr - dt x r) . f_con over the nodes that push a moving body + m
//! m          = (1/2 - a_f) d . ((M a_0 + f_int,0 - f_ext,0) - (M a_1 + f_int,1 - f_ext,1))
//! ```
//!
//! Reactions of the equations belong to the time `t_1 - a_f dt`. What moves a mass does work by the
//! force in the middle of the increment, without which an oscillating support would lose or gain
//! energy in every period, to first order: `m` over prescribed components, and the like over
//! prescribed coordinates of rigid bodies, is the difference.
//!
//! `f_con` are the contact forces that balance the others: those at the end with inertia, else the
//! mean. With inertia, `(1/2 - a_f) d . (f_con,1 - f_con,0)` goes from `numerical` to `contact`: by
//! so much the shifted accelerations see jumps of contact too late or too early, so that else
//! `numerical` would fall in each impact. The second line of `numerical` is what the work of inertia
//! forces exceeds the change of kinetic energy by, written by the mean `v` of the velocities and
//! the jumps that time integration makes,
//!
//! ```text
//! e  = a_alpha - (v_1 - v_0)/dt = (1/2 - a_f) (a_1 - a_0)
//! d' = d - dt v                 = (beta - gamma/2) dt^2 (a_1 - a_0)
//! ```
//!
//! the right hand sides by Chung & Hulbert's formulas, see [`crate::dynamics`]; for
//! prescribed components, the left ones; what follows in ties has its own from these. The last
//! lines are how far the chords `dr` of the arms `r` are from arcs. Neither looks at the
//! assembled inertia forces or at the residual. `G` stands for stress-free strains and tensions, see
//! [`striae_model::actuation`]. So external work and that of actuation equal all other energy up to
//! the residual that Newton's method leaves only if mass, inertia, contact and tie forces are
//! those of the equations that were solved. No node can dissipate less than nothing, as the law
//! of friction holds there at the end.
//!
//! Longer than other files, as it is the one account of all energies of an increment.

mod actuated;
mod gained;

use std::ops::{Add, Mul};

use striae_contact::{field::FacetForces, side::Side};
use striae_mesh::{FacetId, Vec3};

use crate::{
    assembly::{Assembled, Imposed, StepContext, Trial},
    dynamics::{Scheme, wrenches},
    mass::{kinetic_energy, mass_times, product},
    problem::Problem,
    rigid::Pose,
    stabilisation::Dashpot,
    state::{Energies, State},
};
use striae_model::node::GlobalNode;

/// The ends of a converged increment.
pub(super) struct Ends<'a> {
    pub(super) context: &'a StepContext<'a>,
    /// The start.
    pub(super) state: &'a State,
    pub(super) trial: &'a Trial,
    pub(super) imposed: &'a Imposed,
    pub(super) assembled: &'a Assembled,
    /// Velocities at the end.
    pub(super) velocities: &'a [Vec3],
    /// Accelerations at the end.
    pub(super) accelerations: &'a [Vec3],
}

impl Ends<'_> {
    /// Energies at the end; `friction` is dissipated in the increment. Collective.
    pub(super) fn energies(&self, friction: f64) -> Energies {
        let (resisted, stabilisation) = (self.resisted(|_| true), self.stabilisation());
        let resisted = resisted - self.work_of_stabilisation();
        let before = &self.state.energies;
        let (strain, inelastic) = (
            self.assembled.bodies.strain,
            self.assembled.bodies.dissipated,
        );
        // What jumps of contact forces take is counted as contact, not as time integration.
        let (held, shifted) = (
            self.held_weight(),
            0.5 - self.scheme().map_or(0.0, |s| s.alpha_f),
        );
        let (fully, contact) = (self.contact(held), self.contact(shifted));
        let stored = strain - before.strain;
        let actuated = self.actuated();
        let lost = self.internal() - (stored + inelastic) + self.inertia() - self.arcs();
        let moved = self.moved_to_the_middle();
        let lost = lost + actuated + moved;
        Energies {
            kinetic: kinetic_energy(self.context.problem, self.velocities),
            strain,
            external: before.external + self.external() + moved,
            actuation: before.actuation + actuated,
            inelastic: before.inelastic + inelastic,
            friction: before.friction + friction,
            contact: before.contact + contact - friction + (resisted - stabilisation),
            stabilisation: before.stabilisation + stabilisation,
            numerical: before.numerical + (lost + (fully - contact)),
        }
    }

    fn scheme(&self) -> Option<&Scheme> {
        self.imposed.motion.as_ref().map(|motion| motion.scheme())
    }

    /// Weight of the start in loads and internal forces.
    fn averaged_weight(&self) -> f64 {
        self.scheme().map_or(0.5, |scheme| scheme.alpha_f)
    }

    /// Weight of the start in reactions and contact.
    fn held_weight(&self) -> f64 {
        self.scheme().map_or(0.5, |_| 0.0)
    }

    fn averaged(&self, start: Vec3, end: Vec3) -> Vec3 {
        mean(self.averaged_weight(), start, end)
    }

    fn held(&self, start: Vec3, end: Vec3) -> Vec3 {
        mean(self.held_weight(), start, end)
    }

    fn displacement(&self, node: GlobalNode) -> Vec3 {
        self.trial.positions[node] - self.state.positions[node]
    }

    /// Sum over all nodes of the displacement times a force; collective.
    fn work(&self, force: impl Fn(GlobalNode) -> Vec3) -> f64 {
        let problem = self.context.problem;
        let of_node = |node: GlobalNode| self.displacement(node).dot(&force(node));
        problem.share.sum(problem.own_nodes().map(of_node).sum())
    }

    fn external(&self) -> f64 {
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        let applied = self.work(|node| self.averaged(before.applied[node], after.applied[node]));
        let reactions = self.work(|node| {
            if self.context.problem.tie_of[node].is_some() {
                return Vec3::zeros();
            }
            let found = before.internal[node]
                - before.applied[node]
                - before.contact[node]
                - before.ties[node]
                - before.stabilisation[node];
            let reaction = self.context.prescribed_part(node, &after.reaction[node]);
            self.held(found, reaction)
        });
        let driven = |rigid: usize| !self.context.problem.has_coordinates(rigid);
        let surfaces = self.of_surfaces(driven, Way::Whole) + self.resisted(driven);
        applied + reactions + surfaces + self.of_bodies()
    }

    /// Work of the difference between reactions in the middle of the increment, without contact,
    /// and those of the equations.
    fn moved_to_the_middle(&self) -> f64 {
        let Some(scheme) = self.scheme() else {
            return 0.0;
        };
        let (context, problem) = (self.context, self.context.problem);
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        let accelerations = self.state.accelerations.iter().zip(self.accelerations);
        let jumps: Vec<Vec3> = accelerations.map(|(start, end)| start - end).collect();
        let inertia = mass_times(problem, &jumps);
        let on_nodes = self.work(|node| {
            if problem.tie_of[node].is_some() {
                return Vec3::zeros();
            }
            let [start, end] = [before, after].map(|of| of.internal[node] - of.applied[node]);
            context.prescribed_part(node, &(inertia[node] + start - end))
        });
        let [from, to] = [&self.state.rigid, &self.trial.rigid];
        let found = wrenches(problem, &self.state.positions, from, &before.reaction);
        let reached = wrenches(problem, &self.trial.positions, to, &after.reaction);
        let mut on_bodies = 0.0;
        for rigid in (0..from.len()).filter(|&rigid| problem.has_coordinates(rigid)) {
            let [from, to] = [from, to].map(|poses| poses[rigid].coordinates());
            let [found, reached] = [&found, &reached].map(|of| of[rigid].components());
            for at in (0..6).filter(|&at| context.fixed_rigid[rigid][at]) {
                on_bodies += (found[at] - reached[at]) * (to[at] - from[at]);
            }
        }
        (0.5 - scheme.alpha_f) * (on_nodes + on_bodies)
    }

    /// Work on the coordinates of rigid bodies: of what drives free ones, and of what
    /// holds the others against tied nodes and contact.
    fn of_bodies(&self) -> f64 {
        let problem = self.context.problem;
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        let ties = |positions: &[Vec3], poses: &[Pose], holding: &[Vec3]| {
            wrenches(problem, positions, poses, holding)
        };
        let [from, to] = [&self.state.rigid, &self.trial.rigid];
        let found = ties(&self.state.positions, from, &before.reaction);
        let reached = ties(&self.trial.positions, to, &after.reaction);
        let mut work = 0.0;
        let moving = |rigid: &usize| problem.has_coordinates(*rigid);
        for rigid in (0..from.len()).filter(moving) {
            let [from, to] = [from, to].map(|poses| poses[rigid].coordinates());
            let [
                found,
                reached,
                driven_from,
                driven_to,
                pushed_from,
                pushed_to,
            ] = [
                found[rigid],
                reached[rigid],
                before.rigid[rigid],
                after.rigid[rigid],
                before.pushed[rigid],
                after.pushed[rigid],
            ]
            .map(|wrench| wrench.components());
            let [averaged, held] = [self.averaged_weight(), self.held_weight()];
            for at in 0..6 {
                let force = if self.context.fixed_rigid[rigid][at] {
                    mean(averaged, found[at], reached[at])
                        + mean(held, pushed_from[at], pushed_to[at])
                } else {
                    mean(averaged, driven_from[at], driven_to[at])
                };
                work += force * (to[at] - from[at]);
            }
        }
        work
    }

    /// Work of contact forces on the motion of some rigid surfaces, positive where that
    /// pushes.
    fn of_surfaces(&self, wanted: impl Fn(usize) -> bool, way: Way) -> f64 {
        self.of_surfaces_with(self.held_weight(), wanted, way)
    }

    /// Work on surfaces with another weight of the start.
    fn of_surfaces_with(&self, weight: f64, wanted: impl Fn(usize) -> bool, way: Way) -> f64 {
        let problem = self.context.problem;
        let mut work = 0.0;
        for (pair, geometry) in problem.pairs.iter().enumerate() {
            let Some(rigid) = geometry.rigid.filter(|&rigid| wanted(rigid)) else {
                continue;
            };
            let poses = [&self.state.rigid[rigid], &self.trial.rigid[rigid]];
            let [start, end] = [
                (&self.state.pairs[pair].facets[0], &self.state.positions, 0),
                (
                    &self.assembled.contacts[pair].facets[0],
                    &self.trial.positions,
                    1,
                ),
            ]
            .map(|(facets, positions, end)| Pushing {
                pair,
                rigid,
                facets,
                positions,
                poses,
                end,
            });
            work += mean(weight, start.work(problem, way), end.work(problem, way));
        }
        work
    }

    /// Minus the work of stabilisation on some rigid bodies.
    fn resisted(&self, wanted: impl Fn(usize) -> bool) -> f64 {
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        let weight = self.held_weight();
        let mut work = 0.0;
        for rigid in (0..self.trial.rigid.len()).filter(|&rigid| wanted(rigid)) {
            let [from, to] =
                [&self.state.rigid, &self.trial.rigid].map(|poses| poses[rigid].coordinates());
            let [start, end] = [before, after].map(|forces| forces.stabilised[rigid].components());
            for at in 0..6 {
                work -= mean(weight, start[at], end[at]) * (to[at] - from[at]);
            }
        }
        work
    }

    /// Work of stabilisation on nodes.
    fn work_of_stabilisation(&self) -> f64 {
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        self.work(|node| self.held(before.stabilisation[node], after.stabilisation[node]))
    }

    /// Energy dissipated by the forces of stabilisation at the end, which is never negative.
    fn stabilisation(&self) -> f64 {
        let problem = self.context.problem;
        let pairs = self.imposed.dashpots.iter().enumerate();
        let of_pair = |(pair, dashpots): (usize, &Vec<Dashpot>)| -> f64 {
            let rigid = problem.pairs[pair].rigid;
            let poses = rigid.map(|rigid| [&self.state.rigid[rigid], &self.trial.rigid[rigid]]);
            let work = dashpots.iter().map(|dashpot| {
                let stretch = dashpot.stretch(problem, pair, &self.trial.positions, poses);
                dashpot.stiffness * stretch.norm_squared()
            });
            work.sum()
        };
        pairs.map(of_pair).sum()
    }

    fn internal(&self) -> f64 {
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        self.work(|node| self.averaged(before.internal[node], after.internal[node]))
    }

    /// Minus the work of contact forces on the sides of all pairs, with a weight of the start.
    fn contact(&self, weight: f64) -> f64 {
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        let on_nodes = self.work(|node| mean(weight, before.contact[node], after.contact[node]));
        self.of_surfaces_with(weight, |_| true, Way::Whole) - on_nodes
    }

    /// Work of inertia forces beyond the change of kinetic energy, from the jumps.
    fn inertia(&self) -> f64 {
        let Some(scheme) = self.scheme() else {
            return 0.0;
        };
        let (state, dt) = (self.state, self.imposed.elapsed);
        let nodes = self.trial.positions.len();
        let (mut weighted, mut excess) = (vec![Vec3::zeros(); nodes], vec![Vec3::zeros(); nodes]);
        let (mut way, mut shift) = (weighted.clone(), weighted.clone());
        for node in (0..nodes).map(GlobalNode) {
            let of = |vectors: &[Vec3]| self.context.components(node, &vectors[node]);
            let [v_0, v_1] = [&state.velocities[..], self.velocities].map(of);
            let [a_0, a_1] = [&state.accelerations[..], self.accelerations].map(of);
            let moved = self.context.components(node, &self.displacement(node));
            for axis in 0..3 {
                let [v_0, v_1, a_0, a_1] = [v_0, v_1, a_0, a_1].map(|vector| vector[axis]);
                way[node][axis] = 0.5 * dt * (v_0 + v_1);
                if self.context.fixed[node.component(axis)] {
                    let a = (1.0 - scheme.alpha_f) * a_1 + scheme.alpha_f * a_0;
                    weighted[node][axis] = a;
                    excess[node][axis] = a - (v_1 - v_0) / dt;
                    shift[node][axis] = moved[axis] - way[node][axis];
                } else {
                    let jump = a_1 - a_0;
                    weighted[node][axis] = (1.0 - scheme.alpha_m) * a_1 + scheme.alpha_m * a_0;
                    excess[node][axis] = (0.5 - scheme.alpha_f) * jump;
                    shift[node][axis] = (scheme.beta - 0.5 * scheme.gamma) * dt * dt * jump;
                }
            }
        }
        for vectors in [&mut weighted, &mut excess, &mut way, &mut shift] {
            for (node, frame) in self.context.turned.frames() {
                vectors[node] = frame.axes() * vectors[node];
            }
        }
        let problem = self.context.problem;
        for vectors in [&mut weighted, &mut excess, &mut shift] {
            problem.ties.follow(vectors);
        }
        product(problem, &way, &mass_times(problem, &excess))
            + product(problem, &shift, &mass_times(problem, &weighted))
    }

    /// Work of tie forces, and of contact forces on moving bodies, along chords beyond
    /// that along arcs.
    fn arcs(&self) -> f64 {
        let problem = self.context.problem;
        let (before, after) = (&self.state.forces, &self.assembled.forces);
        let moving = |rigid: usize| problem.has_coordinates(rigid);
        let mut work = self.of_surfaces(moving, Way::BeyondArc);
        for (rigid, nodes) in problem.tied.iter().enumerate() {
            let [from, to] = [&self.state.rigid[rigid], &self.trial.rigid[rigid]];
            let turn = to.turned - from.turned;
            for &node in nodes {
                let arm = problem.reference[node] - problem.model.rigid_surfaces[rigid].reference;
                let [r_0, r_1] = [from, to].map(|pose| pose.rotation * arm);
                let beyond = |r: &Vec3, h: &Vec3| (r_1 - r_0 - turn.cross(r)).dot(h);
                let start = beyond(&r_0, &before.reaction[node]);
                let end = beyond(&r_1, &after.reaction[node]);
                work += mean(self.averaged_weight(), start, end);
            }
        }
        work
    }
}

fn mean<T: Mul<f64, Output = T> + Add<Output = T>>(weight: f64, start: T, end: T) -> T {
    start * weight + end * (1.0 - weight)
}

/// A way that a point of a rigid body goes.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Way {
    /// The chord.
    Whole,
    /// Difference between chord and arc.
    BeyondArc,
}

/// Contact forces on the nodes that push a rigid body, at one end of an increment.
struct Pushing<'a> {
    pair: usize,
    rigid: usize,
    facets: &'a [(FacetId, FacetForces)],
    positions: &'a [Vec3],
    /// Of the body at both ends.
    poses: [&'a Pose; 2],
    /// Number of the end.
    end: usize,
}

impl Pushing<'_> {
    /// Work of the forces on the way of the body's points at the nodes.
    fn work(&self, problem: &Problem, way: Way) -> f64 {
        let Some(surface) = problem.pairs[self.pair].contact.sides[0].surface() else {
            return 0.0;
        };
        let reference = &problem.model.rigid_surfaces[self.rigid].reference;
        let placements = self.poses.map(|pose| pose.placement(reference));
        let moved = self.poses[1].displacement - self.poses[0].displacement;
        let turn = self.poses[1].turned - self.poses[0].turned;
        let point = reference + self.poses[self.end].displacement;
        let mut work = 0.0;
        for (facet, forces) in self.facets {
            let corners = surface.facets()[facet.index()];
            for (corner, force) in corners.iter().zip(&forces.force) {
                let Some(node) = problem.surface_node(self.pair, Side::A, *corner) else {
                    continue;
                };
                let x = self.positions[node];
                let material = placements[self.end].back(&x);
                let [from, to] = placements.map(|placement| placement.point(&material));
                let arc = match way {
                    Way::Whole => Vec3::zeros(),
                    Way::BeyondArc => moved + turn.cross(&(x - point)),
                };
                work += force.dot(&(to - from - arc));
            }
        }
        work
    }
}
