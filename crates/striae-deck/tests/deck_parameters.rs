//! Parameters, expressions, settings from outside, and files that a deck includes.

use std::{fs, path::Path};

use striae_deck::{Faults, Setting, parse, parse_with, read, read_with};
use striae_model::Model;

const DECK: &str = r#"
title = "A block on a floor"
[parameters]
L = 2
E = 1e6
n = "= 2*L"
depth = "= L/100"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = "= 3*E"
poissons_ratio = 0.3
[[body]]
name = "block"
material = "rubber"
mesh = { generator = "block", size = ["= L", "= L", 1], divisions = ["= n", 4, "= round(n/3)"] }
[[rigid]]
name = "floor"
plane = { point = [0, 0, 0], normal = [0, 0, 1] }
[[pair]]
name = "sole"
a = { body = "block", facets = "zmin" }
b = { rigid = "floor" }
[[step]]
name = "press"
displacement = [{ body = "block", nodes = "zmax", x = 0, y = 0, z = "= -depth" }]
"#;

fn told(result: Result<striae_deck::Deck, Faults>) -> String {
    result.expect_err("a fault").to_string()
}

fn changed(from: &str, to: &str) -> String {
    assert_eq!(DECK.matches(from).count(), 1, "{from}");
    DECK.replace(from, to)
}

fn depth(model: &Model) -> f64 {
    model.steps[0].displacements[0].numbers()[2].expect("z")
}

#[test]
fn numbers_may_be_expressions_of_parameters() {
    let model = parse(DECK, "deck.toml", Path::new("")).unwrap().model;
    let mesh = &model.bodies[0].mesh;
    assert_eq!((mesh.element_count(), mesh.positions.len()), (16, 50));
    assert!((mesh.volume() - 4.0).abs() < 1e-12);
    let modulus = model.bodies[0].material.lame_constants().youngs_modulus();
    assert!((modulus / 3e6 - 1.0).abs() < 1e-12);
    assert_eq!(depth(&model), -0.02);
}

#[test]
fn parameters_are_set_from_outside() {
    let set = |words: &str| -> Vec<Setting> { vec![words.parse().unwrap()] };
    let with = |words: &str| parse_with(DECK, "deck.toml", Path::new(""), &set(words));
    assert_eq!(depth(&with("L=4").unwrap().model), -0.04);
    let set = with("depth=2*0.25").unwrap();
    assert_eq!(depth(&set.model), -0.5);
    assert_eq!(
        set.notes,
        ["parameters: E = 1000000, L = 2, depth = 0.5, n = 4"]
    );
    assert_eq!(
        told(with("l=4")).lines().next(),
        Some(
            "deck.toml:3:1: `--set l=...` does not set a parameter of this deck; its [parameters] are `E`, `L`, `depth`, `n`"
        ),
    );
    for (words, cause) in [
        ("L", "expected NAME=VALUE, such as `E=2e6`, found `L`"),
        (
            "L=much",
            "`much` is not a number: `much` does not refer to a number here",
        ),
        ("L=", "`` is not a number: expected a number"),
    ] {
        let found = words.parse::<Setting>().unwrap_err();
        assert!(found.contains(cause), "{found}");
    }
}

fn with(deck: &str, settings: &[&str]) -> Result<striae_deck::Deck, Faults> {
    let settings: Vec<Setting> = settings.iter().map(|one| one.parse().unwrap()).collect();
    parse_with(deck, "deck.toml", Path::new(""), &settings)
}

#[test]
fn any_number_of_the_deck_is_set_by_its_path() {
    let set = |settings: &[&str]| with(DECK, settings).unwrap();
    assert_eq!(
        depth(&set(&["step.press.displacement.0.z=-0.5"]).model),
        -0.5
    );
    let wide = set(&["body.block.mesh.size.1=8", "body.block.mesh.divisions.0=3"]);
    let mesh = &wide.model.bodies[0].mesh;
    assert_eq!(mesh.element_count(), 12);
    assert!((mesh.volume() - 16.0).abs() < 1e-12);
    assert!(wide.notes[1].starts_with("set: body.block.mesh.size.1 = 8, "));
    let modulus = |deck: &striae_deck::Deck| {
        let material = &deck.model.bodies[0].material;
        material.lame_constants().youngs_modulus()
    };
    let path = "material.rubber.youngs_modulus";
    let last = set(&[&format!("{path}=2"), &format!("{path}=7")]);
    assert!((modulus(&last) - 7.0).abs() < 1e-12, "the last one counts");
    let parameter = set(&["parameters.E=1"]);
    assert!((modulus(&parameter) - 3.0).abs() < 1e-12);
    // A name may have dots, and what an expression came to does not matter any more.
    let dotted = DECK
        .replace("\"rubber\"", "\"no. 1\"")
        .replace("\"= 3*E\"", "\"= 1/0\"");
    assert!(with(&dotted, &[]).is_err());
    let dotted = with(&dotted, &["material.no. 1.youngs_modulus=5"]).unwrap();
    assert!((modulus(&dotted) - 5.0).abs() < 1e-12);
}

