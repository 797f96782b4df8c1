//! Some mutants of every target, all inputs that once failed, and those that libFuzzer has found.

use striae_mutants::{
    judge::{Depth, Judge},
    target::{Target, found, regressions, samples},
    trial::Mutants,
};

/// Mutants of each target.
const EACH: u64 = 60;

#[test]
fn mutants_neither_panic_nor_fail_without_a_place() {
    let judge = Judge::new().unwrap();
    let mut findings = Vec::new();
    for (target, sample) in regressions() {
        if let Err(finding) = judge.judge(target, &sample, Depth::Run) {
            findings.push(format!("{}: {finding:?}", sample.name));
        }
    }
    for target in Target::ALL {
        for sample in samples(target).into_iter().chain(found(target)) {
            if let Err(finding) = judge.judge(target, &sample, Depth::Check) {
                findings.push(format!("{}: {finding:?}", sample.name));
            }
        }
        let mutants = Mutants::new(vec![target], judge.folder());
        for seed in 0..EACH {
            if let Err(finding) = mutants.tried(seed, &judge) {
                findings.push(format!("{} {seed}: {finding:?}", target.name()));
            }
        }
    }
    assert!(findings.is_empty(), "{}", findings.join("\n"));
}
