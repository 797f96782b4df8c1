//! No surface inside another body: positions against elements and rigid surfaces.
//!
//! Between two bodies, each node of a pair's side is sought in the elements of the
//! other body; its depth is that below the pair's surface of that body, unless another
//! face is at less than half the distance: this pair says nothing of what comes through there.
//! Corners of rigid surfaces are judged likewise.
//! Depths are over the larger facets of the two sides, as that is how fine a weighted
//! gap can see; those over the own ones are told.

use crate::scenes::{
    geometry::{Solid, Surface, height, triangles, turned_back},
    output::{Fields, History},
    scene::{Pair, RigidShape, Scene},
    vector::{
        Matrix, Vector, applied, cross, dot, length, minus, plus, rotation, transposed, unit,
    },
    vtu::Grid,
};

use super::{Findings, sizes::sizes_at_places};

/// Largest depth over the size of a facet.
pub const DEPTH: f64 = 0.1;

/// Checks all pairs.
pub fn check(
    findings: &mut Findings,
    scene: &Scene,
    history: &History,
    fields: &Fields,
    increment: usize,
) {
    for (pair, sides) in scene.pairs.iter().zip(&fields.pairs) {
        match sides {
            [Some(a), Some(b)] => {
                let named = |side: usize| fields.bodies.get(pair.sides[side].owner);
                for (own, own_side, other, other_side) in [(a, 0, b, 1), (b, 1, a, 0)] {
                    let Some(body) = named(other_side) else {
                        continue;
                    };
                    let place = format!("pair {}, {}", pair.name, pair.sides[own_side].owner);
                    deformable(findings, own, other, body, &place, increment);
                }
            }
            [Some(grid), None] | [None, Some(grid)] => {
                rigid(findings, scene, history, fields, pair, grid, increment);
            }
            [None, None] => {}
        }
    }
}

fn deformable(
    findings: &mut Findings,
    own: &Grid,
    other: &Grid,
    body: &Grid,
    place: &str,
    increment: usize,
) {
    let solid = Solid::new(&body.points, &body.cells);
    let facing = Surface::new((0..other.cells.len()).map(|cell| other.corners(cell)));
    let own_sizes = sizes_at_places(own);
    let other_sizes = sizes_at_places(other);
    let largest = other_sizes.iter().copied().fold(0.0, f64::max);
    let mut worst: f64 = 0.0;
    for (node, &x) in own.points.iter().enumerate() {
        let Some(depth) = solid.depth(x) else {
            continue;
        };
        let below = facing.distance(x);
        if depth < 0.5 * below {
            findings.tell("depth through other faces", depth / own_sizes[node]);
            continue;
        }
        let near = nearest(other, x).map_or(largest, |node| other_sizes[node]);
        findings.tell("depth over own facets", below / own_sizes[node]);
        let size = own_sizes[node].max(near);
        worst = worst.max(below / size);
        findings.note("depth", below / (DEPTH * size), || {
            format!("{place}, increment {increment}, node {node}: {below:.2e} of {size:.2e}")
        });
    }
    findings.note("depth", worst / DEPTH, || {
        format!("{place}, increment {increment}")
    });
}

