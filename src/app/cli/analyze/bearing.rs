//! Which bearing it is: how often its parts strike.

use std::path::Path;

use super::AnalyzeArguments;
use crate::app::case::Case;
use crate::app::cli::CliError;
use crate::app::error::ComputeError;
use crate::app::scene::bearing_geometry;
use crate::bearing::BearingError;
use crate::bearing::catalogue::CatalogueBearing;
use crate::bearing::kinematics::{BallRow, DefectOrders};
use crate::signal::diagnosis::FaultOrders;

/// What `--bearing` names.
pub(super) enum Named<'a> {
    Case(&'a Path),
    Catalogue(&'static CatalogueBearing),
}

/// A file goes before a bearing of the catalogue that has its name.
pub(super) fn named_bearing(asked: &AnalyzeArguments) -> Result<Option<Named<'_>>, CliError> {
    let Some(path) = asked.bearing.as_deref() else {
        return Ok(None);
    };
    if path.exists() {
        return Ok(Some(Named::Case(path)));
    }
    let name = path.to_string_lossy();
    if let Some(bearing) = CatalogueBearing::named(&name) {
        return Ok(Some(Named::Catalogue(bearing)));
    }
    // what looks like a file is one that is missing, which its reader says
    if path.extension().is_some() || path.components().count() > 1 {
        return Ok(Some(Named::Case(path)));
    }
    Err(CliError::input(format!("--bearing: found \"{name}\", expected a case file or a bearing of the catalogue"))
        .with_help(format!("bearings: {}", bearing_names())))
}

/// Orders with their relative error: what was typed goes before what a case says. `None` where nothing says them.
pub(super) fn orders(
    asked: &AnalyzeArguments,
    catalogue: Option<&CatalogueBearing>,
    case: Option<&Case>,
    error: f64,
) -> Result<Option<FaultOrders>, CliError> {
    let in_row = |row: Result<DefectOrders, BearingError>| row.map_err(ComputeError::bearing("bearing: "));
    let row: DefectOrders = match (&asked.orders, asked.balls, catalogue, case) {
        (Some(given), ..) => return Ok(Some(FaultOrders::new(given.0, error).map_err(ComputeError::from)?)),
        // clap sees to it that all three numbers are there
        (None, Some(balls), ..) => {
            let [ball, pitch] = [asked.ball_diameter, asked.pitch_diameter].map(|given| given.unwrap_or(f64::NAN));
            in_row(BallRow::new(balls, ball, pitch, asked.contact_angle.to_radians()).map(|row| row.orders()))?
        }
        (None, None, Some(bearing), _) => in_row(catalogue_orders(bearing))?,
        (None, None, None, Some(case)) => {
            let geometry = bearing_geometry(case)?;
            geometry.ok_or_else(|| without_bearing(case))?.orders()
        }
        (None, None, None, None) => return Ok(None),
    };
    Ok(Some(FaultOrders::of(&row, error).map_err(ComputeError::from)?))
}

/// Every designation of the catalogue.
pub(in crate::app::cli) fn bearing_names() -> String {
    let names = CatalogueBearing::all().iter().map(|bearing| bearing.name);
    names.collect::<Vec<_>>().join(", ")
}

/// Orders of a bearing of the catalogue, without a contact angle.
pub(in crate::app::cli) fn catalogue_orders(bearing: &CatalogueBearing) -> Result<DefectOrders, BearingError> {
    Ok(BallRow::new(bearing.balls, bearing.ball_diameter, bearing.pitch_diameter, 0.0)?.orders())
}

/// What is taken for granted of a bearing of the catalogue.
pub(super) fn described(bearing: &CatalogueBearing) -> String {
    format!(
        "Bearing {}: {} balls of {:.3} mm on a circle of {:.2} mm ({}).",
        bearing.name,
        bearing.balls,
        1e3 * bearing.ball_diameter,
        1e3 * bearing.pitch_diameter,
        bearing.source.citation()
    )
}

pub(super) fn without_bearing(case: &Case) -> CliError {
    CliError::input(format!("{}: expected a case with [bearing], found none", case.source.path.display()))
}
