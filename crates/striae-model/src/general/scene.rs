//! The atoms of a draft, what is said of them, and what they are painted with.

use std::collections::BTreeSet;

use crate::{
    check::Draft,
    fault::{Fault, FaultKind},
    model::{BodyId, ContactSurface, RigidId, RigidShape},
    path::Path,
};
use striae_mesh::Face;
use striae_surface::texture::Paint;

use super::{
    atom::{Atom, classes},
    label::{Owner, Part},
    paint::restricted,
    rule::{Couple, Rule, Stated, Undecided},
    taken::Taken,
};

/// Surfaces and the statements about them.
pub(super) struct Scene<'a> {
    pub(super) draft: &'a Draft<'a>,
    pub(super) atoms: Vec<Atom>,
    pub(super) rules: Vec<Rule>,
    pub(super) painted: Vec<(Part, &'a Paint)>,
    taken: Taken,
}

impl<'a> Scene<'a> {
    /// `None` without all meshes and rigid surfaces.
    pub(super) fn new(
        draft: &'a Draft<'a>,
        rules: Vec<Rule>,
        painted: Vec<(Part, &'a Paint)>,
    ) -> Option<Self> {
        let taken = Taken::new(draft);
        let parts: Vec<&Part> = named(&rules, &painted).chain(taken.parts()).collect();
        let mut atoms = Vec::new();
        for (body, of) in draft.bodies.iter().enumerate() {
            let mut skin = of.mesh?.boundary_faces();
            skin.retain(|face| !taken.is_glued(body, face));
            atoms.extend(classes(body, &skin, &parts));
        }
        for (rigid, of) in draft.rigid_surfaces.iter().enumerate() {
            if !matches!(of.part?.shape, RigidShape::Bare) {
                let (owner, faces) = (Owner::Rigid(rigid), Vec::new());
                atoms.push(Atom { owner, faces });
            }
        }
        Some(Self {
            draft,
            atoms,
            rules,
            painted,
            taken,
        })
    }

    /// Returns whether a couple may meet at all, and is in no named pair.
    pub(super) fn is_open(&self, (x, y): Couple) -> bool {
        let [x, y] = [&self.atoms[x], &self.atoms[y]];
        !(self.taken.has([x, y]) || x.is_rigid() && y.is_rigid())
    }

    /// The texture of each atom: the narrowest statement counts.
    pub(super) fn textures(&self, faults: &mut Vec<Fault>) -> Vec<Option<usize>> {
        let members = |(part, _): &(Part, _)| -> BTreeSet<usize> {
            let all = self.atoms.iter().enumerate();
            all.filter(|(_, atom)| atom.is_in(part))
                .map(|(at, _)| at)
                .collect()
        };
        let members: Vec<BTreeSet<usize>> = self.painted.iter().map(members).collect();
        let mut told = BTreeSet::new();
        let mut texture = |atom: usize| {
            let naming = (0..members.len()).filter(|&at| members[at].contains(&atom));
            let least = naming.clone().filter(|&at| {
                let narrower = |other: usize| {
                    members[other].len() < members[at].len()
                        && members[other].is_subset(&members[at])
                };
                !naming.clone().any(narrower)
            });
            match least.collect::<Vec<_>>()[..] {
                [] => None,
                [one] => Some(one),
                [first, second, ..] => {
                    if told.insert((first, second)) {
                        faults.push(self.both_paint(first, second));
                    }
                    None
                }
            }
        };
        let textures = (0..self.atoms.len()).map(&mut texture).collect();
        for (at, _) in members.iter().enumerate().filter(|(_, of)| of.is_empty()) {
            let path = Path::of("contact").field("surface").index(at);
            faults.push(names_nothing(path, format!("`surface` {}", at + 1)));
        }
        textures
    }

    /// The paint of a statement on atoms of one owner.
    pub(super) fn paint(&self, side: &[usize], texture: usize) -> Paint {
        let (part, paint) = &self.painted[texture];
        let Owner::Body(body) = part.owner else {
            return (*paint).clone();
        };
        let Some(mesh) = self.draft.bodies[body].mesh else {
            return (*paint).clone();
        };
        let whole = part.faces.clone();
        let whole = whole.unwrap_or_else(|| mesh.boundary_faces());
        restricted(paint, mesh, &whole, &self.faces(side))
    }

    /// Facets of atoms of one owner, ascending.
    fn faces(&self, side: &[usize]) -> Vec<Face> {
        let faces = side
            .iter()
            .flat_map(|&at| self.atoms[at].faces.iter().copied());
        let mut faces: Vec<Face> = faces.collect();
        faces.sort_unstable();
        faces
    }

    pub(super) fn surface(&self, side: &[usize]) -> ContactSurface {
        match self.atoms[side[0]].owner {
            Owner::Body(body) => ContactSurface::Deformable {
                body: BodyId(body),
                faces: self.faces(side),
            },
            Owner::Rigid(rigid) => ContactSurface::Rigid(RigidId(rigid)),
        }
    }

    /// The fault that neither of two rules is narrower.
    pub(super) fn both_name(&self, found: Undecided) -> Fault {
        let rules = [found.rules.0, found.rules.1].map(|at| &self.rules[at]);
        let parts = || {
            rules
                .iter()
                .flat_map(|rule| [Some(&rule.a), rule.b.as_ref()])
                .flatten()
        };
        let label = |atom: usize| {
            let atom = &self.atoms[atom];
            let naming = parts().filter(|part| atom.is_in(part));
            let size = |part: &&Part| part.faces.as_ref().map_or(usize::MAX, Vec::len);
            let narrowest = naming.min_by_key(size);
            narrowest.map_or_else(|| self.owner(atom), |part| part.label.clone())
        };
        let [first, second] = rules.map(|rule| rule.stated);
        let statements = match (first, second) {
            (Stated::Exclude(_), Stated::Between(_)) | (Stated::Between(_), Stated::Exclude(_)) => {
                format!("{} and {}", first.told(), second.told())
            }
            _ => format!("{} and {}", first.told(), second.place().1 + 1),
        };
        Fault {
            path: second.path(),
            kind: FaultKind::BothName {
                statements,
                a: label(found.couple.0),
                b: label(found.couple.1),
            },
        }
    }

    /// The fault that neither of two textures is that of a narrower surface.
    fn both_paint(&self, first: usize, second: usize) -> Fault {
        let [one, other] = [first, second].map(|at| &self.painted[at].0.label);
        Fault {
            path: Path::of("contact").field("surface").index(second),
            kind: FaultKind::BothPaint {
                first: first + 1,
                second: second + 1,
                labels: [one.clone(), other.clone()],
            },
        }
    }

    fn owner(&self, atom: &Atom) -> String {
        match atom.owner {
            Owner::Body(body) => self.draft.bodies[body].name.to_owned(),
            Owner::Rigid(rigid) => self.draft.rigid_surfaces[rigid].name.to_owned(),
        }
    }
}

/// Parts that statements name.
pub(super) fn named<'s>(
    rules: &'s [Rule],
    painted: &'s [(Part, &Paint)],
) -> impl Iterator<Item = &'s Part> {
    let rules = rules
        .iter()
        .flat_map(|rule| [Some(&rule.a), rule.b.as_ref()]);
    rules.flatten().chain(painted.iter().map(|(part, _)| part))
}

/// The fault that a statement names nothing that is left to touch.
pub(super) fn names_nothing(path: Path, statement: String) -> Fault {
    let kind = FaultKind::NothingToTouch { statement };
    Fault { path, kind }
}
