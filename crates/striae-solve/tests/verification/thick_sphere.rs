//! A thick sphere of metal under pressure from inside, by Hill's closed form.
//!
//! With the radii `a` and `b`, small strains and the yield stress `Y` the metal flows up to the
//! radius `c` under the pressure
//!
//! ```text
//! p = 2 Y ln(c/a) + 2/3 Y (1 - c^3/b^3),   u(b) = (1 - nu) Y c^3 / (E b^2)
//! ```
//!
//! (Hill, *The Mathematical Theory of Plasticity*, 1950, ch. V.1).

use crate::scene::{Run, body, increments, model, step};
use std::collections::HashMap;
use striae_law::bulk::{Hardening, LameConstants, Material, Plastic};
use striae_mesh::{CellBlock, CellKind, ElementId, Face, Mesh, NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Displacement, Load, LoadExtent, LoadKind, Model};
use striae_verify::fitted_rate;

const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const YOUNGS_MODULUS: f64 = 1e4;
const POISSONS_RATIO: f64 = 0.3;
const YIELD: f64 = 1.0;

/// An octant of the sphere: three patches of `n x n` elements, in `2 n` layers.
fn octant(n: usize) -> Mesh {
    let (mut positions, mut numbers) = (Vec::new(), HashMap::new());
    let mut node = |patch: usize, [i, j, k]: [usize; 3]| {
        let [u, v] = [i, j].map(|at| (std::f64::consts::FRAC_PI_4 * at as f64 / n as f64).tan());
        let mut direction = [u, v, 1.0];
        direction.rotate_right(patch);
        let radius = INNER * (OUTER / INNER).powf(k as f64 / (2 * n) as f64);
        let x = Vec3::from(direction).normalize() * radius;
        let key = [x.x, x.y, x.z].map(|x| (x * 1e9).round() as i64);
        *numbers.entry(key).or_insert_with(|| {
            // Nodes of the planes of symmetry lie in them.
            positions.push(x.map(|x| if x.abs() < 1e-12 { 0.0 } else { x }));
            NodeId::new(positions.len() - 1)
        })
    };
    let mut nodes = Vec::new();
    for patch in 0..3 {
        for at in 0..2 * n * n * n {
            let [i, j, k] = [at % n, at / n % n, at / (n * n)];
            for [di, dj, dk] in HEXAHEDRON {
                nodes.push(node(patch, [i + di, j + dj, k + dk]));
            }
        }
    }
    let kind = CellKind::Hexahedron;
    Mesh::new(positions, vec![CellBlock { kind, nodes }]).unwrap()
}

const HEXAHEDRON: [[usize; 3]; 8] = [
    [0, 0, 0],
    [1, 0, 0],
    [1, 1, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 0, 1],
    [1, 1, 1],
    [0, 1, 1],
];

/// The octant under pressure that makes it flow up to the radius `c`.
fn pressed(n: usize, c: f64) -> Model {
    let mesh = octant(n);
    let constants = LameConstants::from_youngs_modulus(YOUNGS_MODULUS, POISSONS_RATIO).unwrap();
    let metal = Plastic::new(constants, Hardening::linear(YIELD, 0.0).unwrap());
    let inner = (0..3).flat_map(|patch| {
        let first = patch * 2 * n * n * n;
        (first..first + n * n).map(|element| Face {
            element: ElementId::new(element),
            side: 0,
        })
    });
    let pressure = 2.0 * YIELD * (c / INNER).ln() + 2.0 / 3.0 * YIELD * (1.0 - (c / OUTER).powi(3));
    let load = Load {
        set: "inside".to_owned(),
        body: BodyId(0),
        faces: inner.collect(),
        kind: LoadKind::Pressure(pressure).into(),
        extent: LoadExtent::Whole,
        curve: Curve::Ramp,
    };
    let held = |axis: usize| {
        let nodes = mesh.positions.iter().enumerate();
        let nodes = nodes.filter(|(_, x)| x[axis] == 0.0);
        let mut components = [None; 3];
        components[axis] = Some(0.0);
        Displacement {
            axes: Axes::Global,
            set: "symmetry".to_owned(),
            body: BodyId(0),
            nodes: nodes.map(|(node, _)| NodeId::new(node)).collect(),
            components: components.map(|of| of.map(Into::into)),
            curve: Curve::Ramp,
        }
    };
    let mut press = step();
    press.increments = increments(0.25, 0.05);
    press.displacements = [0, 1, 2].map(held).into();
    press.loads = vec![load];
    let mut model = model(vec![body("sphere", mesh, Material::plastic(metal))]);
    model.steps = vec![press];
    model
}

#[test]
fn it_widens_by_the_closed_form_while_the_metal_flows() {
    let c = 1.5;
    let widened = (1.0 - POISSONS_RATIO) * YIELD * c * c * c / (YOUNGS_MODULUS * OUTER * OUTER);
    let divisions = [2, 4, 6];
    let errors = divisions.map(|n| {
        let run = Run::completed(pressed(n, c));
        let nodes = run.problem.reference.iter().zip(&run.last().positions);
        let outside = nodes.filter(|(x, _)| (x.norm() - OUTER).abs() < 1e-9);
        let errors = outside.map(|(x, now)| ((now - x).norm() / widened - 1.0).abs());
        errors.fold(0.0, f64::max)
    });
    // Facets of a sphere are chords, and metal flows in whole elements.
    let rate = fitted_rate(&divisions.map(|n| 1.0 / n as f64), &errors);
    assert!(rate > 1.3 && errors[2] < 0.025, "{rate}: {errors:?}");
}
