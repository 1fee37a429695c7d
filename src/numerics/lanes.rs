//! Numbers side by side, [`LANES`] at a time: what the hot loop is written in, so that the compiler can take
//! vector registers of any width without changing a sum's order.
//!
//! A column of n numbers has its last lanes filled up; what stands there must not reach a result.

use std::hint::black_box;

/// Numbers in one group.
pub(crate) const LANES: usize = 4;

/// One group of numbers.
pub(crate) type Lanes = [f64; LANES];

/// Groups for `count` numbers, all with the same value.
pub(crate) fn column(count: usize, value: f64) -> Vec<Lanes> {
    vec![[value; LANES]; count.div_ceil(LANES)]
}

/// Groups that hold `values`, filled up with `rest`.
pub(crate) fn filled(values: &[f64], rest: f64) -> Vec<Lanes> {
    let mut groups = column(values.len(), rest);
    for (lane, value) in groups.as_flattened_mut().iter_mut().zip(values) {
        *lane = *value;
    }
    groups
}

/// The first `N` of these, all for `N` = 0: a loop over a number that the compiler knows is unrolled.
#[inline(always)]
pub(crate) fn first<const N: usize, T>(items: &[T]) -> &[T] {
    if N == 0 { items } else { &items[..N] }
}

/// The same to be changed.
#[inline(always)]
pub(crate) fn first_mut<const N: usize, T>(items: &mut [T]) -> &mut [T] {
    if N == 0 { items } else { &mut items[..N] }
}

/// Copies `values` to the front; what fills up the last group becomes zero.
#[inline(always)]
pub(crate) fn set(groups: &mut [Lanes], values: &[f64]) {
    for (group, values) in groups.iter_mut().zip(values.chunks(LANES)) {
        *group = from(values);
    }
}

/// The first values as a group, filled up with zeros: stored as a whole, so that it can be read as a whole at once.
#[inline(always)]
pub(crate) fn from(values: &[f64]) -> Lanes {
    match *values {
        [a, b, c, d, ..] => [a, b, c, d],
        [a, b, c] => [a, b, c, 0.0],
        [a, b] => [a, b, 0.0, 0.0],
        [a] => [a, 0.0, 0.0, 0.0],
        [] => [0.0; LANES],
    }
}

/// Copies what stands at the front out again.
#[inline(always)]
pub(crate) fn get(groups: &[Lanes], values: &mut [f64]) {
    for (values, group) in values.chunks_mut(LANES).zip(groups) {
        put(group, values);
    }
}

/// Copies a group to at most so many values.
#[inline(always)]
pub(crate) fn put(group: &Lanes, values: &mut [f64]) {
    match values {
        [a, b, c, d, ..] => [*a, *b, *c, *d] = *group,
        [a, b, c] => [*a, *b, *c, _] = *group,
        [a, b] => [*a, *b, ..] = *group,
        [a] => [*a, ..] = *group,
        [] => {}
    }
}

/// `f` of every lane.
#[inline(always)]
pub(crate) fn each(f: impl Fn(usize) -> f64) -> Lanes {
    // written out: without optimisation a loop would go through memory
    [f(0), f(1), f(2), f(3)]
}

/// `a b + c`, rounded once: the same on every machine, and one instruction where the caller is compiled for machines that have it.
#[inline(always)]
pub(crate) fn fused(a: f64, b: f64, c: f64) -> f64 {
    a.mul_add(b, c)
}

/// x, or 0 where it is negative; NaN stays.
#[inline(always)]
pub(crate) fn positive(x: f64) -> f64 {
    if x <= 0.0 { 0.0 } else { x }
}

/// `a . b`, lane by lane and then over the lanes.
#[inline(always)]
pub(crate) fn dot<'a>(a: impl Iterator<Item = &'a Lanes>, b: &[Lanes]) -> f64 {
    let mut sums = [0.0; LANES];
    for (a, b) in a.zip(b) {
        sums = each(|l| sums[l] + a[l] * b[l]);
    }
    total(&sums)
}

/// `a . b` of plain slices.
#[inline]
pub(crate) fn scalar_product(a: &[f64], b: &[f64]) -> f64 {
    // four sums side by side: the order is fixed, and the compiler can use vector registers
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + rest
}

/// `sum += factor * row`.
#[inline(always)]
pub(crate) fn add_scaled(sum: &mut [Lanes], factor: f64, row: &[Lanes]) {
    for (sum, row) in sum.iter_mut().zip(row) {
        *sum = each(|l| sum[l] + factor * row[l]);
    }
}

/// Sum over the lanes.
#[inline(always)]
pub(crate) fn total(x: &Lanes) -> f64 {
    let x = together(*x);
    (x[0] + x[1]) + (x[2] + x[3])
}

/// The same group. A compiler that sees that its lanes part takes all before apart, or into half registers.
#[inline(always)]
pub(crate) fn together(x: Lanes) -> Lanes {
    black_box(x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_fills_up_a_column_of_zeros_does_not_count() {
        let (a, b) = (filled(&[1.0, 2.0, 3.0, 4.0, 5.0], 0.0), column(5, 2.0));
        assert!((dot(a.iter(), &b) - 30.0).abs() < 1e-15);
        let mut sum = column(5, 1.0);
        add_scaled(&mut sum, -1.0, &a);
        assert!((sum.as_flattened()[4] + 4.0).abs() < 1e-15);
        assert!((sum.as_flattened()[5] - 1.0).abs() < 1e-15);
    }

    #[test]
    fn nothing_below_zero_and_nan_shows() {
        assert!(positive(-1.0).abs() < f64::MIN_POSITIVE && (positive(2.0) - 2.0).abs() < 1e-15);
        assert!(positive(f64::NAN).is_nan());
    }
}
