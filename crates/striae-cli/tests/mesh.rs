//! `striae mesh` from outside: what it prints and writes, and files that are refused.

use std::{fs, path::Path, process::Command};

/// Two cubes in a row, with sets, a shell, a wire and a material.
const FILE: &str = "*NODE
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
16, 2., 1., 1.5
*ELEMENT, TYPE=C3D8, ELSET=Left
7, 1, 2, 5, 4, 11, 12, 15, 14
*ELEMENT, TYPE=C3D8, ELSET=Right
8, 2, 3, 6, 5, 12, 13, 16, 15
*ELEMENT, TYPE=S4, ELSET=Skin
9, 1, 4, 14, 11
*ELEMENT, TYPE=B31
10, 1, 2
*NSET, NSET=held
1, 4, 11
*SOLID SECTION, ELSET=Left, MATERIAL=RUBBER
*MATERIAL, NAME=Rubber
*HYPERELASTIC, NEO HOOKE
0.5, 0.02
*MATERIAL, NAME=Foam
*HYPERFOAM
1., 2.
";

/// Exit code, standard output and errors.
fn said(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_striae"))
        .arg("mesh")
        .args(arguments)
        .current_dir(folder)
        .output()
        .expect("the program");
    let text = |bytes| String::from_utf8(bytes).expect("text");
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Lines with single spaces.
fn lines(said: &str) -> Vec<String> {
    let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    said.lines().map(words).collect()
}

#[test]
fn a_file_is_shown_with_its_sets_and_numbers() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(folder.path().join("bar.inp"), FILE).expect("a file");
    let arguments = ["bar.inp", "--picture", "bar.png", "--out", "bar.vtu"];
    let (code, out, errors) = said(folder.path(), &arguments);
    assert_eq!((code, errors.as_str()), (Some(0), ""), "{out}");
    let found = lines(&out);
    assert_eq!(
        found[..4],
        [
            "bar.inp",
            "from (0, 0, 0) to (2, 1, 1.5)",
            "12 nodes",
            "2 hexahedra"
        ]
    );
    // A corner of the second cube is lifted by a half, its upper side by an eighth on average.
    assert_eq!(found[4..6], ["volume 2.125", "edges from 1 to 1.5"]);
    let start = "smallest scaled Jacobians (at best 1), of elements 8 (";
    assert!(found[6].starts_with(start), "{}", found[6]);
    assert!(found[6].ends_with("7 (1.0000)"), "{}", found[6]);
    assert_eq!(
        found[7..11],
        [
            "element sets elements volume",
            "Left 1 1",
            "Right 1 1.125",
            "all 2 2.125",
        ]
    );
    assert_eq!(found[11..13], ["facet sets facets area", "Skin 1 1"]);
    assert!(found[13].starts_with("all 10 "), "{}", found[13]);
    assert_eq!(
        found[14..],
        [
            "node sets nodes",
            "Skin 4",
            "all 12",
            "held 3",
            "material `Rubber`: neo-Hooke, C10 = 5e-1, D1 = 2e-2; of `Left`",
            "material `Foam` cannot be used: bar.inp: line 29: expected *DENSITY, *ELASTIC, *HYPERELASTIC, *PLASTIC or *VISCOELASTIC, found `*HYPERFOAM`",
            "note: in no set and left out: 1 line",
            "wrote bar.png",
            "wrote bar.vtu",
        ]
    );
    let picture = fs::read(folder.path().join("bar.png")).expect("a picture");
    assert!(picture.starts_with(b"\x89PNG"));
    let (code, out, _) = said(folder.path(), &["bar.vtu"]);
    let found = lines(&out);
    assert_eq!(code, Some(0), "{out}");
    assert_eq!(found[2..5], ["12 nodes", "2 hexahedra", "volume 2.125"]);
    for set in [
        "elements: Left-1 1 1",
        "nodes: held-1 3",
        "element_number-8 1 1.125",
    ] {
        assert!(found.iter().any(|line| line == set), "{set}: {out}");
    }
}

#[test]
fn rigid_surfaces_are_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let stl = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\n\
               endloop\nendfacet\nendsolid s\n";
    fs::write(folder.path().join("road.STL"), stl).expect("a file");
    let arguments = ["road.STL", "--picture", "road.png", "--out", "road.vtu"];
    let (code, out, errors) = said(folder.path(), &arguments);
    assert_eq!((code, errors.as_str()), (Some(0), ""), "{out}");
    assert_eq!(
        lines(&out),
        [
            "road.STL",
            "from (0, 0, 0) to (2, 1, 0)",
            "3 nodes",
            "facets of a rigid surface: 1",
            "area 1",
            "open, with 3 boundary edges",
            "mean normal (0, 0, 1): bodies touch it from there",
            "wrote road.png",
            "wrote road.vtu",
        ]
    );
}

