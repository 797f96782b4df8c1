//! A ring of round section, such as an O-ring.
//!
//! The section is a disc of quadrangles (see `disc.rs`), its first axis pointing away from
//! the axis of the ring and its second one along it, swept around.

use super::disc::{Disc, Sector};
use super::generator::{Generate, Generator};
use super::grid::{all_positive, goes_around, named_mesh};
use super::sweep::{Sweep, swept_elements};
use crate::{Mesh, MeshError, Vec3};
use nalgebra::Rotation3;
use std::f64::consts::{PI, TAU};
use striae_declared::{Absent, Declared, LENGTH, POSITIVE, Parameter, Values};

/// The generator.
pub static TORUS: Declared<Generator> = Declared {
    name: "torus",
    summary: "A ring of round section. Set of nodes and facets: `surface`.",
    parameters: &[
        Parameter::position("centre", "Centre of the ring."),
        Parameter::direction("axis", "Axis of any length.")
            .or(Absent::Numbers(&[0.0, 0.0, 1.0])),
        Parameter::number(
            "ring_radius",
            POSITIVE,
            LENGTH,
            "Radius of the circle on which the centres of the sections lie.",
        )
        .or_in_programs(&Absent::Number(4.0)),
        Parameter::number("section_radius", POSITIVE, LENGTH, "Radius of the section.")
            .or_in_programs(&Absent::Number(1.0)),
        Parameter::counts(
            "divisions",
            3,
            "Elements along half an edge of the square core of the section, from the core to the surface, and around the axis. The section has eight times the first number around.",
        )
        .or_in_programs(&Absent::Counts(&[2, 2, 24])),
    ],
    build: |values| Ok(Generator::of(Torus::stated(values))),
    fit: None,
};

/// A ring with the side `surface`. Defaults are those of [`TORUS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Torus {
    /// Middle of the ring.
    pub centre: Vec3,
    /// Axis, of any length but zero. One other than `z` turns the ring by the
    /// shortest way.
    pub axis: Vec3,
    /// Radius of the circle on which the middles of the sections lie.
    pub ring_radius: f64,
    /// Radius of the section.
    pub section_radius: f64,
    /// Elements along half an edge of the square core of the section, from the core to
    /// the surface, and around the axis (at least 3). The section has
    /// eight times the first number around.
    pub divisions: [usize; 3],
}

impl Default for Torus {
    fn default() -> Self {
        Self::stated(&TORUS.completed(&Values::default()))
    }
}

impl Generate for Torus {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.mesh()
    }

    fn elements(&self) -> Option<u128> {
        Some(swept_elements(self.divisions, Sector::Whole))
    }
}

impl Torus {
    fn stated(values: &Values) -> Self {
        Self {
            centre: values.array("centre").into(),
            axis: values.array("axis").into(),
            ring_radius: values.number("ring_radius"),
            section_radius: values.number("section_radius"),
            divisions: values.counts("divisions"),
        }
    }

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
