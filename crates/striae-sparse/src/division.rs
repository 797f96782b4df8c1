//! Division of a graph into parts of about the same weight that hang together little.

use crate::{
    error::SolveError,
    metis::{self, Graph},
};

/// A graph by the neighbours of its vertices.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Neighbourhood {
    starts: Vec<i32>,
    neighbours: Vec<i32>,
    costs: Vec<i32>,
    weights: Vec<i32>,
}

impl Default for Neighbourhood {
    fn default() -> Self {
        Self {
            starts: vec![0],
            neighbours: Vec::new(),
            costs: Vec::new(),
            weights: Vec::new(),
        }
    }
}

impl Neighbourhood {
    /// Adds a vertex of a positive weight, with its neighbours and the positive costs of
    /// having them in another part. Every edge is stated at both ends.
    pub fn add(&mut self, weight: u32, neighbours: impl IntoIterator<Item = (u32, u32)>) {
        for (neighbour, cost) in neighbours {
            self.neighbours.push(neighbour as i32);
            self.costs.push(cost.max(1) as i32);
        }
        self.starts.push(self.neighbours.len() as i32);
        self.weights.push(weight.max(1) as i32);
    }

    /// Returns whether all counts fit into 32 bits, every neighbour is a different vertex, and
    /// every edge is stated at both ends.
    fn is_sound(&self) -> bool {
        let count = self.weights.len();
        let most = i32::MAX as usize;
        let weight: i64 = self.weights.iter().map(|weight| i64::from(*weight)).sum();
        if count > most || self.neighbours.len() > most || weight > i64::from(i32::MAX) {
            return false;
        }
        let of = |vertex: usize| {
            let range = self.starts[vertex] as usize..self.starts[vertex + 1] as usize;
            &self.neighbours[range]
        };
        (0..count).all(|vertex| {
            of(vertex).iter().all(|&other| {
                let other = other as usize;
                other < count && other != vertex && of(other).contains(&(vertex as i32))
            })
        })
    }
}

/// Part of every vertex, of `count` parts that weigh about the same; the same for the same graph.
/// Some may be empty where there are few vertices.
///
/// # Errors
/// When the library for graphs fails.
///
/// # Panics
/// When the graph is none: an edge is stated at one end only, or there are too many to count.
pub fn divided(graph: Neighbourhood, count: usize) -> Result<Vec<u32>, SolveError> {
    assert!(graph.is_sound(), "edges of a graph have two ends");
    let vertices = graph.weights.len();
    if count <= 1 || vertices <= 1 {
        return Ok(vec![0; vertices]);
    }
    if vertices <= count {
        return Ok((0..vertices as u32).collect());
    }
    let Neighbourhood {
        starts,
        neighbours,
        costs,
        weights,
    } = graph;
    let graph = Graph {
        starts,
        neighbours,
        weights,
    };
    metis::k_way(graph, costs, count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of vertices of the weight one, `dear` edges of which cost much.
    fn chain(count: u32, dear: impl Fn(u32) -> bool) -> Neighbourhood {
        let cost = |edge: u32| if dear(edge) { 100 } else { 1 };
        let mut graph = Neighbourhood::default();
        for vertex in 0..count {
            let before = vertex.checked_sub(1).map(|other| (other, cost(other)));
            let after = (vertex + 1 < count).then(|| (vertex + 1, cost(vertex)));
            graph.add(1, before.into_iter().chain(after));
        }
        graph
    }

    #[test]
    fn chains_are_cut_where_it_is_cheap() {
        // Cheap in threes only.
        let parts = divided(chain(120, |edge| edge % 3 != 2), 4).unwrap();
        for three in parts.chunks(3) {
            assert!(three.iter().all(|part| *part == three[0]), "{parts:?}");
        }
        for part in 0..4 {
            let count = parts.iter().filter(|of| **of == part).count();
            assert!((27..=33).contains(&count), "{count} in part {part}");
        }
    }

    #[test]
    fn few_vertices_and_single_parts_are_divided() {
        assert_eq!(divided(chain(3, |_| false), 1), Ok(vec![0; 3]));
        assert_eq!(divided(chain(3, |_| false), 5), Ok(vec![0, 1, 2]));
        assert_eq!(divided(Neighbourhood::default(), 3), Ok(Vec::new()));
    }

    #[test]
    #[should_panic(expected = "two ends")]
    fn edges_with_one_end_are_refused() {
        let mut graph = Neighbourhood::default();
        graph.add(1, [(1, 1)]);
        graph.add(1, []);
        let _ = divided(graph, 2);
    }
}