/// Files of Gmsh and Abaqus that have shells alone.
#[test]
fn files_of_facets_alone_are_rigid_surfaces() {
    let folder = tempfile::tempdir().expect("a folder");
    let nodes = "1 0 0 0\n2 2 0 0\n3 2 2 0\n4 0 2 0\n";
    let gmsh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n{nodes}$EndNodes\n\
         $Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 1 3 4\n$EndElements\n"
    );
    let abaqus = format!(
        "*NODE\n{}*ELEMENT, TYPE=R3D4\n1, 1, 2, 3, 4\n",
        nodes.replace(' ', ", ")
    );
    let turned = gmsh.replace("1 3 4", "1 4 3");
    for (name, text) in [("a.msh", &gmsh), ("b.inp", &abaqus), ("c.msh", &turned)] {
        fs::write(folder.path().join(name), text).expect("a file");
        let (code, out, errors) = said(folder.path(), &[name]);
        assert_eq!((code, errors.as_str()), (Some(0), ""), "{out}");
        let is_turned = name == "c.msh";
        let normal = "mean normal (0, 0, 1): bodies touch it from there";
        assert!(
            out.contains("area 4\n  open, with 4 boundary edges\n"),
            "{out}"
        );
        assert_eq!(out.contains(normal), !is_turned, "{out}");
        let words =
            "opposite orientations: 1, the first of facets 0, 1 from (0, 0, 0) to (2, 2, 0)";
        assert_eq!(out.contains(words), is_turned, "{out}");
    }
    fs::write(folder.path().join("none.inp"), "*NODE\n1, 0, 0, 0\n").expect("a file");
    let (code, _, errors) = said(folder.path(), &["none.inp"]);
    let words = "expected tetrahedra, pyramids, wedges or hexahedra, found none";
    assert!(code == Some(2) && errors.contains(words), "{errors}");
}

/// Cubes that share no nodes, and those that touch without being joined.
#[test]
fn joints_that_are_none_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let apart = FILE.replace(
        "8, 2, 3, 6, 5, 12, 13, 16, 15",
        "8, 22, 3, 6, 25, 32, 13, 16, 35",
    );
    let more = "22, 1., 0., 0.\n25, 1., 1., 0.\n32, 1., 0., 1.\n35, 1., 1., 1.\n";
    let apart = apart.replace("*NODE\n", &format!("*NODE\n{more}"));
    fs::write(folder.path().join("bar.inp"), apart).expect("a file");
    let (code, out, _) = said(folder.path(), &["bar.inp"]);
    assert_eq!(code, Some(0), "{out}");
    for words in [
        "note: pieces that share no nodes: 2: 8 nodes with node 1 at (0, 0, 0); 8 nodes with node 3 at (2, 0, 0)\n",
        "warning: pairs of coincident nodes that are not joined: 4, the first 2 and 22 at (1, 0, 0);",
    ] {
        assert!(out.contains(words), "{out}");
    }
}

#[test]
fn what_cannot_be_shown_is_told_in_one_line() {
    let folder = tempfile::tempdir().expect("a folder");
    fs::write(
        folder.path().join("bar.inp"),
        FILE.replace("5, 1., 1., 0.", "5, 1., x"),
    )
    .expect("a file");
    for (arguments, message) in [
        (
            &["bar.inp"][..],
            "bar.inp: line 6: expected a coordinate, found `5, 1., x`\n",
        ),
        (
            &["none.msh"],
            "none.msh: cannot be read: No such file or directory (os error 2)\n",
        ),
        (
            &["part.step"],
            "part.step: unknown kind of file; expected .msh (Gmsh), .inp (Abaqus), .vtu or .vtk (VTK), or .stl\n",
        ),
    ] {
        let (code, out, errors) = said(folder.path(), arguments);
        assert_eq!((code, out.as_str()), (Some(2), ""));
        assert_eq!(errors, message);
    }
    let (code, _, errors) = said(folder.path(), &["bar.inp", "--out", "bar.vtk"]);
    assert_eq!(code, Some(2));
    assert!(
        errors.contains("the name of the file must end in .vtu"),
        "{errors}"
    );
}
