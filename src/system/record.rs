//! Signals of a run: rows, one an instant, by columns.

use std::ops::Range;

/// What the columns of a record are of.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct RecordLayout {
    /// Names of the sensors.
    pub sensors: Vec<String>,
    /// Number of balls, of all bearings one after the other.
    pub balls: usize,
    /// Whether there are the columns of a bearing in space.
    pub in_space: bool,
}

impl RecordLayout {
    /// All columns, in the order in which they are stored.
    pub(crate) fn columns(&self) -> impl Iterator<Item = Column> + use<> {
        let in_space = self.in_space;
        [Column::Time, Column::ShaftX, Column::ShaftY]
            .into_iter()
            .chain((0..self.sensors.len()).map(Column::Sensor))
            .chain([Column::BallRadius, Column::OuterForce, Column::InnerForce])
            .chain(Column::IN_SPACE.into_iter().filter(move |_| in_space))
    }
}

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
    /// Shaft displacement in z, m; this and what follows are empty for a bearing in its plane.
    pub shaft_z: Vec<f64>,
    /// Tilt of the shaft about x, rad.
    pub tilt_x: Vec<f64>,
    /// Tilt of the shaft about y, rad.
    pub tilt_y: Vec<f64>,
    /// Axial places of the balls from the outer groove's centre at rest [instants x balls], m.
    pub ball_axial: Vec<f64>,
    /// Contact angles at the outer race [instants x balls], rad.
    pub outer_angle: Vec<f64>,
    /// Contact angles at the inner race [instants x balls], rad.
    pub inner_angle: Vec<f64>,
    /// Number of balls, of all bearings one after the other.
    pub balls: usize,
    /// Whether it has the columns of a bearing in space.
    pub in_space: bool,
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
    /// Shaft displacement in z, m.
    ShaftZ,
    /// Tilt of the shaft about x, rad.
    TiltX,
    /// Tilt of the shaft about y, rad.
    TiltY,
    /// Axial places of all balls, m.
    BallAxial,
    /// Contact angles of all balls at the outer race, rad.
    OuterAngle,
    /// Contact angles of all balls at the inner race, rad.
    InnerAngle,
}

impl Column {
    /// Those of a bearing in space alone.
    const IN_SPACE: [Self; 6] =
        [Self::ShaftZ, Self::TiltX, Self::TiltY, Self::BallAxial, Self::OuterAngle, Self::InnerAngle];

    /// Numbers a row, with so many balls.
    pub fn width(self, balls: usize) -> usize {
        if self.is_of_balls() { balls } else { 1 }
    }

    /// Whether it has a number a ball.
    pub(crate) fn is_of_balls(self) -> bool {
        use Column::{BallAxial, BallRadius, InnerAngle, InnerForce, OuterAngle, OuterForce};
        matches!(self, BallRadius | OuterForce | InnerForce | BallAxial | OuterAngle | InnerAngle)
    }

    /// Where the numbers of some rows are.
    pub fn places(self, rows: &Range<usize>, balls: usize) -> Range<usize> {
        let width = self.width(balls);
        rows.start * width..rows.end * width
    }
}

impl RunRecord {
    /// A record without rows.
    pub fn blank(layout: RecordLayout) -> Self {
        let RecordLayout { sensors, balls, in_space } = layout;
        let sensors = sensors.into_iter().map(|name| (name, Vec::new())).collect();
        Self { sensors, balls, in_space, ..Self::default() }
    }

    /// What its columns are of.
    pub fn layout(&self) -> RecordLayout {
        RecordLayout {
            sensors: self.sensors.iter().map(|(name, _)| name.clone()).collect(),
            balls: self.balls,
            in_space: self.in_space,
        }
    }

    /// Its columns, in the order in which they are stored.
    pub(super) fn all_columns(&self) -> impl Iterator<Item = Column> + use<> {
        self.layout().columns()
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
            Column::ShaftZ => &self.shaft_z,
            Column::TiltX => &self.tilt_x,
            Column::TiltY => &self.tilt_y,
            Column::BallAxial => &self.ball_axial,
            Column::OuterAngle => &self.outer_angle,
            Column::InnerAngle => &self.inner_angle,
        }
    }

    /// All columns, in the order of [`RecordLayout::columns`].
    pub(super) fn columns_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
        let sensors = self.sensors.iter_mut().map(|(_, values)| values);
        let forces = [&mut self.ball_radius, &mut self.outer_force, &mut self.inner_force];
        let in_space = self.in_space;
        let space = [
            &mut self.shaft_z,
            &mut self.tilt_x,
            &mut self.tilt_y,
            &mut self.ball_axial,
            &mut self.outer_angle,
            &mut self.inner_angle,
        ];
        let plane = [&mut self.time_s, &mut self.shaft_x, &mut self.shaft_y].into_iter().chain(sensors).chain(forces);
        plane.chain(space.into_iter().filter(move |_| in_space))
    }

    /// Appends rows of the same sensors and balls.
    pub fn append(&mut self, rows: &Self) {
        for (column, values) in self.all_columns().zip(self.columns_mut()) {
            values.extend_from_slice(rows.column(column));
        }
    }

    /// Takes the first rows out.
    pub(super) fn take_first(&mut self, rows: usize) -> Self {
        let mut taken = Self::blank(self.layout());
        let ends = self.all_columns().map(|column| rows * column.width(taken.balls)).collect::<Vec<_>>();
        for ((values, to), end) in self.columns_mut().zip(taken.columns_mut()).zip(ends) {
            to.extend(values.drain(..end));
        }
        taken
    }
}
