//! Rigid motions that nothing holds.
//!
//! Bodies and rigid bodies that are tied together move as one. A motion `u = c + w x (x - x0)`
//! of each is stopped by rows `e . u(x) = 0`: of prescribed components and coordinates,
//! of the normals of closed contact nodes and, where friction holds, of the tangents, and of springs; between
//! two bodies that both move, of the difference of their motions. What is left is the null
//! space of the rows. Lengths are scaled by the size of the bodies.
//!
//! Prescribed nodes are processed by the ranks that own them, everything else by all ranks.
//!
//! Longer than other files, as rows and the words for their null space belong together.

use nalgebra::{DMatrix, Matrix3, SymmetricEigen};
use striae_contact::{
    initial::Faces,
    interference::{Stage, facing},
    side::Side,
    unknowns::{NodeResult, Status},
};
use striae_mesh::Vec3;
use striae_surface::node::SurfaceNode;

use crate::{
    assembly::StepContext,
    interference::{Positions, configuration, thickness},
    outcome::{FreeMotion, FreeMover},
    problem::Problem,
    spring::Link,
    state::State,
};
use striae_model::node::GlobalNode;

/// Contact nodes at which friction holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Friction {
    /// All closed nodes of pairs that have friction.
    Any,
    /// Closed nodes with friction, and all closed nodes of stabilised pairs.
    Dashpots,
    /// Nodes that stick, in pairs of which a noticeable part does.
    Reserve,
}

/// Part of the closed nodes of a pair that may stick when it is at the limit of friction.
const STICKING: f64 = 0.2;
/// Eigenvalue, over the largest one, of a motion that nothing stops.
const SINGULAR: f64 = 1e-9;
/// Corresponding limit for a motion that friction alone stops: normals of deformed surfaces tilt by
/// some hundredths, which holds no body that friction cannot.
const TILTED: f64 = 1e-3;
/// Amount by which a motion may fall short of being entirely free.
const SHORT: f64 = 1e-6;

/// Pairs of which all closed nodes slip, but for a few: at the middle of a turn nothing slips.
pub fn slipping<'n>(contacts: impl Iterator<Item = &'n [Vec<NodeResult>; 2]>) -> Vec<bool> {
    contacts
        .map(|sides| {
            let count = |status| {
                sides
                    .iter()
                    .flatten()
                    .filter(|n| n.status == status)
                    .count()
            };
            let (stick, slip) = (count(Status::Stick), count(Status::Slip));
            slip > 0 && (stick as f64) <= STICKING * (stick + slip) as f64
        })
        .collect()
}

/// Pairs whose sides count as held by each other where they face each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Bridged {
    /// None.
    None,
    /// Pairs that are stabilised in the step.
    Stabilised,
    /// The pair of this number only, as if it touched.
    Touching(usize),
}

/// The pair whose stabilisation would carry the body with a free motion to contact that holds it.
pub fn worth_stabilising(context: &StepContext, state: &State, free: &FreeMotion) -> Option<usize> {
    let open = |pair: &usize| {
        let mut nodes = state.pairs[*pair].nodes.iter().flatten();
        context.stabilisation[*pair] == 0.0 && nodes.all(|node| node.status == Status::Open)
    };
    let held = |pair: &usize| {
        let left = free_motion_in(context, state, Bridged::Touching(*pair));
        left.is_none_or(|left| left.mover != free.mover)
    };
    (0..state.pairs.len()).filter(open).find(held)
}

