//! Supports of kept nodes on a segment, and the effect of pressure on them.
//!
//! Notation and formulas are those of [`super::points`].

use super::{
    Slopes,
    plane_facet::{PlaneFacet, Vec2},
    sums::add,
};

/// Sum of the shares of closed nodes at a point that is round-off: their support ends there.
const NO_SHARE: f64 = 1e-9;

/// The support of a kept node on a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// `phi_k` at the eight corners.
    pub shares: [f64; 8],
    /// `p_k`.
    pub pressure: f64,
    /// `r_k`; zero where nothing yields, and nothing is pressed.
    pub bedding: f64,
    /// `r_k` of an open support, which says what is open for the next increment.
    pub full: f64,
}

/// Data besides the segment that determine the pressure.
#[derive(Clone, Debug)]
pub struct Pressing {
    /// Supports of the kept nodes.
    supports: Vec<Support>,
    /// Gaps below which they are closed.
    limits: Vec<f64>,
    /// Gaps below which they count as closed for the next increment.
    full_limits: Vec<f64>,
    /// `a_d`.
    heights: [f64; 8],
}

/// Integrals of pressure over a segment.
#[derive(Clone, Debug, Default)]
pub struct Pressed {
    /// `F_c`.
    pub force: [f64; 8],
    /// `G_k`.
    pub rows: Vec<f64>,
    /// `int phi_k` over the share that is closed at the full bedding.
    pub closed: Vec<f64>,
    /// `true` for supports with a closed point.
    pub touches: Vec<bool>,
    /// Area under pressure.
    pub area: f64,
    /// Derivatives, if the segment has any.
    pub slopes: Option<Box<PressedSlopes>>,
}

/// Derivatives of the integrals of pressure.
#[derive(Clone, Debug, Default)]
pub struct PressedSlopes {
    /// `dF_c/dx`, column `3 k + i` for `x_k . e_i`.
    pub force: [[f64; 24]; 8],
    /// `dG_k/dx`.
    pub rows: Vec<[f64; 24]>,
    /// `dF_c/dp_k`.
    pub force_by_pressure: Vec<[f64; 8]>,
    /// `dG_k/dp_k`.
    pub rows_by_pressure: Vec<f64>,
}

impl Pressing {
    /// Of supports at heights `a_d` of the corners; points with a gap below `touching` count as
    /// closed that nothing presses yet. Below `near` they count as closed for the next increment:
    /// at a gap of zero that nothing presses, round-off would decide otherwise.
    pub fn new(supports: Vec<Support>, heights: [f64; 8], [touching, near]: [f64; 2]) -> Self {
        let yields_by = |pressure: f64, bedding: f64| match bedding > 0.0 {
            true => pressure / bedding,
            false => f64::NEG_INFINITY,
        };
        let limit = |support: &Support| yields_by(support.pressure, support.bedding);
        // Where wear of others opens a gap, `p` is negative: a stiffer bedding would close more.
        let full =
            |support: &Support| yields_by(support.pressure, support.full).min(limit(support));
        Self {
            full_limits: supports.iter().map(|of| full(of) + near).collect(),
            limits: supports.iter().map(|of| limit(of) + touching).collect(),
            supports,
            heights,
        }
    }

    #[inline(always)]
    pub(super) fn gap(&self, shares: &[f64; 8]) -> f64 {
        dot(&self.heights, shares)
    }

    /// The supports with the gaps below which they are closed.
    #[inline(always)]
    pub(super) fn supports(&self) -> impl Iterator<Item = (&Support, f64)> {
        self.supports.iter().zip(self.limits.iter().copied())
    }

    pub(super) fn count(&self) -> usize {
        self.supports.len()
    }

    /// Number of supports that are closed at a point with these interpolation functions. The number
    /// determines them, as those with the largest limits close first.
    pub(super) fn state(&self, shares: &[f64; 8]) -> usize {
        let gap = self.gap(shares);
        self.limits.iter().filter(|limit| gap < **limit).count()
    }

    /// Returns whether no pressure acts and no point with these shape functions is closed, now or
    /// for the next increment.
    pub(super) fn is_idle(&self, mut points: impl Iterator<Item = [f64; 8]>) -> bool {
        let unpressed = |support: &Support| support.pressure == 0.0;
        let is_apart = |shares: [f64; 8]| {
            let gap = self.gap(&shares);
            let mut limits = self.limits.iter().chain(&self.full_limits);
            limits.all(|limit| gap >= *limit)
        };
        self.supports.iter().all(unpressed) && points.all(is_apart)
    }

    /// `sum_k v_k share_kd`, of a value of every support.
    pub(super) fn at_corners(&self, value: impl Fn(&Support) -> f64) -> [f64; 8] {
        let mut sum = [0.0; 8];
        for support in &self.supports {
            add(&mut sum, value(support), &support.shares);
        }
        sum
    }

