//! Mode shapes along the raceway, ready for the hot loop: pieces of fifth degree, modes side by side.
//!
//! Values, slopes and curvatures are continuous from piece to piece, a ball stays on one for many steps, and a value costs
//! five products.
//!
//! The table of the pieces, and where places in turns lie in it.
//!
//! Polynomials that reproduce the interpolation inside an element, and the quintics into which they are cut.
//!
//! Inside an element the interpolation is smooth. A polynomial through Chebyshev points reproduces it to [`ACCURACY`]; each
//! element is then cut into so many pieces that quintics with its values, slopes and curvatures at their ends do so too.

use super::structure::StructureModes;
use crate::fe::model::{Ring, RingRows, RingSeat};
use crate::numerics::lanes::{LANES, Lanes, each, fused, together, total};
use std::f64::consts::{PI, TAU};

/// Values of the kept modes along the raceway.
#[derive(Debug, Clone)]
pub(in crate::system) struct RacewayTable {
    /// Pieces all round, as a number that places are multiplied with.
    pieces: f64,
    /// Groups of modes: the length of a row, at least one.
    pub groups: usize,
    /// [piece][group of modes]
    quintics: Vec<Quintic>,
}

impl RacewayTable {
    /// Table of `component(rows) . phi` for the lowest `kept` modes.
    pub(crate) fn new(
        ring: &Ring,
        modes: &StructureModes,
        kept: usize,
        component: impl Fn(&RingRows) -> [f64; 6],
    ) -> Self {
        let sample = |element: usize, xi: f64| -> Vec<f64> {
            let half = PI / ring.nodes() as f64;
            let rows = ring.rows_in_element(element, xi * half);
            let factors = component(&rows);
            let value = |mode: usize| -> f64 { (0..6).map(|k| factors[k] * modes.shapes[(rows.dofs[k], mode)]).sum() };
            (0..kept).map(value).collect()
        };
        Self::fit(ring.nodes(), kept, &sample)
    }

    /// Table of a displacement of a point of the section of a ring in space, `arm` (m) outside its node radius, by the lowest `kept`
    /// modes: the radial (0), the tangential (1) or the axial one (2).
    pub(crate) fn along_groove(
        RingSeat { ring, first, .. }: &RingSeat,
        modes: &StructureModes,
        kept: usize,
        arm: f64,
        component: usize,
    ) -> Self {
        let width = TAU / ring.nodes() as f64;
        let sample = |element: usize, xi: f64| -> Vec<f64> {
            let angle = (element as f64 + 0.5 + 0.5 * xi) * width;
            let Some(rows) = ring.space_rows_at(angle) else {
                return vec![0.0; kept];
            };
            let factors = rows.displacement_at(arm, 0.0)[component];
            let value = |mode: usize| -> f64 {
                rows.dofs.iter().zip(factors).map(|(dof, factor)| factor * modes.shapes[(first + dof, mode)]).sum()
            };
            (0..kept).map(value).collect()
        };
        Self::fit(ring.nodes(), kept, &sample)
    }

    /// Table of the radial interpolation itself: six values over the polar components of an
    /// element's nodes, one element for all.
    pub(crate) fn of_interpolation(ring: &Ring) -> Self {
        let half = PI / ring.nodes() as f64;
        Self::fit(1, 6, &|_, xi| ring.polar_radial_row(xi * half).to_vec())
    }

    /// Reproduces `sample(element, xi)`.
    fn fit(elements: usize, modes: usize, sample: &impl Fn(usize, f64) -> Vec<f64>) -> Self {
        let polynomials = ElementPolynomials::fit(elements, modes, sample);
        let cuts = polynomials.cuts();
        Self { pieces: (elements * cuts) as f64, groups: modes.div_ceil(LANES), quintics: polynomials.cut(cuts) }
    }

    /// Where places in turns, 0 <= turn < 1, lie.
    #[inline(always)]
    pub(crate) fn locate(&self, turns: &Lanes) -> Places {
        let (place, last) = (each(|l| turns[l] * self.pieces), self.pieces - 1.0);
        let whole = each(|l| nearest_whole(place[l] - 0.5));
        // also what is not a number gets a piece, and shows itself in the value
        let piece = each(|l| if whole[l] < last { whole[l] } else { last });
        Places {
            pieces: together(each(|l| piece[l] + WHOLE)),
            xi: together(each(|l| 2.0 * (place[l] - piece[l]) - 1.0)),
        }
    }

