//! `striae-fuzz`: a target under libFuzzer, whose options it takes; `cargo xtask fuzz` starts it.
//!
//! [`striae_mutants::fuzzing`] says what the environment has to name.

#![no_main]

use std::sync::LazyLock;

use libfuzzer_sys::{Corpus, fuzz_mutator, fuzz_target, fuzzer_mutate};
use striae_mutants::{fuzzing::Fuzzing, random::Random};

/// Mutants of which one is made by libFuzzer, which changes bytes, words of the dictionary and
/// operands of comparisons.
const BLIND: usize = 3;

static FUZZING: LazyLock<Fuzzing> =
    LazyLock::new(|| Fuzzing::new().expect("a target and a folder for it"));

fuzz_target!(init: LazyLock::force(&FUZZING), |bytes: &[u8]| -> Corpus {
    match FUZZING.tried(bytes) {
        Ok(()) => Corpus::Keep,
        Err(_) => Corpus::Reject,
    }
});

fuzz_mutator!(|data: &mut [u8], size: usize, max_size: usize, seed: u32| {
    let mut random = Random::new(seed.into());
    let size = match random.once_in(BLIND) {
        true => fuzzer_mutate(data, size, max_size),
        false => {
            let mutant = FUZZING.mutated(&data[..size], &mut random);
            let size = mutant.len().min(max_size);
            data[..size].copy_from_slice(&mutant[..size]);
            size
        }
    };
    FUZZING.complete(&mut data[..size]);
    size
});
