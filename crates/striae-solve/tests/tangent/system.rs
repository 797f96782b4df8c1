//! Tangent of the whole system under all kinds of loads: the error of central
//! differences falls with the square of the step.

use nalgebra::Matrix3;
use striae_contact::slip_freedom::SlipFreedom;
use striae_contact::unknowns::Status;
use striae_law::friction::Friction;
use striae_mesh::{CellKind, Vec3};
use striae_model::{
    Actuation, ActuationKind, Axes, BodyId, Curve, Formulation, Freedom, LoadExtent, LoadKind,
    Model, Procedure, RigidId, RigidMotion,
};
use striae_solve::{
    assembly::StepContext,
    newton::{Workspace, advance},
    problem::Problem,
    state::State,
};

use crate::{
    placed::{bumps, dome, on_rigid, two_blocks, two_blocks_of},
    scene::{Places, Run, coulomb, increments, plane, step},
    whole::Whole,
};

#[test]
fn of_the_whole_system_under_all_loads() {
    let hexahedra = two_blocks([2.0, 1.0], [3, 3], Friction::frictionless());
    assert_order(under_all_loads(hexahedra));
}

#[test]
fn of_parts_of_triangles_under_all_loads() {
    let cells = [CellKind::CompositeTetrahedron, CellKind::Wedge];
    let model = two_blocks_of(cells, [2.0, 1.0], [1, 2], Friction::frictionless());
    assert_order(under_all_loads(model));
}

#[test]
fn of_bodies_that_move_themselves_under_all_loads() {
    let hexahedra = two_blocks([2.0, 1.0], [2, 3], coulomb(0.3));
    let cells = [CellKind::CompositeTetrahedron, CellKind::Wedge];
    let mixed = two_blocks_of(cells, [2.0, 1.0], [1, 2], coulomb(0.3));
    for (model, formulation) in [
        (hexahedra.clone(), Formulation::Standard),
        (hexahedra.clone(), Formulation::MeanDilatation),
        (hexahedra, Formulation::AssumedStrain),
        (mixed, Formulation::Standard),
    ] {
        let mut model = under_all_loads(model);
        for body in &mut model.bodies {
            body.formulation = formulation;
        }
        // Bent this way the blocks touch all over; where supports are open in part, a point that
        // opens between two steps of the differences hides their order.
        let strain = Matrix3::new(-0.03, -0.01, 0.0, -0.01, 0.02, -0.02, 0.0, -0.02, -0.01);
        let along = Vec3::new(1.0, 2.0, -2.0) / 3.0;
        let kinds = [
            ActuationKind::Strain(strain),
            ActuationKind::Tension { along, value: 0.05 },
        ];
        let of_body = |body: usize| {
            kinds.map(|kind| Actuation {
                body: BodyId(body),
                section: None,
                kind,
                curve: Curve::Ramp,
            })
        };
        model.steps[0].actuations = [0, 1].into_iter().flat_map(of_body).collect();
        assert_order(model);
    }
}

#[test]
fn of_nodes_that_are_prescribed_in_axes_of_their_own() {
    let skew = Axes::Skew {
        x: Vec3::new(1.0, 0.2, 0.3),
        y: Vec3::new(0.0, 1.0, -0.4),
    };
    for friction in [Friction::frictionless(), coulomb(0.3)] {
        let mut model = under_all_loads(two_blocks([2.0, 1.0], [2, 3], friction));
        let step = &mut model.steps[0];
        step.displacements[1].axes = skew;
        let mut side = step.displacements[0].clone();
        side.nodes = model.bodies[0].mesh.node_sets.get("xmin").unwrap().to_vec();
        side.nodes
            .retain(|node| model.bodies[0].mesh.positions[node.index()].z > 1e-9);
        side.axes = Axes::Normal(Vec3::new(1.0, 0.3, -0.2));
        side.components = [Some(0.005.into()), None, None];
        step.displacements.push(side);
        let is_frictionless = model.pairs[0].friction.is_frictionless();
        assert_order(model.clone());
        if !is_frictionless {
            continue;
        }
        // With inertia, half-way, where contact begins: friction has kinks close by.
        model.bodies.iter_mut().for_each(|body| body.density = 1.0);
        model.steps[0].procedure = Procedure::Dynamic {
            spectral_radius: 0.8,
        };
        model.steps[0].increments = increments(0.25, 1e-3);
        let run = Run::of(model);
        let context = StepContext::new(&run.problem, 0, &run.states[0]);
        let [before, state] = [&run.states[1], &run.states[2]];
        let mut whole = Whole::new(&context, before, state);
        whole.imposed = context.imposed_after(before, state.time, state.time);
        whole.assert_order();
    }
}

