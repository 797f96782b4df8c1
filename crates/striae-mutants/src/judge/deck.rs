//! Decks: from the text to the first increment.

use std::path::Path;

use striae::{
    Converged, Error, Next, Observer, Simulation,
    advice::{Advice, Remark, Topic},
    deck::{Deck, Faults, parse, read},
    model::Model,
    solve::{
        drive::Progress,
        outcome::{CutBack, Ending},
    },
};

use super::{Depth, Finding, Kind, Reached, failed, worded};
use crate::target::Sample;

/// Nodes up to which a deck is run.
const RUN: usize = 400;

/// Reads, checks and begins to run a deck.
pub(super) fn deck(sample: &Sample, folder: &Path, depth: Depth) -> Result<Reached, Finding> {
    let read = match std::str::from_utf8(&sample.bytes) {
        Ok(text) => parse(text, "deck.toml", &sample.base),
        Err(_) => {
            let path = folder.join("deck.toml");
            std::fs::write(&path, &sample.bytes).expect("a file of a new folder");
            read(&path)
        }
    };
    match read {
        Err(faults) => placed(&faults),
        Ok(deck) => accepted(deck, depth),
    }
}

/// Reads a deck that is made for a file.
pub(super) fn around(text: &str, base: &Path, depth: Depth) -> Result<Reached, Finding> {
    match parse(text, "deck.toml", base) {
        Err(faults) => placed(&faults),
        Ok(deck) => accepted(deck, depth),
    }
}

fn placed(faults: &Faults) -> Result<Reached, Finding> {
    for fault in faults.iter() {
        let message = fault.to_string();
        if fault.position.is_none() {
            return failed(Kind::NoPlace, message);
        }
        worded(&message)?;
    }
    Ok(Reached::Refused)
}

fn accepted(deck: Deck, depth: Depth) -> Result<Reached, Finding> {
    let advice = Advice::of(&deck.model);
    if let Some(fault) = advice.faults.first() {
        return failed(Kind::NoPlace, format!("late fault: {fault}"));
    }
    for remark in advice.warnings.iter().chain(&advice.notes) {
        named(remark)?;
    }
    let small = nodes(&deck.model) <= RUN;
    let deck = match deck.alone() {
        Ok(deck) => deck,
        Err(faults) => return placed(&faults),
    };
    match Simulation::of(deck) {
        Err(Error::Memory { .. }) => Ok(Reached::Refused),
        Err(error) => failed(Kind::Disagreement, error.to_string()),
        Ok(simulation) if depth == Depth::Run && small => begun(simulation),
        Ok(_) => Ok(Reached::Accepted),
    }
}

fn named(remark: &Remark) -> Result<(), Finding> {
    match remark.name.is_none() && remark.topic != Topic::Cost {
        true => failed(Kind::NoPlace, remark.to_string()),
        false => worded(&remark.to_string()),
    }
}

fn nodes(model: &Model) -> usize {
    model.bodies.iter().map(|of| of.mesh.positions.len()).sum()
}

fn begun(simulation: Simulation) -> Result<Reached, Finding> {
    match simulation.run_with(&mut First::default()) {
        Err(error) => failed(Kind::Disagreement, error.to_string()),
        Ok(finished) => {
            if let Ending::Stopped { .. } = &finished.ending {
                worded(&finished.ending.to_string())?;
            }
            for warning in &finished.summary.warnings {
                worded(&warning.text)?;
            }
            Ok(Reached::Run)
        }
    }
}

/// Stops a run after its first increment, or some attempts at it.
#[derive(Default)]
struct First {
    cut_backs: usize,
}

impl Observer for First {
    fn increment(&mut self, _converged: &Converged<'_>) -> Next {
        Next::Stop
    }

    fn cut_back(&mut self, _progress: Progress, _reason: &CutBack) -> Next {
        self.cut_backs += 1;
        match self.cut_backs < 4 {
            true => Next::Continue,
            false => Next::Stop,
        }
    }
}
