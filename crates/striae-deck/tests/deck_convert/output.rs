//! Requests of output.

use super::{assert_listed, converted, model, with};

#[test]
fn fields_and_their_frequency() {
    let output = "*OUTPUT, FIELD, FREQUENCY=5\n*NODE OUTPUT\nU\n*ELEMENT OUTPUT\nS, LE\n*CONTACT OUTPUT\nCSTRESS, CDISP
*RESTART, WRITE, FREQUENCY=3\n";
    let (text, listed, _) = converted(&model("", &with(output)));
    assert_listed(&listed, &[]);
    let expected = "[output]
fields_every = 5
body_fields = [\"cauchy-stress\", \"displacement\", \"logarithmic-strain\", \"von-mises\"]
contact_fields = [\"gap\", \"slip\", \"traction\"]
checkpoint_every = 3
";
    assert!(text.ends_with(expected), "{text}");
}

#[test]
fn usual_fields_at_intervals_of_time() {
    let output = "*OUTPUT, FIELD, VARIABLE=PRESELECT, NUMBER INTERVAL=4\n*OUTPUT, HISTORY, VARIABLE=PRESELECT\n";
    let (text, listed, _) = converted(&model("", &with(output)));
    assert_listed(&listed, &[]);
    // The step takes 2.
    assert!(
        text.ends_with("[output]\nfields_interval = 0.5\n"),
        "{text}"
    );
}

#[test]
fn histories_of_displacements_are_probes() {
    let output = "*OUTPUT, HISTORY\n*NODE OUTPUT, NSET=Pad-1.High\nU3, RF3\n*ENERGY OUTPUT\nALLIE,\n*ELEMENT OUTPUT, ELSET=Pad-1.All\nS,\n";
    let (text, listed, _) = converted(&model("", &with(output)));
    let said = [
        "*NODE OUTPUT of `Pad-1.High`: its probe has the mean over 4 nodes",
        "*ELEMENT OUTPUT over time: name points in `probes`",
    ];
    assert_listed(&listed, &said);
    let probe = "{ name = \"Pad-1 Pad-1.High\", body = \"Pad-1\", nodes = \"Pad-1.High\" }";
    assert!(text.contains(probe), "{text}");
}

#[test]
fn files_and_prints_of_calculix() {
    let output = "*NODE FILE, FREQUENCY=2\nU\n*EL FILE\nS, NOE\n*CONTACT FILE\nCDIS, CSTR\n*NODE PRINT, NSET=Pad-1.High\nRF\n*NODE PRINT\nU, NT\n*EL PRINT, ELSET=Pad-1.All\nS\n";
    let (text, listed, _) = converted(&model("", &with(output)));
    let said = [
        "*EL FILE: no field for NOE",
        "*CONTACT FILE: all steps have the most frequent output",
        "*NODE PRINT over time: no NT",
        "*NODE PRINT of all nodes: name a set",
        "*EL PRINT over time: name points in `probes`",
    ];
    assert_listed(&listed, &said);
    assert!(
        text.contains("contact_fields = [\"gap\", \"slip\", \"traction\"]"),
        "{text}"
    );
    assert!(!text.contains("fields_every"), "{text}");
}
