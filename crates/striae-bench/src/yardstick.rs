//! Sparse Cholesky factorisation by faer, with the ordering of the own solvers.

use crate::clock::Seconds;
use faer::{
    Par, Side,
    dyn_stack::{MemBuffer, MemStack},
    perm::Perm,
    sparse::{
        SparseColMat, Triplet,
        linalg::cholesky::{SymmetricOrdering, factorize_symbolic_cholesky},
    },
};
use std::{error::Error, time::Instant};
use striae_sparse::{SparseMatrix, nested_dissection};

/// Fewest repetitions, whose median counts, and the time that is filled with them, s.
const FEWEST: usize = 3;
const BUDGET: f64 = 0.5;

/// Time of one numeric factorisation: the median of a few, processor time their mean.
///
/// Rows with nothing but a diagonal are left alone: their columns are dropped.
pub fn cholesky(matrix: &SparseMatrix) -> Result<Seconds, Box<dyn Error>> {
    let structure = matrix.structure();
    let n = structure.unknowns();
    let order = nested_dissection(structure)?;
    let unknowns = order.iter().flat_map(|&s| structure.unknowns_of(s));
    let forward: Vec<usize> = unknowns.collect();
    let mut inverse = vec![0; n];
    for (k, &u) in forward.iter().enumerate() {
        inverse[u] = k;
    }
    let order = Perm::new_checked(forward.into(), inverse.into(), n);
    let held: Vec<bool> = (0..n)
        .map(|u| matrix.row(u).all(|(v, a)| (u == v) == (a != 0.0)))
        .collect();
    let mut lower = Vec::new();
    for u in 0..n {
        for (v, a) in matrix.row(u) {
            if u >= v && (u == v || !held[u] && !held[v]) {
                lower.push(Triplet::new(u, v, a));
            }
        }
    }
    let sparse = SparseColMat::<usize, f64>::try_new_from_triplets(n, n, &lower)
        .map_err(|error| format!("{error:?}"))?;
    drop(lower);
    let ordering = SymmetricOrdering::Custom(order.as_ref());
    let symbolic =
        factorize_symbolic_cholesky(sparse.symbolic(), Side::Lower, ordering, Default::default())
            .map_err(|error| format!("{error:?}"))?;
    let mut values = vec![0.0; symbolic.len_val()];
    let par = Par::rayon(0);
    let scratch = symbolic.factorize_numeric_llt_scratch::<f64>(par, Default::default());
    let mut memory = MemBuffer::new(scratch);
    let begin = Instant::now();
    let first = Seconds::now(begin);
    let mut times = Vec::new();
    while times.len() < FEWEST || begin.elapsed().as_secs_f64() < BUDGET {
        let started = Instant::now();
        symbolic
            .factorize_numeric_llt(
                &mut values,
                sparse.as_ref(),
                Side::Lower,
                Default::default(),
                par,
                MemStack::new(&mut memory),
                Default::default(),
            )
            .map_err(|error| format!("{error:?}"))?;
        times.push(started.elapsed().as_secs_f64());
    }
    let cpu = Seconds::now(begin).since(first).cpu / times.len() as f64;
    times.sort_by(f64::total_cmp);
    let wall = times[times.len() / 2];
    Ok(Seconds { wall, cpu })
}
