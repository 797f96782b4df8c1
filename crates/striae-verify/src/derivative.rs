//! Derivatives checked by the order of finite-difference errors.
//!
//! For a smooth `f: R^n -> R^m`, a point `x` and a direction `d`,
//!
//! ```text
//! e(h) = | D_h f - J(x) d |,   D_h f = (f(x + h d) - f(x)) / h           e = O(h)    forward
//!                              D_h f = (f(x + h d) - f(x - h d)) / 2h    e = O(h^2)  central
//! ```
//!
//! as long as truncation outweighs round-off, about `eps (|f| + |J d|) / h`.
//! A wrong Jacobian leaves an error that does not fall at all. No tolerance on
//! the derivative has to be chosen: the observed order decides.
//!
//! Steps run from 1/64 by halves, so `x` is to be scaled such that changes of
//! order one are what `f` is nonlinear over.

use crate::Random;
use nalgebra::{DMatrix, DVector};
use std::fmt;

/// Largest step.
const LARGEST_STEP: f64 = 1.0 / 64.0;
/// Number of steps, each half of the one before.
const STEPS: i32 = 16;
/// Errors below this multiple of the estimated round-off say nothing.
const ROUND_OFF_MARGIN: f64 = 100.0;
/// Steps over which the order is fitted: the smallest ones above round-off.
const FITTED: usize = 3;
/// Observed orders may fall short of the expected one by this much.
const SLACK: f64 = 0.25;
/// Random directions tried by [`assert_derivative`].
const DIRECTIONS: u64 = 4;

/// Finite difference with which a derivative is compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Difference {
    /// One-sided, of first order; for functions that may only be entered from one side.
    Forward,
    /// Two-sided, of second order.
    Central,
}

impl Difference {
    fn order(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Central => 2.0,
        }
    }
}

/// A derivative whose error does not fall at the expected order.
#[derive(Clone, Debug, PartialEq)]
pub struct WrongDerivative {
    /// The difference that was taken.
    pub difference: Difference,
    /// Observed order; `NaN` where `f` or the derivative is not finite.
    pub observed_order: f64,
    /// Norm of the claimed derivative along the direction.
    pub derivative_norm: f64,
    /// Steps and the errors at them.
    pub errors: Vec<(f64, f64)>,
}

impl WrongDerivative {
    /// True where the smallest step shows no error: larger ones cross kinks. A derivative that is
    /// wrong by 1e-8 is seen.
    pub fn is_of_kinks(&self) -> bool {
        let smallest = self.errors.last();
        smallest.is_some_and(|(_, error)| *error <= 1e-8 * self.derivative_norm)
    }
}

impl fmt::Display for WrongDerivative {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:?} difference: observed order {:.3}, expected {}; |J d| = {:.6e}",
            self.difference,
            self.observed_order,
            self.difference.order(),
            self.derivative_norm
        )?;
        for (step, error) in &self.errors {
            writeln!(f, "  h = {step:9.3e}  error = {error:9.3e}")?;
        }
        Ok(())
    }
}

/// Asserts that `jacobian(x)`, of shape `m x n`, is the derivative of `f` at `x`:
/// columns by forward and central differences along four random directions.
///
/// # Panics
///
/// With a [`WrongDerivative`] and the direction.
pub fn assert_derivative(
    f: impl Fn(&DVector<f64>) -> DVector<f64>,
    jacobian: impl Fn(&DVector<f64>) -> DMatrix<f64>,
    x: &DVector<f64>,
) {
    let matrix = jacobian(x);
    for seed in 0..DIRECTIONS {
        let direction = Random::new(seed).unit(x.len());
        let claimed = &matrix * &direction;
        assert_directional(&f, &claimed, x, &direction);
    }
}

/// Asserts that `claimed` is the derivative of `f` at `x` along `direction`,
/// by forward and by central differences.
///
/// # Panics
///
/// With a [`WrongDerivative`] and the direction.
pub fn assert_directional(
    f: impl Fn(&DVector<f64>) -> DVector<f64>,
    claimed: &DVector<f64>,
    x: &DVector<f64>,
    direction: &DVector<f64>,
) {
    for difference in [Difference::Forward, Difference::Central] {
        if let Err(fault) = directional(difference, &f, claimed, x, direction) {
            panic!("{fault}along {:?}", direction.as_slice());
        }
    }
}

/// Observed order of the error of `difference` along `direction`; `None` where
/// all errors drown in round-off, as for a linear `f`.
///
/// # Errors
///
/// If the order falls short of the expected one by more than a quarter, and the errors do not
/// tend to nothing either.
pub fn directional(
    difference: Difference,
    f: impl Fn(&DVector<f64>) -> DVector<f64>,
    claimed: &DVector<f64>,
    x: &DVector<f64>,
    direction: &DVector<f64>,
) -> Result<Option<f64>, WrongDerivative> {
    let at_x = f(x);
    let magnitude = at_x.norm() + claimed.norm();
    let mut errors = Vec::new();
    let mut telling = Vec::new();
    for k in 0..STEPS {
        let h = LARGEST_STEP * 0.5f64.powi(k);
        let slope = match difference {
            Difference::Forward => (f(&(x + direction * h)) - &at_x) / h,
            Difference::Central => (f(&(x + direction * h)) - f(&(x - direction * h))) / (2.0 * h),
        };
        let deviation = slope - claimed;
        let error = deviation.norm();
        errors.push((h, error));
        // Written so that an error that is not a number is telling.
        let drowned = error <= ROUND_OFF_MARGIN * f64::EPSILON * magnitude / h;
        if !drowned {
            telling.push((h, deviation));
        }
    }
    let fitted = &telling[telling.len().saturating_sub(FITTED)..];
    if fitted.len() < FITTED && fitted.iter().all(|(_, e)| e.norm().is_finite()) {
        return Ok(None);
    }
    let observed_order = order(fitted);
    let expected = difference.order();
    if observed_order >= expected - SLACK || vanishes(fitted, expected) {
        return Ok(Some(observed_order));
    }
    Err(WrongDerivative {
        difference,
        observed_order,
        derivative_norm: claimed.norm(),
        errors,
    })
}

