//! The bulk that multigrid inverts: symmetric, scaled, stiffened by constraints.

use crate::{
    binding::{Cycle, Entry, Library, Matrix},
    coupling::Coupling,
    error::Error,
    foreign::{Foreign, exchange},
    nodes::{NONE, Nodes},
};
use std::sync::Arc;
use striae_condensed::{Partition, Tangent};
use striae_solve::team::Team;

/// Motions of a rigid body.
const MODES: usize = 6;

/// A part of the bulk, as it is scaled.
pub(crate) struct Bulk<'a> {
    pub(crate) partition: &'a Partition,
    pub(crate) nodes: &'a Nodes,
    pub(crate) tangent: &'a Tangent,
    /// Factors of unknowns and rows.
    pub(crate) scaling: &'a [f64],
    /// Unknowns whose rows have nothing but a diagonal.
    pub(crate) prescribed: &'a [bool],
}

impl Bulk<'_> {
    /// A cycle in the place of its inverse; `None` where it is not definite.
    pub(crate) fn inverse(
        &self,
        library: &Arc<Library>,
        team: &dyn Team,
        coupling: Option<&Coupling>,
    ) -> Result<Option<Cycle>, Error> {
        let nodes = self.nodes;
        let foreign = self.foreign(team);
        let row = |k: usize, entries: &mut Vec<Entry<9>>| {
            let (i, node) = (
                nodes.supervariables[k] as usize,
                (nodes.lay.first + k) as u32,
            );
            self.add_blocks(i, entries);
            if let Some(others) = foreign.get(&node) {
                entries.extend_from_slice(others);
            }
            if let Some(coupling) = coupling {
                coupling.add_stiffness(k, entries);
            }
            let mut diagonal = [0.0; 9];
            for (component, unknown) in self.partition.bulk_group(i).enumerate() {
                diagonal[4 * component] = f64::from(self.prescribed[unknown]);
            }
            entries.push((node, diagonal));
        };
        let matrix = Matrix::assembled(library, (nodes.lay, 3), row)?;
        drop(foreign);
        let kernel = self.near_kernel(team);
        Cycle::new(matrix, nodes.lay_of_unknowns(), &kernel)
    }

    /// What other ranks add to this rank's rows.
    fn foreign(&self, team: &dyn Team) -> Foreign<9> {
        let nodes = self.nodes;
        let rows = nodes.of.iter().enumerate();
        let rows = rows.filter(|&(_, &node)| node != NONE && !nodes.is_own(node));
        let rows = rows.map(|(i, &node)| {
            let mut entries = Vec::new();
            self.add_blocks(i, &mut entries);
            (node, entries)
        });
        exchange(team, &nodes.starts, rows)
    }

    /// Blocks of the symmetric part in the rows of a supervariable that are not zero.
    fn add_blocks(&self, i: usize, entries: &mut Vec<Entry<9>>) {
        let partition = self.partition;
        let values = self.tangent.bodies.values();
        for edge in partition.edges(i) {
            let j = partition.target(edge);
            let (other, mirror) = (self.nodes.of[j], partition.edge(j, i));
            let (true, Some(mirror)) = (other != NONE, mirror) else {
                continue;
            };
            let mut block = [0.0; 9];
            for (r, u) in partition.bulk_group(i).enumerate() {
                let row = partition.row(i, r).start + partition.column(edge);
                for (c, v) in partition.bulk_group(j).enumerate() {
                    let there = partition.row(j, c).start + partition.column(mirror) + r;
                    if !self.prescribed[u] && !self.prescribed[v] {
                        let scale = 0.5 * self.scaling[u] * self.scaling[v];
                        block[3 * r + c] = scale * (values[row + c] + values[there]);
                    }
                }
            }
            if block != [0.0; 9] {
                entries.push((other, block));
            }
        }
    }

    /// Motions of a rigid body in scaled unknowns of this rank's nodes, orthonormal.
    fn near_kernel(&self, team: &dyn Team) -> Vec<Vec<f64>> {
        let points = self.partition.points();
        let own = |i: u32| points.map_or([0.0; 3], |points| points[i as usize]);
        let mut ends = [f64::NEG_INFINITY; 6];
        for &i in &self.nodes.supervariables {
            for (k, x) in own(i).into_iter().enumerate() {
                ends[k] = ends[k].max(x);
                ends[k + 3] = ends[k + 3].max(-x);
            }
        }
        team.largest(&mut ends);
        let size = (0..3).map(|k| ends[k] + ends[k + 3]).fold(0.0, f64::max);
        let size = if size > 0.0 { size } else { 1.0 };
        let mut kernel = vec![Vec::with_capacity(3 * self.nodes.lay.own); MODES];
        for &i in &self.nodes.supervariables {
            let at = own(i);
            let [x, y, z] = [0, 1, 2].map(|k| (at[k] - 0.5 * (ends[k] - ends[k + 3])) / size);
            let rows = [
                [1.0, 0.0, 0.0, 0.0, z, -y],
                [0.0, 1.0, 0.0, -z, 0.0, x],
                [0.0, 0.0, 1.0, y, -x, 0.0],
            ];
            for (u, row) in self.partition.bulk_group(i as usize).zip(rows) {
                let scale = match self.prescribed[u] {
                    true => 0.0,
                    false => 1.0 / self.scaling[u],
                };
                for (mode, value) in kernel.iter_mut().zip(row) {
                    mode.push(scale * value);
                }
            }
        }
        orthonormalise(team, &mut kernel);
        kernel
    }
}

/// Makes vectors orthonormal, one after the other.
fn orthonormalise(team: &dyn Team, vectors: &mut [Vec<f64>]) {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    for k in 0..vectors.len() {
        let (before, own) = vectors.split_at_mut(k);
        let own = &mut own[0];
        let mut products: Vec<f64> = before.iter().map(|other| dot(other, own)).collect();
        team.sum(&mut products);
        for (other, product) in before.iter().zip(products) {
            own.iter_mut()
                .zip(other)
                .for_each(|(a, b)| *a -= product * b);
        }
        let mut square = [dot(own, own)];
        team.sum(&mut square);
        let size = square[0].sqrt();
        if size > 0.0 {
            own.iter_mut().for_each(|a| *a /= size);
        }
    }
}
