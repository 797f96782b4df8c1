//! `[contact]`: what it comes down to, and what is wrong with it.
//!
//! Longer than other files, as each key and each fault has a test.

mod deck;

use deck::schema::{Verdict, verdict};
use std::{collections::BTreeSet, path::Path};
use striae_deck::{parse, write};
use striae_law::friction::Friction;
use striae_mesh::Face;
use striae_model::{BodyId, ContactSurface, Initial, Model, Pair, RigidId};
use striae_surface::texture::{Lines, Paint};

/// A tread on a carcass, with a gap between them, above a road.
const SCENE: &str = r#"
title = "A tread"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "tread"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 0.1], size = [1, 1, 0.5], divisions = [2, 2, 1] }
[[body]]
name = "carcass"
material = "rubber"
mesh = { generator = "block", origin = [0, 0, 0.7], size = [1, 1, 0.5], divisions = [2, 2, 1] }
[[rigid]]
name = "road"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[step]]
name = "press"
displacement = [{ body = "tread", nodes = "all", x = 0, y = 0, z = 0 }, { body = "carcass", nodes = "zmax", x = 0, y = 0, z = -0.2 }]
"#;

fn model(more: &str) -> Model {
    let text = SCENE.replace("nodes = \"all\"", "nodes = \"zmax\"") + more;
    assert_eq!(verdict(&text), Verdict::Accepted, "{text}");
    let deck = parse(&text, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    deck.model
}

/// Faults of a deck, without their places.
fn faults(more: &str) -> Vec<String> {
    let text = SCENE.replace("nodes = \"all\"", "nodes = \"zmax\"") + more;
    let faults = parse(&text, "deck.toml", Path::new("")).unwrap_err();
    let told = faults.iter().map(ToString::to_string);
    let message = |told: String| told.splitn(4, ':').last().unwrap_or("").trim().to_owned();
    told.map(message).collect()
}

fn names(model: &Model) -> Vec<&str> {
    model.pairs.iter().map(|pair| pair.name.as_str()).collect()
}

fn pair<'m>(model: &'m Model, name: &str) -> &'m Pair {
    let mut pairs = model.pairs.iter();
    let found = pairs.find(|pair| pair.name == name);
    found.unwrap_or_else(|| panic!("{name}: {:?}", names(model)))
}

fn faces(surface: &ContactSurface) -> (BodyId, Vec<Face>) {
    match surface {
        ContactSurface::Deformable { body, faces } => (*body, faces.clone()),
        other => panic!("{other:?}"),
    }
}

/// Body and face; a rigid surface comes after all bodies and has none.
type Part = (usize, Option<Face>);

/// All couples of facets and rigid surfaces that pairs let touch, how often, and by which pair.
fn couples(model: &Model) -> Vec<(Part, Part, String)> {
    let members = |surface: &ContactSurface| -> Vec<(usize, Option<Face>)> {
        match surface {
            ContactSurface::Deformable { body, faces } => {
                faces.iter().map(|face| (body.0, Some(*face))).collect()
            }
            ContactSurface::Rigid(rigid) => vec![(model.bodies.len() + rigid.0, None)],
            ContactSurface::Itself => Vec::new(),
        }
    };
    let mut couples = Vec::new();
    for pair in &model.pairs {
        let [a, b] = pair.surfaces().map(members);
        for &x in &a {
            for &y in b.iter().filter(|y| !pair.is_on_itself() || x <= **y) {
                couples.push((x.min(y), x.max(y), pair.name.clone()));
            }
        }
    }
    couples.sort();
    couples
}

/// Number of couples of distinct skins, and of facets of one skin with each other and itself.
fn all_couples(model: &Model) -> usize {
    let skins = model
        .bodies
        .iter()
        .map(|body| body.mesh.boundary_faces().len());
    let skins: Vec<usize> = skins.collect();
    let (all, rigid): (usize, usize) = (skins.iter().sum(), model.rigid_surfaces.len());
    all * (all + 1) / 2 + all * rigid
}

#[track_caller]
fn assert_each_once(model: &Model, expected: usize) {
    let found = couples(model);
    let distinct: BTreeSet<_> = found.iter().map(|(x, y, _)| (x, y)).collect();
    assert_eq!(found.len(), distinct.len(), "a couple is in two pairs");
    assert_eq!(found.len(), expected);
}

