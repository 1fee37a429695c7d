//! Plots as plain data: curves on two axes, with vertical lines.

use serde::{Deserialize, Serialize};

use super::decimate::Thinner;
use super::family::Family;
use super::raster::Raster;
use crate::numerics::series::TimeSeries;

/// How values are spread over an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Scale {
    /// Evenly.
    Linear,
    /// By their logarithm; values that are not positive are left out.
    Log,
}

/// One axis of a plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// What it shows ("Frequency").
    pub label: String,
    /// SI unit of the data ("Hz"; "" for none); the plot chooses a prefix.
    pub unit: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// First and last value shown, in `unit`; `None`: what the data need.
    pub range: Option<[f64; 2]>,
}

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

/// A vertical line with a label, such as an expected defect frequency.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Marker {
    /// Where, in the x axis' unit.
    pub at: f64,
    /// What stands above it.
    pub label: String,
    /// Markers of one family share a colour.
    pub family: usize,
}

/// A horizontal line with a label, such as a limit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Level {
    /// Where, in the y axis' unit.
    pub at: f64,
    /// What stands at its left end.
    pub label: String,
}

/// A plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// What to see in it, under the plot.
    pub caption: Option<String>,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Curves, drawn in this order.
    pub curves: Vec<Curve>,
    /// Vertical lines.
    pub markers: Vec<Marker>,
    /// Lines with harmonics that the reader can mark.
    pub families: Vec<Family>,
    /// Horizontal lines; the vertical range reaches them.
    pub levels: Vec<Level>,
    /// Whether it is taller than usual, for clouds of points.
    pub tall: bool,
    /// A picture under the curves; axes without a range show all of it.
    pub raster: Option<Raster>,
}

impl Axis {
    /// A linear axis that shows all data, in an SI unit ("" for none).
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            unit: unit.into(),
            scale: Scale::Linear,
            range: None,
        }
    }

    /// The axis on a logarithmic scale.
    #[must_use]
    pub fn log(mut self) -> Self {
        self.scale = Scale::Log;
        self
    }

    /// A logarithmic axis over so many decades below `largest`, in its unit.
    #[must_use]
    pub fn decades_below(self, largest: f64, decades: f64) -> Self {
        let least = largest * 10_f64.powf(-decades);
        self.log().range(least, largest)
    }

    /// The axis from `from` to `to`, in its unit.
    #[must_use]
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some([from, to]);
        self
    }
}

impl Curve {
    /// A full line through points, in the axes' units.
    pub fn new(name: impl Into<String>, x: Abscissa, y: Vec<f64>) -> Self {
        Self {
            name: name.into(),
            x,
            y,
            style: CurveStyle::Line,
            symbol: Symbol::Dot,
            colour: None,
            labels: Vec::new(),
        }
    }

    /// A sampled signal over time.
    pub fn of_series(name: impl Into<String>, series: &TimeSeries) -> Self {
        let x = Abscissa::Even {
            start: series.start_s(),
            step: series.step_s(),
        };
        Self::new(name, x, series.values().to_vec())
    }

    /// A sampled signal from `start` on every `step`, thinned while it was read.
    pub fn of_thinned(name: impl Into<String>, [start, step]: [f64; 2], signal: Thinner) -> Self {
        let thinned = signal.finish();
        let x = Abscissa::Even {
            start,
            step: step * thinned.stride,
        };
        Self::new(name, x, thinned.values)
    }

    /// A spectrum over its evenly spaced frequencies in Hz.
    pub fn of_spectrum(name: impl Into<String>, frequency_hz: &[f64], amplitude: &[f64]) -> Self {
        let x = match frequency_hz {
            [start, next, ..] => Abscissa::Even {
                start: *start,
                step: next - start,
            },
            _ => Abscissa::Points(frequency_hz.to_vec()),
        };
        Self::new(name, x, amplitude.to_vec())
    }

    /// The curve in another style.
    #[must_use]
    pub fn style(mut self, style: CurveStyle) -> Self {
        self.style = style;
        self
    }

    /// The curve as points with a symbol.
    #[must_use]
    pub fn points(mut self, symbol: Symbol) -> Self {
        self.style = CurveStyle::Points;
        self.symbol = symbol;
        self
    }

    /// The curve in a colour of the palette, counted from 0.
    #[must_use]
    pub fn colour(mut self, colour: usize) -> Self {
        self.colour = Some(colour);
        self
    }

