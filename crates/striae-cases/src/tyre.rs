//! Common parts of the cases of the tyre: meshes, measures and panels.

use std::f64::consts::FRAC_1_SQRT_2;

use striae_contact::side::Side;
use striae_figure::{Axis, Color, Content, Panel, Series};
use striae_mesh::Vec3;
use striae_solve::state::State;

use super::{
    measure::{MeasuredNode, facets, surface_nodes_in},
    study::{Extent, Run, Study},
};
use crate::failure::Failure;
use striae_deck::Deck;

/// Elements along radius, circumference and axis in the decks and for a quick look,
/// of tyres that are refined at the road, and of those that roll.
const DIVISIONS: [[&str; 2]; 2] = [
    ["divisions = [4, 64, 6]", "divisions = [3, 40, 4]"],
    ["divisions = [4, 90, 6]", "divisions = [3, 60, 4]"],
];
/// Constants of the friction of the decks.
const CONSTANTS: [f64; 3] = [0.1, 0.1, 0.5];

/// A deck of the tyre, coarse for a quick look.
pub fn deck(study: &Study, name: &str, text: &str) -> Result<Deck, Failure> {
    match study.extent {
        Extent::Full => study.deck(name, text),
        Extent::Quick => {
            let coarser = |text: String, [fine, coarse]: &[&str; 2]| text.replace(fine, coarse);
            study.deck(name, &DIVISIONS.iter().fold(text.to_owned(), coarser))
        }
    }
}

/// `w(d)` of the friction of the decks, `a` and `b` the structural vectors of both
/// sides as seen from the tyre.
pub fn friction(a: Vec3, b: Vec3, d: Vec3) -> Vec3 {
    let [c_mag, c_ang, c_cen] = CONSTANTS;
    let (sum, i0) = (a + b, a.dot(&b));
    d * (1.0 + c_mag * i0) + sum * (c_ang * (1.0 + i0) * (c_cen + sum.dot(&d)))
}

/// Structural vector of the tyre where it touches, its grooves along the circumference.
pub const TREAD: Vec3 = Vec3::new(0.0, 1.0, 0.0);
/// Structural vectors of the road as seen from the tyre, 45 and 135 degrees from it.
pub const ROADS: [Vec3; 2] = [
    Vec3::new(FRAC_1_SQRT_2, FRAC_1_SQRT_2, 0.0),
    Vec3::new(FRAC_1_SQRT_2, -FRAC_1_SQRT_2, 0.0),
];

/// The unit vector at an angle to the travel, in degrees.
fn along(degrees: f64) -> Vec3 {
    let angle = degrees.to_radians();
    Vec3::new(angle.cos(), angle.sin(), 0.0)
}

