//! Starts workers, watches them, ends those that hang, and counts.

use std::{
    collections::BTreeMap,
    io::{self, BufRead, BufReader, Write},
    process::{Child, ChildStdout, Command, Stdio},
    sync::{
        Mutex, PoisonError,
        mpsc::{Receiver, RecvTimeoutError, channel},
    },
    thread,
    time::{Duration, Instant},
};

use striae_mutants::{target::Target, trial::Mutants, usage::processor_time};

use super::Options;

/// Seeds of a worker.
const CHUNK: u64 = 500;
/// Time over the processor time of a mutant, where others compute on the machine, too.
const IDLE: u32 = 30;

/// Outcomes of the mutants of a target.
#[derive(Clone, Debug, Default)]
struct Counts {
    outcomes: BTreeMap<String, usize>,
    longest: (u64, u64),
    largest: (u64, u64),
}

/// A failure of a seed.
struct Failure {
    seed: u64,
    outcome: String,
    text: String,
}

/// All that has come so far.
#[derive(Default)]
struct Tally {
    counts: BTreeMap<Target, Counts>,
    failures: Vec<Failure>,
}

/// Tries all seeds; returns how many fail.
pub fn drive(options: &Options) -> io::Result<usize> {
    let starts = options.seeds.clone().step_by(CHUNK as usize);
    let chunks: Vec<(u64, u64)> = starts
        .map(|start| (start, (start + CHUNK).min(options.seeds.end)))
        .collect();
    let chunks = Mutex::new(chunks.into_iter());
    let tally = Mutex::new(Tally::default());
    let next = || {
        let mut chunks = chunks.lock().unwrap_or_else(PoisonError::into_inner);
        chunks.next()
    };
    thread::scope(|scope| {
        let jobs: Vec<_> = (0..options.jobs)
            .map(|_| {
                scope.spawn(|| -> io::Result<()> {
                    while let Some((start, end)) = next() {
                        chunk(options, start, end, &tally)?;
                    }
                    Ok(())
                })
            })
            .collect();
        for job in jobs {
            job.join().expect("workers are watched without panics")?;
        }
        Ok::<(), io::Error>(())
    })?;
    let tally = tally.into_inner().unwrap_or_else(PoisonError::into_inner);
    keep(options, &tally.failures)?;
    for (target, counts) in &tally.counts {
        say(&line(*target, counts));
    }
    say(&format!("{} failures", tally.failures.len()));
    Ok(tally.failures.len())
}

/// Prints a line, if anybody still reads: after `| head` the exit code tells, and the files of
/// failures.
fn say(line: &str) {
    let _ = writeln!(io::stdout(), "{line}");
}

fn line(target: Target, counts: &Counts) -> String {
    let total: usize = counts.outcomes.values().sum();
    let outcomes = counts.outcomes.iter();
    let outcomes = outcomes.map(|(outcome, count)| format!("{outcome} {count}"));
    format!(
        "{}: {total} mutants: {}; longest {:.1} s (seed {}), largest {} MB (seed {})",
        target.name(),
        outcomes.collect::<Vec<_>>().join(", "),
        counts.longest.0 as f64 / 1e3,
        counts.longest.1,
        counts.largest.0 / 1000,
        counts.largest.1
    )
}

