//! Scalars with hand-written gradients over the lanes of a kernel.

use striae_mesh::Vec3;

/// A scalar and its gradient over `N` lanes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity<const N: usize> {
    /// The value.
    pub re: f64,
    /// Its derivatives.
    pub slope: [f64; N],
}

impl<const N: usize> Quantity<N> {
    /// A value without derivatives.
    pub fn constant(re: f64) -> Self {
        Self {
            re,
            slope: [0.0; N],
        }
    }

    /// The lane `lane` itself.
    pub fn variable(re: f64, lane: usize) -> Self {
        let mut variable = Self::constant(re);
        variable.slope[lane] = 1.0;
        variable
    }

    /// Adds to the derivatives by the vector on the lanes from `lane` on.
    pub fn depend(&mut self, lane: usize, derivative: &Vec3) {
        for axis in 0..3 {
            self.slope[lane + axis] += derivative[axis];
        }
    }

    /// `sum factor quantity`.
    pub fn combination<const K: usize>(parts: [(f64, &Self); K]) -> Self {
        let mut sum = Self::constant(0.0);
        for (factor, quantity) in parts {
            sum.re += factor * quantity.re;
            for (slope, other) in sum.slope.iter_mut().zip(&quantity.slope) {
                *slope += factor * other;
            }
        }
        sum
    }

    /// `a b`.
    pub fn product(a: &Self, b: &Self) -> Self {
        Self {
            re: a.re * b.re,
            ..Self::combination([(a.re, b), (b.re, a)])
        }
    }
}
