//! Aggregates: small groups of strongly coupled nodes (Vanek, Mandel & Brezina,
//! doi:10.1007/BF02238511).
//!
//! Nodes are strongly coupled when `|A_ij|^2 > theta^2 |A_ii| |A_jj|` in Frobenius
//! norms. A node all of whose strong neighbours are free begins an aggregate with
//! them; the others join one of a strong neighbour; what is left makes aggregates
//! of its own. A node without strong neighbours is in none: smoothing alone does.

use super::blocks::Blocks;
use rayon::prelude::*;

/// In no aggregate.
pub const NONE: u32 = u32::MAX;

/// Aggregate of every node, and their number.
#[derive(Debug)]
pub(crate) struct Aggregates {
    pub(crate) of: Vec<u32>,
    pub(crate) count: usize,
}

impl Aggregates {
    /// Aggregates of the nodes of a matrix; only pairs of one part count as coupled. Nodes
    /// without a row are in none.
    pub(crate) fn new<const N: usize>(
        matrix: &Blocks<N, N, f64>,
        theta: f64,
        parts: &[u32],
    ) -> Self {
        let graph = Graph::strong(matrix, theta, parts);
        let nodes = matrix.rows();
        let mut of = vec![NONE; nodes];
        let mut count = 0;
        for i in 0..nodes {
            let near = graph.near(i);
            let free = of[i] == NONE && near.iter().all(|&j| of[j as usize] == NONE);
            if !near.is_empty() && free {
                of[i] = count;
                near.iter().for_each(|&j| of[j as usize] = count);
                count += 1;
            }
        }
        let first = of.clone();
        for i in 0..nodes {
            if of[i] == NONE {
                let near = graph.near(i).iter().map(|&j| first[j as usize]);
                of[i] = most_frequent(near.filter(|&a| a != NONE));
            }
        }
        for i in 0..nodes {
            let near = graph.near(i);
            if of[i] == NONE && !near.is_empty() {
                of[i] = count;
                for &j in near {
                    if of[j as usize] == NONE {
                        of[j as usize] = count;
                    }
                }
                count += 1;
            }
        }
        Self {
            of,
            count: count as usize,
        }
    }

    /// Part that the nodes of each aggregate are of.
    pub(crate) fn parts(&self, of_nodes: &[u32]) -> Vec<u32> {
        let mut parts = vec![NONE; self.count];
        for (&aggregate, &part) in self.of.iter().zip(of_nodes) {
            if aggregate != NONE {
                parts[aggregate as usize] = part;
            }
        }
        parts
    }

    /// Nodes of every aggregate, rising.
    pub(crate) fn members(&self) -> Vec<Vec<u32>> {
        let mut members = vec![Vec::new(); self.count];
        for (i, &aggregate) in self.of.iter().enumerate() {
            if aggregate != NONE {
                members[aggregate as usize].push(i as u32);
            }
        }
        members
    }
}

/// The most frequent number, the smallest of equals; `NONE` of none.
fn most_frequent(numbers: impl Iterator<Item = u32>) -> u32 {
    let mut sorted: Vec<u32> = numbers.collect();
    sorted.sort_unstable();
    let runs = sorted.chunk_by(|a, b| a == b);
    let longest = runs.fold((0, NONE), |best, run| {
        if run.len() > best.0 {
            (run.len(), run[0])
        } else {
            best
        }
    });
    longest.1
}

/// Strong neighbours of every node, in compressed rows.
struct Graph {
    starts: Vec<usize>,
    neighbours: Vec<u32>,
}

impl Graph {
    fn strong<const N: usize>(matrix: &Blocks<N, N, f64>, theta: f64, parts: &[u32]) -> Self {
        let square = |block: &[f64]| block.iter().map(|a| a * a).sum::<f64>();
        let diagonal: Vec<f64> = (0..matrix.rows())
            .into_par_iter()
            .map(|i| {
                let own = matrix.row(i).find(|&(j, _)| j == i);
                own.map_or(0.0, |(_, block)| square(block)).sqrt()
            })
            .collect();
        let lists: Vec<Vec<u32>> = (0..matrix.rows())
            .into_par_iter()
            .with_min_len(64)
            .map(|i| {
                let strong = |&(j, block): &(usize, &[f64])| {
                    let may_join = j != i && j < parts.len() && parts[i] == parts[j];
                    may_join && square(block) > theta * theta * diagonal[i] * diagonal[j]
                };
                let near = matrix.row(i).filter(strong);
                near.map(|(j, _)| j as u32).collect()
            })
            .collect();
        let mut starts = vec![0];
        for list in &lists {
            starts.push(starts[starts.len() - 1] + list.len());
        }
        Self {
            starts,
            neighbours: lists.concat(),
        }
    }

    fn near(&self, i: usize) -> &[u32] {
        &self.neighbours[self.starts[i]..self.starts[i + 1]]
    }
}