/// A motion that nothing holds in a converged state. Nodes of pairs that contact has not evaluated
/// yet count as closed if they touch.
pub fn free_motion_in(
    context: &StepContext,
    state: &State,
    bridged: Bridged,
) -> Option<FreeMotion> {
    let mut touching: Vec<_> = (0..state.pairs.len())
        .map(|pair| touching(context, pair))
        .collect();
    let is_bridged = |pair: usize| match bridged {
        Bridged::None => false,
        Bridged::Stabilised => context.stabilisation[pair] > 0.0,
        Bridged::Touching(only) => pair == only,
    };
    for pair in (0..touching.len()).filter(|&pair| is_bridged(pair)) {
        touching[pair] = closed(context, state, pair);
    }
    let pairs = state.pairs.iter().zip(&touching).enumerate();
    let contacts: Vec<_> = pairs
        .map(|(pair, (of_pair, touching))| {
            let looked_at = of_pair.kept.iter().flatten().any(|known| *known);
            if looked_at && !is_bridged(pair) {
                &of_pair.nodes
            } else {
                touching
            }
        })
        .collect();
    let friction = match bridged {
        Bridged::Stabilised => Friction::Dashpots,
        Bridged::None | Bridged::Touching(_) => Friction::Any,
    };
    free_motion(context, state.into(), &contacts, friction)
}

/// Nodes of a pair that are closed where they face the other side.
fn closed(context: &StepContext, state: &State, pair: usize) -> [Vec<NodeResult>; 2] {
    let configuration = configuration(context.problem, pair, state.into());
    let mut nodes = [Vec::new(), Vec::new()];
    for &side in context.pairs[pair].deformable_sides() {
        let normals = configuration.side(side).normals.iter();
        nodes[side] = normals
            .map(|normal| NodeResult {
                normal: *normal,
                ..NodeResult::default()
            })
            .collect();
    }
    for facing in facing(&configuration) {
        nodes[facing.side][facing.node].status = Status::Stick;
    }
    nodes
}

/// Nodes of a pair that touch the other side where the step begins.
fn touching(context: &StepContext, pair: usize) -> [Vec<NodeResult>; 2] {
    const TOUCHING: f64 = 1e-6;
    let at = Positions::from(context.start);
    let configuration = configuration(context.problem, pair, at);
    let stage = Stage {
        configuration: &configuration,
        thickness: &thickness(context.problem, pair, at.nodes),
    };
    let faces = Faces::new(&stage);
    let mut nodes = [Vec::new(), Vec::new()];
    for &side in context.pairs[pair].deformable_sides() {
        let snapshot = configuration.side(side);
        let result = |node: SurfaceNode| {
            let touches = faces
                .signed_gap(side, node)
                .is_some_and(|(gap, _)| gap <= TOUCHING * snapshot.sizes[node]);
            NodeResult {
                normal: snapshot.normals[node],
                status: if touches { Status::Stick } else { Status::Open },
                ..NodeResult::default()
            }
        };
        nodes[side] = SurfaceNode::all(snapshot.x.len()).map(result).collect();
    }
    nodes
}

/// A motion that nothing holds; `contacts` are the nodes of every pair. Collective.
pub fn free_motion(
    context: &StepContext,
    at: Positions,
    contacts: &[&[Vec<NodeResult>; 2]],
    friction: Friction,
) -> Option<FreeMotion> {
    let mut rows = Rows::new(context, at);
    rows.prescribed(context, at);
    rows.prescribed_coordinates(context, at);
    rows.springs(context.problem, at);
    let slipping = slipping(contacts.iter().copied());
    for (pair, nodes) in contacts.iter().enumerate() {
        let is_rough = !context.plan.frictions[pair].is_frictionless();
        let holds = |status: Status| match friction {
            Friction::Any => is_rough,
            Friction::Dashpots => is_rough || context.stabilisation[pair] > 0.0,
            Friction::Reserve => status == Status::Stick && !slipping[pair],
        };
        rows.contact(context.problem, pair, nodes, at, holds);
    }
    let singular = match friction {
        Friction::Any | Friction::Dashpots => SINGULAR,
        Friction::Reserve => TILTED,
    };
    rows.free(context.problem, singular)
}

/// Bodies and rigid bodies that move as one.
struct Component {
    bodies: Vec<usize>,
    rigid: Vec<usize>,
    middle: Vec3,
    size: f64,
}

