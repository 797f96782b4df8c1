//! Loads: forces, pressures, tractions, gravity.

use super::{assert_listed, converted, model, with};
use striae_mesh::Vec3;
use striae_model::{Curve, LoadKind, NodalForce};

fn each(force: &NodalForce) -> Vec3 {
    force.force.map(|value| value.number().expect("a number"))
}

#[test]
fn concentrated_forces_are_at_each_node_of_a_set() {
    let step = with("*CLOAD\nPad-1.High, 3, -2.\nPad-1.High, 1, 0.5\nBase-1.7, 1, 4.\n");
    let (text, listed, deck) = converted(&model("", &step));
    assert_listed(&listed, &[]);
    let forces = &deck.model.steps[0].forces;
    assert_eq!(forces.len(), 2, "{text}");
    let of = |nodes: usize| {
        forces
            .iter()
            .find(|force| force.nodes.len() == nodes)
            .unwrap()
    };
    assert_eq!(each(of(4)), Vec3::new(0.5, 0.0, -2.0));
    assert_eq!(each(of(1)), Vec3::new(4.0, 0.0, 0.0));
}

#[test]
fn forces_of_one_node_in_a_step_add_and_later_steps_modify_them() {
    let first = with("*CLOAD\nPad-1.High, 3, -2.\nPad-1.High, 3, -1.\nPad-1.High, 1, 1.\n");
    let second = "*STEP\n*STATIC\n*CLOAD\nPad-1.High, 3, -5.\n*END STEP\n";
    let third = "*STEP\n*STATIC\n*CLOAD, OP=NEW\nBase-1.High, 2, 7.\n*END STEP\n";
    let (_, listed, deck) = converted(&model("", &(first + second + third)));
    assert_listed(&listed, &[]);
    let forces =
        |step: usize| -> Vec<Vec3> { deck.model.steps[step].forces.iter().map(each).collect() };
    assert_eq!(forces(0), [Vec3::new(1.0, 0.0, -3.0)]);
    // What is not stated again stays, and ends by OP=NEW.
    assert_eq!(forces(1), [Vec3::new(1.0, 0.0, -5.0)]);
    assert_eq!(forces(2), [Vec3::new(0.0, 7.0, 0.0), Vec3::zeros()]);
}

#[test]
fn forces_of_other_sets_at_the_same_nodes_replace_those_before() {
    let saw = "*AMPLITUDE, NAME=Saw\n0., 0., 1., 3., 2., 0., 4., 2.\n";
    let first = with("*CLOAD\nPad-1.High, 3, -2.\n");
    let later = |rows: &str, option: &str| {
        let first = match option.contains("Saw") {
            true => saw.to_owned() + &first,
            false => first.clone(),
        };
        let second = format!("*STEP\n*STATIC\n*CLOAD{option}\n{rows}*END STEP\n");
        converted(&model("", &(first + &second)))
    };
    let all: String = (5..9)
        .map(|node| format!("Pad-1.{node}, 3, -5.\n"))
        .collect();
    let (_, listed, deck) = later(&all, "");
    assert_listed(&listed, &[]);
    let forces = deck.model.steps[1].forces.iter();
    let mut forces: Vec<_> = forces.map(|of| (of.nodes.len(), each(of).z)).collect();
    forces.sort_by_key(|(count, _)| *count);
    assert_eq!(
        forces,
        [(1, -5.0), (1, -5.0), (1, -5.0), (1, -5.0), (4, 0.0)]
    );
    let kept = ["*CLOAD: its nodes keep the force that an earlier step states for `Pad-1.High`"];
    assert_listed(&later("Pad-1.7, 3, -5.\n", "").1, &kept);
    assert_listed(&later(&all, ", AMPLITUDE=Saw").1, &kept);
    for (rows, option) in [
        ("Pad-1.7, 3, -5.\n", ", OP=NEW"),
        ("Pad-1.7, 1, -5.\n", ""),
        ("Pad-1.1, 3, -5.\n", ""),
        ("Base-1.7, 3, -5.\n", ""),
    ] {
        assert_listed(&later(rows, option).1, &[]);
    }
}

