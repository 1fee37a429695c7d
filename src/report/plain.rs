//! A table as plain text, for a terminal.

use super::Table;
use super::table::Align;

impl Table {
    /// The table in columns of equal width, two spaces apart; caption first, no line end after the last row.
    pub fn plain(&self) -> String {
        let heads = self.columns.iter().map(|column| match &column.unit {
            Some(unit) => format!("{} [{unit}]", column.title),
            None => column.title.clone(),
        });
        let mut lines = vec![heads.collect::<Vec<_>>()];
        let texts = |row: &Vec<super::Cell>| row.iter().map(|cell| cell.text.clone()).collect();
        lines.extend(self.rows.iter().map(texts));
        let widths: Vec<usize> = (0..self.columns.len())
            .map(|place| {
                let width =
                    |line: &Vec<String>| line.get(place).map_or(0, |text| text.chars().count());
                lines.iter().map(width).max().unwrap_or(0)
            })
            .collect();
        let mut text = self.caption.clone();
        for line in &lines {
            let mut cells = String::new();
            for ((cell, width), column) in line.iter().zip(&widths).zip(&self.columns) {
                cells += &match column.align {
                    Align::Left => format!("  {cell:<width$}"),
                    Align::Right => format!("  {cell:>width$}"),
                };
            }
            text.push('\n');
            text += cells.trim_end();
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cell, Column, Table};

    #[test]
    fn columns_are_aligned_and_units_are_in_their_heads() {
        let columns = [Column::text("What"), Column::number("Value", "\u{b5}m")];
        let table = Table::new("Sizes", columns)
            .row([Cell::text("play"), Cell::number(2.5, 3)])
            .row([Cell::text("a longer name"), Cell::text("")]);
        let expected =
            "Sizes\n  What           Value [\u{b5}m]\n  play                 2.50\n  a longer name";
        assert_eq!(table.plain(), expected);
    }
}
