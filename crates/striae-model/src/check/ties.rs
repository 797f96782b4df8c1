//! Sides of ties, and pairs of what is tied.

use std::collections::BTreeSet;

use crate::{
    fault::FaultKind,
    model::{BodyId, ContactSurface, Tie},
    path::Path,
    tie::{TieFault, covered},
};
use striae_mesh::Face;

use super::{Draft, List};

/// Notes faults of all ties that do not need their place.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, named) in draft.ties.iter().enumerate() {
        let Some(tie) = named.part else { continue };
        let path = Path::part("ties", index);
        if let Some(distance) = tie.within.filter(|distance| !is_positive(*distance)) {
            let kind = FaultKind::Range {
                what: format!("`within` of tie `{}`", tie.name),
                expected: "larger than zero",
                found: distance,
            };
            faults.push(path.clone().field("within"), kind);
        }
        let (Some(a), Some(b)) = (faces(&tie.a), faces(&tie.b)) else {
            let fault = TieFault::Rigid {
                tie: tie.name.clone(),
            };
            faults.push(path, FaultKind::Tie { fault });
            continue;
        };
        if a.0 == b.0 {
            let fault = TieFault::SameBody {
                tie: tie.name.clone(),
                body: draft.bodies[a.0.0].name.to_owned(),
            };
            faults.push(path, FaultKind::Tie { fault });
            continue;
        }
        if let Some(pair) = pair_of(draft, [a, b], tie.within) {
            let (tie, pair) = (tie.name.clone(), pair.to_owned());
            faults.push(path.clone(), FaultKind::TiedPair { tie, pair });
        }
        let earlier = draft.ties[..index].iter().filter_map(|named| named.part);
        if let Some(other) = earlier.clone().find(|other| joins(other, [a, b])) {
            let (tie, other) = (tie.name.clone(), other.name.clone());
            faults.push(path, FaultKind::SameTie { tie, other });
        }
    }
}

type Surface<'a> = (BodyId, &'a [Face]);

fn is_positive(number: f64) -> bool {
    number > 0.0 && number.is_finite()
}

fn faces(side: &ContactSurface) -> Option<Surface<'_>> {
    match side {
        ContactSurface::Deformable { body, faces } => Some((*body, faces)),
        ContactSurface::Rigid(_) | ContactSurface::Itself => None,
    }
}

/// A pair that has facets of both surfaces that are glued on its two sides.
fn pair_of<'d>(draft: &Draft<'d>, tied: [Surface<'_>; 2], within: Option<f64>) -> Option<&'d str> {
    let pairs = draft.pairs.iter().filter_map(|named| named.pair);
    let both = pairs.filter_map(|pair| Some((pair, [faces(&pair.a)?, faces(&pair.b)?])));
    let mut both = both.filter(|(_, sides)| share(*sides, tied)).peekable();
    both.peek()?;
    let [Some(a), Some(b)] = tied.map(|(body, _)| draft.bodies[body.0].mesh) else {
        return None;
    };
    let cover = covered([(a, tied[0].1), (b, tied[1].1)], within);
    let glued = |side: usize| -> Vec<Face> {
        let faces = tied[side].1.iter().zip(&cover[side]);
        let glued = faces.filter(|(_, part)| **part > 0.0);
        glued.map(|(face, _)| *face).collect()
    };
    let glued = [glued(0), glued(1)];
    let glued = [(tied[0].0, &glued[0][..]), (tied[1].0, &glued[1][..])];
    let found = both.find(|(_, sides)| share(*sides, glued));
    found.map(|(pair, _)| pair.name.as_str())
}

fn joins(tie: &Tie, other: [Surface<'_>; 2]) -> bool {
    let sides = faces(&tie.a).zip(faces(&tie.b));
    sides.is_some_and(|(a, b)| share([a, b], other))
}

/// Returns whether two joints have facets in common on both sides.
fn share([a, b]: [Surface<'_>; 2], [c, d]: [Surface<'_>; 2]) -> bool {
    let common = |one: Surface<'_>, other: Surface<'_>| {
        let of_one: BTreeSet<&Face> = one.1.iter().collect();
        one.0 == other.0 && other.1.iter().any(|face| of_one.contains(face))
    };
    (common(a, c) && common(b, d)) || (common(a, d) && common(b, c))
}