/// A block is drawn by one of its ends. All nodes slip along their friction, so that the rows of
/// driven nodes hold at all of them.
#[test]
fn of_nodes_that_are_driven() {
    let mut model = on_rigid(plane([0.0; 3], [0.0, 0.0, 1.0]));
    let mut step = step();
    step.displacements = vec![
        model.hold("block", "xmin", [Some(-0.3), Some(0.05), None]),
        model.hold("block", "zmax", [None, None, Some(-0.05)]),
    ];
    model.steps = vec![step];
    let run = Run::completed(model);
    let [.., before, last] = &run.states[..] else {
        panic!("no increment");
    };
    let context = StepContext::new(&run.problem, 0, &run.states[0]);
    let mut whole = Whole::new(&context, before, last);
    whole.let_slip(SlipFreedom::Driven);
    let (residual, _) = whole.assembled(&whole.unknowns());
    assert!(residual.norm() < 1e-9);
    whole.assert_order();
}

/// Friction follows that of other nodes, where it is turned along and where it is remembered.
#[test]
fn of_nodes_whose_friction_follows() {
    let mut model = two_blocks([2.0, 1.0], [3, 2], coulomb(5.0));
    let mut step = step();
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.02), Some(0.01), Some(-0.05)]),
    ];
    step.increments = increments(0.5, 1e-3);
    model.steps = vec![step];
    let run = Run::completed(model);
    let [.., before, last] = &run.states[..] else {
        panic!("no increment");
    };
    let context = StepContext::new(&run.problem, 0, &run.states[0]);
    let mut whole = Whole::new(&context, before, last);
    let at = whole.unknowns();
    let (without, _) = whole.assembled(&at);
    whole.let_follow();
    let (with, _) = whole.assembled(&at);
    assert!((with - without).amax() > 1e-6);
    whole.assert_order();
}

/// Two blocks that are held and loaded in all ways.
fn under_all_loads(mut model: Model) -> Model {
    let mut step = step();
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "xmax", [Some(0.01), Some(0.0), None]),
    ];
    let follower = LoadKind::FollowerTraction(Vec3::new(0.01, 0.0, -0.02));
    step.loads = vec![
        model.load(
            "upper",
            "zmax",
            LoadKind::DeadTraction(Vec3::new(0.0, 0.01, -0.03)),
            LoadExtent::Whole,
        ),
        model.load("upper", "ymin", follower, LoadExtent::Whole),
        model.load(
            "upper",
            "zmin",
            LoadKind::Pressure(0.03),
            LoadExtent::Exposed,
        ),
        model.load(
            "lower",
            "zmax",
            LoadKind::Pressure(0.05),
            LoadExtent::Exposed,
        ),
        model.load("lower", "zmax", follower, LoadExtent::Exposed),
        model.load("lower", "xmin", LoadKind::Pressure(0.02), LoadExtent::Whole),
    ];
    model.steps = vec![step];
    model
}

#[test]
fn of_a_rigid_body_that_contact_pushes_under_loads() {
    let flat = plane([0.0; 3], [0.0, 0.0, 1.0]);
    let cases = [
        (dome(4), Friction::frictionless(), Status::Slip),
        (bumps(4, 0.02), coulomb(5.0), Status::Stick),
        (dome(4), coulomb(0.3), Status::Slip),
        (flat, coulomb(0.4), Status::Slip),
    ];
    for (shape, friction, status) in cases {
        let mut model = on_rigid(shape);
        model.pairs[0].friction = friction;
        let mut first = step();
        first.displacements = vec![model.hold("block", "zmax", [Some(0.0); 3])];
        let mut motion = RigidMotion {
            surface: RigidId(0),
            coordinates: [0.02, 0.01, 0.061, 0.03, -0.04, 0.2].map(Freedom::To),
            force: None,
            torque: None,
            curve: Curve::Ramp,
        };
        first.rigid_motions = vec![motion.clone()];
        first.loads = vec![
            model.load(
                "block",
                "zmin",
                LoadKind::Pressure(0.03),
                LoadExtent::Exposed,
            ),
            model.load(
                "block",
                "zmin",
                LoadKind::DeadTraction(Vec3::new(0.0, 0.01, -0.01)),
                LoadExtent::Exposed,
            ),
        ];
        // The step at whose end the system is looked at; nothing moves in it.
        let mut second = step();
        motion.coordinates = [Freedom::AsBefore; 6];
        motion.coordinates[1..].fill(Freedom::Free);
        second.rigid_motions = vec![motion];
        model.steps = vec![first, second];
        let problem = Problem::new(model).unwrap();
        let start = State::undeformed(&problem);
        let states = after_first(&problem, &start);
        let [before, state] = &states;
        let context = StepContext::new(&problem, 1, &start);
        let mut whole = Whole::new(&context, before, state);
        // Turns of the body compose from where the increment began.
        whole.imposed = context.imposed_after(before, 1.0, state.time);
        assert!(whole.layout.rigid(0).is_some());
        let found = state.pairs[0]
            .nodes
            .iter()
            .flatten()
            .map(|node| node.status);
        let found: Vec<Status> = found.filter(|found| *found != Status::Open).collect();
        assert!(found.contains(&status), "{found:?}");
        whole.assert_order_at(whole.settled());
    }
}

