//! Gap and slip of the kept nodes, weighted with the traction field.
//!
//! With the basis `phi_k = 1/2 (N^i Z + N^j Z)_k` on the facets `i` and `j` of a segment, against
//! a rigid surface `(N^i Z)_k`, and `psi_k = 1/2 (N^i Y - N^j Y)_k` of `transfer`, the
//! rows are adjoint to the forces of [`crate::common_field`]:
//!
//! ```text
//! g_k  = 1/w^0_k integral phi_k min(g, p_k/r_k) da + 1/w^0_k sum_l E_kl p_l
//! du_k = 1/w_k integral psi_k R(n_k, s_k n) du da
//!      + 1/w_k sum_l R(n_k, n_l) (E_kl tau_l - E'_kl tau^n_l)
//! w_k  = integral phi_k da
//! ```
//!
//! `w^0_k` is `w_k` at the start of the increment, a constant; the row states `g_k = 0`. Where a
//! support is closed at all points that is the mean gap, where it is open `p_k/r_k`; between, a
//! bedding `r_k` (see [`crate::bedding`]) turns into a multiplier as the support fills. `du`
//! is how the first facet slips, `du_k` how the node does. The terms with `E` are those of [`crate::ramp`].

use nalgebra::Matrix3;
use rayon::prelude::*;
use striae_mesh::Vec3;

use crate::{
    configuration::Configuration,
    frame::{Frame, Frames},
    kinematics::{Kinematics, Presence, Pressure, Report, Supported},
    pairing::{SIGNS, corner_sign},
    patch::{OnSegment, Patch},
    places::{ChainedSum, Places},
    segment_rows::Slip,
    selection::Selection,
    term::{Gradient, Jacobian},
    tracked::{Tracked, TrackedScalar},
    traction_basis::KeptNode,
    transported::Transported,
    unknowns::Tractions,
};

/// Weight below which a node has left the other side, over that at the start.
const GONE: f64 = 1e-9;

/// Gaps and slips of all kept nodes without what the ramp adds.
pub fn kinematics(
    configuration: &Configuration,
    selection: &Selection,
    frames: &Frames,
    tractions: &Tractions,
    (patches, slip): (&[Patch], Slip),
) -> Vec<Kinematics> {
    let mut touching: Vec<Vec<(u32, u32)>> = vec![Vec::new(); selection.kept().len()];
    for (at, patch) in patches.iter().enumerate() {
        for (entry, kept) in patch.kept.iter().enumerate() {
            touching[kept.k as usize].push((at as u32, entry as u32));
        }
    }
    (0..touching.len())
        .into_par_iter()
        // Each node sums its segments in their order, whichever thread does it.
        .with_min_len(4)
        .map(|k| {
            let kept = selection.kept()[k];
            let frame = frames[kept.side][kept.node].as_ref();
            let mut sum = Sum::new(configuration, kept, frame);
            for &(at, entry) in &touching[k] {
                sum.add(&patches[at as usize], entry as usize, slip);
            }
            let closed = tractions.bedded[kept.side][kept.node];
            let bedding = selection.bedding(k, closed);
            sum.over(selection.weight(k), selection.stiffness(k), bedding)
        })
        .collect()
}

/// Sum over the segments of a kept node.
struct Sum<'a> {
    configuration: &'a Configuration<'a>,
    kept: KeptNode,
    frame: Option<&'a Frame>,
    gap: f64,
    /// Of the gap by the pressure of the node.
    by_pressure: f64,
    weight: f64,
    closed: f64,
    touches: bool,
    slip: Vec3,
    slip_by_n: Matrix3<f64>,
    places: Places,
    triples: Vec<u32>,
    /// Of the gap, by triple.
    gap_blocks: Vec<[f64; 3]>,
    /// Of the weight, by triple.
    weight_blocks: Vec<[f64; 3]>,
    /// Of the slip, by triple; only as long as the last one that has any.
    slip_blocks: Vec<Matrix3<f64>>,
    /// `alpha_ck` of the same nodes.
    alphas: Vec<f64>,
    /// Reaches multiplied by the normals: change of the mean gap over a closed support.
    reaches: Vec<Vec3>,
}

