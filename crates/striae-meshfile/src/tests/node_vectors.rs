//! Vectors at nodes, and the numbers that files give to nodes.

use super::{assert_explained, block, written};
use crate::{
    NodeVectors, abaqus, gmsh, node_numbers, node_vectors::list, read_node_vectors,
    rigid_node_numbers,
};
use striae_mesh::Vec3;

/// Node data of some nodes.
fn section(name: &str, components: usize, rows: &[&str]) -> String {
    let count = rows.len();
    let rows = rows.join("\n");
    format!(
        "$NodeData\n2\n\"{name}\"\n\"scheme\"\n1\n0.5\n4\n0\n{components}\n{count}\n0\n{rows}\n$EndNodeData\n"
    )
}

const HEADS: [&str; 2] = [
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n",
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
];

fn at(vectors: &NodeVectors, number: u64) -> Vec3 {
    vectors.of_nodes([number]).unwrap()[0]
}

#[test]
fn node_data_are_found_by_name_among_others() {
    for head in HEADS {
        let text = head.to_owned()
            + "$Other\n1\n$EndOther\n"
            + &section("heat", 1, &["7 300"])
            + &section("fibres", 3, &["7 0.5 -1 2e-1", "3 0 0 1"]);
        let vectors = gmsh::node_data(text.as_bytes(), Some("fibres")).unwrap();
        assert_eq!(at(&vectors, 7), Vec3::new(0.5, -1.0, 0.2));
        assert_eq!(at(&vectors, 3), Vec3::z());
        let none = vectors.of_nodes([3, 4]).map(drop);
        assert_explained(none, ["has no vector", "node 4 of the mesh"]);
        let result = |name| gmsh::node_data(text.as_bytes(), name).map(drop);
        assert_explained(result(Some("hair")), ["`hair` once", "`heat`, `fibres`"]);
        assert_explained(result(None), ["the name of one", "`heat`, `fibres`"]);
        assert_explained(
            result(Some("heat")),
            ["line 15: expected 3 components of `heat`", "found 1"],
        );
    }
}

#[test]
fn the_only_node_data_need_no_name() {
    for head in HEADS {
        let text = head.to_owned() + &section("", 3, &["1 1 0 0"]);
        let vectors = gmsh::node_data(text.as_bytes(), None).unwrap();
        assert_eq!(at(&vectors, 1), Vec3::x());
        let none = gmsh::node_data(head.as_bytes(), None).map(drop);
        assert_explained(none, ["expected node data", "there is none"]);
    }
}

#[test]
fn broken_node_data_are_explained() {
    for (section, parts) in [
        (
            section("f", 3, &["1 1 0 0", "1 0 1 0"]),
            ["line 16", "node 1 for the second time"],
        ),
        (
            section("f", 3, &["1 1 0"]),
            ["line 15", "the end of the line"],
        ),
        (section("f", 3, &["1 1 0 up"]), ["line 15", "`up`"]),
        (
            section("f", 3, &["1 1 0 inf"]),
            ["line 15: expected a finite component", "inf at node 1"],
        ),
        (
            "$NodeData\n1\nf\n".to_owned(),
            ["line 6", "quotation marks"],
        ),
        (
            "$NodeData\n0\n0\n2\n0\n3\n".to_owned(),
            ["line 7", "found 2 integers"],
        ),
        (
            "$NodeData\n1\n".to_owned(),
            ["line 5", "the end of the file"],
        ),
        (
            section("f", 3, &["1 1 0 0"]).replace("$EndNodeData\n", ""),
            ["expected $EndNodeData", "the end of the file"],
        ),
    ] {
        let result = gmsh::node_data((HEADS[1].to_owned() + &section).as_bytes(), None).map(drop);
        assert_explained(result, parts);
    }
}

#[test]
fn lists_give_vectors_line_by_line() {
    let vectors = list("node, x, y, z\n4, 1, 2, 3\n\n0,0,-1e2,0\n").unwrap();
    assert_eq!(at(&vectors, 4), Vec3::new(1.0, 2.0, 3.0));
    assert_eq!(at(&vectors, 0), Vec3::new(0.0, -100.0, 0.0));
    for (text, parts) in [
        ("", ["line 0", "node,x,y,z"]),
        ("1,2,3,4\n", ["line 1: expected node,x,y,z", "`1,2,3,4`"]),
        ("node,x,y,z\n1,2,3\n", ["line 2", "three components"]),
        ("node,x,y,z\n-1,2,3,4\n", ["line 2", "a node number"]),
        (
            "node,x,y,z\n1,2,b,4\n",
            ["line 2: expected a component", "`b`"],
        ),
        (
            "node,x,y,z\n1,2,3,4\n2,nan,0,0\n",
            ["line 3: expected a finite component", "NaN at node 2"],
        ),
        (
            "node,x,y,z\n1,2,3,4\n1,2,3,4\n",
            ["line 3", "node 1 for the second time"],
        ),
    ] {
        assert_explained(list(text).map(drop), parts);
    }
}

#[test]
fn numbers_of_nodes_are_those_of_the_file() {
    let mesh = block(striae_mesh::CellKind::Hexahedron);
    let expected: Vec<u64> = (0..mesh.positions.len() as u64)
        .map(|id| 10 * id + 7)
        .collect();
    for text in [written::gmsh2(&mesh), written::gmsh4(&mesh)] {
        let numbers = gmsh::collected(text.as_bytes())
            .unwrap()
            .node_numbers()
            .unwrap();
        assert_eq!(numbers, expected);
    }
    let text = written::abaqus(&mesh);
    let numbers = abaqus::collected(&text, |fault| fault.to_string(), |line| line.to_string())
        .unwrap()
        .node_numbers()
        .unwrap();
    assert_eq!(numbers, expected);
}

#[test]
fn the_ending_chooses_the_reader() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        path
    };
    let csv = write("fibres.csv", "node,x,y,z\n2,0,1,0\n");
    let msh = write(
        "fibres.msh",
        &(HEADS[1].to_owned() + &section("f", 3, &["2 0 1 0"])),
    );
    let vectors = read_node_vectors(&csv, None).unwrap();
    assert_eq!(read_node_vectors(&msh, Some("f")).unwrap(), vectors);
    let error = read_node_vectors(folder.path().join("fibres.dat"), None).unwrap_err();
    assert!(error.to_string().contains(".msh (Gmsh) or .csv"), "{error}");

    let ground = write(
        "ground.msh",
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 9 9 9\n5 0 0 0\n3 1 0 0\n4 1 1 0\n$EndNodes\n$Elements\n1\n2 2 0 4 5 3\n$EndElements\n",
    );
    assert_eq!(rigid_node_numbers(&ground, None).unwrap(), [4, 5, 3]);
    let cube = write(
        "cube.msh",
        &written::gmsh4(&block(striae_mesh::CellKind::Hexahedron)),
    );
    assert_eq!(node_numbers(&cube, None).unwrap()[..3], [7, 17, 27]);
    assert!(
        node_numbers(&csv, None)
            .unwrap_err()
            .to_string()
            .contains(".inp (Abaqus)")
    );
}
