//! A box of cells, in several ways less regular than a box.
//!
//! Starting from the graded lattice in the box `[0, a] x [0, b] x [0, c]`:
//!
//! 1. *irregularity* `f`: a node moves along each of the `m` lattice axes that are
//!    free for it by `f u l / sqrt(m)`, `u` uniform in `[-1, 1)`, `l` the shorter
//!    neighbouring interval; nodes of plane sides stay in them, nodes of edges
//!    stay. The edges at a corner of a cube then change by at most `2 f` of their
//!    length, and `f < 1 / (2 sqrt(3))` keeps its Jacobian positive;
//! 2. *mesh rotation*: in plan, a node at distance `r` from the middle turns
//!    about it by `angle (1 - r^2/m^2)^2` inside the circle with the shorter
//!    half side `m` as radius. The map keeps areas, hence stays one to one;
//! 3. *slopes*: the lower and upper side become the planes
//!    `z = s_x (x - a/2) + s_y (y - b/2)` and `z = c + ...`, columns of nodes are
//!    stretched linearly between them, and the volume stays `a b c`;
//! 4. rotation and shift of the whole.
//!
//! Cells of other kinds are made by dividing the hexahedra.

use super::Grading;
use super::division::{CELLS, Division, cells, nodes, parts};
use super::generator::{Generate, Generator, product};
use super::grading::{EQUAL, GRADING};
use super::grid::{Closure, Grid, Side, named_mesh};
use crate::{CellKind, Mesh, MeshError, Vec3, random::Random};
use nalgebra::{Rotation3, Unit};
use striae_declared::{
    ANY, Absent, Bound, Declared, LENGTH, NO_UNIT, POSITIVE, Parameter, Set, Values,
};

/// The generator.
pub static BLOCK: Declared<Generator> = Declared {
    name: "block",
    summary: "A block. Sets of nodes and facets: `xmin`, `xmax`, `ymin`, `ymax`, `zmin`, `zmax`, named before rotation.",
    parameters: &[
        Parameter::position(
            "origin",
            "Its corner of smallest coordinates, before rotation.",
        ),
        Parameter::several("size", 3, POSITIVE, LENGTH, "Edge lengths.")
            .or_in_programs(&Absent::Numbers(&[1.0; 3])),
        Parameter::counts("divisions", 3, "Hexahedra along the edges.")
            .or_in_programs(&Absent::Counts(&[1; 3])),
        CELLS,
        Parameter::table("grading", &GRADINGS, "Interval lengths along the edges.").or(EQUAL),
        Parameter::table("rotation", &ROTATION, "Rotation of the whole block.").or(Absent::Nothing),
        Parameter::number(
            "mesh_rotation",
            ANY,
            "degrees",
            "Angle by which the mesh is rotated about the third axis inside the unchanged outline; elements stay well shaped up to about 25.",
        )
        .or(Absent::Number(0.0)),
        Parameter::several(
            "bottom_slopes",
            2,
            ANY,
            NO_UNIT,
            "Slopes of the lower side along the first two axes.",
        )
        .or(Absent::Numbers(&[0.0; 2])),
        Parameter::several(
            "top_slopes",
            2,
            ANY,
            NO_UNIT,
            "Slopes of the upper side along the first two axes.",
        )
        .or(Absent::Numbers(&[0.0; 2])),
        Parameter::number(
            "irregularity",
            &[Bound::AtLeast(0.0), Bound::Below(0.5)],
            NO_UNIT,
            "Random displacement of inner nodes as a fraction of the local interval; elements stay well shaped up to about 0.25.",
        )
        .or(Absent::Number(0.0)),
        Parameter::whole("seed", 0, "Seed of the random displacement.").or(Absent::Whole(0)),
    ],
    build: |values| Ok(Generator::of(Block::stated(values))),
    fit: None,
};

static GRADINGS: Set = Set {
    doc: "Interval lengths along the three axes.",
    parameters: &[
        Parameter::table("x", &GRADING, "Along the first axis.").or(EQUAL),
        Parameter::table("y", &GRADING, "Along the second axis.").or(EQUAL),
        Parameter::table("z", &GRADING, "Along the third axis.").or(EQUAL),
    ],
};

