//! Sums over the ranks that hold a node.
//!
//! Nodes that all ranks hold are summed by a reduction. For others each rank sends what it has to
//! every other holder, and all of them add in the order of the ranks, so that they obtain the same
//! bits.

use striae_mesh::Vec3;

use super::Holding;
use crate::team::Team;
use striae_model::node::GlobalNode;

/// Sums fields over the ranks that hold each node; collective.
pub(super) fn sum(team: &dyn Team, holding: &Holding, fields: &mut [&mut [Vec3]]) {
    let mut replicated = values(fields, &holding.replicated);
    team.sum(&mut replicated);
    put(fields, &holding.replicated, &replicated);
    let parcels = holding.common.iter().map(|nodes| values(fields, nodes));
    let received = team.exchange(parcels.collect());
    let border = Border::new(holding);
    let own = values(fields, &border.nodes);
    let mut sums = vec![0.0; own.len()];
    let width = 3 * fields.len();
    for (rank, received) in received.iter().enumerate() {
        if rank == team.rank() {
            add(&mut sums, &own);
            continue;
        }
        for (node, values) in holding.common[rank]
            .iter()
            .zip(received.chunks_exact(width))
        {
            let first = width * border.places[*node];
            add(&mut sums[first..first + width], values);
        }
    }
    put(fields, &border.nodes, &sums);
}

/// Nodes that some other ranks hold, but not all.
struct Border {
    nodes: Vec<GlobalNode>,
    /// Place of each local node among them, if it is one.
    places: Vec<usize>,
}

impl Border {
    fn new(holding: &Holding) -> Self {
        const NONE: usize = usize::MAX;
        let (mut nodes, mut places) = (Vec::new(), vec![NONE; holding.nodes.len()]);
        for &node in holding.common.iter().flatten() {
            if places[node] == NONE {
                places[node] = nodes.len();
                nodes.push(node);
            }
        }
        Self { nodes, places }
    }
}

/// Values of fields at nodes, node by node.
fn values(fields: &[&mut [Vec3]], nodes: &[GlobalNode]) -> Vec<f64> {
    let mut values = Vec::with_capacity(3 * fields.len() * nodes.len());
    for &node in nodes {
        fields
            .iter()
            .for_each(|field| values.extend(field[node].iter()));
    }
    values
}

fn put(fields: &mut [&mut [Vec3]], nodes: &[GlobalNode], values: &[f64]) {
    let mut values = values.chunks_exact(3);
    for &node in nodes {
        for (field, value) in fields.iter_mut().zip(&mut values) {
            field[node] = Vec3::from_column_slice(value);
        }
    }
}

fn add(sums: &mut [f64], values: &[f64]) {
    sums.iter_mut().zip(values).for_each(|(sum, v)| *sum += v);
}
