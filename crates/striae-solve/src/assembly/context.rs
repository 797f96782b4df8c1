//! Data that stay constant within a step, and values imposed in it.

mod dashpots;
mod turned;

use striae_contact::{
    complementarity::Prescribed, configuration::Configuration, pair::ContactPair, seating::Fitted,
    side::Side,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::node::SurfaceNode;

use crate::{
    dynamics::{ImposedRate, Motion},
    interference::{Positions, placed},
    offsets::Offsets,
    problem::Problem,
    rigid::{Pose, Wrench},
    stabilisation::Dashpot,
    state::State,
};
use dashpots::{coefficient, dashpots};
use striae_model::{
    LoadKind, Moment, Value,
    actuation::Actuations,
    cavity::Content,
    node::GlobalNode,
    plan::{PlannedCavity, PlannedForce, StepPlan},
};
use turned::Turned;

/// Data that stay constant within a step.
#[derive(Clone, Debug)]
pub struct StepContext<'a> {
    /// The problem.
    pub problem: &'a Problem,
    /// Number of the step.
    pub index: usize,
    /// Conditions in force.
    pub plan: &'a StepPlan,
    /// State at its start.
    pub start: &'a State,
    /// Pairs with the distances in which the step looks for contact.
    pub pairs: Vec<ContactPair>,
    /// `true` for prescribed position components, of each global node; along the axes of its own
    /// of a node that has some.
    pub fixed: Vec<bool>,
    /// Nodes that are prescribed along other directions than the coordinate axes.
    pub(crate) turned: Turned<'a>,
    /// `true` for prescribed coordinates, of each rigid body.
    pub fixed_rigid: Vec<[bool; 6]>,
    /// `true` for position components whose motion is known beforehand: `fixed` ones, those of
    /// nodes tied to rigid bodies that prescribed coordinates move along the component, and those
    /// of nodes that follow only such nodes.
    pub known: Vec<bool>,
    /// `known` by pair, side and surface node, with nodes whose gap others determine: those that
    /// follow nodes that touch the same opponent, or are glued to it.
    pub fixed_on_pair: Vec<Prescribed>,
    /// Offsets of the gaps of every pair: overlaps of the meshes that are removed in the step, and
    /// interferences.
    pub offsets: Vec<Offsets>,
    /// Coefficient of stabilisation of every pair, see [`crate::stabilisation`].
    pub stabilisation: Vec<f64>,
}

/// Values imposed at the end of an increment.
#[derive(Clone, Debug)]
pub struct Imposed {
    /// Prescribed position components: `(node, axis, position)`, along axes of its own of a node
    /// that has some.
    pub positions: Vec<(GlobalNode, usize, f64)>,
    /// Loads with their kinds at this point.
    pub loads: Vec<LoadKind<Value>>,
    /// Forces at nodes.
    pub forces: Vec<(GlobalNode, Vec3)>,
    /// Actuation of the bodies.
    pub actuations: Actuations,
    /// Contents of all cavities.
    pub cavities: Vec<Content>,
    /// Coordinates of the rigid bodies; `None` where they are free.
    pub rigid: Vec<[Option<f64>; 6]>,
    /// Force and torque that drive each rigid body.
    pub driving: Vec<Wrench>,
    /// Poses at the last converged state.
    pub before: Vec<Pose>,
    /// Acceleration of gravity.
    pub gravity: Vec3,
    /// Velocities and accelerations of the prescribed components.
    pub rates: Vec<ImposedRate>,
    /// Time since the last converged state; infinite where nothing depends on it.
    pub elapsed: f64,
    /// Time.
    pub time: f64,
    /// Inertia, if the step has it.
    pub motion: Option<Motion>,
    /// Dashpots that stabilise every pair in the increment.
    pub dashpots: Vec<Vec<Dashpot>>,
}

impl Imposed {
    /// Time in which materials flow: none where nothing says how long it is since the last
    /// converged state, as nothing has happened since then.
    pub fn flowing(&self) -> f64 {
        if self.elapsed.is_finite() {
            self.elapsed
        } else {
            0.0
        }
    }
}

