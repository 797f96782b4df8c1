//! Blocks on a spherical cap.

use crate::{area, assert_close, assert_sets_share_out_the_boundary, normals, orders};
use proptest::prelude::*;
use striae_mesh::generate::{CappedBlock, Part};
use striae_mesh::{CellKind, MeshError, Vec3};

const CAP_SIDES: [&str; 6] = ["xmin", "xmax", "ymin", "ymax", "cap", "zmax"];

#[test]
fn cap_lies_on_the_sphere_and_starts_at_the_apex() {
    let block = CappedBlock {
        apex: Vec3::new(3.0, -1.0, 2.0),
        ..CappedBlock::default()
    };
    let mesh = block.mesh().unwrap();
    assert_sets_share_out_the_boundary(&mesh, &CAP_SIDES);
    let centre = block.apex + Vec3::z() * 12.0;
    let cap = mesh.node_sets.get("cap").unwrap();
    for node in cap {
        let r = (mesh.positions[node.index()] - centre).norm();
        assert_close(r, 12.0, 1e-14);
    }
    assert!(
        cap.iter()
            .any(|node| mesh.positions[node.index()] == block.apex)
    );
    assert!(normals(&mesh, "cap").iter().all(|n| n.z < 0.0));
    assert_close(area(&mesh, "zmax"), 100.0, 1e-13);
    for node in mesh.node_sets.get("zmax").unwrap() {
        assert_close(mesh.positions[node.index()].z, 8.5, 1e-14);
    }
    assert!(mesh.quality().smallest_scaled_jacobian > 0.6);
}

#[test]
fn nodes_of_the_cap_lie_on_the_sphere_whatever_the_cells() {
    for cells in CellKind::ALL {
        let block = CappedBlock {
            cells,
            ..CappedBlock::default()
        };
        let mesh = block.mesh().unwrap();
        let centre = Vec3::z() * block.radius;
        for node in mesh.node_sets.get("cap").unwrap() {
            let r = (mesh.positions[node.index()] - centre).norm();
            assert_close(r, block.radius, 1e-14);
        }
        for node in mesh.node_sets.get("zmax").unwrap() {
            assert_close(mesh.positions[node.index()].z, block.height, 1e-14);
        }
    }
}

#[test]
fn cap_elements_have_the_wanted_size_at_the_apex() {
    for h in [0.8, 0.4, 0.2] {
        let block = CappedBlock {
            element_size: h,
            fine_half_width: 1.6,
            fine_depth: 0.8,
            ..CappedBlock::default()
        };
        let mesh = block.mesh().unwrap();
        let at_apex = mesh.elements_of_nodes();
        let apex = mesh
            .positions
            .iter()
            .position(|x| *x == block.apex)
            .unwrap();
        assert_eq!(at_apex[apex].len(), 4);
        for &element in &at_apex[apex] {
            let x = mesh.element_positions(element);
            let extent = x[6] - x[0];
            assert_close(extent.x, h, 1e-12);
            assert_close(extent.y, h, 1e-12);
            assert!((x[4].z - x[0].z) <= h * (1.0 + 1e-12));
        }
        for lengths in block.plan_lengths().unwrap() {
            assert_close(lengths.iter().sum::<f64>(), 10.0, 1e-9);
            for pair in lengths.windows(2) {
                assert!((pair[1] / pair[0]).ln().abs() < 1.3f64.ln() + 1e-9);
            }
        }
    }
}

#[test]
fn half_a_block_is_half_of_the_whole() {
    let whole = CappedBlock::default();
    let half = CappedBlock {
        part: Part::Half,
        ..CappedBlock::default()
    };
    let (whole, half) = (whole.mesh().unwrap(), half.mesh().unwrap());
    assert_sets_share_out_the_boundary(&half, &CAP_SIDES);
    assert_eq!(2 * half.element_count(), whole.element_count());
    assert_close(2.0 * half.volume(), whole.volume(), 1e-13);
    for node in half.node_sets.get("ymin").unwrap() {
        assert_eq!(half.positions[node.index()].y, 0.0);
    }
    for place in &half.positions {
        let apart = whole.positions.iter().map(|known| (known - place).norm());
        assert!(apart.fold(f64::INFINITY, f64::min) < 1e-14, "{place}");
    }
}

