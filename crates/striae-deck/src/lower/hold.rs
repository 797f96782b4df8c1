//! Whether every body is held: a body that is in no contact pair and not tied must have all
//! six rigid motions stopped by displacement conditions, in every step without inertia.
//!
//! A condition on component `i` of a node at `X` sees of the rigid motions
//! `u = c + w x (X - X0)` the number `r . (c, w)` with the row
//! `r = (e_i, (X - X0) x e_i)`. The motions are stopped when the rows have
//! rank six. Lengths are scaled by the size of the body.

use super::Parts;
use crate::{fault::FaultKind, faults::FaultList};
use nalgebra::{Matrix6, Vector6};
use std::collections::BTreeSet;
use striae_mesh::{Mesh, NodeId, Vec3};
use striae_solve::model::{BodyId, Pair, Procedure, RigidSurface, Side, Step};

/// Eigenvalue of the normal matrix, relative to the largest, that counts as zero.
const SINGULAR: f64 = 1e-9;

/// Notes every body that can move freely, in the first step in which it can.
pub(super) fn check(parts: &Parts<'_>, faults: &mut FaultList<'_>) {
    let &Parts {
        bodies,
        rigid,
        pairs,
        steps,
        written,
    } = parts;
    // A faulty pair or step might be what holds the body.
    let (Some(pairs), Some(steps)) = (known(pairs), known(steps)) else {
        return;
    };
    for body in bodies
        .ids()
        .filter(|body| !pairs.iter().any(|pair| touches(pair, *body)))
        .filter(|body| !is_tied(rigid, *body))
    {
        let Some(mesh) = bodies.mesh(body) else {
            continue;
        };
        let mut prescribed = BTreeSet::new();
        for (step, at) in steps.iter().zip(written) {
            prescribe(&mut prescribed, step, body);
            if step.procedure != Procedure::QuasiStatic {
                continue;
            }
            let motions = free_motions(mesh, &prescribed);
            if motions > 0 {
                let body = bodies.name(body).to_owned();
                faults.push(
                    &at.span,
                    FaultKind::Free {
                        body,
                        step: step.name.clone(),
                        motions,
                    },
                );
                break;
            }
        }
    }
}

fn known<T>(list: &[Option<T>]) -> Option<Vec<&T>> {
    list.iter().map(Option::as_ref).collect()
}

fn is_tied(rigid: &[Option<RigidSurface>], body: BodyId) -> bool {
    let ties = rigid.iter().flatten().flat_map(|rigid| &rigid.ties);
    ties.into_iter().any(|(tied, _)| *tied == body)
}

fn touches(pair: &Pair, body: BodyId) -> bool {
    [&pair.a, &pair.b]
        .into_iter()
        .any(|side| matches!(side, Side::Deformable { body: other, .. } if *other == body))
}

fn prescribe(prescribed: &mut BTreeSet<(NodeId, usize)>, step: &Step, body: BodyId) {
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
    let count = mesh.positions.len() as f64;
    let centre = mesh.positions.iter().sum::<Vec3>() / count;
    let size = mesh
        .positions
        .iter()
        .map(|x| (x - centre).norm())
        .fold(f64::MIN_POSITIVE, f64::max);
    let mut normal = Matrix6::zeros();
    for (node, component) in prescribed {
        let e = Vec3::ith(*component, 1.0);
        let arm = ((mesh.positions[node.index()] - centre) / size).cross(&e);
        let row = Vector6::new(e.x, e.y, e.z, arm.x, arm.y, arm.z);
        normal += row * row.transpose();
    }
    let eigenvalues = normal.symmetric_eigenvalues();
    let largest = eigenvalues.max();
    eigenvalues
        .iter()
        .filter(|value| **value <= SINGULAR * largest)
        .count()
}
