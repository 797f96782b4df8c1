//! STL files, whole and broken.

use super::{assert_explained, cube_triangles, written};
use crate::{RigidSurfaceMesh, stl::rigid_surface};
use striae_mesh::Vec3;

fn volume(surface: &RigidSurfaceMesh) -> f64 {
    let facets = surface.facets.iter();
    facets
        .map(|facet| {
            let [a, b, c, d] = facet.map(|node| surface.positions[node.index()]);
            (a.dot(&b.cross(&c)) + a.dot(&c.cross(&d))) / 6.0
        })
        .sum()
}

#[test]
fn stl_triangles_share_their_corners() {
    let mut triangles = cube_triangles();
    triangles.push([Vec3::zeros(), Vec3::zeros(), Vec3::x()]);
    let ascii = written::stl_ascii(&triangles);
    for bytes in [
        ascii.to_ascii_uppercase(),
        ascii,
        written::stl_binary(&triangles),
    ] {
        let surface = rigid_surface(&bytes).unwrap();
        assert_eq!((surface.positions.len(), surface.facets.len()), (8, 12));
        assert_eq!(surface.left_out, 1);
        assert!(surface.facets.iter().all(|facet| facet[2] == facet[3]));
        assert!((volume(&surface) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn broken_stl_files_are_explained() {
    let mut short = written::stl_binary(&cube_triangles());
    short.pop();
    assert_explained(
        rigid_surface(&short).map(drop),
        ["declares 684 bytes", "has 683"],
    );
    assert_explained(rigid_surface(b"abc").map(drop), ["84", "has 3"]);
    let text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n";
    assert_explained(rigid_surface(text).map(drop), ["line 4", "a coordinate"]);
    let text = b"solid a\nendsolid a\n";
    assert_explained(rigid_surface(text).map(drop), ["triangles", "export"]);
}

/// Corners that are nowhere are named by their line, in binary files by their triangle.
#[test]
fn corners_that_are_not_finite_are_refused() {
    let mut triangles = cube_triangles();
    triangles[1][2].y = f64::NAN;
    assert_explained(
        rigid_surface(&written::stl_binary(&triangles)).map(drop),
        [
            "triangle 2: expected finite coordinates, found a corner at",
            "NaN",
        ],
    );
    for infinite in ["NaN", "-inf", "1e999"] {
        let text = format!(
            "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 {infinite} 0\n"
        );
        assert_explained(
            rigid_surface(text.as_bytes()).map(drop),
            [
                "line 5: expected finite coordinates",
                "export the surface again",
            ],
        );
    }
}