#[test]
fn equal_pressures_of_a_face_add() {
    let step = with("*DLOAD\nPad-1.1, P2, 3.\nPad-1.All, P2, 3.\nBase-1.1, P4, 3.\n");
    let (_, listed, deck) = converted(&model("", &step));
    assert_listed(&listed, &[]);
    let mut values: Vec<f64> = Vec::new();
    for load in &deck.model.steps[0].loads {
        let LoadKind::Pressure(value) = &load.kind else {
            panic!("{:?}", load.kind);
        };
        values.push(value.number().unwrap());
    }
    values.sort_by(f64::total_cmp);
    assert_eq!(values, [3.0, 6.0]);
}

#[test]
fn forces_with_an_amplitude_follow_it_over_the_run() {
    let saw = "*AMPLITUDE, NAME=Saw\n0., 0., 1., 3., 2., 0.\n";
    let step = saw.to_owned()
        + &with("*CLOAD, AMPLITUDE=Saw\nPad-1.High, 3, -2.\n")
        + "*STEP\n*STATIC\n0.1, 2.\n*CLOAD, AMPLITUDE=Saw\nPad-1.High, 3, 4.\n*END STEP\n";
    let (_, listed, deck) = converted(&model("", &step));
    assert_listed(&listed, &[]);
    let moments = striae_model::Moment::start(2.0);
    for (step, start, value) in [(0, 0.0, -2.0), (1, 2.0, 4.0)] {
        let force = &deck.model.steps[step].forces[0];
        assert_eq!(each(force).z, value);
        for (s, a) in [(0.0, 0.0), (0.25, 1.5), (0.5, 3.0), (0.75, 1.5), (1.0, 0.0)] {
            let mut moment = moments.later(s);
            moment.time = start + 2.0 * s;
            let found = force.curve.at(moment);
            assert!((found - a).abs() < 1e-12, "{step} {s}: {found}");
        }
    }
}

