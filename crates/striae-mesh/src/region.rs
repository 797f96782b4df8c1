//! Regions of space that sets are made from.
//!
//! Borders belong to a region, and so do points outside of it by up to 1e-9 of its size, so
//! that nodes on a border are inside whatever their last digits.

use crate::Vec3;

/// By how much of its size a region is widened.
const MARGIN: f64 = 1e-9;

/// A region of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Region {
    /// A box along the axes.
    Box {
        /// Corner of smallest coordinates.
        from: Vec3,
        /// Corner of largest coordinates.
        to: Vec3,
    },
    /// A ball.
    Sphere {
        /// Its middle.
        centre: Vec3,
        /// Its radius.
        radius: f64,
    },
    /// A round cylinder without ends.
    Cylinder {
        /// A point of its axis.
        point: Vec3,
        /// Its axis, of any length but zero.
        axis: Vec3,
        /// Its radius.
        radius: f64,
    },
    /// All on one side of a plane.
    HalfSpace {
        /// A point of the plane.
        point: Vec3,
        /// Normal of any length but zero, out of the region.
        normal: Vec3,
    },
}

impl Region {
    /// Returns whether a point is in the region. `size` is a characteristic length of the mesh; it
    /// sets the margin of a half space, which has no size of its own.
    pub fn contains(&self, x: &Vec3, size: f64) -> bool {
        match *self {
            Self::Box { from, to } => {
                let margin = MARGIN * (to - from).norm();
                (0..3).all(|axis| (from[axis] - margin..=to[axis] + margin).contains(&x[axis]))
            }
            Self::Sphere { centre, radius } => (x - centre).norm() <= radius * (1.0 + MARGIN),
            Self::Cylinder {
                point,
                axis,
                radius,
            } => {
                let axis = axis.normalize();
                let off = x - point;
                (off - axis * axis.dot(&off)).norm() <= radius * (1.0 + MARGIN)
            }
            Self::HalfSpace { point, normal } => {
                (x - point).dot(&normal.normalize()) <= MARGIN * size
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn borders_belong_to_regions_whatever_their_last_digits() {
        let at = |x: f64, y: f64, z: f64| Vec3::new(x, y, z);
        let unit = at(1.0, 2.0, 2.0) / 3.0;
        let across = at(2.0, 1.0, -2.0) / 3.0;
        for (region, border, outward) in [
            (
                Region::Box {
                    from: at(-1.0, 0.0, 0.0),
                    to: at(0.3, 1.0, 2.0),
                },
                at(0.1 + 0.2, 0.5, 2.0),
                at(1.0, 0.0, 0.0),
            ),
            (
                Region::Sphere {
                    centre: at(1.0, 1.0, 1.0),
                    radius: 0.7,
                },
                at(1.0, 1.0, 1.0) + unit * 0.7,
                unit,
            ),
            (
                Region::Cylinder {
                    point: at(0.0, 5.0, 0.0),
                    axis: unit * 4.0,
                    radius: 0.7,
                },
                at(0.0, 5.0, 0.0) + unit * 31.0 + across * 0.7,
                across,
            ),
            (
                Region::HalfSpace {
                    point: at(1.0, 0.0, 0.0),
                    normal: unit * 2.0,
                },
                at(1.0, 0.0, 0.0) + across * 3.0,
                unit,
            ),
        ] {
            assert!(region.contains(&border, 1.0), "{region:?}");
            assert!(
                !region.contains(&(border + outward * 1e-6), 1.0),
                "{region:?}"
            );
            assert!(
                region.contains(&(border - outward * 1e-6), 1.0),
                "{region:?}"
            );
        }
    }
}
