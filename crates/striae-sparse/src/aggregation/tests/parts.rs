//! A clamped block whose rows two threads hold: what they make together is what one makes.

use std::{
    ops::Range,
    sync::{Barrier, Mutex},
    thread,
};

use super::{super::others::Nobody, clamped, numbers};
use crate::aggregation::{Coarsening, MODES, NONE, Others, SharedLevel, blocks::Blocks};

const EDGE: usize = 7;
const AREA: usize = 3 * MODES;

/// A vector that both threads see.
struct Board {
    values: Mutex<Vec<f32>>,
    numbers: Mutex<[f64; 2]>,
    barrier: Barrier,
}

impl Board {
    fn new(size: usize) -> Self {
        Self {
            values: Mutex::new(vec![0.0; size]),
            numbers: Mutex::new([0.0; 2]),
            barrier: Barrier::new(2),
        }
    }

    /// The sum of a number of each thread.
    fn sum(&self, at: usize, own: f64) -> f64 {
        self.numbers.lock().unwrap()[at] = own;
        self.barrier.wait();
        let sum = self.numbers.lock().unwrap().iter().sum();
        self.barrier.wait();
        sum
    }

    /// Tells own values, and reads those of others after them.
    fn fetch(&self, size: usize, own: &Range<usize>, others: &[usize], x: &mut [f32]) {
        let (known, theirs) = x.split_at_mut(size * own.len());
        self.values.lock().unwrap()[size * own.start..size * own.end].copy_from_slice(known);
        self.barrier.wait();
        let values = self.values.lock().unwrap();
        for (block, &other) in theirs.chunks_exact_mut(size).zip(others) {
            block.copy_from_slice(&values[size * other..][..size]);
        }
        drop(values);
        self.barrier.wait();
    }

    /// Adds values of others to theirs.
    fn bring(&self, size: usize, own: &Range<usize>, others: &[usize], x: &mut [f32]) {
        let (known, theirs) = x.split_at_mut(size * own.len());
        self.values.lock().unwrap()[size * own.start..size * own.end].copy_from_slice(known);
        self.barrier.wait();
        let mut values = self.values.lock().unwrap();
        for (block, &other) in theirs.chunks_exact(size).zip(others) {
            let target = values[size * other..][..size].iter_mut();
            target.zip(block).for_each(|(t, v)| *t += v);
        }
        drop(values);
        self.barrier.wait();
        let own = size * own.start..size * own.end;
        known.copy_from_slice(&self.values.lock().unwrap()[own]);
        self.barrier.wait();
    }
}

/// Data that one thread holds, and its references to the other's.
struct Part<'a> {
    nodes: Range<usize>,
    other_nodes: Vec<usize>,
    aggregates: Range<usize>,
    other_aggregates: Vec<usize>,
    fine: &'a Board,
    coarse: &'a Board,
}

impl Others for &Part<'_> {
    fn fetch(&mut self, x: &mut [f32]) {
        self.fine.fetch(3, &self.nodes, &self.other_nodes, x);
    }

    fn fetch_coarse(&mut self, x: &mut [f32]) {
        let (own, others) = (&self.aggregates, &self.other_aggregates);
        self.coarse.fetch(MODES, own, others, x);
    }

    fn bring_coarse(&mut self, x: &mut [f32]) {
        let (own, others) = (&self.aggregates, &self.other_aggregates);
        self.coarse.bring(MODES, own, others, x);
    }
}

impl Part<'_> {
    /// Place of an aggregate in vectors of the next level.
    fn place(&self, aggregate: usize) -> usize {
        match self.aggregates.contains(&aggregate) {
            true => aggregate - self.aggregates.start,
            false => {
                let found = self.other_aggregates.binary_search(&aggregate);
                self.aggregates.len() + found.unwrap()
            }
        }
    }

    fn number(&self, place: usize) -> usize {
        let other = place.checked_sub(self.aggregates.len());
        other.map_or(self.aggregates.start + place, |at| {
            self.other_aggregates[at]
        })
    }
}

/// Rows of a matrix, with its columns by number in the part: own ones, then the others.
fn rows(matrix: &Blocks<3, 3, f64>, part: &Part<'_>) -> Blocks<3, 3, f64> {
    let (own, others) = (&part.nodes, &part.other_nodes);
    let place = |j: usize| match own.contains(&j) {
        true => j - own.start,
        false => own.len() + others.binary_search(&j).unwrap(),
    };
    Blocks::from_rows(own.len(), own.len() + others.len(), |i, sum| {
        for (j, block) in matrix.row(own.start + i) {
            sum.block(place(j)).copy_from_slice(block);
        }
    })
}

/// Both halves of a block of `EDGE` elements an edge, with what they are of.
struct Halves {
    matrix: Blocks<3, 3, f64>,
    kernel: Vec<f64>,
    /// Aggregate of every node over both halves, and the columns there.
    of: Vec<u32>,
    columns: Vec<f64>,
    /// Near-kernel of the next level.
    coarse: Vec<f64>,
    nodes: [Range<usize>; 2],
    aggregates: [Range<usize>; 2],
}

