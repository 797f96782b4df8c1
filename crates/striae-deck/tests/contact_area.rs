//! Contact areas that are no whole facets.

mod driven;

use driven::last;
use striae_contact::side::Side;
use striae_solve::report::pairs;

/// Contact area of a block that is pressed onto a tilted plane, which it touches with less than
/// half of its face.
fn area(divisions: usize) -> f64 {
    let (problem, state) = last(&format!(
        r#"
title = "Tilted plane"
[[material]]
name = "solid"
law = "linear-elastic"
youngs_modulus = 1e6
poissons_ratio = 0
[[body]]
name = "block"
material = "solid"
mesh = {{ generator = "block", size = [1, 1, 0.5], divisions = [{divisions}, 2, {divisions}] }}
[[rigid]]
name = "floor"
plane = {{ point = [0, 0, 0], normal = [0.01, 0, 1] }}
[[pair]]
name = "sole"
a = {{ body = "block", facets = "zmin" }}
b = {{ rigid = "floor" }}
[[step]]
name = "press"
increments = 1
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = -0.003 }}]
"#
    ));
    pairs(&problem, &state)[0].sides[Side::A].pressed
}

/// Nodes under pressure stand for three quarters of the face of two facets, a quarter touches.
#[test]
fn the_contact_area_is_that_of_points_under_pressure() {
    let fine = area(16);
    assert!(fine > 0.15 && fine < 0.3, "{fine}");
    for divisions in [2, 3, 4, 8] {
        let coarse = area(divisions);
        assert!((coarse - fine).abs() < 0.15, "{divisions}: {coarse} {fine}");
    }
}
