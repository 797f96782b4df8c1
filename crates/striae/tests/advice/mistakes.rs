//! Each physical mistake is found, and nothing else with it.
//!
//! Longer than other files, as it lists all mistakes that are found.

use striae::{
    advice::{Advice, Topic},
    deck::{Deck, Faults},
};

use super::{COULOMB, PRESSED};

/// Contact of the pad with the floor.
const PAIR: &str = r#"[[pair]]
name = "sole"
a = { body = "pad", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.3 }"#;
const LOADED: &str = r#"pressure = [{ body = "pad", facets = "zmax", value = 10 }]"#;
const PAD: &str = "origin = [0, 0, 0], size = [1, 1, 1], divisions = [3, 3, 3]";
const FLOOR: &str = r#"b = { rigid = "floor" }"#;

/// The deck with passages replaced.
fn read(passages: &[[&str; 2]]) -> Result<Deck, Faults> {
    super::read(PAIR, passages)
}

fn advice(passages: &[[&str; 2]]) -> Advice {
    Advice::of(&read(passages).expect("a valid deck").model)
}

/// The only warning of the deck with passages replaced.
fn warning(passages: &[[&str; 2]]) -> (Topic, String) {
    let advice = advice(passages);
    assert_eq!(advice.faults, []);
    let [warning] = &advice.warnings[..] else {
        panic!("{:?}", advice.warnings);
    };
    (warning.topic, warning.text.clone())
}

fn assert_warned(passages: &[[&str; 2]], topic: Topic, words: &str) {
    let (found, text) = warning(passages);
    assert_eq!(found, topic, "{text}");
    assert!(text.contains(words), "{text}");
}

/// Message for a deck that is refused.
fn refusal(passages: &[[&str; 2]]) -> String {
    read(passages).expect_err("a fault").to_string()
}

#[test]
fn a_sound_deck_has_notes_only() {
    let advice = advice(&[]);
    assert_eq!((&advice.faults, &advice.warnings), (&vec![], &vec![]));
    let said = |topic: Topic, words: &str| {
        let mut notes = advice.notes.iter().filter(|note| note.topic == topic);
        assert!(
            notes.any(|note| note.text.contains(words)),
            "{words}: {:?}",
            advice.notes
        );
    };
    said(Topic::Shape, "between (0, 0, 0) and (1, 1, 1)");
    said(Topic::Shape, "volume 1");
    said(Topic::Hold, "restrained by its prescribed nodes");
    said(Topic::Fit, "smallest gap 0");
    said(Topic::Cost, "unknowns");
}

#[test]
fn millimetres_with_pascals() {
    let steel = ["youngs_modulus = 1e6", "youngs_modulus = 2.1e11"];
    let large = [PAD, "size = [40, 40, 20], divisions = [3, 3, 3]"];
    assert_warned(&[steel, large], Topic::Units, "lengths are in metres");
    let small = [PAD, "size = [0.04, 0.04, 0.02], divisions = [3, 3, 3]"];
    assert_eq!(
        advice(&[steel, small, [PRESSED, &PRESSED.replace("0.02", "0.0002")]]).warnings,
        []
    );
    // A pressure in MPa beside a modulus in Pa, whatever the lengths.
    assert_warned(&[steel, [PRESSED, LOADED]], Topic::Units, "hardly any");
    let megapascals = ["youngs_modulus = 1e6", "youngs_modulus = 2.1e5"];
    assert_eq!(
        advice(&[megapascals, large, [PRESSED, LOADED]]).warnings,
        []
    );
    let soft = ["youngs_modulus = 1e6", "youngs_modulus = 1"];
    assert_warned(&[soft, [PRESSED, LOADED]], Topic::Units, "crushed");
}

#[test]
fn a_density_from_another_system_of_units() {
    let dense = [
        "youngs_modulus = 1e6",
        "youngs_modulus = 2.1e11\ndensity = 7.85e-9",
    ];
    assert_warned(&[dense], Topic::Units, "waves");
}

#[test]
fn the_wrong_side_of_a_plane() {
    let away = ["normal = [0, 0, 1]", "normal = [0, 0, -1]"];
    let refused = refusal(&[away]);
    for words in [
        "faces away from that of `floor`",
        "Reverse the normal of `floor`",
    ] {
        assert!(refused.contains(words), "{refused}");
    }
    let behind = [
        PAD,
        "origin = [0, 0, 0.5], size = [1, 1, 1], divisions = [3, 3, 3]",
    ];
    let refused = refusal(&[away, behind]);
    assert!(
        refused.contains("reverse the normal of `floor`"),
        "{refused}"
    );
}

#[test]
fn a_gap_that_is_never_closed() {
    let above = [
        PAD,
        "origin = [0, 0, 0.1], size = [1, 1, 1], divisions = [3, 3, 3]",
    ];
    for motion in ["-0.06", "0.2", "-0.0999"] {
        let moved = PRESSED.replace("-0.02", motion);
        assert_warned(
            &[above, [PRESSED, &moved]],
            Topic::NeverMeets,
            "can never meet",
        );
    }
    let closed = PRESSED.replace("-0.02", "-0.1001");
    assert_eq!(advice(&[above, [PRESSED, &closed]]).warnings, []);
}

