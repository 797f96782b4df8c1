//! Bodies that nothing can hold, meshes that cannot be and surfaces that look away are refused
//! before a run, with the line of the deck.
//!
//! Longer than other files, as all its tests change one deck.

use std::path::Path;

use striae_deck::parse;

const BLOCKS: &str = r#"title = "Two blocks"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 2
poissons_ratio = 0.4
[[body]]
name = "lower"
material = "rubber"
mesh = { generator = "block", size = [20, 20, 10], divisions = [4, 4, 2] }
[[body]]
name = "upper"
material = "rubber"
mesh = { generator = "block", origin = [5, 5, 10], size = [10, 10, 5], divisions = [3, 3, 2] }
[[pair]]
name = "joint"
a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }
friction = { law = "coulomb", mu = 0.4 }
[[step]]
name = "press"
displacement = [
    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
    { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.5 },
]
"#;
const LOWER: &str = r#"    { body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 },
"#;
const UPPER: &str = r#"{ body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.5 }"#;

/// The deck with passages replaced; what it is refused with, if it is.
fn told(passages: &[[&str; 2]]) -> Option<String> {
    let text = passages.iter().fold(BLOCKS.to_owned(), |text, [old, new]| {
        assert_eq!(text.matches(old).count(), 1, "`{old}`");
        text.replace(old, new)
    });
    let read = parse(&text, "deck.toml", Path::new(""));
    read.err().map(|faults| faults.to_string())
}

#[track_caller]
fn refused(passages: &[[&str; 2]], words: &[&str]) {
    let found = told(passages).expect("a fault");
    for words in words {
        assert!(found.contains(words), "{words}: {found}");
    }
}

#[test]
fn a_sound_deck_is_accepted() {
    assert_eq!(told(&[]), None);
}

#[test]
fn a_body_that_contact_only_pushes_is_named() {
    let words = [
        "deck.toml:20:1: contact can only push body `lower` along -z in step `press`",
        "nothing resists this motion",
        "the contact of `joint`",
    ];
    refused(&[[LOWER, ""]], &words);
    // A load that presses it back holds it, as does inertia.
    let pressed =
        "name = \"press\"\npressure = [{ body = \"lower\", facets = \"zmin\", value = 0.1 }]";
    assert_eq!(told(&[[LOWER, ""], ["name = \"press\"", pressed]]), None);
    let dense = [
        "law = \"neo-hookean\"",
        "law = \"neo-hookean\"\ndensity = 1",
    ];
    let dynamic = ["name = \"press\"", "name = \"press\"\ndynamics = {}"];
    assert_eq!(told(&[[LOWER, ""], dense, dynamic]), None);
}

#[test]
fn a_pressure_of_the_wrong_sign_is_named() {
    let held = r#"{ body = "upper", nodes = "zmax", x = 0, y = 0 }"#;
    let loaded = |value: &str| {
        format!(
            "name = \"press\"\npressure = [{{ body = \"upper\", facets = \"zmax\", value = {value} }}]"
        )
    };
    let pulled = loaded("-0.1");
    refused(
        &[[UPPER, held], ["name = \"press\"", &pulled]],
        &[
            "contact can only push body `upper` along +z",
            "pull it in the same direction, away from the contact of `joint`, with a force of 10",
            "a positive pressure presses",
        ],
    );
    let pressed = loaded("0.1");
    assert_eq!(told(&[[UPPER, held], ["name = \"press\"", &pressed]]), None);
}

