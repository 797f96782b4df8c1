//! Linear systems that are hard for a solver: `Run::completed` holds the answers
//! of the condensed one against those of the multifrontal LU, `Run::iterated` those of
//! the iterative one.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, plane, rubber, step};
use striae_condensed::Method;
use striae_contact::unknowns::{NodeResult, Status};
use striae_law::{bulk::Material, friction::Friction};
use striae_mesh::{
    Vec3,
    generate::{CappedBlock, Half, HalfCylinder},
};
use striae_model::{Backend, LoadExtent, LoadKind, Model};
use striae_solve::{outcome::Ending, repetition::Difference};

/// A block of the given width, `gap` above the middle of a larger one whose bottom is held.
fn blocks([first, second]: [Material; 2], width: f64, gap: f64) -> Model {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [3, 3, 2]).mesh().unwrap();
    let begin = 0.5 * (1.0 - width);
    let upper = block([begin, begin, 0.5 + gap], [width, width, 0.5], [2, 2, 2]);
    let mut model = model(vec![
        body("lower", lower, first),
        body("upper", upper.mesh().unwrap(), second),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.4));
    let mut step = step();
    step.displacements = vec![model.hold("lower", "zmin", [Some(0.0); 3])];
    model.steps = vec![step];
    model
}

/// Run with the upper block's top moved; the iterative solver is compared with the LU, too.
fn pressed(materials: [Material; 2], width: f64, gap: f64, to: [f64; 3]) -> Run {
    let mut model = blocks(materials, width, gap);
    let top = model.hold("upper", "zmax", to.map(Some));
    model.steps[0].displacements.push(top);
    is_iterative(&Run::iterated(model.clone()));
    Run::completed(model)
}

fn is_iterative(run: &Run) {
    for work in &run.work {
        assert_eq!((work.method, work.fall_back), (Method::Iterative, None));
    }
}

/// Nodes under pressure, in a run without fall-backs.
fn touching(run: &Run) -> usize {
    for work in &run.work {
        assert_eq!((work.method, work.fall_back), (Method::Condensed, None));
    }
    let nodes = run.last().pairs[0].nodes.iter().flatten();
    nodes.filter(|node| node.pressure > 0.0).count()
}

#[test]
fn nearly_incompressible_bodies() {
    let soft = rubber(1.0, 0.499);
    let run = pressed([soft.clone(), soft], 0.6, 0.0, [0.002, 0.0, -0.01]);
    assert!(touching(&run) > 0);
}

#[test]
fn steel_on_rubber() {
    for stiffness in [[1e5, 1.0], [1.0, 1e5]] {
        let materials = stiffness.map(|modulus| rubber(modulus, 0.3));
        let run = pressed(materials, 0.6, 0.0, [0.002, 0.0, -0.01]);
        assert!(touching(&run) > 0);
    }
}

#[test]
fn contact_much_smaller_than_an_element() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft.clone(), soft], 0.05, 0.0, [0.0, 0.0, -0.002]);
    assert!(touching(&run) > 0);
}

#[test]
fn contact_comes_to_rest_on_linear_bodies() {
    let mut model = blocks([rubber(1.0, 0.3), rubber(1.0, 0.3)], 0.25, 0.0);
    let finer = block([0.0; 3], [1.0, 1.0, 0.5], [9, 9, 9]).mesh().unwrap();
    model.bodies[0] = body("lower", finer, rubber(1.0, 0.3));
    model.pairs.clear();
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.4));
    let to = [Some(0.01), Some(0.0), Some(-0.01)];
    model.steps[0].displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", to),
    ];
    let mut other = model.clone();
    other.solver.backend = Backend::Multifrontal;
    let iterations = |run: &Run| run.iterations.iter().map(Vec::len).sum::<usize>();
    let (run, other) = (Run::completed(model), Run::of(other));
    let corrections = |run: &Run| {
        run.work
            .iter()
            .map(|w| w.contact_corrections)
            .sum::<usize>()
    };
    assert!(touching(&run) > 0);
    assert!(corrections(&run) > 0 && corrections(&other) == 0);
    assert!(iterations(&run) < iterations(&other));
}

#[test]
fn contact_over_whole_faces() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft.clone(), soft], 1.0, 0.0, [0.002, 0.0, -0.01]);
    assert!(touching(&run) >= 16);
}

/// Iterations of GMRES for an iteration of Newton's method, with the lower of two stacked blocks
/// divided into so many elements along an edge, and the upper one into one less.
fn krylov(n: usize) -> f64 {
    let soft = rubber(1.0, 0.4);
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [n, n, n / 2]);
    let upper = block([0.0, 0.0, 0.5], [1.0, 1.0, 0.5], [n - 1, n - 1, n / 2]);
    let mut model = model(vec![
        body("lower", lower.mesh().unwrap(), soft.clone()),
        body("upper", upper.mesh().unwrap(), soft),
    ]);
    model.touch(("lower", "zmax"), ("upper", "zmin"), coulomb(0.0));
    let mut step = step();
    step.increments = increments(0.5, 1e-3);
    let down = [Some(0.0), Some(0.0), Some(-0.005)];
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", down),
    ];
    model.steps = vec![step];
    model.solver.backend = Backend::Iterative;
    let run = Run::of(model);
    is_iterative(&run);
    // Supports are bedded as open ones while they come into contact.
    let (work, iterations) = (run.work.last(), run.iterations.last());
    let krylov = work.map_or(0, |work| work.krylov_iterations);
    krylov as f64 / iterations.map_or(0, Vec::len) as f64
}

