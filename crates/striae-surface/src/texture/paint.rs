//! Painting of a texture on the reference surface.
//!
//! A [`Field`] has a value at every point of space and a nodal field at every node;
//! directions at a few places are carried over the surface by interpolation along its
//! edges. Directions need not be tangential nor of unit length: the unit vector of their
//! tangential part counts.
//!
//! Lines of fields about an axis through the point `o` with the unit direction `d`, where `r` is
//! the part across it of the unit vector from `o` to `x`:
//!
//! ```text
//! uniform v/|v|      circumferential  d x r      axial  d      radial  r
//! ```
//!
//! each with the turn `t` about the normal `n` of the surface: `cos(t) v + sin(t) n x v` of the
//! tangential part `v`.

use nalgebra::Vector3;
use serde::Serialize;
use striae_declared::{ANY, Absent, Declared, LENGTH, POSITIVE, Parameter, Set, Values};
use striae_mesh::Vec3;

use super::axes::{Axes, tangential};
use super::axis::{Axis, unit};
use super::error::{InadmissibleTexture, TextureError};
use super::own::{DirectionField, OwnLines};
use super::radial_basis::{Conditioning, interpolate};
use crate::{
    graph::EdgeGraph,
    node::SurfaceNode,
    scalar::{Real, constant, constant3, cross, scaled},
};

/// Rotation of the lines of a field, a parameter of each.
pub const TURN: Parameter = Parameter::number(
    "turn",
    ANY,
    "degrees",
    "Angle by which the lines are rotated about the outward normal.",
)
.or(Absent::Number(0.0));

/// One direction.
pub static UNIFORM: Declared<Paint> = Declared {
    name: "uniform",
    summary: "The tangential part of one direction.",
    parameters: &[
        Parameter::direction("uniform", "The direction, of any length."),
        TURN,
    ],
    build: |values| field(Lines::Uniform(values.array("uniform").into()), values),
    fit: None,
};

/// Circles.
pub static CIRCUMFERENTIAL: Declared<Paint> = Declared {
    name: "circumferential",
    summary: "Circles about an axis by the right-hand rule.",
    parameters: &[Parameter::axis("circumferential", "The axis."), TURN],
    build: |values| {
        let axis = Axis::stated(values, "circumferential");
        field(Lines::Circumferential(axis), values)
    },
    fit: None,
};

/// Parallels.
pub static AXIAL: Declared<Paint> = Declared {
    name: "axial",
    summary: "Parallels of an axis.",
    parameters: &[Parameter::axis("axial", "The axis."), TURN],
    build: |values| field(Lines::Axial(Axis::stated(values, "axial")), values),
    fit: None,
};

/// Rays.
pub static RADIAL: Declared<Paint> = Declared {
    name: "radial",
    summary: "Rays from an axis outwards.",
    parameters: &[Parameter::axis("radial", "The axis."), TURN],
    build: |values| field(Lines::Radial(Axis::stated(values, "radial")), values),
    fit: None,
};

fn field(lines: Lines, values: &Values) -> Result<Paint, InadmissibleTexture> {
    Ok(Paint::lines(lines, values))
}

/// A field of directions in space, made tangential to whatever surface it meets.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Field {
    /// Its lines.
    pub lines: Lines,
    /// Angle by which the tangential direction is turned about the outward normal,
    /// counter-clockwise seen from outside (radians).
    pub turn: f64,
}

/// Lines of a field.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Lines {
    /// One direction everywhere.
    Uniform(Vec3),
    /// Circles about an axis, by the right-hand rule.
    Circumferential(Axis),
    /// Parallels of an axis, along its direction.
    Axial(Axis),
    /// Rays from an axis outwards.
    Radial(Axis),
    /// Lines by a formula that is no variant.
    Own(OwnLines),
}