impl<'a> Sum<'a> {
    fn new(configuration: &'a Configuration, kept: KeptNode, frame: Option<&'a Frame>) -> Self {
        Self {
            configuration,
            kept,
            frame,
            gap: 0.0,
            by_pressure: 0.0,
            weight: 0.0,
            closed: 0.0,
            touches: false,
            slip: Vec3::zeros(),
            slip_by_n: Matrix3::zeros(),
            places: Places::none(),
            triples: Vec::with_capacity(48),
            gap_blocks: Vec::with_capacity(48),
            weight_blocks: Vec::with_capacity(48),
            slip_blocks: Vec::new(),
            alphas: Vec::with_capacity(48),
            reaches: Vec::with_capacity(48),
        }
    }

    fn add(&mut self, patch: &Patch, entry: usize, slip: Slip) {
        let OnSegment {
            shares,
            slips,
            sign,
            ..
        } = &patch.kept[entry];
        let pressed = &patch.pressed;
        let mut moved = Vec3::zeros();
        let mut by_gap = [0.0; 24];
        let mut by_weight = [0.0; 24];
        let mut by_slip = [[0.0; 9]; 8];
        for (c, &share) in shares
            .iter()
            .enumerate()
            .filter(|(_, share)| **share != 0.0)
        {
            let [_, x, y, z] = patch.rows.value[c];
            // Slips are taken before they are turned: all corners of the segment share one
            // rotation.
            moved += Vec3::new(x, y, z) * slips[c];
            self.weight += share * patch.rows.areas[c];
            if let Some(of_area) = patch.rows.area_slopes.get(c) {
                add_multiple(&mut by_weight, share, of_area);
            }
            let of_slip = patch.rows.slip_slopes.get(c).into_iter().flatten();
            let sums = by_slip.iter_mut().zip(of_slip);
            sums.for_each(|(sum, part)| add_multiple(sum, slips[c], part));
        }
        self.gap += pressed.rows[entry];
        self.closed += pressed.closed[entry];
        self.touches |= pressed.touches[entry];
        if let Some(slopes) = &pressed.slopes {
            by_gap = slopes.rows[entry];
            self.by_pressure += slopes.rows_by_pressure[entry];
        }
        let turned = (slip == Slip::Wanted).then(|| self.turned(patch, &moved, *sign));
        let slopes = patch.paired.segment.slopes.as_deref();
        let is_rigid = self.configuration.pair.is_rigid();
        for corner in 0..8 {
            let Some((side, node)) = patch.paired.node(self.configuration, corner) else {
                continue;
            };
            // Without slopes a row tells only whether the node itself or one that is opposite is
            // free, and by any entry that it faces something: a rigid side has none.
            let is_beside = self.is_beside(patch, corner) && node != self.kept.node;
            if slopes.is_none() && is_beside && !is_rigid {
                continue;
            }
            let mass = &patch.paired.segment.mass[corner];
            let alpha: f64 = mass.iter().zip(shares).map(|(m, share)| m * share).sum();
            let of_corner = |row: &[f64; 24]| std::array::from_fn(|i| row[3 * corner + i]);
            let first = self.configuration.pair.numbering().position(side, node);
            let blocks = [of_corner(&by_gap), of_corner(&by_weight)];
            let normal = patch.paired.segment.normal * (SIGNS[corner] * alpha);
            let at = self.add_at(first, blocks, alpha, normal);
            if let (Some(turned), Some(slopes)) = (&turned, slopes) {
                let own = Matrix3::from_row_slice(&by_slip[corner]);
                let whole = turned.by_vector * own + turned.by_from * slopes.normal[corner];
                self.add_to_slip(at, &whole);
            }
        }
    }

    /// Returns whether a corner lies on the side of the node, or of the facet around it.
    fn is_beside(&self, patch: &Patch, corner: usize) -> bool {
        let paired = &patch.paired;
        match self.configuration.pair.is_self_contact() {
            true => paired.corners[corner / 4].contains(&self.kept.node),
            false => paired.sides[corner / 4] == self.kept.side,
        }
    }

    /// Adds the slip, turned to the node's own tangent plane.
    fn turned(&mut self, patch: &Patch, slip: &Vec3, sign: f64) -> Transported {
        let n = self.frame.map_or_else(Vec3::zeros, |frame| frame.n.value);
        let turned = Transported::new(slip, &patch.paired.segment.normal, &(n * sign));
        self.slip += turned.value;
        self.slip_by_n += turned.by_n * sign;
        turned
    }

    /// Adds to what depends on a triple, and returns its place.
    fn add_at(&mut self, first: u32, [gap, weight]: [[f64; 3]; 2], alpha: f64, n: Vec3) -> usize {
        let next = self.triples.len();
        let at = self.places.find(first, next);
        if at == next {
            self.triples.push(first);
            self.gap_blocks.push(gap);
            self.weight_blocks.push(weight);
            self.alphas.push(alpha);
            self.reaches.push(n);
        } else {
            add_multiple(&mut self.gap_blocks[at], 1.0, &gap);
            add_multiple(&mut self.weight_blocks[at], 1.0, &weight);
            self.alphas[at] += alpha;
            self.reaches[at] += n;
        }
        at
    }

