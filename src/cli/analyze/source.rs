//! What is analysed, by which orders and speed.

use std::path::{Path, PathBuf};

use super::{AnalyzeArguments, AnalyzeError};
use crate::bearing::SpeedProfile;
use crate::case::Case;
use crate::catalogue::CatalogueBearing;
use crate::cli::{CliError, Options};
use crate::closed_form::race::{BallRow, DefectOrders, RaceError};
use crate::diagnosis::{Fault, FaultOrders};
use crate::exchange::{MeasuredSignal, SignalRequest, read_signals};
use crate::files;
use crate::series::TimeSeries;
use crate::stages::{
    AnalysisSettings, AskedBand, Kinematics, StageError, bearing_geometry, bearing_setup,
};
use crate::system::BearingSetup;

/// Relative error of the orders of a real bearing: the contact angle under load and the cage's slip.
const GEOMETRY_ERROR: f64 = 0.01;

/// How the machine moves.
enum Motion {
    /// As a case says.
    Simulated {
        setup: Box<BearingSetup>,
        error: f64,
    },
    /// By given orders and speed.
    Given {
        orders: FaultOrders,
        speed: SpeedProfile,
    },
}

/// Signals with all that an analysis needs.
pub(super) struct Source {
    pub(super) signals: Vec<MeasuredSignal>,
    pub(super) settings: AnalysisSettings,
    /// The case that says something of it.
    pub(super) case: Option<PathBuf>,
    /// What is taken for granted, in words.
    pub(super) assumptions: Vec<String>,
    motion: Motion,
}

impl Source {
    pub(super) fn kinematics(&self) -> Kinematics<'_> {
        match &self.motion {
            Motion::Simulated { setup, error } => match Kinematics::of(setup) {
                Kinematics::Cage {
                    cage,
                    balls,
                    rolling,
                    ..
                } => Kinematics::Cage {
                    cage,
                    balls,
                    rolling,
                    error: *error,
                },
                given => given,
            },
            Motion::Given { orders, speed } => Kinematics::Given {
                orders: *orders,
                speed: speed.clone(),
            },
        }
    }

    /// Reads what is asked for.
    ///
    /// # Errors
    /// [`CliError`]: a file that cannot be read, a bearing or a speed that nothing says.
    pub(super) fn open(asked: &AnalyzeArguments, options: &Options) -> Result<Self, CliError> {
        let is_run = asked.input.is_dir();
        let mut request = SignalRequest {
            channels: asked.channel.clone(),
            rate_hz: asked.rate,
        };
        let (file, case) = if is_run {
            let case = case_of_run(&asked.input, options)?;
            if request.channels.is_empty() {
                let sensors = case.sensors.iter();
                request.channels = sensors.map(|sensor| sensor.name.clone()).collect();
            }
            (asked.input.join("signals.npz"), Some(case))
        } else {
            let case = match named_bearing(asked)? {
                Some(Named::Case(path)) => Some(Case::load(path, &options.set)?),
                Some(Named::Catalogue(_)) | None => None,
            };
            (asked.input.clone(), case)
        };
        let (motion, mut assumptions) = motion(asked, is_run, case.as_ref(), options)?;
        let mut signals = read_signals(&file, &request).map_err(StageError::from)?;
        if let Some(case) = case.as_ref().filter(|_| is_run) {
            for signal in &mut signals {
                if case.sensors.iter().any(|sensor| sensor.name == signal.name) {
                    *signal = in_acceleration(signal)?;
                }
            }
        }
        let settings = settings(asked, case.as_ref().filter(|_| is_run));
        assumptions.push(match &motion {
            Motion::Simulated { .. } => {
                "Speed, slip and orders are those of the case, whose cage is prescribed.".to_owned()
            }
            Motion::Given { orders, .. } => format!(
                "Orders are known within {} %, a ball's as well as the geometry gives it then; the cage rolls without slip but for that.",
                100.0 * orders.error(Fault::OuterRace)
            ),
        });
        Ok(Self {
            signals,
            settings,
            case: case.map(|case| case.source.path),
            assumptions,
            motion,
        })
    }
}

/// A sensor of a run, whose file has no units.
fn in_acceleration(signal: &MeasuredSignal) -> Result<MeasuredSignal, StageError> {
    let series = &signal.series;
    let values = series.values().to_vec();
    let series = TimeSeries::new(series.start_s(), series.step_s(), "m/s^2", values)?;
    Ok(MeasuredSignal {
        name: signal.name.clone(),
        series,
        speed_hz: signal.speed_hz,
    })
}

/// The case of a run's folder.
fn case_of_run(folder: &Path, options: &Options) -> Result<Case, CliError> {
    let path = folder.join("run.json");
    if !folder.join("signals.npz").is_file() || !path.is_file() {
        return Err(AnalyzeError::NoRun {
            folder: folder.to_owned(),
        }
        .into());
    }
    let damaged = |found: String| AnalyzeError::Damaged {
        path: path.clone(),
        found,
    };
    let text = files::read_text(&path).map_err(|error| damaged(error.to_string()))?;
    let json: serde_json::Value =
        serde_json::from_str(&text).map_err(|error| damaged(error.to_string()))?;
    let case = json["case"].as_str();
    let case = case.ok_or_else(|| damaged("none".to_owned()))?;
    let set = json["set"].as_array().into_iter().flatten();
    let set = set.filter_map(|set| Some(set.as_str()?.to_owned()));
    let set: Vec<String> = set.chain(options.set.iter().cloned()).collect();
    Ok(Case::load(case, &set)?)
}

