//! Directions of fibres, carried along by the mean deformation gradient of each element,
//!
//! ```text
//! F a / |F a| ,   F = 1/V sum_g w_g F_g
//! ```
//!
//! with the direction `a` at rest that the element remembers.

use nalgebra::Matrix3;
use striae_mesh::{CellKind, ElementId, Vec3};
use striae_solve::{problem::Problem, state::State};

use crate::vtk::{Array, Values};

/// An array for each family, zero in elements without it.
pub(crate) fn fibres(problem: &Problem, state: &State, body: usize) -> Vec<Array> {
    let model = &problem.model.bodies[body];
    let sections = problem.compositions[body].used_sections().iter();
    let families = sections.map(|section| model.material_of(*section).fibres().len());
    let families = families.max().unwrap_or(0);
    let mut arrays = vec![Vec::new(); families];
    if families == 0 {
        return Vec::new();
    }
    for (at, corners) in model.mesh.elements().enumerate() {
        let id = ElementId::new(at);
        let (driven, variables) = problem.made_of(state, body, id);
        let nodes = problem.nodes(body, corners);
        let [rest, now] = [&problem.reference, &state.positions]
            .map(|x| nodes.iter().map(|node| x[*node]).collect::<Vec<Vec3>>());
        let gradient = mean_gradient(model.mesh.kind(id), &rest, &now);
        for (family, array) in arrays.iter_mut().enumerate() {
            array.push(match driven.material.fibres().get(family) {
                None => Vec3::zeros(),
                Some(_) => {
                    let rest = &variables[3 * family..3 * family + 3];
                    (gradient * Vec3::from_column_slice(rest)).normalize()
                }
            });
        }
    }
    let named = (1..).zip(arrays);
    named
        .map(|(number, array)| Array::new(format!("fibre_{number}"), Values::Vectors(array)))
        .collect()
}

/// Mean of the deformation gradient over the volume of a cell, up to a factor.
fn mean_gradient(kind: CellKind, rest: &[Vec3], now: &[Vec3]) -> Matrix3<f64> {
    let shape = kind.shape();
    let at_point = |(place, weight): &([f64; 3], f64)| {
        let gradients = (shape.gradients)(&Vec3::from(*place));
        let slopes = |x: &[Vec3]| -> Matrix3<f64> {
            let products = x.iter().zip(&gradients);
            products.map(|(x, gradient)| x * gradient.transpose()).sum()
        };
        let jacobian = slopes(rest);
        let inverse = jacobian.try_inverse();
        let inverse = inverse.expect("elements of a problem are not degenerate");
        slopes(now) * inverse * (*weight * jacobian.determinant())
    };
    shape.points.iter().map(at_point).sum()
}