    /// Values of all modes at a place into `out` \[groups\]; gives their sum with the `amplitudes` \[groups\].
    #[inline(always)]
    pub(crate) fn values_into<'a>(
        &self,
        at: Place,
        amplitudes: &[Lanes],
        out: impl Iterator<Item = &'a mut Lanes>,
    ) -> f64 {
        let mut sums = [0.0; LANES];
        for ((quintic, amplitude), out) in self.row(at.piece).iter().zip(amplitudes).zip(out) {
            let value = value(quintic, at.xi);
            *out = value;
            sums = each(|l| fused(value[l], amplitude[l], sums[l]));
        }
        total(&sums)
    }

    /// The same, and the rate of that sum at the modes' `velocities` \[groups\] for a place that moves by `speed` turns in a second.
    #[inline(always)]
    pub(crate) fn motion_into<'a>(
        &self,
        at: Place,
        [amplitudes, velocities]: [&[Lanes]; 2],
        speed: f64,
        out: impl Iterator<Item = &'a mut Lanes>,
    ) -> [f64; 2] {
        let (mut sums, mut driven, mut climbed) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
        let modes = amplitudes.iter().zip(velocities);
        for ((quintic, (amplitude, velocity)), out) in self.row(at.piece).iter().zip(modes).zip(out) {
            let [value, slope] = value_and_slope(quintic, at.xi);
            *out = value;
            sums = each(|l| fused(value[l], amplitude[l], sums[l]));
            driven = each(|l| fused(value[l], velocity[l], driven[l]));
            climbed = each(|l| fused(slope[l], amplitude[l], climbed[l]));
        }
        let scale = 2.0 * self.pieces * speed;
        [total(&sums), total(&each(|l| fused(scale, climbed[l], driven[l])))]
    }

    /// Derivatives of all modes at a place, per turn times `scale`, into `out` \[groups\].
    #[inline(always)]
    pub(crate) fn slopes_into(&self, at: Place, scale: f64, out: &mut [Lanes]) {
        let scale = 2.0 * self.pieces * scale;
        for (out, quintic) in out.iter_mut().zip(self.row(at.piece)) {
            let slope = slope(quintic, at.xi);
            *out = each(|l| scale * slope[l]);
        }
    }

    /// A bound of each mode's magnitude along the whole raceway \[groups\].
    pub(crate) fn bounds(&self) -> Vec<Lanes> {
        let mut bounds = vec![[0.0; LANES]; self.groups];
        for row in self.quintics.chunks_exact(self.groups) {
            for (bound, quintic) in bounds.iter_mut().zip(row) {
                // |xi| <= 1
                let most = each(|l| quintic.iter().map(|power| power[l].abs()).sum());
                *bound = each(|l| f64::max(bound[l], most[l]));
            }
        }
        bounds
    }

    #[inline(always)]
    fn row(&self, piece: usize) -> &[Quintic] {
        // ends where the other side of a pairing ends
        &self.quintics[piece * self.groups..]
    }
}

/// Values of quintics side by side at a place, -1 <= x <= 1.
#[inline(always)]
pub(in crate::system) fn value([a, b, c, d, e, f]: &Quintic, x: f64) -> Lanes {
    each(|l| fused(fused(fused(fused(fused(a[l], x, b[l]), x, c[l]), x, d[l]), x, e[l]), x, f[l]))
}

/// These and their derivatives by the place.
#[inline(always)]
pub(in crate::system) fn value_and_slope([first, rest @ ..]: &Quintic, x: f64) -> [Lanes; 2] {
    let (mut value, mut slope) = (*first, [0.0; LANES]);
    for (power, next) in rest.iter().enumerate() {
        slope = if power == 0 { value } else { each(|l| fused(slope[l], x, value[l])) };
        value = each(|l| fused(value[l], x, next[l]));
    }
    [value, slope]
}

/// Their derivatives by the place.
#[inline(always)]
pub(in crate::system) fn slope([a, b, c, d, e, _]: &Quintic, x: f64) -> Lanes {
    each(|l| (((5.0 * a[l] * x + 4.0 * b[l]) * x + 3.0 * c[l]) * x + 2.0 * d[l]) * x + e[l])
}