impl<'a> StepContext<'a> {
    /// The context of step `index` that starts from `start`; collective.
    pub fn new(problem: &'a Problem, index: usize, start: &'a State) -> Self {
        let plan = &problem.plans[index];
        let mut fixed = vec![false; 3 * problem.reference.len()];
        for (body, node, axis) in plan.displacements.keys() {
            fixed[3 * (problem.first_node[*body] + node) + axis] = true;
        }
        let turned = Turned::new(problem, plan);
        turned.fix(&mut fixed);
        let fixed_rigid: Vec<[bool; 6]> = (plan.rigid.iter())
            .map(|coordinates| coordinates.each_ref().map(Option::is_some))
            .collect();
        let known = known(problem, &fixed, &fixed_rigid, &turned);
        let components = |pair: usize| {
            Side::BOTH.map(|side| {
                let surface = problem.pairs[pair].contact.sides[side].surface();
                let count = surface.map_or(0, |surface| surface.nodes().len());
                let shadowed = problem.shadowed.get(pair).map(|sides| &sides[side]);
                SurfaceNode::all(count)
                    .flat_map(|node| {
                        let global = problem.surface_node(pair, side, node)?;
                        let own = shadowed.is_some_and(|nodes| nodes[node]);
                        Some([0, 1, 2].map(|axis| own || known[global.component(axis)]))
                    })
                    .flatten()
                    .collect()
            })
        };
        let on_pair = |pair: usize| Prescribed {
            components: components(pair),
            axes: Side::BOTH.map(|side| turned.on_side(problem, pair, side)),
        };
        let pairs = problem.pairs.iter().map(|pair| pair.contact.clone());
        let mut context = Self {
            stabilisation: Vec::new(),
            fixed_on_pair: (0..problem.pairs.len()).map(on_pair).collect(),
            pairs: pairs.collect(),
            offsets: (0..problem.pairs.len())
                .map(|pair| Offsets::new(problem, index, pair))
                .collect(),
            problem,
            index,
            plan,
            start,
            fixed_rigid,
            known,
            fixed,
            turned,
        };
        let stated = problem
            .model
            .pairs
            .iter()
            .map(|of| of.interference.as_ref());
        let first = problem.plans[0].start;
        let offsets = context.offsets.iter().zip(stated);
        let depths: Vec<f64> = offsets
            .map(|(of, stated)| of.search(stated, first))
            .collect();
        context = context.looking(&depths);
        let pairs = 0..problem.pairs.len();
        context.stabilisation = pairs.map(|pair| coefficient(&context, pair)).collect();
        context
    }

    /// Copy of the context in which every pair searches for contact within at least `search`.
    pub fn looking(&self, search: &[f64]) -> Self {
        let mut context = self.clone();
        for (pair, search) in context.pairs.iter_mut().zip(search) {
            let known = pair.search_distance.unwrap_or(0.0);
            if *search > known {
                pair.search_distance = Some(*search);
            }
        }
        context
    }

    /// Overlap of the meshes of a pair that is left at the fraction `s` of the step.
    pub fn offsets_left(&self, pair: usize, s: f64) -> [Vec<f64>; 2] {
        let sides = self.offsets[pair].sides.each_ref();
        sides.map(|side| side.iter().map(|overlap| (1.0 - s) * overlap).collect())
    }

    /// The faces of a pair as they are at the start, at the fraction `s` of the step.
    pub fn fitted(&self, pair: usize, s: f64) -> Option<Fitted> {
        let stated = self.problem.model.pairs[pair].interference.as_ref();
        let first = self.problem.plans[0].start;
        let stated = stated.map_or(0.0, |stated| stated.at(self.index, s, first));
        self.offsets[pair].fitted(stated)
    }

    /// Values imposed at the fraction `s` of the step, at `time`, after `state`.
    pub fn imposed_after(&self, state: &State, s: f64, time: f64) -> Imposed {
        let elapsed = time - state.time;
        Imposed {
            elapsed,
            motion: Motion::new(self.problem, self.index, state, elapsed),
            dashpots: dashpots(self, state, s, elapsed),
            before: state.rigid.clone(),
            ..self.imposed(s)
        }
    }

    /// Motions of all nodes from a state along the components in which they are known; of no
    /// meaning along others.
    pub(crate) fn imposed_motions(&self, state: &State, imposed: &Imposed) -> Vec<Vec3> {
        let mut motions = vec![Vec3::zeros(); state.positions.len()];
        for &(node, axis, position) in &imposed.positions {
            let way = position - self.along(node, axis, &state.positions[node]);
            motions[node.0] += self.axis(node, axis) * way;
        }
        let bodies = self.problem.tied.iter().zip(&state.rigid).enumerate();
        for (rigid, (nodes, pose)) in bodies {
            let reference = &self.problem.model.rigid_surfaces[rigid].reference;
            let now = pose.coordinates();
            let end = std::array::from_fn(|at| imposed.rigid[rigid][at].unwrap_or(now[at]));
            let end = pose.moved_to(&end).placement(reference);
            for &node in nodes {
                motions[node.0] = end.point(&self.problem.reference[node]) - state.positions[node];
            }
        }
        self.problem.ties.follow(&mut motions);
        motions
    }

