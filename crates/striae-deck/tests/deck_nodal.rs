//! Textures read from files, node by node.

use std::path::Path;
use striae_deck::parse;
use striae_mesh::Vec3;
use striae_model::{ContactSurface, Model};
use striae_solve::problem::Problem;
use striae_surface::texture::Paint;

/// A cube whose node numbers rise downwards, one of them used by no element, with
/// directions at its nodes.
const CUBE: &str = r#"$MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
1
2 1 "top"
$EndPhysicalNames
$Nodes
9
80 0 0 0
70 1 0 0
60 1 1 0
50 0 1 0
15 9 9 9
40 0 0 1
30 1 0 1
20 1 1 1
10 0 1 1
$EndNodes
$Elements
2
1 3 2 1 1 40 30 20 10
2 5 0 80 70 60 50 40 30 20 10
$EndElements
$NodeData
1
"fibres"
1
0
3
0
3
5
10 1 0 0
20 0 1 0
30 1 1 0
40 1 2 0
15 0 0 1
$EndNodeData
"#;

/// A block under the cube, with a list of directions at its nodes; rows of a side
/// are put in.
fn deck(a: &str, b: &str) -> String {
    format!(
        r#"title = "Textures from files"
material = [{{ name = "rubber", law = "neo-hookean", youngs_modulus = 1, poissons_ratio = 0.3 }}]
body = [
    {{ name = "cube", material = "rubber", mesh = {{ file = "cube.msh" }}, node_sets = [{{ name = "foot", sphere = {{ centre = [0, 0, 0], radius = 0.1 }} }}] }},
    {{ name = "block", material = "rubber", mesh = {{ generator = "block", origin = [0, 0, 1], size = [1, 1, 1], divisions = [1, 1, 1] }} }},
]
rigid = [{{ name = "floor", plane = {{ point = [0, 0, 2], normal = [0, 0, -1] }} }}]
pair = [
    {{ name = "p", a = {{ body = "cube", facets = "top", texture = {a} }}, b = {{ {b} }} }},
]
[[step]]
name = "rest"
displacement = [
    {{ body = "cube", nodes = "all", x = 0, y = 0 }},
    {{ body = "cube", nodes = "foot", z = 0 }},
    {{ body = "block", nodes = "all", x = 0, y = 0, z = 0 }},
]
"#
    )
}

/// A folder with the files.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("cube.msh", CUBE);
    write("some.csv", "node,x,y,z\n0,1,0,0\n1,0,1,0\n2,1,1,0\n");
    write(
        "list.csv",
        "node,x,y,z\n3,4,0,0\n2,3,0,0\n1,2,0,0\n0,1,0,0\n",
    );
    for (name, direction) in [("normal.csv", "0,0,1"), ("zero.csv", "0,0,0")] {
        let lines = format!("node,x,y,z\n10,1,0,0\n20,{direction}\n30,1,0,0\n40,1,0,0\n");
        write(name, &lines);
    }
    folder
}

const BLOCK: &str = r#"body = "block", facets = "zmin", texture = { nodal = "list.csv" }"#;

fn model(text: &str, base: &Path) -> Model {
    let deck = parse(text, "deck.toml", base);
    deck.unwrap_or_else(|faults| panic!("{faults}")).model
}

#[test]
fn directions_stand_in_the_order_of_the_nodes_of_the_surface() {
    let folder = folder();
    for texture in [
        r#"{ nodal = "cube.msh" }"#,
        r#"{ nodal = "cube.msh", name = "fibres" }"#,
    ] {
        let model = model(&deck(texture, BLOCK), folder.path());
        let [Some(Paint::Nodal(cube)), Some(Paint::Nodal(block))] = &model.pairs[0].textures else {
            panic!("two nodal textures");
        };
        // Nodes 10, 20, 30, 40 of the file.
        let v = Vec3::new;
        assert_eq!(
            cube[..],
            [v(1., 0., 0.), v(0., 1., 0.), v(1., 1., 0.), v(1., 2., 0.)]
        );
        // Nodes of the bottom of a generated block are those from 0.
        assert_eq!(block[..], [1., 2., 3., 4.].map(|x| v(x, 0., 0.)));
    }
}

#[test]
fn every_node_gets_the_direction_of_its_number() {
    let folder = folder();
    let model = model(&deck(r#"{ nodal = "cube.msh" }"#, BLOCK), folder.path());
    let ContactSurface::Deformable { body, faces } = &model.pairs[0].a else {
        panic!("side a is a body");
    };
    let mesh = &model.bodies[body.0].mesh;
    let nodes = mesh.nodes_of_faces(faces);
    // Positions of the nodes 10, 20, 30, 40 of the file.
    let positions: Vec<Vec3> = nodes
        .iter()
        .map(|node| mesh.positions[node.index()])
        .collect();
    let v = Vec3::new;
    assert_eq!(
        positions,
        [v(0., 1., 1.), v(1., 1., 1.), v(1., 0., 1.), v(0., 0., 1.)]
    );
    assert!(Problem::new(model).is_ok());
}

#[test]
fn broken_nodal_textures_are_explained() {
    let folder = folder();
    let told = |a: &str, b: &str| {
        let faults = parse(&deck(a, b), "deck.toml", folder.path()).unwrap_err();
        faults.to_string()
    };
    let cube = r#"{ uniform = [1, 0, 0] }"#;
    for (a, b, parts) in [
        (
            r#"{ nodal = "none.csv" }"#,
            BLOCK,
            [
                "9:76: the texture of body `cube` cannot be read",
                "none.csv: cannot be read",
            ],
        ),
        (
            r#"{ nodal = "cube.msh", name = "hair" }"#,
            BLOCK,
            ["expected node data `hair` once", "there is `fibres`"],
        ),
        (
            cube,
            r#"body = "block", facets = "zmin", texture = { nodal = "some.csv" }"#,
            [
                "the texture of body `block`",
                "some.csv: it has no vector for node 3 of the mesh",
            ],
        ),
        (
            cube,
            r#"rigid = "floor", texture = { nodal = "list.csv" }"#,
            [
                "rigid surface `floor` is a plane and has no nodes",
                "at points or nodes",
            ],
        ),
        (r#"{ hair = 1 }"#, BLOCK, ["texture", "or `nodal`"]),
        (
            r#"{ name = "fibres" }"#,
            BLOCK,
            ["missing key `nodal`", "expected a text"],
        ),
        (r#"{ nodal = 3 }"#, BLOCK, ["`nodal` in", "must be a text"]),
    ] {
        let said = told(a, b);
        for part in parts {
            assert!(said.contains(part), "{said} -- lacks: {part}");
        }
    }
}

#[test]
fn a_direction_along_the_normal_is_refused_with_its_node() {
    let folder = folder();
    let told = |texture: &str| {
        let deck = deck(texture, BLOCK);
        let read = parse(&deck, "deck.toml", folder.path());
        read.unwrap_err().to_string()
    };
    // Opposite directions at two corners of a face cancel at the others.
    let opposite = "{ points = [{ at = [0, 0, 1], direction = [1, 0, 0] }, { at = [1, 1, 1], direction = [-1, 0, 0] }] }";
    for (texture, words) in [
        (
            r#"{ nodal = "normal.csv" }"#,
            "node 1, (1, 1, 1): it is normal",
        ),
        (
            r#"{ nodal = "zero.csv" }"#,
            "node 1, (1, 1, 1): the direction stated there is zero",
        ),
        (opposite, "cancel there"),
    ] {
        let error = told(texture);
        let whole = "the texture of body `cube` has no direction at ";
        assert!(error.contains(whole) && error.contains(words), "{error}");
    }
}
