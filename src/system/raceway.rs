//! Mode shapes along the raceway, ready for the hot loop: one polynomial an element and a mode.
//!
//! Inside an element the interpolation is smooth; a polynomial through Chebyshev points reproduces
//! it to [`ACCURACY`], and Horner's rule over contiguous modes costs a few additions a mode.

use super::structure::StructureModes;
use crate::model::{Ring, RingRows};
use std::f64::consts::{PI, TAU};

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
    /// [element][power][mode], powers of the local coordinate in [-1, 1], highest first.
    coefficients: Vec<f64>,
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
        let mut table = Self::fitted(ring.nodes(), kept.len(), DEGREES[0], &sample);
        for degree in &DEGREES[1..] {
            if table.worst_error(&sample) <= ACCURACY {
                break;
            }
            table = Self::fitted(ring.nodes(), kept.len(), *degree, &sample);
        }
        table
    }

    /// Values of all modes at an angle, rad, into `out` [modes].
    #[inline]
    pub fn values_into(&self, angle: f64, out: &mut [f64]) {
        let turns = (angle * (1.0 / TAU)).rem_euclid(1.0) * self.elements as f64;
        let element = (turns as usize).min(self.elements - 1);
        let xi = 2.0 * (turns - element as f64) - 1.0;
        self.local_values_into(element, xi, out);
    }

    #[inline]
    fn local_values_into(&self, element: usize, xi: f64, out: &mut [f64]) {
        let width = self.modes * (self.degree + 1);
        let block = &self.coefficients[element * width..(element + 1) * width];
        let mut powers = block.chunks_exact(self.modes.max(1));
        if let Some(highest) = powers.next() {
            out.copy_from_slice(highest);
        }
        for coefficients in powers {
            for (value, coefficient) in out.iter_mut().zip(coefficients) {
                *value = *value * xi + coefficient;
            }
        }
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
        let mut coefficients = vec![0.0; elements * count * modes];
        for element in 0..elements {
            let samples: Vec<Vec<f64>> = (0..count).map(|k| sample(element, point(k))).collect();
            for mode in 0..modes {
                for order in 0..count {
                    // discrete cosine transform of the samples
                    let scale = if order == 0 { 1.0 } else { 2.0 } / count as f64;
                    let amplitude: f64 = (0..count)
                        .map(|k| {
                            let angle = order as f64 * (k as f64 + 0.5) * PI / count as f64;
                            scale * samples[k][mode] * angle.cos()
                        })
                        .sum();
                    for (power, factor) in chebyshev[order].iter().enumerate() {
                        let place = (element * count + degree - power) * modes + mode;
                        coefficients[place] += amplitude * factor;
                    }
                }
            }
        }
        Self {
            elements,
            modes,
            degree,
            coefficients,
        }
    }

    /// Deviation between the points, over all elements, relative to the largest value.
    fn worst_error(&self, sample: &impl Fn(usize, f64) -> Vec<f64>) -> f64 {
        let mut found = vec![0.0; self.modes];
        let (mut worst, mut largest): (f64, f64) = (0.0, f64::MIN_POSITIVE);
        for element in 0..self.elements {
            for xi in [-1.0, -0.61, 0.13, 0.77, 1.0] {
                self.local_values_into(element, xi, &mut found);
                for (value, exact) in found.iter().zip(sample(element, xi)) {
                    worst = worst.max((value - exact).abs());
                    largest = largest.max(exact.abs());
                }
            }
        }
        worst / largest
    }
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
