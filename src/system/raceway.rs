//! Mode shapes along the raceway, ready for the hot loop: one polynomial an element and a mode.
//!
//! Inside an element the interpolation is smooth; a polynomial through Chebyshev points reproduces
//! it to [`ACCURACY`], and Horner's rule over modes side by side costs a few additions a mode.

use super::lanes::{LANES, Lanes, column, each, total};
use super::structure::StructureModes;
use crate::model::{Ring, RingRows};
use std::f64::consts::PI;

/// Largest deviation from the interpolation, relative to the largest value of all modes.
const ACCURACY: f64 = 1e-12;

/// Degrees tried, in order.
const DEGREES: [usize; 6] = [3, 5, 7, 9, 13, 17];

/// Values of the kept modes along the raceway.
#[derive(Debug, Clone)]
pub(super) struct RacewayTable {
    elements: usize,
    modes: usize,
    degree: usize,
    /// Coefficients of an element.
    width: usize,
    /// [element][group of modes][power], powers of the local coordinate in [-1, 1], highest first.
    coefficients: Vec<Lanes>,
}

impl RacewayTable {
    /// Table of `component(rows) . phi` for the given modes.
    pub fn new(
        ring: &Ring,
        modes: &StructureModes,
        kept: &[usize],
        component: impl Fn(&RingRows) -> [f64; 6],
    ) -> Self {
        let sample = |element: usize, xi: f64| -> Vec<f64> {
            let half = PI / ring.nodes() as f64;
            let rows = ring.rows_in_element(element, xi * half);
            let factors = component(&rows);
            kept.iter()
                .map(|&mode| {
                    let shape = modes.shapes.col(mode);
                    (0..6).map(|k| factors[k] * shape[rows.dofs[k]]).sum()
                })
                .collect()
        };
        Self::fit(ring.nodes(), kept.len(), &sample)
    }

    /// Table of the radial interpolation itself: six values over the polar components of an
    /// element's nodes, one element for all.
    pub fn of_interpolation(ring: &Ring) -> Self {
        let half = PI / ring.nodes() as f64;
        Self::fit(1, 6, &|_, xi| ring.polar_radial_row(xi * half).to_vec())
    }

    /// Raises the degree until the polynomials reproduce `sample(element, xi)`.
    fn fit(elements: usize, modes: usize, sample: &impl Fn(usize, f64) -> Vec<f64>) -> Self {
        let mut table = Self::fitted(elements, modes, DEGREES[0], sample);
        for degree in &DEGREES[1..] {
            if table.worst_error(sample) <= ACCURACY {
                break;
            }
            table = Self::fitted(elements, modes, *degree, sample);
        }
        table
    }

    /// Groups of modes: the length of a row, at least one.
    #[inline(always)]
    pub fn groups(&self) -> usize {
        self.modes.div_ceil(LANES)
    }

    /// Coefficients of an element: one slice a group of modes.
    #[inline(always)]
    fn element(&self, element: usize) -> impl Iterator<Item = &[Lanes]> {
        let block = &self.coefficients[element * self.width..(element + 1) * self.width];
        block.chunks_exact(self.degree + 1)
    }

    /// Values of all modes at an angle in turns, 0 <= turn < 1, into `out` \[groups\]; gives their sum with the
    /// `amplitudes` \[groups\].
    #[inline(always)]
    pub fn values_into(&self, turn: f64, amplitudes: &[Lanes], out: &mut [Lanes]) -> f64 {
        let (element, xi) = locate(turn, self.elements);
        let block = &self.coefficients[element * self.width..(element + 1) * self.width];
        // loops of known length
        match self.degree {
            3 => horner::<4>(block, xi, amplitudes, out),
            5 => horner::<6>(block, xi, amplitudes, out),
            7 => horner::<8>(block, xi, amplitudes, out),
            9 => horner::<10>(block, xi, amplitudes, out),
            13 => horner::<14>(block, xi, amplitudes, out),
            _ => horner::<18>(block, xi, amplitudes, out),
        }
    }

    /// The values at the local coordinate -1 <= xi <= 1 of an element.
    #[inline(always)]
    pub fn local_values_into(&self, element: usize, xi: f64, out: &mut [Lanes]) {
        for (out, powers) in out.iter_mut().zip(self.element(element)) {
            let mut value = powers[0];
            for power in &powers[1..] {
                value = each(|l| value[l] * xi + power[l]);
            }
            *out = value;
        }
    }

