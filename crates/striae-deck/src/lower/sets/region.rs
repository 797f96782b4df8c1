//! Members of sets in a region.

use super::found::Found;
use crate::{
    fault::FaultKind,
    faults::FaultList,
    lower::nonzero::nonzero,
    raw,
    read::At,
    value::{Number, vector},
};
use striae_mesh::{ElementId, Face, Mesh, NodeId, Region};

/// A region in which members are searched.
pub(super) struct Within(Region);

impl Within {
    pub(super) fn nodes(&self, mesh: &Mesh) -> Found<NodeId> {
        found(mesh, mesh.nodes_in(&self.0))
    }

    /// Elements with all their corners in the region.
    pub(super) fn elements(&self, mesh: &Mesh) -> Found<ElementId> {
        found(mesh, mesh.elements_of(&mesh.nodes_in(&self.0)))
    }

    /// Facets, out of the given ones, with all corners in the region.
    pub(super) fn facets(&self, mesh: &Mesh, of: &[Face]) -> Found<Face> {
        found(mesh, mesh.faces_among(of, &mesh.nodes_in(&self.0)))
    }
}

fn found<T>(mesh: &Mesh, members: Vec<T>) -> Found<T> {
    let (low, high) = mesh.bounds();
    let hint = format!(
        "the body extends from {} to {}",
        striae_mesh::place(&low),
        striae_mesh::place(&high)
    );
    Found {
        members,
        hint: Some(hint),
    }
}

/// A box with its corners in order.
pub(super) fn cuboid(
    from: &Option<At<[Number; 3]>>,
    to: &Option<At<[Number; 3]>>,
    faults: &mut FaultList<'_>,
) -> Option<Within> {
    let raw = to.as_ref()?;
    let (from, to) = (vector(&from.as_ref()?.value), vector(&raw.value));
    if let Some(axis) = (0..3).find(|axis| to[*axis] < from[*axis]) {
        let fault = FaultKind::Unexpected {
            place: format!("coordinate {} of `to`", axis + 1),
            expected: format!("at least {}, that of `from`", from[axis]),
            found: to[axis].to_string(),
        };
        faults.push(&raw.span, fault);
        return None;
    }
    Some(Within(Region::Box { from, to }))
}

pub(super) fn sphere(raw: &Option<At<raw::Sphere>>) -> Option<Within> {
    let raw = &raw.as_ref()?.value;
    Some(Within(Region::Sphere {
        centre: vector(&raw.centre.as_ref()?.value),
        radius: raw.radius.as_ref()?.value.0,
    }))
}

pub(super) fn cylinder(
    raw: &Option<At<raw::Cylinder>>,
    faults: &mut FaultList<'_>,
) -> Option<Within> {
    let raw = &raw.as_ref()?.value;
    Some(Within(Region::Cylinder {
        point: vector(&raw.point.as_ref()?.value),
        axis: nonzero(raw.axis.as_ref()?, "the axis of a cylinder", faults)?,
        radius: raw.radius.as_ref()?.value.0,
    }))
}

pub(super) fn half_space(
    raw: &Option<At<raw::HalfSpace>>,
    faults: &mut FaultList<'_>,
) -> Option<Within> {
    let raw = &raw.as_ref()?.value;
    Some(Within(Region::HalfSpace {
        point: vector(&raw.point.as_ref()?.value),
        normal: nonzero(raw.normal.as_ref()?, "the normal of a half space", faults)?,
    }))
}
