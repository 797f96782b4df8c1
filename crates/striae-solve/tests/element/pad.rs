//! A pad of nearly incompressible rubber between bonded plates.
//!
//! The pad 10 x 10 x 2.5 with Poisson's ratio .499 is squeezed by a thousandth. The force
//! over area, strain and Young's modulus was found on finer and finer meshes (divisions
//! of the whole pad); closed forms for bonded pads give about 3.2.
//!
//! By symmetry an eighth of it is computed.

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

#[test]
fn mean_dilatation_does_not_lock() {
    for cells in [CellKind::Hexahedron, CellKind::Wedge] {
        let modulus = apparent_modulus([4, 4, 2], cells, Formulation::MeanDilatation);
        println!("{cells} {modulus}");
    }
    for d in [[2, 2, 1], [4, 4, 2], [6, 6, 3], [8, 8, 4]] {
        let modulus = apparent_modulus(d, CellKind::Hexahedron, Formulation::MeanDilatation);
        println!(
            "{d:?} {modulus} {}",
            apparent_modulus(d, CellKind::Hexahedron, Formulation::Standard)
        );
    }
    panic!();
}
