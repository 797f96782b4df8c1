//! Couples that are not left to contact of everything: named pairs, ties, facets that follow rigid bodies.

use std::collections::BTreeSet;

use crate::{
    check::Draft,
    model::{BodyId, ContactSurface, Pair, Tie},
    tie::covered,
};
use striae_mesh::{Face, NodeId};

use super::{
    atom::Atom,
    label::{Owner, Part},
};

/// Part of a facet from which on it is glued as a whole.
const GLUED: f64 = 0.5;

/// Couples and facets that something else has.
pub(super) struct Taken {
    /// Both sides of named pairs, and facets of ties that are glued in part.
    couples: Vec<[Part; 2]>,
    /// Facets that are glued, by body.
    glued: Vec<BTreeSet<Face>>,
}

impl Taken {
    pub(super) fn new(draft: &Draft<'_>) -> Self {
        let pairs = draft.pairs.iter().filter_map(|of| sides(of.pair?));
        let mut taken = Self {
            couples: pairs.chain(following(draft)).collect(),
            glued: vec![BTreeSet::new(); draft.bodies.len()],
        };
        for tie in draft.ties.iter().filter_map(|tie| tie.part) {
            taken.add(draft, tie);
        }
        taken
    }

    fn add(&mut self, draft: &Draft<'_>, tie: &Tie) {
        let side = |surface: &ContactSurface| match surface {
            ContactSurface::Deformable { body, faces } => Some((body.0, faces.clone())),
            ContactSurface::Rigid(_) | ContactSurface::Itself => None,
        };
        let (Some(a), Some(b)) = (side(&tie.a), side(&tie.b)) else {
            return;
        };
        let meshes = [a.0, b.0].map(|body| draft.bodies[body].mesh);
        let [Some(mesh_a), Some(mesh_b)] = meshes else {
            return;
        };
        let cover = covered([(mesh_a, &a.1), (mesh_b, &b.1)], tie.within);
        let mut in_part = Vec::new();
        for ((body, faces), cover) in [a, b].into_iter().zip(cover) {
            let faces = faces.into_iter().zip(cover);
            let (whole, rest): (Vec<_>, Vec<_>) = faces.partition(|(_, part)| *part >= GLUED);
            let rest = rest.into_iter().filter(|(_, part)| *part > 0.0);
            in_part.push(unnamed(body, rest.map(|(face, _)| face).collect()));
            self.glued[body].extend(whole.into_iter().map(|(face, _)| face));
        }
        let [a, b] = [in_part.remove(0), in_part.remove(0)];
        self.couples.push([a, b]);
    }

    /// Parts that distinguish facets.
    pub(super) fn parts(&self) -> impl Iterator<Item = &Part> {
        self.couples.iter().flatten()
    }

    /// Returns whether a facet is glued.
    pub(super) fn is_glued(&self, body: usize, face: &Face) -> bool {
        self.glued[body].contains(face)
    }

    /// Returns whether two atoms are a couple of something else.
    pub(super) fn has(&self, [x, y]: [&Atom; 2]) -> bool {
        let both = |[a, b]: &[Part; 2]| x.is_in(a) && y.is_in(b) || x.is_in(b) && y.is_in(a);
        self.couples.iter().any(both)
    }
}

/// Both sides of a pair, the first one twice where it touches itself.
fn sides(pair: &Pair) -> Option<[Part; 2]> {
    let side = |surface: &ContactSurface| match surface {
        ContactSurface::Deformable { body, faces } => Some(unnamed(body.0, faces.clone())),
        ContactSurface::Rigid(rigid) => Some(of_rigid(rigid.0)),
        ContactSurface::Itself => None,
    };
    let [a, b] = pair.surfaces().map(side);
    Some([a?, b?])
}

/// Facets of which all nodes are tied to a rigid surface, and that surface.
fn following(draft: &Draft<'_>) -> Vec<[Part; 2]> {
    let rigid = draft.rigid_surfaces.iter().enumerate();
    let ties = rigid.flat_map(|(at, of)| {
        let ties = of.part.map_or(&[][..], |part| &part.ties);
        ties.iter().map(move |tie| (at, tie))
    });
    let following = ties.filter_map(|(rigid, (body, nodes)): (usize, &(BodyId, Vec<NodeId>))| {
        let faces = draft.bodies[body.0].mesh?.faces_of_nodes(nodes);
        Some([unnamed(body.0, faces), of_rigid(rigid)])
    });
    following.collect()
}

fn of_rigid(rigid: usize) -> Part {
    Part {
        label: String::new(),
        owner: Owner::Rigid(rigid),
        faces: None,
    }
}

fn unnamed(body: usize, mut faces: Vec<Face>) -> Part {
    faces.sort_unstable();
    Part {
        label: String::new(),
        owner: Owner::Body(body),
        faces: Some(faces),
    }
}
