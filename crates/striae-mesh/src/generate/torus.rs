//! A ring of round section, such as an O-ring.
//!
//! The section is a disc of quadrangles (see `disc.rs`), its first axis pointing away from
//! the axis of the ring and its second one along it, swept around.

use super::disc::{Disc, Sector};
use super::grid::{all_positive, goes_around, named_mesh};
use super::sweep::Sweep;
use crate::{Mesh, MeshError, Vec3};
use nalgebra::Rotation3;
use std::f64::consts::{PI, TAU};

/// A ring with the side `surface`.
#[derive(Clone, Debug, PartialEq)]
pub struct Torus {
    /// Middle of the ring; default the origin.
    pub centre: Vec3,
    /// Axis, of any length but zero; default `z`. Another axis turns the ring by the
    /// shortest way.
    pub axis: Vec3,
    /// Radius of the circle on which the middles of the sections lie; default 4.
    pub ring_radius: f64,
    /// Radius of the section; default 1.
    pub section_radius: f64,
    /// Elements along half an edge of the square core of the section, from the core to
    /// the surface, and around the axis (at least 3); default 2, 2, 24. The section has
    /// eight times the first number around.
    pub divisions: [usize; 3],
}

impl Default for Torus {
    fn default() -> Self {
        Self {
            centre: Vec3::zeros(),
            axis: Vec3::z(),
            ring_radius: 4.0,
            section_radius: 1.0,
            divisions: [2, 2, 24],
        }
    }
}

impl Torus {
    /// The mesh.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] for parameters out of range.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        let [core, band, around] = self.divisions;
        let positive = [
            ("radius of the section", self.section_radius),
            ("radius of the hole", self.ring_radius - self.section_radius),
            ("length of the axis", self.axis.norm()),
        ];
        all_positive(&positive)?;
        goes_around(around)?;
        let disc = Disc {
            radius: self.section_radius,
            core,
            band,
            sector: Sector::Whole,
        };
        let sweep = Sweep::around(&disc, around)?;
        let turn = Rotation3::rotation_between(&Vec3::z(), &self.axis)
            .unwrap_or_else(|| Rotation3::from_axis_angle(&Vec3::x_axis(), PI));
        let positions = sweep.positions(|[x, y], layer| {
            // Sections follow clockwise, so that elements are not inside out.
            let (sin, cos) = (-TAU * layer as f64 / around as f64).sin_cos();
            let r = self.ring_radius + x;
            self.centre + turn * Vec3::new(r * cos, r * sin, y)
        });
        let surface = sweep.faces(&disc.circle());
        named_mesh(positions, sweep.elements(), [("surface", surface)])
    }
}
