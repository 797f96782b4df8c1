//! A process that tries mutants, one after another, and says what it does.
//!
//! ```text
//! begin SEED
//! end SEED MILLISECONDS KILOBYTES OUTCOME [TEXT]
//! ```

use std::{
    io::{self, Write},
    time::Duration,
};

use striae_mutants::{
    judge::Judge,
    trial::Mutants,
    usage::{peak_kilobytes, processor_time},
};

use super::Options;

/// Tries all seeds.
pub fn work(options: &Options) -> io::Result<()> {
    let judge = Judge::new()?;
    let mutants = Mutants::new(options.targets.clone(), judge.folder());
    let mut out = io::stdout().lock();
    for seed in options.seeds.clone() {
        writeln!(out, "begin {seed}")?;
        out.flush()?;
        let start = used();
        let outcome = match mutants.tried(seed, &judge) {
            Ok(reached) => format!("{reached:?}"),
            Err(finding) => {
                format!("{:?} {}", finding.kind, finding.text.replace('\n', " | "))
            }
        };
        let milliseconds = used().saturating_sub(start).as_millis();
        writeln!(
            out,
            "end {seed} {milliseconds} {} {outcome}",
            peak_kilobytes().unwrap_or(0)
        )?;
        out.flush()?;
    }
    Ok(())
}

/// Processor time so far.
fn used() -> Duration {
    processor_time(std::process::id()).unwrap_or_default()
}
