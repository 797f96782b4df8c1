//! Steps, boundary conditions and initial conditions.

use super::{STEP, assert_listed, converted, made, model, with};
use striae_mesh::Vec3;
use striae_model::{Curve, Mover, Procedure};

#[test]
fn the_four_numbers_of_a_step() {
    let (_, listed, deck) = converted(&model(
        "",
        &STEP.replace("*STATIC", "*STATIC, DIRECT, SOLVER=PARDISO"),
    ));
    assert_listed(&listed, &[]);
    let sizes = deck.model.steps[0].increments;
    assert_eq!((sizes.initial, sizes.largest), (0.05, 0.05));
    let (_, listed, _) = converted(&model(
        "",
        &STEP.replace("*STATIC", "*STATIC, STABILIZE=2e-4, RIKS"),
    ));
    assert_listed(&listed, &["*STATIC: parameter STABILIZE, RIKS"]);
}

#[test]
fn small_displacements_are_told_once() {
    let step = STEP.replace(", NLGEOM=YES", "");
    let later = "*STEP\n*STATIC\n*END STEP\n";
    let (_, listed, _) = converted(&model("", &format!("{step}{later}")));
    assert_listed(&listed, &["*STEP without NLGEOM"]);
}

/// Keywords of a pair in contact.
const PAIR: &str =
    "*SURFACE INTERACTION, NAME=Fric\n*FRICTION\n0.2\n*CONTACT PAIR, INTERACTION=Fric
Pad-1.Bottom, Base-1.Top
";

/// Returns lines that are listed of a `*DYNAMIC` with these parameters, and its spectral radius.
fn dynamic(before: &str, parameters: &str) -> (Vec<String>, f64) {
    let step = STEP.replace("*STATIC", &format!("*DYNAMIC{parameters}"));
    let (_, listed, deck) = converted(&model("", &format!("{before}{step}")));
    let Procedure::Dynamic { spectral_radius } = deck.model.steps[0].procedure else {
        panic!("{:?}", deck.model.steps[0].procedure);
    };
    (listed, spectral_radius)
}

#[test]
fn implicit_dynamics_has_the_spectral_radius_of_its_alpha() {
    let moderate = f64::sqrt(2.0) - 1.0;
    for (before, parameters, radius) in [
        ("", ", ALPHA=-0.2", 0.8 / 1.2),
        ("", "", 0.95 / 1.05),
        (PAIR, "", moderate),
        ("", ", APPLICATION=MODERATE DISSIPATION", moderate),
        (PAIR, ", APPLICATION=TRANSIENT FIDELITY", 0.95 / 1.05),
        (PAIR, ", APPLICATION=QUASI-STATIC", 0.0),
    ] {
        let (listed, found) = dynamic(before, parameters);
        assert_listed(&listed, &[]);
        assert!((found - radius).abs() < 1e-15, "{parameters}: {found}");
    }
    let (listed, _) = dynamic("", ", ALPHA=-0.7");
    assert_listed(
        &listed,
        &["*DYNAMIC: ALPHA of `-0.7`, which is not between -0.5 and 0"],
    );
    let (listed, _) = dynamic("", ", APPLICATION=crash");
    assert_listed(&listed, &["*DYNAMIC: APPLICATION of `CRASH`"]);
}

#[test]
fn steps_of_other_kinds_are_listed_and_keep_what_stands_before_all_steps() {
    let before = "*BOUNDARY\nBase-1.Low, PINNED\n";
    let frequency = "*STEP, NAME=Modes, PERTURBATION\n*FREQUENCY\n10,\n*END STEP\n";
    let step = STEP.replace("Base-1.Low, 1, 3\n", "");
    let (_, listed, deck) = converted(&model("", &format!("{before}{frequency}{step}")));
    let said = [
        "*STEP: parameter PERTURBATION",
        "*STEP without NLGEOM",
        "*STEP `Modes`: no static or implicit dynamic step",
        "*FREQUENCY of this step",
    ];
    assert_listed(&listed, &said);
    let base = &deck.model.steps[0].displacements[0];
    assert_eq!((base.body.0, base.numbers()), (0, [Some(0.0); 3]));
    let explicit = STEP.replace("*STATIC", "*DYNAMIC, EXPLICIT");
    let (_, made) = made(&model("", &explicit));
    let said = "an explicit step; take *DYNAMIC without EXPLICIT";
    assert!(
        made.listed.iter().any(|line| line.contains(said)),
        "{:?}",
        made.listed
    );
}

