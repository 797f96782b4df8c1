//! The finest level of the cycle on the bodies, with aggregates of its own.
//!
//! They do not reach over contact: bodies that slide on each other keep motions of their
//! own. PETSc's aggregation would not know that, as what constraints couple is as strong as
//! elements are. Aggregates do not reach over ranks either. The coarser levels are PETSc's.

use crate::{
    binding::{Cycle, Entry, Lay, Library, Matrix, Side},
    error::Error,
    foreign::{exchange, fetch, starts},
    halo::{Halo, narrow, widen},
    product::orthonormalise,
};
use rayon::prelude::*;
use std::sync::Arc;
use striae_solve::team::Team;
use striae_sparse::aggregation::{self, Coarsening, MODES, NONE, Others, blocks::Blocks};

/// Values of an interpolation from an aggregate to a node.
const AREA: usize = 3 * MODES;
/// Values of a block of the next level.
const COARSE: usize = MODES * MODES;

/// A matrix of three unknowns a node with a cycle in the place of its inverse.
#[derive(Debug)]
pub(crate) struct Finest {
    level: aggregation::Finest,
    nodes: Halo,
    aggregates: Halo,
    coarser: Cycle,
    /// Vectors of this level and of the next.
    b: Vec<f32>,
    x: Vec<f32>,
    restricted: Vec<f64>,
    correction: Vec<f64>,
}

/// Where the rows of a level lie.
pub(crate) struct Problem<'a> {
    pub(crate) library: &'a Arc<Library>,
    pub(crate) team: &'a dyn Team,
    pub(crate) side: Side,
}

/// The ranks that hold the other rows, of the next level where there is one.
struct Neighbours<'a> {
    nodes: &'a mut Halo,
    aggregates: Option<&'a mut Halo>,
    /// The first that went wrong.
    failure: Result<(), Error>,
}

/// Interpolation to own nodes and to others' that own rows name, by places of aggregates.
struct Interpolation {
    own: Blocks<3, MODES, f64>,
    theirs: Blocks<3, MODES, f64>,
    aggregates: Halo,
}

impl Finest {
    /// From what the bodies couple on this rank, the near-kernel, column by column, and the
    /// rows of this rank's nodes, where blocks of one column add up; `None` where the matrix is
    /// not definite. Collective.
    pub(crate) fn new(
        problem: &Problem<'_>,
        (near, kernel): (Blocks<3, 3, f64>, &[Vec<f64>]),
        row: impl Fn(usize, &mut Vec<Entry<9>>) + Sync,
    ) -> Result<Option<Self>, Error> {
        let own = problem.side.blocks.own;
        let by_node = (0..3 * own).flat_map(|k| kernel.iter().map(move |mode| mode[k]));
        let coarsening = Coarsening::new(&near, &by_node.collect::<Vec<f64>>());
        drop(near);
        let (mut nodes, matrix) = problem.rows(row)?;
        let sum = |own: f64| {
            let mut sum = [own];
            problem.team.sum(&mut sum);
            sum[0]
        };
        let mut neighbours = Neighbours {
            nodes: &mut nodes,
            aggregates: None,
            failure: Ok(()),
        };
        let mut level =
            aggregation::Finest::new(&matrix, neighbours.nodes.blocks(), (&mut neighbours, &sum));
        neighbours.failure?;
        let coarse = problem.coarse(coarsening.count);
        let interpolation =
            problem.interpolation((&level, &matrix), &nodes, (&coarsening, coarse))?;
        let Interpolation {
            own: interpolated,
            theirs,
            aggregates,
        } = interpolation;
        let product = level.coarsen(matrix, (interpolated, &theirs), aggregates.blocks());
        drop(theirs);
        let product = problem.summed(product, (&aggregates, coarse), &coarsening)?;
        let kernel = coarse_kernel(problem.team, &coarsening);
        let unknowns = coarse.unknowns().own;
        Ok(Cycle::new(product, &kernel)?.map(|coarser| Self {
            level,
            b: vec![0.0; 3 * own],
            x: vec![0.0; 3 * nodes.blocks()],
            nodes,
            aggregates,
            coarser,
            restricted: vec![0.0; unknowns],
            correction: vec![0.0; unknowns],
        }))
    }

