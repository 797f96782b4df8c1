//! Derivatives of runs beside closed forms, and beside central differences of whole runs.

use std::path::Path;

use striae::{
    Error, Finished, Simulation,
    deck::{Setting, parse_with},
    model::Model,
    output::history::Table,
    sensitivity::parameter,
    solve::outcome::Ending,
};

/// Two blocks, one of them textured, slid back and forth and then across.
const BLOCKS: &str = include_str!("blocks.toml");
/// A dome on a floor with nap, whose contact grows.
const DOME: &str = include_str!("dome.toml");
/// A cap on facets of a fifteenth of its radius, whose supports are partly closed.
const CAP: &str = include_str!("cap.toml");
/// A billet that yields and is released.
const BILLET: &str = include_str!("billet.toml");
/// Blocks in dynamics, the upper one tied to a rigid plate that is free in one direction.
const DYNAMIC: &str = include_str!("../../src/simulation/tests/dynamic.toml");
/// A slice of a pad between planes of symmetry, part of which sticks and part slips.
const SLICE: &str = include_str!("slice.toml");
/// A step after those of the slice, in which it goes back so little that it does not slip.
const TAKEN_BACK: &str = r#"
[[step]]
name = "back"
increments = 2
displacement = [{ body = "pad", nodes = "zmax", x = 0.0495 }]
"#;
/// A block over ridges. One increment asks for other traction fields in its first iteration, and
/// returns to those of its start.
const RIDGES: &str = include_str!("../everything/ridges.toml");
/// A bar on a floor that it just touches at the end of the step.
const BAR: &str = include_str!("bar.toml");

fn model(text: &str, settings: &[Setting]) -> Model {
    let deck = parse_with(text, "deck.toml", Path::new(""), settings);
    let mut model = deck.unwrap_or_else(|faults| panic!("{faults}")).model;
    // What iterations leave would be divided by the step.
    model.solver.tolerance = 1e-12;
    model.solver.further_iterations = 2;
    model
}

fn differentiated(text: &str, name: &str, value: f64) -> Finished {
    let set = |value: f64| vec![Setting::new(name, value)];
    let by = parameter(name, value, |value| {
        Ok::<_, Error>(model(text, &set(value)))
    })
    .unwrap();
    let simulation = Simulation::new(model(text, &set(value))).unwrap();
    let finished = simulation.differentiated(by).run().unwrap();
    assert_eq!(finished.ending, Ending::Completed);
    finished
}

/// Error that is left to differences of whole runs: of their steps, and of round-off over these.
const BOUND: f64 = 1e-5;
/// Steps of differences over the parameter.
const STEPS: [f64; 3] = [1e-4, 1e-5, 1e-6];

/// Compares derivatives by a number of a deck with central differences of whole runs, column by
/// column over all increments, by the largest derivative of the column, or of the vector that it is
/// a component of, at the step that serves a column best.
fn compare(text: &str, name: &str, value: f64) {
    let finished = differentiated(text, name, value);
    let own = &finished.sensitivities[0];
    assert!(own.ended.is_none() && own.kinks().is_empty());
    let warnings = &finished.summary.warnings;
    assert!(warnings.iter().all(|warning| warning.kind != "sensitivity"));
    let history = |value: f64| {
        let moved = model(text, &[Setting::new(name, value)]);
        Simulation::new(moved).unwrap().run().unwrap().history
    };
    let whole = STEPS.map(|part| {
        let step = part * value;
        (step, [value - step, value + step].map(history))
    });
    // What a user reads of a run: energies, forces of contact, centres of bodies.
    let is_wanted = |column: &str| {
        let last = column.rsplit('.').next().unwrap();
        ["strain", "external", "friction", "inelastic", "dissipated"].contains(&last)
            || column.contains(".resultant_a.")
            || column.starts_with("centre.")
    };
    let mut compared = 0;
    for column in &own.history.columns {
        if !is_wanted(column) {
            continue;
        }
        let derivative = own.history.column(column).unwrap();
        // Components that symmetry keeps at zero are round-off beside those of the same vector.
        let vector: Vec<String> = match column.rsplit_once('.') {
            Some((name, "x" | "y" | "z")) => {
                ["x", "y", "z"].map(|at| format!("{name}.{at}")).into()
            }
            _ => vec![column.clone()],
        };
        let most = |table: &Table| {
            let columns = vector.iter().map(|name| table.column(name).unwrap());
            columns.map(largest).fold(0.0, f64::max)
        };
        let (size, values) = (most(&own.history), most(&finished.history));
        // What depends on the parameter by round-off alone has no derivative to compare.
        if size * value <= 1e-7 * values {
            continue;
        }
        let errors = whole.each_ref().map(|(step, sides)| {
            let [less, more] = sides.each_ref().map(|table| table.column(column).unwrap());
            let both = less.iter().zip(&more);
            let whole = both.map(|(less, more)| (more - less) / (2.0 * step));
            largest(derivative.iter().zip(whole).map(|(own, whole)| own - whole)) / size
        });
        let least = errors.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(
            least < BOUND,
            "{column} by {name}: {errors:?} at steps {STEPS:?}"
        );
        compared += 1;
    }
    assert!(compared > 5, "{compared} columns depend on {name}");
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values
        .into_iter()
        .fold(0.0, |largest, value| largest.max(value.abs()))
}

