//! Fibres through what is behind the facets of pairs.

use striae_contact::{
    body_edge::beyond_edges,
    interference::{Fibre, fibres, lengths},
    pair::{Behind, End, Geometry},
    side::Side,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::topology::Surface;

use super::PairGeometry;
use crate::model::Model;

/// Fibres through what is behind the facets of all pairs. They end at nodes of the
/// body, or of the rigid surface.
pub(crate) fn add_fibres(model: &Model, pairs: &mut [PairGeometry]) {
    let skin = |body: usize| {
        let mesh = &model.bodies[body].mesh;
        let faces = mesh.boundary_faces().into_iter();
        Surface::new(&faces.map(|face| mesh.face_nodes(face)).collect::<Vec<_>>())
    };
    let mut skins: Vec<Option<Surface>> = vec![None; model.bodies.len()];
    for pair in pairs {
        // A plane has no nodes that could come out of a thin body on its other side.
        let has_plane =
            (pair.contact.sides.iter()).any(|side| matches!(side.geometry, Geometry::Plane { .. }));
        pair.fibres = Side::BOTH.map(|side| {
            let Some(surface) = pair.contact.sides[side].surface() else {
                return Vec::new();
            };
            if has_plane {
                return vec![None; surface.facets().len()];
            }
            let Some(body) = pair.bodies[side] else {
                let x = &pair.rigid_reference;
                return fibres(surface, x, surface, x);
            };
            let skin = skins[body].get_or_insert_with(|| skin(body));
            of_body(&model.bodies[body].mesh.positions, surface, skin)
        });
        if pair.contact.is_in_one_body()
            && let Some(body) = pair.bodies[Side::A]
        {
            let behind = behind(&model.bodies[body].mesh.positions, pair, body);
            for (side, behind) in Side::BOTH.into_iter().zip(behind) {
                pair.contact.sides[side].behind = behind;
            }
        }
    }
}

/// The body behind the facets of the sides of a pair within it.
fn behind(positions: &[Vec3], pair: &PairGeometry, body: usize) -> [Vec<Behind>; 2] {
    let at = |node: NodeId| positions[node.index()];
    let surfaces = Side::BOTH.map(|side| pair.contact.sides[side].surface());
    let mut beyond_edges = beyond_edges(surfaces, at);
    Side::BOTH.map(|side| {
        let Some(surface) = surfaces[side] else {
            return Vec::new();
        };
        let x: Vec<Vec3> = surface.nodes().iter().map(|node| at(*node)).collect();
        let thickness = lengths(surface, &x, &pair.fibres[side], at);
        let through = thickness.into_iter().zip(&pair.fibres[side]);
        let beyond_edges = std::mem::take(&mut beyond_edges[side]);
        let behind = through
            .zip(beyond_edges)
            .map(|((thickness, fibre), beyond_edges)| Behind {
                thickness,
                end: fibre.as_ref().and_then(|fibre| end(pair, body, fibre)),
                beyond_edges,
            });
        behind.collect()
    })
}

/// The end of a fibre on a side of a pair that is of its body.
fn end(pair: &PairGeometry, body: usize, fibre: &Fibre) -> Option<End> {
    Side::BOTH.into_iter().find_map(|side| {
        let surface = pair.contact.sides[side].surface()?;
        let nodes = fibre.nodes.map(|node| surface.node(node));
        let [Some(a), Some(b), Some(c), Some(d)] = nodes else {
            return None;
        };
        (pair.bodies[side] == Some(body)).then_some(End {
            side,
            nodes: [a, b, c, d],
            weights: fibre.weights,
        })
    })
}

fn of_body(positions: &[Vec3], surface: &Surface, skin: &Surface) -> Vec<Option<Fibre>> {
    let at = |surface: &Surface| -> Vec<Vec3> {
        let nodes = surface.nodes().iter();
        nodes.map(|node| positions[node.index()]).collect()
    };
    fibres(surface, &at(surface), skin, &at(skin))
}
