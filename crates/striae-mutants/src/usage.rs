//! Processor time and memory of processes, as reported by Linux.

use std::{fs::read_to_string, time::Duration};

/// Ticks of a second in the tables of processes.
const TICKS: u64 = 100;

/// Processor time that a process has used.
pub fn processor_time(process: u32) -> Option<Duration> {
    let text = read_to_string(format!("/proc/{process}/stat")).ok()?;
    // The name of the program may have blanks and is in brackets.
    let (_, rest) = text.rsplit_once(')')?;
    let mut fields = rest.split_whitespace().skip(11);
    let mut ticks = || fields.next()?.parse::<u64>().ok();
    let ticks = ticks()? + ticks()?;
    Some(Duration::from_millis(ticks * 1000 / TICKS))
}

/// Most memory that this process has had, in kilobytes.
pub fn peak_kilobytes() -> Option<u64> {
    let status = read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.split_whitespace().next()?.parse().ok()
}
