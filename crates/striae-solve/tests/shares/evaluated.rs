//! A problem, whole or shared, evaluated at one state.

use striae_condensed::{Growth, Partition, Tangent};
use striae_contact::{
    complementarity::Iteration, segment::Derivatives, selection::Selection, side::Side,
};
use striae_mesh::Vec3;
use striae_solve::{
    assembly::{Assembled, Contact, ElementPlaces, Setting, StepContext, Trial, assemble},
    layout::{Extent, Layout},
    problem::Problem,
    state::State,
};
use striae_sparse::{LinearOperator, Structure, Supervariable};
use striae_surface::node::SurfaceNode;

/// Evaluation of a problem.
pub struct Evaluated {
    pub layout: Layout,
    pub assembled: Assembled,
    /// The tangent times [`vector`] of every unknown's number.
    pub product: Vec<f64>,
    /// Entries of contact in the tangent.
    pub contact_entries: usize,
}

/// Displacement of what is at `x`.
fn displacement(x: &Vec3) -> Vec3 {
    let wave = Vec3::new(
        (3.0 * x.y).sin(),
        (2.0 * x.z).cos(),
        (2.0 * x.x + x.y).sin(),
    );
    wave * 0.01 - Vec3::new(0.0, 0.0, 0.01 * x.z)
}

/// Some number for an unknown of the whole problem.
pub fn vector(unknown: usize) -> f64 {
    (unknown as f64 * 0.37).sin()
}

/// Evaluates the first increment of a problem at a state that follows from places in space
/// alone; `number` is what the unknowns of the layout are called.
pub fn evaluated(problem: &Problem, number: impl Fn(&Layout) -> Vec<usize>) -> Evaluated {
    let state = State::undeformed(problem);
    let context = StepContext::new(problem, 0, &state);
    let selections = selections(&context, &state);
    let layout = Layout::new(problem, Extent::default().with(&selections));
    let partition = partition(problem, &layout);
    let places = ElementPlaces::new(problem, &layout, partition.structure());
    let imposed = context.imposed_after(&state, 0.5, 0.5);
    let trial = trial(problem, &state, &selections);
    let setting = Setting {
        context: &context,
        state: &state,
        selections: &selections,
        imposed: &imposed,
    };
    let mut tangent = Tangent::zero(partition.structure());
    let mut grown = partition.clone();
    let parts = (&mut grown, &places, &mut tangent);
    let contact = Contact::Evaluated(Iteration::LATER);
    let assembled = assemble(
        &setting,
        &trial,
        contact,
        Derivatives::First,
        &layout,
        parts,
    );
    let assembled = assembled.unwrap_or_else(|reason| panic!("{reason}"));
    let x: Vec<f64> = number(&layout).into_iter().map(vector).collect();
    let mut product = vec![0.0; x.len()];
    tangent.multiply(&x, &mut product);
    let rows = 0..tangent.contact.unknowns();
    let entries = rows.flat_map(|row| tangent.contact.row(row).filter(|entry| entry.1 != 0.0));
    Evaluated {
        contact_entries: entries.count(),
        layout,
        assembled,
        product,
    }
}

/// All couples with all.
fn partition(problem: &Problem, layout: &Layout) -> Partition {
    let every: Vec<_> = (0..layout.offsets().len() - 1).map(Supervariable).collect();
    let offsets = layout.offsets().to_vec();
    let structure = Structure::from_cliques(offsets, &[&every]).unwrap();
    assert!(every.len() >= problem.reference.len());
    Partition::from(&structure)
        .grown(&Growth::from_iter([every]))
        .unwrap()
}

fn selections(context: &StepContext, state: &State) -> Vec<Selection> {
    let pairs = state.pairs.iter().enumerate();
    pairs
        .map(|(pair, of_pair)| {
            let start = context.configuration(pair, &state.positions, &state.rigid);
            Selection::new(&start, None, &of_pair.kept, &context.fixed_on_pair[pair])
        })
        .collect()
}

fn trial(problem: &Problem, state: &State, selections: &[Selection]) -> Trial {
    let mut rigid = state.rigid.clone();
    for (at, pose) in rigid.iter_mut().enumerate() {
        if problem.plans[0].rigid[at].iter().all(Option::is_none) {
            *pose = pose.moved_to(&[0.01, 0.005, 0.002, 0.01, -0.02, 0.015]);
        }
    }
    let mut positions: Vec<Vec3> = (problem.reference.iter())
        .map(|x| x + displacement(x))
        .collect();
    for (at, nodes) in problem.tied.iter().enumerate() {
        let placement = rigid[at].placement(&problem.model.rigid_surfaces[at].reference);
        for &node in nodes {
            positions[node] = placement.point(&problem.reference[node]);
        }
    }
    problem.ties.follow(&mut positions);
    let pairs = state.pairs.iter().zip(selections).enumerate();
    let tractions = pairs.map(|(pair, (of_pair, selection))| {
        let mut tractions = of_pair.tractions.clone();
        for side in Side::BOTH {
            for node in SurfaceNode::all(selection.nodes(side)) {
                let place = problem.surface_node(pair, side, node);
                if let (Some(place), true) = (place, selection.is_kept(side, node)) {
                    let x = problem.reference[place];
                    tractions.nodes[side][node] = [0.1 + 0.02 * x.x, 0.01 * x.y, -0.01];
                }
            }
        }
        tractions
    });
    Trial {
        tractions: tractions.collect(),
        positions,
        rigid,
        pressures: Vec::new(),
    }
}
