//! Names that stand for ids and members; unknown ones are faults.

use crate::{
    check::Known,
    fault::{Fault, FaultKind},
    model::{Body, BodyId, CavityId, PairId, RigidId},
    names::nearest,
    path::Path,
};
use striae_mesh::{Face, NodeId, Sets};

/// Parts that names may refer to.
pub(super) struct Names<'a> {
    bodies: &'a [Body],
    rigid: Vec<&'a str>,
    pairs: Vec<&'a str>,
    pub(super) cavities: Vec<&'a str>,
    /// Returns whether there are no other pairs.
    pairs_known: Known,
}

impl<'a> Names<'a> {
    pub(super) fn new(bodies: &'a [Body], rigid: Vec<&'a str>, pairs: Vec<&'a str>) -> Self {
        Self {
            bodies,
            rigid,
            pairs,
            cavities: Vec::new(),
            pairs_known: Known::Whole,
        }
    }

    /// Returns the names where there may be other pairs, whose names are not known here.
    pub(super) fn with_other_pairs(self) -> Self {
        Self {
            pairs_known: Known::InPart,
            ..self
        }
    }

    pub(super) fn body(&self, name: &str, path: &Path, faults: &mut Vec<Fault>) -> Option<BodyId> {
        let known: Vec<&str> = self.bodies.iter().map(|body| body.name.as_str()).collect();
        find("body", name, &known, path, faults).map(BodyId)
    }

    /// Number of a section of a body by its element set.
    pub(super) fn section(
        &self,
        body: BodyId,
        set: &str,
        path: &Path,
        faults: &mut Vec<Fault>,
    ) -> Option<usize> {
        let sections = self.bodies[body.0].sections.iter();
        let known: Vec<&str> = sections.map(|section| section.set.as_str()).collect();
        find("section", set, &known, path, faults).map(|at| at + 1)
    }

    pub(super) fn rigid(
        &self,
        name: &str,
        path: &Path,
        faults: &mut Vec<Fault>,
    ) -> Option<RigidId> {
        find("rigid surface", name, &self.rigid, path, faults).map(RigidId)
    }

    pub(super) fn cavity(
        &self,
        name: &str,
        path: &Path,
        faults: &mut Vec<Fault>,
    ) -> Option<CavityId> {
        find("cavity", name, &self.cavities, path, faults).map(CavityId)
    }

    pub(super) fn pair(&self, name: &str, path: &Path, faults: &mut Vec<Fault>) -> Option<PairId> {
        let position = self.pairs.iter().position(|known| *known == name);
        if position.is_none() && self.pairs_known == Known::InPart {
            return None;
        }
        find("pair", name, &self.pairs, path, faults).map(PairId)
    }

    /// A body and the nodes of one of its sets.
    pub(super) fn nodes(
        &self,
        body: &str,
        set: &str,
        path: &Path,
        faults: &mut Vec<Fault>,
    ) -> Option<(BodyId, Vec<NodeId>)> {
        let id = self.body(body, path, faults)?;
        let sets = &self.bodies[id.0].mesh.node_sets;
        Some((id, members("node", sets, body, set, path, faults)?))
    }

    /// A body and the faces of one of its sets.
    pub(super) fn faces(
        &self,
        body: &str,
        set: &str,
        path: &Path,
        faults: &mut Vec<Fault>,
    ) -> Option<(BodyId, Vec<Face>)> {
        let id = self.body(body, path, faults)?;
        let sets = &self.bodies[id.0].mesh.facet_sets;
        Some((id, members("facet", sets, body, set, path, faults)?))
    }
}

fn find(
    kind: &'static str,
    name: &str,
    known: &[&str],
    path: &Path,
    faults: &mut Vec<Fault>,
) -> Option<usize> {
    let position = known.iter().position(|known| *known == name);
    if position.is_none() {
        let mut known: Vec<String> = known.iter().map(|name| (*name).to_owned()).collect();
        known.sort();
        known.dedup();
        let kind = FaultKind::UnknownName {
            kind,
            name: name.to_owned(),
            nearest: nearest(name, known.iter().map(String::as_str)),
            known,
        };
        faults.push(Fault {
            path: path.clone(),
            kind,
        });
    }
    position
}

fn members<T: Ord + Copy>(
    kind: &'static str,
    sets: &Sets<T>,
    body: &str,
    set: &str,
    path: &Path,
    faults: &mut Vec<Fault>,
) -> Option<Vec<T>> {
    let kind = match FaultKind::members(kind, sets, body, set) {
        Ok(members) => return Some(members.to_vec()),
        Err(kind) => *kind,
    };
    faults.push(Fault {
        path: path.clone(),
        kind,
    });
    None
}

impl FaultKind {
    /// The members of a set of nodes or facets of a body.
    ///
    /// # Errors
    /// The fault that it has no such set, or an empty one.
    pub fn members<'s, T: Ord + Copy>(
        kind: &'static str,
        sets: &'s Sets<T>,
        body: &str,
        set: &str,
    ) -> Result<&'s [T], Box<Self>> {
        let (body, name) = (body.to_owned(), set.to_owned());
        match sets.get(set) {
            Some([]) => Err(Box::new(Self::EmptySet { body, kind, name })),
            Some(members) => Ok(members),
            None => Err(Box::new(Self::UnknownSet {
                body,
                kind,
                nearest: nearest(set, sets.names()),
                name,
                known: sets.names().map(str::to_owned).collect(),
            })),
        }
    }
}
