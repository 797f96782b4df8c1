//! Fields of a finished run, as numbers and as parts of figures.

use nalgebra::Matrix3;
use striae_contact::unknowns::NodeResult;
use striae_io::figure::{Axis, Color, Content, Series};
use striae_mesh::Vec3;
use striae_surface::facet::Shape;

use super::study::Run;

/// A node of a contact surface at the end of a run.
pub struct SurfaceNode<'a> {
    /// Where it was.
    pub reference: Vec3,
    /// Where it is.
    pub position: Vec3,
    /// Its tractions.
    pub result: &'a NodeResult,
}

/// Nodes of a side of the first pair, in the order of the surface.
pub fn surface_nodes(run: &Run, side: usize) -> Vec<SurfaceNode<'_>> {
    let (problem, state) = (&run.simulation.problem, &run.simulation.state);
    let results = state.pairs[0].nodes[side].iter().enumerate();
    results
        .filter_map(|(index, result)| {
            let node = problem.surface_node(0, side, index as u32)?;
            Some(SurfaceNode {
                reference: problem.reference[node],
                position: state.positions[node],
                result,
            })
        })
        .collect()
}

/// Largest difference of the Cauchy stress from `expected` at the Gauss points
/// of all bodies, over the norm of `expected`.
pub fn stress_error(run: &Run, expected: &Matrix3<f64>) -> f64 {
    let (problem, state) = (&run.simulation.problem, &run.simulation.state);
    let mut largest = 0.0_f64;
    for (body, model) in problem.model.bodies.iter().enumerate() {
        let elements = model.mesh.elements.iter().zip(&problem.elements[body]);
        for (corners, element) in elements {
            let current = corners.map(|node| state.positions[problem.node(body, node)]);
            let Ok(stresses) = element.gauss_stress(&current, &model.material) else {
                return f64::NAN;
            };
            for stress in stresses {
                largest = largest.max((stress - expected).norm());
            }
        }
    }
    largest / expected.norm()
}

/// Pressure in colour on a side of the first pair, seen from above.
pub fn pressure_map(run: &Run, side: usize, parts: usize, bar: Axis) -> Content {
    let nodes = surface_nodes(run, side);
    let mut polygons = Vec::new();
    let mut values = Vec::new();
    for facet in facets(run, side) {
        let corners = facet.map(|corner| &nodes[corner as usize]);
        let at = |i: usize, j: usize| {
            let place = |index: usize| index as f64 / parts as f64 - 1.0;
            let weights = Shape::Quadrilateral.weights(place(i), place(j)).value;
            let pairs = weights.into_iter().zip(corners);
            pairs.fold([0.0; 3], |[x, y, p], (w, node)| {
                [
                    x + w * node.position.x,
                    y + w * node.position.y,
                    p + w * node.result.pressure,
                ]
            })
        };
        for i in (0..2 * parts).step_by(2) {
            for j in (0..2 * parts).step_by(2) {
                let corners = [(0, 0), (2, 0), (2, 2), (0, 2)];
                let polygon = corners.map(|(a, b)| at(i + a, j + b));
                polygons.push(polygon.map(|[x, y, _]| [x, y]).to_vec());
                values.push(at(i + 1, j + 1)[2]);
            }
        }
    }
    Content::Facets {
        polygons,
        values,
        bar,
    }
}

/// Edges of the facets of a side of the first pair, seen from above.
pub fn mesh_lines(run: &Run, side: usize, name: &str, color: Color) -> Series {
    let nodes = surface_nodes(run, side);
    let mut points = Vec::new();
    for facet in facets(run, side) {
        let ring = [0, 1, 2, 3, 0].map(|corner| nodes[facet[corner] as usize].position);
        points.extend(ring.map(|x| [x.x, x.y]));
        points.push([f64::NAN; 2]);
    }
    Series::new(name, Content::line(points)).colored(color)
}

fn facets(run: &Run, side: usize) -> &[[u32; 4]] {
    let sides = &run.simulation.problem.pairs[0].contact.sides;
    sides[side]
        .surface()
        .map_or(&[], |surface| surface.facets())
}
