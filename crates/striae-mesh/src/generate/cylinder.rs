//! A solid round cylinder, or a quarter of it.
//!
//! The section is a disc of quadrangles (see `disc.rs`), extruded along the axis.

use super::Grading;
use super::disc::{Disc, Sector};
use super::generator::{Generate, Generator};
use super::grading::{EQUAL, GRADING};
use super::grid::{all_positive, named_mesh};
use super::sweep::{Sweep, swept_elements};
use crate::{Mesh, MeshError, Vec3};
use nalgebra::Rotation3;
use std::f64::consts::PI;
use striae_declared::{Absent, Declared, LENGTH, POSITIVE, Parameter, Values};

/// The generator.
pub static CYLINDER: Declared<Generator> = Declared {
    name: "cylinder",
    summary: "A solid cylinder. Sets of nodes and facets: the round `side`, `zmin`, `zmax`, for a quarter also its planes of symmetry `xmin` and `ymin`; named before rotation.",
    parameters: &[
        Parameter::position("base", "Centre of the side `zmin`."),
        Parameter::direction("axis", "Axis from there, of any length.")
            .or(Absent::Numbers(&[0.0, 0.0, 1.0])),
        Parameter::number("radius", POSITIVE, LENGTH, "Radius.")
            .or_in_programs(&Absent::Number(1.0)),
        Parameter::number("height", POSITIVE, LENGTH, "Extent along the axis.")
            .or_in_programs(&Absent::Number(1.0)),
        Parameter::counts(
            "divisions",
            3,
            "Elements along half an edge of the square core, from the core to the side, and along the axis. A quarter turn has twice the first number.",
        )
        .or_in_programs(&Absent::Counts(&[2, 2, 4])),
        Parameter::table("axial_grading", &GRADING, "Interval lengths along the axis.").or(EQUAL),
        Parameter::word(
            "part",
            &[
                ("whole", "The whole cylinder."),
                (
                    "quarter",
                    "The quarter on the positive sides of the first two axes.",
                ),
            ],
            "Part of it that is meshed.",
        ),
    ],
    build: |values| Ok(Generator::of(Cylinder::stated(values))),
    fit: None,
};

/// A cylinder with sides `side` (round), `zmin`, `zmax`, named for the default axis; a
/// quarter has the planes of symmetry `xmin` and `ymin`, too. Defaults are those of [`CYLINDER`].
#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    /// Middle of the side `zmin`.
    pub base: Vec3,
    /// Axis from there, of any length but zero. One other than `z` turns the
    /// cylinder by the shortest way.
    pub axis: Vec3,
    /// Radius.
    pub radius: f64,
    /// Extent along the axis.
    pub height: f64,
    /// Elements along half an edge of the square core, from the core to the side, and
    /// along the axis. A quarter turn has twice the first number.
    pub divisions: [usize; 3],
    /// Interval lengths along the axis.
    pub axial_grading: Grading,
    /// Part of the cylinder that is meshed.
    pub sector: Sector,
}

impl Default for Cylinder {
    fn default() -> Self {
        Self::stated(&CYLINDER.completed(&Values::default()))
    }
}

impl Generate for Cylinder {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.mesh()
    }

    fn elements(&self) -> Option<u128> {
        Some(swept_elements(self.divisions, self.sector))
    }
}

impl Cylinder {
    fn stated(values: &Values) -> Self {
        Self {
            base: values.array("base").into(),
            axis: values.array("axis").into(),
            radius: values.number("radius"),
            height: values.number("height"),
            divisions: values.counts("divisions"),
            axial_grading: Grading::stated(values.table_if_any("axial_grading")),
            sector: match values.word("part") {
                "quarter" => Sector::Quarter,
                _ => Sector::Whole,
            },
        }
    }

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
