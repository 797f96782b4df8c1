//! Tests of the friction laws: one battery for all, then what is particular to each.

mod admissibility;
mod coefficient;
mod dependence;
mod errata;
mod factor;
mod healing;
mod laws;
mod own;
mod reference;
mod slip_surface;
mod state;
mod tabulated;

use nalgebra::Vector3;

use super::{Ellipse, Friction, Kernel, SlipRule, SlipSample};

/// A law of every kind with friction.
fn laws_of_all_kinds() -> Vec<Friction> {
    let laws = [
        Friction::coulomb(0.3),
        Friction::nap(0.11, 0.14, 0.2),
        Friction::orthotropic(0.2, 0.7, SlipRule::Opposing),
        Friction::orthotropic(0.2, 0.7, SlipRule::Associated),
        Friction::two_textures(0.5, 0.1, 0.1, 0.5),
        Friction::tabulated(&[0.0, 1.5, 3.0, 4.5], &[0.3, 0.15, 0.1, 0.2]),
    ];
    laws.map(|law| law.expect("the constants are in range"))
        .into()
}

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

/// Friction traction of slip with `z` along the unit vector `d`.
fn slipping(kernel: &Kernel<'_, f64>, cap: f64, d: &Vector3<f64>) -> Vector3<f64> {
    kernel.traction(cap, &(d * (cap * kernel.reach(d))))
}
