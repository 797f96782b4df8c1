//! Checks of face loads.

use super::*;
use crate::model::LoadKind;
use nalgebra::{DMatrix, DVector, Rotation3, Unit, Vector3};
use num_dual::DualSVec64;
use striae_mesh::{CellBlock, Mesh, NodeId, Vec3};
use striae_verify::{Random, assert_derivative};

const SQUARE: [[f64; 2]; 4] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];

fn kinds() -> [LoadKind; 3] {
    let traction = Vec3::new(0.3, -0.8, 1.1);
    [
        LoadKind::DeadTraction(traction),
        LoadKind::FollowerTraction(traction),
        LoadKind::Pressure(1.3),
    ]
}

/// A warped face near the unit square, with normal near `e3`.
fn warped(random: &mut Random, amplitude: f64) -> [Vec3; 4] {
    SQUARE.map(|[x, y]| Vec3::new(x, y, 0.0) + random.vector3() * amplitude)
}

fn unknowns(x: &[Vec3; 4]) -> DVector<f64> {
    DVector::from_iterator(UNKNOWNS, x.iter().flat_map(|x| x.iter().copied()))
}

fn corners(unknowns: &DVector<f64>) -> [Vec3; 4] {
    std::array::from_fn(|a| unknowns.fixed_rows::<3>(3 * a).into())
}

fn nodal(force: &[f64; UNKNOWNS]) -> [Vec3; 4] {
    corners(&DVector::from_row_slice(force))
}

#[test]
fn tangents_are_the_derivatives_of_the_forces() {
    let mut random = Random::new(21);
    for kind in kinds() {
        let reference = warped(&mut random, 0.2);
        let at = |x: &DVector<f64>| response(&kind.into(), &reference, &corners(x)).unwrap();
        assert_derivative(
            |x| DVector::from_row_slice(&at(x).force),
            |x| DMatrix::from_row_slice(UNKNOWNS, UNKNOWNS, &at(x).tangent),
            &unknowns(&warped(&mut random, 0.3)),
        );
    }
}

#[test]
fn resultants_on_a_plane_face_are_area_times_traction() {
    let reference = SQUARE.map(|[x, y]| Vec3::new(2.0 * x, 3.0 * y, 0.0));
    let current = SQUARE.map(|[x, y]| Vec3::new(4.0 * x, 0.0, -3.0 * y));
    // The normal turns from e3 to e2, the area from 6 to 12.
    let quarter_turn = |t: Vec3| Vec3::new(t.x, t.z, -t.y);
    for kind in kinds() {
        let force = nodal(&response(&kind.into(), &reference, &current).unwrap().force);
        let expected = match kind {
            LoadKind::DeadTraction(t) => t * 6.0,
            LoadKind::FollowerTraction(t) => quarter_turn(t) * 12.0,
            LoadKind::Pressure(p) => Vec3::new(0.0, -12.0 * p, 0.0),
        };
        assert!((force.iter().sum::<Vec3>() - expected).norm() < 1e-13);
        assert!(force.iter().all(|f| (f * 4.0 - expected).norm() < 1e-13));
    }
}

#[test]
fn pressure_is_objective() {
    let mut random = Random::new(22);
    for _ in 0..20 {
        let (reference, current) = (warped(&mut random, 0.2), warped(&mut random, 0.3));
        let (q, shift) = (random.rotation(), random.vector3());
        let kind = LoadKind::Pressure(1.3);
        let before = response(&kind.into(), &reference, &current).unwrap();
        let after = response(&kind.into(), &reference, &current.map(|x| q * x + shift)).unwrap();
        for (f, turned) in nodal(&before.force).iter().zip(nodal(&after.force)) {
            assert!((q * f - turned).norm() < 1e-14);
        }
    }
}

#[test]
fn a_follower_traction_turns_with_a_tilted_face_but_not_with_its_spin() {
    let reference = SQUARE.map(|[x, y]| Vec3::new(x, y, 0.0));
    let [_, kind, _] = kinds();
    let at_rest = nodal(
        &response(&kind.into(), &reference, &reference)
            .unwrap()
            .force,
    );
    let turned = |axis: Vec3, angle: f64| {
        let q = Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
        (
            q,
            nodal(
                &response(&kind.into(), &reference, &reference.map(|x| q * x))
                    .unwrap()
                    .force,
            ),
        )
    };
    for angle in [-3.0, -1.2, 0.4, 2.0, 3.1] {
        let (q, tilted) = turned(Vec3::new(0.6, -0.8, 0.0), angle);
        let (_, spun) = turned(Vec3::z(), angle);
        for a in 0..4 {
            assert!((q * at_rest[a] - tilted[a]).norm() < 1e-12);
            assert!((at_rest[a] - spun[a]).norm() < 1e-14);
        }
    }
}

