//! Decks made of Abaqus models: keyword by keyword, and what has no counterpart.
//!
//! Longer than other files, as each keyword has a test.

mod amplitudes;
mod contact;
#[path = "../driven/mod.rs"]
mod driven;
mod listed;
mod loads;
mod meshes;
mod output;
mod physics;
mod rigid;
mod springs;
mod steps;

use std::path::PathBuf;
use striae_deck::{Deck, convert, parse};
use striae_declared::Kind;
use striae_law::friction::Law;
use striae_mesh::Vec3;
use striae_model::{Axes, Curve, Displacement, LoadKind, Procedure, RigidShape};

/// A part of one cube with its sides as sets and surfaces.
const CUBE: &str = "*PART, NAME=Cube
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
*NODE
1, 0.5, 0.5, 3.
*NSET, NSET=RP
1,
";

const FOAM: &str = "*MATERIAL, NAME=foam
*DENSITY
2e-9
*ELASTIC
100., 0.
";

const STEP: &str = "*STEP, NAME=Press, NLGEOM=YES
*STATIC
0.1, 2., 1e-5, 0.5
*BOUNDARY
Base-1.Low, 1, 3
Pad-1.Low, 1, 2
Pad-1.High, 3, 3, -0.02
*END STEP
";

/// The deck made of a model, and what is listed.
fn made(model: &str) -> (tempfile::TempDir, striae_deck::Converted) {
    let folder = tempfile::tempdir().unwrap();
    let path: PathBuf = folder.path().join("model.inp");
    std::fs::write(&path, model).unwrap();
    let made = convert(&path, "model.inp").unwrap();
    (folder, made)
}

/// The deck made of a model, what is listed, and the model that the deck reads to.
fn converted(model: &str) -> (String, Vec<String>, Deck) {
    let (folder, made) = made(model);
    let deck = parse(&made.deck, "model.toml", folder.path());
    let deck = deck.unwrap_or_else(|faults| panic!("{faults}\n{}", made.deck));
    (made.deck, made.listed, deck)
}

fn model(assembly: &str, more: &str) -> String {
    format!("{CUBE}{assembly}*END ASSEMBLY\n{FOAM}{more}")
}

/// The steps with more keywords in the last one.
fn with(more: &str) -> String {
    STEP.replace("*END STEP\n", &format!("{more}*END STEP\n"))
}

/// Asserts that exactly these lines are listed, by their beginnings.
fn assert_listed(listed: &[String], expected: &[&str]) {
    assert_eq!(listed.len(), expected.len(), "{listed:#?}");
    for (told, expected) in listed.iter().zip(expected) {
        let (_, told) = told.split_once(": ").unwrap();
        assert!(told.starts_with(expected), "{told}\nis not\n{expected}");
    }
}

#[test]
fn instances_sections_materials_and_steps() {
    let (text, listed, deck) = converted(&model("", STEP));
    assert_eq!(listed, Vec::<String>::new());
    let names = deck.model.bodies.iter().map(|body| body.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["Base-1", "Pad-1"]);
    assert!(text.contains("elements = \"Pad-1\""), "{text}");
    let pad = &deck.model.bodies[1];
    assert_eq!((pad.mesh.bounds().0.z, pad.density), (1.0, 2e-9));
    let step = &deck.model.steps[0];
    assert_eq!((step.name.as_str(), step.duration), ("Press", 2.0));
    assert_eq!(step.increments.initial, 0.05);
    assert_eq!(step.increments.largest, 0.25);
    assert_eq!(step.procedure, Procedure::QuasiStatic);
    let [base, pad, _] = &step.displacements[..] else {
        panic!("{:?}", step.displacements);
    };
    assert_eq!(base.numbers(), [Some(0.0); 3]);
    assert_eq!(pad.numbers(), [None, None, Some(-0.02)]);
}