#[test]
fn a_body_that_nothing_holds() {
    let above = [
        PAD,
        "origin = [0, 0, 0.1], size = [1, 1, 1], divisions = [3, 3, 3]",
    ];
    let loaded = [PRESSED, LOADED];
    assert_warned(
        &[above, loaded],
        Topic::Hold,
        "nothing restrains it before `sole` closes",
    );
    let stabilised = [COULOMB, &format!("{COULOMB}\nstabilise = true")];
    assert_eq!(advice(&[above, loaded, stabilised]).warnings, []);
    let smooth = [COULOMB, r#"friction = { law = "frictionless" }"#];
    assert_warned(
        &[loaded, smooth],
        Topic::Hold,
        "along x, along y and about z, as it is frictionless",
    );
    // Friction holds it once it touches.
    let advice = advice(&[loaded]);
    assert_eq!(advice.warnings, []);
    let hold = advice.notes.iter().find(|note| note.topic == Topic::Hold);
    assert!(hold.is_some_and(|note| note.text.contains("`sole` must restrain it")));
}

#[test]
fn loads_that_pull_a_body_off_or_end_in_any_step() {
    let with = |later: &str| format!("{LOADED}\n[[step]]\nname = \"later\"\n{later}");
    let told = |later: &str| read(&[[PRESSED, &with(later)]]).err();
    let pressure = |value: &str| {
        format!("pressure = [{{ body = \"pad\", facets = \"zmax\", value = {value} }}]")
    };
    let refused = |later: &str, words: &str| {
        let found = told(later).expect("a fault").to_string();
        assert!(
            found.contains("push body `pad` along +z in step `later`"),
            "{found}"
        );
        assert!(found.contains(words), "{found}");
    };
    refused(&pressure("-10"), "with a force of 10");
    refused(&pressure("\"10*(3 - 2*t)\""), "with a force of 10");
    let gone = "0, curve = \"constant\"";
    refused(&pressure(gone), "nothing resists this motion");
    for held in [
        "displacement = [{ body = \"pad\", nodes = \"zmax\", z = 0.1 }]",
        "force = [{ body = \"pad\", nodes = \"zmax\", total = [0, 0, -20] }]",
    ] {
        let both = format!("{}\n{held}", pressure("-10"));
        assert!(told(&both).is_none(), "{held}");
    }
    assert!(told("").is_none() && told(&pressure("5")).is_none());
    // What is unloaded is held up to the end.
    assert!(told(&pressure("0")).is_none());
    // After a turn nobody knows which way contact pushes.
    let turned = |rotation: &str| {
        let turn = format!("[[step.rigid]]\nsurface = \"floor\"\nrotation = {rotation}");
        let last = format!("[[step]]\nname = \"last\"\n{}", pressure("-10"));
        told(&format!("{}\n{turn}\n{last}", pressure("5")))
    };
    assert!(turned("[0, 0, 0]").is_some() && turned("[0, 180, 0]").is_none());
    // Held in the first step, and then by nothing.
    let release = "[[step]]\nname = \"later\"\nrelease = [{ body = \"pad\", nodes = \"zmax\" }]";
    let alone = refusal(&[[PRESSED, &format!("{PRESSED}\n{release}")]]);
    assert!(alone.contains("in step `later`"), "{alone}");
    let loaded = format!("{PRESSED}\n{release}\n{LOADED}");
    assert!(read(&[[PRESSED, &loaded]]).is_ok());
}

#[test]
fn what_neither_stabilisation_nor_inertia_holds() {
    let stabilised = [COULOMB, &format!("{COULOMB}\nstabilise = true")];
    let pulled = LOADED.replace("10", "-10");
    let found = refusal(&[stabilised, [PRESSED, &pulled]]);
    assert!(found.contains("push body `pad` along +z"), "{found}");
    assert!(read(&[stabilised, [PRESSED, "increments = 10"]]).is_ok());
    let dense = ["youngs_modulus = 1e6", "youngs_modulus = 1e6\ndensity = 1"];
    let driven = |force: &str| {
        format!(
            "{PRESSED}\ndynamics = {{}}\nrigid = [{{ surface = \"floor\", free = [\"z\"], force = [0, 0, {force}] }}]"
        )
    };
    let found = refusal(&[dense, [PRESSED, &driven("-1")]]);
    assert!(
        found.contains("push rigid body `floor` along -z"),
        "{found}"
    );
    assert!(read(&[dense, [PRESSED, &driven("1")]]).is_ok());
}

#[test]
fn bodies_that_hold_each_other_and_that_nothing_holds() {
    let lower = r#"name = "pad"
material = "rubber"
mesh = { generator = "block", origin = [-0.5, -0.5, 0], size = [2, 2, 1], divisions = [4, 4, 2] }
[[body]]
name = "upper"
material = "rubber""#;
    let above = "origin = [0, 0, 1], size = [1, 1, 1], divisions = [3, 3, 3]";
    let joint = r#"[[pair]]
name = "joint"
a = { body = "upper", facets = "zmin" }
b = { body = "pad", facets = "zmax" }
friction = { law = "coulomb", mu = 0.3 }

[[step]]"#;
    let pressed = PRESSED.replace("pad", "upper");
    let loose = pressed.replace("x = 0, ", "");
    let bodies = [
        ["name = \"pad\"\nmaterial = \"rubber\"", lower],
        [PAD, above],
    ];
    let on_ice = |step: &str| {
        let smooth = [COULOMB, ""];
        advice(&[&bodies[..], &[smooth, ["[[step]]", joint], [PRESSED, step]]].concat())
    };
    assert_eq!(on_ice(&pressed).warnings, []);
    let found = on_ice(&loose).warnings;
    let [warning] = &found[..] else {
        panic!("{found:?}");
    };
    assert_eq!(
        warning.text,
        "prescribed nodes leave the bodies `pad`, `upper` together free to move along x, and the contact of `sole` leaves them free along x, as it is frictionless; prescribe these motions"
    );
    let rough = advice(&[&bodies[..], &[["[[step]]", joint], [PRESSED, &loose]]].concat());
    assert_eq!(rough.warnings, []);
}

#[test]
fn volumes_that_can_hardly_change_in_standard_hexahedra() {
    let nearly = ["poissons_ratio = 0.3", "poissons_ratio = 0.499"];
    let standard = ["[[rigid]]", "formulation = \"standard\"\n\n[[rigid]]"];
    assert_warned(&[nearly, standard], Topic::Locking, "mean-dilatation");
    assert_eq!(advice(&[nearly]).warnings, []);
    let tetrahedra = [
        PAD,
        "size = [1, 1, 1], divisions = [3, 3, 3], cells = \"tetrahedra\"",
    ];
    assert_warned(
        &[nearly, tetrahedra],
        Topic::Locking,
        "four-node tetrahedra",
    );
    let notes = advice(&[tetrahedra]).notes;
    assert!(
        notes.iter().any(|note| note.topic == Topic::Locking),
        "{notes:?}"
    );
}

#[test]
fn an_overlap() {
    let inside = [
        PAD,
        "origin = [0, 0, -0.1], size = [1, 1, 1], divisions = [3, 3, 3]",
    ];
    let refused = refusal(&[inside]);
    assert!(refused.contains("0.1 inside `floor`"), "{refused}");
}

#[test]
fn a_pair_that_cannot_meet() {
    let top = [r#"facets = "zmin""#, r#"facets = "zmax""#];
    let refused = refusal(&[top]);
    assert!(
        refused.contains("faces away from that of `floor`"),
        "{refused}"
    );
}

#[test]
fn a_direction_without_friction() {
    let grooved = [
        FLOOR,
        r#"b = { rigid = "floor", texture = { uniform = [1, 0, 0] } }"#,
    ];
    let law = |constants: &str| format!("friction = {{ {constants} }}");
    let none = law(r#"law = "orthotropic", mu_along = 0, mu_across = 0.4"#);
    let refused = refusal(&[grooved, [COULOMB, &none]]);
    assert!(
        refused.contains("`mu_along`") && refused.contains("greater than 0"),
        "{refused}"
    );
    let hardly = law(r#"law = "orthotropic", mu_along = 0.001, mu_across = 0.4"#);
    assert_warned(
        &[grooved, [COULOMB, &hardly]],
        Topic::Friction,
        "0.0010 to 0.4000",
    );
    let some = law(r#"law = "nap", mu_forward = 0.2, mu_backward = 0.6, mu_lateral = 0.4"#);
    let notes = advice(&[grooved, [COULOMB, &some]]).notes;
    let range = notes.iter().find(|note| note.topic == Topic::Friction);
    assert!(
        range.is_some_and(|note| note.text.contains("0.2000 to 0.6000")),
        "{notes:?}"
    );
}

#[test]
fn friction_that_falls() {
    let law = |keys: &str| format!(r#"friction = {{ law = "coulomb", mu = 0.3, {keys} }}"#);
    let falls = law(r#"by_pressure = { form = "table", pressures = [1, 2], factors = [1, 0.4] }"#);
    assert_warned(
        &[[COULOMB, &falls]],
        Topic::Friction,
        "falls as the pressure rises from 1 to 2",
    );
    let noted = |keys: &str, expected: &str| {
        let advice = advice(&[[COULOMB, &law(keys)]]);
        assert_eq!(advice.warnings, []);
        let mut notes = advice.notes.iter();
        let found = notes.any(|note| note.topic == Topic::Friction && note.text.contains(expected));
        assert!(found, "{:?}", advice.notes);
    };
    noted(
        r#"by_pressure = { form = "power-law", exponent = 0.5, pressure = 4 }"#,
        "P(p) = 4 (p/4)^0.5, a parabola below p = 0.004: coefficients are up to 47.4342 times those stated",
    );
    noted(
        r#"by_pressure = { form = "power-law", exponent = 1.5, pressure = 4 }"#,
        "P(p) = 4 (p/4)^1.5: coefficients grow with the pressure",
    );
    noted(
        "decay = { kinetic_over_static = 0.5, slip_rate = 1 }",
        "falls with the slip rate, to 0.5000 of that at rest in fast slip",
    );
}

#[test]
fn a_texture_along_the_normal() {
    let law = r#"friction = { law = "orthotropic", mu_along = 0.2, mu_across = 0.4 }"#;
    for (part, textured) in [
        (
            FLOOR,
            r#"b = { rigid = "floor", texture = { uniform = [0, 0, 1] } }"#,
        ),
        (
            r#"a = { body = "pad", facets = "zmin" }"#,
            r#"a = { body = "pad", facets = "zmin", texture = { uniform = [0, 0, 1] } }"#,
        ),
    ] {
        let refused = refusal(&[[part, textured], [COULOMB, law]]);
        assert!(refused.contains("normal to the surface"), "{refused}");
    }
}

#[test]
fn increments_that_grow_are_counted_as_they_grow() {
    let noted = |stated: &str, words: &str| {
        let notes = advice(&[[PRESSED, &format!("{PRESSED}\nincrements = {stated}")]]).notes;
        assert!(
            notes.iter().any(|note| note.text.contains(words)),
            "{notes:?}"
        );
    };
    noted("30", "at least 30 increments");
    noted("{ initial = 0.1 }", "at least 10 increments");
    // Twelve that sum to 0.001 (1.5^12 - 1)/0.5 = 0.2575, and eight of a tenth.
    noted(
        "{ initial = 1e-3, largest = 0.1 }",
        "at least 20 increments",
    );
}

#[test]
fn displacements_beside_sizes() {
    let by = |way: &str| PRESSED.replace("-0.02", way);
    assert_warned(&[[PRESSED, &by("-50")]], Topic::Units, "50 times as much");
    assert_warned(
        &[[PRESSED, &by("-5e30")]],
        Topic::Units,
        "5e30 times as much",
    );
    let slides = PRESSED.replace("x = 0", "x = 50");
    assert_eq!(advice(&[[PRESSED, &slides]]).warnings, []);
    assert_warned(
        &[[PRESSED, &by("-3")]],
        Topic::Units,
        "by 3 towards each other, from a gap of 0, and the material pressed between them is 1 high: it would be crushed completely",
    );
    let noted = advice(&[[PRESSED, &by("-3")]]);
    let mut notes = noted.notes.iter();
    assert!(notes.any(|note| { note.text.contains("displaces nodes of it by 3, 3 times") }));
}

#[test]
fn waves_that_get_nowhere() {
    let dense = ["youngs_modulus = 1e6", "youngs_modulus = 2\ndensity = 1100"];
    let dynamic = PRESSED.to_owned() + "\ndynamics = {}\nduration = 0.1";
    assert_warned(
        &[dense, [PRESSED, &dynamic]],
        Topic::Units,
        "less than an element",
    );
}

#[test]
fn forces_on_what_is_held() {
    let driven = |more: &str| {
        format!("{PRESSED}\nrigid = [{{ surface = \"floor\"{more}, force = [0.1, 0, 0] }}]")
    };
    assert_warned(
        &[[PRESSED, &driven("")]],
        Topic::Hold,
        "drives `floor` along x, where it is held, so this has no effect; add `free = [\"x\"]`",
    );
    let free = driven(", free = [\"x\"]");
    assert_eq!(advice(&[[PRESSED, &free]]).warnings, []);
    let then = |more: &str| {
        format!(
            "{free}\n[[step]]\nname = \"draw\"\nrigid = [{{ surface = \"floor\", displacement = [0, 0.1, 0]{more} }}]"
        )
    };
    assert_warned(
        &[[PRESSED, &then("")]],
        Topic::Hold,
        "step `draw` holds `floor` along x, where the load of an earlier step goes on and now has no effect; add `free = [\"x\"]`, or end the load",
    );
    for more in [", free = [\"x\"]", ", force = [0, 0, 0]"] {
        let advice = advice(&[[PRESSED, &then(more)]]);
        assert_eq!(advice.warnings, [], "{more}");
    }
}

#[test]
fn loads_on_prescribed_nodes() {
    let loaded = |load: &str| format!("{PRESSED}\n{load}");
    let pressure = loaded(r#"pressure = [{ body = "pad", facets = "zmax", value = 10 }]"#);
    assert_warned(
        &[[PRESSED, &pressure]],
        Topic::Hold,
        "the pressure on facets `zmax` of body `pad` acts on nodes whose displacements along z are all prescribed",
    );
    let beside = loaded(r#"traction = [{ body = "pad", facets = "xmax", vector = [10, 0, 0] }]"#);
    assert_eq!(advice(&[[PRESSED, &beside]]).warnings, []);
    for how in ["total", "each"] {
        let force = |nodes: &str| {
            loaded(&format!(
                "force = [{{ body = \"pad\", nodes = \"{nodes}\", {how} = [1, 0, 0] }}]"
            ))
        };
        assert_warned(
            &[[PRESSED, &force("zmax")]],
            Topic::Hold,
            "the force at nodes `zmax` of body `pad` acts on nodes whose displacements along x are all prescribed",
        );
        assert_eq!(advice(&[[PRESSED, &force("zmin")]]).warnings, []);
    }
}

#[test]
fn loads_on_nodes_that_a_later_step_prescribes() {
    let then = |load: &str, more: &str| {
        format!("{load}\n[[step]]\nname = \"hold\"\n{PRESSED}\n{more}\n[[step]]\nname = \"wait\"")
    };
    let loads = [
        (
            "traction",
            "facets",
            "vector",
            "the traction on facets `zmax`",
        ),
        ("force", "nodes", "total", "the force at nodes `zmax`"),
    ];
    for (key, set, value, words) in loads {
        let load = |z: &str| {
            format!("{key} = [{{ body = \"pad\", {set} = \"zmax\", {value} = [0, 0, {z}] }}]")
        };
        let text = format!(
            "step `hold` prescribes the displacements along z of all nodes on which {words} of body `pad` acts, which goes on from an earlier step and now only changes reactions"
        );
        assert_warned(&[[PRESSED, &then(&load("-10"), "")]], Topic::Hold, &text);
        let ended = then(&load("-10"), &load("0"));
        assert_eq!(advice(&[[PRESSED, &ended]]).warnings, [], "{key}");
        let along = then(&load("-10"), "").replace(", z = -0.02", "");
        assert_eq!(advice(&[[PRESSED, &along]]).warnings, [], "{key}");
    }
}

#[test]
fn forces_and_slides_out_of_proportion() {
    let pushed = |force: &str| {
        format!("force = [{{ body = \"pad\", nodes = \"zmax\", total = [0, 0, {force}] }}]")
    };
    assert_warned(
        &[[PRESSED, &pushed("-2e7")]],
        Topic::Units,
        "is a strain of 20: it would be crushed or torn",
    );
    assert_eq!(advice(&[[PRESSED, &pushed("-2e4")]]).warnings, []);
    let slid = |way: &str| PRESSED.replace("x = 0", &format!("x = {way}"));
    assert_warned(
        &[[PRESSED, &slid("200")]],
        Topic::Units,
        "slides nodes of it by 200 along it, far beyond what it touches",
    );
    assert_eq!(advice(&[[PRESSED, &slid("5")]]).warnings, []);
}

#[test]
fn a_free_coordinate_with_a_target() {
    let moved = |way: &str| {
        format!(
            "{PRESSED}\nrigid = [{{ surface = \"floor\", free = [\"x\"], displacement = [{way}, 0, 0] }}]"
        )
    };
    let found = refusal(&[[PRESSED, &moved("1")]]);
    let words = "coordinate `x` of rigid body `floor` is `free`, so it follows the forces and has no target, but its target is 1";
    assert!(found.contains(words), "{found}");
    assert!(read(&[[PRESSED, &moved("0")]]).is_ok());
}

#[test]
fn a_contact_surface_that_is_prescribed() {
    let sole = |way: &str| PRESSED.replace("zmax", "zmin").replace("-0.02", way);
    assert_warned(
        &[[PRESSED, &sole("0")]],
        Topic::Hold,
        "displacements prescribe all nodes of the contact surface of `pad` along its normal",
    );
    let found = refusal(&[[PRESSED, &sole("-0.02")]]);
    let words =
        "displacements move all nodes of its contact surface, up to 0.02 deep into the rigid plane";
    assert!(found.contains(words), "{found}");
}

#[test]
fn a_displacement_of_the_wrong_sign() {
    assert_warned(
        &[[PRESSED, &PRESSED.replace("-0.02", "0.02")]],
        Topic::NeverMeets,
        "moves `pad` and `floor` apart by 0.02",
    );
    // Loads that hardly strain the pad leave them apart.
    let lifted = |load: &str| {
        let lifted = PRESSED.replace("-0.02", "0.02");
        format!("{lifted}\nforce = [{{ body = \"pad\", nodes = \"zmin\", total = {load} }}]")
    };
    for load in ["[100, 0, 0]", "[0, 0, -100]"] {
        assert_warned(
            &[[PRESSED, &lifted(load)]],
            Topic::NeverMeets,
            "moves `pad` and `floor` apart by 0.02",
        );
    }
    assert_eq!(advice(&[[PRESSED, &lifted("[0, 0, -4e4]")]]).warnings, []);
}

#[test]
fn a_tool_in_another_unit_of_length() {
    let plane = "plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
    let facet = "mesh = { positions = [[0, 0, 0], [1e-3, 0, 0], [1e-3, 1e-3, 0], [0, 1e-3, 0]], facets = [[0, 1, 2, 3]] }";
    let found = advice(&[[plane, facet]]);
    let mut warnings = found.warnings.iter();
    assert!(warnings.any(|warning| {
        warning.topic == Topic::Units
            && (warning.text).contains("are both meshes in one unit of length?")
    }));
}

#[test]
fn facets_of_a_tool_that_are_none_or_turned() {
    let plane = "plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
    let tool = |facets: &str| {
        format!(
            "mesh = {{ positions = [[-1, -1, 0], [1, -1, 0], [3, -1, 0], [-1, 3, 0], [1, 3, 0], [3, 3, 0]], facets = [{facets}] }}"
        )
    };
    assert!(read(&[[plane, &tool("[0, 1, 4, 3], [1, 2, 5, 4]")]]).is_ok());
    let turned = refusal(&[[plane, &tool("[0, 1, 4, 3], [1, 4, 5, 2]")]]);
    assert!(
        turned.starts_with(
            "deck.toml:17:8: facets 0 and 1 of rigid surface `floor` have opposite orientations at their edge from (1, -1, 0) to (1, 3, 0); reverse one of them"
        ),
        "{turned}"
    );
    let flat = refusal(&[[plane, &tool("[0, 1, 4, 3], [0, 1, 2, 1]")]]);
    assert!(
        flat.starts_with("deck.toml:17:8: facet 1 of rigid surface `floor`, with a corner at (-1, -1, 0), has no area"),
        "{flat}"
    );
}

#[test]
fn contact_that_spreads_onto_facets_outside_its_pair() {
    let half = [
        PAD,
        "origin = [0, 0, 0], size = [1, 1, 1], divisions = [4, 4, 4]",
    ];
    let set = [
        "material = \"rubber\"\nmesh",
        "material = \"rubber\"\nfacet_sets = [{ name = \"half\", of = \"zmin\", from = [0, 0, 0], to = [0.5, 1, 0] }]\nmesh",
    ];
    assert_warned(
        &[half, set, [r#"facets = "zmin""#, r#"facets = "half""#]],
        Topic::Fit,
        "contact with `floor` spreads that far, and the surface of `pad` continues smoothly beyond the facets of the pair, as at (0.5, 0, 0)",
    );
}

#[test]
fn contact_of_a_patch_that_spreads_over_another_body() {
    let ring = r#"name = "ring"
material = "rubber"
mesh = { generator = "annulus", centre = [0.5, 0.5, 6], inner_radius = 3, outer_radius = 5, width = 0.5, divisions = [2, 64, 2] }
facet_sets = [{ name = "patch", of = "tread", from = [-0.4, -2, 0.9], to = [1.4, 3, 2] }]
[[body]]
name = "pad"
material = "rubber""#;
    let pressed = |way: &str| {
        format!(
            "displacement = [{{ body = \"pad\", nodes = \"zmin\", x = 0, y = 0, z = 0 }}, {{ body = \"ring\", nodes = \"rim\", x = 0, y = 0, z = {way} }}]"
        )
    };
    let warns = |way: &str| {
        let found = advice(&[
            ["name = \"pad\"\nmaterial = \"rubber\"", ring],
            [
                PAD,
                "origin = [-2, -1, 0], size = [5, 3, 1], divisions = [10, 4, 2]",
            ],
            [
                r#"a = { body = "pad", facets = "zmin" }"#,
                r#"a = { body = "ring", facets = "patch" }"#,
            ],
            [FLOOR, r#"b = { body = "pad", facets = "zmax" }"#],
            [PRESSED, &pressed(way)],
        ]);
        let mut warnings = found.warnings.iter();
        warnings.any(|warning| warning.text.contains("contact with `pad` spreads that far"))
    };
    assert!(warns("-0.5"));
    assert!(!warns("-0.01"));
}

#[test]
fn a_texture_that_friction_does_not_look_at() {
    let textured = [
        FLOOR,
        r#"b = { rigid = "floor", texture = { uniform = [1, 0, 0] } }"#,
    ];
    let noted = advice(&[textured]);
    let mut notes = noted.notes.iter();
    assert!(notes.any(|note| note.text.contains("friction is the same in all directions")));
}

#[test]
fn soft_matter_in_pascals() {
    let large = [PAD, "size = [40, 40, 20], divisions = [3, 3, 3]"];
    let noted = advice(&[large]);
    let mut notes = noted.notes.iter();
    assert!(notes.any(|note| {
        note.text
            .contains("lengths are in metres, and it is 40 m long")
    }));
}

#[test]
fn coefficients_that_are_hardly_meant() {
    let percent = [COULOMB, r#"friction = { law = "coulomb", mu = 30 }"#];
    assert_warned(&[percent], Topic::Friction, "not percentages");
}

#[test]
fn nodes_that_are_not_joined() {
    let slit = "{ positions = [[0,0,0],[1,0,0],[0,1,0],[1,1,0],[0,0,1],[1,0,1],[0,1,1],[1,1,1],[0,0,1],[1,0,1],[0,1,1],[1,1,1],[0,0,2],[1,0,2],[0,1,2],[1,1,2]], cells = [[0,1,3,2,4,5,7,6],[8,9,11,10,12,13,15,14]] }
facet_sets = [{ name = \"zmin\", sides = [[0, 0]] }]
node_sets = [{ name = \"zmax\", numbers = [4, 5, 6, 7, 8, 9, 10, 11] }]";
    let mesh = format!("{{ generator = \"block\", {PAD} }}");
    let found = advice(&[[&mesh, slit]]);
    let [warning] = &found.warnings[..] else {
        panic!("{:?}", found.warnings);
    };
    let words = "not joined: 4, the first node 4 and node 8 at (0, 0, 1)";
    assert!(warning.text.contains(words), "{warning}");
    let mut notes = found.notes.iter();
    assert!(notes.any(|note| note.text.contains("2 pieces that share no nodes")));
}

#[test]
fn pieces_of_a_body_that_are_a_pair_have_a_gap() {
    let pieces = "{ positions = [[0,0,0],[1,0,0],[0,1,0],[1,1,0],[0,0,1],[1,0,1],[0,1,1],[1,1,1],[0,0,1.1],[1,0,1.1],[0,1,1.1],[1,1,1.1],[0,0,2],[1,0,2],[0,1,2],[1,1,2]], cells = [[0,1,3,2,4,5,7,6],[8,9,11,10,12,13,15,14]] }
facet_sets = [{ name = \"zmin\", sides = [[0, 1]] }, { name = \"upper\", sides = [[1, 0]] }]
node_sets = [{ name = \"zmax\", numbers = [0, 1, 2, 3, 12, 13, 14, 15] }]";
    let mesh = format!("{{ generator = \"block\", {PAD} }}");
    let other = [FLOOR, r#"b = { body = "pad", facets = "upper" }"#];
    let found = advice(&[[&mesh, pieces], other]);
    let mut notes = found.notes.iter();
    assert!(notes.any(|note| note.text.contains("`sole`: smallest gap 0.1")));
    let [warning] = &found.warnings[..] else {
        panic!("{:?}", found.warnings);
    };
    assert!(warning.text.contains("are 1.000e-1 apart"), "{warning}");
}

#[test]
fn bodies_that_touch_without_a_pair() {
    let text = r#"name = "lid"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 1], size = [1, 1, 1], divisions = [2, 2, 2] }
[[body]]
name = "pad"
material = "rubber""#;
    let held = PRESSED.replace(
        "]",
        r#", { body = "lid", nodes = "zmax", x = 0, y = 0, z = 0 }]"#,
    );
    assert_warned(
        &[
            ["name = \"pad\"\nmaterial = \"rubber\"", text],
            [PRESSED, &held],
        ],
        Topic::Fit,
        "bodies `lid` and `pad` touch or overlap as meshed, but no pair and no tie joins them, so they pass through each other; add a [[pair]] or a [[tie]], or in contact of everything remove the `exclude` of their contact",
    );
}

#[test]
fn a_curved_contact_of_few_nodes() {
    let cap = "generator = \"capped-block\", size = [10, 10], height = 5, radius = 10, element_size = 2.5";
    let block = format!("generator = \"block\", {PAD}");
    let noted = advice(&[
        [&block, cap],
        [r#"facets = "zmin""#, r#"facets = "cap""#],
        [PRESSED, &PRESSED.replace("0.02", "0.1")],
    ]);
    let mut notes = noted.notes.iter();
    let words = "about 1 of 25 nodes touch the plane";
    assert!(
        notes.any(|note| note.text.contains(words)),
        "{:?}",
        noted.notes
    );
}

/// A thin plate on a block whose faces have other numbers, and a body in two pairs.
#[test]
fn a_curved_contact_narrower_than_the_facets_of_the_other_body() {
    let cap = r#"name = "cap"
material = "rubber"
mesh = { generator = "capped-block", apex = [0.5, 0.5, 1], size = [0.8, 0.8], height = 0.4, radius = 1, element_size = 0.1 }
[[body]]
name = "pad"
material = "rubber""#;
    let held = r#"displacement = [{ body = "pad", nodes = "zmin", x = 0, y = 0, z = 0 }, { body = "cap", nodes = "zmax", x = 0, y = 0, z = -0.005 }]"#;
    let noted = advice(&[
        ["name = \"pad\"\nmaterial = \"rubber\"", cap],
        [
            r#"a = { body = "pad", facets = "zmin" }"#,
            r#"a = { body = "cap", facets = "cap" }"#,
        ],
        [FLOOR, r#"b = { body = "pad", facets = "zmax" }"#],
        [PRESSED, held],
    ]);
    // 2 sqrt(2 R u) = .2 wide, .6 of a facet of 1/3.
    let mut notes = noted.notes.iter();
    assert!(
        notes.any(|note| note.text.contains("0.6 facets of `pad`")),
        "{:?}",
        noted.notes
    );
}

#[test]
fn thin_bodies_between_others_are_judged_by_their_own_meshes() {
    for divisions in ["[2, 2, 1]", "[6, 6, 1]"] {
        let plate = format!(
            r#"name = "pad"
material = "rubber"
mesh = {{ generator = "block", origin = [0, 0, 1], size = [1, 1, 0.1], divisions = {divisions} }}
[[body]]
name = "base"
material = "rubber""#
        );
        let pairs = r#"[[pair]]
name = "upper"
a = { body = "base", facets = "zmax" }
b = { body = "pad", facets = "zmin" }
[[pair]]
name = "sole""#;
        let sole = r#"a = { body = "base", facets = "zmin" }"#;
        let found = advice(&[
            ["name = \"pad\"\nmaterial = \"rubber\"", &plate],
            ["[[pair]]\nname = \"sole\"", pairs],
            [r#"a = { body = "pad", facets = "zmin" }"#, sole],
        ]);
        assert_eq!(found.faults, []);
    }
}

#[test]
fn facets_that_are_far_smaller_than_those_opposite() {
    let with = |divisions: &str| {
        let plate = format!(
            r#"name = "pad"
material = "rubber"
mesh = {{ generator = "block", origin = [0, 0, 1], size = [1, 1, 0.1], divisions = {divisions} }}
[[body]]
name = "base"
material = "rubber""#
        );
        let pairs = r#"[[pair]]
name = "upper"
a = { body = "base", facets = "zmax" }
b = { body = "pad", facets = "zmin" }
[[pair]]
name = "sole""#;
        let sole = r#"a = { body = "base", facets = "zmin" }"#;
        read(&[
            ["name = \"pad\"\nmaterial = \"rubber\"", &plate],
            ["[[pair]]\nname = \"sole\"", pairs],
            [r#"a = { body = "pad", facets = "zmin" }"#, sole],
        ])
    };
    let warned = |divisions: &str| {
        let warnings = Advice::of(&with(divisions).expect("a valid deck").model).warnings;
        let mut about = warnings.into_iter().map(|warning| warning.text);
        about.find(|text| text.contains("facets of `pad` lie opposite one facet of `base`"))
    };
    assert_eq!(warned("[20, 20, 1]"), None);
    let told = warned("[400, 3, 1]").expect("a warning");
    assert!(
        told.contains("133 facets") || told.contains("134 facets"),
        "{told}"
    );
    let refused = with("[3000, 3, 1]").expect_err("a fault").to_string();
    assert!(
        refused.contains("facets of `pad` lie opposite one facet of `base`")
            && refused.contains("Refine `base` there"),
        "{refused}"
    );
}

#[test]
fn thin_bending() {
    let strip = |divisions: &str| {
        format!("origin = [0, 0, 0.2], size = [10, 1, 0.1], divisions = {divisions}")
    };
    let bent = r#"displacement = [
        { body = "pad", nodes = "xmin", x = 0, y = 0, z = 0 },
        { body = "pad", nodes = "xmax", z = -0.5 },
    ]"#;
    // 1 + (1/0.1)^2/2.6 times as stiff.
    assert_warned(
        &[[PAD, &strip("[10, 1, 1]")], [PRESSED, bent]],
        Topic::Bending,
        "39.5 times",
    );
    assert_warned(
        &[[PAD, &strip("[10, 1, 4]")], [PRESSED, bent]],
        Topic::Bending,
        "39.5 times",
    );
    let fine = advice(&[[PAD, &strip("[250, 1, 1]")], [PRESSED, bent]]);
    assert_eq!(fine.warnings, []);
    assert!(fine.notes.iter().all(|note| note.topic != Topic::Bending));
    let assumed = ["[[rigid]]", "formulation = \"assumed-strain\"\n\n[[rigid]]"];
    let fine = advice(&[[PAD, &strip("[10, 1, 1]")], [PRESSED, bent], assumed]);
    assert_eq!(fine.warnings, []);
    let wedges = format!("{}, cells = \"wedges\"", strip("[10, 1, 1]"));
    let others = [[PAD, &wedges], [PRESSED, bent], assumed];
    let warnings = advice(&others).warnings;
    let mut locking = warnings.iter().filter(|of| of.topic == Topic::Locking);
    let of_others = locking.next().map(|of| &of.text[..]).unwrap_or_default();
    assert!(of_others.contains("elements other than hexahedra"));
    // On the floor it does not bend.
    let flat = [PAD, "size = [10, 1, 0.1], divisions = [10, 1, 1]"];
    assert_eq!(
        advice(&[flat, [PRESSED, &PRESSED.replace("0.02", "0.002")]]).warnings,
        []
    );
}
