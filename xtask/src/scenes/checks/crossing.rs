//! No skin through another one, or through itself: all facets of all bodies against each other.
//!
//! Facets are triangles, those of four corners four about their middle. Two triangles that share
//! no node of their facets cross where an edge of one goes through the other. How deep is the least
//! way by which one facet leaves the other on the outside: over the axes `a` along both outward
//! normals and along `e_1 x e_2` for all edges, each in the ways with `a . (n_2 - n_1) > -0.7`,
//!
//! ```text
//! depth = min over a of (max over facet 2 of a . x - min over facet 1 of a . x) .
//! ```
//!
//! Nothing is told apart: bodies, layers and folds all count alike.
//! A weighted gap sees no more than the mean over the facets around a node, so corners of coarse
//! facets sink in; deeper than a share of the size of a facet, the root of its area, is wrong: of the smaller one in
//! a body, of the larger one between two bodies, whose meshes need not be alike.

use crate::scenes::{
    geometry::{Extent, area, triangles},
    output::Fields,
    pieces,
    vector::{Vector, cross, dot, length, minus, times, unit},
};

use super::Findings;

/// Largest depth over the size of a facet.
const CROSSING: f64 = 0.3;

/// Share by which an axis may point inwards, along the difference of two outward normals: of facets at an
/// angle to each other, edges also part along axes that point a little inwards.
const LEVEL: f64 = 0.7;

/// A facet of a skin.
struct Facet<'a> {
    body: &'a str,
    nodes: Vec<usize>,
    extent: Extent,
    size: f64,
    corners: Vec<Vector>,
    triangles: Vec<[Vector; 3]>,
}

/// Checks the skins of all bodies.
pub fn check(findings: &mut Findings, fields: &Fields, increment: usize) {
    let mut facets = Vec::new();
    let mut names: Vec<&&str> = fields.bodies.keys().collect();
    names.sort_unstable();
    for body in names {
        let grid = &fields.bodies[*body];
        facets.extend(pieces::boundary(&grid.cells).into_iter().map(|nodes| {
            let corners: Vec<Vector> = nodes.iter().map(|&node| grid.points[node]).collect();
            Facet {
                body,
                extent: Extent::of(&corners),
                size: area(&corners).sqrt(),
                triangles: triangles(&corners),
                corners,
                nodes,
            }
        }));
    }
    let none = || format!("increment {increment}");
    findings.note("crossing", 0.0, none);
    facets.sort_by(|a, b| a.extent.low()[0].total_cmp(&b.extent.low()[0]));
    for (at, one) in facets.iter().enumerate() {
        let near = facets[at + 1..].iter();
        let near = near.take_while(|other| other.extent.low()[0] <= one.extent.high()[0]);
        for other in near.filter(|other| one.extent.meets(&other.extent)) {
            let joined =
                one.body == other.body && one.nodes.iter().any(|node| other.nodes.contains(node));
            if joined {
                continue;
            }
            let depth = deepest(one, other);
            let size = if one.body == other.body {
                one.size.min(other.size)
            } else {
                one.size.max(other.size)
            };
            findings.note("crossing", depth / (CROSSING * size), || {
                format!(
                    "increment {increment}, {} {:?} through {} {:?}: {depth:.2e} of {size:.2e}",
                    one.body, one.nodes, other.body, other.nodes
                )
            });
        }
    }
}

/// Depth of two facets by those of their triangles that cross; 0 where none do.
fn deepest(one: &Facet, other: &Facet) -> f64 {
    let pairs = one.triangles.iter();
    let pairs = pairs.flat_map(|a| other.triangles.iter().map(move |b| (a, b)));
    let crossing = pairs.filter(|(a, b)| pierces(a, b) || pierces(b, a));
    let depths =
        crossing.map(|(a, b)| way_out(&one.corners, &other.corners, [normal(a), normal(b)]));
    depths.fold(0.0, f64::max)
}

