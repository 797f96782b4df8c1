//! Tests of the friction laws: one battery for all, then what is particular to each.

mod admissibility;
mod coefficient;
mod errata;
mod laws;
mod own;
mod reference;
mod slip_surface;
mod tabulated;

use super::{Ellipse, SlipSample};

/// Points at equal angles, dense enough for brute force.
fn dense(surface: &Ellipse) -> Vec<SlipSample> {
    surface.sampled(7200)
}

/// Asserts that `value`, printed to `decimals`, reads `printed`.
fn assert_reads(value: f64, printed: f64, decimals: i32) {
    let half_a_digit = 0.5 * 10f64.powi(-decimals);
    assert!(
        (value - printed).abs() <= half_a_digit,
        "{value} does not read {printed}"
    );
}
