//! Interactions of surfaces.

use super::{CUBE, FOAM, STEP, assert_listed, converted, made, model, with};
use striae_law::friction::Law;
use striae_mesh::Vec3;
use striae_model::Model;

/// Friction with these keywords below the interaction, and a row of the pair.
fn interaction(keywords: &str, row: &str) -> (String, Vec<String>, Model) {
    let more = format!(
        "*SURFACE INTERACTION, NAME=Fric\n{keywords}*CONTACT PAIR, INTERACTION=Fric\n{row}\n{STEP}"
    );
    let (text, listed, deck) = converted(&model("", &more));
    (text, listed, deck.model)
}

const ROW: &str = "Pad-1.Bottom, Base-1.Top";

#[test]
fn anisotropic_friction_is_orthotropic_along_x() {
    let (text, listed, model) = interaction("*FRICTION, ANISOTROPIC\n0.1, 0.4\n", ROW);
    assert_listed(&listed, &[]);
    let Law::Orthotropic(..) = model.pairs[0].friction.law() else {
        panic!("{text}");
    };
    assert!(
        text.contains("mu_along = 0.1, mu_across = 0.4, slip_rule = \"associated\""),
        "{text}"
    );
    assert!(
        text.contains("texture = { uniform = [1.0, 0.0, 0.0] } }\nb ="),
        "{text}"
    );
}

#[test]
fn anisotropic_friction_on_a_side_that_faces_x_is_along_z() {
    let friction = "*SURFACE INTERACTION, NAME=Fric\n*FRICTION, ANISOTROPIC\n0.1, 0.4
*CONTACT PAIR, INTERACTION=Fric\nPad-1.Side, Base-1.Top\n";
    let cube = CUBE.replace(
        "*SURFACE, NAME=Top\n",
        "*SURFACE, NAME=Side\n1, S4\n*SURFACE, NAME=Top\n",
    );
    let text = format!("{cube}*END ASSEMBLY\n{FOAM}{friction}{STEP}");
    let (_, made) = made(&text);
    assert_listed(&made.listed, &[]);
    assert!(
        made.deck.contains("uniform = [0.0, 0.0, 1.0]"),
        "{}",
        made.deck
    );
}

#[test]
fn orientations_turn_the_slip_directions() {
    let anisotropic = "*FRICTION, ANISOTROPIC\n0.1, 0.4\n";
    let oriented = |rows: &str| {
        let orientation = format!("*ORIENTATION, NAME=Ori{rows}");
        let row = format!("{ROW}, Ori\n{orientation}");
        interaction(anisotropic, &row)
    };
    // About the local z axis by 30 degrees from the local x axis, which is y.
    let (text, listed, _) = oriented("\n0., 1., 0., -1., 0., 0.\n3, 30.");
    assert_listed(&listed, &[]);
    let start = text.find("uniform = [").unwrap() + 11;
    let end = start + text[start..].find(']').unwrap();
    let found: Vec<f64> = text[start..end]
        .split(", ")
        .map(|word| word.parse().unwrap())
        .collect();
    let exact = Vec3::new(-0.5, 0.75_f64.sqrt(), 0.0);
    assert!((Vec3::new(found[0], found[1], found[2]) - exact).norm() < 1e-14);
    let (text, listed, _) = oriented(", SYSTEM=CYLINDRICAL\n0.5, 0.5, 0., 0.5, 0.5, 1.\n3, 0.");
    assert_listed(&listed, &[]);
    let radial = "radial = { point = [0.5, 0.5, 0.0], direction = [0.0, 0.0, 1.0] }";
    assert!(text.contains(radial), "{text}");
}

#[test]
fn rough_friction_is_a_large_coefficient() {
    let (_, listed, model) = interaction("*FRICTION, ROUGH\n", ROW);
    assert_listed(&listed, &["*FRICTION ROUGH: taken as a coefficient of 100"]);
    assert_eq!(model.pairs[0].friction.coefficient().at_rest(), 100.0);
}

