//! Assembly and elimination of one front of the multifrontal LU.

use crate::{
    dense::{self, Leftover},
    equilibration::Equilibration,
    matrix::SparseMatrix,
    numeric::{Child, Contribution, Kernel},
    tree::{AssemblyTree, ELSEWHERE, Front},
};

/// Factors of one front.
///
/// `rows` and `columns` name the unknowns of the front after pivoting: first
/// the `pivots` eliminated ones, then up to `summed` the delayed ones, then
/// the border. Values are `size x summed` (with `L` and `U` of the pivots)
/// followed by `summed x rest`, column-major.
#[derive(Clone, Debug, Default)]
pub(crate) struct FrontFactor {
    pub(crate) rows: Vec<u32>,
    pub(crate) columns: Vec<u32>,
    pub(crate) summed: usize,
    pub(crate) pivots: usize,
    pub(crate) replaced: usize,
    pub(crate) smallest: f64,
    /// Values, where delayed pivots made the front larger than planned.
    pub(crate) enlarged: Vec<f64>,
}

/// Data shared by all fronts of a factorisation.
#[derive(Clone, Copy)]
pub(crate) struct System<'a> {
    pub(crate) tree: &'a AssemblyTree,
    pub(crate) matrix: &'a SparseMatrix,
    pub(crate) scaling: &'a Equilibration,
}

impl FrontFactor {
    /// Unknowns of the front.
    pub(crate) fn size(&self) -> usize {
        self.rows.len()
    }

    /// Pivots left to the parent.
    pub(crate) fn delayed(&self) -> usize {
        self.summed - self.pivots
    }

    /// Entries of both factors.
    pub(crate) fn entries(&self) -> usize {
        self.summed * (2 * self.size() - self.summed)
    }

    /// Fully summed columns and the rows above the contribution.
    pub(crate) fn values<'a>(&'a self, planned: &'a [f64]) -> (&'a [f64], &'a [f64]) {
        let values = if self.enlarged.is_empty() {
            planned
        } else {
            &self.enlarged
        };
        values.split_at(self.size() * self.summed)
    }
}

impl Kernel for System<'_> {
    type Factor = FrontFactor;
    type Value = f64;

    fn tree(&self) -> &AssemblyTree {
        self.tree
    }

    fn entries(&self, front: &Front) -> usize {
        front.entries()
    }

    fn factor(
        &self,
        f: usize,
        children: &[Child<'_>],
        planned: &mut [f64],
        rest: &mut [f64],
    ) -> (FrontFactor, Contribution) {
        let factor = factor(*self, f, children, planned, rest);
        let contribution = contribution(&factor);
        (factor, contribution)
    }

    fn with_delayed(
        &self,
        factor: &FrontFactor,
        planned: &[f64],
        rest: &[f64],
        contribution: &mut [f64],
    ) {
        with_delayed(factor, planned, rest, contribution);
    }
}

/// Assembles and factors front `f`; `planned` is the storage for a front that inherits no pivots.
fn factor(
    system: System<'_>,
    f: usize,
    children: &[Child<'_>],
    planned: &mut [f64],
    rest: &mut [f64],
) -> FrontFactor {
    let front = &system.tree.fronts[f];
    let mut factor = unknowns(system, front, children);
    let inherited = factor.summed - front.pivots;
    let values = if inherited == 0 {
        planned.fill(0.0);
        planned
    } else {
        factor.enlarged = vec![0.0; factor.entries()];
        &mut factor.enlarged
    };
    let (left, above) = values.split_at_mut(factor.rows.len() * factor.summed);
    let mut target = Target {
        left,
        above,
        rest,
        size: factor.rows.len(),
        summed: factor.summed,
        planned: front.pivots,
    };
    target.assemble(system, front);
    let mut next = front.pivots;
    for child in children {
        target.extend_add(child, next);
        next += child.contribution.delayed();
    }
    let is_root = system.tree.roots.binary_search(&(f as u32)).is_ok();
    let leftover = if is_root {
        Leftover::Replace
    } else {
        Leftover::Delay
    };
    let done = dense::eliminate(
        target.left,
        target.above,
        target.rest,
        &mut factor.rows,
        &mut factor.columns,
        leftover,
    );
    (factor.pivots, factor.replaced, factor.smallest) = (done.pivots, done.replaced, done.smallest);
    factor
}

/// Names of what the parent receives.
fn contribution(factor: &FrontFactor) -> Contribution {
    Contribution {
        size: factor.size() - factor.pivots,
        delayed_rows: factor.rows[factor.pivots..factor.summed].to_vec(),
        delayed_columns: factor.columns[factor.pivots..factor.summed].to_vec(),
    }
}

/// Contribution with the delayed pivots, from the factors and the part on the border.
fn with_delayed(factor: &FrontFactor, planned: &[f64], rest: &[f64], contribution: &mut [f64]) {
    let (left, above) = factor.values(planned);
    let (size, summed, pivots) = (factor.size(), factor.summed, factor.pivots);
    let (width, delayed) = (size - summed, summed - pivots);
    for (k, column) in contribution.chunks_exact_mut(size - pivots).enumerate() {
        if k < delayed {
            column.copy_from_slice(&left[(pivots + k) * size + pivots..][..size - pivots]);
        } else {
            let j = k - delayed;
            column[..delayed].copy_from_slice(&above[j * summed + pivots..][..delayed]);
            column[delayed..].copy_from_slice(&rest[j * width..][..width]);
        }
    }
}

/// Unknowns of a front: members, inherited, border.
fn unknowns(system: System<'_>, front: &Front, children: &[Child<'_>]) -> FrontFactor {
    let structure = system.matrix.structure();
    let of = |list: &[u32], unknowns: &mut Vec<u32>| {
        for &i in list {
            unknowns.extend(structure.group(i as usize).map(|u| u as u32));
        }
    };
    let (mut rows, mut columns) = (Vec::with_capacity(front.size), Vec::new());
    of(&front.members, &mut rows);
    columns.extend_from_slice(&rows);
    for child in children {
        rows.extend_from_slice(&child.contribution.delayed_rows);
        columns.extend_from_slice(&child.contribution.delayed_columns);
    }
    let summed = rows.len();
    of(&front.border, &mut rows);
    columns.extend_from_slice(&rows[summed..]);
    FrontFactor {
        rows,
        columns,
        summed,
        ..FrontFactor::default()
    }
}

