//! Generators against closed forms, over ranges of their parameters.

use proptest::prelude::*;
use std::f64::consts::PI;
use striae_mesh::generate::{
    Annulus, Block, CappedBlock, Grading, Half, HalfCylinder, Pivot, Refinement, Rotation,
};
use striae_mesh::{Face, Mesh, MeshError, NodeId, Vec3};

/// Faces of the set with the integral of the outward normal over each.
fn normals(mesh: &Mesh, set: &str) -> Vec<Vec3> {
    let faces = mesh.facet_sets.get(set).unwrap();
    faces.iter().map(|&face| mesh.area_vector(face)).collect()
}

fn area(mesh: &Mesh, set: &str) -> f64 {
    mesh.area(mesh.facet_sets.get(set).unwrap())
}

/// The named sets share out the boundary: every face once, node sets to match.
fn assert_sets_share_out_the_boundary(mesh: &Mesh, sets: &[&str]) {
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
    let count = mesh.elements.len();
    assert_eq!(mesh.element_sets.get("all").unwrap().len(), count);
    let closed: Vec3 = faces.iter().map(|&face| mesh.area_vector(face)).sum();
    assert!(closed.norm() < 1e-12 * mesh.area(&faces));
}

fn assert_close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance * b.abs(), "{a} is not {b}");
}

/// Order of convergence from errors at sizes that halve.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|e| (e[0] / e[1]).log2()).collect()
}

const BLOCK_SIDES: [(&str, [f64; 3]); 6] = [
    ("xmin", [-1.0, 0.0, 0.0]),
    ("xmax", [1.0, 0.0, 0.0]),
    ("ymin", [0.0, -1.0, 0.0]),
    ("ymax", [0.0, 1.0, 0.0]),
    ("zmin", [0.0, 0.0, -1.0]),
    ("zmax", [0.0, 0.0, 1.0]),
];

#[test]
fn block_sides_have_their_areas_and_normals() {
    let block = Block {
        origin: Vec3::new(1.0, -2.0, 3.0),
        size: Vec3::new(2.0, 3.0, 5.0),
        divisions: [3, 4, 5],
        gradings: [
            Grading::OneSided { ratio: 3.0 },
            Grading::Symmetric { ratio: 0.5 },
            Grading::Lengths(vec![1.0, 2.0, 2.0, 1.0, 3.0]),
        ],
        mesh_rotation: 20.0,
        irregularity: 0.2,
        ..Block::default()
    };
    let mesh = block.mesh().unwrap();
    assert_sets_share_out_the_boundary(&mesh, &BLOCK_SIDES.map(|(set, _)| set));
    assert_close(mesh.volume(), 30.0, 1e-13);
    for (set, normal) in BLOCK_SIDES {
        let normal = Vec3::from(normal);
        let expected = 30.0 / block.size.dot(&normal.abs());
        assert_close(area(&mesh, set), expected, 1e-13);
        for vector in normals(&mesh, set) {
            assert_close(vector.dot(&normal), vector.norm(), 1e-13);
        }
    }
}

#[test]
fn block_counts_and_order_are_those_of_the_lattice() {
    let mesh = Block {
        divisions: [2, 3, 4],
        ..Block::default()
    }
    .mesh()
    .unwrap();
    assert_eq!((mesh.positions.len(), mesh.elements.len()), (60, 24));
    assert_eq!(mesh.positions[1], Vec3::new(0.5, 0.0, 0.0));
    assert_eq!(mesh.positions[59], Vec3::repeat(1.0));
    assert_close(mesh.quality().smallest_scaled_jacobian, 1.0, 1e-14);
}

#[test]
fn oblique_sides_are_planes_and_keep_the_volume() {
    let mesh = Block {
        size: Vec3::new(2.0, 3.0, 1.5),
        divisions: [4, 5, 3],
        bottom_slopes: [0.1, -0.2],
        top_slopes: [-0.25, 0.15],
        irregularity: 0.2,
        mesh_rotation: 15.0,
        ..Block::default()
    }
    .mesh()
    .unwrap();
    assert_close(mesh.volume(), 9.0, 1e-13);
    for (set, z, [sx, sy], sign) in [
        ("zmin", 0.0, [0.1, -0.2], -1.0),
        ("zmax", 1.5, [-0.25, 0.15], 1.0),
    ] {
        for node in mesh.node_sets.get(set).unwrap() {
            let x = mesh.positions[node.index()];
            let plane = z + sx * (x.x - 1.0) + sy * (x.y - 1.5);
            assert!((x.z - plane).abs() < 1e-14);
        }
        let normal = Vec3::new(-sx, -sy, 1.0).normalize() * sign;
        for vector in normals(&mesh, set) {
            assert_close(vector.dot(&normal), vector.norm(), 1e-13);
        }
        let slope = f64::sqrt(1.0 + sx * sx + sy * sy);
        assert_close(area(&mesh, set), 6.0 * slope, 1e-13);
    }
}

