//! Contact of everything beside named pairs of the faces that touch.

use super::{OF_FACES, completed, forces};

/// A soft block that is pushed off a stiff one and sinks behind its edge.
const OFF: &str = r#"
title = "A block that is pushed off another one"
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.45
[[material]]
name = "stiff"
law = "neo-hookean"
youngs_modulus = 100
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "stiff"
mesh = { generator = "block", size = [1, 1, 0.6], divisions = [3, 3, 2] }
[[body]]
name = "upper"
material = "soft"
mesh = { generator = "block", origin = [0.25, 0.15, 0.6], size = [0.7, 0.7, 0.4], divisions = [2, 4, 2] }
CONTACT
[[step]]
name = "press"
increments = 4
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.04 },
]
[[step]]
name = "off"
increments = 12
displacement = [{ body = "upper", nodes = "zmax", x = 0.85 }]
"#;

#[test]
fn a_block_is_pushed_off_another_one_as_with_a_named_pair() {
    let named = r#"
[[pair]]
name = "soles"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
friction = { law = "coulomb", mu = 0.3 }
"#;
    let all = r#"
[contact]
all = true
friction = { law = "coulomb", mu = 0.3 }
"#;
    let all = format!("{all}{OF_FACES}");
    let [named, found] = [named, &all].map(|contact| {
        let text = OFF.replace("CONTACT", contact);
        completed(&text)
    });
    assert_eq!(found.increments, named.increments);
    let named = forces(&named, "soles");
    let found = forces(&found, "lower.zmax-upper.zmin");
    let last = named.each_ref().map(|axis| axis[15]);
    assert!(named[2][3] < -0.01 && last == [0.0; 3], "{named:?}");
    for (named, found) in named.iter().flatten().zip(found.iter().flatten()) {
        assert!((named - found).abs() < 1e-10, "{named} {found}");
    }
}

/// A thin sheet that is pressed onto another one, on facets of five times their thickness.
const SHEETS: &str = r#"
title = "A sheet on a sheet"
[[material]]
name = "soft"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "soft"
mesh = { generator = "block", size = [0.3, 0.3, 0.02], divisions = [4, 4, 1] }
[[body]]
name = "upper"
material = "soft"
mesh = { generator = "block", origin = [0, 0, 0.02], size = [0.3, 0.3, 0.02], divisions = [3, 3, 1] }
CONTACT
[[step]]
name = "press"
increments = 2
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.0002 },
]
"#;

#[test]
fn outer_faces_of_thin_bodies_do_not_touch_through_both() {
    let named = r#"
[[pair]]
name = "sheets"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
SEARCH
"#;
    let skins = r#"
[[pair]]
name = "skins"
a = { body = "lower", facets = "all" }
b = { body = "upper", facets = "all" }
feature_angle = 45
SEARCH
"#;
    let all = "[contact]\nall = true\nSEARCH\n";
    let pressed = |contact: &str, search: &str| {
        let contact = contact.replace("SEARCH", search);
        let text = SHEETS.replace("CONTACT", &contact);
        let run = completed(&text);
        assert!(run.summary.warnings.is_empty());
        let force = run.history.column("reaction.upper.zmax.z").unwrap();
        force[1]
    };
    let named = pressed(named, "");
    assert!(named < -100.0, "{named}");
    // However far contact looks, both sheets stay between their outer faces.
    for search in ["", "search_distance = 0.02", "search_distance = 0.3"] {
        for contact in [all, skins] {
            let found = pressed(contact, search);
            assert!(
                (found - named).abs() < 1e-9 * named.abs(),
                "{found} {named}"
            );
        }
    }
}
