//! Median times of repeated work.

use serde_json::{Value, json};
use std::time::{Duration, Instant};

/// Time in which repetitions are made, s.
const BUDGET: f64 = 1.0;
const FEWEST: usize = 3;
const MOST: usize = 200;

/// Time on the wall clock and of all threads together, s.
#[derive(Clone, Copy)]
pub struct Seconds {
    /// On the wall clock.
    pub wall: f64,
    /// Of all threads, which another program does not lengthen; Linux only.
    pub cpu: f64,
}

impl Seconds {
    /// The time since the start of the machine and of the process.
    pub fn now(started: Instant) -> Self {
        let wall = started.elapsed().as_secs_f64();
        let cpu = ticks().unwrap_or(f64::NAN) / 100.0;
        Self { wall, cpu }
    }

    /// The time between two moments.
    pub fn since(self, earlier: Self) -> Self {
        Self {
            wall: self.wall - earlier.wall,
            cpu: self.cpu - earlier.cpu,
        }
    }
}

/// User and system time of this process in hundredths of a second.
fn ticks() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = text.rsplit(')').next()?.split_whitespace().collect();
    let field = |k: usize| fields.get(k)?.parse::<f64>().ok();
    Some(field(11)? + field(12)?)
}

/// Median and spread of the time of `work`, which handles so many `items`.
pub fn timed(group: &str, name: &str, items: usize, mut work: impl FnMut()) -> Value {
    timed_by(group, name, items, || {
        let started = Instant::now();
        work();
        started.elapsed()
    })
}

/// Median and spread of the time that `work`, which handles so many `items`, says a part of it took.
pub fn timed_by(
    group: &str,
    name: &str,
    items: usize,
    mut work: impl FnMut() -> Duration,
) -> Value {
    let mut times = Vec::new();
    let begin = Instant::now();
    work();
    let first = Seconds::now(begin);
    while times.len() < FEWEST || times.len() < MOST && begin.elapsed().as_secs_f64() < BUDGET {
        times.push(work().as_secs_f64());
    }
    let cpu = Seconds::now(begin).since(first).cpu / times.len() as f64;
    times.sort_by(f64::total_cmp);
    let quantile = |share: f64| times[((times.len() - 1) as f64 * share).round() as usize];
    let (median, low, high) = (quantile(0.5), quantile(0.1), quantile(0.9));
    println!(
        "{group:9} {name:32} {:>12} an item  {:>12} in all  +-{:.0} %  ({} times)  {:>12} of processors an item",
        words(median / items.max(1) as f64),
        words(median),
        50.0 * (high - low) / median,
        times.len(),
        words(cpu / items.max(1) as f64),
    );
    json!({
        "group": group, "name": name, "items": items, "median_s": median,
        "low_s": low, "high_s": high, "cpu_s": cpu, "times": times.len(),
    })
}

/// A time in the unit that suits it.
pub fn words(seconds: f64) -> String {
    match seconds {
        s if s < 1e-6 => format!("{:.1} ns", s * 1e9),
        s if s < 1e-3 => format!("{:.2} us", s * 1e6),
        s if s < 1.0 => format!("{:.2} ms", s * 1e3),
        s => format!("{s:.2} s"),
    }
}
