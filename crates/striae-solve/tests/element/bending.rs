//! Elements that bend: Cook's membrane and a slender cantilever; and that are compressed.
//!
//! Cook's membrane is the trapezium with the corners (0, 0), (48, 44), (48, 60), (0, 44), held on
//! the left and sheared on the right by a uniform traction of the resultant 1 for each unit of
//! thickness. With Young's modulus 1 and Poisson's ratio 1/3 in plane stress the middle of the
//! right edge rises by 23.9 (Cook, J. Struct. Div. ASCE 100 (1974) 1851). In plane strain, with
//! Young's modulus 250, Poisson's ratio .4999 and the resultant 100, its upper end rises by 7.77,
//! to three thousandths: composite tetrahedra give 7.30, 7.55 and 7.64 with 8, 12 and 16
//! divisions, which extrapolate to 7.75.

use crate::assembly::{Block, Kind};
use nalgebra::Matrix3;
use striae_element::Formulation;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{CellKind, Vec3, generate};

/// Restraint of a node besides the clamped end.
#[derive(Clone, Copy, PartialEq)]
enum Depth {
    Free,
    Held,
}

/// Displacements of the block, built in at `x = 0`, under a traction along `z` at its other end.
fn deflected(block: &Block, material: &Material, traction: f64, depth: Depth) -> Vec<Vec3> {
    let positions = &block.mesh.positions;
    let mut load = block.zero();
    for face in block.mesh.facet_sets.get("xmax").unwrap() {
        let nodes = block.mesh.face_nodes(*face);
        let nodes = if nodes[2] == nodes[3] {
            &nodes[..3]
        } else {
            &nodes[..]
        };
        let share = traction * block.mesh.area(&[*face]) / nodes.len() as f64;
        for node in nodes {
            load.0[3 * node.index() + 2] += share;
        }
    }
    let fixed = |unknown: usize| {
        let (x, component) = (positions[unknown / 3], unknown % 3);
        match depth {
            Depth::Held => x.x == 0.0 || component == 1,
            Depth::Free => x.x == 0.0 && (component != 1 || x.y == 0.0),
        }
    };
    let x = block.solve(material, |_| load.clone(), positions, fixed);
    x.iter()
        .zip(positions)
        .map(|(x, start)| x - start)
        .collect()
}

fn material(youngs_modulus: f64, poissons_ratio: f64) -> Material {
    let constants = LameConstants::from_youngs_modulus(youngs_modulus, poissons_ratio);
    Material::linear_elastic(constants.unwrap())
}

/// Lengths are in units of the width of the membrane, so that round-off is small.
const WIDTH: f64 = 48.0;

/// Mean rise of the nodes in the middle and on the upper end of the free edge.
fn cook(
    n: usize,
    (cells, formulation): Kind,
    material: &Material,
    total: f64,
    depth: Depth,
) -> [f64; 2] {
    let block = generate::Block {
        size: Vec3::new(WIDTH, 1.0, 30.0) / WIDTH,
        divisions: [n, 1, n],
        bottom_slopes: [44.0 / 48.0, 0.0],
        top_slopes: [16.0 / 48.0, 0.0],
        cells,
        ..generate::Block::default()
    };
    let block = Block::of(block.mesh().unwrap(), formulation);
    let moved = deflected(&block, material, total / 16.0, depth);
    let ends = block
        .mesh
        .positions
        .iter()
        .zip(&moved)
        .filter(|(x, _)| x.x == 1.0);
    let rise = |height: f64| {
        let at = ends
            .clone()
            .filter(|(x, _)| (x.z * WIDTH - height).abs() < 1e-9);
        let at: Vec<f64> = at.map(|(_, u)| u.z * WIDTH).collect();
        at.iter().sum::<f64>() / at.len() as f64
    };
    // The lower side keeps its middle: the free edge lies between 22 and 38.
    [rise(30.0), rise(38.0)]
}

/// Deviation from the known deflection with so many divisions.
fn missing(divisions: [usize; 2], cells: CellKind, formulation: [Formulation; 2]) -> [[f64; 2]; 2] {
    let [compressible, rubber] = formulation.map(|formulation| (cells, formulation));
    [
        divisions.map(|n| {
            let [middle, _] = cook(n, compressible, &material(1e4, 1.0 / 3.0), 1.0, Depth::Free);
            1.0 - middle * 1e4 / 23.9
        }),
        divisions.map(|n| {
            let [_, upper] = cook(n, rubber, &material(250.0, 0.4999), 0.1, Depth::Held);
            1.0 - upper * 1e3 / 7.77
        }),
    ]
}

#[test]
fn cooks_membrane_of_ten_node_tetrahedra_rises_as_known() {
    // What is missing falls by the square of the size of elements at least: .38 and .07, and
    // .43 and .11.
    let formulations = [Formulation::Standard, Formulation::MeanDilatation];
    for missing in missing([3, 6], CellKind::CompositeTetrahedron, formulations) {
        let falls = missing[1] > 0.0 && 3.8 * missing[1] < missing[0];
        assert!(falls, "{missing:?}");
    }
}

#[test]
fn cooks_membrane_of_hexahedra_with_assumed_strain_rises_as_known() {
    let formulations = [Formulation::AssumedStrain; 2];
    // .18 and .055, and .24 and .096.
    for missing in missing([4, 8], CellKind::Hexahedron, formulations) {
        let falls = missing[1] > 0.0 && 2.4 * missing[1] < missing[0];
        assert!(falls && missing[1] < 0.1, "{missing:?}");
    }
}

