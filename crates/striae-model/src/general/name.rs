//! Names of sides and of pairs.

use std::collections::BTreeMap;

use striae_mesh::Face;

use super::{
    atom::Atom,
    label::{Owner, Part},
};
use crate::check::Draft;

/// Names that are given so far.
pub(super) struct Names<'a> {
    draft: &'a Draft<'a>,
    atoms: &'a [Atom],
    parts: &'a [&'a Part],
    sides: BTreeMap<Vec<usize>, String>,
    taken: Vec<String>,
}

impl<'a> Names<'a> {
    pub(super) fn new(draft: &'a Draft<'a>, atoms: &'a [Atom], parts: &'a [&'a Part]) -> Self {
        Self {
            draft,
            atoms,
            parts,
            sides: BTreeMap::new(),
            taken: draft
                .pairs
                .iter()
                .map(|pair| pair.name.to_owned())
                .collect(),
        }
    }

    /// The names of pairs by their sides, `tread-road`. Several pairs of one such name, as `x` and
    /// `y-z` beside `x-y` and `z` would be, say where their sides meet: `x--y-z` and `x-y--z`.
    pub(super) fn pairs(&mut self, sides: &[[Vec<usize>; 2]]) -> Vec<String> {
        let labels = sides.iter().map(|[a, b]| [self.side(a), self.side(b)]);
        let labels: Vec<[String; 2]> = labels.collect();
        let mut count: BTreeMap<String, usize> = BTreeMap::new();
        for label in &labels {
            *count.entry(label.join("-")).or_default() += 1;
        }
        let names = labels.iter().map(|label| {
            let name = label.join("-");
            let name = if count[&name] > 1 {
                label.join("--")
            } else {
                name
            };
            let name = free(&name, |name| self.taken.iter().any(|taken| taken == name));
            self.taken.push(name.clone());
            name
        });
        names.collect()
    }

    /// The label that says what these atoms of one owner are: that of the body or rigid surface,
    /// of a statement or of a facet set; else it is a rest.
    fn side(&mut self, members: &[usize]) -> String {
        if let Some(known) = self.sides.get(members) {
            return known.clone();
        }
        let owner = self.atoms[members[0]].owner;
        let name = match owner {
            Owner::Body(body) => self.of_body(body, members),
            Owner::Rigid(rigid) => self.draft.rigid_surfaces[rigid].name.to_owned(),
        };
        self.sides.insert(members.to_vec(), name.clone());
        name
    }

    fn of_body(&self, body: usize, members: &[usize]) -> String {
        let draft = &self.draft.bodies[body];
        let whole = (self.atoms.iter().enumerate())
            .filter(|(_, atom)| atom.owner == Owner::Body(body))
            .map(|(at, _)| at);
        if whole.clone().eq(members.iter().copied()) {
            return draft.name.to_owned();
        }
        let is = |part: &&&Part| {
            let inside = whole.clone().filter(|&at| self.atoms[at].is_in(part));
            !part.label.is_empty() && inside.eq(members.iter().copied())
        };
        if let Some(part) = self.parts.iter().find(is) {
            return part.label.clone();
        }
        let mut faces: Vec<Face> = (members.iter())
            .flat_map(|&at| self.atoms[at].faces.iter().copied())
            .collect();
        faces.sort_unstable();
        let mut sets = draft
            .mesh
            .into_iter()
            .flat_map(|mesh| mesh.facet_sets.iter());
        match sets.find(|(_, members)| *members == faces) {
            Some((set, _)) => format!("{}.{set}", draft.name),
            // A set with this name has labels of its own, which steps and statements use.
            None => free(&format!("{}.rest", draft.name), |name| {
                let set = name
                    .strip_prefix(draft.name)
                    .and_then(|set| set.strip_prefix('.'));
                let mut sets = draft
                    .mesh
                    .into_iter()
                    .flat_map(|mesh| mesh.facet_sets.names());
                sets.any(|known| Some(known) == set)
                    || self.sides.values().any(|taken| taken == name)
            }),
        }
    }
}

/// The name, or the first of `name-2`, `name-3`, ... that is not taken.
fn free(name: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let numbered = (2..).map(|number: usize| format!("{name}-{number}"));
    let mut names = std::iter::once(name.to_owned()).chain(numbered);
    names
        .find(|name| !is_taken(name))
        .expect("there are more numbers than names")
}
