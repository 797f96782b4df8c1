//! Common segments with the kept nodes whose basis functions live on them.

use crate::{
    configuration::Configuration, pairing::PairedFacets, segment_rows::SegmentRows,
    selection::Selection,
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
        let mut kept: Vec<(u32, [f64; 8])> = Vec::with_capacity(16);
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
