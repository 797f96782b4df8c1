//! Springs and dashpots.

use super::{STEP, assert_listed, converted, model};
use striae_mesh::Vec3;
use striae_model::{Spring, SpringEnd, SpringLine};

/// Springs by these keywords of the assembly.
fn springs(keywords: &str) -> (Vec<String>, Vec<Spring>) {
    let (_, listed, deck) = converted(&model(keywords, STEP));
    (listed, deck.model.springs)
}

#[test]
fn springs_to_ground_are_along_coordinates() {
    let keywords = "*ELEMENT, TYPE=SPRING1, ELSET=S\n1, Pad-1.5\n2, Pad-1.6
*SPRING, ELSET=S\n3,\n100.,\n*ELEMENT, TYPE=DASHPOT1, ELSET=D\n3, Pad-1.7\n*DASHPOT, ELSET=D\n1,\n0.5\n";
    let (listed, springs) = springs(keywords);
    assert_listed(&listed, &[]);
    let [spring, dashpot] = &springs[..] else {
        panic!("{springs:?}");
    };
    assert_eq!((spring.stiffness, spring.damping), (100.0, 0.0));
    assert!(matches!(spring.line, SpringLine::Along(direction) if direction == Vec3::z()));
    assert!(matches!(&spring.a, SpringEnd::Nodes { nodes, .. } if nodes.len() == 2));
    assert_eq!((dashpot.stiffness, dashpot.damping), (0.0, 0.5));
    assert!(matches!(dashpot.line, SpringLine::Along(direction) if direction == Vec3::x()));
}

#[test]
fn two_springs_of_one_node_add() {
    let keywords =
        "*ELEMENT, TYPE=SPRING1, ELSET=S\n1, Pad-1.5\n2, Pad-1.5\n*SPRING, ELSET=S\n3,\n100.,\n";
    let (listed, springs) = springs(keywords);
    assert_listed(&listed, &[]);
    assert_eq!(springs.len(), 2);
}

#[test]
fn axial_springs_join_nodes() {
    let keywords =
        "*ELEMENT, TYPE=SPRINGA, ELSET=S\n1, Base-1.1, Pad-1.7\n*SPRING, ELSET=S\n\n100.,\n";
    let (listed, springs) = springs(keywords);
    assert_listed(&listed, &[]);
    assert_eq!(springs.len(), 1);
    assert!(matches!(springs[0].line, SpringLine::To(_)));
}

#[test]
fn springs_without_a_counterpart_are_listed() {
    for (kind, ends, more, rows, said) in [
        (
            "2",
            "Base-1.5, Pad-1.1",
            "",
            "1, 1\n100.",
            "*SPRING of SPRING2: a spring between two",
        ),
        ("1", "Pad-1.5", "", "4\n100.", "*SPRING of rotations"),
        (
            "1",
            "Pad-1.5",
            ", NONLINEAR",
            "1\n0., 0.\n1., 1.",
            "*SPRING with NONLINEAR: state a",
        ),
        (
            "1",
            "Pad-1.5",
            "",
            "1\n-1.",
            "*SPRING other than of one constant of at least 0",
        ),
        (
            "A",
            "Base-1.5, Pad-1.1",
            "",
            "100.",
            "spring element 1: both ends are at one place",
        ),
        (
            "A",
            "Base-1.5, 1",
            "",
            "100.",
            "spring element 1: node `1` is of no body",
        ),
    ] {
        let keywords = format!(
            "*ELEMENT, TYPE=SPRING{kind}, ELSET=S\n1, {ends}\n*SPRING, ELSET=S{more}\n{rows}\n"
        );
        let (listed, springs) = springs(&keywords);
        let told = listed.iter().any(|line| line.contains(said));
        assert!(told && springs.is_empty(), "{listed:?}");
    }
}
