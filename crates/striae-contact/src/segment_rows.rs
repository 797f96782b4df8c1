//! Gap and slip integrals over one segment, with their derivatives.
//!
//! With the integrals `D_cd` of a segment, the sign `s = -1` on the first facet and `1` on the
//! second one, and
//! the positions `x_d` of its eight corners,
//!
//! ```text
//! A_c  = integral N_c da
//! G_c  = integral N_c g da  = n . sum_d s_d D_cd x_d
//! du_c = integral N_c du da = R(n, n^n) (I - n^n n^n) sum_d s_d D_cd x^n_d
//! ```
//!
//! where `x^n_d` and `n^n` are of the last converged configuration: the points that face
//! each other now were apart by `x_b^n - x_a^n`, so side `a` has slipped by that. Nothing
//! is stored but converged positions, and the slip is exactly zero under rigid motion.
//! Against a rigid surface the old positions of side `a` are carried along by its motion,
//! `y_d`, which makes the slip objective under all motions of that surface:
//!
//! ```text
//! du_c = (I - n n) (sum_{d in b} D_cd x_d - sum_{d in a} D_cd y_d)
//! ```

use nalgebra::Matrix3;
use striae_mesh::Vec3;

use crate::{
    configuration::Configuration,
    pairing::{PairedFacets, SIGNS},
    segment::{Facet, Slopes, normal_between, pair_index},
    side::Side,
    transported::Transported,
};

/// Rows a corner: the gap, then the three components of the slip of side `a`.
pub const ROWS: usize = 4;

/// `G_c`, `du_c` and `A_c` of the corners, and derivatives of the last two by the corners.
pub struct SegmentRows {
    /// By corner.
    pub value: [[f64; ROWS]; 8],
    /// Areas of the corners.
    pub areas: [f64; 8],
    /// Of the area by corner `c`, column `3 e + i` for `x_e . e_i`; empty without derivatives or
    /// friction.
    pub area_slopes: Vec<[f64; 24]>,
    /// Of the slip by corner `c`, corner `e` moved, then `3 component + axis`; empty without
    /// derivatives or friction.
    pub slip_slopes: Vec<[[f64; 9]; 8]>,
}

/// Request for slip besides the gap.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Slip {
    /// Slip is computed.
    Wanted,
    /// There is no friction.
    Left,
}

/// Inputs of a segment besides its facets.
#[derive(Clone, Copy, Debug)]
pub struct Given {
    /// Weights of the facets' normals.
    pub weights: [f64; 2],
    /// Offsets of the gap at the corners, in shares that sum to the offset at a point: the part of
    /// an initial overlap of the meshes that is not removed yet, or an interference.
    pub offsets: [f64; 8],
    /// Request for slip.
    pub slip: Slip,
}

/// Gap and slip of a segment.
pub fn segment_rows(
    configuration: &Configuration,
    start: &Configuration,
    paired: &PairedFacets,
    given: Given,
) -> SegmentRows {
    let Given {
        weights,
        offsets,
        slip,
    } = given;
    let origin = paired.origin(configuration);
    let n = paired.segment.normal;
    let mut rows = SegmentRows {
        value: [[0.0; ROWS]; 8],
        areas: std::array::from_fn(|c| paired.area_of(c)),
        area_slopes: Vec::new(),
        slip_slopes: Vec::new(),
    };
    for c in 0..8 {
        let sum = paired.difference(c, &paired.x, &origin);
        let left = paired.segment.mass[c].iter().zip(&offsets);
        let left: f64 = left.map(|(mass, offset)| mass * offset).sum();
        rows.value[c][0] = n.dot(&sum) + left;
    }
    if slip == Slip::Wanted {
        rows.add_area_slopes(paired);
        let moved = Moved::new(configuration, start, paired, weights);
        moved.add_slip(paired, &mut rows);
    }
    rows
}

impl SegmentRows {
    /// Adds the derivatives of the areas: the functions of either side sum up to one.
    fn add_area_slopes(&mut self, paired: &PairedFacets) {
        let Some(slopes) = paired.segment.slopes.as_deref() else {
            return;
        };
        let one = match paired.segment.mass[4][4] {
            0.0 => 0..4,
            _ => 4..8,
        };
        let of_corner = |c: usize| {
            let mut sum = [0.0; 24];
            for d in one.clone() {
                let row = sum.iter_mut().zip(&slopes.mass[pair_index(c, d)]);
                row.for_each(|(sum, slope)| *sum += slope);
            }
            sum
        };
        self.area_slopes = (0..8).map(of_corner).collect();
    }
}

/// A value at each corner.
pub(crate) struct AtCorners(pub(crate) [f64; 8]);