    fn add_to_slip(&mut self, at: usize, block: &Matrix3<f64>) {
        if at >= self.slip_blocks.len() {
            self.slip_blocks.resize(at + 1, Matrix3::zeros());
        }
        self.slip_blocks[at] += block;
    }

    /// The means over the weight of the node: that at the start for the gap, the present one
    /// for the slip.
    fn over(self, start: f64, stiffness: [f64; 2], bedding: f64) -> Kinematics {
        // The gap row is divided by the weight at the start, a constant: derivatives of the weight
        // would vanish at the solution anyway.
        let share = 1.0 / start;
        let by_triple = |blocks: &[[f64; 3]], share: f64| -> Gradient {
            let blocks = self.triples.iter().copied().zip(blocks);
            let scaled = |(first, block): (u32, &[f64; 3])| (first, Vec3::from(*block) * share);
            blocks.map(scaled).collect()
        };
        let is_gone = self.weight <= GONE * start;
        let mut gradient = by_triple(&self.gap_blocks, share);
        let numbering = self.configuration.pair.numbering();
        let own = numbering.traction(self.kept.side, self.kept.node);
        gradient.push((own, Vec3::x() * (self.by_pressure * share)));
        let weight = TrackedScalar {
            value: self.weight,
            gradient: by_triple(&self.weight_blocks, 1.0),
        };
        // The slip of a node that has left the other side is meaningless; dividing by its tiny
        // weight would make it huge as well.
        let present = if is_gone { start } else { self.weight };
        let slip = self.slip / present;
        let share = 1.0 / present;
        let jacobian = self.triples.iter().copied().zip(&self.slip_blocks);
        let mut jacobian: Jacobian = jacobian
            .zip(&weight.gradient)
            .map(|((first, block), (_, by_weight))| {
                (first, block * share - slip * by_weight.transpose() * share)
            })
            .collect();
        if let Some(frame) = self.frame
            && !jacobian.is_empty()
        {
            // For the table to be the one of this thread again.
            drop(self.places);
            let mut sum = ChainedSum::onto(&mut jacobian);
            sum.add(&(self.slip_by_n * share), &frame.n.jacobian);
        }
        let closed = if is_gone {
            0.0
        } else {
            self.closed / self.weight
        };
        let alphas = self.alphas.iter().map(|alpha| alpha / start);
        let reaches = self.reaches.iter().map(|reach| reach / start);
        Kinematics {
            seen_slip: slip,
            shares: self.triples.iter().copied().zip(alphas).collect(),
            reaches: self.triples.iter().copied().zip(reaches).collect(),
            presence: if is_gone {
                Presence::Gone
            } else {
                Presence::Facing
            },
            gap: TrackedScalar {
                value: self.gap / start,
                gradient,
            },
            slip: Tracked {
                value: slip,
                jacobian,
            },
            stiffness,
            pressure: Pressure::AtPoints(Supported {
                weight,
                closed,
                touches: self.touches && !is_gone,
                bedding,
                mean: TrackedScalar::default(),
            }),
        }
    }
}

/// `sum := sum + factor part`.
fn add_multiple<const N: usize>(sum: &mut [f64; N], factor: f64, part: &[f64; N]) {
    sum.iter_mut()
        .zip(part)
        .for_each(|(sum, part)| *sum += factor * part);
}

/// Values reported for every node of both sides.
pub fn reports(
    configuration: &Configuration,
    counts: [usize; 2],
    patches: &[Patch],
) -> [Vec<Report>; 2] {
    let mut reports = counts.map(|count| vec![Report::default(); count]);
    for patch in patches {
        for corner in 0..8 {
            if let Some((side, node)) = patch.paired.node(configuration, corner) {
                let report = &mut reports[side][node];
                let [gap, x, y, z] = patch.rows.value[corner];
                report.gap += gap;
                report.slip += Vec3::new(x, y, z) * corner_sign(corner);
                report.area += patch.paired.area_of(corner);
            }
        }
    }
    for report in reports
        .iter_mut()
        .flatten()
        .filter(|report| report.area > 0.0)
    {
        report.gap /= report.area;
        report.slip /= report.area;
    }
    reports
}
