//! Patch tests: a distorted block takes up a homogeneous state exactly.

use super::assembly::{Block, Force, scatter};
use super::*;
use crate::element::nodal_cauchy_stress;
use crate::load;
use crate::model::LoadKind;
use nalgebra::Matrix3;
use striae_mesh::{Face, NodeId};

/// A stretch without rotation.
fn stretch() -> Matrix3<f64> {
    Matrix3::new(1.15, 0.06, -0.04, 0.06, 0.9, 0.05, -0.04, 0.05, 1.05)
}

/// Forces of a load on the sides of the cube; `kind` is given a side's outward normal.
fn surface_load(block: &Block, x: &[Vec3], kind: impl Fn(Vec3) -> LoadKind) -> Force {
    let reference = &block.mesh.positions;
    let mut total = block.zero();
    for corners in &block.mesh.elements {
        for side in Face::CORNERS {
            let nodes: [NodeId; 4] = side.map(|corner| corners[corner]);
            let face = nodes.map(|node| reference[node.index()]);
            let on = |j: usize, value: f64| face.iter().all(|x| x[j] == value);
            if !(0..3).any(|j| on(j, 0.0) || on(j, 1.0)) {
                continue;
            }
            let normal = (face[2] - face[0]).cross(&(face[3] - face[1])).normalize();
            let current = nodes.map(|node| x[node.index()]);
            let local = load::response(&kind(normal), &face, &current).unwrap();
            scatter(&nodes, &local.force, &local.tangent, &mut total);
        }
    }
    total
}

/// Six unknowns that hold the block: three at the origin, two at `(1, 0, 0)`, one at `(0, 1, 0)`.
fn holding(block: &Block) -> impl Fn(usize) -> bool + use<> {
    let n = block.n;
    move |unknown| {
        let (node, component) = (unknown / 3, unknown % 3);
        node == 0 || (node == n && component > 0) || (node == n * (n + 1) && component == 2)
    }
}

fn largest_difference(x: &[Vec3], y: &[Vec3]) -> f64 {
    x.iter()
        .zip(y)
        .map(|(x, y)| (x - y).norm())
        .fold(0.0, f64::max)
}

#[test]
fn prescribed_boundaries_give_the_homogeneous_state() {
    let block = Block::new(3, 0.25);
    let mut random = Random::new(31);
    let (f, shift) = (random.near_identity(0.2), random.vector3());
    for material in [neo_hookean(), linear_elastic()] {
        let exact: Vec<Vec3> = block.mesh.positions.iter().map(|x| f * x + shift).collect();
        let start: Vec<Vec3> = (0..exact.len())
            .map(|node| {
                let inner = if block.on_boundary(3 * node) {
                    0.0
                } else {
                    0.02
                };
                exact[node] + random.vector3() * inner
            })
            .collect();
        let zero = block.zero();
        let x = block.solve(
            &material,
            |_| zero.clone(),
            &start,
            |u| block.on_boundary(u),
        );
        assert!(largest_difference(&x, &exact) < 1e-13);
        let sigma = material.cauchy_stress(&f).unwrap();
        let stress = nodal_cauchy_stress(&block.mesh, &block.reference, &x, &material).unwrap();
        assert!(
            stress
                .iter()
                .all(|at_node| (at_node - sigma).norm() < 1e-12)
        );
    }
}

#[test]
fn dead_tractions_give_the_homogeneous_state() {
    for n in [1, 3] {
        let block = Block::new(n, 0.25);
        for material in [neo_hookean(), linear_elastic()] {
            let exact: Vec<Vec3> = block.mesh.positions.iter().map(|x| stretch() * x).collect();
            let stress = material.response(&stretch()).unwrap().first_piola;
            let dead = |normal: Vec3| LoadKind::DeadTraction(stress * normal);
            let x = block.solve(
                &material,
                |x| surface_load(&block, x, dead),
                &held(&block, &exact),
                holding(&block),
            );
            assert!(largest_difference(&x, &exact) < 1e-12);
        }
    }
}

#[test]
fn pressure_gives_uniform_compression() {
    let block = Block::new(2, 0.25);
    let shrunk = Matrix3::identity() * 0.9;
    let exact: Vec<Vec3> = block.mesh.positions.iter().map(|x| shrunk * x).collect();
    let pressure = -neo_hookean().cauchy_stress(&shrunk).unwrap().trace() / 3.0;
    let x = block.solve(
        &neo_hookean(),
        |x| surface_load(&block, x, |_| LoadKind::Pressure(pressure)),
        &held(&block, &exact),
        holding(&block),
    );
    assert!(largest_difference(&x, &exact) < 1e-12);
}

/// The reference positions with the exact ones at the unknowns that hold the block.
fn held(block: &Block, exact: &[Vec3]) -> Vec<Vec3> {
    let fixed = holding(block);
    let mut start = block.mesh.positions.clone();
    for unknown in (0..3 * start.len()).filter(|&unknown| fixed(unknown)) {
        start[unknown / 3][unknown % 3] = exact[unknown / 3][unknown % 3];
    }
    start
}
