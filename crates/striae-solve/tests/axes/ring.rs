//! Parts of a ring under pressure from inside.
//!
//! Small displacements of a ring in plane strain are `u = A r + B/r` along the radius (Lamé).

use striae_mesh::{CellBlock, CellKind, ElementId, Face, Mesh, NodeId, Vec3};
use striae_model::{Axes, BodyId, Curve, Load, LoadExtent, LoadKind, Model};
use striae_verify::fitted_rate;

use super::prescribed;
use crate::scene::{Run, body, increments, model, rubber, step};

const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const WIDTH: f64 = 0.25;

/// Part of the ring about `z` over an angle, of `n` by `around` elements; the first `n` elements
/// have their side 0 inside.
fn sector(angle: f64, n: usize, around: usize) -> Mesh {
    let (mut positions, mut nodes) = (Vec::new(), Vec::new());
    let number = |i: usize, j: usize, k: usize| (k * (around + 1) + j) * (n + 1) + i;
    for k in 0..2 {
        for j in 0..=around {
            for i in 0..=n {
                let r = INNER + (OUTER - INNER) * i as f64 / n as f64;
                let (sin, cos) = (angle * j as f64 / around as f64).sin_cos();
                positions.push(Vec3::new(r * cos, r * sin, k as f64 * WIDTH));
            }
        }
    }
    for j in 0..around {
        for i in 0..n {
            let face =
                |i: usize| [[j, 0], [j + 1, 0], [j + 1, 1], [j, 1]].map(|[j, k]| number(i, j, k));
            nodes.extend(face(i).into_iter().chain(face(i + 1)).map(NodeId::new));
        }
    }
    let kind = CellKind::Hexahedron;
    Mesh::new(positions, vec![CellBlock { kind, nodes }]).unwrap()
}

fn cylindrical() -> Axes {
    Axes::Cylindrical {
        point: Vec3::zeros(),
        axis: Vec3::z(),
    }
}

/// A sector with symmetric cuts, in plane strain, pressed from inside by large strains.
fn pressed(angle: f64, around: usize, cut: Axes) -> Run {
    let n = 3;
    let mesh = sector(angle, n, around);
    let (sin, cos) = angle.sin_cos();
    let on_cut = |x: &Vec3| (sin * x.x - cos * x.y).abs() < 1e-9;
    let inside = (0..around).map(|j| Face {
        element: ElementId::new(j * n),
        side: 0,
    });
    let mut press = step();
    press.increments = increments(0.5, 0.1);
    press.displacements = vec![
        prescribed(&mesh, Axes::Global, [None, Some(0.0), None], |x| x.y == 0.0),
        prescribed(&mesh, Axes::Global, [None, None, Some(0.0)], |_| true),
        match cut {
            Axes::Cylindrical { .. } => prescribed(&mesh, cut, [None, Some(0.0), None], on_cut),
            _ => prescribed(&mesh, cut, [Some(0.0), None, None], on_cut),
        },
    ];
    press.loads = vec![Load {
        set: "inside".to_owned(),
        body: BodyId(0),
        faces: inside.collect(),
        kind: LoadKind::Pressure(0.1).into(),
        extent: LoadExtent::Whole,
        curve: Curve::Ramp,
    }];
    let mut model = model(vec![body("ring", mesh, rubber(1.0, 0.3))]);
    model.steps = vec![press];
    Run::completed(model)
}

#[test]
fn a_sector_with_a_cut_at_an_angle_is_part_of_the_quarter() {
    let half = std::f64::consts::FRAC_PI_4;
    let x_cut = Axes::Normal(Vec3::new(-2.0, 0.0, 0.0));
    let quarter = pressed(2.0 * half, 8, x_cut);
    let normal = Vec3::new(half.sin(), -half.cos(), 0.0);
    for cut in [
        Axes::Normal(normal * 3.0),
        Axes::Skew {
            x: -normal,
            y: Vec3::z(),
        },
        cylindrical(),
    ] {
        let eighth = pressed(half, 4, cut);
        let mut compared = 0;
        let of_quarter: Vec<_> = (quarter.problem.reference.iter())
            .zip(quarter.positions(0))
            .collect();
        let largest = eighth.problem.reference.iter().zip(eighth.positions(0));
        for (at, x) in largest {
            let twin = of_quarter
                .iter()
                .find(|(other, _)| (*other - at).norm() < 1e-9);
            let (_, twin) = twin.expect("the meshes agree");
            assert!(
                (x - *twin).norm() < 1e-10,
                "{at:?}: {:e}",
                (x - *twin).norm()
            );
            assert!((x - at).norm() > 0.02);
            compared += 1;
        }
        assert_eq!(compared, eighth.problem.reference.len());
    }
}