#[test]
fn paths_that_lead_to_no_number_are_refused_with_what_is_there() {
    for (setting, message) in [
        (
            "material.ruber.youngs_modulus=1",
            "`material.ruber.youngs_modulus` is no number of this deck; `material` has `rubber`; did you mean `rubber`?",
        ),
        (
            "material.rubber.density=1",
            "`material.rubber` has `law`, `name`, `poissons_ratio`, `youngs_modulus`",
        ),
        ("sptep.x=1", "the deck has `body`, `material`, `pair`,"),
        (
            "step.press.duration=2",
            "`step.press` has `displacement`, `name`; a number that the deck leaves to its default must be stated there first",
        ),
        (
            "body.block.mesh.size.3=1",
            "`body.block.mesh.size` has `0`, `1`, `2`",
        ),
        (
            "body.block.mesh.size.0.x=1",
            "`body.block.mesh.size.0` has none",
        ),
        (
            "material.rubber.law=1",
            "deck.toml:10:7: `material.rubber.law` is no number but the text \"neo-hookean\"",
        ),
        (
            "pair.sole.a=1",
            "`pair.sole.a` is no number but a table; it has `body`, `facets`",
        ),
        ("parameters.l=1", "its [parameters] are `E`, `L`"),
        (".=1", "the deck has"),
        (
            "material.=1",
            "`material.` is no number but a list of 1; it has `rubber`",
        ),
        (
            "material.rubber.poissons_ratio=0.7",
            "deck.toml:12:18: `poissons_ratio` in [[material]] must be",
        ),
    ] {
        let found = told(with(DECK, &[setting]));
        assert!(found.contains(message), "{setting}: {found}");
    }
}

#[test]
fn settings_are_written_as_they_are_read() {
    for (text, written) in [
        ("E=2e6", "E=2000000"),
        ("E=2e20", "E=2e20"),
        ("a.b=-1/1e7", "a.b=-1e-7"),
        ("mu=0.1+0.2", "mu=0.30000000000000004"),
        ("mu=0", "mu=0"),
    ] {
        let setting: Setting = text.parse().unwrap();
        assert_eq!(setting.to_string(), written);
        assert_eq!(written.parse::<Setting>().unwrap(), setting);
    }
}

#[test]
fn expressions_are_rounded_by_no_more_than_their_round_off() {
    for (expression, value) in [
        ("123456789.1", 123_456_789.1),
        ("1e-19", 1e-19),
        ("0.3/0.1", 3.0),
    ] {
        let deck = changed("\"= -depth\"", &format!("\"= {expression}\""));
        let model = parse(&deck, "deck.toml", Path::new("")).unwrap().model;
        assert_eq!(depth(&model), value);
    }
}

#[test]
fn faults_of_expressions_have_their_places() {
    for (from, to, message) in [
        (
            "\"= 3*E\"",
            "\"= 3*G\"",
            "deck.toml:11:18: this expression cannot be computed: there is no parameter `G`; [parameters] has `E`, `L`, `depth`, `n`",
        ),
        (
            "\"= 3*E\"",
            "\"= 3*(E\"",
            "deck.toml:11:18: this expression cannot be computed: expected `)`, found the end",
        ),
        (
            "\"= 2*L\"",
            "\"= 2*depth*n\"",
            "deck.toml:6:5: this expression cannot be computed: `n` is computed from itself; give it as a number",
        ),
        (
            "L = 2",
            "L = \"= depth\"",
            "`L` is computed from itself over `depth`; give one of them as a number",
        ),
        (
            "\"= -depth\"",
            "\"= depth/0\"",
            "this expression cannot be computed: division by zero",
        ),
        (
            "\"= 3*E\"",
            "\"= -E\"",
            "deck.toml:11:18: `youngs_modulus` in [[material]] must be a number greater than 0, but is -1000000",
        ),
        (
            "\"= n\"",
            "\"= n/3\"",
            "must be a whole number of at least 1, but is 1.3",
        ),
        (
            "L = 2",
            "L = [2]",
            "deck.toml:4:5: parameter `L` must be a number or an expression such as \"= 2*E\", but is a list of 1",
        ),
        (
            "L = 2",
            "L = true",
            "deck.toml:6:5: this expression cannot be computed: parameter `L` is not a number",
        ),
        (
            "L = 2",
            "L = 2\n2nd = 1",
            "`2nd` is not a valid parameter name",
        ),
        (
            "[parameters]",
            "[parameters]\npi = 3",
            "`pi` is not a valid parameter name",
        ),
    ] {
        let found = told(parse(&changed(from, to), "deck.toml", Path::new("")));
        assert!(found.contains(message), "{to}: {found}");
    }
}

