//! Abaqus files that include others.

use super::{block, written};
use crate::{node_numbers, read, read_with_notes};
use striae_mesh::CellKind;

/// Writes files and reads the first; the message without the folder where it fails.
fn outcome(files: &[(&str, &str)]) -> Result<usize, String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    }
    let mesh = read(folder.path().join(files[0].0));
    let shown = |error: crate::MeshFileError| {
        let folder = format!("{}/", folder.path().display());
        error.to_string().replace(&folder, "")
    };
    mesh.map(|mesh| mesh.element_count()).map_err(shown)
}

#[test]
fn included_files_stand_in_their_places() {
    let mesh = block(CellKind::Hexahedron);
    let text = written::abaqus(&mesh);
    let lines: Vec<&str> = text.lines().collect();
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, text).unwrap();
    };
    // Cut within the rows of a keyword, and a file in a folder that includes one beside it.
    let (head, rest) = lines.split_at(5);
    let (middle, tail) = rest.split_at(4);
    write(
        "whole.inp",
        format!("{}\n*INCLUDE, INPUT=parts/rest.inp\n", head.join("\n")),
    );
    write(
        "parts/rest.inp",
        format!(
            "{}\n*Include,\n input = \"tail.txt\"\n** the end",
            middle.join("\n")
        ),
    );
    write("parts/tail.txt", tail.join("\n"));
    let path = folder.path().join("whole.inp");
    assert_eq!(read_with_notes(&path).unwrap().mesh, mesh);
    assert_eq!(
        node_numbers(&path, None).unwrap().len(),
        mesh.positions.len()
    );
}

#[test]
fn faults_name_the_file_they_are_in_and_its_line() {
    let main = "** a comment\n*NODE\n1, 0, 0, 0\n*INCLUDE, INPUT=more.inp\n*NSET, NSET=a\nnone\n";
    for (more, expected) in [
        (
            "2, 1, 0, 0\n3, x\n",
            "more.inp: line 2: expected a coordinate, found `3, x`",
        ),
        (
            "2, 1, 0, 0\n",
            "main.inp: line 6: expected a number or a set defined before, found `none`",
        ),
        (
            "*INCLUDE, INPUT=main.inp\n",
            "more.inp: line 1: expected a file that does not include this one again, found `main.inp`, which includes this file",
        ),
        (
            "\n*INCLUDE, INPUT=more.inp\n",
            "more.inp: line 2: expected a file that does not include this one again, found `more.inp`, which includes this file",
        ),
        (
            "*INCLUDE\n",
            "more.inp: line 1: expected the parameter INPUT, found `*INCLUDE`",
        ),
        (
            "*INCLUDE, INPUT=none.inp\n",
            "more.inp: line 1: expected a file to include, found `none.inp`, which cannot be read: No such file or directory (os error 2)",
        ),
    ] {
        let found = outcome(&[("main.inp", main), ("more.inp", more)]);
        assert_eq!(found, Err(expected.to_owned()));
    }
}

#[test]
fn what_is_included_twice_beside_each_other_is_no_circle() {
    let found = outcome(&[
        (
            "main.inp",
            "*INCLUDE, INPUT=empty.inp\n*INCLUDE, INPUT=empty.inp\n",
        ),
        ("empty.inp", "** nothing\n"),
    ]);
    assert!(found.unwrap_err().contains("mesh the volume of the body"));
}
