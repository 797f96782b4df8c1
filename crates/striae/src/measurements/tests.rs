//! Files of measurements, whole and broken.

use super::{AngleFrom, Form, Reading, parse, read};

#[test]
fn readings_are_read() {
    let text = "\u{feff}# ground steel\nangle, tangential, normal, theta # degrees, N\n\
                0, 3, 10, 0\n\n90, 2, 10, 45\n";
    let readings = parse(text, "m.csv").unwrap();
    assert_eq!(readings[0], Reading::against(0.0, 0.3));
    assert_eq!(readings[1].theta, 45f64.to_radians());
    let text = "spread,direction,friction,angle\n2,120,.5,90\n";
    let reading = parse(text, "m.csv").unwrap()[0];
    let directed = Reading::directed(90f64.to_radians(), 0.5, 120f64.to_radians());
    assert_eq!(
        reading,
        Reading {
            spread: 2.0,
            ..directed
        }
    );
    assert!((reading.across.unwrap() - 0.25).abs() < 1e-15);
}

#[test]
fn all_faults_are_told_with_their_places() {
    let text = "angle, friction, spread\n0, 0.3, 1\n30, much, 0\n60, 0.2\n90, inf, 1\n";
    assert_eq!(
        parse(text, "m.csv").unwrap_err().to_string(),
        "m.csv:3:5: `much` is not a finite number for `friction`\nm.csv:3:11: `0` is not a positive number for `spread`\nm.csv:4:1: fields: 2, but columns: 3; each needs one\nm.csv:5:5: `inf` is not a finite number for `friction`"
    );
    for (text, message) in [
        ("", "it is empty"),
        ("angle,friction\n", "no readings"),
        ("0,0.3\n", "m.csv:1:1: numbers, but no names of columns"),
        (
            "angle,COF\n0,1\n",
            "m.csv:1:1: a column `friction` is needed, or `tangential` and `normal`; there are `angle`, `COF`; name yours by `--columns`, such as `--columns friction=COLUMN`",
        ),
        (
            "panel,x,y\n1,0,1\n",
            "there are `panel`, `x`, `y`; name yours by `--columns`, such as `--columns angle=COLUMN`",
        ),
        (
            "Angle,angle (deg),friction\n0,0,1\n",
            "m.csv:1:7: columns `Angle` and `angle (deg)` can both be `angle`; name one of them: `--columns angle=1`",
        ),
        (
            "angle [rad],friction\n0,1\n",
            "m.csv:1:1: column `angle [rad]`: `angle` is needed in degrees; convert it",
        ),
        (
            "angle,tangental,normal\n0,1,1\n",
            "unknown column `tangental`; did you mean `tangential`?",
        ),
        ("angle,angle,friction\n", "column `angle` appears twice"),
        ("friction\n1\n", "a column `angle` is needed"),
        ("angle,normal\n1,1\n", "a column `friction` is needed, or"),
        ("angle,friction,normal\n1,1,1\n", "not both"),
        (
            "angle,tangential,normal\n1,1,-1\n",
            "m.csv:2:5: `-1` is not a positive number",
        ),
        (
            "angle,friction\n0,.3\n90,1e308\n",
            "m.csv:3:4: friction of more than 1000, but it is tangential over normal force",
        ),
        (
            "angle,tangential,normal\n1,1e200,1e-200\n",
            "m.csv:2:9: the tangential force is more than 1000 times the normal one; leave out readings",
        ),
        (
            "angle,friction,spread\n1,.3,1e-300\n",
            "m.csv:2:6: `spread` must lie between 0.000001 and 1000000",
        ),
    ] {
        let told = parse(text, "m.csv").unwrap_err().to_string();
        assert!(told.contains(message), "{told}");
    }
}

