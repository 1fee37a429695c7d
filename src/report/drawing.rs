//! A plane drawing of the model as plain data. Lengths in m, x to the right, y up, angles in rad counted
//! counter-clockwise from x.

use serde::{Deserialize, Serialize};

/// A point in the plane of the bearing.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// To the right, m.
    pub x: f64,
    /// Up, m.
    pub y: f64,
}

/// A circle: a race, a ball, the shaft.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Circle {
    /// Its centre.
    pub centre: Point,
    /// Its radius, m.
    pub radius: f64,
}

/// The finite-element ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ring {
    /// Its centre line.
    pub circle: Circle,
    /// Its nodes.
    pub nodes: Vec<Point>,
}

/// A support spring: from its attachment towards the ground.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spring {
    /// Where it holds the model.
    pub at: Point,
    /// Direction from there to the ground, rad.
    pub towards_rad: f64,
}

/// A dent on a race.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Dent {
    /// The race it lies on.
    pub race: Circle,
    /// Angle of its middle, rad.
    pub angle_rad: f64,
    /// Its length along the race, m; drawn no shorter than can be seen.
    pub length: f64,
    /// What stands beside it.
    pub label: String,
}

/// A sensor: an arrow at its place, a ring and a dot if it measures across the drawing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Sensor {
    /// Its name.
    pub name: String,
    /// Its place.
    pub at: Point,
    /// Direction in which it measures, rad; `None`: across the drawing.
    pub direction_rad: Option<f64>,
}

/// A drawing of the model. Whatever is empty is left out, of the key too.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Drawing {
    /// What it shows.
    pub title: String,
    /// What to see in it, under the drawing.
    pub caption: Option<String>,
    /// Edges of the mesh as lines through points.
    pub mesh_edges: Vec<Vec<Point>>,
    /// The finite-element ring.
    pub ring: Option<Ring>,
    /// Races and shaft: circles without filling.
    pub races: Vec<Circle>,
    /// Balls: filled circles.
    pub balls: Vec<Circle>,
    /// Support springs.
    pub springs: Vec<Spring>,
    /// Dents.
    pub dents: Vec<Dent>,
    /// Sensors.
    pub sensors: Vec<Sensor>,
}

impl Point {
    /// The point at a distance `radius` (m) and angle (rad) from this one.
    pub(crate) fn polar(self, radius: f64, angle_rad: f64) -> Self {
        Self { x: self.x + radius * angle_rad.cos(), y: self.y + radius * angle_rad.sin() }
    }
}
