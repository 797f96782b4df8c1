//! Friction where displacements or other pairs hold nodes in tangential directions: planes of
//! symmetry and corners.
//!
//! Longer than other files, as the decks stand beside what is asked of them.

use std::path::Path;

use striae_contact::{evaluation::Evaluation, side::Side, unknowns::Status};
use striae_deck::parse;
use striae_mesh::Vec3;
use striae_solve::{
    drive::{Continue, Observer, Progress, run},
    newton::{Increment, IterationObserver},
    norms::Norms,
    outcome::{CutBack, Ending},
    problem::Problem,
    report::pairs,
    state::State,
};

/// Forces on the sides `a` of all pairs in every converged state, and the last state.
struct Forces<'a>(&'a Problem, Vec<Vec<Vec3>>, Option<State>);

impl IterationObserver for Forces<'_> {
    fn iteration(&mut self, _: usize, _: &Norms, _: &[Evaluation]) {}
}

impl Observer for Forces<'_> {
    fn step(&mut self, _: usize, _: &str) {}

    fn increment(&mut self, _: Progress, increment: &Increment) -> Continue {
        let pairs = pairs(self.0, &increment.state);
        let force = |pair: &striae_solve::report::PairReport| pair.sides[Side::A].force;
        self.1.push(pairs.iter().map(force).collect());
        self.2 = Some(increment.state.clone());
        Continue::Yes
    }

    fn cut_back(&mut self, _: Progress, _: &CutBack) -> Continue {
        panic!("an increment was cut")
    }
}

fn forces(deck: &str) -> Vec<Vec<Vec3>> {
    solved(deck).0
}

/// Forces in every converged state, and the last one.
fn solved(deck: &str) -> (Vec<Vec<Vec3>>, State) {
    let model = parse(deck, "deck.toml", Path::new("")).unwrap().model;
    let problem = Problem::new(model).unwrap();
    let mut forces = Forces(&problem, Vec::new(), None);
    let (_, ending) = run(&problem, State::undeformed(&problem), &mut forces);
    assert_eq!(ending, Ending::Completed);
    (forces.1, forces.2.unwrap())
}

/// A block on another one; of a half model the part `y > 0` with its plane of symmetry.
fn blocks(is_half: bool, law: &str) -> String {
    let (origin, width, divisions) = match is_half {
        true => (0.0, 0.5, 2),
        false => (-0.5, 1.0, 4),
    };
    let symmetry = match is_half {
        true => {
            r#", { body = "lower", nodes = "ymin", y = 0 }, { body = "upper", nodes = "ymin", y = 0 }"#
        }
        false => "",
    };
    format!(
        r#"
title = "block on block"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1e6
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "rubber"
mesh = {{ generator = "block", origin = [0, {origin}, 0], size = [1, {width}, 0.5], divisions = [4, {divisions}, 1] }}
[[body]]
name = "upper"
material = "rubber"
mesh = {{ generator = "block", origin = [0.25, {origin}, 0.5], size = [0.5, {width}, 0.5], divisions = [3, {divisions}, 1] }}
node_sets = [{{ name = "every", from = [-9, -9, -9], to = [9, 9, 9] }}]
[[pair]]
name = "contact"
a = {{ body = "lower", facets = "zmax" }}
b = {{ body = "upper", facets = "zmin" }}
friction = {law}
[[step]]
name = "press"
increments = 1
displacement = [
    {{ body = "lower", nodes = "zmin", x = 0, y = 0, z = 0 }},
    {{ body = "upper", nodes = "zmax", x = 0, y = 0, z = -0.02 }}{symmetry}
]
[[step]]
name = "slide"
increments = 4
displacement = [{{ body = "upper", nodes = "zmax", x = 0.1 }}]
"#
    )
}

/// Half of a symmetric model, with the grid lines of both sides in the plane of symmetry, has
/// half of the forces, for laws that are symmetric to that plane.
#[test]
fn half_a_model_has_half_the_force() {
    for law in [
        r#"{ law = "coulomb", mu = 0.3 }"#,
        r#"{ law = "coulomb", mu = 0.3, shear_cap = 1e3 }"#,
        r#"{ law = "frictionless" }"#,
        r#"{ law = "coulomb", mu = 0.3, by_state = { form = "ageing-law", direct_effect = 0.01, evolution_effect = 0.008, slip_rate = 0.1, slip_distance = 0.1 } }"#,
    ] {
        let (whole, half) = (forces(&blocks(false, law)), forces(&blocks(true, law)));
        assert_eq!(whole.len(), half.len());
        let scale = whole[4][0].norm();
        for (whole, half) in whole.iter().zip(&half) {
            let difference = half[0] * 2.0 - whole[0];
            let off = difference.x.hypot(difference.z) / scale;
            assert!(off < 2e-3, "{law}: {off:e}");
        }
    }
}