impl AtCorners {
    /// `sum_d v_d dD_cd/dx_e` for all corners `e`.
    pub(crate) fn of_mass(&self, slopes: &Slopes, c: usize) -> [Vec3; 8] {
        let mut sum = [0.0; 24];
        for (d, value) in self.0.iter().enumerate() {
            if *value != 0.0 {
                let by = &slopes.mass[pair_index(c, d)];
                for (sum, slope) in sum.iter_mut().zip(by) {
                    *sum += value * slope;
                }
            }
        }
        std::array::from_fn(|e| Vec3::new(sum[3 * e], sum[3 * e + 1], sum[3 * e + 2]))
    }
}

/// Previous positions of the facing points, and the rotation of what was tangential then.
struct Moved {
    /// Old or carried positions, from a common origin.
    y: [Vec3; 8],
    /// `R(n, n^n) (I - n^n n^n)` or `I - n n`.
    turn: Matrix3<f64>,
    /// The old normal, for a deformable pair.
    n_old: Option<Vec3>,
    /// `true` if side `b` is a plane, on which the points follow those of side `a`.
    on_plane: bool,
}

impl Moved {
    fn new(
        configuration: &Configuration,
        start: &Configuration,
        paired: &PairedFacets,
        weights: [f64; 2],
    ) -> Self {
        let n = paired.segment.normal;
        let old = |corner: usize| start.side(Side::A).x[paired.corners[0][corner]];
        if configuration.pair.is_rigid() {
            // Moving the old position with the rigid surface makes slip independent of any rigid
            // motion of both.
            let carried = |x: Vec3| {
                let material = start.placement.back(&x);
                configuration.placement.point(&material)
            };
            let tangential = Matrix3::identity() - n * n.transpose();
            let on_plane = configuration.plane().is_some();
            let y = std::array::from_fn(|d| match d {
                0..4 if on_plane => paired.x[d] - carried(old(d)),
                0..4 => carried(old(d)) - paired.x[0],
                _ => paired.x[d] - paired.x[0],
            });
            return Self {
                y,
                turn: tangential,
                n_old: None,
                on_plane,
            };
        }
        // Differences from a near point: sums of absolute positions would lose digits far from the
        // origin.
        let origin = old(0);
        let x: [Vec3; 8] = std::array::from_fn(|d| match d {
            0..4 => old(d),
            _ => start.side(paired.sides[1]).x[paired.corners[1][d - 4]],
        });
        let facet = |first: usize| {
            let shape = striae_surface::facet::Shape::of(&paired.corners[first / 4]);
            Facet {
                corners: std::array::from_fn(|at| x[first + at]),
                shape,
            }
        };
        // Facets that did not face each other at the start have no common normal then; what is
        // tangential now is the best substitute.
        let n_old = normal_between(&facet(0), &facet(4), weights).unwrap_or(n);
        let tangential = Matrix3::identity() - n_old * n_old.transpose();
        let turned = Transported::new(&Vec3::zeros(), &n_old, &n);
        Self {
            y: x.map(|x| x - origin),
            turn: turned.by_vector * tangential,
            n_old: Some(n_old),
            on_plane: false,
        }
    }

    fn add_slip(&self, paired: &PairedFacets, rows: &mut SegmentRows) {
        let slopes = paired.segment.slopes.as_deref();
        if slopes.is_some() {
            rows.slip_slopes = vec![[[0.0; 9]; 8]; 8];
        }
        let turned = self.y.map(|y| self.turn * y);
        // On a plane `y` is the way of side `a` relative to it.
        let sign = |d: usize| if self.on_plane { 1.0 } else { SIGNS[d] };
        let components: [AtCorners; 3] =
            [0, 1, 2].map(|axis| AtCorners(std::array::from_fn(|d| sign(d) * turned[d][axis])));
        for c in 0..8 {
            let mass = &paired.segment.mass[c];
            let sum: Vec3 = (0..8).map(|d| turned[d] * (sign(d) * mass[d])).sum();
            rows.value[c][1..].copy_from_slice(sum.as_slice());
            let Some(slopes) = slopes else { continue };
            let by_mass = components.each_ref().map(|of| of.of_mass(slopes, c));
            let by_n = self.n_old.map(|n_old| {
                let plain: Vec3 = (0..8).map(|d| self.y[d] * (sign(d) * mass[d])).sum();
                let tangential = plain - n_old * n_old.dot(&plain);
                Transported::new(&tangential, &n_old, &paired.segment.normal).by_n
            });
            for e in 0..8 {
                let mut block = Matrix3::from_fn(|row, axis| by_mass[row][e][axis]);
                if let Some(by_n) = by_n {
                    block += by_n * slopes.normal[e];
                }
                if self.on_plane && e < 4 {
                    block += self.turn * mass[e];
                }
                for row in 0..3 {
                    for axis in 0..3 {
                        rows.slip_slopes[c][e][3 * row + axis] = block[(row, axis)];
                    }
                }
            }
        }
    }
}
