//! Common segments with the kept nodes whose basis functions live on them.

use rayon::prelude::*;
use striae_mesh::FacetId;
use striae_surface::{facet::Shape, node::SurfaceNode};

use crate::{
    complementarity::Iteration,
    configuration::Configuration,
    pairing::{Corners, Folded, PairedFacets, corner_sign, paired_unless_folded},
    segment::{Facet, Pressed, Pressing, SegmentDerivatives, Support},
    segment_rows::{Given, SegmentRows, Slip, segment_rows},
    selection::Selection,
    side::Side,
    unknowns::Tractions,
};

/// Gap up to which points count as closed in the first iteration of an increment, over the size
/// of the facet.
const TOUCHING: f64 = 1e-9;
/// Gap that is round-off, over the size of the facet and its distance from the origin: points up to
/// it count as closed for the next increment.
const ROUND_OFF: f64 = 1e-13;

/// A segment with its rows and the kept nodes whose basis functions live on it.
pub struct Patch {
    /// Facets and integrals.
    pub paired: PairedFacets,
    /// Gap and slip.
    pub rows: SegmentRows,
    /// Kept nodes, in their order.
    pub kept: Vec<OnSegment>,
    /// Integrals of pressure, in the order of the kept nodes.
    pub pressed: Pressed,
}

/// A kept node on a segment.
#[derive(Clone, Debug)]
pub struct OnSegment {
    /// Its place among the kept nodes.
    pub k: u32,
    /// Its basis function for pressure at the corners: `phi_k = sum_c share_kc N_c`.
    pub shares: [f64; 8],
    /// Function for friction as the first facet sees it, `psi_k`: with the sign of what is passed
    /// on from the node to the corner, and from there to the first facet.
    pub slips: [f64; 8],
    /// 1 where the node is seen from the side of the first facet, -1 from that of the second.
    pub sign: f64,
}

/// The kept nodes whose basis functions live on a segment.
pub(crate) fn kept_on(
    configuration: &Configuration,
    selection: &Selection,
    paired: &PairedFacets,
) -> Vec<OnSegment> {
    let share = configuration.pair.share();
    let mut kept: Vec<OnSegment> = Vec::with_capacity(8);
    for corner in 0..8 {
        let Some((side, node)) = paired.node(configuration, corner) else {
            continue;
        };
        let row = selection.row(side, node).iter();
        for (&(k, weight), friction) in row.zip(selection.friction_row(side, node)) {
            let at = match kept.binary_search_by_key(&k, |entry| entry.k) {
                Ok(at) => at,
                Err(at) => {
                    let none = OnSegment {
                        k,
                        shares: [0.0; 8],
                        slips: [0.0; 8],
                        sign: 0.0,
                    };
                    kept.insert(at, none);
                    at
                }
            };
            let kept = &mut kept[at];
            kept.shares[corner] = share * weight;
            kept.slips[corner] = share * friction * corner_sign(corner);
            kept.sign += kept.slips[corner];
        }
    }
    for kept in &mut kept {
        kept.sign = if kept.sign < 0.0 { -1.0 } else { 1.0 };
    }
    kept
}

/// Returns which derivatives are needed of the contributions of facets with these corners to the
/// rows.
pub(crate) fn wanted(
    configuration: &Configuration,
    selection: &Selection,
    (wanted, corners): (Option<&[Vec<bool>; 2]>, &[Corners]),
) -> bool {
    let Some(wanted) = wanted else {
        return true;
    };
    let is_wanted = |(side, node): (Side, SurfaceNode)| wanted[side][node];
    let followed = |side: Side, node: SurfaceNode| {
        let mut row = selection.row(side, node).iter();
        row.any(|&(k, _)| is_wanted(selection.kept()[k as usize].place()))
    };
    // Corners of a rigid side have no rows.
    let corners = corners
        .iter()
        .filter(|(side, _)| configuration.pair.is_deformable(*side));
    let nodes = corners.flat_map(|(side, nodes)| nodes.map(|node| (*side, node)));
    let mut nodes = nodes.map(|(side, node)| is_wanted((side, node)) || followed(side, node));
    nodes.any(|is_wanted| is_wanted)
}

/// The pressure of kept nodes in an iteration.
#[derive(Clone, Copy)]
pub(crate) struct Pressures<'a> {
    /// Unknowns and beddings.
    pub tractions: &'a Tractions,
    /// Stage of the iteration.
    pub iteration: Iteration,
}

impl Pressures<'_> {
    /// Integrals of the pressures over a segment.
    fn on(
        &self,
        configuration: &Configuration,
        selection: &Selection,
        paired: &PairedFacets,
        kept: &[OnSegment],
        offsets: &[f64; 8],
    ) -> Pressed {
        let supports: Vec<Support> = kept
            .iter()
            .map(|&OnSegment { k, shares, .. }| {
                let (side, node) = selection.kept()[k as usize].place();
                let closed = self.tractions.bedded[side][node];
                Support {
                    shares,
                    pressure: self.tractions.nodes[side][node][0],
                    bedding: selection.bedding(k as usize, closed),
                    full: selection.bedding(k as usize, 0.0),
                }
            })
            .collect();
        let heights = paired.heights(configuration);
        let segment = &paired.segment;
        let heights = std::array::from_fn(|d| heights[d] + offsets[d]);
        let size = segment.area.sqrt();
        let touching = match self.iteration {
            Iteration::First => TOUCHING * size,
            Iteration::Later(_) | Iteration::Corrected(_) | Iteration::Given => 0.0,
        };
        let near = ROUND_OFF * (size + paired.x[0].norm());
        let pressing = Pressing::new(supports, heights, [touching, near]);
        let x = &paired.x;
        let facet = Facet {
            corners: [x[0], x[1], x[2], x[3]],
            shape: Shape::of(&paired.corners[0]),
        };
        segment.pressed(&facet, &pressing)
    }
}

/// The segments between facets whose corners carry traction.
///
/// # Errors
/// When the surfaces are folded over each other.
pub(crate) fn patches(
    configuration: &Configuration,
    start: &Configuration,
    selection: &Selection,
    pressures: Pressures,
    (slip, slopes): (Slip, &(impl Fn(&[Corners]) -> SegmentDerivatives + Sync)),
) -> Result<Vec<Patch>, Folded> {
    let own = configuration.side(Side::A);
    let carries = |facet: FacetId| {
        let corners = own.corners(facet);
        corners.iter().any(|&node| selection.carries(Side::A, node))
    };
    let scope = selection.scope();
    let paired = paired_unless_folded(configuration, start, scope, slopes, carries)?;
    let patches = paired
        .into_par_iter()
        .with_min_len(4)
        .map(|paired| {
            let given = Given {
                weights: scope.weights(&paired),
                offsets: selection.offsets_at(configuration, &paired),
                slip,
            };
            let rows = segment_rows(configuration, start, &paired, given);
            let kept = kept_on(configuration, selection, &paired);
            let offsets = &given.offsets;
            Patch {
                pressed: pressures.on(configuration, selection, &paired, &kept, offsets),
                kept,
                rows,
                paired,
            }
        })
        .collect();
    Ok(patches)
}
