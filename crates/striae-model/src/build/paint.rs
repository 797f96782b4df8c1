//! Textures that are fields in space.

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

fn axis(point: impl Into<Vec3>, direction: impl Into<Vec3>) -> Axis {
    Axis {
        point: point.into(),
        direction: direction.into(),
    }
}

fn field(lines: Lines) -> Paint {
    Paint::Field(Field { lines, turn: 0.0 })
}
