//! Fields of bodies for their files, and what materials remember.

use nalgebra::Matrix3;
use striae_element::{nodal_stress_sums, von_mises};
use striae_mesh::{ElementId, Vec3};
use striae_solve::{problem::Problem, state::State};

use crate::{
    BodyField,
    fibres::fibres,
    means::{Sums, means, tensor_means},
    strain::strain_sums,
    vtk::{Array, Cells, Grid, Values},
};

/// A body with the requested fields. Those of stress, strain and energy are left out if the state
/// has none. Collective.
pub(crate) fn body_grid<'a>(
    problem: &'a Problem,
    state: &'a State,
    body: usize,
    fields: &[BodyField],
) -> Grid<'a> {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let points = &state.positions[range];
    let mesh = &problem.model.bodies[body].mesh;
    let needs = |some: &[BodyField]| fields.iter().any(|field| some.contains(field));
    let of_stress = needs(&[
        BodyField::CauchyStress,
        BodyField::VonMises,
        BodyField::PrincipalStress,
        BodyField::PrincipalStressDirections,
    ]);
    let of_strain = needs(&[
        BodyField::LogarithmicStrain,
        BodyField::PrincipalStrain,
        BodyField::PrincipalStrainDirections,
    ]);
    let tensors = Tensors {
        stress: of_stress.then(|| stress(problem, state, body)).flatten(),
        strain: of_strain
            .then(|| tensor_means(problem, body, strain_sums(mesh, points)))
            .flatten(),
    };
    let mut grid = Grid {
        points,
        cells: Cells::Blocks(&mesh.blocks),
        point_arrays: Vec::new(),
        cell_arrays: Vec::new(),
        time: state.time,
    };
    for field in fields {
        add(&mut grid, problem, state, body, *field, &tensors);
    }
    grid
}

/// Tensors at the nodes, as far as they are requested and known.
struct Tensors {
    stress: Option<Vec<Matrix3<f64>>>,
    strain: Option<Vec<Matrix3<f64>>>,
}

/// Cauchy stress at the nodes of a body; collective.
pub(crate) fn stress(problem: &Problem, state: &State, body: usize) -> Option<Vec<Matrix3<f64>>> {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let model = &problem.model.bodies[body];
    let sums = nodal_stress_sums(
        &model.mesh,
        &problem.elements[body],
        &state.positions[range],
        |element| problem.made_of(state, body, element),
    );
    tensor_means(problem, body, sums.ok())
}

/// Means over the elements of what the points of a body remember, as far as it has a name;
/// zero in elements whose material does not remember it.
fn memory(problem: &Problem, state: &State, body: usize) -> Vec<Array> {
    let names = problem.names_remembered(body);
    let names = names.into_iter();
    names
        .map(|name| {
            let means = problem.remembered(state, body, &name);
            Array::new(name, Values::Scalars(means))
        })
        .collect()
}

fn add(
    grid: &mut Grid<'_>,
    problem: &Problem,
    state: &State,
    body: usize,
    field: BodyField,
    tensors: &Tensors,
) {
    let range = problem.first_node[body]..problem.first_node[body + 1];
    let mut point = |name: &str, values: Values| {
        grid.point_arrays.push(Array::new(name, values));
    };
    let (stress, strain) = (tensors.stress.as_deref(), tensors.strain.as_deref());
    match (field, stress, strain) {
        (BodyField::Displacement, ..) => {
            let reference = problem.reference[range].iter();
            let displacement = grid.points.iter().zip(reference).map(|(x, at)| x - at);
            let displacement = Values::Vectors(displacement.collect());
            point("displacement", displacement);
        }
        (BodyField::Velocity, ..) => {
            let velocities = &state.velocities[range];
            let moves = velocities.iter().any(|velocity| *velocity != Vec3::zeros());
            if problem.share.any(moves) {
                point("velocity", Values::Vectors(velocities.to_vec()));
            }
        }
        (BodyField::CauchyStress, Some(stress), _) => {
            point("cauchy_stress", Values::SymmetricTensors(stress.to_vec()));
        }
        (BodyField::VonMises, Some(stress), _) => {
            let equivalent = stress.iter().map(von_mises).collect();
            point("von_mises", Values::Scalars(equivalent));
        }
        (BodyField::PrincipalStress, Some(stress), _) => {
            point("principal_stress", principal_values(stress));
        }
        (BodyField::PrincipalStressDirections, Some(stress), _) => {
            for (name, directions) in principal_directions("principal_stress_direction", stress) {
                point(&name, directions);
            }
        }
        (BodyField::LogarithmicStrain, _, Some(strain)) => {
            let strain = strain.to_vec();
            point("logarithmic_strain", Values::SymmetricTensors(strain));
        }
        (BodyField::PrincipalStrain, _, Some(strain)) => {
            point("principal_strain", principal_values(strain));
        }
        (BodyField::PrincipalStrainDirections, _, Some(strain)) => {
            for (name, directions) in principal_directions("principal_strain_direction", strain) {
                point(&name, directions);
            }
        }
        (BodyField::StrainEnergyDensity, ..) => {
            if let Some(density) = means(problem, body, energy_sums(problem, state, body)) {
                point("strain_energy_density", Values::Scalars(density));
            }
        }
        (BodyField::HistoryVariables, ..) => {
            grid.cell_arrays.extend(memory(problem, state, body));
        }
        (BodyField::Fibres, ..) => grid.cell_arrays.extend(fibres(problem, state, body)),
        (BodyField::Section, ..) => grid.cell_arrays.extend(sections(problem, body)),
        (_, _, _) => {}
    }
}