/// A place on the raceway: piece, and local coordinate there, -1 <= xi <= 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(in crate::system) struct Place {
    pub piece: usize,
    pub xi: f64,
}

/// Places side by side.
#[derive(Debug, Clone, Copy)]
pub(in crate::system) struct Places {
    /// With the piece in the lowest bits.
    pieces: Lanes,
    xi: Lanes,
}

impl Places {
    #[inline(always)]
    pub(crate) fn get(&self, lane: usize) -> Place {
        Place { piece: self.pieces[lane].to_bits() as u32 as usize, xi: self.xi[lane] }
    }
}

/// Added to it, a number below 2^51 has its nearest whole one in the lowest bits: fewer instructions than a conversion.
const WHOLE: f64 = 1.5 * (1_u64 << 52) as f64;

/// The nearest whole number, for magnitudes below 2^51.
#[inline(always)]
pub(in crate::system) fn nearest_whole(x: f64) -> f64 {
    (x + WHOLE) - WHOLE
}

/// The lowest bits of a whole number, for magnitudes below 2^51.
#[inline(always)]
pub(in crate::system) fn lowest_bits(whole: f64) -> u32 {
    (whole + WHOLE).to_bits() as u32
}

/// An angle (rad) in turns, reduced to 0 <= turn < 1; beyond 1e15 rad, where no fraction of a turn is left, 0.
#[inline(always)]
pub(in crate::system) fn reduced_turn(angle: f64) -> f64 {
    let turns = angle * (0.5 / PI);
    let rest = turns - nearest_whole(turns);
    let turn = if rest < 0.0 { rest + 1.0 } else { rest };
    if turn < 1.0 { turn } else { 0.0 }
}

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
        // of a discrete cosine transform [order][point]
        let cosine = |order: usize, k: usize| (order as f64 * (k as f64 + 0.5) * PI / count as f64).cos();
        let cosines: Vec<Vec<f64>> = (0..count).map(|order| (0..count).map(|k| cosine(order, k)).collect()).collect();
        let blank = || vec![vec![[0.0; LANES]; count]; modes.div_ceil(LANES)];
        let mut powers: Vec<_> = (0..elements).map(|_| blank()).collect();
        for (element, groups) in powers.iter_mut().enumerate() {
            let samples: Vec<Vec<f64>> = (0..count).map(|k| sample(element, point(k))).collect();
            for mode in 0..modes {
                for (order, (polynomial, cosines)) in chebyshev.iter().zip(&cosines).enumerate() {
                    let scale = if order == 0 { 1.0 } else { 2.0 } / count as f64;
                    let terms = samples.iter().zip(cosines);
                    let amplitude: f64 = terms.map(|(values, cosine)| scale * values[mode] * cosine).sum();
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
    use crate::numerics::lanes::column;

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
        let amplitudes = crate::numerics::lanes::filled(&[1.0, -2.0, 3.0, 0.5, 4.0], 0.0);
        let (mut row, mut slopes) = (column(5, 0.0), column(5, 0.0));
        for i in 0..1000 {
            let turn = f64::from(i) / 1000.0;
            let at = table.locate(&[turn; LANES]).get(2);
            let sum = table.values_into(at, &amplitudes, row.iter_mut());
            table.slopes_into(at, 0.5 / PI, &mut slopes);
            let mut expected = 0.0;
            for (place, wave) in (1..=5).enumerate() {
                let (sin, cos) = (f64::from(wave) * 2.0 * PI * turn).sin_cos();
                let [value, slope] = [&row, &slopes].map(|row| row.as_flattened()[place]);
                // values are good to 1e-12 of the largest, slopes to that over a piece's length
                assert!((value - cos).abs() < 1e-11, "{wave} {turn}");
                assert!((slope + f64::from(wave) * sin).abs() < 1e-8, "{wave} {turn}");
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
            let at = table.locate(&[f64::from(i) / 1000.0; LANES]).get(0);
            table.values_into(at, &column(5, 0.0), row.iter_mut());
            for (largest, value) in largest.iter_mut().zip(row.as_flattened()) {
                *largest = largest.max(value.abs());
            }
        }
        for (largest, bound) in largest.iter().zip(bounds.as_flattened()) {
            // the bound adds the magnitudes of a polynomial's terms
            assert!(largest <= bound && *bound < 10.0, "{largest} {bound}");
        }
    }
}

#[cfg(test)]
mod polynomials_tests {
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
