//! How much memory a factorisation may take.

use super::{LinalgError, gigabytes};
use std::fmt;
use std::fs;
use std::path::Path;

/// Entries up to which a factor is computed in double precision: it is small, and so is its time.
pub(super) const SMALL: usize = 1 << 22;

/// Memory that can still be had.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Room {
    /// Bytes.
    pub bytes: u64,
    bound: Bound,
}

/// What bounds the memory of the process.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Bound {
    Machine,
    Group,
    AddressSpace,
    Data,
}

impl Room {
    /// Whether an allocation beyond it fails at once: the limits of the process are not those of the machine, which may take pages from
    /// others.
    #[cfg(feature = "mumps")]
    pub(super) fn is_of_process(self) -> bool {
        matches!(self.bound, Bound::AddressSpace | Bound::Data)
    }
}

impl fmt::Display for Room {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let free = gigabytes(self.bytes);
        match self.bound {
            Bound::Machine => write!(f, "{free} of memory are free"),
            Bound::Group => write!(f, "{free} are left of the memory that the control group may take"),
            Bound::AddressSpace => write!(f, "{free} are left of the process's address space (ulimit -v)"),
            Bound::Data => write!(f, "{free} are left of the process's data (ulimit -d)"),
        }
    }
}

/// Bytes of a factor with so many entries.
pub(super) fn bytes_of(entries: usize) -> u64 {
    entries as u64 * if entries > SMALL { 4 } else { 8 }
}

/// Checks that a factor with so many entries fits into the room that is `free`.
///
/// # Errors
/// [`LinalgError::TooLarge`].
pub(super) fn affordable(order: usize, entries: usize, free: Option<Room>) -> Result<(), LinalgError> {
    let bytes = bytes_of(entries);
    match free {
        Some(free) if bytes > free.bytes => {
            Err(LinalgError::TooLarge { order, entries: entries as u64, bytes, limit: free.to_string() })
        }
        _ => Ok(()),
    }
}

/// Memory that the system can give without swapping: what Linux calls available, and no more than what is left of the limits of the
/// process and of its control groups. `None` where the system does not say.
pub(super) fn available() -> Option<Room> {
    let read = |path: &str| fs::read_to_string(path).unwrap_or_default();
    let machine = of_kernel(&read("/proc/meminfo"), "MemAvailable:")?;
    let group = of_groups(Path::new("/sys/fs/cgroup"), &read("/proc/self/cgroup"));
    let [address_space, data] = of_process(&read("/proc/self/limits"), &read("/proc/self/status"));
    let rooms = [
        (Some(machine), Bound::Machine),
        (group, Bound::Group),
        (address_space, Bound::AddressSpace),
        (data, Bound::Data),
    ];
    rooms.into_iter().filter_map(|(bytes, bound)| bytes.map(|bytes| Room { bytes, bound })).min()
}

/// A line `NAME: N kB`, in bytes.
fn of_kernel(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let number = line.trim().strip_suffix("kB")?.trim();
    Some(1024 * number.parse::<u64>().ok()?)
}

/// What is left of the process's address space and of its data; `None` without a limit.
fn of_process(limits: &str, status: &str) -> [Option<u64>; 2] {
    [("Max address space", "VmSize:"), ("Max data size", "VmData:")].map(|(limit, taken)| {
        let line = limits.lines().find_map(|line| line.strip_prefix(limit))?;
        // the first number is the one in force
        let most: u64 = line.split_whitespace().next()?.parse().ok()?;
        Some(most.saturating_sub(of_kernel(status, taken)?))
    })
}

