//! The report: one HTML file that opens without a network, for an engineer to hand on.
//!
//! The caller fills plain data ([`Report`] of [`Section`]s of paragraphs, [`Fact`]s, [`Table`]s, [`Plot`]s and
//! [`Drawing`]s); [`Report::to_html`] checks it at one door and gives the file as a string. Plots are drawn as SVG, so
//! that they print and show without scripts, and carry their data (thinned such that spikes survive) for a small script
//! to zoom in. All text is escaped.
//!
//! **Limitations**: plots have one x axis and one y axis; drawings are plane.

mod content;
mod decimate;
mod drawing;
mod embed;
mod error;
mod html;
mod layout;
mod number;
mod plot;
mod svg;
mod svg_drawing;
mod svg_plot;
mod table;
mod ticks;

pub use content::{Block, Fact, Headline, Report, Section, Verdict};
pub use drawing::{Circle, Dent, Drawing, Point, Ring, Sensor, Spring};
pub use error::ReportError;
pub use number::{pretty_unit, significant};
pub use plot::{Abscissa, Axis, Curve, CurveStyle, Marker, Plot, Scale};
pub use table::{Align, Cell, Column, Table};
