//! Points of a surface at which factors of friction are asked for, all at once.

use nalgebra::Vector3;

use super::{FactorLane, FactorPoint};
use crate::friction::textures::Textures;

/// Points at the end of an increment; lists have one entry a point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FactorPoints {
    /// Duration of the increment; zero where it has none.
    pub elapsed: f64,
    /// Time at its end.
    pub time: f64,
    /// Pressures, zero or compressive.
    pub pressure: Vec<f64>,
    /// Slip rates `|du|/dt`.
    pub slip_rate: Vec<f64>,
    /// Slips up to the increment.
    pub accumulated_slip: Vec<f64>,
    /// Positions at the start of the increment.
    pub position: Vec<Vector3<f64>>,
    /// Unit normals of the surface that carries the points.
    pub normal: Vec<Vector3<f64>>,
    /// Its textures `a`; zero without one.
    pub own: Vec<Vector3<f64>>,
    /// Textures of the other surface, `a_b' = -a_b`; zero without one.
    pub opposite: Vec<Vector3<f64>>,
    /// States at the start of the increment, one point after the other.
    pub states: Vec<f64>,
}

impl FactorPoints {
    /// Number of points.
    pub fn len(&self) -> usize {
        self.pressure.len()
    }

    /// Returns whether there are none.
    pub fn is_empty(&self) -> bool {
        self.pressure.is_empty()
    }

    /// State of a point.
    pub fn state(&self, at: usize) -> &[f64] {
        let count = self.states.len() / self.len().max(1);
        &self.states[count * at..count * (at + 1)]
    }

    /// The points again at other slip rates.
    pub fn at_rates(&self, mut rate: impl FnMut(f64) -> f64) -> Self {
        Self {
            slip_rate: self.slip_rate.iter().map(|v| rate(*v)).collect(),
            ..self.clone()
        }
    }

    /// The points, and after them those of others of the same increment.
    pub fn and(mut self, others: &Self) -> Self {
        self.pressure.extend(&others.pressure);
        self.slip_rate.extend(&others.slip_rate);
        self.accumulated_slip.extend(&others.accumulated_slip);
        self.position.extend(&others.position);
        self.normal.extend(&others.normal);
        self.own.extend(&others.own);
        self.opposite.extend(&others.opposite);
        self.states.extend(&others.states);
        self
    }

    /// A point in dual numbers.
    pub fn point(&self, at: usize) -> FactorPoint {
        let lane = |value: f64, lane: usize| FactorLane::from_re(value).derivative(lane);
        let vector =
            |v: &Vector3<f64>, first: usize| Vector3::from_fn(|i, _| lane(v[i], first + i));
        let texture =
            |v: &Vector3<f64>, first: usize| (*v != Vector3::zeros()).then(|| vector(v, first));
        FactorPoint {
            pressure: lane(self.pressure[at], 0),
            slip_rate: lane(self.slip_rate[at], 1),
            accumulated_slip: self.accumulated_slip[at],
            position: self.position[at],
            time: self.time,
            elapsed: self.elapsed,
            normal: vector(&self.normal[at], 2),
            textures: Textures {
                own: texture(&self.own[at], 5),
                opposite: texture(&self.opposite[at], 8),
            },
        }
    }

    /// A point in words.
    pub(in crate::friction) fn told(&self, at: usize) -> String {
        let x = &self.position[at];
        let state = match self.state(at) {
            [] => String::new(),
            state => format!(", the state {state:?} before the increment"),
        };
        format!(
            "the pressure {:.4e}, the slip rate {:.4e}, the accumulated slip {:.4e}, the position \
             ({:.4e}, {:.4e}, {:.4e}), the time {:.4e}{state}",
            self.pressure[at],
            self.slip_rate[at],
            self.accumulated_slip[at],
            x.x,
            x.y,
            x.z,
            self.time
        )
    }
}
