//! Rigid bodies and what they do.

use super::{Listed, Scope, body::Bodies, list, mesh, nonzero::nonzero};
use crate::{fault::FaultKind, faults::FaultList, raw, read::At, value::Positive, value::vector};
use std::path::Path;
use striae_mesh::Vec3;
use striae_model::{
    FaultKind as ModelFault, Freedom, RigidId, RigidInertia, RigidMotion, RigidShape, RigidSurface,
};

/// The rigid bodies; `None` for the faulty ones.
pub(super) fn bodies(
    raw: &[At<raw::Rigid>],
    deformable: &Bodies,
    base: &Path,
    faults: &mut FaultList<'_>,
) -> Vec<Option<RigidSurface>> {
    let lower = |rigid: &At<raw::Rigid>| lower_body(rigid, deformable, base, faults);
    raw.iter().map(lower).collect()
}

fn lower_body(
    rigid: &At<raw::Rigid>,
    deformable: &Bodies,
    base: &Path,
    faults: &mut FaultList<'_>,
) -> Option<RigidSurface> {
    let raw = &rigid.value;
    let name = raw.name.as_ref().map_or("", |name| &name.value.0);
    let mut ties = Vec::new();
    let shape = match raw.shape.as_ref()? {
        raw::RigidShape::Plane(plane) => plane_shape(&plane.plane.as_ref()?.value, faults)?,
        raw::RigidShape::Mesh(surface) => {
            let (positions, facets) = mesh::surface(surface.mesh.as_ref()?, name, base, faults)?;
            RigidShape::Facets { positions, facets }
        }
        raw::RigidShape::Tied(tied) => {
            for tie in &tied.tied.as_ref()?.value {
                let body = deformable.find(tie.value.body.as_ref(), faults)?;
                let nodes = deformable.nodes(body, tie.value.nodes.as_ref(), faults)?;
                ties.push((body, nodes));
            }
            RigidShape::Bare
        }
    };
    let stated = raw.reference.as_ref().map(|point| vector(&point.value));
    let inertia = match &raw.density {
        Some(density) => solid(rigid, &shape, density, name, faults),
        None => inertia(rigid, stated.unwrap_or_default(), name, faults),
    };
    let centre = match (&raw.density, &inertia) {
        (Some(_), Some(inertia)) => inertia.centre,
        _ => Vec3::zeros(),
    };
    Some(RigidSurface {
        name: name.to_owned(),
        shape,
        reference: stated.unwrap_or(centre),
        ties,
        inertia,
    })
}

fn plane_shape(plane: &raw::Plane, faults: &mut FaultList<'_>) -> Option<RigidShape> {
    let normal = nonzero(plane.normal.as_ref()?, "the normal of a plane", faults)?.normalize();
    let point = vector(&plane.point.as_ref()?.value);
    Some(RigidShape::Plane { point, normal })
}

/// Inertia of the solid inside a surface.
fn solid(
    rigid: &At<raw::Rigid>,
    shape: &RigidShape,
    density: &At<Positive>,
    name: &str,
    faults: &mut FaultList<'_>,
) -> Option<RigidInertia> {
    if rigid.value.mass.is_some() || rigid.value.inertia.is_some() {
        let kind = ModelFault::RigidInertia { rigid: name.into() };
        faults.push(&rigid.span, kind);
        return None;
    }
    let found = match shape {
        RigidShape::Facets { positions, facets } => {
            striae_model::solid::inertia(positions, facets, density.value.0)
                .map_err(|error| error.to_string())
        }
        RigidShape::Plane { .. } | RigidShape::Bare => {
            Err("only a `mesh` encloses a volume".into())
        }
    };
    let fault = |cause| {
        let rigid = name.into();
        faults.push(&density.span, FaultKind::RigidSolid { rigid, cause });
    };
    found.map_err(fault).ok()
}

fn inertia(
    rigid: &At<raw::Rigid>,
    centre: Vec3,
    name: &str,
    faults: &mut FaultList<'_>,
) -> Option<RigidInertia> {
    let (mass, moments) = (&rigid.value.mass, &rigid.value.inertia);
    if mass.is_none() && moments.is_none() {
        return None;
    }
    let moments = moments.as_ref().map(|m| m.value.map(|moment| moment.0));
    match (mass, moments) {
        (Some(mass), Some(moments))
            if 2.0 * moments.iter().copied().fold(0.0, f64::max)
                <= moments.iter().sum::<f64>() * (1.0 + 1e-12) =>
        {
            let mass = mass.value.0;
            Some(RigidInertia::aligned(mass, centre, moments))
        }
        _ => {
            let kind = ModelFault::RigidInertia { rigid: name.into() };
            faults.push(&rigid.span, kind);
            None
        }
    }
}

/// Motions of rigid bodies in a step.
pub(super) fn motions(
    raw: &[At<raw::RigidMotion>],
    scope: &Scope<'_>,
    faults: &mut FaultList<'_>,
) -> Listed<RigidMotion> {
    Listed::new(raw, |motion| {
        let name = motion.value.surface.as_ref();
        let surface = name.and_then(|name| scope.rigid.find(name, faults));
        let curve = scope.curves.find(motion.value.curve.as_ref(), faults);
        free_targets(&motion.value, faults);
        let target = |target: &Option<At<[_; 3]>>| target.as_ref().map(|at| vector(&at.value));
        Some(RigidMotion {
            surface: RigidId(surface?),
            coordinates: coordinates(&motion.value),
            force: target(&motion.value.force),
            torque: target(&motion.value.torque),
            curve: curve?,
        })
    })
}

/// Notes coordinates that are free and have a target; zeros fill the place of those without one.
fn free_targets(raw: &raw::RigidMotion, faults: &mut FaultList<'_>) {
    let target = |target: &Option<At<[_; 3]>>| target.as_ref().map(|at| vector(&at.value));
    let targets = [target(&raw.displacement), target(&raw.rotation)];
    let name = raw.surface.as_ref().map_or("", |name| &name.value.0);
    for free in list(&raw.free) {
        let (at, coordinate) = match free.value {
            raw::Coordinate::X => (0, "x"),
            raw::Coordinate::Y => (1, "y"),
            raw::Coordinate::Z => (2, "z"),
            raw::Coordinate::Rx => (3, "rx"),
            raw::Coordinate::Ry => (4, "ry"),
            raw::Coordinate::Rz => (5, "rz"),
        };
        let target = targets[at / 3].map_or(0.0, |target| target[at % 3]);
        if target != 0.0 {
            let rigid = name.into();
            let kind = ModelFault::FreeTarget {
                coordinate,
                rigid,
                target,
            };
            faults.push(&free.span, kind);
        }
    }
}

fn coordinates(raw: &raw::RigidMotion) -> [Freedom; 6] {
    use raw::Coordinate::{Rx, Ry, Rz, X, Y, Z};
    let target = |target: &Option<At<[_; 3]>>| target.as_ref().map(|at| vector(&at.value));
    let rotation = target(&raw.rotation).map(|angles| angles.map(f64::to_radians));
    let targets = [target(&raw.displacement), rotation];
    let names = [X, Y, Z, Rx, Ry, Rz];
    std::array::from_fn(|at| {
        let free = list(&raw.free).iter().any(|free| free.value == names[at]);
        match &targets[at / 3] {
            _ if free => Freedom::Free,
            Some(target) => Freedom::To(target[at % 3]),
            None => Freedom::AsBefore,
        }
    })
}
