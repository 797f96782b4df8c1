//! Values of nodes and elements in a checkpoint, by their numbers in the whole.
//!
//! Everything else at a point of a run, such as pairs, rigid bodies and energies, is equal on all
//! ranks. The experience of the linear solver affects only digits and is particular to a rank, so
//! it is left out; the extrapolation of increments is included, as it saves the next one
//! iterations.

use std::{iter::successors, mem::take};

use serde::{Deserialize, Serialize};
use striae_mesh::{ElementId, Vec3};
use striae_solve::{
    drive::Point,
    newton::{Course, Memory},
    problem::Problem,
    state::State,
};

use crate::ranks::told;

/// Fields of a state with a vector a node.
const VECTORS: usize = 10;

/// Piece that a rank writes.
#[derive(Serialize, Deserialize)]
pub(super) struct Piece {
    pub entries: Entries,
}

/// Values at nodes and in elements, of the start of the step and of the last state.
#[derive(Default, Serialize, Deserialize)]
pub(super) struct Entries {
    /// Number of each node in the whole, and its values.
    nodes: Vec<(u32, Values)>,
    /// Number of each element that remembers something, by body, and its variables.
    elements: Vec<Vec<(u32, [Vec<f64>; 2])>>,
}

/// Values at a node.
#[derive(Serialize, Deserialize)]
struct Values {
    states: [[Vec3; VECTORS]; 2],
    /// Positions before the last increment and before the one preceding it, as far as they are
    /// continued.
    course: Vec<Vec3>,
}

impl Values {
    fn of(point: &Point, node: usize) -> Self {
        let states = [&point.start, &point.state];
        let course = courses(&point.memory);
        Self {
            states: states.map(|state| fields(state).map(|field| field[node])),
            course: course.map(|course| course.positions[node]).collect(),
        }
    }
}

impl Entries {
    /// Values of a rank, taken out of its point.
    pub fn taken(point: &mut Point, problem: &Problem) -> Self {
        let share = &problem.share;
        let states = [&point.start, &point.state];
        let nodes = problem.own_nodes().map(|node| {
            let values = Values::of(point, node.0);
            (share.whole_node(node).0 as u32, values)
        });
        let nodes = nodes.collect();
        let bodies = problem.compositions.iter().zip(&problem.model.bodies);
        let elements = bodies.enumerate().map(|(body, (composition, model))| {
            let all = (0..model.mesh.element_count()).map(ElementId::new);
            let some = all.filter(|id| !composition.variables(*id).is_empty());
            let values = some.map(|id| {
                let places = composition.variables(id);
                let variables = states.map(|state| state.histories[body][places.clone()].to_vec());
                (share.whole_element(body, id).0, variables)
            });
            values.collect()
        });
        let entries = Self {
            nodes,
            elements: elements.collect(),
        };
        strip(point);
        entries
    }

    /// Values of a point of the whole problem, of which this rank has a share; `None` if it is of
    /// another problem. Collective.
    pub fn of_whole(point: &Point, problem: &Problem) -> Option<Self> {
        let states = [&point.start, &point.state];
        let counts = counts(problem);
        let holding = problem.share.holding()?;
        let fits = |state: &&State| {
            let mut known = fields(state).into_iter();
            let variables = state.histories.iter().map(Vec::len);
            known.all(|field| field.len() == holding.whole.nodes)
                && variables.eq(counts.iter().map(|of_body| of_body.iter().sum::<usize>()))
        };
        let follows = |course: &Course| course.positions.len() == holding.whole.nodes;
        if !states.iter().all(fits) || !courses(&point.memory).all(follows) {
            return None;
        }
        let nodes = (0..holding.whole.nodes).map(|node| (node as u32, Values::of(point, node)));
        let elements = counts.iter().enumerate().map(|(body, counts)| {
            let mut first = 0;
            let values = (0..).zip(counts).map(|(element, count)| {
                let places = first..first + count;
                first += count;
                let variables = states.map(|state| state.histories[body][places.clone()].to_vec());
                (element, variables)
            });
            values.filter(|(_, of)| !of[0].is_empty()).collect()
        });
        Some(Self {
            nodes: nodes.collect(),
            elements: elements.collect(),
        })
    }

    /// Keeps some nodes, and some elements by body and number.
    pub fn keep(&mut self, node: impl Fn(u32) -> bool, element: impl Fn(usize, u32) -> bool) {
        self.nodes.retain(|(number, _)| node(*number));
        for (body, elements) in self.elements.iter_mut().enumerate() {
            elements.retain(|(number, _)| element(body, *number));
        }
    }

    /// Adds others.
    pub fn append(&mut self, mut others: Self) {
        self.nodes.append(&mut others.nodes);
        let bodies = self.elements.len().max(others.elements.len());
        self.elements.resize_with(bodies, Vec::new);
        for (own, mut other) in self.elements.iter_mut().zip(others.elements) {
            own.append(&mut other);
        }
    }

