//! Gmsh files, whole and broken.

use super::{assert_explained, block, divided, written};
use crate::{
    MeshFileFault,
    gmsh::{self, rigid_surface},
    read_rigid_surface,
};
use striae_mesh::{CellKind, Mesh, NodeId, Vec3};

fn body(text: &str) -> Result<Mesh, MeshFileFault> {
    gmsh::body(text.as_bytes()).map(|reading| reading.mesh)
}

/// A cube of node 1 to 8 with the given elements and names, version 2.
fn cube(names: &str, elements: &[&str]) -> String {
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n{names}$Nodes\n8\n\
         1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n8 0 1 1\n\
         $EndNodes\n$Elements\n{}\n",
        elements.len()
    );
    for element in elements {
        text = text + element + "\n";
    }
    text + "$EndElements\n"
}

#[test]
fn points_and_curves_make_node_sets() {
    let names = "$PhysicalNames\n2\n0 4 \"tip\"\n1 4 \"edge of it\"\n$EndPhysicalNames\n";
    let cells = ["1 15 2 4 1 7", "2 1 2 4 1 3 7", "3 5 2 4 1 1 2 3 4 5 6 7 8"];
    let mesh = body(&cube(names, &cells)).unwrap();
    assert_eq!(mesh.node_sets.get("tip"), Some([NodeId(6)].as_slice()));
    let edge = [NodeId(2), NodeId(6)];
    assert_eq!(mesh.node_sets.get("edge of it"), Some(edge.as_slice()));
    let names: Vec<&str> = mesh.element_sets.names().collect();
    assert_eq!(names, ["4", "all"], "a group without a name has its number");
}

#[test]
fn quadrangles_of_no_group_and_in_any_order_are_fine() {
    let cells = [
        "1 3 0 1 2 3 4",
        "2 3 2 9 1 8 7 6 5",
        "3 5 0 1 2 3 4 5 6 7 8",
    ];
    let mesh = body(&cube("", &cells)).unwrap();
    let top = mesh.facet_sets.get("9").unwrap();
    assert_eq!(mesh.area_vector(top[0]), Vec3::z());
    assert_eq!(mesh.facet_sets.names().count(), 1);
    let stray = ["2 3 2 9 1 1 2 7 8", "3 5 0 1 2 3 4 5 6 7 8"];
    let reading = gmsh::body(cube("", &stray).as_bytes()).unwrap();
    assert_eq!(
        reading.notes,
        ["facet set `9`: 1 of 1 facets are not on the boundary of the body and are left out",]
    );
    assert_eq!(reading.mesh.facet_sets.get("9"), None);
    assert_eq!(reading.mesh.node_sets.get("9").unwrap().len(), 4);
}

/// Two cubes as two volumes with the surface between them, outer faces, a line and a point.
#[test]
fn surfaces_between_volumes_and_lines_are_no_fault() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n3 1 \"core\"\n\
        3 2 \"shell\"\n2 3 \"between\"\n1 4 \"axis\"\n$EndPhysicalNames\n$Nodes\n14\n\
        1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n6 2 1 0\n\
        7 0 0 1\n8 1 0 1\n9 2 0 1\n10 0 1 1\n11 1 1 1\n12 2 1 1\n13 5 5 5\n14 6 5 5\n\
        $EndNodes\n$Elements\n9\n\
        1 5 2 1 1 1 2 5 4 7 8 11 10\n2 5 2 2 2 2 3 6 5 8 9 12 11\n\
        3 3 2 3 3 2 5 11 8\n4 3 2 3 3 1 4 10 7\n5 1 2 4 4 13 14\n\
        6 3 0 3 6 12 9\n7 1 0 1 2\n8 1 0 2 3\n9 15 0 1\n$EndElements\n";
    let reading = gmsh::body(text.as_bytes()).unwrap();
    let mesh = &reading.mesh;
    let names: Vec<&str> = mesh.element_sets.names().collect();
    assert_eq!(names, ["all", "core", "shell"]);
    let between = mesh.facet_sets.get("between").unwrap();
    assert_eq!(between.len(), 1);
    assert_eq!(mesh.area_vector(between[0]), -Vec3::x());
    assert_eq!(mesh.node_sets.get("between").unwrap().len(), 8);
    assert_eq!(
        reading.notes,
        [
            "facet set `between`: 1 of 2 facets are not on the boundary of the body and are \
             left out",
            "node set `axis` has no node of the body and is left out",
            "in no set and left out: 1 surface element, 2 lines and 1 point",
        ]
    );
}

#[test]
fn elements_of_several_kinds_make_a_block_each() {
    // A cube cut along a diagonal into a wedge, and a tetrahedron and a pyramid beside it.
    let cells = [
        "1 6 2 1 1 1 2 4 5 6 8",
        "2 4 2 1 1 2 3 4 7",
        "3 7 2 1 1 2 4 8 6 7",
        "4 2 2 8 1 5 6 8",
        "5 3 2 9 1 1 2 6 5",
    ];
    let mesh = body(&cube("", &cells)).unwrap();
    let kinds: Vec<CellKind> = mesh.blocks.iter().map(|block| block.kind).collect();
    assert_eq!(
        kinds,
        [CellKind::Tetrahedron, CellKind::Pyramid, CellKind::Wedge]
    );
    assert!((mesh.volume() - 1.0).abs() < 1e-15);
    assert_eq!(mesh.boundary_faces().len(), 10);
    let area = |set| mesh.area_vector(mesh.facet_sets.get(set).unwrap()[0]);
    assert_eq!([area("8"), area("9")], [Vec3::z() * 0.5, -Vec3::y()]);
}

