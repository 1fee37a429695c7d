//! What can be wrong with the contents of a report.

use thiserror::Error;

/// Why a report cannot be made.
#[derive(Debug, Error)]
pub enum ReportError {
    /// A picture whose values do not fill whole rows.
    #[error("plot \"{plot}\": {values} values do not fill rows of {columns}, which must be at least one")]
    Raster {
        /// Title of the plot.
        plot: String,
        /// Values found.
        values: usize,
        /// Values a row should have.
        columns: usize,
    },
    /// A picture that cannot be made.
    #[error("plot \"{plot}\": its picture cannot be made")]
    Picture {
        /// Title of the plot.
        plot: String,
        /// Why.
        source: png::EncodingError,
    },
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
    #[error("table \"{table}\": row {row} points to footnote {footnote}, the table has {footnotes}")]
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
    #[error("plot \"{plot}\" has nothing to draw: no finite point (positive on a logarithmic axis) in its range")]
    EmptyPlot {
        /// Title of the plot.
        plot: String,
    },
    /// A curve with different numbers of abscissas and ordinates.
    #[error("plot \"{plot}\": curve \"{curve}\" has {abscissas} abscissas for {ordinates} ordinates")]
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
    /// A shape without triangles, or with all points in one place.
    #[error("shape \"{view}\" has no surface with an extent")]
    EmptyShape {
        /// Title of the view.
        view: String,
    },
    /// An index of a shape that points at nothing.
    #[error("shape \"{view}\": {what} is {index}, there are {count}")]
    ShapeIndex {
        /// Title of the view.
        view: String,
        /// Which index.
        what: &'static str,
        /// Index found, from 0.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A mode shape that has not one displacement a point.
    #[error("shape \"{view}\": mode \"{mode}\" has {found} displacements for {expected} points")]
    ShapeLength {
        /// Title of the view.
        view: String,
        /// Label of the mode.
        mode: String,
        /// Displacements found.
        found: usize,
        /// Points of the view.
        expected: usize,
    },
    /// A number of a shape that is not finite or out of its range.
    #[error("shape \"{view}\": {what} is not a number in range")]
    ShapeNumber {
        /// Title of the view.
        view: String,
        /// Which number.
        what: String,
    },
    /// A matrix or a bar chart whose values do not fit its labels.
    #[error("\"{chart}\": row {row} has {found} values for {expected} labels")]
    ChartLength {
        /// Title of the chart.
        chart: String,
        /// Row or series, counted from 1; one past the last where a whole row is missing.
        row: usize,
        /// Values found.
        found: usize,
        /// Labels.
        expected: usize,
    },
    /// A value of a matrix or a bar chart that cannot be shown.
    #[error("\"{chart}\": value {column} of row {row} is {value}")]
    ChartValue {
        /// Title of the chart.
        chart: String,
        /// Row or series, counted from 1.
        row: usize,
        /// Place in it, counted from 1.
        column: usize,
        /// The value.
        value: f64,
    },
    /// The data of a plot or a shape could not be written as JSON.
    #[error("\"{plot}\": data cannot be embedded: {source}")]
    Embed {
        /// Its title.
        plot: String,
        /// What the library said.
        source: serde_json::Error,
    },
    /// The content of a report cannot be put into a file.
    #[error("the report's content cannot be kept: {reason}")]
    Unrecorded {
        /// What the library said.
        reason: String,
    },
    /// A file is not the content of a report, or of one that another version of the program has made.
    #[error("not the content of a report, or not one of this version's: {reason}")]
    Record {
        /// What the library said.
        reason: String,
    },
    /// The page template failed.
    #[error("page template failed: {0}")]
    Template(#[from] minijinja::Error),
}

impl ReportError {
    /// A row of a chart with another number of values than the chart has labels.
    pub(super) fn wrong_length(chart: &str, row: usize, [found, expected]: [usize; 2]) -> Self {
        Self::ChartLength { chart: chart.to_owned(), row, found, expected }
    }

    /// Checks the values of a row of a chart; the first that is not good is the error.
    pub(super) fn check_row(
        chart: &str,
        row: usize,
        values: impl IntoIterator<Item = f64>,
        good: impl Fn(f64) -> bool,
    ) -> Result<(), Self> {
        let bad = (1..).zip(values).find(|(_, value)| !good(*value));
        bad.map_or(Ok(()), |(column, value)| Err(Self::ChartValue { chart: chart.to_owned(), row, column, value }))
    }
}