#[test]
fn files_of_instruments_are_read() {
    let text = "Tribometer 7\nTest;Angle;Fz [N];Fx [N];Temp\n1;0;2,5;0,5;23,1\n2;90;2;0,8;warm\n";
    let columns = ["angle=Angle", "normal=Fz [N]", "tangential=4"];
    let form = Form {
        skipped: 1,
        columns: columns.map(|one| one.parse().unwrap()).to_vec(),
        ..Form::default()
    };
    let measured = read(text, "m.csv", &form).unwrap();
    let expected = [(0.0, 0.2), (90f64.to_radians(), 0.4)];
    let expected = expected.map(|(slip, friction)| Reading::against(slip, friction));
    assert_eq!(measured.readings, expected);
    assert_eq!(measured.notes, ["unused columns: `Test`, `Temp`"]);
    let bare = read(
        "0\t0.2\n90\t0.4\n",
        "m.csv",
        &Form {
            columns: ["angle=1", "friction=2"]
                .map(|one| one.parse().unwrap())
                .to_vec(),
            ..Form::default()
        },
    );
    assert_eq!(bare.unwrap().readings, expected);
    let missing = Form {
        columns: vec!["normal=Fy".parse().unwrap()],
        ..form
    };
    let told = read(text, "m.csv", &missing).unwrap_err().to_string();
    assert!(
        told.contains("m.csv:2:1: unknown column `Fy`; there are `Test`"),
        "{told}"
    );
}

#[test]
fn names_have_capitals_and_units_and_blanks_separate() {
    let expected = parse("angle,friction\n0,.3\n90,.2\n", "m.csv").unwrap();
    for text in [
        "Angle (deg),Mu\n0,.3\n90,.2\n",
        "Friction;angle [°];Normal (N)\n0,3;0;7\n0,2;90;8\n",
        "angle  friction\n 0  .3\n90  .2\n",
    ] {
        let measured = read(text, "m.csv", &Form::default()).unwrap();
        assert_eq!(measured.readings, expected, "{text}");
        assert_eq!(measured.notes.is_empty(), !text.contains("Normal"));
    }
}

#[test]
fn numbers_that_are_hardly_meant_are_noted() {
    let notes = |text: &str| read(text, "m.csv", &Form::default()).unwrap().notes;
    let usual = "angle,friction\n0,.3\n90,.2\n180,.25\n";
    assert!(notes(usual).is_empty());
    for (line, words) in [
        (
            "45,-.2\n",
            "negative friction, which would drive the slip: -0.2 in line 5; ",
        ),
        (
            "45,35\n",
            "more than 10 times the median 0.3000: 35 in line 5; is it in percent",
        ),
    ] {
        let told = notes(&format!("{usual}{line}"));
        assert!(told.len() == 1 && told[0].contains(words), "{told:?}");
    }
    let told = notes("angle,friction\n0,.3\n1.5708,.2\n3.1416,.25\n");
    assert!(told[0].contains("are they in radians?"), "{told:?}");
}

#[test]
fn specimens_are_numbered_by_their_names() {
    let text = "specimen,angle,friction\nleft,0,0.2\nright,0,0.3\nleft,90,0.4\n";
    let measured = read(text, "m.csv", &Form::default()).unwrap();
    let numbers: Vec<usize> = measured.readings.iter().map(|one| one.specimen).collect();
    assert_eq!(numbers, [0, 1, 0]);
    assert_eq!(measured.specimens, ["left", "right"]);
    let told = parse("specimen,angle,friction\n,0,0.2\n", "m.csv");
    let told = told.unwrap_err().to_string();
    assert!(
        told.contains("m.csv:2:1: the name of the specimen is missing"),
        "{told}"
    );
}

#[test]
fn angles_from_the_grooves_are_turned_by_a_quarter() {
    let form = Form {
        angle_from: AngleFrom::Along,
        ..Form::default()
    };
    let text = "angle,friction,direction\n90,0.4,100\n";
    let along = read(text, "m.csv", &form).unwrap().readings[0];
    let across = parse("angle,friction,direction\n0,0.4,10\n", "m.csv").unwrap()[0];
    assert!((along.slip - across.slip).abs() < 1e-15);
    assert!((along.against - across.against).abs() < 1e-15);
    assert!((along.across.unwrap() - across.across.unwrap()).abs() < 1e-15);
}