/// What is left to the narrowest of the control groups that the process is in, the lines of `membership`: version 2 or 1, at `root`.
/// Pages of files that can be dropped count as left.
fn of_groups(root: &Path, membership: &str) -> Option<u64> {
    let left = |folder: &Path, [most, taken, droppable]: [&str; 3]| {
        let read = |name: &str| fs::read_to_string(folder.join(name)).ok();
        let number = |name: &str| read(name)?.trim().parse::<u64>().ok();
        let stat = read("memory.stat").unwrap_or_default();
        let dropped = stat.lines().find_map(|line| line.strip_prefix(droppable)?.trim().parse::<u64>().ok());
        Some(number(most)?.saturating_sub(number(taken)?.saturating_sub(dropped.unwrap_or(0))))
    };
    let of_line = |line: &str| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, path) = (parts.next()?, parts.next()?);
        let (root, names) = match controllers {
            "" => (root.to_owned(), ["memory.max", "memory.current", "inactive_file "]),
            _ if controllers.split(',').any(|name| name == "memory") => {
                (root.join("memory"), ["memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file "])
            }
            _ => return None,
        };
        // a container may see the groups above its own by other names, its own at the root
        let within = Path::new(path.trim_start_matches('/'));
        within.ancestors().filter_map(|part| left(&root.join(part), names)).min()
    };
    membership.lines().filter_map(of_line).min()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_that_does_not_fit_is_refused_with_its_size() {
        let room = |bytes: u64, bound: Bound| Some(Room { bytes, bound });
        assert_eq!(affordable(10, 1 << 20, room(1 << 23, Bound::Machine)), Ok(()));
        assert_eq!(affordable(10, 1 << 30, None), Ok(()));
        // more than 2^31 entries
        let (order, entries) = (3_000_000, 7_000_000_000);
        for (bound, words) in [
            (Bound::Machine, "20.0 GB of memory are free"),
            (Bound::Group, "20.0 GB are left of the memory that the control group may take"),
            (Bound::AddressSpace, "20.0 GB are left of the process's address space (ulimit -v)"),
            (Bound::Data, "20.0 GB are left of the process's data (ulimit -d)"),
        ] {
            let error = affordable(order, entries, room(20_000_000_000, bound)).unwrap_err();
            assert_eq!(
                error.to_string(),
                format!(
                    "the factor of a 3000000 x 3000000 matrix has 7000000000 entries, at least 28.0 GB: {words}; expected a coarser mesh, or elements of lower order"
                )
            );
        }
    }

    #[test]
    fn the_systems_words_are_understood() {
        let text = "MemTotal:       24000000 kB\nMemAvailable:   23456789 kB\n";
        assert_eq!(of_kernel(text, "MemAvailable:"), Some(23_456_789 * 1024));
        for damaged in ["", "MemAvailable: many kB", "MemAvailable: 12"] {
            assert_eq!(of_kernel(damaged, "MemAvailable:"), None, "{damaged}");
        }
        let status = "VmSize:\t    1000 kB\nVmData:\t     400 kB\n";
        let limits = |data: &str, space: &str| {
            format!(
                "Limit                     Soft Limit           Hard Limit           Units     \n\
                 Max data size             {data}            unlimited            bytes     \n\
                 Max address space         {space}           unlimited            bytes     \n"
            )
        };
        assert_eq!(of_process(&limits("unlimited", "unlimited"), status), [None, None]);
        assert_eq!(of_process(&limits("500000", "2048000"), status), [Some(1_024_000), Some(500_000 - 409_600)]);
        // less than is mapped already
        assert_eq!(of_process(&limits("unlimited", "1000"), status), [Some(0), None]);
        assert_eq!(of_process("", status), [None, None]);
    }

    #[test]
    fn the_narrowest_control_group_counts() {
        let root = tempfile::tempdir().unwrap();
        let group = |path: &str, files: &[(&str, &str)]| {
            let folder = root.path().join(path);
            fs::create_dir_all(&folder).unwrap();
            for (name, text) in files {
                fs::write(folder.join(name), text).unwrap();
            }
        };
        let of = |membership: &str| of_groups(root.path(), membership);
        group("job/step", &[("memory.max", "max\n"), ("memory.current", "700\n")]);
        assert_eq!(of("0::/job/step\n"), None);
        let stat = "anon 500\ninactive_file 100\n";
        group("job", &[("memory.max", "1000\n"), ("memory.current", "800\n"), ("memory.stat", stat)]);
        assert_eq!(of("0::/job/step\n"), Some(300));
        group("job/step", &[("memory.max", "750\n")]);
        assert_eq!(of("0::/job/step\n"), Some(50));
        // a container: its own group is the root
        assert_eq!(of("0::/\n"), None);
        group("", &[("memory.max", "90\n"), ("memory.current", "70\n")]);
        assert_eq!(of("0::/\n"), Some(20));
        assert_eq!(of("0::/elsewhere\n"), Some(20));
        let first = [("memory.limit_in_bytes", "60\n"), ("memory.usage_in_bytes", "50\n")];
        group("memory/batch", &first);
        assert_eq!(of("9:cpu:/batch\n4:memory:/batch\n0::/\n"), Some(10));
    }
}
