//! The default solver: condensed where that works and is cheaper, iterative where direct factors
//! would be too large, multifrontal LU otherwise.
//!
//! Factors of the interior of the bodies are kept while they are good enough as a preconditioner:
//! the contact system is factored again, and GMRES compensates for the change of the bulk. They are
//! renewed if that takes, or last took, more iterations than a factorisation costs, counted in
//! operations. As they only precondition, they are stored in single precision, which halves time
//! and memory. If that is too coarse for a problem, they are stored in double precision from then
//! on.
//!
//! Fall-backs depend on counts and signs alone, so equal matrices are always solved in one way: it
//! falls back if the interface is so large that its dense algebra costs more than the LU, if the
//! interior is not positive definite, if the contact system is singular (the LU then names the
//! unknown), or if refinement does not reach an accurate solution. Systems that the iterative
//! solver cannot solve are passed to the condensed one, if that fits into memory.
//!
//! Longer than other files, as all choices are in one place.

use crate::{
    condensed::Condensed,
    experience::{Experience, FactoredInterior},
    iterative::Iterative,
    partition::Partition,
    report::{Analysis, Factored, FallBack, Method},
    solver::TangentSolver,
    tangent::Tangent,
};
use striae_sparse::{
    Age, FaerLu, LinearSolver, MultifrontalLu, Precision, SolveError, SolveReport, Structure,
    gmres::Ends,
};

/// Part of a factorisation of the bodies that an iteration of Newton's method takes: in
/// single precision half the time, and for every other iteration at most.
const REUSED: f64 = 0.25;
/// Largest dense matrix, in bytes.
const LARGEST_DENSE: usize = 6 << 30;
/// Work of a dense system of what contact leaves free, over that of the interior, up to
/// which it is worth correcting contact alone.
const CHEAP: f64 = 0.1;
/// Iterations of GMRES below which older factors are not worth a try.
const FEWEST: usize = 3;
/// Most iterations of GMRES with older factors.
const MOST: usize = 25;

/// Part of the iterations that older factors are worth, inverted, from which on they
/// are not used for another state.
const AGED: usize = 2;

/// Unknowns above which no direct solver is considered.
const MANY: usize = 450_000;
/// Predicted memory of factors, in bytes, above which the iterative solver is taken.
const LARGEST: usize = 12 << 30;
/// Operations of a factorisation above which the iterative solver is taken.
const COSTLY: f64 = 3.5e12;

/// Reduction of the residual by a solution, unless another one is requested.
pub const REDUCTION: f64 = 1e-6;

/// Solver that is tried first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Choice {
    /// The one that costs least by a count of operations and memory.
    #[default]
    ByCost,
    /// The iterative one, whatever it costs; a direct one where it fails.
    Iterative,
    /// Multifrontal LU, and no other.
    Multifrontal,
    /// faer's sparse LU, and no other.
    Faer,
}

/// Chooses between the condensed solver, the multifrontal LU and the iterative solver.
#[derive(Default)]
pub struct Automatic {
    choice: Choice,
    iterative: Option<Iterative>,
    partition: Option<Partition>,
    condensed: Option<Condensed>,
    lu: Option<Box<dyn LinearSolver>>,
    /// Reason why the iterative solver was chosen by cost.
    reason: Option<FallBack>,
    /// Iterations of GMRES that older factors are worth.
    allowance: usize,
    /// Experience from earlier matrices.
    experience: Experience,
    /// Method that made the last factors.
    factored: Option<Made>,
}

/// Method that made the factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Made {
    /// The iterative solver.
    Iterative,
    /// The condensed one, with an interior of this age.
    Condensed(Age),
    /// An LU.
    Lu,
}

impl Automatic {
    /// A solver that has seen no matrix yet.
    pub fn new(choice: Choice) -> Self {
        Self {
            choice,
            ..Self::default()
        }
    }