static ROTATION: Set = Set {
    doc: "Rotation of a body.",
    parameters: &[
        Parameter::direction("axis", "Axis of any length."),
        Parameter::number("degrees", ANY, "degrees", "Angle by the right-hand rule."),
        Parameter::position("about", "Fixed point of the rotation.")
            .or(Absent::Otherwise("the centre of the body")),
    ],
};

/// A box of cells with sides `xmin xmax ymin ymax zmin zmax`, named before
/// rotation. Defaults are those of [`BLOCK`].
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Corner with the smallest coordinates, before rotation.
    pub origin: Vec3,
    /// Lengths of the edges.
    pub size: Vec3,
    /// Number of hexahedra along `x, y, z`.
    pub divisions: [usize; 3],
    /// Kind of cell that the hexahedra are divided into. Wedges extend along `z`.
    pub cells: CellKind,
    /// Interval lengths along `x, y, z`.
    pub gradings: [Grading; 3],
    /// Rotation of the whole block.
    pub rotation: Option<Rotation>,
    /// Angle in degrees by which the mesh turns about `z` inside the unchanged
    /// outline: fully at the middle, not at all at the outline.
    pub mesh_rotation: f64,
    /// Slopes `[dz/dx, dz/dy]` of the lower side about its middle.
    pub bottom_slopes: [f64; 2],
    /// Slopes `[dz/dx, dz/dy]` of the upper side about its middle.
    pub top_slopes: [f64; 2],
    /// Largest random displacement of nodes as a fraction of the local interval,
    /// in `[0, 0.5)`.
    pub irregularity: f64,
    /// Seed of the random displacement.
    pub seed: u64,
}

/// A rotation of a whole body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rotation {
    /// Axis, of any length but zero.
    pub axis: Vec3,
    /// Angle in degrees, by the right-hand rule.
    pub degrees: f64,
    /// Point that stays.
    pub about: Pivot,
}

/// Fixed point of a rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pivot {
    /// The middle of the body.
    Centre,
    /// A point in space.
    Point(Vec3),
}

impl Default for Block {
    fn default() -> Self {
        Self::stated(&BLOCK.completed(&Values::default()))
    }
}

impl Generate for Block {
    fn mesh(&self) -> Result<Mesh, MeshError> {
        self.mesh()
    }

    fn elements(&self) -> Option<u128> {
        let parts = parts(self.cells) as u128;
        Some(product(&self.divisions).saturating_mul(parts))
    }

    fn nodes(&self) -> Option<u128> {
        Some(nodes(self.cells, &self.divisions))
    }
}

impl Block {
    fn stated(values: &Values) -> Self {
        let gradings = values.table_if_any("grading");
        let along = |axis| Grading::stated(gradings.and_then(|all| all.table_if_any(axis)));
        Self {
            origin: values.array("origin").into(),
            size: values.array("size").into(),
            divisions: values.counts("divisions"),
            cells: cells(values),
            gradings: ["x", "y", "z"].map(along),
            rotation: values.table_if_any("rotation").map(Rotation::stated),
            mesh_rotation: values.number("mesh_rotation"),
            bottom_slopes: values.array("bottom_slopes"),
            top_slopes: values.array("top_slopes"),
            irregularity: values.number("irregularity"),
            seed: values.whole("seed") as u64,
        }
    }

    /// The mesh.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] or [`MeshError::IntervalCount`] for parameters
    /// out of range, [`MeshError::Inverted`] where they distort the mesh too much.
    pub fn mesh(&self) -> Result<Mesh, MeshError> {
        self.check_parameters()?;
        let grid = Grid::new(self.divisions, parts(self.cells), Closure::Open)?;
        let mut nodes: [Vec<f64>; 3] = Default::default();
        for axis in 0..3 {
            nodes[axis] = self.gradings[axis].nodes(self.divisions[axis])?;
            nodes[axis].iter_mut().for_each(|x| *x *= self.size[axis]);
        }
        let mut random = Random::new(self.seed);
        let mut positions = grid.positions(|lattice| {
            let x = irregular(&nodes, lattice, self.irregularity, &mut random);
            self.place(self.slope(self.turn(x)))
        });
        let sides = [
            ("xmin", grid.faces(Side::FirstI)),
            ("xmax", grid.faces(Side::LastI)),
            ("ymin", grid.faces(Side::FirstJ)),
            ("ymax", grid.faces(Side::LastJ)),
            ("zmin", grid.faces(Side::FirstK)),
            ("zmax", grid.faces(Side::LastK)),
        ];
        let division = Division::new(grid.elements(), self.cells, &mut positions);
        let sides = sides.map(|(name, faces)| (name, division.faces(&faces)));
        named_mesh(positions, division.cells, sides)
    }

