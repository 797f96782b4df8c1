//! Rings.

use crate::{area, assert_close, assert_sets_share_out_the_boundary, normals};
use proptest::prelude::*;
use std::f64::consts::PI;
use striae_mesh::generate::{Annulus, Refinement};
use striae_mesh::{MeshError, Vec3};

/// Area of a regular ring of `count` corners between two radii.
fn ring_area(inner: f64, outer: f64, angles: impl Iterator<Item = f64>) -> f64 {
    let factor: f64 = angles.map(|angle| 0.5 * angle.sin()).sum();
    factor * (outer * outer - inner * inner)
}

#[test]
fn annulus_has_the_volume_of_its_polygon() {
    let ring = Annulus {
        divisions: [2, 24, 3],
        ..Annulus::default()
    };
    let mesh = ring.mesh().unwrap();
    assert_sets_share_out_the_boundary(&mesh, &["rim", "tread", "ymin", "ymax"]);
    let step = 2.0 * PI / 24.0;
    let plane = ring_area(0.2, 0.5, std::iter::repeat_n(step, 24));
    assert_close(mesh.volume(), 0.4 * plane, 1e-13);
    assert_close(area(&mesh, "sides"), 2.0 * plane, 1e-13);
    assert_close(area(&mesh, "tread"), 0.4 * 24.0 * (0.5 * step).sin(), 1e-13);
    for (set, sign) in [("rim", -1.0), ("tread", 1.0)] {
        for &face in mesh.facet_sets.get(set).unwrap() {
            let middle = mesh.face_positions(face).iter().sum::<Vec3>() / 4.0;
            let outward = Vec3::new(middle.x, 0.0, middle.z) * sign;
            assert!(mesh.area_vector(face).dot(&outward) > 0.0);
        }
    }
}

#[test]
fn annulus_is_finer_around_its_lowest_point() {
    let ring = Annulus {
        divisions: [1, 61, 1],
        refinement: Some(Refinement {
            half_angle: 40.0,
            ratio: 4.0,
        }),
        ..Annulus::default()
    };
    let mesh = ring.mesh().unwrap();
    let mut sizes: Vec<(f64, f64)> = mesh
        .facet_sets
        .get("tread")
        .unwrap()
        .iter()
        .map(|&face| {
            let psi = |x: Vec3| x.x.atan2(-x.z);
            let x = mesh.face_positions(face);
            let angles = x.map(psi);
            let span = angles
                .iter()
                .map(|a| (a - angles[0]).abs())
                .fold(0.0, f64::max);
            let middle = psi(x.iter().sum::<Vec3>());
            (middle.abs().to_degrees(), span.min(2.0 * PI - span))
        })
        .collect();
    sizes.sort_by(|a, b| a.0.total_cmp(&b.0));
    assert_close(sizes.iter().map(|s| s.1).sum::<f64>(), 2.0 * PI, 1e-12);
    let smallest = sizes[0].1;
    for &(angle, size) in sizes.iter().filter(|s| s.0 < 36.0) {
        assert!((size / smallest - 1.0).abs() < 1e-9, "{angle}");
    }
    let ratio = sizes[60].1 / smallest;
    assert!((3.6..4.0).contains(&ratio), "{ratio}");
}

#[test]
fn annulus_turns_to_any_axis() {
    for axis in [Vec3::x(), -Vec3::y(), Vec3::z(), Vec3::new(1.0, 2.0, -0.5)] {
        let centre = Vec3::new(1.0, 2.0, 3.0);
        let mesh = Annulus {
            axis,
            centre,
            ..Annulus::default()
        }
        .mesh()
        .unwrap();
        let unit = axis.normalize();
        for node in mesh.node_sets.get("rim").unwrap() {
            let arm = mesh.positions[node.index()] - centre;
            assert_close((arm - unit * arm.dot(&unit)).norm(), 0.2, 1e-13);
        }
        for vector in normals(&mesh, "ymax") {
            assert_close(vector.dot(&unit), vector.norm(), 1e-12);
        }
    }
    let none = Annulus {
        axis: Vec3::zeros(),
        ..Annulus::default()
    };
    assert!(matches!(none.mesh(), Err(MeshError::Parameter { .. })));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn rings_stay_valid(
        divisions in [1..4usize, 8..80, 1..4],
        inner_radius in 0.1..0.4f64,
        half_angle in 0.0..90.0f64,
        ratio in 1.0..4.0f64,
    ) {
        let ring = Annulus {
            divisions,
            inner_radius,
            refinement: Some(Refinement { half_angle, ratio }),
            ..Annulus::default()
        };
        let mesh = ring.mesh().unwrap();
        mesh.check_shape().unwrap();
        let exact = 0.4 * PI * (0.25 - inner_radius * inner_radius);
        prop_assert!(mesh.volume() < exact);
        let lowest = Vec3::new(0.0, -0.2, -0.5);
        prop_assert!(mesh.positions.iter().any(|x| (x - lowest).norm() < 1e-14));
    }
}
