//! Checks of the fields on the contact surfaces: law, tension, gaps.

use crate::scenes::{
    law::Point,
    output::Fields,
    scene::{Pair, Scene},
    vector::length,
    vtu::Grid,
};

use super::{Findings, sizes::sizes, work};

/// Friction beyond the law, relative.
const LAW: f64 = 1e-6;
/// Tension over the largest pressure.
const TENSION: f64 = 1e-8;
/// Gap over the size of a facet.
const GAP: f64 = 1e-6;
/// Pressures below this share of the largest are none, as are excesses of friction.
const NOTHING: f64 = 1e-9;
/// Pressures below this share of the softest modulus are none: contact that has opened leaves
/// residuals of the solver's tolerance over 1e-4 of that modulus.
const RESIDUAL: f64 = 1e-13;
/// Code of nodes that have an own row.
const KEPT: f64 = 1.0;

/// Checks all pairs.
pub fn check(findings: &mut Findings, scene: &Scene, fields: &Fields, increment: usize) {
    for body in fields.bodies.values() {
        if !body.is_finite() {
            let place = || format!("fields after increment {increment} are not finite");
            findings.note("ending", f64::INFINITY, place);
        }
    }
    let moduli = scene.bodies.iter().map(|body| body.material.modulus);
    let residual = RESIDUAL * moduli.fold(f64::INFINITY, f64::min);
    for (pair, sides) in scene.pairs.iter().zip(&fields.pairs) {
        let pressures = sides
            .iter()
            .flatten()
            .filter_map(|grid| grid.scalars("pressure"));
        let largest = pressures
            .flatten()
            .fold(0.0, |largest, p| p.abs().max(largest));
        if largest < residual {
            continue;
        }
        for (grid, side) in sides.iter().zip(&pair.sides) {
            let Some(grid) = grid else { continue };
            let place = |node: usize, what: String| {
                format!(
                    "pair {}, {}, increment {increment}, node {node}: {what}",
                    pair.name, side.owner
                )
            };
            surface(findings, pair, grid, largest, &place);
        }
    }
}

fn surface(
    findings: &mut Findings,
    pair: &Pair,
    grid: &Grid,
    largest: f64,
    place: &dyn Fn(usize, String) -> String,
) {
    let (Some(pressure), Some(gap)) = (grid.scalars("pressure"), grid.scalars("gap")) else {
        findings.note("gap", f64::INFINITY, || {
            place(0, "there is no pressure or gap".into())
        });
        return;
    };
    let size = sizes(grid);
    let kept_nodes = grid.scalars("kept");
    let kept = |node: usize| kept_nodes.is_none_or(|kept| kept[node] == KEPT);
    for node in 0..grid.points.len() {
        let (p, g, h) = (pressure[node], gap[node], size[node]);
        if largest > 0.0 {
            findings.note("tension", -p / (TENSION * largest), || {
                place(node, format!("pressure {p:.2e} of {largest:.2e}"))
            });
        }
        if !kept(node) {
            continue;
        }
        findings.note("gap", -g / (GAP * h), || {
            place(node, format!("gap {g:.2e} of {h:.2e}"))
        });
        if p > NOTHING * largest {
            findings.note("product", g / (GAP * h), || {
                place(
                    node,
                    format!("gap {g:.2e} of {h:.2e} under pressure {p:.2e}"),
                )
            });
        }
    }
    friction(findings, pair, grid, &kept, largest, place);
    work::check(findings, grid, &kept, largest, place);
}

fn friction(
    findings: &mut Findings,
    pair: &Pair,
    grid: &Grid,
    kept: &dyn Fn(usize) -> bool,
    largest: f64,
    place: &dyn Fn(usize, String) -> String,
) {
    let Some(pressure) = grid.scalars("pressure") else {
        return;
    };
    let Some(friction) = grid.vectors("friction_traction") else {
        return;
    };
    let zeros = || vec![[0.0; 3]; grid.points.len()];
    let normal = grid.vectors("normal").unwrap_or_else(zeros);
    let texture = grid.vectors("texture").unwrap_or_else(zeros);
    let nothing = NOTHING * largest;
    for node in (0..grid.points.len()).filter(|&node| kept(node)) {
        let point = Point {
            pressure: pressure[node].max(nothing),
            friction: friction[node],
            normal: normal[node],
            texture: texture[node],
        };
        let tau = length(point.friction);
        if tau <= nothing {
            continue;
        }
        let used = pair.law.use_of(&point, pair.cap);
        // A solver's tolerance is a share of the largest pressure, also where there is little.
        let excess = tau * (1.0 - 1.0 / used) / nothing;
        findings.note("law", excess.min((used - 1.0) / LAW), || {
            place(
                node,
                format!(
                    "friction {tau:.3e} under {:.3e} uses {used:.8}",
                    point.pressure
                ),
            )
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::{
        kinds::{Dialect, scene},
        law::Law,
    };

    /// Checks that fail on a unit square whose nodes have these pressures, gaps and friction along
    /// `x`.
    fn failed(pressure: [f64; 4], gap: [f64; 4], friction: [f64; 4]) -> Vec<&'static str> {
        let mut pair = scene(0, Dialect::default()).pairs.remove(0);
        (pair.law, pair.cap) = (Law::Coulomb(0.3), None);
        let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let grid = Grid::plain(points, vec![vec![0, 1, 2, 3]]);
        let friction = friction.into_iter().flat_map(|x| [x, 0.0, 0.0]).collect();
        let grid = grid
            .with("pressure", 1, pressure.to_vec())
            .with("gap", 1, gap.to_vec())
            .with("friction_traction", 3, friction)
            .with("kept", 1, vec![1.0, 1.0, 1.0, 0.0]);
        let mut findings = Findings::default();
        surface(&mut findings, &pair, &grid, 1.0, &|_, what| what);
        findings.failed().map(|(name, _)| name).collect()
    }

    #[test]
    fn each_fault_fails_its_check() {
        let (p, g, t) = (
            [1.0, 0.5, 0.0, 0.2],
            [0.0, 0.0, 0.1, -0.1],
            [0.3, -0.1, 0.0, 0.9],
        );
        assert!(failed(p, g, t).is_empty());
        assert_eq!(failed([1.0, 0.5, 0.0, -0.1], g, t), ["tension"]);
        assert_eq!(failed(p, [0.0, -1e-5, 0.1, 0.0], t), ["gap"]);
        assert_eq!(failed(p, [0.0, 1e-5, 0.1, 0.0], t), ["product"]);
        assert_eq!(failed(p, g, [0.3, -0.151, 0.0, 0.0]), ["law"]);
        assert_eq!(failed(p, g, [0.3, -0.1, 0.01, 0.0]), ["law"]);
    }

    #[test]
    fn friction_in_excess_is_held_against_the_largest_pressure() {
        let excessive = |p: f64, excess: f64| {
            failed(
                [1.0, p, 0.0, 0.0],
                [0.0; 4],
                [0.0, 0.3 * p + excess, 0.0, 0.0],
            )
        };
        assert!(excessive(1e-5, 0.5e-9).is_empty());
        assert_eq!(excessive(1e-5, 2e-9), ["law"]);
        assert!(excessive(1.0, 0.2e-6).is_empty());
        assert_eq!(excessive(1.0, 0.4e-6), ["law"]);
    }
}