#[test]
fn by_constants_of_friction() {
    compare(BLOCKS, "pair.interface.friction.mu_along", 0.2);
    compare(DOME, "pair.contact.friction.mu_backward", 0.5);
}

#[test]
fn by_the_angle_of_a_texture() {
    compare(BLOCKS, "pair.interface.a.texture.uniform.1", 1.0);
}

#[test]
fn by_the_target_of_a_displacement() {
    compare(BLOCKS, "step.slide.displacement.0.x", 0.1);
}

#[test]
fn by_the_height_of_a_body() {
    compare(DOME, "height", 1.0);
}

#[test]
fn by_the_radius_of_a_cap_whose_contact_grows() {
    // Open shares of supports, on which the next increment depends, change without jumps.
    compare(CAP, "radius", 0.03);
    compare(CAP, "radius", 0.0263);
}

#[test]
fn of_a_slice_whose_friction_has_one_direction() {
    compare(SLICE, "width", 1.0);
    compare(SLICE, "pair.foot.friction.mu", 0.4);
    compare(SLICE, "material.rubber.youngs_modulus", 1e6);
}

#[test]
fn of_a_slice_that_is_taken_back_a_little() {
    // Nodes stick on the verge of slip, from where a start that a width moves by 1e-5 must not make
    // them slip.
    let taken_back = format!("{SLICE}{TAKEN_BACK}");
    compare(&taken_back, "width", 1.0);
    compare(&taken_back, "pair.foot.friction.mu", 0.4);
}

#[test]
fn of_a_slice_that_sticks_beyond_the_law() {
    // The corrector lets nodes stick that the rows of its neighbours alone would make slip.
    let strategy = r#"
        [solver]
        strategy = { method = "table-1", stick_tolerance = 0.1 }
    "#;
    let corrected = format!("{SLICE}{TAKEN_BACK}{strategy}");
    compare(&corrected, "width", 1.0);
    compare(&corrected, "pair.foot.friction.mu", 0.4);
}

#[test]
fn pressure_of_a_slice_that_sticks_depends_on_no_width() {
    let pressed = SLICE.split("[[step]]\nname = \"drag\"").next().unwrap();
    let pressed = pressed.replace("[3, 1, 2]", "[1, 1, 1]");
    let finished = differentiated(&pressed.replace("mu = 0.4", "mu = 3"), "width", 1.0);
    let history = &finished.sensitivities[0].history;
    let by_width = history.column("pair.foot.max_pressure").unwrap();
    // Strains are uniform, whatever the width.
    assert!(by_width.iter().all(|by| by.abs() < 1e-3), "{by_width:?}");
}

#[test]
fn by_constants_of_metal_that_yields_and_is_released() {
    compare(BILLET, "material.metal.yield_stress", 250e6);
    compare(BILLET, "pair.top.friction.mu", 0.1);
}

#[test]
fn with_inertia_and_a_body_that_is_tied() {
    compare(DYNAMIC, "pair.interface.friction.mu", 0.3);
    compare(DYNAMIC, "material.solid.density", 1000.0);
}

