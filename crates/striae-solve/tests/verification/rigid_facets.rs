//! A body on a rigid meshed surface.

use crate::scene::{
    Places, Run, block, body, coulomb, increments, largest_distance, model, plane, rubber, step,
};
use striae_mesh::{NodeId, Vec3};
use striae_model::{Model, RigidShape};

/// Division of a square grid of rigid facets.
#[derive(Clone, Copy)]
enum Division {
    Quadrilaterals,
    Triangles,
    OtherTriangles,
}

/// A rigid surface `z = height(x, y)` over `[-1, 2]^2`.
fn grid(count: usize, division: Division, height: impl Fn(f64, f64) -> f64) -> RigidShape {
    let at = |i: usize| -1.0 + 3.0 * i as f64 / count as f64;
    let positions = (0..(count + 1) * (count + 1)).map(|k| {
        let (x, y) = (at(k % (count + 1)), at(k / (count + 1)));
        Vec3::new(x, y, height(x, y))
    });
    let node = |i: usize, j: usize| NodeId::new(i + (count + 1) * j);
    let mut facets = Vec::new();
    for j in 0..count {
        for i in 0..count {
            let [a, b, c, d] = [
                node(i, j),
                node(i + 1, j),
                node(i + 1, j + 1),
                node(i, j + 1),
            ];
            match division {
                Division::Quadrilaterals => facets.push([a, b, c, d]),
                Division::Triangles => facets.extend([[a, b, c, c], [a, c, d, d]]),
                Division::OtherTriangles => facets.extend([[a, b, d, d], [b, c, d, d]]),
            }
        }
    }
    RigidShape::Facets {
        positions: positions.collect(),
        facets,
    }
}

fn pressed_and_slid(shape: RigidShape, start: f64) -> Model {
    let mut mesh = block([0.0, 0.0, start], [1.0, 1.0, 0.5], [3, 3, 1]);
    mesh.irregularity = 0.15;
    let mut model = model(vec![body("block", mesh.mesh().unwrap(), rubber(1.0, 0.3))]);
    model.touch_rigid(("block", "zmin"), shape, coulomb(0.3));
    let mut press = step();
    press.displacements =
        vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.05 - start)])];
    press.increments = increments(0.5, 0.01);
    let mut slide = step();
    slide.displacements = vec![model.hold("block", "zmax", [Some(0.02), Some(0.01), None])];
    slide.increments = increments(0.25, 0.01);
    model.steps = vec![press, slide];
    model
}

#[test]
fn flat_facets_are_a_plane() {
    let flat = |_: f64, _: f64| 0.0;
    let on_plane = Run::completed(pressed_and_slid(plane([0.0; 3], [0.0, 0.0, 1.0]), 0.0));
    for shape in [
        grid(4, Division::Quadrilaterals, flat),
        grid(5, Division::Triangles, flat),
        grid(5, Division::OtherTriangles, flat),
    ] {
        let run = Run::completed(pressed_and_slid(shape, 0.0));
        let error = largest_distance(run.positions(0), on_plane.positions(0));
        assert!(error < 1e-10, "off by {error:.1e}");
        let [a, b] = [&run, &on_plane].map(|r| r.last().pairs[0].tractions.nodes[0].clone());
        // Quadrature over cut facets of an irregular mesh is not exact.
        let largest = b.iter().map(|q| q[0]).fold(0.0, f64::max);
        for (p, q) in a.iter().zip(&b) {
            assert!((p[0] - q[0]).abs() < 1e-8 * largest, "{p:?} {q:?}");
        }
    }
}

#[test]
fn a_curved_surface_converges() {
    let bump = |x: f64, y: f64| 0.05 * (1.0 - (x - 0.5).powi(2) - (y - 0.5).powi(2)) - 0.05;
    let centre = |count| {
        let run = Run::completed(pressed_and_slid(
            grid(count, Division::Quadrilaterals, bump),
            0.0,
        ));
        let pair = &striae_solve::report::pairs(&run.problem, run.last())[0];
        pair.sides[0].force
    };
    let forces = [5, 10, 20, 40].map(centre);
    let changes: Vec<f64> = forces.windows(2).map(|f| (f[1] - f[0]).norm()).collect();
    assert!(
        changes[1] < 0.5 * changes[0] && changes[2] < 0.5 * changes[1],
        "{changes:?}"
    );
}
