//! Contact over a strip: cylinders side by side in plane strain. Forces are per
//! length.
//!
//! With `1/R = 1/R_1 + 1/R_2` and the contact modulus `E*`
//!
//! ```text
//! a = sqrt(4 P R/(pi E*))    p0 = 2P/(pi a)    c = a sqrt(1 - Q/mu P)
//! ```
//!
//! (Johnson 1985, equations 4.43-4.45 and 7.21-7.28.) The displacements depend
//! on the shape of the whole bodies and have no such form.

use std::f64::consts::PI;

use super::{partial_slip, semi_ellipse};

/// Hertz's contact over a strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineContact {
    /// Force per length `P` that presses the bodies together.
    pub force: f64,
    /// Half the width `a` of the strip.
    pub half_width: f64,
    /// Pressure `p0` in the middle.
    pub peak_pressure: f64,
}

/// Cattaneo and Mindlin's partial slip of a contact strip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinePartialSlip {
    /// The contact.
    pub contact: LineContact,
    /// Coefficient of friction.
    pub mu: f64,
    /// Force per length `Q` along the plane, across the strip.
    pub force: f64,
    /// Half the width `c` of the stick zone; 0 in full slip.
    pub stick_half_width: f64,
}

impl LineContact {
    /// The contact under a force per length, with radius of curvature `R` and
    /// modulus `E*`.
    pub fn new(force: f64, curvature_radius: f64, modulus: f64) -> Self {
        let half_width = (4.0 * force * curvature_radius / (PI * modulus)).sqrt();
        Self {
            force,
            half_width,
            peak_pressure: 2.0 * force / (PI * half_width),
        }
    }

    /// Pressure at a distance from the middle.
    pub fn pressure(&self, x: f64) -> f64 {
        self.peak_pressure * semi_ellipse(x / self.half_width)
    }
}

impl LinePartialSlip {
    /// The contact under a tangential force per length `0 <= Q`; full slip from
    /// `mu P` on.
    pub fn new(contact: LineContact, mu: f64, force: f64) -> Self {
        let left = (1.0 - force / (mu * contact.force)).max(0.0);
        Self {
            contact,
            mu,
            force,
            stick_half_width: contact.half_width * left.sqrt(),
        }
    }

    /// Traction along `Q` at a distance from the middle.
    pub fn traction(&self, x: f64) -> f64 {
        let contact = &self.contact;
        self.mu * contact.peak_pressure * partial_slip(x, contact.half_width, self.stick_half_width)
    }

    /// Largest traction, at the edge of the stick zone.
    pub fn peak_traction(&self) -> f64 {
        self.traction(self.stick_half_width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::closed_forms::contact_modulus;

    const MU: f64 = 0.2;

    /// Two half cylinders of radius 8, `E = 200`, `nu = 0.3`, pressed by 0.625
    /// over their diameter.
    fn contact() -> LineContact {
        let modulus = contact_modulus(&[[200.0, 0.3]; 2]);
        LineContact::new(0.625 * 16.0, 4.0, modulus)
    }

    /// `integral f dx` over `-limit .. limit`, by the midpoint rule after
    /// `x = limit sin t`, under which semi-ellipses are smooth.
    fn over_strip(limit: f64, f: impl Fn(f64) -> f64) -> f64 {
        const PARTS: usize = 4000;
        let step = PI / PARTS as f64;
        let angles = (0..PARTS).map(|i| (i as f64 + 0.5) * step - 0.5 * PI);
        let sum: f64 = angles.map(|t| f(limit * t.sin()) * limit * t.cos()).sum();
        step * sum
    }

    #[test]
    fn the_known_example_is_met() {
        let slip = LinePartialSlip::new(contact(), MU, 0.05851 * 16.0);
        let near = |value: f64, known: f64| assert!((value / known - 1.0).abs() < 1e-5, "{value}");
        near(contact().half_width, 0.680778);
        near(contact().peak_pressure, 9.35135);
        near(slip.stick_half_width, 0.496511);
        near(slip.peak_traction(), 1.27957);
        near(slip.traction(0.0), 0.50623);
    }

    #[test]
    fn pressure_and_traction_carry_the_forces() {
        let a = contact().half_width;
        let carried = over_strip(a, |x| contact().pressure(x));
        assert!((carried / contact().force - 1.0).abs() < 1e-6);
        for share in [0.0, 0.3, 0.9, 1.0] {
            let force = share * MU * contact().force;
            let slip = LinePartialSlip::new(contact(), MU, force);
            let c = slip.stick_half_width;
            let outside = MU * (carried - over_strip(c, |x| contact().pressure(x)));
            let carried = over_strip(c, |x| slip.traction(x)) + outside;
            assert!((carried - force).abs() < 1e-6 * MU * contact().force);
        }
    }

    #[test]
    fn limits_are_no_traction_and_coulomb_everywhere() {
        let none = LinePartialSlip::new(contact(), MU, 0.0);
        let full = LinePartialSlip::new(contact(), MU, MU * contact().force);
        assert_eq!(none.stick_half_width, contact().half_width);
        assert_eq!(full.stick_half_width, 0.0);
        for x in [-0.6, 0.0, 0.3, 0.9] {
            assert_eq!(none.traction(x), 0.0);
            let limit = MU * contact().pressure(x);
            assert!((full.traction(x) - limit).abs() <= 1e-15 * limit);
        }
    }

    /// The stick zone moves as a whole: the strain of the surface,
    /// proportional to `pv integral q(s)/(x - s) ds`, vanishes in it. The
    /// integral is taken with the pole subtracted, which leaves
    /// `q(x) log((a + x)/(a - x))`.
    #[test]
    fn the_stick_zone_is_not_strained() {
        let slip = LinePartialSlip::new(contact(), MU, 0.5 * MU * contact().force);
        let (a, c) = (contact().half_width, slip.stick_half_width);
        let strain = |x: f64| {
            let regular = over_strip(a, |s| {
                let near = (s - x).abs() < 1e-12;
                let difference = slip.traction(s) - slip.traction(x);
                if near { 0.0 } else { difference / (x - s) }
            });
            regular + slip.traction(x) * ((a + x) / (a - x)).ln()
        };
        let scale = slip.peak_traction();
        for share in [-0.9, -0.4, 0.1, 0.6] {
            assert!(strain(share * c).abs() < 2e-2 * scale, "{share}");
        }
        assert!(strain(0.5 * (a + c)).abs() > 0.5 * scale);
    }
}
