//! The case file's modes, accuracy, time and analysis.

use super::found::Found;
use super::page::{COMPUTED_DIGITS, Page, number};
use super::scene::SPEED_HZ;
use crate::bearing::catalogue::CatalogueBearing;
use crate::bearing::kinematics::BallRow;
use crate::signal::diagnosis::{Fault, FaultOrders};

/// What settles before the window, s.
const SETTLED_S: f64 = 0.1;
/// Fewest revolutions of the window, half a second.
const FEWEST_TURNS: f64 = 12.5;

/// The window that is analysed.
struct Window {
    end_s: f64,
    words: String,
}

impl Window {
    /// Long enough for the lines of the outer race, which the draft dents.
    fn of(bearing: &CatalogueBearing) -> Self {
        let of = |turns: f64, words: String| Self { end_s: SETTLED_S + turns / SPEED_HZ, words };
        let row = BallRow::new(bearing.balls, bearing.ball_diameter, bearing.pitch_diameter, 0.0);
        let Ok(orders) = row.map(|row| row.orders()) else {
            return of(FEWEST_TURNS, "guess, s".to_owned());
        };
        let needed = FaultOrders::of(&orders, 0.0).map(|exact| exact.turns_to_judge(Fault::OuterRace));
        match needed {
            Ok(Some(needed)) if needed <= FEWEST_TURNS => of(
                FEWEST_TURNS,
                format!("{FEWEST_TURNS} turns; the lines of the outer race need {:.0} at least", needed.ceil()),
            ),
            Ok(Some(needed)) => of(
                needed.ceil(),
                format!(
                    "{:.0} turns: fewer do not tell the lines of the outer race, {} a turn, from the shaft's",
                    needed.ceil(),
                    number(orders.outer, COMPUTED_DIGITS)
                ),
            ),
            _ => of(
                FEWEST_TURNS,
                format!(
                    "{FEWEST_TURNS} turns; no window tells the lines of this outer race, {} a turn, from the shaft's",
                    number(orders.outer, COMPUTED_DIGITS)
                ),
            ),
        }
    }
}

pub(crate) fn run(page: &mut Page, found: &Found<'_>) {
    let bearing = found.bearing.map_or(found.ring.of, |numbers| numbers.bearing);
    let window = Window::of(bearing);
    page.table("[modes]");
    page.value_from("count", "12", "the lowest so many");
    page.note("with the bearing's contacts at rest under the shaft's weight (needs [bearing] and a support):");
    page.line("#linearise = \"static\"");
    page.table("[accuracy]");
    page.value_from("band_hz", "[0, 20000]", "guess: frequencies that the signals are to be good for");
    page.value_from("target", "0.01", "usual: relative error");
    page.table("[transient]");
    page.value_from("start", "0", "s, in equilibrium at that time's speed");
    page.value_from(
        "end",
        number(window.end_s, COMPUTED_DIGITS),
        &format!("guess, s: {} turns, of which the first settle", number(SPEED_HZ * window.end_s, 3)),
    );
    page.value_from("method", "\"auto\"", "the program's choice; plummer run --explain says which");
    page.value_from("output_hz", "51200", "usual for recorders; more than twice the band");
    page.table("[analysis]");
    page.value_from("high_pass_hz", "3000", "guess: above it the housing rings, below it the shaft turns");
    page.value_from(
        "envelope",
        format!("[{{ from = {SETTLED_S}, to = {} }}]", number(window.end_s, COMPUTED_DIGITS)),
        &window.words,
    );
}