/// Returns whether the deviations tend to zero, extrapolated to a step of zero as a polynomial in
/// `h^order`, relative to the smallest of them.
///
/// If the first two terms of the error cancel at some step, the error passes through zero there and
/// decreases slowly below, although the derivative is right: with `e = h (1 - h / h_0)` the order
/// between `h_0 / 2` and `h_0 / 4` is .4. The polynomial includes both terms. The error of a wrong
/// derivative remains in it entirely.
fn vanishes(points: &[(f64, DVector<f64>)], order: f64) -> bool {
    let mut limit = DVector::zeros(points[0].1.len());
    for (i, (h, deviation)) in points.iter().enumerate() {
        let mut weight = 1.0;
        for (j, (other, _)) in points.iter().enumerate() {
            if i != j {
                weight /= 1.0 - (h / other).powf(order);
            }
        }
        limit += deviation * weight;
    }
    let (_, smallest) = &points[points.len() - 1];
    limit.norm() <= SLACK * smallest.norm()
}

/// Slope of the errors over the steps in logarithms, `NaN` unless all are finite.
fn order(points: &[(f64, DVector<f64>)]) -> f64 {
    let (h, error): (Vec<f64>, Vec<f64>) = points.iter().map(|(h, e)| (*h, e.norm())).unzip();
    if error.iter().any(|error| !error.is_finite()) {
        return f64::NAN;
    }
    crate::fitted_rate(&h, &error)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn f(x: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(vec![x[0].sin() * x[1].exp(), x[0] * x[1], x[1].powi(3)])
    }

    fn jacobian(x: &DVector<f64>) -> DMatrix<f64> {
        let (s, c, e) = (x[0].sin(), x[0].cos(), x[1].exp());
        DMatrix::from_row_slice(3, 2, &[c * e, s * e, x[1], x[0], 0.0, 3.0 * x[1].powi(2)])
    }

    fn point() -> DVector<f64> {
        DVector::from_vec(vec![0.7, 1.3])
    }

    fn orders(claimed: &DVector<f64>) -> [Result<Option<f64>, WrongDerivative>; 2] {
        [Difference::Forward, Difference::Central]
            .map(|difference| directional(difference, f, claimed, &point(), &direction()))
    }

    fn direction() -> DVector<f64> {
        Random::new(9).unit(2)
    }

    #[test]
    fn a_right_derivative_shows_orders_one_and_two() {
        assert_derivative(f, jacobian, &point());
        let [forward, central] = orders(&(jacobian(&point()) * direction()));
        assert!((forward.unwrap().unwrap() - 1.0).abs() < 0.05);
        assert!((central.unwrap().unwrap() - 2.0).abs() < 0.05);
    }

    #[test]
    fn an_error_of_one_in_ten_million_is_seen() {
        let claimed = jacobian(&point()) * direction() * (1.0 + 1e-7);
        let [_, central] = orders(&claimed);
        assert!(central.unwrap_err().observed_order < 1.0);
    }

    #[test]
    fn a_linear_function_has_no_order() {
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, 2.0, 3.0, 4.0]);
        let claimed = &matrix * direction();
        for difference in [Difference::Forward, Difference::Central] {
            let order = directional(
                difference,
                |x| &matrix * x,
                &claimed,
                &point(),
                &direction(),
            );
            assert_eq!(order, Ok(None));
        }
    }

    #[test]
    fn what_is_not_a_number_is_refused() {
        let [forward, central] = orders(&DVector::from_vec(vec![f64::NAN, 0.0, 0.0]));
        assert!(forward.is_err() && central.is_err());
    }

    #[test]
    fn an_error_that_passes_through_zero_is_none() {
        let zero = DVector::zeros(1);
        let one = DVector::from_element(1, 1.0);
        let cubic = |x: &DVector<f64>| x.map(|v| 1.0 + v + 1e-6 * (v * v - v.powi(3) / 1.6e-3));
        let order = directional(Difference::Forward, cubic, &one, &zero, &one);
        assert!(order.unwrap().unwrap() < 0.5);
        let wrong = &one * (1.0 + 1e-9);
        assert!(directional(Difference::Forward, cubic, &wrong, &zero, &one).is_err());
    }

    #[test]
    fn a_kink_shows_first_order_only() {
        let kink = |x: &DVector<f64>| x.map(|v| v.max(0.0) + v * v);
        let zero = DVector::zeros(1);
        let one = DVector::from_element(1, 1.0);
        assert!(directional(Difference::Forward, kink, &one, &zero, &one).is_ok());
        assert!(directional(Difference::Central, kink, &one, &zero, &one).is_err());
    }
}