#[test]
fn amplitudes_of_one_force_are_not_mixed() {
    let step = "*AMPLITUDE, NAME=Saw\n0., 0., 1., 3., 2., 0.\n".to_owned()
        + &with("*CLOAD\nPad-1.High, 1, 1.\n*CLOAD, AMPLITUDE=Saw\nPad-1.High, 3, -2.\n");
    let (_, listed, _) = converted(&model("", &step));
    let said = [
        "*AMPLITUDE `Saw`, which nothing here follows",
        "*CLOAD `Pad-1.High, 3, -2.`: a load has one amplitude in a step",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn pressures_of_elements_are_on_their_faces() {
    let step = with("*DLOAD\nPad-1.All, P2, 3.\nBase-1.1, P4, 5.\n");
    let later = "*STEP\n*STATIC\n*DLOAD\nPad-1.1, P2, 8.\n*END STEP\n";
    let (_, listed, deck) = converted(&model("", &(step + later)));
    assert_listed(&listed, &[]);
    let pressed = |step: usize| -> Vec<(usize, f64, f64)> {
        let loads = deck.model.steps[step].loads.iter();
        let all = loads.map(|load| {
            let mesh = &deck.model.bodies[load.body.0].mesh;
            let [face] = load.faces[..] else {
                panic!("{:?}", load.faces);
            };
            let nodes = mesh
                .face_nodes(face)
                .map(|node| mesh.positions[node.index()]);
            let x = nodes.iter().map(|x| x.x).sum::<f64>() / 4.0;
            match load.kind.numbers() {
                Some(LoadKind::Pressure(value)) => (load.body.0, x, value),
                other => panic!("{other:?}"),
            }
        });
        all.collect()
    };
    // Side 2 of a hexahedron is on top, side 4 at x = 1.
    assert_eq!(pressed(0), [(0, 1.0, 5.0), (1, 0.5, 3.0)]);
    assert_eq!(pressed(1), [(1, 0.5, 8.0)]);
}

#[test]
fn inner_faces_and_other_forces_per_volume_are_listed() {
    let loads = "*DLOAD\nPad-1.All, P7, 1.\nPad-1.All, CENTRIF, 100., 0., 0., 0., 0., 0., 1.
Pad-1.All, HP, 1., 2., 3.\n*DSLOAD\nPad-1.Nothing, P, 1.\n";
    let (_, listed, _) = converted(&model("", &with(loads)));
    let said = [
        "*DLOAD `Pad-1.All, P7, 1.`",
        "*DLOAD `Pad-1.All, CENTRIF, 100., 0., 0., 0., 0., 0., 1.`: gravity is the only",
        "*DLOAD `Pad-1.All, HP, 1., 2., 3.`",
        "*DSLOAD `Pad-1.Nothing, P, 1.`",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn pressures_between_elements_are_listed() {
    let upper = "*NODE\n9, 0., 0., 2.\n10, 1., 0., 2.\n11, 1., 1., 2.\n12, 0., 1., 2.\n*ELEMENT, TYPE=C3D8, ELSET=All\n2, 5, 6, 7, 8, 9, 10, 11, 12\n";
    let cube = "1, 1, 2, 3, 4, 5, 6, 7, 8\n";
    let of = |word: &str| {
        let model = model("", &with(&format!("*DLOAD\n{word}, P2, 1.\n")));
        let model = model.replace(cube, &format!("{cube}{upper}"));
        let (_, listed, deck) = converted(&model.replace("Cube\n0., 0., 1.", "Cube\n0., 0., 2."));
        let faces = deck.model.steps[0].loads.first();
        (listed, faces.map_or(0, |load| load.faces.len()))
    };
    let (listed, faces) = of("Pad-1.All");
    let said = ["*DLOAD `Pad-1.All, P2, 1.`: pressures on faces between elements are left out"];
    assert_listed(&listed, &said);
    assert_eq!(faces, 1);
    assert_listed(&of("Pad-1.2").0, &[]);
    let said = ["*DLOAD `Pad-1.1, P2, 1.`, which is no outer face of a body"];
    assert_listed(&of("Pad-1.1").0, &said);
}

#[test]
fn gravity_of_some_bodies_is_told_to_be_on_all() {
    let of = |words: &str| with(&format!("*DLOAD\n{words}"));
    let both = "Pad-1.All, GRAV, 2., 0., 0., -1.\nBase-1.All, GRAV, 2., 0., 0., -1.\n";
    let (_, listed, deck) = converted(&model("", &of(both)));
    assert_listed(&listed, &[]);
    let gravity = deck.model.steps[0].gravity.as_ref().unwrap();
    assert_eq!(gravity.acceleration, Vec3::new(0.0, 0.0, -2.0));
    let (_, listed, _) = converted(&model("", &of("Pad-1.All, GRAV, 2., 0., 0., -1.\n")));
    assert_listed(
        &listed,
        &["*DLOAD, GRAV of `Pad-1.All`: gravity is on all bodies"],
    );
}

#[test]
fn tractions_of_fixed_and_of_turning_direction() {
    let step = with(
        "*DSLOAD, FOLLOWER=NO\nPad-1.Top, TRVEC, 2., 0., 0., 3.\n*DSLOAD\nBase-1.Top, TRVEC, 1., 1., 0., 0.\n",
    );
    let (_, listed, deck) = converted(&model("", &step));
    assert_listed(&listed, &[]);
    let kinds: Vec<_> = deck.model.steps[0]
        .loads
        .iter()
        .map(|load| load.kind.numbers().unwrap())
        .collect();
    assert!(kinds.contains(&LoadKind::DeadTraction(Vec3::new(0.0, 0.0, 2.0))));
    assert!(kinds.contains(&LoadKind::FollowerTraction(Vec3::new(1.0, 0.0, 0.0))));
}

#[test]
fn loads_of_dynamic_steps_act_at_once() {
    let step = with("*CLOAD\nPad-1.High, 1, 1.\n").replace("*STATIC", "*DYNAMIC, ALPHA=-0.05");
    let (_, listed, deck) = converted(&model("", &step));
    assert_listed(&listed, &[]);
    assert_eq!(deck.model.steps[0].forces[0].curve, Curve::Constant);
}

#[test]
fn forces_in_turned_axes_are_listed() {
    let turned = "*TRANSFORM, NSET=Pad-1.High\n0., 1., 0., -1., 0., 0.\n";
    let step = with("*CLOAD\nPad-1.High, 1, 1.\n");
    let (_, listed, _) = converted(&model(turned, &step));
    assert_listed(
        &listed,
        &["*CLOAD `Pad-1.High, 1, 1.` in the axes of a *TRANSFORM"],
    );
}
