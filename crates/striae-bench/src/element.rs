//! Times of the response of single elements, on one thread.

use crate::clock::timed;
use serde_json::Value;
use std::{error::Error, hint::black_box};
use striae_element::{ElementResponse, Elements, Formulation};
use striae_law::bulk::{LameConstants, Material, Past};
use striae_mesh::{CellKind, Vec3, generate::Block};

/// Elements, with hexahedra of the standard formulation as the measure of all others.
pub fn all() -> Result<Vec<Value>, Box<dyn Error>> {
    let mut results = Vec::new();
    for (kind, formulation, name) in [
        (CellKind::Hexahedron, Formulation::Standard, "standard"),
        (CellKind::Hexahedron, Formulation::MeanDilatation, "mean"),
        (CellKind::Hexahedron, Formulation::AssumedStrain, "assumed"),
        (CellKind::Tetrahedron, Formulation::Standard, "standard"),
        (
            CellKind::CompositeTetrahedron,
            Formulation::Standard,
            "standard",
        ),
        (
            CellKind::CompositeTetrahedron,
            Formulation::MeanDilatation,
            "mean",
        ),
    ] {
        results.push(responses(kind, formulation, &format!("{kind}, {name}"))?);
    }
    Ok(results)
}

/// Responses of all elements of a block to a stretch.
fn responses(
    cells: CellKind,
    formulation: Formulation,
    name: &str,
) -> Result<Value, Box<dyn Error>> {
    let block = Block {
        divisions: [10; 3],
        irregularity: 0.1,
        cells,
        ..Block::default()
    };
    let mesh = block.mesh()?;
    let elements = Elements::new(&mesh, formulation)?;
    let rubber = Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.49)?);
    let stretched = |x: &Vec3| Vec3::new(1.1 * x.x, x.y + 0.1 * x.x * x.z, 0.95 * x.z);
    let current: Vec<Vec3> = mesh.positions.iter().map(stretched).collect();
    let (_, block) = elements.blocks().next().ok_or("no elements")?;
    let mut response = ElementResponse::zero(block, &rubber);
    Ok(timed("element", name, block.count(), || {
        for (at, corners) in mesh.elements().enumerate() {
            let mut x = [Vec3::zeros(); striae_mesh::MAX_CORNERS];
            for (x, node) in x.iter_mut().zip(corners) {
                *x = current[node.index()];
            }
            let x = &x[..corners.len()];
            let result = block.respond(at, x, &rubber, Past::default(), &mut response);
            black_box((result.is_ok(), response.energy));
        }
    }))
}