    /// Factors with the LU, which is analysed when first needed.
    fn factor_lu(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        let partition = self.partition.as_ref().ok_or(SolveError::NotAnalysed)?;
        if self.lu.is_none() {
            let (solver, analysis) = analysed_lu(Method::Multifrontal, partition.whole())?;
            if analysis.cost.peak_bytes > LARGEST && self.iterative.is_some() {
                let bytes = analysis.cost.peak_bytes;
                return Err(SolveError::TooLarge { bytes });
            }
            self.lu = Some(solver);
        }
        let solver = self.lu.as_mut().ok_or(SolveError::NotAnalysed)?;
        let report = solver.factor(&tangent.sum(partition.whole()))?;
        let method = match self.choice {
            Choice::Faer => Method::Faer,
            _ => Method::Multifrontal,
        };
        self.factored = Some(Made::Lu);
        Ok(Factored {
            fall_back: self.experience.fall_back,
            ..Factored::by(method, report)
        })
    }

    /// Factors everything.
    fn factor_anew(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        self.experience.taken = 0;
        let iterative = self.iterative.as_mut();
        if let Some(iterative) = iterative.filter(|_| self.experience.rest == 0) {
            match iterative.factor(tangent) {
                Ok(report) => {
                    self.factored = Some(Made::Iterative);
                    (self.condensed, self.lu) = (None, None);
                    return Ok(Factored {
                        fall_back: self.reason,
                        ..report
                    });
                }
                Err(SolveError::NotPositiveDefinite { .. } | SolveError::Singular { .. }) => {
                    self.give_up(FallBack::NoPreconditioner);
                }
                Err(other) => return Err(other),
            }
        } else {
            self.experience.rest = self.experience.rest.saturating_sub(1);
        }
        self.plan_direct()?;
        if self.condensed.is_none() || self.experience.patience > 0 {
            self.experience.patience = self.experience.patience.saturating_sub(1);
            return self.factor_lu(tangent);
        }
        match self.factor_condensed(tangent) {
            Ok(report) => {
                let reason = self.iterative.as_ref().and(self.experience.fall_back);
                self.experience.fall_back = reason;
                self.factored = Some(Made::Condensed(Age::Fresh));
                // The LU would only hold memory now.
                self.lu = None;
                Ok(Factored {
                    fall_back: reason,
                    ..report
                })
            }
            Err(SolveError::NotPositiveDefinite { unknown, .. }) => {
                self.fall_back(FallBack::IndefiniteInterior { unknown }, tangent)
            }
            Err(SolveError::Singular { .. }) => self.fall_back(FallBack::SingularContact, tangent),
            Err(other) => Err(other),
        }
    }

    /// Precision that factors of the bodies are tried in.
    fn precision(&self) -> Precision {
        match self.allowance >= FEWEST && !self.experience.too_coarse {
            true => Precision::Single,
            false => Precision::Double,
        }
    }

    /// Factors with the condensed solver, the bodies in single precision while that does.
    fn factor_condensed(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        let single = self.precision() == Precision::Single;
        let condensed = self.condensed.as_mut().ok_or(SolveError::NotAnalysed)?;
        if single {
            match condensed.factor(tangent, Precision::Single) {
                Err(SolveError::NotPositiveDefinite { .. } | SolveError::Singular { .. }) => {}
                other => return other,
            }
        }
        let done = condensed.factor(tangent, Precision::Double);
        self.experience.too_coarse |= single && done.is_ok();
        done
    }