/// Expressions that need a parameter without a value are no faults of their own.
#[test]
fn faults_of_parameters_are_told_once() {
    let found = told(with(&changed("L = 2", "L = \"= n\""), &[]));
    let lines = found.lines().filter(|line| line.starts_with("deck.toml:"));
    let places: Vec<&str> = lines.map(|line| &line[..13]).collect();
    assert_eq!(
        places,
        ["deck.toml:4:5", "deck.toml:6:5", "deck.toml:7:9"],
        "{found}"
    );
    let found = told(with(&changed("L = 2", "L = true"), &[]));
    assert!(found.ends_with("3 faults"), "{found}");
}

#[test]
fn what_doubles_with_every_parameter_takes_no_time() {
    let mut text = String::from("title = \"t\"\n[parameters]\np0 = 1\n");
    for at in 1..45 {
        let before = at - 1;
        text += &format!("p{at} = \"= p{before} + p{before}\"\n");
    }
    let found = told(parse(&text, "deck.toml", Path::new("")));
    assert!(found.contains("has no [[body]]"), "{found}");
    assert!(!found.contains("expression"), "{found}");
}

#[test]
fn included_files_count_as_if_they_stood_in_the_deck() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let at = |text: &str| DECK.find(text).unwrap();
    let (material, rest) = (at("[[material]]"), at("[[body]]"));
    write(
        "parts.toml",
        &("E = 7\n".to_owned() + &DECK[material..rest]),
    );
    fs::create_dir(folder.path().join("more")).unwrap();
    write(
        "more/shared.toml",
        "include = \"../parts.toml\"\n[parameters]\nE = 1\nspare = 3\n",
    );
    let deck = "include = [\"more/shared.toml\"]".to_owned() + &DECK[..material] + &DECK[rest..];
    write("deck.toml", &deck);
    let path = folder.path().join("deck.toml");
    let found = told(read(&path));
    assert!(
        found.contains("parts.toml:1:1: unknown key `E` in the deck"),
        "{found}"
    );
    write("parts.toml", &DECK[material..rest]);
    let model = read(&path).unwrap().model;
    let modulus = model.bodies[0].material.lame_constants().youngs_modulus();
    assert!((modulus / 3e6 - 1.0).abs() < 1e-12, "the deck counts");
    read_with(&path, &[Setting::new("spare", 1.0)]).unwrap();
    write("parts.toml", &DECK[material..rest].replace("0.3", "0.7"));
    let found = told(read(&path));
    let words = "parts.toml:5:18: `poissons_ratio` in [[material]] must be";
    assert!(found.contains(words), "{found}");
    write("parts.toml", "include = \"more/shared.toml\"");
    let found = told(read(&path));
    let words =
        "parts.toml:1:11: `more/shared.toml` cannot be included: it includes itself by way of";
    assert!(found.contains(words), "{found}");
    write("parts.toml", "include = \"parts.toml\"");
    let found = told(read(&path));
    assert!(found.contains("included: it includes itself\n"), "{found}");
    write("parts.toml", "include = \"deck.toml\"");
    let found = told(read(&path));
    let words = "`deck.toml` cannot be included: it includes itself by way of `";
    assert!(found.contains(words), "{found}");
    assert!(!found.contains("already"), "{found}");
    write("parts.toml", "");
    let twice = deck.replace("shared.toml\"", "shared.toml\", \"parts.toml\"");
    write("deck.toml", &twice);
    let found = told(read(&path));
    assert!(found.contains("it is already included"), "{found}");
    write("parts.toml", "\u{feff}[[body]]\nname = \"block\"\n");
    write("deck.toml", &deck);
    let found = told(read(&path));
    assert!(found.contains("parts.toml`, line 2"), "{found}");
    write("deck.toml", &deck.replace("more/shared", "none"));
    let found = told(read(&path));
    assert!(
        found.contains("deck.toml:1:12: `none.toml` cannot be included"),
        "{found}"
    );
}

#[test]
fn valid_keys_are_listed_with_an_unknown_one() {
    let found = told(parse(
        &changed("name = \"floor\"", "name = \"floor\"\ncolour = 1"),
        "deck.toml",
        Path::new(""),
    ));
    let list = "      = valid keys: `density`, `inertia`, `mass`, `name`, `plane`, `reference`";
    assert!(found.contains(list), "{found}");
}
