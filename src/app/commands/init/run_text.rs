//! The window that a case file's run is analysed in.

use super::found::Found;
use super::scene::SPEED_HZ;
use super::seat::Seat;
use crate::bearing::kinematics::BallRow;
use crate::signal::diagnosis::{Fault, FaultOrders};
use serde::Serialize;

/// What settles before the window, s.
const SETTLED_S: f64 = 0.1;
/// Fewest revolutions of the window, half a second.
const FEWEST_TURNS: f64 = 12.5;

/// The window that is analysed.
#[derive(Serialize)]
pub(crate) struct Window {
    from_s: f64,
    end_s: f64,
    /// Its length in turns of the shaft.
    turns: f64,
    /// How many turns tell the lines of the outer race from the shaft's; `None`: no number of them does.
    needed: Option<f64>,
    /// Order of the outer race; `None` where it is not known.
    outer: Option<f64>,
}

impl Window {
    /// Long enough for the lines of every outer race, one of which the draft dents.
    pub(crate) fn of(found: &Found<'_>) -> Self {
        let first = Self::of_seat(&found.seat);
        found
            .further
            .iter()
            .map(Self::of_seat)
            .fold(first, |longest, own| if own.turns > longest.turns { own } else { longest })
    }

    fn of_seat(seat: &Seat) -> Self {
        let bearing = seat.numbers().bearing;
        let row = BallRow::new(bearing.balls, bearing.ball_diameter, bearing.pitch_diameter, 0.0).ok();
        let orders = row.map(|row| row.orders());
        let exact = orders.and_then(|orders| FaultOrders::of(&orders, 0.0).ok());
        let needed = exact.and_then(|exact| exact.turns_to_judge(Fault::OuterRace));
        let turns = needed.filter(|needed| *needed > FEWEST_TURNS).map_or(FEWEST_TURNS, f64::ceil);
        let end_s = SETTLED_S + turns / SPEED_HZ;
        Self {
            from_s: SETTLED_S,
            end_s,
            turns,
            needed: needed.map(f64::ceil),
            outer: orders.map(|orders| orders.outer),
        }
    }
}
