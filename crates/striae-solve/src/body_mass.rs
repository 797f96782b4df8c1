//! Consistent mass of the elements of bodies, found once for a problem.

use striae_element::{Elements, redistributed};
use striae_mesh::ElementId;

use striae_model::{Body, Model};

use crate::composition::Composition;

/// Mass matrices of the elements of a body, with the mass of contact nodes moved if requested.
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
