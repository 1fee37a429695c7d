//! The tables of a sweep's page: narrow ones, one a window or part of the model, in units that a reader takes in.

use super::SweepResult;
use super::outputs::MODEL;
use super::result::{NamedColumn, Values};
use crate::report::{Cell, Column, Table, display_unit, trimmed};

/// Most figures in a table: more do not fit a page beside what was varied.
const MOST_FIGURES: usize = 9;
/// Digits of a figure.
const DIGITS: usize = 4;
/// Most digits of what was typed.
const TYPED_DIGITS: usize = 7;

impl SweepResult {
    /// The tables, each with what was varied before its figures.
    pub(crate) fn tables(&self) -> Vec<Table> {
        let figures = self.figures();
        let mut titles: Vec<&String> = Vec::new();
        for title in figures.iter().filter_map(|column| column.table.as_ref()) {
            if !titles.contains(&title) {
                titles.push(title);
            }
        }
        let of_title = |title: &String| {
            let of_title: Vec<&NamedColumn> =
                figures.iter().filter(|column| column.table.as_ref() == Some(title)).collect();
            let parts = of_title.chunks(MOST_FIGURES).enumerate();
            let table = |(place, columns): (usize, &[&NamedColumn])| {
                let title = if place == 0 { title.clone() } else { format!("{title}, continued") };
                self.table_of(&title, columns)
            };
            parts.map(table).collect::<Vec<_>>()
        };
        titles.into_iter().flat_map(of_title).collect()
    }

    /// The first table of what was computed, not of the model.
    pub(crate) fn results_table(&self) -> Option<Table> {
        self.tables().into_iter().find(|table| table.caption != MODEL)
    }

    fn table_of(&self, title: &str, figures: &[&NamedColumn]) -> Table {
        let (mut axes, states) = (self.axes(), self.states());
        let names: Vec<String> = axes.iter().map(|axis| short_name(&axis.label).to_owned()).collect();
        for (axis, name) in axes.iter_mut().zip(&names) {
            if names.iter().filter(|other| *other == name).count() == 1 {
                axis.label.clone_from(name);
            }
        }
        let all_done = self.not_done().next().is_none();
        let states = Some(&states).filter(|_| !all_done);
        let columns: Vec<&NamedColumn> = axes.iter().chain(states).chain(figures.iter().copied()).collect();
        let shown: Vec<Shown> =
            columns.iter().enumerate().map(|(k, column)| Shown::of(column, k < axes.len())).collect();
        let heads = shown.iter().map(|shown| shown.head.clone());
        let heads = std::iter::once(Column::number("point", "")).chain(heads);
        Table::new(title, heads).rows(self.points.iter().enumerate().map(|(row, point)| {
            let number = point.point.number;
            let cells = shown.iter().map(move |shown| shown.cells[row].clone());
            std::iter::once(Cell::text(number.to_string()).value(number as f64)).chain(cells)
        }))
    }
}

/// What a key is without what it is of.
pub(super) fn short_name(words: &str) -> &str {
    words.split_once(" of the ").map_or(words, |(name, _)| name)
}

/// A column in the unit in which it is shown.
struct Shown {
    head: Column,
    cells: Vec<Cell>,
}

impl Shown {
    /// With digits as they were typed, or a few of them.
    fn of(column: &NamedColumn, typed: bool) -> Self {
        let numbers = match &column.values {
            Values::Numbers(numbers) => numbers,
            Values::Texts(texts) => {
                let head = Column::text(column.label.clone());
                return Self { head, cells: texts.iter().map(Cell::text).collect() };
            }
        };
        let scaled = Scaled::of(column.unit, numbers);
        // counts
        let whole = numbers.iter().all(|number| number.is_nan() || number.fract().abs() < f64::MIN_POSITIVE);
        let cell = |&value: &f64| {
            let value = Some(value / scaled.factor).filter(|value| value.is_finite());
            match value {
                Some(value) if typed || whole => Cell::text(trimmed(value, TYPED_DIGITS)).value(value),
                value => Cell::number_or(value, DIGITS, "–"),
            }
        };
        Self { head: Column::number(column.label.clone(), &scaled.unit), cells: numbers.iter().map(cell).collect() }
    }
}

/// The unit in which numbers are shown, and what they are divided by.
pub(super) struct Scaled {
    pub(super) factor: f64,
    /// As it is printed; "" for none.
    pub(super) unit: String,
}

impl Scaled {
    /// With the prefix that suits the largest; frequencies and times stay as they are, so that tables can be compared.
    pub(super) fn of(unit: &str, numbers: &[f64]) -> Self {
        if matches!(unit, "Hz" | "s" | "") {
            return Self { factor: 1.0, unit: unit.to_owned() };
        }
        let largest = numbers.iter().filter(|number| number.is_finite()).fold(0.0_f64, |most, x| most.max(x.abs()));
        let shown = display_unit(unit, largest);
        Self { factor: shown.factor, unit: shown.text }
    }

    /// A number with its unit, as short as it was typed.
    pub(super) fn words(&self, value: f64) -> String {
        let number = trimmed(value / self.factor, TYPED_DIGITS);
        match self.unit.as_str() {
            "" => number,
            "°" => format!("{number}°"),
            unit => format!("{number} {unit}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::result::tests::four;
    use super::{Scaled, short_name};

    #[test]
    fn tables_are_narrow_and_in_units_of_what_they_show() {
        let tables = four().tables();
        let titles: Vec<&str> = tables.iter().map(|table| table.caption.as_str()).collect();
        assert_eq!(titles, ["Model", "Eigenfrequencies"]);
        let heads: Vec<&str> = tables[1].columns.iter().map(|column| column.title.as_str()).collect();
        assert_eq!(heads, ["point", "number of nodes", "element", "state", "mode 1", "mode 2", "mode 3"]);
        assert_eq!(tables[1].rows[1][4].text, "8100");
        assert_eq!(tables[1].rows[2][4].text, "–");
    }

    #[test]
    fn values_are_as_short_as_they_were_typed() {
        let metres = Scaled::of("m", &[1e-6, 2.5e-6, 4e-6]);
        assert_eq!([metres.words(2.5e-6), metres.words(4e-6)], ["2.5 µm", "4 µm"]);
        assert_eq!(Scaled::of("°", &[270.0]).words(270.0), "270°");
        assert_eq!(Scaled::of("", &[1e5]).words(-0.1 - 0.2), "−0.3");
        assert_eq!(Scaled::of("Hz", &[12e3]).words(12e3), "12\u{202f}000 Hz");
        assert_eq!(Scaled::of("m^4", &[9e-12]).words(9e-12), "9 mm⁴");
    }

    #[test]
    fn names_of_keys_are_short() {
        assert_eq!(short_name("second moment of area of the first section of the ring"), "second moment of area");
        assert_eq!(short_name("title"), "title");
    }
}