    /// Puts them into a point, in the order of their numbers.
    pub fn put(mut self, point: &mut Point) {
        strip(point);
        self.nodes.sort_unstable_by_key(|(number, _)| *number);
        for elements in &mut self.elements {
            elements.sort_unstable_by_key(|(number, _)| *number);
        }
        for (at, state) in [&mut point.start, &mut point.state].into_iter().enumerate() {
            for (place, field) in fields_mut(state).into_iter().enumerate() {
                let values = self.nodes.iter();
                let values = values.map(|(_, values)| values.states[at][place]);
                *field = values.collect();
            }
            let bodies = self.elements.iter();
            let of_body = |elements: &Vec<(u32, [Vec<f64>; 2])>| {
                let variables = elements.iter().flat_map(|(_, of)| &of[at]);
                variables.copied().collect()
            };
            state.histories = bodies.map(of_body).collect();
        }
        let mut course = point.memory.course.as_mut();
        for place in 0.. {
            let Some(of_increment) = course else { break };
            let values = self.nodes.iter();
            let values = values.map(|(_, values)| values.course[place]);
            of_increment.positions = values.collect();
            course = of_increment.before.as_deref_mut();
        }
    }
}

/// Number of internal variables of each element of the whole, by body; collective.
fn counts(problem: &Problem) -> Vec<Vec<usize>> {
    let bodies = problem.compositions.iter().zip(&problem.model.bodies);
    let own = bodies.enumerate().map(|(body, (composition, model))| {
        let elements = (0..model.mesh.element_count()).map(ElementId::new);
        let counted = elements.map(|id| {
            let whole = problem.share.whole_element(body, id).0;
            (whole, composition.variables(id).len() as u32)
        });
        counted.collect()
    });
    let own: Vec<Vec<(u32, u32)>> = own.collect();
    let mut counts: Vec<Vec<usize>> = vec![Vec::new(); own.len()];
    for of_rank in told(&problem.share, &own) {
        for (counts, of_body) in counts.iter_mut().zip(of_rank) {
            for (element, count) in of_body {
                let needed = counts.len().max(element as usize + 1);
                counts.resize(needed, 0);
                counts[element as usize] = count as usize;
            }
        }
    }
    counts
}

/// Leaves what all ranks hold.
fn strip(point: &mut Point) {
    for state in [&mut point.start, &mut point.state] {
        fields_mut(state)
            .into_iter()
            .for_each(|field| field.clear());
        state.histories.clear();
    }
    point.memory = Memory {
        extent: take(&mut point.memory.extent),
        course: take(&mut point.memory.course),
        ..Memory::default()
    };
    let mut course = point.memory.course.as_mut();
    while let Some(of_increment) = course {
        of_increment.positions.clear();
        course = of_increment.before.as_deref_mut();
    }
}

/// Starts of the last increment and of the one before.
fn courses(memory: &Memory) -> impl Iterator<Item = &Course> {
    successors(memory.course.as_ref(), |course| course.before.as_deref())
}

fn fields(state: &State) -> [&Vec<Vec3>; VECTORS] {
    let forces = &state.forces;
    [
        &state.positions,
        &state.velocities,
        &state.accelerations,
        &forces.internal,
        &forces.inertia,
        &forces.reaction,
        &forces.applied,
        &forces.contact,
        &forces.ties,
        &forces.stabilisation,
    ]
}

fn fields_mut(state: &mut State) -> [&mut Vec<Vec3>; VECTORS] {
    let forces = &mut state.forces;
    [
        &mut state.positions,
        &mut state.velocities,
        &mut state.accelerations,
        &mut forces.internal,
        &mut forces.inertia,
        &mut forces.reaction,
        &mut forces.applied,
        &mut forces.contact,
        &mut forces.ties,
        &mut forces.stabilisation,
    ]
}

/// The file of a piece beside an index.
pub(super) fn piece_file(index: &str, set: u64, rank: usize) -> String {
    format!("{}-{set}.{rank}.bin", stem(index))
}

/// Returns whether a file is a piece of a checkpoint.
pub(crate) fn is_piece(name: &str) -> bool {
    [super::FILE, super::END]
        .iter()
        .any(|index| is_piece_of(index, name))
}

/// Returns whether a file is a piece beside an index.
pub(super) fn is_piece_of(index: &str, name: &str) -> bool {
    set_of(index, name).is_some()
}

/// The set of a piece.
pub(super) fn set_of(index: &str, name: &str) -> Option<u64> {
    let numbers = name.strip_prefix(stem(index))?.strip_prefix('-')?;
    let (set, rank) = numbers.strip_suffix(".bin")?.split_once('.')?;
    rank.parse::<usize>().ok().and(set.parse().ok())
}

fn stem(index: &str) -> &str {
    index.strip_suffix(".bin").unwrap_or(index)
}
