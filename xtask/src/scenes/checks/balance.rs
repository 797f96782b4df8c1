//! Balance of forces on a body without inertia.

use std::collections::BTreeMap;

use crate::scenes::{
    output::History,
    scene::{Scene, Tie},
    vector::{Vector, length, plus, times},
};

use super::{Findings, round_off};

/// Balance of forces on a body.
const BALANCE: f64 = 1e-6;

/// Checks a body: reactions of its held sets, contact, ties, loads.
pub fn check(findings: &mut Findings, scene: &Scene, body: &str, history: &History) {
    let held = scene.held(body);
    let mut loads: BTreeMap<&str, Vector> = BTreeMap::new();
    let sum = |loads: &BTreeMap<&str, Vector>| loads.values().copied().fold([0.0; 3], plus);
    let mut load_steps = Vec::new();
    let mut start = 0.0;
    for step in &scene.steps {
        let duration = step.duration.unwrap_or(1.0);
        let from = sum(&loads);
        for (_, facets, traction, area) in step.tractions.iter().filter(|t| t.0 == body) {
            let force = scene.placement.direction(times(*area, *traction));
            loads.insert(*facets, force);
        }
        load_steps.push((start, duration, from, sum(&loads)));
        start += duration;
    }
    let load = |time: f64| {
        let reached = load_steps.iter().rev().find(|step| time > step.0 - 1e-12);
        reached.map_or([0.0; 3], |(start, duration, from, to)| {
            let share = (time - start) / duration;
            plus(times(1.0 - share, *from), times(share, *to))
        })
    };
    let forces = |row: usize| {
        let sets = held.iter().map(|(set, components)| {
            let force = history.vector(row, &format!("reaction.{body}.{set}"));
            let force = force.unwrap_or([f64::NAN; 3]);
            [0, 1, 2].map(|i| if components[i] { force[i] } else { 0.0 })
        });
        let contact = scene.pairs.iter().flat_map(|pair| {
            let sides = pair.sides.iter().zip(["a", "b"]);
            let own = sides.filter(|(side, _)| side.owner == body);
            own.map(|(_, letter)| format!("pair.{}.resultant_{letter}", pair.name))
        });
        let ties = scene.ties.iter();
        let of_tie = |tie: &Tie| {
            let force = history.vector(row, &format!("tie.{}.force_a", tie.name));
            let force = force.unwrap_or([f64::NAN; 3]);
            let sides = tie.sides.iter().zip([1.0, -1.0]);
            let own = sides.filter(|(side, _)| side.0 == body);
            own.map(|(_, sign)| times(sign, force)).fold([0.0; 3], plus)
        };
        let tied: Vec<Vector> = ties.map(of_tie).collect();
        let found = contact.map(|name| history.vector(row, &name));
        let mut all: Vec<Vector> = found.map(|force| force.unwrap_or([f64::NAN; 3])).collect();
        all.extend(sets);
        all.extend(tied);
        all.push(load(history.number(row, "time").unwrap_or(0.0)));
        all
    };
    let of_run = (0..history.len())
        .flat_map(forces)
        .map(length)
        .fold(0.0, f64::max);
    for row in 0..history.len() {
        let off = length(forces(row).into_iter().fold([0.0; 3], plus));
        let bound = BALANCE * of_run + round_off::of_force(scene, body);
        if off.is_nan() || of_run > 0.0 {
            findings.note("balance", off / bound, || {
                format!(
                    "body {body}, increment {}: {off:.2e} of {of_run:.2e}",
                    row + 1
                )
            });
        }
    }
}
