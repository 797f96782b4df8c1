//! Checks of the history: balances of forces and energies.

use crate::scenes::{
    output::{Fields, History},
    scene::{End, Origin, Pair, Scene},
    vector::{Vector, length, plus},
};

use super::{Findings, balance, round_off};

/// Balance of the resultants of a pair.
const RESULTANTS: f64 = 1e-8;
/// Fall of the dissipation over the largest energy.
const DISSIPATION: f64 = 1e-9;
/// Balance of energies over the largest one.
const ENERGY: f64 = 1e-6;
/// Forces below this share of the largest of the run are none.
const NOTHING: f64 = 1e-12;
/// Forces over the largest of the run of pairs that are apart.
const APART: f64 = 1e-8;

/// Checks all rows.
pub fn check(findings: &mut Findings, scene: &Scene, history: &History) {
    findings.iterations = history
        .column("iterations")
        .iter()
        .map(|&n| n as usize)
        .collect();
    if history.len() == 0 {
        return;
    }
    ending(findings, scene, history);
    findings.touched = scene.pairs.iter().any(|pair| {
        let soft = pair.is_itself() || pair.sides.iter().all(|side| side.facets.is_some());
        soft && largest(pair, &sides(history, &pair.name)) > 0.0
    });
    for pair in &scene.pairs {
        resultants(findings, pair, history);
        let column = format!("pair.{}.dissipated", pair.name);
        dissipation(findings, scene, &column, history);
    }
    contact(findings, scene, history);
    dissipation(findings, scene, "energy.friction", history);
    energy(findings, scene, history);
    if !scene.is_dynamic() {
        for body in &scene.bodies {
            balance::check(findings, scene, body.name, history);
        }
    }
}

/// Checks that pairs with forces after an increment have fields.
pub fn fields(
    findings: &mut Findings,
    scene: &Scene,
    (history, increment): (&History, usize),
    fields: &Fields,
) {
    for (pair, grids) in scene.pairs.iter().zip(&fields.pairs) {
        let forces = sides(history, &pair.name);
        let presses = forces
            .get(increment - 1)
            .is_some_and(|of| of.size(pair) > 0.0);
        if presses && grids.iter().all(Option::is_none) {
            let place = || {
                format!(
                    "pair {} has no fields after increment {increment}",
                    pair.name
                )
            };
            findings.note("contact", f64::INFINITY, place);
        }
    }
}

fn ending(findings: &mut Findings, scene: &Scene, history: &History) {
    let last = history.number(history.len() - 1, "time").unwrap_or(0.0);
    let missing = (scene.end_time() - last) / (1e-9 * scene.end_time());
    findings.note("ending", missing, || {
        format!("time {last} of {}", scene.end_time())
    });
    let times = history.column("time");
    let backwards = times.windows(2).any(|pair| pair[1] <= pair[0]);
    if backwards {
        findings.note("ending", f64::INFINITY, || "time does not rise".into());
    }
}

/// Forces of a pair after an increment.
struct Forces {
    /// Resultants on both sides.
    resultants: [Vector; 2],
    /// Integral of pressure.
    pressed: f64,
}

impl Forces {
    /// Size of what the pair does: of a body and itself nothing is left of the resultants.
    fn size(&self, pair: &Pair) -> f64 {
        if pair.is_itself() {
            return self.pressed;
        }
        let [a, b] = self.resultants.map(length);
        a.max(b)
    }
}

/// Forces of a pair in all rows.
fn sides(history: &History, pair: &str) -> Vec<Forces> {
    let row = |row: usize| {
        let side = |letter| history.vector(row, &format!("pair.{pair}.resultant_{letter}"));
        let pressed = history.number(row, &format!("pair.{pair}.pressure_integral_a"));
        Some(Forces {
            resultants: [side("a")?, side("b")?],
            pressed: pressed.unwrap_or(f64::NAN),
        })
    };
    (0..history.len()).filter_map(row).collect()
}

fn largest(pair: &Pair, forces: &[Forces]) -> f64 {
    let all = forces.iter().map(|forces| forces.size(pair));
    all.fold(0.0, f64::max)
}

fn resultants(findings: &mut Findings, pair: &Pair, history: &History) {
    let name = &pair.name;
    let forces = sides(history, name);
    if forces.is_empty() {
        let place = || format!("pair {name} has no resultants");
        findings.note("resultants", f64::INFINITY, place);
        return;
    }
    let of_run = largest(pair, &forces);
    for (row, of_row) in forces.iter().enumerate() {
        let [a, b] = of_row.resultants;
        let larger = of_row.size(pair);
        let bound = RESULTANTS * larger + NOTHING * of_run;
        let off = length(plus(a, b));
        if bound > 0.0 {
            findings.note("resultants", off / bound, || {
                format!(
                    "pair {name}, increment {}: {off:.2e} of {larger:.2e}",
                    row + 1
                )
            });
        }
    }
}