#[test]
fn friction_by_slip_rate_and_by_pressure() {
    let (text, listed, _) = interaction("*FRICTION\n0.2, 0.\n0.1, 1.\n0.05, 4.\n", ROW);
    assert_listed(&listed, &[]);
    let table = "by_slip_rate = { form = \"table\", slip_rates = [0.0, 1.0, 4.0], factors = [1.0, 0.5, 0.25] }";
    assert!(text.contains(table), "{text}");
    let (text, listed, _) = interaction("*FRICTION\n0.2, , 1.\n0.1, , 5.\n", ROW);
    assert_listed(&listed, &[]);
    let table = "by_pressure = { form = \"table\", pressures = [1.0, 5.0], factors = [1.0, 0.5] }";
    assert!(text.contains(table), "{text}");
    let (_, listed, _) = interaction("*FRICTION\n0.2, 0., 1.\n0.1, 1., 5.\n", ROW);
    assert_listed(
        &listed,
        &["*FRICTION by more than slip rate or pressure: its first row"],
    );
    let (_, listed, _) = interaction("*FRICTION\n0.2, 1e7\n", ROW);
    assert_listed(
        &listed,
        &["*FRICTION with one row: the numbers after the coefficient"],
    );
}

#[test]
fn friction_without_a_counterpart_is_listed() {
    let (_, listed, model) = interaction("*FRICTION, USER\n0.2\n", ROW);
    assert_listed(&listed, &["*FRICTION with USER: no friction"]);
    assert_eq!(model.pairs[0].friction.coefficient().at_rest(), 0.0);
    let idle = "*SURFACE INTERACTION, NAME=Idle\n*FRICTION\n0.2\n";
    let (_, listed, _) = converted(&super::model("", &format!("{idle}{STEP}")));
    assert_listed(
        &listed,
        &["*FRICTION of `Idle`, which no contact refers to"],
    );
}

#[test]
fn friction_changes_in_a_step() {
    let pair = "*SURFACE INTERACTION, NAME=Fric\n*FRICTION\n0.2\n*CONTACT PAIR, INTERACTION=Fric
Pad-1.Bottom, Base-1.Top\n";
    let change = with("*CHANGE FRICTION, INTERACTION=Fric\n*FRICTION\n0.7\n");
    let (_, listed, deck) = converted(&model("", &format!("{pair}{change}")));
    assert_listed(&listed, &[]);
    let (_, friction) = &deck.model.steps[0].frictions[0];
    assert_eq!(friction.coefficient().at_rest(), 0.7);
    let none = with("*CHANGE FRICTION, INTERACTION=Other\n*FRICTION\n0.7\n");
    let (_, listed, _) = converted(&model("", &format!("{pair}{none}")));
    assert_listed(&listed, &["*CHANGE FRICTION of `OTHER`, which no pair has"]);
}

#[test]
fn parameters_of_pairs_that_change_their_meaning_are_listed() {
    let pair =
        "*CONTACT PAIR, SMALL SLIDING, ADJUST=0.0, EXTENSION ZONE=0.1\nPad-1.Bottom, Base-1.Top\n";
    let (text, listed, _) = converted(&model("", &format!("{pair}{STEP}")));
    let said = [
        "*CONTACT PAIR: parameter EXTENSION ZONE",
        "*CONTACT PAIR, SMALL SLIDING: surfaces may slide any way",
    ];
    assert_listed(&listed, &said);
    assert!(text.contains("initial = { close = 0.0 }"), "{text}");
    let pair = "*CONTACT PAIR, ADJUST=Pad-1.Low\nPad-1.Bottom, Base-1.Top\n";
    let (_, listed, _) = converted(&model("", &format!("{pair}{STEP}")));
    assert_listed(
        &listed,
        &["*CONTACT PAIR, ADJUST=Pad-1.Low: all of the surfaces"],
    );
}

#[test]
fn tied_contact_is_a_tie() {
    let step = STEP.replace("Pad-1.Low, 1, 2\n", "");
    let pair = "*CONTACT PAIR, TIED\nPad-1.Bottom, Base-1.Top\n";
    let (_, listed, deck) = converted(&model("", &format!("{pair}{step}")));
    assert_listed(&listed, &[]);
    assert_eq!(deck.model.ties.len(), 1);
    let of_calculix = "*SURFACE INTERACTION, NAME=T\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED
1e7,\n*CONTACT PAIR, INTERACTION=T\nPad-1.Bottom, Base-1.Top\n";
    let (_, listed, deck) = converted(&model("", &format!("{of_calculix}{step}")));
    assert_listed(&listed, &[]);
    assert_eq!((deck.model.ties.len(), deck.model.pairs.len()), (1, 0));
}