struct Rows {
    components: Vec<Component>,
    /// Component of every body and, after these, of every rigid body; `None`: at rest or moved.
    of: Vec<Option<usize>>,
    normal: DMatrix<f64>,
}

impl Rows {
    fn new(context: &StepContext, at: Positions) -> Self {
        let problem = context.problem;
        let (bodies, rigid) = (problem.model.bodies.len(), problem.tied.len());
        let mut root: Vec<usize> = (0..bodies + rigid).collect();
        let to_rigid = problem.model.rigid_surfaces.iter().enumerate();
        let to_rigid = to_rigid.flat_map(|(index, surface)| {
            let tied = surface.ties.iter();
            tied.map(move |(body, _)| [body.0, bodies + index])
        });
        let to_bodies = problem.ties.joints.iter().map(|joint| joint.bodies);
        for [one, other] in to_rigid.chain(to_bodies) {
            let (one, other) = (root[one], root[other]);
            let (low, high) = (one.min(other), one.max(other));
            root.iter_mut()
                .filter(|r| **r == high)
                .for_each(|r| *r = low);
        }
        let mut components: Vec<Component> = Vec::new();
        let mut of = vec![None; bodies + rigid];
        for first in 0..bodies + rigid {
            let moves = first < bodies || problem.has_coordinates(first - bodies);
            if root[first] != first || !moves {
                continue;
            }
            let members: Vec<usize> = (0..bodies + rigid).filter(|m| root[*m] == first).collect();
            members
                .iter()
                .for_each(|member| of[*member] = Some(components.len()));
            let (own, ties) = members.into_iter().partition(|member| *member < bodies);
            let ties: Vec<usize> = ties;
            let ties = ties.into_iter().map(|member| member - bodies).collect();
            components.push(Component::new(problem, at, own, ties));
        }
        let size = 6 * components.len();
        Self {
            components,
            of,
            normal: DMatrix::zeros(size, size),
        }
    }

    /// `e . u(x)` of the motion of a component, six entries.
    fn entries(&self, component: usize, x: &Vec3, e: &Vec3) -> [f64; 6] {
        let Component { middle, size, .. } = &self.components[component];
        let arm = ((x - middle) / *size).cross(e);
        [e.x, e.y, e.z, arm.x, arm.y, arm.z]
    }

    fn add(&mut self, entries: &[(usize, [f64; 6])]) {
        for (one, a) in entries {
            for (other, b) in entries {
                for i in 0..6 {
                    for j in 0..6 {
                        self.normal[(6 * one + i, 6 * other + j)] += a[i] * b[j];
                    }
                }
            }
        }
    }

    /// Rows of prescribed nodes, the first ones; collective.
    fn prescribed(&mut self, context: &StepContext, at: Positions) {
        let problem = context.problem;
        let nodes = problem.first_node.last().copied().unwrap_or(0);
        let nodes = problem.own_nodes().take_while(|node| node.0 < nodes);
        for node in nodes {
            let (body, _) = problem.body_node(node);
            let Some(component) = self.of[body] else {
                continue;
            };
            for axis in (0..3).filter(|axis| context.fixed[node.component(*axis)]) {
                let row = self.entries(component, &at.nodes[node], &context.axis(node, axis));
                self.add(&[(component, row)]);
            }
        }
        problem.share.team().sum(self.normal.as_mut_slice());
    }

    fn prescribed_coordinates(&mut self, context: &StepContext, at: Positions) {
        let problem = context.problem;
        let bodies = problem.model.bodies.len();
        for (rigid, fixed) in context.fixed_rigid.iter().enumerate() {
            let Some(component) = self.of[bodies + rigid] else {
                continue;
            };
            let point =
                problem.model.rigid_surfaces[rigid].reference + at.rigid[rigid].displacement;
            for coordinate in (0..6).filter(|coordinate| fixed[*coordinate]) {
                let row = match coordinate {
                    axis @ 0..3 => self.entries(component, &point, &Vec3::ith(axis, 1.0)),
                    turn => std::array::from_fn(|at| if at == turn { 1.0 } else { 0.0 }),
                };
                self.add(&[(component, row)]);
            }
        }
    }

