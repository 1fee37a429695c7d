//! The report: one HTML file that opens without a network, for an engineer to hand on.
//!
//! The caller fills plain data ([`Report`] of [`Section`]s of paragraphs, [`Fact`]s, [`Table`]s, [`Plot`]s,
//! [`Drawing`]s, [`Bars`], [`Spans`], [`Matrix`], [`StepMap`] and [`ModeShapeView`]s); [`Report::to_html`] checks it at one door and gives the
//! file as a string. Plots are drawn as SVG, so that they print and show without scripts, and carry their data (thinned
//! such that spikes survive) for a small script to zoom in and to put cursors on, harmonic ones too ([`Family`]). Mode shapes are still pictures in print and without WebGL;
//! in a browser one turns and animates them. Every table offers itself as CSV. All text is escaped. A report's content is kept
//! as a file too ([`Report::to_record`]), so that a later version can draw it again.
//!
//! Read [`Report`] first, which shows how a page is put together.
//!
//! **Limitations**: plots have one x axis and one y axis; drawings are plane; mode shapes are real.

mod bars;
mod blocks;
mod content;
mod csv;
mod curve;
mod embed;
mod error;
mod html;
mod layout;
mod matrix;
mod number;
mod plot;
mod shapes;
mod spans;
mod standalone;
mod step_map;
mod svg;
mod svg_drawing;
mod svg_plot;
mod table;
mod ticks;
mod words;

pub use bars::{BarSeries, Bars};
pub(in crate::report) use content::TableFiles;
pub use content::{Block, Document, Fact, Headline, MeshFile, Report, Section};
pub(crate) use curve::Thinner;
pub use curve::{Abscissa, Curve, CurveStyle, Symbol};
pub(crate) use embed::SIGNAL_POINTS;
pub use error::ReportError;
pub use matrix::Matrix;
pub(crate) use number::{display_unit, duration, given, pretty_unit, quantity, signed, signed_fixed, trimmed};
pub use number::{fixed, shaft_speed, significant};
pub(in crate::report) use number::{raised_powers, with_unit};
pub(crate) use plot::Raster;
pub use plot::{Axis, Family, Level, Marker, Plot, Scale, Sides};
pub use shapes::{ModeShapeView, ShapeFigures, ShapeGroup, ShapeLine, ShapeMode, ShapeTriangle, UpAxis};
pub use spans::{SpanPoint, SpanRow, Spans};
pub use step_map::{StepMap, StepPanel, StepState};
pub use svg_drawing::{Circle, Dent, Drawing, Point, Ring, Sensor, Spring};
pub use table::{Align, Cell, CellLook, Column, Table, Verdict};
pub(crate) use words::{counted, mass_in_words, size_in_words, wrapped};