impl Field {
    /// Texture of a surface with unit `normal` at a point: on a rigid plane, the texture itself.
    ///
    /// `None` where the field has no tangential part, as circles on their axis.
    /// Generic over the scalar, so that dual numbers give the derivatives.
    pub fn axes<D: Real>(&self, point: Vector3<D>, normal: Vector3<D>) -> Option<Axes<D>> {
        let tangent = tangential(self.lines.direction(point), normal);
        let (sin, cos) = self.turn.sin_cos();
        let turned =
            scaled(&tangent, constant(cos)) + scaled(&cross(&normal, &tangent), constant(sin));
        Axes::along(turned, normal)
    }
}

impl Lines {
    /// Returns lines by a formula.
    pub fn own(field: impl DirectionField + 'static) -> Self {
        Self::Own(OwnLines::new(field))
    }

    /// Direction at a point: of unit length, shorter only close to the axis in relation
    /// to the distance from the axis's point.
    fn direction<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        match self {
            Self::Uniform(direction) => unit(constant3(direction)),
            Self::Axial(axis) => axis.along(),
            Self::Circumferential(axis) => axis.around(point),
            Self::Radial(axis) => axis.away(point),
            Self::Own(own) => own.direction(point),
        }
    }

    /// Returns the axis that the lines are about, if there is one.
    pub fn axis(&self) -> Option<Axis> {
        match self {
            Self::Uniform(_) => None,
            Self::Circumferential(axis) | Self::Axial(axis) | Self::Radial(axis) => Some(*axis),
            Self::Own(own) => own.axis(),
        }
    }

    /// Returns the axis on which the lines have no direction, if there is one.
    pub fn pole(&self) -> Option<Axis> {
        match self {
            Self::Axial(_) => None,
            lines => lines.axis(),
        }
    }
}

impl Paint {
    /// Returns the lines with the rotation [`TURN`] of values, none where they have none.
    pub fn lines(lines: Lines, values: &Values) -> Self {
        let turn = values.number_if_any(TURN.name).unwrap_or(0.0).to_radians();
        Self::Field(Field { lines, turn })
    }
}

/// Directions at places.
pub static PAINTED: Declared<Paint> = Declared {
    name: "painted",
    summary: "Directions at chosen places, interpolated between them.",
    parameters: &[
        Parameter::tables("points", &POINT, "The places and their directions."),
        Parameter::number("width", POSITIVE, LENGTH, "Width of the interpolation.").or(
            Absent::Otherwise(
                "a quarter of the largest distance over the surface, which suits about five places",
            ),
        ),
    ],
    build: |values| {
        let points = values.tables("points").iter();
        let point = |one: &Values| (one.array("at").into(), one.array("direction").into());
        Ok(Paint::Points {
            directions: points.map(point).collect(),
            width: values.number_if_any("width"),
        })
    },
    fit: None,
};

static POINT: Set = Set {
    doc: "A direction at a place.",
    parameters: &[
        Parameter::several(
            "at",
            3,
            ANY,
            LENGTH,
            "The place; the nearest node of the surface is painted.",
        ),
        Parameter::direction(
            "direction",
            "The direction, of any length; its tangential part is used.",
        ),
    ],
};

/// Directions at all nodes.
pub static NODAL: Declared<Paint> = Declared {
    name: "nodal",
    summary: "A direction at every node of the surface.",
    parameters: &[Parameter::vectors(
        "directions",
        "",
        "Directions in ascending order of the nodes; their tangential part is used.",
    )],
    build: |values| {
        let directions = values.vectors("directions").iter();
        Ok(Paint::Nodal(directions.map(|one| (*one).into()).collect()))
    },
    fit: None,
};

/// Origin of the directions of a texture.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Paint {
    /// A field in space.
    Field(Field),
    /// A direction at every node of the surface, in the order of the nodes.
    Nodal(Vec<Vec3>),
    /// Directions at chosen places, interpolated in between.
    Points {
        /// Place and direction; the node nearest to the place is painted.
        directions: Vec<(Vec3, Vec3)>,
        /// Width `beta` of the interpolation; `None`: a quarter of the diameter of the
        /// edge graph, which suits about five places. Many places need less: half
        /// their spacing is safe on a regular grid of them.
        width: Option<f64>,
    },
    /// Directions at chosen nodes, interpolated in between.
    Nodes {
        /// Surface-local node and direction.
        directions: Vec<(SurfaceNode, Vec3)>,
        /// Width `beta` of the interpolation; `None`: a quarter of the diameter of the
        /// edge graph, which suits about five places. Many places need less: half
        /// their spacing is safe on a regular grid of them.
        width: Option<f64>,
    },
}