/// Friction holds a block on a slope that its weight presses on, unless there is none.
#[test]
fn slopes_hold_by_friction() {
    let slope = "[[rigid]]\nname = \"slope\"\nplane = { point = [0, 0, 0], normal = [-0.3, 0, 1] }\n[[pair]]\nname = \"joint\"";
    let weight = "name = \"press\"\ngravity = { vector = [0, 0, -10] }";
    let with = |friction: &str| {
        told(&[
            ["[[pair]]\nname = \"joint\"", slope],
            [
                "a = { body = \"lower\", facets = \"zmax\" }",
                "a = { body = \"lower\", facets = \"zmin\" }",
            ],
            [
                "b = { body = \"upper\", facets = \"zmin\" }",
                "b = { rigid = \"slope\" }\ninitial = \"resolve\"",
            ],
            [
                "size = [20, 20, 10], divisions = [4, 4, 2] }",
                "size = [20, 20, 10], divisions = [4, 4, 2], rotation = { axis = [0, 1, 0], degrees = -16.7, about = [0, 0, 0] } }",
            ],
            [LOWER, ""],
            ["poissons_ratio = 0.4", "poissons_ratio = 0.4\ndensity = 1"],
            ["name = \"press\"", weight],
            ["mu = 0.4", friction],
        ])
    };
    assert_eq!(with("mu = 0.4"), None);
    let found = with("mu = 0").expect("a fault");
    assert!(found.contains("only push body `lower` along -x"), "{found}");
}

#[test]
fn a_rigid_body_that_contact_only_pushes_is_named() {
    let floor = "[[rigid]]\nname = \"floor\"\nplane = { point = [0, 0, 0], normal = [0, 0, 1] }\n[[pair]]\nname = \"joint\"";
    let sole = "a = { body = \"lower\", facets = \"zmin\" }";
    let on_floor = [
        ["[[pair]]\nname = \"joint\"", floor],
        ["a = { body = \"lower\", facets = \"zmax\" }", sole],
        [
            "b = { body = \"upper\", facets = \"zmin\" }",
            "b = { rigid = \"floor\" }",
        ],
        [
            LOWER,
            "    { body = \"lower\", nodes = \"zmax\", x = 0, y = 0, z = -0.5 },\n",
        ],
    ];
    let free = |more: &str| {
        format!("name = \"press\"\nrigid = [{{ surface = \"floor\", free = [\"z\"]{more} }}]")
    };
    let (loose, driven) = (free(""), free(", force = [0, 0, 10]"));
    let with = |step: &str| {
        let passages = [&on_floor[..], &[["name = \"press\"", step]]].concat();
        told(&passages)
    };
    let found = with(&loose).expect("a fault");
    assert!(
        found.contains("contact can only push rigid body `floor` along -z"),
        "{found}"
    );
    assert_eq!(with(&driven), None);
}

#[test]
fn surfaces_that_are_prescribed_towards_each_other_are_named() {
    let both = r#"{ body = "upper", nodes = "zmin", z = -0.5 }, { body = "lower", nodes = "zmax", z = 0 }, { body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.5 }"#;
    refused(
        &[[UPPER, both]],
        &[
            "pair `joint`: in step `press` displacements prescribe all nodes of both contact surfaces",
        ],
    );
}

const CUBES: &str = "{ positions = [[5,5,10],[6,5,10],[5,6,10],[6,6,10],[5,5,11],[6,5,11],[5,6,11],[6,6,11],[5,5,11],[6,5,11],[5,6,11],[6,6,11],[5,5,12],[6,5,12],[5,6,12],[6,6,12]], cells = [[0,1,3,2,4,5,7,6],[8,9,11,10,12,13,15,14]] }";
const UPPER_MESH: &str =
    r#"{ generator = "block", origin = [5, 5, 10], size = [10, 10, 5], divisions = [3, 3, 2] }"#;

#[test]
fn pieces_that_nothing_holds_are_named() {
    let sets = format!(
        "{CUBES}\nnode_sets = [{{ name = \"zmax\", numbers = [12, 13, 14, 15] }}]\nfacet_sets = [{{ name = \"zmin\", sides = [[0, 0]] }}]"
    );
    // The lower cube is in the pair, which pushes it up into nothing.
    refused(
        &[[UPPER_MESH, &sets]],
        &[
            "contact can only push the piece with node 0 of body `upper`",
            "made of 2 pieces that share no nodes",
            "along +z",
        ],
    );
    let on_top = sets
        .replace("[[0, 0]]", "[[1, 0]]")
        .replace("[12, 13, 14, 15]", "[4, 5, 6, 7]");
    refused(
        &[[UPPER_MESH, &on_top]],
        &["made of 2 pieces that share no nodes"],
    );
    // Neither held nor in the pair: nothing touches it at all.
    let loose = sets.replace("[[0, 0]]", "[[1, 1]]");
    refused(
        &[
            [UPPER_MESH, &loose],
            ["name = \"press\"", "name = \"press\"\nincrements = 2"],
        ],
        &[
            "for the piece of 8 nodes with node 0 at (5, 5, 10) nothing restrains it in step `press`",
            "4 of its nodes lie on nodes of another piece: merge coincident nodes",
        ],
    );
}

