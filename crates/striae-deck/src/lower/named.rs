//! Locations of the named parts of a deck.

use super::list;
use crate::{
    faults::{FaultList, Location},
    places::{Part, Places},
    raw,
    read::At,
    value::Text,
};

/// Places of the names of all parts.
pub(super) fn places(raw: &raw::Simulation, faults: &FaultList<'_>) -> Places {
    let bodies = list(&raw.body).iter().map(|at| at.value.name.as_ref());
    let rigid = list(&raw.rigid).iter().map(|at| at.value.name.as_ref());
    let pairs = list(&raw.pair).iter().map(|at| at.value.name.as_ref());
    let ties = list(&raw.tie).iter().map(|at| at.value.name.as_ref());
    let springs = list(&raw.spring).iter().map(|at| at.value.name.as_ref());
    let cavities = list(&raw.cavity).iter().map(|at| at.value.name.as_ref());
    let steps = list(&raw.step).iter().map(|at| at.value.name.as_ref());
    let of = |part: Part, names: Vec<Option<&At<Text>>>| -> Vec<(Part, String, Location)> {
        let names = names.into_iter().flatten();
        let placed = names.map(|at| (part, at.value.0.clone(), faults.location(&at.span)));
        placed.collect()
    };
    let all = [
        of(Part::Body, bodies.collect()),
        of(Part::Rigid, rigid.collect()),
        of(Part::Pair, pairs.collect()),
        of(Part::Tie, ties.collect()),
        of(Part::Spring, springs.collect()),
        of(Part::Cavity, cavities.collect()),
        of(Part::Step, steps.collect()),
    ];
    Places::new(all.into_iter().flatten())
}