    /// Solves with the condensed solver's factors of an interior of some age; `None` when those
    /// are no good any more.
    fn solve_condensed(
        &mut self,
        age: Age,
        tangent: &Tangent,
        (rhs, x): (&[f64], &mut [f64]),
        reduction: f64,
    ) -> Result<Option<SolveReport>, SolveError> {
        let condensed = self.condensed.as_ref().ok_or(SolveError::NotFactored)?;
        if (age, condensed.precision()) == (Age::Fresh, Precision::Double) {
            return condensed.solve(tangent, rhs, x).map(Some);
        }
        let ends = Ends {
            iterations: self.allowance,
            reduction,
        };
        let report = condensed.solve_nearby(tangent, (rhs, x), ends)?;
        match &report {
            Some(report) => self.experience.taken = report.krylov_iterations,
            None => self.experience.too_coarse |= age == Age::Fresh,
        }
        Ok(report.map(|report| SolveReport { age, ..report }))
    }

    /// Leaves matrices to a direct solver for a while.
    fn give_up(&mut self, reason: FallBack) {
        self.experience.iterative_failed(reason);
        if let Some(iterative) = &mut self.iterative {
            iterative.forget();
        }
    }

    /// Plans the condensed solver instead of the iterative one, if there is memory for it.
    fn plan_direct(&mut self) -> Result<(), SolveError> {
        let is_planned = self.condensed.is_some() || self.lu.is_some();
        if self.iterative.is_none() || is_planned {
            return Ok(());
        }
        let partition = self.partition.as_ref().ok_or(SolveError::NotAnalysed)?;
        let condensed = Condensed::analyse(partition)?;
        if condensed.analysis(Precision::Double).cost.peak_bytes <= LARGEST {
            self.condensed = Some(condensed);
        }
        Ok(())
    }

    fn fall_back(&mut self, reason: FallBack, tangent: &Tangent) -> Result<Factored, SolveError> {
        self.experience.condensed_failed(reason);
        self.factor_lu(tangent)
    }

    /// Factors contact on older factors of the bodies while these are good enough, else all.
    fn refreshed_or_anew(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        self.factored = None;
        let good = self.allowance >= FEWEST && 4 * self.experience.taken <= 3 * self.allowance;
        if let Some(condensed) = self.condensed.as_mut()
            && self.experience.patience == 0
            && good
            && let Ok(Some(report)) = condensed.refresh(tangent)
        {
            self.factored = Some(Made::Condensed(Age::Stale));
            return Ok(report);
        }
        self.factor_anew(tangent)
    }

    /// Solves with the last factors; others are made where they do not serve.
    fn solved_to(
        &mut self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<SolveReport, SolveError> {
        if self.factored == Some(Made::Iterative) {
            let iterative = self.iterative.as_ref().ok_or(SolveError::NotFactored)?;
            if let Some(report) = iterative.solve(tangent, rhs, x, reduction)? {
                return Ok(report);
            }
            self.give_up(FallBack::NotConverged);
            self.factor_anew(tangent)?;
        }
        while let Some(Made::Condensed(age)) = self.factored {
            match self.solve_condensed(age, tangent, (rhs, &mut *x), reduction) {
                Ok(Some(report)) => return Ok(report),
                Ok(None) => self.factor_anew(tangent)?,
                Err(SolveError::Inaccurate { backward_error }) => {
                    self.fall_back(FallBack::Inaccurate { backward_error }, tangent)?
                }
                Err(other) => return Err(other),
            };
        }
        match (self.lu.as_mut(), self.factored) {
            (Some(solver), Some(_)) => solver.solve(tangent, rhs, x),
            _ => Err(SolveError::NotFactored),
        }
    }
}

impl Automatic {
    /// Plans the solver that costs least.
    fn plan_by_cost(&mut self, partition: &Partition) -> Result<Analysis, SolveError> {
        let condensed = Condensed::analyse(partition)?;
        // In double precision, in case single is too coarse.
        let analysis = condensed.analysis(Precision::Double);
        let order = condensed.interface();
        let (contact, bodies) = condensed.work();
        // Where the bodies outweigh the interface, the LU of both costs more.
        let direct = if contact > bodies {
            let (solver, other) = analysed_lu(Method::Multifrontal, partition.whole())?;
            let dense = size_of::<f64>() * order * order;
            let is_dearer = contact + REUSED * bodies > other.cost.flops;
            (dense > LARGEST_DENSE || is_dearer).then_some((solver, other))
        } else {
            None
        };
        let cheaper = direct.as_ref().map_or(analysis, |direct| direct.1).cost;
        if cheaper.peak_bytes > LARGEST || cheaper.flops > COSTLY {
            self.iterative = Iterative::analyse(partition);
            if self.iterative.is_some() {
                self.reason = Some(FallBack::LargeBodies {
                    bytes: cheaper.peak_bytes,
                    flops: cheaper.flops,
                });
                return Ok(Iterative::analysis(partition.whole()));
            }
        }
        if let Some((solver, other)) = direct {
            self.lu = Some(solver);
            self.experience.fall_back = Some(FallBack::LargeInterface { unknowns: order });
            return Ok(other);
        }
        let worth = 0.7 * condensed.solutions_per_factorisation();
        self.allowance = (worth as usize).min(MOST);
        let analysis = condensed.analysis(self.precision());
        self.condensed = Some(condensed);
        Ok(analysis)
    }