    /// Rows of springs: along them, and across those in tension, they resist the relative motion of
    /// their ends.
    fn springs(&mut self, problem: &Problem, at: Positions) {
        for link in problem.links.iter().filter(|link| link.stiffness > 0.0) {
            let Some(length) = link.length(at.nodes) else {
                continue;
            };
            self.spring(problem, at, (link, &length.gradient));
            let is_tight = link.tension(length.value, 0.0) > 0.0;
            if is_tight && length.curvature != Matrix3::zeros() {
                for axis in 0..3 {
                    let across = length.curvature.column(axis) * length.value;
                    self.spring(problem, at, (link, &across));
                }
            }
        }
    }

    fn spring(&mut self, problem: &Problem, at: Positions, (link, along): (&Link, &Vec3)) {
        let bodies = problem.model.bodies.len();
        let of_node = |node: GlobalNode| match problem.tie_of[node] {
            Some(rigid) => self.of[bodies + rigid],
            None => self.of[problem.body_node(node).0],
        };
        let ends = [(Some(link.a), 1.0), (link.second(), -1.0)];
        let ends = ends.into_iter().filter_map(|(node, sign)| {
            let component = of_node(node?)?;
            let row = self.entries(component, &at.nodes[node?], &(along * sign));
            Some((component, row))
        });
        let entries: Vec<_> = ends.collect();
        self.add(&entries);
    }

    /// Rows of the closed nodes of a pair.
    fn contact(
        &mut self,
        problem: &Problem,
        pair: usize,
        nodes: &[Vec<NodeResult>; 2],
        at: Positions,
        holds: impl Fn(Status) -> bool,
    ) {
        let geometry = &problem.pairs[pair];
        if geometry.contact.is_self_contact() {
            return;
        }
        let bodies = problem.model.bodies.len();
        let of_side = Side::BOTH.map(|side| match (geometry.bodies[side], geometry.rigid) {
            (Some(body), _) => self.of[body],
            (None, Some(rigid)) => self.of[bodies + rigid],
            (None, None) => None,
        });
        for side in Side::BOTH {
            for (node, result) in nodes[side].iter().enumerate() {
                let global = problem.surface_node(pair, side, SurfaceNode::new(node));
                let (Some(global), false) = (global, result.status == Status::Open) else {
                    continue;
                };
                let n = result.normal;
                let mut directions = vec![n];
                if holds(result.status) {
                    directions = (0..3).map(|axis| Vec3::ith(axis, 1.0)).collect();
                }
                let x = at.nodes[global];
                for e in directions {
                    let row = |side: Side, sign: f64| {
                        let component = of_side[side]?;
                        Some((component, self.entries(component, &x, &(e * sign))))
                    };
                    let rows = [row(side, 1.0), row(side.opposite(), -1.0)];
                    let rows: Vec<_> = rows.into_iter().flatten().collect();
                    self.add(&rows);
                }
            }
        }
    }

    /// The motion with an eigenvalue below `singular` of the largest, if there is one.
    fn free(self, problem: &Problem, singular: f64) -> Option<FreeMotion> {
        let eigen = SymmetricEigen::new(self.normal.clone());
        let largest = eigen.eigenvalues.iter().copied().fold(0.0, f64::max);
        let count = eigen.eigenvalues.len();
        let null: Vec<usize> = (0..count)
            .filter(|&k| eigen.eigenvalues[k] <= singular * largest)
            .collect();
        if null.is_empty() {
            return None;
        }
        let part = |unknown: usize| -> f64 {
            let squares = null
                .iter()
                .map(|&k| eigen.eigenvectors[(unknown, k)].powi(2));
            squares.sum::<f64>()
        };
        for (index, component) in self.components.iter().enumerate() {
            let free: Vec<usize> = (0..6)
                .filter(|k| part(6 * index + k) > 1.0 - SHORT)
                .collect();
            if !free.is_empty() {
                return Some(component.motion(problem, &free));
            }
        }
        let vector = eigen.eigenvectors.column(null[0]);
        let of = |index: usize| vector.rows(6 * index, 6).norm_squared();
        let index = (0..self.components.len()).max_by(|a, b| of(*a).total_cmp(&of(*b)))?;
        let six: [f64; 6] = std::array::from_fn(|k| vector[6 * index + k]);
        Some(self.components[index].oblique(problem, &six))
    }
}

