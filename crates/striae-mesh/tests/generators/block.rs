//! Blocks, straight, turned, oblique and irregular.

use crate::{area, assert_close, assert_sets_share_out_the_boundary, normals};
use proptest::prelude::*;
use striae_mesh::generate::{Block, Grading, Pivot, Rotation};
use striae_mesh::{CellKind, MeshError, Vec3};

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
    assert_eq!((mesh.positions.len(), mesh.element_count()), (60, 24));
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
        assert!((x - y).norm() <= 0.25 * 0.25);
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

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn distorted_blocks_stay_valid(
        divisions in [1..7usize, 1..7, 1..4],
        size in [0.5..3.0f64, 0.5..3.0, 0.5..3.0],
        angle in -25.0..25.0f64,
        irregularity in 0.0..0.25f64,
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
}

#[test]
fn cells_of_all_kinds_fill_the_same_block() {
    let counts = [
        (CellKind::Tetrahedron, 6, 2),
        (CellKind::Pyramid, 6, 1),
        (CellKind::Wedge, 2, 1),
        (CellKind::Hexahedron, 1, 1),
        (CellKind::CompositeTetrahedron, 6, 8),
    ];
    for (cells, parts, facets_a_side) in counts {
        let block = Block {
            size: Vec3::new(2.0, 1.0, 1.5),
            divisions: [3, 2, 4],
            irregularity: 0.15,
            mesh_rotation: 10.0,
            cells,
            ..Block::default()
        };
        let mesh = block.mesh().unwrap();
        assert_sets_share_out_the_boundary(&mesh, &BLOCK_SIDES.map(|(name, _)| name));
        assert_eq!(mesh.element_count(), 24 * parts);
        assert_close(mesh.volume(), 3.0, 1e-13);
        assert!(mesh.quality().smallest_scaled_jacobian > 0.1, "{cells}");
        for (set, count) in [("xmin", 8), ("ymax", 12)] {
            assert_eq!(
                mesh.facet_sets.get(set).unwrap().len(),
                facets_a_side * count
            );
        }
        for (set, exact) in [("xmin", 1.5), ("ymax", 3.0), ("zmax", 2.0)] {
            assert_close(area(&mesh, set), exact, 1e-13);
        }
    }
}
