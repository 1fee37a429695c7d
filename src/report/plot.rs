//! Plots as plain data: curves on two axes, a picture under them, and lines to read them by.

use serde::{Deserialize, Serialize};

use super::curve::Curve;

/// How values are spread over an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum Scale {
    /// Evenly.
    #[default]
    Linear,
    /// By their logarithm; values that are not positive are left out.
    Log,
}

/// One axis of a plot.
#[must_use]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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

/// A vertical line with a label, such as an expected defect frequency.
#[must_use]
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
#[must_use]
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
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
    pub(crate) raster: Option<Raster>,
}

/// A fundamental whose harmonics k f, k = 1, 2, ..., the reader can mark in the page, read and move together. Drawings and
/// prints without a script do not show it; fixed lines are [`Marker`](super::Marker)s.
#[must_use]
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Family {
    /// What it belongs to ("outer race").
    pub name: String,
    /// The fundamental, in the x axis' unit; one that is not above 0 is left out.
    pub fundamental: f64,
    /// Side lines at k f +- m times a spacing.
    pub sides: Option<Sides>,
    /// Its colour, that of a marker's family.
    pub family: usize,
}

/// Lines beside the harmonics of a family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sides {
    /// Whose spacing it is ("shaft").
    pub name: String,
    /// The spacing, in the x axis' unit, above 0.
    pub spacing: f64,
}

impl Family {
    /// A family with its fundamental in the x axis' unit, in the colour of a marker's family.
    pub fn new(name: impl Into<String>, fundamental: f64, family: usize) -> Self {
        Self { name: name.into(), fundamental, sides: None, family }
    }

    /// The family with side lines, `spacing` in the x axis' unit.
    pub fn sides(mut self, name: impl Into<String>, spacing: f64) -> Self {
        self.sides = Some(Sides { name: name.into(), spacing });
        self
    }
}

pub(super) fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

/// Values on a grid, even on both axes of the plot: on a logarithmic one in the logarithm.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Raster {
    /// Left and right edge of the grid, in the x axis' unit.
    pub x: [f64; 2],
    /// Lower and upper edge, in the y axis' unit.
    pub y: [f64; 2],
    /// Cells in a row.
    pub columns: usize,
    /// \[rows x columns\], from the lowest row on. What is not finite, or not positive on a logarithmic scale of colours, is as the least.
    pub values: Vec<f64>,
    /// What the values are, their unit and scale, and with its `range` what the first and the last colour stand for.
    pub colours: Axis,
}

impl Axis {
    /// A linear axis that shows all data, in an SI unit ("" for none).
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), scale: Scale::Linear, range: None }
    }

    /// The axis on a logarithmic scale.
    pub(crate) fn log(mut self) -> Self {
        self.scale = Scale::Log;
        self
    }

    /// A logarithmic axis over so many decades below `largest`, in its unit.
    pub(crate) fn decades_below(self, largest: f64, decades: f64) -> Self {
        let least = largest * 10_f64.powf(-decades);
        self.log().range(least, largest)
    }

    /// The axis from `from` to `to`, in its unit.
    pub fn range(mut self, from: f64, to: f64) -> Self {
        self.range = Some([from, to]);
        self
    }
}

impl Marker {
    /// A vertical line at `at`, in the x axis' unit.
    pub fn new(at: f64, label: impl Into<String>) -> Self {
        Self { at, label: label.into(), family: 0 }
    }

    /// The line in the colour of a family.
    pub(crate) fn family(mut self, family: usize) -> Self {
        self.family = family;
        self
    }
}

impl Plot {
    /// A plot without curves.
    pub fn new(title: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { title: title.into(), x, y, ..Self::default() }
    }

    /// The plot with a curve more.
    pub fn curve(mut self, curve: Curve) -> Self {
        self.curves.push(curve);
        self
    }

    /// Whether one of its curves has a point that is finite.
    pub(crate) fn has_points(&self) -> bool {
        self.curves.iter().any(|curve| curve.y.iter().any(|y| y.is_finite()))
    }

    /// The plot with a vertical line more.
    pub fn marker(mut self, marker: Marker) -> Self {
        self.markers.push(marker);
        self
    }

    /// The plot with a horizontal line more, in the y axis' unit.
    pub(crate) fn level(mut self, at: f64, label: impl Into<String>) -> Self {
        self.levels.push(Level { at, label: label.into() });
        self
    }

    /// The plot taller than usual.
    pub(crate) fn tall(mut self) -> Self {
        self.tall = true;
        self
    }

    /// The plot with a picture under its curves.
    pub(crate) fn raster(mut self, raster: Raster) -> Self {
        self.raster = Some(raster);
        self
    }

    /// The plot with a caption.
    pub fn caption(mut self, text: impl Into<String>) -> Self {
        self.caption = Some(text.into());
        self
    }

    /// The plot with a family more that the reader can mark.
    pub fn family(mut self, family: Family) -> Self {
        self.families.push(family);
        self
    }
}
