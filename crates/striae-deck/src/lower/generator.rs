//! Parameters of mesh generators.

use crate::{
    faults::FaultList,
    raw,
    read::At,
    value::{Count, Number, vector},
};
use striae_mesh::{
    CellKind, Mesh, MeshError, Vec3,
    generate::{
        Annulus, Block, CappedBlock, Cylinder, Grading, Half, HalfCylinder, Part, Pivot,
        Refinement, Rotation, Sector, Torus, refined_lengths,
    },
};
use striae_model::FaultKind as ModelFault;

/// A generator with its parameters.
pub(super) enum Generator {
    Block(Block),
    CappedBlock(CappedBlock),
    HalfCylinder(HalfCylinder),
    Annulus(Annulus),
    Cylinder(Cylinder),
    Torus(Torus),
}

impl Generator {
    /// The generator, or `None` where a parameter could not be read.
    pub(super) fn new(raw: &raw::Generator, faults: &mut FaultList<'_>) -> Option<Self> {
        match raw {
            raw::Generator::Block(raw) => block(raw, faults).map(Self::Block),
            raw::Generator::CappedBlock(raw) => capped_block(raw).map(Self::CappedBlock),
            raw::Generator::HalfCylinder(raw) => half_cylinder(raw).map(Self::HalfCylinder),
            raw::Generator::Annulus(raw) => annulus(raw, faults).map(Self::Annulus),
            raw::Generator::Cylinder(raw) => cylinder(raw, faults).map(Self::Cylinder),
            raw::Generator::Torus(raw) => torus(raw, faults).map(Self::Torus),
        }
    }

    /// About how many elements the mesh will have, as far as that is known before it is made.
    pub(super) fn elements(&self) -> Option<u128> {
        let product = |counts: &[usize]| {
            let counts = counts.iter().map(|count| *count as u128);
            counts.fold(1, u128::saturating_mul)
        };
        match self {
            Self::Block(block) => {
                Some(product(&block.divisions).saturating_mul(parts(block.cells)))
            }
            Self::CappedBlock(block) => {
                let [x, y] = block.plan_lengths().ok()?;
                let [height, depth] = [block.height, block.fine_depth];
                let z = refined_lengths(height, depth, block.element_size, block.growth).ok()?;
                let hexahedra = product(&[x.len(), y.len(), z.len()]);
                Some(hexahedra.saturating_mul(parts(block.cells)))
            }
            Self::Annulus(ring) => Some(product(&ring.divisions)),
            Self::Cylinder(Cylinder { divisions, .. }) | Self::Torus(Torus { divisions, .. }) => {
                let [core, band, layers] = *divisions;
                Some(product(&[4, core, core.saturating_add(band), layers]))
            }
            Self::HalfCylinder(slice) => {
                let layer = HalfCylinder {
                    layers: 1,
                    ..slice.clone()
                };
                let layer = layer.mesh().ok()?.element_count() as u128;
                Some(layer.saturating_mul(slice.layers as u128))
            }
        }
    }

    /// About how many nodes the mesh will have, as far as that is known before it is made.
    pub(super) fn nodes(&self) -> Option<u128> {
        let beside = |counts: &[usize]| {
            let counts = counts.iter().map(|count| *count as u128 + 1);
            counts.fold(1, u128::saturating_mul)
        };
        match self {
            Self::Block(block) => Some(beside(&block.divisions)),
            Self::Annulus(ring) => Some(beside(&ring.divisions)),
            _ => self.elements(),
        }
    }

    /// The mesh.
    pub(super) fn mesh(&self) -> Result<Mesh, MeshError> {
        match self {
            Self::Block(block) => block.mesh(),
            Self::CappedBlock(block) => block.mesh(),
            Self::HalfCylinder(slice) => slice.mesh(),
            Self::Annulus(ring) => ring.mesh(),
            Self::Cylinder(cylinder) => cylinder.mesh(),
            Self::Torus(ring) => ring.mesh(),
        }
    }
}

/// Cells that a hexahedron is divided into.
fn parts(cells: CellKind) -> u128 {
    match cells {
        CellKind::Hexahedron => 1,
        CellKind::Wedge => 2,
        _ => 6,
    }
}