#[test]
fn contact_pairs_friction_and_ties() {
    let contact = "*SURFACE INTERACTION, NAME=Fric
1.,
*FRICTION, TAUMAX=5., EXPONENTIAL DECAY
0.4, 0.1, 2.
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=HARD
*CONTACT PAIR, INTERACTION=fric, TYPE=SURFACE TO SURFACE, ADJUST=0.1
Pad-1.Bottom, Base-1.Top
";
    let (_, listed, deck) = converted(&model("", &format!("{contact}{STEP}")));
    assert_eq!(listed, Vec::<String>::new());
    let pair = &deck.model.pairs[0];
    assert_eq!(pair.name, "Pad-1.Bottom on Base-1.Top");
    assert!(matches!(pair.friction.law(), Law::Coulomb));
    assert_eq!(pair.friction.shear_cap(), Some(5.0));
    assert_eq!(pair.friction.coefficient().at_rest(), 0.4);
    let by_rate = pair.friction.coefficient().by_rate();
    let stated = by_rate.statement().map(|of| (of.law, of.values.clone()));
    let decay = [("kinetic_over_static", 0.25), ("slip_rate", 0.5)];
    assert_eq!(stated, Some(("decay", decay.into())));
    let tie = "*TIE, NAME=glue, POSITION TOLERANCE=0.2\nPad-1.Bottom, Base-1.Top\n";
    let (_, listed, deck) = converted(&model(tie, &STEP.replace("Pad-1.Low, 1, 2\n", "")));
    assert_eq!(listed, Vec::<String>::new());
    assert_eq!(deck.model.ties.len(), 1);
    let own = "*TIE, NAME=glue\nPad-1.Bottom, Pad-1.Top\n";
    let (_, listed, _) = converted(&model(own, STEP));
    assert_listed(
        &listed,
        &["*TIE `Pad-1.Bottom, Pad-1.Top`: both surfaces are of one"],
    );
}

#[test]
fn general_contact_between_named_surfaces() {
    let contact = "*SURFACE INTERACTION, NAME=Fric
*FRICTION
0.3,
*CONTACT
*CONTACT INCLUSIONS
Pad-1.Bottom, Base-1.Top
*CONTACT PROPERTY ASSIGNMENT
, , Fric
";
    let (_, listed, deck) = converted(&model("", &format!("{contact}{STEP}")));
    assert_eq!(listed, Vec::<String>::new());
    assert_eq!(deck.model.pairs[0].friction.coefficient().at_rest(), 0.3);
    let adjusted = "*SURFACE INTERACTION, NAME=Fric\n*FRICTION\n0.3,\n*CONTACT PAIR, INTERACTION=Fric, ADJUST=0.1\nPad-1.Bottom,\n";
    let (_, listed, _) = converted(&model("", &format!("{adjusted}{STEP}")));
    assert_listed(
        &listed,
        &["*CONTACT PAIR, ADJUST of `Pad-1.Bottom`: no gaps"],
    );
    let own = contact.replace("Pad-1.Bottom, Base-1.Top", "Pad-1.Bottom,");
    let (_, listed, deck) = converted(&model("", &format!("{own}{STEP}")));
    assert_eq!(listed, Vec::<String>::new());
    assert!(deck.model.pairs[0].is_on_itself());
    assert_eq!(deck.model.pairs[0].friction.coefficient().at_rest(), 0.3);
}

#[test]
fn general_contact_of_everything() {
    let contact = "*SURFACE INTERACTION, NAME=Fric
*FRICTION
0.3,
*SURFACE INTERACTION, NAME=Smooth
*CONTACT
*CONTACT INCLUSIONS, ALL EXTERIOR
*CONTACT PROPERTY ASSIGNMENT
, , Fric
Pad-1.Bottom, Base-1.Top, Smooth
";
    let (text, listed, deck) = converted(&model("", &format!("{contact}{STEP}")));
    assert!(
        text.contains("[contact]\nall = true\nfriction = "),
        "{text}"
    );
    assert!(deck.model.pairs.iter().any(|pair| pair.is_on_itself()));
    assert_eq!(listed, Vec::<String>::new());
    let smooth = |name: &str| name.contains("Base-1.Top") && name.contains("Pad-1.Bottom");
    assert!(deck.model.pairs.iter().any(|pair| smooth(&pair.name)));
    for pair in &deck.model.pairs {
        let expected = if smooth(&pair.name) { 0.0 } else { 0.3 };
        let found = pair.friction.coefficient().at_rest();
        assert_eq!(found, expected, "{}", pair.name);
    }
}

