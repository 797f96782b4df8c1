//! Springs and dashpots.

use crate::{
    fault::Fault,
    model::{RigidSurface, Spring, SpringEnd, SpringLine, SpringRest},
    path::Path,
};
use striae_mesh::Vec3;

use super::lookup::Names;

/// Springs; see [`spring`], [`spring_to_point`] and [`spring_along`].
#[derive(Clone, Debug)]
pub struct SpringBuilder {
    name: String,
    a: SpringEndBuilder,
    line: Line,
    stiffness: f64,
    damping: f64,
    rest: SpringRest,
}

#[derive(Clone, Debug)]
enum Line {
    To(SpringEndBuilder),
    ToPoint(Vec3),
    Along(Vec3),
}

/// End of springs that moves with a body; see [`nodes_of`], [`reference_of`] and [`point_of`].
#[derive(Clone, Debug)]
pub struct SpringEndBuilder(End);

#[derive(Clone, Debug)]
enum End {
    Nodes { body: String, nodes: String },
    Rigid { rigid: String, point: Option<Vec3> },
}

/// The nodes of a set of a deformable body.
pub fn nodes_of(body: impl Into<String>, nodes: impl Into<String>) -> SpringEndBuilder {
    SpringEndBuilder(End::Nodes {
        body: body.into(),
        nodes: nodes.into(),
    })
}

/// The reference point of a rigid body.
pub fn reference_of(rigid: impl Into<String>) -> SpringEndBuilder {
    SpringEndBuilder(End::Rigid {
        rigid: rigid.into(),
        point: None,
    })
}

/// A point of a rigid body, by its position at the start.
pub fn point_of(rigid: impl Into<String>, point: impl Into<Vec3>) -> SpringEndBuilder {
    SpringEndBuilder(End::Rigid {
        rigid: rigid.into(),
        point: Some(point.into()),
    })
}

/// Springs from each node of `a` to `b`, a single node or a point of a rigid body. They act along
/// the line between both ends as these move.
pub fn spring(name: impl Into<String>, a: SpringEndBuilder, b: SpringEndBuilder) -> SpringBuilder {
    SpringBuilder::new(name, a, Line::To(b))
}

/// Springs from each node of `a` to a point at rest, along the line to that point.
pub fn spring_to_point(
    name: impl Into<String>,
    a: SpringEndBuilder,
    point: impl Into<Vec3>,
) -> SpringBuilder {
    SpringBuilder::new(name, a, Line::ToPoint(point.into()))
}

/// Springs from each node of `a` to ground, which resist displacements along a fixed direction of
/// any length.
pub fn spring_along(
    name: impl Into<String>,
    a: SpringEndBuilder,
    direction: impl Into<Vec3>,
) -> SpringBuilder {
    let direction: Vec3 = direction.into();
    let unit = direction.try_normalize(0.0).unwrap_or(direction);
    SpringBuilder::new(name, a, Line::Along(unit))
}

impl SpringBuilder {
    fn new(name: impl Into<String>, a: SpringEndBuilder, line: Line) -> Self {
        Self {
            name: name.into(),
            a,
            line,
            stiffness: 0.0,
            damping: 0.0,
            rest: SpringRest::Slack,
        }
    }

    /// Tension of each spring over its elongation.
    pub fn stiffness(mut self, stiffness: f64) -> Self {
        self.stiffness = stiffness;
        self
    }

    /// Tension of the dashpot beside each spring over the rate of elongation.
    pub fn damping(mut self, damping: f64) -> Self {
        self.damping = damping;
        self
    }

    /// Length at which the springs have no tension; by default their length at the start.
    pub fn free_length(mut self, length: f64) -> Self {
        self.rest = SpringRest::Length(length);
        self
    }

    /// Tension at the start, negative for compression.
    pub fn preload(mut self, tension: f64) -> Self {
        self.rest = SpringRest::Preload(tension);
        self
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The springs; `rigid` are the rigid bodies as far as they are known.
    pub(super) fn resolved(
        &self,
        index: usize,
        (names, rigid): (&Names<'_>, &[Option<RigidSurface>]),
        faults: &mut Vec<Fault>,
    ) -> Option<Spring> {
        let path = |field| Path::part("springs", index).field(field);
        let a = self.a.resolved(&path("a"), (names, rigid), faults);
        let line = match &self.line {
            Line::To(end) => {
                let end = end.resolved(&path("b"), (names, rigid), faults);
                end.map(SpringLine::To)
            }
            Line::ToPoint(point) => Some(SpringLine::ToPoint(*point)),
            Line::Along(direction) => Some(SpringLine::Along(*direction)),
        };
        Some(Spring {
            name: self.name.clone(),
            a: a?,
            line: line?,
            stiffness: self.stiffness,
            damping: self.damping,
            rest: self.rest,
        })
    }
}

impl SpringEndBuilder {
    fn resolved(
        &self,
        path: &Path,
        (names, rigid): (&Names<'_>, &[Option<RigidSurface>]),
        faults: &mut Vec<Fault>,
    ) -> Option<SpringEnd> {
        match &self.0 {
            End::Nodes { body, nodes } => {
                let (body, nodes) = names.nodes(body, nodes, path, faults)?;
                Some(SpringEnd::Nodes { body, nodes })
            }
            End::Rigid { rigid: name, point } => {
                let id = names.rigid(name, path, faults)?;
                let of = rigid.get(id.0).and_then(Option::as_ref);
                let point = point.or_else(|| of.map(|of| of.reference))?;
                Some(SpringEnd::Rigid { rigid: id, point })
            }
        }
    }
}
