//! Contact pairs and friction.

use super::{Read, body::Bodies, friction::friction, texture};
use crate::{
    fault::FaultKind,
    faults::{FaultList, Span},
    names::Names,
    raw,
    read::At,
};
use std::{collections::BTreeSet, path::Path};
use striae_law::friction::Friction;
use striae_mesh::{Face, Mesh, NodeId};
use striae_solve::model::{
    ClosedGaps, Enforcement, Initial, Pair, Procedure, RigidId, RigidShape, RigidSurface, Side,
    Step,
};
use striae_surface::texture::Paint;

/// What a side of a pair may refer to.
pub(super) struct Surfaces<'r> {
    pub(super) bodies: &'r Bodies,
    pub(super) rigid_names: &'r Names,
    pub(super) rigid: &'r [Option<RigidSurface>],
    pub(super) read: Read,
    /// The deck as written, whose meshes know the numbers of their nodes.
    pub(super) written: &'r raw::Simulation,
    /// Folder that paths are relative to.
    pub(super) base: &'r Path,
}

/// The pairs; `None` for the faulty ones. A rigid surface becomes side `b`.
pub(super) fn pairs(
    raw: &[At<raw::Pair>],
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Vec<Option<Pair>> {
    let mut pairs: Vec<Option<Pair>> = Vec::new();
    for raw in raw {
        let pair = lower_pair(raw, surfaces, faults);
        if let Some(pair) = &pair {
            let twin = pairs.iter().flatten().find(|other| same_sides(other, pair));
            if let Some(other) = twin {
                let kind = FaultKind::SamePair {
                    pair: pair.name.clone(),
                    other: other.name.clone(),
                };
                faults.push(&raw.span, kind);
            }
        }
        pairs.push(pair);
    }
    pairs
}

fn lower_pair(
    raw: &At<raw::Pair>,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Pair> {
    let pair = &raw.value;
    let name = pair
        .name
        .as_ref()
        .map_or("", |name| &name.value.0)
        .to_owned();
    let a = pair
        .a
        .as_ref()
        .and_then(|side| lower_side(&side.value, surfaces, faults));
    let b = pair
        .b
        .as_ref()
        .and_then(|side| lower_side(&side.value, surfaces, faults));
    let (friction, at) = match &pair.friction {
        Some(raw) => (friction(&raw.value, &raw.span, faults), &raw.span),
        None => (Some(Friction::frictionless()), &raw.span),
    };
    let ((a, texture_a), (b, texture_b)) = match (a?, b?) {
        ((Side::Rigid(_), _), (Side::Rigid(_), _)) => {
            faults.push(&raw.span, FaultKind::TwoRigid { pair: name });
            return None;
        }
        (a @ (Side::Rigid(_), _), b) => (b, a),
        sides => sides,
    };
    no_self_contact(&name, &raw.span, &a, &b, surfaces.bodies, faults)?;
    let (friction, textures) = (friction?, [texture_a, texture_b]);
    if surfaces.read == Read::Whole {
        texture::check_friction(&name, &friction, &textures, at, faults);
    }
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
        stabilised: pair.stabilise.as_ref().is_some_and(|truth| truth.value.0),
    })
}

/// Notes pairs that ask for stabilisation where no step has any.
pub(super) fn check(
    raw: &[At<raw::Pair>],
    pairs: &[Option<Pair>],
    steps: &[Option<Step>],
    faults: &mut FaultList<'_>,
) {
    let is_dynamic = |step: &Option<Step>| {
        let procedure = step.as_ref().map(|step| step.procedure);
        matches!(procedure, Some(Procedure::Dynamic { .. }))
    };
    if steps.is_empty() || !steps.iter().all(is_dynamic) {
        return;
    }
    for (raw, pair) in raw.iter().zip(pairs) {
        if let (Some(at), Some(pair)) = (&raw.value.stabilise, pair)
            && at.value.0
        {
            let pair = pair.name.clone();
            faults.push(&at.span, FaultKind::StabilisedByInertia { pair });
        }
    }
}

