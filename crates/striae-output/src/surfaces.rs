//! Contact surfaces in files.

use std::path::Path;

use striae_contact::{
    factor_states::{FactorStates, LARGEST_STATE},
    side::Side,
    unknowns::{NodeResult, Status as ContactStatus},
};
use striae_mesh::{NodeId, Vec3};
use striae_solve::{problem::Problem, state::State};
use striae_surface::node::SurfaceNode;

use crate::{
    ContactField, OutputError,
    vtk::{Array, Cells, Grid, Values, write},
    worn::Sums,
};

/// Quantities written of a side of a pair besides its state.
pub(crate) struct Wanted<'a> {
    /// Fields.
    pub fields: &'a [ContactField],
    /// Coefficient of wear, if one is known.
    pub wear: Option<f64>,
    /// Sums over slip at the nodes.
    pub worn: &'a [Sums],
    /// Results at the nodes, by side.
    pub nodes: &'a [Vec<NodeResult>; 2],
    /// Time of the last increment; 0 before the first one.
    pub elapsed: f64,
}

/// Writes a side of a pair in a state.
pub(crate) fn write_surface(
    path: &Path,
    problem: &Problem,
    state: &State,
    (pair, side): (usize, Side),
    wanted: &Wanted,
) -> Result<(), OutputError> {
    let geometry = &problem.pairs[pair];
    let Some(surface) = geometry.contact.sides[side].surface() else {
        return Ok(());
    };
    let global = |node: SurfaceNode| problem.surface_node(pair, side, node);
    let count = surface.nodes().len();
    let points: Vec<Vec3> = SurfaceNode::all(count)
        .filter_map(global)
        .map(|n| state.positions[n])
        .collect();
    let quads: Vec<[NodeId; 4]> = surface
        .facets()
        .iter()
        .map(|corners| corners.map(|node| NodeId(node.0)))
        .collect();
    let mut grid = Grid {
        points: &points,
        cells: Cells::Quadrilaterals(&quads),
        point_arrays: Vec::new(),
        cell_arrays: Vec::new(),
        time: state.time,
    };
    for field in wanted.fields {
        if *field == ContactField::WornDepth && !geometry.contact.wears() {
            continue;
        }
        let arrays = arrays(*field, state, (pair, side), wanted);
        let named = arrays
            .into_iter()
            .map(|(name, values)| Array::new(name, values));
        grid.point_arrays.extend(named);
    }
    if let Some(coefficient) = wanted.wear {
        let depth = Array::new("wear_depth", sums(wanted, 1, coefficient));
        grid.point_arrays.push(depth);
    }
    write(path, &grid)
}

/// Names of the states of a factor with more than one.
const STATES: [&str; LARGEST_STATE] = [
    "friction_state_1",
    "friction_state_2",
    "friction_state_3",
    "friction_state_4",
    "friction_state_5",
    "friction_state_6",
    "friction_state_7",
    "friction_state_8",
];

/// States of a factor of friction, one array each.
fn of_factor(states: &FactorStates, side: Side) -> Vec<(&'static str, Values)> {
    let of = |at: usize| Values::Scalars(states.of(side, at));
    match states.count {
        1 => vec![("friction_state", of(0))],
        count => (0..count).map(|at| (STATES[at], of(at))).collect(),
    }
}

/// Arrays of a field.
fn arrays(
    field: ContactField,
    state: &State,
    (pair, side): (usize, Side),
    wanted: &Wanted,
) -> Vec<(&'static str, Values)> {
    let nodes = &wanted.nodes[side];
    let scalars = |f: fn(&NodeResult) -> f64| Values::Scalars(nodes.iter().map(f).collect());
    let vectors = |f: fn(&NodeResult) -> Vec3| Values::Vectors(nodes.iter().map(f).collect());
    match field {
        ContactField::Gap => vec![("gap", scalars(|node| node.gap))],
        ContactField::Traction => vec![
            ("pressure", scalars(|node| node.pressure)),
            (
                "traction",
                vectors(|node| node.tau - node.normal * node.pressure),
            ),
            ("friction_traction", vectors(|node| node.tau)),
        ],
        ContactField::MeanTraction => vec![
            ("mean_pressure", scalars(NodeResult::mean_pressure)),
            ("mean_traction", vectors(|node| node.mean)),
        ],
        ContactField::Slip => vec![("slip", vectors(|node| node.slip))],
        ContactField::SlipRate => {
            let per_time = match wanted.elapsed > 0.0 {
                true => 1.0 / wanted.elapsed,
                false => 0.0,
            };
            let rates = nodes.iter().map(|node| node.slip * per_time).collect();
            vec![("slip_rate", Values::Vectors(rates))]
        }
        ContactField::AccumulatedSlip => {
            let slip = &state.pairs[pair].tractions.accumulated[side];
            vec![("accumulated_slip", Values::Scalars(slip.clone()))]
        }
        ContactField::WornDepth => {
            let worn = &state.pairs[pair].tractions.worn[side];
            vec![("worn_depth", Values::Scalars(worn.clone()))]
        }
        ContactField::FrictionState => {
            let tractions = &state.pairs[pair].tractions;
            match &tractions.factors {
                Some(states) => of_factor(states, side),
                None => {
                    let states = tractions.states[side].clone();
                    vec![("friction_state", Values::Scalars(states))]
                }
            }
        }
        ContactField::FrictionWork => vec![("friction_work", sums(wanted, 0, 1.0))],
        ContactField::Normal => vec![("normal", vectors(|node| node.normal))],
        ContactField::Texture => vec![
            ("texture", vectors(|node| node.texture)),
            (
                "structural_vector",
                vectors(|node| node.normal.cross(&node.texture)),
            ),
        ],
        ContactField::Status => {
            let status = nodes.iter().map(|node| match node.status {
                ContactStatus::Open => 0,
                ContactStatus::Stick => 1,
                ContactStatus::Slip => 2,
            });
            vec![("status", Values::Codes(status.collect()))]
        }
        ContactField::Roles => roles(state, (pair, side)),
    }
}

/// Roles of the nodes.
fn roles(state: &State, (pair, side): (usize, Side)) -> Vec<(&'static str, Values)> {
    let kept = state.pairs[pair].kept[side].iter().copied().map(u8::from);
    vec![("kept", Values::Codes(kept.collect()))]
}

/// A sum at all nodes, times a factor.
fn sums(wanted: &Wanted, at: usize, factor: f64) -> Values {
    let worn = wanted.worn.iter();
    Values::Scalars(worn.map(|sums| factor * sums[at]).collect())
}
