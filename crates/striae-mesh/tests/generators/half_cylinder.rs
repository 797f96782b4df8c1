//! Slices of half cylinders.

use crate::{area, assert_close, assert_sets_share_out_the_boundary, normals, orders};
use proptest::prelude::*;
use std::f64::consts::PI;
use striae_mesh::generate::{Half, HalfCylinder};
use striae_mesh::{NodeId, Vec3};

#[test]
fn half_cylinder_sides_are_where_they_belong() {
    for (half, up) in [(Half::Lower, 1.0), (Half::Upper, -1.0)] {
        let slice = HalfCylinder {
            apex: Vec3::new(1.0, 2.0, 3.0),
            half,
            thickness: 0.5,
            layers: 2,
            ..HalfCylinder::default()
        };
        let mesh = slice.mesh().unwrap();
        assert_sets_share_out_the_boundary(&mesh, &["flat", "arc", "ymin", "ymax"]);
        let centre = slice.apex + Vec3::z() * (8.0 * up);
        let position = |node: &NodeId| mesh.positions[node.index()];
        for x in mesh.node_sets.get("arc").unwrap().iter().map(position) {
            assert_close((x - centre).xz().norm(), 8.0, 1e-13);
        }
        for x in mesh.node_sets.get("flat").unwrap().iter().map(position) {
            assert_close(x.z, centre.z, 1e-14);
        }
        assert!(
            mesh.node_sets
                .get("arc")
                .unwrap()
                .iter()
                .any(|n| (position(n) - slice.apex).norm() < 1e-13)
        );
        assert_close(area(&mesh, "flat"), 8.0, 1e-13);
        for (set, normal) in [
            ("flat", Vec3::z() * up),
            ("ymin", -Vec3::y()),
            ("ymax", Vec3::y()),
        ] {
            for vector in normals(&mesh, set) {
                assert_close(vector.dot(&normal), vector.norm(), 1e-12);
            }
        }
        for (vector, &face) in normals(&mesh, "arc")
            .iter()
            .zip(mesh.facet_sets.get("arc").unwrap())
        {
            let middle = mesh.face_positions(face).iter().sum::<Vec3>() / 4.0;
            assert!(vector.dot(&(middle - centre)) > 0.0);
        }
    }
}

#[test]
fn half_cylinder_elements_have_the_wanted_size_at_the_contact() {
    for h in [0.4, 0.1, 0.05] {
        let slice = HalfCylinder {
            element_size: h,
            fine_depth: 0.5,
            ..HalfCylinder::default()
        };
        let mesh = slice.mesh().unwrap();
        let near = mesh
            .positions
            .iter()
            .position(|x| x.norm() < 1e-13)
            .unwrap();
        for &element in &mesh.elements_of_nodes()[near] {
            let x = mesh.element_positions(element);
            let [along, deep] = [3, 1].map(|c| (x[c] - x[0]).norm());
            assert!(
                (along - h).abs() < 0.01 * h && (deep - h).abs() < 0.01 * h,
                "{along} {deep}"
            );
        }
        assert!(mesh.quality().smallest_scaled_jacobian > 0.5);
    }
}

#[test]
fn half_cylinder_converges_with_order_two() {
    let errors = [0.4, 0.2, 0.1].map(|h| {
        let slice = HalfCylinder {
            element_size: h,
            growth: 1.0,
            ..HalfCylinder::default()
        };
        let mesh = slice.mesh().unwrap();
        [
            (mesh.volume() - 32.0 * PI).abs(),
            (area(&mesh, "arc") - 8.0 * PI).abs(),
        ]
    });
    for quantity in 0..2 {
        for order in orders(&errors.map(|pair| pair[quantity])) {
            assert!((order - 2.0).abs() < 0.1, "order {order}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn half_cylinders_stay_valid(
        radius in 1.0..20.0f64,
        relative_size in 0.01..0.3f64,
        relative_width in 0.0..0.5f64,
        growth in 1.05..1.6f64,
    ) {
        let slice = HalfCylinder {
            radius,
            element_size: relative_size * radius,
            fine_half_width: relative_width * radius,
            growth,
            ..HalfCylinder::default()
        };
        let quality = slice.mesh().unwrap().quality();
        prop_assert!(quality.smallest_scaled_jacobian > 0.4);
        let exact = 0.5 * PI * radius * radius;
        prop_assert!(quality.volume < exact && quality.volume > 0.9 * exact);
    }
}
