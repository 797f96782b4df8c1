//! Sets of nodes, facets and elements that a deck makes besides those of the mesh.

use crate::{
    fault::FaultKind,
    faults::FaultList,
    raw,
    read::At,
    value::{All, Number, Text, Whole, vector},
};
use std::collections::BTreeSet;
use striae_mesh::{ElementId, Face, Mesh, NodeId, Sets, Vec3};
use striae_model::FaultKind as ModelFault;

/// By how much of its size a box is widened, so that nodes on its sides are inside.
const MARGIN: f64 = 1e-9;

/// Adds the node sets of a body to its mesh, in their order.
pub(super) fn add_node_sets(
    mesh: &mut Mesh,
    body: &str,
    raw: &[At<raw::NodeSet>],
    faults: &mut FaultList<'_>,
) {
    for At { value: raw, .. } in raw {
        let (Some(name), Some(members)) = (&raw.name, &raw.members) else {
            continue;
        };
        let members = match members {
            raw::NodeMembers::Nearest(raw) => raw
                .nearest
                .as_ref()
                .map(|place| vec![nearest_node(mesh, place)]),
            raw::NodeMembers::Common(raw) => raw.common.as_ref().and_then(|names| {
                let sets = named("node", &mesh.node_sets, body, &names.value, faults)?;
                let (first, rest) = sets.split_first()?;
                Some(
                    first
                        .iter()
                        .filter(|node| rest.iter().all(|set| set.contains(node)))
                        .copied()
                        .collect(),
                )
            }),
            raw::NodeMembers::Union(raw) => union("node", &mesh.node_sets, body, raw, faults),
            raw::NodeMembers::Box(raw) => region(&raw.from, &raw.to).map(|inside| {
                let nodes = mesh.positions.iter().enumerate().filter(|(_, x)| inside(x));
                nodes.map(|(index, _)| NodeId::new(index)).collect()
            }),
            raw::NodeMembers::Listed(raw) => listed_nodes(mesh, body, raw, faults),
        };
        if let Some(members) = members {
            insert("node", &mut mesh.node_sets, body, name, members, faults);
        }
    }
}

/// Adds the facet sets of a body to its mesh, in their order.
pub(super) fn add_facet_sets(
    mesh: &mut Mesh,
    body: &str,
    raw: &[At<raw::FacetSet>],
    faults: &mut FaultList<'_>,
) {
    for At { value: raw, .. } in raw {
        let (Some(name), Some(members)) = (&raw.name, &raw.members) else {
            continue;
        };
        let members: Option<Vec<Face>> = match members {
            raw::FacetMembers::Union(raw) => union("facet", &mesh.facet_sets, body, raw, faults),
            raw::FacetMembers::Box(raw) => raw.of.as_ref().and_then(|of| {
                let faces = named(
                    "facet",
                    &mesh.facet_sets,
                    body,
                    std::slice::from_ref(of),
                    faults,
                )?
                .concat();
                let inside = region(&raw.from, &raw.to)?;
                Some(
                    faces
                        .into_iter()
                        .filter(|face| mesh.face_positions(*face).iter().all(&inside))
                        .collect(),
                )
            }),
            raw::FacetMembers::Listed(raw) => listed_facets(mesh, body, raw, faults),
        };
        if let Some(members) = members {
            insert("facet", &mut mesh.facet_sets, body, name, members, faults);
        }
    }
}

/// Adds the element sets of a body to its mesh, in their order.
pub(super) fn add_element_sets(
    mesh: &mut Mesh,
    body: &str,
    raw: &[At<raw::ElementSet>],
    faults: &mut FaultList<'_>,
) {
    for At { value: raw, .. } in raw {
        let (Some(name), Some(members)) = (&raw.name, &raw.members) else {
            continue;
        };
        let members = match members {
            raw::ElementMembers::Union(raw) => {
                union("element", &mesh.element_sets, body, raw, faults)
            }
            raw::ElementMembers::Box(raw) => region(&raw.from, &raw.to).map(|inside| {
                let is_inside = |node: &NodeId| inside(&mesh.positions[node.index()]);
                let elements = mesh.elements().enumerate();
                let elements = elements.filter(|(_, corners)| corners.iter().all(is_inside));
                elements.map(|(index, _)| ElementId::new(index)).collect()
            }),
            raw::ElementMembers::Listed(raw) => listed_elements(mesh, body, raw, faults),
        };
        if let Some(members) = members {
            insert(
                "element",
                &mut mesh.element_sets,
                body,
                name,
                members,
                faults,
            );
        }
    }
}