/// A block in the corner of two rigid planes, or of one rigid surface of two facets, that is
/// pressed into it and drawn along it.
fn corner(is_one_surface: bool, y_held: &str) -> String {
    let (rigid, pairs) = match is_one_surface {
        true => (
            r#"
[[rigid]]
name = "ell"
mesh = { positions = [[0,-1,0],[3,-1,0],[3,3,0],[0,3,0],[0,-1,3],[0,3,3]], facets = [[0,1,2,3],[0,3,5,4]] }
"#,
            r#"
[[pair]]
name = "both"
a = { body = "block", facets = "both" }
b = { rigid = "ell" }
friction = { law = "coulomb", mu = 0.3 }
"#,
        ),
        false => (
            r#"
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[rigid]]
name = "wall"
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
"#,
            r#"
[[pair]]
name = "down"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.3 }
[[pair]]
name = "aside"
a = { body = "block", facets = "xmin" }
b = { rigid = "wall" }
friction = { law = "coulomb", mu = 0.3 }
"#,
        ),
    };
    format!(
        r#"
title = "corner"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0.3
[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [2, 2, 2] }}
facet_sets = [{{ name = "both", union = ["zmin", "xmin"] }}]
{rigid}{pairs}
[[step]]
name = "press"
increments = 5
displacement = [
    {{ body = "block", nodes = "zmax", z = -0.02 }},
    {{ body = "block", nodes = "xmax", x = -0.01 }},
    {{ body = "block", nodes = "{y_held}", y = 0 }},
]
[[step]]
name = "draw"
increments = 5
displacement = [
    {{ body = "block", nodes = "zmax", y = 0.5 }},
    {{ body = "block", nodes = "xmax", y = 0.5 }},
]
"#
    )
}

/// Friction along the edge of a corner is determined at the nodes of the edge, too: drawn along
/// it, the block feels `mu` times the pressure of both walls.
#[test]
fn a_block_in_a_corner_has_the_friction_of_both_walls() {
    for is_one_surface in [false, true] {
        let all = forces(&corner(is_one_surface, "zmax"));
        let last: Vec3 = all[9].iter().sum();
        let ratio = last.y.abs() / (last.x + last.z);
        assert!((ratio - 0.3).abs() < 0.003, "{is_one_surface}: {ratio}");
    }
}

/// Planes of symmetry that meet the corner leave no direction at the node where they do.
#[test]
fn corners_can_be_pressed_with_a_face_held() {
    for is_one_surface in [false, true] {
        let all = forces(&corner(is_one_surface, "ymin"));
        let pressed: Vec3 = all[4].iter().sum();
        assert!(pressed.x > 10.0 && pressed.z > 10.0, "{pressed}");
    }
}

/// A block on a floor, or on another block whose ends are prescribed too, that is drawn by one of
/// its ends.
fn drawn(on_block: bool, law: &str) -> String {
    let (lower, side, held) = match on_block {
        true => (
            r#"
[[body]]
name = "lower"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, -1], size = [1, 1, 1], divisions = [3, 2, 2] }
"#,
            r#"{ body = "lower", facets = "zmax" }"#,
            r#"{ body = "lower", nodes = "zmin", y = 0, z = 0 }, { body = "lower", nodes = "xmin", x = 0 }, { body = "lower", nodes = "xmax", x = 0 },"#,
        ),
        false => (
            r#"
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
"#,
            r#"{ rigid = "floor" }"#,
            "",
        ),
    };
    format!(
        r#"
title = "drawn by its end"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1000
poissons_ratio = 0
{lower}
[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "block", size = [1, 1, 1], divisions = [4, 2, 2] }}
[[pair]]
name = "sole"
a = {{ body = "block", facets = "zmin" }}
b = {side}
friction = {law}
[[step]]
name = "press"
increments = 2
displacement = [
    {held}
    {{ body = "block", nodes = "xmin", x = 0 }},
    {{ body = "block", nodes = "zmax", y = 0, z = -0.02 }},
]
[[step]]
name = "slide"
increments = 4
displacement = [{{ body = "block", nodes = "xmin", x = 0.2 }}]
"#
    )
}

/// The slip of nodes that prescribed motions move past what they face is known, so that they have
/// the friction of the law, as all others.
#[test]
fn nodes_that_are_driven_have_the_friction_of_the_law() {
    for on_block in [false, true] {
        for law in [
            r#"{ law = "coulomb", mu = 0.3 }"#,
            r#"{ law = "coulomb", mu = 0.3, by_state = { form = "slip-law", direct_effect = 1e-9, evolution_effect = 1e-9, slip_rate = 0.1, slip_distance = 0.1 } }"#,
        ] {
            let (all, state) = solved(&drawn(on_block, law));
            let slipping = slipping(&state);
            assert!(slipping >= 12, "{slipping}");
            // The joint of two blocks tilts, so that only the floor has the ratio of the forces.
            if !on_block {
                let last = all[5][0];
                let off = -last.x / last.z / 0.3 - 1.0;
                assert!(off.abs() < 1e-5, "{law}: {off:e}");
            }
        }
    }
}

