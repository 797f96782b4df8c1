use proptest::prelude::*;

use super::*;

const FILE: &str = r#"
[[quantity]]
name = "force"
value = 15712.0
relative = 0.005
source = "two other codes"
unit = "N"

[[quantity]]
name = "balance"
value = 0.0
absolute = 1e-9
source = "equilibrium"

[[quantity]]
name = "peak"
min = 0.04
max = 0.05
source = "figure axis, \"about\""
"#;

fn verdicts(values: [Option<f64>; 3]) -> Vec<Verdict> {
    let expected = Expected::parse(FILE).unwrap();
    let names = ["force", "balance", "peak"];
    let comparisons = compare(&expected, |name| {
        values[names.iter().position(|n| *n == name).unwrap()]
    });
    comparisons.iter().map(|c| c.verdict).collect()
}

#[test]
fn verdicts_follow_the_tolerances() {
    use Verdict::{Fail, Missing, Pass};
    assert_eq!(
        verdicts([Some(15_790.0), Some(-9e-10), Some(0.05)]),
        [Pass, Pass, Pass]
    );
    assert_eq!(
        verdicts([Some(15_800.0), Some(2e-9), Some(0.0501)]),
        [Fail, Fail, Fail]
    );
    assert_eq!(
        verdicts([Some(f64::NAN), Some(f64::NAN), Some(f64::NAN)]),
        [Fail, Fail, Fail]
    );
    assert_eq!(verdicts([None, None, None]), [Missing, Missing, Missing]);
}

#[test]
fn the_report_is_aligned() {
    let expected = Expected::parse(FILE).unwrap();
    let comparisons = compare(&expected, |name| match name {
        "force" => Some(15_700.0),
        "peak" => Some(0.06),
        _ => None,
    });
    let text = report(&comparisons);
    let expected = "\
quantity  | computed |      expected | deviation | verdict
----------+----------+---------------+-----------+--------
force [N] |    15700 | 15712 ± 0.5 % |   -0.08 % | pass
balance   |        - |       0 ± 1e-9 |         - | MISSING
peak      |     0.06 |  0.04 .. 0.05 | +1.00e-2 | FAIL
";
    for (found, wanted) in text.lines().zip(expected.lines()) {
        let cells = |line: &str| {
            line.split('|')
                .map(|c| c.trim().to_owned())
                .collect::<Vec<_>>()
        };
        if !found.starts_with('-') {
            assert_eq!(cells(found), cells(wanted));
        }
    }
    let bars = |line: &str| {
        let at = line.chars().enumerate().filter(|(_, c)| "|+".contains(*c));
        at.map(|(i, _)| i).filter(|i| *i < 50).collect::<Vec<_>>()
    };
    let first = bars(text.lines().next().unwrap());
    for line in text.lines() {
        assert!(first.iter().all(|i| bars(line).contains(i)), "{text}");
    }
}

#[test]
fn the_csv_quotes_and_keeps_all_digits() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("table.csv");
    let expected = Expected::parse(FILE).unwrap();
    write_csv(&path, &compare(&expected, |_| Some(0.1 + 0.2)), "full").unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let last = text.lines().last().unwrap();
    assert!(
        last.starts_with("peak,,0.30000000000000004,0.04,0.05,"),
        "{last}"
    );
    assert!(
        last.ends_with("FAIL,\"figure axis, \"\"about\"\"\",full"),
        "{last}"
    );
}

#[test]
fn contradictory_entries_are_refused() {
    let with = |fields: &str| {
        Expected::parse(&format!(
            "[[quantity]]\nname = \"q\"\nsource = \"s\"\n{fields}"
        ))
        .unwrap_err()
    };
    assert!(with("").contains("give `value`"));
    assert!(with("value = 1.0").contains("needs `relative` or `absolute`"));
    assert!(with("value = 0.0\nrelative = 0.1").contains("relative to zero"));
    assert!(with("value = 1.0\nrelative = 0.1\nabsolute = 0.1").contains("not both"));
    assert!(with("value = 1.0\nabsolute = -0.1").contains("negative"));
    assert!(with("value = 1.0\nmin = 0.1\nabsolute = 0.1").contains("not both"));
    assert!(with("min = 1.0\nmax = 0.1").contains("above"));
    assert!(with("min = 1.0\nabsolute = 0.1").contains("no tolerance"));
    assert!(with("value = 1.0\nabsolut = 0.1").contains("absolut"));
    let twice = "[[quantity]]\nname = \"q\"\nsource = \"s\"\nmin = 0.0\n".repeat(2);
    assert_eq!(
        Expected::parse(&twice).unwrap_err(),
        "`q` is expected twice"
    );
}

proptest! {
    /// Values inside the interval pass, values clearly outside fail.
    #[test]
    fn interval_and_verdict_agree(value in -1e6..1e6, width in 1e-6..1.0, offset in -2.0..2.0_f64) {
        for tolerance in [Tolerance::Absolute(width), Tolerance::Relative(width)] {
            let target = Target::Value { value, tolerance };
            let (min, max) = target.interval();
            let half = (max - min) / 2.0;
            prop_assume!((offset.abs() - 1.0).abs() > 1e-3 && half > 1e-6);
            prop_assert_eq!(target.contains(value + offset * half), offset.abs() < 1.0);
        }
    }
}
