//! Restraint of bodies: displacement conditions and springs to ground must stop all six rigid motions
//! of a body that is in no contact pair, not tied and not joined to others by springs, in every step without inertia, see [`RigidMotions`].

use std::collections::BTreeMap;

use crate::{
    axes::{NodeFrame, are_parallel},
    fault::FaultKind,
    model::{BodyId, ContactSurface, Mover, Procedure, SpringEnd, SpringLine, Step},
    motions::RigidMotions,
    path::Path,
};
use striae_mesh::{Mesh, NodeId, Vec3};

use super::{Draft, List};

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
        let mut prescribed = Held::new();
        for (index, step) in draft.steps.iter().map(|of| of.step).enumerate() {
            prescribe(&mut prescribed, step, (body, mesh));
            if step.procedure != Procedure::QuasiStatic {
                continue;
            }
            let motions = free_motions(draft, (body, mesh), &prescribed);
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
    // A tie or a spring that is not known might be what holds it.
    let unknown = draft.ties.iter().any(|tie| tie.part.is_none())
        || draft.springs.iter().any(|spring| spring.part.is_none());
    unknown
        || is_sprung_to_another(draft, body)
        || to_rigid.any(|(tied, _)| *tied == body)
        || ties.any(|tie| tie.joins(body))
}

/// Returns whether springs join a body to another one.
fn is_sprung_to_another(draft: &Draft<'_>, body: BodyId) -> bool {
    let springs = draft.springs.iter().filter_map(|spring| spring.part);
    let mut holding = springs.filter(|spring| spring.holds(Mover::Deformable(body)));
    holding.any(|spring| !spring.ends().all(|end| end.is_on(Mover::Deformable(body))))
}

/// Returns whether springs hold a body or rigid body.
pub(super) fn is_sprung(draft: &Draft<'_>, mover: Mover) -> bool {
    let mut springs = draft.springs.iter();
    // A spring that is not known might be what holds it.
    springs.any(|spring| spring.part.is_none_or(|spring| spring.holds(mover)))
}

/// Places of nodes of a body that springs hold against ground, with directions in which they do.
pub(super) fn grounded(draft: &Draft<'_>, (body, mesh): (BodyId, &Mesh)) -> Vec<(NodeId, Vec3)> {
    let mut all = Vec::new();
    let springs = draft.springs.iter().filter_map(|spring| spring.part);
    for spring in springs.filter(|spring| spring.stiffness > 0.0) {
        let SpringEnd::Nodes { body: of, nodes } = &spring.a else {
            continue;
        };
        for node in nodes.iter().filter(|_| *of == body) {
            let direction = match &spring.line {
                SpringLine::To(_) => None,
                SpringLine::ToPoint(point) => {
                    (mesh.positions[node.index()] - point).try_normalize(0.0)
                }
                SpringLine::Along(direction) => Some(*direction),
            };
            all.extend(direction.map(|direction| (*node, direction)));
        }
    }
    all
}

fn touches(draft: &Draft<'_>, body: BodyId) -> bool {
    let is = |side: &ContactSurface| matches!(side, ContactSurface::Deformable { body: other, .. } if *other == body);
    let mut pairs = draft.pairs.iter().filter_map(|pair| pair.pair);
    // Contact of a body with itself holds it nowhere.
    pairs.any(|pair| !pair.is_within_a_body() && (is(&pair.a) || is(&pair.b)))
}

/// Directions along which nodes of a body are prescribed, with the components that they are in
/// the axes in which they were stated.
pub(super) type Held = BTreeMap<NodeId, Vec<(usize, Vec3)>>;

/// Takes the releases of a step, then its displacements, into account.
pub(super) fn prescribe(held: &mut Held, step: &Step, (body, mesh): (BodyId, &Mesh)) {
    for release in step.releases.iter().filter(|release| release.body == body) {
        for node in &release.nodes {
            if let Some(of_node) = held.get_mut(node) {
                of_node.retain(|(component, _)| !release.components[*component]);
            }
        }
    }
    for condition in step.displacements.iter().filter(|of| of.body == body) {
        for node in &condition.nodes {
            let directions = condition.axes.directions(&mesh.positions[node.index()]);
            let of_node = held.entry(*node).or_default();
            for (component, direction) in directions.into_iter().enumerate() {
                if let (Some(direction), Some(_)) = (direction, &condition.components[component]) {
                    of_node.retain(|(_, other)| !are_parallel(other, &direction));
                    of_node.push((component, direction));
                }
            }
        }
    }
}

/// Part of a vector that nothing holds at a node.
pub(super) fn left(held: &[(usize, Vec3)], vector: &Vec3) -> Vec3 {
    let directions: Vec<Vec3> = held.iter().map(|(_, direction)| *direction).collect();
    let frame = NodeFrame::new(&directions);
    frame.map_or(*vector, |frame| frame.free() * vector)
}

fn free_motions(draft: &Draft<'_>, (body, mesh): (BodyId, &Mesh), held: &Held) -> usize {
    let mut motions = RigidMotions::of(mesh);
    for (node, direction) in grounded(draft, (body, mesh)) {
        motions.stop(&mesh.positions[node.index()], &direction);
    }
    for (node, of_node) in held {
        for (_, direction) in of_node {
            motions.stop(&mesh.positions[node.index()], direction);
        }
    }
    motions.left()
}