    /// `x = M^-1 b`: smoothing, a correction by the coarser levels, smoothing.
    pub(crate) fn apply(&mut self, b: &[f64], x: &mut [f64]) -> Result<(), Error> {
        let Self {
            nodes, aggregates, ..
        } = self;
        narrow(b, &mut self.b);
        let mut neighbours = Neighbours {
            nodes,
            aggregates: Some(aggregates),
            failure: Ok(()),
        };
        let mut failure = Ok(());
        let mut coarser = |b: &[f32], x: &mut [f32]| {
            widen(b, &mut self.restricted);
            let applied = self.coarser.apply(&self.restricted, &mut self.correction);
            keep_first(&mut failure, applied);
            narrow(&self.correction, x);
        };
        self.level
            .cycle(&self.b, &mut self.x, &mut neighbours, &mut coarser);
        neighbours.failure.and(failure)?;
        widen(&self.x[..b.len()], x);
        Ok(())
    }
}

impl Problem<'_> {
    /// This rank's rows, and the nodes of others that they name.
    fn rows(
        &self,
        row: impl Fn(usize, &mut Vec<Entry<9>>) + Sync,
    ) -> Result<(Halo, Blocks<3, 3, f64>), Error> {
        let side = self.side;
        let own = side.blocks.own;
        let named: Vec<Vec<u32>> = (0..own)
            .into_par_iter()
            .with_min_len(256)
            .map_init(Vec::new, |entries, k| {
                entries.clear();
                row(k, entries);
                let others = entries.iter().map(|entry| entry.0);
                others.filter(|&node| !side.contains(node)).collect()
            })
            .collect();
        let nodes = Halo::new(self.library, side, named.into_iter().flatten())?;
        let rows = Blocks::from_rows(own, nodes.blocks(), |k, sum| {
            let mut entries = Vec::with_capacity(64);
            row(k, &mut entries);
            for (node, block) in &entries {
                let target = sum.block(nodes.place(*node)).iter_mut();
                target.zip(block).for_each(|(t, b)| *t += b);
            }
        });
        Ok((nodes, rows))
    }

    /// Aggregates of all ranks, of which this one has so many.
    fn coarse(&self, count: usize) -> Side {
        let starts = starts(self.team, count);
        Side {
            blocks: Lay {
                first: starts[self.team.rank()],
                own: count,
                total: starts[self.team.size()],
            },
            size: MODES,
        }
    }

    fn interpolation(
        &self,
        (level, matrix): (&aggregation::Finest, &Blocks<3, 3, f64>),
        nodes: &Halo,
        (coarsening, coarse): (&Coarsening, Side),
    ) -> Result<Interpolation, Error> {
        let starts = starts(self.team, self.side.blocks.own);
        let first = coarse.blocks.first as u32;
        let tentative = fetch(self.team, &starts, nodes.others(), |k| {
            let values = coarsening.columns[k * AREA..].first_chunk::<AREA>();
            let is_in = coarsening.aggregates[k] != NONE;
            let value = values.filter(|_| is_in);
            let entries = value.map(|values| (first + coarsening.aggregates[k], *values));
            entries.into_iter().collect()
        });
        let named = tentative.values().flatten().map(|entry| entry.0);
        let near = Halo::new(self.library, coarse, named)?;
        let (mut of, mut columns) = (coarsening.aggregates.clone(), coarsening.columns.clone());
        for node in nodes.others() {
            let entry = tentative.get(node).and_then(|entries| entries.first());
            of.push(entry.map_or(NONE, |entry| near.place(entry.0) as u32));
            columns.extend(entry.map_or([0.0; AREA], |entry| entry.1));
        }
        let own = level.interpolation(matrix, (of, columns), near.blocks());
        let theirs = fetch(self.team, &starts, nodes.others(), |k| {
            let entries = own.row(k).map(|(place, values)| {
                let mut copy = [0.0; AREA];
                copy.copy_from_slice(values);
                (near.number(place), copy)
            });
            entries.collect()
        });
        let named = theirs.values().flatten().map(|entry| entry.0);
        let named = named.chain(near.others().iter().copied());
        let aggregates = Halo::new(self.library, coarse, named)?;
        let count = aggregates.blocks();
        let own = Blocks::from_rows(own.rows(), count, |k, sum| {
            for (place, values) in own.row(k) {
                let place = aggregates.place(near.number(place));
                sum.block(place).copy_from_slice(values);
            }
        });
        let others = nodes.others();
        let theirs = Blocks::from_rows(others.len(), count, |k, sum| {
            for (aggregate, values) in theirs.get(&others[k]).into_iter().flatten() {
                let place = aggregates.place(*aggregate);
                sum.block(place).copy_from_slice(values);
            }
        });
        Ok(Interpolation {
            own,
            theirs,
            aggregates,
        })
    }

    /// The matrix of the next level from what all ranks add to it.
    fn summed(
        &self,
        part: Blocks<MODES, MODES, f64>,
        (aggregates, coarse): (&Halo, Side),
        coarsening: &Coarsening,
    ) -> Result<Matrix, Error> {
        let own = coarse.blocks.own;
        let entries = |place: usize| -> Vec<Entry<COARSE>> {
            let row = part.row(place).map(|(other, values)| {
                let mut copy = [0.0; COARSE];
                copy.copy_from_slice(values);
                (aggregates.number(other), copy)
            });
            row.collect()
        };
        let starts = starts(self.team, own);
        let others = own..aggregates.blocks();
        let others = others.map(|place| (aggregates.number(place), entries(place)));
        let foreign = exchange(self.team, &starts, others);
        let row = |k: usize, sum: &mut Vec<Entry<COARSE>>| {
            sum.extend(entries(k));
            let number = (coarse.blocks.first + k) as u32;
            sum.extend(foreign.get(&number).into_iter().flatten());
        };
        let mut matrix = Matrix::assembled(self.library, (coarse, coarse), row)?;
        let first = coarse.unknowns().first;
        matrix.set_ones(coarsening.empty().map(|unknown| first + unknown))?;
        Ok(matrix)
    }
}