    /// Derivatives of all modes by the angle at an angle in turns, 1/rad, into `out` \[groups\].
    #[inline(always)]
    pub fn slopes_into(&self, turn: f64, out: &mut [Lanes]) {
        let (element, xi) = locate(turn, self.elements);
        self.local_slopes_into(element, xi, self.elements as f64 / PI, out);
    }

    /// Derivatives by the local coordinate, times `scale`.
    #[inline(always)]
    pub fn local_slopes_into(&self, element: usize, xi: f64, scale: f64, out: &mut [Lanes]) {
        for (out, powers) in out.iter_mut().zip(self.element(element)) {
            let (mut value, mut slope) = (powers[0], [0.0; LANES]);
            for power in &powers[1..] {
                slope = each(|l| slope[l] * xi + value[l]);
                value = each(|l| value[l] * xi + power[l]);
            }
            *out = slope.map(|slope| slope * scale);
        }
    }

    /// A bound of each mode's magnitude along the whole raceway \[groups\].
    pub fn bounds(&self) -> Vec<Lanes> {
        let mut bounds = column(self.modes, 0.0);
        for element in 0..self.elements {
            for (bound, powers) in bounds.iter_mut().zip(self.element(element)) {
                // |xi| <= 1
                *bound = each(|l| bound[l].max(powers.iter().map(|power| power[l].abs()).sum()));
            }
        }
        bounds
    }

    /// Interpolation at the Chebyshev points, converted to powers.
    fn fitted(
        elements: usize,
        modes: usize,
        degree: usize,
        sample: &impl Fn(usize, f64) -> Vec<f64>,
    ) -> Self {
        let count = degree + 1;
        let point = |k: usize| ((k as f64 + 0.5) * PI / count as f64).cos();
        let chebyshev = chebyshev_to_powers(degree);
        let groups = modes.div_ceil(LANES);
        let mut coefficients = vec![[0.0; LANES]; elements * groups * count];
        for element in 0..elements {
            let samples: Vec<Vec<f64>> = (0..count).map(|k| sample(element, point(k))).collect();
            for mode in 0..modes {
                for (order, polynomial) in chebyshev.iter().take(count).enumerate() {
                    // discrete cosine transform of the samples
                    let scale = if order == 0 { 1.0 } else { 2.0 } / count as f64;
                    let amplitude: f64 = samples
                        .iter()
                        .enumerate()
                        .map(|(k, values)| {
                            let angle = order as f64 * (k as f64 + 0.5) * PI / count as f64;
                            scale * values[mode] * angle.cos()
                        })
                        .sum();
                    for (power, factor) in polynomial.iter().enumerate() {
                        let group = element * groups + mode / LANES;
                        let place = group * count + degree - power;
                        coefficients[place][mode % LANES] += amplitude * factor;
                    }
                }
            }
        }
        Self {
            elements,
            modes,
            degree,
            width: groups * count,
            coefficients,
        }
    }

    /// Deviation between the points, over all elements, relative to the largest value.
    fn worst_error(&self, sample: &impl Fn(usize, f64) -> Vec<f64>) -> f64 {
        let mut found = column(self.modes, 0.0);
        let (mut worst, mut largest): (f64, f64) = (0.0, f64::MIN_POSITIVE);
        for element in 0..self.elements {
            for xi in [-1.0, -0.61, 0.13, 0.77, 1.0] {
                self.local_values_into(element, xi, &mut found);
                for (value, exact) in found.as_flattened().iter().zip(sample(element, xi)) {
                    worst = worst.max((value - exact).abs());
                    largest = largest.max(exact.abs());
                }
            }
        }
        worst / largest
    }
}

/// Values of polynomials with `N` coefficients at `xi`, and their sum with the amplitudes.
#[inline(always)]
fn horner<const N: usize>(
    block: &[Lanes],
    xi: f64,
    amplitudes: &[Lanes],
    out: &mut [Lanes],
) -> f64 {
    let mut sums = [0.0; LANES];
    let groups = block.as_chunks::<N>().0.iter().zip(amplitudes);
    for (out, (powers, amplitude)) in out.iter_mut().zip(groups) {
        let mut value = powers[0];
        for power in &powers[1..] {
            value = each(|l| value[l] * xi + power[l]);
        }
        *out = value;
        sums = each(|l| sums[l] + value[l] * amplitude[l]);
    }
    total(&sums)
}

