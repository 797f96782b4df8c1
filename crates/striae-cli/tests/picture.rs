//! Pictures and animations of runs, from outside: files, messages and exit codes.

use std::{
    fs,
    path::Path,
    process::{Command, Output},
};

const DECK: &str = r#"
title = "A block on a floor"
material = [{ name = "foam", law = "neo-hookean", youngs_modulus = 1000, poissons_ratio = 0.3 }]

[[body]]
name = "block"
material = "foam"
mesh = { generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.3 }

[[step]]
name = "press"
increments = 3
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.1 }]
"#;

fn striae(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_striae"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program")
}

/// Results in `results` of a new folder.
fn results() -> tempfile::TempDir {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("deck.toml"), DECK).expect("the deck");
    let run = ["run", "deck.toml", "--out", "results", "--quiet"];
    let output = striae(folder.path(), &run);
    assert!(output.status.success(), "{output:?}");
    folder
}

#[test]
fn a_run_is_animated_as_gif_or_png() {
    let folder = results();
    let said = |arguments: &[&str]| {
        let output = striae(folder.path(), arguments);
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).expect("text")
    };
    let small = ["picture", "results", "--animate", "--width", "300"];
    assert_eq!(said(&small), "wrote results/animation.gif\n");
    let gif = fs::read(folder.path().join("results/animation.gif")).expect("the file");
    assert!(gif.starts_with(b"GIF89a"));
    let other = ["--frame-time", "0.5", "--view", "front", "--field", "gap"];
    said(&[&small[..], &other, &["--output", "film.png"]].concat());
    let png = fs::read(folder.path().join("film.png")).expect("the file");
    let control = png.windows(4).position(|name| name == b"acTL");
    let control = control.expect("an animated PNG") + 4;
    // The start and three increments.
    assert_eq!(png[control..control + 4], [0, 0, 0, 4]);
}

#[test]
fn views_have_names_and_colours_a_range() {
    let folder = results();
    let drawn = |arguments: &[&str]| {
        let small = ["picture", "results", "--width", "300", "--out", "a.png"];
        let output = striae(folder.path(), &[&small[..], arguments].concat());
        assert!(output.status.success(), "{output:?}");
        fs::read(folder.path().join("a.png")).expect("the file")
    };
    assert_eq!(drawn(&[]), drawn(&["--view", "corner"]));
    assert_eq!(drawn(&["--view", "front"]), drawn(&["--view", "0,1,0"]));
    assert_ne!(drawn(&["--view", "front"]), drawn(&["--view", "left"]));
    assert_ne!(drawn(&[]), drawn(&["--range", "0,1e4"]));
}

#[test]
fn what_is_not_possible_is_refused_and_nothing_is_written() {
    let folder = results();
    let refused = |arguments: &[&str]| {
        let output = striae(
            folder.path(),
            &[&["picture", "results"], arguments].concat(),
        );
        assert_eq!(output.status.code(), Some(2), "{output:?}");
        String::from_utf8(output.stderr).expect("text")
    };
    for (arguments, words) in [
        (
            &["--animate", "--out", "film.mp4"][..],
            "film.mp4: an animation ends in .gif or .png; choose one of these",
        ),
        (
            &["--animate", "--field", "heat", "--out", "film.gif"],
            "unknown field `heat`",
        ),
        (&["--animate", "--time", "1"], "cannot be used with"),
        (&["--view", "sideways"], "or one of corner, front, back"),
        (&["--range", "2,1"], "two ascending numbers are needed"),
        (&["--animate", "--frame-time", "0"], "from 0.01 to 60"),
        (&["--frame-time", "1"], "--animate"),
        (
            &["--out", "film.jpg"],
            "film.jpg: a picture ends in .png, with `--animate` in .gif or .png; choose one of these",
        ),
        (
            &["--hide", "nix"],
            "unknown name `nix` of a body or surface; known names are block",
        ),
        (&["--animate", "--hide", "nix"], "unknown name `nix`"),
        (&["--time", "nan"], "the fields are from time 0 to "),
        (
            &["--magnify", "nan"],
            "a number from -1e12 to 1e12 is needed",
        ),
        (&["--magnify", "1e300"], "cannot be magnified by 1e300"),
    ] {
        let said = refused(arguments);
        assert!(said.contains(words), "{said}");
    }
    for name in [
        "film.mp4",
        "film.jpg",
        "film.gif",
        "results/animation.gif",
        "results/picture.png",
    ] {
        assert!(!folder.path().join(name).exists(), "{name}");
    }
}