#[test]
fn amplitudes_are_curves_from_the_present_value() {
    let steps = "*AMPLITUDE, NAME=Saw
0., 0., 0.5, 2., 1., 1.
*AMPLITUDE, NAME=Smooth, DEFINITION=SMOOTH STEP
0., 0., 1., 1.
*STEP, NLGEOM
*STATIC
0.1, 1.
*BOUNDARY
Base-1.Low, ENCASTRE
Pad-1.Low, 1, 2
*BOUNDARY, AMPLITUDE=Saw
Pad-1.High, 3, 3, -0.02
*END STEP
*STEP, NLGEOM
*STATIC
0.1, 1.
*BOUNDARY, AMPLITUDE=Smooth
Pad-1.High, 1, 1, 0.5
*BOUNDARY, AMPLITUDE=Saw
Pad-1.High, 3, 3, -0.04
*END STEP
";
    let (_, listed, deck) = converted(&model("", steps));
    assert_eq!(listed, Vec::<String>::new());
    let curve = |step: usize, at: usize| &deck.model.steps[step].displacements[at].curve;
    assert_eq!(
        curve(0, 1),
        &Curve::Table(vec![(0.0, 0.0), (0.5, 2.0), (1.0, 1.0)])
    );
    // From -0.02 on the way of the amplitude over 0, -0.08 and -0.04.
    let back = deck.model.steps[1]
        .displacements
        .iter()
        .find_map(|of| of.components[2].as_ref().map(|_| &of.curve));
    let Some(Curve::Table(points)) = back else {
        panic!("{back:?}");
    };
    let expected = [(0.0, -1.0), (0.5, 3.0), (1.0, 1.0)];
    for (found, expected) in points.iter().zip(expected) {
        assert!(
            (found.0 - expected.0).abs() + (found.1 - expected.1).abs() < 1e-12,
            "{points:?}"
        );
    }
    let smooth = deck.model.steps[1]
        .displacements
        .iter()
        .find_map(|of| of.components[0].as_ref().map(|_| &of.curve));
    let Some(Curve::Table(points)) = smooth else {
        panic!("{smooth:?}");
    };
    assert_eq!(points.len(), 21);
    assert!(
        points
            .iter()
            .all(|(x, c)| (x * x * x * (10.0 - 15.0 * x + 6.0 * x * x) - c).abs() < 1e-12)
    );
}

#[test]
fn pressures_tractions_and_gravity() {
    let loads = "*DSLOAD
Pad-1.Top, P, 0.5
Pad-1.Top, TRVEC, 2., 3., 0., 4.
*DLOAD
, GRAV, 9810., 0., 0., -1.
*END STEP
";
    let step = STEP.replace("*END STEP\n", loads);
    let (_, listed, deck) = converted(&model("", &step));
    assert_eq!(listed, Vec::<String>::new());
    let step = &deck.model.steps[0];
    assert!(
        step.loads
            .iter()
            .any(|load| load.kind.numbers() == Some(LoadKind::Pressure(0.5)))
    );
    let traction = step
        .loads
        .iter()
        .find_map(|load| match load.kind.numbers() {
            Some(LoadKind::FollowerTraction(vector)) => Some(vector),
            _ => None,
        });
    assert!((traction.unwrap() - striae_mesh::Vec3::new(1.2, 0.0, 1.6)).norm() < 1e-14);
    assert_eq!(step.gravity.as_ref().unwrap().acceleration.z, -9810.0);
}

