//! Deformable sides of pairs, and the skins that they are part of.

use std::collections::{BTreeSet, HashMap};

use striae_contact::pair::{Enclosure, Geometry, PairedSurface};
use striae_mesh::{Face, FacetId, NodeId};
use striae_surface::topology::Surface;

use crate::model::{ContactSurface, Model, Pair};

/// Side of a pair that consists of these faces of a body.
pub(super) fn deformable(
    model: &Model,
    body: usize,
    faces: &[Face],
    feature_angle: Option<f64>,
) -> PairedSurface {
    let body_model = &model.bodies[body];
    let facets: Vec<[NodeId; 4]> = faces
        .iter()
        .map(|&f| body_model.mesh.face_nodes(f))
        .collect();
    let surface = match feature_angle {
        None => Surface::new(&facets),
        Some(angle) => {
            let normals = facets.iter().map(|corners| {
                let [a, b, c, d] = corners.map(|node| body_model.mesh.positions[node.index()]);
                (c - a).cross(&(d - b)).normalize()
            });
            let cosine = angle.to_radians().cos();
            Surface::with_faces(&facets, &normals.collect::<Vec<_>>(), cosine)
        }
    };
    PairedSurface {
        geometry: Geometry::Deformable(surface),
        stiffness: body_model.modulus_at(faces),
        texture: None,
        behind: Vec::new(),
        enclosure: feature_angle.map(|_| enclosure(model, body, faces)),
    }
}

/// The faces of a body that any pair knows by its faces, of which a side has some.
fn enclosure(model: &Model, body: usize, own: &[Face]) -> Enclosure {
    let by_faces = model
        .pairs
        .iter()
        .filter(|pair| pair.feature_angle.is_some());
    let sides = by_faces.flat_map(Pair::surfaces);
    let known = sides.filter_map(|side| match side {
        ContactSurface::Deformable { body: of, faces } if of.0 == body => Some(faces),
        _ => None,
    });
    let faces: BTreeSet<Face> = known.flatten().chain(own).copied().collect();
    let facets = own.iter().enumerate();
    let facets: HashMap<Face, FacetId> =
        facets.map(|(at, face)| (*face, FacetId::new(at))).collect();
    let mesh = &model.bodies[body].mesh;
    let corners: Vec<[NodeId; 4]> = faces.iter().map(|face| mesh.face_nodes(*face)).collect();
    Enclosure {
        surface: Surface::new(&corners),
        facets: faces.iter().map(|face| facets.get(face).copied()).collect(),
    }
}
