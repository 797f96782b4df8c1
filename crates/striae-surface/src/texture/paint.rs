//! Painting of a texture on the reference surface.
//!
//! A [`Field`] has a value at every point of space and a nodal field at every node;
//! directions at a few places are carried over the surface by interpolation along its
//! edges. Directions need not be tangential nor of unit length: the unit vector of their
//! tangential part counts.

use nalgebra::Vector3;
use serde::Serialize;
use striae_mesh::Vec3;

use super::axes::tangential;
use super::radial_basis::interpolate;
use super::{Axes, Conditioning, TextureError};
use crate::{
    graph::EdgeGraph,
    node::SurfaceNode,
    scalar::{Real, constant, constant3, cross, dot, normalised, scaled},
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

/// A field of directions in space, made tangential to whatever surface it meets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Field {
    /// Its lines.
    pub lines: Lines,
    /// Angle by which the tangential direction is turned about the outward normal,
    /// counter-clockwise seen from outside (radians).
    pub turn: f64,
}

/// Lines of a field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum Lines {
    /// One direction everywhere.
    Uniform(Vec3),
    /// Circles about an axis, by the right-hand rule.
    Circumferential(Axis),
    /// Parallels of an axis, along its direction.
    Axial(Axis),
    /// Rays from an axis outwards.
    Radial(Axis),
}

/// An axis in space.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// A point of it.
    pub point: Vec3,
    /// Its direction, of any length.
    pub direction: Vec3,
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
    /// Direction at a point: of unit length, shorter only close to the axis in relation
    /// to the distance from the axis's point.
    fn direction<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        match self {
            Self::Uniform(direction) => unit(constant3(direction)),
            Self::Axial(axis) => axis.along(),
            Self::Circumferential(axis) => cross(&axis.along(), &axis.towards(point)),
            Self::Radial(axis) => tangential(axis.towards(point), axis.along()),
        }
    }
}

impl Axis {
    fn along<D: Real>(&self) -> Vector3<D> {
        unit(constant3(&self.direction))
    }

    fn towards<D: Real>(&self, point: Vector3<D>) -> Vector3<D> {
        unit(point - constant3(&self.point))
    }
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

/// The vector at unit length; zero stays zero.
fn unit<D: Real>(vector: Vector3<D>) -> Vector3<D> {
    if dot(&vector, &vector).re() > 0.0 {
        normalised(&vector)
    } else {
        vector
    }
}
