//! Student's distribution for a whole number of degrees of freedom, in closed form.
//!
//! With `t = sqrt(nu) tan(theta)` the probability of `|T| <= t` is
//!
//! ```text
//! nu odd:   2/pi (theta + sin theta [cos theta + (2/3) cos^3 theta + ... + (2.4...(nu-3))/(3.5...(nu-2)) cos^(nu-2) theta])
//! nu even:  sin theta [1 + (1/2) cos^2 theta + (1.3)/(2.4) cos^4 theta + ... + (1.3...(nu-3))/(2.4...(nu-2)) cos^(nu-2) theta]
//! ```
//!
//! Source: Abramowitz & Stegun (1964), Handbook of Mathematical Functions, 26.7.3 and 26.7.4.

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

/// The `t` that `|T|` does not exceed with the probability `level`.
pub(super) fn two_sided(level: f64, degrees_of_freedom: usize) -> f64 {
    let (mut below, mut above) = (0.0, FRAC_PI_2);
    loop {
        let theta = 0.5 * (below + above);
        if theta <= below || theta >= above {
            return (degrees_of_freedom as f64).sqrt() * theta.tan();
        }
        if probability(theta, degrees_of_freedom) < level {
            below = theta;
        } else {
            above = theta;
        }
    }
}

/// Probability of `|T| <= sqrt(nu) tan(theta)`.
fn probability(theta: f64, degrees_of_freedom: usize) -> f64 {
    let (sine, cosine) = theta.sin_cos();
    let odd = degrees_of_freedom % 2 == 1;
    // Powers 1, 3, .. nu - 2 of the cosine, or 0, 2, .. nu - 2.
    let first = usize::from(odd);
    let mut term = if odd { cosine } else { 1.0 };
    let mut sum = 0.0;
    for power in (first..(degrees_of_freedom - 1).max(first)).step_by(2) {
        sum += term;
        term *= cosine * cosine * (power + 1) as f64 / (power + 2) as f64;
    }
    if odd {
        FRAC_2_PI * (theta + sine * sum)
    } else {
        sine * sum
    }
}

#[cfg(test)]
mod tests {
    use super::two_sided;

    #[test]
    fn quantiles_are_those_of_tables() {
        // Abramowitz & Stegun, table 26.10, printed to three decimals.
        for (level, nu, t) in [
            (0.95, 1, 12.706),
            (0.95, 2, 4.303),
            (0.95, 3, 3.182),
            (0.99, 4, 4.604),
            (0.95, 9, 2.262),
            (0.90, 10, 1.812),
            (0.99, 30, 2.750),
            (0.95, 120, 1.980),
        ] {
            let found = two_sided(level, nu);
            assert!((found - t).abs() < 5.01e-4, "{level} {nu}: {found}");
        }
    }

    #[test]
    fn many_degrees_of_freedom_tend_to_the_normal_distribution() {
        // z + (z^3 + z)/(4 nu), Abramowitz & Stegun 26.7.5.
        let z = 1.959_963_984_540_054_f64;
        for nu in [1000, 1001] {
            let expected = z + (z.powi(3) + z) / (4.0 * f64::from(nu));
            assert!((two_sided(0.95, nu as usize) - expected).abs() < 1e-5);
        }
    }
}
