//! A half disc of quadrangles, fine at the end of its middle radius.
//!
//! The half disc is divided into a rectangular core below the flat side and a band of radial lines
//! around the core's three other sides:
//!
//! ```text
//!   flat  +----+--------+----+
//!          \   |  core  |   /      core: width 2 c, height c, c = 0.45 R
//!           \--+--------+--/       band: from the arc (fine) to the core
//!             \ |  |  | /
//!      arc       `----'   contact point
//! ```
//!
//! The band's lower part spans 45 degrees to either side of the contact point
//! and has elements of the wanted size there, growing along the arc and
//! towards the core by [`refined_lengths`]; nodes of the arc lie on the circle.

use super::HalfCylinder;
use crate::{
    MeshError,
    generate::grading::{mirrored, refined_lengths, unit_partial_sums, whole},
};
use std::f64::consts::FRAC_PI_4;

/// The half disc below the `x` axis, centre at the origin.
///
/// Core nodes `(i, k)` come first, `i` in `0..=across` along `x`, `k` in
/// `0..=down` from the flat side; then band nodes `(u, j)`, `u` in `0..=around` along
/// the arc from the left end of the flat side to the right one, `j` in `0..deep` from
/// the arc; band nodes with `j = deep` are the core's.
pub(super) struct HalfDisc {
    radius: f64,
    /// Angles of the radial lines from the lowest point, left to right.
    angles: Vec<f64>,
    /// Share of the way from the arc to the core, from 0 to 1.
    shares: Vec<f64>,
    /// Core divisions along `x`.
    across: usize,
    /// Core divisions along `z`.
    down: usize,
}

/// Half width and height of the core over the radius.
const CORE: f64 = 0.45;

impl HalfDisc {
    pub(super) fn new(slice: &HalfCylinder) -> Result<Self, MeshError> {
        let radius = slice.radius;
        let (h, growth) = (slice.element_size, slice.growth);
        let arc = refined_lengths(radius * FRAC_PI_4, slice.fine_half_width, h, growth)?;
        let depth = refined_lengths((1.0 - CORE) * radius, slice.fine_depth, h, growth)?;
        let down = whole(CORE * radius / depth[depth.len() - 1]).max(2);
        let lower = unit_partial_sums(&mirrored(&arc));
        let across = lower.len() - 1;
        let upper = |step: usize| FRAC_PI_4 * (1.0 + step as f64 / down as f64);
        let angles = (1..=down)
            .rev()
            .map(|step| -upper(step))
            .chain(lower.iter().map(|s| FRAC_PI_4 * (2.0 * s - 1.0)))
            .chain((1..=down).map(upper))
            .collect();
        Ok(Self {
            radius,
            angles,
            shares: unit_partial_sums(&depth),
            across,
            down,
        })
    }

    pub(super) fn cell_count(&self) -> usize {
        self.across * self.down + (self.angles.len() - 1) * self.deep()
    }

    pub(super) fn node_count(&self) -> usize {
        self.core_count() + self.angles.len() * self.deep()
    }

    pub(super) fn positions(&self) -> impl Iterator<Item = [f64; 2]> {
        let core = (0..self.core_count()).map(|index| {
            let (i, k) = (index % (self.across + 1), index / (self.across + 1));
            self.core_position(i, k)
        });
        let band = (0..self.angles.len() * self.deep()).map(|index| {
            let (u, j) = (index / self.deep(), index % self.deep());
            let (sin, cos) = self.angles[u].sin_cos();
            let flat = u == 0 || u + 1 == self.angles.len();
            let outer = [
                self.radius * sin,
                if flat { 0.0 } else { -self.radius * cos },
            ];
            let (i, k) = self.core_end(u);
            let inner = self.core_position(i, k);
            [0, 1].map(|axis| outer[axis] + self.shares[j] * (inner[axis] - outer[axis]))
        });
        core.chain(band)
    }

    /// Corners of all cells, counter-clockwise with `x` to the right and `z` up.
    pub(super) fn quadrangles(&self) -> Vec<[usize; 4]> {
        let mut cells = Vec::new();
        for k in 0..self.down {
            for i in 0..self.across {
                cells.push([
                    self.core(i, k + 1),
                    self.core(i + 1, k + 1),
                    self.core(i + 1, k),
                    self.core(i, k),
                ]);
            }
        }
        for u in 0..self.angles.len() - 1 {
            for j in 0..self.deep() {
                cells.push([
                    self.band(u, j),
                    self.band(u + 1, j),
                    self.band(u + 1, j + 1),
                    self.band(u, j + 1),
                ]);
            }
        }
        cells
    }

    /// Cells on the flat side and on the arc, with the side of their element.
    pub(super) fn outline(&self) -> [Vec<(usize, u8)>; 2] {
        let deep = self.deep();
        let first = self.across * self.down;
        let last = first + (self.angles.len() - 2) * deep;
        // A cell a b c d becomes an element with the bottom a d c b: its edge
        // a b lies on side 5, b c on 4, c d on 3 and d a on 2.
        let core = (0..self.across).map(|cell| (cell, 3));
        let left = (first..first + deep).map(|cell| (cell, 2));
        let right = (last..last + deep).map(|cell| (cell, 4));
        let arc = (0..self.angles.len() - 1).map(|u| (first + u * deep, 5));
        [core.chain(left).chain(right).collect(), arc.collect()]
    }

    fn core_position(&self, i: usize, k: usize) -> [f64; 2] {
        let half_width = CORE * self.radius;
        let x = half_width * self.angles[self.down + i] / FRAC_PI_4;
        [x, -half_width * k as f64 / self.down as f64]
    }

    fn core(&self, i: usize, k: usize) -> usize {
        i + (self.across + 1) * k
    }

    fn band(&self, u: usize, j: usize) -> usize {
        if j < self.deep() {
            return self.core_count() + u * self.deep() + j;
        }
        let (i, k) = self.core_end(u);
        self.core(i, k)
    }

    /// The core node at which radial line `u` ends.
    fn core_end(&self, u: usize) -> (usize, usize) {
        let (across, down) = (self.across, self.down);
        if u < down {
            (0, u)
        } else if u <= down + across {
            (u - down, down)
        } else {
            (across, 2 * down + across - u)
        }
    }

    fn core_count(&self) -> usize {
        (self.across + 1) * (self.down + 1)
    }

    fn deep(&self) -> usize {
        self.shares.len() - 1
    }
}