fn lower_initial(raw: &raw::Initial) -> Initial {
    /// Gaps that are closed by default, over the local facet size.
    const SHARE: f64 = 0.1;
    match raw {
        raw::Initial::Word(raw::InitialWord::AsMeshed) => Initial::AsMeshed,
        raw::Initial::Word(raw::InitialWord::Close) => Initial::Close(ClosedGaps::Share(SHARE)),
        raw::Initial::Word(raw::InitialWord::Resolve) => Initial::Resolve,
        raw::Initial::Close(raw) => {
            let gap = raw.close.as_ref().map_or(0.0, |gap| gap.value.0);
            Initial::Close(ClosedGaps::UpTo(gap))
        }
    }
}

/// A side with its texture.
fn lower_side(
    raw: &raw::Side,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<(Side, Option<Paint>)> {
    let side = lower_surface(raw, surfaces, faults);
    let texture = match &raw.texture {
        Some(raw) => texture::paint(&raw.value, side.as_ref(), surfaces, faults).map(Some),
        None => Some(None),
    };
    Some((side?, texture?))
}

fn lower_surface(
    raw: &raw::Side,
    surfaces: &Surfaces<'_>,
    faults: &mut FaultList<'_>,
) -> Option<Side> {
    match raw.surface.as_ref()? {
        raw::SideSurface::Deformable(side) => {
            let body = surfaces.bodies.find(side.body.as_ref(), faults)?;
            let faces = surfaces.bodies.faces(body, side.facets.as_ref(), faults)?;
            Some(Side::Deformable { body, faces })
        }
        raw::SideSurface::Rigid(side) => {
            let name = side.rigid.as_ref()?;
            let rigid = surfaces.rigid_names.find(name, faults)?;
            let shape = surfaces.rigid[rigid].as_ref().map(|rigid| &rigid.shape);
            if matches!(shape, Some(RigidShape::Bare)) {
                let rigid = name.value.0.clone();
                faults.push(&name.span, FaultKind::NoSurface { rigid });
                return None;
            }
            if let Some(texture) = &raw.texture {
                texture::check_plane(surfaces.rigid[rigid].as_ref(), texture, faults);
            }
            Some(Side::Rigid(RigidId(rigid)))
        }
    }
}

fn no_self_contact(
    pair: &str,
    span: &Span,
    a: &Side,
    b: &Side,
    bodies: &Bodies,
    faults: &mut FaultList<'_>,
) -> Option<()> {
    let (
        Side::Deformable { body, faces: on_a },
        Side::Deformable {
            body: other,
            faces: on_b,
        },
    ) = (a, b)
    else {
        return Some(());
    };
    if body != other {
        return Some(());
    }
    let mesh = bodies.mesh(*body)?;
    let shared = nodes(mesh, on_a).intersection(&nodes(mesh, on_b)).count();
    let kind = FaultKind::SelfContact {
        pair: pair.into(),
        body: bodies.name(*body).into(),
        shared,
    };
    faults.push(span, kind);
    None
}

fn nodes(mesh: &Mesh, faces: &[Face]) -> BTreeSet<NodeId> {
    faces
        .iter()
        .flat_map(|face| mesh.face_nodes(*face))
        .collect()
}

fn same_sides(one: &Pair, other: &Pair) -> bool {
    let same = |a: &Side, b: &Side| match (a, b) {
        (
            Side::Deformable {
                body: i,
                faces: on_i,
            },
            Side::Deformable {
                body: j,
                faces: on_j,
            },
        ) => i == j && on_i == on_j,
        (Side::Rigid(i), Side::Rigid(j)) => i == j,
        _ => false,
    };
    same(&one.a, &other.a) && same(&one.b, &other.b)
        || same(&one.a, &other.b) && same(&one.b, &other.a)
}
