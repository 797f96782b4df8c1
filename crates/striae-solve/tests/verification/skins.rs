//! Bodies that pass through themselves, or others that they have no pair with.

use crate::scene::{Places, Run, block, body, coulomb, increments, model, rubber, step};
use striae_contact::interference::SHARE;
use striae_mesh::{CellBlock, Mesh, NodeId, Vec3, generate::Block};
use striae_model::Model;
use striae_solve::{
    newton::InStep,
    outcome::{CutBack, Ending, Remedy, Start},
    warning::{Judgement, Kind, Warning},
};

/// A block with a slit half as high as its lips: `x` beyond 1, `z` from 1 to 1.5.
pub fn jaw() -> Mesh {
    let whole: Block = block([0.0; 3], [5.0, 1.0, 2.5], [10, 2, 5]);
    let mut mesh = whole.mesh().unwrap();
    let is_left = |corners: &&[NodeId]| {
        let sum: Vec3 = corners.iter().map(|n| mesh.positions[n.index()]).sum();
        let centre = sum / 8.0;
        centre.x < 1.0 || (centre.z - 1.25).abs() > 0.25
    };
    let cells: Vec<[NodeId; 8]> = mesh
        .elements()
        .filter(is_left)
        .map(|corners| corners.try_into().unwrap())
        .collect();
    let mut nodes: Vec<NodeId> = cells.iter().flatten().copied().collect();
    nodes.sort_unstable();
    nodes.dedup();
    let number = |node: NodeId| NodeId::new(nodes.binary_search(&node).unwrap());
    let cells = cells.iter().map(|corners| corners.map(number));
    let x = nodes
        .iter()
        .map(|node| mesh.positions[node.index()])
        .collect();
    mesh = Mesh::new(x, vec![CellBlock::hexahedra(cells)]).unwrap();
    let named = |wanted: &dyn Fn(&Vec3) -> bool| -> Vec<NodeId> {
        let nodes = mesh.positions.iter().enumerate();
        let nodes = nodes.filter(|(_, x)| wanted(x));
        nodes.map(|(node, _)| NodeId::new(node)).collect()
    };
    let sets = [
        ("bottom", named(&|x| x.z == 0.0)),
        ("top", named(&|x| x.z == 2.5)),
        ("lower", named(&|x| x.z == 1.0 && x.x >= 1.0)),
        ("upper", named(&|x| x.z == 1.5 && x.x >= 1.0)),
    ];
    for (name, nodes) in sets {
        let faces = mesh.faces_of_nodes(&nodes);
        mesh.facet_sets.insert(name, faces);
        mesh.node_sets.insert(name, nodes);
    }
    mesh
}

/// The jaw, its top lowered in increments of a size.
pub fn closing(way: f64, size: f64) -> Model {
    let mut model = model(vec![body("jaw", jaw(), rubber(2.0, 0.3))]);
    let mut step = step();
    step.increments = increments(size, 1e-3);
    step.displacements = vec![
        model.hold("jaw", "bottom", [Some(0.0); 3]),
        model.hold("jaw", "top", [Some(0.0), Some(0.0), Some(-way)]),
    ];
    model.steps = vec![step];
    model
}

fn warnings(run: &Run) -> Vec<Warning> {
    let mut judgement = Judgement::default();
    for (states, progress) in run.states.windows(2).zip(&run.progress) {
        let in_step = InStep::up_to(progress.step, progress.fraction);
        judgement.increment(&run.problem, &states[0], &states[1], in_step);
    }
    judgement.warnings(&run.problem, &run.ending)
}

#[test]
fn a_body_does_not_go_through_itself_without_a_word() {
    let run = Run::of(closing(1.6, 0.1));
    let Ending::Stopped { reason, .. } = &run.ending else {
        panic!("{}", run.ending);
    };
    let CutBack::Overlap {
        body, other, start, ..
    } = reason
    else {
        panic!("{reason}");
    };
    assert_eq!([body.as_str(), other], ["jaw"; 2]);
    assert_eq!((*start, reason.remedy()), (Start::Inside, Remedy::None));
    assert!(
        reason.to_string().contains("passes through itself"),
        "{reason}"
    );
    let found = warnings(&run);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!(found[0].kind, Kind::Overlap);
    assert!(found[0].value > SHARE && found[0].value <= 0.5);
}

#[test]
fn a_body_that_touches_itself_hardly_or_by_a_pair_is_none_that_goes_through() {
    let run = Run::of(closing(0.4, 0.1));
    assert_eq!(run.ending, Ending::Completed);
    assert_eq!(warnings(&run), []);
    let mut model = closing(0.9, 0.1);
    model.touch(("jaw", "lower"), ("jaw", "upper"), coulomb(0.2));
    let run = Run::of(model);
    assert_eq!(run.ending, Ending::Completed, "{}", run.ending);
    let overlaps = |warning: &Warning| warning.kind == Kind::Overlap;
    assert!(!warnings(&run).iter().any(overlaps));
}

#[test]
fn bodies_without_a_pair_do_not_go_through_each_other_without_a_word() {
    let lower = block([0.0; 3], [1.0, 1.0, 0.5], [4, 4, 2]).mesh().unwrap();
    let upper = block([0.2, 0.2, 0.7], [0.5, 0.5, 0.5], [3, 3, 2])
        .mesh()
        .unwrap();
    let mut model = model(vec![
        body("lower", lower, rubber(1.0, 0.3)),
        body("upper", upper, rubber(1.0, 0.3)),
    ]);
    let mut step = step();
    step.increments = increments(0.1, 1e-3);
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.4)]),
    ];
    model.steps = vec![step];
    let run = Run::of(model);
    let said = run.ending.to_string();
    assert!(
        said.contains("inside `") && said.contains("no pair"),
        "{said}"
    );
    assert!(
        warnings(&run)
            .iter()
            .all(|warning| warning.kind == Kind::Overlap)
    );
}

#[test]
fn sheets_do_not_go_through_each_other_in_one_increment() {
    let sheet = |z: f64| block([0.0, 0.0, z], [2.0, 2.0, 0.05], [4, 4, 1]).mesh();
    let mut model = model(vec![
        body("lower", sheet(0.0).unwrap(), rubber(1.0, 0.3)),
        body("upper", sheet(0.1).unwrap(), rubber(1.0, 0.3)),
    ]);
    let mut step = step();
    step.increments = increments(1.0, 1.0);
    step.displacements = vec![
        model.hold("lower", "zmin", [Some(0.0); 3]),
        model.hold("upper", "zmax", [Some(0.0), Some(0.0), Some(-0.25)]),
    ];
    model.steps = vec![step];
    let said = Run::of(model).ending.to_string();
    assert!(
        said.contains("passes through `") && said.contains("no pair"),
        "{said}"
    );
}