fn block(raw: &raw::Block, faults: &mut FaultList<'_>) -> Option<Block> {
    let rotation = match &raw.rotation {
        Some(raw) => Some(rotation(&raw.value, faults)?),
        None => None,
    };
    let along = |grading: fn(&raw::Gradings) -> &Option<At<raw::Grading>>| {
        raw.grading
            .as_ref()
            .map_or(Some(Grading::Uniform), |gradings| {
                lower_grading(grading(&gradings.value))
            })
    };
    let [x, y, z] = &raw.size.as_ref()?.value;
    Some(Block {
        origin: point(&raw.origin),
        size: Vec3::new(x.0, y.0, z.0),
        divisions: counts(&raw.divisions)?,
        cells: cells(&raw.cells),
        gradings: [
            along(|all| &all.x)?,
            along(|all| &all.y)?,
            along(|all| &all.z)?,
        ],
        rotation,
        mesh_rotation: raw
            .mesh_rotation
            .as_ref()
            .map_or(0.0, |angle| angle.value.0),
        bottom_slopes: slopes(&raw.bottom_slopes),
        top_slopes: slopes(&raw.top_slopes),
        irregularity: raw.irregularity.as_ref().map_or(0.0, |part| part.value.0),
        seed: raw.seed.as_ref().map_or(0, |seed| seed.value.0 as u64),
    })
}

fn capped_block(raw: &raw::CappedBlock) -> Option<CappedBlock> {
    let element_size = raw.element_size.as_ref()?.value.0;
    let [x, y] = &raw.size.as_ref()?.value;
    Some(CappedBlock {
        apex: point(&raw.apex),
        size: [x.0, y.0],
        height: raw.height.as_ref()?.value.0,
        radius: raw.radius.as_ref()?.value.0,
        element_size,
        fine_half_width: raw
            .fine_half_width
            .as_ref()
            .map_or(2.0 * element_size, |width| width.value.0),
        fine_depth: raw.fine_depth.as_ref().map_or(0.0, |depth| depth.value.0),
        growth: raw.growth.as_ref().map_or(1.3, |growth| growth.value.0),
        part: match raw.part.as_ref().map(|part| part.value) {
            None | Some(raw::Part::Whole) => Part::Whole,
            Some(raw::Part::Half) => Part::Half,
        },
        cells: cells(&raw.cells),
    })
}

fn half_cylinder(raw: &raw::HalfCylinder) -> Option<HalfCylinder> {
    let element_size = raw.element_size.as_ref()?.value.0;
    Some(HalfCylinder {
        apex: point(&raw.apex),
        half: match raw.half.as_ref().map(|half| half.value) {
            None | Some(raw::Half::Lower) => Half::Lower,
            Some(raw::Half::Upper) => Half::Upper,
        },
        radius: raw.radius.as_ref()?.value.0,
        thickness: raw.thickness.as_ref()?.value.0,
        layers: raw.layers.as_ref().map_or(1, |layers| layers.value.0),
        element_size,
        fine_half_width: raw
            .fine_half_width
            .as_ref()
            .map_or(5.0 * element_size, |width| width.value.0),
        fine_depth: raw.fine_depth.as_ref().map_or(0.0, |depth| depth.value.0),
        growth: raw.growth.as_ref().map_or(1.2, |growth| growth.value.0),
    })
}

fn annulus(raw: &raw::Annulus, faults: &mut FaultList<'_>) -> Option<Annulus> {
    let refinement = match &raw.refinement {
        Some(At { value: raw, .. }) => Some(Refinement {
            half_angle: raw.half_angle.as_ref()?.value.0,
            ratio: raw.ratio.as_ref()?.value.0,
        }),
        None => None,
    };
    Some(Annulus {
        centre: point(&raw.centre),
        axis: axis(&raw.axis, Vec3::y(), "the axis of a ring", faults)?,
        inner_radius: raw.inner_radius.as_ref()?.value.0,
        outer_radius: raw.outer_radius.as_ref()?.value.0,
        width: raw.width.as_ref()?.value.0,
        divisions: counts(&raw.divisions)?,
        radial_grading: lower_grading(&raw.radial_grading)?,
        axial_grading: lower_grading(&raw.axial_grading)?,
        refinement,
    })
}