/// A front in its three pieces while it is assembled.
struct Target<'a> {
    left: &'a mut [f64],
    above: &'a mut [f64],
    rest: &'a mut [f64],
    size: usize,
    summed: usize,
    /// Pivots before any were inherited.
    planned: usize,
}

impl Target<'_> {
    /// Position in the front of a position that was planned.
    fn shifted(&self, planned: usize) -> usize {
        if planned < self.planned {
            planned
        } else {
            planned + self.summed - self.planned
        }
    }

    /// Adds the entries of the matrix in the rows and columns of the members.
    fn assemble(&mut self, system: System<'_>, front: &Front) {
        let structure = system.matrix.structure();
        let mut start = 0;
        for &i in &front.members {
            let i = i as usize;
            for edge in structure.edges(i) {
                let local = system.tree.local[edge];
                if local == ELSEWHERE {
                    continue;
                }
                let other = self.shifted(local as usize);
                self.add_block(system, (i, edge), (start, other));
                if other >= self.summed {
                    let mirrored = system.tree.mirror[edge] as usize;
                    self.add_block(system, (structure.target(edge), mirrored), (other, start));
                }
            }
            start += structure.group(i).len();
        }
    }

    /// Adds the block of an edge of supervariable `i` at a place in the front.
    fn add_block(
        &mut self,
        system: System<'_>,
        (i, edge): (usize, usize),
        (row, column): (usize, usize),
    ) {
        let structure = system.matrix.structure();
        let (rows, columns) = (structure.group(i), structure.group(structure.target(edge)));
        for a in 0..rows.len() {
            let position = structure.row(i, a).start + structure.column(edge);
            let values = &system.matrix.values()[position..][..columns.len()];
            let scale = system.scaling.rows[rows.start + a];
            for (b, value) in values.iter().enumerate() {
                let scaled = value * scale * system.scaling.columns[columns.start + b];
                if column < self.summed {
                    self.left[(column + b) * self.size + row + a] += scaled;
                } else {
                    self.above[(column + b - self.summed) * self.summed + row + a] += scaled;
                }
            }
        }
    }

    /// Adds a child's contribution, its delayed pivots at `delayed_at`.
    fn extend_add(&mut self, child: &Child<'_>, delayed_at: usize) {
        let places = self.places(child, delayed_at);
        let size = places.len();
        // Places rise apart from the delayed ones, which are fully summed.
        let split = places
            .iter()
            .take_while(|&&p| (p as usize) < self.summed)
            .count();
        let (upper, lower) = places.split_at(split);
        let rest = self.size - self.summed;
        for (source, &place) in child.values.chunks_exact(size.max(1)).zip(&places) {
            let place = place as usize;
            if place < self.summed {
                let column = &mut self.left[place * self.size..][..self.size];
                add_at(column, source, &places, 0);
            } else {
                let j = place - self.summed;
                add_at(
                    &mut self.above[j * self.summed..][..self.summed],
                    source,
                    upper,
                    0,
                );
                add_at(
                    &mut self.rest[j * rest..][..rest],
                    &source[split..],
                    lower,
                    self.summed,
                );
            }
        }
    }

    /// Place in this front of each row and column of a contribution.
    fn places(&self, child: &Child<'_>, delayed_at: usize) -> Vec<u32> {
        let delayed = delayed_at..delayed_at + child.contribution.delayed();
        let border = child.front.places().map(|place| self.shifted(place));
        delayed.chain(border).map(|place| place as u32).collect()
    }
}

/// `target[places[k] - origin] += source[k]`.
fn add_at(target: &mut [f64], source: &[f64], places: &[u32], origin: usize) {
    for (&place, value) in places.iter().zip(source) {
        target[place as usize - origin] += value;
    }
}
