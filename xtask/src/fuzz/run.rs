//! A target under libFuzzer for some time.

use std::{
    fs::{self, File},
    path::{Path, PathBuf},
    process::Command,
    time::Instant,
};

use super::{Options, Place};
use crate::fault::Fault;

/// Times that a target begins again after an input has ended its process.
const STARTS: u32 = 10;
/// Memory that an input may take, in megabytes.
const MEMORY: u64 = 2000;
/// Addresses that the process may reserve, in kilobytes: threads reserve more than they use.
const ADDRESSES: u64 = 1000 * MEMORY + 2_000_000;
/// Wall time after which an input is given up, in seconds, by a target that has a core to itself.
///
/// Only loops last as long: the target itself judges the processor time of an input, within less.
const PATIENCE: u64 = 60;

/// Counts and findings of a target.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Outcome {
    /// Its name.
    pub target: String,
    /// Time of the search.
    pub seconds: u64,
    /// Inputs tried.
    pub executions: u64,
    /// Edges of the code that some input passes.
    pub edges: u64,
    /// Inputs kept.
    pub corpus: u64,
    /// Seconds of the slowest input.
    pub longest: u64,
    /// Most memory.
    pub megabytes: u64,
    /// Inputs that fail, each with what it does.
    pub findings: Vec<String>,
}

/// Searches for the given time, again after inputs that end the process.
pub fn searched(place: &Place, target: &str, options: &Options) -> Result<Outcome, Fault> {
    let begun = Instant::now();
    let mut outcome = Outcome {
        target: target.to_owned(),
        ..Outcome::default()
    };
    for start in 0..STARTS {
        let left = options
            .time
            .saturating_sub(begun.elapsed())
            .as_secs_f64()
            .ceil();
        if left == 0.0 {
            break;
        }
        let log = place.of("logs", &format!("{target}-{start}"));
        let time = format!("-max_total_time={left}");
        // A search that begins again is not to meet the same end.
        let seed = options
            .seed
            .map(|seed| format!("-seed={}", seed.wrapping_add(start)));
        let own: Vec<&str> = [&time]
            .into_iter()
            .chain(&seed)
            .map(String::as_str)
            .collect();
        let ended = started(place, target, &log, &own)?;
        let text = fs::read(&log).map_err(unreadable(&log))?;
        outcome.add(&String::from_utf8_lossy(&text));
        if ended {
            break;
        }
        if outcome.executions == 0 {
            return Err(Fault::Option(format!("{} tells why", log.display())));
        }
    }
    outcome.seconds = begun.elapsed().as_secs();
    outcome.findings = findings(place, target)?;
    Ok(outcome)
}

/// Runs the program; true if it ends by itself.
pub fn started(place: &Place, target: &str, log: &Path, own: &[&str]) -> Result<bool, Fault> {
    let corpus = place.of("corpus", target);
    fs::create_dir_all(&corpus).map_err(unreadable(&corpus))?;
    let out = File::create(log).map_err(unreadable(log))?;
    let seeds = place.of("seeds", target);
    fs::create_dir_all(&seeds).map_err(unreadable(&seeds))?;
    let option = |name: &str, path: PathBuf| format!("-{name}={}", path.display());
    let mut command = Command::new("sh");
    command
        .arg("-c")
        .arg(format!("ulimit -v {ADDRESSES}; exec \"$0\" \"$@\""))
        .arg(&place.program)
        .args(own)
        .arg(option("dict", place.of("words", target)))
        .arg(option(
            "artifact_prefix",
            place.of("findings", &format!("{target}-")),
        ))
        .arg(format!("-rss_limit_mb={MEMORY}"))
        .arg(format!("-timeout={}", PATIENCE * place.sharing))
        .args(["-print_final_stats=1", "-use_value_profile=0"]);
    if !own.iter().any(|word| word.contains("merge=")) {
        let own = Path::new("crates/striae-mutants/corpus/fuzz").join(target);
        command.args([corpus, seeds, own]);
    }
    let status = command
        .env("STRIAE_FUZZ_TARGET", target)
        .env("STRIAE_FUZZ_FOLDER", &place.folder)
        // What an input writes is in a folder that goes with the next search.
        .env("TMPDIR", place.folder.join("scratch"))
        .env("RAYON_NUM_THREADS", "1")
        .stdout(out.try_clone().map_err(unreadable(log))?)
        .stderr(out)
        .status();
    let status = status.map_err(|cause| Fault::Start {
        command: place.program.display().to_string(),
        cause,
    })?;
    Ok(status.success())
}

/// All findings of a target; inputs that ended the process have no text.
fn findings(place: &Place, target: &str) -> Result<Vec<String>, Fault> {
    let folder = place.folder.join("findings");
    let mut found = Vec::new();
    for entry in fs::read_dir(&folder).map_err(unreadable(&folder))? {
        let path = entry.map_err(unreadable(&folder))?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let input = name.starts_with(target) && !name.ends_with(".txt");
        // Slow units are told, not counted: only those beyond the limit are findings.
        if input && !name.contains("-slow-unit-") {
            let told = fs::read_to_string(path.with_extension("txt"));
            let told = told.unwrap_or_else(|_| "it ended the process".into());
            found.push(format!("{}: {told}", path.display()));
        }
    }
    found.sort();
    Ok(found)
}

pub(super) fn unreadable(path: &Path) -> impl FnOnce(std::io::Error) -> Fault {
    let path = path.to_owned();
    move |cause| Fault::Unreadable { path, cause }
}

impl Outcome {
    /// Adds what the log of a process tells.
    fn add(&mut self, log: &str) {
        let mut executions = 0;
        for line in log.lines() {
            let words: Vec<&str> = line.split_whitespace().collect();
            let after = |name: &str| {
                let at = words.iter().position(|word| *word == name)?;
                let word = words.get(at + 1)?.split('/').next()?;
                word.parse::<u64>().ok()
            };
            if let Some(count) = words.first().and_then(|word| word.strip_prefix('#')) {
                executions = count.parse().unwrap_or(executions);
            }
            executions = after("stat::number_of_executed_units:").unwrap_or(executions);
            self.edges = self.edges.max(after("cov:").unwrap_or(0));
            self.corpus = self.corpus.max(after("corp:").unwrap_or(0));
            self.longest = self
                .longest
                .max(after("stat::slowest_unit_time_sec:").unwrap_or(0));
            self.megabytes = self.megabytes.max(after("stat::peak_rss_mb:").unwrap_or(0));
        }
        self.executions += executions;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_log_gives_counts_that_add_up_over_starts() {
        let log = "#512\tpulse  cov: 70 ft: 90 corp: 5/20b exec/s: 256 rss: 41Mb\n\
                   #900\tDONE   cov: 80 ft: 99 corp: 7/30b exec/s: 300 rss: 41Mb\n\
                   stat::number_of_executed_units: 901\n\
                   stat::slowest_unit_time_sec:    2\n\
                   stat::peak_rss_mb:              45\n";
        let mut outcome = Outcome::default();
        outcome.add(log);
        outcome.add("#100\tpulse  cov: 60 ft: 90 corp: 5/20b\n");
        let expected = Outcome {
            executions: 1001,
            edges: 80,
            corpus: 7,
            longest: 2,
            megabytes: 45,
            ..Outcome::default()
        };
        assert_eq!(outcome, expected);
    }
}
