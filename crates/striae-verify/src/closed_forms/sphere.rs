//! Contact over a circle: a sphere on a plane, or two spheres.
//!
//! With `1/R = 1/R_1 + 1/R_2` and the contact modulus `E*`
//!
//! ```text
//! a = (3 P R/4E*)^(1/3)    p0 = 3P/(2 pi a^2)    delta = a^2/R               Hertz
//! c = a (1 - Q/mu P)^(1/3)                                                   Mindlin
//! delta_x = 3 mu P C/(16 a) [1 - (1 - Q/mu P)^(2/3)],   C = sum (2 - nu)/G
//! ```
//!
//! (Johnson 1985, equations 4.22-4.24 and 7.31-7.42.)

use std::f64::consts::PI;

use super::{partial_slip, semi_ellipse};

/// Hertz's contact over a circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointContact {
    /// Force `P` that presses the bodies together.
    pub force: f64,
    /// Radius `a` of the contact circle.
    pub radius: f64,
    /// Pressure `p0` in the middle.
    pub peak_pressure: f64,
    /// Approach `delta` of the bodies.
    pub approach: f64,
}

/// Mindlin's partial slip of a contact circle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PartialSlip {
    /// The contact.
    pub contact: PointContact,
    /// Coefficient of friction.
    pub mu: f64,
    /// Force `Q` along the plane.
    pub force: f64,
    /// Radius `c` of the stick zone; 0 in full slip.
    pub stick_radius: f64,
}

impl PointContact {
    /// The contact under a force, with radius of curvature `R` and modulus `E*`.
    pub fn new(force: f64, curvature_radius: f64, modulus: f64) -> Self {
        let radius = (0.75 * force * curvature_radius / modulus).cbrt();
        Self {
            force,
            radius,
            peak_pressure: 1.5 * force / (PI * radius * radius),
            approach: radius * radius / curvature_radius,
        }
    }

    /// Pressure at a distance from the middle.
    pub fn pressure(&self, r: f64) -> f64 {
        self.peak_pressure * semi_ellipse(r / self.radius)
    }
}

impl PartialSlip {
    /// The contact under a tangential force `0 <= Q`; full slip from `mu P` on.
    pub fn new(contact: PointContact, mu: f64, force: f64) -> Self {
        let left = (1.0 - force / (mu * contact.force)).max(0.0);
        Self {
            contact,
            mu,
            force,
            stick_radius: contact.radius * left.cbrt(),
        }
    }

    /// Traction along `Q` at a distance from the middle.
    pub fn traction(&self, r: f64) -> f64 {
        let contact = &self.contact;
        self.mu * contact.peak_pressure * partial_slip(r, contact.radius, self.stick_radius)
    }

    /// Largest traction, at the edge of the stick zone.
    pub fn peak_traction(&self) -> f64 {
        self.traction(self.stick_radius)
    }

    /// Relative tangential displacement of points far away, for
    /// `compliance = sum (2 - nu)/G` over the deformable bodies.
    pub fn displacement(&self, compliance: f64) -> f64 {
        let a = self.contact.radius;
        let left = (self.stick_radius / a).powi(2);
        3.0 * self.mu * self.contact.force * compliance / (16.0 * a) * (1.0 - left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RADIUS: f64 = 12.0;
    const MODULUS: f64 = 0.546;
    const MU: f64 = 0.1;

    fn contact() -> PointContact {
        PointContact::new(0.2, RADIUS, MODULUS)
    }

    /// `2 pi integral f r dr` over a circle, by the midpoint rule after
    /// `r = limit sin t`, under which semi-ellipses are smooth.
    fn over_circle(limit: f64, f: impl Fn(f64) -> f64) -> f64 {
        const PARTS: usize = 4000;
        let step = 0.5 * PI / PARTS as f64;
        let angles = (0..PARTS).map(|i| (i as f64 + 0.5) * step);
        let sum: f64 = angles
            .map(|t| f(limit * t.sin()) * limit * limit * t.sin() * t.cos())
            .sum();
        2.0 * PI * step * sum
    }

    #[test]
    fn the_pressure_carries_the_force() {
        let contact = contact();
        let carried = over_circle(contact.radius, |r| contact.pressure(r));
        assert!((carried / contact.force - 1.0).abs() < 1e-6);
        assert_eq!(contact.pressure(1.01 * contact.radius), 0.0);
    }

    #[test]
    fn force_and_approach_are_hertz_power_law() {
        let contact = contact();
        let force = 4.0 / 3.0 * MODULUS * RADIUS.sqrt() * contact.approach.powf(1.5);
        assert!((force / contact.force - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_traction_carries_the_tangential_force() {
        for share in [0.0, 0.2, 0.7, 1.0] {
            let force = share * MU * contact().force;
            let slip = PartialSlip::new(contact(), MU, force);
            let inside = over_circle(slip.stick_radius, |r| slip.traction(r));
            let whole = over_circle(contact().radius, |r| MU * contact().pressure(r));
            let under = over_circle(slip.stick_radius, |r| MU * contact().pressure(r));
            let carried = inside + whole - under;
            assert!((carried - force).abs() < 1e-6 * MU * contact().force);
        }
    }

    #[test]
    fn limits_are_no_traction_and_coulomb_everywhere() {
        let none = PartialSlip::new(contact(), MU, 0.0);
        assert_eq!(none.stick_radius, contact().radius);
        let full = PartialSlip::new(contact(), MU, MU * contact().force);
        assert_eq!(full.stick_radius, 0.0);
        for r in [0.0, 0.5, 1.2, 2.0] {
            assert_eq!(none.traction(r), 0.0);
            let limit = MU * contact().pressure(r);
            assert!((full.traction(r) - limit).abs() <= 1e-15 * limit);
        }
        assert_eq!(PartialSlip::new(contact(), MU, 1.0).stick_radius, 0.0);
    }

    #[test]
    fn friction_is_used_up_just_where_it_slips() {
        let slip = PartialSlip::new(contact(), MU, 0.5 * MU * contact().force);
        for i in 0..100 {
            let r = contact().radius * f64::from(i) / 100.0;
            let limit = MU * contact().pressure(r);
            let reserve = limit - slip.traction(r);
            assert_eq!(reserve > 1e-15, r < slip.stick_radius, "{r}");
            assert!(slip.traction(r) <= slip.peak_traction());
        }
    }

    /// A contact that slips at its edge is as stiff as one stuck over the stick
    /// zone alone, `dQ/d delta_x = 8 c/C`, which meets the limit of full stick.
    #[test]
    fn stiffness_is_that_of_the_stick_zone() {
        let compliance = 10.0;
        let at = |force: f64| PartialSlip::new(contact(), MU, force);
        let force = 0.6 * MU * contact().force;
        let errors = [1e-4, 5e-5].map(|share| {
            let step = share * force;
            let [more, less] = [force + step, force - step].map(|q| at(q).displacement(compliance));
            let stiffness = 2.0 * step / (more - less);
            (stiffness * compliance / (8.0 * at(force).stick_radius) - 1.0).abs()
        });
        assert!(errors[0] < 1e-7, "{errors:?}");
        assert!((errors[0] / errors[1] - 4.0).abs() < 0.1, "{errors:?}");
    }
}
