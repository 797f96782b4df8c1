//! Checks of single elements of every kind.

mod actuation;
mod mass;
mod memory;
mod single;
mod tangents;

use super::{Element, ElementResponse, Elements, Formulation};

use striae_law::bulk::{LameConstants, Material, Past};
use striae_mesh::{CellBlock, CellKind, Mesh, NodeId, Vec3};
use striae_verify::Random;

fn neo_hookean() -> Material {
    Material::neo_hookean(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap())
}

fn linear_elastic() -> Material {
    Material::linear_elastic(LameConstants::from_youngs_modulus(1.0, 0.3).unwrap())
}

const FORMULATIONS: [Formulation; 3] = [
    Formulation::Standard,
    Formulation::MeanDilatation,
    Formulation::AssumedStrain,
];

/// One element.
struct Single {
    kind: CellKind,
    reference: Vec<Vec3>,
    elements: Elements,
}

impl Single {
    fn new(kind: CellKind, formulation: Formulation, reference: Vec<Vec3>) -> Self {
        let block = CellBlock {
            kind,
            nodes: (0..reference.len()).map(NodeId::new).collect(),
        };
        let mesh = Mesh::new(reference.clone(), vec![block]).unwrap();
        Self {
            kind,
            reference,
            elements: Elements::new(&mesh, formulation).unwrap(),
        }
    }

    /// With edges half the natural size, or all of it where they are divided by a node;
    /// corners disturbed by at most `amplitude`.
    fn distorted(
        kind: CellKind,
        formulation: Formulation,
        random: &mut Random,
        amplitude: f64,
    ) -> Self {
        let size = match kind {
            CellKind::CompositeTetrahedron => 1.0,
            _ => 0.5,
        };
        let corners = kind.shape().corners.iter();
        let corners = corners.map(|x| Vec3::from(*x) * size + random.vector3() * amplitude);
        Self::new(kind, formulation, corners.collect())
    }

    fn element(&self) -> Element<'_> {
        self.elements.iter().next().unwrap()
    }

    fn response(&self, x: &[Vec3], material: &Material) -> ElementResponse {
        self.element()
            .response(x, material, Past::default())
            .unwrap()
    }

    /// Each corner disturbed by at most `amplitude`.
    fn disturbed(&self, random: &mut Random, amplitude: f64) -> Vec<Vec3> {
        let reference = self.reference.iter();
        reference
            .map(|x| x + random.vector3() * amplitude)
            .collect()
    }
}