/// Largest error of the displacement of a ring that is widened inside and held outside, over
/// that inside.
fn error(n: usize) -> f64 {
    let way = 1e-6;
    let mesh = sector(std::f64::consts::FRAC_PI_3, n, 2 * n);
    let radius = |x: &Vec3| x.xy().norm();
    let mut widen = step();
    widen.displacements = vec![
        prescribed(&mesh, cylindrical(), [None, Some(0.0), Some(0.0)], |_| true),
        prescribed(&mesh, cylindrical(), [Some(way), None, None], |x| {
            (radius(x) - INNER).abs() < 1e-9
        }),
        prescribed(&mesh, cylindrical(), [Some(0.0), None, None], |x| {
            (radius(x) - OUTER).abs() < 1e-9
        }),
    ];
    let mut model = model(vec![body("ring", mesh, rubber(1.0, 0.3))]);
    model.steps = vec![widen];
    let run = Run::completed(model);
    let b = way / (1.0 / INNER - INNER / (OUTER * OUTER));
    let a = -b / (OUTER * OUTER);
    let nodes = run.problem.reference.iter().zip(run.positions(0));
    let errors = nodes.map(|(at, x)| {
        let r = radius(at);
        let radial = Vec3::new(at.x / r, at.y / r, 0.0);
        ((x - at) - radial * (a * r + b / r)).norm() / way
    });
    errors.fold(0.0, f64::max)
}

#[test]
fn a_ring_in_cylindrical_axes_converges_to_the_closed_form() {
    let divisions = [4, 8, 16];
    let errors = divisions.map(error);
    let rate = fitted_rate(&divisions.map(|n| 1.0 / n as f64), &errors);
    assert!((rate - 2.0).abs() < 0.1, "rate {rate}: {errors:?}");
    assert!(errors[2] < 1e-3, "{errors:?}");
}

/// Widens a ring by the pressure, and turns it by tangential displacements, then frees the turned
/// nodes: what was held by the cut alone is at rest again.
#[test]
fn released_components_are_free_in_their_axes() {
    let angle = std::f64::consts::FRAC_PI_3;
    let mesh = sector(angle, 2, 4);
    let on = |r: f64| move |x: &Vec3| (x.xy().norm() - r).abs() < 1e-9;
    let mut turn = step();
    turn.displacements = vec![
        prescribed(&mesh, cylindrical(), [Some(0.0); 3], on(INNER)),
        prescribed(
            &mesh,
            cylindrical(),
            [Some(0.0), Some(0.01), Some(0.0)],
            on(OUTER),
        ),
    ];
    let mut free = step();
    "free".clone_into(&mut free.name);
    free.releases = vec![striae_model::Release {
        body: BodyId(0),
        nodes: turn.displacements[1].nodes.clone(),
        components: [false, true, false],
    }];
    let mut model: Model = model(vec![body("ring", mesh, rubber(1.0, 0.3))]);
    model.steps = vec![turn, free];
    let run = Run::completed(model);
    let ways = |state: &striae_solve::state::State| {
        let nodes = run.problem.reference.iter().zip(&state.positions);
        let ways = nodes.filter(|(at, _)| on(OUTER)(at)).map(|(at, x)| {
            let tangential = Vec3::new(-at.y, at.x, 0.0) / OUTER;
            (x - at).dot(&tangential)
        });
        ways.collect::<Vec<f64>>()
    };
    assert!(
        ways(&run.states[1])
            .iter()
            .all(|way| (way - 0.01).abs() < 1e-12)
    );
    assert!(ways(run.last()).iter().all(|way| way.abs() < 1e-9));
    let reactions = run
        .problem
        .reference
        .iter()
        .zip(&run.last().forces.reaction);
    assert!(reactions.map(|(_, force)| force.norm()).fold(0.0, f64::max) < 1e-9);
}