#[test]
fn block_rotation_is_rigid() {
    let straight = Block {
        origin: Vec3::new(1.0, 2.0, 3.0),
        divisions: [2; 3],
        irregularity: 0.1,
        ..Block::default()
    };
    let centre = Vec3::new(1.5, 2.5, 3.5);
    for (about, fixed) in [
        (Pivot::Centre, centre),
        (Pivot::Point(Vec3::zeros()), Vec3::zeros()),
    ] {
        let turned = Block {
            rotation: Some(Rotation {
                axis: Vec3::z() * 3.0,
                degrees: 90.0,
                about,
            }),
            ..straight.clone()
        };
        let (a, b) = (straight.mesh().unwrap(), turned.mesh().unwrap());
        for (x, y) in a.positions.iter().zip(&b.positions) {
            let arm = x - fixed;
            let expected = fixed + Vec3::new(-arm.y, arm.x, arm.z);
            assert!((y - expected).norm() < 1e-14);
        }
        for vector in normals(&b, "xmax") {
            assert_close(vector.y, vector.norm(), 1e-13);
        }
    }
}

#[test]
fn mesh_rotation_turns_the_middle_and_keeps_the_outline() {
    let block = |mesh_rotation| Block {
        size: Vec3::new(4.0, 4.0, 1.0),
        divisions: [40, 40, 1],
        mesh_rotation,
        ..Block::default()
    };
    let (a, b) = (block(0.0).mesh().unwrap(), block(17.0).mesh().unwrap());
    let middle = Vec3::new(2.0, 2.0, 0.0);
    let mut near_middle = 0;
    for (x, y) in a.positions.iter().zip(&b.positions) {
        let (p, q) = (x - middle, y - middle);
        assert_eq!(x.z, y.z);
        let radius = p.xy().norm();
        assert!((radius - q.xy().norm()).abs() < 1e-14);
        if radius >= 2.0 {
            assert_eq!(x, y);
        } else if radius > 0.05 && radius < 0.11 {
            near_middle += 1;
            let angle = p.xy().perp(&q.xy()).atan2(p.xy().dot(&q.xy()));
            assert!((angle.to_degrees() - 17.0).abs() < 0.2);
        }
    }
    assert!(near_middle >= 8);
}

#[test]
fn irregularity_is_repeatable_and_bounded() {
    let block = |seed| Block {
        divisions: [4; 3],
        irregularity: 0.25,
        seed,
        ..Block::default()
    };
    let regular = Block {
        irregularity: 0.0,
        ..block(0)
    };
    let (a, b) = (block(5).mesh().unwrap(), regular.mesh().unwrap());
    assert_eq!(a, block(5).mesh().unwrap());
    assert_ne!(a, block(6).mesh().unwrap());
    let mut still = 0;
    for (x, y) in a.positions.iter().zip(&b.positions) {
        assert!((x - y).amax() <= 0.25 * 0.25);
        still += usize::from(x == y);
    }
    assert_eq!(still, 8 + 12 * 3, "corners and edges stay, all else moves");
}

#[test]
fn too_much_distortion_is_an_error() {
    let faults = [
        Block {
            irregularity: 0.5,
            ..Block::default()
        },
        Block {
            size: Vec3::new(1.0, 0.0, 1.0),
            ..Block::default()
        },
        Block {
            divisions: [1, 0, 1],
            ..Block::default()
        },
        Block {
            top_slopes: [2.5, 0.0],
            ..Block::default()
        },
    ];
    for block in faults {
        assert!(matches!(block.mesh(), Err(MeshError::Parameter { .. })));
    }
    let wound_up = Block {
        divisions: [12, 12, 1],
        mesh_rotation: 300.0,
        ..Block::default()
    };
    assert!(matches!(wound_up.mesh(), Err(MeshError::Inverted { .. })));
}

#[test]
fn meshes_beyond_all_bounds_are_refused_at_once() {
    let block = Block {
        divisions: [usize::MAX; 3],
        ..Block::default()
    };
    assert!(matches!(block.mesh(), Err(MeshError::TooLarge { .. })));
    let ring = Annulus {
        divisions: [1, 1 << 40, 1],
        ..Annulus::default()
    };
    assert!(matches!(ring.mesh(), Err(MeshError::TooLarge { .. })));
    let slice = HalfCylinder {
        layers: 1 << 40,
        ..HalfCylinder::default()
    };
    assert!(matches!(slice.mesh(), Err(MeshError::TooLarge { .. })));
    for element_size in [1e-12, f64::NAN] {
        let cap = CappedBlock {
            element_size,
            ..CappedBlock::default()
        };
        assert!(matches!(cap.mesh(), Err(MeshError::Parameter { .. })));
    }
    let endless = CappedBlock {
        height: f64::INFINITY,
        ..CappedBlock::default()
    };
    assert!(endless.mesh().is_err());
}

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
    assert!(matches!(
        flat.mesh(),
        Err(MeshError::Parameter { name: "height", .. })
    ));
}

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
    fn distorted_blocks_stay_valid(
        divisions in [1..7usize, 1..7, 1..4],
        size in [0.5..3.0f64, 0.5..3.0, 0.5..3.0],
        angle in -25.0..25.0f64,
        irregularity in 0.0..0.2f64,
        slopes in [-0.1..0.1f64, -0.1..0.1, -0.1..0.1, -0.1..0.1],
        seed: u64,
    ) {
        let block = Block {
            size: Vec3::from(size),
            divisions,
            mesh_rotation: angle,
            irregularity,
            bottom_slopes: [slopes[0], slopes[1]],
            top_slopes: [slopes[2], slopes[3]],
            seed,
            ..Block::default()
        };
        let mesh = block.mesh().unwrap();
        prop_assert!(mesh.quality().smallest_scaled_jacobian > 0.05);
        prop_assert!((mesh.volume() / size.iter().product::<f64>() - 1.0).abs() < 1e-12);
    }

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
