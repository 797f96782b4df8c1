//! The slip surface of most laws at one contact point, in closed form.
//!
//! In a frame `(e, e_perp)` of the tangent plane and over `varpi`, every law of the
//! form `-tau = L z + varpi eta` has an ellipse with centre `h e` and semi-axes `P`
//! along `e`, `A` across it:
//!
//! ```text
//! w = -tau/varpi = (h + P cos phi, A sin phi) ,   z/varpi = (cos phi, sin phi)
//! d = (cos phi, sin phi)          slip rule `Opposing`
//! d ~ (cos phi / P, sin phi / A)  slip rule `Associated`
//! ```
//!
//! The slip function is its gauge, with `v = -tau`:
//!
//! ```text
//! Gamma(v) = [-h v_e + sqrt(h^2 v_e^2 + (P^2 - h^2)(v_e^2 + P^2 v_s^2/A^2))]/(P^2 - h^2) ,
//! Upsilon = Gamma(v) - varpi <= 0 .
//! ```
//!
//! Source: (36) of Jones & Papadopoulos (2006) written in the frame of `a_ba`. The
//! ellipse is convex, unlike what that paper says of it in general. Lengths here
//! are stresses over `varpi`; angles are in radians.

use nalgebra::Vector2;

use super::slip_sample::{Extremes, SlipRule, SlipSample, sampled};

/// An elliptic slip surface over `varpi`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ellipse {
    /// Semi-axis `P` along `e`.
    pub along: f64,
    /// Semi-axis `A` across `e`.
    pub across: f64,
    /// Centre `h` along `e`.
    pub offset: f64,
    /// Slip rule.
    pub rule: SlipRule,
}

impl Ellipse {
    /// The ellipse with semi-axes `P` and `A` and centre `h`; the associated rule
    /// is known for `h = 0` only.
    pub(super) fn new(along: f64, across: f64, offset: f64, rule: SlipRule) -> Self {
        Self {
            along,
            across,
            offset,
            rule,
        }
    }

    /// The point with `z` at the angle `phi` from `e`.
    pub fn at(&self, angle: f64) -> SlipSample {
        let (sine, cosine) = angle.sin_cos();
        let traction = Vector2::new(self.offset + self.along * cosine, self.across * sine);
        let slip = match self.rule {
            SlipRule::Opposing => Vector2::new(cosine, sine),
            SlipRule::Associated => {
                Vector2::new(cosine / self.along, sine / self.across).normalize()
            }
        };
        SlipSample {
            angle,
            slip,
            traction,
            deviation: slip.perp(&traction).atan2(slip.dot(&traction)),
        }
    }

    /// `count` points, at equal steps of `phi` from 0.
    pub fn sampled(&self, count: usize) -> Vec<SlipSample> {
        sampled(count, |angle| self.at(angle))
    }

    /// `Gamma(v)`: the least `varpi` whose slip surface holds `v = -tau`.
    #[allow(non_snake_case)]
    pub fn gauge(&self, v: &Vector2<f64>) -> f64 {
        let (P, A, h) = (self.along, self.across, self.offset);
        let inside = (P - h) * (P + h);
        let stretched = v.x * v.x + (P * v.y / A).powi(2);
        let root = ((h * v.x).powi(2) + inside * stretched).sqrt();
        if h * v.x > 0.0 {
            stretched / (root + h * v.x) // the same, without cancellation
        } else {
            (root - h * v.x) / inside
        }
    }

    /// The angle `phi` at which the ray along `v = -tau` meets the slip surface;
    /// inverse of [`Ellipse::at`].
    pub fn angle(&self, v: &Vector2<f64>) -> f64 {
        let w = v / self.gauge(v);
        (w.y / self.across).atan2((w.x - self.offset) / self.along)
    }

    /// Largest traction and largest angle between traction and slip.
    pub fn extremes(&self) -> Extremes {
        let candidates = self.traction_cosines();
        let traction = candidates.map(|x| self.at_cosine(x).traction.norm());
        let candidates = self.deviation_cosines();
        let deviation = candidates.map(|x| self.at_cosine(x).deviation.abs());
        Extremes {
            traction: traction.into_iter().fold(0.0, f64::max),
            deviation: deviation.into_iter().fold(0.0, f64::max),
        }
    }

    /// The point where slip dissipates least.
    ///
    /// By the opposing rule `w . d = A + h cos phi + (P - A) cos^2 phi`; by the
    /// associated one it is the distance of a tangent from the centre.
    pub fn least_dissipation(&self) -> SlipSample {
        let excess = self.along - self.across;
        let vertex = cosine_or_end(-self.offset / (2.0 * excess));
        let candidates = [-1.0, 0.0, vertex].map(|x| self.at_cosine(x));
        candidates
            .into_iter()
            .fold(self.at_cosine(1.0), |least, other| {
                if other.dissipation() < least.dissipation() {
                    other
                } else {
                    least
                }
            })
    }

    fn at_cosine(&self, cosine: f64) -> SlipSample {
        self.at(cosine.acos())
    }

    /// Ends and vertex of `|w|^2`, a parabola in `cos phi`.
    #[allow(non_snake_case)]
    fn traction_cosines(&self) -> [f64; 3] {
        let (P, A, h) = (self.along, self.across, self.offset);
        [-1.0, 1.0, cosine_or_end(h * P / (A * A - P * P))]
    }

    /// Stationary points `x = cos phi` of the angle between `d` and `w`.
    ///
    /// Opposing: `(P^2 - A^2) x^2 + h (2 P - A) x + h^2 - A (P - A) = 0`.
    /// Associated: `tan = (A/P - P/A) sin(2 phi)/2`.
    #[allow(non_snake_case)]
    fn deviation_cosines(&self) -> [f64; 2] {
        let (P, A, h) = (self.along, self.across, self.offset);
        match self.rule {
            SlipRule::Associated => [0.5f64.sqrt(); 2],
            SlipRule::Opposing => {
                quadratic_roots(P * P - A * A, h * (2.0 * P - A), h * h - A * (P - A))
                    .map(cosine_or_end)
            }
        }
    }
}

/// `x` where it is a cosine, else the harmless end of the range.
fn cosine_or_end(x: f64) -> f64 {
    if x.abs() <= 1.0 { x } else { 1.0 }
}

/// Roots of `a x^2 + b x + c`, without cancellation; not finite where there are none.
fn quadratic_roots(a: f64, b: f64, c: f64) -> [f64; 2] {
    let q = -0.5 * (b + (b * b - 4.0 * a * c).sqrt().copysign(b));
    [q / a, c / q]
}
