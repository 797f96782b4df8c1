//! Fibres through what is behind the facets of pairs.

use striae_contact::{
    interference::{Fibre, fibres, lengths},
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
        pair.fibres = Side::BOTH.map(|side| {
            let Some(surface) = pair.contact.sides[side].surface() else {
                return Vec::new();
            };
            let Some(body) = pair.bodies[side] else {
                let x = &pair.rigid_reference;
                return fibres(surface, x, surface, x);
            };
            let skin = skins[body].get_or_insert_with(|| skin(body));
            of_body(&model.bodies[body].mesh.positions, surface, skin)
        });
        if pair.contact.is_in_one_body() {
            for side in Side::BOTH {
                let own = pair.bodies[side].zip(pair.contact.sides[side].surface());
                let Some((body, surface)) = own else { continue };
                let positions = &model.bodies[body].mesh.positions;
                let at = |node: NodeId| positions[node.index()];
                let x: Vec<Vec3> = surface.nodes().iter().map(|node| at(*node)).collect();
                let thickness = lengths(surface, &x, &pair.fibres[side], at);
                pair.contact.sides[side].thickness = thickness;
            }
        }
    }
}

fn of_body(positions: &[Vec3], surface: &Surface, skin: &Surface) -> Vec<Option<Fibre>> {
    let at = |surface: &Surface| -> Vec<Vec3> {
        let nodes = surface.nodes().iter();
        nodes.map(|node| positions[node.index()]).collect()
    };
    fibres(surface, &at(surface), skin, &at(skin))
}