    /// Values imposed at the fraction `s` of the step, independent of the previous state.
    pub fn imposed(&self, s: f64) -> Imposed {
        let moment = self.plan.start.later(s);
        let prescribed = self.plan.displacements.iter();
        let prescribed = prescribed.map(|((body, node, axis), how)| {
            let node = self.problem.node(*body, NodeId::new(*node));
            (node, axis, how)
        });
        let prescribed = prescribed.filter(|(node, ..)| self.turned.frame(*node).is_none());
        let prescribed = prescribed.map(|(node, axis, how)| {
            let reference = &self.problem.reference[node];
            let ends = [reference[*axis], self.start.positions[node][*axis]];
            (node, *axis, reference, ends, how)
        });
        let positions = prescribed
            .clone()
            .map(|(node, axis, x, ends, how)| (node, axis, how.at(ends, x, moment)));
        let rates = prescribed.map(|(node, axis, x, ends, how)| {
            let [first, second] = how.rate(ends, x, moment);
            ImposedRate {
                node,
                axis,
                direction: None,
                velocity: first / moment.duration,
                acceleration: second / (moment.duration * moment.duration),
            }
        });
        let (of_turned, their_rates) = self.turned.imposed(self.problem, self.start, moment);
        Imposed {
            positions: positions.chain(of_turned).collect(),
            loads: self.plan.loads.iter().map(|load| load.at(moment)).collect(),
            forces: self.forces(moment),
            actuations: self.plan.actuations(&self.problem.model.bodies, s),
            cavities: self.contents(moment),
            rigid: self.coordinates(s),
            driving: self.driving(s),
            before: self.start.rigid.clone(),
            gravity: self.plan.gravity.at(moment),
            rates: rates.chain(their_rates).collect(),
            elapsed: f64::INFINITY,
            time: moment.time,
            motion: None,
            dashpots: Vec::new(),
        }
    }

    fn contents(&self, moment: Moment) -> Vec<Content> {
        let planned = self.plan.cavities.iter().enumerate();
        let content = |(cavity, planned): (usize, &PlannedCavity)| {
            let volume = self.problem.cavity_volume(cavity, &self.start.positions);
            let from = [self.start.pressures[cavity], volume];
            planned.content(from, self.problem.cavities[cavity].volume, moment)
        };
        planned.map(content).collect()
    }

    /// Forces at the nodes that this rank owns.
    fn forces(&self, moment: Moment) -> Vec<(GlobalNode, Vec3)> {
        let problem = self.problem;
        let of_one = |planned: &PlannedForce| {
            let force = planned.at(moment);
            let nodes = planned.nodes.iter();
            let nodes = nodes.map(|node| problem.node(planned.body.0, *node));
            let own = nodes.filter(|node| problem.share.owns(*node));
            let at = |node: GlobalNode| {
                let x = &problem.reference[node];
                (node, force.map(|value| value.at(x, moment.time)))
            };
            own.map(at).collect::<Vec<_>>()
        };
        self.plan.forces.iter().flat_map(of_one).collect()
    }

    fn coordinates(&self, s: f64) -> Vec<[Option<f64>; 6]> {
        let moment = self.plan.start.later(s);
        let plans = self.plan.rigid.iter().zip(&self.start.rigid);
        plans
            .map(|(plan, pose)| {
                let start = pose.coordinates();
                std::array::from_fn(|at| {
                    let how = plan[at].as_ref();
                    how.map(|how| how.at([0.0, start[at]], &Vec3::zeros(), moment))
                })
            })
            .collect()
    }

    /// Velocities and accelerations of the coordinates of rigid bodies, zero where free.
    pub(crate) fn rigid_rates(&self, s: f64) -> Vec<[[f64; 2]; 6]> {
        let moment = self.plan.start.later(s);
        let duration = moment.duration;
        let plans = self.plan.rigid.iter().zip(&self.start.rigid);
        plans
            .map(|(plan, pose)| {
                let start = pose.coordinates();
                std::array::from_fn(|at| {
                    let how = plan[at].as_ref();
                    let rate = how.map(|how| how.rate([0.0, start[at]], &Vec3::zeros(), moment));
                    let [first, second] = rate.unwrap_or_default();
                    [first / duration, second / (duration * duration)]
                })
            })
            .collect()
    }

    fn driving(&self, s: f64) -> Vec<Wrench> {
        let moment = self.plan.start.later(s);
        let plans = self.plan.driving.iter();
        plans
            .map(|[force, torque]| Wrench {
                force: force.at(moment),
                torque: torque.at(moment),
            })
            .collect()
    }

    /// Configuration of a pair with the nodes at `positions`.
    pub fn configuration(
        &self,
        pair: usize,
        positions: &[Vec3],
        rigid: &[Pose],
    ) -> Configuration<'_> {
        let at = Positions {
            nodes: positions,
            rigid,
        };
        placed(self.problem, pair, &self.pairs[pair], at)
    }
}

/// Components whose motion is known beforehand, three a node.
fn known(
    problem: &Problem,
    fixed: &[bool],
    fixed_rigid: &[[bool; 6]],
    turned: &Turned,
) -> Vec<bool> {
    let mut own = fixed.to_vec();
    for (nodes, fixed) in problem.tied.iter().zip(fixed_rigid) {
        // Turns about an axis move no point along it.
        let [x, y, z] = [0, 1, 2].map(|axis| fixed[3 + axis]);
        let turns = [y && z, z && x, x && y];
        for node in nodes {
            for axis in 0..3 {
                own[node.component(axis)] = fixed[axis] && turns[axis];
            }
        }
    }
    let mut known = own.clone();
    for follower in problem.ties.followers() {
        for (axis, weights) in follower.weights.iter().enumerate() {
            let Some(weights) = weights else { continue };
            known[follower.node.component(axis)] =
                weights.iter().all(|(node, _)| match turned.frame(*node) {
                    Some(frame) => frame.held() == 3,
                    None => own[node.component(axis)],
                });
        }
    }
    known
}
