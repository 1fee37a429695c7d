//! Polynomials that reproduce the interpolation inside an element, and the quintics into which they are cut.
//!
//! Inside an element the interpolation is smooth. A polynomial through Chebyshev points reproduces it to [`ACCURACY`]; each
//! element is then cut into so many pieces that quintics with its values, slopes and curvatures at their ends do so too.

use crate::numerics::lanes::{LANES, Lanes, each};
use std::f64::consts::PI;

/// Coefficients of a polynomial in its local coordinate in [-1, 1], highest power first.
pub(in crate::system) type Quintic = [Lanes; 6];

/// Largest deviation from the interpolation, relative to the largest value of all modes.
const ACCURACY: f64 = 1e-12;

/// Degrees of an element's polynomial that are tried, in order.
const DEGREES: [usize; 6] = [3, 5, 7, 9, 13, 17];

/// Pieces of an element at most: enough for five waves over eight elements.
const MOST_CUTS: usize = 64;

/// One polynomial an element and a mode.
pub(super) struct ElementPolynomials {
    elements: usize,
    modes: usize,
    /// [element][group of modes][power], powers of the local coordinate in [-1, 1], highest first.
    powers: Vec<Vec<Vec<Lanes>>>,
}

impl ElementPolynomials {
    /// Raises the degree until the polynomials reproduce `sample(element, xi)`.
    pub(super) fn fit(elements: usize, modes: usize, sample: &impl Fn(usize, f64) -> Vec<f64>) -> Self {
        let mut fitted = Self::of_degree(elements, modes, DEGREES[0], sample);
        for degree in &DEGREES[1..] {
            if fitted.deviation(sample) <= ACCURACY {
                break;
            }
            fitted = Self::of_degree(elements, modes, *degree, sample);
        }
        fitted
    }

    /// Interpolation at the Chebyshev points, converted to powers.
    fn of_degree(elements: usize, modes: usize, degree: usize, sample: &impl Fn(usize, f64) -> Vec<f64>) -> Self {
        let count = degree + 1;
        let point = |k: usize| ((k as f64 + 0.5) * PI / count as f64).cos();
        let chebyshev = chebyshev_to_powers(degree);
        let blank = || vec![vec![[0.0; LANES]; count]; modes.div_ceil(LANES)];
        let mut powers: Vec<_> = (0..elements).map(|_| blank()).collect();
        for (element, groups) in powers.iter_mut().enumerate() {
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
                        groups[mode / LANES][degree - power][mode % LANES] += amplitude * factor;
                    }
                }
            }
        }
        Self { elements, modes, powers }
    }

    /// Value and first two derivatives of a group of modes by the local coordinate of an element.
    fn at(&self, element: usize, group: usize, xi: f64) -> [Lanes; 3] {
        let powers = &self.powers[element][group];
        let (mut value, mut slope, mut half_bend) = (powers[0], [0.0; LANES], [0.0; LANES]);
        for power in &powers[1..] {
            half_bend = each(|l| half_bend[l] * xi + slope[l]);
            slope = each(|l| slope[l] * xi + value[l]);
            value = each(|l| value[l] * xi + power[l]);
        }
        [value, slope, half_bend.map(|half| 2.0 * half)]
    }

    /// The quintic with the values, slopes and curvatures at the ends of piece `cut` of `cuts`: even and odd powers apart,
    /// each from their value and derivatives at 1.
    fn quintic(&self, element: usize, group: usize, cut: usize, cuts: usize) -> Quintic {
        let end = |k: usize| 2.0 * k as f64 / cuts as f64 - 1.0;
        let [first, last] = [cut, cut + 1].map(|k| self.at(element, group, end(k)));
        let scale = 1.0 / cuts as f64;
        let mean = |k: usize, l: usize| 0.5 * (last[k][l] + first[k][l]) * scale.powi(k as i32);
        let half = |k: usize, l: usize| 0.5 * (last[k][l] - first[k][l]) * scale.powi(k as i32);
        let fifth = each(|l| 0.125 * (half(2, l) - 3.0 * (mean(1, l) - half(0, l))));
        let fourth = each(|l| 0.125 * (mean(2, l) - half(1, l)));
        let third = each(|l| 0.5 * (mean(1, l) - half(0, l)) - 2.0 * fifth[l]);
        let second = each(|l| 0.5 * half(1, l) - 2.0 * fourth[l]);
        [
            fifth,
            fourth,
            third,
            second,
            each(|l| half(0, l) - third[l] - fifth[l]),
            each(|l| mean(0, l) - second[l] - fourth[l]),
        ]
    }

    /// Largest deviation of the quintics, in the middle of pieces, relative to the largest value there.
    fn deviation_of_quintics(&self, cuts: usize) -> f64 {
        let mut pairs = Vec::new();
        for element in 0..self.elements {
            for group in 0..self.modes.div_ceil(LANES) {
                for cut in 0..cuts {
                    let middle = (2 * cut + 1) as f64 / cuts as f64 - 1.0;
                    let [exact, ..] = self.at(element, group, middle);
                    let [.., found] = self.quintic(element, group, cut, cuts);
                    pairs.extend(found.into_iter().zip(exact));
                }
            }
        }
        relative_deviation(&pairs)
    }

    /// Deviation between the points, over all elements, relative to the largest value.
    fn deviation(&self, sample: &impl Fn(usize, f64) -> Vec<f64>) -> f64 {
        let mut pairs = Vec::new();
        for element in 0..self.elements {
            for xi in [-1.0, -0.61, 0.13, 0.77, 1.0] {
                for (mode, exact) in sample(element, xi).into_iter().enumerate() {
                    let [found, ..] = self.at(element, mode / LANES, xi);
                    pairs.push((found[mode % LANES], exact));
                }
            }
        }
        relative_deviation(&pairs)
    }

    /// Into how many pieces elements must be cut for quintics to reproduce them.
    pub(super) fn cuts(&self) -> usize {
        let mut cuts = 1;
        while cuts < MOST_CUTS && self.deviation_of_quintics(cuts) > ACCURACY {
            cuts *= 2;
        }
        cuts
    }

    /// The quintics with each element in so many pieces [piece][group of modes].
    pub(super) fn cut(&self, cuts: usize) -> Vec<Quintic> {
        let groups = self.modes.div_ceil(LANES);
        let mut quintics = Vec::with_capacity(self.elements * cuts * groups);
        for element in 0..self.elements {
            for cut in 0..cuts {
                quintics.extend((0..groups).map(|group| self.quintic(element, group, cut, cuts)));
            }
        }
        quintics
    }
}

/// Largest deviation of values found from exact ones, relative to the largest of these.
fn relative_deviation(pairs: &[(f64, f64)]) -> f64 {
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, value| most.max(value.abs()));
    let worst = most(&mut pairs.iter().map(|(found, exact)| found - exact));
    worst / most(&mut pairs.iter().map(|(_, exact)| *exact)).max(f64::MIN_POSITIVE)
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

#[cfg(test)]
mod tests {
    use super::*;

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
