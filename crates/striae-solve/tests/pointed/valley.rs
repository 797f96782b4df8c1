//! Rigid points below the edges and nodes of a face that dips towards them.

use striae_contact::{
    configuration::Configuration,
    pointed::{Bend, Pierced, Progress, choice::points, pierced},
    selection::{Before, Kept, Selection},
    side::Side,
    spot::Spot,
    tip::{RigidPoint, RigidPoints, Tip},
    unknowns::NodeResult,
};
use striae_law::friction::Friction;
use striae_mesh::Vec3;
use striae_solve::{assembly::StepContext, model::Model, problem::Problem, state::State};
use striae_surface::{node::SurfaceNode, scalar::combination};

use crate::scene::{Floor, TOP, moved, standing, tilted};

/// Size of the facets of a block with four divisions.
const SIZE: f64 = 0.288_675;
/// The vertex that is the top of the floor.
const VERTEX: SurfaceNode = SurfaceNode(4);

/// A block whose sole has an edge over the top of a floor.
fn block(floor: Floor) -> Model {
    let mut upper = tilted(0.0, 4);
    upper.origin.x += TOP - 0.25;
    let friction = Friction::coulomb(0.3).unwrap();
    let mut model = standing(upper, &["zmin"], floor, friction);
    model.steps = vec![moved(&model, [0.0; 3], 1)];
    model
}

/// The pair of the block where every node of its sole is moved by some way.
fn shaped<'a>(context: &'a StepContext<'a>, way: impl Fn(&Vec3) -> Vec3) -> Configuration<'a> {
    let start = &context.start.positions;
    let positions: Vec<Vec3> = start.iter().map(|x| x + way(x)).collect();
    context.configuration(0, &positions, &context.start.rigid)
}

/// Place, gap and normal of the top of the floor.
fn seen(configuration: &Configuration) -> (Vec3, f64, Vec3) {
    let spot = Spot::new(configuration, Tip::Rigid(RigidPoint::vertex(VERTEX))).unwrap();
    let facet = spot.hit.unwrap().facet;
    let x = configuration.side(Side::A).corner_positions(facet);
    let weights = spot.opposing.unwrap().weights;
    (combination(&weights, &x), spot.gap.value, spot.ray.value)
}

/// The largest changes of place and gap as the sole, `z = slope . |x - x_0| - depth` and
/// warped, is moved along a line, for the length of a step, and how often the place is
/// on an edge or node.
fn passed(slope: [f64; 2], y: f64, depth: f64) -> ([f64; 2], usize) {
    const STEP: f64 = 1e-4;
    let problem = Problem::new(block(Floor::Pyramid)).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    let at = |step: i32| {
        let along = Vec3::new(0.8, 0.6, 0.0) * (STEP * f64::from(step));
        let sole = shaped(&context, |x| {
            let [dx, dy] = [x.x - TOP, x.y - y];
            let z = -slope[0] * dx.abs() - slope[1] * dy.abs() + 0.1 * dx * dy;
            along - Vec3::new(0.0, y, depth - z)
        });
        seen(&sole)
    };
    let mut largest = [0.0_f64; 2];
    let mut between = 0;
    let mut before = at(-300);
    for step in -299..=300 {
        let now = at(step);
        let changes = [(now.0 - before.0).norm(), (now.1 - before.1).abs()];
        for (largest, change) in largest.iter_mut().zip(changes) {
            *largest = largest.max(change / STEP);
        }
        // Along the normal of a facet neither would turn.
        between += usize::from((now.2 - before.2).norm() > 0.1 * STEP);
        before = now;
    }
    (largest, between)
}

#[test]
fn place_and_gap_go_over_edges_and_nodes_without_a_jump() {
    let edge = ([0.3, 0.0], 0.0);
    let node = ([0.3, 0.2], 1.0 / 6.0);
    for (slope, y) in [edge, node] {
        let ([place, gap], between) = passed(slope, y, 0.04);
        // The wedge at this depth is 0.04 * 0.6 wide.
        assert!(between > 100, "{slope:?}: {between}");
        assert!(place < 1.5, "{slope:?}: {place}");
        assert!(gap < 0.5, "{slope:?}: {gap}");
    }
}

