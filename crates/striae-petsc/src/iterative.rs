//! FGMRES on the whole system, with the block factorisation as its preconditioner.
//!
//! The method is that of the [iterative solver](striae_condensed) on one rank, whose module docs
//! give the formulas, except that the matrix is never assembled on one rank, one cycle of PETSc's
//! multigrid approximates the inverse of the bodies, and every rank factors a copy of the contact
//! system.

use crate::{
    binding::{Krylov, Sum},
    borders::{Borders, lay},
    bulk::{Bulk, Inverse},
    coupling::{Coupling, Part},
    error::Error,
    nodes::Nodes,
    product::{Product, norm, normalise, place, scale},
    ranks::Ranks,
};
use striae_condensed::{Numbering, Partition, Tangent};
use striae_solve::team::Team;
use striae_sparse::{Age, Equilibration, SolveError, SolveReport, root};

/// Iterations at most.
const MOST: usize = 600;
/// Number of times that the true residual is evaluated.
const LOOKS: usize = 5;
/// Reduction of the residual between looks; more is lost to round-off.
const GAIN: f64 = 1e-10;
/// Size of a solution over that of its right-hand side at which the matrix, whose entries
/// are near one, counts as singular.
const SINGULAR: f64 = 1e13;

/// A preconditioner of the sum of parts.
#[derive(Debug)]
pub(crate) struct Iterative {
    krylov: Krylov,
    inverse: Inverse,
    coupling: Option<Coupling>,
    /// Factors of own unknowns and rows.
    scaling: Equilibration,
    /// Places of own unknowns that are prescribed, and their diagonals.
    prescribed: Vec<(u32, f64)>,
    /// Places of the bulk among own unknowns, node by node.
    bulk: Vec<u32>,
    /// Vectors of the bulk.
    b: Vec<f64>,
    x: Vec<f64>,
}

/// A part of a system with what is known of it.
pub(crate) struct Shared<'a> {
    pub(crate) ranks: &'a Ranks,
    pub(crate) partition: &'a Partition,
    pub(crate) numbering: &'a Numbering,
    pub(crate) tangent: &'a Tangent,
    /// Borders that the tangent touches.
    pub(crate) borders: &'a mut Borders,
}

impl Iterative {
    /// Makes the preconditioner; `None` where the bodies are not definite. Collective.
    pub(crate) fn new(shared: &mut Shared<'_>, nodes: &Nodes) -> Result<Option<Self>, SolveError> {
        let Shared {
            ranks,
            partition,
            numbering,
            tangent,
            ..
        } = *shared;
        let library = ranks.library();
        let (factors, prescribed) = diagonal(shared, nodes)?;
        let places = shared.borders.own.clone();
        let own = |values: &[f64]| places.iter().map(|&u| values[u as usize]).collect();
        let mut scaling = Equilibration {
            rows: own(&factors),
            columns: own(&factors),
        };
        let is_prescribed: Vec<bool> = prescribed.iter().map(|d| *d != 0.0).collect();
        let part = Part {
            partition,
            numbering,
            nodes,
            tangent,
            scaling: &factors,
            prescribed: &is_prescribed,
        };
        let coupling = Coupling::new(library, ranks, part, &mut scaling)?;
        let bulk = Bulk {
            partition,
            nodes,
            tangent,
            scaling: &factors,
            prescribed: &is_prescribed,
        };
        let Some(inverse) = bulk.inverse(library, ranks, coupling.as_ref())? else {
            return Ok(None);
        };
        let held = (0..)
            .zip(&places)
            .map(|(at, &u)| (at, prescribed[u as usize]));
        Ok(Some(Self {
            krylov: Krylov::new(library, lay(numbering))?,
            inverse,
            coupling,
            scaling,
            prescribed: held.filter(|(_, diagonal)| *diagonal != 0.0).collect(),
            bulk: nodes.places.clone(),
            b: vec![0.0; nodes.places.len()],
            x: vec![0.0; nodes.places.len()],
        }))
    }

    /// Entries of the contact part that every rank keeps.
    pub(crate) fn entries(&self) -> usize {
        self.coupling.as_ref().map_or(0, Coupling::entries)
    }

