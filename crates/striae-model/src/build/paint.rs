//! Textures: fields in space, or directions at places and nodes.

use striae_mesh::Vec3;
use striae_surface::texture::{Axis, Field, Lines, Paint};

/// Lines along one direction.
pub fn uniform(direction: impl Into<Vec3>) -> Paint {
    field(Lines::Uniform(direction.into()))
}

/// Circles about the axis through a point.
pub fn circumferential(point: impl Into<Vec3>, direction: impl Into<Vec3>) -> Paint {
    field(Lines::Circumferential(axis(point, direction)))
}

/// Parallels of the axis through a point.
pub fn axial(point: impl Into<Vec3>, direction: impl Into<Vec3>) -> Paint {
    field(Lines::Axial(axis(point, direction)))
}

/// Rays away from the axis through a point.
pub fn radial(point: impl Into<Vec3>, direction: impl Into<Vec3>) -> Paint {
    field(Lines::Radial(axis(point, direction)))
}

/// Directions at chosen places, interpolated in between: the node nearest to each place
/// is painted. `width` is that of the interpolation, see [`Paint::Points`].
pub fn painted(directions: Vec<(Vec3, Vec3)>, width: Option<f64>) -> Paint {
    Paint::Points { directions, width }
}

/// A direction at every node of the surface, in ascending order of the nodes.
pub fn nodal(directions: Vec<Vec3>) -> Paint {
    Paint::Nodal(directions)
}

/// The lines of a field turned about the outward normal by an angle in degrees,
/// counter-clockwise seen from outside. What is painted at places or nodes stays.
pub fn turned(paint: Paint, degrees: f64) -> Paint {
    match paint {
        Paint::Field(field) => Paint::Field(Field {
            turn: field.turn + degrees.to_radians(),
            ..field
        }),
        other => other,
    }
}

fn axis(point: impl Into<Vec3>, direction: impl Into<Vec3>) -> Axis {
    Axis {
        point: point.into(),
        direction: direction.into(),
    }
}

fn field(lines: Lines) -> Paint {
    Paint::Field(Field { lines, turn: 0.0 })
}
