//! Runs that go on from a checkpoint with other steps.
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

use std::path::{Path, PathBuf};

use striae_deck::Deck;
use striae_output::checkpoint::{Checkpoint, CheckpointError, Source, step_fingerprint};
use striae_solve::{
    drive::Point,
    model::{Curve, Gravity, Load, Model, RigidMotion, Step},
    plan::{PlannedLoad, plans},
};

use super::{Begun, Simulation, case_name};
use crate::error::Error;

/// Fraction from which on a step is done.
const DONE: f64 = 1.0;

impl Simulation {
    /// Goes on from the checkpoint in a folder, of a run that was stopped or has
    /// completed, with the steps of another deck, whose bodies, rigid surfaces and pairs are the same and
    /// which begins with the steps that are done. Times and numbers of steps and increments
    /// go on; history and summary, written to `out`, are those of the further steps. That run
    /// can be resumed, unless it leaves a step that was under way.
    ///
    /// # Errors
    /// When there is no checkpoint, by name what differs between the decks, or all
    /// faults of the new one.
    pub fn resume_with(folder: &Path, deck: &Path, out: impl Into<PathBuf>) -> Result<Self, Error> {
        let Checkpoint { source, point, .. } = Checkpoint::read_last(folder)?;
        let Deck { model, output, .. } = striae_deck::read(deck)?;
        source.check_parts(&model)?;
        let steps = model.steps.len();
        let (model, begun) = continued(model, &source, point)?;
        let is_of_deck = model.steps.len() == steps;
        let mut simulation = Self::new(model)?.writing(output);
        simulation.begun = begun;
        Ok(match is_of_deck {
            true => simulation.resumable(out, case_name(deck), deck),
            false => simulation.recorded(out, case_name(deck)),
        })
    }
}

/// The model with all steps, those done first, and where it begins.
fn continued(mut model: Model, source: &Source, point: Point) -> Result<(Model, Begun), Error> {
    let under_way = point.step;
    let is_done = point.fraction >= DONE;
    let done = under_way + usize::from(is_done);
    source.check_steps(&model, done)?;
    if model.steps.len() == done {
        return Err(CheckpointError::NothingLeft.into());
    }
    let increments = point.increments;
    if is_done {
        let begun = Begun::After(Box::new((done, increments, point.state)));
        return Ok((model, begun));
    }
    let (_, known) = &source.steps[under_way];
    if step_fingerprint(&model.steps[under_way]) == *known {
        return Ok((model, Begun::Within(Box::new(point))));
    }
    let old = striae_deck::read(&source.path)?;
    source.check(&old.model, &old.output)?;
    let part = ended(&old.model, under_way, point.fraction);
    model.steps.insert(under_way, part);
    let begun = Begun::After(Box::new((under_way + 1, increments, point.state)));
    Ok((model, begun))
}

/// A step that ends at a fraction of itself, with the loads it has there.
fn ended(model: &Model, index: usize, fraction: f64) -> Step {
    let step = &model.steps[index];
    let plan = &plans(model)[index];
    let load = |load: &PlannedLoad| Load {
        set: load.set.clone(),
        body: load.body,
        faces: load.faces.clone(),
        kind: load.at(fraction),
        extent: load.extent,
        curve: Curve::Ramp,
    };
    let motion = |motion: &RigidMotion| {
        let [force, torque] = &plan.driving[motion.surface.0];
        RigidMotion {
            force: motion.force.map(|_| force.at(fraction)),
            torque: motion.torque.map(|_| torque.at(fraction)),
            ..motion.clone()
        }
    };
    Step {
        name: format!("{}, until it was stopped", step.name),
        duration: step.duration * fraction,
        gravity: step.gravity.as_ref().map(|_| Gravity {
            acceleration: plan.gravity.at(fraction),
            curve: Curve::Ramp,
        }),
        loads: plan.loads.iter().map(load).collect(),
        rigid_motions: step.rigid_motions.iter().map(motion).collect(),
        ..step.clone()
    }
}
