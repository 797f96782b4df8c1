//! Textures on deformed surfaces.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_dual::Dual64;
use striae_mesh::Vec3;
use striae_verify::{Random, assert_derivative, fitted_rate};

use super::shapes::*;
use crate::{
    node::SurfaceNode,
    texture::{Axes, Ordinates, Paint},
};

#[test]
fn a_rigid_motion_rotates_the_texture() {
    let shape = Shape::patch(6, torus).partly_triangular();
    let texture = shape.painted(&helices(0.5));
    let before = shape.axes(&texture);
    for seed in 0..5 {
        let mut random = Random::new(seed);
        let (q, t) = (random.rotation(), random.vector3());
        let after = shape.moved(|x| q * x + t).axes(&texture);
        for (one, other) in before.iter().zip(&after) {
            let rotated = Axes {
                s: q * one.s,
                a: q * one.a,
            };
            assert!(difference(&rotated, other) < 1e-12);
        }
    }
}

#[test]
fn an_affine_motion_of_a_plane_surface_maps_the_direction_exactly() {
    let shape = Shape::patch(5, plane).partly_triangular();
    let mut random = Random::new(4);
    let directions: Vec<Vec3> = shape.positions.iter().map(|_| random.vector3()).collect();
    let texture = shape.painted(&Paint::Nodal(directions));
    let before = shape.axes(&texture);
    for _ in 0..5 {
        let (f, t) = (random.near_identity(0.4), random.vector3());
        let moved = shape.moved(|x| f * x + t);
        for ((one, other), n) in (before.iter().zip(moved.axes(&texture))).zip(moved.normals()) {
            let expected = Axes::along(f * one.s, n).unwrap();
            assert!((f * one.s).normalize().dot(&n).abs() < 1e-12);
            assert!(difference(&expected, &other) < 1e-12);
        }
    }
}

#[test]
fn a_helix_on_an_inflated_and_stretched_cylinder_stays_one() {
    let shape = Shape::tube(9, 4);
    let texture = shape.painted(&helices(0.6));
    let moved = shape.moved(|x| Vec3::new(1.7 * x.x, 1.7 * x.y, 0.8 * x.z));
    let pitch = (0.8 * 0.6f64.sin()).atan2(1.7 * 0.6f64.cos());
    for axes in moved.axes(&texture) {
        assert!((axes.s.z - pitch.sin()).abs() < 1e-14);
    }
}

#[test]
fn a_helix_on_a_twisted_cylinder_stays_one_with_a_pitch_of_second_order() {
    let (twist, turn) = (0.5, 0.6f64);
    let pitch = turn.sin().atan2(turn.cos() + twist * turn.sin());
    let (mut h, mut errors) = (Vec::new(), Vec::new());
    for n in [8, 16, 32] {
        let shape = Shape::tube(2 * n, n);
        let texture = shape.painted(&helices(turn));
        let turned =
            |x: &Vec3| nalgebra::Rotation3::from_axis_angle(&Vec3::z_axis(), twist * x.z) * x;
        let moved = shape.moved(turned);
        let axes = moved.axes(&texture);
        let inner: Vec<f64> = moved.inner_nodes().iter().map(|&i| axes[i].s.z).collect();
        assert!(inner.iter().all(|z| (z - inner[0]).abs() < 1e-13));
        h.push(1.0 / n as f64);
        errors.push((inner[0] - pitch.sin()).abs());
    }
    let rate = fitted_rate(&h, &errors);
    assert!((rate - 2.0).abs() < 0.1, "{rate} {errors:?}");
}

/// A smooth motion and its gradient.
fn bend(x: &Vec3) -> Vec3 {
    Vec3::new(
        x.x + 0.2 * x.y * x.z,
        1.2 * x.y + 0.1 * x.x * x.x,
        x.z - 0.3 * x.x + 0.1 * x.y * x.y,
    )
}

fn bend_gradient(x: &Vec3) -> Matrix3<f64> {
    Matrix3::new(
        1.0,
        0.2 * x.z,
        0.2 * x.y, //
        0.2 * x.x,
        1.2,
        0.0, //
        -0.3,
        0.2 * x.y,
        1.0,
    )
}

/// Largest errors against `F s/|F s|` at inner and at all nodes, for exact tangents `s` in the end.
fn convection_errors(n: usize, map: fn(f64, f64) -> Vec3) -> [f64; 2] {
    let shape = Shape::patch(n, |u, v| {
        let (u, v) = uneven(u, v);
        map(u, v)
    });
    let texture = shape.painted(&helices(0.5));
    let before = shape.axes(&texture);
    let axes = shape.moved(bend).axes(&texture);
    let error = |i: usize| {
        let expected = bend_gradient(&shape.positions[i]) * before[i].s;
        (axes[i].s - expected.normalize()).norm()
    };
    let largest = |nodes: &[usize]| nodes.iter().map(|&i| error(i)).fold(0.0, f64::max);
    let all: Vec<usize> = (0..axes.len()).collect();
    [largest(&shape.inner_nodes()), largest(&all)]
}

#[test]
fn on_curved_surfaces_the_mapped_direction_is_met_in_the_limit() {
    for map in [sphere, torus] {
        let sizes = [8, 16, 32, 64];
        let h = sizes.map(|n| 1.0 / n as f64);
        let errors = sizes.map(|n| convection_errors(n, map));
        let inner = fitted_rate(&h, &errors.map(|e| e[0]));
        let all = fitted_rate(&h, &errors.map(|e| e[1]));
        assert!(
            (inner - 2.0).abs() < 0.1,
            "inner nodes: rate {inner}, {errors:?}"
        );
        assert!((all - 1.0).abs() < 0.1, "all nodes: rate {all}, {errors:?}");
    }
}

/// `s` and `a` as a function of the positions of a node, of its ring and of the normal.
fn stacked<D: crate::scalar::Real>(ordinates: &Ordinates<'_>, x: &[D]) -> Vec<D> {
    let points: Vec<Vector3<D>> = (x.chunks(3))
        .map(|c| Vector3::new(c[0], c[1], c[2]))
        .collect();
    let last = points.len() - 1;
    let axes = ordinates
        .convect(points[0], &points[1..last], points[last])
        .unwrap();
    axes.s.iter().chain(axes.a.iter()).copied().collect()
}

#[test]
fn derivatives_by_dual_numbers_have_the_right_order() {
    let shape = Shape::patch(3, torus).partly_triangular();
    let texture = shape.painted(&helices(0.5));
    for node in [0, 5, 6, 9].map(SurfaceNode) {
        let ordinates = texture.ordinates(node);
        let mut x: Vec<f64> = shape.positions[node].iter().copied().collect();
        for &neighbour in ordinates.ring {
            x.extend(shape.positions[neighbour].iter());
        }
        x.extend(shape.normals()[node].iter());
        let jacobian = |x: &DVector<f64>| {
            let column = |j: usize| {
                let seeded = |i: usize| Dual64::new(x[i], f64::from(i == j));
                let dual: Vec<Dual64> = (0..x.len()).map(seeded).collect();
                let column = stacked(&ordinates, &dual)
                    .into_iter()
                    .map(|value| value.eps);
                DVector::from_vec(column.collect())
            };
            DMatrix::from_columns(&(0..x.len()).map(column).collect::<Vec<_>>())
        };
        let f = |x: &DVector<f64>| DVector::from_vec(stacked(&ordinates, x.as_slice()));
        assert_derivative(f, jacobian, &DVector::from_vec(x.clone()));
    }
}
