//! A curve of a plot as plain data.
//!
//! Thins a curve such that its spikes survive: the lowest and the highest value of each bucket stay.

use serde::{Deserialize, Serialize};

/// Abscissas of a curve, in the x axis' unit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Abscissa {
    /// start + k step; step > 0.
    Even {
        /// First abscissa.
        start: f64,
        /// Distance between two.
        step: f64,
    },
    /// One for each ordinate, in any order.
    Points(Vec<f64>),
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum CurveStyle {
    /// A full line.
    Line,
    /// A dashed line.
    Dashed,
    /// A dot at each point.
    Points,
}

impl CurveStyle {
    /// Its name in the page's style sheet and script.
    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Dashed => "dashed",
            Self::Points => "points",
        }
    }
}

/// What stands at each point of a curve drawn as points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Symbol {
    /// A filled circle.
    #[default]
    Dot,
    /// A filled diamond.
    Diamond,
    /// A filled square.
    Square,
    /// A filled triangle.
    Triangle,
    /// A wide circle around the point, to mark what another curve has there.
    Ring,
    /// A wide square around the point.
    Frame,
}

/// A curve. Ordinates that are not finite are gaps.
#[must_use]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Curve {
    /// Name in the legend; one without a name is not in it.
    pub name: String,
    /// Abscissas.
    pub x: Abscissa,
    /// Ordinates, in the y axis' unit.
    pub y: Vec<f64>,
    /// How it is drawn.
    pub style: CurveStyle,
    /// What stands at its points, if it is drawn as points.
    pub symbol: Symbol,
    /// Its colour, counted from 0; `None`: the next one.
    pub colour: Option<usize>,
    /// What each point is, shown where the reader points at it; points beyond the list have none.
    pub labels: Vec<String>,
}

impl Curve {
    /// A full line through points, in the axes' units.
    pub fn new(name: impl Into<String>, x: Abscissa, y: Vec<f64>) -> Self {
        Self { name: name.into(), x, y, style: CurveStyle::Line, symbol: Symbol::Dot, colour: None, labels: Vec::new() }
    }

    /// A sampled signal from `start` on every `step`, thinned while it was read.
    pub(crate) fn of_thinned(name: impl Into<String>, [start, step]: [f64; 2], signal: Thinner) -> Self {
        let thinned = signal.finish();
        let x = Abscissa::Even { start, step: step * thinned.stride };
        Self::new(name, x, thinned.values)
    }

    /// A spectrum over its evenly spaced frequencies in Hz.
    pub(crate) fn of_spectrum(name: impl Into<String>, frequency_hz: &[f64], amplitude: &[f64]) -> Self {
        let x = match frequency_hz {
            [start, next, ..] => Abscissa::Even { start: *start, step: next - start },
            _ => Abscissa::Points(frequency_hz.to_vec()),
        };
        Self::new(name, x, amplitude.to_vec())
    }

    /// The curve in another style.
    pub fn style(mut self, style: CurveStyle) -> Self {
        self.style = style;
        self
    }

    /// The curve as points with a symbol.
    pub(crate) fn points(mut self, symbol: Symbol) -> Self {
        self.style = CurveStyle::Points;
        self.symbol = symbol;
        self
    }

    /// The curve in a colour of the palette, counted from 0.
    pub(crate) fn colour(mut self, colour: usize) -> Self {
        self.colour = Some(colour);
        self
    }

    /// The curve with what each of its points is.
    pub(crate) fn labels(mut self, labels: Vec<String>) -> Self {
        self.labels = labels;
        self
    }

    /// The part of the curve with abscissas in `from` ..= `to`, such as the low end of a long spectrum: what is not
    /// shown need not be embedded.
    pub(crate) fn within(mut self, from: f64, to: f64) -> Self {
        let keep: Vec<usize> = (0..self.y.len()).filter(|k| (from..=to).contains(&self.x_at(*k))).collect();
        self.y = keep.iter().map(|k| self.y[*k]).collect();
        let labels = keep.iter().map_while(|k| self.labels.get(*k).cloned());
        self.labels = labels.collect();
        self.x = match self.x {
            Abscissa::Even { start, step } => {
                Abscissa::Even { start: start + keep.first().map_or(0.0, |k| *k as f64 * step), step }
            }
            Abscissa::Points(x) => Abscissa::Points(keep.iter().filter_map(|k| x.get(*k).copied()).collect()),
        };
        self
    }

