//! `cargo xtask report-test`: reports in a real browser.
//!
//! Runs small decks with the program, makes their reports, opens them from disk in headless
//! Chromium and uses them as a person would: checks that there is no error on the console, no
//! request other than for the page itself, a picture that is not blank, slider, field, arrows and
//! cut that change it, and a legend with the extremes of the VTU files. Pictures are kept in
//! `target/report` to be looked at.
//!
//! Chromium is Debian's package `chromium`, or what `CHROMIUM` names; `.ci/run` installs it. The
//! browser is driven by its protocol over pipes: messages in JSON, ended by a zero byte.

mod chromium;
mod picture;
mod use_it;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    time::Instant,
};

use crate::{
    cargo,
    decks::{BLOCKS, Grooved, Pad},
    fault::Fault,
};
use chromium::Chromium;

/// A pad on a grooved floor.
const PAD: Pad = Pad {
    divisions: [8, 8, 3],
    grooved: Grooved::Floor,
    increments: [2, 4],
    way: 0.4,
    output: "",
};

/// Tests reports in a browser.
///
/// # Errors
/// When the program or the browser cannot be had, or a report does not do what it should.
pub fn report_test() -> Result<(), Fault> {
    let started = Instant::now();
    let program = fs::canonicalize(cargo::program()?).map_err(unusable("the program"))?;
    let folder = PathBuf::from("target/report");
    fs::create_dir_all(&folder).map_err(unusable("target/report"))?;
    let folder = fs::canonicalize(&folder).map_err(unusable("target/report"))?;
    let mut browser = Chromium::start()?;
    let everything = template(&program, &folder.join("everything"))?;
    for (name, deck) in [
        ("pad", PAD.deck()),
        ("blocks", BLOCKS.to_owned()),
        // Its skin would hide what touches below.
        ("everything", everything),
    ] {
        let path = folder.join(name).with_extension("toml");
        fs::write(&path, deck).map_err(unusable("a deck"))?;
        let results = folder.join(name);
        if results.exists() {
            fs::remove_dir_all(&results).map_err(unusable("old results"))?;
        }
        let command = Command::new(&program)
            .arg("run")
            .arg(&path)
            .args(["--quiet", "--report", "--out"])
            .arg(&results)
            .output()
            .map_err(unusable("the program"))?;
        if !command.status.success() {
            let said = String::from_utf8_lossy(&command.stderr).into_owned();
            return Err(Fault::Browser(format!("{name}: {said}")));
        }
        let faults = use_it::tried(&mut browser, &results, &folder.join(name))?;
        if !faults.is_empty() {
            return Err(Fault::Browser(format!("{name}: {}", faults.join("\n"))));
        }
        println!("report of {name}: all well");
    }
    println!("reports tested in {:.0} s", started.elapsed().as_secs_f64());
    Ok(())
}

/// The deck of the template `pad`, in which all may touch.
fn template(program: &Path, folder: &Path) -> Result<String, Fault> {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(unusable("an old deck"))?;
    }
    let made = Command::new(program)
        .args(["new", "--template", "pad"])
        .arg(folder)
        .output()
        .map_err(unusable("the program"))?;
    if !made.status.success() {
        let said = String::from_utf8_lossy(&made.stderr).into_owned();
        return Err(Fault::Browser(said));
    }
    fs::read_to_string(folder.join("deck.toml")).map_err(unusable("a deck"))
}

fn unusable(what: &str) -> impl Fn(std::io::Error) -> Fault {
    move |cause| Fault::Browser(format!("{what}: {cause}"))
}
