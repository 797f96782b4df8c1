//! Functions of position and time, histories over the time of the run and from files, in decks
//! that are run and in faulty ones.

mod driven;

use std::path::Path;

use striae_deck::{parse, write};
use striae_mesh::Vec3;
use striae_solve::{problem::Problem, report::reactions, state::State};

const BLOCK: &str = r#"
title = "a block"

[parameters]
A = 2e-3

[[material]]
name = "elastic"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3

[[body]]
name = "block"
material = "elastic"
mesh = { generator = "block", size = [2, 1, 1], divisions = [4, 2, 2] }
"#;

fn last(rest: &str) -> (Problem, State) {
    driven::last(&format!("{BLOCK}{rest}"))
}

fn faults(rest: &str) -> String {
    let found = parse(&format!("{BLOCK}{rest}"), "deck", Path::new("")).expect_err(rest);
    found.to_string()
}

#[test]
fn a_linear_function_on_the_boundary_is_the_displacement_inside() {
    let sides = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"].map(|side| {
        format!(
            r#"{{ body = "block", nodes = "{side}", x = "A*x + 0.01*y", y = "-0.02*z", z = "= 3*A - 0.006" }}"#
        )
    });
    let step = format!(
        "\n[[step]]\nname = \"shear\"\nincrements = 1\ndisplacement = [{}]\n",
        sides.join(", ")
    );
    let (problem, state) = last(&step);
    let f = |x: &Vec3| Vec3::new(2e-3 * x.x + 0.01 * x.y, -0.02 * x.z, 0.0);
    for (x, now) in problem.reference.iter().zip(state.positions.iter()) {
        assert!((now - x - f(x)).norm() < 1e-12, "{x}: {now}");
    }
}

#[test]
fn functions_of_time_are_followed_and_kept() {
    let text = r#"
[[step]]
name = "shake"
duration = 2
increments = 5
displacement = [
    { body = "block", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "block", nodes = "zmax", x = "0.01*sin(2*pi*t) + 0.001*t*y", y = 0, z = 0 },
]

[[step]]
name = "keep"
increments = 1
"#;
    let (problem, state) = last(text);
    for (x, now) in problem.reference.iter().zip(state.positions.iter()) {
        if x.z == 1.0 {
            let expected = 0.01 * (4.0 * std::f64::consts::PI).sin() + 0.002 * x.y;
            assert!((now.x - x.x - expected).abs() < 1e-14, "{x}: {now}");
        }
    }
}

/// The sum of the reactions of the node set `zmin` along `z` after the last increment.
fn reaction(rest: &str) -> Vec3 {
    let (problem, state) = last(rest);
    let all = reactions(&problem, &state);
    let mut named = all.into_iter();
    named
        .find(|(name, _)| name.ends_with("zmin"))
        .expect("a reaction")
        .1
}

#[test]
fn loads_are_integrated_with_their_functions() {
    // int (1 - y) (x + t) dx dy over 2 x 1 at t = 3, exact with 2 x 2 points a face.
    let held = r#"{ body = "block", nodes = "zmin", x = 0, y = 0, z = 0 }"#;
    for (load, expected) in [
        (
            r#"pressure = [{ body = "block", facets = "zmax", value = "1e-4*(1 - y)*(x + t)" }]"#,
            Vec3::new(0.0, 0.0, 4e-4),
        ),
        (
            r#"traction = [{ body = "block", facets = "zmax", vector = [0, "1e-4*x", "A*t*0.01"] }]"#,
            Vec3::new(0.0, -2e-4, -1.2e-4),
        ),
        (
            r#"traction = [{ body = "block", facets = "zmax", vector = [0, 0, 1e-5], curve = "load" }]"#,
            Vec3::new(0.0, 0.0, -2e-5 * 7.0),
        ),
    ] {
        let curve = r#"
[[curve]]
name = "load"
points = [[0, 1], [1, 3], [3, 7], [8, -1]]
time = "run"
"#;
        // In two steps, as what the second one finds must not matter.
        let steps = format!(
            "{curve}\n[[step]]\nname = \"one\"\nincrements = 1\ndisplacement = [{held}]\n{load}\n\
             [[step]]\nname = \"two\"\nincrements = 1\nduration = 2\n{load}\n"
        );
        let found = reaction(&steps);
        let scale = expected.norm();
        assert!((found - expected).norm() < 2e-3 * scale, "{load}: {found}");
    }
}

