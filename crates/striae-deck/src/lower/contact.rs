//! Contact pairs and friction, ties.

use super::{curve::Curves, friction::friction, surfaces::Surfaces, texture};
use crate::{faults::FaultList, raw, read::At};
use striae_law::friction::Friction;
use striae_model::{
    ClosedGaps, ContactSurface, Curve, Enforcement, Initial, InterferenceFit, Known, Pair, RigidId,
    Tie,
};
use striae_surface::texture::Paint;

/// A pair as far as it is known.
pub(super) struct LoweredPair {
    /// The pair, without friction where that is faulty; `None` without its sides.
    pub(super) pair: Option<Pair>,
    /// Completeness of its friction.
    pub(super) known: Known,
}

/// The pairs. A rigid surface becomes side `b`.
pub(super) fn pairs(
    raw: &[At<raw::Pair>],
    surfaces: &Surfaces<'_>,
    curves: &Curves,
    faults: &mut FaultList<'_>,
) -> Vec<LoweredPair> {
    let lower = |pair: &At<raw::Pair>| {
        let friction = match &pair.value.friction {
            Some(raw) => friction(&raw.value, &raw.span, faults),
            None => Some(Friction::frictionless()),
        };
        let known = match friction {
            Some(_) => Known::Whole,
            None => Known::InPart,
        };
        let friction = friction.unwrap_or_else(Friction::frictionless);
        LoweredPair {
            pair: lower_pair(pair, friction, (surfaces, curves), faults),
            known,
        }
    };
    raw.iter().map(lower).collect()
}

fn lower_pair(
    raw: &At<raw::Pair>,
    friction: Friction,
    (surfaces, curves): (&Surfaces<'_>, &Curves),
    faults: &mut FaultList<'_>,
) -> Option<Pair> {
    let pair = &raw.value;
    let interference = pair.interference.as_ref();
    let interference = interference.map(|stated| lower_interference(&stated.value, curves, faults));
    let name = pair
        .name
        .as_ref()
        .map_or("", |name| &name.value.0)
        .to_owned();
    let a = pair
        .a
        .as_ref()
        .and_then(|side| lower_side(&side.value, surfaces, faults));
    let b = pair.b.as_ref().and_then(|side| match &side.value {
        raw::SecondSide::Itself => Some((ContactSurface::Itself, None)),
        raw::SecondSide::Other(side) => lower_side(side, surfaces, faults),
    });
    let (a, b) = (a?, b?);
    let wear = pair.wear.as_ref();
    let mut wear = wear.map_or([0.0; 2], |wear| lower_wear(&wear.value, [&a.0, &b.0]));
    let ((a, texture_a), (b, texture_b)) = match (a, b) {
        (a @ (ContactSurface::Rigid(_), _), b @ (ContactSurface::Deformable { .. }, _)) => {
            wear.reverse();
            (b, a)
        }
        sides => sides,
    };
    let textures = [texture_a, texture_b];
    let interference = match interference {
        Some(stated) => Some(stated?),
        None => None,
    };
    Some(Pair {
        name,
        a,
        b,
        textures,
        friction,
        enforcement: match pair
            .enforcement
            .as_ref()
            .map(|enforcement| enforcement.value)
        {
            None | Some(raw::Enforcement::Weighted) => Enforcement::Weighted,
            Some(raw::Enforcement::Collocated) => Enforcement::Collocated,
        },
        search_distance: pair
            .search_distance
            .as_ref()
            .map(|distance| distance.value.0),
        initial: pair
            .initial
            .as_ref()
            .map_or(Initial::AsMeshed, |initial| lower_initial(&initial.value)),
        interference,
        wear,
        wear_across: pair.wear_across.as_ref().map_or(1.0, |ratio| ratio.value.0),
        stabilised: pair.stabilise.as_ref().is_some_and(|truth| truth.value.0),
        feature_angle: pair.feature_angle.as_ref().map(|angle| angle.value.0),
    })
}

/// Coefficients of the sides as they are written.
fn lower_wear(raw: &raw::Wear, sides: [&ContactSurface; 2]) -> [f64; 2] {
    match raw {
        raw::Wear::All(coefficient) => sides.map(|side| match side {
            ContactSurface::Deformable { .. } => coefficient.0,
            ContactSurface::Rigid(_) | ContactSurface::Itself => 0.0,
        }),
        raw::Wear::Sides(sides) => [&sides.a, &sides.b].map(|stated| {
            let stated = stated.as_ref();
            stated.map_or(0.0, |coefficient| coefficient.value.0)
        }),
    }
}

fn lower_interference(
    raw: &raw::Interference,
    curves: &Curves,
    faults: &mut FaultList<'_>,
) -> Option<InterferenceFit> {
    Some(match raw {
        raw::Interference::Value(value) => InterferenceFit {
            value: value.0,
            curve: Curve::Ramp,
        },
        raw::Interference::Along(along) => {
            let curve = curves.find(along.curve.as_ref(), faults);
            InterferenceFit {
                value: along.value.as_ref()?.value.0,
                curve: curve?,
            }
        }
    })
}

pub(super) fn lower_initial(raw: &raw::Initial) -> Initial {
    match raw {
        raw::Initial::Word(raw::InitialWord::AsMeshed) => Initial::AsMeshed,
        raw::Initial::Word(raw::InitialWord::Close) => Initial::Close(ClosedGaps::default()),
        raw::Initial::Word(raw::InitialWord::Resolve) => Initial::Resolve,
        raw::Initial::Close(raw) => {
            let gap = raw.close.as_ref().map_or(0.0, |gap| gap.value.0);
            Initial::Close(ClosedGaps::UpTo(gap))
        }
    }
}

/// The ties; `None` without their sides.
pub(super) fn ties(
    raw: &[At<raw::BodyTie>],
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Vec<Option<Tie>> {
    let mut lower = |tie: &At<raw::BodyTie>| {
        let tie = &tie.value;
        let [a, b] = [&tie.a, &tie.b].map(|side| {
            let side = side.as_ref()?;
            faces(&side.value, surfaces, faults)
        });
        Some(Tie {
            name: tie.name.as_ref()?.value.0.clone(),
            a: a?,
            b: b?,
            within: tie.within.as_ref().map(|distance| distance.value.0),
            moved: 0.0,
        })
    };
    raw.iter().map(&mut lower).collect()
}

/// A side with its texture.
fn lower_side(
    raw: &raw::Side,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<(ContactSurface, Option<Paint>)> {
    let side = lower_surface(raw, surfaces, faults);
    let texture = match &raw.texture {
        Some(raw) => texture::paint(raw, side.as_ref(), surfaces, faults).map(Some),
        None => Some(None),
    };
    Some((side?, texture?))
}

fn lower_surface(
    raw: &raw::Side,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<ContactSurface> {
    match raw.surface.as_ref()? {
        raw::SideSurface::Deformable(side) => faces(side, surfaces, faults),
        raw::SideSurface::Rigid(side) => {
            let name = side.rigid.as_ref()?;
            let rigid = surfaces.rigid_names.find(name, faults)?;
            Some(ContactSurface::Rigid(RigidId(rigid)))
        }
    }
}

/// Facets of a body.
fn faces(
    raw: &raw::DeformableSide,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<ContactSurface> {
    let body = surfaces.bodies.find(raw.body.as_ref(), faults)?;
    let faces = surfaces.bodies.faces(body, raw.facets.as_ref(), faults)?;
    Some(ContactSurface::Deformable { body, faces })
}