impl Neighbours<'_> {
    fn keep(&mut self, done: Result<(), Error>) {
        keep_first(&mut self.failure, done);
    }
}

impl Others for Neighbours<'_> {
    fn fetch(&mut self, x: &mut [f32]) {
        let done = self.nodes.fetch(x);
        self.keep(done);
    }

    fn fetch_coarse(&mut self, x: &mut [f32]) {
        if let Some(aggregates) = &mut self.aggregates {
            let done = aggregates.fetch(x);
            self.keep(done);
        }
    }

    fn bring_coarse(&mut self, x: &mut [f32]) {
        if let Some(aggregates) = &mut self.aggregates {
            let done = aggregates.bring(x);
            self.keep(done);
        }
    }
}

/// Orthonormal near-kernel of the next level, column by column.
fn coarse_kernel(team: &dyn Team, coarsening: &Coarsening) -> Vec<Vec<f64>> {
    let mut kernel: Vec<Vec<f64>> = (0..MODES)
        .map(|mode| {
            let rows = coarsening.near_kernel.chunks_exact(MODES);
            rows.map(|row| row[mode]).collect()
        })
        .collect();
    orthonormalise(team, &mut kernel);
    kernel
}

/// Keeps what went wrong first.
fn keep_first(failure: &mut Result<(), Error>, done: Result<(), Error>) {
    if failure.is_ok() {
        *failure = done;
    }
}