#[test]
fn periodic_curves_and_those_of_files_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let csv = "\u{feff}test 7\nt [s];u [mm];Fz\n0,0;0;1\n0,5;2,5;1 # top\n\n1;-1;1\n";
    std::fs::write(folder.path().join("way.csv"), csv).unwrap();
    let deck = format!(
        r#"{BLOCK}
[[curve]]
name = "way"
file = "way.csv"
columns = ["t [s]", "2"]
skip = 1
period = 1.25
time = "run"

[[curve]]
name = "wave"
function = "1 - cos(pi*t)"

[[step]]
name = "move"
duration = 4
displacement = [
    {{ body = "block", nodes = "zmax", x = 1e-3, y = 0, z = 0, curve = "way" }},
    {{ body = "block", nodes = "zmin", x = 1e-3, y = 0, z = 0, curve = "wave" }},
]
"#
    );
    let read = |deck: &str| parse(deck, "deck", folder.path());
    let model = read(&deck).unwrap().model;
    let plan = &striae_model::plan::plans(&model)[0];
    let moment = |time: f64| plan.start.later(time / 4.0);
    let [way, wave] = [0, 1].map(|at| &model.steps[0].displacements[at].curve);
    for (time, expected) in [
        (0.25, 1.25),
        (0.75, 0.75),
        (1.2, -1.0),
        (2.75, 1.25),
        (4.0, 1.25),
    ] {
        assert!((way.at(moment(time)) - expected).abs() < 1e-12, "{time}");
    }
    assert!((wave.at(moment(2.0)) - 1.0).abs() < 1e-15);
    // Written and read again it is the same model.
    let text = write(&model, &Default::default()).unwrap();
    let again = parse(&text, "again", Path::new(""))
        .unwrap_or_else(|f| panic!("{f}"))
        .model;
    assert_eq!(format!("{:?}", again.steps), format!("{:?}", model.steps));
    for (from, to, words) in [
        (
            "way.csv",
            "no.csv",
            "curve file `no.csv`: it cannot be read: ",
        ),
        (
            "\"2\"",
            "\"u\"",
            "curve file `way.csv`, line 2: there is no column `u`; there are `t [s]`, `u [mm]`, `Fz`",
        ),
        (
            "1.25",
            "0.75",
            "must ascend within the period from 0 to 0.75, but one is at 1",
        ),
        ("time = \"run\"", "time = \"step\"", ""),
        (
            "1 - cos(pi*t)",
            "1 - cos(pi*x)",
            "curve `wave` must be a function of `t` alone, but `1 - cos(pi*x)` depends on",
        ),
    ] {
        let told =
            read(&deck.replacen(from, to, 1)).map_or_else(|f| f.to_string(), |_| String::new());
        assert!(told.contains(words), "{to}: {told}");
    }
    std::fs::write(folder.path().join("way.csv"), csv.replace("2,5", "much")).unwrap();
    let told = read(&deck).unwrap_err().to_string();
    assert!(
        told.contains("line 4: `much` is no finite number for column `2`"),
        "{told}"
    );
    let twice = csv.replace("u [mm]", "t [s]");
    std::fs::write(folder.path().join("way.csv"), twice).unwrap();
    let told = read(&deck).unwrap_err().to_string();
    assert!(
        told.contains("line 2: several columns are named `t [s]`; state the number of one"),
        "{told}"
    );
    std::fs::write(folder.path().join("way.csv"), csv.replace("2,5", "2;5")).unwrap();
    let told = read(&deck).unwrap_err().to_string();
    assert!(
        told.contains("line 4: it has 4 fields, but the first line has 3; decimal commas need"),
        "{told}"
    );
}

