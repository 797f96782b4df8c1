//! Flat pairs against numbers of an independent implementation.

use striae_contact::{
    side::Side,
    traction_basis::{KeptNode, TractionBasis},
};
use striae_surface::node::SurfaceNode;

use crate::flat::{Face, Pair};

const REFERENCE: &str = include_str!("reference.txt");

/// Lines of a case by their first words.
struct Case<'a> {
    faces: [Face; 2],
    lines: Vec<&'a str>,
}

fn numbers(line: &str) -> Vec<f64> {
    let number = |word: &str| word.parse().expect("a number");
    line.split_whitespace().map(number).collect()
}

impl Case<'_> {
    fn values(&self, name: &str) -> Vec<f64> {
        let found = self.lines.iter().find_map(|line| {
            let rest = line.strip_prefix(name)?;
            (rest.is_empty() || rest.starts_with(' ')).then_some(rest)
        });
        numbers(found.expect("every case has all lines"))
    }
}

fn cases() -> Vec<Case<'static>> {
    let mut cases: Vec<Case> = Vec::new();
    for line in REFERENCE.lines().filter(|line| !line.starts_with('#')) {
        if let Some(rest) = line.strip_prefix("case ") {
            let c = numbers(rest);
            let face = |c: &[f64]| {
                let divisions = [c[0] as usize, c[1] as usize];
                Face::uniform(divisions, [c[2], c[3]], [c[4], c[5]], c[6])
            };
            cases.push(Case {
                faces: [face(&c[..7]), face(&c[7..])],
                lines: Vec::new(),
            });
        } else {
            cases.last_mut().expect("a case begins").lines.push(line);
        }
    }
    cases
}

fn assert_close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    let scale = expected.iter().fold(1e-3_f64, |m, v| m.max(v.abs()));
    for (at, (a, b)) in found.iter().zip(expected).enumerate() {
        assert!((a - b).abs() <= 1e-10 * scale, "{what} {at}: {a} {b}");
    }
}

#[test]
fn flat_pairs_agree_with_an_independent_implementation() {
    for (number, case) in cases().iter().enumerate() {
        let pair = Pair::new(case.faces.each_ref());
        let basis = TractionBasis::new(&pair.interface());
        let kept: Vec<KeptNode> = Side::BOTH
            .into_iter()
            .flat_map(|side| {
                let nodes = case.values(&format!("kept {}", side.index()));
                nodes.into_iter().map(move |node| KeptNode {
                    side,
                    node: SurfaceNode::new(node as usize),
                })
            })
            .collect();
        assert_eq!(basis.kept, kept, "case {number}");
        assert_close(&basis.pivots, &case.values("pivots"), "pivot");
        assert_close(&basis.weights, &case.values("weights"), "weight");
        let v: Vec<f64> = kept
            .iter()
            .map(|k| {
                let x = pair.nodes[k.side][k.node].position;
                (3.0 * x.x + 5.0 * x.y + k.side.index() as f64).cos()
            })
            .collect();
        let image = |row: &[(u32, f64)]| -> f64 {
            row.iter().map(|&(k, value)| value * v[k as usize]).sum()
        };
        for side in Side::BOTH {
            let nodes = case.values(&format!("carrying {}", side.index()));
            let found: Vec<f64> = nodes
                .iter()
                .map(|&node| image(&basis.rows[side][node as usize]))
                .collect();
            assert_close(
                &found,
                &case.values(&format!("values {}", side.index())),
                "transferred",
            );
        }
        let mut ramp = vec![0.0; kept.len()];
        for weak in &basis.ramp {
            let applied = weak.coefficient * image(&weak.row);
            for &(k, value) in &weak.row {
                ramp[k as usize] += applied * value;
            }
        }
        assert_close(&ramp, &case.values("ramp"), "ramp");
    }
}
