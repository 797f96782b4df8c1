//! Meshes written by the tests come back; broken files are explained.

mod written;

use super::{MeshFileFault, abaqus, gmsh, read, read_rigid_surface, stl};
use proptest::prelude::*;
use std::io::Write;
use striae_mesh::generate::Block;
use striae_mesh::{ElementId, Mesh, NodeId, Vec3};

fn block() -> Mesh {
    let mut mesh = Block {
        divisions: [2, 3, 2],
        irregularity: 0.2,
        ..Block::default()
    }
    .mesh()
    .unwrap();
    mesh.element_sets
        .insert("lower half", (0..6).map(ElementId::new));
    mesh
}

#[test]
fn meshes_come_back_from_all_formats() {
    let mesh = block();
    for (format, result) in [
        ("msh 2", gmsh::body(&written::gmsh2(&mesh))),
        ("msh 4", gmsh::body(&written::gmsh4(&mesh))),
        ("inp", abaqus::body(&written::abaqus(&mesh))),
    ] {
        let back = result.unwrap_or_else(|fault| panic!("{format}: {fault}"));
        assert_eq!(back, mesh, "{format}");
    }
}

#[test]
fn the_ending_chooses_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = block();
    let path = folder.path().join("block.MSH");
    std::fs::write(&path, written::gmsh4(&mesh)).unwrap();
    assert_eq!(read(&path).unwrap(), mesh);
    let path = folder.path().join("block.inp");
    std::fs::write(&path, written::abaqus(&mesh)).unwrap();
    assert_eq!(read(&path).unwrap(), mesh);

    let path = folder.path().join("block.vtk");
    let error = read(&path).unwrap_err();
    assert!(matches!(error.fault, MeshFileFault::UnknownEnding { .. }));
    let error = read(folder.path().join("none.inp")).unwrap_err();
    assert!(matches!(error.fault, MeshFileFault::Unreadable(_)));
    assert!(error.to_string().contains("none.inp: cannot be read"));
}

#[test]
fn unused_nodes_are_left_out_also_of_sets() {
    let mesh = block();
    let text = written::abaqus(&mesh)
        + "*NODE, NSET=reference\n99999, 5., 5.D0\n*NSET, NSET=mixed\n99999, 17\n";
    let back = abaqus::body(&text).unwrap();
    assert_eq!(back.positions, mesh.positions);
    assert_eq!(back.node_sets.get("reference"), None);
    assert_eq!(back.node_sets.get("mixed"), Some([NodeId(1)].as_slice()));
}

/// Two cubes side by side along x as an Abaqus file without sets.
const TWO_CUBES: &str = "*HEADING
 two cubes
** a comment
*Part, name=pair
*Node
1, 0., 0., 0.
2, 1., 0., 0.
3, 2., 0., 0.
4, 0., 1.,
5, 1., 1., 0.
6, 2., 1., 0.
11, 0., 0., 1.
12, 1., 0., 1.
13, 2., 0., 1.
14, 0., 1., 1.
15, 1., 1., 1.
16, 2., 1., 1.
*Element, type=C3D8R,
 elset=Both
7, 1, 2, 5, 4, 11, 12,
15, 14
8, 2, 3, 6, 5, 12, 13, 16, 15
*End Part
";

#[test]
fn abaqus_sets_are_resolved() {
    let text = TWO_CUBES.to_owned()
        + "*Assembly, name=all
*Instance, name=pair-1, part=pair
0., 0., 0.
*End Instance
*Node
1, 9., 9., 9.
*Nset, nset=low, generate
1, 6
*Nset, nset=Few, instance=pair-1
pair-1.1, 4
LOW
*Nset, nset=few
16,
*Elset, elset=second
8,
*Nset, nset=corners, elset=second
*Surface, type=ELEMENT, name=Right
second, S4
*Surface, name=Ends
7, S6
BOTH, S2
*End Assembly
*Material, name=rubber
*Hyperelastic, neo hooke
1., 0.1
";
    let mesh = abaqus::body(&text).unwrap();
    let ids = |list: &[u32]| -> Vec<NodeId> { list.iter().map(|&id| NodeId(id)).collect() };
    assert_eq!(
        mesh.node_sets.get("low"),
        Some(ids(&[0, 1, 2, 3, 4, 5]).as_slice())
    );
    assert_eq!(
        mesh.node_sets.get("Few"),
        Some(ids(&[0, 1, 2, 3, 4, 5, 11]).as_slice())
    );
    assert_eq!(mesh.node_sets.get("corners").unwrap().len(), 8);
    assert_eq!(mesh.element_sets.get("Both").unwrap().len(), 2);
    let right = mesh.facet_sets.get("Right").unwrap();
    assert_eq!(right.len(), 1);
    assert_eq!(mesh.area_vector(right[0]), Vec3::x());
    let normals: Vec<Vec3> = mesh
        .facet_sets
        .get("Ends")
        .unwrap()
        .iter()
        .map(|&face| mesh.area_vector(face))
        .collect();
    assert_eq!(normals, [Vec3::z(), -Vec3::x(), Vec3::z()]);
    assert_eq!(mesh.node_sets.get("Right").unwrap().len(), 4);
}

