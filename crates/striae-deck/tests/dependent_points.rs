//! Points of a rigid surface whose places depend on each other.

use std::path::Path;

use striae_contact::evaluation::Evaluation;
use striae_deck::parse;
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    report::pairs,
    state::State,
};

/// Vertices of the floor along each axis, and their distance.
const VERTICES: usize = 16;
const SPACING: f64 = 0.167_531_788_236_873_2;
/// Where the floor begins, and its highest place.
const CORNER: [f64; 3] = [
    -0.697_095_554_884_031_6,
    -1.295_861_765_884_647_2,
    -0.810_160_284_110_576_7,
];
/// Depth of a groove; grooves along both axes add up.
const DEPTH: f64 = 0.012_758_242_879_321_2;

/// A floor of square bumps between grooves, in triangles.
fn floor() -> String {
    let groove = |at: usize| if matches!(at % 4, 1 | 2) { DEPTH } else { 0.0 };
    let mut positions = String::new();
    let mut facets = String::new();
    for i in 0..VERTICES {
        for j in 0..VERTICES {
            let [x, y] = [
                CORNER[0] + i as f64 * SPACING,
                CORNER[1] + j as f64 * SPACING,
            ];
            let z = CORNER[2] - groove(i) - groove(j);
            positions += &format!("[{x:?}, {y:?}, {z:?}], ");
            if i + 1 < VERTICES && j + 1 < VERTICES {
                let a = i * VERTICES + j;
                let [b, c, d] = [a + VERTICES, a + VERTICES + 1, a + 1];
                facets += &format!("[{a}, {b}, {c}, {c}], [{a}, {c}, {d}, {d}], ");
            }
        }
    }
    format!("positions = [{positions}]\nfacets = [{facets}]")
}

/// A block whose face is coarser than the bumps. Half of the way down, two points are on two
/// edges of it that meet at a node, and the other ends of both edges are pointed.
fn deck() -> String {
    format!(
        r#"
title = "Block on bumps"
[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1.0
poissons_ratio = 0.3
[[body]]
name = "upper"
material = "solid"
[body.mesh]
generator = "block"
origin = [0.08519472176564258, -0.500971232426977, -0.8048756468779119]
size = [0.9483962702537512, 0.9231957566377594, 0.5436239293121102]
divisions = [4, 2, 4]
grading = {{ x = {{ one_sided = 0.308644592433001 }} }}
[[rigid]]
name = "floor"
[rigid.mesh]
{}
[[pair]]
name = "contact"
a = {{ body = "upper", facets = "zmin" }}
b = {{ rigid = "floor" }}
friction = {{ law = "coulomb", mu = 0.17984886539715322 }}
[[step]]
name = "press"
increments = 16
displacement = [{{ body = "upper", nodes = "zmax", x = 0.0, y = 0.0, z = -0.04081119128390828 }}]
"#,
        floor()
    )
}

/// Counts what was cut back.
#[derive(Default)]
struct Cuts(usize);

impl IterationObserver for Cuts {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Cuts {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, _: &Increment) -> Continue {
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, _: &CutBack) -> Continue {
        self.0 += 1;
        Continue::Yes
    }
}

/// The matrix is singular there unless the points yield in the tangent. What is converged to has
/// gaps of zero at all points in contact all the same, and friction inside the law.
#[test]
fn points_that_state_the_same_place_share_the_force() {
    let model = parse(&deck(), "deck.toml", Path::new("")).unwrap().model;
    let problem = Problem::new(model).unwrap();
    let mut cuts = Cuts::default();
    let (state, ending) = run(&problem, State::undeformed(&problem), &mut cuts);
    assert_eq!(ending, Ending::Completed);
    assert_eq!(cuts.0, 0);
    let contact = &state.pairs[0];
    let points = contact.points.iter().zip(&contact.nodes[1]);
    let pressed: Vec<_> = points
        .filter(|(point, node)| point.is_some_and(|point| point.left == 0.0) && node.pressure > 0.0)
        .collect();
    assert!(pressed.len() >= 4, "{}", pressed.len());
    for (_, node) in pressed {
        assert!(node.gap.abs() < 1e-9, "{:e}", node.gap);
        let cap = 0.179_848_865_397_153_22 * node.pressure;
        assert!(node.tau.norm() <= cap * (1.0 + 1e-9));
    }
    assert!(pairs(&problem, &state)[0].mismatch < 1e-10);
}
