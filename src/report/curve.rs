//! A curve of a plot as plain data.

use serde::{Deserialize, Serialize};

use super::decimate::Thinner;

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