#[test]
fn symmetries_hold_what_their_names_say() {
    for (word, held) in [
        ("XSYMM", [Some(0.0), None, None]),
        ("YASYMM", [Some(0.0), None, Some(0.0)]),
        ("ENCASTRE", [Some(0.0); 3]),
    ] {
        let step = with(&format!("*BOUNDARY\nBase-1.High, {word}\n"));
        let (_, listed, deck) = converted(&model("", &step));
        assert_listed(&listed, &[]);
        let stated = &deck.model.steps[0].displacements;
        let high = stated
            .iter()
            .find(|of| of.set.contains("High") && of.body.0 == 0);
        assert_eq!(high.unwrap().numbers(), held, "{word}");
    }
}

#[test]
fn conditions_without_a_counterpart_are_listed() {
    let more =
        "*BOUNDARY, TYPE=ACCELERATION\nPad-1.High, 1, 1, 2.\n*BOUNDARY, FIXED\nPad-1.High, 1, 1
*BOUNDARY, USER\nPad-1.High, 11, 11, 2.\n*TEMPERATURE\nPad-1.High, 20.\n";
    let (_, listed, _) = converted(&model("", &with(more)));
    let said = [
        "*BOUNDARY, TYPE=ACCELERATION",
        "*BOUNDARY: parameter FIXED",
        "*BOUNDARY, FIXED: state the displacements",
        "*BOUNDARY: parameter USER",
        "*BOUNDARY `Pad-1.High, 11, 11, 2.`",
        "*TEMPERATURE: there are no temperatures",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn some_nodes_in_turned_axes_are_listed() {
    let turned =
        "*NSET, NSET=Pair\nPad-1.5, Pad-1.6\n*TRANSFORM, NSET=Pair\n0., 1., 0., -1., 0., 0.\n";
    let (_, listed, _) = converted(&model(turned, STEP));
    let said = [
        "*TRANSFORM",
        "some nodes of `Pad-1.High` are in `Pair` of *TRANSFORM",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn initial_velocities_of_whole_bodies() {
    let before = "*INITIAL CONDITIONS, TYPE=VELOCITY\nPad-1.All, 1, 2.\nPad-1.All, 3, -1.\n";
    let nodes = "*NSET, NSET=Pad-1.All\nPad-1.Low, Pad-1.High\n";
    let step = STEP.replace("*STATIC", "*DYNAMIC");
    let (_, listed, deck) = converted(&model(nodes, &format!("{before}{step}")));
    assert_listed(&listed, &[]);
    let [velocity] = &deck.model.steps[0].velocities[..] else {
        panic!("{:?}", deck.model.steps[0].velocities);
    };
    assert!(matches!(velocity.body, Mover::Deformable(body) if body.0 == 1));
    assert_eq!(velocity.velocity, Vec3::new(2.0, 0.0, -1.0));
    let (_, listed, _) = converted(&model(nodes, &format!("{before}{STEP}")));
    assert_listed(
        &listed,
        &["*INITIAL CONDITIONS, TYPE=VELOCITY before a static step"],
    );
    let some = before.replace("Pad-1.All", "Pad-1.Low");
    let (_, listed, _) = converted(&model("", &format!("{some}{step}")));
    let said = "*INITIAL CONDITIONS `Pad-1.Low, 1, 2.`: velocities are those of whole bodies";
    assert_eq!(listed.len(), 2);
    assert!(listed[0].ends_with(said), "{listed:?}");
    let stress = "*INITIAL CONDITIONS, TYPE=STRESS\nPad-1.All, 1., 1., 1.\n";
    let (_, listed, _) = converted(&model("", &format!("{stress}{STEP}")));
    assert_listed(&listed, &["*INITIAL CONDITIONS, TYPE=STRESS"]);
}

#[test]
fn nodes_on_the_axis_of_a_transform_are_left_out() {
    let turned = "*TRANSFORM, NSET=Pad-1.High, TYPE=C\n1., 1., 0., 1., 1., 1.\n";
    let step = STEP.replace("Pad-1.High, 3, 3, -0.02\n", "Pad-1.High, 2, 3\n");
    let (_, listed, deck) = converted(&model(turned, &step));
    assert_listed(
        &listed,
        &["*BOUNDARY of `Pad-1.High`: node Pad-1.7 is on the axis of the *TRANSFORM"],
    );
    let stated = deck.model.steps[0].displacements.iter();
    let of = |component: usize| {
        let mut found = stated
            .clone()
            .filter(|of| of.components[component].is_some() && of.set.starts_with("Pad-1.High"));
        found.next().expect("it is prescribed").nodes.len()
    };
    assert_eq!((of(1), of(2)), (3, 4));
}

#[test]
fn conditions_go_on_from_those_of_the_same_nodes_in_other_sets() {
    let nodes = |rows: std::ops::Range<usize>| -> String {
        rows.map(|node| format!("Pad-1.{node}, 3, 3, -0.06\n"))
            .collect()
    };
    let later = |rows: &str, option: &str| {
        let mixed = "*NSET, NSET=Mixed, INSTANCE=Pad-1\n1, 5\n";
        let ramp = match option.contains("Ramp") {
            true => "*AMPLITUDE, NAME=Ramp\n0., 0.5, 1., 1.\n",
            false => "",
        };
        let second = format!("*STEP\n*STATIC\n*BOUNDARY{option}\n{rows}*END STEP\n");
        converted(&model(mixed, &format!("{ramp}{STEP}{second}")))
    };
    // From -0.02 to -0.06 over -0.03: the curve begins at a quarter of the way.
    let (text, listed, deck) = later(&nodes(5..9), ", AMPLITUDE=Ramp");
    assert_listed(&listed, &[]);
    for displacement in &deck.model.steps[1].displacements {
        let Curve::Table(points) = &displacement.curve else {
            panic!("{text}");
        };
        assert!((points[0].1 - 0.25).abs() < 1e-12, "{points:?}");
    }
    let mixed = "Mixed, 3, 3, -0.06\n";
    assert_listed(&later(mixed, "").1, &[]);
    let (_, listed, _) = later(mixed, ", AMPLITUDE=Ramp");
    assert_listed(
        &listed,
        &[
            "*AMPLITUDE `Ramp`, which nothing here follows",
            "*BOUNDARY of `Mixed`: its nodes have different displacements",
        ],
    );
    // A node that a later step moves away from its set, whatever the names of both.
    for name in ["Above", "Zero"] {
        let one = format!("*NSET, NSET={name}, INSTANCE=Pad-1\n5\n");
        let ramp = "*AMPLITUDE, NAME=Ramp\n0., 0.5, 1., 1.\n";
        let moved = format!("*STEP\n*STATIC\n*BOUNDARY\n{name}, 3, 3, -0.06\n*END STEP\n");
        let last = "*STEP\n*STATIC\n*BOUNDARY, AMPLITUDE=Ramp\nPad-1.5, 3, 3, -0.1\nPad-1.High, 3, 3, -0.1\n*END STEP\n";
        let (text, listed, deck) = converted(&model(&one, &format!("{ramp}{STEP}{moved}{last}")));
        assert_listed(
            &listed,
            &["*BOUNDARY of `Pad-1.High`: its nodes have different"],
        );
        let [only] = &deck.model.steps[2].displacements[..] else {
            panic!("{text}");
        };
        // From -0.06 by -0.05 to -0.1: the curve begins a quarter of the way back.
        let Curve::Table(points) = &only.curve else {
            panic!("{text}");
        };
        assert!((points[0].1 + 0.25).abs() < 1e-12, "{name}: {points:?}");
    }
    // None of the nodes is released in the step that states it again.
    let held = "Base-1.Low, 1, 3\nPad-1.Low, 1, 2\n";
    let (text, listed, deck) = later(&(held.to_owned() + &nodes(5..9)), ", OP=NEW");
    assert_listed(&listed, &[]);
    assert!(deck.model.steps[1].releases.is_empty(), "{text}");
}

/// The deck of steps that move a point to which the top of the pad is coupled.
fn of_point(steps: &str) -> (String, Vec<String>) {
    let coupling = "*COUPLING, CONSTRAINT NAME=c, REF NODE=RP, SURFACE=Pad-1.Top\n*KINEMATIC\n";
    let held = "*BOUNDARY\nBase-1.Low, 1, 3\n";
    let (_, made) = made(&model(coupling, &format!("{held}{steps}")));
    (made.deck, made.listed)
}

fn step_of(conditions: &str) -> String {
    format!("*STEP, NLGEOM=YES\n*STATIC\n0.5, 1.\n{conditions}*END STEP\n")
}

#[test]
fn coordinates_that_were_free_go_to_zero() {
    let pushed = step_of("*BOUNDARY\nRP, 2, 6\n*CLOAD\nRP, 1, 0.6\n");
    let (deck, listed) = of_point(&(pushed.clone() + &step_of("*BOUNDARY\nRP, 1, 1, 0.\n")));
    assert_listed(&listed, &[]);
    let (_, last) = deck.rsplit_once("[[step]]").unwrap();
    assert!(last.contains("displacement = [0.0, 0.0, 0.0] }"), "{last}");
    let velocity = step_of("*BOUNDARY, TYPE=VELOCITY\nRP, 1, 1, 0.2\n");
    let (_, listed) = of_point(&(pushed + &velocity));
    assert_listed(&listed, &["*BOUNDARY of `RP`: it was free before"]);
}

#[test]
fn coordinates_that_are_freed_have_no_target() {
    let moved = step_of("*BOUNDARY\nRP, 1, 1, 0.02\nRP, 2, 6\n");
    let freed =
        step_of("*BOUNDARY, OP=NEW\nBase-1.Low, 1, 3\nRP, 3, 3, -0.05\nRP, 2, 2\nRP, 4, 6\n");
    let (deck, listed) = of_point(&(moved + &freed));
    assert_listed(&listed, &[]);
    let said = "displacement = [0.0, 0.0, -0.05], free = [\"x\"]";
    assert!(deck.contains(said), "{deck}");
}

#[test]
fn conditions_before_all_steps_end_with_those_that_are_new() {
    let before = "*BOUNDARY\nRP, 1, 6\n";
    let new = "*BOUNDARY, OP=NEW\nBase-1.Low, 1, 3\n*CLOAD\nRP, 3, -1.\n";
    let (deck, listed) = of_point(&format!("{before}{}", step_of(new)));
    assert_listed(&listed, &[]);
    assert!(deck.contains("free = [\"x\", \"y\", \"z\""), "{deck}");
}

#[test]
fn new_loads_end_components_that_are_not_stated_again() {
    let first = step_of("*CLOAD\nRP, 1, 0.6\nPad-1.Low, 1, 0.3\n");
    let second = step_of("*CLOAD, OP=NEW\nRP, 2, 0.05\nPad-1.Low, 2, 0.1\n");
    let (deck, listed) = of_point(&(first + &second));
    assert_listed(&listed, &[]);
    let (_, last) = deck.rsplit_once("[[step]]").unwrap();
    assert!(last.contains("force = [0.0, 0.05, 0.0]"), "{last}");
    assert!(last.contains("each = [0.0, 0.1, 0.0]"), "{last}");
}

#[test]
fn velocities_that_go_on_are_listed() {
    let moving = "*BOUNDARY, TYPE=VELOCITY\nPad-1.High, 3, 3, -0.01\n";
    let steps = with(moving).replace("Pad-1.High, 3, 3, -0.02\n", "") + &step_of("");
    let (_, made) = made(&model("", &steps));
    assert_listed(
        &made.listed,
        &["*BOUNDARY, TYPE=VELOCITY beyond the end of its step"],
    );
    let steps = with(moving).replace("Pad-1.High, 3, 3, -0.02\n", "") + &step_of(moving);
    let (_, listed, deck) = converted(&model("", &steps));
    assert_listed(&listed, &[]);
    let last = &deck.model.steps[1].displacements[0];
    let down = last.numbers()[2].unwrap();
    assert!((down + 0.03).abs() < 1e-12, "{down}");
}
