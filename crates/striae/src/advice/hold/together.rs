//! Restraint of bodies that touch or are glued, as one.
//!
//! Each of two blocks on top of each other may be held by the other one, and nothing holds both:
//! bodies that closed contact and ties join are looked at as if they were one piece.

use std::collections::BTreeSet;

use striae_contact::initial::Fit;
use striae_model::{BodyId, ContactSurface, Model, Mover, PairId, Procedure, RigidMotions, Step};

use super::{
    super::{Advice, Topic},
    cause, holds, stop_by, stop_prescribed,
};

/// Warns of groups of bodies that nothing holds at first.
pub(super) fn look(model: &Model, fits: &[Option<Fit>], step: &Step, advice: &mut Advice) {
    if step.procedure != Procedure::QuasiStatic {
        return;
    }
    for group in groups(model, fits) {
        let name = |body: &BodyId| model.bodies[body.0].name.as_str();
        let is_told = |body: &BodyId| advice.warns_of(name(body), &[Topic::Hold]);
        let held = |body: &BodyId| is_held_otherwise(model, *body);
        if group.len() < 2 || group.iter().any(|body| is_told(body) || held(body)) {
            continue;
        }
        let positions = group
            .iter()
            .flat_map(|body| &model.bodies[body.0].mesh.positions);
        let mut motions = RigidMotions::around(positions);
        for body in &group {
            stop_prescribed(&model.bodies[body.0].mesh, step, *body, &mut motions);
        }
        let free = motions.words();
        let pairs = outward(model, &group);
        let (closed, open): (Vec<_>, Vec<_>) = pairs
            .into_iter()
            .partition(|(pair, body)| holds(model, fits, *pair, &model.bodies[body.0].mesh));
        for (pair, body) in &closed {
            stop_by(model, PairId(*pair), *body, &mut motions);
        }
        if motions.left() == 0 {
            continue;
        }
        let [closed, open] = [closed, open].map(|of| of.into_iter().map(|(at, _)| at).collect());
        let (closed, open): (Vec<usize>, Vec<usize>) = (closed, open);
        let cause = cause(
            model,
            [&closed, &open],
            ["them", "they are"],
            &motions.words(),
        );
        let listed: Vec<String> = group
            .iter()
            .map(|body| format!("`{}`", name(body)))
            .collect();
        let text = format!(
            "prescribed nodes leave the bodies {} together free to move {free}, and {cause}",
            listed.join(", ")
        );
        let first = name(&group[0]).to_owned();
        advice.warn(Topic::Hold, &first, text);
    }
}

/// Bodies that closed contact and ties join.
fn groups(model: &Model, fits: &[Option<Fit>]) -> Vec<Vec<BodyId>> {
    let body = |side: &ContactSurface| match side {
        ContactSurface::Deformable { body, .. } => Some(*body),
        ContactSurface::Rigid(_) | ContactSurface::Itself => None,
    };
    let pairs = model.pairs.iter().enumerate().filter_map(|(at, pair)| {
        let joined = [body(&pair.a)?, body(&pair.b)?];
        holds(model, fits, at, &model.bodies[joined[0].0].mesh).then_some(joined)
    });
    let ties = model.ties.iter();
    let ties = ties.filter_map(|tie| Some([body(&tie.a)?, body(&tie.b)?]));
    let mut groups: Vec<Vec<BodyId>> = (0..model.bodies.len()).map(|at| vec![BodyId(at)]).collect();
    for [one, other] in pairs.chain(ties) {
        let of = |body: BodyId| groups.iter().position(|group| group.contains(&body));
        let (Some(first), Some(second)) = (of(one), of(other)) else {
            continue;
        };
        if first != second {
            let joined = groups.swap_remove(first.max(second));
            groups[first.min(second)].extend(joined);
        }
    }
    groups.iter_mut().for_each(|group| group.sort());
    groups.sort();
    groups
}

/// Returns whether a body is tied to a rigid one, or springs hold it.
fn is_held_otherwise(model: &Model, body: BodyId) -> bool {
    let mut to_rigid = model.rigid_surfaces.iter().flat_map(|rigid| &rigid.ties);
    let mut springs = model.springs.iter();
    let mut ties = model.ties.iter().filter(|tie| tie.joins(body));
    let is_rigid = |side: &ContactSurface| matches!(side, ContactSurface::Rigid(_));
    to_rigid.any(|(tied, _)| *tied == body)
        || springs.any(|spring| spring.holds(Mover::Deformable(body)))
        || ties.any(|tie| is_rigid(&tie.a) || is_rigid(&tie.b))
}

/// Pairs of bodies of a group with rigid surfaces and with bodies outside it.
fn outward(model: &Model, group: &[BodyId]) -> BTreeSet<(usize, BodyId)> {
    let own = |side: &ContactSurface| match side {
        ContactSurface::Deformable { body, .. } => Some(*body).filter(|of| group.contains(of)),
        ContactSurface::Rigid(_) | ContactSurface::Itself => None,
    };
    let pairs = model.pairs.iter().enumerate();
    let pairs = pairs.filter(|(_, pair)| !pair.is_on_itself());
    let found = pairs.filter_map(|(at, pair)| match (own(&pair.a), own(&pair.b)) {
        (Some(body), None) | (None, Some(body)) => Some((at, body)),
        _ => None,
    });
    found.collect()
}
