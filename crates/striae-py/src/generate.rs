//! Generators of meshes.

use pyo3::prelude::*;
use striae::mesh::{
    CellKind, Vec3,
    generate::{
        Annulus, Block, CappedBlock, Cylinder, Grading, Half, HalfCylinder, Part, Pivot,
        Refinement, Rotation, Sector, Torus,
    },
};

use crate::mesh::{Mesh, made};

/// Lengths of the intervals along an edge: a word and its numbers.
type Intervals = Option<(String, Vec<f64>)>;

/// Axis, degrees and the point that stays.
type Turn = Option<([f64; 3], f64, Option<[f64; 3]>)>;

fn grading(intervals: Intervals) -> Grading {
    match intervals {
        None => Grading::Uniform,
        Some((word, numbers)) => match (word.as_str(), &numbers[..]) {
            ("one-sided", [ratio]) => Grading::OneSided { ratio: *ratio },
            ("symmetric", [ratio]) => Grading::Symmetric { ratio: *ratio },
            _ => Grading::Lengths(numbers),
        },
    }
}

fn rotation(turn: Turn) -> Option<Rotation> {
    turn.map(|(axis, degrees, about)| Rotation {
        axis: axis.into(),
        degrees,
        about: about.map_or(Pivot::Centre, |point| Pivot::Point(point.into())),
    })
}

fn kind(cells: &str) -> CellKind {
    match cells {
        "tetra" => CellKind::Tetrahedron,
        "tetra10" => CellKind::CompositeTetrahedron,
        "wedge" => CellKind::Wedge,
        "pyramid" => CellKind::Pyramid,
        _ => CellKind::Hexahedron,
    }
}

/// A block.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub fn block(
    origin: [f64; 3],
    size: [f64; 3],
    divisions: [usize; 3],
    gradings: [Intervals; 3],
    turn: Turn,
    mesh_rotation: f64,
    bottom_slopes: [f64; 2],
    top_slopes: [f64; 2],
    irregularity: f64,
    seed: u64,
    cells: &str,
) -> PyResult<Mesh> {
    let block = Block {
        origin: origin.into(),
        size: size.into(),
        divisions,
        gradings: gradings.map(grading),
        rotation: rotation(turn),
        mesh_rotation,
        bottom_slopes,
        top_slopes,
        irregularity,
        seed,
        cells: kind(cells),
    };
    made(block.mesh())
}

/// A block whose lower side is a spherical cap.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub fn capped_block(
    apex: [f64; 3],
    size: [f64; 2],
    height: f64,
    radius: f64,
    element_size: f64,
    fine_half_width: f64,
    fine_depth: f64,
    growth: f64,
    half: bool,
    cells: &str,
) -> PyResult<Mesh> {
    let block = CappedBlock {
        apex: apex.into(),
        size,
        height,
        radius,
        element_size,
        fine_half_width,
        fine_depth,
        growth,
        part: if half { Part::Half } else { Part::Whole },
        cells: kind(cells),
    };
    made(block.mesh())
}

/// A slice of half a cylinder.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub fn half_cylinder(
    apex: [f64; 3],
    upper: bool,
    radius: f64,
    thickness: f64,
    layers: usize,
    element_size: f64,
    fine_half_width: f64,
    fine_depth: f64,
    growth: f64,
) -> PyResult<Mesh> {
    let half_cylinder = HalfCylinder {
        apex: apex.into(),
        half: if upper { Half::Upper } else { Half::Lower },
        radius,
        thickness,
        layers,
        element_size,
        fine_half_width,
        fine_depth,
        growth,
    };
    made(half_cylinder.mesh())
}

/// A ring.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "keyword arguments of Python")]
pub fn annulus(
    centre: [f64; 3],
    axis: [f64; 3],
    inner_radius: f64,
    outer_radius: f64,
    width: f64,
    divisions: [usize; 3],
    gradings: [Intervals; 2],
    refinement: Option<(f64, f64)>,
) -> PyResult<Mesh> {
    let [radial_grading, axial_grading] = gradings.map(grading);
    let annulus = Annulus {
        centre: Vec3::from(centre),
        axis: Vec3::from(axis),
        inner_radius,
        outer_radius,
        width,
        divisions,
        radial_grading,
        axial_grading,
        refinement: refinement.map(|(half_angle, ratio)| Refinement { half_angle, ratio }),
    };
    made(annulus.mesh())
}

/// A solid cylinder.
#[pyfunction]
pub fn cylinder(
    base: [f64; 3],
    axis: [f64; 3],
    radius: f64,
    height: f64,
    divisions: [usize; 3],
    gradings: [Intervals; 1],
    quarter: bool,
) -> PyResult<Mesh> {
    let [axial_grading] = gradings.map(grading);
    let cylinder = Cylinder {
        base: base.into(),
        axis: axis.into(),
        radius,
        height,
        divisions,
        axial_grading,
        sector: if quarter {
            Sector::Quarter
        } else {
            Sector::Whole
        },
    };
    made(cylinder.mesh())
}

/// A ring of round section.
#[pyfunction]
pub fn torus(
    centre: [f64; 3],
    axis: [f64; 3],
    ring_radius: f64,
    section_radius: f64,
    divisions: [usize; 3],
) -> PyResult<Mesh> {
    let torus = Torus {
        centre: centre.into(),
        axis: axis.into(),
        ring_radius,
        section_radius,
        divisions,
    };
    made(torus.mesh())
}
