//! Balance of the resultants of the two sides of a patch: which combinations of force
//! and moment have rows, and what the others are held at.

use nalgebra::{Matrix3, Matrix3x6, Matrix6, Vector6};
use striae_mesh::Vec3;

use crate::{
    selection::Role,
    term::{Field, LocalTerm},
    transfer::Fields,
    unknowns::Tractions,
};

/// Combinations of force and moment that the rows of a patch stand for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BalanceRows {
    /// First balance unknown of the patch.
    pub first: u32,
    /// Patch centre.
    pub centre: Vec3,
    /// Patch radius.
    pub radius: f64,
    /// Weights of `(F, M/l)` in every active row.
    pub modes: Matrix6<f64>,
    /// Number of active rows.
    pub active: usize,
}

impl BalanceRows {
    /// Force and moment over the patch radius about the patch centre of forces at `x`.
    pub fn resultant(&self, x: &[Vec3; 4], force: &[Vec3; 4]) -> Vector6<f64> {
        let mut resultant = Vector6::zeros();
        for corner in 0..4 {
            let arm = (x[corner] - self.centre) / self.radius;
            let mut sum = resultant.fixed_view_mut::<3, 1>(0, 0);
            sum += force[corner];
            let mut sum = resultant.fixed_view_mut::<3, 1>(3, 0);
            sum += arm.cross(&force[corner]);
        }
        resultant
    }
}

/// Share of the largest eigenvalue below which a patch cannot be balanced in a direction.
const BALANCEABLE: f64 = 1e-8;

/// Which resultants of every patch its traction nodes can balance.
///
/// The correction `p_b (c + omega x r/l)` of the traction nodes spans all six
/// resultants unless there are too few of them under pressure; the eigenvectors
/// of `sum p B^T B`, `B = [I, -[r/l]_x]`, tell which.
pub fn balance_rows(fields: &Fields) -> Vec<BalanceRows> {
    let numbering = fields.configuration.pair.numbering();
    let mut gram = vec![Matrix6::<f64>::zeros(); fields.selection.patches.len()];
    for &side in fields.configuration.pair.deformable_sides() {
        for (node, role) in fields.selection.roles[side].iter().enumerate() {
            let (Role::Traction(_), Some(patch)) = (role, fields.selection.patch_of[side][node])
            else {
                continue;
            };
            let geometry = &fields.selection.patches[patch as usize];
            let arm = (fields.configuration.side(side).x[node] - geometry.centre) / geometry.radius;
            let pressure = fields.tractions.nodes[side][node][0].max(0.0);
            let mut b = Matrix3x6::<f64>::zeros();
            b.fixed_view_mut::<3, 3>(0, 0)
                .copy_from(&Matrix3::identity());
            b.fixed_view_mut::<3, 3>(0, 3)
                .copy_from(&-arm.cross_matrix());
            gram[patch as usize] += b.transpose() * b * pressure;
        }
    }
    let rows = |(patch, gram): (usize, &Matrix6<f64>)| {
        let geometry = &fields.selection.patches[patch];
        let eigen = gram.symmetric_eigen();
        let largest = eigen.eigenvalues.max();
        let mut order: Vec<usize> = (0..6).collect();
        order.sort_by(|&a, &b| eigen.eigenvalues[b].total_cmp(&eigen.eigenvalues[a]));
        let strong = |at: &&usize| largest > 0.0 && eigen.eigenvalues[**at] > BALANCEABLE * largest;
        let active = order.iter().filter(strong).count();
        let modes = if active == 6 {
            Matrix6::identity()
        } else {
            Matrix6::from_fn(|row, column| eigen.eigenvectors[(row, order[column])])
        };
        BalanceRows {
            first: numbering.balance(patch),
            centre: geometry.centre,
            radius: geometry.radius,
            modes,
            active,
        }
    };
    gram.iter().enumerate().map(rows).collect()
}

/// Rows that hold the components of `(c, omega l)` that cannot be balanced at zero.
pub fn held_balance(balance: &[BalanceRows], tractions: &Tractions) -> Vec<LocalTerm> {
    let mut terms = Vec::new();
    for (patch, rows) in balance.iter().enumerate() {
        let values = Vector6::from(tractions.balance[patch]);
        for mode in rows.active..6 {
            let weights = rows.modes.column(mode);
            terms.push(LocalTerm {
                rows: vec![rows.first + mode as u32],
                fields: vec![Field::Number],
                residual: vec![weights.dot(&values)],
                columns: (0..6).map(|at| rows.first + at).collect(),
                tangent: weights.iter().copied().collect(),
            });
        }
    }
    terms
}