    /// The condensed solver, if it was chosen independently of contact and also is that of another
    /// partition.
    fn unchanged(&self, partition: &Partition) -> Option<&Condensed> {
        let condensed = self.condensed.as_ref()?;
        let (contact, bodies) = condensed.work();
        let is_chosen = self.iterative.is_none() && contact <= bodies;
        let before = self.partition.as_ref()?;
        (is_chosen && before.condenses_like(partition)).then_some(condensed)
    }

    /// Predicted costs of all methods it chooses between, in the order they are tried.
    ///
    /// # Errors
    /// Returns why the unknowns cannot be ordered.
    pub fn estimates(&self, partition: &Partition) -> Result<Vec<Analysis>, SolveError> {
        if matches!(self.choice, Choice::Multifrontal | Choice::Faer) {
            return Ok(Vec::new());
        }
        let mut all = vec![
            Condensed::analyse(partition)?.analysis(self.precision()),
            analysed_lu(Method::Multifrontal, partition.whole())?.1,
        ];
        if Iterative::analyse(partition).is_some() {
            all.push(Iterative::analysis(partition.whole()));
        }
        Ok(all)
    }

    /// Solves `tangent x = rhs` with the last factorisation, to [`REDUCTION`] at least.
    ///
    /// `tangent` is the factored one or one close to it: the residual is that of
    /// `tangent`. The old content of `x` is not used.
    ///
    /// # Errors
    /// Returns why there is no accurate solution.
    pub fn solve(
        &mut self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
    ) -> Result<SolveReport, SolveError> {
        self.solve_to(tangent, rhs, x, REDUCTION)
    }
}

impl TangentSolver for Automatic {
    /// Orders the unknowns and predicts the cost. Earlier factorisations are forgotten, unless
    /// additional couplings of contact only matter to an LU: if the condensed solver is used and no
    /// more supervariables are kept.
    fn analyse(&mut self, partition: &Partition) -> Result<Analysis, SolveError> {
        if let Some(condensed) = self.unchanged(partition) {
            let analysis = condensed.analysis(self.precision());
            self.partition = Some(partition.clone());
            self.lu = None;
            return Ok(analysis);
        }
        *self = Self {
            choice: self.choice,
            experience: self.experience.of_other_pattern(),
            ..Self::default()
        };
        self.partition = Some(partition.clone());
        let direct = match self.choice {
            Choice::Multifrontal => Some(Method::Multifrontal),
            Choice::Faer => Some(Method::Faer),
            Choice::ByCost | Choice::Iterative => None,
        };
        if let Some(method) = direct {
            let (solver, analysis) = analysed_lu(method, partition.whole())?;
            self.lu = Some(solver);
            return Ok(analysis);
        }
        let unknowns = partition.unknowns();
        if self.choice == Choice::Iterative || unknowns > MANY {
            self.iterative = Iterative::analyse(partition);
        }
        if self.iterative.is_some() {
            if self.choice == Choice::ByCost {
                self.reason = Some(FallBack::ManyUnknowns { unknowns });
            }
            return Ok(Iterative::analysis(partition.whole()));
        }
        self.plan_by_cost(partition)
    }

