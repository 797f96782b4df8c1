//! Output by choice: fields, bodies, intervals, probes, what slip has done, resultants.
//!
//! Longer than other files, as all of them look at one deck.

use std::path::Path;

use striae::{
    Simulation, deck,
    output::{
        Existing,
        history::Table,
        vtk::{Snapshot, Stored, read_series},
    },
};

const DECK: &str = r#"
title = "A bar pressed on a floor and drawn over it"

[[material]]
name = "solid"
law = "linear-elastic"
youngs_modulus = 1000
poissons_ratio = 0

[[body]]
name = "bar"
material = "solid"
mesh = { generator = "block", origin = [2, 3, 0], size = [1, 1, 2], divisions = [3, 2, 2], cells = "CELLS" }

[[body]]
name = "weight"
material = "solid"
mesh = { generator = "block", origin = [9, 9, 0], size = [1, 1, 1], divisions = [1, 1, 1] }

[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }

[[pair]]
name = "foot"
a = { body = "bar", facets = "zmin" }
b = { rigid = "floor", texture = { uniform = [0.6, 0.8, 0] } }
friction = { law = "coulomb", mu = 0.5 }

[[step]]
name = "press"
increments = 4
displacement = [
    { body = "bar", nodes = "zmax", z = -0.02 },
    { body = "bar", nodes = "all", x = 0, y = 0 },
    { body = "weight", nodes = "all", x = 0, y = 0, z = 0 },
]

[[step]]
name = "draw"
increments = 8
displacement = [{ body = "bar", nodes = "all", x = 0.1 }]

[output]
fields_interval = 0.5
bodies = ["bar"]
body_fields = [
    "displacement", "principal-stress", "strain-energy-density", "logarithmic-strain",
    "principal-strain", "principal-stress-directions",
]
contact_fields = ["gap", "slip-rate", "accumulated-slip", "friction-work"]
wear_coefficient = 0.001
probes = [
    { name = "middle", body = "bar", point = [2.4, 3.3, 0.7] },
    { name = "top", body = "bar", nodes = "zmax" },
]
sections = [
    { name = "low", body = "bar", point = [0, 0, 0.9], normal = [0, 0, 2] },
    { name = "side", body = "bar", point = [2.4, 3.5, 0], normal = [1, 0.1, 0] },
]
"#;

/// Pressure, friction coefficient and way of the drawn bar.
const PRESSURE: f64 = 10.0;
const MU: f64 = 0.5;
const WAY: f64 = 0.1;

fn run(folder: &Path, cells: &str) {
    let deck = deck::parse(&DECK.replace("CELLS", cells), "deck.toml", Path::new("")).unwrap();
    let simulation = Simulation::of(deck).unwrap();
    let simulation = simulation.recorded(folder, "bar").over(Existing::Replace);
    simulation.run().unwrap();
}

fn snapshots(folder: &Path, name: &str) -> Vec<Snapshot> {
    read_series(&folder.join(name)).unwrap()
}

fn assert_all(folder: &Path, snapshot: &Snapshot, name: &str, expected: &[f64]) {
    let path = folder.join(&snapshot.parts[0].1);
    let values = Stored::open(&path)
        .unwrap()
        .array(&path, name)
        .unwrap()
        .unwrap();
    assert_eq!(values.components, expected.len());
    for value in values.numbers.chunks(expected.len()) {
        for (value, expected) in value.iter().zip(expected) {
            let error = (value - expected).abs();
            assert!(
                error < 1e-6 * (1.0 + expected.abs()),
                "{name}: {value} for {expected}"
            );
        }
    }
}

