//! Members of sets of facets.

use super::{
    Kind,
    found::Found,
    members as members_of,
    members::{Sources, common, listed, single, union, unknown_member},
    region,
};
use crate::{
    faults::FaultList,
    lower::nonzero::nonzero,
    raw,
    read::At,
    value::{Text, vector},
};
use std::collections::BTreeSet;
use striae_mesh::{ElementId, Face, Mesh};

/// The sets that facets come from.
pub(super) fn needed(raw: &raw::FacetMembers) -> Sources<'_> {
    match raw {
        raw::FacetMembers::Common(raw) => listed(Kind::Facet, &raw.common),
        raw::FacetMembers::Union(raw) => listed(Kind::Facet, &raw.union),
        raw::FacetMembers::Box(raw) => single(Kind::Facet, &raw.of),
        raw::FacetMembers::Sphere(raw) => single(Kind::Facet, &raw.of),
        raw::FacetMembers::Cylinder(raw) => single(Kind::Facet, &raw.of),
        raw::FacetMembers::HalfSpace(raw) => single(Kind::Facet, &raw.of),
        raw::FacetMembers::Direction(raw) => single(Kind::Facet, &raw.of),
        raw::FacetMembers::Around(raw) => single(Kind::Facet, &raw.of),
        raw::FacetMembers::Nodes(raw) => single(Kind::Node, &raw.nodes),
        raw::FacetMembers::Border(raw) => single(Kind::Element, &raw.border),
        raw::FacetMembers::Listed(_) => Sources(Vec::new()),
    }
}

/// Facets; `None` after a fault.
pub(super) fn facets(
    mesh: &Mesh,
    body: &str,
    raw: &raw::FacetMembers,
    faults: &mut FaultList<'_>,
) -> Option<Found<Face>> {
    let sets = &mesh.facet_sets;
    let of = |set: &Option<At<Text>>, faults: &mut FaultList<'_>| match set {
        Some(set) => members_of("facet", sets, body, set, faults),
        None => Some(mesh.boundary_faces()),
    };
    Some(match raw {
        raw::FacetMembers::Common(raw) => common("facet", sets, body, raw, faults)?.into(),
        raw::FacetMembers::Union(raw) => union("facet", sets, body, raw, faults)?.into(),
        raw::FacetMembers::Box(raw) => {
            let faces = of(&raw.of, faults)?;
            region::cuboid(&raw.from, &raw.to, faults)?.facets(mesh, &faces)
        }
        raw::FacetMembers::Sphere(raw) => {
            let faces = of(&raw.of, faults)?;
            region::sphere(&raw.sphere)?.facets(mesh, &faces)
        }
        raw::FacetMembers::Cylinder(raw) => {
            let faces = of(&raw.of, faults)?;
            region::cylinder(&raw.cylinder, faults)?.facets(mesh, &faces)
        }
        raw::FacetMembers::HalfSpace(raw) => {
            let faces = of(&raw.of, faults)?;
            region::half_space(&raw.half_space, faults)?.facets(mesh, &faces)
        }
        raw::FacetMembers::Direction(raw) => {
            let faces = of(&raw.of, faults)?;
            along(mesh, &faces, raw, faults)?
        }
        raw::FacetMembers::Around(raw) => {
            let faces = of(&raw.of, faults)?;
            let place = vector(&raw.around.as_ref()?.value);
            let angle = raw.feature_angle.as_ref()?.value.0.to_radians();
            mesh.faces_around(&faces, &place, angle).into()
        }
        raw::FacetMembers::Nodes(raw) => {
            let set = raw.nodes.as_ref()?;
            let nodes = members_of("node", &mesh.node_sets, body, set, faults)?;
            let set = &set.value.0;
            Found {
                members: mesh.faces_of_nodes(&nodes),
                hint: Some(format!("no facet has all its corners in node set `{set}`")),
            }
        }
        raw::FacetMembers::Border(raw) => {
            let set = raw.border.as_ref()?;
            let elements = members_of("element", &mesh.element_sets, body, set, faults)?;
            let set = &set.value.0;
            Found {
                members: mesh.boundary_of(&elements),
                hint: Some(format!("element set `{set}` is inside the body")),
            }
        }
        raw::FacetMembers::Listed(raw) => listed_facets(mesh, body, raw, faults)?.into(),
    })
}

/// Facets that look along a direction.
fn along(
    mesh: &Mesh,
    faces: &[Face],
    raw: &raw::FacetsAlong,
    faults: &mut FaultList<'_>,
) -> Option<Found<Face>> {
    let direction = nonzero(raw.direction.as_ref()?, "the direction of facets", faults)?;
    let angle = raw.angle.as_ref()?.value.0.to_radians();
    let angles = faces.iter();
    let angles = angles.map(|face| mesh.area_vector(*face).angle(&direction));
    let least = angles.fold(f64::INFINITY, f64::min).to_degrees();
    Some(Found {
        members: mesh.faces_along(faces, &direction, angle),
        hint: Some(format!("the least angle of a facet is {least:.4} degrees")),
    })
}

/// Sides of elements by number.
fn listed_facets(
    mesh: &Mesh,
    body: &str,
    raw: &raw::ListedFacets,
    faults: &mut FaultList<'_>,
) -> Option<Vec<Face>> {
    let boundary: BTreeSet<Face> = mesh.boundary_faces().into_iter().collect();
    let mut faces = Vec::new();
    for At { value, span } in &raw.sides.as_ref()?.value {
        let [element, side] = value.map(|number| number.0);
        let face = u8::try_from(side).ok().map(|side| (element, side));
        let face = face
            .filter(|(element, _)| *element < mesh.element_count())
            .map(|(element, side)| Face {
                element: ElementId::new(element),
                side,
            });
        match face.filter(|face| boundary.contains(face)) {
            Some(face) => faces.push(face),
            None => {
                let cause = format!("side {side} of element {element} is not on its boundary");
                unknown_member(body, cause, span, faults);
                return None;
            }
        }
    }
    Some(faces)
}