#[test]
fn a_deep_point_between_facets_is_at_its_distance_from_their_edge() {
    let problem = Problem::new(block(Floor::Pyramid)).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    for (across, depth) in [(0.0, 0.1), (0.02, 0.1), (-0.02, 0.15)] {
        let sole = shaped(&context, |x| {
            Vec3::new(across, 0.0, -0.5 * (x.x - TOP).abs() - depth)
        });
        let (place, gap, normal) = seen(&sole);
        let bottom = Vec3::new(TOP + across, 0.0, -depth);
        let to_bottom = bottom - Vec3::x() * TOP;
        assert!((place - bottom).norm() < 1e-12, "{place}");
        assert!((gap + to_bottom.norm()).abs() < 1e-12, "{gap}");
        assert!((normal + to_bottom / to_bottom.norm()).norm() < 1e-12);
    }
}

/// Results of a pair in which nothing presses, of its nodes and of the field.
fn nothing(problem: &Problem) -> ([Vec<NodeResult>; 2], [Vec<[f64; 3]>; 2]) {
    let [a, b] = problem.pairs[0].contact.carriers();
    (
        [a, b].map(|count| vec![NodeResult::default(); count]),
        [a, b].map(|count| vec![[0.0; 3]; count]),
    )
}

/// What pierces the sole at a depth, with some of the ends of the edge over the top pointed.
fn found(context: &StepContext, depth: f64, ends: &[f64]) -> Pierced {
    let sole = shaped(context, |_| -Vec3::z() * depth);
    let none: Kept = context.start.pairs[0].kept.clone();
    let mut pointed = none.clone();
    for (node, x) in sole.side(Side::A).x.iter().enumerate() {
        let is_end = |y: &f64| (x.x - TOP).hypot(x.y - y) < 1e-9;
        pointed[0][node] = ends.iter().any(is_end);
    }
    let before = Before {
        kept: &none,
        required: &none,
        pointed: &pointed,
        points: &Vec::new(),
    };
    let selection = Selection::new(&sole, None, before, &context.fixed_on_pair[0]);
    assert_eq!(selection.pointed_places().len(), ends.len());
    let (_, carried) = nothing(context.problem);
    pierced(
        &sole,
        &selection,
        &carried,
        Bend::Blunt,
        Progress::Iterating,
    )
}

#[test]
fn a_point_on_an_edge_between_two_pointed_nodes_is_left_to_them() {
    let problem = Problem::new(block(Floor::Pyramid)).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    let ends = [-1.0 / 6.0, 1.0 / 6.0];
    let lefts = |depth: f64, ends: &[f64]| -> Vec<f64> {
        let points = found(&context, depth * SIZE, ends).points;
        points.iter().map(|(_, point)| point.left / SIZE).collect()
    };
    assert_eq!(lefts(0.03, &[]), [0.0]);
    assert_eq!(lefts(0.03, &ends[..1]), [0.0]);
    assert!(lefts(0.03, &ends).is_empty());
    let deep = lefts(0.09, &ends);
    assert!(deep.len() == 1 && (deep[0] - 0.07).abs() < 1e-6, "{deep:?}");
}

#[test]
fn a_point_leaves_to_what_the_field_carries() {
    let problem = Problem::new(block(Floor::Hill)).unwrap();
    let start = State::undeformed(&problem);
    let context = StepContext::new(&problem, 0, &start);
    // The facet over the top is closed in the mean, or all but that.
    let sole = shaped(&context, |_| Vec3::new(0.125, 0.0, -0.012));
    let (mut nodes, mut carried) = nothing(&problem);
    let mut lodged: RigidPoints = vec![None; nodes[1].len()];
    let at = |node: &SurfaceNode| (sole.side(Side::A).x[*node] - Vec3::x() * TOP).norm();
    let near = SurfaceNode::all(sole.side(Side::A).x.len());
    let home = near.min_by(|a, b| at(a).total_cmp(&at(b))).unwrap();
    lodged[home] = Some(RigidPoint::vertex(VERTEX));
    nodes[1][home].pressure = 0.3;
    assert_eq!(points::staying(&sole, &lodged, &nodes, &carried).len(), 1);
    carried[0][home][0] = 0.3;
    assert!(points::staying(&sole, &lodged, &nodes, &carried).is_empty());
}
