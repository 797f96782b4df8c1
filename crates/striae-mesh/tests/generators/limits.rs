//! Parameters that no mesh can be made of.

use striae_mesh::generate::{Annulus, Block, CappedBlock, Cylinder, HalfCylinder, Torus};
use striae_mesh::{CellKind, MeshError};

#[test]
fn meshes_beyond_all_bounds_are_refused_at_once() {
    let block = Block {
        divisions: [usize::MAX; 3],
        ..Block::default()
    };
    assert!(matches!(block.mesh(), Err(MeshError::TooLarge { .. })));
    let divided = Block {
        divisions: [150; 3],
        cells: CellKind::CompositeTetrahedron,
        ..Block::default()
    };
    let refused = divided.mesh().map_err(|error| error.to_string());
    let expected = "the mesh would have 20250000 elements, but the limit is 20000000";
    assert_eq!(refused, Err(expected.to_owned()));
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
    for divisions in [[usize::MAX; 3], [1, 1 << 40, 3], [1, 1, 1 << 40]] {
        let cylinder = Cylinder {
            divisions,
            ..Cylinder::default()
        };
        assert!(matches!(cylinder.mesh(), Err(MeshError::TooLarge { .. })));
        let ring = Torus {
            divisions,
            ..Torus::default()
        };
        assert!(matches!(ring.mesh(), Err(MeshError::TooLarge { .. })));
    }
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

#[test]
fn round_bodies_without_elements_or_a_hole_are_refused() {
    for divisions in [[0, 1, 1], [1, 0, 1], [1, 1, 0]] {
        let cylinder = Cylinder {
            divisions,
            ..Cylinder::default()
        };
        assert!(matches!(cylinder.mesh(), Err(MeshError::Parameter { .. })));
    }
    let full = Torus {
        ring_radius: 1.0,
        ..Torus::default()
    };
    assert!(matches!(full.mesh(), Err(MeshError::Parameter { .. })));
}