#[test]
fn broken_gmsh_files_are_explained() {
    let two = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    let four = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    for (text, parts) in [
        ("hello\n".to_owned(), ["line 1", "$MeshFormat"]),
        ("$Nodes\n".to_owned(), ["line 1", "$MeshFormat before all"]),
        (
            "$MeshFormat\n4.1 2 8\n".to_owned(),
            ["line 2", "file type 0 (ASCII) or 1 (binary)"],
        ),
        (
            "$MeshFormat\n4 0 8\n".to_owned(),
            ["line 2", "Mesh.MshFileVersion = 4.1"],
        ),
        (
            "$MeshFormat\n2.2 0 8\n$Nodes\n".to_owned(),
            ["line 3: expected $EndMeshFormat", "`$Nodes`"],
        ),
        (
            format!("{two}$Nodes\n2\n1 0 0 0\n"),
            ["line 6", "the end of the file"],
        ),
        (
            format!("{two}$Nodes\n1\n1 0 zero 0\n"),
            ["line 6", "found `zero`"],
        ),
        (
            format!("{two}$Elements\n1\n5 14 0 1 2 3 4 5 6 7 8 9 10 11 12 13 14\n$EndElements\n"),
            [
                "line 6: expected tetrahedra, prisms, hexahedra",
                "element type 14 (14-node pyramid); mesh with",
            ],
        ),
        (
            format!("{two}$Elements\n1\n5 92 0 1\n"),
            ["line 6", "element type 92"],
        ),
        (
            format!("{two}$Elements\n1\n5 19 0 1 2 3 4 5 6 7 8 9 10 11 12 13\n$EndElements\n"),
            ["line 6", "(13-node pyramid)"],
        ),
        (
            format!("{two}$Elements\n1\n5 5 0 1 2 3\n"),
            ["line 6", "the end of the line"],
        ),
        (
            format!("{two}$PhysicalNames\n1\n2 1 top\n"),
            ["line 6", "quotation marks"],
        ),
        (
            format!("{two}$Periodic\n0\n"),
            ["$EndPeriodic", "the end of the file"],
        ),
        (
            format!("{four}$Nodes\n1 1 1 1\n3 1 0\n"),
            ["line 6", "the head of a block"],
        ),
        (
            format!(
                "{four}$Elements\n1 1 1 1\n3 1 17 1\n1 {}\n$EndElements\n",
                "1 ".repeat(20)
            ),
            ["node 1, which the file does not define", "line 7"],
        ),
    ] {
        assert_explained(body(&text).map(drop), parts);
    }
    let nothing = rigid_surface(two.as_bytes()).map(drop);
    assert_explained(nothing, ["triangles or quadrangles", "mesh the surfaces"]);
}

#[test]
fn rigid_surfaces_come_from_gmsh_with_triangles_and_quadrangles() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 9 9 9\n2 0 0 0\n3 1 0 0\n4 1 1 0\n5 0 1 0\n6 2 0 0\n$EndNodes\n$Elements\n4\n1 15 2 1 1 1\n2 3 2 7 1 2 3 4 5\n3 3 2 8 1 2 3 4 5\n4 2 0 3 6 4\n$EndElements\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ground.msh");
    std::fs::write(&path, text).unwrap();
    let surface = read_rigid_surface(&path).unwrap();
    assert_eq!(
        surface.facets,
        [[0, 1, 2, 3].map(NodeId), [1, 4, 2, 2].map(NodeId)]
    );
    assert_eq!(surface.positions[4], Vec3::new(2.0, 0.0, 0.0));
    assert_eq!(surface.positions.len(), 5);
    assert!(read_rigid_surface(folder.path().join("ground.obj")).is_err());
}

#[test]
fn cells_of_higher_order_are_divided() {
    // Gmsh's own order of the edges and faces.
    let edges_8 = [
        [0, 1],
        [0, 3],
        [0, 4],
        [1, 2],
        [1, 5],
        [2, 3],
        [2, 6],
        [3, 7],
        [4, 5],
        [4, 7],
        [5, 6],
        [6, 7],
    ];
    let faces_8 = [
        [0, 3, 2, 1],
        [0, 1, 5, 4],
        [0, 4, 7, 3],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [4, 5, 6, 7],
    ];
    let edges_6 = [
        [0, 1],
        [0, 2],
        [0, 3],
        [1, 2],
        [1, 4],
        [2, 5],
        [3, 4],
        [3, 5],
        [4, 5],
    ];
    let faces_6 = [[0, 1, 4, 3], [0, 3, 5, 2], [1, 2, 5, 4]];
    for (cells, types, edges, faces) in [
        (CellKind::Hexahedron, [17, 12], &edges_8[..], &faces_8[..]),
        (CellKind::Wedge, [18, 13], &edges_6[..], &faces_6[..]),
    ] {
        let linear = block(cells);
        for (kind, full) in types.into_iter().zip([false, true]) {
            let whole = written::Whole::new(&linear, edges, faces, full);
            let reading = gmsh::body(whole.gmsh(kind).as_bytes()).unwrap();
            divided(&linear, &reading);
        }
    }
}
