//! A good deck is lowered to the model it describes.
//!
//! Longer than other files, as it goes through all that a deck can say.

mod deck;

use deck::BASE;
use std::{num::NonZeroUsize, path::Path};
use striae_deck::{Deck, parse, read};
use striae_law::{
    bulk::{LameConstants, Material},
    friction::Friction,
};
use striae_mesh::{CellKind, NodeId, Region, Vec3, generate::Block};
use striae_model::{
    Backend, BodyId, ContactSurface, Curve, Enforcement, Formulation, Freedom, Increments,
    LoadExtent, LoadKind, Mover, PairId, Procedure, RigidId, RigidShape, Solver, Strategy,
    Velocity,
};
use striae_output::FieldOutput;

use striae_surface::texture::{Field, Lines, Paint};

fn lowered(text: &str) -> Deck {
    parse(text, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"))
}

#[test]
fn bodies_have_their_meshes_and_materials() {
    let model = lowered(BASE).model;
    assert_eq!(model.title, "Two blocks");
    let constants = LameConstants::from_youngs_modulus(1e6, 0.3).unwrap();
    let size = Vec3::new(1.0, 1.0, 0.5);
    let lower = Block {
        size,
        divisions: [4, 4, 2],
        ..Block::default()
    };
    let upper = Block {
        origin: Vec3::new(0.0, 0.0, 0.5),
        size,
        divisions: [3, 3, 2],
        ..Block::default()
    };
    for (body, (name, block)) in model
        .bodies
        .iter()
        .zip([("lower", lower), ("upper", upper)])
    {
        assert_eq!(body.name, name);
        let mut mesh = block.mesh().unwrap();
        mesh.name_all_facets();
        assert_eq!(body.mesh, mesh);
        assert_eq!(body.material, Material::neo_hookean(constants));
    }
    let RigidShape::Plane { point, normal } = &model.rigid_surfaces[0].shape else {
        panic!("a plane")
    };
    assert_eq!(
        (model.rigid_surfaces[0].name.as_str(), *point, *normal),
        ("floor", Vec3::zeros(), Vec3::z())
    );
}

#[test]
fn decks_have_all_bulk_laws() {
    use striae_law::bulk::{
        Branch, Hardening, Hyperelastic, Isochoric, OgdenTerm, Plastic, Viscoelastic, Volumetric,
    };
    let constants = LameConstants::from_youngs_modulus(1e6, 0.3).unwrap();
    let rubber = |isochoric| {
        Material::hyperelastic(Hyperelastic::new(isochoric, 20.0, Volumetric::Quadratic).unwrap())
    };
    let ogden = Isochoric::Ogden(Box::new([
        OgdenTerm {
            mu: 0.63,
            alpha: 1.3,
        },
        OgdenTerm {
            mu: -0.01,
            alpha: -2.0,
        },
    ]));
    let yeoh = Isochoric::Yeoh {
        c10: 0.3,
        c20: -0.01,
        c30: 0.002,
    };
    let by_ratio = Hyperelastic::with_poissons_ratio(
        Isochoric::NeoHookean { shear: 0.5 },
        0.49,
        Volumetric::Logarithmic,
    );
    let chains = Isochoric::ArrudaBoyce {
        mu: 0.4,
        locking_stretch: 3.0,
    };
    let gent = Isochoric::Gent {
        shear: 0.5,
        limit: 30.0,
    };
    let (c10, c01) = (0.2, 0.05);
    let slow = Isochoric::NeoHookean { shear: 0.5 };
    let slow = Hyperelastic::new(slow, 20.0, Volumetric::Quadratic).unwrap();
    let branches = [(0.5, 0.1), (2.0, 10.0)].map(|(ratio, time)| Branch { ratio, time });
    let metal = |hardening: Result<Hardening, _>| {
        Material::plastic(Plastic::new(constants, hardening.unwrap()))
    };
    let pairs = [[0.0, 100.0], [0.1, 150.0]];
    for (law, expected) in [
        (
            "law = \"neo-hookean\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nvolumetric = \"logarithmic\"",
            Material::neo_hookean_with(constants, Volumetric::Logarithmic),
        ),
        (
            "law = \"linear-elastic\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3",
            Material::linear_elastic(constants),
        ),
        (
            "law = \"isochoric-neo-hookean\"\nshear_modulus = 0.5\npoissons_ratio = 0.49\nvolumetric = \"logarithmic\"",
            Material::hyperelastic(by_ratio.unwrap()),
        ),
        (
            "law = \"mooney-rivlin\"\nc10 = 0.2\nc01 = 0.05\nbulk_modulus = 20",
            rubber(Isochoric::MooneyRivlin { c10, c01 }),
        ),
        (
            "law = \"yeoh\"\nc10 = 0.3\nc20 = -0.01\nc30 = 0.002\nbulk_modulus = 20",
            rubber(yeoh),
        ),
        (
            "law = \"ogden\"\nterms = [{ mu = 0.63, alpha = 1.3 }, { mu = -0.01, alpha = -2 }]\nbulk_modulus = 20",
            rubber(ogden),
        ),
        (
            "law = \"gent\"\nshear_modulus = 0.5\nlimit = 30\nbulk_modulus = 20",
            rubber(gent),
        ),
        (
            "law = \"arruda-boyce\"\nmu = 0.4\nlocking_stretch = 3\nbulk_modulus = 20",
            rubber(chains),
        ),
        (
            "law = \"isochoric-neo-hookean\"\nshear_modulus = 0.5\nbulk_modulus = 20\nrelaxation = [{ ratio = 0.5, time = 0.1 }, { ratio = 2, time = 10 }]",
            Material::viscoelastic(Viscoelastic::new(slow, &branches).unwrap()),
        ),
        (
            "law = \"elastic-plastic\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nyield_stress = 100",
            metal(Hardening::linear(100.0, 0.0)),
        ),
        (
            "law = \"elastic-plastic\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nyield_stress = 100\nhardening_modulus = 7\nsaturation = { stress = 200, rate = 5 }",
            metal(Hardening::voce(100.0, 200.0, 5.0, 7.0)),
        ),
        (
            "law = \"elastic-plastic\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3\nyield_table = [[0, 100], [0.1, 150]]",
            metal(Hardening::table(&pairs)),
        ),
    ] {
        let base = "law = \"neo-hookean\"\nyoungs_modulus = 1e6\npoissons_ratio = 0.3";
        let text = BASE.replacen(base, law, 1);
        assert_ne!(text, BASE.replacen(base, "", 1));
        let model = striae_deck::parse(&text, "deck.toml", Path::new("."))
            .unwrap()
            .model;
        assert_eq!(model.bodies[0].material, expected);
    }
}

#[test]
fn bodies_have_the_elements_of_their_deck() {
    let body = |from: &str, to: &str| {
        let mut bodies = lowered(&BASE.replace(from, to)).model.bodies;
        bodies.swap_remove(0)
    };
    let ratio = |nu: &str| body("poissons_ratio = 0.3", nu).formulation;
    assert_eq!(ratio("poissons_ratio = 0.45"), Formulation::Standard);
    assert_eq!(ratio("poissons_ratio = 0.46"), Formulation::MeanDilatation);
    let stated = "name = \"lower\"\nformulation = \"mean-dilatation\"\nmaterial";
    let body_with = body("name = \"lower\"\nmaterial", stated);
    assert_eq!(body_with.formulation, Formulation::MeanDilatation);
    for (cells, kind) in [
        ("wedges", CellKind::Wedge),
        ("pyramids", CellKind::Pyramid),
        ("hexahedra", CellKind::Hexahedron),
    ] {
        let with = format!("divisions = [4, 4, 2], cells = \"{cells}\" }}");
        let mesh = body("divisions = [4, 4, 2] }", &with).mesh;
        assert_eq!(mesh.blocks[0].kind, kind);
    }
    let cells = "divisions = [4, 4, 2], cells = \"composite-tetrahedra\" }";
    let text = BASE.replace("divisions = [4, 4, 2] }", cells);
    let text = text.replace(", extent = \"exposed\"", "");
    let mesh = &lowered(&text).model.bodies[0].mesh;
    assert_eq!(mesh.blocks[0].kind, CellKind::CompositeTetrahedron);
}

#[test]
fn decks_add_sets_to_meshes() {
    let from = "divisions = [4, 4, 2] }";
    let sets = format!(
        "{from}\n\
         node_sets = [\n\
           {{ name = \"pin\", nearest = [0.1, -1, 0.1] }},\n\
           {{ name = \"edge\", common = [\"xmin\", \"zmin\"] }},\n\
           {{ name = \"ends\", union = [\"xmin\", \"xmax\", \"edge\"] }},\n\
           {{ name = \"slab\", from = [0, 0, 0.25], to = [1, 1, 0.25] }},\n\
         ]\n\
         facet_sets = [\n\
           {{ name = \"sides\", union = [\"xmin\", \"ymin\"] }},\n\
           {{ name = \"half\", of = \"sides\", from = [0, 0, 0], to = [0.5, 1, 0.5] }},\n\
         ]"
    );
    let mesh = &lowered(&BASE.replace(from, &sets)).model.bodies[0].mesh;
    let nodes = |set: &str| mesh.node_sets.get(set).unwrap();
    let at = |node: &NodeId| mesh.positions[node.index()];
    let [pin] = nodes("pin") else {
        panic!("one node")
    };
    assert_eq!(at(pin), Vec3::zeros());
    assert_eq!(nodes("edge").len(), 5);
    assert!(
        nodes("edge")
            .iter()
            .all(|node| at(node).x == 0.0 && at(node).z == 0.0)
    );
    assert_eq!(nodes("ends").len(), 2 * 15);
    assert_eq!(nodes("slab").len(), 25);
    // Eight faces of `xmin` and, of the eight of `ymin`, those below x = 0.5.
    assert_eq!(mesh.facet_sets.get("half").unwrap().len(), 8 + 4);
}

#[test]
fn decks_make_sets_from_regions_shapes_and_each_other() {
    let from = "divisions = [4, 4, 2] }";
    let sets = format!(
        "{from}\n\
         node_sets = [\n\
           {{ name = \"of-far\", facets = \"far\" }},\n\
           {{ name = \"ball\", sphere = {{ centre = [0, 0, 0], radius = 0.25 }} }},\n\
           {{ name = \"bar\", cylinder = {{ point = [0, 0, 9], axis = [0, 0, 2], radius = 0.25 }} }},\n\
           {{ name = \"near\", half_space = {{ point = [0.25, 0, 0], normal = [1, 0, 0] }} }},\n\
           {{ name = \"of-low\", elements = \"low\" }},\n\
           {{ name = \"around-low\", border = \"low\" }},\n\
         ]\n\
         element_sets = [\n\
           {{ name = \"row\", nodes = \"near\" }},\n\
           {{ name = \"low\", from = [0, 0, 0], to = [1, 1, 0.25] }},\n\
           {{ name = \"behind\", facets = \"up\" }},\n\
           {{ name = \"both\", union = [\"row\", \"low\"] }},\n\
           {{ name = \"corner\", common = [\"row\", \"low\"] }},\n\
           {{ name = \"two\", numbers = [0, 5] }},\n\
         ]\n\
         facet_sets = [\n\
           {{ name = \"far\", of = \"up\", half_space = {{ point = [0.5, 0, 0], normal = [-1, 0, 0] }} }},\n\
           {{ name = \"up\", direction = [0, 0, 5], angle = 10 }},\n\
           {{ name = \"front\", around = [0.4, -1, 0.2], feature_angle = 30 }},\n\
           {{ name = \"edge\", nodes = \"bar\" }},\n\
           {{ name = \"skirt\", border = \"low\" }},\n\
           {{ name = \"boxed\", from = [0, 0, 0], to = [1, 1, 0] }},\n\
           {{ name = \"under\", common = [\"skirt\", \"boxed\"] }},\n\
         ]"
    );
    let mesh = &lowered(&BASE.replace(from, &sets)).model.bodies[0].mesh;
    let facets = |set: &str| mesh.facet_sets.get(set).unwrap();
    assert_eq!(facets("all"), mesh.boundary_faces());
    assert_eq!(facets("up"), facets("zmax"));
    assert_eq!(facets("front"), facets("ymin"));
    assert_eq!(facets("boxed"), facets("zmin"));
    assert_eq!(facets("under"), facets("zmin"));
    let count = |set| facets(set).len();
    assert_eq!(["far", "edge", "skirt"].map(count), [8, 4, 16 + 16]);
    let nodes = |set| mesh.node_sets.get(set).unwrap().len();
    assert_eq!(
        ["of-far", "ball", "bar", "near", "of-low", "around-low"].map(nodes),
        [15, 4, 9, 30, 50, 50]
    );
    let elements = |set| mesh.element_sets.get(set).unwrap().len();
    assert_eq!(
        ["all", "row", "low", "behind", "both", "corner", "two"].map(elements),
        [32, 8, 16, 16, 20, 4, 2]
    );
    let expected = [nodes("near"), count("up"), count("front"), elements("low")];
    assert_eq!(built(), expected);
}

/// Sizes of sets of these names that a builder makes.
fn built() -> [usize; 4] {
    let block = Block {
        size: Vec3::new(1.0, 1.0, 0.5),
        divisions: [4, 4, 2],
        ..Block::default()
    };
    let near = Region::HalfSpace {
        point: Vec3::new(0.25, 0.0, 0.0),
        normal: Vec3::x(),
    };
    let low = Region::Box {
        from: Vec3::zeros(),
        to: Vec3::new(1.0, 1.0, 0.25),
    };
    let constants = LameConstants::from_youngs_modulus(1e6, 0.3).unwrap();
    let material = Material::neo_hookean(constants);
    let body = striae_model::body("block", block.mesh().unwrap(), material)
        .nodes_in("near", &near)
        .elements_in("low", &low)
        .facets_in("low", &low)
        .facets_along("up", [0.0, 0.0, 5.0], 0.2)
        .facets_around("front", [0.4, -1.0, 0.2], 0.5);
    let model = striae_model::model("sets").body(body);
    let held = striae_model::step("held").hold("block", "zmin");
    let model = model.step(held).build().unwrap();
    let mesh = &model.bodies[0].mesh;
    let facets = |set: &str| mesh.facet_sets.get(set).unwrap().len();
    assert_eq!(facets("low"), 16 + 16);
    assert_eq!(facets("all"), mesh.boundary_faces().len());
    [
        mesh.node_sets.get("near").unwrap().len(),
        facets("up"),
        facets("front"),
        mesh.element_sets.get("low").unwrap().len(),
    ]
}

#[test]
fn pairs_name_ids_and_faces() {
    let model = lowered(BASE).model;
    let pair = &model.pairs[0];
    for (side, (id, set)) in [&pair.a, &pair.b]
        .into_iter()
        .zip([(0, "zmax"), (1, "zmin")])
    {
        let ContactSurface::Deformable { body, faces } = side else {
            panic!("deformable")
        };
        assert_eq!(*body, BodyId(id));
        assert_eq!(faces, model.bodies[id].mesh.facet_sets.get(set).unwrap());
    }
    assert_eq!(pair.friction, Friction::coulomb(0.3).unwrap());
    assert_eq!(
        (pair.enforcement, pair.search_distance, pair.stabilised),
        (Enforcement::Weighted, None, false)
    );
}

#[test]
fn a_rigid_side_becomes_the_second_one() {
    let text = BASE.replace(
        r#"a = { body = "lower", facets = "zmax" }"#,
        r#"a = { rigid = "floor" }"#,
    );
    let text = text.replace(
        "mu = 0.3 }",
        "mu = 0.3 }\nenforcement = \"collocated\"\nsearch_distance = 0.1\nstabilise = true",
    );
    let pair = &lowered(&text).model.pairs[0];
    assert!(matches!(
        pair.a,
        ContactSurface::Deformable {
            body: BodyId(1),
            ..
        }
    ));
    assert!(matches!(pair.b, ContactSurface::Rigid(RigidId(0))));
    assert_eq!(
        (pair.enforcement, pair.search_distance, pair.stabilised),
        (Enforcement::Collocated, Some(0.1), true)
    );
}

#[test]
fn steps_state_what_they_change() {
    let model = lowered(BASE).model;
    let [press, slide] = &model.steps[..] else {
        panic!("two steps")
    };
    assert_eq!((press.name.as_str(), press.duration), ("press", 2.0));
    assert_eq!(
        press.increments,
        Increments {
            initial: 0.1,
            smallest: 1e-3,
            largest: 0.2
        }
    );
    let [bottom, top] = &press.displacements[..] else {
        panic!("two conditions")
    };
    assert_eq!(
        (bottom.set.as_str(), bottom.body, bottom.numbers()),
        ("zmin", BodyId(0), [Some(0.0); 3])
    );
    assert_eq!(bottom.curve, Curve::Ramp);
    assert_eq!(
        (top.body, top.numbers()),
        (BodyId(1), [None, None, Some(-0.02)])
    );
    assert_eq!(
        top.curve,
        Curve::Table(vec![(0.0, 0.0), (0.5, 1.0), (1.0, 0.0)])
    );
    let expected: Vec<NodeId> = model.bodies[1].mesh.node_sets.get("zmax").unwrap().to_vec();
    assert_eq!(top.nodes, expected);
    let [traction, pressure] = &press.loads[..] else {
        panic!("two loads")
    };
    assert_eq!(traction.kind, LoadKind::FollowerTraction(Vec3::x()).into());
    assert_eq!(
        (traction.body, traction.extent),
        (BodyId(1), LoadExtent::Whole)
    );
    assert_eq!(
        (pressure.kind.clone(), pressure.extent),
        (LoadKind::Pressure(3.0).into(), LoadExtent::Exposed)
    );

    assert_eq!(slide.duration, 1.0);
    assert_eq!(
        slide.increments,
        Increments {
            initial: 0.1,
            smallest: 1e-4,
            largest: 0.1
        }
    );
    assert_eq!(slide.releases[0].components, [false, false, true]);
    assert_eq!(
        slide.rigid_motions[0].coordinates[..3],
        [0.0, 0.0, 0.1].map(Freedom::To)
    );
    assert_eq!(slide.frictions, [(PairId(0), Friction::frictionless())]);
}

#[test]
fn settings_have_defaults() {
    let deck = lowered(BASE);
    let stated = Solver {
        backend: Backend::Faer,
        strategy: Strategy::Table1 {
            stick_tolerance: 0.001,
        },
        tolerance: 1e-9,
        largest_iterations: 15,
        further_iterations: 0,
    };
    assert_eq!(deck.model.solver, stated);
    assert_eq!(
        deck.output.fields,
        FieldOutput::Every(NonZeroUsize::new(2).unwrap())
    );
    let bare = lowered(&BASE[..BASE.find("[output]").unwrap()]);
    let default = Solver {
        backend: Backend::Condensed,
        strategy: Strategy::Semismooth,
        tolerance: 1e-10,
        largest_iterations: 40,
        further_iterations: 0,
    };
    assert_eq!(bare.model.solver, default);
    assert_eq!(
        bare.output.fields,
        FieldOutput::Every(NonZeroUsize::new(1).unwrap())
    );
    let last = lowered(&BASE.replace("fields_every = 2", "fields_every = 0"));
    assert_eq!(last.output.fields, FieldOutput::Last);
}

#[test]
fn friction_takes_a_cap() {
    let law = r#"{ law = "coulomb", mu = 0.2, shear_cap = 5 }"#;
    let text = BASE.replace(r#"{ law = "coulomb", mu = 0.3 }"#, law);
    let expected = Friction::coulomb(0.2).unwrap().with_shear_cap(5.0).unwrap();
    assert_eq!(lowered(&text).model.pairs[0].friction, expected);
}

#[test]
fn tables_of_friction_are_in_degrees() {
    let law = r#"{ law = "tabulated", angles = [-90, 0, 90, 180], mu = [0.1, 0.2, 0.3, 0.4] }"#;
    let text = BASE
        .replace(r#"{ law = "coulomb", mu = 0.3 }"#, law)
        .replace(
            r#"facets = "zmin" }"#,
            r#"facets = "zmin", texture = { uniform = [1, 0, 0] } }"#,
        );
    let quarter = std::f64::consts::FRAC_PI_2;
    let angles = [-quarter, 0.0, quarter, 2.0 * quarter];
    let expected = Friction::tabulated(&angles, &[0.1, 0.2, 0.3, 0.4]).unwrap();
    assert_eq!(lowered(&text).model.pairs[0].friction, expected);
}

#[test]
fn textures_go_with_their_sides() {
    let text = BASE
        .replace(
            r#"a = { body = "lower", facets = "zmax" }"#,
            r#"a = { rigid = "floor", texture = { uniform = [0, 2, 0], turn = 180 } }"#,
        )
        .replace(
            r#"facets = "zmin" }"#,
            r#"facets = "zmin", texture = { points = [{ at = [0, 0, 0], direction = [1, 0, 0] }], width = 2 } }"#,
        )
        .replace(
            r#"law = "coulomb", mu = 0.3"#,
            r#"law = "two-textures", mu = 0.3, c_mag = 0.1, c_ang = 0.1, c_cen = 0.5"#,
        );
    let pair = &lowered(&text).model.pairs[0];
    assert_eq!(
        pair.friction,
        Friction::two_textures(0.3, 0.1, 0.1, 0.5).unwrap()
    );
    let points = Paint::Points {
        directions: vec![(Vec3::zeros(), Vec3::x())],
        width: Some(2.0),
    };
    let lines = Lines::Uniform(2.0 * Vec3::y());
    let field = Paint::Field(Field {
        lines,
        turn: std::f64::consts::PI,
    });
    assert_eq!(pair.textures, [Some(points), Some(field)]);
}

#[test]
fn every_generator_makes_its_mesh() {
    for mesh in [
        r#"generator = "block", size = [1, 2, 3], divisions = [2, 3, 4], grading = { x = { one_sided = 3 }, y = { symmetric = 2 }, z = { lengths = [1, 2, 2, 1] } }, rotation = { axis = [0, 0, 2], degrees = 30, about = [0, 0, 0] }, mesh_rotation = 10, bottom_slopes = [0.1, 0], top_slopes = [0, 0.1], irregularity = 0.1, seed = 4"#,
        r#"generator = "capped-block", size = [10, 10], height = 6.5, radius = 12, element_size = 1.6, apex = [0, 0, 1], fine_half_width = 2, fine_depth = 1, growth = 1.5, part = "half""#,
        r#"generator = "capped-block", size = [10, 10], height = 6.5, radius = 12, element_size = 3, cells = "composite-tetrahedra""#,
        r#"generator = "half-cylinder", radius = 8, thickness = 1, element_size = 1, half = "upper", layers = 2"#,
        r#"generator = "annulus", inner_radius = 0.2, outer_radius = 0.5, width = 0.4, divisions = [2, 24, 2], refinement = { half_angle = 20, ratio = 3 }"#,
        r#"generator = "cylinder", base = [0, 0, 1], axis = [0, 1, 0], radius = 2, height = 3, divisions = [2, 2, 3], axial_grading = { one_sided = 2 }, part = "quarter""#,
        r#"generator = "torus", centre = [0, 0, 1], axis = [1, 0, 0], ring_radius = 4, section_radius = 1, divisions = [1, 1, 8]"#,
    ] {
        let deck = format!(
            "title = \"t\"\n[[material]]\nname = \"m\"\nlaw = \"linear-elastic\"\nlambda = 1\nshear_modulus = 1\n\
             [[body]]\nname = \"b\"\nmaterial = \"m\"\nmesh = {{ {mesh} }}\n\
             [[step]]\nname = \"s\"\ndisplacement = [{{ body = \"b\", nodes = \"all\", x = 0, y = 0, z = 0 }}]\n"
        );
        assert!(lowered(&deck).model.bodies[0].mesh.element_count() >= 24);
    }
}

#[test]
fn elements_turned_inside_out_are_named() {
    let twisted = "divisions = [4, 4, 2], mesh_rotation = 170";
    let text = BASE.replace("divisions = [4, 4, 2]", twisted);
    let faults = parse(&text, "deck.toml", Path::new("")).unwrap_err();
    let said: Vec<String> = faults.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].starts_with("deck.toml:10:8: the mesh of body `lower` cannot be made: "));
    assert!(
        said[0].contains("turned inside out") && said[0].contains("element "),
        "{said:?}"
    );
    assert!(said[0].contains("none without `mesh_rotation`"), "{said:?}");
}

#[test]
fn inertia_gravity_and_decaying_friction() {
    let text = BASE
        .replace("youngs_modulus = 1e6", "density = 1000\nyoungs_modulus = 1e6")
        .replace(
            "duration = 2.0\n",
            "duration = 2.0\ndynamics = { spectral_radius = 0.5 }\ngravity = { vector = [0, 0, -9.81], curve = \"constant\" }\nvelocity = [{ body = \"upper\", vector = [1, 2, 3], spin = [0, 0, 4], about = [5, 6, 7] }]\n",
        )
        .replace(
            r#"{ law = "coulomb", mu = 0.3 }"#,
            r#"{ law = "coulomb", mu = 0.3, decay = { kinetic_over_static = 0.5, slip_rate = 2 } }"#,
        );
    let model = parse(&text, "deck.toml", Path::new("")).unwrap().model;
    assert!(model.bodies.iter().all(|body| body.density == 1000.0));
    let [press, slide] = &model.steps[..] else {
        panic!("two steps")
    };
    assert_eq!(
        press.procedure,
        Procedure::Dynamic {
            spectral_radius: 0.5
        }
    );
    assert_eq!(slide.procedure, Procedure::QuasiStatic);
    let gravity = press.gravity.as_ref().unwrap();
    assert_eq!(gravity.acceleration, Vec3::new(0.0, 0.0, -9.81));
    assert_eq!(gravity.curve, Curve::Constant);
    let expected = Velocity {
        body: Mover::Deformable(BodyId(1)),
        velocity: Vec3::new(1.0, 2.0, 3.0),
        spin: Vec3::new(0.0, 0.0, 4.0),
        about: Vec3::new(5.0, 6.0, 7.0),
    };
    assert_eq!(press.velocities, [expected]);
    let fast = model.pairs[0].friction.cap(1.0, 2.0);
    assert!((fast - 0.15 * (1.0 + (-1.0_f64).exp())).abs() < 1e-15);
}

#[test]
fn friction_that_depends_on_pressure_and_slip_rate() {
    let read = |keys: &str| {
        let friction = format!(r#"{{ law = "coulomb", mu = 0.3, {keys} }}"#);
        let text = BASE.replace(r#"{ law = "coulomb", mu = 0.3 }"#, &friction);
        let text = text.replace(
            r#"{ pair = "interface", law = "frictionless" }"#,
            &format!(r#"{{ pair = "interface", law = "coulomb", mu = 0.3, {keys} }}"#),
        );
        let model = parse(&text, "deck.toml", Path::new("")).unwrap().model;
        let friction = model.pairs[0].friction.clone();
        assert_eq!(model.steps[1].frictions[0].1, friction);
        friction
    };
    let close = |friction: &Friction, [p, v]: [f64; 2], expected: f64| {
        let found = friction.cap(p, v);
        assert!(
            (found - expected).abs() < 1e-13 * expected,
            "{found} {expected}"
        );
    };
    let power = read(r#"by_pressure = { form = "power-law", exponent = 0.5, pressure = 4 }"#);
    close(&power, [9.0, 0.0], 0.3 * 6.0);
    let floor =
        read(r#"by_pressure = { form = "power-law", exponent = 0.5, pressure = 4, floor = 100 }"#);
    // `V = 20`, `S = 0.1` and half of the floor.
    close(&floor, [50.0, 0.0], 0.3 * (15.0 - 2.5));
    let adhesion = read(r#"by_pressure = { form = "adhesion", pressure = 2 }"#);
    close(&adhesion, [5.0, 0.0], 0.3 * 7.0);
    let saturation = read(r#"by_pressure = { form = "saturation", shear_stress = 0.2 }"#);
    close(&saturation, [5.0, 0.0], 0.2 * 7.5_f64.tanh());
    let table =
        r#"by_pressure = { form = "table", pressures = [1, 2, 4], factors = [1, 0.9, 0.5] }"#;
    close(&read(table), [2.0, 0.0], 0.3 * 1.8);
    let stribeck =
        r#"by_slip_rate = { form = "stribeck", kinetic_over_static = 0.5, slip_rate = 2 }"#;
    close(
        &read(stribeck),
        [1.0, 3.0],
        0.15 * (1.0 + (-2.25_f64).exp()),
    );
    let viscous = r#"by_slip_rate = { form = "stribeck", kinetic_over_static = 0.5, slip_rate = 2, exponent = 1, viscous = 0.1 }"#;
    let expected = 0.15 * (1.0 + (-1.5_f64).exp()) + 0.09;
    close(&read(viscous), [1.0, 3.0], expected);
    let logarithm =
        r#"by_slip_rate = { form = "logarithm", factor = -0.1, slip_rate = 1, limit = 2 }"#;
    close(
        &read(logarithm),
        [1.0, 3.0],
        0.3 * (1.0 - 0.1 * 3.0_f64.ln()),
    );
    let run_in =
        r#"by_accumulated_slip = { form = "exponential", final_over_initial = 1.5, slip = 0.2 }"#;
    let after = read(run_in).cap_after(0.1, 2.0, 0.0);
    let expected = 0.6 * (1.5 - 0.5 * (-0.5_f64).exp());
    assert!((after - expected).abs() < 1e-14, "{after} {expected}");
    let state = r#"by_state = { form = "ageing-law", direct_effect = 0.01, evolution_effect = 0.02, slip_rate = 0.1, slip_distance = 0.5 }"#;
    let read_state = read(state);
    assert_eq!(read_state.rate_and_state().unwrap().state, 5.0);
    close(&read_state, [2.0, 0.3], 2.0 * (0.3 - 0.01 * 3.0_f64.ln()));
    let both = format!(
        "by_slip_rate = {{ form = \"table\", slip_rates = [0, 3], factors = [1, 2] }}, {table}"
    );
    close(&read(&both), [4.0, 3.0], 0.3 * 2.0 * 0.5 * 4.0);
}

#[test]
fn a_density_gives_mass_centre_and_inertia() {
    let text = BASE.replace(
        "plane = { point = [0, 0, 0], normal = [0, 0, 1] }",
        "mesh = { positions = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], facets = [[1, 2, 3, 3], [0, 2, 1, 1], [0, 1, 3, 3], [0, 3, 2, 2]] }\ndensity = 6",
    );
    let deck = parse(&text, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    let rigid = &deck.model.rigid_surfaces[0];
    let inertia = rigid.inertia.unwrap();
    // rho/6 is 1; second moments of the coordinates about the centre 3/80, products -1/80.
    assert!((inertia.mass - 1.0).abs() < 1e-14);
    assert!((rigid.reference - Vec3::repeat(0.25)).norm() < 1e-14);
    let mut moments = inertia.moments;
    moments.sort_by(f64::total_cmp);
    for (found, expected) in moments.into_iter().zip([0.0625, 0.0625, 0.1]) {
        assert!((found - expected).abs() < 1e-14, "{moments:?}");
    }
    let stated = text.replace("density = 6", "density = 6\nreference = [0, 0, 9]");
    let deck =
        parse(&stated, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    let rigid = &deck.model.rigid_surfaces[0];
    assert_eq!(rigid.reference, Vec3::new(0.0, 0.0, 9.0));
    assert_eq!(rigid.inertia, Some(inertia));
}

#[test]
fn paths_are_relative_to_the_deck() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid s\n";
    std::fs::write(folder.path().join("road.stl"), triangle).unwrap();
    let text = BASE.replace(
        "plane = { point = [0, 0, 0], normal = [0, 0, 1] }",
        r#"mesh = { file = "road.stl" }"#,
    );
    let path = folder.path().join("deck.toml");
    std::fs::write(&path, text).unwrap();
    let deck = read(&path).unwrap_or_else(|faults| panic!("{faults}"));
    let RigidShape::Facets { positions, facets } = &deck.model.rigid_surfaces[0].shape else {
        panic!("facets")
    };
    assert_eq!((positions.len(), facets.len()), (3, 1));

    let absent = read(&folder.path().join("absent.toml")).unwrap_err();
    assert_eq!(absent.iter().len(), 1);
    assert_eq!(absent.iter().next().unwrap().position, None);
}

#[test]
fn faults_are_shown_with_the_line_underlined() {
    let text = "title = \"t\u{e9}st\"\n[solver]\n\ttolerance = \"small\" # why\n";
    let shown = parse(text, "a.toml", Path::new(""))
        .unwrap_err()
        .to_string();
    let expected = "\
a.toml:3:14: `tolerance` in [solver] must be a number greater than 0, but is the text \"small\"
    3 |  tolerance = \"small\" # why
      |              ^^^^^^^
3 faults";
    assert!(shown.ends_with(expected), "{shown}");
}

#[test]
fn elements_of_files_choose_the_formulation_and_are_noted() {
    let edges = [
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
    let corners = CellKind::Hexahedron.shape().corners.iter();
    let mut nodes: Vec<Vec3> = corners.map(|x| Vec3::from(*x)).collect();
    nodes.extend(edges.map(|[a, b]| (nodes[a] + nodes[b]) / 2.0));
    let mut file = String::from("*NODE\n");
    for (at, x) in nodes.iter().enumerate() {
        file += &format!("{}, {}, {}, {}\n", at + 1, x.x, x.y, x.z);
    }
    file += "*ELEMENT, TYPE=C3D20RH\n7, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,\n";
    file += "16, 17, 18, 19, 20\n";
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.inp"), file).unwrap();
    let text = |formulation: &str| {
        format!(
            r#"title = "A cube"
            body = [{{ name = "cube", material = "rubber", mesh = {{ file = "cube.inp" }}{formulation} }}]
            material = [{{ name = "rubber", law = "neo-hookean", youngs_modulus = 1.0, poissons_ratio = 0.3 }}]
            step = [{{ name = "hold", displacement = [{{ body = "cube", nodes = "all", x = 0, y = 0, z = 0 }}] }}]"#
        )
    };
    let read = |formulation: &str| {
        let deck = parse(&text(formulation), "deck.toml", folder.path());
        deck.unwrap_or_else(|faults| panic!("{faults}"))
    };
    let deck = read("");
    assert_eq!(
        deck.model.bodies[0].formulation,
        Formulation::MeanDilatation
    );
    assert_eq!(deck.model.bodies[0].mesh.element_count(), 8);
    assert_eq!(
        deck.notes,
        [
            "body `cube`: elements C3D20RH are read as elements with full integration",
            "body `cube`: 1 hexahedron of 20 nodes is divided into 8 linear ones",
        ]
    );
    let stated = read(r#", formulation = "standard""#);
    assert_eq!(stated.model.bodies[0].formulation, Formulation::Standard);
}

#[test]
fn a_solver_of_ranks_is_a_fault_where_there_are_none() {
    assert!(lowered(BASE).alone().is_ok());
    let deck = lowered(&BASE.replace(r#""faer""#, r#""mumps""#));
    assert_eq!(deck.model.solver.backend, Backend::Mumps);
    let faults = deck.alone().unwrap_err().to_string();
    let place = "deck.toml:44:11: `backend = \"mumps\"` needs PETSc: build with";
    assert!(faults.starts_with(place), "{faults}");
    assert!(faults.contains("`backend = \"multifrontal\"`"));
}
