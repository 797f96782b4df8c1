//! Directions painted at fixed places on a sequence of refined meshes: each is compared with the
//! next one.

use striae_mesh::Vec3;
use striae_verify::fitted_rate;

use super::shapes::*;
use crate::texture::Paint;

const COARSEST: usize = 8;

/// `s` at the nodes of the coarsest mesh, painted at five places inside the patch.
fn painted(n: usize, map: fn(f64, f64) -> Vec3) -> Vec<Vec3> {
    let shape = Shape::patch(n, map);
    let places = [
        (0.125, 0.125),
        (0.875, 0.25),
        (0.5, 0.5),
        (0.25, 0.875),
        (0.875, 0.75),
    ];
    let directions = places.map(|(u, v)| {
        let x = map(u, v);
        (x, Vec3::new(-x.y, x.x, 2.0 * u - v))
    });
    let paint = Paint::Points {
        directions: directions.to_vec(),
        width: None,
    };
    let axes = shape.axes(&shape.painted(&paint));
    let stride = n / COARSEST;
    let node = |k: usize| stride * (k % (COARSEST + 1) + (n + 1) * (k / (COARSEST + 1)));
    (0..(COARSEST + 1) * (COARSEST + 1))
        .map(|k| axes[node(k)].s)
        .collect()
}

#[test]
fn refinement_of_the_mesh_converges() {
    for map in [sphere, torus] {
        let meshes = [8, 16, 32, 64].map(|n| painted(n, map));
        let rate = |nodes: &[usize]| {
            let changes: Vec<f64> = (meshes.windows(2))
                .map(|pair| nodes.iter().map(|&i| (pair[0][i] - pair[1][i]).norm()))
                .map(|changes| changes.fold(0.0, f64::max))
                .collect();
            fitted_rate(&[1.0, 0.5, 0.25], &changes)
        };
        let inner = rate(&Shape::patch(COARSEST, map).inner_nodes());
        let all = rate(&(0..meshes[0].len()).collect::<Vec<_>>());
        assert!((inner - 2.0).abs() < 0.1, "inner nodes: rate {inner}");
        assert!((all - 1.0).abs() < 0.2, "all nodes: rate {all}");
    }
}
