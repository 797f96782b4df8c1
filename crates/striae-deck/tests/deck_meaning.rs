//! Faults found while a deck is lowered: what it says is well formed but not possible.
//!
//! Longer than other files, as it is a table of decks and the exact messages they get.

mod deck;

use deck::{faulty, misread, misstated};

#[test]
fn constants() {
    misstated(
        "bulk modulus that is negative",
        &[(
            "youngs_modulus = 1e6\npoissons_ratio = 0.3",
            "lambda = -1\nshear_modulus = 1",
        )],
        &[
            "5:10: the material is not admissible: `lambda` = -1 and `shear_modulus` = 1 give a bulk modulus that is not positive",
        ],
    );
    for (what, law, expected) in [
        (
            "rubber without shear modulus",
            "law = \"mooney-rivlin\"\nc10 = 0.1\nc01 = -0.2\npoissons_ratio = 0.49",
            "2:1: the material is not admissible: the constants give the shear modulus -0.2 at rest, but it must be positive",
        ),
        (
            "rubber without terms",
            "law = \"ogden\"\nterms = []\nbulk_modulus = 10",
            "5:9: the material is not admissible: the law has no term, but it needs at least one",
        ),
        (
            "an exponent of zero",
            "law = \"ogden\"\nterms = [{ mu = 1, alpha = 2 }, { mu = 1, alpha = 0 }]\nbulk_modulus = 10",
            "5:9: the material is not admissible: `alpha` of term 1 is 0, but it must be positive or negative",
        ),
        (
            "branches that are none",
            "law = \"gent\"\nshear_modulus = 1\nlimit = 30\nbulk_modulus = 10\nrelaxation = []",
            "8:14: the material is not admissible: there is no branch, but at least one is needed",
        ),
        (
            "saturation below the yield stress",
            "law = \"elastic-plastic\"\nyoungs_modulus = 1\npoissons_ratio = 0.3\nyield_stress = 2\nsaturation = { stress = 1, rate = 1 }",
            "8:14: the material is not admissible: the saturation stress is 1, but it must be at least `yield_stress`, 2",
        ),
        (
            "a table of hardening that falls",
            "law = \"elastic-plastic\"\nyoungs_modulus = 1\npoissons_ratio = 0.3\nyield_table = [[0, 2], [0.1, 1]]",
            "7:15: the material is not admissible: pair 1 of the table: its plastic strain must be larger than the previous one, its stress positive and not smaller than the previous one",
        ),
    ] {
        let base = "law = \"neo-hookean\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3";
        misstated(what, &[(base, law)], &[expected]);
    }
    misstated(
        "friction that creates energy",
        &[(
            r#"law = "coulomb", mu = 0.3"#,
            r#"law = "two-textures", mu = 0.3, c_mag = 0, c_ang = -1, c_cen = 0"#,
        )],
        &[
            "22:12: this friction is not admissible: friction would create energy: textures with a_a . a_b' = I0 = 1.000000 and slip with a_ba . d = I1 = 2.000000 give a dissipation -tau . d / varpi = -7.000000",
        ],
    );
    misstated(
        "tabulated friction with an angle said twice around",
        &[(
            r#"law = "coulomb", mu = 0.3"#,
            r#"law = "tabulated", angles = [0, 90, 270, 360], mu = [0.3, 0.2, 0.2, 0.3]"#,
        )],
        &[
            "22:12: this friction is not admissible: angles from 0.000 to 360.000 degrees are refused: they must span less than a turn, after which the table repeats",
        ],
    );
    misstated(
        "tabulated friction with angles out of order",
        &[(
            r#"law = "coulomb", mu = 0.3"#,
            r#"law = "tabulated", angles = [0, 180, 90], mu = [0.3, 0.2, 0.2]"#,
        )],
        &[
            "22:12: this friction is not admissible: the angle 90.000 degrees after 180.000 degrees is refused: the angles of a table must ascend",
        ],
    );
    let dependences = [
        (
            "a logarithm that lets friction vanish",
            r#"by_slip_rate = { form = "logarithm", factor = -0.5, slip_rate = 1 }"#,
            "22:56: this friction is not admissible: factor = -0.5 lets friction vanish at the slip rate 6.389056: a factor below zero needs a limit below that rate, from which on friction is constant",
        ),
        (
            "a table by pressure that does not ascend",
            r#"by_pressure = { form = "table", pressures = [0, 2, 2], factors = [1, 1, 1] }"#,
            "22:55: this friction is not admissible: pressures: 2 after 2 is refused: they must ascend",
        ),
        (
            "a table by slip rate with a factor too few",
            r#"by_slip_rate = { form = "table", slip_rates = [0, 2], factors = [1] }"#,
            "22:56: this friction is not admissible: the table has slip_rates: 2, but factors: 1; it needs equally many of both, at least two",
        ),
        (
            "a decay in two places",
            r#"decay = { kinetic_over_static = 0.5, slip_rate = 1 }, by_slip_rate = { form = "stribeck", kinetic_over_static = 0.5, slip_rate = 1 }"#,
            "22:110: this friction is not admissible: it has both `decay` and `by_slip_rate`; give one of them; a decay with more constants is `by_slip_rate = { form = \"stribeck\", .. }`",
        ),
        (
            "a decay and a state",
            r#"decay = { kinetic_over_static = 0.5, slip_rate = 1 }, by_state = { form = "ageing-law", direct_effect = 0.01, evolution_effect = 0.015, slip_rate = 1, slip_distance = 1 }"#,
            "22:106: this friction is not admissible: it has both `decay` and `by_state`, which both say how friction goes with the slip rate; give one of them",
        ),
    ];
    for (what, keys, expected) in dependences {
        let friction = format!(r#"law = "coulomb", mu = 0.3, {keys}"#);
        misstated(
            what,
            &[(r#"law = "coulomb", mu = 0.3"#, &friction)],
            &[expected],
        );
    }
    misread(
        "friction by state without a direct effect",
        &[(
            r#"law = "coulomb", mu = 0.3"#,
            r#"law = "coulomb", mu = 0.3, by_state = { form = "slip-law", direct_effect = 0, evolution_effect = 0.015, slip_rate = 1, slip_distance = 1 }"#,
        )],
        &[
            "22:89: `direct_effect` in [[pair]] friction by_state must be a number greater than 0, but is 0",
        ],
    );
    misstated(
        "an axis of no length",
        &[(
            r#"generator = "block", size = [1, 1, 0.5], divisions = [4, 4, 2]"#,
            r#"generator = "torus", axis = [0, 0, 0], ring_radius = 4, section_radius = 1, divisions = [1, 1, 3]"#,
        )],
        &["10:38: `axis` in [[body]] mesh must not be the zero vector"],
    );
    misstated(
        "normal of no length",
        &[("normal = [0, 0, 1]", "normal = [0, 0, 0]")],
        &["17:39: the normal of a plane must not be the zero vector"],
    );
}

/// Right-angled, with legs of length 1.
const TETRAHEDRON: &str = "mesh = { positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], facets = [[1, 2, 3, 3], [0, 2, 1, 1], [0, 1, 3, 3], [0, 3, 2, 2]] }";

#[test]
fn rigid_bodies() {
    let floor = "plane = { point = [0, 0, 0], normal = [0, 0, 1] }";
    let tied = r#"tied = [{ body = "upper", nodes = "zmax" }]"#;
    misstated(
        "mass without inertia",
        &[(
            floor,
            "plane = { point = [0, 0, 0], normal = [0, 0, 1] }\nmass = 2",
        )],
        &[
            "15:1: rigid body `floor` needs both `mass` and `inertia`, none of whose three moments exceeds the sum of the others, or `density` alone",
        ],
    );
    misstated(
        "moments that no body has",
        &[(
            floor,
            "plane = { point = [0, 0, 0], normal = [0, 0, 1] }\nmass = 2\ninertia = [1, 1, 3]",
        )],
        &[
            "15:1: rigid body `floor` needs both `mass` and `inertia`, none of whose three moments exceeds the sum of the others, or `density` alone",
        ],
    );
    misstated(
        "density and mass",
        &[(floor, &format!("{TETRAHEDRON}\ndensity = 2\nmass = 2"))],
        &[
            "15:1: rigid body `floor` needs both `mass` and `inertia`, none of whose three moments exceeds the sum of the others, or `density` alone",
        ],
    );
    misstated(
        "density of a plane",
        &[(floor, &format!("{floor}\ndensity = 2"))],
        &[
            "18:11: the inertia of rigid body `floor` cannot be computed from its density: only a `mesh` encloses a volume",
        ],
    );
    misstated(
        "density of an open surface",
        &[(
            floor,
            &format!("{}\ndensity = 2", TETRAHEDRON.replace("[1, 2, 3, 3], ", "")),
        )],
        &[
            "18:11: the inertia of rigid body `floor` cannot be computed from its density: the surface is not closed at the edge from node 2 to node 1; every edge must belong to two facets",
        ],
    );
    misstated(
        "free rigid body that nothing is tied to",
        &[(
            r#"{ surface = "floor", displacement = [0, 0, 0.1] }"#,
            r#"{ surface = "floor", free = ["z"] }"#,
        )],
        &[
            "36:1: step `slide` frees coordinates of rigid body `floor`; only bodies that nodes are tied to, that have a mass, that springs hold or that are a side of a pair can be free",
        ],
    );
    misstated(
        "tied nodes that are prescribed",
        &[(floor, tied)],
        &[
            "26:1: step `press` prescribes node 32 of body `upper`, which is tied to a rigid body; move the rigid body instead",
        ],
    );
    misstated(
        "nodes that are tied twice",
        &[(
            floor,
            r#"tied = [{ body = "upper", nodes = "xmax" }]

[[rigid]]
name = "clamp"
tied = [{ body = "upper", nodes = "ymax" }]"#,
        )],
        &[
            "19:1: rigid bodies `floor` and `clamp` are both tied to node 15 of body `upper`; a node follows one of them: take it out of the set of the other",
            "30:1: step `press` prescribes node 35 of body `upper`, which is tied to a rigid body; move the rigid body instead",
        ],
    );
    misstated(
        "side without a surface",
        &[
            (floor, r#"tied = [{ body = "upper", nodes = "xmax" }]"#),
            (
                r#"a = { body = "lower", facets = "zmax" }"#,
                r#"a = { rigid = "floor" }"#,
            ),
        ],
        &[
            "20:15: rigid body `floor` has no surface to touch; give it a `plane` or a `mesh`",
            "26:1: step `press` prescribes node 35 of body `upper`, which is tied to a rigid body; move the rigid body instead",
        ],
    );
}

#[test]
fn inertia() {
    misstated(
        "velocity without inertia",
        &[(
            "duration = 2.0\n",
            "duration = 2.0\nvelocity = [{ body = \"upper\", vector = [1, 0, 0] }]\n",
        )],
        &[
            "29:13: step `press` states a velocity but has no inertia; give it `dynamics = {}` or remove the velocity",
        ],
    );
    misstated(
        "inertia and gravity without density",
        &[
            ("duration = 2.0\n", "duration = 2.0\ndynamics = {}\n"),
            (
                "name = \"slide\"",
                "name = \"slide\"\ngravity = { vector = [0, 0, -9.81] }",
            ),
        ],
        &[
            "26:1: body `lower` has inertia or weight in step `press`, but its material has no `density`; give it one",
            "26:1: body `upper` has inertia or weight in step `press`, but its material has no `density`; give it one",
        ],
    );
    misstated(
        "two velocities of a body",
        &[
            (
                "youngs_modulus = 1e6",
                "density = 1000\nyoungs_modulus = 1e6",
            ),
            (
                "duration = 2.0\n",
                "duration = 2.0\ndynamics = {}\nvelocity = [{ body = \"upper\", vector = [1, 0, 0] }, { body = \"upper\", spin = [1, 0, 0] }]\n",
            ),
        ],
        &["31:53: step `press` states the velocity of body `upper` twice"],
    );
}

#[test]
fn meshes() {
    misstated(
        "mesh file of unknown kind",
        &[(
            r#"{ generator = "block", size = [1, 1, 0.5], divisions = [4, 4, 2] }"#,
            r#"{ file = "part.docx" }"#,
        )],
        &[
            "10:8: the mesh of body `lower` cannot be made: part.docx: unknown kind of file; expected .msh (Gmsh), .inp (Abaqus), .vtu or .vtk (VTK)",
        ],
    );
    misstated(
        "mesh too large",
        &[("divisions = [4, 4, 2]", "divisions = [4000, 4000, 2000]")],
        &[
            "10:8: the mesh of body `lower` cannot be made: the mesh would have 32000000000 elements, but the limit is 20000000",
        ],
    );
    misstated(
        "mesh too large once its hexahedra are divided",
        &[(
            "divisions = [4, 4, 2]",
            "divisions = [150, 150, 150], cells = \"tetrahedra\"",
        )],
        &[
            "10:8: the mesh of body `lower` cannot be made: the mesh would have 20250000 elements, but the limit is 20000000",
        ],
    );
    misstated(
        "lengths of which volumes are no numbers",
        &[(
            "size = [1, 1, 0.5], divisions = [4, 4, 2]",
            "size = [1e300, 1, 0.5], divisions = [4, 4, 2]",
        )],
        &[
            "10:39: an element of `size` in [[body]] mesh must be from 1e-50 to 1e50, but is 1e300; check its unit and its exponent",
        ],
    );
    misstated(
        "sides that cross",
        &[(
            "divisions = [4, 4, 2]",
            "divisions = [4, 4, 2], top_slopes = [-2, 0]",
        )],
        &[
            "10:8: the mesh of body `lower` cannot be made: height of the lowest column between the oblique sides is -0.5, but it must be positive",
        ],
    );
    misstated(
        "lengths that do not fit the divisions",
        &[(
            "divisions = [4, 4, 2]",
            "divisions = [4, 4, 2], grading = { z = { lengths = [1, 2, 3] } }",
        )],
        &[
            "10:8: the mesh of body `lower` cannot be made: 3 interval lengths are given for 2 divisions",
        ],
    );
    misstated(
        "facet with a node that is not there",
        &[(
            "plane = { point = [0, 0, 0], normal = [0, 0, 1] }",
            "mesh = { positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], facets = [[0, 1, 2, 2], [0, 1, 3, 3]] }",
        )],
        &[
            "17:81: facet 1 of rigid surface `floor` refers to node 3, but there are 3 nodes counted from 0",
        ],
    );
}

#[test]
fn increments() {
    for stated in ["{ initial = 1e-18, largest = 1e-18 }", "20000000"] {
        misstated(
            "more increments than any run makes",
            &[("{ initial = 0.1, smallest = 1e-3, largest = 0.2 }", stated)],
            &["29:14: step `press` would have more than 1e7 increments; take fewer or larger ones"],
        );
    }
}

#[test]
fn names() {
    misstated(
        "two bodies of one name",
        &[(r#"name = "upper""#, r#"name = "lower""#)],
        &[
            "12:8: body `lower` is already defined in line 8",
            "21:14: no body is named `upper`; there is `lower`",
            "32:12: no body is named `upper`; there is `lower`",
            "34:22: no body is named `upper`; there is `lower`",
            "38:21: no body is named `upper`; there is `lower`",
        ],
    );
    misstated(
        "two steps of one name",
        &[(r#"name = "slide""#, r#"name = "press""#)],
        &["37:8: step `press` is already defined in line 27"],
    );
    for told in ["pre\\nss", "\\tpress", "press\\u0000"] {
        let found = format!(
            "`name` in [[step]] must be one line of printable characters, but is the text \"{told}\""
        );
        misstated(
            "a name with control characters",
            &[("name = \"press\"", &format!("name = \"{told}\""))],
            &[&format!("27:8: {}", found.replace("u0000", "0"))],
        );
    }
    misstated(
        "unknown material",
        &[(
            r#"name = "upper"
material = "rubber""#,
            r#"name = "upper"
material = "ruber""#,
        )],
        &["13:12: no material is named `ruber`; there is `rubber`; did you mean `rubber`?"],
    );
    misstated(
        "unknown body",
        &[(r#"a = { body = "lower""#, r#"a = { body = "lowr""#)],
        &["20:14: no body is named `lowr`; there are `lower`, `upper`; did you mean `lower`?"],
    );
    misstated(
        "unknown rigid surface",
        &[(
            r#"b = { body = "upper", facets = "zmin" }"#,
            r#"b = { rigid = "flor" }"#,
        )],
        &["21:15: no rigid surface is named `flor`; there is `floor`; did you mean `floor`?"],
    );
    misstated(
        "unknown pair",
        &[(r#"pair = "interface""#, r#"pair = "inteface""#)],
        &["40:22: no pair is named `inteface`; there is `interface`; did you mean `interface`?"],
    );
    misstated(
        "unknown curve",
        &[(r#"curve = "there-and-back""#, r#"curve = "there-and-bak""#)],
        &[
            "32:56: no curve is named `there-and-bak`; there are `ramp`, `constant`, `smooth`, `there-and-back`; did you mean `there-and-back`?",
        ],
    );
    misstated(
        "unknown facet set",
        &[(r#"facets = "zmin""#, r#"facets = "zmn""#)],
        &[
            "21:32: body `upper` has no facet set `zmn`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`; did you mean `zmin`?",
        ],
    );
    misstated(
        "unknown node set",
        &[(r#"nodes = "zmin""#, r#"nodes = "bottom""#)],
        &[
            "31:29: body `lower` has no node set `bottom`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`",
        ],
    );
    faulty(
        "no body",
        "title = \"Nothing\"\n[[step]]\nname = \"wait\"\n",
        &["1:1: the deck has no [[body]]; there is nothing to simulate"],
    );
    faulty(
        "no step",
        "title = \"t\"\n[[material]]\nname = \"m\"\nlaw = \"linear-elastic\"\nlambda = 1\nshear_modulus = 1\n[[body]]\nname = \"b\"\nmaterial = \"m\"\nmesh = { generator = \"block\", size = [1, 1, 1], divisions = [1, 1, 1] }\n",
        &["1:1: the deck has no [[step]]; there is nothing to do"],
    );
}

#[test]
fn pairs() {
    misstated(
        "rigid surface against rigid surface",
        &[(
            r#"a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }"#,
            r#"a = { rigid = "floor" }
b = { rigid = "floor" }"#,
        )],
        &["18:1: pair `interface` joins two rigid surfaces; at least one side must be a body"],
    );
    misstated(
        "facets on both sides",
        &[(
            r#"b = { body = "upper", facets = "zmin" }"#,
            r#"b = { body = "lower", facets = "all" }"#,
        )],
        &[
            "18:1: pair `interface` has 16 facets of body `lower` on both sides; give its sides facets of their own, or set `b = \"itself\"` if facets of `a` may touch each other",
        ],
    );
    misstated(
        "the same pair twice",
        &[(
            "[[curve]]",
            r#"[[pair]]
name = "again"
a = { body = "upper", facets = "zmin" }
b = { body = "lower", facets = "zmax" }
[[curve]]"#,
        )],
        &["23:1: pair `again` joins the same two surfaces as pair `interface`"],
    );
}

#[test]
fn curves() {
    misstated(
        "curve with a built-in name",
        &[
            (r#"name = "there-and-back""#, r#"name = "smooth""#),
            (r#"curve = "there-and-back""#, r#"curve = "smooth""#),
        ],
        &["24:8: `smooth` is a built-in curve; give this one another name"],
    );
    misstated(
        "curve with one point",
        &[("[[0, 0], [0.5, 1], [1, 0]]", "[[0, 0]]")],
        &[
            "25:10: the first numbers of the points of curve `there-and-back` must ascend from 0 to 1, but there are only 1",
        ],
    );
    misstated(
        "curve that starts late",
        &[("[[0, 0], [0.5, 1], [1, 0]]", "[[0.1, 0], [1, 0]]")],
        &[
            "25:10: the first numbers of the points of curve `there-and-back` must ascend from 0 to 1, but start at 0.1",
        ],
    );
    misstated(
        "curve that ends early",
        &[("[[0, 0], [0.5, 1], [1, 0]]", "[[0, 0], [0.9, 0]]")],
        &[
            "25:10: the first numbers of the points of curve `there-and-back` must ascend from 0 to 1, but end at 0.9",
        ],
    );
    misstated(
        "curve that turns back",
        &[(
            "[[0, 0], [0.5, 1], [1, 0]]",
            "[[0, 0], [0.5, 1], [0.5, 2], [1, 0]]",
        )],
        &[
            "25:10: the first numbers of the points of curve `there-and-back` must ascend from 0 to 1, but 0.5 is followed by 0.5",
        ],
    );
}

#[test]
fn conditions() {
    misstated(
        "smallest increment above the largest",
        &[("smallest = 1e-3", "smallest = 0.5")],
        &[
            "29:14: increments of step `press` must satisfy smallest <= initial <= largest, but 0.5, 0.1, 0.2 do not",
        ],
    );
    misstated(
        "condition without a component",
        &[(
            r#"z = -0.02, curve = "there-and-back""#,
            r#"curve = "there-and-back""#,
        )],
        &[
            "32:3: the displacement of `zmax` of body `upper` prescribes nothing; give at least one of `x`, `y`, `z`",
        ],
    );
    misstated(
        "component prescribed twice",
        &[(
            r#"curve = "there-and-back" },"#,
            r#"curve = "there-and-back" },
  { body = "upper", nodes = "all", z = 0.5, curve = "there-and-back" },"#,
        )],
        &[
            "33:3: step `press` prescribes component `z` of node 32 of body `upper` twice: -0.02 by `zmax`, 0.5 by `all`",
        ],
    );
    misstated(
        "component prescribed along two curves",
        &[(
            r#"curve = "there-and-back" },"#,
            r#"curve = "there-and-back" },
  { body = "upper", nodes = "xmax", z = -0.02, curve = "smooth" },"#,
        )],
        &[
            "33:3: step `press` prescribes component `z` of node 35 of body `upper` twice: -0.02 along a curve by `zmax`, -0.02 along `smooth` by `xmax`",
        ],
    );
    misstated(
        "release of what is free",
        &[(r#"components = ["z"]"#, r#"components = ["x"]"#)],
        &[
            "38:12: step `slide` releases component `x` of `zmax` of body `upper`, which is not prescribed",
        ],
    );
    misstated(
        "release of nothing",
        &[(r#"nodes = "zmax", components = ["z"]"#, r#"nodes = "zmin""#)],
        &[
            "38:12: step `slide` releases all components of `zmin` of body `upper`, which is not prescribed",
        ],
    );
    misstated(
        "the same load twice",
        &[(
            r#"value = 3, extent = "exposed" }"#,
            r#"value = 3, extent = "exposed" }, { body = "lower", facets = "xmin", value = 4 }"#,
        )],
        &["35:81: step `press` states the pressure on `xmin` of body `lower` twice"],
    );
    misstated(
        "the same rigid motion twice",
        &[(
            "displacement = [0, 0, 0.1] }",
            r#"displacement = [0, 0, 0.1] }, { surface = "floor", displacement = [0, 0, 1] }"#,
        )],
        &["39:61: step `slide` states the motion of rigid body `floor` twice"],
    );
    misstated(
        "the same friction twice",
        &[(
            r#"law = "frictionless" }"#,
            r#"law = "frictionless" }, { pair = "interface", law = "coulomb", mu = 1 }"#,
        )],
        &["40:59: step `slide` states the friction of pair `interface` twice"],
    );
    misstated(
        "a body that nothing holds",
        &[
            (
                r#"a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }"#,
                r#"a = { body = "lower", facets = "zmax" }
b = { rigid = "floor" }"#,
            ),
            (r#", z = -0.02, curve = "there-and-back""#, ", z = -0.02"),
            (
                r#"  { body = "upper", nodes = "zmax", z = -0.02 },
"#,
                "",
            ),
            (
                r#"release = [{ body = "upper", nodes = "zmax", components = ["z"] }]
"#,
                "",
            ),
        ],
        &[
            "26:1: body `upper` is in no contact pair and nothing restrains it in step `press`; prescribe displacements that restrain it",
        ],
    );
    misstated(
        "a body that can still slide",
        &[(
            r#"a = { body = "lower", facets = "zmax" }
b = { body = "upper", facets = "zmin" }"#,
            r#"a = { body = "lower", facets = "zmax" }
b = { rigid = "floor" }"#,
        )],
        &[
            "26:1: body `upper` is in no contact pair and 3 of its rigid motions are free in step `press`; prescribe displacements that restrain it",
        ],
    );
}

#[test]
fn textures() {
    misstated(
        "friction without a texture it needs",
        &[
            (
                r#"law = "coulomb", mu = 0.3"#,
                r#"law = "two-textures", mu = 0.3, c_mag = 0.1, c_ang = 0.1, c_cen = 0.5"#,
            ),
            (
                r#"a = { body = "lower", facets = "zmax" }"#,
                r#"a = { body = "lower", facets = "zmax", texture = { uniform = [1, 0, 0] } }"#,
            ),
        ],
        &[
            "22:12: the friction of pair `interface` needs a texture on both sides; sides that have one: 1; give a side its direction, such as `texture = { uniform = [1, 0, 0] }`",
        ],
    );
    misstated(
        "friction with one texture too many",
        &[
            (
                r#"law = "coulomb", mu = 0.3"#,
                r#"law = "nap", mu_forward = 0.2, mu_backward = 0.3, mu_lateral = 0.25"#,
            ),
            (
                r#"a = { body = "lower", facets = "zmax" }"#,
                r#"a = { body = "lower", facets = "zmax", texture = { uniform = [1, 0, 0] } }"#,
            ),
            (
                r#"b = { body = "upper", facets = "zmin" }"#,
                r#"b = { body = "upper", facets = "zmin", texture = { axial = { direction = [1, 0, 0] } } }"#,
            ),
        ],
        &[
            "22:12: the friction of pair `interface` needs a texture on one side; sides that have one: 2; leave one of them out",
        ],
    );
    misstated(
        "later friction without a texture it needs",
        &[(
            r#"law = "frictionless""#,
            r#"law = "tabulated", angles = [0, 120, 240], mu = [0.1, 0.2, 0.3]"#,
        )],
        &[
            "40:13: the friction of pair `interface` needs a texture on one side; sides that have one: 0; give a side its direction, such as `texture = { uniform = [1, 0, 0] }`",
        ],
    );
    misstated(
        "texture of no direction",
        &[(
            r#"a = { body = "lower", facets = "zmax" }"#,
            r#"a = { body = "lower", facets = "zmax", texture = { uniform = [0, 0, 0] } }"#,
        )],
        &["20:62: `uniform` in [[pair]] a texture must not be the zero vector"],
    );
    misstated(
        "texture about an axis of no direction",
        &[(
            r#"a = { body = "lower", facets = "zmax" }"#,
            r#"a = { body = "lower", facets = "zmax", texture = { radial = { direction = [0, 0, 0] } } }"#,
        )],
        &["20:75: `direction` in [[pair]] a texture radial must not be the zero vector"],
    );
    misstated(
        "texture at points of a plane",
        &[(
            r#"b = { body = "upper", facets = "zmin" }"#,
            r#"b = { rigid = "floor", texture = { points = [{ at = [0, 0, 0], direction = [1, 0, 0] }] } }"#,
        )],
        &[
            "21:34: rigid surface `floor` is a plane and has no nodes, so its texture cannot be given at points or nodes",
            "26:1: body `upper` is in no contact pair and 3 of its rigid motions are free in step `press`; prescribe displacements that restrain it",
        ],
    );
}

#[test]
fn sets() {
    misstated(
        "node set with the name of another",
        &[(
            "divisions = [4, 4, 2] }",
            r#"divisions = [4, 4, 2] }
node_sets = [{ name = "zmin", nearest = [0, 0, 0] }]"#,
        )],
        &["11:23: body `lower` already has a node set `zmin`"],
    );
    misstated(
        "node set of an unknown set",
        &[(
            "divisions = [4, 4, 2] }",
            r#"divisions = [4, 4, 2] }
node_sets = [{ name = "edge", common = ["xmin", "zmn"] }]"#,
        )],
        &[
            "11:49: body `lower` has no node set `zmn`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`; did you mean `zmin`?",
        ],
    );
    misstated(
        "node set without members",
        &[(
            "divisions = [4, 4, 2] }",
            r#"divisions = [4, 4, 2] }
node_sets = [{ name = "edge", common = ["xmin", "xmax"] }]"#,
        )],
        &["11:23: node set `edge` of body `lower` is empty"],
    );
    misstated(
        "facet set without members",
        &[(
            "divisions = [4, 4, 2] }",
            r#"divisions = [4, 4, 2] }
facet_sets = [{ name = "strip", of = "zmax", from = [0, 0, 0], to = [1, 1, 0.4] }]"#,
        )],
        &[
            "11:24: facet set `strip` of body `lower` is empty: the body extends from (0, 0, 0) to (1, 1, 0.5)",
        ],
    );
}

#[test]
fn sets_that_nothing_is_in() {
    for (sets, message) in [
        (
            r#"node_sets = [{ name = "s", sphere = { centre = [9, 0, 0], radius = 1 } }]"#,
            "11:23: node set `s` of body `lower` is empty: the body extends from (0, 0, 0) to (1, 1, 0.5)",
        ),
        (
            r#"node_sets = [{ name = "s", from = [0, 0.5, 0], to = [1, 0.25, 1] }]"#,
            "11:53: coordinate 2 of `to` must be at least 0.5, that of `from`, but is 0.25",
        ),
        (
            r#"node_sets = [{ name = "s", half_space = { point = [9, 0, 0], normal = [0, 0, 0] } }]"#,
            "11:71: the normal of a half space must not be the zero vector",
        ),
        (
            r#"node_sets = [{ name = "s", elements = "core" }]"#,
            "11:39: body `lower` has no element set `core`; it has `all`",
        ),
        (
            r#"node_sets = [{ name = "a", facets = "b" }]
facet_sets = [{ name = "b", nodes = "a" }, { name = "c", union = ["b"] }]"#,
            "12:24: facet set `b` of body `lower` is made from itself over node set `a`; start from a set of the mesh, a region or numbers",
        ),
        (
            r#"element_sets = [{ name = "a", union = ["all", "a"] }]"#,
            "11:26: element set `a` of body `lower` is made from itself; start from a set of the mesh, a region or numbers",
        ),
        (
            r#"node_sets = [{ name = "b", facets = "s" }]
facet_sets = [{ name = "s", direction = [1, 1, 0], angle = 20 }]"#,
            "12:24: facet set `s` of body `lower` is empty: the least angle of a facet is 45.0000 degrees",
        ),
        (
            r#"facet_sets = [{ name = "s", direction = [0, 0, 0], angle = 20 }]"#,
            "11:41: the direction of facets must not be the zero vector",
        ),
        (
            r#"facet_sets = [{ name = "s", of = "up", around = [0, 0, 0], feature_angle = 20 }]"#,
            "11:34: body `lower` has no facet set `up`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`",
        ),
        (
            r#"node_sets = [{ name = "pin", nearest = [0, 0, 0] }]
facet_sets = [{ name = "s", nodes = "pin" }]"#,
            "12:24: facet set `s` of body `lower` is empty: no facet has all its corners in node set `pin`",
        ),
        (
            r#"element_sets = [{ name = "s", nodes = "zmin" }]"#,
            "11:26: element set `s` of body `lower` is empty: no element has all its corners in node set `zmin`",
        ),
        (
            r#"element_sets = [{ name = "s", numbers = [32] }]"#,
            "11:41: the mesh of body `lower` cannot be made: there is no element 32: it has elements: 32, from 0",
        ),
        (
            r#"element_sets = [{ name = "s", numbers = [3] }, { name = "s", numbers = [4] }]"#,
            "11:57: body `lower` already has an element set `s`",
        ),
    ] {
        let sets = format!("divisions = [4, 4, 2] }}\n{sets}");
        misstated("set", &[("divisions = [4, 4, 2] }", &sets)], &[message]);
    }
}

#[test]
fn triangles_where_four_corners_are_needed() {
    let tetrahedra = "divisions = [4, 4, 2], cells = \"tetrahedra\" }";
    misstated(
        "collocated contact of triangles",
        &[
            ("divisions = [4, 4, 2] }", tetrahedra),
            (
                r#"law = "coulomb", mu = 0.3 }"#,
                "law = \"coulomb\", mu = 0.3 }\nenforcement = \"collocated\"",
            ),
        ],
        &[
            "18:1: collocated contact in pair `interface` needs facets with four corners, and body `lower` has triangles there; mesh it with hexahedra, wedges or pyramids that show quadrilaterals",
        ],
    );
}
