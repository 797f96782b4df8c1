//! `striae fit` from outside: constants, pictures and refused measurements.

use std::{
    fs,
    process::{Command, Output},
};

const MEASUREMENTS: &str = "\
# made-up readings, as an example
angle, friction
0,   0.41
45,  0.33
90,  0.21
135, 0.31
180, 0.39
270, 0.19
";

fn fit(text: &str, words: &[&str]) -> (Output, tempfile::TempDir) {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("m.csv"), text).expect("a file");
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(["fit", "m.csv"])
        .args(words)
        .current_dir(folder.path())
        .output()
        .expect("the program starts");
    (output, folder)
}

/// The example of the book, whose numbers follow from the normal equations by hand.
#[test]
fn constants_come_as_a_table_of_a_deck_with_their_intervals() {
    let (output, folder) = fit(
        MEASUREMENTS,
        &["--law", "orthotropic", "--plot", "made/r.svg"],
    );
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    let book = include_str!("../../../docs/book/how-to/fit-friction.md");
    let (table, rest) = told.split_once("wrote").expect("files are named");
    assert!(book.contains(table), "{told}");
    assert!(rest.contains("made/r.svg, .png and .csv"), "{told}");
    for kind in ["svg", "png", "csv"] {
        assert!(folder.path().join(format!("made/r.{kind}")).exists());
    }
}

#[test]
fn every_law_is_fitted() {
    let mut around = String::from("angle,friction,direction,theta\n");
    for i in 0..24 {
        let (angle, theta) = (15 * i, 40 * (i % 3));
        around += &format!(
            "{angle},{},{angle},{theta}\n",
            0.3 + 0.001 * f64::from(i % 5)
        );
    }
    for (law, key) in [
        ("coulomb", "{ law = \"coulomb\", mu = 0.30"),
        ("nap", "mu_backward = 0.30"),
        ("two-textures", "c_mag = "),
        ("tabulated", "angles = [0, 15, 30, "),
    ] {
        let (output, _) = fit(&around, &["--law", law, "--plot", "r.svg"]);
        let told = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && told.contains(key), "{output:?}");
    }
    let (output, _) = fit(
        &around,
        &["--law", "orthotropic", "--slip-rule", "associated"],
    );
    assert!(String::from_utf8_lossy(&output.stdout).contains("slip_rule = \"associated\" }"));
}

/// Friction that is the same in all directions is measured without telling them.
#[test]
fn isotropic_laws_need_no_angles() {
    let text = "friction\n0.3\n0.5\n";
    let (output, _) = fit(text, &["--law", "coulomb"]);
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{output:?}");
    assert!(told.contains("{ law = \"coulomb\", mu = 0.4 }"), "{told}");
    for (text, law) in [
        (text, "orthotropic"),
        ("friction,direction\n0.3,10\n", "coulomb"),
    ] {
        let (output, _) = fit(text, &["--law", law]);
        assert_eq!(output.status.code(), Some(2));
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains("a column `angle` is needed"), "{told}");
    }
}

#[test]
fn faults_have_places_and_exit_code_2() {
    for (text, words) in [
        (
            "angle, friction\n0, much\n",
            "m.csv:2:4: `much` is not a finite number",
        ),
        (
            "angle, friction\n0, .3\n",
            "it needs slip in three directions",
        ),
        (
            "angle, friction\n0, -.3\n",
            "the mean friction against slip is -0.3",
        ),
    ] {
        let (output, _) = fit(text, &["--law", "nap"]);
        assert_eq!(output.status.code(), Some(2));
        let told = String::from_utf8_lossy(&output.stderr);
        assert!(told.contains(words), "{told}");
    }
}

/// Readings of a tester that names columns in its own way and counts from the grooves.
#[test]
fn files_of_testers_are_fitted_and_the_convention_is_said() {
    let text = "rig 3\nno;alpha;Fn;Ft\n1;0;10;2,0\n2;90;10;4,0\n3;180;10;2,0\n4;270;10;4,0\n";
    let columns = "angle=alpha,normal=Fn,tangential=Ft";
    let words = [
        "--law",
        "orthotropic",
        "--skip-lines",
        "1",
        "--columns",
        columns,
    ];
    let (output, _) = fit(text, &words);
    let told = String::from_utf8_lossy(&output.stdout);
    for words in [
        "mu_along = 0.4, mu_across = 0.2",
        "angle 0 is slip across the grooves (against a nap); if yours is along them, add `--angle-from along`",
        "unused columns: `no`",
    ] {
        assert!(told.contains(words), "{told}");
    }
    let (output, _) = fit(text, &[&words[..], &["--angle-from", "along"]].concat());
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(told.contains("mu_along = 0.2, mu_across = 0.4"), "{told}");
    assert!(told.contains("angle 0 is slip along the grooves"), "{told}");
}

/// Two specimens whose friction differs by a fifth: the interval is that of their scatter.
#[test]
fn specimens_are_told_and_widen_the_intervals() {
    let text = "Probe,angle,friction\nA,0,0.22\nA,0,0.22\nB,0,0.18\nB,0,0.18\n";
    let words = ["--law", "coulomb"];
    let (output, _) = fit(
        text,
        &[&words[..], &["--columns", "specimen=Probe"]].concat(),
    );
    let told = String::from_utf8_lossy(&output.stdout);
    for words in [
        "mu = 0.2 }",
        // 0.02 times Student's t for one degree of freedom, 12.706.
        "95 % within -0.0541 .. 0.4541",
        "specimens: 2; friction over that of the law (readings): `A` 1.100 (2), `B` 0.900 (2)",
    ] {
        assert!(told.contains(words), "{told}");
    }
    let (output, _) = fit(text, &words);
    let told = String::from_utf8_lossy(&output.stdout);
    assert!(told.contains("95 % within 0.1633 .. 0.2367"), "{told}");
    assert!(told.contains("unused columns: `Probe`"), "{told}");
}
