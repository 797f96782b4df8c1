//! Faults found while a deck is read: syntax, keys, types, ranges, words.
//!
//! Longer than other files, as it is a table of decks and the exact messages they get.

mod deck;

use deck::{faulty, misread, misstated};

#[test]
fn syntax() {
    misread(
        "syntax: unclosed text",
        &[(r#"title = "Two blocks""#, r#"title = "Two blocks"#)],
        &[r#"1:20: not valid TOML: invalid basic string, expected `"`"#],
    );
    misread(
        "syntax: key without value",
        &[("fields_every = 2", "fields_every =")],
        &["42:15: not valid TOML: string values must be quoted, expected literal string"],
    );
    misread(
        "syntax: key given twice",
        &[("fields_every = 2", "fields_every = 2\nfields_every = 3")],
        &["43:1: not valid TOML: duplicate key"],
    );
    misread(
        "syntax: list without comma",
        &[("divisions = [4, 4, 2]", "divisions = [4 4, 2]")],
        &["10:64: not valid TOML: string values must be quoted, expected literal string"],
    );
    for (number, remedy) in [
        (".3", "0.3"),
        ("-.3", "-0.3"),
        ("3.", "3"),
        ("3.e2", "300"),
        ("03", "3"),
    ] {
        misread(
            "syntax: number that other readers know",
            &[("mu = 0.3", &format!("mu = {number}"))],
            &[&format!(
                "22:36: not valid TOML: `{number}` is not how it writes a number; write {remedy}"
            )],
        );
    }
}

#[test]
fn keys() {
    misread(
        "missing title",
        &[(
            r#"title = "Two blocks"
"#,
            "",
        )],
        &["1:1: missing key `title` in the deck; expected a text"],
    );
    misread(
        "unknown key of the deck",
        &[("[output]", "[outputs]")],
        &["41:2: unknown key `outputs` in the deck; did you mean `output`?"],
    );
    misread(
        "unknown key like no other",
        &[(
            "fields_every = 2",
            r#"fields_every = 2
colour = "red""#,
        )],
        &["43:1: unknown key `colour` in [output]"],
    );
    misread(
        "misspelled required key is not also missing",
        &[("divisions = [4, 4, 2]", "divsions = [4, 4, 2]")],
        &["10:51: unknown key `divsions` in [[body]] mesh; did you mean `divisions`?"],
    );
    misread(
        "misspelled key of a list element",
        &[(r#"components = ["z"]"#, r#"component = ["z"]"#)],
        &["38:46: unknown key `component` in [[step]] release; did you mean `components`?"],
    );
    misread(
        "key of another law",
        &[("mu = 0.3", "mu = 0.3, c_mag = 0.1")],
        &["22:41: unknown key `c_mag` in [[pair]] friction"],
    );
    misread(
        "missing material law",
        &[(
            r#"law = "neo-hookean"
"#,
            "",
        )],
        &[
            "2:1: missing key `law` in [[material]]; expected one of `neo-hookean`, `linear-elastic`, `isochoric-neo-hookean`, `mooney-rivlin`, `yeoh`, `ogden`, `gent`, `arruda-boyce`, `elastic-plastic`",
        ],
    );
    misread(
        "half of the elastic constants",
        &[("poissons_ratio = 0.3\n", "")],
        &[
            "2:1: missing key `poissons_ratio` in [[material]]; expected a number greater than -1 and less than 0.5",
        ],
    );
    misread(
        "missing coefficient of friction",
        &[(r#"law = "coulomb", mu = 0.3"#, r#"law = "coulomb""#)],
        &["22:12: missing key `mu` in [[pair]] friction; expected a number of at least 0"],
    );
    misread(
        "too many elastic constants",
        &[(
            "poissons_ratio = 0.3",
            "poissons_ratio = 0.3\nshear_modulus = 1",
        )],
        &[
            "7:1: `youngs_modulus` and `shear_modulus` exclude each other in [[material]]; give either `youngs_modulus` and `poissons_ratio` or `lambda` and `shear_modulus`",
        ],
    );
    misread(
        "no elastic constants",
        &[("youngs_modulus = 1e6\npoissons_ratio = 0.3\n", "")],
        &[
            "2:1: [[material]] needs either `youngs_modulus` and `poissons_ratio` or `lambda` and `shear_modulus`",
        ],
    );
    misread(
        "file and generator",
        &[(
            r#"generator = "block", size"#,
            r#"file = "part.msh", generator = "block", size"#,
        )],
        &[
            "10:29: `file` and `generator` exclude each other in [[body]] mesh; give either `file` or `positions` and `cells` or `generator`",
        ],
    );
    misread(
        "neither file nor generator",
        &[(
            r#"mesh = { generator = "block", size = [1, 1, 0.5], divisions = [4, 4, 2] }"#,
            "mesh = {}",
        )],
        &["10:8: [[body]] mesh needs either `file` or `positions` and `cells` or `generator`"],
    );
    misread(
        "side with body and rigid surface",
        &[(
            r#"b = { body = "upper", facets = "zmin" }"#,
            r#"b = { body = "upper", facets = "zmin", rigid = "floor" }"#,
        )],
        &[
            "21:40: `body` and `rigid` exclude each other in [[pair]] b; give either `body` and `facets` or `rigid`",
        ],
    );
    misread(
        "rigid surface without a shape",
        &[("plane = { point = [0, 0, 0], normal = [0, 0, 1] }\n", "")],
        &["15:1: [[rigid]] needs either `plane` or `mesh` or `tied`"],
    );
    faulty(
        "empty deck",
        "",
        &[
            "1:1: missing key `title` in the deck; expected a text",
            "1:1: the deck has no [[body]]; there is nothing to simulate",
            "1:1: the deck has no [[step]]; there is nothing to do",
        ],
    );
    misread(
        "several faults at once",
        &[
            ("poissons_ratio = 0.3", "poissons_ratio = 3"),
            ("divisions = [4, 4, 2]", "divsions = [4, 4, 2]"),
            (r#"facets = "zmin""#, r#"facets = "botom""#),
            (r#"pair = "interface""#, r#"pair = "face""#),
        ],
        &[
            "6:18: `poissons_ratio` in [[material]] must be a number greater than -1 and less than 0.5, but is 3",
            "10:51: unknown key `divsions` in [[body]] mesh; did you mean `divisions`?",
            "21:32: body `upper` has no facet set `botom`; it has `all`, `xmax`, `xmin`, `ymax`, `ymin`, `zmax`, `zmin`",
            "40:22: no pair is named `face`; there is `interface`",
        ],
    );
}

#[test]
fn types() {
    misread(
        "empty title",
        &[(r#""Two blocks""#, r#""  ""#)],
        &[r#"1:9: `title` must be a text, but is the text "  ""#],
    );
    misread(
        "one table where a list is expected",
        &[("[[rigid]]", "[rigid]")],
        &["15:1: `rigid` must be a list of tables, but is a table; begin it with [[rigid]]"],
    );
    misread(
        "one condition where a list is expected",
        &[(
            r#"release = [{ body = "upper", nodes = "zmax", components = ["z"] }]"#,
            r#"release = { body = "upper", nodes = "zmax" }"#,
        )],
        &[
            "38:11: `release` in [[step]] must be a list of tables, but is a table; put it into brackets, [{ ... }]",
        ],
    );
    misread(
        "list of tables where one is expected",
        &[("[output]", "[[output]]")],
        &["41:1: `output` must be a table, but is a list of 1"],
    );
    misread(
        "text where a number is expected",
        &[("youngs_modulus = 1e6", r#"youngs_modulus = "1e6""#)],
        &[
            r#"5:18: `youngs_modulus` in [[material]] must be a number greater than 0, but is the text "1e6""#,
        ],
    );
    misread(
        "friction law that is no text",
        &[(r#"law = "coulomb", mu = 0.3"#, "law = 1")],
        &[
            "22:20: `law` in [[pair]] friction must be one of `frictionless`, `coulomb`, `two-textures`, `orthotropic`, `nap`, `tabulated`, but is 1",
        ],
    );
    misread(
        "coefficients of a table that are no coefficients",
        &[(
            r#"law = "coulomb", mu = 0.3"#,
            r#"law = "tabulated", angles = [0, 90, 180], mu = [0.1, "much", 0]"#,
        )],
        &[
            r#"22:67: an element of `mu` in [[pair]] friction must be a number greater than 0, but is the text "much""#,
            "22:75: an element of `mu` in [[pair]] friction must be a number greater than 0, but is 0",
        ],
    );
    for (what, keys, expected) in [
        (
            "power law that friction falls by",
            r#"by_pressure = { form = "power-law", exponent = 0, pressure = 1 }"#,
            "22:88: `exponent` in [[pair]] friction by_pressure must be a number greater than 0, but is 0",
        ),
        (
            "Stribeck's curve with an infinite slope",
            r#"by_slip_rate = { form = "stribeck", kinetic_over_static = 0.5, slip_rate = 1, exponent = 0.5 }"#,
            "22:130: `exponent` in [[pair]] friction by_slip_rate must be a number of at least 1, but is 0.5",
        ),
        (
            "unknown dependence on the pressure",
            r#"by_pressure = { form = "power law", exponent = 1, pressure = 1 }"#,
            "22:64: `form` in [[pair]] friction by_pressure cannot be `power law`; expected one of `power-law`, `adhesion`, `saturation`, `table`; did you mean `power-law`?",
        ),
    ] {
        let friction = format!(r#"law = "coulomb", mu = 0.3, {keys}"#);
        misread(
            what,
            &[(r#"law = "coulomb", mu = 0.3"#, &friction)],
            &[expected],
        );
    }
    misread(
        "divisions that are not whole",
        &[("divisions = [4, 4, 2]", "divisions = [4, 4.5, 2]")],
        &[
            "10:67: an element of `divisions` in [[body]] mesh must be a whole number of at least 1, but is 4.5",
        ],
    );
    misread(
        "too few components",
        &[(
            "size = [1, 1, 0.5], divisions = [4",
            "size = [1, 1], divisions = [4",
        )],
        &[
            "10:38: `size` in [[body]] mesh must be a list of 3 numbers greater than 0, but is a list of 2",
        ],
    );
    misread(
        "increments of the wrong type",
        &[(
            "increments = { initial = 0.1, smallest = 1e-3, largest = 0.2 }",
            "increments = 0.5",
        )],
        &[
            "29:14: `increments` in [[step]] must be a whole number of at least 1 or a table, but is 0.5",
        ],
    );
}

#[test]
fn ranges() {
    misread(
        "not a number",
        &[("mu = 0.3", "mu = nan")],
        &["22:36: `mu` in [[pair]] friction must be a number of at least 0, but is nan"],
    );
    misread(
        "infinite number",
        &[("value = 3", "value = inf")],
        &[
            "35:56: `value` in [[step]] pressure must be a number or a function of `x`, `y`, `z` and `t`, such as \"0.1*x*sin(2*pi*t)\", but is inf",
        ],
    );
    misread(
        "Young's modulus of zero",
        &[("youngs_modulus = 1e6", "youngs_modulus = 0")],
        &["5:18: `youngs_modulus` in [[material]] must be a number greater than 0, but is 0"],
    );
    misread(
        "Poisson's ratio of one half",
        &[("poissons_ratio = 0.3", "poissons_ratio = 0.5")],
        &[
            "6:18: `poissons_ratio` in [[material]] must be a number greater than -1 and less than 0.5, but is 0.5",
        ],
    );
    misread(
        "chains that are locked at rest",
        &[
            ("\"neo-hookean\"", "\"arruda-boyce\""),
            ("youngs_modulus = 1e6", "mu = 1\nlocking_stretch = 1"),
        ],
        &["6:19: `locking_stretch` in [[material]] must be a number greater than 1, but is 1"],
    );
    misread(
        "Poisson's ratio of minus one",
        &[("poissons_ratio = 0.3", "poissons_ratio = -1")],
        &[
            "6:18: `poissons_ratio` in [[material]] must be a number greater than -1 and less than 0.5, but is -1",
        ],
    );
    misread(
        "negative coefficient of friction",
        &[("mu = 0.3", "mu = -0.3")],
        &["22:36: `mu` in [[pair]] friction must be a number of at least 0, but is -0.3"],
    );
    misread(
        "no divisions",
        &[("divisions = [4, 4, 2]", "divisions = [4, 0, 2]")],
        &[
            "10:67: an element of `divisions` in [[body]] mesh must be a whole number of at least 1, but is 0",
        ],
    );
    misread(
        "negative size",
        &[(
            "size = [1, 1, 0.5], divisions = [4",
            "size = [1, -1, 0.5], divisions = [4",
        )],
        &[
            "10:42: an element of `size` in [[body]] mesh must be a number greater than 0, but is -1",
        ],
    );
    misread(
        "duration of zero",
        &[("duration = 2.0", "duration = 0")],
        &["28:12: `duration` in [[step]] must be a number greater than 0, but is 0"],
    );
    misread(
        "no increments",
        &[(
            "increments = { initial = 0.1, smallest = 1e-3, largest = 0.2 }",
            "increments = 0",
        )],
        &["29:14: `increments` in [[step]] must be a whole number of at least 1, but is 0"],
    );
    misread(
        "increment longer than the step",
        &[("largest = 0.2", "largest = 1.5")],
        &[
            "29:58: `largest` in [[step]] increments must be a number greater than 0 and of at most 1, but is 1.5",
        ],
    );
    misread(
        "tolerance of zero",
        &[("tolerance = 1e-9", "tolerance = 0")],
        &["45:13: `tolerance` in [solver] must be a number greater than 0, but is 0"],
    );
    misread(
        "no iterations",
        &[("largest_iterations = 15", "largest_iterations = 0")],
        &["46:22: `largest_iterations` in [solver] must be a whole number of at least 1, but is 0"],
    );
    misread(
        "stick tolerance of zero",
        &[("stick_tolerance = 0.001", "stick_tolerance = 0")],
        &[
            "47:52: `stick_tolerance` in [solver] strategy must be a number greater than 0, but is 0",
        ],
    );
    misread(
        "negative number of increments between files",
        &[("fields_every = 2", "fields_every = -2")],
        &["42:16: `fields_every` in [output] must be a whole number of at least 0, but is -2"],
    );
}

#[test]
fn words() {
    misread(
        "unknown strategy",
        &[(r#""table-1", stick_tolerance = 0.001"#, r#""table-2""#)],
        &[
            "47:23: `method` in [solver] strategy cannot be `table-2`; expected one of `semismooth`, `table-1`; did you mean `table-1`?",
        ],
    );
    misread(
        "unknown material law",
        &[(r#""neo-hookean""#, r#""neohookean""#)],
        &[
            "4:7: `law` in [[material]] cannot be `neohookean`; expected one of `neo-hookean`, `linear-elastic`, `isochoric-neo-hookean`, `mooney-rivlin`, `yeoh`, `ogden`, `gent`, `arruda-boyce`, `elastic-plastic`; did you mean `neo-hookean`?",
        ],
    );
    misread(
        "unknown generator",
        &[(
            r#"generator = "block", size"#,
            r#"generator = "blck", size"#,
        )],
        &[
            "10:22: `generator` in [[body]] mesh cannot be `blck`; expected one of `block`, `capped-block`, `half-cylinder`, `annulus`, `cylinder`, `torus`; did you mean `block`?",
        ],
    );
    misread(
        "unknown enforcement",
        &[(
            "mu = 0.3 }",
            r#"mu = 0.3 }
enforcement = "weighed""#,
        )],
        &[
            "23:15: `enforcement` in [[pair]] cannot be `weighed`; expected one of `weighted`, `collocated`; did you mean `weighted`?",
        ],
    );
    misread(
        "unknown component",
        &[(r#"components = ["z"]"#, r#"components = ["w"]"#)],
        &[
            "38:60: an element of `components` in [[step]] release cannot be `w`; expected one of `x`, `y`, `z`",
        ],
    );
    misread(
        "unknown backend",
        &[(r#""faer""#, r#""pardiso""#)],
        &[
            "44:11: `backend` in [solver] cannot be `pardiso`; expected one of `condensed`, `multifrontal`, `faer`, `iterative`, `mumps`",
        ],
    );
}

#[test]
fn exclusive() {
    misread(
        "two textures on one side",
        &[(
            r#"a = { body = "lower", facets = "zmax" }"#,
            r#"a = { body = "lower", facets = "zmax", texture = { uniform = [1, 0, 0], axial = { direction = [1, 0, 0] } } }"#,
        )],
        &[
            "20:73: `uniform` and `axial` exclude each other in [[pair]] a texture; give either `uniform` or `circumferential` or `axial` or `radial` or `points` or `directions` or `nodal`",
        ],
    );
    misread(
        "node set that is made in two ways",
        &[(
            "divisions = [4, 4, 2] }",
            r#"divisions = [4, 4, 2] }
node_sets = [{ name = "edge", common = ["xmin"], union = ["xmax"] }]"#,
        )],
        &[
            "11:50: `common` and `union` exclude each other in [[body]] node_sets; give either `nearest` or `common` or `union` or `from` and `to` or `sphere` or `cylinder` or `half_space` or `facets` or `elements` or `border` or `numbers`",
        ],
    );
}

#[test]
fn sets_of_wrong_numbers() {
    for (sets, message) in [
        (
            r#"node_sets = [{ name = "s", sphere = { centre = [9, 0, 0], radius = -1 } }]"#,
            "11:68: `radius` in [[body]] node_sets sphere must be a number greater than 0, but is -1",
        ),
        (
            r#"facet_sets = [{ name = "s", around = [0, 0, 0], feature_angle = 200 }]"#,
            "11:65: `feature_angle` in [[body]] facet_sets must be a number of at least 0 and of at most 180, but is 200",
        ),
    ] {
        let sets = format!("divisions = [4, 4, 2] }}\n{sets}");
        misread("set", &[("divisions = [4, 4, 2] }", &sets)], &[message]);
    }
}

#[test]
fn of_very_many_faults_the_first_are_shown() {
    for repeated in ["[[body]]\n", "[[pair]]\n"] {
        let text = "title = \"many\"\n".to_owned() + &repeated.repeat(5000);
        let faults = striae_deck::parse(&text, "deck.toml", std::path::Path::new(""));
        let faults = faults.unwrap_err();
        assert!(faults.iter().len() > 5000);
        let told = faults.to_string();
        let end = format!(
            "{} faults, of which the first 50 are shown",
            faults.iter().len()
        );
        assert!(told.ends_with(&end), "{}", &told[told.len() - 80..]);
        assert_eq!(told.matches("deck.toml:").count(), 50);
    }
}

/// Moduli, densities and durations whose squares overflow or vanish are mistakes of units.
#[test]
fn magnitudes() {
    let law = "youngs_modulus = 1e6\npoissons_ratio = 0.3";
    for (changed, number, place, key) in [
        (law, "1e300", "5:18", "`youngs_modulus` in [[material]]"),
        (law, "1e-300", "5:18", "`youngs_modulus` in [[material]]"),
        (
            "duration = 2.0",
            "1e-320",
            "28:12",
            "`duration` in [[step]]",
        ),
    ] {
        let value = changed
            .split("\n")
            .next()
            .and_then(|line| line.split(" = ").nth(1));
        let with = changed.replacen(value.expect("a value"), number, 1);
        let expected = format!(
            "{place}: {key} must be from 1e-50 to 1e50, but is {number}; check its unit and its exponent"
        );
        misstated(
            "magnitude of a positive number",
            &[(changed, &with)],
            &[&expected],
        );
    }
    misstated(
        "moduli of another set, and a density",
        &[(law, "lambda = -1e60\nshear_modulus = 1e60\ndensity = 1e-60")],
        &[
            "5:10: `lambda` in [[material]] must be at most 1e50 in magnitude, but is -1e60; check its unit and its exponent",
            "6:17: `shear_modulus` in [[material]] must be from 1e-50 to 1e50, but is 1e60; check its unit and its exponent",
            "7:11: `density` in [[material]] must be from 1e-50 to 1e50, but is 1e-60; check its unit and its exponent",
        ],
    );
}
