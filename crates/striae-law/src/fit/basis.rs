//! Friction laws as sums of parameters times vectors.
//!
//! With `d = (c, s)`, the cosine and sine of the direction of slip, in the frame of the law:
//!
//! ```text
//! coulomb        q = mu                       w = mu (c, s)
//! orthotropic    q = (mu_along, mu_across)    w = (mu_across c, mu_along s)                     opposing
//!                                             w = (mu_across^2 c, mu_along^2 s)/g ,             associated
//!                                             g^2 = mu_across^2 c^2 + mu_along^2 s^2
//! nap            q = (mu_f, mu_b, mu_t)       w = (mu_f (c - 1)/2 + mu_b (c + 1)/2, mu_t s)
//! two textures   q = mu (1, c_mag, c_ang, c_ang c_cen) ,  I0 = cos theta ,  m^2 = 2 + 2 I0
//!                w = (q_0 + q_1 I0)(c, s) + (1 + I0) m (q_2 m c + q_3, 0)
//! tabulated      q = mu_i                     w = mu_i (c, s)   at the angle i
//! ```
//!
//! The associated `w` is of degree one, `w = sum q_k dw/dq_k`. Sources are those of the laws,
//! see [`crate::friction`].

use std::f64::consts::{PI, TAU};

use nalgebra::{DMatrix, DVector, Vector2};

use super::{ConstantName, Reading, Sought};
use crate::friction::{Friction, FrictionError, SlipRule};

/// Directions of slip in which a law must dissipate.
const DIRECTIONS: usize = 720;
/// Difference below which two angles of a table are the same (radians).
const SAME: f64 = 1e-6;

/// A law that is sought, and the angles of its table.
pub(super) struct Shape {
    sought: Sought,
    /// Angles of the table, ascending within a turn from 0.
    angles: Vec<f64>,
    /// Number of the angle of each reading.
    nodes: Vec<usize>,
}

/// Relation of a constant to the parameters.
#[derive(Clone, Copy, Debug)]
pub(super) enum Meaning {
    /// One of the parameters.
    Parameter(usize),
    /// The first one over the second one.
    Quotient(usize, usize),
}

impl Shape {
    pub(super) fn new(sought: Sought, readings: &[Reading]) -> Self {
        let (angles, nodes) = match sought {
            Sought::Tabulated => table(readings),
            _ => (Vec::new(), vec![0; readings.len()]),
        };
        Self {
            sought,
            angles,
            nodes,
        }
    }

    /// Number of parameters.
    pub(super) fn count(&self) -> usize {
        match self.sought {
            Sought::Coulomb => 1,
            Sought::Orthotropic(_) => 2,
            Sought::Nap => 3,
            Sought::TwoTextures => 4,
            Sought::Tabulated => self.angles.len(),
        }
    }

    /// Returns whether the vectors are independent of the parameters.
    pub(super) fn is_linear(&self) -> bool {
        self.sought != Sought::Orthotropic(SlipRule::Associated)
    }

    /// Returns whether friction across the slip direction depends on the parameters.
    pub(super) fn knows_across(&self) -> bool {
        !matches!(self.sought, Sought::Coulomb | Sought::Tabulated)
    }

    /// The vectors `w_k` in a direction of slip, for a reading where there is a table.
    pub(super) fn basis(
        &self,
        reading: usize,
        theta: f64,
        slip: f64,
        q: &DVector<f64>,
    ) -> Vec<Vector2<f64>> {
        let (s, c) = slip.sin_cos();
        let d = Vector2::new(c, s);
        let e = Vector2::x();
        match self.sought {
            Sought::Coulomb => vec![d],
            Sought::Orthotropic(SlipRule::Opposing) => {
                vec![Vector2::new(0.0, s), Vector2::new(c, 0.0)]
            }
            Sought::Orthotropic(SlipRule::Associated) => associated(q[0], q[1], d),
            Sought::Nap => vec![
                e * (0.5 * (c - 1.0)),
                e * (0.5 * (c + 1.0)),
                Vector2::new(0.0, s),
            ],
            Sought::TwoTextures => {
                let i0 = theta.cos();
                let m = (2.0 + 2.0 * i0).max(0.0).sqrt();
                let turned = e * ((1.0 + i0) * m);
                vec![d, d * i0, turned * (m * c), turned]
            }
            Sought::Tabulated => {
                let node = self.nodes[reading];
                let at = |i| if i == node { d } else { Vector2::zeros() };
                (0..self.angles.len()).map(at).collect()
            }
        }
    }