/// Motions that reach nodes through a rigid body or a tie are as good as their own.
#[test]
fn nodes_that_a_carrier_drives_have_the_friction_of_the_law() {
    let own = drawn(true, r#"{ law = "coulomb", mu = 0.3 }"#);
    let carrier = r#"
[[body]]
name = "carrier"
material = "rubber"
mesh = { generator = "block", origin = [-1, 0, 0], size = [1, 1, 1], divisions = [2, 3, 3] }
[[tie]]
name = "glue"
a = { body = "carrier", facets = "xmax" }
b = { body = "block", facets = "xmin" }
"#;
    let by_tie =
        own.replace(
            r#"{ body = "block", nodes = "xmin", x = 0 },"#,
            r#"{ body = "carrier", nodes = "all", x = 0, y = 0 },"#,
        )
        .replace(
            r#"{ body = "block", nodes = "xmin", x = 0.2 }"#,
            r#"{ body = "carrier", nodes = "all", x = 0.2 }"#,
        ) + carrier;
    let plate = r#"
[[rigid]]
name = "plate"
reference = [0, 0, 0]
tied = [{ body = "block", nodes = "xmin" }]
"#;
    let by_plate = own
        .replace(r#"{ body = "block", nodes = "xmin", x = 0 },"#, "")
        .replace(r#"nodes = "zmax", y = 0, z"#, r#"nodes = "top", y = 0, z"#)
        .replace(
            "divisions = [4, 2, 2] }",
            r#"divisions = [4, 2, 2] }
node_sets = [{ name = "top", from = [0.1, 0, 0.9], to = [1, 1, 1] }]"#,
        )
        .replace(
            r#"displacement = [{ body = "block", nodes = "xmin", x = 0.2 }]"#,
            r#"rigid = [{ surface = "plate", displacement = [0.2, 0, -0.01] }]"#,
        )
        .replace(
            "increments = 2",
            r#"increments = 2
rigid = [{ surface = "plate", displacement = [0, 0, -0.01], rotation = [0, 0, 0] }]"#,
        )
        + plate;
    for deck in [by_tie, by_plate] {
        let (_, state) = solved(&deck);
        let slipping = slipping(&state);
        assert!(slipping >= 12, "{slipping}");
    }
}

/// Number of kept nodes under pressure; all of them slip with `mu = 0.3`.
fn slipping(state: &State) -> usize {
    let pair = &state.pairs[0];
    let mut slipping = 0;
    for side in Side::BOTH {
        for (node, kept) in pair.nodes[side].iter().zip(&pair.kept[side]) {
            if *kept && node.pressure > 0.0 {
                assert_eq!(node.status, Status::Slip);
                let off = node.tau.norm() / (0.3 * node.pressure) - 1.0;
                assert!(off.abs() < 1e-6, "{off:e}");
                slipping += 1;
            }
        }
    }
    slipping
}

/// A side that is prescribed wholly is as good as rigid and takes no direction from the other one:
/// in full slip friction is `mu P` at every kept node.
#[test]
fn a_side_that_is_prescribed_wholly_leaves_all_directions() {
    let deck = blocks(false, r#"{ law = "coulomb", mu = 0.3 }"#).replace(
        r#"{ body = "upper", nodes = "zmax""#,
        r#"{ body = "upper", nodes = "every""#,
    );
    let state = solved(&deck).1;
    let slipping = slipping(&state);
    assert!(slipping >= 12, "{slipping}");
}

/// A block whose lower nodes are drawn along `y` and pushed sideways by a load, which friction alone
/// holds: it slips where the resultant of both points, `sin = T/(mu N)`, in every increment, also in
/// the first one after a pause.
#[test]
fn a_drawn_block_gives_way_sideways_as_the_law_has_it() {
    let deck = r#"
title = "drawn block with a side load"
[[material]]
name = "steel"
law = "neo-hookean"
youngs_modulus = 210000
poissons_ratio = 0.3
[[body]]
name = "block"
material = "steel"
mesh = { generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
friction = { law = "coulomb", mu = 0.2 }
[[step]]
name = "press"
increments = 2
displacement = [{ body = "block", nodes = "zmin", x = 0, y = 0 }]
pressure = [{ body = "block", facets = "zmax", value = 100 }]
[[step]]
name = "draw"
increments = { initial = 0.05, smallest = 1e-3, largest = 0.4 }
release = [{ body = "block", nodes = "zmin", components = ["x"] }]
displacement = [{ body = "block", nodes = "zmin", y = 1 }]
traction = [{ body = "block", facets = "zmax", vector = [SIDE, 0, 0], curve = "constant" }]
"#;
    for side in [0.0, 1.0, 5.0] {
        let (forces, state) = solved(&deck.replace("SIDE", &format!("{side}")));
        let force = forces.last().unwrap()[0];
        assert!((force.z - 100.0).abs() < 0.1, "{force}");
        // `T` of the ends in all increments of the second step.
        for forces in &forces[3..] {
            let slip = forces[0].xy().norm() / forces[0].z;
            assert!((slip - 0.2).abs() < 1e-4, "{slip}");
        }
        let sine = side / (0.2 * force.z);
        let expected = sine / (1.0 - sine * sine).sqrt();
        let nodes = &state.positions[..4];
        let way = nodes.iter().map(|x| x.x).sum::<f64>() / 4.0 - 0.5;
        assert!((way - expected).abs() < 2e-3, "{way} {expected}");
    }
}
