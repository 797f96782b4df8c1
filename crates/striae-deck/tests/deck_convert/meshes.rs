//! Parts, surfaces and materials.

use super::{CUBE, FOAM, STEP, assert_listed, converted, made, model};
use striae_law::bulk::Law;
use striae_mesh::Vec3;

fn with_surfaces(surfaces: &str) -> String {
    let cube = CUBE.replace("*SOLID SECTION", &format!("{surfaces}*SOLID SECTION"));
    format!("{cube}*END ASSEMBLY\n{FOAM}{STEP}")
}

#[test]
fn surfaces_without_faces_are_all_that_is_free() {
    let (_, listed, deck) = converted(&with_surfaces("*SURFACE, NAME=Skin\nAll,\n"));
    assert_listed(&listed, &[]);
    let sets = &deck.model.bodies[0].mesh.facet_sets;
    assert_eq!(sets.get("Base-1.Skin").unwrap().len(), 6);
}

#[test]
fn surfaces_are_combined() {
    let surfaces = "*SURFACE, NAME=Two\n1, S1\n1, S2\n
*SURFACE, NAME=Both, COMBINE=UNION\nTop, Bottom
*SURFACE, NAME=One, COMBINE=INTERSECTION\nTwo, Top
*SURFACE, NAME=Rest, COMBINE=DIFFERENCE\nTwo, Top\n";
    let (_, listed, deck) = converted(&with_surfaces(surfaces));
    assert_listed(&listed, &[]);
    let sets = &deck.model.bodies[0].mesh.facet_sets;
    let of = |name: &str| sets.get(&format!("Base-1.{name}")).unwrap().to_vec();
    assert_eq!(of("Both"), [of("Bottom"), of("Top")].concat());
    assert_eq!((of("One"), of("Rest")), (of("Top"), of("Bottom")));
}

#[test]
fn instances_are_moved_and_then_turned() {
    let turned = "*INSTANCE, NAME=Third, PART=Cube\n0., 0., 5.\n0., 0., 0., 0., 0., 1., 90.\n*END INSTANCE\n";
    let step = STEP.replace("Base-1.Low, 1, 3\n", "Base-1.Low, 1, 3\nThird.Low, 1, 3\n");
    let (_, listed, deck) = converted(&model(turned, &step));
    assert_listed(&listed, &[]);
    let (low, high) = deck.model.bodies[2].mesh.bounds();
    assert!((low - Vec3::new(-1.0, 0.0, 5.0)).norm() < 1e-15);
    assert!((high - Vec3::new(0.0, 1.0, 6.0)).norm() < 1e-15);
}

#[test]
fn rubber_and_metals() {
    for (card, expected) in [
        (
            "*HYPERELASTIC, NEO HOOKE\n1., 0.02",
            "isochoric-neo-hookean",
        ),
        (
            "*HYPERELASTIC, MOONEY-RIVLIN\n1., 0.2, 0.02",
            "mooney-rivlin",
        ),
        ("*HYPERELASTIC, YEOH\n1., 0.2, 0.1, 0.02", "yeoh"),
        ("*HYPERELASTIC, OGDEN, N=1\n1., 2., 0.02", "ogden"),
        (
            "*ELASTIC\n100., 0.3\n*PLASTIC\n1., 0.\n2., 0.1",
            "elastic-plastic",
        ),
    ] {
        let text = model("", STEP).replace("*ELASTIC\n100., 0.\n", &format!("{card}\n"));
        let (text, listed, _) = converted(&text);
        assert_listed(&listed, &[]);
        assert!(text.contains(&format!("law = \"{expected}\"")), "{text}");
    }
    let visco = "*ELASTIC\n100., 0.3\n*VISCOELASTIC, TIME=PRONY\n0.5, 0., 0.1";
    let text = model("", STEP).replace("*ELASTIC\n100., 0.", visco);
    let (_, listed, deck) = converted(&text);
    assert_listed(&listed, &[]);
    assert!(matches!(
        deck.model.bodies[0].material.law(),
        Law::Viscoelastic(_)
    ));
}