    /// Solves for own unknowns, of which the `first` is known; the error says how large the residual stays where that takes
    /// too many iterations.
    pub(crate) fn solve(
        &mut self,
        product: &mut Product<'_>,
        team: &dyn Team,
        (rhs, x, first): (&[f64], &mut [f64], usize),
        reduction: f64,
    ) -> Result<SolveReport, SolveError> {
        x.fill(0.0);
        for &(at, diagonal) in &self.prescribed {
            x[at as usize] = rhs[at as usize] / diagonal;
        }
        let scaling = self.scaling.clone();
        let mut residual = product.residual(team, (x, rhs), &scaling.columns)?;
        scale(&mut residual.values, &scaling.rows);
        let size = norm(team, &residual.values);
        let (mut iterations, mut present) = (0, size);
        let mut correction = vec![0.0; x.len()];
        for _ in 0..LOOKS {
            if present <= reduction * size || iterations >= MOST {
                break;
            }
            let wanted = (0.9 * reduction * size / present).max(GAIN);
            let ends = (wanted, MOST - iterations);
            let pair = (residual.values.as_slice(), correction.as_mut_slice());
            iterations += self.corrected(product, &scaling, pair, ends)?;
            for (x, (d, factor)) in x.iter_mut().zip(correction.iter().zip(&scaling.columns)) {
                *x += d * factor;
            }
            residual = product.residual(team, (x, rhs), &scaling.columns)?;
            scale(&mut residual.values, &scaling.rows);
            let before = present;
            present = norm(team, &residual.values);
            if present.is_nan() || present >= 0.5 * before {
                break;
            }
        }
        let mut scaled: Vec<f64> = x.iter().zip(&scaling.columns).map(|(x, c)| x / c).collect();
        let mut whole = rhs.to_vec();
        scale(&mut whole, &scaling.rows);
        if norm(team, &scaled) > SINGULAR * norm(team, &whole) {
            // What is left of the right-hand side in so large a solution is a null vector.
            normalise(team, &mut scaled);
            let unknown = place(team, &scaled, first);
            let equation = unknown;
            return Err(SolveError::Singular { unknown, equation });
        }
        let backward_error = residual.backward_error;
        match residual.suffices(present, reduction * size) {
            true => Ok(SolveReport {
                backward_error,
                refinements: 0,
                krylov_iterations: iterations,
                age: Age::Fresh,
            }),
            false => Err(SolveError::Inaccurate { backward_error }),
        }
    }

    /// A correction in scaled unknowns; returns the iterations it took.
    fn corrected(
        &mut self,
        product: &mut Product<'_>,
        scaling: &Equilibration,
        pair: (&[f64], &mut [f64]),
        ends: (f64, usize),
    ) -> Result<usize, Error> {
        let Self {
            krylov,
            inverse,
            coupling,
            bulk,
            b,
            x,
            prescribed,
            ..
        } = self;
        let mut scaled = vec![0.0; pair.0.len()];
        let mut multiply = |v: &[f64], image: &mut [f64]| {
            scaled.copy_from_slice(v);
            scale(&mut scaled, &scaling.columns);
            product.apply(&scaled, image)?;
            scale(image, &scaling.rows);
            Ok(())
        };
        let mut precondition = |v: &[f64], image: &mut [f64]| {
            let places = bulk.iter().map(|&at| v[at as usize]);
            b.iter_mut().zip(places).for_each(|(b, v)| *b = v);
            image.copy_from_slice(v);
            inverse.apply(b, x)?;
            if let Some(coupling) = coupling {
                coupling.solve(v, x, b)?;
                coupling.put_multipliers(image);
                inverse.apply(b, x)?;
            }
            for (&at, x) in bulk.iter().zip(&*x) {
                image[at as usize] = *x;
            }
            for &(at, _) in &*prescribed {
                image[at as usize] = v[at as usize];
            }
            Ok(())
        };
        let ended = krylov.solve((&mut multiply, &mut precondition), pair, ends)?;
        Ok(ended.iterations)
    }
}

/// Factors of the unknowns of a part by the diagonal of the bulk, 1 for multipliers; and
/// the diagonals of unknowns that are prescribed, zero for all others.
fn diagonal(shared: &mut Shared<'_>, nodes: &Nodes) -> Result<(Vec<f64>, Vec<f64>), Error> {
    let count = nodes.inner.len();
    let (mut diagonal, mut others) = (vec![0.0; count], vec![0.0; count]);
    for unknown in 0..count {
        for (column, a) in shared.tangent.row(unknown) {
            match column == unknown {
                true => diagonal[unknown] = a,
                false if a != 0.0 => others[unknown] = 1.0,
                false => {}
            }
        }
    }
    shared.borders.join(&mut diagonal, Sum::Added)?;
    shared.borders.join(&mut others, Sum::Added)?;
    let is_bulk = |unknown: usize| !nodes.is_multiplier(nodes.inner[unknown]);
    let factors = (0..count).map(|unknown| match is_bulk(unknown) {
        true => root(diagonal[unknown].abs()),
        false => 1.0,
    });
    let prescribed = (0..count).map(|unknown| match is_bulk(unknown) && others[unknown] == 0.0 {
        true => diagonal[unknown],
        false => 0.0,
    });
    Ok((factors.collect(), prescribed.collect()))
}
