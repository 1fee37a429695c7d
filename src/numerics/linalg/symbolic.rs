//! Where the entries of a factor are: supernodes of one pattern, shared by all factorisations on it.
//!
//! How much memory a factorisation may take.

use super::{LinalgError, SymmetricMatrix, gigabytes};
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SymbolicSupernodalParams;
use faer::sparse::linalg::cholesky::simplicial::{
    prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch,
};
use faer::sparse::linalg::cholesky::supernodal::{
    SymbolicSupernodalCholesky, factorize_supernodal_symbolic_cholesky, factorize_supernodal_symbolic_cholesky_scratch,
};
use std::fs;

/// Supernodes that are merged: so many columns with at most this fraction of zeros. Against faer's default 5 % faster on
/// a solid of 60 000 degrees of freedom.
const RELAXATION: &[(usize, f64)] = &[(8, 1.0), (24, 0.6), (64, 0.15), (usize::MAX, 0.05)];

/// Entries of a factor up to which double precision costs nothing that is noticed: 32 MB.
pub(super) const SMALL: usize = 1 << 22;

/// Where the factor's entries are, for one pattern: faer's analysis, `len_val` entries.
pub(super) type Symbolic = SymbolicSupernodalCholesky<u32>;

/// Analyses the pattern of a matrix in the order in which it is factorised.
///
/// # Errors
/// [`LinalgError::TooLarge`] if the factor has more than 2^31 entries or more than memory holds; [`LinalgError::Factorisation`]
/// if memory does not suffice for the analysis.
pub(super) fn analysed(a: &SymmetricMatrix) -> Result<Symbolic, LinalgError> {
    let order = a.order();
    let failed = |reason| LinalgError::Factorisation { order, reason };
    let (offsets, rows) = upper_pattern(a);
    let pattern = SymbolicSparseColMatRef::new_checked(order, order, &offsets, None, &rows);
    let scratch = StackReq::or(
        prefactorize_symbolic_cholesky_scratch::<u32>(order, rows.len()),
        factorize_supernodal_symbolic_cholesky_scratch::<u32>(order),
    );
    let mut buffer = MemBuffer::try_new(scratch).map_err(|_| failed("out of memory"))?;
    let stack = MemStack::new(&mut buffer);
    let (mut tree, mut counts) = (vec![0; order], vec![0; order]);
    let tree = prefactorize_symbolic_cholesky(&mut tree, &mut counts, pattern, stack);
    let entries = counts.iter().map(|&count| u64::from(count)).sum();
    affordable(order, entries, available())?;
    let parameters = SymbolicSupernodalParams { relax: Some(RELAXATION) };
    factorize_supernodal_symbolic_cholesky(pattern, tree, &counts, stack, parameters)
        .map_err(|_| failed("its factor has more than 2^31 entries, or memory is short"))
}

/// Checks that a factor fits: in single precision where it is large, which is tried first.
///
/// # Errors
/// [`LinalgError::TooLarge`].
fn affordable(order: usize, entries: u64, free: Option<u64>) -> Result<(), LinalgError> {
    let large = entries > SMALL as u64;
    let bytes = entries * if large { 4 } else { 8 };
    let limit = match free {
        _ if entries > i32::MAX as u64 => "more than 2^31 entries cannot be counted".to_owned(),
        Some(free) if bytes > free => format!("{} GB of memory are free", gigabytes(free)),
        _ => return Ok(()),
    };
    Err(LinalgError::TooLarge { order, entries, bytes, limit })
}

/// Upper triangle in compressed columns: the transposed pattern.
fn upper_pattern(a: &SymmetricMatrix) -> (Vec<u32>, Vec<u32>) {
    let order = a.order();
    let mut offsets = vec![0_u32; order + 1];
    for &row in &a.rows {
        offsets[row as usize + 1] += 1;
    }
    for row in 0..order {
        offsets[row + 1] += offsets[row];
    }
    let mut next = offsets.clone();
    let mut columns = vec![0; a.rows.len()];
    for column in 0..order {
        for (row, _) in a.column(column) {
            columns[next[row] as usize] = column as u32;
            next[row] += 1;
        }
    }
    (offsets, columns)
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
        let (order, entries, free) = (3_000_000, 2_000_000_000, 4_000_000_000);
        let error = affordable(order, entries, Some(free)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "the factor of a 3000000 x 3000000 matrix has 2000000000 entries, at least 8.0 GB: 4.0 GB of memory are free; expected a coarser mesh, or elements of lower order"
        );
        let places = affordable(order, 1 << 31, Some(u64::MAX)).unwrap_err();
        assert!(places.to_string().contains("more than 2^31 entries"), "{places}");
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
