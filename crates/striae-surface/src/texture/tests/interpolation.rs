//! Directions painted at a few places.

use std::f64::consts::TAU;

use striae_mesh::Vec3;
use striae_verify::{Random, fitted_rate};

use super::shapes::*;
use crate::{
    node::SurfaceNode,
    texture::{Axes, Conditioning, Paint, Texture, TextureError},
};

/// Random directions at places spread over a patch.
fn scattered(map: fn(f64, f64) -> Vec3, seed: u64) -> Vec<(Vec3, Vec3)> {
    let mut random = Random::new(seed);
    [(0.0, 0.0), (1.0, 0.1), (0.4, 0.5), (0.1, 0.9), (0.9, 1.0)]
        .map(|(u, v)| (map(u, v), random.vector3()))
        .to_vec()
}

fn points(directions: Vec<(Vec3, Vec3)>) -> Paint {
    Paint::Points {
        directions,
        width: None,
    }
}

fn nearest(shape: &Shape, place: &Vec3) -> usize {
    let distance = |i: &usize| (shape.positions[*i] - place).norm();
    (0..shape.positions.len())
        .min_by(|i, j| distance(i).total_cmp(&distance(j)))
        .unwrap()
}

#[test]
fn the_direction_of_the_painted_places_is_reproduced() {
    for map in [sphere, torus] {
        let shape = Shape::patch(10, map);
        let directions = scattered(map, 3);
        let axes = shape.axes(&shape.painted(&points(directions.clone())));
        for (place, direction) in directions {
            let node = nearest(&shape, &place);
            let expected = Axes::along(direction.normalize(), shape.normals()[node]).unwrap();
            assert!(difference(&axes[node], &expected) < 1e-12);
        }
    }
}

/// The corners and the centre of a square of `n` by `n` facets.
fn five_points(n: usize, width: Option<f64>) -> Result<Conditioning, TextureError> {
    let shape = Shape::patch(n, |u, v| Vec3::new(u, v, 0.0));
    let n = n as u32;
    let nodes = [0, n, n * (n + 1), n * (n + 2), n * (n + 2) / 2];
    let paint = Paint::Nodes {
        directions: nodes.map(|node| (SurfaceNode(node), Vec3::x())).to_vec(),
        width,
    };
    Texture::new(&shape.positions, &shape.facets, &shape.normals(), &paint)
        .map(|(_, conditioning)| conditioning)
}

#[test]
fn a_width_of_the_diameter_is_indefinite_and_refused() {
    // Sign-alternating corners: 1 + phi(2) - 2 phi(1) with D = 2.
    let width = 2.0;
    let expected = 1.0 + 0.5f64.sqrt() - 4.0 / 5f64.sqrt();
    match five_points(6, Some(width)) {
        Err(TextureError::IndefiniteKernel {
            smallest_eigenvalue,
            advice,
            ..
        }) => {
            assert!((smallest_eigenvalue - expected).abs() < 1e-13);
            assert!(five_points(6, Some(advice)).is_ok());
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_default_width_is_a_quarter_of_the_diameter_and_well_conditioned() {
    let phi = |r: f64| 1.0 / (1.0 + 4.0 * r * r).sqrt();
    match five_points(6, None) {
        Ok(Conditioning::Interpolated {
            diameter,
            width,
            smallest_eigenvalue,
            condition,
            amplitude,
        }) => {
            assert!((diameter - 2.0).abs() < 1e-14 && (width - 0.5).abs() < 1e-14);
            assert!((smallest_eigenvalue - (1.0 + phi(2.0) - 2.0 * phi(1.0))).abs() < 1e-13);
            assert!(condition < 25.0, "{condition}");
            assert!((1.0 - 1e-13..1.1).contains(&amplitude), "{amplitude}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn renumbering_nodes_and_facets_changes_nothing() {
    let shape = Shape::patch(7, torus).partly_triangular();
    let nodes = shape.positions.len();
    let new = |node: usize| (node * 13 + 5) % nodes; // 64 nodes: 13 is coprime
    let mut other = shape.clone();
    for node in 0..nodes {
        other.positions[new(node)] = shape.positions[node];
    }
    other.facets = (shape.facets.iter().rev())
        .map(|facet| facet.map(|node| SurfaceNode::new(new(node.index()))))
        .map(|[a, b, c, d]| if c == d { [b, c, a, a] } else { [c, d, a, b] })
        .collect();
    let mut directions = scattered(torus, 8);
    let axes = shape.axes(&shape.painted(&points(directions.clone())));
    directions.rotate_left(2);
    let renumbered = other.axes(&other.painted(&points(directions)));
    for node in 0..nodes {
        assert!(difference(&axes[node], &renumbered[new(node)]) < 1e-12);
    }
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let scale = 1e-3;
    let shape = Shape::patch(8, torus);
    let small = shape.moved(|x| x * scale);
    let directions = scattered(torus, 2);
    let small_directions = directions.iter().map(|(x, v)| (x * scale, *v)).collect();
    let axes = shape.axes(&shape.painted(&points(directions)));
    let small_axes = small.axes(&small.painted(&points(small_directions)));
    for (one, other) in axes.iter().zip(&small_axes) {
        assert!(difference(one, other) < 1e-11);
    }
}

#[test]
fn two_parts_are_interpolated_on_their_own() {
    let square = Shape::patch(4, plane);
    let far = square.moved(|x| x + Vec3::new(5.0, 0.0, 0.0));
    let nodes = square.positions.len() as u32;
    let both = Shape {
        positions: [&square.positions[..], &far.positions].concat(),
        facets: (square.facets.iter().copied())
            .chain(
                square
                    .facets
                    .iter()
                    .map(|f| f.map(|node| SurfaceNode(node.0 + nodes))),
            )
            .collect(),
    };
    let (one, two) = (Vec3::new(1.0, 0.2, -0.3), Vec3::new(-0.1, 0.9, 0.4));
    let paint = Paint::Nodes {
        directions: vec![(SurfaceNode(0), one), (SurfaceNode(nodes), two)],
        width: None,
    };
    let axes = both.axes(&both.painted(&paint));
    for (node, axes) in axes.iter().enumerate() {
        let expected = if node < nodes as usize { one } else { two };
        assert!((axes.s - expected.normalize()).norm() < 1e-13);
    }
}

/// Largest error for a helix on a tube painted at every `step`-th node both ways.
fn helix_error(shape: &Shape, step: usize) -> f64 {
    let exact = shape.axes(&shape.painted(&helices(0.5)));
    let chosen =
        |node: &usize| (node % 32).is_multiple_of(step) && (node / 32).is_multiple_of(step);
    let spacing = TAU * step as f64 / 32.0;
    let paint = Paint::Nodes {
        directions: (0..exact.len())
            .filter(chosen)
            .map(|node| (SurfaceNode::new(node), exact[node].s))
            .collect(),
        width: Some(spacing / 2.0),
    };
    let axes = shape.axes(&shape.painted(&paint));
    let errors = (exact.iter().zip(&axes)).map(|(one, other)| difference(one, other));
    errors.fold(0.0, f64::max)
}

#[test]
fn a_helix_painted_at_some_places_is_met_as_they_get_denser() {
    let shape = Shape::tube(32, 8);
    let steps = [8, 4, 2];
    let errors = steps.map(|step| helix_error(&shape, step));
    let rate = fitted_rate(&steps.map(|step| step as f64), &errors);
    assert!(errors[0] < 0.2 && rate > 1.0, "rate {rate}, {errors:?}");
}
