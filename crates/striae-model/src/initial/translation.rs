//! Sides that prescribed displacements move as one piece, and how near that takes them.
//!
//! A body of which all prescribed nodes have the same displacement in every step, and that
//! nothing else moves, goes along without strain until it touches. With the gap `h` of the
//! sides along a direction `d` and displacements in the boxes `U_a` and `U_b`, they stay
//! apart while `max d . (u_a - u_b) < h`.

use std::collections::BTreeSet;

use striae_mesh::Vec3;

use crate::{
    model::{
        BodyId, ContactSurface, Curve, Displacement, Freedom, Model, Moment, Mover, PairId,
        Procedure, RigidId, RigidShape, Spring, Step,
    },
    plan::starts,
};

/// Smallest and largest displacement along every axis.
type Ranges = [(f64, f64); 3];

/// Smallest distance between the sides of a pair that move as one piece each, along the direction
/// in which they stay farthest apart; negative if they may overlap. `None` if one of them may
/// deform before it touches.
pub(crate) fn nearest_approach(model: &Model, pair: PairId) -> Option<f64> {
    let of_pair = &model.pairs[pair.0];
    let ways = [way(model, pair, &of_pair.a)?, way(model, pair, &of_pair.b)?];
    let directions = match normal(model, &of_pair.b) {
        Some(normal) => vec![-normal],
        None => (0..3)
            .flat_map(|axis| [1.0, -1.0].map(|sign| Vec3::ith(axis, sign)))
            .collect(),
    };
    let left = directions.iter().map(|d| {
        let [a, b] = [&of_pair.a, &of_pair.b].map(|side| extent(model, side, d));
        let approach = farthest(&ways[0], d) + farthest(&ways[1], &-d);
        b.0 - a.1 - approach
    });
    Some(left.fold(f64::NEG_INFINITY, f64::max))
}

/// Largest displacement along a direction.
fn farthest(way: &Ranges, d: &Vec3) -> f64 {
    let along = way.iter().enumerate();
    along
        .map(|(axis, (low, high))| (low * d[axis]).max(high * d[axis]))
        .sum()
}

fn normal(model: &Model, side: &ContactSurface) -> Option<Vec3> {
    let ContactSurface::Rigid(rigid) = side else {
        return None;
    };
    match &model.rigid_surfaces[rigid.0].shape {
        RigidShape::Plane { normal, .. } => Some(normal.normalize()),
        RigidShape::Facets { .. } | RigidShape::Bare => None,
    }
}

/// Extent of a side along a direction.
fn extent(model: &Model, side: &ContactSurface, d: &Vec3) -> (f64, f64) {
    let over = |positions: &mut dyn Iterator<Item = Vec3>| {
        positions.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x.dot(d)), high.max(x.dot(d)))
        })
    };
    match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = &model.bodies[body.0].mesh;
            over(&mut faces.iter().flat_map(|&face| mesh.face_positions(face)))
        }
        ContactSurface::Rigid(rigid) => match &model.rigid_surfaces[rigid.0].shape {
            RigidShape::Plane { point, .. } => (point.dot(d), f64::INFINITY),
            RigidShape::Facets { positions, .. } => over(&mut positions.iter().copied()),
            RigidShape::Bare => (f64::NEG_INFINITY, f64::INFINITY),
        },
        ContactSurface::Itself => (f64::NEG_INFINITY, f64::INFINITY),
    }
}

fn way(model: &Model, pair: PairId, side: &ContactSurface) -> Option<Ranges> {
    match side {
        ContactSurface::Deformable { body, .. } => body_way(model, pair, *body),
        ContactSurface::Rigid(rigid) => rigid_way(model, *rigid),
        ContactSurface::Itself => None,
    }
}

fn body_way(model: &Model, pair: PairId, body: BodyId) -> Option<Ranges> {
    let is = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: other, .. } if *other == body);
    let mut others = model.pairs.iter().enumerate();
    let touched = others.any(|(at, other)| at != pair.0 && (is(&other.a) || is(&other.b)));
    let mut ties = model.rigid_surfaces.iter().flat_map(|rigid| &rigid.ties);
    let sprung = |spring: &Spring| spring.ends().any(|end| end.is_on(Mover::Deformable(body)));
    let joined = model.ties.iter().any(|tie| tie.joins(body)) || model.springs.iter().any(sprung);
    if touched || joined || ties.any(|(tied, _)| *tied == body) {
        return None;
    }
    let mut ranges = [(0.0, 0.0); 3];
    let mut first: [Option<BTreeSet<&str>>; 3] = [None, None, None];
    for (step, start) in model.steps.iter().zip(starts(model)) {
        if is_moved_otherwise(model, step, body) {
            return None;
        }
        for axis in 0..3 {
            let stated = step.displacements.iter().filter(|of| of.body == body);
            let stated = stated.filter_map(|of| Some((of, of.numbers()[axis]?)));
            let stated: Vec<(&Displacement, f64)> = stated.collect();
            let Some((one, target)) = stated.first() else {
                continue;
            };
            let sets: BTreeSet<&str> = stated.iter().map(|(of, _)| of.set.as_str()).collect();
            let differs =
                |(of, other): &(&Displacement, f64)| other != target || of.curve != one.curve;
            if stated.iter().any(differs) || *first[axis].get_or_insert(sets.clone()) != sets {
                return None;
            }
            ranges[axis] = with(ranges[axis], *target, &one.curve, start);
        }
    }
    first.iter().any(Option::is_some).then_some(ranges)
}

fn is_moved_otherwise(model: &Model, step: &Step, body: BodyId) -> bool {
    step.procedure != Procedure::QuasiStatic
        || step.gravity.is_some()
        || model.loads(step, body)
        || step.actuations.iter().any(|of| of.body == body)
        || step.releases.iter().any(|release| release.body == body)
        || step
            .displacements
            .iter()
            .any(|of| of.body == body && (of.varies() || !of.axes.are_global()))
}

fn rigid_way(model: &Model, rigid: RigidId) -> Option<Ranges> {
    let mut ranges = [(0.0, 0.0); 3];
    for (step, start) in model.steps.iter().zip(starts(model)) {
        for motion in step.rigid_motions.iter().filter(|of| of.surface == rigid) {
            for (at, coordinate) in motion.coordinates.iter().enumerate() {
                match coordinate {
                    Freedom::AsBefore => {}
                    Freedom::To(target) if at < 3 => {
                        ranges[at] = with(ranges[at], *target, &motion.curve, start);
                    }
                    Freedom::To(angle) if *angle == 0.0 => {}
                    Freedom::To(_) | Freedom::Free => return None,
                }
            }
        }
    }
    Some(ranges)
}

/// The range with all that lies on the way from any of it to a target, in the step that starts then.
fn with((low, high): (f64, f64), target: f64, curve: &Curve, start: Moment) -> (f64, f64) {
    let [least, most] = curve.range(start);
    let (least, most) = (least.min(0.0), most.max(1.0));
    let ends = [low, high].into_iter().flat_map(|found| {
        let from = curve.origin(found, 0.0);
        [least, most].map(|c| from + c * (target - from))
    });
    ends.fold((low, high), |(low, high), end| {
        (low.min(end), high.max(end))
    })
}
