//! Totals of a run so far, written to files or not.

use striae_solve::{
    newton::{Increment, LinearWork},
    outcome::Ending,
    problem::Problem,
    report::{PairReport, held_reactions, pairs, ties},
    state::State,
    warning::Judgement,
};

use crate::summary::{
    PairSummary, SolverSummary, Status, Summary, TieSummary, WarningSummary, newton_counts,
    peak_rss_mib,
};

/// Counts increments and judges them.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    /// Newton iterations of every increment.
    pub iterations: Vec<usize>,
    /// Increments that were cut.
    pub cut_backs: usize,
    /// Unknowns of the last system.
    pub unknowns: usize,
    /// Work spent on the linear systems.
    pub solver: SolverSummary,
    /// Warnings gathered so far.
    pub judgement: Judgement,
}

impl Tally {
    /// Judges a converged increment by the state before it.
    pub fn judge(&mut self, problem: &Problem, before: &State, increment: &Increment) {
        self.judgement.converged(problem, before, increment);
    }

    /// Counts a converged increment.
    pub fn increment(&mut self, increment: &Increment) {
        self.iterations.push(increment.iterations.len());
        self.unknowns = increment.unknowns;
        self.note_work(&increment.work);
    }

    /// The summary of a run that has ended, with further warnings; collective.
    pub fn summary(
        &self,
        case: &str,
        problem: &Problem,
        state: &State,
        ending: &Ending,
        seconds: f64,
        further: Vec<WarningSummary>,
    ) -> Summary {
        let (newton_total, newton_max, newton_median) = newton_counts(&self.iterations);
        Summary {
            case: case.to_owned(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            status: match ending {
                Ending::Completed => Status::Completed,
                Ending::Stopped { .. } | Ending::Interrupted { .. } => Status::Stopped,
            },
            reason: ending.to_string(),
            increments: self.iterations.len(),
            cutbacks: self.cut_backs,
            newton_total,
            newton_max,
            newton_median,
            unknowns: self.unknowns,
            solver: self.solver.clone(),
            wall_s: seconds,
            peak_rss_mib: peak_rss_mib().map(|own| problem.share.largest(own)),
            pairs: pairs(problem, state).iter().map(pair_summary).collect(),
            ties: tie_summaries(problem, state),
            reactions: held_reactions(problem, state)
                .into_iter()
                .map(|(name, force)| (name, force.into()))
                .collect(),
            warnings: self
                .judgement
                .warnings(problem, ending)
                .into_iter()
                .map(WarningSummary::from)
                .chain(further)
                .collect(),
        }
    }

    fn note_work(&mut self, work: &LinearWork) {
        self.solver.method = work.method.to_string();
        self.solver.factorisations += work.factorisations;
        self.solver.contact_corrections += work.contact_corrections;
        self.solver.krylov_iterations += work.krylov_iterations;
        self.solver.assembly_s += work.times.assembly.as_secs_f64();
        self.solver.factorisation_s += work.times.factorisation.as_secs_f64();
        self.solver.solution_s += work.times.solution.as_secs_f64();
        self.solver.contact_s += work.times.contact.as_secs_f64();
        if let Some(reason) = work.fall_back {
            self.solver.fall_backs += 1;
            self.solver.reason = Some(reason.to_string());
        }
    }
}

fn tie_summaries(problem: &Problem, state: &State) -> Vec<TieSummary> {
    let found = ties(problem, state).into_iter();
    let found = found.zip(&problem.model.ties);
    found
        .map(|(report, model)| TieSummary {
            name: report.name,
            force_a: report.sides[0].force.into(),
            force_b: report.sides[1].force.into(),
            mismatch: report.mismatch,
            moment_mismatch: report.moment_mismatch,
            area: report.area,
            moved: model.moved,
        })
        .collect()
}

fn pair_summary(report: &PairReport) -> PairSummary {
    PairSummary {
        name: report.name.clone(),
        resultant_a: report.sides[0].force.into(),
        resultant_b: report.sides[1].force.into(),
        pressure_integral: report.sides[0].pressure,
        mismatch: report.mismatch,
        stick: report.stick,
        slip: report.slip,
        open: report.open,
        max_pressure: report.max_pressure,
        dissipated: report.dissipated,
    }
}