#[test]
fn options_of_heat_leave_a_material_as_it_is() {
    let more = "*EXPANSION\n1e-5,\n*CONDUCTIVITY\n50.,\n*SPECIFIC HEAT\n1.,\n*DAMPING, ALPHA=1.\n";
    let text = model("", STEP).replace(
        "*ELASTIC\n100., 0.\n",
        &format!("*ELASTIC\n100., 0.\n{more}"),
    );
    let (_, listed, deck) = converted(&text);
    let said = [
        "*EXPANSION: there are no temperatures",
        "*CONDUCTIVITY",
        "*SPECIFIC HEAT",
        "*DAMPING: materials have no damping",
    ];
    assert_listed(&listed, &said);
    assert_eq!(deck.model.bodies[0].density, 2e-9);
}

#[test]
fn materials_without_a_counterpart_are_listed() {
    for (card, said) in [
        (
            "*HYPERELASTIC, TEST DATA INPUT, OGDEN\n*UNIAXIAL TEST DATA\n1., 1.",
            "NEO HOOKE",
        ),
        (
            "*ELASTIC, TYPE=ORTHOTROPIC\n1., 1., 1., 1.",
            "TYPE=ISOTROPIC",
        ),
        ("*USER MATERIAL, CONSTANTS=1\n1.", "*DENSITY, *ELASTIC"),
    ] {
        let text = model("", STEP).replace("*ELASTIC\n100., 0.\n", &format!("{card}\n"));
        let (_, made) = made(&text);
        let found = made
            .listed
            .iter()
            .find(|line| line.contains("*MATERIAL `foam`"));
        assert!(
            found.is_some_and(|line| line.contains(said)),
            "{:?}",
            made.listed
        );
    }
}

#[test]
fn elements_that_are_no_solids_are_listed() {
    let shells = "*ELEMENT, TYPE=S4, ELSET=Shell\n7, 5, 6, 7, 8\n";
    let cube = CUBE.replace("*NSET, NSET=Low", &format!("{shells}*NSET, NSET=Low"));
    let text = format!("{cube}*END ASSEMBLY\n{FOAM}{STEP}");
    let (_, listed, _) = converted(&text);
    assert_listed(
        &listed,
        &["*ELEMENT, TYPE=S4: 1 element is left out; only C3D4 to C3D27 are elements of a body"],
    );
}

#[test]
fn models_of_a_plane_say_that_they_are() {
    let (_, made) = made(
        "*NODE\n1, 0., 0.\n2, 1., 0.\n3, 1., 1.\n4, 0., 1.\n*ELEMENT, TYPE=CPE4\n1, 1, 2, 3, 4\n",
    );
    assert!(
        made.listed[0].contains("no solid elements"),
        "{:?}",
        made.listed
    );
}

#[test]
fn parameters_are_refused_with_their_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.inp");
    let text = format!("*PARAMETER\nlength = 2.\n{}", model("", STEP));
    std::fs::write(&path, text).unwrap();
    let fault = striae_deck::convert(&path, "model.inp")
        .unwrap_err()
        .to_string();
    assert!(
        fault.contains("line 1: expected numbers in the places of parameters"),
        "{fault}"
    );
    assert!(fault.contains("write the value for each name"), "{fault}");
}

#[test]
fn included_files_are_named_with_their_lines() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("model.inp");
    std::fs::write(
        folder.path().join("steps.inp"),
        STEP.replace("*STATIC", "*HEAT TRANSFER"),
    )
    .unwrap();
    std::fs::write(&path, model("", "*INCLUDE, INPUT=steps.inp\n")).unwrap();
    let made = striae_deck::convert(&path, "model.inp").unwrap();
    let found = made
        .listed
        .iter()
        .any(|line| line.starts_with("steps.inp line 1: *STEP `Press`"));
    assert!(found, "{:?}", made.listed);
}

