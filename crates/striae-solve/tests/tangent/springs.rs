//! Tangents of springs and dashpots between nodes, points of rigid bodies and ground.

use nalgebra::DVector;
use striae_mesh::Vec3;
use striae_model::{
    BodyId, Curve, Freedom, Model, Procedure, RigidId, RigidInertia, RigidMotion, RigidShape,
    RigidSurface, Spring, SpringEnd, SpringLine, SpringRest,
};
use striae_solve::assembly::StepContext;
use striae_verify::{Difference, Random, derivative::directional};

use crate::{
    scene::{Places, Run, block, body, increments, model, rubber, step},
    whole::Whole,
};

/// A block on its side, a rigid body beside it, and springs of all kinds.
fn sprung(procedure: Procedure) -> Model {
    let mesh = block([0.0; 3], [1.0, 1.0, 0.5], [2, 2, 1]).mesh().unwrap();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.bodies[0].density = 1.0;
    let mut rigid = RigidSurface::new("frame", RigidShape::Bare);
    rigid.reference = Vec3::new(2.0, 0.5, 0.3);
    rigid.inertia = Some(RigidInertia::aligned(
        0.5,
        rigid.reference,
        [0.1, 0.12, 0.11],
    ));
    model.rigid_surfaces = vec![rigid];
    model.springs = springs(&model);
    let mut step = step();
    step.procedure = procedure;
    step.increments = increments(0.25, 1e-3);
    step.displacements = vec![
        model.hold("block", "zmin", [Some(0.1), Some(0.0), None]),
        model.hold("block", "xmin", [None, None, Some(0.05)]),
    ];
    step.rigid_motions = vec![RigidMotion {
        surface: RigidId(0),
        coordinates: [Freedom::Free; 6],
        force: Some(Vec3::new(0.02, -0.01, 0.03)),
        torque: Some(Vec3::new(0.01, 0.0, -0.02)),
        curve: Curve::Ramp,
    }];
    model.steps = vec![step];
    model
}

fn springs(model: &Model) -> Vec<Spring> {
    let nodes = |nodes| SpringEnd::Nodes {
        body: BodyId(0),
        nodes,
    };
    let on_block = |x| nodes(vec![model.node_at("block", x)]);
    let on_frame = |x: [f64; 3]| SpringEnd::Rigid {
        rigid: RigidId(0),
        point: x.into(),
    };
    let spring = |a: SpringEnd, line: SpringLine, rest: SpringRest| Spring {
        name: String::new(),
        a,
        line,
        stiffness: 0.3,
        damping: 0.04,
        rest,
    };
    let mut all = vec![
        spring(
            nodes(model.nodes("block", "zmax")),
            SpringLine::ToPoint(Vec3::new(0.4, 0.7, 2.0)),
            SpringRest::Length(1.2),
        ),
        spring(
            nodes(model.nodes("block", "xmax")),
            SpringLine::Along(Vec3::new(0.6, 0.0, 0.8)),
            SpringRest::Preload(0.01),
        ),
        spring(
            on_block([0.0, 0.0, 0.5]),
            SpringLine::To(on_block([1.0, 1.0, 0.0])),
            SpringRest::Slack,
        ),
        spring(
            on_block([1.0, 1.0, 0.5]),
            SpringLine::To(on_frame([2.0, 0.9, 0.6])),
            SpringRest::Preload(0.02),
        ),
    ];
    let anchors = [
        ([2.5, 0.5, 0.3], [3.5, 0.9, 0.2]),
        ([2.0, 1.0, 0.3], [2.1, 2.0, 0.4]),
        ([2.0, 0.5, 0.8], [1.8, 0.4, 1.8]),
        ([2.4, 0.1, 0.5], [2.4, -0.9, 0.9]),
        ([1.9, 0.2, 0.0], [2.9, 0.2, -0.6]),
        ([2.2, 0.8, 0.1], [2.2, 0.0, -0.9]),
    ];
    all.extend(anchors.map(|(on, at)| {
        let line = SpringLine::ToPoint(at.into());
        spring(on_frame(on), line, SpringRest::Preload(0.01))
    }));
    for (number, spring) in all.iter_mut().enumerate() {
        spring.name = format!("spring {number}");
    }
    all
}

/// Asserts the order of the tangent along what is unknown: nodes tied to the frame are not.
fn assert_order(whole: &Whole, tied: &[usize]) {
    let u = whole.unknowns();
    let (residual, tangent) = whole.assembled(&u);
    assert!(residual.norm() < 1e-9, "{:e}", residual.norm());
    for seed in 0..3 {
        let mut direction = Random::new(seed).unit(u.len());
        tied.iter().for_each(|at| direction[*at] = 0.0);
        let mut claimed = DVector::zeros(u.len());
        striae_sparse::LinearOperator::multiply(
            &tangent,
            direction.as_slice(),
            claimed.as_mut_slice(),
        );
        let residual = |u: &DVector<f64>| whole.assembled(u).0;
        let order = directional(Difference::Central, residual, &claimed, &u, &direction);
        order.unwrap_or_else(|wrong| panic!("{wrong}"));
    }
}

#[test]
fn of_springs_and_dashpots() {
    let dynamic = Procedure::Dynamic {
        spectral_radius: 0.8,
    };
    for procedure in [Procedure::QuasiStatic, dynamic] {
        let run = Run::completed(sprung(procedure));
        let context = StepContext::new(&run.problem, 0, &run.states[0]);
        let [before, state] = [&run.states[2], &run.states[3]];
        let mut whole = Whole::new(&context, before, state);
        whole.imposed = context.imposed_after(before, state.time, state.time);
        let tied = run.problem.tied.iter().flatten();
        let unknowns = tied.flat_map(|node| {
            let first = whole.layout.position(*node);
            first..first + 3
        });
        assert_order(&whole, &unknowns.collect::<Vec<_>>());
    }
}

/// The work of all forces is found in the energies, to the residual that is left.
#[test]
fn energies_balance() {
    let dynamic = Procedure::Dynamic {
        spectral_radius: 0.8,
    };
    for procedure in [Procedure::QuasiStatic, dynamic] {
        let run = Run::completed(sprung(procedure));
        let energies = run.last().energies;
        assert!(energies.inelastic > 1e-5, "{energies:?}");
        let scale = energies.strain.abs() + energies.external.abs();
        assert!(energies.imbalance().abs() < 1e-9 * scale, "{energies:?}");
    }
}