impl Halves {
    fn new() -> Self {
        let (matrix, kernel) = clamped(EDGE, 0.3);
        let half = matrix.rows() / 2;
        let nodes = [0..half, half..matrix.rows()];
        let mut halves = Self {
            of: Vec::new(),
            columns: Vec::new(),
            coarse: Vec::new(),
            aggregates: [0..0, 0..0],
            nodes: nodes.clone(),
            matrix,
            kernel,
        };
        let mut first = 0;
        for (at, own) in nodes.into_iter().enumerate() {
            // Columns of the other half come after the own ones.
            let place = |j: usize| match own.contains(&j) {
                true => j - own.start,
                false => own.len() + if j < own.start { j } else { j - own.end },
            };
            let near = Blocks::<3, 3, f64>::from_rows(own.len(), halves.matrix.rows(), |i, sum| {
                for (j, block) in halves.matrix.row(own.start + i) {
                    sum.block(place(j)).copy_from_slice(block);
                }
            });
            let kernel = &halves.kernel[AREA * own.start..AREA * own.end];
            let found = Coarsening::new(&near, kernel, 0, &vec![0; own.len()]);
            let numbers = found.aggregates.iter().map(|&a| match a {
                NONE => NONE,
                a => a + first,
            });
            halves.of.extend(numbers);
            halves.columns.extend(found.columns);
            halves.coarse.extend(found.near_kernel);
            halves.aggregates[at] = first as usize..first as usize + found.count;
            first += found.count as u32;
        }
        halves
    }

    fn aggregates(&self) -> usize {
        self.aggregates[1].end
    }

    fn part<'a>(&self, at: usize, fine: &'a Board, coarse: &'a Board) -> Part<'a> {
        let own = self.nodes[at].clone();
        let near = |others: &[usize]| -> Vec<usize> {
            let named = others.iter().flat_map(|&i| self.matrix.row(i));
            let mut named: Vec<usize> = named.map(|(j, _)| j).collect();
            named.sort_unstable();
            named.dedup();
            named
        };
        let reached = near(&own.clone().collect::<Vec<_>>());
        let mut other_nodes = reached.clone();
        other_nodes.retain(|j| !own.contains(j));
        // Interpolation at the nodes reached comes from the aggregates of what they reach.
        let named = near(&reached).into_iter().map(|j| self.of[j]);
        let mut named: Vec<usize> = named.filter(|&a| a != NONE).map(|a| a as usize).collect();
        named.sort_unstable();
        named.dedup();
        named.retain(|a| !self.aggregates[at].contains(a));
        Part {
            nodes: own,
            other_nodes,
            aggregates: self.aggregates[at].clone(),
            other_aggregates: named,
            fine,
            coarse,
        }
    }

    /// Level and interpolation of a half.
    fn level(&self, part: &Part<'_>) -> (SharedLevel<3>, Blocks<3, 3, f64>, Blocks<3, MODES, f64>) {
        let matrix = rows(&self.matrix, part);
        let count = part.nodes.len() + part.other_nodes.len();
        let sum = |own: f64| part.fine.sum(usize::from(part.nodes.start > 0), own);
        let level = SharedLevel::new(&matrix, count, (&mut &*part, &sum));
        let all = part.nodes.clone().chain(part.other_nodes.iter().copied());
        let all: Vec<usize> = all.collect();
        let of = all.iter().map(|&j| match self.of[j] {
            NONE => NONE,
            a => part.place(a as usize) as u32,
        });
        let columns = all.iter().flat_map(|&j| &self.columns[AREA * j..][..AREA]);
        let tentative = (of.collect(), columns.copied().collect());
        let coarse = part.aggregates.len() + part.other_aggregates.len();
        let interpolation = level.interpolation(&matrix, tentative, coarse);
        (level, matrix, interpolation)
    }
}

/// Both halves of something, made by two threads.
fn by_both<T: Send>(work: impl Fn(usize) -> T + Sync) -> [T; 2] {
    thread::scope(|scope| {
        let work = &work;
        let other = scope.spawn(move || work(1));
        [work(0), other.join().unwrap()]
    })
}

/// Rows of two halves by the numbers of all aggregates.
fn joined<const R: usize>(
    halves: &[(Blocks<R, MODES, f64>, Vec<usize>)],
    count: usize,
) -> Blocks<R, MODES, f64> {
    let rows: Vec<(usize, usize)> = halves
        .iter()
        .enumerate()
        .flat_map(|(at, (half, _))| (0..half.rows()).map(move |i| (at, i)))
        .collect();
    Blocks::from_rows(rows.len(), count, |k, sum| {
        let (half, numbers) = &halves[rows[k].0];
        for (place, values) in half.row(rows[k].1) {
            sum.block(numbers[place]).copy_from_slice(values);
        }
    })
}

