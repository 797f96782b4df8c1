//! Runs that continue from a checkpoint with the steps of another deck.

use std::{fs, path::Path};

use striae::{Converged, Interrupt, Next, Observer, prelude::*};

const PARTS: &str = r#"
title = "A block pressed on a floor and drawn over it"

[[material]]
name = "solid"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3

[[body]]
name = "block"
material = "solid"
mesh = { generator = "block", size = [1, 1, 0.5], divisions = [2, 2, 2] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.2 }
"#;

const PRESS: &str = r#"
[[step]]
name = "press"
increments = 2
displacement = [
    { body = "block", nodes = "all", x = 0, y = 0 },
    { body = "block", nodes = "zmax", z = -0.02 },
]
"#;

const DRAW: &str = r#"
[[step]]
name = "draw"
increments = 4
displacement = [{ body = "block", nodes = "zmax", x = 0.1 }]
pressure = [{ body = "block", facets = "xmax", value = 8 }]
"#;

const TURN: &str = r#"
[[step]]
name = "turn"
increments = 4
displacement = [{ body = "block", nodes = "zmax", y = 0.1 }]
"#;

/// Stops after so many increments.
struct After(usize);

impl Observer for After {
    fn increment(&mut self, converged: &Converged<'_>) -> Next {
        match converged.progress.increment == self.0 {
            true => Next::Stop,
            false => Next::Continue,
        }
    }
}

fn written(folder: &Path, name: &str, steps: &[&str]) -> std::path::PathBuf {
    let path = folder.join(name);
    fs::write(&path, format!("{PARTS}{}", steps.concat())).unwrap();
    path
}

fn run(folder: &Path, steps: &[&str], increments: usize) -> std::path::PathBuf {
    let deck = written(folder, "old.toml", steps);
    let out = folder.join("old");
    let simulation = Simulation::open(&deck, &out).unwrap();
    simulation
        .until(&Interrupt::default())
        .run_with(&mut After(increments))
        .unwrap();
    out
}

fn positions(finished: &striae::Finished) -> Vec<Vec3> {
    finished.results().positions("block").unwrap().to_vec()
}

fn assert_same(one: &[Vec3], other: &[Vec3], tolerance: f64) {
    for (one, other) in one.iter().zip(other) {
        assert!((one - other).norm() < tolerance, "{one:?} {other:?}");
    }
}

#[test]
fn a_completed_run_goes_on_as_if_all_steps_had_been_in_its_deck() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = run(folder, &[PRESS, DRAW], 0);
    assert!(!old.join("checkpoint.bin").exists() && old.join("end.bin").exists());
    let deck = written(folder, "new.toml", &[PRESS, DRAW, TURN]);
    let further = Simulation::resume_with(&old, &deck, folder.join("new")).unwrap();
    let further = further.run().unwrap();
    let whole = Simulation::open(&deck, folder.join("whole"))
        .unwrap()
        .run()
        .unwrap();
    assert_eq!(
        (further.ending.clone(), further.increments),
        (Ending::Completed, whole.increments)
    );
    assert_eq!(further.history.rows.len(), 4);
    assert_eq!(further.state.time, whole.state.time);
    assert_same(&positions(&further), &positions(&whole), 1e-9);
}

#[test]
fn a_step_under_way_is_finished_if_it_is_stated_again() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = run(folder, &[PRESS, DRAW], 4);
    let deck = written(folder, "new.toml", &[PRESS, DRAW, TURN]);
    let new = folder.join("new");
    let further = Simulation::resume_with(&old, &deck, &new).unwrap();
    // Stopped again, and resumed in its own folder.
    further.run_with(&mut After(7)).unwrap();
    let further = Simulation::resume(&new).unwrap().run().unwrap();
    let whole = Simulation::open(&deck, folder.join("whole"))
        .unwrap()
        .run()
        .unwrap();
    assert_eq!(further.increments, whole.increments);
    assert_same(&positions(&further), &positions(&whole), 1e-9);
}

#[test]
fn a_step_under_way_is_left_with_the_loads_it_has() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = run(folder, &[PRESS, DRAW], 4);
    let hold = "[[step]]\nname = \"hold\"\nincrements = 1\n";
    let deck = written(folder, "new.toml", &[PRESS, hold]);
    let further = Simulation::resume_with(&old, &deck, folder.join("new")).unwrap();
    let held = further.run().unwrap();
    assert_eq!(
        (held.ending.clone(), held.increments),
        (Ending::Completed, 5)
    );
    assert!((held.state.time - 2.5).abs() < 1e-12);
    // Half the way and half the pressure: the state does not change.
    let mut at_stop = Vec::new();
    struct Taken<'a>(&'a mut Vec<Vec3>);
    impl Observer for Taken<'_> {
        fn increment(&mut self, converged: &Converged<'_>) -> Next {
            *self.0 = converged.results.positions("block").unwrap().to_vec();
            After(4).increment(converged)
        }
    }
    let again = Simulation::open(&folder.join("old.toml"), folder.join("again")).unwrap();
    again.run_with(&mut Taken(&mut at_stop)).unwrap();
    assert_same(&positions(&held), &at_stop, 1e-9);
}

#[test]
fn what_differs_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let old = run(folder, &[PRESS, DRAW], 0);
    for (text, words) in [
        (
            format!(
                "{}{PRESS}{DRAW}{TURN}",
                PARTS.replace("youngs_modulus = 1000", "youngs_modulus = 1001")
            ),
            "body `block` is not the same",
        ),
        (
            format!(
                "{}{PRESS}{DRAW}{TURN}",
                PARTS.replace("mu = 0.2", "mu = 0.3")
            ),
            "pair `sole` is not the same",
        ),
        (
            format!(
                "{}{PRESS}{DRAW}{TURN}",
                PARTS.replace("[0, 0, 0], normal", "[0, 1, 0], normal")
            ),
            "rigid surface `floor` is not the same",
        ),
        (
            format!("{PARTS}{}{DRAW}{TURN}", PRESS.replace("-0.02", "-0.03")),
            "step `press` is completed",
        ),
        (format!("{PARTS}{PRESS}{TURN}"), "step `draw` is completed"),
        (
            format!("{PARTS}{PRESS}{DRAW}"),
            "no step after the completed ones",
        ),
    ] {
        let deck = folder.join("new.toml");
        fs::write(&deck, text).unwrap();
        let refused = Simulation::resume_with(&old, &deck, folder.join("new")).unwrap_err();
        assert!(refused.to_string().contains(words), "{refused}");
    }
}