#[test]
fn pressure_on_a_closed_surface_balances_and_has_a_potential() {
    let mut random = Random::new(23);
    let cube: [Vec3; 8] = std::array::from_fn(|a| {
        let [x, y] = SQUARE[a % 4];
        Vec3::new(x, y, (a / 4) as f64) + random.vector3() * 0.2
    });
    let mut force = [Vec3::zeros(); 8];
    let mut tangent = DMatrix::<f64>::zeros(24, 24);
    let cell = CellBlock::hexahedra([std::array::from_fn(NodeId::new)]);
    for side in cell.kind.shape().faces {
        let face: [Vec3; 4] = std::array::from_fn(|a| cube[side[a]]);
        let load = response(&LoadKind::Pressure(1.3.into()), &face, &face).unwrap();
        let global = |row: usize| 3 * side[row / 3] + row % 3;
        for row in 0..UNKNOWNS {
            force[side[row / 3]][row % 3] += load.force[row];
            for column in 0..UNKNOWNS {
                tangent[(global(row), global(column))] += load.tangent[UNKNOWNS * row + column];
            }
        }
    }
    let moment: Vec3 = (0..8).map(|a| cube[a].cross(&force[a])).sum();
    assert!(force.iter().sum::<Vec3>().norm() < 1e-14);
    assert!(moment.norm() < 1e-14);
    // The potential is p V, homogeneous of degree 3 in the positions.
    let volume = Mesh::new(cube.to_vec(), vec![cell]).unwrap().volume();
    let virial: f64 = (0..8).map(|a| cube[a].dot(&force[a])).sum();
    assert!((virial + 3.0 * 1.3 * volume).abs() < 1e-14);
    assert!((&tangent - tangent.transpose()).norm() < 1e-14);
}

#[test]
fn the_integrand_integrates_to_the_response() {
    let mut random = Random::new(24);
    for kind in kinds() {
        let (reference, current) = (warped(&mut random, 0.2), warped(&mut random, 0.3));
        let mut force = [0.0; UNKNOWNS];
        for [x, y] in SQUARE {
            let (xi, eta) = ((2.0 * x - 1.0) / 3f64.sqrt(), (2.0 * y - 1.0) / 3f64.sqrt());
            let [g_1, g_2] = integrand::tangents(&current, &integrand::shape_slopes(xi, eta));
            let area = g_1.cross(&g_2).norm();
            let t = traction(&kind, &reference, &current, xi, eta);
            for (a, shape) in integrand::shape(xi, eta).iter().enumerate() {
                for i in 0..3 {
                    force[3 * a + i] += shape * area * t[i];
                }
            }
        }
        let whole = response(&kind.into(), &reference, &current).unwrap().force;
        let difference = DVector::from_row_slice(&force) - DVector::from_row_slice(&whole);
        assert!(difference.norm() < 1e-14);
    }
}

#[test]
fn the_integrand_is_differentiable_in_the_point_and_the_corners() {
    type Dual = DualSVec64<14>;
    let mut random = Random::new(25);
    for kind in kinds() {
        let reference = warped(&mut random, 0.2);
        let mut x = unknowns(&warped(&mut random, 0.3));
        x = x.push(0.2).push(-0.4);
        assert_derivative(
            |x| {
                let t = traction(&kind, &reference, &corners(x), x[12], x[13]);
                DVector::from_row_slice(t.as_slice())
            },
            |x| {
                let x: [Dual; 14] = std::array::from_fn(|k| Dual::from_re(x[k]).derivative(k));
                let current =
                    std::array::from_fn(|a| Vector3::new(x[3 * a], x[3 * a + 1], x[3 * a + 2]));
                let kind = kind.map(|value| Dual::from(*value));
                let t = traction(&kind, &reference, &current, x[12], x[13]);
                DMatrix::from_fn(3, 14, |i, k| t[i].eps.0.map_or(0.0, |slope| slope[k]))
            },
            &x,
        );
    }
}

#[test]
fn a_face_without_a_normal_or_turned_over_is_refused() {
    let square = SQUARE.map(|[x, y]| Vec3::new(x, y, 0.0));
    let turned_over = square.map(|x| Vec3::new(-x.x, x.y, x.z));
    let collapsed = [Vec3::zeros(); 4];
    let [dead, follower, pressure] = kinds();
    for current in [&turned_over, &collapsed] {
        assert_eq!(
            response(&follower.into(), &square, current),
            Err(LoadError::Undirected { gauss_point: 0 })
        );
        assert!(response(&dead.into(), &square, current).is_ok());
        assert!(response(&pressure.into(), &square, current).is_ok());
    }
}
