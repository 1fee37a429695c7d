//! How much memory a factorisation may take.

use std::fs;

/// Memory that the system can give without swapping, in bytes: what Linux calls available, and no more than what is left of the
/// control group's limit. `None` where the system does not say.
pub(super) fn available() -> Option<u64> {
    let text = fs::read_to_string("/proc/meminfo").ok()?;
    let free = of_meminfo(&text)?;
    let group = |name: &str| {
        let text = fs::read_to_string(format!("/sys/fs/cgroup/{name}")).ok()?;
        text.trim().parse::<u64>().ok()
    };
    let left = group("memory.max").zip(group("memory.current"));
    Some(left.map_or(free, |(most, taken)| free.min(most.saturating_sub(taken))))
}

/// The line `MemAvailable: N kB`.
fn of_meminfo(text: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let number = line.trim().strip_suffix("kB")?.trim();
    Some(1024 * number.parse::<u64>().ok()?)
}

#[cfg(test)]
mod tests {
    use super::of_meminfo;

    #[test]
    fn the_systems_words_are_understood() {
        let text = "MemTotal:       24000000 kB\nMemAvailable:   23456789 kB\n";
        assert_eq!(of_meminfo(text), Some(23_456_789 * 1024));
        for damaged in ["", "MemAvailable: many kB", "MemAvailable: 12"] {
            assert_eq!(of_meminfo(damaged), None, "{damaged}");
        }
    }
}
