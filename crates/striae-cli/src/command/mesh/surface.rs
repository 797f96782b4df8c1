//! Picture of a mesh: its boundary, with facets in the colours of their sets.

use striae::mesh_file::RigidSurfaceMesh;
use striae_mesh::{Face, Mesh, Vec3};
use striae_report::picture::Surfaces;

/// The boundary of a body. A facet in several sets has the colour of the smallest; without
/// sets of facets, those of elements are shown.
pub fn of_body(mesh: &Mesh) -> Surfaces {
    let faces = mesh.boundary_faces();
    let is_chosen = |name: &str| name != "all";
    let facets = mesh.facet_sets.iter();
    let facets = facets.filter(|(name, _)| is_chosen(name));
    let mut sets: Vec<(&str, Vec<Face>)> = facets
        .map(|(name, members)| (name, members.to_vec()))
        .collect();
    if sets.is_empty() {
        let elements = mesh.element_sets.iter();
        let elements = elements.filter(|(name, _)| is_chosen(name));
        sets.extend(elements.map(|(name, members)| (name, mesh.boundary_of(members))));
    }
    let mut smaller: Vec<usize> = (0..sets.len()).collect();
    smaller.sort_by_key(|at| std::cmp::Reverse(sets[*at].1.len()));
    let mut named = vec![None; faces.len()];
    for at in smaller {
        for face in &sets[at].1 {
            if let Ok(place) = faces.binary_search(face) {
                named[place] = Some(at);
            }
        }
    }
    let corners = faces.iter().map(|face| mesh.face_nodes(*face));
    Surfaces {
        places: places(&mesh.positions),
        faces: corners.map(|nodes| nodes.map(|n| n.index())).collect(),
        named,
        names: sets.into_iter().map(|(name, _)| name.to_owned()).collect(),
        ..Surfaces::default()
    }
}

/// A rigid surface with the normals of its facets.
pub fn of_rigid(surface: &RigidSurfaceMesh) -> Surfaces {
    let facets = surface.facets.iter();
    Surfaces {
        places: places(&surface.positions),
        faces: facets.map(|nodes| nodes.map(|n| n.index())).collect(),
        named: vec![None; surface.facets.len()],
        shows_normals: true,
        ..Surfaces::default()
    }
}

fn places(positions: &[Vec3]) -> Vec<[f64; 3]> {
    positions.iter().map(|x| (*x).into()).collect()
}