    /// Heights of the corners.
    pub(super) fn heights(&self) -> &[f64; 8] {
        &self.heights
    }

    /// Gaps below which supports count as closed for the next increment.
    pub(super) fn full_limits(&self) -> &[f64] {
        &self.full_limits
    }

    /// The smallest gap at which a support is open.
    pub(super) fn least_limit(&self) -> f64 {
        self.limits.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// `int phi_k` over the segment.
    pub(super) fn weights(&self, mass: &[[f64; 8]; 8]) -> Vec<f64> {
        let weight = |support: &Support| -> f64 {
            let own = mass.iter().map(|row| dot(row, &support.shares));
            // The functions of each side sum up to one.
            own.sum::<f64>() / sides(mass)
        };
        self.supports.iter().map(weight).collect()
    }

    /// The integrals where nothing presses and nothing is closed: `G_k = 0`.
    pub(super) fn idle(&self, mass: &[[f64; 8]; 8], slopes: Option<&Slopes>) -> Pressed {
        let open = self.weights(mass).into_iter();
        let count = self.supports.len();
        Pressed {
            rows: vec![0.0; count],
            slopes: slopes.map(|_| {
                Box::new(PressedSlopes {
                    rows: vec![[0.0; 24]; count],
                    force_by_pressure: vec![[0.0; 8]; count],
                    rows_by_pressure: open
                        .zip(&self.supports)
                        .map(|(open, support)| over_bedding(open, support))
                        .collect(),
                    ..PressedSlopes::default()
                })
            }),
            closed: vec![0.0; count],
            touches: vec![false; count],
            ..Pressed::default()
        }
    }
}

/// Number of sides that have functions.
fn sides(mass: &[[f64; 8]; 8]) -> f64 {
    let has = |first: usize| (first..first + 4).any(|c| mass[c][c] != 0.0);
    f64::from(u8::from(has(0)) + u8::from(has(4)))
}

/// `value/r_k`, nothing where there is no bedding.
#[inline(always)]
pub(super) fn over_bedding(value: f64, support: &Support) -> f64 {
    match support.bedding > 0.0 {
        true => value / support.bedding,
        false => 0.0,
    }
}

#[inline(always)]
pub(super) fn dot(a: &[f64; 8], b: &[f64; 8]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Values at a point that integrands are made of.
pub(super) struct Point {
    /// `P`.
    pub pressure: f64,
    /// `sum phi_k` over the closed nodes.
    closed: f64,
    /// `sum phi_k r_k` over the closed nodes.
    pub stiffness: f64,
    /// `sum_k share_kd P_k`, of which the gradient of `P` at constant gap is made.
    pub by_shares: [f64; 8],
}

impl Point {
    /// Adds the supports at a point, with the weight of the point, to sums by support.
    #[inline(always)]
    pub(super) fn new(pressing: &Pressing, n: &[f64; 8], gap: f64) -> Self {
        let mut point = Self {
            pressure: 0.0,
            closed: 0.0,
            stiffness: 0.0,
            by_shares: [0.0; 8],
        };
        for (support, limit) in pressing.supports() {
            if gap < limit {
                let phi = dot(&support.shares, n);
                let own = support.pressure - support.bedding * gap;
                point.pressure += phi * own;
                point.closed += phi;
                point.stiffness += phi * support.bedding;
                add(&mut point.by_shares, own, &support.shares);
            }
        }
        point
    }

    /// Returns whether the point is under pressure, of more than nodes whose support ends there.
    pub(super) fn is_pressed(&self) -> bool {
        self.closed > NO_SHARE && self.pressure > 0.0
    }
}

/// Values of a support at a point.
pub(super) struct OfSupport {
    /// `phi_k`.
    pub phi: f64,
    /// `min(g, p_k/r_k)`.
    pub held: f64,
    /// One where it is closed, else zero.
    pub closed: f64,
}

impl OfSupport {
    #[inline(always)]
    pub(super) fn new((support, limit): (&Support, f64), n: &[f64; 8], gap: f64) -> Self {
        let closed = gap < limit;
        Self {
            phi: dot(&support.shares, n),
            held: match closed {
                true => gap,
                false => over_bedding(support.pressure, support),
            },
            closed: f64::from(u8::from(closed)),
        }
    }
}

/// Interpolation functions of both facets at a place.
pub(super) fn shares(facets: &[PlaneFacet; 2], place: &Vec2) -> [f64; 8] {
    let [a, b] = [facets[0].at(place).value, facets[1].at(place).value];
    std::array::from_fn(|c| if c < 4 { a[c] } else { b[c - 4] })
}