    fn check_parameters(&self) -> Result<(), MeshError> {
        for size in self.size.iter().copied() {
            MeshError::require(size > 0.0, "size", size, "it must be positive")?;
        }
        let f = self.irregularity;
        MeshError::require(
            (0.0..0.5).contains(&f),
            "irregularity",
            f,
            "it must be at least 0 and less than 0.5",
        )?;
        if let Some(rotation) = &self.rotation {
            let length = rotation.axis.norm();
            MeshError::require(
                length > 0.0,
                "length of the rotation axis",
                length,
                "it must be positive",
            )?;
        }
        let [bottom, top] = [self.bottom_slopes, self.top_slopes];
        let lost: f64 = (0..2)
            .map(|axis| 0.5 * self.size[axis] * (top[axis] - bottom[axis]).abs())
            .sum();
        let height = self.size.z - lost;
        MeshError::require(
            height > 0.0,
            "height of the lowest column between the oblique sides",
            height,
            "it must be positive",
        )
    }

    fn turn(&self, x: Vec3) -> Vec3 {
        let middle = 0.5 * self.size;
        let radius = middle.x.min(middle.y);
        let from_middle = Vec3::new(x.x - middle.x, x.y - middle.y, 0.0);
        let inside = (1.0 - from_middle.norm_squared() / radius.powi(2)).max(0.0);
        if inside == 0.0 || self.mesh_rotation == 0.0 {
            return x;
        }
        let angle = self.mesh_rotation.to_radians() * inside.powi(2);
        x - from_middle + Rotation3::from_axis_angle(&Vec3::z_axis(), angle) * from_middle
    }

    fn slope(&self, x: Vec3) -> Vec3 {
        let rise = |slopes: [f64; 2]| {
            slopes[0] * (x.x - 0.5 * self.size.x) + slopes[1] * (x.y - 0.5 * self.size.y)
        };
        let share = x.z / self.size.z;
        let lift = rise(self.bottom_slopes) * (1.0 - share) + rise(self.top_slopes) * share;
        x + Vec3::z() * lift
    }

    fn place(&self, x: Vec3) -> Vec3 {
        let x = self.origin + x;
        let Some(rotation) = &self.rotation else {
            return x;
        };
        let fixed = match rotation.about {
            Pivot::Centre => self.origin + 0.5 * self.size,
            Pivot::Point(point) => point,
        };
        let axis = Unit::new_normalize(rotation.axis);
        fixed + Rotation3::from_axis_angle(&axis, rotation.degrees.to_radians()) * (x - fixed)
    }
}

impl Rotation {
    fn stated(values: &Values) -> Self {
        let about = values.array_if_any("about");
        Self {
            axis: values.array("axis").into(),
            degrees: values.number("degrees"),
            about: about.map_or(Pivot::Centre, |point: [f64; 3]| Pivot::Point(point.into())),
        }
    }
}

/// Position of a lattice node with its random displacement.
fn irregular(
    nodes: &[Vec<f64>; 3],
    lattice: [usize; 3],
    fraction: f64,
    random: &mut Random,
) -> Vec3 {
    let free = [0, 1, 2].map(|axis| (1..nodes[axis].len() - 1).contains(&lattice[axis]));
    let free_count = free.iter().filter(|&&free| free).count();
    let fraction = fraction / (free_count as f64).sqrt();
    Vec3::from_fn(|axis, _| {
        let (x, i) = (&nodes[axis], lattice[axis]);
        if free_count < 2 || !free[axis] {
            return x[i];
        }
        let interval = (x[i] - x[i - 1]).min(x[i + 1] - x[i]);
        x[i] + fraction * interval * random.symmetric()
    })
}
