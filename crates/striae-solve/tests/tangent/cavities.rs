//! Tangents of cavities with all contents.

use striae_mesh::{CellBlock, CellKind, Mesh};
use striae_model::{
    BodyId, Cavity, CavityContent, CavityFilling, CavityId, Curve, Model, Procedure,
};
use striae_solve::assembly::StepContext;

use crate::{
    scene::{Places, Run, block, body, increments, model, rubber, step},
    whole::Whole,
};

/// An irregular block without the element in its middle, that is sheared.
fn hollow(procedure: Procedure, content: CavityContent) -> Model {
    let mut whole = block([0.0; 3], [1.0; 3], [3, 3, 3]);
    whole.irregularity = 0.15;
    let whole = whole.mesh().unwrap();
    let cells = whole.elements().enumerate().filter(|(at, _)| *at != 13);
    let nodes = cells.flat_map(|(_, corners)| corners.to_vec()).collect();
    let inner = whole.corners(striae_mesh::ElementId(13)).to_vec();
    let kind = CellKind::Hexahedron;
    let blocks = vec![CellBlock { kind, nodes }];
    let mut mesh = Mesh::new(whole.positions.clone(), blocks).unwrap();
    for (name, nodes) in whole.node_sets.iter() {
        mesh.node_sets.insert(name, nodes.to_vec());
    }
    let faces = mesh.boundary_faces().into_iter();
    let is_inner = |face: &striae_mesh::Face| {
        let corners = mesh.face_nodes(*face);
        corners.iter().all(|corner| inner.contains(corner))
    };
    let inside = faces.filter(is_inner).collect();
    let mut model = model(vec![body("block", mesh, rubber(1.0, 0.3))]);
    model.bodies[0].density = 1.0;
    model.cavities = vec![Cavity {
        name: "hole".to_owned(),
        parts: vec![(BodyId(0), inside)],
    }];
    let mut step = step();
    step.procedure = procedure;
    step.increments = increments(0.25, 1e-3);
    step.displacements = vec![
        model.hold("block", "zmin", [Some(0.0); 3]),
        model.hold("block", "zmax", [Some(0.1), None, Some(-0.05)]),
    ];
    step.fillings = vec![CavityFilling {
        cavity: CavityId(0),
        content,
        curve: Curve::Ramp,
    }];
    model.steps = vec![step];
    model
}

#[test]
fn of_cavities() {
    let dynamic = Procedure::Dynamic {
        spectral_radius: 0.8,
    };
    let gas = CavityContent::Gas {
        ambient: 0.3,
        exponent: 1.4,
    };
    for (procedure, content) in [
        (Procedure::QuasiStatic, CavityContent::Pressure(0.1)),
        (Procedure::QuasiStatic, CavityContent::VolumeRatio(1.3)),
        (Procedure::QuasiStatic, gas),
        (dynamic, gas),
    ] {
        let run = Run::completed(hollow(procedure, content));
        let context = StepContext::new(&run.problem, 0, &run.states[0]);
        let [before, state] = [&run.states[2], &run.states[3]];
        assert!(state.pressures[0].abs() > 1e-3, "{:?}", state.pressures);
        let mut whole = Whole::new(&context, before, state);
        whole.imposed = context.imposed_after(before, state.time, state.time);
        let (residual, _) = whole.assembled(&whole.unknowns());
        assert!(residual.norm() < 1e-9, "{:e}", residual.norm());
        whole.assert_order();
    }
}
