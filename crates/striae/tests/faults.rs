//! A model built in Rust has the faults of the deck that says the same, in the same
//! words, with paths in place of lines.

use std::path::Path;

use striae::{deck, model::RigidMotion, prelude::*};
use striae_model::{
    ContactMass, ContactSurface, Fault, Increments, Load, Mover, Pair, RigidId, RigidShape,
    RigidSurface, Step, Velocity,
};

/// Eleven different faults.
const DECK: &str = r#"
title = "Eleven faults"
[[material]]
name = "m"
law = "linear-elastic"
lambda = 1
shear_modulus = 1
[[body]]
name = "one"
material = "m"
mesh = { generator = "block", size = [1, 1, 1], divisions = [1, 1, 1] }
[[body]]
name = "two"
material = "m"
mesh = { generator = "block", origin = [0, 0, 1], size = [1, 1, 1], divisions = [1, 1, 1] }
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[rigid]]
name = "wall"
plane = { point = [-1, 0, 0], normal = [1, 0, 0] }
[[pair]]
name = "joint"
a = { body = "one", facets = "zmax" }
b = { body = "two", facets = "zmin" }
friction = { law = "orthotropic", mu_along = 0.1, mu_across = 0.2 }
[[pair]]
name = "again"
a = { body = "two", facets = "zmin" }
b = { body = "one", facets = "zmax" }
[[pair]]
name = "rigid"
a = { rigid = "floor" }
b = { rigid = "floor" }
[[pair]]
name = "self"
a = { body = "one", facets = "xmin" }
b = { body = "one", facets = "xmin" }
[[step]]
name = "press"
increments = { initial = 0.1, smallest = 0.5, largest = 1 }
displacement = [
  { body = "two", nodes = "zmax", z = 1 },
  { body = "two", nodes = "all", z = 2 },
]
release = [{ body = "one", nodes = "zmin" }]
pressure = [
  { body = "one", facets = "xmin", value = 1 },
  { body = "one", facets = "xmin", value = 2 },
]
rigid = [{ surface = "wall", free = ["x"] }]
velocity = [{ body = "one", vector = [1, 0, 0] }]
[[step]]
name = "hold"
displacement = [{ body = "two", nodes = "zmax" }]
"#;

fn block(name: &str, z: f64) -> striae::model::Body {
    let mesh = Block {
        origin: Vec3::new(0.0, 0.0, z),
        ..Block::default()
    };
    striae::model::Body {
        name: name.into(),
        mesh: mesh.mesh().unwrap(),
        material: Material::linear_elastic(LameConstants {
            lambda: 1.0,
            shear: 1.0,
        }),
        formulation: striae::model::Formulation::Standard,
        density: 0.0,
        contact_mass: ContactMass::Consistent,
        sections: Vec::new(),
    }
}

fn side(bodies: &[striae::model::Body], body: usize, facets: &str) -> ContactSurface {
    ContactSurface::Deformable {
        body: striae::model::BodyId(body),
        faces: bodies[body].mesh.facet_sets.get(facets).unwrap().to_vec(),
    }
}

fn joined(name: &str, a: ContactSurface, b: ContactSurface, friction: Friction) -> Pair {
    Pair {
        name: name.into(),
        a,
        b,
        textures: [None, None],
        friction,
        enforcement: striae::model::Enforcement::Weighted,
        search_distance: None,
        initial: Initial::AsMeshed,
        interference: None,
        wear: [0.0; 2],
        wear_across: 1.0,
        stabilised: false,
        feature_angle: None,
    }
}

