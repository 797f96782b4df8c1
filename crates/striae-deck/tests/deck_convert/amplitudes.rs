//! Kinds of amplitudes, against their formulas.

use super::{STEP, assert_listed, converted, made, model, with};
use striae_model::{Displacement, Moment};

/// Displacement of the pad's top along z over the first step of a duration of 2.
fn course(amplitude: &str, parameters: &str) -> (Vec<String>, Vec<[f64; 2]>) {
    let step = STEP.replace("Pad-1.High, 3, 3, -0.02\n", "");
    let step = step.replace(
        "*END STEP",
        &format!("*BOUNDARY, AMPLITUDE=Way{parameters}\nPad-1.High, 3, 3, 0.5\n*END STEP"),
    );
    let text = model("", &format!("{amplitude}{step}"));
    let (_, made) = made(&text);
    if !made.deck.contains("nodes = \"Pad-1.High\"") {
        return (made.listed, Vec::new());
    }
    let (_, listed, deck) = converted(&text);
    let stated = &deck.model.steps[0].displacements;
    let of = |of: &&Displacement| of.components[2].is_some() && of.components[0].is_none();
    let stated = stated.iter().find(of).unwrap();
    let target = stated.numbers()[2].unwrap();
    let moments = (0..=40).map(|at| Moment::start(2.0).later(at as f64 / 40.0));
    let course = moments.map(|at| [at.time, target * stated.curve.at(at)]);
    (listed, course.collect())
}

fn assert_course(amplitude: &str, tolerance: f64, exact: impl Fn(f64) -> f64) {
    let (listed, course) = course(amplitude, "");
    assert_listed(&listed, &[]);
    for [t, found] in course {
        let exact = exact(t);
        assert!((found - exact).abs() <= tolerance, "{t}: {found} {exact}");
    }
}

#[test]
fn tables_that_lead_back_are_followed() {
    let saw = "*AMPLITUDE, NAME=Way\n0., 0., 1., 1., 2., 0.\n";
    assert_course(saw, 1e-14, |t| 0.5 * (1.0 - (t - 1.0).abs()));
}

#[test]
fn equally_spaced_values() {
    let way = "*AMPLITUDE, NAME=Way, DEFINITION=EQUALLY SPACED, FIXED INTERVAL=0.5, BEGIN=0.5\n0., 2., 1.\n";
    assert_course(way, 1e-14, |t| match t {
        t if t < 0.5 => 0.0,
        t if t < 1.0 => 2.0 * (t - 0.5),
        t if t < 1.5 => 1.0 - (t - 1.0),
        _ => 0.5,
    });
}

#[test]
fn periodic_modulated_and_decaying_formulas() {
    let periodic = "*AMPLITUDE, NAME=Way, DEFINITION=PERIODIC
2, 3., 0., 0.25\n0.1, 0.2, 0.3, 0.4\n";
    assert_course(periodic, 1e-13, |t| {
        let first = 0.1 * (3.0 * t).cos() + 0.2 * (3.0 * t).sin();
        let second = 0.3 * (6.0 * t).cos() + 0.4 * (6.0 * t).sin();
        0.5 * (0.25 + first + second)
    });
    let modulated = "*AMPLITUDE, NAME=Way, DEFINITION=MODULATED\n1., 2., 0., 3., 10.\n";
    assert_course(modulated, 1e-13, |t| {
        0.5 * (1.0 + 2.0 * (3.0 * t).sin() * (10.0 * t).sin())
    });
    let decay = "*AMPLITUDE, NAME=Way, DEFINITION=DECAY\n0.1, 5., 0., 0.2\n";
    assert_course(decay, 1e-13, |t| 0.5 * (0.1 + 5.0 * (-t / 0.2).exp()));
}

#[test]
fn absolute_values_need_no_reference() {
    let way = "*AMPLITUDE, NAME=Way, VALUE=ABSOLUTE\n0., 0., 2., 0.03\n";
    assert_course(way, 1e-15, |t| 0.015 * t);
}

#[test]
fn velocities_are_integrated() {
    let (listed, constant) = course("", ", TYPE=VELOCITY");
    // Without the amplitude of that name there is nothing to follow.
    assert_listed(
        &listed,
        &["*BOUNDARY of `Pad-1.High`: there is no *AMPLITUDE `Way`"],
    );
    assert!(constant.is_empty());
    let ramp = "*AMPLITUDE, NAME=Way\n0., 0., 2., 1.\n";
    let (listed, course) = course(ramp, ", TYPE=VELOCITY");
    assert_listed(&listed, &[]);
    // v = 0.5 t/2, in twenty straight pieces.
    for [t, found] in course {
        assert!((found - 0.125 * t * t).abs() < 0.125 * 0.05 * 0.05 + 1e-14);
    }
    let step = with("*BOUNDARY, TYPE=VELOCITY\nBase-1.High, 1, 1, 0.25\n");
    let (_, listed, deck) = converted(&model("", &step));
    assert_listed(&listed, &[]);
    let stated = &deck.model.steps[0].displacements;
    assert!(
        stated
            .iter()
            .any(|of| of.numbers() == [Some(0.5), None, None])
    );
}

#[test]
fn what_is_no_course_is_listed() {
    for (amplitude, what) in [
        (
            "*AMPLITUDE, NAME=Way, DEFINITION=USER\n",
            "with DEFINITION=USER",
        ),
        (
            "*AMPLITUDE, NAME=Way\n0., 0., 0., 1.\n",
            "with times that do not rise",
        ),
        (
            "*AMPLITUDE, NAME=Way, DEFINITION=PERIODIC\n1., 2.\n",
            "too few numbers",
        ),
        (
            "*AMPLITUDE, NAME=Way, DEFINITION=DECAY\n0., 1., 1., 1.\n",
            "that begins within a step",
        ),
    ] {
        let (listed, _) = course(amplitude, "");
        assert!(listed.iter().any(|line| line.contains(what)), "{listed:?}");
    }
}

/// In total time an amplitude goes on in the steps after, where a deck has to state it again.
#[test]
fn amplitudes_in_total_time_are_listed_where_steps_leave_them() {
    let way = "*AMPLITUDE, NAME=Way, TIME=TOTAL TIME\n0., 0., 2., 1., 4., 3.\n";
    let driven = with("*BOUNDARY, AMPLITUDE=Way\nPad-1.High, 1, 1, 0.5\n");
    let later = "*STEP, NAME=Later, NLGEOM=YES\n*STATIC\n0.1, 2., 1e-5, 0.5\n";
    let again = "*BOUNDARY, AMPLITUDE=Way\nPad-1.High, 1, 1, 0.5\n";
    let listed = |steps: &str| made(&model("", &format!("{way}{steps}"))).1.listed;
    assert_listed(&listed(&driven), &[]);
    assert_listed(
        &listed(&format!("{driven}{later}*END STEP\n")),
        &["*AMPLITUDE `Way` beyond the end of the step that refers to it"],
    );
    let restated = format!("{driven}{later}{again}*END STEP\n");
    assert_listed(&listed(&restated), &[]);
}
