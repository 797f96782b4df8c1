//! Bodies with a cavity.

use std::collections::BTreeMap;

use striae::{
    Finished,
    mesh::{CellBlock, CellKind},
    model::{BodyBuilder, ModelBuilder, cavity},
    prelude::*,
};

pub fn rubber(modulus: f64, poisson: f64) -> Material {
    Material::neo_hookean(LameConstants::from_youngs_modulus(modulus, poisson).unwrap())
}

/// A cube of edge 3 around an empty one of edge 1.
pub fn hollow_cube() -> BodyBuilder {
    let whole = Block {
        size: Vec3::new(3.0, 3.0, 3.0),
        divisions: [3, 3, 3],
        ..Block::default()
    };
    let mesh = whole.mesh().unwrap();
    let is_inner = |at: &usize| *at == 13;
    let cells = mesh.elements().enumerate();
    let nodes = cells.filter(|(at, _)| !is_inner(at));
    let nodes = nodes.flat_map(|(_, corners)| corners.to_vec()).collect();
    let kind = CellKind::Hexahedron;
    let mesh = Mesh::new(mesh.positions, vec![CellBlock { kind, nodes }]).unwrap();
    let is_within = |x: &Vec3| x.iter().all(|x| (0.99..2.01).contains(x));
    body("cube", mesh, rubber(1.0, 0.3))
        .density(1.0)
        .facets_where("inside", is_within)
        .nodes_where("foot", |x| x.z < 0.01)
        .nodes_where("top", |x| x.z > 2.99)
}

/// A model of this cube with its cavity.
pub fn cube(title: &str) -> ModelBuilder {
    let hole = cavity("hole", "cube", "inside");
    model(title).body(hollow_cube()).cavity(hole)
}

/// An eighth of a hollow sphere of inner radius 1, with so many divisions along an edge and through
/// the wall.
pub fn sphere(outer: f64, along: usize, through: usize) -> Mesh {
    let mut positions: Vec<Vec3> = Vec::new();
    let mut known = BTreeMap::new();
    let mut nodes = Vec::new();
    let quarter = std::f64::consts::FRAC_PI_4;
    let side = |at: usize| (quarter * at as f64 / along as f64).tan();
    let mut node = |axis: usize, [i, j, k]: [usize; 3]| {
        let mut x = Vec3::zeros();
        x[axis] = 1.0;
        x[(axis + 1) % 3] = side(i);
        x[(axis + 2) % 3] = side(j);
        let x = x.normalize() * (1.0 + (outer - 1.0) * k as f64 / through as f64);
        let key = [x.x, x.y, x.z].map(|x| (x * 1e9).round() as i64);
        *known.entry(key).or_insert_with(|| {
            positions.push(x);
            NodeId::new(positions.len() - 1)
        })
    };
    for axis in 0..3 {
        for at in 0..along * along * through {
            let [i, j, k] = [at % along, at / along % along, at / along / along];
            for (di, dj, dk) in [
                (0, 0, 0),
                (1, 0, 0),
                (1, 1, 0),
                (0, 1, 0),
                (0, 0, 1),
                (1, 0, 1),
                (1, 1, 1),
                (0, 1, 1),
            ] {
                nodes.push(node(axis, [i + di, j + dj, k + dk]));
            }
        }
    }
    let kind = CellKind::Hexahedron;
    Mesh::new(positions, vec![CellBlock { kind, nodes }]).unwrap()
}

pub fn run(model: ModelBuilder) -> Finished {
    let model = model.build().unwrap_or_else(|faults| panic!("{faults}"));
    let run = Simulation::new(model).unwrap().run().unwrap();
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    run
}