#[test]
fn everything_touches_everything_and_itself() {
    let model = model("[contact]\nall = true\nfriction = { law = \"coulomb\", mu = 0.3 }");
    assert_eq!(
        names(&model),
        [
            "tread-tread",
            "tread-carcass",
            "tread-road",
            "carcass-carcass",
            "carcass-road"
        ]
    );
    let own = pair(&model, "tread-tread");
    assert!(own.is_on_itself());
    assert_eq!(
        faces(&own.a),
        (BodyId(0), model.bodies[0].mesh.boundary_faces())
    );
    let road = pair(&model, "carcass-road");
    assert!(matches!(road.b, ContactSurface::Rigid(RigidId(0))));
    for pair in &model.pairs {
        assert_eq!(pair.feature_angle, Some(45.0));
        assert_eq!(pair.friction, Friction::coulomb(0.3).unwrap());
        assert_eq!(pair.textures, [None, None]);
    }
    assert_each_once(&model, all_couples(&model));
}

#[test]
fn nothing_more_touches_without_it() {
    assert!(model("").pairs.is_empty());
    assert!(
        model("[contact]\nall = false\nexclude = [{ a = \"nobody\" }]")
            .pairs
            .is_empty()
    );
}

#[test]
fn settings_are_those_of_each_pair_and_hold_between_bodies() {
    let model = model(
        "[contact]\nall = true\nfeature_angle = 30\nsearch_distance = 0.2\ninitial = \"resolve\"\nstabilise = true",
    );
    for pair in &model.pairs {
        let own = pair.is_on_itself();
        assert_eq!(pair.feature_angle, Some(30.0));
        assert_eq!(pair.search_distance, Some(0.2));
        assert_eq!(pair.stabilised, !own);
        let initial = if own {
            Initial::AsMeshed
        } else {
            Initial::Resolve
        };
        assert_eq!(pair.initial, initial);
    }
}

#[test]
fn the_narrowest_statement_counts() {
    let model = model(
        r#"[contact]
all = true
friction = { law = "coulomb", mu = 0.1 }
exclude = [{ a = "carcass", b = "carcass" }, { a = "tread.xmin" }]
[[contact.between]]
a = "tread"
b = "road"
friction = { law = "coulomb", mu = 0.2 }
[[contact.between]]
a = "road"
b = "tread.zmin"
friction = { law = "coulomb", mu = 0.3 }
[[contact.between]]
a = "tread.xmin"
b = "carcass"
friction = { law = "coulomb", mu = 0.4 }
[[contact.between]]
a = "tread.xmin"
b = "road"
friction = { law = "coulomb", mu = 0.5 }
"#,
    );
    let mu = |name: &str| pair(&model, name).friction.clone();
    let expected = [
        ("tread.rest-tread.rest", 0.1),
        ("tread.rest-carcass", 0.1),
        ("tread.xmin-carcass", 0.4),
        ("tread.rest-2-road", 0.2),
        ("tread.zmin-road", 0.3),
        ("tread.xmin-road", 0.5),
        ("carcass-road", 0.1),
    ];
    let found: BTreeSet<&str> = names(&model).into_iter().collect();
    assert_eq!(found, expected.iter().map(|(name, _)| *name).collect());
    for (name, coefficient) in expected {
        assert_eq!(mu(name), Friction::coulomb(coefficient).unwrap(), "{name}");
    }
    let skin = model.bodies[0].mesh.boundary_faces().len();
    let xmin = model.bodies[0].mesh.facet_sets.get("xmin").unwrap().len();
    let carcass = model.bodies[1].mesh.boundary_faces().len();
    // All but the carcass with itself, and those of `xmin` with its body.
    let within = carcass * (carcass + 1) / 2 + xmin * (xmin + 1) / 2 + xmin * (skin - xmin);
    assert_each_once(&model, all_couples(&model) - within);
}

#[test]
fn parts_of_one_body_have_their_own_friction() {
    let model = model(
        r#"[contact]
all = true
[[contact.between]]
a = "tread.xmin"
b = "tread"
friction = { law = "coulomb", mu = 0.2 }
"#,
    );
    let rough = |pair: &&Pair| pair.friction != Friction::frictionless();
    let rough: Vec<&Pair> = model.pairs.iter().filter(rough).collect();
    let told: Vec<&str> = rough.iter().map(|pair| pair.name.as_str()).collect();
    assert_eq!(told, ["tread.xmin-tread.xmin", "tread.rest-tread.xmin"]);
    assert!(!rough[1].is_on_itself());
    assert_each_once(&model, all_couples(&model));
}

const NAMED: &str = r#"
[contact]
all = true
[[pair]]
name = "tread-road"
a = { body = "tread", facets = "zmin" }
b = { rigid = "road" }
"#;

