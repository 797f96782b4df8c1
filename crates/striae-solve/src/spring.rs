//! Springs with dashpots: one link from each node of the first end of a [`Spring`].
//!
//! A link has the length `l` between its ends `a` and `b`, or the displacement of `a` along a fixed
//! direction. With its length `L` at the start, the stiffness `k` and the damping `c`, its tension is
//!
//! ```text
//! N = N_0 + k (l - L) + c l',   internal forces N g on a, -N g on b,   g = dl/dx_a
//! ```
//!
//! Without inertia the rate is `l' = (l - l_n)/dt` in the (pseudo) time of the step, with inertia
//! `l' = g . (v_a - v_b)` with the velocities that time integration gives to the nodes. Between two
//! points the link turns with them: `dg/dx_a = (I - g g)/l`. Its energy is counted from the start,
//!
//! ```text
//! W = N_0 (l - L) + k/2 (l - L)^2,   D = c (l - l_n)^2/dt
//! ```
//!
//! with the work `D` that its dashpot dissipates in an increment, at the mean rate.
//!
//! A point of a rigid body is a global node without mass that is tied to the body. Forces of links
//! are internal forces, so time integration, reactions and energies treat them as those of elements.

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use striae_model::{Model, Spring, SpringEnd, SpringLine, SpringRest, node::GlobalNode};

/// A single spring with a dashpot beside it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Number of its springs in the model.
    pub spring: usize,
    /// First end.
    pub a: GlobalNode,
    /// The line along which it acts.
    pub line: Line,
    /// Length at the start.
    pub length: f64,
    /// Tension at the start.
    pub preload: f64,
    /// Tension over elongation.
    pub stiffness: f64,
    /// Tension over rate of elongation.
    pub damping: f64,
}

/// Line along which a link acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Line {
    /// To a node.
    To(GlobalNode),
    /// To a point at rest.
    ToPoint(Vec3),
    /// Along a unit vector, from this position of the first end.
    Along(Vec3, Vec3),
}

/// Length of a link with its derivatives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Length {
    /// Length.
    pub value: f64,
    /// Its gradient by the position of the first end, minus that by the second one.
    pub gradient: Vec3,
    /// Second derivative by the position of the first end.
    pub curvature: Matrix3<f64>,
}

impl Link {
    /// The node at the second end, if that moves.
    pub fn second(&self) -> Option<GlobalNode> {
        match self.line {
            Line::To(node) => Some(node),
            Line::ToPoint(_) | Line::Along(..) => None,
        }
    }

    /// Length with the nodes at `positions`; `None` where the ends meet, so that the link has no
    /// direction.
    pub fn length(&self, positions: &[Vec3]) -> Option<Length> {
        let from = match self.line {
            Line::To(node) => positions[node],
            Line::ToPoint(point) => point,
            Line::Along(direction, start) => {
                return Some(Length {
                    value: direction.dot(&(positions[self.a] - start)),
                    gradient: direction,
                    curvature: Matrix3::zeros(),
                });
            }
        };
        let way = positions[self.a] - from;
        let value = way.norm();
        let gradient = way.try_normalize(0.0)?;
        let across = Matrix3::identity() - gradient * gradient.transpose();
        let curvature = across / value;
        let is_finite = curvature.iter().all(|entry| entry.is_finite());
        is_finite.then_some(Length {
            value,
            gradient,
            curvature,
        })
    }

    /// Tension at a length and its rate.
    pub fn tension(&self, length: f64, rate: f64) -> f64 {
        self.preload + self.stiffness * (length - self.length) + self.damping * rate
    }

    /// Energy stored since the start at a length.
    pub fn stored(&self, length: f64) -> f64 {
        let elongation = length - self.length;
        (self.preload + 0.5 * self.stiffness * elongation) * elongation
    }

    /// Rate of the length of the link with some velocities of the nodes.
    pub fn rate(&self, length: &Length, velocities: &[Vec3]) -> f64 {
        length.gradient.dot(&self.relative(velocities))
    }

    /// Vector of the first end relative to the second one.
    pub fn relative(&self, vectors: &[Vec3]) -> Vec3 {
        let of_second = self.second().map_or_else(Vec3::zeros, |node| vectors[node]);
        vectors[self.a] - of_second
    }
}

/// Links of all springs of a model. Points of rigid bodies join the reference positions and the
/// nodes `tied` to each body.
pub(crate) fn links(
    model: &Model,
    first_node: &[usize],
    (reference, tied): (&mut Vec<Vec3>, &mut [Vec<GlobalNode>]),
) -> Vec<Link> {
    let mut links = Vec::new();
    let mut nodes_of = |end: &SpringEnd, reference: &mut Vec<Vec3>| match end {
        SpringEnd::Nodes { body, nodes } => {
            let nodes = nodes.iter();
            let global = nodes.map(|node| GlobalNode(first_node[body.0] + node.index()));
            global.collect::<Vec<_>>()
        }
        SpringEnd::Rigid { rigid, point } => {
            let node = GlobalNode(reference.len());
            reference.push(*point);
            tied[rigid.0].push(node);
            vec![node]
        }
    };
    for (spring, of) in model.springs.iter().enumerate() {
        let first = nodes_of(&of.a, reference);
        let second = match &of.line {
            SpringLine::To(end) => nodes_of(end, reference).first().copied(),
            SpringLine::ToPoint(_) | SpringLine::Along(_) => None,
        };
        for a in first {
            let line = match (&of.line, second) {
                (SpringLine::To(_), None) => continue,
                (SpringLine::To(_), Some(node)) => Line::To(node),
                (SpringLine::ToPoint(point), _) => Line::ToPoint(*point),
                (SpringLine::Along(direction), _) => Line::Along(*direction, reference[a]),
            };
            links.push(link(spring, of, (a, line), reference));
        }
    }
    links
}

fn link(spring: usize, of: &Spring, (a, line): (GlobalNode, Line), reference: &[Vec3]) -> Link {
    let link = Link {
        spring,
        a,
        line,
        length: 0.0,
        preload: 0.0,
        stiffness: of.stiffness,
        damping: of.damping,
    };
    let length = link.length(reference).map_or(0.0, |length| length.value);
    let preload = match of.rest {
        SpringRest::Slack => 0.0,
        SpringRest::Length(slack) => of.stiffness * (length - slack),
        SpringRest::Preload(tension) => tension,
    };
    Link {
        length,
        preload,
        ..link
    }
}

/// Adds the force of each dashpot at the given velocities to tensions and forces that are those
/// without dashpots.
pub(crate) fn add_dashpots(
    links: &[Link],
    positions: &[Vec3],
    velocities: &[Vec3],
    (tensions, internal): (&mut [f64], &mut [Vec3]),
) {
    for (link, tension) in links.iter().zip(tensions) {
        let Some(length) = link.length(positions) else {
            continue;
        };
        let viscous = link.damping * link.rate(&length, velocities);
        *tension += viscous;
        internal[link.a] += length.gradient * viscous;
        if let Some(second) = link.second() {
            internal[second] -= length.gradient * viscous;
        }
    }
}