#[test]
fn exclusions_from_contact_of_everything() {
    let contact = "*CONTACT\n*CONTACT INCLUSIONS, ALL EXTERIOR\n*CONTACT EXCLUSIONS
Pad-1.Top, Base-1.Top\nPad-1.Bottom,\n, Base-1.Bottom\n";
    let (text, listed, _) = converted(&model("", &format!("{contact}{STEP}")));
    assert_listed(&listed, &[]);
    for entry in [
        "{ a = \"Pad-1.Pad-1.Top\", b = \"Base-1.Base-1.Top\" }",
        "{ a = \"Pad-1.Pad-1.Bottom\", b = \"Pad-1.Pad-1.Bottom\" }",
        "{ a = \"Base-1.Base-1.Bottom\" }",
    ] {
        assert!(text.contains(entry), "{entry}\n{text}");
    }
    let contact = contact.replace(", ALL EXTERIOR\n", "\nPad-1.Bottom, Base-1.Top\n");
    let (_, listed, _) = converted(&model("", &format!("{contact}{STEP}")));
    assert!(
        listed
            .iter()
            .all(|line| line.contains("*CONTACT EXCLUSIONS"))
    );
    assert_eq!(listed.len(), 4, "{listed:?}");
}

#[test]
fn surfaces_that_cannot_touch_say_why() {
    let of_nodes =
        "*SURFACE, TYPE=NODE, NAME=Corner\nPad-1.1,\n*CONTACT PAIR\nCorner, Base-1.Top\n";
    let (_, listed, _) = converted(&model("", &format!("{of_nodes}{STEP}")));
    let said = "contact of `Corner` and `Base-1.Top`: the nodes of `Corner` make up no facet";
    assert_listed(&listed, &[said]);
    let unknown = "*CONTACT PAIR\nPad-1.Bottom, Base-1.Roof\n";
    let (_, listed, _) = converted(&model("", &format!("{unknown}{STEP}")));
    assert_listed(
        &listed,
        &["contact of `Pad-1.Bottom` and `Base-1.Roof`: there is no *SURFACE"],
    );
}

#[test]
fn sets_of_instances_that_are_no_bodies_are_not_those_of_bodies() {
    let tool = "*PART, NAME=Tool\n*NODE\n1, 0., 0., 0.\n2, 1., 0., 0.\n3, 1., 1., 0.
*ELEMENT, TYPE=R3D3, ELSET=All\n1, 1, 2, 3\n*END PART\n";
    let instance = "*INSTANCE, NAME=Tool-1, PART=Tool\n*END INSTANCE\n";
    let step = with("*CLOAD\nTool-1.All, 1, 1.\n*DLOAD\nTool-1.All, P1, 1.\n");
    let (_, listed, _) = converted(&(tool.to_owned() + &model(instance, &step)));
    let said = [
        "instance `Tool-1` of rigid elements without *RIGID BODY",
        "*CLOAD `Tool-1.All, 1, 1.`: `Tool-1.All` belongs to no body",
        "*DLOAD `Tool-1.All, P1, 1.`, which is no outer face of a body",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn clearances_and_later_pairs_are_listed() {
    let more = "*CLEARANCE, MASTER=Base-1.Top, SLAVE=Pad-1.Bottom, VALUE=0.1\n";
    let later = "*STEP\n*STATIC\n*CONTACT PAIR\nPad-1.Bottom, Base-1.Top\n*END STEP\n";
    let (_, listed, _) = converted(&model("", &format!("{more}{STEP}{later}")));
    let said = [
        "*CLEARANCE: state `initial` or `interference` of the pair",
        "*CONTACT PAIR of a later step: it acts from the start",
    ];
    assert_listed(&listed, &said);
}

#[test]
fn numbers_of_a_penalty_are_listed() {
    for (row, is_listed) in [
        ("1e5, 0.02, 0.1", true),
        (", 0.02", true),
        (", , 0.1", true),
        (", 0., 1.", false),
        ("", false),
    ] {
        let contact = format!(
            "*SURFACE INTERACTION, NAME=I\n*FRICTION\n0.2,\n*SURFACE BEHAVIOR, PENALTY\n{row}\n*CONTACT PAIR, INTERACTION=I\nPad-1.Bottom, Base-1.Top\n"
        );
        let (_, listed, _) = converted(&model("", &format!("{contact}{STEP}")));
        let said = format!("*SURFACE BEHAVIOR, PENALTY of `{row}`: contact is exact");
        let said = is_listed.then_some(said.as_str());
        assert_listed(&listed, said.as_slice());
    }
}

#[test]
fn cyclic_symmetry_is_no_tie() {
    let tie = "*TIE, NAME=T, CYCLIC SYMMETRY\nPad-1.Bottom, Base-1.Top\n";
    let (_, listed, deck) = converted(&model(tie, STEP));
    assert_listed(
        &listed,
        &["*TIE, CYCLIC SYMMETRY: both surfaces are those of one sector"],
    );
    assert!(deck.model.ties.is_empty());
}