/// Deflection of a cantilever 20 long, 1 thick and wide over that of Timoshenko's beam.
fn cantilever(divisions: [usize; 3], formulation: Formulation) -> f64 {
    let block = generate::Block {
        size: Vec3::new(20.0, 1.0, 1.0),
        divisions,
        ..generate::Block::default()
    };
    let block = Block::of(block.mesh().unwrap(), formulation);
    let moved = deflected(&block, &material(1e4, 0.3), 1e-3, Depth::Free);
    let tip = block.mesh.positions.iter().zip(&moved);
    let tip: Vec<f64> = tip.filter(|(x, _)| x.x == 20.0).map(|(_, u)| u.z).collect();
    let mean = tip.iter().sum::<f64>() / tip.len() as f64;
    let (bent, sheared) = (20f64.powi(3) * 4.0, 20.0 * 2.0 * 1.3 * 6.0 / 5.0);
    mean / (1e-3 * (bent + sheared) / 1e4)
}

#[test]
fn a_cantilever_bends_as_a_beam_with_assumed_strain() {
    let ratio = cantilever([20, 1, 2], Formulation::AssumedStrain);
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    let locked = cantilever([20, 1, 2], Formulation::Standard);
    assert!(locked < 0.8, "{locked}");
}

/// Smallest eigenvalue of the tangent of a block that is squeezed uniformly between slippery
/// plates to a part of its height.
fn least_stiffness(height: f64, formulation: Formulation, material: &Material) -> f64 {
    let block = Block::new(3, 0.0, (CellKind::Hexahedron, formulation));
    // Without stress on the sides.
    let stress = |wide: f64| {
        let f = Matrix3::from_diagonal(&Vec3::new(wide, wide, height));
        material.response(&f).unwrap().first_piola[(0, 0)]
    };
    let (mut low, mut high) = (1.0, 3.0);
    for _ in 0..60 {
        let wide = 0.5 * (low + high);
        *(if stress(wide) > 0.0 {
            &mut high
        } else {
            &mut low
        }) = wide;
    }
    let place = |x: &Vec3| Vec3::new(low * x.x, low * x.y, height * x.z);
    let x: Vec<Vec3> = block.mesh.positions.iter().map(place).collect();
    let (force, tangent) = block.internal(&x, material);
    let free = |unknown: &usize| {
        let (at, component) = (block.mesh.positions[unknown / 3], unknown % 3);
        let held = component == 2 && (at.z == 0.0 || at.z == 1.0);
        let on_axis = component < 2 && at.x == 0.0 && at.y == 0.0 && at.z == 0.0;
        let on_edge = component == 1 && at == Vec3::x();
        !(held || on_axis || on_edge)
    };
    let free: Vec<usize> = (0..force.len()).filter(free).collect();
    assert!(force.select_rows(&free).norm() < 1e-12);
    let tangent = tangent.select_rows(&free).select_columns(&free);
    tangent.symmetric_eigenvalues().min()
}

#[test]
fn compressed_blocks_do_not_buckle_into_hourglasses() {
    for poissons_ratio in [0.3, 0.45, 0.49] {
        let constants = LameConstants::from_youngs_modulus(1.0, poissons_ratio).unwrap();
        let rubber = Material::neo_hookean(constants);
        for height in [0.9, 0.7, 0.5] {
            let [standard, assumed] = [Formulation::Standard, Formulation::AssumedStrain]
                .map(|formulation| least_stiffness(height, formulation, &rubber));
            // Softer by what does not lock, .68 to .9 of it.
            assert!(
                assumed > 0.6 * standard && standard > 0.0,
                "{poissons_ratio}, {height}: {standard} {assumed}"
            );
        }
    }
}

#[test]
fn a_bonded_block_is_compressed_to_three_fifths() {
    let constants = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let rubber = Material::neo_hookean(constants);
    let force = |formulation| {
        let block = Block::new(4, 0.0, (CellKind::Hexahedron, formulation));
        let fixed = |unknown: usize| {
            let z = block.mesh.positions[unknown / 3].z;
            z == 0.0 || z == 1.0
        };
        let zero = block.zero();
        let mut x = block.mesh.positions.clone();
        for _ in 0..20 {
            for (x, start) in x.iter_mut().zip(&block.mesh.positions) {
                x.z -= 0.02 * start.z;
            }
            x = block.solve(&rubber, |_| zero.clone(), &x, fixed);
        }
        assert_mirrored(&block, &x);
        let (force, _) = block.internal(&x, &rubber);
        let top = (0..x.len()).filter(|&node| block.mesh.positions[node].z == 1.0);
        top.map(|node| force[3 * node + 2]).sum::<f64>()
    };
    let ratio = force(Formulation::AssumedStrain) / force(Formulation::MeanDilatation);
    assert!((ratio - 1.0).abs() < 0.01, "{ratio}");
}

/// The solution is as symmetric as the unit cube.
fn assert_mirrored(block: &Block, x: &[Vec3]) {
    for (at, start) in block.mesh.positions.iter().enumerate() {
        let mirrored = Vec3::new(1.0 - start.x, start.y, start.z);
        let mut others = block.mesh.positions.iter();
        let other = others.position(|other| (other - mirrored).norm() < 1e-12);
        let sum = x[at].x + x[other.unwrap()].x;
        assert!((sum - 1.0).abs() < 1e-9, "{sum}");
    }
}
