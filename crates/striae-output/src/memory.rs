//! Memory of the machine.

use std::fs::read_to_string;

/// Bytes that the machine has for new programs without swapping; `None` where the
/// system does not tell (it is Linux that does).
pub fn available_bytes() -> Option<f64> {
    available(&read_to_string("/proc/meminfo").ok()?)
}

fn available(text: &str) -> Option<f64> {
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kibibytes: f64 = line.trim().strip_suffix(" kB")?.parse().ok()?;
    Some(1024.0 * kibibytes)
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
}