#[test]
fn abaqus_faces_have_their_normals() {
    for (side, normal) in [
        ("S1", -Vec3::z()),
        ("S2", Vec3::z()),
        ("S3", -Vec3::y()),
        ("S5", Vec3::y()),
        ("S6", -Vec3::x()),
    ] {
        let text = format!("{TWO_CUBES}*SURFACE, NAME=one\n7, {side}\n");
        let mesh = abaqus::body(&text).unwrap();
        let faces = mesh.facet_sets.get("one").unwrap();
        assert_eq!(mesh.area_vector(faces[0]), normal, "{side}");
    }
}

#[test]
fn broken_abaqus_files_are_explained() {
    for (text, parts) in [
        ("1, 2\n*NODE\n", ["line 1", "a keyword such as *NODE"]),
        ("*NODE\n1, 0, x, 0\n", ["line 2", "a coordinate"]),
        ("*NODE\n1, 0\n1, 0\n", ["line 3", "has not been used"]),
        ("*ELEMENT, TYPE=C3D4\n", ["line 1", "linear hexahedra"]),
        (
            "*ELEMENT, TYPE=C3D8\n1, 2, 3\n",
            ["line 2", "eight node numbers"],
        ),
        ("*ELEMENT\n", ["line 1", "the parameter TYPE"]),
        (
            "*ELEMENT, TYPE=C3D8\n1,1,2,3,4,5,6,7,8\n",
            ["line 2", "node 1, which the file does not define"],
        ),
        (
            "*NSET, NSET=a, GENERATE\n5, 1\n",
            ["line 2", "first <= last"],
        ),
        ("*NSET, NSET=a\nnone\n", ["line 2", "a set defined before"]),
        ("*NGEN\n", ["line 1", "written out one by one"]),
        ("*NODE, SYSTEM=C\n", ["line 1", "Cartesian"]),
        (
            "*PART, NAME=a\n*PART, NAME=b\n",
            ["line 2", "a file of its own"],
        ),
        (
            "*INSTANCE, NAME=a\n1., 0., 0.\n",
            ["line 2", "move the part"],
        ),
        ("*SURFACE, NAME=a\n1, S7\n", ["line 2", "S1 to S6"]),
        (
            "*NODE\n1, 0, 0, 0\n",
            ["expected 8-node hexahedra", "only they"],
        ),
    ] {
        assert_explained(abaqus::body(text).map(drop), parts);
    }
    let inner = format!("{TWO_CUBES}*SURFACE, NAME=mid\n7, S4\n");
    let parts = [
        "line 25: expected a face on the boundary of the body in set 'mid'",
        "side 4 of element 7",
    ];
    assert_explained(abaqus::body(&inner).map(drop), parts);
    let inverted = TWO_CUBES.replace(
        "8, 2, 3, 6, 5, 12, 13, 16, 15",
        "8, 12, 13, 16, 15, 2, 3, 6, 5",
    );
    let parts = [
        "line 22: expected a positive Jacobian determinant",
        "element 8",
    ];
    assert_explained(abaqus::body(&inverted).map(drop), parts);
    let twice = TWO_CUBES.replace("8, 2, 3", "7, 2, 3");
    assert_explained(
        abaqus::body(&twice).map(drop),
        ["line 22", "element 7 for the second time"],
    );
}

#[test]
fn broken_gmsh_files_are_explained() {
    let two = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
    let four = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    for (text, parts) in [
        ("hello\n".to_owned(), ["line 1", "$MeshFormat"]),
        ("$Nodes\n".to_owned(), ["line 1", "$MeshFormat before all"]),
        (
            "$MeshFormat\n4.1 1 8\n".to_owned(),
            ["line 2", "Mesh.Binary = 0"],
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
            format!("{two}$Elements\n1\n5 4 0 1 2 3 4\n$EndElements\n"),
            [
                "line 6: expected 8-node hexahedra",
                "element type 4 (tetrahedron); recombine",
            ],
        ),
        (
            format!("{two}$Elements\n1\n5 92 0 1\n"),
            ["line 6", "element type 92"],
        ),
        (
            format!("{two}$Elements\n1\n5 2 1 4 1 2 3\n$EndElements\n"),
            ["line 6", "(triangle)"],
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
            ["element type 17", "Mesh.ElementOrder = 1"],
        ),
    ] {
        assert_explained(gmsh::body(&text).map(drop), parts);
    }
    let nothing = gmsh::rigid_surface(two).map(drop);
    assert_explained(nothing, ["triangles or quadrangles", "mesh the surfaces"]);
}