/// Orders and speed: what was typed goes before what a case says.
fn motion(
    asked: &AnalyzeArguments,
    is_run: bool,
    case: Option<&Case>,
    options: &Options,
) -> Result<(Motion, Vec<String>), CliError> {
    // a folder's case may be told another bearing
    let (other, catalogue) = match named_bearing(asked)? {
        Some(Named::Catalogue(bearing)) => (None, Some(bearing)),
        Some(Named::Case(path)) if is_run => (Some(Case::load(path, &options.set)?), None),
        _ => (None, None),
    };
    let typed = asked.orders.is_some() || asked.balls.is_some() || catalogue.is_some();
    let bearing = other.as_ref().or(case);
    if let (Some(case), false, None) = (bearing, typed, &asked.speed)
        && case.speed.is_some()
    {
        let setup = bearing_setup(case)?.ok_or_else(|| without_bearing(case))?;
        let exact = if is_run && other.is_none() {
            0.0
        } else {
            GEOMETRY_ERROR
        };
        let error = asked.geometry_error.unwrap_or(exact);
        let setup = Box::new(setup);
        return Ok((Motion::Simulated { setup, error }, Vec::new()));
    }
    let error = asked.geometry_error.unwrap_or(GEOMETRY_ERROR);
    let mut notes = Vec::new();
    let in_row = |row: Result<DefectOrders, RaceError>| {
        row.map_err(|error| CliError::from(StageError::Geometry(error.into())))
    };
    let orders = match (&asked.orders, asked.balls, catalogue, bearing) {
        (Some(given), ..) => FaultOrders::new(given.0, error),
        (None, Some(_), ..) => FaultOrders::of(&in_row(row(asked))?, error),
        (None, None, Some(bearing), _) => {
            notes.push(described(bearing));
            FaultOrders::of(&in_row(catalogue_row(bearing))?, error)
        }
        (None, None, None, Some(case)) => {
            let geometry = bearing_geometry(case)?.ok_or_else(|| without_bearing(case))?;
            FaultOrders::of(&geometry.orders(), error)
        }
        (None, None, None, None) => return Err(AnalyzeError::NoBearing.into()),
    }
    .map_err(StageError::from)?;
    let speed = match (&asked.speed, case) {
        (Some(speed), _) => {
            notes.push("The shaft turns as --speed says.".to_owned());
            speed.profile.clone()
        }
        (None, Some(case)) if case.speed.is_some() => {
            let setup = bearing_setup(case)?.ok_or_else(|| without_bearing(case))?;
            setup.cage.shaft().clone()
        }
        _ => return Err(AnalyzeError::NoSpeed.into()),
    };
    Ok((Motion::Given { orders, speed }, notes))
}

/// What `--bearing` names.
enum Named<'a> {
    Case(&'a Path),
    Catalogue(&'static CatalogueBearing),
}

/// A file goes before a bearing of the catalogue that has its name.
fn named_bearing(asked: &AnalyzeArguments) -> Result<Option<Named<'_>>, AnalyzeError> {
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
    Err(AnalyzeError::UnknownBearing {
        found: name.into_owned(),
    })
}

/// What is taken for granted of a bearing of the catalogue.
fn described(bearing: &CatalogueBearing) -> String {
    format!(
        "Bearing {}: {} balls of {:.3} mm on a circle of {:.2} mm ({}).",
        bearing.name,
        bearing.balls,
        1e3 * bearing.ball_diameter,
        1e3 * bearing.pitch_diameter,
        bearing.source.citation()
    )
}

fn catalogue_row(bearing: &CatalogueBearing) -> Result<DefectOrders, RaceError> {
    let row = BallRow::new(
        bearing.balls,
        bearing.ball_diameter,
        bearing.pitch_diameter,
        0.0,
    )?;
    Ok(row.orders())
}

fn without_bearing(case: &Case) -> AnalyzeError {
    AnalyzeError::CaseWithoutBearing {
        path: case.source.path.clone(),
    }
}

/// Orders of the row of balls that was typed; clap sees to it that all three numbers are there.
fn row(asked: &AnalyzeArguments) -> Result<DefectOrders, RaceError> {
    let row = BallRow::new(
        asked.balls.unwrap_or(0),
        asked.ball_diameter.unwrap_or(f64::NAN),
        asked.pitch_diameter.unwrap_or(f64::NAN),
        asked.contact_angle.to_radians(),
    )?;
    Ok(row.orders())
}

/// Filter and windows: what was typed, else what the run's case says.
fn settings(asked: &AnalyzeArguments, case: Option<&Case>) -> AnalysisSettings {
    let mut settings = case.map(AnalysisSettings::of).unwrap_or_default();
    if !asked.window.is_empty() {
        settings.windows = asked.window.clone();
    }
    let typed = asked.high_pass.map(AskedBand::HighPass);
    let typed = typed.or(asked.band.map(AskedBand::from));
    settings.band = typed.or(settings.band);
    settings.whiten |= asked.whiten;
    settings
}
