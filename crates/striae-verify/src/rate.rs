//! Rates of convergence.
//!
//! With `error = C h^r` the rate `r` is the slope of `log error` over `log h`,
//! fitted here by least squares.

/// The rate `r` in `error = C h^r`, by least squares over the logarithms.
///
/// # Panics
///
/// Unless there are at least two pairs, all of them positive and finite.
pub fn fitted_rate(h: &[f64], error: &[f64]) -> f64 {
    assert_eq!(h.len(), error.len(), "as many errors as mesh sizes");
    assert!(h.len() >= 2, "a rate needs two points");
    assert!(
        h.iter().chain(error).all(|v| *v > 0.0 && v.is_finite()),
        "mesh sizes {h:?} and errors {error:?} must be positive and finite"
    );
    let count = h.len() as f64;
    let log_h: Vec<f64> = h.iter().map(|v| v.ln()).collect();
    let log_error: Vec<f64> = error.iter().map(|v| v.ln()).collect();
    let mean_h = log_h.iter().sum::<f64>() / count;
    let mean_error = log_error.iter().sum::<f64>() / count;
    let (mut above, mut below) = (0.0, 0.0);
    for (x, y) in log_h.iter().zip(&log_error) {
        above += (x - mean_h) * (y - mean_error);
        below += (x - mean_h).powi(2);
    }
    above / below
}

#[cfg(test)]
mod tests {
    use super::fitted_rate;

    #[test]
    fn an_exact_power_is_found() {
        let h = [0.5, 0.25, 0.125, 0.0625];
        let error = h.map(|h: f64| 7.0 * h.powf(1.5));
        assert!((fitted_rate(&h, &error) - 1.5).abs() < 1e-13);
    }

    #[test]
    #[should_panic(expected = "must be positive")]
    fn a_vanishing_error_has_no_rate() {
        fitted_rate(&[1.0, 0.5], &[1.0, 0.0]);
    }
}
