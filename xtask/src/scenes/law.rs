//! Slip surfaces, on their own from the formulas of the friction laws.
//!
//! At a node of the side that carries the texture `s`, with the outward normal `n`,
//! `a = n x s` and `w = -tau`, friction is inside the law where
//!
//! ```text
//! coulomb      |w| <= mu p
//! orthotropic  (w.s/mu_along)^2 + (w.a/mu_across)^2 <= p^2
//! nap          ((w.a - h p)/P)^2 + (w.s/mu_lateral)^2 <= p^2 ,  P, h = (mu_backward +- mu_forward)/2
//! tabulated    |w| <= mu(phi) p ,   phi the angle of w from a, counter-clockwise
//! ```
//!
//! On the other side, and for two textures, the output does not tell the opposing
//! texture; there `|w|` stays below the largest traction of the law at any angle. A
//! cap of the shear stress `c` puts `min(mu p, c)` in place of `mu p`, `mu` the
//! largest coefficient.

use super::vector::{Vector, cross, dot, length, times};

/// A friction law.
#[derive(Clone, Debug, PartialEq)]
pub enum Law {
    /// No friction.
    Frictionless,
    /// Isotropic.
    Coulomb(f64),
    /// Along and across the grooves, and the slip rule.
    Orthotropic(f64, f64, &'static str),
    /// With, against and across the nap.
    Nap(f64, f64, f64),
    /// `mu`, `c_mag`, `c_ang`, `c_cen`.
    TwoTextures(f64, f64, f64, f64),
    /// Angles in degrees with their coefficients.
    Tabulated(Vec<(f64, f64)>),
}

impl Law {
    /// Its name in the deck.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Frictionless => "frictionless",
            Self::Coulomb(_) => "coulomb",
            Self::Orthotropic(..) => "orthotropic",
            Self::Nap(..) => "nap",
            Self::TwoTextures(..) => "two-textures",
            Self::Tabulated(_) => "tabulated",
        }
    }

    /// The coefficient that scales the law.
    pub fn coefficient(&self) -> f64 {
        match self {
            Self::Frictionless => 0.0,
            Self::Coulomb(mu) | Self::TwoTextures(mu, ..) => *mu,
            Self::Orthotropic(along, across, _) => along.max(*across),
            Self::Nap(forward, backward, lateral) => forward.max(*backward).max(*lateral),
            Self::Tabulated(table) => table.iter().map(|row| row.1).fold(0.0, f64::max),
        }
    }

    /// The largest friction over the pressure, at any angle.
    pub fn largest(&self) -> f64 {
        match *self {
            Self::TwoTextures(mu, c_mag, c_ang, c_cen) => {
                let at = |k: usize, j: usize| {
                    let cosine = (k as f64 * std::f64::consts::PI / 360.0).cos();
                    let m = (2.0 + 2.0 * cosine).sqrt();
                    let (a, b) = (1.0 + c_mag * cosine, c_ang * (1.0 + cosine));
                    let (sine, along) = (j as f64 * std::f64::consts::PI / 360.0).sin_cos();
                    f64::hypot(b * m * c_cen + (a + b * m * m) * along, a * sine)
                };
                let pairs = (0..=360).flat_map(|k| (0..=360).map(move |j| (k, j)));
                // Sampled every half a degree: off by no more than 1e-4.
                mu * 1.0001 * pairs.map(|(k, j)| at(k, j)).fold(0.0, f64::max)
            }
            Self::Nap(forward, backward, lateral) => {
                let (p, h) = (0.5 * (backward + forward), 0.5 * (backward - forward));
                let at = |j: usize| {
                    let (sine, cosine) = (j as f64 * std::f64::consts::PI / 360.0).sin_cos();
                    f64::hypot(h + p * cosine, lateral * sine)
                };
                1.0001 * (0..=360).map(at).fold(0.0, f64::max)
            }
            _ => self.coefficient(),
        }
    }

    /// Friction over the largest that the law allows in its direction at a node of the
    /// textured side: at most 1 inside.
    pub fn use_of(&self, point: &Point, cap: Option<f64>) -> f64 {
        let mu = self.coefficient();
        let reached = mu * point.pressure;
        let varpi = cap.map_or(reached, |cap| reached.min(cap));
        let w = times(-1.0, point.friction);
        if length(w) == 0.0 {
            return 0.0;
        }
        // The law of a pressure of 1, without a cap.
        let w = times(mu / varpi, w);
        let a = cross(point.normal, point.texture);
        let (along, across) = (dot(w, point.texture), dot(w, a));
        if length(point.texture) < 0.5 {
            return length(w) / self.largest();
        }
        match self {
            Self::Orthotropic(one, two, _) => f64::hypot(along / one, across / two),
            Self::Nap(forward, backward, lateral) => {
                let (p, h) = (0.5 * (backward + forward), 0.5 * (backward - forward));
                gauge(across, along, p, h, *lateral)
            }
            Self::Tabulated(table) => length(w) / tabulated(table, along_angle(across, along)),
            _ => length(w) / self.largest(),
        }
    }
}

