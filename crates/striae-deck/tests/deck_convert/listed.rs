//! Keywords without a counterpart: each is listed, whatever it is.

use super::{assert_listed, converted, model, with};

#[test]
fn every_other_keyword_is_listed_with_advice() {
    let model_keywords = [
        ("*SPRING, ELSET=E\n1\n10.", "*SPRING: state a `[[spring]]`"),
        (
            "*DASHPOT, ELSET=E\n1\n10.",
            "*DASHPOT: state a `[[spring]]`",
        ),
        ("*MASS, ELSET=E\n1.", "*MASS: state `mass` and `inertia`"),
        (
            "*SHELL SECTION, ELSET=E\n1.",
            "*SHELL SECTION: only solids have sections",
        ),
        (
            "*FLUID BEHAVIOR, NAME=F",
            "*FLUID BEHAVIOR: state a `[[cavity]]`",
        ),
        (
            "*ORIENTATION, NAME=O\n1., 0., 0., 0., 1., 0.",
            "*ORIENTATION",
        ),
        (
            "*PHYSICAL CONSTANTS, ABSOLUTE ZERO=0.",
            "*PHYSICAL CONSTANTS",
        ),
    ];
    for (keyword, said) in model_keywords {
        let (_, listed, _) = converted(&model("", &format!("{keyword}\n{}", with(""))));
        assert_listed(&listed, &[said]);
    }
    for (keyword, said) in [
        (
            "*MODEL CHANGE, REMOVE\nPad-1.All",
            "*MODEL CHANGE: elements and pairs are there",
        ),
        ("*CONTACT CONTROLS, STABILIZE", "*CONTACT CONTROLS"),
        (
            "*CONTACT INTERFERENCE, SHRINK\nPad-1.Bottom, Base-1.Top",
            "*CONTACT INTERFERENCE: state",
        ),
        ("*CONTROLS, PARAMETERS=FIELD\n1.", "*CONTROLS"),
        (
            "*SECTION PRINT, NAME=S\nSOF",
            "*SECTION PRINT: state `sections`",
        ),
        ("*MONITOR, NODE=1, DOF=1", "*MONITOR"),
        ("*SOMETHING NEW\n1., 2.", "*SOMETHING NEW"),
    ] {
        let (_, listed, _) = converted(&model("", &with(&format!("{keyword}\n"))));
        assert_listed(&listed, &[said]);
    }
}

#[test]
fn garbage_is_no_panic() {
    let whole = model(
        "",
        &with("*CLOAD\nPad-1.High, 3, -2.\n*DLOAD\nPad-1.All, P2, 1.\n"),
    );
    for word in ["1", "x", ",", "*", "1e999", "-3", "Pad-1.High", "="] {
        for (at, _) in whole.match_indices([',', '\n']) {
            let text = format!("{}{word}{}", &whole[..at], &whole[at..]);
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("model.inp");
            std::fs::write(&path, text).unwrap();
            if let Ok(made) = striae_deck::convert(&path, "model.inp") {
                let _ = striae_deck::parse(&made.deck, "model.toml", folder.path());
            }
        }
    }
}
