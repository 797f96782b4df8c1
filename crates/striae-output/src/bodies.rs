//! Bodies in files: displacements, velocities, stresses and what materials remember.

use striae_element::{nodal_cauchy_stress, von_mises};
use striae_mesh::Vec3;
use striae_solve::{problem::Problem, state::State};

use crate::vtk::{Array, Cells, Grid, Values};

/// A body at the positions of a state.
pub(crate) fn body_grid<'a>(problem: &'a Problem, state: &'a State, body: usize) -> Grid<'a> {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let points = &state.positions[range.clone()];
    let model = &problem.model.bodies[body];
    let displacement = points
        .iter()
        .zip(&problem.reference[range])
        .map(|(x, reference)| x - reference);
    let mut point_arrays = vec![Array::new(
        "displacement",
        Values::Vectors(displacement.collect()),
    )];
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let velocities = &state.velocities[range];
    if velocities.iter().any(|velocity| *velocity != Vec3::zeros()) {
        let velocities = Values::Vectors(velocities.to_vec());
        point_arrays.push(Array::new("velocity", velocities));
    }
    let stress = nodal_cauchy_stress(
        &model.mesh,
        &problem.elements[body],
        points,
        &model.material,
        &state.histories[body],
    );
    if let Ok(stress) = stress {
        let equivalent = stress.iter().map(von_mises).collect();
        point_arrays.push(Array::new(
            "cauchy_stress",
            Values::SymmetricTensors(stress),
        ));
        point_arrays.push(Array::new("von_mises", Values::Scalars(equivalent)));
    }
    Grid {
        points,
        cells: Cells::Blocks(&model.mesh.blocks),
        point_arrays,
        cell_arrays: memory(problem, state, body),
        time: state.time,
    }
}

/// Means over the elements of what the points of a body remember, as far as it has a name.
fn memory(problem: &Problem, state: &State, body: usize) -> Vec<Array> {
    let material = &problem.model.bodies[body].material;
    let (elements, each) = (&problem.elements[body], material.variables());
    let fields = material.fields().into_iter();
    fields
        .map(|field| {
            let means = elements.iter().map(|element| {
                let variables = &state.histories[body][element.variables(each)];
                element.mean(variables, field.variable)
            });
            Array::new(field.name, Values::Scalars(means.collect()))
        })
        .collect()
}