#[test]
fn node_numbers_beyond_all_bounds_are_faults() {
    for number in ["4294967296", "16", "18446744073709551615"] {
        let cells = CUBES.replace("[[0,1,3,2,", &format!("[[{number},1,3,2,"));
        let sets = format!("{cells}\nfacet_sets = [{{ name = \"zmin\", sides = [[0, 0]] }}]");
        let words = format!("element 0 refers to node {number}, but the mesh has 16 nodes");
        refused(&[[UPPER_MESH, &sets]], &["deck.toml:14:", &words]);
    }
    let sides = format!("{CUBES}\nfacet_sets = [{{ name = \"zmin\", sides = [[4294967296, 0]] }}]");
    refused(
        &[[UPPER_MESH, &sides]],
        &["side 0 of element 4294967296 is not on its boundary"],
    );
}

#[test]
fn meshes_beyond_memory_are_refused_before_they_are_made() {
    let largest = "the mesh of body `upper` cannot be made: the mesh would have";
    for divisions in ["[999999, 999999, 999999]", "[4000, 4000, 1000]"] {
        let started = std::time::Instant::now();
        let large = UPPER_MESH.replace("[3, 3, 2]", divisions);
        refused(&[[UPPER_MESH, &large]], &["deck.toml:14:8:", largest]);
        assert!(started.elapsed().as_secs() < 5);
    }
}

#[test]
fn facing_is_judged_before_overlap() {
    // Both surfaces look upwards.
    refused(
        &[[
            "facets = \"zmin\" }\nfriction",
            "facets = \"zmax\" }\nfriction",
        ]],
        &[
            "deck.toml:16:8: pair `joint`: the surface of `",
            "faces away from that of `",
            "Name the facets that face each other",
        ],
    );
}

#[test]
fn faces_that_cannot_touch_are_told_before_overlap() {
    // Perpendicular faces of bodies that overlap, back to back, and both outer faces.
    let outer = |facets: &str| format!("facets = \"{facets}\" }}\nfriction");
    let cases = [
        [
            "mesh = { generator = \"block\", origin = [5, 5, 10]",
            "mesh = { generator = \"block\", origin = [-2, 5, 7]",
            "xmin",
            "90 degrees apart",
        ],
        [
            "origin = [5, 5, 10]",
            "origin = [5, 5, 5]",
            "zmax",
            "0 degrees apart",
        ],
        [
            "origin = [5, 5, 10]",
            "origin = [5, 5, 10]",
            "zmax",
            "0 degrees apart",
        ],
    ];
    for [origin, other, facets, angle] in cases {
        let found = told(&[
            [origin, other],
            ["facets = \"zmin\" }\nfriction", &outer(facets)],
        ]);
        let found = found.expect("a fault");
        for words in ["faces away from that of", angle] {
            assert!(found.contains(words), "{found}");
        }
        assert!(!found.contains("inside"), "no talk of overlap: {found}");
    }
    // A plane whose normal points into the body that stands on it.
    let plane = "[[rigid]]\nname = \"floor\"\nplane = { point = [0, 0, 10], normal = [0, 0, -1] }\n[[pair]]\nname = \"joint\"";
    refused(
        &[
            ["[[pair]]\nname = \"joint\"", plane],
            [
                "a = { body = \"lower\", facets = \"zmax\" }",
                "a = { body = \"upper\", facets = \"zmin\" }",
            ],
            [
                "b = { body = \"upper\", facets = \"zmin\" }",
                "b = { rigid = \"floor\" }",
            ],
        ],
        &[
            "faces away from that of `floor`",
            "Reverse the normal of `floor`",
        ],
    );
}

