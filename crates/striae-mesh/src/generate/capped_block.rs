//! A block whose lower side is part of a sphere.
//!
//! In plan a rectangle about the apex, from `z = 0` at the apex to the plane
//! upper side at `z = height`. With `r` the distance from the middle axis the
//! lower side is `z_cap = R - sqrt(R^2 - r^2)`, and a node at the share `s` of
//! its column lies at `z = z_cap + s (height - z_cap)`: nodes of the cap are on
//! the sphere. Elements have the wanted size at the apex and grow away from
//! it, see [`refined_lengths`].
//!
//! Cells of other kinds are made by dividing the hexahedra at `(x, y, s)`, so that nodes in
//! the middles of edges lie on the sphere as well.

use super::division::{CELLS, Division, cells, nodes, parts};
use super::generator::{Generate, Generator, product};
use super::grading::{mirrored, refined_lengths, unit_partial_sums};
use super::grid::{Closure, Grid, Side, named_mesh};
use crate::{CellKind, Mesh, MeshError, Vec3};
use striae_declared::{
    Absent, Bound, Declared, LENGTH, NO_UNIT, NOT_NEGATIVE, POSITIVE, Parameter, Values,
};

/// The generator.
pub static CAPPED_BLOCK: Declared<Generator> = Declared {
    name: "capped-block",
    summary: "A block whose lower side is a spherical cap, finer around its lowest point. Sets of nodes and facets: `xmin`, `xmax`, `ymin`, `ymax`, `cap`, `zmax`.",
    parameters: &[
        Parameter::position("apex", "Lowest point."),
        Parameter::several(
            "size",
            2,
            POSITIVE,
            LENGTH,
            "Edge lengths along the first two axes.",
        )
        .or_in_programs(&Absent::Numbers(&[10.0; 2])),
        Parameter::number(
            "height",
            POSITIVE,
            LENGTH,
            "Height from the lowest point to the upper side.",
        )
        .or_in_programs(&Absent::Number(6.5)),
        Parameter::number("radius", POSITIVE, LENGTH, "Radius of the sphere.")
            .or_in_programs(&Absent::Number(12.0)),
        Parameter::number(
            "element_size",
            POSITIVE,
            LENGTH,
            "Element size at the lowest point.",
        )
        .or_in_programs(&Absent::Number(0.8)),
        Parameter::number(
            "fine_half_width",
            NOT_NEGATIVE,
            LENGTH,
            "Half the width of the zone with elements of this size.",
        )
        .or(Absent::Computed("2 element_size", |values| {
            2.0 * values.number("element_size")
        })),
        Parameter::number(
            "fine_depth",
            NOT_NEGATIVE,
            LENGTH,
            "Depth of the zone with elements of this size.",
        )
        .or(Absent::Number(0.0)),
        Parameter::number(
            "growth",
            &[Bound::AtLeast(1.0)],
            NO_UNIT,
            "Largest ratio of neighbouring sizes outside that zone.",
        )
        .or(Absent::Number(1.3)),
        Parameter::word(
            "part",
            &[
                ("whole", "The whole block."),
                (
                    "half",
                    "The half on the positive side of the second axis; `ymin` is then the plane of symmetry.",
                ),
            ],
            "Part of it that is meshed.",
        ),
        CELLS,
    ],
    build: |values| Ok(Generator::of(CappedBlock::stated(values))),
    fit: None,
};

/// A block on a spherical cap, with sides `xmin xmax ymin ymax cap zmax`. Defaults are those of
/// [`CAPPED_BLOCK`].
#[derive(Clone, Debug, PartialEq)]
pub struct CappedBlock {
    /// Lowest point.
    pub apex: Vec3,
    /// Edges of the plan along `x` and `y`.
    pub size: [f64; 2],
    /// From the apex to the upper side.
    pub height: f64,
    /// Radius of the sphere.
    pub radius: f64,
    /// Element size at the apex.
    pub element_size: f64,
    /// Half edge of the square around the apex with elements of this size in
    /// plan.
    pub fine_half_width: f64,
    /// Depth to which elements have this height at the apex.
    pub fine_depth: f64,
    /// Largest ratio of neighbouring sizes outside.
    pub growth: f64,
    /// Part of the block that is meshed.
    pub part: Part,
    /// Kind of cell that the hexahedra are divided into. Wedges extend along `z`.
    pub cells: CellKind,
}

/// Part of a block that is meshed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// All of it.
    Whole,
    /// Half with `y >= 0` as seen from the apex; its side `ymin` is the plane of symmetry.
    Half,
}

impl Default for CappedBlock {
    fn default() -> Self {
        Self::stated(&CAPPED_BLOCK.completed(&Values::default()))
    }
}

