//! `striae convert` from outside: a model of two instances that becomes a deck, passes the check
//! and pushes with the right force.

use std::{fs, path::Path, process::Command};

/// Two cubes of side 1 on each other, without lateral strain as Poisson's ratio is 0; the upper
/// one is pressed down by 0.02.
const MODEL: &str = "*HEADING
two cubes
*PART, NAME=Cube
*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
5, 0., 0., 1.
6, 1., 0., 1.
7, 1., 1., 1.
8, 0., 1., 1.
*ELEMENT, TYPE=C3D8, ELSET=All
1, 1, 2, 3, 4, 5, 6, 7, 8
*NSET, NSET=Low
1, 2, 3, 4
*NSET, NSET=High
5, 6, 7, 8
*SURFACE, NAME=Bottom
1, S1
*SURFACE, NAME=Top
1, S2
*SOLID SECTION, ELSET=All, MATERIAL=Foam
,
*END PART
*ASSEMBLY, NAME=A
*INSTANCE, NAME=Base-1, PART=Cube
*END INSTANCE
*INSTANCE, NAME=Pad-1, PART=Cube
0., 0., 1.
*END INSTANCE
*END ASSEMBLY
*MATERIAL, NAME=Foam
*ELASTIC
100., 0.
*SURFACE INTERACTION, NAME=Fric
*FRICTION
0.4,
*CONTACT PAIR, INTERACTION=Fric
Pad-1.Bottom, Base-1.Top
*BOUNDARY
Base-1.Low, ENCASTRE
*STEP, NAME=Press, NLGEOM=YES
*STATIC
0.5, 1.
*BOUNDARY
Pad-1.High, 1, 2
Pad-1.High, 3, 3, -0.02
*OUTPUT, FIELD, VARIABLE=PRESELECT
*MONITOR, NODE=Pad-1.5, DOF=3
*END STEP
";

/// Exit code, standard output and errors.
fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

#[test]
fn a_converted_model_of_two_instances_pushes_with_the_right_force() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("model.inp"), MODEL).unwrap();
    let (code, out, errors) = said(folder, &["convert", "model.inp"]);
    assert_eq!(code, Some(0), "{out}{errors}");
    assert_eq!(
        out,
        "not converted:\n  line 50: *MONITOR\nwrote model.toml\nnext: striae check model.toml\n"
    );
    let (code, out, errors) = said(folder, &["check", "model.toml"]);
    assert_eq!(code, Some(0), "{out}{errors}");
    assert!(
        out.contains("bodies `Base-1`, `Pad-1`: keywords of the file that a mesh does not use: *MATERIAL (line 33)"),
        "{out}"
    );
    let (code, out, errors) = said(folder, &["run", "model.toml"]);
    assert_eq!(code, Some(0), "{out}{errors}");
    let results = fs::read_dir(folder.join("results")).unwrap();
    let results = results.map(|entry| entry.unwrap().path()).next().unwrap();
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let mut lines = history.lines();
    let names = lines.next().unwrap().split(',');
    let column = names
        .clone()
        .position(|name| name == "reaction.Base-1.Base-1.Low.z");
    let column = column.unwrap_or_else(|| panic!("{:?}", names.collect::<Vec<_>>()));
    let force = lines.last().unwrap().split(',').nth(column).unwrap();
    let force: f64 = force.parse().unwrap();
    // Neo-Hookean with lambda = 0: P = G (s - 1/s) at the stretch s = 0.99 of both.
    let expected = 50.0 * (1.0 / 0.99 - 0.99);
    assert!(
        (force - expected).abs() < 1e-8 * expected,
        "{force} {expected}"
    );

    let (code, _, errors) = said(folder, &["convert", "model.inp"]);
    assert_eq!(code, Some(2), "{errors}");
    assert!(errors.contains("model.toml already exists"), "{errors}");
}

#[test]
fn a_deck_beside_its_model_moves_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let [before, after] = ["before", "after"].map(|name| folder.path().join(name));
    fs::create_dir_all(before.join("models")).unwrap();
    fs::create_dir_all(before.join("runs/first")).unwrap();
    fs::write(before.join("models/model.inp"), MODEL).unwrap();
    let out = "runs/first/model.toml";
    let (code, _, errors) = said(&before, &["convert", "models/model.inp", "--out", out]);
    assert_eq!(code, Some(0), "{errors}");
    let deck = fs::read_to_string(before.join(out)).unwrap();
    assert!(deck.contains("\"../../models/model.inp\""), "{deck}");
    fs::rename(&before, &after).unwrap();
    let (code, _, errors) = said(&after, &["check", out]);
    assert_eq!(code, Some(0), "{errors}");
}

#[test]
fn what_the_deck_lacks_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = MODEL.replace("*ELASTIC\n100., 0.", "*HYPERFOAM\n1., 2.");
    fs::write(folder.join("model.inp"), model).unwrap();
    let (code, out, errors) = said(folder, &["convert", "model.inp", "--out", "made.toml"]);
    assert_eq!(code, Some(2), "{out}{errors}");
    assert!(out.contains("line 33: *MATERIAL `Foam`"), "{out}");
    let end = "wrote made.toml\nnext: complete the deck, then: striae check made.toml\n";
    assert!(out.ends_with(end), "{out}");
    assert!(
        errors.contains("made.toml") && errors.contains("`Foam`"),
        "{errors}"
    );
    let (code, _, errors) = said(folder, &["convert", "nothing.inp"]);
    assert_ne!(code, Some(0));
    assert!(errors.contains("nothing.inp"), "{errors}");
}