#[test]
fn fields_bodies_and_intervals_are_those_chosen() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    run(folder, "hexahedra");
    let bodies = snapshots(folder, "bodies.pvd");
    let times: Vec<f64> = bodies.iter().map(|snapshot| snapshot.time).collect();
    assert_eq!(times, [0.0, 0.5, 1.0, 1.5, 2.0]);
    let names: Vec<&str> = bodies[1].parts.iter().map(|part| part.0.as_str()).collect();
    assert_eq!(names, ["bar"]);
    let path = folder.join(&bodies[1].parts[0].1);
    let stored = Stored::open(&path).unwrap();
    let names: Vec<&str> = stored.names().map(|name| name.0).collect();
    assert_eq!(
        names,
        [
            "displacement",
            "principal_stress",
            "strain_energy_density",
            "logarithmic_strain",
            "principal_strain",
            "principal_stress_direction_1",
            "principal_stress_direction_2",
            "principal_stress_direction_3",
        ]
    );
    let shortened = f64::ln(0.99);
    let strain = [0.0, 0.0, shortened, 0.0, 0.0, 0.0];
    assert_all(folder, &bodies[2], "logarithmic_strain", &strain);
    assert_all(
        folder,
        &bodies[2],
        "principal_strain",
        &[0.0, 0.0, shortened],
    );
    let third = "principal_stress_direction_3";
    assert_all(folder, &bodies[2], third, &[0.0, 0.0, 1.0]);
    // Half the energy of stress and strain, uniaxial.
    assert_all(
        folder,
        &bodies[2],
        "principal_stress",
        &[0.0, 0.0, -PRESSURE],
    );
    assert_all(
        folder,
        &bodies[2],
        "strain_energy_density",
        &[0.5 * PRESSURE * 0.01],
    );
}

#[test]
fn slip_work_and_wear_add_up() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    run(folder, "hexahedra");
    let contact = snapshots(folder, "contact.pvd");
    let last = contact.last().unwrap();
    assert_all(folder, last, "accumulated_slip", &[WAY]);
    assert_all(folder, last, "friction_work", &[MU * PRESSURE * WAY]);
    assert_all(folder, last, "wear_depth", &[0.001 * PRESSURE * WAY]);
    // The step takes a time of 1.
    assert_all(folder, last, "slip_rate", &[WAY, 0.0, 0.0]);
    let path = folder.join(&last.parts[0].1);
    let stored = Stored::open(&path).unwrap();
    let names: Vec<&str> = stored.names().map(|name| name.0).collect();
    let chosen = [
        "gap",
        "slip_rate",
        "accumulated_slip",
        "friction_work",
        "wear_depth",
    ];
    assert_eq!(names, chosen);
    let history = Table::read(&folder.join("history.csv")).unwrap();
    let end = |name: &str| *history.column(name).unwrap().last().unwrap();
    // On an area of 1 the work is that of the pair.
    assert!((end("pair.foot.dissipated") - MU * PRESSURE * WAY).abs() < 1e-6);
    assert!((end("pair.foot.area") - 1.0).abs() < 1e-9);
    for (axis, expected) in [("x", 2.5 + WAY), ("y", 3.5), ("z", 0.0)] {
        let centre = end(&format!("pair.foot.centre.{axis}"));
        assert!((centre - expected).abs() < 1e-9, "{axis}: {centre}");
    }
}

/// The floor feels friction along x, in the frame of its grooves `s = (.6, .8, 0)` with
/// `a = n x s = (-.8, .6, 0)`.
#[test]
fn forces_are_resolved_along_and_across_the_grooves_of_a_plane() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "hexahedra");
    let text = std::fs::read_to_string(folder.path().join("history.csv")).unwrap();
    assert!(
        text.lines().nth(1).unwrap().starts_with("1,1,0.25,"),
        "{text}"
    );
    let history = Table::read(&folder.path().join("history.csv")).unwrap();
    let end = |name: &str| *history.column(name).unwrap().last().unwrap();
    let friction = MU * PRESSURE;
    for (name, expected) in [
        ("resultant_b.x", friction),
        ("along_b", 0.6 * friction),
        ("across_b", -0.8 * friction),
    ] {
        let found = end(&format!("pair.foot.{name}"));
        assert!((found - expected).abs() < 1e-6, "{name}: {found}");
    }
    assert_eq!(history.column("pair.foot.along_a"), None);
}

