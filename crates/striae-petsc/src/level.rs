//! A level of the cycle on the bodies, with aggregates of its own.
//!
//! Aggregates do not extend across contact: bodies that slide on each other keep their own motions.
//! PETSc's aggregation would not respect that, as couplings of constraints are as strong as those
//! of elements. Aggregates do not reach over ranks either. When few unknowns are left the coarser
//! levels are PETSc's.

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
use striae_sparse::aggregation::{
    COARSEST, Coarsening, MODES, NONE, Others, SLOW, SharedLevel, blocks::Blocks,
};

/// Values of a block of the next level.
const COARSE: usize = MODES * MODES;

/// The finest level: three unknowns a node.
pub(crate) type Finest = Level<3, 9, { 3 * MODES }>;

/// A matrix of `N` unknowns a node with a cycle as a substitute for its inverse. Blocks have `AREA`
/// values, `N` by `N`, and those of the interpolation `WIDE`, `N` by [`MODES`].
#[derive(Debug)]
pub(crate) struct Level<const N: usize, const AREA: usize, const WIDE: usize> {
    level: SharedLevel<N>,
    nodes: Halo,
    aggregates: Halo,
    coarser: Coarser,
    /// Vector with others' places.
    x: Vec<f32>,
}

/// Substitute for the inverse of the next level.
#[derive(Debug)]
enum Coarser {
    Level(Box<Level<MODES, COARSE, COARSE>>),
    /// With vectors of own unknowns.
    Cycle(Box<Cycle>, [Vec<f64>; 2]),
}

/// Lists what is in one of this rank's rows, in any order, where blocks of one column add up.
type Row<'a, const AREA: usize> = &'a (dyn Fn(usize, &mut Vec<Entry<AREA>>) + Sync);

/// Layout of the rows of a level.
#[derive(Clone, Copy)]
pub(crate) struct Problem<'a> {
    pub(crate) library: &'a Arc<Library>,
    pub(crate) team: &'a dyn Team,
    pub(crate) side: Side,
    /// Number of finer levels.
    pub(crate) depth: usize,
}

/// Data of own nodes: the near-kernel, with as many rows as a node has unknowns and six columns,
/// and the connected part of each node.
#[derive(Clone, Copy)]
pub(crate) struct Kernel<'a> {
    pub(crate) motions: &'a [f64],
    pub(crate) parts: &'a [u32],
}

/// The ranks that hold the other rows, of the next level where there is one.
struct Neighbours<'a> {
    nodes: &'a mut Halo,
    aggregates: Option<&'a mut Halo>,
    /// The first that went wrong.
    failure: Result<(), Error>,
}

/// Interpolation to own nodes and to others' that own rows name, by places of aggregates.
struct Interpolation<const N: usize> {
    own: Blocks<N, MODES, f64>,
    theirs: Blocks<N, MODES, f64>,
    aggregates: Halo,
}

impl<const N: usize, const AREA: usize, const WIDE: usize> Level<N, AREA, WIDE> {
    /// From what is known of own nodes, and the rows of a matrix; `None` where it is not
    /// definite. Collective.
    pub(crate) fn new(
        problem: Problem<'_>,
        kernel: Kernel<'_>,
        row: Row<'_, AREA>,
    ) -> Result<Option<Self>, Error> {
        let (mut nodes, matrix) = problem.rows::<N, AREA>(row)?;
        let coarsening = Coarsening::new(&matrix, kernel.motions, problem.depth, kernel.parts);
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
        let places = neighbours.nodes.blocks();
        let mut level = SharedLevel::new(&matrix, places, (&mut neighbours, &sum));
        neighbours.failure?;
        let coarse = problem.coarse(coarsening.count);
        let interpolation = problem.interpolation::<N, WIDE>(
            (&level, &matrix),
            &nodes,
            (&coarsening, coarse.side),
        )?;
        let Interpolation {
            own,
            theirs,
            aggregates,
        } = interpolation;
        let product = level.coarsen(matrix, (own, &theirs), aggregates.blocks());
        drop(theirs);
        let coarser = coarse.solved(&product, &aggregates, &coarsening, problem.side)?;
        Ok(coarser.map(|coarser| Self {
            level,
            x: vec![0.0; N * nodes.blocks()],
            nodes,
            aggregates,
            coarser,
        }))
    }

    /// Own unknowns.
    fn own(&self) -> usize {
        self.nodes.own()
    }

