//! Restraint of bodies: displacement conditions must stop all six rigid motions of a body that is
//! in no contact pair and not tied, in every step without inertia, see [`RigidMotions`].

use std::collections::BTreeSet;

use striae_mesh::{Mesh, NodeId, Vec3};
use striae_solve::model::{BodyId, ContactSurface, Procedure, Step};

use super::{Draft, List};
use crate::{fault::FaultKind, motions::RigidMotions, path::Path};

/// Notes every body that can move freely, in the first step in which it can. All pairs
/// and steps must be known, as each might be what holds the body.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, of) in draft.bodies.iter().enumerate() {
        let body = BodyId(index);
        let Some(mesh) = of
            .mesh
            .filter(|_| !touches(draft, body) && !is_tied(draft, body))
        else {
            continue;
        };
        let mut prescribed = BTreeSet::new();
        for (index, step) in draft.steps.iter().map(|of| of.step).enumerate() {
            prescribe(&mut prescribed, step, body);
            if step.procedure != Procedure::QuasiStatic {
                continue;
            }
            let motions = free_motions(mesh, &prescribed);
            if motions > 0 {
                let kind = FaultKind::Free {
                    body: of.name.to_owned(),
                    step: step.name.clone(),
                    motions,
                };
                faults.push(Path::part("steps", index), kind);
                break;
            }
        }
    }
}

pub(super) fn is_tied(draft: &Draft<'_>, body: BodyId) -> bool {
    let rigid = draft.rigid_surfaces.iter().filter_map(|rigid| rigid.part);
    let mut to_rigid = rigid.flat_map(|rigid| &rigid.ties);
    let mut ties = draft.ties.iter().filter_map(|tie| tie.part);
    // A tie that is not known might be what holds it.
    let unknown = draft.ties.iter().any(|tie| tie.part.is_none());
    unknown || to_rigid.any(|(tied, _)| *tied == body) || ties.any(|tie| tie.joins(body))
}

fn touches(draft: &Draft<'_>, body: BodyId) -> bool {
    let is = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: other, .. } if *other == body);
    let mut pairs = draft.pairs.iter().filter_map(|pair| pair.pair);
    // Contact of a body with itself holds it nowhere.
    pairs.any(|pair| !pair.is_within_a_body() && (is(&pair.a) || is(&pair.b)))
}

pub(super) fn prescribe(prescribed: &mut BTreeSet<(NodeId, usize)>, step: &Step, body: BodyId) {
    for release in step.releases.iter().filter(|release| release.body == body) {
        prescribed.retain(|(node, component)| {
            !(release.components[*component] && release.nodes.contains(node))
        });
    }
    for condition in step
        .displacements
        .iter()
        .filter(|condition| condition.body == body)
    {
        for component in (0..3).filter(|component| condition.components[*component].is_some()) {
            prescribed.extend(condition.nodes.iter().map(|node| (*node, component)));
        }
    }
}

fn free_motions(mesh: &Mesh, prescribed: &BTreeSet<(NodeId, usize)>) -> usize {
    let mut motions = RigidMotions::of(mesh);
    for (node, component) in prescribed {
        motions.stop(&mesh.positions[node.index()], &Vec3::ith(*component, 1.0));
    }
    motions.left()
}
