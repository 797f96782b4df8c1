//! Runs that continue from a checkpoint with other steps.
//!
//! The new deck has the same bodies, rigid surfaces and pairs, and begins with the steps that
//! the run has done. A step that the run stopped in may be stated otherwise: what was done of
//! it then counts as a step of its own, that ends where the run stopped,
//!
//! ```text
//! done:  press, slide up to the fraction f       new deck:  press, turn, lift
//! run:   press, slide (f of it), turn, lift      from `turn` on
//! ```
//!
//! and loads of that step stay as large as they were then. Where the new deck states it in
//! the same way, the run finishes it first.

use std::{
    path::{Path, PathBuf},
    sync::Arc,
};

use striae_deck::Setting;
use striae_model::{
    Actuation, BodyId, Curve, Gravity, Load, Model, NodalForce, RigidMotion, Step,
    plan::{PlannedActuation, PlannedForce, PlannedLoad, plans},
};
use striae_output::checkpoint::{Checkpoint, CheckpointError, Index, step_fingerprint};

use super::{Begun, Simulation, case_name, read_again, source};
use crate::{
    error::Error,
    ranks::{Ranks, agreed},
};

/// Fraction from which on a step is done.
const DONE: f64 = 1.0;

/// Point at which a run continues with the steps of another deck.
enum TakenUp {
    /// After so many steps.
    After(usize),
    /// Within a step that both decks have.
    Within,
}

impl Simulation {
    /// Continues from the checkpoint in a folder, of a run that was stopped or has completed, with
    /// the steps of another deck, whose bodies, rigid surfaces and pairs are the same and which
    /// begins with the steps that are done. Times and numbers of steps and increments continue;
    /// history and summary, written to `out`, are those of the further steps. That run can be
    /// resumed, unless it leaves a step that was under way.
    ///
    /// # Errors
    /// When there is no checkpoint, by name what differs between the decks, or all
    /// faults of the new one.
    pub fn resume_with(folder: &Path, deck: &Path, out: impl Into<PathBuf>) -> Result<Self, Error> {
        Self::resume_with_set(folder, deck, &[], out)
    }

    /// Goes on as [`Self::resume_with`], with numbers of the new deck set from outside.
    ///
    /// # Errors
    /// As [`Self::resume_with`], and where a setting is of no number of the deck.
    pub fn resume_with_set(
        folder: &Path,
        deck: &Path,
        settings: &[Setting],
        out: impl Into<PathBuf>,
    ) -> Result<Self, Error> {
        Self::branched(None, folder, (deck, settings), out.into())
    }

    /// Resumes on several ranks, for any number of ranks that wrote the checkpoint; collective.
    ///
    /// # Errors
    /// Returns the errors of [`Self::resume_with_set`], on all ranks.
    pub fn resume_with_on(
        ranks: Arc<dyn Ranks>,
        folder: &Path,
        deck: &Path,
        settings: &[Setting],
        out: impl Into<PathBuf>,
    ) -> Result<Self, Error> {
        Self::branched(Some(ranks), folder, (deck, settings), out.into())
    }

    fn branched(
        ranks: Option<Arc<dyn Ranks>>,
        folder: &Path,
        (path, settings): (&Path, &[Setting]),
        out: PathBuf,
    ) -> Result<Self, Error> {
        let read = || -> Result<_, Error> {
            let index = Index::read_last(folder)?;
            let mut deck = striae_deck::read_with(path, settings)?;
            index.source().check_parts(&deck.model)?;
            let own = source(case_name(path), (path, settings), &deck.model, &deck.output);
            let steps = deck.model.steps.len();
            let taken_up = continued(&mut deck.model, &index)?;
            let is_of_deck = deck.model.steps.len() == steps;
            Ok((index, deck, taken_up, is_of_deck.then_some(own)))
        };
        let (index, deck, taken_up, own) = agreed(ranks.as_ref(), read())?;
        let simulation = Self::of_on(ranks, deck)?;
        let Checkpoint { point, .. } = index.held(&simulation.problem)?;
        let mut simulation = simulation.recorded(out, case_name(path));
        simulation.begun = match taken_up {
            TakenUp::Within => Begun::Within(Box::new(point)),
            TakenUp::After(steps) => Begun::After(Box::new((steps, point.increments, point.state))),
        };
        Ok(match own {
            Some(own) => simulation.with_source(own),
            None => simulation,
        })
    }
}

/// Point at which a checkpoint continues with the steps of a model; the model gets the completed
/// part of a step that it states differently.
fn continued(model: &mut Model, index: &Index) -> Result<TakenUp, Error> {
    let (source, (under_way, fraction)) = (index.source(), index.reached());
    let is_done = fraction >= DONE;
    let done = under_way + usize::from(is_done);
    source.check_steps(model, done)?;
    if model.steps.len() == done {
        return Err(CheckpointError::NothingLeft.into());
    }
    if is_done {
        return Ok(TakenUp::After(done));
    }
    let (_, known) = &source.steps[under_way];
    if step_fingerprint(&model.steps[under_way]) == *known {
        return Ok(TakenUp::Within);
    }
    let old = read_again(source)?;
    source.check(&old.model, &old.output)?;
    let part = ended(&old.model, under_way, fraction);
    model.steps.insert(under_way, part);
    Ok(TakenUp::After(under_way + 1))
}

/// A step that ends at a fraction of itself, with the loads and the actuation it has there.
fn ended(model: &Model, index: usize, fraction: f64) -> Step {
    let step = &model.steps[index];
    let plan = &plans(model)[index];
    let moment = plan.start.later(fraction);
    let load = |load: &PlannedLoad| Load {
        set: load.set.clone(),
        body: load.body,
        faces: load.faces.clone(),
        kind: load.at(moment),
        extent: load.extent,
        curve: Curve::Ramp,
    };
    let force = |of: &PlannedForce| NodalForce {
        set: of.set.clone(),
        body: of.body,
        nodes: of.nodes.clone(),
        force: of.at(moment),
        curve: Curve::Ramp,
    };
    let actuation = |planned: &PlannedActuation| Actuation {
        body: BodyId(planned.body),
        section: Some(planned.section),
        kind: planned.at(moment),
        curve: Curve::Ramp,
    };
    let motion = |motion: &RigidMotion| {
        let [force, torque] = &plan.driving[motion.surface.0];
        RigidMotion {
            force: motion.force.map(|_| force.at(moment)),
            torque: motion.torque.map(|_| torque.at(moment)),
            ..motion.clone()
        }
    };
    Step {
        name: format!("{}, until it was stopped", step.name),
        duration: step.duration * fraction,
        gravity: step.gravity.as_ref().map(|_| Gravity {
            acceleration: plan.gravity.at(moment),
            curve: Curve::Ramp,
        }),
        loads: plan.loads.iter().map(load).collect(),
        forces: plan.forces.iter().map(force).collect(),
        actuations: plan.actuations.iter().map(actuation).collect(),
        rigid_motions: step.rigid_motions.iter().map(motion).collect(),
        ..step.clone()
    }
}
