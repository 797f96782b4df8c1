//! A disc of quadrangles: a square core and a band around it.
//!
//! ```text
//!       .-------.
//!      / \  |  / \       core: half its edge is R/2, divided into `core`
//!     |   +---+   |      band: from the core to the circle, `band` layers
//!     |---|   |---|
//!     |   +---+   |
//!      \ /  |  \ /
//!       '-------'
//! ```
//!
//! Nodes of the circle lie on it at equal angles. A quarter is the part with
//! coordinates that are not negative.

use std::f64::consts::FRAC_PI_2;

/// Part of a disc that is meshed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sector {
    /// All of it.
    Whole,
    /// Quarter with `x >= 0` and `y >= 0`, seen from the centre.
    Quarter,
}

/// A disc about the origin.
///
/// Core nodes `(i, j)` come first, row by row; then those of the band, `(u, k)` with `u`
/// around the core counter-clockwise from the first axis and `k` in `1..=band` outwards.
pub(super) struct Disc {
    pub(super) radius: f64,
    /// Elements along half an edge of the core.
    pub(super) core: usize,
    /// Layers of the band.
    pub(super) band: usize,
    pub(super) sector: Sector,
}

/// Half the edge of the core over the radius.
const CORE: f64 = 0.5;

impl Disc {
    pub(super) fn cell_count(&self) -> usize {
        (self.row() - 1).pow(2) + self.steps() * self.band
    }

    pub(super) fn node_count(&self) -> usize {
        self.row().pow(2) + self.lines() * self.band
    }

    pub(super) fn positions(&self) -> impl Iterator<Item = [f64; 2]> {
        let core = (0..self.row().pow(2)).map(|index| {
            let first = self.first();
            let [i, j] = [index % self.row(), index / self.row()].map(|at| at as i64 + first);
            self.core_position([i, j])
        });
        let band = (0..self.lines() * self.band).map(|index| {
            let (u, k) = (index / self.band, index % self.band + 1);
            let inner = self.core_position(self.outline(u));
            let share = k as f64 / self.band as f64;
            let outer = self.on_circle(u);
            [0, 1].map(|axis| inner[axis] + share * (outer[axis] - inner[axis]))
        });
        core.chain(band)
    }

    /// Corners of all cells, counter-clockwise. The edge from the second to the third
    /// corner of cells of the band looks outwards.
    pub(super) fn quadrangles(&self) -> Vec<[usize; 4]> {
        let (first, last) = (self.first(), self.core as i64);
        let mut cells = Vec::new();
        for j in first..last {
            for i in first..last {
                let corners = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
                cells.push(corners.map(|at| self.core_node(at)));
            }
        }
        for u in 0..self.steps() {
            for k in 0..self.band {
                let ahead = (u + 1) % self.lines();
                let corners = [(u, k), (u, k + 1), (ahead, k + 1), (ahead, k)];
                cells.push(corners.map(|(u, k)| self.band_node(u, k)));
            }
        }
        cells
    }

    /// Cells on the circle with the edge that lies on it, counted from the one between the
    /// first two corners.
    pub(super) fn circle(&self) -> Vec<(usize, u8)> {
        let core = (self.row() - 1).pow(2);
        let last = |u| core + u * self.band + self.band - 1;
        (0..self.steps()).map(|u| (last(u), 1)).collect()
    }

    /// Cells of a quarter on the second axis and on the first one, likewise.
    pub(super) fn planes(&self) -> [Vec<(usize, u8)>; 2] {
        let (n, core) = (self.core, self.core.pow(2));
        let start = core + (self.steps() - 1) * self.band;
        let left = (0..n).map(|j| (j * n, 3));
        let below = (0..n).map(|i| (i, 0));
        [
            left.chain((start..start + self.band).map(|cell| (cell, 2)))
                .collect(),
            below
                .chain((core..core + self.band).map(|cell| (cell, 0)))
                .collect(),
        ]
    }

    /// Smallest lattice coordinate of the core.
    fn first(&self) -> i64 {
        match self.sector {
            Sector::Whole => -(self.core as i64),
            Sector::Quarter => 0,
        }
    }

    /// Nodes along an edge of the core.
    fn row(&self) -> usize {
        (self.core as i64 - self.first()) as usize + 1
    }

    /// Elements around.
    fn steps(&self) -> usize {
        match self.sector {
            Sector::Whole => 8 * self.core,
            Sector::Quarter => 2 * self.core,
        }
    }

    /// Radial lines of the band.
    fn lines(&self) -> usize {
        match self.sector {
            Sector::Whole => self.steps(),
            Sector::Quarter => self.steps() + 1,
        }
    }

    fn core_position(&self, at: [i64; 2]) -> [f64; 2] {
        at.map(|at| CORE * self.radius * at as f64 / self.core as f64)
    }

    /// The end of a radial line; quarter turns are exact.
    fn on_circle(&self, u: usize) -> [f64; 2] {
        let (quarters, rest) = (u / (2 * self.core), u % (2 * self.core));
        let angle = FRAC_PI_2 * rest as f64 / (2 * self.core) as f64;
        let place = [self.radius * angle.cos(), self.radius * angle.sin()];
        (0..quarters).fold(place, |[x, y], _| [-y, x])
    }

    /// Lattice coordinates of the core at which a radial line begins.
    fn outline(&self, u: usize) -> [i64; 2] {
        let (quarters, rest) = (u / (2 * self.core), (u % (2 * self.core)) as i64);
        let n = self.core as i64;
        let place = if rest <= n {
            [n, rest]
        } else {
            [2 * n - rest, n]
        };
        (0..quarters).fold(place, |[i, j], _| [-j, i])
    }

    fn core_node(&self, at: [i64; 2]) -> usize {
        let [i, j] = at.map(|at| (at - self.first()) as usize);
        i + self.row() * j
    }

    fn band_node(&self, u: usize, k: usize) -> usize {
        match k {
            0 => self.core_node(self.outline(u)),
            _ => self.row().pow(2) + u * self.band + k - 1,
        }
    }
}
