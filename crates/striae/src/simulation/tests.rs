//! Runs that are stopped after every single attempt give the files of those that are not.

use std::{collections::BTreeMap, fs, path::PathBuf};

use serde_json::Value;
use striae_deck::{Laws, Reader};
use striae_declared::{Declared, NO_UNIT, POSITIVE, Parameter};
use striae_law::friction::{FactorLane, FactorLaw, FactorPoint, FactorRange, Friction, OwnFactor};
use striae_output::{Existing, recorder::Recorder};

use super::*;

/// Textured blocks pressed and slid back and forth; some increments of every slide are cut.
const QUASI_STATIC: &str = include_str!("tests/quasi-static.toml");
/// A block on a tied plate, pressed, then slid with inertia.
const DYNAMIC: &str = include_str!("tests/dynamic.toml");
/// A block whose factors outlast increments, most of its contact nodes idle.
const KEPT: &str = include_str!("tests/kept.toml");
/// A free rigid body whose contact with a block starts on the way.
const PUSHED: &str = include_str!("tests/pushed.toml");

fn read(text: &str) -> Deck {
    striae_deck::parse(text, "deck.toml", Path::new("")).unwrap()
}

/// An interrupt that has come already: the run ends after its first attempt.
fn at_once() -> Interrupt {
    let interrupt = Interrupt::default();
    interrupt.set();
    interrupt
}

fn begun(deck: &Deck, folder: &Path) -> Simulation {
    let simulation = Simulation::of(deck.clone()).unwrap();
    let simulation = simulation.resumable(folder, "case", Path::new("deck.toml"));
    simulation.over(Existing::Replace)
}

/// Every file of a run but its summary and checkpoint.
fn files(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let lists = [folder.to_owned(), folder.join("fields")].map(|place| {
        let entries = fs::read_dir(place).unwrap();
        entries.map(|entry| entry.unwrap().path())
    });
    let named = |path: &PathBuf| path.extension().is_some_and(|ending| ending != "json");
    let paths = lists.into_iter().flatten().filter(named);
    paths
        .map(|path| {
            let content = fs::read(&path).unwrap();
            (path.strip_prefix(folder).unwrap().to_owned(), content)
        })
        .collect()
}

/// `summary.json` without what depends on the clock and on the machine.
fn summary(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("summary.json")).unwrap();
    let mut summary: Value = serde_json::from_str(&text).unwrap();
    let object = summary.as_object_mut().unwrap();
    assert!(object.remove("wall_s").is_some() && object.remove("peak_rss_mib").is_some());
    let solver = object["solver"].as_object_mut().unwrap();
    solver.retain(|key, _| !key.ends_with("_s"));
    summary
}

/// Runs a deck in one piece and in pieces of one attempt each; returns its summary.
fn assert_same_in_pieces(text: &str, least: usize) -> Value {
    assert_same_deck_in_pieces(&read(text), least)
}

fn assert_same_deck_in_pieces(deck: &Deck, least: usize) -> Value {
    let place = tempfile::tempdir().unwrap();
    let [whole, pieces] = ["whole", "pieces"].map(|name| place.path().join(name));
    begun(deck, &whole).run().unwrap();
    let mut ending = begun(deck, &pieces).until(&at_once()).run().unwrap().ending;
    let mut stops = 0;
    while let Ending::Interrupted { .. } = ending {
        stops += 1;
        let checkpoint = Checkpoint::read(&pieces).unwrap();
        let resumed = Simulation::resume_from(deck.clone(), checkpoint, &pieces).unwrap();
        ending = resumed.until(&at_once()).run().unwrap().ending;
    }
    assert_eq!(ending, Ending::Completed);
    assert!(stops >= least, "{stops} stops");
    let summaries = [&whole, &pieces].map(|folder| summary(folder));
    assert_eq!(summaries[0], summaries[1]);
    let (whole, pieces) = (files(&whole), files(&pieces));
    assert!(whole.keys().eq(pieces.keys()), "{:?}", pieces.keys());
    for (path, content) in whole {
        assert!(pieces[&path] == content, "{} differs", path.display());
    }
    let [summary, _] = summaries;
    summary
}

#[test]
fn a_quasi_static_run_is_the_same_in_pieces() {
    assert_same_in_pieces(QUASI_STATIC, 10);
}