/// The angle from `a` towards `n x a = -s`.
fn along_angle(across: f64, along: f64) -> f64 {
    (-along).atan2(across).to_degrees()
}

/// State of a node in contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Pressure.
    pub pressure: f64,
    /// Friction traction on the side of the node.
    pub friction: Vector,
    /// Outward normal.
    pub normal: Vector,
    /// Texture `s` of this side, or zero.
    pub texture: Vector,
}

/// The scale at which the ellipse with the centre `h` and the semi-axes `p` and `q`
/// reaches a point, by bisection.
fn gauge(x: f64, y: f64, p: f64, h: f64, q: f64) -> f64 {
    let holds = |scale: f64| f64::hypot((x - h * scale) / p, y / q) <= scale;
    let (mut low, mut high) = (0.0, f64::hypot(x, y) / (p - h.abs()).min(q) * 2.0);
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if holds(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// The monotone cubic of Fritsch & Butland (1984) through a table that repeats after
/// a turn, at an angle in degrees.
fn tabulated(table: &[(f64, f64)], angle: f64) -> f64 {
    let count = table.len() as isize;
    let at = |i: isize| {
        let (degrees, mu) = table[i.rem_euclid(count) as usize];
        (degrees + 360.0 * i.div_euclid(count) as f64, mu)
    };
    let angle = table[0].0 + (angle - table[0].0).rem_euclid(360.0);
    let i = (0..count).rev().find(|&i| at(i).0 <= angle).unwrap_or(0);
    let width = |i: isize| at(i + 1).0 - at(i).0;
    let secant = |i: isize| (at(i + 1).1 - at(i).1) / width(i);
    let slope = |i: isize| {
        let ([h_0, h], [s_0, s]) = ([width(i - 1), width(i)], [secant(i - 1), secant(i)]);
        if s_0 * s <= 0.0 {
            0.0
        } else {
            3.0 * (h_0 + h) / ((2.0 * h + h_0) / s_0 + (h + 2.0 * h_0) / s)
        }
    };
    // Hermite's cubic with the values and slopes at both ends.
    let (h, t) = (width(i), (angle - at(i).0) / width(i));
    let (t2, t3) = (t * t, t * t * t);
    at(i).1 * (2.0 * t3 - 3.0 * t2 + 1.0)
        + at(i + 1).1 * (3.0 * t2 - 2.0 * t3)
        + h * slope(i) * (t3 - 2.0 * t2 + t)
        + h * slope(i + 1) * (t3 - t2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(pressure: f64, friction: Vector) -> Point {
        Point {
            pressure,
            friction,
            normal: [0.0, 0.0, 1.0],
            texture: [1.0, 0.0, 0.0],
        }
    }

    #[test]
    fn friction_on_the_slip_surface_uses_the_law_up() {
        // With s = x, a = n x s = y; slip along +y is against the nap.
        let nap = Law::Nap(0.1, 0.3, 0.2);
        let cases = [
            (Law::Coulomb(0.3), [0.18, 0.24, 0.0]),
            (Law::Orthotropic(0.2, 0.4, "opposing"), [0.2, 0.0, 0.0]),
            (Law::Orthotropic(0.2, 0.4, "opposing"), [0.0, -0.4, 0.0]),
            (nap.clone(), [0.0, -0.3, 0.0]),
            (nap.clone(), [0.0, 0.1, 0.0]),
            (nap, [-0.2, -0.1, 0.0]),
        ];
        for (law, friction) in cases {
            let found = law.use_of(&point(1.0, friction), None);
            assert!((found - 1.0).abs() < 1e-12, "{law:?} {friction:?}: {found}");
            let capped = law.use_of(
                &point(4.0, times(2.0, friction)),
                Some(2.0 * law.coefficient()),
            );
            assert!((capped - 1.0).abs() < 1e-12, "{law:?}");
        }
    }

    #[test]
    fn tables_are_passed_through_and_turn_counter_clockwise() {
        let table = vec![(0.0, 0.3), (90.0, 0.12), (200.0, 0.2), (300.0, 0.18)];
        for &(angle, mu) in &table {
            assert!((tabulated(&table, angle - 360.0) - mu).abs() < 1e-14);
        }
        assert!((0.12..0.3).contains(&tabulated(&table, 45.0)));
        // A quarter turn counter-clockwise from a = y is -x, so tau points along x.
        let law = Law::Tabulated(table);
        let found = law.use_of(&point(1.0, [0.12, 0.0, 0.0]), None);
        assert!((found - 1.0).abs() < 1e-12, "{found}");
    }
}