impl Generate for CappedBlock {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.mesh()
    }

    fn elements(&self) -> Option<u128> {
        let hexahedra = product(&self.divisions()?);
        Some(hexahedra.saturating_mul(parts(self.cells) as u128))
    }

    fn nodes(&self) -> Option<u128> {
        Some(nodes(self.cells, &self.divisions()?))
    }
}

/// Ratio of the height at the corners to the rise of the cap below which it counts as zero.
const FLAT: f64 = 1e-6;

impl CappedBlock {
    fn stated(values: &Values) -> Self {
        Self {
            apex: values.array("apex").into(),
            size: values.array("size"),
            height: values.number("height"),
            radius: values.number("radius"),
            element_size: values.number("element_size"),
            fine_half_width: values.number("fine_half_width"),
            fine_depth: values.number("fine_depth"),
            growth: values.number("growth"),
            part: match values.word("part") {
                "half" => Part::Half,
                _ => Part::Whole,
            },
            cells: cells(values),
        }
    }

    /// The mesh.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] for parameters out of range, in particular a
    /// sphere that does not reach the edges of the plan.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        self.check_parameters()?;
        let [x_lengths, y_lengths] = self.plan_lengths()?;
        let (y_start, y_extent) = match self.part {
            Part::Whole => (-0.5 * self.size[1], self.size[1]),
            Part::Half => (0.0, 0.5 * self.size[1]),
        };
        let z_lengths =
            refined_lengths(self.height, self.fine_depth, self.element_size, self.growth)?;
        let grid = Grid::new(
            [x_lengths.len(), y_lengths.len(), z_lengths.len()],
            parts(self.cells),
            Closure::Open,
        )?;
        let [x, y, s] = [&x_lengths, &y_lengths, &z_lengths].map(|l| unit_partial_sums(l));
        let mut positions = grid.positions(|[i, j, k]| {
            let x = self.size[0] * (x[i] - 0.5);
            Vec3::new(x, y_start + y_extent * y[j], s[k])
        });
        let sides = [
            ("xmin", grid.faces(Side::FirstI)),
            ("xmax", grid.faces(Side::LastI)),
            ("ymin", grid.faces(Side::FirstJ)),
            ("ymax", grid.faces(Side::LastJ)),
            ("cap", grid.faces(Side::FirstK)),
            ("zmax", grid.faces(Side::LastK)),
        ];
        let division = Division::new(grid.elements(), self.cells, &mut positions);
        let sides = sides.map(|(name, faces)| (name, division.faces(&faces)));
        let positions = positions.into_iter().map(|x| {
            let cap = sagitta(self.radius, x.x * x.x + x.y * x.y);
            self.apex + Vec3::new(x.x, x.y, cap + x.z * (self.height - cap))
        });
        named_mesh(positions.collect(), division.cells, sides)
    }

    /// Interval lengths of the plan along `x` and `y`, for a commensurate
    /// foundation under the block.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] as [`refined_lengths`].
    pub fn plan_lengths(&self) -> Result<[Vec<f64>; 2], MeshError> {
        let [x, y] = self.size.map(|size| {
            refined_lengths(
                0.5 * size,
                self.fine_half_width,
                self.element_size,
                self.growth,
            )
        });
        Ok(match self.part {
            Part::Whole => [mirrored(&x?), mirrored(&y?)],
            Part::Half => [mirrored(&x?), y?],
        })
    }

    /// Numbers of hexahedra along the axes; `None` for parameters out of range.
    fn divisions(&self) -> Option<[usize; 3]> {
        let [x, y] = self.plan_lengths().ok()?;
        let z = refined_lengths(self.height, self.fine_depth, self.element_size, self.growth);
        Some([x.len(), y.len(), z.ok()?.len()])
    }

    fn check_parameters(&self) -> Result<(), MeshError> {
        for size in self.size {
            MeshError::require(size > 0.0, "size", size, "it must be positive")?;
        }
        let half_diagonal = 0.5 * self.size[0].hypot(self.size[1]);
        MeshError::require(
            self.radius > half_diagonal,
            "radius",
            self.radius,
            "it must exceed half the diagonal of the plan",
        )?;
        let rise = sagitta(self.radius, half_diagonal.powi(2));
        // Elements of hardly any height would be degenerate by round-off.
        if self.height > rise * (1.0 + FLAT) {
            return Ok(());
        }
        Err(MeshError::CapRise {
            height: self.height,
            rise,
        })
    }
}

/// `R - sqrt(R^2 - r^2)` without cancellation.
fn sagitta(radius: f64, r_squared: f64) -> f64 {
    r_squared / (radius + (radius * radius - r_squared).sqrt())
}
