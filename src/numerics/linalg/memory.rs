//! How much memory a factorisation may take.

use super::{LinalgError, gigabytes};
use std::fs;

/// Entries up to which a factor is computed in double precision: it is small, and so is its time.
pub(super) const SMALL: usize = 1 << 22;

/// Checks that a factor with so many entries fits into `free` bytes.
///
/// # Errors
/// [`LinalgError::TooLarge`].
pub(super) fn affordable(order: usize, entries: usize, free: Option<u64>) -> Result<(), LinalgError> {
    let bytes = entries as u64 * if entries > SMALL { 4 } else { 8 };
    match free {
        Some(free) if bytes > free => {
            let limit = format!("{} GB of memory are free", gigabytes(free));
            Err(LinalgError::TooLarge { order, entries: entries as u64, bytes, limit })
        }
        _ => Ok(()),
    }
}

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
    use super::affordable;

    #[test]
    fn a_factor_that_does_not_fit_is_refused_with_its_size() {
        assert_eq!(affordable(10, 1 << 20, Some(1 << 23)), Ok(()));
        assert_eq!(affordable(10, 1 << 30, None), Ok(()));
        // more than 2^31 entries
        let (order, entries, free) = (3_000_000, 7_000_000_000, 20_000_000_000);
        let error = affordable(order, entries, Some(free)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the factor of a 3000000 x 3000000 matrix has 7000000000 entries, at least 28.0 GB: 20.0 GB of memory are free; expected a coarser mesh, or elements of lower order"
        );
    }
}

#[cfg(test)]
mod memory_tests {
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
