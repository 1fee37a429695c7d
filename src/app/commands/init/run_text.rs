//! The window that a case file's run is analysed in.

use super::found::Found;
use super::page::{COMPUTED_DIGITS, number};
use super::scene::SPEED_HZ;
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
    words: String,
}

impl Window {
    /// Long enough for the lines of the outer race, which the draft dents.
    pub(crate) fn of(found: &Found<'_>) -> Self {
        let bearing = found.bearing.map_or(found.ring.of, |numbers| numbers.bearing);
        let of = |turns: f64, words: String| Self { from_s: SETTLED_S, end_s: SETTLED_S + turns / SPEED_HZ, words };
        let row = BallRow::new(bearing.balls, bearing.ball_diameter, bearing.pitch_diameter, 0.0);
        let Ok(orders) = row.map(|row| row.orders()) else {
            return of(FEWEST_TURNS, "guess, s".to_owned());
        };
        let needed = FaultOrders::of(&orders, 0.0).map(|exact| exact.turns_to_judge(Fault::OuterRace));
        let (needed, outer) = (needed.ok().flatten(), number(orders.outer, COMPUTED_DIGITS));
        let turns = needed.map_or(FEWEST_TURNS, f64::ceil);
        match needed {
            Some(needed) if needed <= FEWEST_TURNS => {
                of(FEWEST_TURNS, format!("{FEWEST_TURNS} turns; the lines of the outer race need {turns:.0} at least"))
            }
            Some(_) => of(
                turns,
                format!(
                    "{turns:.0} turns: fewer do not tell the lines of the outer race, {outer} a turn, from the shaft's"
                ),
            ),
            None => of(
                turns,
                format!(
                    "{turns} turns; no window tells the lines of this outer race, {outer} a turn, from the shaft's"
                ),
            ),
        }
    }
}