#[test]
fn named_pairs_keep_their_couples_and_names() {
    let model = model(NAMED);
    let zmin = model.bodies[0].mesh.facet_sets.get("zmin").unwrap();
    assert_eq!(model.pairs[0].feature_angle, None);
    let rest = pair(&model, "tread.rest-road");
    assert!(faces(&rest.a).1.iter().all(|face| !zmin.contains(face)));
    assert_eq!(
        faces(&pair(&model, "tread-tread").a).1.len(),
        faces(&rest.a).1.len() + zmin.len()
    );
    assert_each_once(&model, all_couples(&model));
}

#[test]
fn a_surface_that_touches_itself_can_be_named() {
    let own = "[[pair]]\nname = \"slit\"\na = { body = \"tread\", facets = \"xmin\" }\nb = \"itself\"\nfeature_angle = 60\n";
    let alone = model(own);
    assert!(alone.pairs[0].is_on_itself());
    assert_eq!(alone.pairs[0].feature_angle, Some(60.0));
    let both = model(&format!("[contact]\nall = true\n{own}"));
    assert_each_once(&both, all_couples(&both));
}

#[test]
fn glued_facets_are_left_out() {
    let glued = r#"
[contact]
all = true
[[tie]]
name = "glue"
a = { body = "tread", facets = "zmax" }
b = { body = "carcass", facets = "all" }
within = 0.11
"#;
    let model = model(glued);
    let sets = [(0, "zmax"), (1, "zmin")]
        .map(|(body, set): (usize, &str)| model.bodies[body].mesh.facet_sets.get(set).unwrap());
    let [_, zmin] = sets;
    for (x, y, pair) in couples(&model) {
        for (body, face) in [x, y] {
            let glued = sets.get(body);
            assert!(
                !glued
                    .zip(face)
                    .is_some_and(|(set, face)| set.contains(&face)),
                "{pair}"
            );
        }
    }
    let own = faces(&pair(&model, "carcass-carcass").a).1;
    assert_eq!(
        own.len(),
        model.bodies[1].mesh.boundary_faces().len() - zmin.len()
    );
}

#[test]
fn textures_divide_surfaces_where_a_law_needs_them() {
    let text = r#"
[contact]
all = true
[[contact.between]]
a = "tread.zmin"
b = "road"
friction = { law = "nap", mu_forward = 0.3, mu_backward = 0.6, mu_lateral = 0.5 }
[[contact.surface]]
of = "tread"
texture = { uniform = [1, 0, 0] }
[[contact.surface]]
of = "tread.zmin"
texture = { uniform = [0, 1, 0] }
"#;
    let model = model(text);
    let textured = pair(&model, "tread.zmin-road");
    let Some(Paint::Field(field)) = &textured.textures[0] else {
        panic!("{:?}", textured.textures)
    };
    assert_eq!(field.lines, Lines::Uniform([0.0, 1.0, 0.0].into()));
    assert_eq!(pair(&model, "tread-carcass").textures, [None, None]);
    assert_each_once(&model, all_couples(&model));
}

/// A statement of two surfaces keeps their textures, which the law of a later step needs.
#[test]
fn textures_stay_for_laws_of_later_steps() {
    let text = |of: &str| {
        format!(
            r#"
friction = [{{ pair = "tread.zmin-road", law = "orthotropic", mu_along = 0.1, mu_across = 0.4 }}]
[contact]
all = true
[[contact.between]]
a = "tread.zmin"
b = "road"
friction = {{ law = "coulomb", mu = 0.3 }}
[[contact.surface]]
of = "{of}"
texture = {{ uniform = [0, 1, 0] }}
"#
        )
    };
    let model = model(&text("tread.zmin"));
    let textures = &pair(&model, "tread.zmin-road").textures;
    assert!(matches!(textures, [Some(Paint::Field(_)), None]));
    let found = faults(&text("carcass"));
    assert!(
        found[0].contains("name the textured facets as `of` of a `[[contact.surface]]`"),
        "{found:?}"
    );
}