/// The angle in degrees to the travel at which the sliding tyre feels no lateral
/// force, with scales 45 degrees apart.
pub fn drift() -> f64 {
    let (mut low, mut high) = (-45.0, 45.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if friction(TREAD, ROADS[0], along(middle)).y < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Area that belongs to each node of the tread in a state.
pub fn areas(run: &Run, state: &State) -> Vec<f64> {
    let corners = facets(run, Side::A);
    let mut areas = vec![0.0; state.pairs[0].nodes[0].len()];
    for (facet, forces) in &state.pairs[0].facets[0] {
        for (corner, area) in corners[facet.index()].iter().zip(forces.area) {
            areas[*corner] += area;
        }
    }
    areas
}

/// Judges what holds in every run with inertia: balance of energy over the
/// external work, dissipation in every increment over that of the whole run.
pub fn account(study: &mut Study, run: &Run) {
    let imbalance = run.largest("energy.imbalance") / run.largest("energy.external");
    study.measured("energy.imbalance", imbalance);
    let dissipated = run.column("energy.friction");
    let steps = dissipated.windows(2).map(|pair| pair[1] - pair[0]);
    let least = steps.fold(f64::INFINITY, f64::min);
    study.measured("dissipation.least", least / run.largest("energy.friction"));
}

/// Side of the tyre in some states, seen along its axis.
pub fn shapes(run: &Run, states: &[&State], x: Axis) -> Panel {
    let problem = &run.finished.problem;
    let mesh = &problem.model.bodies[0].mesh;
    let side = mesh.facet_sets.get("ymin").unwrap_or_default();
    let colors = [Color::Grey, Color::Blue, Color::Green, Color::Vermillion];
    let mut panel = Panel::plane(x, Axis::linear("z", "m").within(-0.65, 0.55));
    for (state, color) in states.iter().zip(colors) {
        let mut points = Vec::new();
        for face in side {
            let nodes = mesh.face_nodes(*face);
            for corner in [0, 1, 2, 3, 0] {
                let x = state.positions[problem.node(0, nodes[corner])];
                points.push([x.x, x.z]);
            }
            points.push([f64::NAN; 2]);
        }
        panel = panel.with(Series::new("", Content::line(points)).colored(color));
    }
    panel.with(
        Series::new("road", Content::line(vec![[-0.7, -0.5], [1.6, -0.5]])).colored(Color::Black),
    )
}

/// Mean pressure around the nodes of the tread where it touches, seen from above.
pub fn pressures(run: &Run, state: &State) -> Panel {
    let nodes = surface_nodes_in(run, state, Side::A);
    let mut polygons = Vec::new();
    let mut values = Vec::new();
    for facet in facets(run, Side::A) {
        let corners = facet.map(|corner| &nodes[corner]);
        if corners.iter().any(|node| node.result.pressure > 0.0) {
            for (i, j) in (0..4).flat_map(|i| (0..4).map(move |j| (f64::from(i), f64::from(j)))) {
                let ring = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
                let at = |a: f64, b: f64| interpolated(&corners, 0.25 * (i + a), 0.25 * (j + b));
                polygons.push(ring.map(|(a, b)| at(a, b)).map(|[x, y, _]| [x, y]).to_vec());
                values.push(at(0.5, 0.5)[2]);
            }
        }
    }
    let largest = values.iter().copied().fold(0.0, f64::max);
    let bar = Axis::linear("pressure", "MPa").within(0.0, largest);
    let map = Content::Facets {
        polygons,
        values,
        bar,
    };
    let [x, y] = patch_axes(&nodes);
    Panel::plane(x, y)
        .titled("pressure")
        .with(Series::new("", map))
}

fn interpolated(corners: &[&MeasuredNode; 4], s: f64, t: f64) -> [f64; 3] {
    let weights = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
    let pairs = weights.into_iter().zip(corners);
    pairs.fold([0.0; 3], |[x, y, p], (w, node)| {
        [
            x + w * node.position.x,
            y + w * node.position.y,
            p + w * node.result.mean_pressure(),
        ]
    })
}

/// Axes around the patch.
fn patch_axes(nodes: &[MeasuredNode]) -> [Axis; 2] {
    let touching = || nodes.iter().filter(|node| node.result.pressure > 0.0);
    ["x", "y"].map(|label| {
        let of = |node: &MeasuredNode| {
            if label == "x" {
                node.position.x
            } else {
                node.position.y
            }
        };
        let low = touching().map(of).fold(f64::INFINITY, f64::min);
        let high = touching().map(of).fold(f64::NEG_INFINITY, f64::max);
        Axis::linear(label, "m").within(low - 0.06, high + 0.12)
    })
}

/// Friction on the tread and slip in the last increment, seen from above.
pub fn arrows(run: &Run, state: &State) -> Panel {
    let nodes = surface_nodes_in(run, state, Side::A);
    let touching: Vec<&MeasuredNode> = nodes
        .iter()
        .filter(|node| node.result.pressure > 0.0)
        .collect();
    let arrows = |vector: fn(&MeasuredNode) -> Vec3, unit: &str| Content::Arrows {
        origins: touching
            .iter()
            .map(|n| [n.position.x, n.position.y])
            .collect(),
        vectors: touching
            .iter()
            .map(|n| vector(n))
            .map(|v| [v.x, v.y])
            .collect(),
        unit: unit.into(),
    };
    let [x, y] = patch_axes(&nodes);
    Panel::plane(x, y)
        .titled("friction and slip")
        .with(Series::new("slip", arrows(|node| node.result.slip, "m")).colored(Color::Blue))
        .with(
            Series::new("friction", arrows(|node| node.result.tau, "MPa"))
                .colored(Color::Vermillion),
        )
}
