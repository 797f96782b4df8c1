//! Pieces of bodies that are not joined to the rest: each must be held on its own, by
//! contact, a tie or displacement conditions, in every step without inertia.

use std::collections::BTreeSet;

use crate::{
    fault::FaultKind,
    model::{BodyId, ContactSurface, Procedure, SpringEnd, SpringLine},
    motions::RigidMotions,
    path::Path,
};
use striae_mesh::{Face, Mesh, NodeId};

use super::{Draft, List, hold};

/// Notes every piece that can move freely, in the first step in which it can.
pub(super) fn check(draft: &Draft<'_>, faults: &mut List) {
    for (index, of) in draft.bodies.iter().enumerate() {
        let Some(mesh) = of.mesh else { continue };
        let pieces = mesh.pieces();
        if pieces.len() < 2 {
            continue;
        }
        let body = BodyId(index);
        let touched = touched(draft, body, mesh);
        let loose = pieces.iter().filter(|piece| {
            let mut nodes = piece.iter();
            !nodes.any(|node| touched.contains(node))
        });
        for piece in loose {
            of_piece(draft, body, (mesh, piece, pieces.len()), faults);
        }
    }
}

fn of_piece(
    draft: &Draft<'_>,
    body: BodyId,
    (mesh, piece, pieces): (&Mesh, &[NodeId], usize),
    faults: &mut List,
) {
    let place = |node: NodeId| &mesh.positions[node.index()];
    let mut prescribed = hold::Held::new();
    for (index, step) in draft.steps.iter().map(|of| of.step).enumerate() {
        hold::prescribe(&mut prescribed, step, (body, mesh));
        if step.procedure != Procedure::QuasiStatic {
            continue;
        }
        let mut motions = RigidMotions::around(piece.iter().map(|node| place(*node)));
        let own = |node: &NodeId| piece.binary_search(node).is_ok();
        for (node, of_node) in prescribed.iter().filter(|(node, _)| own(node)) {
            for (_, direction) in of_node {
                motions.stop(place(*node), direction);
            }
        }
        for (node, direction) in hold::grounded(draft, (body, mesh)) {
            if own(&node) {
                motions.stop(place(node), &direction);
            }
        }
        if motions.left() == 0 {
            continue;
        }
        let coincident = mesh.coincident_nodes();
        let coincident = coincident.iter().filter(|[a, b]| own(a) != own(b));
        let kind = FaultKind::LoosePiece {
            body: draft.bodies[body.0].name.to_owned(),
            pieces,
            nodes: piece.len(),
            node: piece[0],
            at: *place(piece[0]),
            step: step.name.clone(),
            motions: motions.left(),
            coincident: coincident.count(),
        };
        faults.push(Path::part("steps", index), kind);
        return;
    }
}

/// Nodes of a body that contact, a tie or a spring to another body may hold.
fn touched(draft: &Draft<'_>, body: BodyId, mesh: &Mesh) -> BTreeSet<NodeId> {
    let of_side = |side: &ContactSurface| match side {
        ContactSurface::Deformable { body: of, faces } if *of == body => faces.clone(),
        _ => Vec::<Face>::new(),
    };
    let pairs = draft.pairs.iter().filter_map(|pair| pair.pair);
    let pairs = pairs.flat_map(|pair| [of_side(&pair.a), of_side(&pair.b)].concat());
    let ties = draft.ties.iter().filter_map(|tie| tie.part);
    let ties = ties.flat_map(|tie| [of_side(&tie.a), of_side(&tie.b)].concat());
    let faces = pairs.chain(ties);
    let mut nodes: BTreeSet<NodeId> = faces.flat_map(|face| mesh.face_nodes(face)).collect();
    let rigid = draft.rigid_surfaces.iter().filter_map(|rigid| rigid.part);
    for (of, tied) in rigid.flat_map(|rigid| &rigid.ties) {
        if *of == body {
            nodes.extend(tied.iter().copied());
        }
    }
    let springs = draft.springs.iter().filter_map(|spring| spring.part);
    for spring in springs.filter(|spring| matches!(spring.line, SpringLine::To(_))) {
        for end in spring.ends().filter(|_| spring.stiffness > 0.0) {
            match end {
                SpringEnd::Nodes {
                    body: of,
                    nodes: own,
                } if *of == body => nodes.extend(own),
                _ => {}
            }
        }
    }
    nodes
}
