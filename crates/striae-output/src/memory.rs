//! Memory that is there for a run.

use std::{fs::read_to_string, path::Path};

/// Bytes that this process can take without swapping: those that the machine has for new programs,
/// or fewer where a limit of the process or its control group is lower; `None` if the system does
/// not report it (only Linux does).
pub fn available_bytes() -> Option<f64> {
    let of_machine = read_to_string("/proc/meminfo").ok();
    let of_machine = of_machine.and_then(|text| available(&text));
    let limits = [of_machine, of_process(), of_group()];
    limits.into_iter().flatten().reduce(f64::min)
}

fn available(text: &str) -> Option<f64> {
    kibibytes(text, "MemAvailable:")
}

/// Bytes on a line of a table in kibibytes.
fn kibibytes(text: &str, name: &str) -> Option<f64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: f64 = line.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(1024.0 * kibibytes)
}

/// Addresses that the process may still take (`ulimit -v`).
fn of_process() -> Option<f64> {
    let limit = address_limit(&read_to_string("/proc/self/limits").ok()?)?;
    let taken = kibibytes(&read_to_string("/proc/self/status").ok()?, "VmSize:")?;
    Some((limit - taken).max(0.0))
}

fn address_limit(text: &str) -> Option<f64> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("Max address space"))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Memory that the control group may still take, as in containers.
fn of_group() -> Option<f64> {
    let text = read_to_string("/proc/self/cgroup").ok()?;
    let path = text.lines().find_map(|line| line.strip_prefix("0::"))?;
    let folder = Path::new("/sys/fs/cgroup").join(path.trim_start_matches('/'));
    let number = |file: &str| -> Option<f64> {
        let text = read_to_string(folder.join(file)).ok()?;
        text.trim().parse().ok()
    };
    // Files in memory are given up for programs.
    let files = read_to_string(folder.join("memory.stat")).unwrap_or_default();
    let files = files
        .lines()
        .find_map(|line| line.strip_prefix("inactive_file "))
        .and_then(|number| number.parse::<f64>().ok());
    let taken = number("memory.current")? - files.unwrap_or(0.0);
    Some((number("memory.max")? - taken).max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn available_memory_is_read() {
        let text = "MemTotal:       24600000 kB\nMemFree: 3 kB\nMemAvailable:   22000000 kB\n";
        assert_eq!(available(text), Some(22_000_000.0 * 1024.0));
        assert_eq!(available("MemTotal: 1 kB"), None);
    }

    #[test]
    fn a_limit_of_addresses_is_read() {
        let text = "Limit                     Soft Limit           Hard Limit           Units\n\
                    Max address space         2048000000           unlimited            bytes\n";
        assert_eq!(address_limit(text), Some(2_048_000_000.0));
        let text = "Max address space         unlimited            unlimited            bytes\n";
        assert_eq!(address_limit(text), None);
    }
}