#[test]
fn a_run_of_bodies_that_remember_is_the_same_in_pieces() {
    let rubber = "law = \"neo-hookean\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\n";
    let relaxing = "law = \"yeoh\"\nc10 = 1e5\nc20 = 0\nc30 = 0\npoissons_ratio = 0.4\n\
                    relaxation = [{ ratio = 1, time = 0.5 }]\n\
                    [[material]]\nname = \"metal\"\nlaw = \"elastic-plastic\"\n\
                    youngs_modulus = 1e6\npoissons_ratio = 0.3\nyield_stress = 2e4\n";
    let upper = "name = \"upper\"\nmaterial = \"rubber\"";
    let text = QUASI_STATIC.replace(rubber, relaxing);
    let text = text.replace(upper, "name = \"upper\"\nmaterial = \"metal\"");
    assert_same_in_pieces(&text, 10);
    let other = read(&text.replace("time = 0.5", "time = 0.4"));
    let place = tempfile::tempdir().unwrap();
    let deck = read(&text);
    begun(&deck, place.path()).until(&at_once()).run().unwrap();
    let checkpoint = Checkpoint::read(place.path()).unwrap();
    assert!(Simulation::resume_from(other, checkpoint.clone(), place.path()).is_err());
    let mut short = checkpoint;
    short.point.state.histories[1].pop();
    let refused = Simulation::resume_from(deck, short, place.path()).unwrap_err();
    assert!(refused.to_string().contains("is damaged"), "{refused}");
}

#[test]
fn a_run_of_sides_that_wear_is_the_same_in_pieces() {
    let pair = "name = \"interface\"\n";
    let text = QUASI_STATIC.replace(pair, &format!("{pair}wear = {{ a = 2e-7, b = 1e-7 }}\n"));
    assert_ne!(text, QUASI_STATIC);
    assert_same_in_pieces(&text, 10);
}

/// The quasi-static deck with other friction.
fn with_friction(friction: &str) -> String {
    let before = "law = \"orthotropic\", mu_along = 0.2, mu_across = 0.4";
    assert!(QUASI_STATIC.contains(before));
    QUASI_STATIC.replace(before, friction)
}

#[test]
fn runs_with_a_state_of_friction_are_the_same_in_pieces() {
    let law = "law = \"orthotropic\", mu_along = 0.2, mu_across = 0.4";
    for by_state in [
        "form = \"ageing-law\", direct_effect = 0.02, evolution_effect = 0.015, \
         slip_rate = 0.1, slip_distance = 0.03",
        "form = \"static-kinetic\", kinetic_over_static = 0.8, slip_distance = 0.05, \
         healing_time = 1",
        "form = \"logarithmic-healing\", factor = 0.1, slip_distance = 0.05, healing_time = 0.1",
    ] {
        let text = with_friction(&format!("{law}, by_state = {{ {by_state} }}"));
        let summary = assert_same_in_pieces(&text, 4);
        assert!(summary["increments"].as_u64().unwrap() > 5);
    }
}

/// A film that builds up with the time in contact and wears off with slip.
#[derive(Debug)]
struct Film;

impl FactorLaw for Film {
    fn name(&self) -> &str {
        "film"
    }

    fn range(&self) -> FactorRange {
        FactorRange {
            pressure: 1e6,
            ..FactorRange::default()
        }
    }

    fn initial_state(&self) -> Vec<f64> {
        vec![0.0, 0.5]
    }

    fn state_after(&self, at: &FactorPoint, before: &[f64]) -> Vec<FactorLane> {
        let formed = at.elapsed / 0.7;
        let film = (FactorLane::from(formed + before[0])) / (at.slip() / 0.2 + (1.0 + formed));
        vec![film, at.slip() * 0.1 + before[1]]
    }

    fn factor(&self, at: &FactorPoint, state: &[FactorLane]) -> FactorLane {
        (state[0] * 0.2 + 1.0) * (state[1] * 0.1 + 0.95 + 0.01 * at.time)
    }
}

static FILM: Declared<Friction> = Declared {
    name: "film",
    summary: "Coulomb friction under a film.",
    parameters: &[Parameter::number("mu", POSITIVE, NO_UNIT, "Coefficient.")],
    build: |values| {
        let factor = OwnFactor::of(Film)?;
        Friction::coulomb(values.number("mu"))?.with_factor(factor)
    },
    fit: None,
};

