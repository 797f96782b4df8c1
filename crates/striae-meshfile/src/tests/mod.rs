//! Meshes written by the tests come back; broken files are explained.

mod abaqus;
mod abaqus_assembly;
mod abaqus_include;
mod abaqus_material;
mod gmsh;
mod gmsh_binary;
mod node_vectors;
mod parts;
mod stl;
mod vtk;
mod written;

use super::{MeshFileFault, read};
use crate as mesh_file;
use proptest::prelude::*;
use striae_mesh::generate::Block;
use striae_mesh::{CellKind, ElementId, Mesh, Vec3};

#[test]
fn meshes_come_back_from_all_formats() {
    for cells in CellKind::ALL {
        let mesh = block(cells);
        for (format, result) in [
            (
                "msh 2",
                mesh_file::gmsh::body(written::gmsh2(&mesh).as_bytes()),
            ),
            (
                "msh 4",
                mesh_file::gmsh::body(written::gmsh4(&mesh).as_bytes()),
            ),
            ("inp", mesh_file::abaqus::body(&written::abaqus(&mesh))),
        ] {
            let back = result.unwrap_or_else(|fault| panic!("{cells}, {format}: {fault}"));
            assert_eq!(back.mesh, mesh, "{cells}, {format}");
        }
    }
}

#[test]
fn the_ending_chooses_the_format() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = block(CellKind::Hexahedron);
    let path = folder.path().join("block.MSH");
    std::fs::write(&path, written::gmsh4(&mesh)).unwrap();
    assert_eq!(read(&path).unwrap(), mesh);
    let path = folder.path().join("block.inp");
    std::fs::write(&path, written::abaqus(&mesh)).unwrap();
    assert_eq!(read(&path).unwrap(), mesh);

    let path = folder.path().join("block.obj");
    let error = read(&path).unwrap_err();
    assert!(matches!(error.fault, MeshFileFault::UnknownEnding { .. }));
    let error = read(folder.path().join("none.inp")).unwrap_err();
    assert!(matches!(error.fault, MeshFileFault::Unreadable(_)));
    assert!(error.to_string().contains("none.inp: cannot be read"));
}

/// A coordinate that is no number is named by the line and the node number of the file.
#[test]
fn coordinates_that_are_not_finite_are_named_as_the_file_names_them() {
    let mut mesh = Block::default().mesh().unwrap();
    // A place that no other line of the files has, at the node that they call 37.
    mesh.positions[3] = Vec3::new(1.0, 1.0, 0.0625);
    for text in [
        written::gmsh2(&mesh),
        written::gmsh4(&mesh),
        written::abaqus(&mesh),
    ] {
        let is_it = |line: &str| line.ends_with("0.0625");
        let line = 1 + text.lines().position(is_it).expect("the node");
        for (one, read) in [("NaN", "NaN"), ("inf", "inf"), ("-1e999", "-inf")] {
            let text = text.replace("0.0625", one);
            let result = match text.starts_with('$') {
                true => mesh_file::gmsh::body(text.as_bytes()),
                false => mesh_file::abaqus::body(&text),
            };
            let found = format!("found node 37 at (1, 1, {read})");
            let expected = format!("line {line}: expected finite coordinates, {found}");
            assert_eq!(result.unwrap_err().to_string(), expected);
        }
    }
}

#[test]
fn byte_order_marks_are_passed_over_in_files_of_all_kinds() {
    let folder = tempfile::tempdir().unwrap();
    let marked = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, ["\u{feff}".as_bytes(), bytes].concat()).unwrap();
        path
    };
    let mesh = block(CellKind::Hexahedron);
    for (name, text) in [
        ("a.msh", written::gmsh2(&mesh)),
        ("a.inp", written::abaqus(&mesh)),
    ] {
        let found = read(marked(name, text.as_bytes())).unwrap();
        assert_eq!(found.element_count(), mesh.element_count(), "{name}");
    }
    let stl = marked("a.stl", &written::stl_ascii(&cube_triangles()));
    let surface = mesh_file::read_rigid_surface(stl).unwrap();
    assert_eq!(surface.facets.len(), 12);
    let csv = marked("a.csv", b"node,x,y,z\n1,1,0,0\n");
    mesh_file::read_node_vectors(csv, None).unwrap();
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
        let _ = mesh_file::stl::rigid_surface(&stl[..(cut * stl.len() as f64) as usize]);
    }
}

/// Every reader on the same text.
fn any(text: &str) -> [bool; 4] {
    [
        mesh_file::gmsh::body(text.as_bytes()).is_ok(),
        mesh_file::gmsh::rigid_surface(text.as_bytes()).is_ok(),
        mesh_file::abaqus::body(text).is_ok(),
        mesh_file::stl::rigid_surface(text.as_bytes()).is_ok(),
    ]
}

fn block(cells: CellKind) -> Mesh {
    let mut mesh = Block {
        divisions: [2, 3, 2],
        irregularity: 0.2,
        cells,
        ..Block::default()
    }
    .mesh()
    .unwrap();
    mesh.element_sets
        .insert("lower half", (0..6).map(ElementId::new));
    mesh
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

fn assert_explained(result: Result<(), MeshFileFault>, parts: [&str; 2]) {
    let message = result.unwrap_err().to_string();
    for part in parts {
        assert!(message.contains(part), "{message} -- lacks: {part}");
    }
}

/// Checks a mesh of cells of higher order, divided, against the linear one it was made of.
fn divided(linear: &Mesh, reading: &crate::Reading) {
    let mesh = &reading.mesh;
    let count = linear.element_count();
    assert_eq!(mesh.element_count(), 8 * count);
    let note = reading.notes.last().unwrap();
    assert!(
        note.ends_with(&format!("into {} linear ones", 8 * count)),
        "{note}"
    );
    assert!((mesh.volume() / linear.volume() - 1.0).abs() < 1e-13);
    assert!(mesh.quality().smallest_scaled_jacobian > 0.1);
    assert_eq!(
        mesh.boundary_faces().len(),
        4 * linear.boundary_faces().len()
    );
    for (name, faces) in linear.facet_sets.iter() {
        let found = mesh.facet_sets.get(name).unwrap();
        assert_eq!(found.len(), 4 * faces.len(), "{name}");
        assert!((mesh.area(found) / linear.area(faces) - 1.0).abs() < 1e-13);
        let sum = |mesh: &Mesh, faces: &[striae_mesh::Face]| {
            faces
                .iter()
                .map(|face| mesh.area_vector(*face))
                .sum::<Vec3>()
        };
        assert!((sum(mesh, found) - sum(linear, faces)).norm() < 1e-13);
    }
    assert_eq!(mesh.element_sets.get("all").unwrap().len(), 8 * count);
}
