//! Fibres through what is behind the facets of pairs.

use striae_contact::{
    body_edge::beyond_edges,
    interference::{Fibre, Thickness, fibres, lengths},
    pair::{Behind, End, Geometry},
    side::Side,
};
use striae_mesh::{NodeId, Vec3};
use striae_surface::topology::Surface;

use super::PairGeometry;
use crate::model::Model;

/// Fibres through what is behind the facets of all pairs. They end at nodes of the
/// body, or of the rigid surface.
pub fn add_fibres(model: &Model, pairs: &mut [PairGeometry]) {
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
        if !has_plane && (pair.contact.has_faces || pair.contact.is_self_contact()) {
            let behind = behind(model, pair);
            for (side, behind) in Side::BOTH.into_iter().zip(behind) {
                pair.contact.sides[side].behind = behind;
            }
        }
    }
}

/// Material behind the facets of the sides of a pair.
fn behind(model: &Model, pair: &PairGeometry) -> [Vec<Behind>; 2] {
    let at = |body: usize, node: NodeId| model.bodies[body].mesh.positions[node.index()];
    let surfaces = Side::BOTH.map(|side| pair.contact.sides[side].surface());
    let count = |surface: Option<&Surface>| surface.map_or(0, |surface| surface.facets().len());
    let mut beyond_edges = match pair.bodies[Side::A] {
        Some(body) if pair.contact.is_in_one_body() => {
            beyond_edges(surfaces, |node| at(body, node))
        }
        _ => surfaces.map(|surface| vec![Vec::new(); count(surface)]),
    };
    let Thickness(thickness) = thickness_with(pair, at);
    let mut thickness = thickness.into_iter();
    Side::BOTH.map(|side| {
        let through = thickness.next().unwrap_or_default().into_iter();
        let beyond_edges = std::mem::take(&mut beyond_edges[side]);
        let end = |fibre: &Option<Fibre>| end(pair, pair.bodies[side]?, fibre.as_ref()?);
        through
            .zip(&pair.fibres[side])
            .zip(beyond_edges)
            .map(|((thickness, fibre), beyond_edges)| Behind {
                thickness,
                end: end(fibre),
                beyond_edges,
            })
            .collect()
    })
}

/// Thickness with the nodes of bodies at given places.
pub fn thickness_with(geometry: &PairGeometry, at: impl Fn(usize, NodeId) -> Vec3) -> Thickness {
    Thickness(Side::BOTH.map(|side| {
        let Some(surface) = geometry.contact.sides[side].surface() else {
            return Vec::new();
        };
        let rigid = &geometry.rigid_reference;
        let x: Vec<Vec3> = match geometry.bodies[side] {
            Some(body) => surface.nodes().iter().map(|&node| at(body, node)).collect(),
            None => rigid.clone(),
        };
        let end = |node: NodeId| match geometry.bodies[side] {
            Some(body) => at(body, node),
            None => {
                rigid[surface
                    .node(node)
                    .expect("the skin of a rigid side is the side")]
            }
        };
        lengths(surface, &x, &geometry.fibres[side], end)
    }))
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