#[test]
fn couplings_are_tied_rigid_bodies_that_points_move() {
    let coupling = "*COUPLING, CONSTRAINT NAME=grip, REF NODE=RP, SURFACE=Pad-1.Top\n*KINEMATIC\n";
    let step = STEP.replace(
        "Pad-1.High, 3, 3, -0.02\n",
        "RP, 1, 2\nRP, 4, 6\nRP, 6, 6, 0.5\n*CLOAD\nRP, 3, -7.\n",
    );
    let (text, listed, deck) = converted(&model(coupling, &step));
    assert_eq!(listed, Vec::<String>::new());
    let rigid = &deck.model.rigid_surfaces[0];
    assert_eq!(rigid.name, "grip");
    assert!(matches!(rigid.shape, RigidShape::Bare));
    let motion = &deck.model.steps[0].rigid_motions[0];
    assert_eq!(motion.force.unwrap().z, -7.0);
    assert!(text.contains("free = [\"z\"]"), "{text}");
    assert!(text.contains("reference = [0.5, 0.5, 3.0]"), "{text}");
    assert!(
        text.contains(&format!("{:?}", 0.5_f64.to_degrees())),
        "{text}"
    );
}

#[test]
fn rigid_elements_and_analytical_planes() {
    let parts = "*PART, NAME=Tool
*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
*ELEMENT, TYPE=R3D4, ELSET=Tool
1, 1, 4, 3, 2
*END PART
*PART, NAME=Wall
*SURFACE, TYPE=CYLINDER, NAME=Face
START, -1., 0.
LINE, 1., 0.
*END PART
";
    let assembly = "*INSTANCE, NAME=Tool-1, PART=Tool
0., 0., 2.
*END INSTANCE
*INSTANCE, NAME=Wall-1, PART=Wall
0., -1., 0.
*END INSTANCE
*NODE
2, 0., -1., 0.
*NSET, NSET=RW
2,
*ELSET, ELSET=ToolSet, INSTANCE=Tool-1
1,
*SURFACE, NAME=ToolFace
ToolSet, SPOS
*RIGID BODY, REF NODE=RP, ELSET=ToolSet
*RIGID BODY, REF NODE=RW, ANALYTICAL SURFACE=Wall-1.Face
";
    let more = "*CONTACT PAIR\nPad-1.Top, ToolFace\nPad-1.Bottom, Wall-1.Face\n*BOUNDARY\nRP, ENCASTRE\nRW, ENCASTRE\n";
    let text = parts.to_owned() + &model(assembly, &format!("{more}{STEP}"));
    let (deck_text, listed, deck) = converted(&text);
    assert_eq!(listed, Vec::<String>::new());
    let [tool, wall] = &deck.model.rigid_surfaces[..] else {
        panic!("{deck_text}");
    };
    assert!(matches!(&tool.shape, RigidShape::Facets { facets, .. } if facets.len() == 1));
    let RigidShape::Plane { point, normal } = wall.shape else {
        panic!("{deck_text}");
    };
    assert_eq!((point.y, normal.y), (-1.0, 1.0));
    assert_eq!(deck.model.pairs.len(), 2);
    assert!(deck.model.steps[0].rigid_motions.is_empty());
}

#[test]
fn implicit_dynamics_and_conditions_that_end() {
    let steps = "*BOUNDARY
Base-1.Low, PINNED
*STEP, NAME=hold, NLGEOM
*STATIC
*BOUNDARY
Pad-1.High, 1, 3, 0.01
*END STEP
*STEP, NAME=let go, NLGEOM
*DYNAMIC
0.01, 0.1, 1e-7, 0.02
*BOUNDARY, OP=NEW
Base-1.Low, PINNED
*END STEP
";
    let (text, listed, deck) = converted(&model("", steps));
    assert_eq!(listed, Vec::<String>::new());
    let step = &deck.model.steps[1];
    assert_ne!(step.procedure, Procedure::QuasiStatic);
    assert!((step.increments.largest - 0.2).abs() < 1e-12);
    assert_eq!(step.releases.len(), 1, "{text}");
    assert_eq!(step.releases[0].components, [true; 3]);
}

