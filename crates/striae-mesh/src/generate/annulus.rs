//! A ring of rectangular section, such as a tyre.
//!
//! A point of the ring lies at `r (sin psi, -cos psi)` in the plane across the
//! axis, `psi` counted from the lowest point. Sizes along the circumference
//! follow `s(psi) = 1` up to `|psi| = beta` and `1 + (q - 1) (|psi| - beta) / (pi - beta)`
//! beyond: nodes are equally spaced in `t = int dpsi / s`, which has a closed
//! form with a closed inverse.

use super::Grading;
use super::generator::{Generate, Generator, lattice_nodes, product};
use super::grading::{EQUAL, GRADING};
use super::grid::{Closure, Grid, Side, all_positive, goes_around, named_mesh};
use crate::{Face, Mesh, MeshError, Vec3};
use nalgebra::Rotation3;
use std::f64::consts::PI;
use striae_declared::{
    Absent, Bound, Declared, LENGTH, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Set, Values,
};

/// The generator.
pub static ANNULUS: Declared<Generator> = Declared {
    name: "annulus",
    summary: "A ring about an axis. Sets of nodes and facets: `rim` inside, `tread` outside, the plane sides `ymin`, `ymax` and both of them, `sides`.",
    parameters: &[
        Parameter::position("centre", "Centre of the ring."),
        Parameter::direction("axis", "Axis of any length.").or(Absent::Numbers(&[0.0, 1.0, 0.0])),
        Parameter::number("inner_radius", POSITIVE, LENGTH, "Inner radius.")
            .or_in_programs(&Absent::Number(0.2)),
        Parameter::number("outer_radius", POSITIVE, LENGTH, "Outer radius.")
            .or_in_programs(&Absent::Number(0.5)),
        Parameter::number("width", POSITIVE, LENGTH, "Width along the axis.")
            .or_in_programs(&Absent::Number(0.4)),
        Parameter::counts(
            "divisions",
            3,
            "Elements along the radius, the circumference and the axis.",
        )
        .or_in_programs(&Absent::Counts(&[3, 48, 4])),
        Parameter::table(
            "radial_grading",
            &GRADING,
            "Interval lengths from the inner to the outer radius.",
        )
        .or(EQUAL),
        Parameter::table(
            "axial_grading",
            &GRADING,
            "Interval lengths along the axis.",
        )
        .or(EQUAL),
        Parameter::table(
            "refinement",
            &REFINEMENT,
            "Smaller elements around the lowest point.",
        )
        .or(Absent::Nothing),
    ],
    build: |values| Ok(Generator::of(Annulus::stated(values))),
    fit: None,
};

static REFINEMENT: Set = Set {
    doc: "Smaller elements around the lowest point of a ring.",
    parameters: &[
        Parameter::number(
            "half_angle",
            NOT_NEGATIVE,
            "degrees",
            "Angle to either side of the lowest point within which the size is smallest.",
        ),
        Parameter::number(
            "ratio",
            &[Bound::AtLeast(1.0)],
            NO_UNIT,
            "Size at the highest point over the size at the lowest.",
        ),
    ],
};

/// A ring with sides `rim` (inside), `tread` (outside), `ymin`, `ymax` (the
/// two plane sides, named for the default axis) and `sides` (both). Defaults are those of [`ANNULUS`].
#[derive(Clone, Debug, PartialEq)]
pub struct Annulus {
    /// Middle of the ring.
    pub centre: Vec3,
    /// Axis, of any length but zero. One other than `y` turns the ring
    /// by the shortest way, a horizontal one leaves the lowest point lowest.
    pub axis: Vec3,
    /// Inner radius.
    pub inner_radius: f64,
    /// Outer radius.
    pub outer_radius: f64,
    /// Extent along the axis.
    pub width: f64,
    /// Elements along radius, circumference (at least 3) and axis.
    pub divisions: [usize; 3],
    /// Interval lengths from the inner to the outer radius.
    pub radial_grading: Grading,
    /// Interval lengths along the axis.
    pub axial_grading: Grading,
    /// Smaller elements around the lowest point.
    pub refinement: Option<Refinement>,
}

/// Smaller elements around the lowest point of a ring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinement {
    /// Angle in degrees to either side of the lowest point within which the
    /// size is smallest and uniform.
    pub half_angle: f64,
    /// Size at the highest point over that at the lowest; 1 is uniform.
    pub ratio: f64,
}

impl Default for Annulus {
    fn default() -> Self {
        Self::stated(&ANNULUS.completed(&Values::default()))
    }
}

