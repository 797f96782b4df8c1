//! Rigid bodies that are free though nothing moves them, and tied nodes that are
//! prescribed as well or tied twice.

use std::collections::BTreeMap;

use crate::{
    fault::FaultKind,
    model::{BodyId, ContactSurface, Freedom, Mover, RigidId, Step},
    path::Path,
};
use striae_mesh::NodeId;

use super::{Draft, List, Positions, hold::is_sprung};

/// Notes nodes that are tied twice, and the others in every whole step.
pub(super) fn check(
    draft: &Draft<'_>,
    impossible: &Positions,
    partial: &Positions,
    faults: &mut List,
) {
    let mut tied: BTreeMap<(BodyId, NodeId), usize> = BTreeMap::new();
    for (index, rigid) in draft.rigid_surfaces.iter().enumerate() {
        let ties = rigid.part.iter().flat_map(|part| &part.ties);
        let nodes = ties.flat_map(|(body, nodes)| nodes.iter().map(|node| (*body, *node)));
        let mut twice = None;
        for at in nodes {
            let first = *tied.entry(at).or_insert(index);
            if first != index {
                twice.get_or_insert((first, at));
            }
        }
        if let Some((first, (body, node))) = twice {
            let name = |rigid: usize| draft.rigid_surfaces[rigid].name.to_owned();
            let kind = FaultKind::TiedTwice {
                first: name(first),
                second: name(index),
                body: draft.bodies[body.0].name.into(),
                node,
            };
            faults.push(Path::part("rigid_surfaces", index), kind);
        }
    }
    for (index, of) in draft.steps.iter().enumerate() {
        if partial.contains(&index) {
            continue;
        }
        let (step, path) = (of.step, Path::part("steps", index));
        for rigid in free(draft, impossible, step) {
            let kind = FaultKind::FreeRigid {
                rigid: draft.rigid_surfaces[rigid.0].name.into(),
                step: step.name.clone(),
            };
            faults.push(path.clone(), kind);
        }
        let prescribed = step.displacements.iter().find_map(|condition| {
            let nodes = condition.nodes.iter();
            let mut both = nodes.filter(|node| tied.contains_key(&(condition.body, **node)));
            both.next().map(|node| (condition.body, *node))
        });
        if let Some((body, node)) = prescribed {
            let kind = FaultKind::PrescribedTied {
                step: step.name.clone(),
                body: draft.bodies[body.0].name.into(),
                node,
            };
            faults.push(path, kind);
        }
    }
}

/// Rigid bodies that a step frees though nothing is tied to them, nothing touches them,
/// no spring holds them and they have no mass.
fn free(draft: &Draft<'_>, impossible: &Positions, step: &Step) -> Vec<RigidId> {
    let nothing_moves = |rigid: &RigidId| {
        let Some(body) = draft.rigid_surfaces[rigid.0].part else {
            return false;
        };
        let is = |side: &ContactSurface| matches!(side, ContactSurface::Rigid(id) if id == rigid);
        let pairs = draft.pairs.iter().enumerate();
        let mut possible = pairs
            .filter(|(index, _)| !impossible.contains(index))
            .filter_map(|(_, pair)| pair.pair);
        let touched = possible.any(|pair| is(&pair.a) || is(&pair.b));
        let sprung = is_sprung(draft, Mover::Rigid(*rigid));
        !touched && !sprung && body.ties.is_empty() && body.inertia.is_none()
    };
    let motions = step.rigid_motions.iter();
    let freed = motions.filter(|motion| motion.coordinates.contains(&Freedom::Free));
    freed
        .map(|motion| motion.surface)
        .filter(nothing_moves)
        .collect()
}
