//! Sides, textures and stabilisation of pairs.

use std::collections::BTreeSet;

use striae_law::friction::{Friction, RequiredTextures};
use striae_mesh::{Face, Mesh, NodeId};
use striae_solve::model::{ContactSurface, Initial, Pair, Procedure, RigidShape};
use striae_surface::texture::Paint;

use super::{Draft, Known, List, Positions};
use crate::{fault::FaultKind, path::Path};

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
            && let Some(kind) = textures(&pair.name, &pair.friction, &pair.textures)
        {
            faults.push(path.clone().field("friction"), kind);
        }
        if pair.interference.is_some() && pair.initial == Initial::Resolve {
            let kind = FaultKind::InterferenceResolved {
                pair: pair.name.clone(),
            };
            faults.push(path.clone().field("interference"), kind);
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

/// Notes pairs that ask for stabilisation where no step has any.
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
pub(super) fn textures(
    pair: &str,
    friction: &Friction,
    textures: &[Option<Paint>; 2],
) -> Option<FaultKind> {
    let found = textures.iter().flatten().count();
    let required = match friction.required_textures() {
        RequiredTextures::One if found != 1 => "one side",
        RequiredTextures::Both if found != 2 => "both sides",
        _ => return None,
    };
    Some(FaultKind::Textures {
        pair: pair.into(),
        required,
        found,
    })
}

/// Why two surfaces make no pair, with the side that is to blame where it is one.
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

/// Why two surfaces cannot touch each other.
fn wrong_together(draft: &Draft<'_>, pair: &Pair) -> Option<FaultKind> {
    let name = || pair.name.clone();
    match (&pair.a, &pair.b) {
        (ContactSurface::Rigid(_), ContactSurface::Rigid(_)) => {
            Some(FaultKind::TwoRigid { pair: name() })
        }
        (
            ContactSurface::Deformable { body, faces: on_a },
            ContactSurface::Deformable {
                body: other,
                faces: on_b,
            },
        ) if body == other => {
            let of = &draft.bodies[body.0];
            let shared = of.mesh.map_or(0, |mesh| {
                nodes(mesh, on_a).intersection(&nodes(mesh, on_b)).count()
            });
            Some(FaultKind::SelfContact {
                pair: name(),
                body: of.name.into(),
                shared,
            })
        }
        _ => None,
    }
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

fn nodes(mesh: &Mesh, faces: &[Face]) -> BTreeSet<NodeId> {
    let corners = faces.iter().flat_map(|face| mesh.face_nodes(*face));
    corners.collect()
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
        _ => false,
    };
    same(&one.a, &other.a) && same(&one.b, &other.b)
        || same(&one.a, &other.b) && same(&one.b, &other.a)
}