impl Component {
    /// Bodies and rigid bodies that move as one; collective.
    fn new(problem: &Problem, at: Positions, bodies: Vec<usize>, rigid: Vec<usize>) -> Self {
        let share = &problem.share;
        let nodes = bodies.iter().flat_map(|&body| problem.nodes_of(body));
        let nodes = nodes.filter(|node| share.owns(*node));
        let nodes: Vec<Vec3> = nodes.map(|node| at.nodes[node]).collect();
        let mut sum = [nodes.iter().sum::<Vec3>()];
        share.sum_vectors(&mut sum);
        let reference = rigid.first().map(|&rigid| {
            problem.model.rigid_surfaces[rigid].reference + at.rigid[rigid].displacement
        });
        let mean = sum[0] / share.sum(nodes.len() as f64).max(1.0);
        let middle = reference.unwrap_or(mean);
        let arms = nodes.iter().map(|x| (x - middle).norm());
        let size = share.largest(arms.fold(0.0, f64::max));
        Self {
            bodies,
            rigid,
            middle,
            size: if size > 0.0 { size } else { 1.0 },
        }
    }

    fn mover(&self, problem: &Problem) -> FreeMover {
        match (self.rigid.first(), self.bodies.first()) {
            (Some(rigid), _) => FreeMover::Rigid(problem.model.rigid_surfaces[*rigid].name.clone()),
            (None, body) => {
                let body = body.map(|body| problem.model.bodies[*body].name.clone());
                FreeMover::Body(body.unwrap_or_default())
            }
        }
    }

    /// Motions along and about the axes.
    fn motion(&self, problem: &Problem, free: &[usize]) -> FreeMotion {
        let mover = self.mover(problem);
        let words = match &mover {
            FreeMover::Rigid(_) => [
                "in `x`", "in `y`", "in `z`", "in `rx`", "in `ry`", "in `rz`",
            ],
            FreeMover::Body(_) => [
                "along x", "along y", "along z", "about x", "about y", "about z",
            ],
        };
        let words: Vec<&str> = free.iter().map(|&k| words[k]).collect();
        let motions = match &words[..] {
            [rest @ .., last] if !rest.is_empty() => format!("{} and {last}", rest.join(", ")),
            _ => words.concat(),
        };
        FreeMotion { mover, motions }
    }

    /// Any other motion.
    fn oblique(&self, problem: &Problem, [x, y, z, rx, ry, rz]: &[f64; 6]) -> FreeMotion {
        let (shift, turn) = (Vec3::new(*x, *y, *z), Vec3::new(*rx, *ry, *rz));
        let words = |v: &Vec3| {
            // Zero has no sign.
            let [x, y, z] = [v.x, v.y, v.z].map(|x| (x * 1e3).round() / 1e3 + 0.0);
            format!("({x:.3}, {y:.3}, {z:.3})")
        };
        let motions = if turn.norm() < SHORT * shift.norm() {
            format!("along {}", words(&shift.normalize()))
        } else {
            let turn = turn / self.size;
            let through = self.middle + turn.cross(&shift) / turn.norm_squared();
            format!(
                "about {} through {}",
                words(&turn.normalize()),
                words(&through)
            )
        };
        let mover = self.mover(problem);
        FreeMotion { mover, motions }
    }
}
