//! Parts of files: element sets, physical volumes and instances.

use super::super::{self as mesh_file, MeshFileFault, abaqus, gmsh, unused_note};

/// Two cubes that share a face.
const CUBES: &str = "*NODE
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
*ELEMENT, TYPE=C3D8, ELSET=Left
7, 1, 2, 5, 4, 11, 12, 15, 14
*ELEMENT, TYPE=C3D8, ELSET=Right
8, 2, 3, 6, 5, 12, 13, 16, 15
*NSET, NSET=low
1, 2, 3
*NSET, NSET=far
3, 6
*SURFACE, NAME=glue
Left, S4
*SURFACE, NAME=top
7, S2
8, S2
*SURFACE, NAME=rims, TYPE=NODE
far,
5,
";

#[test]
fn a_part_has_what_is_on_it_of_all_sets() {
    let whole = abaqus::body(CUBES).unwrap();
    assert!(whole.mesh.facet_sets.get("glue").is_none());
    assert_eq!(whole.mesh.node_sets.get("rims").map(<[_]>::len), Some(3));
    let left = abaqus::part(CUBES, Some("Left")).unwrap();
    assert_eq!(left.notes, Vec::<String>::new());
    let mesh = &left.mesh;
    assert_eq!((mesh.element_count(), mesh.positions.len()), (1, 8));
    let facets = mesh.facet_sets.iter().map(|(name, of)| (name, of.len()));
    let facets: Vec<(&str, usize)> = facets.collect();
    assert_eq!(facets, [("glue", 1), ("top", 1)]);
    assert_eq!(mesh.node_sets.get("low").map(<[_]>::len), Some(2));
    assert_eq!(mesh.node_sets.get("rims").map(<[_]>::len), Some(1));
    assert!(mesh.node_sets.get("far").is_none());
    assert!(mesh.element_sets.get("Right").is_none());
    let normal = mesh.area_vector(mesh.facet_sets.get("glue").unwrap()[0]);
    assert!((normal - striae_mesh::Vec3::x()).norm() < 1e-14);
    let numbers = &left.numbers;
    assert_eq!(numbers.element(striae_mesh::ElementId(0)), "7");
}

#[test]
fn names_that_a_file_does_not_have_are_answered_with_those_it_has() {
    let fault = abaqus::part(CUBES, Some("left")).unwrap_err();
    let MeshFileFault::NoPart { known, .. } = &fault else {
        panic!("{fault}");
    };
    assert_eq!(known, &["Left", "Right"]);
    assert_eq!(
        fault.to_string(),
        "it has no element set or instance `left`; it has `Left`, `Right`"
    );
    assert_eq!(
        abaqus::part(CUBES, Some("all")).unwrap(),
        abaqus::body(CUBES).unwrap()
    );
}

#[test]
fn the_only_instance_is_all_of_the_file() {
    let text = "*PART, NAME=p\n".to_owned()
        + CUBES
        + "*END PART\n*ASSEMBLY, NAME=a\n*INSTANCE, NAME=p-1, PART=p\n1., 0., 0.\n*END INSTANCE\n*END ASSEMBLY\n";
    let part = abaqus::part(&text, Some("p-1")).unwrap();
    assert_eq!(part, abaqus::body(&text).unwrap());
    let fault = abaqus::part(&text, Some("p-2")).unwrap_err().to_string();
    assert!(fault.ends_with("it has `Left`, `Right`, `p-1`"), "{fault}");
}

#[test]
fn members_that_the_file_lacks_are_told_in_parts_too() {
    for (more, told) in [
        ("*ELSET, ELSET=odd\n99\n", "element 99"),
        ("*NSET, NSET=odd\n99\n", "node 99"),
        ("*SURFACE, NAME=odd\n99, S1\n", "element 99"),
    ] {
        let fault = abaqus::part(&format!("{CUBES}{more}"), Some("Left")).unwrap_err();
        let fault = fault.to_string();
        assert!(fault.contains(told) && fault.contains("line 31"), "{fault}");
    }
}