    // All linear algebra of this process is done on threads of the pool, which need not be woken
    // then.
    fn factor(&mut self, tangent: &Tangent) -> Result<Factored, SolveError> {
        rayon::scope(|_| self.refreshed_or_anew(tangent))
    }

    /// Reduces the residual by `reduction` where it is not reduced to round-off: where the factors
    /// of the bodies are [stale](Age::Stale) or the solver is iterative.
    fn solve_to(
        &mut self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<SolveReport, SolveError> {
        rayon::scope(|_| self.solved_to(tangent, rhs, x, reduction))
    }

    /// Forgets factors, but not the analysis.
    fn forget(&mut self) {
        self.experience.taken = 0;
        if let Some(condensed) = &mut self.condensed {
            condensed.forget();
        }
    }

    fn start_afresh(&mut self) {
        self.experience.forgive();
        if AGED * self.experience.taken > self.allowance {
            self.forget();
        }
        if let Some(condensed) = &mut self.condensed {
            condensed.forget_untouched();
        }
    }

    /// Solves with factors of the condensed solver alone.
    fn solve_beside(
        &self,
        tangent: &Tangent,
        rhs: &[f64],
        x: &mut [f64],
        reduction: f64,
    ) -> Result<Option<SolveReport>, SolveError> {
        let is_made = matches!(self.factored, Some(Made::Condensed(_)));
        let condensed = self.condensed.as_ref().filter(|_| is_made);
        let Some(condensed) = condensed.filter(|condensed| condensed.serves(tangent)) else {
            return Ok(None);
        };
        let ends = Ends {
            iterations: MOST,
            reduction,
        };
        rayon::scope(|_| condensed.solve_nearby(tangent, (rhs, x), ends))
    }

    /// Returns whether correcting contact alone is cheap enough to pay.
    fn has_interior(&self) -> bool {
        let condensed = self.condensed.as_ref();
        matches!(self.factored, Some(Made::Condensed(_)))
            && condensed.is_some_and(|condensed| condensed.share_of_contact() <= CHEAP)
    }

    /// Solves without refinement, for corrections that are checked by other means.
    fn solve_other_contact(
        &mut self,
        tangent: &Tangent,
        rhs: &[f64],
    ) -> Result<Option<Vec<f64>>, SolveError> {
        match (&mut self.condensed, self.factored) {
            (Some(condensed), Some(Made::Condensed(_))) => {
                rayon::scope(|_| condensed.solve_other_contact(tangent, rhs))
            }
            _ => Ok(None),
        }
    }

    fn experience(&self) -> (Experience, Option<FactoredInterior>) {
        let interior = self.condensed.as_ref().and_then(Condensed::factored);
        (self.experience.clone(), interior)
    }

    fn recall(&mut self, experience: &Experience, interior: Option<&FactoredInterior>) {
        (self.experience.too_coarse, self.experience.taken) =
            (experience.too_coarse, experience.taken);
        if let (Some(condensed), Some(interior)) = (&mut self.condensed, interior)
            && condensed.factor_again(interior).is_err()
        {
            condensed.forget();
        }
    }
}

/// An LU with its analysis.
fn analysed_lu(
    method: Method,
    structure: &Structure,
) -> Result<(Box<dyn LinearSolver>, Analysis), SolveError> {
    let mut solver: Box<dyn LinearSolver> = match method {
        Method::Faer => Box::new(FaerLu::new()),
        _ => Box::new(MultifrontalLu::new()),
    };
    let cost = solver.analyse(structure)?;
    Ok((solver, Analysis { cost, method }))
}