/// A block and a rigid body, or another block, before they touch and while they do.
#[test]
fn of_stabilised_pairs() {
    for gap in [0.3, 0.0] {
        let mut blocks = two_blocks([2.0, 1.0], [3, 3], coulomb(0.3));
        let upper = blocks.body("upper");
        let positions = blocks.bodies[upper].mesh.positions.iter_mut();
        positions.for_each(|x| x.z += gap);
        let mut held = step();
        held.displacements = vec![
            blocks.hold("lower", "zmin", [Some(0.0); 3]),
            blocks.hold("upper", "zmax", [Some(0.01), Some(0.0), Some(-0.01)]),
        ];
        held.increments = increments(0.25, 1e-3);
        blocks.steps = vec![held];
        let mut rigid = on_rigid(dome(4));
        let mut lowered = step();
        lowered.displacements = vec![rigid.hold("block", "zmax", [Some(0.0); 3])];
        lowered.rigid_motions = vec![RigidMotion {
            surface: RigidId(0),
            coordinates: [
                Freedom::To(0.02),
                Freedom::To(0.01),
                Freedom::To(0.06 - gap),
                Freedom::To(0.03),
                Freedom::Free,
                Freedom::Free,
            ],
            force: None,
            torque: Some(Vec3::new(0.0, 1e-5, -1e-5)),
            curve: Curve::Ramp,
        }];
        lowered.increments = increments(0.25, 1e-3);
        rigid.steps = vec![lowered];
        for mut model in [blocks, rigid] {
            model.pairs[0].stabilised = true;
            let run = Run::of(model);
            let start = State::undeformed(&run.problem);
            let context = StepContext::new(&run.problem, 0, &start);
            // By time, as sizes of increments follow the iterations. Corners of the one mesh have
            // left edges of the other by then, and no unknowns are chosen within the increment.
            let late = run.states.iter().position(|state| state.time >= 0.2);
            let at = late.expect("the run comes that far");
            let [before, state] = [&run.states[at - 1], &run.states[at]];
            let mut whole = Whole::new(&context, before, state);
            whole.imposed = context.imposed_after(before, state.time, state.time);
            assert!(whole.imposed.dashpots.iter().any(|pair| !pair.is_empty()));
            let (residual, _) = whole.assembled(&whole.unknowns());
            assert!(residual.norm() < 1e-9, "{:e}", residual.norm());
            whole.assert_order();
            if whole.layout.moves_no_body() {
                whole.assert_order_of_contact();
            }
        }
    }
}

/// States at half the first step and at its end.
fn after_first(problem: &Problem, start: &State) -> [State; 2] {
    let context = StepContext::new(problem, 0, start);
    let mut workspace = Workspace::new(problem.model.solver.backend);
    let mut state = start.clone();
    [0.5, 1.0].map(|s| {
        let increment = advance(&context, &state, s, s, &mut workspace, &mut ());
        state = increment.unwrap_or_else(|cut| panic!("{cut}")).state;
        state.clone()
    })
}

/// Asserts the order at the end of a model of one step.
fn assert_order(model: Model) {
    let run = Run::completed(model);
    let start = State::undeformed(&run.problem);
    let context = StepContext::new(&run.problem, 0, &start);
    let [.., before, last] = &run.states[..] else {
        panic!("no increment");
    };
    let whole = Whole::new(&context, before, last);
    let (residual, _) = whole.assembled(&whole.unknowns());
    assert!(residual.norm() < 1e-9);
    whole.assert_order();
    if whole.layout.moves_no_body() {
        whole.assert_order_of_contact();
    }
}