impl Generate for Annulus {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.mesh()
    }

    fn elements(&self) -> Option<u128> {
        Some(product(&self.divisions))
    }

    fn nodes(&self) -> Option<u128> {
        Some(lattice_nodes(&self.divisions))
    }
}

impl Annulus {
    fn stated(values: &Values) -> Self {
        let refinement = values.table_if_any("refinement");
        Self {
            centre: values.array("centre").into(),
            axis: values.array("axis").into(),
            inner_radius: values.number("inner_radius"),
            outer_radius: values.number("outer_radius"),
            width: values.number("width"),
            divisions: values.counts("divisions"),
            radial_grading: Grading::stated(values.table_if_any("radial_grading")),
            axial_grading: Grading::stated(values.table_if_any("axial_grading")),
            refinement: refinement.map(|values| Refinement {
                half_angle: values.number("half_angle"),
                ratio: values.number("ratio"),
            }),
        }
    }

    /// The mesh.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] or [`MeshError::IntervalCount`] for parameters
    /// out of range.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        self.check_parameters()?;
        let [radial, around, axial] = self.divisions;
        let grid = Grid::new([radial, axial, around], 1, Closure::Ring)?;
        let radii = self.radial_grading.nodes(radial)?;
        let depths = self.axial_grading.nodes(axial)?;
        let angles = self.angles();
        let turn = Rotation3::rotation_between(&Vec3::y(), &self.axis)
            .unwrap_or_else(|| Rotation3::from_axis_angle(&Vec3::z_axis(), PI));
        let positions = grid.positions(|[i, j, k]| {
            let r = self.inner_radius + radii[i] * (self.outer_radius - self.inner_radius);
            let y = self.width * (depths[j] - 0.5);
            let (sin, cos) = angles[k].sin_cos();
            self.centre + turn * Vec3::new(r * sin, y, -r * cos)
        });
        let [ymin, ymax] = [grid.faces(Side::FirstJ), grid.faces(Side::LastJ)];
        let both: Vec<Face> = ymin.iter().chain(&ymax).copied().collect();
        let sides = [
            ("rim", grid.faces(Side::FirstI)),
            ("tread", grid.faces(Side::LastI)),
            ("ymin", ymin),
            ("ymax", ymax),
            ("sides", both),
        ];
        named_mesh(positions, grid.elements(), sides)
    }

    fn check_parameters(&self) -> Result<(), MeshError> {
        let positive = [
            ("inner radius", self.inner_radius),
            (
                "thickness of the ring",
                self.outer_radius - self.inner_radius,
            ),
            ("width", self.width),
            ("length of the axis", self.axis.norm()),
        ];
        all_positive(&positive)?;
        goes_around(self.divisions[1])?;
        let Some(Refinement { half_angle, ratio }) = self.refinement else {
            return Ok(());
        };
        MeshError::require(
            (0.0..180.0).contains(&half_angle),
            "half angle of the refinement",
            half_angle,
            "it must be at least 0 and less than 180",
        )?;
        let ratio_fits = ratio >= 1.0 && ratio.is_finite();
        MeshError::require(
            ratio_fits,
            "ratio of the refinement",
            ratio,
            "it must be at least 1",
        )
    }

    /// Angles from the lowest point, a node at 0.
    fn angles(&self) -> Vec<f64> {
        let count = self.divisions[1];
        let refinement = self.refinement.unwrap_or(Refinement {
            half_angle: 0.0,
            ratio: 1.0,
        });
        let to_top = refinement.spacing(PI);
        (0..count)
            .map(|k| {
                let share = 2.0 * k as f64 / count as f64;
                if share <= 1.0 {
                    refinement.angle(share * to_top)
                } else {
                    -refinement.angle((2.0 - share) * to_top)
                }
            })
            .collect()
    }
}

impl Refinement {
    /// `t(psi) = int_0^psi dpsi / s` for `psi >= 0`.
    fn spacing(&self, psi: f64) -> f64 {
        let beta = self.half_angle.to_radians();
        let slope = self.slope();
        if psi <= beta || slope == 0.0 {
            return psi;
        }
        beta + (slope * (psi - beta)).ln_1p() / slope
    }

    /// The inverse of [`Refinement::spacing`].
    fn angle(&self, t: f64) -> f64 {
        let beta = self.half_angle.to_radians();
        let slope = self.slope();
        if t <= beta || slope == 0.0 {
            return t;
        }
        beta + (slope * (t - beta)).exp_m1() / slope
    }

    fn slope(&self) -> f64 {
        (self.ratio - 1.0) / (PI - self.half_angle.to_radians())
    }
}
