//! Fill-reducing ordering of a graph by nested dissection: binding to METIS
//! (Karypis & Kumar, doi:10.1137/S1064827595287997).
#![allow(unsafe_code)]

use crate::error::SolveError;
use metis_sys::{
    METIS_NOPTIONS, METIS_NodeND, METIS_SetDefaultOptions, idx_t,
    moptions_et_METIS_OPTION_NUMBERING, moptions_et_METIS_OPTION_SEED, rstatus_et_METIS_OK,
};
use std::sync::Mutex;

/// METIS draws from the random numbers of the C library, which all threads
/// share: one call at a time keeps the ordering reproducible.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

const SEED: idx_t = 1;

/// Undirected graph without loops, in compressed rows.
pub(crate) struct Graph {
    /// First neighbour of each vertex, one more than there are vertices.
    pub(crate) starts: Vec<i32>,
    /// Neighbours; every edge appears at both ends.
    pub(crate) neighbours: Vec<i32>,
    /// Positive weights of the vertices.
    pub(crate) weights: Vec<i32>,
}

/// Vertices in order of elimination.
pub(crate) fn nested_dissection(mut graph: Graph) -> Result<Vec<u32>, SolveError> {
    let count = graph.weights.len();
    if graph.neighbours.is_empty() {
        return Ok((0..count as u32).collect());
    }
    let mut vertices = count as idx_t;
    let mut options = [0; METIS_NOPTIONS as usize];
    let mut order = vec![0; count];
    let mut position = vec![0; count];
    let guard = ONE_AT_A_TIME.lock();
    // SAFETY: all pointers are to live arrays of the lengths METIS asks for:
    // `count + 1` starts, `starts[count]` neighbours, `count` weights and
    // permutations, METIS_NOPTIONS options. METIS keeps none of them.
    let code = unsafe {
        METIS_SetDefaultOptions(options.as_mut_ptr());
        options[moptions_et_METIS_OPTION_NUMBERING as usize] = 0;
        options[moptions_et_METIS_OPTION_SEED as usize] = SEED;
        METIS_NodeND(
            &mut vertices,
            graph.starts.as_mut_ptr(),
            graph.neighbours.as_mut_ptr(),
            graph.weights.as_mut_ptr(),
            options.as_mut_ptr(),
            order.as_mut_ptr(),
            position.as_mut_ptr(),
        )
    };
    drop(guard);
    if code != rstatus_et_METIS_OK {
        return Err(SolveError::Library {
            library: "METIS",
            code,
        });
    }
    Ok(order.into_iter().map(|vertex| vertex as u32).collect())
}
