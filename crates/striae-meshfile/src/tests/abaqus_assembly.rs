//! Abaqus files with parts that are placed several times.

use super::assert_explained;
use crate::{MeshFileFault, Reading, abaqus};
use striae_mesh::{ElementId, Mesh, NodeId, Vec3};

/// A block of 2 x 1 x 1 cubes.
const PART: &str = "*Part, name=Block
*Node, nset=every
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
4, 0., 1., 0.
5, 1., 1., 0.
6, 2., 1., 0.
11, 0., 0., 1.
12, 1., 0., 1.
13, 2., 0., 1.
14, 0., 1., 1.
15, 1., 1., 1.
16, 2., 1., 1.
*Element, type=C3D8, elset=cubes
7, 1, 2, 5, 4, 11, 12, 15, 14
8, 2, 3, 6, 5, 12, 13, 16, 15
*Element, type=S4, elset=Skin
9, 1, 4, 14, 11
*Elset, elset=right
8,
*Surface, name=End
right, S4
*End Part
";

fn assembled(instances: &str, sets: &str) -> Result<Reading, MeshFileFault> {
    let text = format!("{PART}*Assembly, name=all\n{instances}{sets}*End Assembly\n");
    abaqus::body(&text)
}

const TWO: &str = "*Instance, name=low, part=BLOCK
*End Instance
*Instance, name=up, part=Block
0., 0., 5.
0., 0., 5., 0., 0., 9., 90.
*End Instance
";

/// The middle of the facets of a set.
fn middle(mesh: &Mesh, set: &str) -> Vec3 {
    let nodes = mesh.nodes_of_faces(mesh.facet_sets.get(set).unwrap());
    let sum: Vec3 = nodes.iter().map(|node| mesh.positions[node.index()]).sum();
    sum / nodes.len() as f64
}

#[test]
fn instances_are_moved_then_turned() {
    let mesh = assembled(TWO, "").unwrap().mesh;
    assert_eq!((mesh.positions.len(), mesh.element_count()), (24, 4));
    assert!((mesh.volume() - 4.0).abs() < 1e-14);
    for (place, straight) in mesh.positions[12..].iter().zip(&mesh.positions) {
        let turned = Vec3::new(-straight.y, straight.x, straight.z + 5.0);
        assert!((place - turned).norm() < 1e-15);
    }
    // A third of a turn about the diagonal permutes the axes, about a point that stays.
    let diagonal = "*Instance, name=one, part=Block\n1., 2., 3.\n1., 1., 1., 2., 2., 2., 120.\n*End Instance\n";
    let mesh = assembled(diagonal, "").unwrap().mesh;
    let straight = assembled(TWO, "").unwrap().mesh.positions;
    for (place, x) in mesh.positions.iter().zip(&straight) {
        let moved = x + Vec3::new(1.0, 2.0, 3.0);
        let turned = Vec3::new(moved.z, moved.x, moved.y);
        assert!((place - turned).norm() < 1e-14, "{place} {turned}");
    }
}

#[test]
fn sets_of_several_instances_have_their_names() {
    let sets = "*Node
1, 9., 9., 9.
*Element, type=CONN3D2, elset=links
1, 1, 1
*Nset, nset=reference
1,
*Nset, nset=few, instance=up
1, 16
*Nset, nset=both
low.3, UP.every
*Nset, nset=of-low, elset=low.right
*Elset, elset=ends
low.right, up.7
*Elset, elset=generated, instance=up, generate
7, 8
*Surface, name=Sides
low.right, S4
up.7, S6
";
    let reading = assembled(TWO, sets).unwrap();
    let mesh = &reading.mesh;
    let names: Vec<&str> = mesh.element_sets.names().collect();
    assert_eq!(
        names,
        [
            "all",
            "ends",
            "generated",
            "low",
            "low.cubes",
            "low.right",
            "up",
            "up.cubes",
            "up.right"
        ]
    );
    let elements = |set: &str| -> Vec<u32> {
        let members = mesh.element_sets.get(set).unwrap().iter();
        members.map(|element| element.0).collect()
    };
    assert_eq!(elements("ends"), [1, 2]);
    assert_eq!(elements("up"), [2, 3]);
    assert_eq!(elements("generated"), [2, 3]);
    let count = |set: &str| mesh.node_sets.get(set).unwrap().len();
    assert_eq!(["few", "both", "of-low", "up"].map(count), [2, 13, 8, 12]);
    assert_eq!(mesh.node_sets.get("reference"), None);
    let facets: Vec<&str> = mesh.facet_sets.names().collect();
    assert_eq!(
        facets,
        ["Sides", "low.End", "low.Skin", "up.End", "up.Skin"]
    );
    let away = middle(mesh, "up.End") - Vec3::new(-0.5, 2.0, 5.5);
    assert!(away.norm() < 1e-14, "{away}");
    assert_eq!(mesh.facet_sets.get("Sides").unwrap().len(), 2);
    assert_eq!(reading.numbers.element(ElementId(3)), "up.8");
    assert_eq!(reading.numbers.node(NodeId(6)), "low.11");
    assert_eq!(
        reading.notes,
        [
            "elements of type CONN3D2 of the assembly are ignored",
            "node set `reference` has no node of the body and is left out",
        ]
    );
}

