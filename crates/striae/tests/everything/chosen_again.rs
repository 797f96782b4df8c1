//! Traction fields that were chosen again during the iterations of an increment.

use super::{completed, forces};

/// A block that is drawn over ridges. In the first iteration of an increment, and only there, a
/// flank of it touches.
const RIDGES: &str = include_str!("ridges.toml");

/// Named pairs do not look at the flanks, so their first iteration shows nothing new.
#[test]
fn what_touches_in_an_iteration_alone_leaves_no_trace() {
    let friction = r#"friction = { law = "coulomb", mu = 0.5788 }"#;
    let drawn = |contact: &str| completed(&RIDGES.replace("CONTACT", contact));
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
                (all - named).abs() < 1e-7,
                "increment {increment}: {all} for {named}"
            );
        }
    }
}