/// The foot of a bar that is held at its top has no reaction, only a residual.
#[test]
fn reactions_are_those_of_sets_that_something_holds() {
    let folder = tempfile::tempdir().unwrap();
    let held = r#"body = "bar", nodes = "all""#;
    assert_eq!(DECK.matches(held).count(), 2);
    let text = DECK.replace("CELLS", "hexahedra");
    let text = text.replace(held, r#"body = "bar", nodes = "zmax""#);
    let deck = deck::parse(&text, "deck.toml", Path::new("")).unwrap();
    let simulation = Simulation::of(deck).unwrap();
    simulation.recorded(folder.path(), "bar").run().unwrap();
    let history = Table::read(&folder.path().join("history.csv")).unwrap();
    for (name, is_there) in [("zmax", true), ("all", true), ("zmin", false)] {
        let column = history.column(&format!("reaction.bar.{name}.z"));
        assert_eq!(column.is_some(), is_there, "{name}");
    }
    assert!(history.column("reaction.floor.z").is_some());
}

/// A cut transmits the loads beyond it, through any kind of elements.
#[test]
fn cuts_transmit_what_acts_beyond_them() {
    for cells in ["hexahedra", "wedges", "pyramids", "tetrahedra"] {
        let folder = tempfile::tempdir().unwrap();
        run(folder.path(), cells);
        let sections = Table::read(&folder.path().join("sections.csv")).unwrap();
        assert_eq!(sections.rows.len(), 12);
        let end = |name: &str| *sections.column(name).unwrap().last().unwrap();
        let assert_end = |name: &str, expected: f64| {
            let found = end(name);
            assert!((found - expected).abs() < 1e-6, "{cells}, {name}: {found}");
        };
        assert_end("low.force.x", 0.0);
        assert_end("low.force.z", -PRESSURE);
        assert_end("side.force.x", 0.0);
        assert_end("side.force.z", 0.0);
        if cells == "hexahedra" {
            for (name, expected) in [
                ("low.normal_force", -PRESSURE),
                ("low.shear_force", 0.0),
                ("low.area", 1.0),
                ("low.centre.x", 2.5 + WAY),
                ("low.centre.z", 0.99),
                ("side.normal_force", 0.0),
                ("side.moment.y", 0.0),
                ("side.area", 1.98),
            ] {
                assert_end(name, expected);
            }
        }
    }
}

#[test]
fn states_of_friction_are_those_of_the_time_and_the_slip() {
    let state = r#"mu = 0.5, by_state = { form = "ageing-law", direct_effect = 0.01, evolution_effect = 0.015, slip_rate = 0.1, slip_distance = 0.2, state = 3 }"#;
    let text = DECK.replace("mu = 0.5", state);
    let text = text.replace(r#""gap", "slip-rate""#, r#""friction-state", "slip-rate""#);
    let folder = tempfile::tempdir().unwrap();
    let (folder, text) = (folder.path(), text.replace("CELLS", "hexahedra"));
    let deck = deck::parse(&text, "deck.toml", Path::new("")).unwrap();
    let simulation = Simulation::of(deck).unwrap();
    simulation.recorded(folder, "bar").run().unwrap();
    let contact = snapshots(folder, "contact.pvd");
    // In the step of a time of 1 in which the bar is pressed it ages, then it slips at 0.1.
    let left = (-0.1_f64 / 0.2).exp();
    let slid = 4.0 * left + 2.0 * (1.0 - left);
    assert_all(folder, &contact[2], "friction_state", &[4.0]);
    assert_all(folder, contact.last().unwrap(), "friction_state", &[slid]);
}

#[test]
fn the_state_of_healing_is_written() {
    let friction = r#"friction = { law = "coulomb", mu = 0.5, by_state = { form = "static-kinetic", kinetic_over_static = 0.6, slip_distance = 0.2, healing_time = 2, state = 0.3 } }"#;
    let text = DECK.replace(r#"friction = { law = "coulomb", mu = 0.5 }"#, friction);
    let text = text.replace(r#""gap", "slip-rate""#, r#""friction-state", "slip-rate""#);
    let folder = tempfile::tempdir().unwrap();
    let (folder, text) = (folder.path(), text.replace("CELLS", "hexahedra"));
    let deck = deck::parse(&text, "deck.toml", Path::new("")).unwrap();
    let simulation = Simulation::of(deck).unwrap();
    simulation.recorded(folder, "bar").run().unwrap();
    let contact = snapshots(folder, "contact.pvd");
    // It heals for a time of 1, then slips at 0.1.
    let rested = 1.0 - 0.7 * (-0.5_f64).exp();
    let steady = 0.5 / (0.5 + 0.5);
    let slid = steady + (rested - steady) * (-1.0_f64).exp();
    assert_all(folder, &contact[2], "friction_state", &[rested]);
    assert_all(folder, contact.last().unwrap(), "friction_state", &[slid]);
}

#[test]
fn contact_is_written_as_it_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let lifted = DECK.replace("[2, 3, 0]", "[2, 3, 0.01]");
    let moved = lifted.replace("[2.4, 3.3, 0.7]", "[2.4, 3.3, 0.71]");
    let text = moved.replace("CELLS", "hexahedra");
    let deck = deck::parse(&text, "deck.toml", Path::new("")).unwrap();
    let simulation = Simulation::of(deck).unwrap();
    simulation.recorded(folder, "bar").run().unwrap();
    let contact = snapshots(folder, "contact.pvd");
    assert_eq!(contact[0].time, 0.0);
    assert_all(folder, &contact[0], "gap", &[0.01]);
    assert_all(folder, &contact[0], "accumulated_slip", &[0.0]);
}

#[test]
fn probes_are_watched_in_every_increment() {
    for cells in [
        "hexahedra",
        "wedges",
        "pyramids",
        "tetrahedra",
        "composite-tetrahedra",
    ] {
        let folder = tempfile::tempdir().unwrap();
        run(folder.path(), cells);
        let probes = Table::read(&folder.path().join("probes.csv")).unwrap();
        assert_eq!(probes.rows.len(), 12);
        let end = |name: &str| *probes.column(name).unwrap().last().unwrap();
        for (name, expected) in [
            ("time", 2.0),
            ("middle.displacement.x", WAY),
            ("middle.displacement.z", -0.01 * 0.7),
            ("middle.stress.zz", -PRESSURE),
            ("middle.stress.xy", 0.0),
            ("middle.von_mises", PRESSURE),
            ("top.displacement.z", -0.02),
        ] {
            assert!((end(name) - expected).abs() < 1e-6, "{name}: {}", end(name));
        }
    }
}

#[test]
fn what_is_not_there_is_refused_where_it_is_written() {
    for (old, new, words) in [
        (
            r#"bodies = ["bar"]"#,
            r#"bodies = ["bat"]"#,
            "did you mean `bar`",
        ),
        (
            "[2.4, 3.3, 0.7]",
            "[0, 0, 0]",
            "probe `middle` cannot be placed: (0, 0, 0) is outside",
        ),
        (
            r#"nodes = "zmax" },
]"#,
            r#"nodes = "lid" },
]"#,
            "no node set `lid`",
        ),
        (
            r#"name = "top""#,
            r#"name = "middle""#,
            "another probe `middle`",
        ),
        (
            "normal = [0, 0, 2]",
            "normal = [0, 0, 0]",
            "section `low` does not cut its body: its normal is zero",
        ),
        (
            "point = [2.4, 3.5, 0]",
            "point = [9, 3.5, 0]",
            "section `side` does not cut its body: all elements of the body are behind the plane",
        ),
        (
            r#"name = "side""#,
            r#"name = "low""#,
            "another section `low`",
        ),
        (
            r#""slip-rate""#,
            r#""slip-rates""#,
            "did you mean `slip-rate`",
        ),
        (
            "fields_interval = 0.5",
            "fields_interval = 0.5\nfields_every = 2",
            "exclude each other",
        ),
        (
            r#""principal-stress","#,
            r#""principal-stres","#,
            "did you mean `principal-stress`",
        ),
    ] {
        assert_eq!(DECK.matches(old).count(), 1, "{old}");
        let text = DECK.replace("CELLS", "hexahedra").replace(old, new);
        let refused = deck::parse(&text, "deck.toml", Path::new(""))
            .unwrap_err()
            .to_string();
        assert!(refused.contains(words), "{refused}");
    }
}