#[test]
fn a_single_instance_keeps_its_numbers_and_labels() {
    let one = "*Instance, name=one, part=Block\n1., 0., 0.\n*End Instance\n";
    let reading = assembled(one, "*Nset, nset=few, instance=one\n1, one.6\n").unwrap();
    let names: Vec<&str> = reading.mesh.element_sets.names().collect();
    assert_eq!(names, ["all", "cubes", "right"]);
    assert_eq!(reading.mesh.node_sets.get("few").unwrap().len(), 2);
    assert_eq!(middle(&reading.mesh, "End"), Vec3::new(3.0, 0.5, 0.5));
    assert_eq!(reading.numbers.element(ElementId(1)), "8");
    // Nodes may also stand in the instance, and parts without one are left out.
    let text = PART.to_owned()
        + "*Part, name=Empty\n*End Part\n*Assembly, name=all\n*Instance, name=a, part=Empty\n0, 0, 1\n"
        + &PART
            .lines()
            .skip(1)
            .collect::<Vec<_>>()
            .join("\n")
            .replace("*End Part", "")
        + "\n*End Instance\n*End Assembly\n";
    let reading = abaqus::body(&text).unwrap();
    assert_eq!(middle(&reading.mesh, "End"), Vec3::new(2.0, 0.5, 1.5));
    assert_eq!(
        reading.notes,
        ["part `Block` has no instance and is left out"]
    );
}

#[test]
fn broken_assemblies_are_explained() {
    for (instances, sets, parts) in [
        (
            "*Instance, name=a, part=Blok\n*End Instance\n",
            "",
            ["line 26", "an instance of a part defined before"],
        ),
        (
            "*Instance, name=a, part=Block\n1., x\n*End Instance\n",
            "",
            ["line 27", "a translation of three numbers"],
        ),
        (
            "*Instance, name=a, part=Block\n0., 0., 0.\n0., 0., 0., 1., 0., 0., 1., 2.\n",
            "",
            ["line 28", "two points of an axis and an angle"],
        ),
        (
            "*Instance, name=a, part=Block\n0., 0., 0.\n1., 1., 1., 1., 1., 1., 90.\n",
            "",
            ["line 28", "two different points of an axis"],
        ),
        (
            "*Instance, name=a, part=Block\n*End Instance\n*Instance, name=A, part=Block\n",
            "",
            ["line 28", "a name that no other instance has"],
        ),
        (
            TWO,
            "*Nset, nset=x\n3\n",
            [
                "line 33",
                "a number with the name of its instance, found `3`",
            ],
        ),
        (
            TWO,
            "*Nset, nset=x, instance=middle\n3\n",
            ["line 32", "an instance defined before"],
        ),
        (
            TWO,
            "*Nset, nset=x, instance=up\n3, 77\n",
            ["line 33", "node up.77, which the file does not define"],
        ),
        (
            TWO,
            "*Surface, name=x\nup.77, S1\n",
            ["line 33", "element up.77, which the file does not define"],
        ),
        (
            TWO,
            "*Element, type=C3D8\n1, 1, 2, 3, 4, 5, 6, 7, 8\n",
            ["line 32", "solid elements in a part"],
        ),
    ] {
        assert_explained(assembled(instances, sets).map(drop), parts);
    }
    let inverted = PART.replace(
        "8, 2, 3, 6, 5, 12, 13, 16, 15",
        "8, 12, 13, 16, 15, 2, 3, 6, 5",
    );
    let text = format!("{inverted}*Assembly, name=all\n{TWO}*End Assembly\n");
    assert_explained(
        abaqus::body(&text).map(drop),
        [
            "line 17: expected a positive Jacobian determinant",
            "element low.8 with",
        ],
    );
}

#[test]
fn numbers_of_several_instances_are_bounded_wherever_they_are() {
    for (known, large) in [
        ("right, S4", "18446744073709551615, S4"),
        ("8,\n", "18446744073709551615,\n"),
        ("9, 1, 4, 14, 11", "9, 18446744073709551615, 4, 14, 11"),
    ] {
        let part = PART.replace(known, large);
        assert_ne!(part, PART);
        let text = format!("{part}*Assembly, name=all\n{TWO}*End Assembly\n");
        let refused = abaqus::body(&text).map(drop);
        assert_explained(
            refused,
            ["numbers below 1099511627776", "*Instance, name=low"],
        );
    }
}