/// Section of every element, where the body has some.
fn sections(problem: &Problem, body: usize) -> Option<Array> {
    let model = &problem.model.bodies[body];
    let elements = (0..model.mesh.element_count()).map(ElementId::new);
    let section = |element| problem.compositions[body].section(element) as i32;
    let numbers = elements.map(section).collect();
    let has_some = !model.sections.is_empty();
    has_some.then(|| Array::new("section", Values::Integers(numbers)))
}

/// Eigenvalues of symmetric tensors, the largest first.
fn principal_values(tensors: &[Matrix3<f64>]) -> Values {
    Values::Vectors(tensors.iter().map(|tensor| principal(tensor).0).collect())
}

/// Unit vectors along the axes of symmetric tensors, by the name of their array.
fn principal_directions(name: &str, tensors: &[Matrix3<f64>]) -> [(String, Values); 3] {
    let axes: Vec<[Vec3; 3]> = tensors.iter().map(|tensor| principal(tensor).1).collect();
    [0, 1, 2].map(|at| {
        let directions = axes.iter().map(|axes| axes[at]).collect();
        (format!("{name}_{}", at + 1), Values::Vectors(directions))
    })
}

/// Eigenvalues of a symmetric tensor, the largest first, and unit vectors along its axes,
/// whose largest component is positive.
fn principal(tensor: &Matrix3<f64>) -> (Vec3, [Vec3; 3]) {
    let eigen = tensor.symmetric_eigen();
    let mut order = [0, 1, 2];
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let values = order.map(|at| eigen.eigenvalues[at]);
    let axes = order.map(|at| {
        let axis: Vec3 = eigen.eigenvectors.column(at).into();
        axis * axis[axis.iamax()].signum()
    });
    (values.into(), axes)
}

/// Stored energy of the elements at every node, and their volume at rest.
fn energy_sums(problem: &Problem, state: &State, body: usize) -> Option<Sums<f64>> {
    let model = &problem.model.bodies[body];
    let nodes = model.mesh.positions.len();
    let (mut energies, mut volumes) = (vec![0.0; nodes], vec![0.0; nodes]);
    let elements = model.mesh.elements().zip(problem.elements[body].iter());
    for (at, (corners, element)) in elements.enumerate() {
        let nodes = problem.nodes(body, corners).into_iter();
        let x: Vec<Vec3> = nodes.map(|node| state.positions[node]).collect();
        let (driven, variables) = problem.made_of(state, body, ElementId::new(at));
        let energy = element.stored_energy(&x, driven, variables).ok()?;
        for corner in corners {
            energies[corner.index()] += energy;
            volumes[corner.index()] += element.volume();
        }
    }
    Some((energies, volumes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn principal_values_come_in_order_with_their_axes() {
        let turn = nalgebra::Rotation3::from_euler_angles(0.3, -0.8, 1.1);
        let diagonal = Matrix3::from_diagonal(&Vec3::new(-2.0, 5.0, 1.0));
        let stress = turn.matrix() * diagonal * turn.matrix().transpose();
        let (values, axes) = principal(&stress);
        assert!((values - Vec3::new(5.0, 1.0, -2.0)).norm() < 1e-14);
        for (value, axis) in values.iter().zip(&axes) {
            assert!((stress * axis - axis * *value).norm() < 1e-14);
            assert!(axis.max() >= axis.amax(), "{axis}");
        }
    }
}