    /// Abscissa of point `index`; NaN where there is none.
    pub(super) fn x_at(&self, index: usize) -> f64 {
        match &self.x {
            Abscissa::Even { start, step } => start + index as f64 * step,
            Abscissa::Points(x) => x.get(index).copied().unwrap_or(f64::NAN),
        }
    }
}

/// Half the size of a filled symbol, and of one that goes around another, pixels.
const FILLED: f64 = 3.5;
const AROUND: f64 = 7.0;

impl Symbol {
    /// Path data around the origin, `l` its half size in pixels; the script of the page puts the same at its points.
    pub(super) fn path(self) -> String {
        let (l, m) = (FILLED, AROUND);
        let wide = 1.25 * l;
        match self {
            Self::Dot => circle(l),
            Self::Diamond => format!("M0 -{wide}L{wide} 0L0 {wide}L-{wide} 0Z"),
            Self::Square => format!("M-{l} -{l}H{l}V{l}H-{l}Z"),
            Self::Triangle => format!("M0 -{wide}L{wide} {l}H-{wide}Z"),
            Self::Ring => circle(m),
            Self::Frame => format!("M-{m} -{m}H{m}V{m}H-{m}Z"),
        }
    }

    /// Whether it goes around a point instead of covering it.
    pub(super) fn is_open(self) -> bool {
        matches!(self, Self::Ring | Self::Frame)
    }
}

fn circle(r: f64) -> String {
    format!("M-{r} 0A{r} {r} 0 1 1 {r} 0A{r} {r} 0 1 1 -{r} 0Z")
}

/// Evenly spaced values thinned to two a bucket.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Thinned {
    /// Values; where thinned, the extremes of each bucket in the order in which they occur.
    pub(super) values: Vec<f64>,
    /// Original samples per value: 1, or half a bucket.
    pub(super) stride: f64,
}

/// Thins evenly spaced `values` to at most `most` (at least 2) as a [`Thinner`] does.
pub(super) fn even(values: &[f64], most: usize) -> Thinned {
    let mut thinner = Thinner::new(values.len(), most);
    thinner.push(values);
    thinner.finish()
}

/// Thins evenly spaced values that come in pieces by keeping the lowest and highest of each bucket, in their order: a signal
/// of any length takes the memory of what is kept. Left alone if there are no more values than may stay. A bucket without a
/// finite value gives two gaps (NaN). Abscissas are then good to a bucket: value k stands for samples near k stride.
#[derive(Debug, Clone)]
pub(crate) struct Thinner {
    /// Values in a bucket; 0: all stay.
    bucket: usize,
    /// Of the bucket under way.
    under_way: Vec<f64>,
    kept: Vec<f64>,
}

impl Thinner {
    /// For so many values, of which at most `most` (at least 2) stay.
    pub(crate) fn new(length: usize, most: usize) -> Self {
        let most = most.max(2);
        let bucket = if length <= most { 0 } else { length.div_ceil(most / 2) };
        Self { bucket, under_way: Vec::with_capacity(bucket), kept: Vec::with_capacity(length.min(most)) }
    }

    /// Takes the next values.
    pub(crate) fn push(&mut self, values: &[f64]) {
        if self.bucket == 0 {
            self.kept.extend_from_slice(values);
            return;
        }
        let mut rest = values;
        while !rest.is_empty() {
            let room = self.bucket - self.under_way.len();
            let (next, later) = rest.split_at(room.min(rest.len()));
            self.under_way.extend_from_slice(next);
            rest = later;
            if self.under_way.len() == self.bucket {
                self.close();
            }
        }
    }

    fn close(&mut self) {
        let bucket = &self.under_way;
        self.kept.extend(match extremes(bucket) {
            Some((first, second)) => [bucket[first], bucket[second]],
            None => [f64::NAN, f64::NAN],
        });
        self.under_way.clear();
    }

    /// What stays.
    pub(super) fn finish(mut self) -> Thinned {
        if !self.under_way.is_empty() {
            self.close();
        }
        Thinned { values: self.kept, stride: if self.bucket == 0 { 1.0 } else { 0.5 * self.bucket as f64 } }
    }
}

