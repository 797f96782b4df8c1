//! Sides, textures and stabilisation of pairs.

use std::collections::BTreeSet;

use crate::{
    fault::FaultKind,
    model::{ContactSurface, Enforcement, Initial, Pair, Procedure, RigidShape},
    path::Path,
};
use striae_law::friction::Friction;
use striae_mesh::Face;
use striae_surface::texture::Paint;

use super::{Draft, DraftPair, Known, List, Positions};

/// Notes faults of all pairs; returns those that are no pairs or not wholly known.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) -> Positions {
    let mut impossible = Positions::new();
    let mut sound: Vec<&Pair> = Vec::new();
    for (index, named) in draft.pairs.iter().enumerate() {
        let Some(pair) = named.pair else {
            impossible.insert(index);
            continue;
        };
        let path = Path::part("pairs", index);
        check_planes(draft, pair, &path, faults);
        let wrong = impossible_sides(draft, pair);
        if !wrong.is_empty() {
            impossible.insert(index);
            for (side, kind) in wrong {
                let path = path.clone();
                let path = side.map_or(path.clone(), |side| path.field(side));
                faults.push(path, kind);
            }
            continue;
        }
        if named.known == Known::InPart {
            impossible.insert(index);
            continue;
        }
        if draft.known == Known::Whole
            && let Some(kind) = textures(named, &pair.friction)
        {
            faults.push(path.clone().field("friction"), kind);
        }
        if let Some((field, kind)) = unsuited(pair) {
            faults.push(path.clone().field(field), kind);
        }
        if pair.interference.is_some() && pair.initial == Initial::Resolve {
            let kind = FaultKind::InterferenceResolved {
                pair: pair.name.clone(),
            };
            faults.push(path.clone().field("interference"), kind);
        }
        if let Some(kind) = wear_across(pair) {
            faults.push(path.clone().field("wear_across"), kind);
        }
        if let Some(kind) = wear(draft, index, pair) {
            faults.push(path.clone().field("wear"), kind);
        }
        if let Some(other) = sound.iter().find(|other| same_sides(other, pair)) {
            let kind = FaultKind::SamePair {
                pair: pair.name.clone(),
                other: other.name.clone(),
            };
            faults.push(path, kind);
        }
        sound.push(pair);
    }
    impossible
}

/// Notes pairs that request stabilisation although no step has any.
pub(super) fn check_stabilised(
    draft: &Draft<'_>,
    impossible: &Positions,
    partial: &Positions,
    faults: &mut List,
) {
    let mut steps = draft.steps.iter();
    let dynamic = steps.all(|step| matches!(step.step.procedure, Procedure::Dynamic { .. }));
    if draft.steps.is_empty() || !partial.is_empty() || !dynamic {
        return;
    }
    for (index, named) in draft.pairs.iter().enumerate() {
        if let Some(pair) = named.pair
            && pair.stabilised
            && !impossible.contains(&index)
        {
            let path = Path::part("pairs", index).field("stabilised");
            let pair = pair.name.clone();
            faults.push(path, FaultKind::StabilisedByInertia { pair });
        }
    }
}

/// Friction without the textures that give it a direction, or with too many.
pub(super) fn textures(of: &DraftPair, friction: &Friction) -> Option<FaultKind> {
    let pair = of.pair?;
    let found = match (pair.is_on_itself(), &pair.textures) {
        // Both surfaces that touch have the one texture.
        (true, [Some(_), _]) => 2,
        (_, textures) => textures.iter().flatten().count(),
    };
    let required = friction.required_textures().unmet(found)?;
    Some(FaultKind::Textures {
        pair: pair.name.clone(),
        required,
        found,
        is_named: of.is_named,
    })
}

/// Reason why two surfaces do not make a pair, with the side responsible if there is one.
fn impossible_sides(draft: &Draft<'_>, pair: &Pair) -> Vec<(Option<&'static str>, FaultKind)> {
    let without_surface = |(side, name): (&ContactSurface, &'static str)| {
        let ContactSurface::Rigid(rigid) = side else {
            return None;
        };
        let body = draft.rigid_surfaces[rigid.0].part?;
        let rigid = body.name.clone();
        let bare = matches!(body.shape, RigidShape::Bare);
        bare.then_some((Some(name), FaultKind::NoSurface { rigid }))
    };
    let sides = [(&pair.a, "a"), (&pair.b, "b")].into_iter();
    let mut wrong: Vec<_> = sides.filter_map(without_surface).collect();
    if wrong.is_empty() {
        wrong.extend(wrong_together(draft, pair).map(|kind| (None, kind)));
    }
    wrong
}