    /// `x = M^-1 b` for own unknowns: smoothing, a correction by the coarser levels,
    /// smoothing.
    pub(crate) fn apply(&mut self, b: &[f32], x: &mut [f32]) -> Result<(), Error> {
        let Self {
            nodes, aggregates, ..
        } = self;
        let mut neighbours = Neighbours {
            nodes,
            aggregates: Some(aggregates),
            failure: Ok(()),
        };
        let mut failure = Ok(());
        let mut coarser = |b: &[f32], x: &mut [f32]| {
            keep_first(&mut failure, self.coarser.apply(b, x));
        };
        self.level
            .cycle(b, &mut self.x, &mut neighbours, &mut coarser);
        neighbours.failure.and(failure)?;
        x.copy_from_slice(&self.x[..x.len()]);
        Ok(())
    }
}

impl Coarser {
    /// Applies the level to vectors with others' places after the own ones.
    fn apply(&mut self, b: &[f32], x: &mut [f32]) -> Result<(), Error> {
        match self {
            Self::Level(level) => {
                let own = level.own();
                level.apply(&b[..own], &mut x[..own])
            }
            Self::Cycle(cycle, [restricted, correction]) => {
                widen(b, restricted);
                cycle.apply(restricted, correction)?;
                narrow(correction, x);
                Ok(())
            }
        }
    }
}

impl Problem<'_> {
    /// Rows of this rank, and the nodes of others that they refer to.
    fn rows<const N: usize, const AREA: usize>(
        &self,
        row: Row<'_, AREA>,
    ) -> Result<(Halo, Blocks<N, N, f64>), Error> {
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

    /// The next level, of whose aggregates this rank has so many.
    fn coarse(&self, count: usize) -> Self {
        let starts = starts(self.team, count);
        let side = Side {
            blocks: Lay {
                first: starts[self.team.rank()],
                own: count,
                total: starts[self.team.size()],
            },
            size: MODES,
        };
        Self {
            side,
            depth: self.depth + 1,
            ..*self
        }
    }

    fn interpolation<const N: usize, const WIDE: usize>(
        &self,
        (level, matrix): (&SharedLevel<N>, &Blocks<N, N, f64>),
        nodes: &Halo,
        (coarsening, coarse): (&Coarsening, Side),
    ) -> Result<Interpolation<N>, Error> {
        let starts = starts(self.team, self.side.blocks.own);
        let first = coarse.blocks.first as u32;
        let tentative = fetch(self.team, &starts, nodes.others(), |k| {
            let values = coarsening.columns[k * WIDE..].first_chunk::<WIDE>();
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
            columns.extend(entry.map_or([0.0; WIDE], |entry| entry.1));
        }
        let own = level.interpolation(matrix, (of, columns), near.blocks());
        let theirs = fetch(self.team, &starts, nodes.others(), |k| {
            let entries = own.row(k).map(|(place, values)| {
                let mut copy = [0.0; WIDE];
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

    /// Substitute for the inverse of this level, from the contributions of all ranks to its matrix;
    /// `None` if that is not definite.
    fn solved(
        &self,
        part: &Blocks<MODES, MODES, f64>,
        aggregates: &Halo,
        coarsening: &Coarsening,
        finer: Side,
    ) -> Result<Option<Coarser>, Error> {
        let own = self.side.blocks.own;
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
        let mut ones = vec![[0.0; COARSE]; own];
        for unknown in coarsening.empty() {
            ones[unknown / MODES][unknown % MODES * (MODES + 1)] = 1.0;
        }
        let row = |k: usize, sum: &mut Vec<Entry<COARSE>>| {
            sum.extend(entries(k));
            let number = (self.side.blocks.first + k) as u32;
            sum.extend(foreign.get(&number).into_iter().flatten());
            sum.push((number, ones[k]));
        };
        let kernel = Kernel {
            motions: &coarsening.near_kernel,
            parts: &coarsening.parts,
        };
        let total = self.side.blocks.total;
        if MODES * total > COARSEST && (total as f64) < SLOW * finer.blocks.total as f64 {
            let level = Level::new(*self, kernel, &row)?;
            return Ok(level.map(|level| Coarser::Level(Box::new(level))));
        }
        let matrix = Matrix::assembled(self.library, (self.side, self.side), row)?;
        let unknowns = vec![0.0; self.side.unknowns().own];
        let cycle = Cycle::new(matrix, &coarse_kernel(self.team, coarsening))?;
        Ok(cycle.map(|cycle| Coarser::Cycle(Box::new(cycle), [unknowns.clone(), unknowns])))
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