#[test]
fn solids_that_no_body_has_are_listed_and_left_out() {
    for kind in ["COH3D8", "GK3D8", "SC8R", "CIN3D8"] {
        let more = format!(
            "*ELEMENT, TYPE={kind}, ELSET=Glue\n8, 5, 6, 7, 8, 5, 6, 7, 8\n9, 5, 6, 7, 8,\n 5, 6, 7, 8\n"
        );
        let cube = CUBE.replace("*NSET, NSET=Low", &format!("{more}*NSET, NSET=Low"));
        let (_, listed, deck) = converted(&format!("{cube}*END ASSEMBLY\n{FOAM}{STEP}"));
        let said = format!("*ELEMENT, TYPE={kind}: 2 elements are left out; only C3D4 to C3D27");
        assert_listed(&listed, &[&said]);
        assert_eq!(deck.model.bodies[0].mesh.element_count(), 1);
    }
}

#[test]
fn materials_end_at_keywords_that_are_no_options() {
    for (keyword, said) in [
        (
            "*FOUNDATION\nPad-1.1, F1, 100.\n",
            "*FOUNDATION: state a `[[spring]]` with a `direction`",
        ),
        ("*FILM PROPERTY, NAME=F\n1.,\n", "*FILM PROPERTY"),
        ("*SECTION CONTROLS, NAME=C\n1.,\n", "*SECTION CONTROLS"),
        (
            "*SURFACE PROPERTY ASSIGNMENT, PROPERTY=THICKNESS\n, 1.\n",
            "*SURFACE PROPERTY ASSIGNMENT",
        ),
        ("*CONTROLS\n1.,\n", "*CONTROLS"),
        ("*BASE MOTION, DOF=1\n", "*BASE MOTION"),
        ("*MONITOR, NODE=Pad-1.1, DOF=1\n", "*MONITOR"),
    ] {
        let (_, listed, deck) = converted(&model("", &format!("{keyword}{STEP}")));
        assert_listed(&listed, &[said]);
        assert_eq!(deck.model.bodies[0].density, 2e-9);
    }
}

/// A column of two cubes of one part, with these sections.
fn column(sections: &str) -> String {
    let upper = "9, 0., 0., 2.\n10, 1., 0., 2.\n11, 1., 1., 2.\n12, 0., 1., 2.\n";
    let second = "2, 5, 6, 7, 8, 9, 10, 11, 12\n*ELSET, ELSET=First\n1,\n";
    let cube = CUBE
        .replace("*ELEMENT", &format!("{upper}*ELEMENT"))
        .replace("*NSET, NSET=Low", &format!("{second}*NSET, NSET=Low"))
        .replace("*SOLID SECTION, ELSET=All, MATERIAL=Foam\n,\n", sections)
        .replace(
            "*INSTANCE, NAME=Pad-1, PART=Cube\n0., 0., 1.\n*END INSTANCE\n",
            "",
        );
    let rigid = "*ELASTIC\n100., 0.\n*MATERIAL, NAME=Wood\n*ELASTIC\n50., 0.\n";
    let step = "*STEP, NLGEOM=YES\n*STATIC\n*BOUNDARY\nBase-1.Low, 1, 3\n*END STEP\n";
    format!("{cube}*END ASSEMBLY\n{FOAM}{step}").replace("*ELASTIC\n100., 0.\n", rigid)
}

#[test]
fn the_last_section_of_an_element_holds() {
    let foam = "*SOLID SECTION, ELSET=All, MATERIAL=Foam\n";
    let wood = "*SOLID SECTION, ELSET=First, MATERIAL=Wood\n";
    let (text, listed, deck) = converted(&column(&format!("{foam}{wood}")));
    let said =
        "*SOLID SECTION of `First` holds for element 1, not that of `All` which is stated before";
    assert_listed(&listed, &[said]);
    assert!(
        text.contains("{ name = \"rest of All\", numbers = [1] }"),
        "{text}"
    );
    assert_eq!(deck.model.bodies[0].sections.len(), 2);
    let (text, listed, _) = converted(&column(&format!("{wood}{foam}")));
    let said =
        "*SOLID SECTION of `All` holds for element 1, not that of `First` which is stated before";
    assert_listed(&listed, &[said]);
    assert!(text.contains("\nmaterial = \"foam\"\n"), "{text}");
}

#[test]
fn comments_on_top_may_have_signs_before_them() {
    let (_, listed, _) = converted(&format!(">** written by a program\n{}", model("", STEP)));
    assert_listed(&listed, &[]);
}