#[test]
fn a_curved_tool_turned_inside_out_is_named() {
    let mut positions = Vec::new();
    let mut facets = [Vec::new(), Vec::new()];
    for i in 0..=24 {
        let (sine, cosine) = (180.0 + 7.5 * f64::from(i)).to_radians().sin_cos();
        for y in [-1, 21] {
            positions.push(format!(
                "[{}, {y}, {}]",
                10.0 + 6.0 * cosine,
                16.0 + 6.0 * sine
            ));
        }
        if i < 24 {
            let [a, b, c, d] = [0, 1, 3, 2].map(|corner| 2 * i + corner);
            facets[0].push(format!("[{a}, {b}, {c}, {d}]"));
            facets[1].push(format!("[{a}, {d}, {c}, {b}]"));
        }
    }
    let tool = |facets: &[String]| {
        format!(
            "[[rigid]]\nname = \"roller\"\nmesh = {{ positions = [{}], facets = [{}] }}\n[[pair]]\nname = \"joint\"",
            positions.join(", "),
            facets.join(", ")
        )
    };
    let with = |facets: &[String]| {
        told(&[
            ["[[pair]]\nname = \"joint\"", &tool(facets)],
            [
                "b = { body = \"upper\", facets = \"zmin\" }",
                "b = { rigid = \"roller\" }",
            ],
        ])
    };
    assert_eq!(with(&facets[0]), None);
    let found = with(&facets[1]).expect("a fault");
    for words in ["faces away from it", "reverse the facets of `roller`"] {
        assert!(found.contains(words), "{found}");
    }
    assert!(!found.contains("inside"), "no talk of overlap: {found}");
}

#[test]
fn textures_without_a_direction_name_node_cause_and_remedy() {
    let law = r#"friction = { law = "orthotropic", mu_along = 0.2, mu_across = 0.6 }"#;
    let with = |texture: &str| {
        let textured =
            format!("a = {{ body = \"lower\", facets = \"zmax\", texture = {texture} }}");
        told(&[
            ["a = { body = \"lower\", facets = \"zmax\" }", &textured],
            [r#"friction = { law = "coulomb", mu = 0.4 }"#, law],
        ])
    };
    let found = with("{ uniform = [0, 0, 1] }").expect("a fault");
    for words in [
        "deck.toml:17:50: pair `joint`: the texture of body `lower` has no direction at node ",
        "normal to the surface there; choose a direction with a tangential part",
    ] {
        assert!(found.contains(words), "{found}");
    }
    let circles = "{ circumferential = { point = [10, 10, 0], direction = [0, 0, 1] } }";
    let found = with(circles).expect("a fault");
    for words in [
        ", (10, 10, 10): its axis passes through that node",
        "move the axis or the mesh",
    ] {
        assert!(found.contains(words), "{found}");
    }
    assert_eq!(with(&circles.replace("[10, 10, 0]", "[12, 12.5, 0]")), None);
}

#[test]
fn textures_of_planes_are_judged_where_the_body_is() {
    let law = r#"friction = { law = "orthotropic", mu_along = 0.2, mu_across = 0.6 }"#;
    let with = |texture: &str| {
        let floor = "[[rigid]]\nname = \"floor\"\nplane = { point = [0, 0, 10], normal = [0, 0, -1] }\n[[pair]]\nname = \"joint\"";
        let side = format!("b = {{ rigid = \"floor\", texture = {texture} }}");
        told(&[
            ["[[pair]]\nname = \"joint\"", floor],
            ["b = { body = \"upper\", facets = \"zmin\" }", &side],
            [r#"friction = { law = "coulomb", mu = 0.4 }"#, law],
        ])
    };
    let found = with("{ uniform = [0, 0, 1] }").expect("a fault");
    assert!(
        found.contains("it is normal to the surface there"),
        "{found}"
    );
    let circles = "{ circumferential = { point = [10, 10, 0], direction = [0, 0, 1] } }";
    let found = with(circles).expect("a fault");
    for words in [
        "deck.toml:21:34: pair `joint`: the texture of rigid surface `floor` has no direction at node ",
        "of body `lower`, (10, 10, 10): its axis passes through that node",
    ] {
        assert!(found.contains(words), "{found}");
    }
    assert_eq!(with(&circles.replace("[10, 10, 0]", "[12, 12.5, 0]")), None);
}
