//! The equilibrated system, seen by nodes.

use super::{NONE, Nodes};
use crate::tangent::Tangent;
use striae_sparse::{Equilibration, aggregation::MODES};

/// A matrix with its scaling.
pub(super) struct Scaled<'a> {
    pub(super) nodes: &'a Nodes,
    pub(super) tangent: &'a Tangent,
    pub(super) scaling: &'a Equilibration,
    pub(super) prescribed: &'a [bool],
}

impl Scaled<'_> {
    /// Scaled entries of a row, but those of prescribed unknowns.
    pub(super) fn row(&self, u: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let scale = self.scaling.rows[u];
        let entries = self.tangent.row(u).filter(|&(v, _)| !self.prescribed[v]);
        entries.map(move |(v, a)| (v, scale * a * self.scaling.columns[v]))
    }

    /// Node and component of a bulk unknown, [`NONE`] for a multiplier.
    pub(super) fn node(&self, u: usize) -> (u32, usize) {
        let structure = &self.nodes.partition;
        let i = structure.owner(u).0;
        let component = u - structure.group(i).start;
        if component < structure.bulk_group(i).len() {
            (self.nodes.of[i], component)
        } else {
            (NONE, 0)
        }
    }

    /// Symmetric part of a row of the bulk, in blocks that add up, with what contact adds between
    /// positions: the bedding of supports that are not closed is as stiff as the bulk.
    pub(super) fn bulk_row(&self, node: usize, mut add: impl FnMut(usize, &[f64; 9])) {
        let structure = &self.nodes.partition;
        let i = self.nodes.supervariables[node] as usize;
        let values = self.tangent.bodies.values();
        for edge in structure.edges(i).filter(|&e| structure.is_bulk_edge(e)) {
            let j = structure.target(edge);
            let (other, mirror) = (self.nodes.of[j], structure.edge(j, i));
            let (true, Some(mirror)) = (other != NONE, mirror) else {
                continue;
            };
            let mut block = [0.0; 9];
            for (r, u) in structure.bulk_group(i).enumerate() {
                let row = structure.row(i, r).start + structure.column(edge);
                for (c, v) in structure.bulk_group(j).enumerate() {
                    let there = structure.row(j, c).start + structure.column(mirror) + r;
                    let scale = self.scaling.rows[u] * self.scaling.columns[v];
                    block[3 * r + c] = if !self.prescribed[u] && !self.prescribed[v] {
                        0.5 * scale * (values[row + c] + values[there])
                    } else {
                        f64::from(u == v)
                    };
                }
            }
            add(other as usize, &block);
        }
        let contact = &self.tangent.contact;
        for (r, u) in structure.bulk_group(i).enumerate() {
            for (v, a) in contact.row(u) {
                let (other, c) = self.node(v);
                if other != NONE && !self.prescribed[u] && !self.prescribed[v] {
                    let scale = self.scaling.rows[u] * self.scaling.columns[v];
                    let mut block = [0.0; 9];
                    block[3 * r + c] = 0.5 * scale * (a + contact.get(v, u));
                    add(other as usize, &block);
                }
            }
        }
    }

    /// Motions of a rigid body in scaled unknowns, 3 rows by six a node.
    pub(super) fn near_kernel(&self) -> Vec<f64> {
        let structure = &self.nodes.partition;
        let points = structure.points();
        let own = |i: u32| points.map_or([0.0; 3], |points| points[i as usize]);
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &i in &self.nodes.supervariables {
            for (k, x) in own(i).into_iter().enumerate() {
                (low[k], high[k]) = (low[k].min(x), high[k].max(x));
            }
        }
        let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let mut kernel = Vec::with_capacity(3 * MODES * self.nodes.supervariables.len());
        for &i in &self.nodes.supervariables {
            let at = own(i);
            let [x, y, z] = [0, 1, 2].map(|k| (at[k] - 0.5 * (low[k] + high[k])) / size);
            let rows = [
                [1.0, 0.0, 0.0, 0.0, z, -y],
                [0.0, 1.0, 0.0, -z, 0.0, x],
                [0.0, 0.0, 1.0, y, -x, 0.0],
            ];
            for (u, row) in structure.bulk_group(i as usize).zip(rows) {
                let scale = if self.prescribed[u] {
                    0.0
                } else {
                    1.0 / self.scaling.columns[u]
                };
                kernel.extend(row.map(|value| scale * value));
            }
        }
        kernel
    }
}
