//! Elements that bend: Cook's membrane and a slender cantilever.
//!
//! Cook's membrane is the trapezium with the corners (0, 0), (48, 44), (48, 60), (0, 44), held on
//! the left and sheared on the right by a uniform traction of the resultant 1 for each unit of
//! thickness. With Young's modulus 1 and Poisson's ratio 1/3 in plane stress the middle of the
//! right edge rises by 23.9 (Cook, J. Struct. Div. ASCE 100 (1974) 1851). In plane strain, with
//! Young's modulus 250, Poisson's ratio .4999 and the resultant 100, its upper end rises by 7.77
//! (for instance Cervera et al., Comput. Methods Appl. Mech. Eng. 199 (2010) 2559).

use crate::assembly::Block;
use striae_element::Formulation;
use striae_law::bulk::{LameConstants, Material};
use striae_mesh::{CellKind, Vec3, generate};

/// What holds a node besides the end that is built in.
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
fn cook(n: usize, cells: CellKind, material: &Material, total: f64, depth: Depth) -> [f64; 2] {
    let block = generate::Block {
        size: Vec3::new(WIDTH, 1.0, 30.0) / WIDTH,
        divisions: [n, 1, n],
        bottom_slopes: [44.0 / 48.0, 0.0],
        top_slopes: [16.0 / 48.0, 0.0],
        cells,
        ..generate::Block::default()
    };
    let formulation = Formulation::suited_to(material);
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

#[test]
fn cooks_membrane_of_ten_node_tetrahedra_rises_as_published() {
    let cells = CellKind::CompositeTetrahedron;
    // What is missing falls by the square of the size of elements at least: .38 and .07 with
    // three and six divisions, and .43 and .11.
    let missing = [3, 6].map(|n| {
        let [middle, _] = cook(n, cells, &material(1e4, 1.0 / 3.0), 1.0, Depth::Free);
        1.0 - middle * 1e4 / 23.9
    });
    assert!(
        missing[1] > 0.0 && 4.0 * missing[1] < missing[0],
        "{missing:?}"
    );
    let missing = [3, 6].map(|n| {
        let [_, upper] = cook(n, cells, &material(250.0, 0.4999), 0.1, Depth::Held);
        1.0 - upper * 1e3 / 7.77
    });
    assert!(
        missing[1] > 0.0 && 3.8 * missing[1] < missing[0],
        "{missing:?}"
    );
}
