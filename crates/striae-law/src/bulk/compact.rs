//! Tangents of a few numbers: those of the form
//!
//! ```text
//! A_iJkL = identity d_ik d_JL + crossed B_iL B_kJ + direct B_iJ B_kL,   B = F^-T
//! ```
//!
//! The stiffness of an element takes half the work with them.

use super::Tangent;
use nalgebra::Matrix3;

/// A tangent of a few numbers:
/// `A_iJkL = identity d_ik d_JL + crossed B_iL B_kJ + direct B_iJ B_kL`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompactTangent {
    /// Factor of `d_ik d_JL`.
    pub identity: f64,
    /// Factor of `B_iL B_kJ`.
    pub crossed: f64,
    /// Factor of `B_iJ B_kL`.
    pub direct: f64,
    /// `B = F^-T`.
    pub inverse_transposed: Matrix3<f64>,
}

impl CompactTangent {
    /// All components, column `3 k + L` by column.
    #[allow(non_snake_case)]
    #[inline]
    pub fn full(&self) -> Tangent {
        let mut A = Tangent::zeros();
        let B = &self.inverse_transposed;
        let (crossed_B, direct_B) = (B * self.crossed, B * self.direct);
        // All rows `3 i + J` of a column at once.
        let direct_iJ: [f64; 9] = std::array::from_fn(|row| direct_B[(row / 3, row % 3)]);
        for k in 0..3 {
            let B_kJ: [f64; 9] = std::array::from_fn(|row| B[(k, row % 3)]);
            for L in 0..3 {
                let crossed_iL: [f64; 9] = std::array::from_fn(|row| crossed_B[(row / 3, L)]);
                let (at, B_kL) = (3 * k + L, B[(k, L)]);
                let column = &mut A.data.0[at];
                for row in 0..9 {
                    column[row] = crossed_iL[row] * B_kJ[row] + direct_iJ[row] * B_kL;
                }
                column[at] += self.identity;
            }
        }
        A
    }
}
