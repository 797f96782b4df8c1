use super::*;
use clap::Parser;

#[derive(Parser)]
struct Program {
    #[command(flatten)]
    arguments: Arguments,
}

/// Two blocks whose sides have these textures.
fn deck(a: &str, b: &str) -> String {
    format!(
        r#"
title = "Two textured blocks"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "lower"
material = "rubber"
mesh = {{ generator = "block", size = [2, 1, 0.5], divisions = [6, 3, 1] }}
[[body]]
name = "upper"
material = "rubber"
mesh = {{ generator = "block", origin = [0, 0, 0.5], size = [1, 1, 0.5], divisions = [4, 4, 1] }}
[[rigid]]
name = "wall"
plane = {{ point = [0, 0, 0], normal = [0, 0, 1] }}
[[pair]]
name = "interface"
a = {{ body = "lower", facets = "zmax", texture = {a} }}
b = {{ body = "upper", facets = "zmin" }}
[[pair]]
name = "wall"
a = {{ body = "lower", facets = "zmin" }}
b = {{ rigid = "wall", texture = {b} }}
[[step]]
name = "rest"
increments = 1
displacement = [
    {{ body = "lower", nodes = "xmin", x = 0, y = 0, z = 0 }},
    {{ body = "upper", nodes = "zmax", x = 0, y = 0, z = 0 }},
]
"#
    )
}

/// Printed text for a deck, or the failure; pictures are written to `folder`.
fn said(deck: &str, folder: &Path) -> Result<String, Failure> {
    let file = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    std::fs::write(&file, deck).unwrap();
    let words = ["texture", "--out"].map(std::ffi::OsStr::new);
    let words = words
        .into_iter()
        .chain([folder.as_os_str(), file.path().as_os_str()]);
    let mut out = Vec::new();
    run(&Program::parse_from(words).arguments, &mut out)?;
    Ok(String::from_utf8(out).unwrap())
}

const POINTS: &str = "{ points = [{ at = [0, 0, 0.5], direction = [1, 0, 0] }, { at = [2, 1, 0.5], direction = [1, 1, 0] }] }";
const CIRCLES: &str = "{ circumferential = { point = [1, 0.5, 0], direction = [0, 0, 1] } }";

#[test]
fn textured_sides_become_pictures_and_others_do_not() {
    let scratch = tempfile::tempdir().unwrap();
    let text = said(&deck(POINTS, CIRCLES), scratch.path()).unwrap();
    assert!(
        text.contains("pair `interface`, side a, body `lower`: 28 nodes"),
        "{text}"
    );
    assert!(text.contains("interpolated: diameter 3.00"), "{text}");
    assert!(
        text.contains("pair `wall`, side b, rigid surface `wall`: a plane"),
        "{text}"
    );
    let mut files: Vec<String> = (scratch.path().read_dir().unwrap())
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    files.sort();
    let expected = ["texture-interface-a", "texture-wall-b"];
    let expected = expected
        .iter()
        .flat_map(|stem| ["csv", "png", "svg", "vtu"].map(|ending| format!("{stem}.{ending}")));
    assert_eq!(files, expected.collect::<Vec<_>>());
    let vtu = std::fs::read(scratch.path().join("texture-interface-a.vtu")).unwrap();
    let head = String::from_utf8_lossy(&vtu);
    for array in ["texture", "structural_vector", "normal"] {
        assert!(head.contains(&format!("Name=\"{array}\"")), "{array}");
    }
}

#[test]
fn strokes_run_along_the_painted_direction() {
    let scratch = tempfile::tempdir().unwrap();
    said(&deck("{ uniform = [1, 1, 7] }", CIRCLES), scratch.path()).unwrap();
    let csv = std::fs::read_to_string(scratch.path().join("texture-interface-a.csv")).unwrap();
    // Columns from the right, as the title has commas: value, arrow, y, x, item, series.
    let column = |line: &str, number: usize| line.rsplit(',').nth(number).unwrap().to_owned();
    let points = |series: &str| -> Vec<[f64; 2]> {
        let rows = csv.lines().filter(|line| column(line, 6) == series);
        rows.map(|row| [4, 3].map(|number| column(row, number).parse().unwrap()))
            .collect()
    };
    for (series, slope) in [("s", 1.0), ("a", -1.0)] {
        let points = points(series);
        assert_eq!(points.len(), 3 * 28);
        for stroke in points.chunks(3) {
            let [dx, dy] = [0, 1].map(|axis| stroke[1][axis] - stroke[0][axis]);
            assert!((dy - slope * dx).abs() < 1e-12, "{series}: {dx} {dy}");
        }
    }
    // a = n x s points to the left of s on the top of the block.
    let tick = &points("a")[..2];
    assert!(tick[1][0] < tick[0][0] && tick[1][1] > tick[0][1]);
}

#[test]
fn a_closed_surface_is_seen_from_both_sides() {
    let ring = r#"
title = "A tyre in a half cylinder"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
name = "tyre"
material = "rubber"
mesh = { generator = "annulus", inner_radius = 0.2, outer_radius = 0.5, width = 0.4, divisions = [1, 16, 3] }
[[rigid]]
name = "road"
plane = { point = [0, 0, -0.5], normal = [0, 0, 1] }
[[pair]]
name = "contact"
a = { body = "tyre", facets = "tread", texture = { circumferential = { direction = [0, 1, 0] } } }
b = { rigid = "road" }
[[step]]
name = "rest"
increments = 1
displacement = [{ body = "tyre", nodes = "rim", x = 0, y = 0, z = 0 }]
"#;
    let scratch = tempfile::tempdir().unwrap();
    said(ring, scratch.path()).unwrap();
    let csv = std::fs::read_to_string(scratch.path().join("texture-contact-a.csv")).unwrap();
    assert!(
        csv.lines().any(|line| line.starts_with("2,")),
        "a second view"
    );
}

#[test]
fn painting_faults_are_told_and_nothing_is_written() {
    let scratch = tempfile::tempdir().unwrap();
    let failure = said(&deck("{ uniform = [0, 0, 1] }", CIRCLES), scratch.path()).unwrap_err();
    assert!(matches!(failure, Failure::Deck(_)), "exit code 2");
    let text = failure.to_string();
    assert!(
        text.contains("pair `interface`: the texture of body `lower` has no direction at node"),
        "{text}"
    );
    assert_eq!(scratch.path().read_dir().unwrap().count(), 0);
}

#[test]
fn a_deck_without_textures_says_so() {
    let scratch = tempfile::tempdir().unwrap();
    let text = said(include_str!("../new/blocks.toml"), scratch.path()).unwrap();
    assert_eq!(text, "no side of a pair has a texture\n");
}
