//! Generators against closed forms, over ranges of their parameters.

mod annulus;
mod block;
mod capped_block;
mod half_cylinder;
mod limits;
mod round;

use striae_mesh::{Face, Mesh, Vec3};

/// Faces of the set with the integral of the outward normal over each.
pub(crate) fn normals(mesh: &Mesh, set: &str) -> Vec<Vec3> {
    let faces = mesh.facet_sets.get(set).unwrap();
    faces.iter().map(|&face| mesh.area_vector(face)).collect()
}

pub(crate) fn area(mesh: &Mesh, set: &str) -> f64 {
    mesh.area(mesh.facet_sets.get(set).unwrap())
}

/// The named sets share out the boundary: every face once, node sets to match.
pub(crate) fn assert_sets_share_out_the_boundary(mesh: &Mesh, sets: &[&str]) {
    let mut faces: Vec<Face> = Vec::new();
    for set in sets {
        let members = mesh.facet_sets.get(set).unwrap();
        faces.extend(members);
        let nodes = mesh.nodes_of_faces(members);
        assert_eq!(mesh.node_sets.get(set), Some(nodes.as_slice()), "{set}");
    }
    faces.sort_unstable();
    assert_eq!(faces, mesh.boundary_faces());
    let count = mesh.positions.len();
    assert_eq!(mesh.node_sets.get("all").unwrap().len(), count);
    let count = mesh.element_count();
    assert_eq!(mesh.element_sets.get("all").unwrap().len(), count);
    let closed: Vec3 = faces.iter().map(|&face| mesh.area_vector(face)).sum();
    assert!(closed.norm() < 1e-12 * mesh.area(&faces));
}

pub(crate) fn assert_close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} is not {b}");
}

/// Order of convergence from errors at sizes that halve.
pub(crate) fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}
