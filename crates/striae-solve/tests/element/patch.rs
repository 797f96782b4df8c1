//! Patch tests: a distorted block takes up a homogeneous state exactly.

use crate::{
    assembly::{Block, Force, kinds, scatter},
    linear_elastic, neo_hookean,
};
use nalgebra::Matrix3;
use striae_element::{Formulation, nodal_cauchy_stress};
use striae_law::bulk::LameConstants;
use striae_mesh::{CellKind, Vec3};
use striae_model::{LoadKind, load};
use striae_verify::Random;

/// A stretch without rotation.
fn stretch() -> Matrix3<f64> {
    Matrix3::new(1.15, 0.06, -0.04, 0.06, 0.9, 0.05, -0.04, 0.05, 1.05)
}

/// Forces of a load on the sides of the cube; `kind` is given a side's outward normal.
fn surface_load(block: &Block, x: &[Vec3], kind: impl Fn(Vec3) -> LoadKind) -> Force {
    let mut total = block.zero();
    for face in block.mesh.boundary_faces() {
        let nodes = block.mesh.face_nodes(face);
        let reference = block.mesh.face_positions(face);
        let current = nodes.map(|node| x[node.index()]);
        let [a, b, c, d] = reference;
        let normal = (c - a).cross(&(d - b)).normalize();
        let local = load::response(&kind(normal).into(), &reference, &current).unwrap();
        scatter(&nodes, &local.force, &local.tangent, &mut total);
    }
    total
}

/// The six unknowns that hold the block: three at the origin, two at `(1, 0, 0)`,
/// one at `(0, 1, 0)`.
fn holding(block: &Block) -> impl Fn(usize) -> bool + '_ {
    |unknown| {
        let (position, component) = (block.mesh.positions[unknown / 3], unknown % 3);
        position == Vec3::zeros()
            || (position == Vec3::x() && component > 0)
            || (position == Vec3::y() && component == 2)
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
    for (kind, material) in kinds().zip([neo_hookean(), linear_elastic()].into_iter().cycle()) {
        let block = Block::new(2, 0.25, kind);
        let mut random = Random::new(31);
        let (f, shift) = (random.near_identity(0.2), random.vector3());
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
        let stress =
            nodal_cauchy_stress(&block.mesh, &block.reference, &x, |_| (&material, &[])).unwrap();
        assert!(
            stress
                .iter()
                .all(|at_node| (at_node - sigma).norm() < 1e-12)
        );
    }
}

#[test]
fn dead_tractions_give_the_homogeneous_state() {
    for (kind, n) in kinds().zip([1, 2].into_iter().cycle()) {
        let block = Block::new(n, 0.25, kind);
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
    for kind in kinds() {
        let block = Block::new(2, 0.25, kind);
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
}

#[test]
fn a_linear_field_of_stress_is_recovered_exactly_at_the_nodes() {
    // u = (x y, 0, 0)/10: e_xx = y/10, e_xy = x/20.
    let block = Block::new(2, 0.0, (CellKind::Hexahedron, Formulation::Standard));
    let positions = &block.mesh.positions;
    let current: Vec<Vec3> = positions
        .iter()
        .map(|x| x + Vec3::x() * (x.x * x.y / 10.0))
        .collect();
    let LameConstants { lambda, shear } = linear_elastic().lame_constants();
    let material = linear_elastic();
    let stress = nodal_cauchy_stress(&block.mesh, &block.reference, &current, |_| {
        (&material, &[])
    });
    let stress = stress.unwrap();
    for (x, sigma) in positions.iter().zip(stress) {
        let (normal, across) = (lambda * x.y / 10.0, shear * x.x / 10.0);
        let mut exact = Matrix3::identity() * normal;
        exact[(0, 0)] += 2.0 * shear * x.y / 10.0;
        exact[(0, 1)] = across;
        exact[(1, 0)] = across;
        assert!((sigma - exact).norm() < 1e-14);
    }
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
