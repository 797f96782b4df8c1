//! Abaqus files, whole and broken.

use super::{assert_explained, block, divided, written};
use crate::{Asked, MeshFileFault, abaqus};
use striae_mesh::{CellKind, Mesh, NodeId, Vec3};

fn body(text: &str) -> Result<Mesh, MeshFileFault> {
    abaqus::body(text).map(|reading| reading.mesh)
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
*Nset, nset=low, generate, instance=pair-1
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
    let mesh = body(&text).unwrap();
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
        let mesh = body(&text).unwrap();
        let faces = mesh.facet_sets.get("one").unwrap();
        assert_eq!(mesh.area_vector(faces[0]), normal, "{side}");
    }
}

#[test]
fn shells_and_bars_make_sets_of_facets_and_nodes() {
    let text = TWO_CUBES.to_owned()
        + "*Element, type=S4R, elset=Skin
21, 1, 4, 14, 11
22, 2, 5, 15, 12
*Element, type=T3D2, elset=Wire
23, 1, 2
*Element, type=MASS, elset=Wire
24, 13
*Element, type=B31
25, 2, 3
*Elset, elset=Mixed
7, 21, 23
*Nset, nset=skinned, elset=Skin
*Surface, name=Outside
Skin, SPOS
*Surface, name=Mid
7, S4
";
    let reading = abaqus::body(&text).unwrap();
    let mesh = &reading.mesh;
    let left = |set: &str| {
        let faces = mesh.facet_sets.get(set).unwrap();
        assert_eq!(faces.len(), 1, "{set}");
        assert_eq!(mesh.area_vector(faces[0]), -Vec3::x(), "{set}");
    };
    ["Skin", "Mixed", "Outside"].into_iter().for_each(left);
    assert_eq!(mesh.facet_sets.get("Mid"), None);
    let nodes = |set: &str| mesh.node_sets.get(set).unwrap().len();
    assert_eq!(["Skin", "Wire", "Mid", "skinned"].map(nodes), [8, 2, 4, 8]);
    let names: Vec<&str> = mesh.element_sets.names().collect();
    assert_eq!(names, ["Both", "Mixed", "all"]);
    assert_eq!(mesh.element_sets.get("Mixed").unwrap().len(), 1);
    let left_out = "facets are not on the boundary of the body and are left out";
    assert_eq!(
        reading.notes,
        [
            "elements C3D8R are read as elements with full integration".to_owned(),
            "1 element of type MASS is ignored".to_owned(),
            format!("facet set `Mid`: 1 of 1 {left_out}"),
            format!("facet set `Outside`: 1 of 2 {left_out}"),
            format!("facet set `Skin`: 1 of 2 {left_out}"),
            "in no set and left out: 1 line".to_owned(),
        ]
    );
}

#[test]
fn broken_abaqus_files_are_explained() {
    for (text, parts) in [
        ("1, 2\n*NODE\n", ["line 1", "a keyword such as *NODE"]),
        ("*NODE\n1, 0, x, 0\n", ["line 2", "a coordinate"]),
        ("*NODE\n1, 0\n1, 0\n", ["line 3", "has not been used"]),
        ("*ELEMENT, TYPE=C3D13\n", ["line 1", "with these elements"]),
        (
            "*ELEMENT, TYPE=C3D8\n1, 2, 3\n",
            ["line 2", "8 node numbers"],
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
            ["line 1", "the parameter PART"],
        ),
        ("*SURFACE, NAME=a\n1, S7\n", ["line 2", "S1 to S6"]),
        (
            "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*SURFACE, NAME=a\n1, S5\n",
            [
                "line 9",
                "a side of the element, found side 5 of element 1, a tetrahedron",
            ],
        ),
        (
            "*ELEMENT, TYPE=C3D9\n",
            ["line 1", "mesh the part with these elements"],
        ),
        (
            "*ELEMENT, TYPE=S4\n1, 2, x\n",
            ["line 2", "an element number and node numbers, found `x`"],
        ),
        (
            "*ELEMENT, TYPE=S3\n1, 2, 3, 4\n1, 2, 3, 4\n",
            ["line 3", "element 1 for the second time"],
        ),
        (
            "*NODE\n1, 0, 0, 0\n",
            ["expected tetrahedra", "mesh the volume"],
        ),
    ] {
        assert_explained(body(text).map(drop), parts);
    }
    let inverted = TWO_CUBES.replace(
        "8, 2, 3, 6, 5, 12, 13, 16, 15",
        "8, 12, 13, 16, 15, 2, 3, 6, 5",
    );
    let parts = [
        "line 22: expected a positive Jacobian determinant",
        "element 8",
    ];
    assert_explained(body(&inverted).map(drop), parts);
    let twice = TWO_CUBES.replace("8, 2, 3", "7, 2, 3");
    assert_explained(
        body(&twice).map(drop),
        ["line 22", "element 7 for the second time"],
    );
}

/// Two cubes with rows at the end of the part.
fn with(rows: &str) -> String {
    TWO_CUBES.replace("*End Part", &(rows.to_owned() + "*End Part"))
}