/// Tries a chunk; after a crash or a hang another worker continues with the next seed.
fn chunk(options: &Options, start: u64, end: u64, tally: &Mutex<Tally>) -> io::Result<()> {
    let mut next = start;
    while next < end {
        let (mut child, lines) = worker(options, next, end)?;
        let mut under_way = next;
        let mut begun = (Instant::now(), Duration::ZERO);
        loop {
            let line = match lines.recv_timeout(Duration::from_secs(1)) {
                Ok(line) => line,
                Err(RecvTimeoutError::Timeout) => {
                    let limit = Duration::from_secs(options.seconds);
                    let used = processor_time(child.id()).unwrap_or_default();
                    let computes = used.saturating_sub(begun.1);
                    if computes <= limit && begun.0.elapsed() <= limit * IDLE {
                        continue;
                    }
                    child.kill()?;
                    child.wait()?;
                    let text = format!("no answer in {} s", options.seconds);
                    take(options, tally, under_way, [0, 0], "Hang", &text);
                    next = under_way + 1;
                    break;
                }
                Err(RecvTimeoutError::Disconnected) => {
                    let status = child.wait()?;
                    if !status.success() {
                        let text = format!("the process ended: {status}");
                        take(options, tally, under_way, [0, 0], "Crash", &text);
                        next = under_way + 1;
                    } else {
                        next = end;
                    }
                    break;
                }
            };
            let words: Vec<&str> = line.splitn(6, ' ').collect();
            match words[..] {
                ["begin", seed] => {
                    under_way = seed.parse().unwrap_or(under_way);
                    let used = processor_time(child.id()).unwrap_or_default();
                    begun = (Instant::now(), used);
                }
                ["end", seed, milliseconds, kilobytes, outcome, ..] => {
                    let number = |word: &str| word.parse::<u64>().unwrap_or(0);
                    let seed = number(seed);
                    let used = [number(milliseconds), number(kilobytes)];
                    let text = words.get(5).copied().unwrap_or_default();
                    take(options, tally, seed, used, outcome, text);
                    under_way = seed + 1;
                    if used[1] > 1000 * options.megabytes {
                        let text = format!("{} MB", used[1] / 1000);
                        take(options, tally, seed, used, "Memory", &text);
                        child.kill()?;
                        child.wait()?;
                        next = seed + 1;
                        break;
                    }
                }
                _ => {}
            }
        }
    }
    Ok(())
}

/// Starts a worker, with its address space bounded where the shell can do that.
fn worker(options: &Options, start: u64, end: u64) -> io::Result<(Child, Receiver<String>)> {
    let program = std::env::current_exe()?;
    // Threads reserve addresses that they never use.
    let limit = 1000 * options.megabytes + 2_000_000;
    let mut child = Command::new("sh")
        .arg("-c")
        .arg(format!("ulimit -v {limit}; exec \"$0\" \"$@\""))
        .arg(program)
        .arg("--worker")
        .args(["--seeds", &format!("{start}..{end}")])
        .args(["--targets", &options.names])
        .env("RAYON_NUM_THREADS", "1")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()?;
    let lines = child.stdout.take().map(reader);
    let lines = lines.ok_or_else(|| io::Error::other("a worker has no output"))?;
    Ok((child, lines))
}

fn reader(out: ChildStdout) -> Receiver<String> {
    let (sender, receiver) = channel();
    thread::spawn(move || {
        for line in BufReader::new(out).lines().map_while(Result::ok) {
            if sender.send(line).is_err() {
                break;
            }
        }
    });
    receiver
}

fn take(
    options: &Options,
    tally: &Mutex<Tally>,
    seed: u64,
    [milliseconds, kilobytes]: [u64; 2],
    outcome: &str,
    text: &str,
) {
    let target = options.targets[(seed % options.targets.len() as u64) as usize];
    let mut tally = tally.lock().unwrap_or_else(PoisonError::into_inner);
    let counts = tally.counts.entry(target).or_default();
    let outcome = match milliseconds > 1000 * options.seconds {
        true => "Slow",
        false => outcome,
    };
    *counts.outcomes.entry(outcome.to_owned()).or_default() += 1;
    counts.longest = counts.longest.max((milliseconds, seed));
    counts.largest = counts.largest.max((kilobytes, seed));
    if !["Refused", "Accepted", "Run"].contains(&outcome) {
        say(&format!("{} {seed}: {outcome}: {text}", target.name()));
        tally.failures.push(Failure {
            seed,
            outcome: outcome.to_owned(),
            text: text.to_owned(),
        });
    }
}

/// Writes the mutants that fail, each with a file of what it does.
fn keep(options: &Options, failures: &[Failure]) -> io::Result<()> {
    if failures.is_empty() {
        return Ok(());
    }
    std::fs::create_dir_all(&options.keep)?;
    let folder = options.keep.join("work");
    std::fs::create_dir_all(&folder)?;
    let mutants = Mutants::new(options.targets.clone(), &folder);
    for failure in failures {
        let (target, sample, _) = mutants.mutant(failure.seed);
        let name = format!("{}-{}-{}", target.name(), failure.seed, sample.name);
        std::fs::write(options.keep.join(&name), &sample.bytes)?;
        let told = format!("{}: {}\n", failure.outcome, failure.text);
        std::fs::write(options.keep.join(name + ".txt"), told)?;
    }
    std::fs::remove_dir_all(folder)
}