impl Paint {
    /// Unit tangential direction at every node.
    pub(super) fn directions(
        &self,
        positions: &[Vec3],
        facets: &[[SurfaceNode; 4]],
        normals: &[Vec3],
    ) -> Result<(Vec<Vec3>, Conditioning), TextureError> {
        let (places, width) = match self {
            Self::Field(field) => {
                let axes = positions
                    .iter()
                    .zip(normals)
                    .map(|(x, n)| field.axes(*x, *n));
                return Ok((units(axes)?, Conditioning::Given));
            }
            Self::Nodal(directions) => {
                count(directions, positions)?;
                let axes = (directions.iter().zip(normals)).map(|(v, n)| Axes::along(unit(*v), *n));
                return Ok((units(axes)?, Conditioning::Given));
            }
            Self::Points { directions, width } => (nearest(directions, positions), *width),
            Self::Nodes { directions, width } => (directions.clone(), *width),
        };
        let places = made_tangential(&places, normals)?;
        let graph = EdgeGraph::new(positions, facets);
        let (directions, conditioning) = interpolate(&graph, &places, width)?;
        let axes = (directions.iter().zip(normals)).map(|(v, n)| Axes::along(*v, *n));
        Ok((units(axes)?, conditioning))
    }
}

/// Painted nodes with unit tangential directions; each node at most once.
fn made_tangential(
    places: &[(SurfaceNode, Vec3)],
    normals: &[Vec3],
) -> Result<Vec<(SurfaceNode, Vec3)>, TextureError> {
    let nodes = normals.len();
    let mut painted = vec![false; nodes];
    (places.iter())
        .map(|&(node, direction)| {
            let normal =
                *(normals.get(node.index())).ok_or(TextureError::MissingNode { node, nodes })?;
            if std::mem::replace(&mut painted[node], true) {
                return Err(TextureError::PaintedTwice { node });
            }
            let axes = Axes::along(unit(direction), normal);
            Ok((node, axes.ok_or(TextureError::Vanishing { node })?.s))
        })
        .collect()
}

/// Nearest node of each place; of equally near ones that of least coordinates, whatever
/// the numbering.
fn nearest(directions: &[(Vec3, Vec3)], positions: &[Vec3]) -> Vec<(SurfaceNode, Vec3)> {
    let key = |place: &Vec3, x: &Vec3| [(x - place).norm_squared(), x.x, x.y, x.z];
    (directions.iter())
        .filter_map(|(place, direction)| {
            let (node, _) = positions.iter().enumerate().min_by(|(_, x), (_, y)| {
                let pairs = key(place, x).into_iter().zip(key(place, y));
                pairs.fold(std::cmp::Ordering::Equal, |order, (x, y)| {
                    order.then(x.total_cmp(&y))
                })
            })?;
            Some((SurfaceNode::new(node), *direction))
        })
        .collect()
}

/// The directions `s` of all nodes, or the first node that has none.
fn units(axes: impl Iterator<Item = Option<Axes<f64>>>) -> Result<Vec<Vec3>, TextureError> {
    axes.enumerate()
        .map(|(node, axes)| match axes {
            Some(axes) => Ok(axes.s),
            None => Err(TextureError::Vanishing {
                node: SurfaceNode::new(node),
            }),
        })
        .collect()
}

fn count(directions: &[Vec3], positions: &[Vec3]) -> Result<(), TextureError> {
    let (found, nodes) = (directions.len(), positions.len());
    if found == nodes {
        return Ok(());
    }
    Err(TextureError::Count {
        what: "directions",
        found,
        nodes,
    })
}
