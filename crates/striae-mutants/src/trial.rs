//! Mutants by seed.

use std::{collections::BTreeMap, path::Path};

use striae::{Converged, Next, Observer, Simulation, output::checkpoint::FILE};

use crate::{
    judge::{Depth, Finding, Judge, Reached},
    mutation::{Form, mutated},
    random::Random,
    target::{Sample, Target, samples, small_deck},
};

/// Bytes of a checkpoint before its checksum: a line, and the format.
const BEFORE_CHECKSUM: usize = b"striae checkpoint\n".len() + 8;
/// Mutants of which one is run.
const RUN: usize = 4;

/// The files that are damaged, by target.
#[derive(Debug)]
pub struct Mutants {
    targets: Vec<Target>,
    samples: BTreeMap<Target, Vec<Sample>>,
}

impl Mutants {
    /// Reads the files of some targets; that of checkpoints is made in a folder.
    pub fn new(targets: Vec<Target>, folder: &Path) -> Self {
        let samples = targets.iter().map(|target| {
            let samples = match target {
                Target::Checkpoint => vec![checkpoint(folder)],
                target => samples(*target),
            };
            (*target, samples)
        });
        Self {
            samples: samples.collect(),
            targets,
        }
    }

    /// The files of a target.
    pub fn samples(&self, target: Target) -> &[Sample] {
        &self.samples[&target]
    }

    /// The mutant of a seed, and how deep it is tried. Targets take turns.
    pub fn mutant(&self, seed: u64) -> (Target, Sample, Depth) {
        let target = self.targets[(seed % self.targets.len() as u64) as usize];
        let mut random = Random::new(seed);
        let samples = &self.samples[&target];
        let sample = random.pick(samples);
        let other = random.pick(samples);
        let mut bytes = mutated(&sample.bytes, &other.bytes, sample.form, &mut random);
        if target == Target::Checkpoint && !random.once_in(4) {
            seal(&mut bytes);
        }
        let depth = match random.once_in(RUN) {
            true => Depth::Run,
            false => Depth::Check,
        };
        let sample = Sample {
            bytes,
            ..sample.clone()
        };
        (target, sample, depth)
    }

    /// Tries the mutant of a seed.
    ///
    /// # Errors
    /// The failure.
    pub fn tried(&self, seed: u64, judge: &Judge) -> Result<Reached, Finding> {
        let (target, sample, depth) = self.mutant(seed);
        judge.judge(target, &sample, depth)
    }
}

/// Writes the checksum of a damaged checkpoint.
pub(crate) fn seal(bytes: &mut [u8]) {
    let rest = BEFORE_CHECKSUM + 8;
    if bytes.len() > rest {
        let sum = u64::from(crc32fast::hash(&bytes[rest..]));
        bytes[BEFORE_CHECKSUM..rest].copy_from_slice(&sum.to_le_bytes());
    }
}

/// The checkpoint of a run that is stopped in its second increment.
fn checkpoint(folder: &Path) -> Sample {
    let run = folder.join("made");
    let simulation = Simulation::open(&small_deck(), &run).expect("a deck of the repository");
    let finished = simulation.run_with(&mut Second(0));
    finished.expect("a run that can be written");
    Sample {
        name: FILE.to_owned(),
        bytes: std::fs::read(run.join(FILE)).expect("a checkpoint of a stopped run"),
        form: Form::Binary,
        base: run,
    }
}

/// Stops a run after two increments.
struct Second(usize);

impl Observer for Second {
    fn increment(&mut self, _converged: &Converged<'_>) -> Next {
        self.0 += 1;
        match self.0 < 2 {
            true => Next::Continue,
            false => Next::Stop,
        }
    }
}
