//! Traction fields that were chosen again during the iterations of an increment.

use striae::Finished;

use super::{completed, forces};

/// A block that is drawn over ridges. In the first iteration of an increment, and only there, a
/// flank of it touches.
fn drawn(contact: &str) -> Finished {
    let text = format!(
        r#"
title = "A block over ridges"
[[material]]
name = "rubber"
law = "neo-hookean"
youngs_modulus = 8
poissons_ratio = 0.3
[[body]]
name = "block"
material = "rubber"
mesh = {{ generator = "block", origin = [0, 0, 0], size = [46.94, 43.25, 35.05], divisions = [4, 7, 4], irregularity = 0.13567690775333202, seed = 295, grading = {{ x = {{ symmetric = 0.43031584 }} }} }}
[[rigid]]
name = "floor"
[rigid.mesh]
positions = [[-36.89, -35.93, 0], [-36.89, 79.19, 0], [-21.8, -35.93, -1.99], [-21.8, 79.19, -1.99], [-6.71, -35.93, 0], [-6.71, 79.19, 0], [8.38, -35.93, -1.99], [8.38, 79.19, -1.99], [23.47, -35.93, 0], [23.47, 79.19, 0], [38.56, -35.93, -1.99], [38.56, 79.19, -1.99], [53.65, -35.93, 0], [53.65, 79.19, 0], [68.74, -35.93, -1.99], [68.74, 79.19, -1.99]]
facets = [[0, 2, 3, 1], [2, 4, 5, 3], [4, 6, 7, 5], [6, 8, 9, 7], [8, 10, 11, 9], [10, 12, 13, 11], [12, 14, 15, 13]]
{contact}
[[step]]
name = "press"
displacement = [{{ body = "block", nodes = "zmax", x = 0, y = 0, z = -1.5532 }}]
[[step]]
name = "slide"
increments = 5
displacement = [{{ body = "block", nodes = "zmax", x = 7.1009, y = -12.9406, z = -1.5532 }}]
"#
    );
    completed(&text)
}

/// Named pairs do not look at the flanks, so their first iteration shows nothing new.
#[test]
fn what_touches_in_an_iteration_alone_leaves_no_trace() {
    let friction = r#"friction = { law = "coulomb", mu = 0.5788 }"#;
    let everything = drawn(&format!("[contact]\nall = true\n{friction}"));
    let named = drawn(&format!(
        "[[pair]]\nname = \"named\"\na = {{ body = \"block\", facets = \"zmin\" }}\nb = {{ rigid = \"floor\" }}\n{friction}"
    ));
    let everything = forces(&everything, "block-floor");
    for (all, named) in everything.iter().zip(&forces(&named, "named")) {
        assert_eq!(all.len(), named.len());
        for (increment, (all, named)) in all.iter().zip(named).enumerate() {
            // Of forces of some 500; 9e-4 where the trace is left.
            assert!(
                (all - named).abs() < 1e-6,
                "increment {increment}: {all} for {named}"
            );
        }
    }
}