/// The least way by which a facet leaves another one on the outside, by their normals.
fn way_out(one: &[Vector], other: &[Vector], [n, m]: [Vector; 2]) -> f64 {
    let edges = |corners: &[Vector]| -> Vec<Vector> {
        let next = corners.iter().cycle().skip(1);
        corners
            .iter()
            .zip(next)
            .map(|(a, b)| minus(*b, *a))
            .collect()
    };
    let (edges, others) = (edges(one), edges(other));
    let crossed = edges
        .iter()
        .flat_map(|e| others.iter().map(move |f| cross(*e, *f)));
    let outwards = minus(m, n);
    // Along the common edge of two sides neither way is more outwards.
    let signed = |axis: Vector| {
        let axis = unit(axis);
        let ways = [1.0, -1.0].map(|sign| times(sign, axis));
        ways.into_iter().filter(|way| dot(*way, outwards) > -LEVEL)
    };
    let axes = crossed.filter(|axis| length(*axis) > 0.0).flat_map(signed);
    let ways = axes.chain([m, times(-1.0, n)]).map(|axis| {
        let along = |corners: &[Vector], sign: f64| {
            let all = corners.iter().map(|x| sign * dot(axis, *x));
            all.fold(f64::NEG_INFINITY, f64::max)
        };
        along(other, 1.0) + along(one, -1.0)
    });
    ways.fold(f64::INFINITY, f64::min).max(0.0)
}

fn normal([a, b, c]: &[Vector; 3]) -> Vector {
    let normal = cross(minus(*b, *a), minus(*c, *a));
    if length(normal) > 0.0 {
        unit(normal)
    } else {
        normal
    }
}

/// Height of a point over the plane of a triangle.
fn height(x: Vector, of: &[Vector; 3]) -> f64 {
    dot(minus(x, of[0]), normal(of))
}

/// Returns true if an edge of a triangle goes through another one.
fn pierces(one: &[Vector; 3], other: &[Vector; 3]) -> bool {
    let n = normal(other);
    let heights = one.map(|x| height(x, other));
    (0..3).any(|from| {
        let to = (from + 1) % 3;
        let (h, k) = (heights[from], heights[to]);
        if h * k >= 0.0 {
            return false;
        }
        let along = minus(one[to], one[from]);
        let share = times(h / (h - k), along);
        let through = [0, 1, 2].map(|i| one[from][i] + share[i]);
        (0..3).all(|i| {
            let edge = minus(other[(i + 1) % 3], other[i]);
            dot(cross(edge, minus(through, other[i])), n) >= 0.0
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::vtu::Grid;

    #[test]
    fn a_tip_goes_through_what_it_reaches_below() {
        let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let tip = |x: f64, z: f64| [[x, 0.2, z], [x, 0.3, 1.0], [x + 0.1, 0.2, 1.0]];
        assert!(pierces(&tip(0.2, -0.1), &flat));
        assert!(!pierces(&flat, &tip(0.2, -0.1)));
        assert!(!pierces(&tip(0.2, 0.01), &flat));
        assert!(!pierces(&tip(1.2, -0.1), &flat));
    }

    /// Measure of a cube whose upper neighbour comes down to a height.
    fn measure(height: f64, shift: f64) -> f64 {
        let cube = |z: f64, shift: f64| {
            let plan = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            let level = |z: f64| plan.map(|[x, y]| [x + shift, y + 0.5 * shift, z]);
            let points: Vec<Vector> = [level(z), level(z + 1.0)].concat();
            Grid::plain(points, vec![(0..8).collect()])
        };
        let bodies = [("lower", cube(0.0, 0.0)), ("upper", cube(height, shift))];
        let fields = Fields {
            bodies: bodies.into_iter().collect(),
            pairs: Vec::new(),
        };
        let mut findings = Findings::default();
        check(&mut findings, &fields, 1);
        findings.worst["crossing"].measure
    }

    #[test]
    fn cubes_that_cross_are_found_and_those_that_touch_are_not() {
        assert_eq!(measure(1.0, 0.3), 0.0);
        assert_eq!(measure(1.01, 0.0), 0.0);
        for depth in [0.01, 0.2] {
            let found = measure(1.0 - depth, 0.3);
            assert!((found - depth / CROSSING).abs() < 1e-9, "{depth}: {found}");
        }
        assert!(measure(0.5, 0.3) > 1.0);
    }

    #[test]
    fn one_body_through_itself_is_found() {
        // Two separate cubes, as one body.
        let cube = |x: f64| {
            let corner = |i: usize| [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]][i % 4];
            (0..8).map(move |i| {
                let [a, b] = corner(i);
                [x + a, 0.3 * x + b, (i / 4) as f64 + 0.2 * x]
            })
        };
        let points: Vec<Vector> = cube(0.0).chain(cube(0.5)).collect();
        let cells = vec![(0..8).collect(), (8..16).collect()];
        let fields = Fields {
            bodies: [("body", Grid::plain(points, cells))].into_iter().collect(),
            pairs: Vec::new(),
        };
        let mut findings = Findings::default();
        check(&mut findings, &fields, 1);
        assert!(findings.worst["crossing"].measure > 0.5);
    }
}