    /// The curve with what each of its points is.
    #[must_use]
    pub fn labels(mut self, labels: Vec<String>) -> Self {
        self.labels = labels;
        self
    }

    /// The part of the curve with abscissas in `from` ..= `to`, such as the low end of a long spectrum: what is not
    /// shown need not be embedded.
    #[must_use]
    pub fn within(mut self, from: f64, to: f64) -> Self {
        let keep: Vec<usize> = (0..self.y.len())
            .filter(|k| (from..=to).contains(&self.x_at(*k)))
            .collect();
        self.y = keep.iter().map(|k| self.y[*k]).collect();
        let labels = keep.iter().map_while(|k| self.labels.get(*k).cloned());
        self.labels = labels.collect();
        self.x = match self.x {
            Abscissa::Even { start, step } => Abscissa::Even {
                start: start + keep.first().map_or(0.0, |k| *k as f64 * step),
                step,
            },
            Abscissa::Points(x) => {
                Abscissa::Points(keep.iter().filter_map(|k| x.get(*k).copied()).collect())
            }
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

impl Marker {
    /// A vertical line at `at`, in the x axis' unit.
    pub fn new(at: f64, label: impl Into<String>) -> Self {
        Self {
            at,
            label: label.into(),
            family: 0,
        }
    }

    /// The line in the colour of a family.
    #[must_use]
    pub fn family(mut self, family: usize) -> Self {
        self.family = family;
        self
    }
}

impl Plot {
    /// A plot without curves.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self {
            title: title.into(),
            caption: None,
            x,
            y,
            curves: Vec::new(),
            markers: Vec::new(),
            families: Vec::new(),
            levels: Vec::new(),
            tall: false,
            raster: None,
        }
    }

    /// The plot with a curve more.
    #[must_use]
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// The plot with a vertical line more.
    #[must_use]
    pub fn marker(mut self, marker: Marker) -> Self {
        self.markers.push(marker);
        self
    }

    /// The plot with a horizontal line more, in the y axis' unit.
    #[must_use]
    pub fn level(mut self, at: f64, label: impl Into<String>) -> Self {
        let label = label.into();
        self.levels.push(Level { at, label });
        self
    }

    /// The plot taller than usual.
    #[must_use]
    pub fn tall(mut self) -> Self {
        self.tall = true;
        self
    }

    /// The plot with a picture under its curves.
    #[must_use]
    pub fn raster(mut self, raster: Raster) -> Self {
        self.raster = Some(raster);
        self
    }

    /// The plot with a caption.
    #[must_use]
    pub fn caption(mut self, text: impl Into<String>) -> Self {
        self.caption = Some(text.into());
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn within_keeps_abscissas_in_place() {
        let y: Vec<f64> = (0..10).map(f64::from).collect();
        let even = Abscissa::Even {
            start: 1.0,
            step: 0.5,
        };
        let cut = Curve::new("c", even, y.clone()).within(2.0, 3.2);
        assert_eq!(cut.y, [2.0, 3.0, 4.0]);
        assert_eq!(
            cut.x,
            Abscissa::Even {
                start: 2.0,
                step: 0.5
            }
        );
        let points = Abscissa::Points((0..10).map(|k| f64::from(k * k)).collect());
        let labels = ["0", "1", "2", "3"].map(str::to_owned).to_vec();
        let cut = Curve::new("c", points, y).labels(labels).within(3.0, 17.0);
        assert_eq!(cut.y, [2.0, 3.0, 4.0]);
        assert_eq!(cut.labels, ["2", "3"]);
        assert_eq!(cut.x, Abscissa::Points(vec![4.0, 9.0, 16.0]));
    }

    #[test]
    fn series_and_spectra_keep_their_axes() {
        let series = TimeSeries::new(2.0, 0.25, "m/s^2", vec![1.0, 2.0]).expect("a valid series");
        let curve = Curve::of_series("P1", &series);
        assert_eq!(
            curve.x,
            Abscissa::Even {
                start: 2.0,
                step: 0.25
            }
        );
        let (frequency_hz, amplitude) = ([0.0, 2.5, 5.0, 7.5], [1.0, 3.0, 2.0, 0.5]);
        let curve = Curve::of_spectrum("P1", &frequency_hz, &amplitude);
        assert!((curve.x_at(3) - frequency_hz[3]).abs() < 1e-15);
        assert_eq!(curve.y, amplitude);
    }
}