#[test]
fn what_has_no_counterpart_is_listed_with_its_line() {
    let more = "*INITIAL CONDITIONS, TYPE=TEMPERATURE
Pad-1.High, 20.
*SURFACE INTERACTION, NAME=soft
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL
1., 2.
";
    let step = with("*CLOAD\nnowhere, 3, -1.\n*DLOAD\nPad-1.All, BX, 2.\n*CONTROLS\n1,\n");
    let (text, listed, _) = converted(&model("", &format!("{more}{step}")));
    let said = listed.join("\n");
    for (line, what) in [
        ("line 40", "*INITIAL CONDITIONS, TYPE=TEMPERATURE"),
        (
            "line 43",
            "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=EXPONENTIAL",
        ),
        ("line 53", "*CLOAD `nowhere, 3, -1.`"),
        ("line 55", "*DLOAD `Pad-1.All, BX, 2.`"),
        ("line 56", "*CONTROLS"),
    ] {
        let found = listed
            .iter()
            .any(|told| told.starts_with(&format!("{line}: {what}")));
        assert!(found, "{line} {what}:\n{said}");
        assert!(text.contains(what), "{text}");
    }
    assert_eq!(listed.len(), 5, "{said}");
}

#[test]
fn transformed_nodes_are_prescribed_in_their_axes() {
    let transforms = "*TRANSFORM, NSET=Pad-1.High, TYPE=C\n0., 0., 0., 0., 0., 2.
*TRANSFORM, NSET=Base-1.Low\n1., 1., 0., 0., 1., 0.
*TRANSFORM, NSET=Base-1.High, TYPE=S\n0., 0., 0., 0., 0., 1.\n";
    let (_, listed, deck) = converted(&model(transforms, STEP));
    let stated = &deck.model.steps[0].displacements;
    let axes = |body: &str, set: &str| {
        let mut all = stated.iter();
        let named = |of: &&Displacement| {
            deck.model.bodies[of.body.0].name == body && of.set.eq_ignore_ascii_case(set)
        };
        all.find(named).expect("it is prescribed").axes
    };
    assert_eq!(
        axes("Base-1", "Base-1.Low"),
        Axes::Skew {
            x: Vec3::new(1.0, 1.0, 0.0),
            y: Vec3::y(),
        }
    );
    assert_eq!(
        axes("Pad-1", "Pad-1.High"),
        Axes::Cylindrical {
            point: Vec3::zeros(),
            axis: Vec3::new(0.0, 0.0, 2.0),
        }
    );
    assert_eq!(axes("Pad-1", "Pad-1.Low"), Axes::Global);
    // Spherical axes have no counterpart.
    assert_eq!(listed.len(), 1, "{listed:?}");
    assert!(listed[0].contains("*TRANSFORM"), "{listed:?}");
}

#[test]
fn pieces_of_a_file_without_parts_are_bodies_by_their_element_sets() {
    let node = |number: usize, z: f64| {
        let corners = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]];
        let [x, y] = corners[(number - 1) % 4];
        format!("{number}, {x}, {y}, {z}\n")
    };
    let mut text = "*NODE\n".to_owned();
    for number in 1..=16 {
        text += &node(number, [0., 1., 1., 2.][(number - 1) / 4]);
    }
    text += "*ELEMENT, TYPE=C3D8, ELSET=Below\n1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D8, ELSET=Above\n2, 9, 10, 11, 12, 13, 14, 15, 16
*ELSET, ELSET=Both\nBelow, Above\n*SOLID SECTION, ELSET=Both, MATERIAL=foam
*SURFACE, NAME=low\nBelow, S2\n*SURFACE, NAME=high\nAbove, S1
";
    text += FOAM;
    text += "*CONTACT PAIR\nhigh, low\n*BOUNDARY\n1, 1, 3\n13, 1, 3\n*STEP, NLGEOM\n*STATIC\n*END STEP\n";
    let (_, listed, deck) = converted(&text);
    assert_eq!(listed, Vec::<String>::new());
    let names = deck.model.bodies.iter().map(|body| body.name.as_str());
    assert_eq!(names.collect::<Vec<_>>(), ["Below", "Above"]);
    assert_eq!(deck.model.pairs.len(), 1);
    let held = &deck.model.steps[0].displacements[0];
    assert_eq!((held.body.0, held.nodes.len()), (0, 1));
}