/// The model of the deck, field by field.
fn eleven_faults() -> Model {
    let bodies = vec![block("one", 0.0), block("two", 1.0)];
    let plane = |name: &str, point: Vec3, normal: Vec3| {
        RigidSurface::new(name, RigidShape::Plane { point, normal })
    };
    let orthotropic = Friction::orthotropic(0.1, 0.2, SlipRule::Opposing).unwrap();
    let pairs = vec![
        joined(
            "joint",
            side(&bodies, 0, "zmax"),
            side(&bodies, 1, "zmin"),
            orthotropic,
        ),
        joined(
            "again",
            side(&bodies, 1, "zmin"),
            side(&bodies, 0, "zmax"),
            Friction::frictionless(),
        ),
        joined(
            "rigid",
            ContactSurface::Rigid(RigidId(0)),
            ContactSurface::Rigid(RigidId(0)),
            Friction::frictionless(),
        ),
        joined(
            "self",
            side(&bodies, 0, "xmin"),
            side(&bodies, 0, "xmin"),
            Friction::frictionless(),
        ),
    ];
    let steps = vec![press(&bodies), hold(&bodies)];
    Model {
        ties: Vec::new(),
        springs: Vec::new(),
        cavities: Vec::new(),
        title: "Eleven faults".into(),
        rigid_surfaces: vec![
            plane("floor", Vec3::zeros(), Vec3::z()),
            plane("wall", -Vec3::x(), Vec3::x()),
        ],
        pairs,
        steps,
        solver: striae::model::solver(),
        bodies,
    }
}

fn displaced(
    bodies: &[striae::model::Body],
    set: &str,
    z: Option<f64>,
) -> striae::model::Displacement {
    striae::model::Displacement {
        axes: striae::model::Axes::Global,
        set: set.into(),
        body: striae::model::BodyId(1),
        nodes: bodies[1].mesh.node_sets.get(set).unwrap().to_vec(),
        components: [None, None, z.map(Into::into)],
        curve: Curve::Ramp,
    }
}

fn press(bodies: &[striae::model::Body]) -> Step {
    let mesh = &bodies[0].mesh;
    let pressed = |pressure| Load {
        set: "xmin".into(),
        body: striae::model::BodyId(0),
        faces: mesh.facet_sets.get("xmin").unwrap().to_vec(),
        kind: LoadKind::Pressure(pressure).into(),
        extent: LoadExtent::Whole,
        curve: Curve::Ramp,
    };
    let mut free = [Freedom::AsBefore; 6];
    free[0] = Freedom::Free;
    Step {
        name: "press".into(),
        duration: 1.0,
        procedure: striae::model::Procedure::QuasiStatic,
        increments: Increments {
            initial: 0.1,
            smallest: 0.5,
            largest: 1.0,
        },
        velocities: vec![Velocity {
            body: Mover::Deformable(striae::model::BodyId(0)),
            velocity: Vec3::x(),
            spin: Vec3::zeros(),
            about: Vec3::zeros(),
        }],
        gravity: None,
        displacements: vec![
            displaced(bodies, "zmax", Some(1.0)),
            displaced(bodies, "all", Some(2.0)),
        ],
        releases: vec![striae::model::Release {
            body: striae::model::BodyId(0),
            nodes: mesh.node_sets.get("zmin").unwrap().to_vec(),
            components: [false; 3],
        }],
        forces: Vec::new(),
        loads: vec![pressed(1.0), pressed(2.0)],
        actuations: Vec::new(),
        fillings: Vec::new(),
        rigid_motions: vec![RigidMotion {
            surface: RigidId(1),
            coordinates: free,
            force: None,
            torque: None,
            curve: Curve::Ramp,
        }],
        frictions: Vec::new(),
    }
}

fn hold(bodies: &[striae::model::Body]) -> Step {
    Step {
        name: "hold".into(),
        increments: striae::model::equal_increments(10),
        velocities: Vec::new(),
        displacements: vec![displaced(bodies, "zmax", None)],
        releases: Vec::new(),
        loads: Vec::new(),
        rigid_motions: Vec::new(),
        ..press(bodies)
    }
}

#[test]
fn eleven_faults_of_a_model_have_the_words_of_the_deck() {
    let faults = eleven_faults().faults();
    let mut of_model: Vec<String> = faults.iter().map(|fault| fault.kind.to_string()).collect();
    let of_deck = deck::parse(DECK, "deck.toml", Path::new("")).unwrap_err();
    let mut of_deck: Vec<String> = of_deck.iter().map(|fault| fault.kind.to_string()).collect();
    of_model.sort();
    of_deck.sort();
    assert_eq!(of_model, of_deck);
    assert_eq!(of_model.len(), 11, "{of_model:#?}");
    let mut kinds: Vec<_> = faults
        .iter()
        .map(|at| std::mem::discriminant(&at.kind))
        .collect();
    kinds.dedup();
    assert_eq!(kinds.len(), 11);
}

