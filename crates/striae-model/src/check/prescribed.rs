//! Pairs both of whose surfaces are prescribed along their normals: nothing is left for
//! contact to decide.

use crate::{
    fault::FaultKind,
    model::{BodyId, ContactSurface, Pair},
    path::Path,
};
use striae_mesh::{Face, Mesh, NodeId};

use super::{
    Draft, List, Positions,
    hold::{self, Held},
};

/// Component of a normal that counts as zero.
const ACROSS: f64 = 0.1;

/// Notes such pairs of deformable bodies in the first step in which they are.
pub(super) fn check(
    draft: &Draft<'_>,
    impossible: &Positions,
    partial: &Positions,
    faults: &mut List,
) {
    let mut prescribed = vec![Held::new(); draft.bodies.len()];
    let mut known = Positions::new();
    for (index, of) in draft.steps.iter().enumerate() {
        if partial.contains(&index) {
            return;
        }
        for (body, prescribed) in prescribed.iter_mut().enumerate() {
            if let Some(mesh) = draft.bodies[body].mesh {
                hold::prescribe(prescribed, of.step, (BodyId(body), mesh));
            }
        }
        for (number, named) in draft.pairs.iter().enumerate() {
            let pair = named.pair.filter(|_| !impossible.contains(&number));
            let Some(pair) = pair.filter(|pair| both(draft, pair, &prescribed)) else {
                continue;
            };
            if known.insert(number) {
                let kind = FaultKind::BothPrescribed {
                    pair: pair.name.clone(),
                    step: of.step.name.clone(),
                };
                faults.push(Path::part("steps", index), kind);
            }
        }
    }
}

fn both(draft: &Draft<'_>, pair: &Pair, prescribed: &[Held]) -> bool {
    pair.surfaces().into_iter().all(|side| match side {
        ContactSurface::Deformable { body, faces } => {
            let mesh = draft.bodies[body.0].mesh;
            mesh.is_some_and(|mesh| all(mesh, faces, &prescribed[body.0]))
        }
        ContactSurface::Rigid(_) | ContactSurface::Itself => false,
    })
}

/// True where all nodes of all faces are prescribed along the normals of the faces.
fn all(mesh: &Mesh, faces: &[Face], prescribed: &Held) -> bool {
    faces.iter().all(|face| {
        let normal = mesh.area_vector(*face).normalize();
        let nodes = mesh.face_nodes(*face);
        let held = |node: &NodeId| {
            let of_node = prescribed.get(node);
            of_node.is_some_and(|held| hold::left(held, &normal).amax() <= ACROSS)
        };
        nodes.iter().all(held)
    })
}
