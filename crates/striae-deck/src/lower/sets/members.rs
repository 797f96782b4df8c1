//! Members of sets of nodes and elements.

use super::{Kind, found::Found, members, region};
use crate::{
    faults::{FaultList, Span},
    raw,
    read::At,
    value::{All, Number, Text, Whole, vector},
};
use striae_mesh::{ElementId, Mesh, NodeId, Sets};
use striae_model::FaultKind as ModelFault;

/// Names of the sets that members come from.
pub(super) struct Sources<'r>(pub(super) Vec<(Kind, &'r At<Text>)>);

/// The sets that nodes come from.
pub(super) fn nodes_needed(raw: &raw::NodeMembers) -> Sources<'_> {
    match raw {
        raw::NodeMembers::Common(raw) => listed(Kind::Node, &raw.common),
        raw::NodeMembers::Union(raw) => listed(Kind::Node, &raw.union),
        raw::NodeMembers::Facets(raw) => single(Kind::Facet, &raw.facets),
        raw::NodeMembers::Elements(raw) => single(Kind::Element, &raw.elements),
        raw::NodeMembers::Border(raw) => single(Kind::Element, &raw.border),
        _ => Sources(Vec::new()),
    }
}

/// The sets that elements come from.
pub(super) fn elements_needed(raw: &raw::ElementMembers) -> Sources<'_> {
    match raw {
        raw::ElementMembers::Common(raw) => listed(Kind::Element, &raw.common),
        raw::ElementMembers::Union(raw) => listed(Kind::Element, &raw.union),
        raw::ElementMembers::Nodes(raw) => single(Kind::Node, &raw.nodes),
        raw::ElementMembers::Facets(raw) => single(Kind::Facet, &raw.facets),
        _ => Sources(Vec::new()),
    }
}

pub(super) fn listed(kind: Kind, names: &Option<At<Vec<At<Text>>>>) -> Sources<'_> {
    let names = names.iter().flat_map(|names| &names.value);
    Sources(names.map(|name| (kind, name)).collect())
}

pub(super) fn single(kind: Kind, name: &Option<At<Text>>) -> Sources<'_> {
    Sources(name.iter().map(|name| (kind, name)).collect())
}

/// Nodes; `None` after a fault.
pub(super) fn nodes(
    mesh: &Mesh,
    body: &str,
    raw: &raw::NodeMembers,
    faults: &mut FaultList<'_>,
) -> Option<Found<NodeId>> {
    Some(match raw {
        raw::NodeMembers::Nearest(raw) => vec![nearest_node(mesh, raw.nearest.as_ref()?)].into(),
        raw::NodeMembers::Common(raw) => common("node", &mesh.node_sets, body, raw, faults)?.into(),
        raw::NodeMembers::Union(raw) => union("node", &mesh.node_sets, body, raw, faults)?.into(),
        raw::NodeMembers::Facets(raw) => {
            let facets = raw.facets.as_ref()?;
            let facets = members("facet", &mesh.facet_sets, body, facets, faults)?;
            mesh.nodes_of_faces(&facets).into()
        }
        raw::NodeMembers::Elements(raw) => {
            let elements = raw.elements.as_ref()?;
            let elements = members("element", &mesh.element_sets, body, elements, faults)?;
            mesh.nodes_of_elements(&elements).into()
        }
        raw::NodeMembers::Border(raw) => {
            let elements = raw.border.as_ref()?;
            let elements = members("element", &mesh.element_sets, body, elements, faults)?;
            mesh.nodes_of_faces(&mesh.border(&elements)).into()
        }
        raw::NodeMembers::Listed(raw) => {
            let numbers = raw.numbers.as_ref()?;
            let found = numbered("node", mesh.positions.len(), body, numbers, faults)?;
            found.map(NodeId::new).collect::<Vec<_>>().into()
        }
        raw::NodeMembers::Box(raw) => region::cuboid(&raw.from, &raw.to, faults)?.nodes(mesh),
        raw::NodeMembers::Sphere(raw) => region::sphere(&raw.sphere)?.nodes(mesh),
        raw::NodeMembers::Cylinder(raw) => region::cylinder(&raw.cylinder, faults)?.nodes(mesh),
        raw::NodeMembers::HalfSpace(raw) => {
            region::half_space(&raw.half_space, faults)?.nodes(mesh)
        }
    })
}