#[test]
fn parts_interpolate_rigid_motions_and_project_like_the_whole() {
    let halves = Halves::new();
    let boards = [3 * halves.matrix.rows(), MODES * halves.aggregates()].map(Board::new);
    let parts = [0, 1].map(|at| halves.part(at, &boards[0], &boards[1]));
    let made = by_both(|at| halves.level(&parts[at]));
    let numbers = |at: usize| {
        let part = &parts[at];
        let count = part.aggregates.len() + part.other_aggregates.len();
        (0..count).map(|place| part.number(place)).collect()
    };
    let count = halves.aggregates();
    let own = [0, 1].map(|at| (made[at].2.clone(), numbers(at)));
    let whole = joined(&own, count);
    // But for the held nodes and those next to them, rows take rigid motions to zero.
    let layer = (EDGE + 1) * (EDGE + 1);
    for i in 2 * layer..whole.rows() {
        for row in 0..3 {
            for mode in 0..MODES {
                let terms = whole.row(i).flat_map(|(k, p)| {
                    let coarse = &halves.coarse[k * MODES * MODES..];
                    (0..MODES).map(move |m| p[row * MODES + m] * coarse[m * MODES + mode])
                });
                let expected = halves.kernel[AREA * i + row * MODES + mode];
                assert!((terms.sum::<f64>() - expected).abs() < 1e-12, "node {i}");
            }
        }
    }
    let [mut first, second] = made;
    let mut sums = vec![0.0; count * count * MODES * MODES];
    let mut add = |at: usize, level: &mut SharedLevel<3>, matrix, own: Blocks<3, MODES, f64>| {
        let theirs = parts[at].other_nodes.iter();
        let theirs: Vec<usize> = theirs.copied().collect();
        let width = parts[at].aggregates.len() + parts[at].other_aggregates.len();
        let theirs = Blocks::from_rows(theirs.len(), width, |k, sum| {
            for (aggregate, values) in whole.row(theirs[k]) {
                sum.block(parts[at].place(aggregate))
                    .copy_from_slice(values);
            }
        });
        let product = level.coarsen(matrix, (own, &theirs), width);
        for i in 0..product.rows() {
            for (j, block) in product.row(i) {
                let [i, j] = [i, j].map(|place| parts[at].number(place));
                let target = &mut sums[(i * count + j) * MODES * MODES..][..MODES * MODES];
                target.iter_mut().zip(block).for_each(|(t, v)| *t += v);
            }
        }
    };
    add(0, &mut first.0, first.1, first.2);
    let mut second = second;
    add(1, &mut second.0, second.1, second.2);
    let alone = (&mut Nobody as &mut dyn Others, &(|own| own) as _);
    let mut level = SharedLevel::new(&halves.matrix, halves.matrix.rows(), alone);
    let none = Blocks::default();
    let expected = level.coarsen(halves.matrix.clone(), (whole, &none), count);
    let mut seen = vec![0.0; sums.len()];
    for i in 0..count {
        for (j, block) in expected.row(i) {
            seen[(i * count + j) * MODES * MODES..][..MODES * MODES].copy_from_slice(block);
        }
    }
    let size = seen.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
    let differences = sums.iter().zip(&seen).map(|(a, b)| (a - b).abs());
    assert!(differences.fold(0.0, f64::max) < 1e-13 * size);
}

#[test]
fn the_cycle_of_parts_is_symmetric() {
    let halves = Halves::new();
    let unknowns = 3 * halves.matrix.rows();
    let boards = [unknowns, MODES * halves.aggregates()].map(Board::new);
    let parts = [0, 1].map(|at| halves.part(at, &boards[0], &boards[1]));
    let vectors = [numbers(unknowns, 1), numbers(unknowns, 2)];
    let images = by_both(|at| {
        let part = &parts[at];
        let (mut level, matrix, own) = halves.level(part);
        let width = part.aggregates.len() + part.other_aggregates.len();
        // The next level is not looked at here.
        let none = Blocks::from_rows(part.other_nodes.len(), width, |_, _| {});
        let _ = level.coarsen(matrix, (own, &none), width);
        vectors.each_ref().map(|v| {
            let own = 3 * part.nodes.start..3 * part.nodes.end;
            let b: Vec<f32> = v[own].iter().map(|&v| v as f32).collect();
            let mut x = vec![0.0; b.len() + 3 * part.other_nodes.len()];
            let mut coarser = |b: &[f32], x: &mut [f32]| {
                x.iter_mut().zip(b).for_each(|(x, b)| *x = 0.2 * b);
            };
            level.cycle(&b, &mut x, &mut &*part, &mut coarser);
            x.truncate(b.len());
            x
        })
    });
    let product = |of: usize, with: usize| -> f64 {
        let image = images[0][of].iter().chain(&images[1][of]);
        let terms = image.zip(&vectors[with]);
        terms.map(|(&x, v)| f64::from(x) * v).sum()
    };
    let (one, other) = (product(0, 1), product(1, 0));
    let size = (product(0, 0) * product(1, 1)).sqrt();
    assert!(size > 0.0);
    assert!((one - other).abs() < 1e-6 * size, "{one} {other} {size}");
}
