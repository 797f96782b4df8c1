//! Partial Cholesky factorisation of a symmetric matrix: an interior is
//! eliminated, a set of supervariables is kept.
//!
//! With `i` the interior and `k` what is kept,
//! `S = A_kk - A_ki A_ii^-1 A_ik`, `g = b_k - A_ki A_ii^-1 b_i`, and once
//! `x_k` is known, `x_i = A_ii^-1 (b_i - A_ik x_k)`. Only `A_ii` needs to be
//! positive definite. Multifrontal, on the fronts' lower triangles; the kept
//! unknowns form the last front, which is assembled but not factored. The
//! result does not depend on the number of threads.

mod fronts;

use crate::{
    descent::Descent,
    error::SolveError,
    matrix::SparseMatrix,
    numeric::Numeric,
    ordering,
    real::{Precision, Real},
    solver::Cost,
    structure::Structure,
    supervariable::{Supervariable, Tier},
    tree::AssemblyTree,
};
use faer::Mat;
pub use fronts::mirror_lower;
use fronts::{Failure, Plan, entries};

/// Cholesky factorisation of the interior of a symmetric matrix.
#[derive(Debug)]
pub struct SchurCholesky {
    structure: Structure,
    tree: AssemblyTree,
    descent: Descent,
    /// Unknowns in the order of elimination.
    order: Vec<u32>,
    /// Unknowns of the Schur complement.
    kept: Vec<usize>,
    scales: Vec<f64>,
    factors: Factors,
}

/// Factors of one precision or the other.
#[derive(Debug)]
enum Factors {
    Single(Numeric<Option<Failure>, f32>),
    Double(Numeric<Option<Failure>, f64>),
}

