//! Fill-reducing ordering of a graph by nested dissection, and its division into parts that
//! hang together little: binding to METIS (Karypis & Kumar, doi:10.1137/S1064827595287997 and
//! doi:10.1006/jpdc.1997.1404).
#![allow(unsafe_code)]

use crate::error::SolveError;
use metis_sys::{
    METIS_NOPTIONS, METIS_NodeND, METIS_PartGraphKway, METIS_SetDefaultOptions, idx_t,
    moptions_et_METIS_OPTION_NUMBERING, moptions_et_METIS_OPTION_SEED, rstatus_et_METIS_OK,
};
use std::{ptr::null_mut, sync::Mutex};

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
    checked(code)?;
    Ok(order.into_iter().map(|vertex| vertex as u32).collect())
}

/// Part of every vertex, of `count` parts that weigh about the same; `costs` are those of
/// edges between parts, one for each neighbour.
pub(crate) fn k_way(
    mut graph: Graph,
    mut costs: Vec<i32>,
    count: usize,
) -> Result<Vec<u32>, SolveError> {
    let mut vertices = graph.weights.len() as idx_t;
    let (mut constraints, mut parts, mut cut) = (1, count as idx_t, 0);
    let mut options = [0; METIS_NOPTIONS as usize];
    let mut part = vec![0; graph.weights.len()];
    let guard = ONE_AT_A_TIME.lock();
    // SAFETY: all pointers are null, which METIS takes for what is not given, or to live arrays
    // of the lengths it asks for: `vertices + 1` starts, `starts[vertices]` neighbours and costs,
    // `vertices` weights and parts, METIS_NOPTIONS options. METIS keeps none of them.
    let code = unsafe {
        METIS_SetDefaultOptions(options.as_mut_ptr());
        options[moptions_et_METIS_OPTION_NUMBERING as usize] = 0;
        options[moptions_et_METIS_OPTION_SEED as usize] = SEED;
        METIS_PartGraphKway(
            &mut vertices,
            &mut constraints,
            graph.starts.as_mut_ptr(),
            graph.neighbours.as_mut_ptr(),
            graph.weights.as_mut_ptr(),
            null_mut(),
            costs.as_mut_ptr(),
            &mut parts,
            null_mut(),
            null_mut(),
            options.as_mut_ptr(),
            &mut cut,
            part.as_mut_ptr(),
        )
    };
    drop(guard);
    checked(code)?;
    Ok(part.into_iter().map(|part| part as u32).collect())
}

fn checked(code: i32) -> Result<(), SolveError> {
    if code == rstatus_et_METIS_OK {
        return Ok(());
    }
    Err(SolveError::Library {
        library: "METIS",
        code,
    })
}
