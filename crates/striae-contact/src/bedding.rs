//! The bedding of a kept node: pressure per gap on the part of its support that is open.
//!
//! ```text
//! r_k = [C_CLOSED + (C_OPEN - C_CLOSED) o_k]/l_k
//! ```
//!
//! with the flexibility `l_k` of the facets around the node and the open share `o_k` of its
//! support, where `g > p_k l_k/C_OPEN`. Below the size of a facet the bedding is the only
//! compliance there is: an elastic half-space under a cap of .18 of a facet, or a flat punch of
//! .35, has `r_k l_k = 5`; smaller contacts want more, larger ones less. Where a support is
//! closed gaps are zero in the mean, and a bedding would only penalise what gaps non-matching
//! meshes leave between nodes.
//!
//! `o_k` is that of the last converged state, one where there was no contact, and rests in an
//! increment, so that rows stay those of a bedding.

/// `r_k l_k` of a support that is open.
pub const C_OPEN: f64 = 5.0;
/// `r_k l_k` of a support that is closed.
pub const C_CLOSED: f64 = 0.1;

/// `r_k` of a node with the flexibility `l_k`, `closed = 1 - o_k`; zero where nothing yields.
pub fn bedding(flexibility: f64, closed: f64) -> f64 {
    match flexibility > 0.0 {
        // Where the support is closed the multiplier acts, and a stiff bedding would only penalise
        // the gaps that non-matching meshes leave.
        true => (C_OPEN + (C_CLOSED - C_OPEN) * closed) / flexibility,
        false => 0.0,
    }
}
