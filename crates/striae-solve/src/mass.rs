//! Consistent mass of all bodies, found once for a problem, and what follows from it.

use striae_element::{Elements, redistributed};
use striae_mesh::{ElementId, Vec3};

use crate::{
    composition::Composition,
    model::{Body, Model},
    problem::Problem,
    state::State,
};

/// Mass matrices of the elements of a body, with the mass of contact nodes moved where that
/// is asked for.
#[derive(Clone, Debug)]
pub struct BodyMass {
    /// First entry of every element, and the number of all; empty in a body without mass.
    first: Vec<usize>,
    /// `m_ab` of one element after the other, row by row.
    entries: Vec<f64>,
}

impl BodyMass {
    /// The mass of a body, `massless` of whose nodes are to have none.
    pub(crate) fn new(
        body: &Body,
        elements: &Elements,
        composition: &Composition,
        massless: &[bool],
    ) -> Self {
        let mut mass = Self {
            first: Vec::new(),
            entries: Vec::new(),
        };
        if !body.has_mass() {
            return mass;
        }
        mass.first.push(0);
        for ((at, corners), element) in body.mesh.elements().enumerate().zip(elements.iter()) {
            let density = body.density_of(composition.section(ElementId::new(at)));
            if density > 0.0 {
                let corners = corners.iter().map(|node| massless[node.index()]);
                let massless: Vec<bool> = corners.collect();
                let mut of_element = element.mass(density);
                if massless.contains(&true) {
                    of_element = redistributed(element.kind(), &of_element, &massless);
                }
                let rows = &of_element[..massless.len()];
                let rows = rows.iter().flat_map(|row| &row[..massless.len()]);
                mass.entries.extend(rows);
            }
            mass.first.push(mass.entries.len());
        }
        mass
    }

    /// The mass matrix of an element, row by row; nothing where it has no mass.
    pub fn of_element(&self, element: ElementId) -> &[f64] {
        match self.first.get(element.index()..) {
            Some([first, end, ..]) => &self.entries[*first..*end],
            _ => &[],
        }
    }
}

/// The mass of all bodies of a model.
pub(crate) fn masses(
    model: &Model,
    elements: &[Elements],
    compositions: &[Composition],
    (first_node, massless): (&[usize], &[bool]),
) -> Vec<BodyMass> {
    let bodies = model.bodies.iter().enumerate();
    let of_body = |(at, body): (usize, &Body)| {
        let own = &massless[first_node[at]..first_node[at + 1]];
        BodyMass::new(body, &elements[at], &compositions[at], own)
    };
    bodies.map(of_body).collect()
}

/// `M v`, node by node.
pub fn mass_times(problem: &Problem, vectors: &[Vec3]) -> Vec<Vec3> {
    let mut product = vec![Vec3::zeros(); vectors.len()];
    for (body, model) in problem.model.bodies.iter().enumerate() {
        if !model.has_mass() {
            continue;
        }
        for (at, corners) in model.mesh.elements().enumerate() {
            let nodes = problem.nodes(body, corners);
            let mass = problem.masses[body].of_element(ElementId::new(at));
            for (&row, mass) in nodes.iter().zip(mass.chunks_exact(nodes.len())) {
                for (&column, mass) in nodes.iter().zip(mass) {
                    product[row] += vectors[column] * *mass;
                }
            }
        }
    }
    for &(node, mass) in &problem.mass_points {
        product[node] += vectors[node] * mass;
    }
    product
}

/// `v . M v / 2`.
pub fn kinetic_energy(problem: &Problem, velocities: &[Vec3]) -> f64 {
    let momentum = mass_times(problem, velocities);
    let products = momentum.iter().zip(velocities);
    0.5 * products.map(|(p, v)| p.dot(v)).sum::<f64>()
}

/// Linear momentum and angular momentum about the origin.
pub fn momentum(problem: &Problem, state: &State) -> (Vec3, Vec3) {
    let nodal = mass_times(problem, &state.velocities);
    let turning = nodal.iter().zip(&state.positions);
    (nodal.iter().sum(), turning.map(|(p, x)| x.cross(p)).sum())
}