/// Checks what must hold at the ends of the steps.
fn contact(findings: &mut Findings, scene: &Scene, history: &History) {
    for (index, step) in scene.steps.iter().enumerate() {
        let end = scene.end_of(index);
        let at_end = |&row: &usize| {
            history
                .number(row, "time")
                .is_some_and(|time| (time - end).abs() < 1e-9 * end)
        };
        let Some(row) = (0..history.len()).find(at_end) else {
            continue;
        };
        for pair in scene
            .pairs
            .iter()
            .filter(|pair| pair.origin == Origin::Scene)
        {
            let forces = sides(history, &pair.name);
            let (of_run, now) = (largest(pair, &forces), largest(pair, &forces[row..=row]));
            let place = |what: &str| {
                format!(
                    "pair {}, end of step {}: {what}, force {now:.2e}",
                    pair.name, step.name
                )
            };
            match step.end {
                End::Open => {}
                End::Met if of_run > 0.0 => findings.note("contact", 0.0, || place("met")),
                End::Met => findings.note("contact", f64::INFINITY, || place("never met")),
                End::Touching if now > 0.0 => findings.note("contact", 0.0, || place("touches")),
                End::Touching => {
                    findings.note("contact", f64::INFINITY, || place("does not touch"));
                }
                End::Apart if of_run > 0.0 => {
                    findings.note("contact", now / (APART * of_run), || place("apart"));
                }
                End::Apart => {}
            }
        }
    }
}

fn dissipation(findings: &mut Findings, scene: &Scene, column: &str, history: &History) {
    let values = history.column(column);
    let scale = energies(history);
    let bound = DISSIPATION * scale + round_off::of_energy(scene);
    let mut before = 0.0;
    for (row, value) in values.into_iter().enumerate() {
        let fall = before - value;
        if scale > 0.0 {
            findings.note("dissipation", fall / bound, || {
                format!("{column}, increment {}: falls by {fall:.2e}", row + 1)
            });
        }
        before = value;
    }
}

const ENERGIES: [&str; 9] = [
    "kinetic",
    "inelastic",
    "strain",
    "friction",
    "contact",
    "stabilisation",
    "numerical",
    "external",
    "actuation",
];

/// The largest energy of the run.
fn energies(history: &History) -> f64 {
    let columns = ENERGIES
        .iter()
        .map(|name| history.column(&format!("energy.{name}")));
    columns
        .flatten()
        .fold(0.0, |largest, value| value.abs().max(largest))
}