fn assert_explained(result: Result<(), MeshFileFault>, parts: [&str; 2]) {
    let message = result.unwrap_err().to_string();
    for part in parts {
        assert!(message.contains(part), "{message} -- lacks: {part}");
    }
}

#[test]
fn gmsh_points_make_node_sets_and_groups_without_names_numbers() {
    let text = written::gmsh2(&block())
        .replace("1 \"tip\"", "9 \"other\"")
        .replace("3 99 \"lower half\"\n", "3 98 \"unused\"\n");
    let mesh = gmsh::body(&text).unwrap();
    assert_eq!(mesh.element_sets.get("99").unwrap().len(), 6);
    assert_eq!(mesh.element_sets.get("lower half"), None);
}

/// The surface of a unit cube, two triangles a side.
fn cube_triangles() -> Vec<[Vec3; 3]> {
    let mesh = Block::default().mesh().unwrap();
    let faces = mesh.boundary_faces().into_iter();
    faces
        .flat_map(|face| {
            let [a, b, c, d] = mesh.face_positions(face);
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn volume(surface: &super::RigidSurfaceMesh) -> f64 {
    let facets = surface.facets.iter();
    facets
        .map(|facet| {
            let [a, b, c, d] = facet.map(|node| surface.positions[node.index()]);
            (a.dot(&b.cross(&c)) + a.dot(&c.cross(&d))) / 6.0
        })
        .sum()
}

#[test]
fn stl_triangles_share_their_corners() {
    let mut triangles = cube_triangles();
    triangles.push([Vec3::zeros(), Vec3::zeros(), Vec3::x()]);
    for bytes in [
        written::stl_ascii(&triangles),
        written::stl_binary(&triangles),
    ] {
        let surface = stl::rigid_surface(&bytes).unwrap();
        assert_eq!((surface.positions.len(), surface.facets.len()), (8, 12));
        assert!(surface.facets.iter().all(|facet| facet[2] == facet[3]));
        assert!((volume(&surface) - 1.0).abs() < 1e-12);
    }
}

#[test]
fn broken_stl_files_are_explained() {
    let mut short = written::stl_binary(&cube_triangles());
    short.pop();
    assert_explained(
        stl::rigid_surface(&short).map(drop),
        ["announces 684 bytes", "has 683"],
    );
    assert_explained(stl::rigid_surface(b"abc").map(drop), ["84", "has 3"]);
    let text = b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n";
    assert_explained(
        stl::rigid_surface(text).map(drop),
        ["line 4", "a coordinate"],
    );
    let text = b"solid a\nendsolid a\n";
    assert_explained(stl::rigid_surface(text).map(drop), ["triangles", "export"]);
}

#[test]
fn rigid_surfaces_come_from_gmsh_with_triangles_and_quadrangles() {
    let text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 9 9 9\n2 0 0 0\n3 1 0 0\n4 1 1 0\n5 0 1 0\n6 2 0 0\n$EndNodes\n$Elements\n4\n1 15 2 1 1 1\n2 3 2 7 1 2 3 4 5\n3 3 2 8 1 2 3 4 5\n4 2 0 3 6 4\n$EndElements\n";
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ground.msh");
    std::fs::File::create(&path)
        .unwrap()
        .write_all(text.as_bytes())
        .unwrap();
    let surface = read_rigid_surface(&path).unwrap();
    assert_eq!(
        surface.facets,
        [[0, 1, 2, 3].map(NodeId), [1, 4, 2, 2].map(NodeId)]
    );
    assert_eq!(surface.positions[4], Vec3::new(2.0, 0.0, 0.0));
    assert_eq!(surface.positions.len(), 5);
    assert!(read_rigid_surface(folder.path().join("ground.obj")).is_err());
}

proptest! {
    #[test]
    fn damaged_files_never_panic(cut in 0.0..1.0f64, at in 0.0..1.0f64, byte in 32..127u8) {
        let mesh = Block::default().mesh().unwrap();
        for text in [written::gmsh2(&mesh), written::gmsh4(&mesh), written::abaqus(&mesh)] {
            let mut bytes = text.into_bytes();
            let end = bytes.len();
            let _ = any(&String::from_utf8_lossy(&bytes[..(cut * end as f64) as usize]));
            bytes[(at * end as f64) as usize] = byte;
            let _ = any(&String::from_utf8_lossy(&bytes));
        }
        let stl = written::stl_binary(&cube_triangles());
        let _ = stl::rigid_surface(&stl[..(cut * stl.len() as f64) as usize]);
    }
}

/// Every reader on the same text.
fn any(text: &str) -> [bool; 4] {
    [
        gmsh::body(text).is_ok(),
        gmsh::rigid_surface(text).is_ok(),
        abaqus::body(text).is_ok(),
        stl::rigid_surface(text.as_bytes()).is_ok(),
    ]
}