#[test]
fn iterations_of_gmres_hardly_grow_where_meshes_do_not_match() {
    let [coarse, fine] = [10, 22].map(krylov);
    assert!(fine < 1.3 * coarse && fine < 16.0, "{coarse} {fine}");
}

#[test]
fn no_contact_at_all() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft.clone(), soft], 0.6, 1.0, [0.01, 0.0, -0.05]);
    assert_eq!(touching(&run), 0);
}

#[test]
fn a_body_held_by_friction_alone() {
    let soft = rubber(1.0, 0.3);
    let mut model = blocks([soft.clone(), soft], 0.6, 0.0);
    let pull = LoadKind::DeadTraction(Vec3::new(0.001, 0.0, -0.01));
    let load = model.load("upper", "zmax", pull, LoadExtent::Whole);
    model.steps[0].loads = vec![load];
    // The iterative solver may give up on it and say so; the answers are the same.
    for work in Run::iterated(model.clone()).work {
        assert_eq!(work.method == Method::Iterative, work.fall_back.is_none());
    }
    let run = Run::completed(model);
    assert!(touching(&run) > 0);
}

/// Half cylinders between two walls, which hold nodes of both surfaces in `y`: friction along
/// `y` is in no row of momentum there.
fn slices(layers: [usize; 2]) -> Model {
    let half = |half, layers, element_size| HalfCylinder {
        half,
        thickness: 0.4,
        layers,
        element_size,
        fine_half_width: 0.8,
        fine_depth: 0.4,
        growth: 1.6,
        ..HalfCylinder::default()
    };
    let lower = half(Half::Upper, layers[0], 0.2).mesh().unwrap();
    let upper = half(Half::Lower, layers[1], 0.16).mesh().unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(200.0, 0.3)),
        body("upper", upper, rubber(200.0, 0.3)),
    ]);
    model.touch(("lower", "arc"), ("upper", "arc"), coulomb(0.2));
    let walls = |model: &Model| {
        let sides = [
            ("lower", "ymin"),
            ("lower", "ymax"),
            ("upper", "ymin"),
            ("upper", "ymax"),
        ];
        sides.map(|(body, side)| model.hold(body, side, [None, Some(0.0), None]))
    };
    let flats = |model: &Model, x: f64| {
        [
            model.hold("lower", "flat", [Some(0.0), None, Some(0.0)]),
            model.hold("upper", "flat", [Some(x), None, Some(-0.15)]),
        ]
    };
    for x in [0.0, 0.03] {
        let mut step = step();
        step.increments = increments(0.25, 0.2);
        step.displacements.extend(walls(&model));
        step.displacements.extend(flats(&model, x));
        model.steps.push(step);
    }
    model
}

#[test]
fn slices_between_walls() {
    for layers in [[1, 1], [2, 3]] {
        // Some matrices are so near to singular that it falls back on direct solvers.
        Run::iterated(slices(layers));
        let run = Run::completed(slices(layers));
        assert!(run.cuts.is_empty(), "{layers:?}: {:?}", run.cuts);
        assert!(touching(&run) > 0);
        let statuses = |status| {
            let nodes = run.states.iter().flat_map(|state| &state.pairs[0].nodes);
            nodes.flatten().any(|node| node.status == status)
        };
        assert!(statuses(Status::Stick) && statuses(Status::Slip));
    }
}

#[test]
fn differences_are_over_the_largest() {
    let soft = rubber(1.0, 0.3);
    let run = pressed([soft.clone(), soft], 0.6, 0.0, [0.002, 0.0, -0.01]);
    let (state, mut other) = (run.last(), run.last().clone());
    assert_eq!(Difference::between(state, &other), Difference::default());
    let extent = state.positions.iter().map(|x| x.norm()).fold(0.0, f64::max);
    other.positions[3].y += 1e-3 * extent;
    let nodes = other.pairs[0].nodes.iter_mut().flatten();
    let traction = |node: &NodeResult| (node.tau - node.normal * node.pressure).norm();
    let largest = nodes.max_by(|a, b| traction(a).total_cmp(&traction(b)));
    let largest = largest.unwrap();
    largest.tau *= 0.5;
    largest.pressure *= 0.5;
    let difference = Difference::between(state, &other);
    assert!((difference.positions - 1e-3).abs() < 1e-12);
    assert!((difference.tractions - 0.5).abs() < 1e-12);
}

#[test]
fn nodes_that_hardly_touch_hide_no_forces() {
    for backend in [Backend::Condensed, Backend::Iterative] {
        let cap = CappedBlock {
            size: [10.0, 10.0],
            height: 6.5,
            radius: 12.0,
            element_size: 0.6,
            fine_half_width: 1.6,
            fine_depth: 0.5,
            ..CappedBlock::default()
        };
        let solid = body("block", cap.mesh().unwrap(), rubber(1.0, 0.3));
        let mut model = model(vec![solid]);
        let floor = plane([0.0; 3], [0.0, 0.0, 1.0]);
        model.touch_rigid(("block", "cap"), floor, Friction::frictionless());
        let mut press = step();
        press.increments = increments(0.2, 0.01);
        press.displacements =
            vec![model.hold("block", "zmax", [Some(0.0), Some(0.0), Some(-0.15)])];
        model.steps = vec![press];
        model.solver.backend = backend;
        let run = Run::of(model);
        assert_eq!(run.ending, Ending::Completed);
        // Where rows of such nodes decided the end of GMRES, forces fell by half in each of 36.
        let counts: Vec<usize> = run.iterations.iter().map(Vec::len).collect();
        assert!(
            counts.iter().all(|count| *count <= 7),
            "{backend:?} {counts:?}"
        );
    }
}