fn nearest(grid: &Grid, x: Vector) -> Option<usize> {
    let distance = |node: &usize| length(minus(grid.points[*node], x));
    (0..grid.points.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
}

/// Nodes below a rigid surface, and its corners inside the body.
fn rigid(
    findings: &mut Findings,
    scene: &Scene,
    history: &History,
    fields: &Fields,
    pair: &Pair,
    grid: &Grid,
    increment: usize,
) {
    let Some(surface) = scene
        .rigid
        .iter()
        .find(|rigid| pair.sides.iter().any(|side| side.owner == rigid.name))
    else {
        return;
    };
    let moved = history.vector(increment - 1, &format!("displacement.{}", surface.name));
    let moved = moved.unwrap_or([0.0; 3]);
    let place = &scene.placement;
    let (turned, about) = match surface.shape {
        RigidShape::Solid(_, _, at, _) => (turn(history, increment, surface.name), place.point(at)),
        _ => (rotation([0.0, 0.0, 1.0], 0.0), [0.0; 3]),
    };
    // Into the local frame of the surface.
    let local = |x: Vector| {
        let x = turned_back(&turned, about, moved, x);
        applied(&transposed(&place.matrix()), minus(x, place.shift))
    };
    let below: Box<dyn Fn(Vector) -> f64> = match &surface.shape {
        RigidShape::Plane(point, normal) => {
            let (point, normal) = (*point, unit(*normal));
            Box::new(move |x| dot(minus(point, x), normal))
        }
        RigidShape::Solid(positions, facets, at, _) => {
            let planes: Vec<(Vector, Vector)> = facets
                .iter()
                .map(|[a, b, c, _]| {
                    let [a, b, c] = [a, b, c].map(|&i| plus(positions[i], *at));
                    (a, unit(cross(minus(b, a), minus(c, a))))
                })
                .collect();
            Box::new(move |x| {
                let depths = planes.iter().map(|&(point, n)| dot(minus(point, x), n));
                depths.fold(f64::INFINITY, f64::min)
            })
        }
        RigidShape::Sheet(positions, facets) => {
            let pieces: Vec<[Vector; 3]> = facets
                .iter()
                .flat_map(|facet| triangles(&corners(positions, facet)))
                .collect();
            Box::new(move |x| {
                height(&pieces, x).map_or(f64::NEG_INFINITY, |(z, cosine)| (z - x[2]) * cosine)
            })
        }
        RigidShape::Head(..) => return,
    };
    let sizes = sizes_at_places(grid);
    for (node, &x) in grid.points.iter().enumerate() {
        let depth = below(local(x));
        findings.note("depth", depth / (DEPTH * sizes[node]), || {
            format!(
                "pair {}, increment {increment}, node {node}: {depth:.2e} of {:.2e}",
                pair.name, sizes[node]
            )
        });
    }
    if let RigidShape::Sheet(positions, _) = &surface.shape {
        let Some(side) = pair.sides.iter().find(|side| side.facets.is_some()) else {
            return;
        };
        let Some(body) = fields.bodies.get(side.owner) else {
            return;
        };
        let solid = Solid::new(&body.points, &body.cells);
        let facing = Surface::new((0..grid.cells.len()).map(|cell| grid.corners(cell)));
        for (corner, &x) in positions.iter().enumerate() {
            let x = place.point(x);
            let x = [0, 1, 2].map(|i| x[i] + moved[i]);
            let Some(inside) = solid.depth(x) else {
                continue;
            };
            let depth = facing.distance(x);
            if inside < 0.5 * depth {
                // It came through another face, of which another pair speaks.
                continue;
            }
            let size = nearest(grid, x).map_or(f64::NAN, |node| sizes[node]);
            findings.note("depth", depth / (DEPTH * size), || {
                format!("pair {}, increment {increment}, rigid corner {corner}: {depth:.2e} of {size:.2e}", pair.name)
            });
        }
    }
}

/// The rotation of a rigid body, by the angles about the fixed axes: exact about one of them, and
/// little off where turns about others are small.
fn turn(history: &History, increment: usize, name: &str) -> Matrix {
    let angles = history.vector(increment - 1, &format!("angle.{name}"));
    let angles = angles.unwrap_or([0.0; 3]).map(f64::to_radians);
    match length(angles) {
        0.0 => rotation([0.0, 0.0, 1.0], 0.0),
        angle => rotation(unit(angles), angle),
    }
}

fn corners(positions: &[Vector], facet: &[usize; 4]) -> Vec<Vector> {
    let mut corners: Vec<usize> = facet.to_vec();
    corners.dedup();
    corners.into_iter().map(|i| positions[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit cube from a height up, and its lower or upper side.
    fn cube(z: f64, side: [usize; 4]) -> [Grid; 2] {
        let plan = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let level = |z: f64| plan.map(|[x, y]| [0.1 + 0.8 * x, 0.1 + 0.8 * y, z]);
        let points: Vec<Vector> = [level(z), level(z + 1.0)].concat();
        let surface = side.map(|i| points[i]).to_vec();
        let body = Grid::plain(points, vec![(0..8).collect()]);
        [body, Grid::plain(surface, vec![vec![0, 1, 2, 3]])]
    }

    fn measure(gap: f64) -> f64 {
        let [body, top] = cube(-1.0, [4, 5, 6, 7]);
        let [_, bottom] = cube(gap, [0, 3, 2, 1]);
        let moved = bottom.points.iter().map(|x| [x[0] + 0.3, x[1] + 0.2, x[2]]);
        let shifted = Grid::plain(moved.collect(), bottom.cells.clone());
        let mut findings = Findings::default();
        deformable(&mut findings, &shifted, &top, &body, "", 1);
        findings.worst["depth"].measure
    }

    #[test]
    fn depth_is_below_the_surface_of_the_pair() {
        assert_eq!(measure(0.01), 0.0);
        let bound = DEPTH * 0.8;
        for depth in [0.01, 0.3] {
            let found = measure(-depth);
            assert!((found - depth / bound).abs() < 1e-9, "{depth}: {found}");
        }
    }
}
