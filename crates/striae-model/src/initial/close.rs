//! Gaps and overlaps closed without strain: nodes go to the nearest point of the other side.

use std::{cmp::Ordering, collections::BTreeMap};

use striae_contact::{initial::Faces, interference::Stage, side::Side};
use striae_mesh::{MeshError, Vec3};
use striae_surface::node::SurfaceNode;

use super::{InitialFault, Reference};
use crate::model::{ClosedGaps, Initial, Model, PairId};

/// Square of the part of a direction that others do not cover, below which it is one of theirs.
const ALIKE: f64 = 1e-2;

/// The model with closed gaps for all pairs that request it, one pair after another.
///
/// # Errors
/// When an element would be turned inside out.
pub fn close(mut model: Model) -> Result<Model, InitialFault> {
    for pair in 0..model.pairs.len() {
        if let Initial::Close(gaps) = model.pairs[pair].initial {
            close_pair(&mut model, PairId(pair), gaps)?;
        }
    }
    Ok(model)
}

fn close_pair(model: &mut Model, pair: PairId, gaps: ClosedGaps) -> Result<(), InitialFault> {
    let Some(reference) = Reference::new(model, pair) else {
        return Ok(());
    };
    let x = reference.at(model, |stage| closed(stage, gaps));
    for (side, x) in Side::BOTH.into_iter().zip(x) {
        let surface = reference.geometry.contact.sides[side].surface();
        let (Some(body), Some(surface)) = (reference.geometry.bodies[side], surface) else {
            continue;
        };
        let mesh = &mut model.bodies[body].mesh;
        // On an edge between faces several nodes of the surface are one of the mesh.
        let mut ways: BTreeMap<usize, Vec<Vec3>> = BTreeMap::new();
        for (node, x) in surface.nodes().iter().zip(x) {
            let way = x - mesh.positions[node.index()];
            ways.entry(node.index()).or_default().push(way);
        }
        for (node, ways) in ways {
            mesh.positions[node] += joint(&ways);
        }
        if let Err(MeshError::Inverted { element, .. }) = mesh.check_shape() {
            return Err(InitialFault::Inverted {
                pair: model.pairs[pair.0].name.clone(),
                body: model.bodies[body].name.clone(),
                element,
            });
        }
    }
    Ok(())
}

/// Shortest way that is as long along each of some ways as that is.
fn joint(ways: &[Vec3]) -> Vec3 {
    let mut sum = Vec3::zeros();
    let mut directions: Vec<Vec3> = Vec::new();
    for way in ways {
        let length = way.norm();
        if length == 0.0 {
            continue;
        }
        let along = way / length;
        let covered = |rest: Vec3, q: &Vec3| rest - q * q.dot(&rest);
        let new = directions.iter().fold(along, covered);
        // Of faces that look the same way one leads where the other does.
        if new.norm_squared() > ALIKE {
            sum += new * ((length - along.dot(&sum)) / new.norm_squared());
            directions.push(new.normalize());
        }
    }
    sum
}

/// Positions of the surface nodes with gaps and overlaps closed.
fn closed(stage: &Stage, gaps: ClosedGaps) -> [Vec<Vec3>; 2] {
    let sides = moved(stage);
    let part = 1.0 / sides.len() as f64;
    let mut x = Side::BOTH.map(|side| {
        let snapshot = stage.configuration.sides[side].as_ref();
        snapshot.map_or_else(Vec::new, |snapshot| snapshot.x.clone())
    });
    for &side in sides {
        for (node, target) in chosen(stage, side, gaps) {
            let place = &mut x[side][node];
            *place += (target - *place) * part;
        }
    }
    x
}

/// Sides whose nodes are moved: the one with the smaller surface, which the other one
/// covers, the finer one of two as large, or both half the way.
fn moved(stage: &Stage) -> &'static [Side] {
    const SAME: f64 = 1e-6;
    if stage.configuration.pair.is_rigid() {
        return &[Side::A];
    }
    let [a, b] = Side::BOTH.map(|side| {
        let snapshot = stage.configuration.side(side);
        let facets = snapshot.surface.facets();
        let area = |facet: &[SurfaceNode; 4]| {
            let [a, b, c, d] = facet.map(|node| snapshot.x[node]);
            0.5 * (c - a).cross(&(d - b)).norm()
        };
        (facets.iter().map(area).sum::<f64>(), facets.len())
    });
    match (a.0 / b.0, a.1.cmp(&b.1)) {
        (ratio, _) if ratio < 1.0 - SAME => &[Side::A],
        (ratio, _) if ratio > 1.0 + SAME => &[Side::B],
        (_, Ordering::Greater) => &[Side::A],
        (_, Ordering::Less) => &[Side::B],
        (_, Ordering::Equal) => &Side::BOTH,
    }
}

/// Nodes with a gap that is closed, or with an overlap, and where they belong.
fn chosen(stage: &Stage, side: Side, gaps: ClosedGaps) -> Vec<(SurfaceNode, Vec3)> {
    let snapshot = stage.configuration.side(side);
    let limit = |node: SurfaceNode| match gaps {
        ClosedGaps::Share(share) => share * snapshot.sizes[node],
        ClosedGaps::UpTo(gap) => gap,
    };
    let faces = Faces::new(stage);
    let within = |node: SurfaceNode| {
        let (gap, target) = faces.signed_gap(side, node)?;
        (gap <= limit(node) * (1.0 + 1e-9)).then_some((node, target))
    };
    SurfaceNode::all(snapshot.x.len())
        .filter_map(within)
        .collect()
}