#[test]
fn a_run_with_a_state_of_ones_own_is_the_same_in_pieces() {
    let laws = Laws::default().with_friction(&FILM);
    let text = with_friction("law = \"film\", mu = 0.3");
    let deck = Reader::new(&laws, &[]).parse(&text, "deck.toml", Path::new(""));
    assert_same_deck_in_pieces(&deck.unwrap(), 4);
}

#[test]
fn a_run_on_older_factors_is_the_same_in_pieces() {
    let summary = assert_same_in_pieces(KEPT, 5);
    let count = |of: &Value| of.as_u64().unwrap();
    assert!(count(&summary["solver"]["factorisations"]) < count(&summary["increments"]));
}

#[test]
fn a_run_of_the_iterative_solver_is_the_same_in_pieces() {
    let text = KEPT.replace("element_size = 0.6", "element_size = 1");
    let summary = assert_same_in_pieces(&(text + "[solver]\nbackend = \"iterative\"\n"), 5);
    assert_eq!(summary["solver"]["method"], "iterative");
}

#[test]
fn a_dynamic_run_is_the_same_in_pieces() {
    assert_same_in_pieces(DYNAMIC, 10);
}

#[test]
fn a_run_of_bodies_that_move_themselves_is_the_same_in_pieces() {
    let pull = "actuation = [{ body = \"lower\", tension = 1e4, along = [1, 0, 0] }]\n";
    let swell = "actuation = [{ body = \"upper\", stretch = 0.05, curve = \"smooth\" }]\n";
    let press = "increments = 2\n";
    let slide = "increments = 10\n";
    let text = DYNAMIC.replace(press, &format!("{press}{pull}"));
    let text = text.replace(slide, &format!("{slide}{swell}"));
    assert_same_in_pieces(&text, 10);
}

#[test]
fn a_run_with_nodes_in_axes_of_their_own_is_the_same_in_pieces() {
    let upper = "{ body = \"upper\", nodes = \"zmax\",";
    let lower = "{ body = \"lower\", nodes = \"zmin\",";
    for (text, stated) in [(QUASI_STATIC, upper), (DYNAMIC, lower)] {
        assert!(text.contains(stated), "{text}");
        let axes = format!("{stated} axes = [[1, 0.1, 0], [0, 1, 0.05]],");
        assert_same_in_pieces(&text.replace(stated, &axes), 10);
    }
}

#[test]
fn a_run_with_a_pushed_body_is_the_same_in_pieces() {
    assert_same_in_pieces(PUSHED, 20);
}

#[test]
fn checkpoints_come_when_they_are_due_and_go_when_the_run_is_done() {
    let place = tempfile::tempdir().unwrap();
    let deck = read(DYNAMIC);
    let recorder =
        Recorder::create(place.path(), "case", deck.output.clone(), Existing::Keep).unwrap();
    let due: Vec<usize> = (1..=8).filter(|&count| recorder.keeps(count)).collect();
    assert_eq!(due, [3, 6]);
    drop(recorder);
    begun(&deck, place.path()).until(&at_once()).run().unwrap();
    assert!(Checkpoint::read(place.path()).is_ok());
    let run = begun(&deck, place.path()).run();
    assert_eq!(run.unwrap().ending, Ending::Completed);
    assert!(Checkpoint::read(place.path()).is_err());
}

/// Two resume one run: the one that comes second does not repeat what the first has completed.
#[test]
fn a_run_that_has_gone_on_since_its_checkpoint_was_read_is_left_alone() {
    let place = tempfile::tempdir().unwrap();
    let (deck, folder) = (read(QUASI_STATIC), place.path());
    begun(&deck, folder).until(&at_once()).run().unwrap();
    let resumed = || {
        let checkpoint = Checkpoint::read(folder).unwrap();
        Simulation::resume_from(deck.clone(), checkpoint, folder).unwrap()
    };
    let (first, second) = (resumed(), resumed());
    first.run().unwrap();
    let before = files(folder);
    let refused = second.run().unwrap_err().to_string();
    assert!(refused.contains("has been written to since"), "{refused}");
    assert!(files(folder) == before);
}
