//! A pad of nearly incompressible rubber between bonded plates.
//!
//! The pad 10 x 10 x 2.5 with Poisson's ratio .499 is squeezed by a thousandth. Force over
//! area, strain and Young's modulus, with mean dilatation on finer and finer hexahedra:
//!
//! | divisions of the whole pad | 4x4x2 | 8x8x4 | 16x16x8 | 32x32x16 | 48x48x24 | limit |
//! | --- | --- | --- | --- | --- | --- | --- |
//! | apparent modulus | 4.300 | 3.622 | 3.426 | 3.351 | 3.330 | 3.29 |
//!
//! Ten-node tetrahedra, six in each of these divisions, give 3.23 and 3.28 with 4x4x2 and 8x8x4.
//!
//! The last steps of hexahedra fall like the mesh size, as stress is singular at the bonded edges. Across
//! the thickness the rubber is pressed out with a parabola of displacements; linear elements
//! in `n` layers are too stiff in it by `1/n^2`, 6 % for four. By symmetry an eighth of the
//! pad is computed.

use crate::assembly::Block;
use striae_element::Formulation;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{CellKind, Vec3, generate};

const STRAIN: f64 = 1e-3;

/// Apparent over Young's modulus with so many divisions of an eighth.
fn apparent_modulus(divisions: [usize; 3], cells: CellKind, formulation: Formulation) -> f64 {
    let size = Vec3::new(5.0, 5.0, 1.25);
    let mesh = generate::Block {
        size,
        divisions,
        cells,
        ..generate::Block::default()
    };
    let block = Block::of(mesh.mesh().unwrap(), formulation);
    let constants = LameConstants::from_youngs_modulus(1.0, 0.499).unwrap();
    let rubber = Material::neo_hookean(constants);
    let mut start = block.mesh.positions.clone();
    for x in start.iter_mut().filter(|x| x.z == size.z) {
        x.z -= STRAIN * size.z;
    }
    let fixed = |unknown: usize| {
        let x = block.mesh.positions[unknown / 3];
        x.z == size.z || x[unknown % 3] == 0.0
    };
    let zero = block.zero();
    let x = block.solve(&rubber, |_| zero.clone(), &start, fixed);
    let (force, _) = block.internal(&x, &rubber);
    let on_plate = (0..x.len()).filter(|&node| block.mesh.positions[node].z == size.z);
    let force: f64 = on_plate.map(|node| -force[3 * node + 2]).sum();
    force / (size.x * size.y * STRAIN)
}

/// Limit for fine meshes.
const CONVERGED: f64 = 3.29;

#[test]
fn mean_dilatation_converges_and_standard_elements_lock() {
    for cells in [CellKind::Hexahedron, CellKind::Wedge] {
        let error = |divisions, formulation| {
            apparent_modulus(divisions, cells, formulation) / CONVERGED - 1.0
        };
        let coarse = error([4, 4, 2], Formulation::MeanDilatation);
        let fine = error([8, 8, 4], Formulation::MeanDilatation);
        assert!((0.06..0.12).contains(&coarse), "{cells}: {coarse}");
        assert!((0.0..0.07).contains(&fine), "{cells}: {fine}");
        let locked = error([4, 4, 2], Formulation::Standard);
        assert!(locked > 2.0, "{cells}: {locked}");
    }
}

#[test]
fn ten_node_tetrahedra_are_exact_to_a_few_hundredths_also_with_few_of_them() {
    let error = |divisions| {
        let cells = CellKind::CompositeTetrahedron;
        apparent_modulus(divisions, cells, Formulation::MeanDilatation) / CONVERGED - 1.0
    };
    let (coarse, fine) = (error([2, 2, 1]), error([4, 4, 2]));
    assert!(coarse.abs() < 0.05, "{coarse}");
    assert!(fine.abs() < 0.02, "{fine}");
}