/// Elements; `None` after a fault.
pub(super) fn elements(
    mesh: &Mesh,
    body: &str,
    raw: &raw::ElementMembers,
    faults: &mut FaultList<'_>,
) -> Option<Found<ElementId>> {
    let sets = &mesh.element_sets;
    Some(match raw {
        raw::ElementMembers::Common(raw) => common("element", sets, body, raw, faults)?.into(),
        raw::ElementMembers::Union(raw) => union("element", sets, body, raw, faults)?.into(),
        raw::ElementMembers::Nodes(raw) => {
            let set = raw.nodes.as_ref()?;
            let nodes = members("node", &mesh.node_sets, body, set, faults)?;
            let hint = format!(
                "no element has all its corners in node set `{}`",
                set.value.0
            );
            Found {
                members: mesh.elements_of(&nodes),
                hint: Some(hint),
            }
        }
        raw::ElementMembers::Facets(raw) => {
            let facets = raw.facets.as_ref()?;
            let facets = members("facet", &mesh.facet_sets, body, facets, faults)?;
            let behind = facets.iter().map(|facet| facet.element);
            behind.collect::<Vec<_>>().into()
        }
        raw::ElementMembers::Listed(raw) => {
            let numbers = raw.numbers.as_ref()?;
            let found = numbered("element", mesh.element_count(), body, numbers, faults)?;
            found.map(ElementId::new).collect::<Vec<_>>().into()
        }
        raw::ElementMembers::Box(raw) => region::cuboid(&raw.from, &raw.to, faults)?.elements(mesh),
        raw::ElementMembers::Sphere(raw) => region::sphere(&raw.sphere)?.elements(mesh),
        raw::ElementMembers::Cylinder(raw) => {
            region::cylinder(&raw.cylinder, faults)?.elements(mesh)
        }
        raw::ElementMembers::HalfSpace(raw) => {
            region::half_space(&raw.half_space, faults)?.elements(mesh)
        }
    })
}

fn named<T: Ord + Copy>(
    kind: &'static str,
    sets: &Sets<T>,
    body: &str,
    names: &[At<Text>],
    faults: &mut FaultList<'_>,
) -> Option<Vec<Vec<T>>> {
    let found: Vec<Vec<T>> = names
        .iter()
        .filter_map(|name| members(kind, sets, body, name, faults))
        .collect();
    (found.len() == names.len()).then_some(found)
}

pub(super) fn union<T: Ord + Copy>(
    kind: &'static str,
    sets: &Sets<T>,
    body: &str,
    raw: &raw::SetUnion,
    faults: &mut FaultList<'_>,
) -> Option<Vec<T>> {
    Some(named(kind, sets, body, &raw.union.as_ref()?.value, faults)?.concat())
}

/// Common members of several sets.
pub(super) fn common<T: Ord + Copy>(
    kind: &'static str,
    sets: &Sets<T>,
    body: &str,
    raw: &raw::CommonMembers,
    faults: &mut FaultList<'_>,
) -> Option<Vec<T>> {
    let sets = named(kind, sets, body, &raw.common.as_ref()?.value, faults)?;
    let (first, rest) = sets.split_first()?;
    let first = first.iter().copied();
    let is_common = |member: &T| rest.iter().all(|set| set.binary_search(member).is_ok());
    Some(first.filter(is_common).collect())
}

/// Numbers of nodes or elements, which are below their count.
fn numbered<'r>(
    kind: &'static str,
    count: usize,
    body: &str,
    raw: &'r At<All<Whole<0>>>,
    faults: &mut FaultList<'_>,
) -> Option<impl Iterator<Item = usize> + use<'r>> {
    let numbers = raw.value.0.iter().map(|number| number.0);
    let largest = numbers.clone().max().unwrap_or(0);
    if largest < count {
        return Some(numbers);
    }
    let cause = format!("there is no {kind} {largest}: it has {kind}s: {count}, from 0");
    unknown_member(body, cause, &raw.span, faults);
    None
}

/// Notes the fault that the mesh of a body has no such member.
pub(super) fn unknown_member(body: &str, cause: String, span: &Span, faults: &mut FaultList<'_>) {
    let owner = format!("body `{body}`");
    faults.push(span, ModelFault::Mesh { owner, cause });
}

/// The node nearest to a place, the first of several.
fn nearest_node(mesh: &Mesh, place: &At<[Number; 3]>) -> NodeId {
    let place = vector(&place.value);
    let distance = |index: &usize| (mesh.positions[*index] - place).norm_squared();
    let nearest = (0..mesh.positions.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    NodeId::new(nearest.unwrap_or(0))
}
