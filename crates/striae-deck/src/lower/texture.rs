//! Textures of the sides of a pair, and whether friction finds those it needs.

use super::{
    axis::{axis, degrees, nonzero},
    nodal,
    surfaces::Surfaces,
};
use crate::{faults::FaultList, raw, read::At, value::vector};
use striae_mesh::Vec3;
use striae_model::FaultKind as ModelFault;
use striae_solve::model::{ContactSurface, RigidShape, RigidSurface};
use striae_surface::texture::{Field, Lines, Paint};

/// The paint of a side, `None` after its faults or those of the side have been noted.
pub(super) fn paint(
    raw: &raw::Texture,
    side: Option<&ContactSurface>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Paint> {
    let (lines, turn) = match raw {
        raw::Texture::Uniform(raw) => {
            let direction = nonzero(raw.uniform.as_ref()?, "the direction of a texture", faults)?;
            (Lines::Uniform(direction), &raw.turn)
        }
        raw::Texture::Circumferential(raw) => (
            Lines::Circumferential(axis(raw.circumferential.as_ref()?, faults)?),
            &raw.turn,
        ),
        raw::Texture::Axial(raw) => (Lines::Axial(axis(raw.axial.as_ref()?, faults)?), &raw.turn),
        raw::Texture::Radial(raw) => (
            Lines::Radial(axis(raw.radial.as_ref()?, faults)?),
            &raw.turn,
        ),
        raw::Texture::Points(raw) => return points(raw, faults),
        raw::Texture::Nodal(raw) => return nodal::paint(raw, side?, surfaces, faults),
        raw::Texture::Listed(raw) => {
            let directions = raw.directions.as_ref()?.value.iter();
            return Some(Paint::Nodal(
                directions.map(|at| vector(&at.value)).collect(),
            ));
        }
    };
    Some(Paint::Field(Field {
        lines,
        turn: degrees(turn).to_radians(),
    }))
}

/// Notes a texture given at points or nodes of a plane, which has no nodes.
pub(super) fn check_plane(
    surface: Option<&RigidSurface>,
    raw: &At<raw::Texture>,
    faults: &mut FaultList<'_>,
) {
    let Some(RigidSurface {
        name,
        shape: RigidShape::Plane { .. },
        ..
    }) = surface
    else {
        return;
    };
    if matches!(
        raw.value,
        raw::Texture::Points(_) | raw::Texture::Nodal(_) | raw::Texture::Listed(_)
    ) {
        faults.push(
            &raw.span,
            ModelFault::NodesOnPlane {
                surface: name.clone(),
            },
        );
    }
}

fn points(raw: &raw::PointTexture, faults: &mut FaultList<'_>) -> Option<Paint> {
    let mut directions: Vec<(Vec3, Vec3)> = Vec::new();
    let points = &raw.points.as_ref()?.value;
    for At { value: point, .. } in points {
        let Some(direction) = &point.direction else {
            continue;
        };
        let direction = nonzero(direction, "the direction of a texture", faults);
        let (Some(at), Some(direction)) = (&point.at, direction) else {
            continue;
        };
        directions.push((vector(&at.value), direction));
    }
    let width = raw.width.as_ref().map(|width| width.value.0);
    (directions.len() == points.len()).then_some(Paint::Points { directions, width })
}
