//! Bodies that move themselves.

use std::path::Path;

use striae_deck::{Deck, Faults, parse};
use striae_mesh::Vec3;
use striae_model::{Actuation, ActuationKind, Curve};

/// A bar of two elements, the right one a section with fibres, with actuations in two steps.
fn read(first: &str, second: &str) -> Result<Deck, Faults> {
    let text = format!(
        r#"title = "A bar that moves itself"

[[material]]
name = "gum"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3

[[material]]
name = "muscle"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
fibres = [{{ modulus = 1, direction = {{ uniform = [1, 0, 0] }} }}]

[[curve]]
name = "overshoot"
points = [[0, 0], [0.5, 2], [1, 1]]

[[body]]
name = "bar"
material = "gum"
mesh = {{ generator = "block", size = [2, 1, 1], divisions = [2, 1, 1] }}
element_sets = [{{ name = "right", numbers = [1] }}]
sections = [{{ elements = "right", material = "muscle" }}]

[[step]]
name = "first"
displacement = [{{ body = "bar", nodes = "xmin", x = 0, y = 0, z = 0 }}]
actuation = [
{first}
]

[[step]]
name = "second"
actuation = [
{second}
]
"#
    );
    parse(&text, "deck.toml", Path::new(""))
}

fn actuations(first: &str) -> Vec<Actuation> {
    let deck = read(first, "").unwrap_or_else(|faults| panic!("{faults}"));
    deck.model.steps[0].actuations.clone()
}

/// The faults of a statement in the first step, and one in the second, without their columns.
fn told(first: &str, second: &str) -> Vec<String> {
    let faults = read(first, second).expect_err("faults");
    let faults = faults.iter().map(ToString::to_string);
    faults
        .map(|fault| fault.splitn(4, ':').nth(3).unwrap_or("").trim().to_owned())
        .collect()
}

#[test]
fn all_kinds_are_read() {
    let found = actuations(
        r#"{ body = "bar", stretch = 0.1 },
           { body = "bar", section = "right", stretch = -0.1, along = "fibres", curve = "smooth" },
           { body = "bar", thermal_expansion = 1e-3, temperature = 50 },
           { body = "bar", section = "right", tension = 0.3, along = "fibres" },
           { body = "bar", tension = 0.2, along = [0, 3, 4], curve = "overshoot" }"#,
    );
    let kinds: Vec<ActuationKind> = found.iter().map(|of| of.kind).collect();
    assert_eq!(
        kinds,
        [
            ActuationKind::isotropic(0.1),
            ActuationKind::FibreStrain(-0.1),
            ActuationKind::Thermal {
                expansion: 1e-3,
                temperature: 50.0
            },
            ActuationKind::FibreTension(0.3),
            ActuationKind::Tension {
                along: Vec3::new(0.0, 0.6, 0.8),
                value: 0.2
            },
        ]
    );
    let sections: Vec<Option<usize>> = found.iter().map(|of| of.section).collect();
    assert_eq!(sections, [None, Some(1), None, Some(1), None]);
    assert_eq!(found[1].curve, Curve::Smooth);
    assert!(matches!(found[4].curve, Curve::Table(_)));
}