/// Reason why two surfaces cannot touch each other.
fn wrong_together(draft: &Draft<'_>, pair: &Pair) -> Option<FaultKind> {
    let name = || pair.name.clone();
    let not_itself = |found| FaultKind::NotItself {
        pair: name(),
        found,
    };
    match (&pair.a, &pair.b) {
        (ContactSurface::Rigid(_), ContactSurface::Rigid(_)) => {
            Some(FaultKind::TwoRigid { pair: name() })
        }
        (ContactSurface::Itself, _) => Some(not_itself("side `a` is `itself`")),
        (ContactSurface::Rigid(_), ContactSurface::Itself) => {
            Some(not_itself("a rigid surface does not touch itself"))
        }
        (
            ContactSurface::Deformable { body, faces: on_a },
            ContactSurface::Deformable {
                body: other,
                faces: on_b,
            },
        ) if body == other => {
            let on_a: BTreeSet<&Face> = on_a.iter().collect();
            let shared = on_b.iter().filter(|face| on_a.contains(face)).count();
            (shared > 0).then(|| FaultKind::SharedFacets {
                pair: name(),
                body: draft.bodies[body.0].name.into(),
                shared,
            })
        }
        _ => None,
    }
}

/// Requests of a pair that its kind does not have, with the field.
fn unsuited(pair: &Pair) -> Option<(&'static str, FaultKind)> {
    let name = || pair.name.clone();
    let collocated = pair.enforcement == Enforcement::Collocated;
    let on_itself = |what| FaultKind::OnItself { pair: name(), what };
    match pair.is_on_itself() {
        true if collocated => Some(("enforcement", on_itself("is not collocated"))),
        true if pair.interference.is_some() => {
            Some(("interference", on_itself("has no `interference`")))
        }
        true if matches!(pair.initial, Initial::Close(_)) => {
            Some(("initial", on_itself("closes no gaps")))
        }
        true if pair.wear != [0.0; 2] => Some(("wear", on_itself("has no `wear`"))),
        true if pair.stabilised => {
            let why = "does not restrain the body, so `stabilise` has no effect";
            Some(("stabilised", on_itself(why)))
        }
        _ if collocated && pair.feature_angle.is_some() => {
            let kind = FaultKind::CollocatedFeatures { pair: name() };
            Some(("feature_angle", kind))
        }
        _ => None,
    }
}

/// Reason why wear cannot depend on a direction.
fn wear_across(pair: &Pair) -> Option<FaultKind> {
    let name = || pair.name.clone();
    match pair.wear_across == 1.0 {
        true => None,
        false if pair.wear == [0.0; 2] => Some(FaultKind::WearAcrossNothing { pair: name() }),
        false if pair.textures == [None, None] => {
            Some(FaultKind::WearWithoutTexture { pair: name() })
        }
        // Which one it goes by must not depend on which side is called `a`.
        false if pair.textures.iter().all(Option::is_some) => {
            Some(FaultKind::WearAcrossTwoTextures { pair: name() })
        }
        false => None,
    }
}

/// Reason why the sides of a pair cannot wear as they are to.
fn wear(draft: &Draft<'_>, index: usize, pair: &Pair) -> Option<FaultKind> {
    if pair.wear == [0.0; 2] || pair.is_on_itself() {
        return None;
    }
    let name = pair.name.clone();
    if matches!(pair.b, ContactSurface::Rigid(_)) && pair.wear[1] != 0.0 {
        return Some(FaultKind::RigidWear { pair: name });
    }
    if pair.enforcement == Enforcement::Collocated {
        return Some(FaultKind::CollocatedWear { pair: name });
    }
    let steps = || draft.steps.iter();
    let all_known = draft.known == Known::Whole && steps().all(|step| step.known == Known::Whole);
    let mut changes = steps().flat_map(|step| &step.step.frictions);
    let is_frictionless = pair.friction.is_frictionless()
        && !changes.any(|(id, friction)| id.0 == index && !friction.is_frictionless());
    (all_known && is_frictionless).then_some(FaultKind::FrictionlessWear { pair: name })
}

/// Notes textures given at points or nodes of a plane, which has no nodes.
fn check_planes(draft: &Draft<'_>, pair: &Pair, path: &Path, faults: &mut List) {
    for (side, texture) in [&pair.a, &pair.b]
        .into_iter()
        .zip(&pair.textures)
        .enumerate()
    {
        let (ContactSurface::Rigid(rigid), Some(paint)) = texture else {
            continue;
        };
        let Some(surface) = draft.rigid_surfaces[rigid.0].part else {
            continue;
        };
        let plane = matches!(surface.shape, RigidShape::Plane { .. });
        if plane && !matches!(paint, Paint::Field(_)) {
            let surface = surface.name.clone();
            let path = path.clone().field("textures").index(side);
            faults.push(path, FaultKind::NodesOnPlane { surface });
        }
    }
}

fn same_sides(one: &Pair, other: &Pair) -> bool {
    let same = |a: &ContactSurface, b: &ContactSurface| match (a, b) {
        (
            ContactSurface::Deformable {
                body: i,
                faces: on_i,
            },
            ContactSurface::Deformable {
                body: j,
                faces: on_j,
            },
        ) => i == j && on_i == on_j,
        (ContactSurface::Rigid(i), ContactSurface::Rigid(j)) => i == j,
        (ContactSurface::Itself, ContactSurface::Itself) => true,
        _ => false,
    };
    same(&one.a, &other.a) && same(&one.b, &other.b)
        || same(&one.a, &other.b) && same(&one.b, &other.a)
}
