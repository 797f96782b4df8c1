//! Declared generators: each is told in full, and its defaults for programs make a mesh of about
//! the size it expects.

use super::{BLOCK, CAPPED_BLOCK, CYLINDER, GENERATORS, Generate};
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
        (&CAPPED_BLOCK, "cells", "wedges"),
    ] {
        let values = Values::default().with(key, word);
        let generator = declared.made(&values).expect(word);
        let mesh = generator.mesh().expect(word);
        assert_eq!(
            generator.elements(),
            Some(mesh.element_count() as u128),
            "{word}"
        );
    }
}
