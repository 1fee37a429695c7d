//! The catalogue as a table.

use std::fmt::Write as _;

use super::{CliError, Outcome};
use crate::app::cli::analyze::catalogue_orders;
use crate::app::cli::output::json;
use crate::app::commands::init::{BearingSummary, CatalogueResult};
use crate::app::commands::result::VERSION;
use crate::bearing::catalogue::{CatalogueBearing, Source};

pub(super) fn list() -> Result<Outcome, CliError> {
    let entry = |bearing| BearingSummary::of(bearing, catalogue_orders(bearing).ok());
    Ok(Outcome {
        summary: table(),
        result: json(&CatalogueResult {
            plummer: VERSION,
            command: "init",
            bearings: CatalogueBearing::all().iter().map(entry).collect(),
        })?,
        written: Vec::new(),
        verdict: Ok(()),
    })
}

fn table() -> String {
    let mut text = String::from(
        "deep groove ball bearings, lengths in mm, mass in kg; orders per revolution of the shaft, without contact angle\n\
         name   bore  outer  width  balls  ball diameter  pitch diameter  mass    BPFO   BPFI    BSF    FTF  source",
    );
    for bearing in CatalogueBearing::all() {
        let [bore, outer, width, ball, pitch] =
            [bearing.bore, bearing.outer_diameter, bearing.width, bearing.ball_diameter, bearing.pitch_diameter]
                .map(|length| 1e3 * length);
        let star = if bearing.pitch_published { ' ' } else { '*' };
        let orders = catalogue_orders(bearing)
            .ok()
            .map_or([f64::NAN; 4], |orders| [orders.outer, orders.inner, orders.ball_spin, orders.cage]);
        let orders = orders.map(|order| format!(" {order:>6.4}")).concat();
        // writing to a String cannot fail
        let _ = write!(
            text,
            "\n{:<5} {bore:>5.0} {outer:>6.0} {width:>6.0} {:>6} {ball:>14.3} {pitch:>14.2}{star} {:>6.3}{orders}  {}",
            bearing.name,
            bearing.balls,
            bearing.mass,
            bearing.source.name()
        );
    }
    text.push_str("\n* not published: the mean of bore and outer diameter");
    text.push_str("\nBSF is the spin of a ball: a flaw on it strikes both races, twice a spin, so that --orders takes BSF=s or ball=2s.");
    for source in Source::ALL {
        let _ = write!(text, "\n{}: {}", source.name(), source.citation());
    }
    text.push_str(
        "\nMakers choose the balls themselves: those of another maker's bearing of the same name may differ.",
    );
    text
}