#[test]
fn faults_of_functions_have_places_and_remedies() {
    let step = |target: &str| {
        format!(
            "\n[[step]]\nname = \"one\"\ndisplacement = [{{ body = \"block\", nodes = \"zmin\", x = {target}, y = 0, z = 0 }}]\n"
        )
    };
    for (target, words) in [
        (r#""0.1*sin(t""#, "deck:20:55:"),
        (
            r#""0.1*sin(t""#,
            "`0.1*sin(t` is no function of `x`, `y`, `z` and `t`, at letter 10: expected `)`, found the end; write one such as",
        ),
        (
            r#""B*x""#,
            "at letter 1: there is no `B`; [parameters] has `A`",
        ),
        (
            r#""1/(x - 2)""#,
            "`1/(x - 2)` has no finite value at x = 2, y = 0, z = 0, t = 0; it must have one",
        ),
        (
            r#""sqrt(0.5 - t)""#,
            "has no finite value at x = 0, y = 0, z = 0, t = 0.525",
        ),
        (
            r#""= 2*t""#,
            "there is no parameter `t`; [parameters] has `A`; a function of position and time is written without the `=`",
        ),
        (
            "true",
            "must be a number or a function of `x`, `y`, `z` and `t`, such as \"0.1*x*sin(2*pi*t)\"",
        ),
    ] {
        let told = faults(&step(target));
        assert!(told.contains(words), "{target}: {told}");
    }
    let text = format!("{BLOCK}{}", step("\"A*t\"")).replace("A = 2e-3", "A = 1\nt = 3");
    let told = parse(&text, "deck", Path::new("")).unwrap_err().to_string();
    assert!(
        told.contains("`t` is a parameter and, in the function `A*t`, a coordinate or the time"),
        "{told}"
    );
}

#[test]
fn functions_are_written_without_parameters() {
    let step = r#"
[[step]]
name = "one"
displacement = [{ body = "block", nodes = "zmin", x = "A*x*t", y = 0, z = 0 }]
traction = [{ body = "block", facets = "zmax", vector = ["A", 0, "sin(t)"], direction = "follower" }]
"#;
    let model = parse(&format!("{BLOCK}{step}"), "deck", Path::new(""))
        .unwrap()
        .model;
    let text = write(&model, &Default::default()).unwrap();
    assert!(text.contains(r#"x = "0.002*x*t""#), "{text}");
    let again = parse(&text, "again", Path::new(""))
        .unwrap_or_else(|f| panic!("{f}"))
        .model;
    assert_eq!(format!("{:?}", again.steps), format!("{:?}", model.steps));
}

#[test]
fn forces_at_nodes_add_up_and_do_work() {
    let step = |force: &str| {
        format!(
            r#"
[[step]]
name = "pull"
duration = 2
increments = 4
displacement = [{{ body = "block", nodes = "zmin", x = 0, y = 0, z = 0 }}]
force = [{{ body = "block", nodes = "zmax", {force} }}]

[[step]]
name = "keep"
increments = 1
"#
        )
    };
    // Nodes of the side: 5 x 3.
    for (force, expected) in [
        ("total = [1e-4, 0, -2e-4]", Vec3::new(-1e-4, 0.0, 2e-4)),
        (
            r#"total = [0, "A*t", 0], curve = "smooth""#,
            Vec3::new(0.0, -4e-3, 0.0),
        ),
        // The mean of x^2 over the nodes is 1.5.
        (
            r#"each = [0, 0, "1e-5*x^2"]"#,
            Vec3::new(0.0, 0.0, -15.0 * 1.5e-5),
        ),
    ] {
        let (problem, state) = last(&step(force));
        let held = reactions(&problem, &state)
            .into_iter()
            .find(|(name, _)| name.ends_with("zmin"));
        let found = held.expect("a reaction").1;
        assert!(
            (found - expected).norm() < 1e-7 * expected.norm(),
            "{force}: {found}"
        );
        // The force grows in proportion to the displacement: its work is what is stored.
        let energies = &state.energies;
        assert!(
            (energies.external - energies.strain).abs() < 2e-2 * energies.strain,
            "{energies:?}"
        );
    }
    let told = faults(&step("total = [1, 0, 0], each = [1, 0, 0]"));
    assert!(told.contains("each"), "{told}");
    let twice = step("total = [1, 0, 0]").replace(
        "force = [",
        r#"force = [{ body = "block", nodes = "zmax", each = [0, 0, 1] }, "#,
    );
    let told = faults(&twice);
    assert!(
        told.contains("the force at `zmax` of body `block`"),
        "{told}"
    );
    let told = faults(&step("total = [1, 0, 0]").replace("nodes = \"zmax\"", "nodes = \"top\""));
    assert!(told.contains("no node set `top`"), "{told}");
}
