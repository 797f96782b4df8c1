//! Sums over long vectors in a fixed order, on any number of threads.
//!
//! Chunks of a fixed length are summed one by one, then the sums of the chunks.

use rayon::prelude::*;

/// Length of a chunk.
pub(crate) const CHUNK: usize = 4096;

/// Euclidean norm.
pub(crate) fn norm(v: &[f64]) -> f64 {
    let chunks = v.par_chunks(CHUNK);
    let squares: Vec<f64> = chunks.map(|v| v.iter().map(|v| v * v).sum()).collect();
    squares.iter().sum::<f64>().sqrt()
}

/// Products of a vector with each of others.
pub(crate) fn products(vectors: &[Vec<f64>], v: &[f64]) -> Vec<f64> {
    let parts: Vec<Vec<f64>> = v
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, v)| {
            let first = chunk * CHUNK;
            let own = vectors.iter().map(|q| &q[first..first + v.len()]);
            own.map(|q| dot(q, v)).collect()
        })
        .collect();
    let mut sums = vec![0.0; vectors.len()];
    for part in &parts {
        sums.iter_mut().zip(part).for_each(|(sum, p)| *sum += p);
    }
    sums
}

/// `v := v + sum_k factors_k vectors_k`.
pub(crate) fn add_combination(vectors: &[Vec<f64>], factors: &[f64], v: &mut [f64]) {
    v.par_chunks_mut(CHUNK).enumerate().for_each(|(chunk, v)| {
        let first = chunk * CHUNK;
        for (q, factor) in vectors.iter().zip(factors) {
            let own = &q[first..first + v.len()];
            v.iter_mut().zip(own).for_each(|(v, q)| *v += factor * q);
        }
    });
}

/// In four interleaved sums, which a processor adds at a time.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (fours, others) = (a.chunks_exact(4), b.chunks_exact(4));
    let tails = fours.remainder().iter().zip(others.remainder());
    let tail: f64 = tails.map(|(a, b)| a * b).sum();
    let mut sums = [0.0; 4];
    for (a, b) in fours.zip(others) {
        for k in 0..4 {
            sums[k] += a[k] * b[k];
        }
    }
    sums.iter().sum::<f64>() + tail
}