/// The members of the set of that name, or `None` after a fault.
pub(super) fn members<T: Ord + Copy>(
    kind: &'static str,
    sets: &Sets<T>,
    body: &str,
    set: &At<Text>,
    faults: &mut FaultList<'_>,
) -> Option<Vec<T>> {
    let members = ModelFault::members(kind, sets, body, &set.value.0);
    members
        .map(<[T]>::to_vec)
        .map_err(|fault| faults.push(&set.span, *fault))
        .ok()
}

fn insert<T: Ord + Copy>(
    kind: &'static str,
    sets: &mut Sets<T>,
    body: &str,
    name: &At<Text>,
    members: Vec<T>,
    faults: &mut FaultList<'_>,
) {
    let (body, set) = (body.to_owned(), name.value.0.clone());
    if sets.get(&set).is_some() {
        faults.push(
            &name.span,
            FaultKind::DuplicateSet {
                body,
                kind,
                name: set,
            },
        );
    } else if members.is_empty() {
        faults.push(
            &name.span,
            ModelFault::EmptySet {
                body,
                kind,
                name: set,
            },
        );
    } else {
        sets.insert(set, members);
    }
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

fn union<T: Ord + Copy>(
    kind: &'static str,
    sets: &Sets<T>,
    body: &str,
    raw: &raw::SetUnion,
    faults: &mut FaultList<'_>,
) -> Option<Vec<T>> {
    Some(named(kind, sets, body, &raw.union.as_ref()?.value, faults)?.concat())
}

/// Nodes by number.
fn listed_nodes(
    mesh: &Mesh,
    body: &str,
    raw: &raw::ListedNodes,
    faults: &mut FaultList<'_>,
) -> Option<Vec<NodeId>> {
    let nodes = listed("node", mesh.positions.len(), body, &raw.numbers, faults)?;
    Some(nodes.map(NodeId::new).collect())
}

/// Elements by number.
fn listed_elements(
    mesh: &Mesh,
    body: &str,
    raw: &raw::ListedElements,
    faults: &mut FaultList<'_>,
) -> Option<Vec<ElementId>> {
    let elements = listed("element", mesh.element_count(), body, &raw.numbers, faults)?;
    Some(elements.map(ElementId::new).collect())
}

/// Numbers of what there are so many of.
fn listed<'r>(
    kind: &'static str,
    count: usize,
    body: &str,
    numbers: &'r Option<At<All<Whole<0>>>>,
    faults: &mut FaultList<'_>,
) -> Option<impl Iterator<Item = usize> + use<'r>> {
    let numbers = numbers.as_ref()?;
    let members = numbers.value.0.iter().map(|number| number.0);
    let largest = members.clone().max().unwrap_or(0);
    if largest >= count {
        let cause = format!("there is no {kind} {largest}: it has {kind}s: {count}, from 0");
        faults.push(&numbers.span, unknown_member(body, cause));
        return None;
    }
    Some(members)
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
        let face = u8::try_from(side).ok().map(|side| Face {
            element: ElementId::new(element),
            side,
        });
        match face.filter(|face| boundary.contains(face)) {
            Some(face) => faces.push(face),
            None => {
                let cause = format!("side {side} of element {element} is not on its boundary");
                faults.push(span, unknown_member(body, cause));
                return None;
            }
        }
    }
    Some(faces)
}

fn unknown_member(body: &str, cause: String) -> ModelFault {
    ModelFault::Mesh {
        owner: format!("body `{body}`"),
        cause,
    }
}

/// The node nearest to a place, the first of several.
fn nearest_node(mesh: &Mesh, place: &At<[Number; 3]>) -> NodeId {
    let place = vector(&place.value);
    let distance = |index: &usize| (mesh.positions[*index] - place).norm_squared();
    let nearest = (0..mesh.positions.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)));
    NodeId::new(nearest.unwrap_or(0))
}

/// Whether a point is in the box.
fn region(
    from: &Option<At<[Number; 3]>>,
    to: &Option<At<[Number; 3]>>,
) -> Option<impl Fn(&Vec3) -> bool + use<>> {
    let (from, to) = (vector(&from.as_ref()?.value), vector(&to.as_ref()?.value));
    let margin = MARGIN * (to - from).norm();
    Some(move |x: &Vec3| {
        (0..3).all(|axis| (from[axis] - margin..=to[axis] + margin).contains(&x[axis]))
    })
}
