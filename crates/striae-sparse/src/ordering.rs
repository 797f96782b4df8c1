//! Order of elimination of the supervariables: tier by tier, nested
//! dissection of the graph each tier induces, weighted by the sizes.

use crate::{
    error::SolveError,
    metis::{self, Graph},
    structure::Structure,
    supervariable::{Supervariable, Tier},
};

/// Order of elimination that the solvers would choose without tiers, for comparisons.
///
/// # Errors
/// When the library for orderings fails.
pub fn nested_dissection(structure: &Structure) -> Result<Vec<Supervariable>, SolveError> {
    let order = order(structure, &vec![Tier(0); structure.supervariables()])?;
    let supervariable = |i: u32| Supervariable(i as usize);
    Ok(order.into_iter().map(supervariable).collect())
}

/// Supervariables in order of elimination.
pub(crate) fn order(structure: &Structure, tiers: &[Tier]) -> Result<Vec<u32>, SolveError> {
    let count = structure.supervariables();
    let tier = |i: u32| tiers[i as usize];
    let mut members: Vec<u32> = (0..count as u32).collect();
    members.sort_by_key(|&i| tier(i));
    let mut order = Vec::with_capacity(count);
    let mut index = vec![0; count];
    for group in members.chunk_by(|&a, &b| tier(a) == tier(b)) {
        let graph = induced(structure, tiers, group, &mut index);
        order.extend(
            metis::nested_dissection(graph)?
                .into_iter()
                .map(|v| group[v as usize]),
        );
    }
    Ok(order)
}

/// Graph on the members of one tier.
fn induced(structure: &Structure, tiers: &[Tier], members: &[u32], index: &mut [i32]) -> Graph {
    for (k, &i) in members.iter().enumerate() {
        index[i as usize] = k as i32;
    }
    let mut graph = Graph {
        starts: vec![0],
        neighbours: Vec::new(),
        weights: Vec::new(),
    };
    for &i in members {
        for j in structure.neighbours(Supervariable(i as usize)) {
            if j.0 != i as usize && tiers[j.0] == tiers[i as usize] {
                graph.neighbours.push(index[j.0]);
            }
        }
        graph.starts.push(graph.neighbours.len() as i32);
        graph
            .weights
            .push(structure.group(i as usize).len().max(1) as i32);
    }
    graph
}