#[test]
fn force_of_a_bar_by_its_modulus_and_by_its_friction() {
    let pressed = BAR.replace("z = -0.01", "z = -0.02");
    let finished = differentiated(&pressed, "material.elastic.youngs_modulus", 1e4);
    // F = E A u / L of the linear bar without lateral strain.
    let by_modulus = finished.sensitivities[0]
        .history
        .column("pair.foot.resultant_a.z")
        .unwrap();
    assert!((by_modulus.last().unwrap() - 0.01).abs() < 1e-10);
    let by_state = finished.sensitivities[0].derivative(|results| {
        let pair = results.pair("foot").unwrap();
        pair.sides[0].force.z * pair.sides[0].force.z
    });
    let force = *finished
        .history
        .column("pair.foot.resultant_a.z")
        .unwrap()
        .last()
        .unwrap();
    assert!((by_state - 2.0 * force * 0.01).abs() < 1e-7 * by_state);
}

#[test]
fn a_node_that_just_touches_is_named() {
    let finished = differentiated(BAR, "step.press.displacement.0.z", -0.01);
    let kinks = finished.sensitivities[0].kinks();
    assert!(!kinks.is_empty());
    let warnings = &finished.summary.warnings;
    let kink = warnings
        .iter()
        .find(|warning| warning.kind == "kink")
        .unwrap();
    assert!(
        kink.text.contains("one-sided") && kink.text.contains("pair `foot`"),
        "{}",
        kink.text
    );
}

#[test]
fn a_parameter_that_nothing_uses_is_named() {
    let pressed = BAR.replace("z = -0.01", "z = -0.02");
    let text = format!("parameters = {{ unused = 3 }}\n{pressed}");
    let told = |name: &str, value: f64| {
        let finished = differentiated(&text, name, value);
        let warnings = finished.summary.warnings.into_iter();
        let warnings = warnings.filter(|warning| warning.kind == "sensitivity");
        warnings.map(|of| of.text).collect::<Vec<_>>()
    };
    assert_eq!(
        told("unused", 3.0),
        [
            "derivatives by `unused` are all zero, as the model does not depend on it; name a number that the model uses"
        ]
    );
    // Friction of nodes that do not slip has no effect, but is used.
    let of_friction = told("pair.foot.friction.mu", 0.3);
    assert!(!of_friction.iter().any(|text| text.contains("all zero")));
}

#[test]
fn the_run_itself_stays_as_it_is() {
    let alone = Simulation::new(model(DOME, &[])).unwrap().run().unwrap();
    let with = differentiated(DOME, "height", 1.0);
    assert_eq!(alone.history, with.history);
}

#[test]
fn a_parameter_that_changes_the_mesh_is_refused() {
    let divided = |value: f64| -> Result<Model, Error> {
        let divisions = format!("divisions = [{}, 2, 2]", if value < 2.0 { 2 } else { 3 });
        Ok(model(
            &BAR.replace("divisions = [2, 2, 2]", &divisions),
            &[],
        ))
    };
    let simulation = Simulation::new(model(BAR, &[])).unwrap();
    let by = parameter("divisions", 2.0, divided).unwrap();
    let refused = simulation.differentiated(by).run().unwrap_err().to_string();
    assert!(
        refused.contains("`divisions` changes the elements"),
        "{refused}"
    );
}

#[test]
fn a_parameter_that_changes_the_formulation_is_refused() {
    // Elements take mean dilatation above a Poisson's ratio of 0.45.
    let ratio = |value: f64| -> Result<Model, Error> {
        Ok(model(
            BAR,
            &[Setting::new("material.elastic.poissons_ratio", value)],
        ))
    };
    let simulation = Simulation::new(ratio(0.45).unwrap()).unwrap();
    let by = parameter("nu", 0.45, ratio).unwrap();
    let refused = simulation.differentiated(by).run().unwrap_err().to_string();
    assert!(
        refused.contains("`nu` changes the formulation of elements"),
        "{refused}"
    );
}

#[test]
fn fields_that_return_to_those_of_the_start_are_differentiated() {
    let contact = "[contact]\nall = true\nfriction = { law = \"coulomb\", mu = 0.5788 }";
    compare(
        &RIDGES.replace("CONTACT", contact),
        "contact.friction.mu",
        0.5788,
    );
}
