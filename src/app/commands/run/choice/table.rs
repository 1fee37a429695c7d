//! What was chosen, as a table.

use super::model_choice::ModelChoice;
use crate::report::{Cell, Column, Table, significant};

impl ModelChoice {
    /// The model's parts with reasons and estimated errors.
    pub(crate) fn table(&self) -> Table {
        let mut table = Table::new(
            "The model, and why it is this one",
            [
                Column::text("Part"),
                Column::text("Chosen"),
                Column::text("Why, and what is left out"),
                Column::text("Estimated error"),
            ],
        );
        let error =
            |value: Option<f64>| value.map_or_else(|| "not estimated".to_owned(), |value| significant(value, 2));
        for part in &self.parts {
            table = table.row([
                Cell::text(part.what),
                Cell::text(&part.chosen),
                Cell::text(&part.why),
                Cell::text(error(part.estimated_error)),
            ]);
        }
        table.row([
            Cell::text("together"),
            Cell::text(""),
            Cell::text("root of the sum of squares, relative, in the band, while nearby solutions stay together"),
            Cell::text(error(self.estimated_error)),
        ])
    }
}
