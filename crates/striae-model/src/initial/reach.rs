//! Test of whether the sides of a pair can ever meet.
//!
//! Parts moved by prescribed displacements only move as far as the farthest of them, and their
//! deformation adds at most as much again; parts moved as one piece follow [`nearest_approach`].
//! Loads, inertia, ties and free coordinates may take a body anywhere.

use striae_contact::initial::Fit;
use striae_mesh::Vec3;

use super::translation::nearest_approach;
use crate::model::{
    Axes, BodyId, ContactSurface, Freedom, Model, Mover, PairId, Procedure, RigidId, Spring,
};

/// Relative excess over the initial distance that counts as round-off.
const ROUND_OFF: f64 = 1e-9;
/// Motion that deformation may add, over that of what is prescribed.
const DEFORMATION: f64 = 2.0;

/// Returns whether a pair with this fit may meet in some step.
pub fn may_meet(model: &Model, pair: PairId, fit: &Fit) -> bool {
    let of_pair = &model.pairs[pair.0];
    if fit.overlap.is_some() || of_pair.interference.is_some() {
        return true;
    }
    let reach = |side: &ContactSurface| match side {
        ContactSurface::Deformable { body, .. } => body_reach(model, *body),
        ContactSurface::Rigid(rigid) => rigid_reach(model, *rigid),
        ContactSurface::Itself => None,
    };
    let [a, b] = of_pair.surfaces();
    match (reach(a), reach(b)) {
        (Some(a), Some(b)) => fit.distance <= DEFORMATION * (a + b) && comes_near(model, pair, fit),
        _ => true,
    }
}

/// Returns whether sides that move as one piece come as near as round-off.
fn comes_near(model: &Model, pair: PairId, fit: &Fit) -> bool {
    let left = nearest_approach(model, pair);
    left.is_none_or(|left| left <= ROUND_OFF * fit.distance)
}

/// Distance that prescribed displacements move a body; `None` if it is unlimited.
fn body_reach(model: &Model, body: BodyId) -> Option<f64> {
    let tied = |(other, _): &(BodyId, Vec<_>)| *other == body;
    if model
        .rigid_surfaces
        .iter()
        .any(|rigid| rigid.ties.iter().any(tied))
    {
        return None;
    }
    let sprung = |spring: &Spring| spring.ends().any(|end| end.is_on(Mover::Deformable(body)));
    if model.ties.iter().any(|tie| tie.joins(body)) || model.springs.iter().any(sprung) {
        return None;
    }
    let mut farthest: Option<f64> = None;
    for step in &model.steps {
        let loaded = model.loads(step, body);
        let actuated = step.actuations.iter().any(|of| of.body == body);
        if loaded || actuated || step.gravity.is_some() || step.procedure != Procedure::QuasiStatic
        {
            return None;
        }
        for condition in step.displacements.iter().filter(|d| d.body == body) {
            if condition.varies() {
                return None;
            }
            let way = condition
                .numbers()
                .map(|component| component.unwrap_or(0.0).abs());
            let way = match condition.axes {
                Axes::Global => Vec3::from(way).norm(),
                // Those along other axes at the same nodes may add to it.
                _ => return None,
            };
            farthest = Some(farthest.unwrap_or(0.0).max(way));
        }
    }
    farthest
}

/// Distance that prescribed coordinates move a rigid surface; `None` if it is unlimited.
fn rigid_reach(model: &Model, rigid: RigidId) -> Option<f64> {
    let mut farthest = 0.0_f64;
    for step in &model.steps {
        for motion in step.rigid_motions.iter().filter(|m| m.surface == rigid) {
            let mut way = Vec3::zeros();
            for (at, coordinate) in motion.coordinates.iter().enumerate() {
                match coordinate {
                    Freedom::AsBefore => {}
                    Freedom::To(target) if at < 3 => way[at] = target.abs(),
                    Freedom::To(angle) if *angle == 0.0 => {}
                    Freedom::To(_) | Freedom::Free => return None,
                }
            }
            farthest = farthest.max(way.norm());
        }
    }
    Some(farthest)
}
