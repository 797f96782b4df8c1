//! The unit cube as a block of elements with dense matrices.

use nalgebra::{DMatrix, DVector};
use striae_element::{Elements, Formulation};
use striae_law::bulk::{Material, Past};
use striae_mesh::{CellKind, Mesh, NodeId, Vec3, generate};

/// Kind of the cells and formulation of the elements.
pub(crate) type Kind = (CellKind, Formulation);

/// All kinds of elements.
pub(crate) fn kinds() -> impl Iterator<Item = Kind> {
    let formulations = [Formulation::Standard, Formulation::MeanDilatation];
    let kinds = CellKind::ALL.into_iter();
    let plain = kinds.flat_map(move |cells| formulations.map(|formulation| (cells, formulation)));
    plain.chain([(CellKind::Hexahedron, Formulation::AssumedStrain)])
}

/// A block of `n^3` hexahedra, or cells made of them, over the unit cube.
pub(crate) struct Block {
    pub(crate) mesh: Mesh,
    pub(crate) reference: Elements,
}

/// A nodal force with its derivative by the node positions.
pub(crate) type Force = (DVector<f64>, DMatrix<f64>);

impl Block {
    /// The block with nodes disturbed by up to the fraction `irregularity` of a
    /// mesh size; those on faces and edges of the cube stay on them.
    pub(crate) fn new(n: usize, irregularity: f64, (cells, formulation): Kind) -> Self {
        let block = generate::Block {
            divisions: [n; 3],
            cells,
            irregularity,
            seed: n as u64,
            ..generate::Block::default()
        };
        Self::of(block.mesh().unwrap(), formulation)
    }

    /// A mesh with its elements.
    pub(crate) fn of(mesh: Mesh, formulation: Formulation) -> Self {
        let reference = Elements::new(&mesh, formulation).unwrap();
        Self { mesh, reference }
    }

    /// Returns whether an unknown belongs to a node on the surface of the cube.
    pub(crate) fn on_boundary(&self, unknown: usize) -> bool {
        let position = self.mesh.positions[unknown / 3];
        position.iter().any(|&x| x == 0.0 || x == 1.0)
    }

    /// No force at all.
    pub(crate) fn zero(&self) -> Force {
        let size = 3 * self.mesh.positions.len();
        (DVector::zeros(size), DMatrix::zeros(size, size))
    }

    /// Internal force at the node positions `x`.
    pub(crate) fn internal(&self, x: &[Vec3], material: &Material) -> Force {
        let mut total = self.zero();
        for (corners, element) in self.mesh.elements().zip(self.reference.iter()) {
            let current: Vec<Vec3> = corners.iter().map(|node| x[node.index()]).collect();
            let local = element
                .response(&current, material, Past::default())
                .unwrap();
            scatter(
                corners,
                local.force.as_flattened(),
                &local.stiffness.by_rows(),
                &mut total,
            );
        }
        total
    }

    /// Newton's method from `start`; the unknowns named by `fixed` rest.
    pub(crate) fn solve(
        &self,
        material: &Material,
        external: impl Fn(&[Vec3]) -> Force,
        start: &[Vec3],
        fixed: impl Fn(usize) -> bool,
    ) -> Vec<Vec3> {
        let free: Vec<usize> = (0..3 * start.len()).filter(|&u| !fixed(u)).collect();
        let constants = material.lame_constants();
        let round_off = 1e-14 * (constants.lambda + 2.0 * constants.shear);
        let mut x = start.to_vec();
        for _ in 0..12 {
            let ((force, stiffness), (load, tangent)) = (self.internal(&x, material), external(&x));
            let residual = (force - load).select_rows(&free);
            if residual.norm() < round_off {
                return x;
            }
            let matrix = (stiffness - tangent)
                .select_rows(&free)
                .select_columns(&free);
            let step = matrix.lu().solve(&residual).expect("a regular tangent");
            for (step, &unknown) in step.iter().zip(&free) {
                x[unknown / 3][unknown % 3] -= step;
            }
        }
        panic!("Newton's method did not converge");
    }
}

/// Adds a local force and tangent to the whole.
pub(crate) fn scatter(nodes: &[NodeId], force: &[f64], tangent: &[f64], total: &mut Force) {
    let global = |row: usize| 3 * nodes[row / 3].index() + row % 3;
    for row in 0..force.len() {
        total.0[global(row)] += force[row];
        for column in 0..force.len() {
            total.1[(global(row), global(column))] += tangent[force.len() * row + column];
        }
    }
}