/// Power coefficients of the Chebyshev polynomials T_0 .. T_degree.
fn chebyshev_to_powers(degree: usize) -> Vec<Vec<f64>> {
    let mut table = vec![vec![1.0], vec![0.0, 1.0]];
    while table.len() <= degree {
        let (before, last) = (&table[table.len() - 2], &table[table.len() - 1]);
        let mut next = vec![0.0; table.len() + 1];
        for (power, coefficient) in last.iter().enumerate() {
            next[power + 1] += 2.0 * coefficient;
        }
        for (power, coefficient) in before.iter().enumerate() {
            next[power] -= coefficient;
        }
        table.push(next);
    }
    table
}

/// Element that contains a place, 0 <= turn < 1, and the local coordinate there, -1 <= xi <= 1.
#[inline(always)]
pub(super) fn locate(turn: f64, elements: usize) -> (usize, f64) {
    // added to it, a number below 2^51 has its nearest whole one in the lowest bits: fewer instructions than a conversion
    const WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;
    let place = turn * elements as f64;
    let shifted = (place - 0.5) + WHOLE;
    let element = (shifted.to_bits() as u32 as usize).min(elements - 1);
    (element, 2.0 * (place - (shifted - WHOLE)) - 1.0)
}

/// An angle (rad) in turns, reduced to 0 <= turn < 1.
#[inline]
pub(super) fn reduced_turn(angle: f64) -> f64 {
    let turns = angle * (0.5 / PI);
    // truncation to an integer is one instruction everywhere; floor is not
    let whole = turns as i64 as f64;
    let rest = turns - whole;
    let turn = if rest < 0.0 { rest + 1.0 } else { rest };
    if turn < 1.0 { turn } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turns_are_reduced_from_both_sides() {
        for (angle, turn) in [(0.0, 0.0), (PI, 0.5), (-0.5 * PI, 0.75), (7.0 * PI, 0.5)] {
            assert!((reduced_turn(angle) - turn).abs() < 1e-15, "{angle}");
        }
        assert!(reduced_turn(-1e-18) < 1.0);
    }

    /// Five waves round eight elements, more than one group of lanes.
    fn waves() -> RacewayTable {
        let angle = |element: usize, xi: f64| (element as f64 + 0.5 * (xi + 1.0)) * PI / 4.0;
        RacewayTable::fit(8, 5, &|element, xi| {
            let at = angle(element, xi);
            (1..=5).map(|wave| (f64::from(wave) * at).cos()).collect()
        })
    }

    #[test]
    fn rows_slopes_and_sums_are_those_of_the_waves() {
        let table = waves();
        let amplitudes = crate::system::lanes::filled(&[1.0, -2.0, 3.0, 0.5, 4.0], 0.0);
        let (mut row, mut slopes) = (column(5, 0.0), column(5, 0.0));
        for i in 0..1000 {
            let turn = f64::from(i) / 1000.0;
            let sum = table.values_into(turn, &amplitudes, &mut row);
            table.slopes_into(turn, &mut slopes);
            let mut expected = 0.0;
            for (place, wave) in (1..=5).enumerate() {
                let (sin, cos) = (f64::from(wave) * 2.0 * PI * turn).sin_cos();
                let [value, slope] = [&row, &slopes].map(|row| row.as_flattened()[place]);
                // polynomials are good to 1e-12, their slopes to that times degree squared over the element
                assert!((value - cos).abs() < 1e-11, "{wave} {turn}");
                assert!(
                    (slope + f64::from(wave) * sin).abs() < 1e-8,
                    "{wave} {turn}"
                );
                expected += amplitudes.as_flattened()[place] * cos;
            }
            assert!((sum - expected).abs() < 1e-10, "{turn}");
        }
    }

    #[test]
    fn no_value_exceeds_its_bound() {
        let table = waves();
        let bounds = table.bounds();
        let mut row = column(5, 0.0);
        let mut largest = [0.0_f64; 5];
        for i in 0..1000 {
            table.values_into(f64::from(i) / 1000.0, &column(5, 0.0), &mut row);
            for (largest, value) in largest.iter_mut().zip(row.as_flattened()) {
                *largest = largest.max(value.abs());
            }
        }
        for (largest, bound) in largest.iter().zip(bounds.as_flattened()) {
            // the bound adds the magnitudes of a polynomial's terms
            assert!(largest <= bound && *bound < 10.0, "{largest} {bound}");
        }
    }

    #[test]
    fn powers_reproduce_chebyshev_polynomials() {
        let table = chebyshev_to_powers(5);
        for (order, powers) in table.iter().enumerate() {
            let x: f64 = 0.37;
            let value: f64 = powers.iter().rev().fold(0.0, |sum, c| sum * x + c);
            assert!((value - (order as f64 * x.acos()).cos()).abs() < 1e-14);
        }
    }
}
