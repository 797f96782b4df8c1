//! Common segments with the kept nodes whose basis functions live on them.

use rayon::prelude::*;
use striae_mesh::FacetId;
use striae_surface::node::SurfaceNode;

use crate::{
    configuration::Configuration,
    pairing::{Corners, PairedFacets, paired_facets},
    segment::Derivatives,
    segment_rows::{Given, SegmentRows, Slip, segment_rows},
    selection::Selection,
    side::Side,
};

/// A segment with its rows and the kept nodes whose basis functions live on it.
pub struct Patch {
    /// Facets and integrals.
    pub paired: PairedFacets,
    /// Gap and slip.
    pub rows: SegmentRows,
    /// Kept nodes, and the values of their basis functions at the corners: `phi_k = sum_c
    /// share_kc N_c`.
    pub kept: Vec<(u32, [f64; 8])>,
}

impl Patch {
    /// The kept nodes at the corners of paired facets.
    pub fn kept_of(
        configuration: &Configuration,
        selection: &Selection,
        paired: &PairedFacets,
    ) -> Vec<(u32, [f64; 8])> {
        let share = if configuration.pair.is_rigid() {
            1.0
        } else {
            0.5
        };
        let mut kept: Vec<(u32, [f64; 8])> = Vec::with_capacity(8);
        for corner in 0..8 {
            let Some((side, node)) = paired.node(configuration, corner) else {
                continue;
            };
            for &(k, weight) in selection.row(side, node) {
                let at = match kept.binary_search_by_key(&k, |entry| entry.0) {
                    Ok(at) => at,
                    Err(at) => {
                        kept.insert(at, (k, [0.0; 8]));
                        at
                    }
                };
                kept[at].1[corner] = share * weight;
            }
        }
        kept
    }
}

/// Whether derivatives of what facets with these corners add to rows are wanted.
pub(crate) fn wanted(
    configuration: &Configuration,
    selection: &Selection,
    (wanted, corners): (Option<&[Vec<bool>; 2]>, &[Corners]),
) -> Derivatives {
    let Some(wanted) = wanted else {
        return Derivatives::First;
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
    match nodes.any(|is_wanted| is_wanted) {
        true => Derivatives::First,
        false => Derivatives::None,
    }
}

/// The segments between facets whose corners carry traction.
pub(crate) fn patches(
    configuration: &Configuration,
    start: &Configuration,
    selection: &Selection,
    (slip, slopes): (Slip, &(impl Fn(&[Corners]) -> Derivatives + Sync)),
) -> Vec<Patch> {
    let own = configuration.side(Side::A);
    let carries = |facet: FacetId| {
        let corners = own.corners(facet);
        corners.iter().any(|&node| selection.carries(Side::A, node))
    };
    let scope = selection.scope();
    paired_facets(configuration, scope, slopes, carries)
        .into_par_iter()
        .with_min_len(4)
        .map(|paired| {
            let given = Given {
                weights: scope.weights(&paired),
                offsets: selection.offsets_at(configuration, &paired),
                slip,
            };
            let rows = segment_rows(configuration, start, &paired, given);
            Patch {
                kept: Patch::kept_of(configuration, selection, &paired),
                rows,
                paired,
            }
        })
        .collect()
}