fn cylinder(raw: &raw::SolidCylinder, faults: &mut FaultList<'_>) -> Option<Cylinder> {
    Some(Cylinder {
        base: point(&raw.base),
        axis: axis(&raw.axis, Vec3::z(), "the axis of a cylinder", faults)?,
        radius: raw.radius.as_ref()?.value.0,
        height: raw.height.as_ref()?.value.0,
        divisions: counts(&raw.divisions)?,
        axial_grading: lower_grading(&raw.axial_grading)?,
        sector: match raw.part.as_ref().map(|part| part.value) {
            None | Some(raw::Sector::Whole) => Sector::Whole,
            Some(raw::Sector::Quarter) => Sector::Quarter,
        },
    })
}

fn torus(raw: &raw::Torus, faults: &mut FaultList<'_>) -> Option<Torus> {
    Some(Torus {
        centre: point(&raw.centre),
        axis: axis(&raw.axis, Vec3::z(), "the axis of a ring", faults)?,
        ring_radius: raw.ring_radius.as_ref()?.value.0,
        section_radius: raw.section_radius.as_ref()?.value.0,
        divisions: counts(&raw.divisions)?,
    })
}

fn cells(raw: &Option<At<raw::Cells>>) -> CellKind {
    match raw.as_ref().map(|cells| cells.value) {
        None | Some(raw::Cells::Hexahedra) => CellKind::Hexahedron,
        Some(raw::Cells::Wedges) => CellKind::Wedge,
        Some(raw::Cells::Pyramids) => CellKind::Pyramid,
        Some(raw::Cells::Tetrahedra) => CellKind::Tetrahedron,
        Some(raw::Cells::CompositeTetrahedra) => CellKind::CompositeTetrahedron,
    }
}

fn axis(
    raw: &Option<At<[Number; 3]>>,
    default: Vec3,
    place: &str,
    faults: &mut FaultList<'_>,
) -> Option<Vec3> {
    match raw {
        Some(axis) => nonzero(axis, place, faults),
        None => Some(default),
    }
}

fn lower_grading(raw: &Option<At<raw::Grading>>) -> Option<Grading> {
    Some(match raw.as_ref().map(|raw| &raw.value) {
        None => Grading::Uniform,
        Some(raw::Grading::OneSided(raw)) => Grading::OneSided {
            ratio: raw.one_sided.as_ref()?.value.0,
        },
        Some(raw::Grading::Symmetric(raw)) => Grading::Symmetric {
            ratio: raw.symmetric.as_ref()?.value.0,
        },
        Some(raw::Grading::Lengths(raw)) => Grading::Lengths(
            raw.lengths
                .as_ref()?
                .value
                .iter()
                .map(|length| length.value.0)
                .collect(),
        ),
    })
}

fn rotation(raw: &raw::Rotation, faults: &mut FaultList<'_>) -> Option<Rotation> {
    Some(Rotation {
        axis: nonzero(raw.axis.as_ref()?, "the axis of a rotation", faults)?,
        degrees: raw.degrees.as_ref()?.value.0,
        about: raw
            .about
            .as_ref()
            .map_or(Pivot::Centre, |about| Pivot::Point(vector(&about.value))),
    })
}

/// A vector that is not zero.
pub(super) fn nonzero(
    raw: &At<[Number; 3]>,
    place: &str,
    faults: &mut FaultList<'_>,
) -> Option<Vec3> {
    let vector = vector(&raw.value);
    if vector.norm() > 0.0 {
        return Some(vector);
    }
    faults.push(
        &raw.span,
        ModelFault::ZeroVector {
            place: place.into(),
        },
    );
    None
}

fn point(raw: &Option<At<[Number; 3]>>) -> Vec3 {
    raw.as_ref()
        .map_or(Vec3::zeros(), |point| vector(&point.value))
}

fn counts(raw: &Option<At<[Count; 3]>>) -> Option<[usize; 3]> {
    let [x, y, z] = &raw.as_ref()?.value;
    Some([x.0, y.0, z.0])
}

fn slopes(raw: &Option<At<[Number; 2]>>) -> [f64; 2] {
    raw.as_ref()
        .map_or([0.0; 2], |slopes| [slopes.value[0].0, slopes.value[1].0])
}