/// Indices of the points that stay when `values` are thinned to at most `most`: of each bucket the lowest and the
/// highest. Points keep their own abscissas. All of them if there are no more than that.
pub(super) fn indices(values: &[f64], most: usize) -> Vec<usize> {
    let most = most.max(2);
    if values.len() <= most {
        return (0..values.len()).collect();
    }
    let bucket = values.len().div_ceil(most / 2);
    let mut kept = Vec::with_capacity(most);
    for (k, chunk) in values.chunks(bucket).enumerate() {
        if let Some((first, second)) = extremes(chunk) {
            kept.push(k * bucket + first);
            if second != first {
                kept.push(k * bucket + second);
            }
        }
    }
    kept
}

/// Places of the lowest and the highest finite value, the earlier one first.
fn extremes(chunk: &[f64]) -> Option<(usize, usize)> {
    let mut found: Option<(usize, usize)> = None;
    for (k, value) in chunk.iter().enumerate().filter(|(_, v)| v.is_finite()) {
        let (low, high) = found.get_or_insert((k, k));
        if *value < chunk[*low] {
            *low = k;
        }
        if *value > chunk[*high] {
            *high = k;
        }
    }
    found.map(|(low, high)| (low.min(high), low.max(high)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn within_keeps_abscissas_in_place() {
        let y: Vec<f64> = (0..10).map(f64::from).collect();
        let even = Abscissa::Even { start: 1.0, step: 0.5 };
        let cut = Curve::new("c", even, y.clone()).within(2.0, 3.2);
        assert_eq!(cut.y, [2.0, 3.0, 4.0]);
        assert_eq!(cut.x, Abscissa::Even { start: 2.0, step: 0.5 });
        let points = Abscissa::Points((0..10).map(|k| f64::from(k * k)).collect());
        let labels = ["0", "1", "2", "3"].map(str::to_owned).to_vec();
        let cut = Curve::new("c", points, y).labels(labels).within(3.0, 17.0);
        assert_eq!(cut.y, [2.0, 3.0, 4.0]);
        assert_eq!(cut.labels, ["2", "3"]);
        assert_eq!(cut.x, Abscissa::Points(vec![4.0, 9.0, 16.0]));
    }

    #[test]
    fn spectra_keep_their_axes() {
        let (frequency_hz, amplitude) = ([0.0, 2.5, 5.0, 7.5], [1.0, 3.0, 2.0, 0.5]);
        let curve = Curve::of_spectrum("P1", &frequency_hz, &amplitude);
        assert!((curve.x_at(3) - frequency_hz[3]).abs() < 1e-15);
        assert_eq!(curve.y, amplitude);
    }
}

#[cfg(test)]
mod decimate_tests {
    use super::*;

    #[test]
    fn spikes_survive_in_their_order() {
        let mut values = vec![0.0; 1000];
        values[333] = 9.0;
        values[334] = -7.0;
        values[999] = 4.0;
        let thinned = even(&values, 40);
        assert_eq!(thinned.values.len(), 40);
        let at = thinned.values.iter().position(|v| *v > 8.0).expect("the spike");
        assert!(thinned.values[at + 1] < -6.0);
        assert!((at as f64 * thinned.stride - 333.0).abs() <= 2.0 * thinned.stride);
        assert!(thinned.values.iter().any(|v| (v - 4.0).abs() < 1e-15));
        let kept = indices(&values, 40);
        assert!(kept.len() <= 40);
        assert!([333, 334, 999].iter().all(|k| kept.contains(k)));
        assert!(kept.is_sorted());
    }

    #[test]
    fn pieces_make_no_difference() {
        let values: Vec<f64> = (0..1003).map(|k| f64::from(k * k % 97)).collect();
        for most in [2, 40, 333, 2000] {
            let whole = even(&values, most);
            for piece in [1, 7, 50, 1003] {
                let mut thinner = Thinner::new(values.len(), most);
                values.chunks(piece).for_each(|piece| thinner.push(piece));
                assert_eq!(thinner.finish(), whole, "{most} {piece}");
            }
        }
    }

    #[test]
    fn short_curves_are_left_alone_and_gaps_stay_gaps() {
        let values = [1.0, f64::NAN, 3.0];
        assert!((even(&values, 3).stride - 1.0).abs() < 1e-15);
        assert_eq!(indices(&values, 3), [0, 1, 2]);
        let mut long = vec![1.0; 100];
        long[40..60].fill(f64::NAN);
        let thinned = even(&long, 20);
        assert_eq!(thinned.values.iter().filter(|v| v.is_nan()).count(), 4);
        assert!(indices(&long, 20).iter().all(|k| long[*k].is_finite()));
    }
}