#[test]
fn strains_have_their_axes() {
    let found = actuations(
        r#"{ body = "bar", strain = [0.1, 0.2, 0.3, 0.01, 0.02, 0.03], axes = [[0, 2, 0], [0, 1, 1]] }"#,
    );
    // x of the strain is y, y of it z, z of it x.
    let expected = [[0.3, 0.03, 0.02], [0.03, 0.1, 0.01], [0.02, 0.01, 0.2]];
    let ActuationKind::Strain(strain) = found[0].kind else {
        panic!("{found:?}")
    };
    for (i, row) in expected.iter().enumerate() {
        for (j, component) in row.iter().enumerate() {
            assert!((strain[(i, j)] - component).abs() < 1e-15, "{strain}");
        }
    }
    let along = actuations(r#"{ body = "bar", stretch = 0.5, along = [3, 0, 4] }"#);
    let ActuationKind::Strain(strain) = along[0].kind else {
        panic!("{along:?}")
    };
    let grown = strain * Vec3::new(0.6, 0.0, 0.8);
    assert!((grown - Vec3::new(0.3, 0.0, 0.4)).norm() < 1e-15);
    assert!((strain * Vec3::y()).norm() == 0.0);
}

#[test]
fn what_leaves_nothing_of_a_length_is_refused() {
    let gone = |of: &str, factor: &str| {
        format!(
            "step `first` actuates {of}: its lengths at rest would change by the factor {factor} and vanish; strains, all kinds together and with the values of their curves, must stay above -1"
        )
    };
    for (stated, of, factor) in [
        (r#"{ body = "bar", stretch = -1 }"#, "body `bar`", "0.0000"),
        (
            r#"{ body = "bar", strain = [0, 0, 0, 1.5, 0, 0] }"#,
            "body `bar`",
            "-0.5000",
        ),
        (
            r#"{ body = "bar", stretch = -0.6, curve = "overshoot" }"#,
            "body `bar`",
            "-0.2000",
        ),
        (
            r#"{ body = "bar", section = "right", stretch = -1.5, along = "fibres" }"#,
            "section `right` of body `bar`",
            "-0.5000",
        ),
        (
            r#"{ body = "bar", stretch = -0.6 }, { body = "bar", thermal_expansion = -1, temperature = 0.5 }"#,
            "body `bar`",
            "-0.1000",
        ),
    ] {
        assert_eq!(told(stated, ""), [gone(of, factor)], "{stated}");
    }
    let second = told(
        r#"{ body = "bar", stretch = -0.6 }"#,
        r#"{ body = "bar", thermal_expansion = -1, temperature = 0.5 }"#,
    );
    assert_eq!(second.len(), 1);
    assert!(second[0].starts_with("step `second` actuates body `bar`: its lengths"));
}

#[test]
fn what_makes_no_sense_is_told_with_its_remedy() {
    for (stated, expected) in [
        (
            r#"{ body = "bar", stretch = 1e7 }"#,
            "step `first` actuates body `bar`: its strain must be a number up to 1e6, but is 10000000",
        ),
        (
            r#"{ body = "bar", stretch = 0.1 }, { body = "bar", section = "right", strain = [0, 0, 0, 0, 0, 0] }"#,
            "step `first` actuates section `right` of body `bar`: this kind of actuation is stated twice; remove one of them",
        ),
        (
            r#"{ body = "bar", section = "left", stretch = 0.1 }"#,
            "body `bar` has no section of element set `left`; it has `right`",
        ),
        (
            r#"{ body = "bar", tension = 1, along = [0, 0, 0] }"#,
            "`along` of an actuation must not be the zero vector",
        ),
        (
            r#"{ body = "bar", strain = [0, 0, 0, 0, 0, 0], axes = [[1, 0, 0], [2, 0, 0]] }"#,
            "the axes of a strain, and the part of the second normal to the first, must not be the zero vector",
        ),
    ] {
        assert_eq!(told(stated, ""), [expected], "{stated}");
    }
    for wrong in [
        r#"{ body = "bar" }"#,
        r#"{ body = "bar", tension = 1 }"#,
        r#"{ body = "bar", stretch = 0.1, temperature = 3 }"#,
        r#"{ body = "bar", stretch = 0.1, along = "fibers" }"#,
        r#"{ body = "bar", stretch = nan }"#,
        r#"{ body = "bar", strain = [0, 0, inf, 0, 0, 0] }"#,
        r#"{ body = "bar", thermal_expansion = 1e-5 }"#,
    ] {
        assert_eq!(told(wrong, "").len(), 1, "{wrong}");
    }
}

#[test]
fn fibres_that_are_not_there_cannot_be_actuated() {
    let deck = read("", "").unwrap_or_else(|faults| panic!("{faults}"));
    let mut model = deck.model;
    let own = Actuation {
        body: striae_model::BodyId(0),
        section: Some(0),
        kind: ActuationKind::FibreStrain(0.1),
        curve: Curve::Ramp,
    };
    model.steps[0].actuations = vec![own];
    let faults = striae_model::Validate::faults(&model);
    assert_eq!(
        faults[0].to_string(),
        "steps[0].actuations[0]: step `first` actuates body `bar`: its material has no fibres; give it `fibres`, or state a direction for `along`"
    );
    let ActuationKind::Strain(mut strain) = ActuationKind::isotropic(0.1) else {
        unreachable!("a strain")
    };
    strain[(0, 1)] = 0.1;
    let unsymmetric = ActuationKind::Strain(strain);
    for (kind, expected) in [
        (ActuationKind::isotropic(f64::NAN), "up to 1e6, but is NaN"),
        (
            ActuationKind::FibreTension(f64::INFINITY),
            "a finite number, but is inf",
        ),
        (unsymmetric, "must be symmetric"),
        (
            ActuationKind::Tension {
                along: Vec3::new(0.0, 0.0, 2.0),
                value: 1.0,
            },
            "must be a unit vector",
        ),
    ] {
        model.steps[0].actuations[0].kind = kind;
        model.steps[0].actuations[0].section = Some(1);
        let faults = striae_model::Validate::faults(&model);
        assert!(faults[0].to_string().contains(expected), "{faults:?}");
    }
    model.steps[0].actuations[0].section = Some(2);
    let faults = striae_model::Validate::faults(&model);
    assert!(faults[0].to_string().contains("there is no section 2"));
}
