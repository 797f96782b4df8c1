//! Sets of nodes, facets and elements that a deck makes besides those of the mesh.
//!
//! A definition may name sets of the mesh and of the deck in any order: those come first whose
//! sets are there. What cannot be made like that is refused in `order`.

mod facets;
mod found;
mod members;
mod order;
mod region;

use crate::{fault::FaultKind, faults::FaultList, raw, read::At, value::Text};
use found::Found;
use members::Sources;
use striae_mesh::{Mesh, Sets};
use striae_model::FaultKind as ModelFault;

use super::list;

/// A set that the deck makes.
#[derive(Clone, Copy)]
enum Definition<'r> {
    Nodes(&'r raw::NodeSet),
    Facets(&'r raw::FacetSet),
    Elements(&'r raw::ElementSet),
}

/// Kind of the members of a set.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kind {
    Node,
    Facet,
    Element,
}

impl Kind {
    fn word(self) -> &'static str {
        match self {
            Self::Node => "node",
            Self::Facet => "facet",
            Self::Element => "element",
        }
    }
}

/// A set by what its members are and its name.
type Named<'r> = (Kind, &'r str);

/// Adds the sets of a body to its mesh, and those called `all` that it has not.
pub(super) fn add_sets(mesh: &mut Mesh, body: &str, raw: &raw::Body, faults: &mut FaultList<'_>) {
    let elements = list(&raw.element_sets).iter();
    let elements = elements.map(|set| Definition::Elements(&set.value));
    let nodes = list(&raw.node_sets).iter();
    let nodes = nodes.map(|set| Definition::Nodes(&set.value));
    let facets = list(&raw.facet_sets).iter();
    let facets = facets.map(|set| Definition::Facets(&set.value));
    let all: Vec<Definition<'_>> = elements.chain(nodes).chain(facets).collect();
    name_all(mesh, &all);
    let (mut left, mut faulty) = (all, Vec::new());
    loop {
        let is_ready = |definition: &Definition<'_>| {
            let mut needs = definition.needs().into_iter();
            needs.all(|need| has(mesh, need))
        };
        let (ready, waiting): (Vec<_>, Vec<_>) = left.into_iter().partition(is_ready);
        left = waiting;
        if ready.is_empty() {
            break;
        }
        for definition in ready {
            if !definition.add(mesh, body, faults) {
                faulty.extend(definition.name());
            }
        }
    }
    order::refuse(left, faulty, mesh, body, faults);
}

/// Names all facets and all elements, where the deck does not give these names.
fn name_all(mesh: &mut Mesh, definitions: &[Definition<'_>]) {
    let is_free = |kind: Kind| {
        let mut names = definitions.iter().map(|definition| definition.name());
        names.all(|name| name != Some((kind, "all")))
    };
    if is_free(Kind::Facet) {
        mesh.name_all_facets();
    }
    if is_free(Kind::Element) {
        mesh.name_all_elements();
    }
}

fn has(mesh: &Mesh, (kind, set): Named<'_>) -> bool {
    match kind {
        Kind::Node => mesh.node_sets.get(set).is_some(),
        Kind::Facet => mesh.facet_sets.get(set).is_some(),
        Kind::Element => mesh.element_sets.get(set).is_some(),
    }
}

impl<'r> Definition<'r> {
    fn name(self) -> Option<Named<'r>> {
        let (kind, name) = self.stated();
        name.map(|name| (kind, &name.value.0[..]))
    }

    /// Kind, and name as it is written.
    fn stated(self) -> (Kind, Option<&'r At<Text>>) {
        match self {
            Self::Nodes(set) => (Kind::Node, set.name.as_ref()),
            Self::Facets(set) => (Kind::Facet, set.name.as_ref()),
            Self::Elements(set) => (Kind::Element, set.name.as_ref()),
        }
    }

    /// Sets that have to be there before.
    fn needs(self) -> Vec<Named<'r>> {
        let sources = match self {
            Self::Nodes(set) => set.members.as_ref().map(members::nodes_needed),
            Self::Facets(set) => set.members.as_ref().map(facets::needed),
            Self::Elements(set) => set.members.as_ref().map(members::elements_needed),
        };
        let Some(Sources(sources)) = sources else {
            return Vec::new();
        };
        let names = sources.into_iter();
        names
            .map(|(kind, name)| (kind, &name.value.0[..]))
            .collect()
    }

    /// Adds the set; whether it is there now.
    fn add(self, mesh: &mut Mesh, body: &str, faults: &mut FaultList<'_>) -> bool {
        let added = match self {
            Self::Nodes(raw::NodeSet { name, members, .. }) => {
                let found = members.as_ref();
                let found = found.and_then(|raw| members::nodes(mesh, body, raw, faults));
                insert("node", &mut mesh.node_sets, body, name, found, faults)
            }
            Self::Facets(raw::FacetSet { name, members, .. }) => {
                let found = members.as_ref();
                let found = found.and_then(|raw| facets::facets(mesh, body, raw, faults));
                insert("facet", &mut mesh.facet_sets, body, name, found, faults)
            }
            Self::Elements(raw::ElementSet { name, members, .. }) => {
                let found = members.as_ref();
                let found = found.and_then(|raw| members::elements(mesh, body, raw, faults));
                insert("element", &mut mesh.element_sets, body, name, found, faults)
            }
        };
        added.is_some()
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

/// Adds a set that has members and a name of its own; `None` after a fault.
fn insert<T: Ord + Copy>(
    kind: &'static str,
    sets: &mut Sets<T>,
    body: &str,
    name: &Option<At<Text>>,
    found: Option<Found<T>>,
    faults: &mut FaultList<'_>,
) -> Option<()> {
    let (At { value, span }, Found { mut members, hint }) = (name.as_ref()?, found?);
    let (body, set) = (body.to_owned(), value.0.clone());
    members.sort_unstable();
    members.dedup();
    match sets.get(&set) {
        Some(_) => {
            let name = set;
            faults.push(span, FaultKind::DuplicateSet { body, kind, name });
            return None;
        }
        None if members.is_empty() => {
            let name = set;
            let fault = match hint {
                None => ModelFault::EmptySet { body, kind, name }.into(),
                Some(cause) => FaultKind::NothingChosen {
                    body,
                    kind,
                    name,
                    cause,
                },
            };
            faults.push(span, fault);
            return None;
        }
        None => sets.insert(set, members),
    }
    Some(())
}