#[test]
fn every_fault_has_the_path_of_what_is_wrong() {
    let faults = eleven_faults().faults();
    let mut paths: Vec<String> = faults.iter().map(|fault| fault.path.to_string()).collect();
    paths.sort();
    assert_eq!(
        paths,
        [
            "pairs[0].friction",
            "pairs[1]",
            "pairs[2]",
            "pairs[3]",
            "steps[0]",
            "steps[0].displacements[1]",
            "steps[0].increments",
            "steps[0].loads[1]",
            "steps[0].releases[0]",
            "steps[0].velocities[0]",
            "steps[1].displacements[0]",
        ]
    );
}

/// Faults of a sound model after a change, as text.
fn after(change: impl FnOnce(&mut Model)) -> Vec<String> {
    let rubber = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let mut sound = model("A block on a floor")
        .body(body(
            "block",
            Block::default().mesh().unwrap(),
            Material::neo_hookean(rubber),
        ))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(pair("sole", surface("block", "zmin"), rigid("floor")))
        .step(step("press").displace("block", "zmax", [0.0, 0.0, -0.1]))
        .build()
        .unwrap();
    change(&mut sound);
    sound.faults().iter().map(Fault::to_string).collect()
}

#[test]
fn what_only_a_model_can_say_is_judged_too() {
    assert!(after(|_| ()).is_empty());
    let missing = after(|model| {
        model.pairs[0].b = ContactSurface::Rigid(RigidId(3));
        model.steps[0].displacements[0].nodes.push(NodeId(99));
    });
    assert_eq!(
        missing,
        [
            "pairs[0].b: there is no rigid surface 3; there are 1, counted from 0",
            "steps[0].displacements[0]: there is no node 99; there are 8, counted from 0",
        ]
    );
    let numbers = after(|model| {
        model.pairs[0].search_distance = Some(0.0);
        model.steps[0].duration = f64::NAN;
        model.steps[0].displacements[0].curve = Curve::Table(vec![(0.0, 0.0), (0.5, 1.0)]);
        model.bodies[0].density = -1.0;
        model.rigid_surfaces[0].shape = RigidShape::Plane {
            point: Vec3::zeros(),
            normal: Vec3::zeros(),
        };
    });
    assert_eq!(
        numbers,
        [
            "bodies[0].density: the density of body `block` must be a number of at least 0, but is -1",
            "rigid_surfaces[0].shape: the normal of a plane must not be the zero vector",
            "pairs[0].search_distance: the search distance of pair `sole` must be a positive number, but is 0",
            "steps[0].duration: the duration of step `press` must be a positive number, but is NaN",
            "steps[0].displacements[0].curve: the first numbers of the points of curve `steps[0].displacements[0].curve` must ascend from 0 to 1, but end at 0.5",
        ]
    );
    let twice = after(|model| model.steps.push(model.steps[0].clone()));
    assert_eq!(
        twice,
        ["steps[1].name: step `press` is already defined as steps[0]"]
    );
}

#[test]
fn unknown_names_are_listed_with_everything_else() {
    let rubber = LameConstants::from_youngs_modulus(1.0, 0.3).unwrap();
    let faults = model("Names")
        .body(body(
            "block",
            Block::default().mesh().unwrap(),
            Material::neo_hookean(rubber),
        ))
        .rigid(plane("floor", [0.0; 3], [0.0, 0.0, 1.0]))
        .pair(pair("sole", surface("block", "zmn"), rigid("flor")))
        .step(
            step("press")
                .displace("blok", "zmax", [0.0; 3])
                .displace("block", "zmax", [Some(1.0), None, None])
                .displace("block", "all", [Some(2.0), None, None]),
        )
        .build()
        .unwrap_err();
    let lines: Vec<String> = faults.0.iter().map(Fault::to_string).collect();
    assert_eq!(
        lines,
        [
            "pairs[0].a: body `block` has no facet set `zmn`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`; did you mean `zmin`?",
            "pairs[0].b: no rigid surface is named `flor`; there is `floor`; did you mean `floor`?",
            "steps[0].displacements[0]: no body is named `blok`; there is `block`; did you mean `block`?",
            "steps[0].displacements[2]: step `press` prescribes component `x` of node 4 of body `block` twice: 1 by `zmax`, 2 by `all`",
        ]
    );
}