    /// Places where dissipation is checked: number of a reading, angle between textures, slip.
    ///
    /// For two textures it is smallest where they are opposed or aligned.
    pub(super) fn judged(&self) -> Vec<(usize, f64, f64)> {
        let around = |theta: f64| {
            let step = TAU / DIRECTIONS as f64;
            (0..DIRECTIONS).map(move |i| (0, theta, i as f64 * step))
        };
        match self.sought {
            Sought::Coulomb => vec![(0, 0.0, 0.0)],
            Sought::Orthotropic(_) => vec![(0, 0.0, 0.0), (0, 0.0, 0.5 * PI)],
            Sought::Nap => around(0.0).collect(),
            Sought::TwoTextures => around(0.0).chain([(0, PI, 0.0)]).collect(),
            Sought::Tabulated => {
                let first = |node| self.nodes.iter().position(|other| *other == node);
                let reading = |node| first(node).expect("each angle is that of a reading");
                let angles = self.angles.iter().enumerate();
                angles.map(|(i, angle)| (reading(i), 0.0, *angle)).collect()
            }
        }
    }

    /// The law with certain parameters.
    pub(super) fn friction(&self, q: &DVector<f64>) -> Result<Friction, FrictionError> {
        let constants = self.constants();
        let values: Vec<f64> = constants.iter().map(|(_, how)| how.value(q)).collect();
        match self.sought {
            Sought::Coulomb => Friction::coulomb(values[0]),
            Sought::Orthotropic(rule) => Friction::orthotropic(values[0], values[1], rule),
            Sought::Nap => Friction::nap(values[0], values[1], values[2]),
            Sought::TwoTextures => {
                Friction::two_textures(values[0], values[1], values[2], values[3])
            }
            Sought::Tabulated => Friction::tabulated(&self.angles, &values),
        }
    }

    /// The constants of the law.
    pub(super) fn constants(&self) -> Vec<(ConstantName, Meaning)> {
        use Meaning::{Parameter, Quotient};
        let listed: &[(&'static str, Meaning)] = match self.sought {
            Sought::Coulomb => &[("mu", Parameter(0))],
            Sought::Orthotropic(_) => &[("mu_along", Parameter(0)), ("mu_across", Parameter(1))],
            Sought::Nap => &[
                ("mu_forward", Parameter(0)),
                ("mu_backward", Parameter(1)),
                ("mu_lateral", Parameter(2)),
            ],
            Sought::TwoTextures => &[
                ("mu", Parameter(0)),
                ("c_mag", Quotient(1, 0)),
                ("c_ang", Quotient(2, 0)),
                ("c_cen", Quotient(3, 2)),
            ],
            Sought::Tabulated => {
                let angles = self.angles.iter().enumerate();
                return angles
                    .map(|(i, angle)| (ConstantName::MuAt(*angle), Parameter(i)))
                    .collect();
            }
        };
        let named = listed
            .iter()
            .map(|(key, how)| (ConstantName::Key(key), *how));
        named.collect()
    }
}

impl Meaning {
    /// The constant.
    pub(super) fn value(self, q: &DVector<f64>) -> f64 {
        match self {
            Self::Parameter(k) => q[k],
            Self::Quotient(k, l) => q[k] / q[l],
        }
    }

    /// Its interval, from the covariance of the parameters and Student's `t`.
    ///
    /// Fieller: the `r` for which `|q_k - r q_l|` is at most `t` times its standard deviation.
    pub(super) fn interval(self, q: &DVector<f64>, covariance: &DMatrix<f64>, t: f64) -> [f64; 2] {
        let (k, l) = match self {
            Self::Parameter(k) => {
                let half = t * covariance[(k, k)].sqrt();
                return [q[k] - half, q[k] + half];
            }
            Self::Quotient(k, l) => (k, l),
        };
        let form = |i: usize, j: usize| q[i] * q[j] - t * t * covariance[(i, j)];
        let (square, middle, constant) = (form(l, l), form(k, l), form(k, k));
        if square <= 0.0 {
            return [f64::NEG_INFINITY, f64::INFINITY];
        }
        let root = (middle * middle - square * constant).max(0.0).sqrt();
        [(middle - root) / square, (middle + root) / square]
    }
}

/// Derivatives of the associated law by its constants along and across the grooves.
fn associated(along: f64, across: f64, d: Vector2<f64>) -> Vec<Vector2<f64>> {
    let g = (across * d.x).hypot(along * d.y);
    let w = Vector2::new(across * across * d.x, along * along * d.y) / g;
    let by_along = Vector2::new(0.0, 2.0 * along * d.y) / g - w * (along * d.y * d.y / (g * g));
    let by_across = Vector2::new(2.0 * across * d.x, 0.0) / g - w * (across * d.x * d.x / (g * g));
    vec![by_along, by_across]
}

/// Angles that were measured, ascending, and the number of that of each reading.
fn table(readings: &[Reading]) -> (Vec<f64>, Vec<usize>) {
    let turned = |reading: &Reading| {
        let angle = reading.slip.rem_euclid(TAU);
        if TAU - angle < SAME { 0.0 } else { angle }
    };
    let mut angles: Vec<f64> = readings.iter().map(turned).collect();
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|next, before| *next - *before < SAME);
    let node = |reading: &Reading| {
        let angle = turned(reading);
        angles.partition_point(|start| *start <= angle) - 1
    };
    let nodes = readings.iter().map(node).collect();
    (angles, nodes)
}
