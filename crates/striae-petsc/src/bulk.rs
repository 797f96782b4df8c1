//! The bulk that multigrid inverts: symmetric, scaled, stiffened by constraints.

use crate::{
    binding::{Cycle, Entry, Library, Matrix, Side},
    coupling::Coupling,
    error::Error,
    foreign::{Foreign, exchange},
    halo::{narrow, widen},
    level::{Finest, Kernel, Problem},
    nodes::{NONE, Nodes},
    product::orthonormalise,
};
use std::sync::Arc;
use striae_condensed::{Partition, Tangent};
use striae_solve::team::Team;
use striae_sparse::aggregation::MODES;

/// A scaled part of the bulk.
pub(crate) struct Bulk<'a> {
    pub(crate) partition: &'a Partition,
    pub(crate) nodes: &'a Nodes,
    pub(crate) tangent: &'a Tangent,
    /// Factors of unknowns and rows.
    pub(crate) scaling: &'a [f64],
    /// Unknowns whose rows have nothing but a diagonal.
    pub(crate) prescribed: &'a [bool],
}

/// Substitute for the inverse.
#[derive(Debug)]
pub(crate) enum Inverse {
    /// Preconditioner selected by options.
    Chosen(Cycle),
    /// Own aggregates, with vectors of own unknowns.
    Usual(Box<Finest>, [Vec<f32>; 2]),
}

impl Inverse {
    /// `x = M^-1 b`.
    pub(crate) fn apply(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), Error> {
        match self {
            Self::Chosen(cycle) => cycle.apply(b, x),
            Self::Usual(finest, [right, left]) => {
                narrow(b, right);
                finest.apply(right, left)?;
                widen(left, x);
                Ok(())
            }
        }
    }
}

/// Rows of this rank's nodes.
struct Rows<'a> {
    bulk: &'a Bulk<'a>,
    foreign: Foreign<9>,
    coupling: Option<&'a Coupling>,
}

impl Rows<'_> {
    /// Entries of the bodies in the row of an own node, with the stiffness of constraints.
    fn add(&self, k: usize, entries: &mut Vec<Entry<9>>) {
        let Bulk {
            nodes, partition, ..
        } = *self.bulk;
        let (i, node) = (nodes.supervariables[k] as usize, self.node(k));
        self.bulk.add_blocks(i, entries);
        if let Some(others) = self.foreign.get(&node) {
            entries.extend_from_slice(others);
        }
        let mut diagonal = [0.0; 9];
        for (component, unknown) in partition.bulk_group(i).enumerate() {
            diagonal[4 * component] = f64::from(self.bulk.prescribed[unknown]);
        }
        entries.push((node, diagonal));
        if let Some(coupling) = self.coupling {
            coupling.add_stiffness(k, entries);
        }
    }

    /// Number of an own node.
    fn node(&self, k: usize) -> u32 {
        (self.bulk.nodes.lay.first + k) as u32
    }
}

impl Bulk<'_> {
    /// Substitute for the inverse; `None` if the matrix is not definite.
    pub(crate) fn inverse(
        &self,
        library: &Arc<Library>,
        team: &dyn Team,
        coupling: Option<&Coupling>,
    ) -> Result<Option<Inverse>, Error> {
        let rows = Rows {
            bulk: self,
            foreign: self.foreign(team),
            coupling,
        };
        let side = Side {
            blocks: self.nodes.lay,
            size: 3,
        };
        let row = |k: usize, entries: &mut Vec<Entry<9>>| rows.add(k, entries);
        let mut kernel = self.near_kernel(team);
        if Cycle::is_chosen(library)? {
            let matrix = Matrix::assembled(library, (side, side), row)?;
            orthonormalise(team, &mut kernel);
            return Ok(Cycle::new(matrix, &kernel)?.map(Inverse::Chosen));
        }
        let own = side.blocks.own;
        let motions = (0..3 * own).flat_map(|k| kernel.iter().map(move |mode| mode[k]));
        let motions: Vec<f64> = motions.collect();
        let kernel = Kernel {
            motions: &motions,
            parts: &self.parts(),
        };
        let problem = Problem {
            library,
            team,
            side,
            depth: 0,
        };
        let finest = Finest::new(problem, kernel, &row)?;
        let unknowns = vec![0.0; side.unknowns().own];
        let vectors = [unknowns.clone(), unknowns];
        Ok(finest.map(|finest| Inverse::Usual(Box::new(finest), vectors)))
    }

    /// Connected part of this rank's elements that each own node is of.
    fn parts(&self) -> Vec<u32> {
        let mut of = vec![NONE; self.partition.supervariables()];
        for (part, members) in (0..).zip(self.partition.bodies()) {
            members.into_iter().for_each(|i| of[i as usize] = part);
        }
        let own = self.nodes.supervariables.iter();
        own.map(|&i| of[i as usize]).collect()
    }

    /// Contributions of other ranks to this rank's rows.
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

    /// Motions of a rigid body in scaled unknowns of this rank's nodes.
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
        let mut kernel = vec![Vec::new(); MODES];
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
        kernel
    }
}