#[test]
fn sets_that_name_themselves_grow_no_further() {
    let rows = "*Nset, nset=a\n1, 2\n".to_owned() + &"A, A, A, A, A, A, A, A\n".repeat(20);
    let mesh = body(&with(&rows)).unwrap();
    assert_eq!(mesh.node_sets.get("a").unwrap().len(), 2);
}

#[test]
fn ranges_of_more_numbers_than_the_file_has_rows_are_refused() {
    let text = with("*Elset, elset=a, generate\n7, 8000007\n");
    assert_explained(
        body(&text).map(drop),
        ["line 24", "numbers that the file defines"],
    );
}

#[test]
fn numbers_of_ranges_need_not_be_defined() {
    let rows = "*Nset, nset=a, generate\n1, 14\n*Nset, nset=b\na\n*Elset, elset=c, generate\n6, 8\n\
         *Surface, name=d\nc, S1\n";
    let reading = abaqus::body(&with(rows)).unwrap();
    let mesh = reading.mesh;
    assert_eq!(mesh.node_sets.get("a").unwrap().len(), 10);
    assert_eq!(mesh.node_sets.get("b").unwrap().len(), 10);
    assert_eq!(mesh.element_sets.get("c").unwrap().len(), 2);
    assert_eq!(mesh.facet_sets.get("d").unwrap().len(), 2);
    let left_out = "that are not defined and left out";
    for note in [
        format!("set `a`: numbers of a range, the first in line 24, {left_out}: 4"),
        format!("set `c`: numbers of a range, the first in line 28, {left_out}: 1"),
    ] {
        assert!(reading.notes.contains(&note), "{:?}", reading.notes);
    }
    let listed = with("*Nset, nset=a\n1, 9\n");
    assert_explained(
        body(&listed).map(drop),
        ["line 24", "node 9, which the file does not define"],
    );
}

#[test]
fn unused_nodes_are_left_out_also_of_sets() {
    let mesh = block(striae_mesh::CellKind::Hexahedron);
    let text = written::abaqus(&mesh)
        + "*NODE, NSET=reference\n99999, 5., 5.D0\n*NSET, NSET=mixed\n99999, 17\n";
    let back = body(&text).unwrap();
    assert_eq!(back.positions, mesh.positions);
    assert_eq!(back.node_sets.get("reference"), None);
    assert_eq!(back.node_sets.get("mixed"), Some([NodeId(1)].as_slice()));
}

#[test]
fn cells_of_higher_order_are_divided() {
    let edges_8 = [
        [0, 1],
        [1, 2],
        [2, 3],
        [3, 0],
        [4, 5],
        [5, 6],
        [6, 7],
        [7, 4],
        [0, 4],
        [1, 5],
        [2, 6],
        [3, 7],
    ];
    let edges_6 = [
        [0, 1],
        [1, 2],
        [2, 0],
        [3, 4],
        [4, 5],
        [5, 3],
        [0, 3],
        [1, 4],
        [2, 5],
    ];
    for (cells, edges) in [
        (CellKind::Hexahedron, &edges_8[..]),
        (CellKind::Wedge, &edges_6[..]),
    ] {
        let linear = block(cells);
        let whole = written::Whole::new(&linear, edges, &[], false);
        let reading = abaqus::body(&whole.abaqus("RH")).unwrap();
        assert_eq!(reading.asked, Some(Asked::MeanDilatation));
        let note = reading
            .notes
            .iter()
            .find(|note| note.contains("full integration"));
        assert!(
            note.is_some_and(|note| note.contains("C3D")),
            "{:?}",
            reading.notes
        );
        divided(&linear, &reading);
    }
    let edges: Vec<[usize; 2]> = edges_8.into();
    let linear = block(CellKind::Hexahedron);
    let faces: Vec<[usize; 4]> = CellKind::Hexahedron
        .shape()
        .faces
        .iter()
        .map(|face| (*face).try_into().unwrap())
        .collect();
    let mut whole = written::Whole::new(&linear, &edges, &faces, true);
    // The middle of the cell comes first.
    whole
        .cells
        .iter_mut()
        .for_each(|cell| cell[20..].rotate_right(1));
    divided(&linear, &abaqus::body(&whole.abaqus("I")).unwrap());
}

#[test]
fn nodes_are_added_beside_the_largest_number_there_is() {
    let edges = [
        [0, 1],
        [1, 2],
        [2, 0],
        [3, 4],
        [4, 5],
        [5, 3],
        [0, 3],
        [1, 4],
        [2, 5],
    ];
    let linear = block(CellKind::Wedge);
    let whole = written::Whole::new(&linear, &edges, &[], false);
    let text = whole.abaqus("") + "*NODE\n18446744073709551615, 9., 9., 9.\n";
    let mesh = body(&text).unwrap();
    assert_eq!(mesh.element_count(), 8 * linear.element_count());
    assert!((mesh.volume() - linear.volume()).abs() < 1e-12);
}
