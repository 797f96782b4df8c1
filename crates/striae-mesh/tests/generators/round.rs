//! Cylinders and rings of round section.

use crate::{area, assert_close, assert_sets_share_out_the_boundary, normals, orders};
use proptest::prelude::*;
use std::f64::consts::PI;
use striae_mesh::Vec3;
use striae_mesh::generate::{Cylinder, Sector, Torus};

#[test]
fn cylinder_sides_are_where_they_belong() {
    let cylinder = Cylinder {
        base: Vec3::new(1.0, 2.0, 3.0),
        radius: 2.0,
        height: 5.0,
        divisions: [3, 2, 4],
        ..Cylinder::default()
    };
    let mesh = cylinder.mesh().unwrap();
    assert_sets_share_out_the_boundary(&mesh, &["side", "zmin", "zmax"]);
    for node in mesh.node_sets.get("side").unwrap() {
        let from_axis = (mesh.positions[node.index()] - cylinder.base).xy().norm();
        assert_close(from_axis, 2.0, 1e-14);
    }
    for (set, normal) in [("zmin", -Vec3::z()), ("zmax", Vec3::z())] {
        for vector in normals(&mesh, set) {
            assert_close(vector.dot(&normal), vector.norm(), 1e-12);
        }
    }
    let quarter = Cylinder {
        sector: Sector::Quarter,
        ..cylinder
    };
    let part = quarter.mesh().unwrap();
    assert_sets_share_out_the_boundary(&part, &["side", "zmin", "zmax", "xmin", "ymin"]);
    assert_close(4.0 * part.volume(), mesh.volume(), 1e-13);
    for (set, normal) in [("xmin", -Vec3::x()), ("ymin", -Vec3::y())] {
        assert_close(area(&part, set), 10.0, 1e-13);
        for vector in normals(&part, set) {
            assert_close(vector.dot(&normal), vector.norm(), 1e-12);
        }
    }
}

#[test]
fn torus_surface_is_round() {
    let ring = Torus {
        centre: Vec3::new(1.0, 2.0, 3.0),
        ..Torus::default()
    };
    let mesh = ring.mesh().unwrap();
    assert_sets_share_out_the_boundary(&mesh, &["surface"]);
    for node in mesh.node_sets.get("surface").unwrap() {
        let x = mesh.positions[node.index()] - ring.centre;
        assert_close((x.xy().norm() - 4.0).hypot(x.z), 1.0, 1e-13);
    }
    for (vector, &face) in normals(&mesh, "surface")
        .iter()
        .zip(mesh.facet_sets.get("surface").unwrap())
    {
        let middle = mesh.face_positions(face).iter().sum::<Vec3>() / 4.0 - ring.centre;
        let on_line = Vec3::new(middle.x, middle.y, 0.0).normalize() * 4.0;
        assert!(vector.dot(&(middle - on_line)) > 0.0);
    }
}

#[test]
fn round_bodies_converge_with_order_two() {
    let errors = [1, 2, 4].map(|n| {
        let cylinder = Cylinder {
            divisions: [n, n, 1],
            ..Cylinder::default()
        };
        let torus = Torus {
            divisions: [n, n, 12 * n],
            ..Torus::default()
        };
        let (cylinder, torus) = (cylinder.mesh().unwrap(), torus.mesh().unwrap());
        [
            (cylinder.volume() - PI).abs(),
            (area(&cylinder, "side") - 2.0 * PI).abs(),
            (torus.volume() - 8.0 * PI * PI).abs(),
            (area(&torus, "surface") - 16.0 * PI * PI).abs(),
        ]
    });
    for quantity in 0..4 {
        for order in orders(&errors.map(|all| all[quantity])) {
            assert!((order - 2.0).abs() < 0.1, "order {order}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn round_bodies_stay_valid(
        core in 1..5usize,
        band in 1..5usize,
        along in 3..7usize,
        axis in prop::array::uniform3(-1.0..1.0f64),
        hole in 0.2..5.0f64,
    ) {
        prop_assume!(Vec3::from(axis).norm() > 0.1);
        let cylinder = Cylinder {
            axis: axis.into(),
            divisions: [core, band, along],
            ..Cylinder::default()
        };
        prop_assert!(cylinder.mesh().unwrap().quality().smallest_scaled_jacobian > 0.4);
        let torus = Torus {
            axis: axis.into(),
            ring_radius: 1.0 + hole,
            divisions: [core, band, 2 * along],
            ..Torus::default()
        };
        prop_assert!(torus.mesh().unwrap().quality().smallest_scaled_jacobian > 0.2);
    }
}