fn energy(findings: &mut Findings, scene: &Scene, history: &History) {
    let scale = energies(history);
    let bound = ENERGY * scale + round_off::of_energy(scene);
    if scale == 0.0 {
        return;
    }
    for row in 0..history.len() {
        let of = |name: &str| {
            let later = ["inelastic", "actuation"].contains(&name);
            let none = if later { 0.0 } else { f64::NAN };
            history
                .number(row, &format!("energy.{name}"))
                .unwrap_or(none)
        };
        let spent: f64 = ENERGIES[..7].iter().map(|name| of(name)).sum();
        let off = of("external") + of("actuation") - spent;
        findings.note("energy", off.abs() / bound, || {
            format!("increment {}: {off:.2e} of {scale:.2e}", row + 1)
        });
        findings.tell("contact energy", of("contact").abs() / scale);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenes::kinds::{Dialect, kind_of, scene};

    const NAMES: &str = "time,iterations,energy.kinetic,energy.strain,energy.friction,energy.contact,energy.stabilisation,\
                         energy.numerical,energy.external,pair.interface.dissipated,\
                         pair.interface.resultant_a.x,pair.interface.resultant_a.y,\
                         pair.interface.resultant_a.z,pair.interface.resultant_b.x,\
                         pair.interface.resultant_b.y,pair.interface.resultant_b.z,\
                         reaction.lower.zmin.x,reaction.lower.zmin.y,reaction.lower.zmin.z,\
                         reaction.upper.zmax.x,reaction.upper.zmax.y,reaction.upper.zmax.z";

    /// Scenes of the first kind, a press, with all ratios of stiffness.
    fn presses() -> impl Iterator<Item = Scene> {
        let seeds = (0..).filter(|&seed| kind_of(seed) == "press").take(20);
        let scenes = seeds.map(|seed| scene(seed, Dialect::default()));
        scenes.map(|mut scene| {
            scene.pairs[0].sides.sort_by_key(|side| side.owner);
            scene
        })
    }

    /// Checks that fail in a press whose rows are correct except for changes of one cell each.
    fn failed(changes: &[(usize, &str, &str)]) -> Vec<&'static str> {
        let scene = presses().next().unwrap();
        failed_in(&scene, 1.0, changes)
    }

    /// Checks that fail with forces and energies `scale` times as large.
    fn failed_in(scene: &Scene, scale: f64, changes: &[(usize, &str, &str)]) -> Vec<&'static str> {
        let names: Vec<&str> = NAMES.split(',').collect();
        let mut rows = [
            "0.5,4,0,1,0.5,0,0,0,1.5,0.5,0,0,-2,0,0,2,0,0,2,0,0,-2",
            "1,4,0,2,1,0,0,0,3,1,0,0,-4,0,0,4,0,0,4,0,0,-4",
        ]
        .map(|row| row.split(',').map(str::to_owned).collect::<Vec<_>>());
        for cell in rows.iter_mut().flat_map(|row| &mut row[2..]) {
            *cell = (scale * cell.parse::<f64>().unwrap()).to_string();
        }
        for (row, name, value) in changes {
            let column = names.iter().position(|found| found == name).unwrap();
            rows[*row][column] = (*value).to_owned();
        }
        let text = format!("{NAMES}\n{}\n{}\n", rows[0].join(","), rows[1].join(","));
        let mut findings = Findings::default();
        check(&mut findings, scene, &History::of(&text).unwrap());
        findings.failed().map(|(name, _)| name).collect()
    }

    #[test]
    fn a_good_history_passes() {
        assert!(failed(&[]).is_empty());
    }

    #[test]
    fn each_fault_fails_its_check() {
        assert_eq!(failed(&[(1, "time", "0.9")]), ["ending"]);
        assert_eq!(failed(&[(0, "reaction.upper.zmax.x", "1e-4")]), ["balance"]);
        assert_eq!(failed(&[(1, "energy.strain", "2.0001")]), ["energy"]);
        let b = "pair.interface.resultant_b.z";
        assert_eq!(failed(&[(1, b, "4.000001")]), ["resultants"]);
        let fall = [(1, "pair.interface.dissipated", "0.4")];
        assert_eq!(failed(&fall), ["dissipation"]);
        let all = ["pair.interface.resultant_a.z", b, "reaction.lower.zmin.z"];
        let none: Vec<_> = all.into_iter().chain(["reaction.upper.zmax.z"]).collect();
        let none: Vec<_> = none.into_iter().map(|name| (1, name, "0")).collect();
        assert_eq!(failed(&none), ["contact"]);
        assert_eq!(failed(&[(1, "energy.external", "NaN")]), ["energy"]);
    }

    #[test]
    fn roundings_are_not_held_against_each_other() {
        for scene in presses() {
            let force = 0.5 * round_off::of_force(&scene, "lower");
            let energy = 0.5 * round_off::of_energy(&scene);
            let changes = [
                (1, "reaction.lower.zmin.x", force.to_string()),
                (1, "energy.strain", energy.to_string()),
                (1, "pair.interface.dissipated", (-energy).to_string()),
            ];
            let changes = changes
                .each_ref()
                .map(|(row, name, value)| (*row, *name, &**value));
            assert_eq!(failed_in(&scene, 0.0, &changes), ["contact"]);
        }
    }

    #[test]
    fn a_tenthousandth_of_a_weak_press_is_found() {
        for scene in presses() {
            // A strain of one part in a thousand on one facet of the softest body.
            let softest = scene.bodies.iter().map(round_off::of_element);
            let press = 1e-3 * softest.fold(f64::INFINITY, f64::min);
            assert!(failed_in(&scene, 0.25 * press, &[]).is_empty());
            let wrong = (1e-4 * press).to_string();
            for name in ["reaction.upper.zmax.x", "reaction.lower.zmin.y"] {
                assert_eq!(
                    failed_in(&scene, 0.25 * press, &[(1, name, &wrong)]),
                    ["balance"]
                );
            }
            let wrong = (-press * 1.0001).to_string();
            let b = "pair.interface.resultant_a.z";
            let found = failed_in(&scene, 0.25 * press, &[(1, b, &wrong)]);
            assert_eq!(found, ["balance", "resultants"]);
        }
    }
}
