//! Signals of a run: rows, one an instant, by columns.

use std::ops::Range;

/// Signals of a run on one time grid; row-major tables have one row an instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RunRecord {
    /// Time of each instant, s.
    pub time_s: Vec<f64>,
    /// Shaft displacement in x, m.
    pub shaft_x: Vec<f64>,
    /// Shaft displacement in y, m.
    pub shaft_y: Vec<f64>,
    /// Acceleration of every sensor, m/s^2, band-limited to 0.4 of the output rate.
    pub sensors: Vec<(String, Vec<f64>)>,
    /// Radial positions of the balls [instants x balls], m: from the bearing centre, in `printed`
    /// from the ring's mean centre.
    pub ball_radius: Vec<f64>,
    /// Forces at the outer race [instants x balls], N.
    pub outer_force: Vec<f64>,
    /// Forces at the inner race [instants x balls], N.
    pub inner_force: Vec<f64>,
    /// Number of balls.
    pub balls: usize,
}

/// A column of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Column {
    /// Time, s.
    Time,
    /// Shaft displacement in x, m.
    ShaftX,
    /// Shaft displacement in y, m.
    ShaftY,
    /// Acceleration of a sensor by its number, m/s^2.
    Sensor(usize),
    /// Radial positions of all balls, m.
    BallRadius,
    /// Forces of all balls at the outer race, N.
    OuterForce,
    /// Forces of all balls at the inner race, N.
    InnerForce,
}

impl Column {
    /// All columns of a record with so many sensors, in the order in which they are stored.
    pub fn all(sensors: usize) -> impl Iterator<Item = Self> {
        [Self::Time, Self::ShaftX, Self::ShaftY].into_iter().chain((0..sensors).map(Self::Sensor)).chain([
            Self::BallRadius,
            Self::OuterForce,
            Self::InnerForce,
        ])
    }

    /// Numbers a row, with so many balls.
    pub fn width(self, balls: usize) -> usize {
        match self {
            Self::BallRadius | Self::OuterForce | Self::InnerForce => balls,
            Self::Time | Self::ShaftX | Self::ShaftY | Self::Sensor(_) => 1,
        }
    }

    /// Where the numbers of some rows are.
    pub fn places(self, rows: &Range<usize>, balls: usize) -> Range<usize> {
        let width = self.width(balls);
        rows.start * width..rows.end * width
    }
}

impl RunRecord {
    /// A record without rows.
    pub(crate) fn blank(sensors: impl IntoIterator<Item = String>, balls: usize) -> Self {
        Self { sensors: sensors.into_iter().map(|name| (name, Vec::new())).collect(), balls, ..Self::default() }
    }

    /// Number of rows: instants that are complete.
    pub fn rows(&self) -> usize {
        let sensors = self.sensors.iter().map(|(_, values)| values.len());
        sensors.fold(self.time_s.len(), usize::min)
    }

    /// Numbers of a column, row by row.
    pub fn column(&self, column: Column) -> &[f64] {
        match column {
            Column::Time => &self.time_s,
            Column::ShaftX => &self.shaft_x,
            Column::ShaftY => &self.shaft_y,
            Column::Sensor(sensor) => &self.sensors[sensor].1,
            Column::BallRadius => &self.ball_radius,
            Column::OuterForce => &self.outer_force,
            Column::InnerForce => &self.inner_force,
        }
    }

    /// All columns, in the order of [`Column::all`].
    pub(super) fn columns_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let sensors = self.sensors.iter_mut().map(|(_, values)| values);
        let forces = [&mut self.ball_radius, &mut self.outer_force, &mut self.inner_force];
        [&mut self.time_s, &mut self.shaft_x, &mut self.shaft_y].into_iter().chain(sensors).chain(forces)
    }

    /// Appends rows of the same sensors and balls.
    pub fn append(&mut self, rows: &Self) {
        for (column, values) in Column::all(self.sensors.len()).zip(self.columns_mut()) {
            values.extend_from_slice(rows.column(column));
        }
    }

    /// Takes the first rows out.
    pub(super) fn take_first(&mut self, rows: usize) -> Self {
        let names = self.sensors.iter().map(|(name, _)| name.clone());
        let mut taken = Self::blank(names, self.balls);
        let ends = Column::all(taken.sensors.len()).map(|column| rows * column.width(taken.balls)).collect::<Vec<_>>();
        for ((values, to), end) in self.columns_mut().zip(taken.columns_mut()).zip(ends) {
            to.extend(values.drain(..end));
        }
        taken
    }
}
