//! Declared generators: each is told in full, and its defaults for programs make a mesh of about
//! the size it expects.

use super::{ANNULUS, BLOCK, CAPPED_BLOCK, CYLINDER, GENERATORS, Generate, HALF_CYLINDER};
use striae_declared::{Form, Parameter, Values};

fn are_told(parameters: &[Parameter]) {
    for parameter in parameters {
        let has_unit = match parameter.form {
            Form::Number(_) | Form::Numbers(_) | Form::Several(..) => true,
            Form::Table(set) | Form::Tables(set) => {
                assert!(set.doc.ends_with('.'), "{}", set.doc);
                are_told(set.parameters);
                false
            }
            Form::OneOf(sets) => {
                sets.iter().for_each(|set| are_told(set.parameters));
                continue;
            }
            _ => false,
        };
        assert!(parameter.doc.ends_with('.'), "{}", parameter.doc);
        assert_eq!(parameter.unit.is_empty(), !has_unit, "{}", parameter.name);
    }
}

#[test]
fn each_is_told_and_makes_a_mesh_of_its_defaults() {
    for declared in GENERATORS {
        let names = GENERATORS
            .iter()
            .filter(|other| other.name == declared.name);
        assert_eq!(names.count(), 1, "{}", declared.name);
        assert!(declared.summary.ends_with('.'), "{}", declared.summary);
        are_told(declared.parameters);
        let generator = declared.made(&Values::default()).expect(declared.name);
        let mesh = generator.mesh().expect(declared.name);
        assert_eq!(
            generator.elements(),
            Some(mesh.element_count() as u128),
            "{}",
            declared.name
        );
        let nodes = generator.nodes().expect(declared.name) as f64;
        let ratio = nodes / mesh.positions.len() as f64;
        assert!(ratio > 0.5 && ratio < 1.2, "{}: {ratio}", declared.name);
    }
}

#[test]
fn elements_of_quarters_and_of_divided_hexahedra_are_counted() {
    for (declared, key, word) in [
        (&CYLINDER, "part", "quarter"),
        (&BLOCK, "cells", "pyramids"),
        (&BLOCK, "cells", "composite-tetrahedra"),
        (&CAPPED_BLOCK, "cells", "wedges"),
        (&CAPPED_BLOCK, "cells", "composite-tetrahedra"),
    ] {
        let values = Values::default().with(key, word);
        let generator = declared.made(&values).expect(word);
        let mesh = generator.mesh().expect(word);
        assert_eq!(
            generator.elements(),
            Some(mesh.element_count() as u128),
            "{word}"
        );
        let nodes = generator.nodes().expect(word) as f64;
        let ratio = nodes / mesh.positions.len() as f64;
        assert!(ratio > 0.3 && ratio < 1.2, "{word}: {ratio}");
    }
}

#[test]
fn the_parameter_that_turns_elements_inside_out_is_named() {
    let ratio = Values::default().with("one_sided", 1e300);
    let gradings = Values::default().with("x", ratio);
    let refinement = Values::from([("half_angle", 10.0), ("ratio", 1e300)]);
    let lattice = Values::default().with("divisions", &[4, 4, 2][..]);
    for (declared, parameter, values) in [
        (
            &BLOCK,
            "mesh_rotation",
            lattice.clone().with("mesh_rotation", 1e308),
        ),
        (&BLOCK, "grading", lattice.with("grading", gradings)),
        (
            &ANNULUS,
            "refinement",
            Values::default().with("refinement", refinement),
        ),
        (&HALF_CYLINDER, "growth", Values::from([("growth", 1e300)])),
    ] {
        let refused = declared.made(&values).expect(parameter).mesh();
        let refused = refused.expect_err(parameter).to_string();
        let blamed = format!("none without `{parameter}`; make it more moderate");
        assert!(refused.contains(&blamed), "{refused}");
    }
}

#[test]
fn lengths_are_refused_where_volumes_are_no_numbers() {
    for (length, admitted) in [(1e300, false), (1e-200, false), (1e90, true), (1e-90, true)] {
        let values = Values::default().with("size", &[length; 3][..]);
        let made = BLOCK.made(&values).expect("a block").mesh();
        assert_eq!(made.is_ok(), admitted, "{length}");
    }
    let far = Values::default().with("origin", [1e300, 0.0, 0.0]);
    let refused = BLOCK.made(&far).expect("a block").mesh().expect_err("far");
    let expected = "origin is 1e300, but it must be at most 1e100 in magnitude";
    assert_eq!(refused.to_string(), expected);
}