/// A dense matrix, column by column.
#[derive(Clone, Copy, Debug)]
pub enum Values<'a> {
    /// In single precision.
    Single(&'a [f32]),
    /// In double precision.
    Double(&'a [f64]),
}
impl SchurCholesky {
    /// Plans the elimination of all but the `kept` supervariables.
    pub fn analyse(structure: &Structure, kept: &[Supervariable]) -> Result<Self, SolveError> {
        let mut tiers = vec![Tier(0); structure.supervariables()];
        kept.iter().for_each(|s| tiers[s.0] = Tier(1));
        let is_kept = |&i: &u32| tiers[i as usize] == Tier(1);
        let kept: Vec<u32> = (0..tiers.len() as u32).filter(is_kept).collect();
        let mut order = ordering::order(structure, &tiers)?;
        order.truncate(tiers.len() - kept.len());
        order.extend(&kept);
        let tree = AssemblyTree::new(structure, &tiers, &order, kept.len());
        let unknowns = |list: &[u32]| -> Vec<u32> {
            let groups = list.iter().map(|&i| structure.group(i as usize));
            groups.flatten().map(|u| u as u32).collect()
        };
        let interior = tree.fronts.len() - usize::from(!kept.is_empty());
        let fronts = tree.fronts.iter();
        Ok(Self {
            descent: Descent::new(&tree, interior),
            order: fronts.flat_map(|front| unknowns(&front.members)).collect(),
            structure: structure.clone(),
            tree,
            kept: unknowns(&kept).into_iter().map(|u| u as usize).collect(),
            scales: Vec::new(),
            factors: Factors::of(Precision::Double),
        })
    }

    /// Predicted cost of [`factor`](Self::factor).
    pub fn cost(&self, precision: Precision) -> Cost {
        let factor_entries = self.tree.fronts.iter().map(entries).sum();
        let interior = self.tree.fronts.iter().take(self.interior());
        let flops = interior
            .map(|f| 0.5 * crate::tree::elimination_flops(f.pivots, f.size))
            .sum();
        let peak_bytes = precision.bytes() * (factor_entries + self.tree.stack());
        Cost {
            factor_entries,
            flops,
            peak_bytes,
        }
    }

    /// Unknowns of the rows and columns of the Schur complement, rising.
    pub fn kept_unknowns(&self) -> &[usize] {
        &self.kept
    }

    /// Eliminates the interior.
    ///
    /// Of the matrix only one of each pair of mirrored entries is used.
    pub fn factor(
        &mut self,
        matrix: &SparseMatrix,
        precision: Precision,
    ) -> Result<(), SolveError> {
        self.scales.clear();
        if !self.structure.same_as(matrix.structure()) {
            return Err(SolveError::NotAnalysed);
        }
        let scales = self.unit_diagonal(matrix)?;
        if self.factors.precision() != precision {
            self.factors = Factors::of(precision);
        }
        let plan = Plan {
            tree: &self.tree,
            matrix,
            scales: &scales,
            interior: self.interior(),
            kept: self.kept.len(),
        };
        let failure = match &mut self.factors {
            Factors::Single(numeric) => plan.factor(numeric),
            Factors::Double(numeric) => plan.factor(numeric),
        };
        if let Some(failure) = failure {
            return Err(SolveError::NotPositiveDefinite {
                unknown: failure.unknown,
                pivot: failure.pivot,
            });
        }
        self.scales = scales;
        Ok(())
    }

    /// The Schur complement of the last factorisation, both triangles.
    pub fn complement(&self) -> Mat<f64> {
        let n = self.kept.len();
        Mat::from_fn(n, n, |i, j| match self.complement_values() {
            Values::Single(values) => values[j * n + i].double(),
            Values::Double(values) => values[j * n + i],
        })
    }

    /// Values of the complement, column by column.
    pub fn complement_values(&self) -> Values<'_> {
        let begin = |values: usize| values.saturating_sub(self.kept.len().pow(2));
        match &self.factors {
            Factors::Single(numeric) => {
                Values::Single(&numeric.values[begin(numeric.values.len())..])
            }
            Factors::Double(numeric) => {
                Values::Double(&numeric.values[begin(numeric.values.len())..])
            }
        }
    }

    /// Eliminates the interior from a right-hand side; the kept unknowns hold
    /// `b_k - A_ki A_ii^-1 b_i`, the others what [`expand`](Self::expand) needs.
    pub fn condense(&self, rhs: &[f64]) -> Result<Vec<f64>, SolveError> {
        check_length(rhs, self.structure.unknowns())?;
        if self.scales.len() != rhs.len() {
            return Err(SolveError::NotFactored);
        }
        Ok(match &self.factors {
            Factors::Single(numeric) => self.condensed(&numeric.values, rhs),
            Factors::Double(numeric) => self.condensed(&numeric.values, rhs),
        })
    }

    /// Returns the right-hand side of the kept unknowns in double precision, after elimination of
    /// the interior.
    fn condensed<T: Real>(&self, values: &[T], rhs: &[f64]) -> Vec<f64> {
        let interior = self.order.len() - self.kept.len();
        let scaled = |&u: &u32| T::of(rhs[u as usize] * self.scales[u as usize]);
        let mut y: Vec<T> = self.order[..interior].iter().map(scaled).collect();
        y.resize(self.order.len(), T::default());
        self.descent.upwards(values, &mut y);
        let mut condensed = vec![0.0; rhs.len()];
        for (&u, y) in self.order.iter().zip(&y) {
            condensed[u as usize] = y.double();
        }
        for &u in &self.kept {
            condensed[u] += rhs[u];
        }
        condensed
    }

    /// All unknowns, from a condensed right-hand side with the solution at the kept ones.
    pub fn expand(&self, condensed: Vec<f64>) -> Result<Vec<f64>, SolveError> {
        check_length(&condensed, self.structure.unknowns())?;
        Ok(match &self.factors {
            Factors::Single(numeric) => self.expanded(&numeric.values, condensed),
            Factors::Double(numeric) => self.expanded(&numeric.values, condensed),
        })
    }

    /// Returns the full solution; the kept unknowns are unchanged to the last bit.
    fn expanded<T: Real>(&self, values: &[T], condensed: Vec<f64>) -> Vec<f64> {
        let unknowns = self.order.iter().map(|&u| u as usize);
        let mut y: Vec<T> = unknowns.map(|u| T::of(condensed[u])).collect();
        self.descent.downwards(values, &mut y);
        let mut x = condensed;
        let interior = self.order.len() - self.kept.len();
        for (&u, y) in self.order[..interior].iter().zip(y) {
            x[u as usize] = y.double() * self.scales[u as usize];
        }
        x
    }

    /// Number of fronts that are eliminated.
    fn interior(&self) -> usize {
        let root = self.tree.fronts.last().filter(|_| !self.kept.is_empty());
        self.tree.fronts.len() - root.map_or(0, |_| 1)
    }

    /// Powers of two that bring the diagonal of the interior near one.
    fn unit_diagonal(&self, matrix: &SparseMatrix) -> Result<Vec<f64>, SolveError> {
        let mut scales = vec![1.0; self.structure.unknowns()];
        for &unknown in &self.order[..self.order.len() - self.kept.len()] {
            let unknown = unknown as usize;
            let pivot = matrix.get(unknown, unknown).unwrap_or(0.0);
            if pivot.is_nan() || pivot <= 0.0 {
                return Err(SolveError::NotPositiveDefinite { unknown, pivot });
            }
            scales[unknown] = (-(0.5 * pivot.log2()).round()).exp2();
        }
        Ok(scales)
    }
}

impl Factors {
    /// None yet.
    fn of(precision: Precision) -> Self {
        match precision {
            Precision::Single => Self::Single(Numeric::default()),
            Precision::Double => Self::Double(Numeric::default()),
        }
    }

    fn precision(&self) -> Precision {
        match self {
            Self::Single(_) => Precision::Single,
            Self::Double(_) => Precision::Double,
        }
    }
}
fn check_length(v: &[f64], expected: usize) -> Result<(), SolveError> {
    if v.len() == expected {
        Ok(())
    } else {
        Err(SolveError::Length {
            found: v.len(),
            expected,
        })
    }
}