/// A set of facets that is called `rest` is no rest: a step that changes the friction of its pair
/// would change that of all other facets instead.
#[test]
fn a_set_may_be_called_rest() {
    let block = "divisions = [2, 2, 1] }\n[[body]]\nname = \"carcass\"";
    let with_set = block.replacen(
        '\n',
        "\nfacet_sets = [{ name = \"rest\", of = \"zmin\", from = [-1, -1, 0], to = [0.6, 2, 1] }]\n",
        1,
    );
    let text = SCENE
        .replace("nodes = \"all\"", "nodes = \"zmax\"")
        .replace(block, &with_set)
        + r#"
[contact]
all = true
[[contact.between]]
a = "tread.rest"
b = "road"
friction = { law = "coulomb", mu = 0.1 }
"#;
    let deck = parse(&text, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    let stated = Friction::coulomb(0.1).unwrap();
    assert_eq!(pair(&deck.model, "tread.rest-road").friction, stated);
    let rest = &pair(&deck.model, "tread.rest-2-road").friction;
    assert!(rest.is_frictionless());
}

/// `x-y-z` could be two pairs of these bodies, so none is called so.
#[test]
fn names_with_hyphens_are_told_apart() {
    let bodies = ["x", "y-z", "x-y", "z"].map(|name| {
        format!(
            "[[body]]\nname = \"{name}\"\nmaterial = \"rubber\"\nmesh = {{ generator = \"block\", origin = [0, 0, 5], size = [1, 1, 1], divisions = [1, 1, 1] }}\n"
        )
    });
    let scene = SCENE.replace("nodes = \"all\"", "nodes = \"zmax\"");
    let with = |changed: &str| {
        let step =
            format!("friction = [{{ pair = \"{changed}\", law = \"coulomb\", mu = 0.9 }}]\n");
        let text = format!("{scene}{step}{}[contact]\nall = true\n", bodies.concat());
        parse(&text, "deck.toml", Path::new("")).map_err(|faults| faults.to_string())
    };
    let found = with("x-y-z").unwrap_err();
    assert!(found.contains("no pair is named `x-y-z`"), "{found}");
    for name in ["x--y-z", "x-y--z"] {
        assert!(found.contains(&format!("`{name}`")), "{name}: {found}");
        let found = with(name).err().unwrap_or_default();
        assert!(!found.contains("no pair is named"), "{found}");
    }
}

#[test]
fn steps_change_friction_by_the_names_of_labels() {
    let changed = r#"
friction = [{ pair = "tread-road", law = "coulomb", mu = 0.9 }]
[contact]
all = true
"#;
    let model = model(changed);
    let (id, friction) = &model.steps[0].frictions[0];
    assert_eq!(model.pairs[id.0].name, "tread-road");
    assert_eq!(*friction, Friction::coulomb(0.9).unwrap());
    assert_eq!(
        faults(&changed.replace("tread-road", "tread-raod")),
        [
            "no pair is named `tread-raod`; there are `carcass-carcass`, `carcass-road`, `tread-carcass`, `tread-road`, `tread-tread`; did you mean `tread-road`?"
        ]
    );
}

#[test]
fn it_reads_back_as_pairs() {
    let text = format!(
        "{SCENE}{NAMED}[[contact.between]]\na = \"tread.xmin\"\nb = \"tread\"\nfriction = {{ law = \"coulomb\", mu = 0.2 }}\n"
    )
    .replace("nodes = \"all\"", "nodes = \"zmax\"");
    let deck = parse(&text, "deck.toml", Path::new("")).unwrap_or_else(|faults| panic!("{faults}"));
    let written = write(&deck.model, &deck.output).unwrap();
    let again = parse(&written, "deck.toml", Path::new("")).unwrap_or_else(|f| panic!("{f}"));
    assert_eq!(
        format!("{:?}", deck.model.pairs),
        format!("{:?}", again.model.pairs)
    );
}

#[test]
fn statements_that_contradict_each_other_are_named() {
    let between = |a: &str, b: &str| {
        format!(
            "[[contact.between]]\na = \"{a}\"\nb = \"{b}\"\nfriction = {{ law = \"coulomb\", mu = 0.2 }}\n"
        )
    };
    let all = "[contact]\nall = true\n".to_owned();
    let three = all.clone()
        + &between("tread", "road")
        + &between("carcass", "road")
        + &between("road", "tread");
    assert_eq!(
        faults(&three),
        [
            "`between` 1 and 3 both name tread and road, and neither is narrower; remove one of them, or give it facet sets, such as `body.set`"
        ]
    );
    let crossed =
        all.clone() + &between("tread.zmin", "carcass") + &between("tread", "carcass.xmin");
    assert_eq!(
        faults(&crossed),
        [
            "`between` 1 and 2 both name tread.zmin and carcass.xmin, and neither is narrower; remove one of them, or give it facet sets, such as `body.set`"
        ]
    );
    let decided = crossed + &between("tread.zmin", "carcass.xmin");
    assert_each_once(&model(&decided), all_couples(&model(&decided)));
    let excluded =
        format!("{all}exclude = [{{ a = \"road\", b = \"tread\" }}]\n") + &between("tread", "road");
    assert_eq!(
        faults(&excluded),
        [
            "`exclude` 1 and `between` 1 both name tread and road, and neither is narrower; remove one of them, or give it facet sets, such as `body.set`"
        ]
    );
    let painted = format!(
        "{all}surface = [{{ of = \"tread.zmin\", texture = {{ uniform = [0, 1, 0] }} }}, {{ of = \"tread.zmin\", texture = {{ uniform = [1, 0, 0] }} }}]"
    );
    assert_eq!(
        faults(&painted),
        [
            "`surface` 1 and 2 paint the same facets, of tread.zmin and tread.zmin, and neither is narrower; remove one of them, or give it another facet set"
        ]
    );
}

#[test]
fn statements_about_nothing_are_named() {
    let nothing = |what: &str| {
        format!(
            "{what} names nothing that can touch: named pairs and ties keep their facets, and rigid surfaces do not touch each other; remove it, or name other surfaces"
        )
    };
    let excluded = |labels: &str| faults(&format!("[contact]\nall = true\nexclude = [{labels}]"));
    assert_eq!(
        excluded("{ a = \"road\", b = \"road\" }"),
        [nothing("`exclude` 1")]
    );
    assert_eq!(
        faults(&format!(
            "{NAMED}[[contact.between]]\na = \"tread.zmin\"\nb = \"road\"\nfriction = {{ law = \"frictionless\" }}\n"
        )),
        [nothing("`between` 1")]
    );
    assert_eq!(
        excluded("{ a = \"raod\" }"),
        [
            "no body or rigid surface is named `raod`; there are `carcass`, `road`, `tread`; did you mean `road`?"
        ]
    );
    assert_eq!(
        excluded("{ a = \"tread.sole\" }"),
        [
            "body `tread` has no facet set `sole`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`"
        ]
    );
    assert_eq!(
        excluded("{ a = \"road.top\" }"),
        ["`road.top` is a part of rigid surface `road`, which has no sets; name all of it, `road`"]
    );
}

#[test]
fn friction_without_its_texture_is_told_where_it_is_stated() {
    let text = "[contact]\nall = true\n[[contact.between]]\na = \"tread\"\nb = \"road\"\nfriction = { law = \"nap\", mu_forward = 0.3, mu_backward = 0.6, mu_lateral = 0.5 }\n";
    let whole = SCENE.replace("nodes = \"all\"", "nodes = \"zmax\"") + text;
    let faults = parse(&whole, "deck.toml", Path::new("")).unwrap_err();
    let line = whole
        .lines()
        .position(|line| line.contains("law = \"nap\""))
        .unwrap()
        + 1;
    let found: Vec<String> = faults.iter().map(ToString::to_string).collect();
    let [found] = &found[..] else {
        panic!("{found:?}")
    };
    assert!(found.starts_with(&format!("deck.toml:{line}:")), "{found}");
    assert!(
        found.contains("the friction of pair `tread-road` needs a texture on one side"),
        "{found}"
    );
}

#[test]
fn keys_are_judged() {
    let missing = faults("[contact]\nfriction = { law = \"frictionless\" }");
    assert!(
        missing[0].starts_with("missing key `all` in [contact]"),
        "{missing:?}"
    );
    let angle = faults("[contact]\nall = true\nfeature_angle = 0");
    assert!(
        angle[0].starts_with("`feature_angle` in [contact] must be"),
        "{angle:?}"
    );
    let side = faults(
        "[[pair]]\nname = \"p\"\na = { body = \"tread\", facets = \"zmin\" }\nb = \"tread\"\n",
    );
    assert!(side[0].contains("itself"), "{side:?}");
    let rigid = faults("[[pair]]\nname = \"p\"\na = { rigid = \"road\" }\nb = \"itself\"\n");
    assert_eq!(
        rigid,
        [
            "pair `p`: a rigid surface does not touch itself; only side `b` can be `itself`, of a body on side `a`"
        ]
    );
    for (key, what) in [
        ("stabilise = true", "does not restrain the body"),
        ("enforcement = \"collocated\"", "is not collocated"),
        ("interference = 0.1", "has no `interference`"),
    ] {
        let found = faults(&format!(
            "[[pair]]\nname = \"p\"\na = {{ body = \"tread\", facets = \"zmin\" }}\nb = \"itself\"\n{key}\n"
        ));
        assert!(found[0].contains(what), "{found:?}");
    }
}
