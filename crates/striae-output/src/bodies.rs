//! Fields of bodies for their files, and what materials remember.

use nalgebra::Matrix3;
use striae_element::{nodal_cauchy_stress, von_mises};
use striae_mesh::Vec3;
use striae_solve::{problem::Problem, state::State};

use crate::{
    BodyField,
    vtk::{Array, Cells, Grid, Values},
};

/// A body with the fields that are asked for. Those of stress and energy are left out
/// where the state has none.
pub(crate) fn body_grid<'a>(
    problem: &'a Problem,
    state: &'a State,
    body: usize,
    fields: &[BodyField],
) -> Grid<'a> {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let mut grid = Grid {
        points: &state.positions[range],
        cells: Cells::Blocks(&problem.model.bodies[body].mesh.blocks),
        point_arrays: Vec::new(),
        cell_arrays: memory(problem, state, body),
        time: state.time,
    };
    let of_stress = [
        BodyField::CauchyStress,
        BodyField::VonMises,
        BodyField::PrincipalStress,
    ];
    let is_asked = fields.iter().any(|field| of_stress.contains(field));
    let stress = is_asked.then(|| stress(problem, state, body)).flatten();
    for field in fields {
        add(&mut grid, problem, state, body, *field, stress.as_deref());
    }
    grid
}

/// Cauchy stress at the nodes of a body.
pub(crate) fn stress(problem: &Problem, state: &State, body: usize) -> Option<Vec<Matrix3<f64>>> {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let model = &problem.model.bodies[body];
    nodal_cauchy_stress(
        &model.mesh,
        &problem.elements[body],
        &state.positions[range],
        &model.material,
        &state.histories[body],
    )
    .ok()
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

fn add(
    grid: &mut Grid<'_>,
    problem: &Problem,
    state: &State,
    body: usize,
    field: BodyField,
    stress: Option<&[Matrix3<f64>]>,
) {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let mut point = |name: &'static str, values: Values| {
        grid.point_arrays.push(Array::new(name, values));
    };
    match field {
        BodyField::Displacement => {
            let reference = problem.reference[range].iter();
            let displacement = grid.points.iter().zip(reference).map(|(x, at)| x - at);
            let displacement = Values::Vectors(displacement.collect());
            point("displacement", displacement);
        }
        BodyField::Velocity => {
            let velocities = &state.velocities[range];
            if velocities.iter().any(|velocity| *velocity != Vec3::zeros()) {
                point("velocity", Values::Vectors(velocities.to_vec()));
            }
        }
        BodyField::CauchyStress => {
            if let Some(stress) = stress {
                point("cauchy_stress", Values::SymmetricTensors(stress.to_vec()));
            }
        }
        BodyField::VonMises => {
            if let Some(stress) = stress {
                let equivalent = stress.iter().map(von_mises).collect();
                point("von_mises", Values::Scalars(equivalent));
            }
        }
        BodyField::PrincipalStress => {
            if let Some(stress) = stress {
                let principal = stress.iter().map(principal).collect();
                point("principal_stress", Values::Vectors(principal));
            }
        }
        BodyField::StrainEnergyDensity => {
            if let Some(density) = energy_density(problem, state, body) {
                point("strain_energy_density", Values::Scalars(density));
            }
        }
    }
}

/// Eigenvalues of a symmetric tensor, the largest first.
fn principal(stress: &Matrix3<f64>) -> Vec3 {
    let mut values: Vec3 = stress.symmetric_eigenvalues();
    values.as_mut_slice().sort_by(|a, b| b.total_cmp(a));
    values
}

/// Stored energy of the elements at every node over their volume at rest.
fn energy_density(problem: &Problem, state: &State, body: usize) -> Option<Vec<f64>> {
    let model = &problem.model.bodies[body];
    let mut sums = vec![[0.0; 2]; model.mesh.positions.len()];
    for (corners, element) in model.mesh.elements().zip(problem.elements[body].iter()) {
        let nodes = problem.nodes(body, corners).into_iter();
        let x: Vec<Vec3> = nodes.map(|node| state.positions[node]).collect();
        let variables = &state.histories[body][element.variables(model.material.variables())];
        let energy = element.stored_energy(&x, &model.material, variables).ok()?;
        for corner in corners {
            sums[corner.index()][0] += energy;
            sums[corner.index()][1] += element.volume();
        }
    }
    Some(
        sums.into_iter()
            .map(|[energy, volume]| energy / volume)
            .collect(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_values_come_in_order() {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.8, 1.1);
        let diagonal = Matrix3::from_diagonal(&Vec3::new(-2.0, 5.0, 1.0));
        let stress = turn.matrix() * diagonal * turn.matrix().transpose();
        assert!((principal(&stress) - Vec3::new(5.0, 1.0, -2.0)).norm() < 1e-14);
    }
}
