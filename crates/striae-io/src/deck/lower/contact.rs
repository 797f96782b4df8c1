//! Contact pairs and friction.

use super::body::Bodies;
use crate::deck::{
    fault::FaultKind,
    faults::{FaultList, Span},
    names::Names,
    raw,
    read::At,
};
use std::collections::BTreeSet;
use striae_law::friction::{Friction, FrictionError, SlipRule};
use striae_mesh::{Face, Mesh, NodeId};
use striae_solve::model::{Balance, Pair, RigidId, Side};

/// The pairs; `None` for the faulty ones. A rigid surface becomes side `b`.
pub(super) fn pairs(
    raw: &[At<raw::Pair>],
    bodies: &Bodies,
    rigid: &Names,
    faults: &mut FaultList<'_>,
) -> Vec<Option<Pair>> {
    let mut pairs: Vec<Option<Pair>> = Vec::new();
    for raw in raw {
        let pair = lower_pair(raw, bodies, rigid, faults);
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

/// A friction law, or `None` after its faults have been noted.
pub(super) fn friction(
    raw: &raw::Friction,
    span: &Span,
    faults: &mut FaultList<'_>,
) -> Option<Friction> {
    lowered(raw)?
        .map_err(|error| {
            faults.push(
                span,
                FaultKind::Friction {
                    cause: error.to_string(),
                },
            )
        })
        .ok()
}

fn lower_pair(
    raw: &At<raw::Pair>,
    bodies: &Bodies,
    rigid: &Names,
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
        .and_then(|side| lower_side(&side.value, bodies, rigid, faults));
    let b = pair
        .b
        .as_ref()
        .and_then(|side| lower_side(&side.value, bodies, rigid, faults));
    let friction = match &pair.friction {
        Some(raw) => friction(&raw.value, &raw.span, faults),
        None => Some(Friction::frictionless()),
    };
    let (a, b) = match (a?, b?) {
        (Side::Rigid(_), Side::Rigid(_)) => {
            faults.push(&raw.span, FaultKind::TwoRigid { pair: name });
            return None;
        }
        (a @ Side::Rigid(_), b) => (b, a),
        sides => sides,
    };
    no_self_contact(&name, &raw.span, &a, &b, bodies, faults)?;
    Some(Pair {
        name,
        a,
        b,
        friction: friction?,
        balance: match pair.balance.as_ref().map(|balance| balance.value) {
            None | Some(raw::Balance::Resultants) => Balance::Resultants,
            Some(raw::Balance::None) => Balance::None,
        },
        search_distance: pair
            .search_distance
            .as_ref()
            .map(|distance| distance.value.0),
    })
}

fn lower_side(
    raw: &raw::Side,
    bodies: &Bodies,
    rigid: &Names,
    faults: &mut FaultList<'_>,
) -> Option<Side> {
    match raw {
        raw::Side::Deformable(side) => {
            let body = bodies.find(side.body.as_ref(), faults)?;
            let faces = bodies.faces(body, side.facets.as_ref(), faults)?;
            Some(Side::Deformable { body, faces })
        }
        raw::Side::Rigid(side) => rigid
            .find(side.rigid.as_ref()?, faults)
            .map(|id| Side::Rigid(RigidId(id))),
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

/// The friction, or `None` where a constant could not be read.
fn lowered(raw: &raw::Friction) -> Option<Result<Friction, FrictionError>> {
    let mut friction = match raw.law.as_ref()? {
        raw::FrictionLaw::Frictionless(_) => Ok(Friction::frictionless()),
        raw::FrictionLaw::Coulomb(law) => Friction::coulomb(law.mu.as_ref()?.value.0),
        raw::FrictionLaw::TwoTextures(law) => Friction::two_textures(
            law.mu.as_ref()?.value.0,
            law.c_mag.as_ref()?.value.0,
            law.c_ang.as_ref()?.value.0,
            law.c_cen.as_ref()?.value.0,
        ),
        raw::FrictionLaw::Orthotropic(law) => {
            let rule = match law.slip_rule.as_ref().map(|rule| rule.value) {
                None | Some(raw::SlipRule::Opposing) => SlipRule::Opposing,
                Some(raw::SlipRule::Associated) => SlipRule::Associated,
            };
            Friction::orthotropic(
                law.mu_along.as_ref()?.value.0,
                law.mu_across.as_ref()?.value.0,
                rule,
            )
        }
        raw::FrictionLaw::Nap(law) => Friction::nap(
            law.mu_forward.as_ref()?.value.0,
            law.mu_backward.as_ref()?.value.0,
            law.mu_lateral.as_ref()?.value.0,
        ),
    };
    if let Some(decay) = &raw.decay {
        let ratio = decay.value.kinetic_over_static.as_ref()?.value.0;
        let rate = decay.value.rate.as_ref()?.value.0;
        friction = friction.and_then(|friction| friction.with_decay(ratio, rate));
    }
    if let Some(cap) = &raw.shear_cap {
        friction = friction.and_then(|friction| friction.with_shear_cap(cap.value.0));
    }
    Some(friction)
}
