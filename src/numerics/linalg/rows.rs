//! Products of columns of a factor and rows of right-hand sides.
//!
//! They are functions of their own: within a longer one, sums are written to memory after every product.

use super::precision::Precision;
use multiversion::multiversion;
use multiversion::target::target_cfg_f;

/// Rows that are handled at once.
pub(super) const TILE: usize = 8;

/// A row of a block of `L` right-hand sides.
pub(super) type Row<T, const L: usize> = [T; L];

/// `rows += columns minus^T` for `J` columns.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx2+fma", "x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
#[inline(never)]
pub(super) fn subtract<T: Precision, const L: usize, const J: usize>(
    columns: &[&[T]; J],
    minus: &[Row<T, L>; J],
    rows: &mut [Row<T, L>],
) {
    if target_cfg_f!(any(target_feature = "fma", target_feature = "neon")) {
        subtract_by::<T, L, J, true>(columns, minus, rows);
    } else {
        subtract_by::<T, L, J, false>(columns, minus, rows);
    }
}

#[inline(always)]
fn subtract_by<T: Precision, const L: usize, const J: usize, const FUSED: bool>(
    columns: &[&[T]; J],
    minus: &[Row<T, L>; J],
    rows: &mut [Row<T, L>],
) {
    let minus = *minus;
    let (tiles, last) = rows.as_chunks_mut::<TILE>();
    let done = TILE * tiles.len();
    // slices of known length need no checks
    let entries = columns.map(|column| &column.as_chunks::<TILE>().0[..tiles.len()]);
    for (index, rows) in tiles.iter_mut().enumerate() {
        let entries: [&[T; TILE]; J] = std::array::from_fn(|j| &entries[j][index]);
        for (i, row) in rows.iter_mut().enumerate() {
            let mut sum = *row;
            for j in 0..J {
                add::<T, L, FUSED>(&mut sum, entries[j][i], &minus[j]);
            }
            *row = sum;
        }
    }
    for (i, row) in last.iter_mut().enumerate() {
        for j in 0..J {
            add::<T, L, FUSED>(row, columns[j][done + i], &minus[j]);
        }
    }
}

/// `columns^T rows` for `J` columns, `R` rows at once.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx2+fma", "x86_64+avx2+fma", "aarch64+neon"), dispatcher = "direct")]
#[inline(never)]
pub(super) fn products<T: Precision, const L: usize, const J: usize, const R: usize>(
    columns: &[&[T]; J],
    rows: &[Row<T, L>],
) -> [Row<T, L>; J] {
    if target_cfg_f!(any(target_feature = "fma", target_feature = "neon")) {
        products_by::<T, L, J, R, true>(columns, rows)
    } else {
        products_by::<T, L, J, R, false>(columns, rows)
    }
}

#[inline(always)]
fn products_by<T: Precision, const L: usize, const J: usize, const R: usize, const FUSED: bool>(
    columns: &[&[T]; J],
    rows: &[Row<T, L>],
) -> [Row<T, L>; J] {
    let mut sums = [[T::default(); L]; J];
    let (tiles, last) = rows.as_chunks::<R>();
    let done = R * tiles.len();
    let entries = columns.map(|column| &column.as_chunks::<R>().0[..tiles.len()]);
    for (index, rows) in tiles.iter().enumerate() {
        let entries: [&[T; R]; J] = std::array::from_fn(|j| &entries[j][index]);
        for (i, row) in rows.iter().enumerate() {
            for j in 0..J {
                add::<T, L, FUSED>(&mut sums[j], entries[j][i], row);
            }
        }
    }
    for (i, row) in last.iter().enumerate() {
        for j in 0..J {
            add::<T, L, FUSED>(&mut sums[j], columns[j][done + i], row);
        }
    }
    sums
}

/// `to + factor row` in place.
#[inline(always)]
pub(super) fn add<T: Precision, const L: usize, const FUSED: bool>(to: &mut Row<T, L>, factor: T, row: &Row<T, L>) {
    for lane in 0..L {
        to[lane] = if FUSED { factor.fused(row[lane], to[lane]) } else { factor * row[lane] + to[lane] };
    }
}
