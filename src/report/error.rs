//! What can be wrong with the contents of a report.

use thiserror::Error;

/// Why a report cannot be made.
#[derive(Debug, Error)]
pub enum ReportError {
    /// A table row with more or fewer cells than the table has columns.
    #[error("table \"{table}\": row {row} has {found} cells, the table has {expected} columns")]
    RowLength {
        /// Caption of the table.
        table: String,
        /// Row, counted from 1.
        row: usize,
        /// Cells found.
        found: usize,
        /// Columns of the table.
        expected: usize,
    },
    /// A cell that points to a footnote that the table lacks.
    #[error(
        "table \"{table}\": row {row} points to footnote {footnote}, the table has {footnotes}"
    )]
    Footnote {
        /// Caption of the table.
        table: String,
        /// Row, counted from 1.
        row: usize,
        /// Footnote asked for, counted from 1.
        footnote: usize,
        /// Footnotes of the table.
        footnotes: usize,
    },
    /// A plot in which nothing can be drawn: no curve has a finite point (positive, on a logarithmic axis) in the
    /// plot's range.
    #[error(
        "plot \"{plot}\" has nothing to draw: no finite point (positive on a logarithmic axis) in its range"
    )]
    EmptyPlot {
        /// Title of the plot.
        plot: String,
    },
    /// A curve with different numbers of abscissas and ordinates.
    #[error(
        "plot \"{plot}\": curve \"{curve}\" has {abscissas} abscissas for {ordinates} ordinates"
    )]
    CurveLength {
        /// Title of the plot.
        plot: String,
        /// Name of the curve.
        curve: String,
        /// Abscissas found.
        abscissas: usize,
        /// Ordinates found.
        ordinates: usize,
    },
    /// An axis range that is reversed, empty, not finite, or not positive on a logarithmic axis.
    #[error("plot \"{plot}\": axis \"{axis}\" cannot show {from} to {to}")]
    Range {
        /// Title of the plot.
        plot: String,
        /// Label of the axis.
        axis: String,
        /// Begin of the range, in the axis' unit.
        from: f64,
        /// End of the range, in the axis' unit.
        to: f64,
    },
    /// A drawing without extent, or with a coordinate that is not finite.
    #[error("drawing \"{drawing}\" has no extent or a coordinate that is not finite")]
    Extent {
        /// Title of the drawing.
        drawing: String,
    },
    /// The plot data could not be written as JSON.
    #[error("plot \"{plot}\": data cannot be embedded: {source}")]
    Embed {
        /// Title of the plot.
        plot: String,
        /// What the library said.
        source: serde_json::Error,
    },
    /// The page template failed.
    #[error("page template failed: {0}")]
    Template(#[from] minijinja::Error),
}
