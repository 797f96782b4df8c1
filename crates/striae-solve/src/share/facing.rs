//! Elements that face each other across contact pairs and ties.

use std::collections::BTreeMap;

use striae_contact::search::{Bounds, Tree};

use crate::model::{ContactSurface, Model};

/// Nodes that it costs as much to exchange as to evaluate, on one rank more, the contact of a
/// facet with the one that it faces.
const CONTACT: u32 = 16;
/// Nodes that a tied facet has in common with the one that it faces.
const TIED: u32 = 4;
/// How far the nearest facet of the other side may be, in sizes of a facet's box.
const REACH: f64 = 2.0;

/// What couples elements that have no nodes in common, by numbers of elements of all bodies,
/// one body after the other.
#[derive(Debug, Default)]
pub(super) struct Facing {
    /// Elements that face an element, with what it costs to have them on two ranks.
    neighbours: BTreeMap<u32, BTreeMap<u32, u32>>,
    /// How many faces of pairs between bodies an element has.
    faces: BTreeMap<u32, u32>,
}

impl Facing {
    /// Elements behind the facets of a side are neighbours of those behind the nearest facets of
    /// the other side, where these are near when the analysis begins.
    pub(super) fn new(model: &Model) -> Self {
        let mut facing = Self::default();
        let pairs = model.pairs.iter().map(|pair| ([&pair.a, &pair.b], CONTACT));
        let ties = model.ties.iter().map(|tie| ([&tie.a, &tie.b], TIED));
        for (sides, cost) in pairs.chain(ties) {
            let [Some(a), Some(b)] = sides.map(|side| Facets::new(model, side)) else {
                continue;
            };
            facing.join(&a, &b, cost);
            facing.join(&b, &a, cost);
            if cost == CONTACT {
                for element in a.elements.iter().chain(&b.elements) {
                    *facing.faces.entry(*element).or_default() += 1;
                }
            }
        }
        facing
    }

    fn join(&mut self, from: &Facets, to: &Facets, cost: u32) {
        for (one, bounds) in from.elements.iter().zip(&from.boxes) {
            let Some(other) = to.nearest(bounds).filter(|other| other != one) else {
                continue;
            };
            for [one, other] in [[*one, other], [other, *one]] {
                *self
                    .neighbours
                    .entry(one)
                    .or_default()
                    .entry(other)
                    .or_default() += cost;
            }
        }
    }

    /// Elements that face an element, with what it costs to have them on two ranks.
    pub(super) fn neighbours(&self, element: u32) -> impl Iterator<Item = (u32, u32)> {
        let of_element = self.neighbours.get(&element);
        of_element
            .into_iter()
            .flatten()
            .map(|(other, cost)| (*other, *cost))
    }

    /// How many faces of pairs between bodies an element has.
    pub(super) fn faces(&self, element: u32) -> u32 {
        self.faces.get(&element).copied().unwrap_or(0)
    }
}

/// Facets of a side with the elements behind them.
struct Facets {
    elements: Vec<u32>,
    boxes: Vec<Bounds>,
    tree: Tree,
}

impl Facets {
    /// `None` for a rigid surface.
    fn new(model: &Model, side: &ContactSurface) -> Option<Self> {
        let ContactSurface::Deformable { body, faces } = side else {
            return None;
        };
        let before = model.bodies[..body.0].iter();
        let first: usize = before.map(|body| body.mesh.element_count()).sum();
        let mesh = &model.bodies[body.0].mesh;
        let boxes: Vec<Bounds> = faces
            .iter()
            .map(|face| Bounds::around(mesh.face_positions(*face)))
            .collect();
        let number = |element: usize| (first + element) as u32;
        Some(Self {
            elements: faces
                .iter()
                .map(|face| number(face.element.index()))
                .collect(),
            tree: Tree::new(boxes.clone()),
            boxes,
        })
    }

    /// Element of the facet that is nearest to the middle of a facet of the other side; of
    /// several as near, as boxes may overlap, the one with the nearest middle.
    fn nearest(&self, of: &Bounds) -> Option<u32> {
        let middle = of.middle();
        let reach = REACH * (of.high - of.low).norm();
        let mut best = (reach * reach, f64::INFINITY, None);
        self.tree.visit_nearest(&middle, |item| {
            let bounds = &self.boxes[item as usize];
            let distance = bounds.squared_distance(&middle);
            let between = (bounds.middle() - middle).norm_squared();
            if (distance, between) < (best.0, best.1) {
                best = (distance, between, Some(item));
            }
            distance
        });
        best.2.map(|item| self.elements[item as usize])
    }
}
