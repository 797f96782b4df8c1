//! Numbers that factors are kept in, with their vector instructions.

use faer::traits::ComplexField;
use pulp::Simd;
use std::{
    iter::Sum,
    ops::{AddAssign, Div, Mul, MulAssign, Sub, SubAssign},
};

/// Precision of factors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// Single: half the memory and half the time, and seven digits.
    Single,
    /// Double.
    #[default]
    Double,
}

impl Precision {
    /// Bytes of a number.
    pub fn bytes(self) -> usize {
        match self {
            Self::Single => size_of::<f32>(),
            Self::Double => size_of::<f64>(),
        }
    }
}

/// `f32` or `f64`.
pub trait Real:
    ComplexField
    + Copy
    + Default
    + PartialOrd
    + Send
    + Sync
    + Sum
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + 'static
{
    /// Pivot of a positive definite matrix with unit diagonal that counts as not positive.
    const TINY: f64;

    /// Several of them side by side.
    type Lanes<S: Simd>: Copy;

    /// The nearest one.
    fn of(value: f64) -> Self;
    /// Conversion to double precision.
    fn double(self) -> f64;
    /// Its root.
    fn root(self) -> Self;

    /// A slice by whole lanes, and what is left.
    fn lanes<S: Simd>(values: &[Self]) -> (&[Self::Lanes<S>], &[Self]);
    /// Mutable version of [`lanes`](Self::lanes).
    fn lanes_mut<S: Simd>(values: &mut [Self]) -> (&mut [Self::Lanes<S>], &mut [Self]);
    /// One value in all lanes.
    fn splat<S: Simd>(simd: S, value: Self) -> Self::Lanes<S>;
    /// `a + b`.
    fn plus<S: Simd>(simd: S, a: Self::Lanes<S>, b: Self::Lanes<S>) -> Self::Lanes<S>;
    /// `a b`.
    fn product<S: Simd>(simd: S, a: Self::Lanes<S>, b: Self::Lanes<S>) -> Self::Lanes<S>;
    /// `a b + c`.
    fn multiply_add<S: Simd>(
        simd: S,
        a: Self::Lanes<S>,
        b: Self::Lanes<S>,
        c: Self::Lanes<S>,
    ) -> Self::Lanes<S>;
    /// Sum of all lanes.
    fn total<S: Simd>(simd: S, a: Self::Lanes<S>) -> Self;
}

macro_rules! real {
    ($type:ty, $tiny:expr, $lanes:ident, $slice:ident, $slice_mut:ident, $splat:ident,
     $add:ident, $multiply:ident, $multiply_add:ident, $total:ident) => {
        impl Real for $type {
            const TINY: f64 = $tiny;

            type Lanes<S: Simd> = S::$lanes;

            #[inline(always)]
            fn of(value: f64) -> Self {
                value as Self
            }

            #[inline(always)]
            fn double(self) -> f64 {
                f64::from(self)
            }

            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn lanes<S: Simd>(values: &[Self]) -> (&[S::$lanes], &[Self]) {
                S::$slice(values)
            }

            #[inline(always)]
            fn lanes_mut<S: Simd>(values: &mut [Self]) -> (&mut [S::$lanes], &mut [Self]) {
                S::$slice_mut(values)
            }

            #[inline(always)]
            fn splat<S: Simd>(simd: S, value: Self) -> S::$lanes {
                simd.$splat(value)
            }

            #[inline(always)]
            fn plus<S: Simd>(simd: S, a: S::$lanes, b: S::$lanes) -> S::$lanes {
                simd.$add(a, b)
            }

            #[inline(always)]
            fn product<S: Simd>(simd: S, a: S::$lanes, b: S::$lanes) -> S::$lanes {
                simd.$multiply(a, b)
            }

            #[inline(always)]
            fn multiply_add<S: Simd>(
                simd: S,
                a: S::$lanes,
                b: S::$lanes,
                c: S::$lanes,
            ) -> S::$lanes {
                simd.$multiply_add(a, b, c)
            }

            #[inline(always)]
            fn total<S: Simd>(simd: S, a: S::$lanes) -> Self {
                simd.$total(a)
            }
        }
    };
}

real!(
    f32,
    2e-6,
    f32s,
    as_simd_f32s,
    as_mut_simd_f32s,
    splat_f32s,
    add_f32s,
    mul_f32s,
    mul_add_e_f32s,
    reduce_sum_f32s
);
real!(
    f64,
    1e-13,
    f64s,
    as_simd_f64s,
    as_mut_simd_f64s,
    splat_f64s,
    add_f64s,
    mul_f64s,
    mul_add_e_f64s,
    reduce_sum_f64s
);