/// Integral of `R - sqrt(R^2 - r^2)` over a rectangle, the inner integral in
/// closed form, the outer by Simpson's rule.
fn volume_below_cap(radius: f64, half: [f64; 2]) -> f64 {
    let inner = |x: f64| {
        // int_{-b}^{b} sqrt(c^2 - y^2) dy with c^2 = R^2 - x^2.
        let (c_squared, b) = (radius * radius - x * x, half[1]);
        let root = b * (c_squared - b * b).sqrt() + c_squared * (b / c_squared.sqrt()).asin();
        2.0 * b * radius - root
    };
    let (count, a) = (2000, half[0]);
    let step = 2.0 * a / count as f64;
    let sum: f64 = (0..=count)
        .map(|i| {
            let weight = if i == 0 || i == count {
                1.0
            } else {
                2.0 + 2.0 * (i % 2) as f64
            };
            weight * inner(-a + step * i as f64)
        })
        .sum();
    sum * step / 3.0
}

#[test]
fn capped_volume_converges_with_order_two() {
    let exact = 650.0 - volume_below_cap(12.0, [5.0, 5.0]);
    let errors = [1.0, 0.5, 0.25].map(|h| {
        let block = CappedBlock {
            element_size: h,
            growth: 1.0,
            ..CappedBlock::default()
        };
        (block.mesh().unwrap().volume() - exact).abs()
    });
    // A bilinear interpolant of z is too large by h^2/12 times the Laplacian of z,
    // whose integral is the flux of its gradient through the four sides.
    let flux = 40.0 * (5.0 / 119f64.sqrt()).asin();
    assert_close(errors[2], 0.25 * 0.25 / 12.0 * flux, 1e-2);
    for order in orders(&errors) {
        assert!((order - 2.0).abs() < 0.05, "order {order}");
    }
}

#[test]
fn sphere_too_small_for_the_plan_is_refused() {
    let small = CappedBlock {
        radius: 7.0,
        ..CappedBlock::default()
    };
    assert!(matches!(
        small.mesh(),
        Err(MeshError::Parameter { name: "radius", .. })
    ));
    let flat = CappedBlock {
        height: 2.0,
        ..CappedBlock::default()
    };
    assert!(matches!(flat.mesh(), Err(MeshError::CapRise { .. })));
    // The corners are level with the top but for round-off.
    let level = CappedBlock {
        size: [12.0, 12.0],
        height: 6.0,
        radius: 9.0,
        ..CappedBlock::default()
    };
    let refused = level.mesh().expect_err("no height is left").to_string();
    assert!(refused.contains("must be more than 6.000000"), "{refused}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn capped_blocks_stay_valid(
        size in [4.0..10.0f64, 4.0..10.0],
        radius in 9.0..40.0f64,
        element_size in 0.4..1.5f64,
        fine_half_width in 0.0..2.0f64,
        growth in 1.05..1.6f64,
    ) {
        let block = CappedBlock {
            size, radius, element_size, fine_half_width, growth, ..CappedBlock::default()
        };
        let quality = block.mesh().unwrap().quality();
        prop_assert!(quality.smallest_scaled_jacobian > 0.4);
        let exact = size[0] * size[1] * 6.5 - volume_below_cap(radius, size.map(|s| 0.5 * s));
        prop_assert!(quality.volume < exact && quality.volume > 0.97 * exact);
    }
}

#[test]
fn capped_blocks_of_other_cells_have_the_same_sides() {
    let whole = CappedBlock::default();
    let hexahedra = whole.mesh().unwrap();
    let cells = CellKind::ALL.into_iter();
    for cells in cells {
        let mesh = CappedBlock {
            cells,
            ..whole.clone()
        }
        .mesh()
        .unwrap();

        assert_sets_share_out_the_boundary(&mesh, &CAP_SIDES);
        assert_close(mesh.volume(), hexahedra.volume(), 0.01);
        assert_close(area(&mesh, "cap"), area(&hexahedra, "cap"), 0.01);
    }
}