#[test]
fn physical_volumes_that_share_a_face_are_parts() {
    let text = "$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
3
2 3 \"glue\"
3 1 \"one\"
3 2 \"other\"
$EndPhysicalNames
$Nodes
5
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
5 0 0 -1
$EndNodes
$Elements
3
1 4 2 1 1 1 2 3 4
2 4 2 2 2 1 3 2 5
3 2 2 3 3 1 2 3
$EndElements
";
    let part = |name| {
        gmsh::collected(text.as_bytes())?
            .of_part(Some(name))?
            .mesh()
    };
    for (name, side) in [("one", -0.5), ("other", 0.5)] {
        let reading = part(name).unwrap();
        let glue = reading.mesh.facet_sets.get("glue").unwrap();
        assert_eq!(glue.len(), 1);
        assert!((reading.mesh.area_vector(glue[0]).z - side).abs() < 1e-14);
    }
    assert!(matches!(part("glue"), Err(MeshFileFault::NoPart { .. })));
}

#[test]
fn keywords_that_no_mesh_is_made_of_are_noted_with_their_lines() {
    let more = "*MATERIAL, NAME=m
*ELASTIC
1., 0.3
*SURFACE INTERACTION, NAME=i
*FRICTION
0.4
*SURFACE, TYPE=CYLINDER, NAME=roll
*BOUNDARY
low, 1, 3
*STEP
*STATIC
*BOUNDARY
far, 1, 1, 0.5
*END STEP
";
    let reading = abaqus::body(&format!("*HEADING\n{CUBES}{more}")).unwrap();
    assert_eq!(reading.notes.len(), 1, "{:?}", reading.notes);
    assert_eq!(
        unused_note(&reading.unused, true).unwrap(),
        "keywords of the file that a mesh does not use: *SURFACE INTERACTION (line 34), \
         *FRICTION (line 35), *SURFACE (line 37), *BOUNDARY (line 38, line 42), *STEP (line 40), \
         *STATIC (line 41); `striae convert` makes a deck of them"
    );
    let all = unused_note(&reading.unused, false).unwrap();
    assert!(
        all.contains("*MATERIAL (line 31), *ELASTIC (line 32), *SURFACE"),
        "{all}"
    );
    assert_eq!(
        unused_note(&abaqus::body(CUBES).unwrap().unused, false),
        None
    );
}

#[test]
fn rigid_elements_of_an_instance_are_a_rigid_surface() {
    let text = "*PART, NAME=p\n".to_owned()
        + CUBES
        + "*END PART
*PART, NAME=tool
*NODE
1, 0., 0., 0.
2, 1., 0., 0.
3, 1., 1., 0.
4, 0., 1., 0.
9, 0.5, 0.5, 1.
*ELEMENT, TYPE=R3D4
1, 1, 2, 3, 4
*END PART
*ASSEMBLY, NAME=a
*INSTANCE, NAME=p-1, PART=p
*END INSTANCE
*INSTANCE, NAME=tool-1, PART=tool
0., 0., 2.
*END INSTANCE
*END ASSEMBLY
";
    let folder = std::env::temp_dir().join(format!("striae-rigid-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("model.inp");
    std::fs::write(&path, &text).unwrap();
    let surface = mesh_file::read_rigid_part(&path, Some("tool-1")).unwrap();
    assert_eq!((surface.positions.len(), surface.facets.len()), (4, 1));
    assert!(surface.positions.iter().all(|x| x.z == 2.0));
    let empty = mesh_file::read_rigid_part(&path, Some("p-1")).unwrap_err();
    assert!(empty.to_string().contains("R3D4"), "{empty}");
    let body = mesh_file::read_part(&path, Some("p-1")).unwrap();
    assert_eq!(body.mesh.element_count(), 2);
    let points = mesh_file::InputFile::read(&path).unwrap().points();
    let (_, place) = points.find("tool-1.9").unwrap();
    assert_eq!(place, striae_mesh::Vec3::new(0.5, 0.5, 3.0));
    std::fs::remove_dir_all(&folder).unwrap();
}
