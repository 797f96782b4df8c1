//! A solid round cylinder, or a quarter of it.
//!
//! The section is a disc of quadrangles (see `disc.rs`), extruded along the axis.

use super::Grading;
use super::disc::{Disc, Sector};
use super::grid::{all_positive, named_mesh};
use super::sweep::Sweep;
use crate::{Mesh, MeshError, Vec3};
use nalgebra::Rotation3;
use std::f64::consts::PI;

/// A cylinder with sides `side` (round), `zmin`, `zmax`, named for the default axis; a
/// quarter has the planes of symmetry `xmin` and `ymin`, too.
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    /// Middle of the side `zmin`; default the origin.
    pub base: Vec3,
    /// Axis from there, of any length but zero; default `z`. Another axis turns the
    /// cylinder by the shortest way.
    pub axis: Vec3,
    /// Radius; default 1.
    pub radius: f64,
    /// Extent along the axis; default 1.
    pub height: f64,
    /// Elements along half an edge of the square core, from the core to the side, and
    /// along the axis; default 2, 2, 4. A quarter turn has twice the first number.
    pub divisions: [usize; 3],
    /// Interval lengths along the axis; default uniform.
    pub axial_grading: Grading,
    /// Part of the cylinder that is meshed; all of it by default.
    pub sector: Sector,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self {
            base: Vec3::zeros(),
            axis: Vec3::z(),
            radius: 1.0,
            height: 1.0,
            divisions: [2, 2, 4],
            axial_grading: Grading::Uniform,
            sector: Sector::Whole,
        }
    }
}

impl Cylinder {
    /// The mesh.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] or [`MeshError::IntervalCount`] for parameters out of
    /// range.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        let positive = [
            ("radius", self.radius),
            ("height", self.height),
            ("length of the axis", self.axis.norm()),
        ];
        all_positive(&positive)?;
        let [core, band, layers] = self.divisions;
        let disc = Disc {
            radius: self.radius,
            core,
            band,
            sector: self.sector,
        };
        let sweep = Sweep::along(&disc, layers)?;
        let heights = self.axial_grading.nodes(layers)?;
        let turn = Rotation3::rotation_between(&Vec3::z(), &self.axis)
            .unwrap_or_else(|| Rotation3::from_axis_angle(&Vec3::x_axis(), PI));
        let positions = sweep.positions(|[x, y], layer| {
            self.base + turn * Vec3::new(x, y, self.height * heights[layer])
        });
        let mut sides = vec![
            ("side", sweep.faces(&disc.circle())),
            ("zmin", sweep.first()),
            ("zmax", sweep.last()),
        ];
        if self.sector == Sector::Quarter {
            let [xmin, ymin] = disc.planes();
            sides.push(("xmin", sweep.faces(&xmin)));
            sides.push(("ymin", sweep.faces(&ymin)));
        }
        named_mesh(positions, sweep.elements(), sides)
    }
}
