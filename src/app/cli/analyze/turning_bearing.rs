//! The bearing whose signals are analysed, and the speed of its shaft.
//!
//! Which bearing it is: how often its parts strike.

use super::{AnalyzeArguments, GivenSpeed};
use crate::app::case::{Case, bearing_help};
use crate::app::cli::{CliError, Options};
use crate::app::commands::analyze::DamageShown;
use crate::app::commands::run::alike;
use crate::app::error::ComputeError;
use crate::app::scene::{bearing_geometry, bearing_setup};
use crate::bearing::catalogue::CatalogueBearing;
use crate::bearing::kinematics::{BallRow, DefectOrders};
use crate::bearing::{BearingError, SpeedProfile};
use crate::formats::MeasuredSignal;
use crate::report::{shaft_speed, significant};
use crate::signal::diagnosis::{Fault, FaultOrders, Kinematics};
use crate::system::BearingSetup;
use std::path::Path;

/// Relative error of the orders of a real bearing: the contact angle under load and the cage's slip.
const GEOMETRY_ERROR: f64 = 0.01;
/// Rates and speeds that differ by less, relative, are the same: nominal speeds are rounded.
const SAME: f64 = 0.01;

/// A bearing and what is said of its shaft's speed.
pub(super) struct TurningBearing {
    /// `None` where nothing says the bearing.
    pub(super) orders: Option<FaultOrders>,
    /// The bearing of a case that says its motion too, and the relative error of its orders.
    setup: Option<(Box<BearingSetup>, f64)>,
    typed: Option<GivenSpeed>,
    of_case: Option<SpeedProfile>,
    pub(super) catalogue: Option<String>,
    /// Whether what a file states of its speed goes before what was typed.
    pub(super) own_first: bool,
    /// The bearing of a run in space that is asked for: its label, and what its damage adds to the signals.
    pub(super) of_run: Option<(String, DamageShown)>,
    /// The run's other bearings that strike at the same orders, a sentence each.
    pub(super) alike: Vec<String>,
}

impl TurningBearing {
    /// What was typed goes before what a case says. `case` is the one of a run's folder, or that of `--bearing`.
    ///
    /// # Errors
    /// [`CliError`]: a bearing that is none, a case without one.
    pub(super) fn of(
        asked: &AnalyzeArguments,
        run: Option<&Path>,
        case: Option<&Case>,
        options: &Options,
    ) -> Result<Self, CliError> {
        if let (Some(folder), Some(case)) = (run, case)
            && let Some(label) = bearing_of_run(asked, case)?
        {
            refuse_contact_angle(asked, "a run in space, whose results say the orders")?;
            return Self::of_run_in_space(asked, folder, case, &label);
        }
        let is_run = run.is_some();
        // a folder's case may be told another bearing
        let (other, catalogue) = match named_bearing(asked)? {
            Some(Named::Catalogue(bearing)) => (None, Some(bearing)),
            Some(Named::Case(path)) if is_run => (Some(in_the_plane(path, options)?), None),
            _ => (None, None),
        };
        if asked.balls.is_none() && catalogue.is_none() {
            refuse_contact_angle(asked, if case.is_some() { "a case, which has its own" } else { "no bearing" })?;
        }
        let typed = asked.orders.is_some() || asked.balls.is_some() || catalogue.is_some();
        let bearing = other.as_ref().or(case);
        let moved = |case: Option<&Case>| {
            let case = case.filter(|case| case.speed.is_some() && asked.speed.is_none());
            let setup = case.map(|case| bearing_setup(case)?.ok_or_else(|| without_bearing(case)));
            setup.transpose()
        };
        let setup: Option<BearingSetup> = moved(bearing.filter(|_| !typed))?;
        let of_case: Option<BearingSetup> = match setup {
            Some(_) => None,
            None => moved(case)?,
        };
        let simulated = is_run && other.is_none();
        let exact = if simulated { 0.0 } else { GEOMETRY_ERROR };
        Ok(Self {
            orders: orders(asked, catalogue, bearing, asked.geometry_error.unwrap_or(GEOMETRY_ERROR))?,
            setup: setup.map(|setup| (Box::new(setup), asked.geometry_error.unwrap_or(exact))),
            typed: asked.speed.clone(),
            of_case: of_case.map(|setup| setup.cage.shaft().clone()),
            catalogue: catalogue
                .zip(asked.bearing.as_deref())
                .map(|(bearing, name)| described(bearing, name, asked.contact_angle)),
            own_first: false,
            of_run: None,
            alike: Vec::new(),
        })
    }

    /// One of the bearings of a run in space, at the orders that its results say.
    fn of_run_in_space(asked: &AnalyzeArguments, folder: &Path, case: &Case, label: &str) -> Result<Self, CliError> {
        let (rolling, damage, alike) = bearing_of_results(folder, label)?;
        let orders = FaultOrders::of(&rolling, asked.geometry_error.unwrap_or(0.0)).map_err(ComputeError::from)?;
        Ok(Self {
            orders: Some(orders),
            setup: None,
            typed: asked.speed.clone(),
            of_case: Some(crate::app::scene::bearing::speed(case)?),
            catalogue: None,
            own_first: false,
            of_run: Some((label.to_owned(), damage)),
            alike,
        })
    }

    /// How a signal's machine moves, and what is taken for granted then, in words. `None` where nothing says the bearing or the
    /// speed.
    pub(super) fn motion(&self, signal: &MeasuredSignal) -> Option<(Kinematics<'_>, Vec<String>)> {
        if let (Some((setup, error)), None) = (&self.setup, own_speed(signal)) {
            let kinematics = match Kinematics::of(&setup.cage, setup.geometry.balls(), setup.geometry.orders()) {
                Kinematics::Cage { cage, balls, rolling, .. } => {
                    Kinematics::Cage { cage, balls, rolling, error: *error }
                }
                given => given,
            };
            let words = "Speed, slip and orders are those of the case, whose cage is prescribed.";
            return Some((kinematics, vec![words.to_owned()]));
        }
        let orders = self.orders?;
        let (speed, words) = self.speed_for(Some(signal))?;
        let notes = self.catalogue.iter().cloned().chain([words, format!(
            "Orders are known within {} %, a ball's as well as the geometry gives it then; the cage rolls without slip but for that.",
            100.0 * orders.error(Fault::OuterRace)
        )]);
        Some((Kinematics::Given { orders, speed }, notes.collect()))
    }

    /// What is to be said where what was typed takes the place of what the file says of itself, or is less than it needs.
    pub(super) fn overruled(&self, signal: &MeasuredSignal, asked_rate: Option<(&str, f64)>) -> Vec<String> {
        let differ = |typed: f64, own: f64| (typed / own - 1.0).abs() > SAME;
        let (mut said, span) = (Vec::new(), signal.series.span());
        let hz = |value: f64| significant(value, 6);
        if let (Some((option, typed)), Some(own)) = (asked_rate, signal.own_rate_hz)
            && differ(typed, own)
        {
            said.push(format!("{option} takes {} Hz for what the file says are {} Hz", hz(typed), hz(own)));
        }
        let Some(GivenSpeed { profile, .. }) = &self.typed else {
            return said;
        };
        let turns = (profile.angle(span.to) - profile.angle(span.from)).abs() / std::f64::consts::TAU;
        let typed = turns / (span.to - span.from);
        if let Some(own) = own_speed(signal).filter(|&own| !self.own_first && differ(typed, own)) {
            said.push(format!(
                "--speed takes {}, on the average, for what the file says are {}",
                shaft_speed(typed, 6),
                shaft_speed(own, 6)
            ));
        }
        said
    }

    /// The shaft's speed and whose word it is: `--speed`, else the file's own, else the case's.
    pub(super) fn speed_for(&self, signal: Option<&MeasuredSignal>) -> Option<(SpeedProfile, String)> {
        let own_first = self.own_first && signal.and_then(own_speed).is_some();
        if let Some(typed) = self.typed.as_ref().filter(|_| !own_first) {
            let words = format!("The shaft turns as --speed says: {}.", typed.text.trim());
            return Some((typed.profile.clone(), words));
        }
        if let Some(hz) = signal.and_then(own_speed) {
            let words = format!("The shaft turns as the file says: {}.", shaft_speed(hz, 6));
            return Some((SpeedProfile::constant(hz).ok()?, words));
        }
        let of_case = self.setup.as_ref().map(|(setup, _)| setup.cage.shaft());
        let profile = of_case.or(self.of_case.as_ref())?;
        Some((profile.clone(), "The shaft turns as the case says.".to_owned()))
    }
}

/// The shaft's speed that a file states of itself, Hz.
fn own_speed(signal: &MeasuredSignal) -> Option<f64> {
    signal.speed_hz.filter(|&hz| hz.is_finite() && hz > 0.0)
}

/// The label of the bearing that is asked for of a run in space; `None` of a run in the plane.
///
/// # Errors
/// [`CliError`] where the run has several and none of them is named.
fn bearing_of_run(asked: &AnalyzeArguments, case: &Case) -> Result<Option<String>, CliError> {
    if asked.orders.is_some() || asked.balls.is_some() || case.in_space("`analyze`")?.is_none() {
        return Ok(None);
    }
    let labels: Vec<String> = case.seats().into_iter().map(|seat| seat.label).collect();
    let named = asked.bearing.as_deref().map(|name| name.to_string_lossy().into_owned());
    match (named, labels.as_slice()) {
        (None, [only]) => Ok(Some(only.clone())),
        (Some(named), labels) if labels.contains(&named) => Ok(Some(named)),
        (named, _) => {
            let found = named.map_or_else(|| "none".to_owned(), |name| format!("\"{name}\""));
            let what = format!("--bearing: found {found}, expected a bearing of the run: {}", labels.join(", "));
            Err(CliError::input(what)
                .with_help("a run of several bearings is analysed for one of them: add --bearing LABEL"))
        }
    }
}

/// The orders of a bearing that the results of a run say, what its damage adds to the signals, and which others strike at the same orders.
fn bearing_of_results(folder: &Path, label: &str) -> Result<(DefectOrders, DamageShown, Vec<String>), CliError> {
    #[derive(serde::Deserialize)]
    struct Orders {
        cage: f64,
        outer: f64,
        inner: f64,
        ball: f64,
    }
    #[derive(serde::Deserialize)]
    struct OfBearing {
        label: String,
        defect_orders: Orders,
        damage_share: Option<f64>,
    }
    #[derive(serde::Deserialize)]
    struct Results {
        bearings: Vec<OfBearing>,
    }
    let path = folder.join("run.json");
    let text =
        std::fs::read_to_string(&path).map_err(|error| CliError::input(format!("{}: {error}", path.display())))?;
    let results: Result<Results, _> = serde_json::from_str(&text);
    let results = results.map_err(|error| CliError::input(format!("{}: {error}", path.display())))?;
    let orders = |of: &OfBearing| {
        let Orders { cage, outer, inner, ball } = of.defect_orders;
        DefectOrders { cage, outer, inner, ball_spin: 0.5 * ball, ball_defect: ball }
    };
    let Some(own) = results.bearings.iter().find(|own| own.label == label) else {
        let what = format!("{}: found no bearing \"{label}\", expected the orders of one", path.display());
        return Err(CliError::input(what).with_help("compute the run anew"));
    };
    let others = results.bearings.iter().filter(|other| other.label != label);
    let same = others.filter_map(|other| alike((label, &orders(own)), (&other.label, &orders(other))));
    Ok((orders(own), DamageShown::in_space(own.damage_share), same.collect()))
}

/// A case whose bearing stays in its plane, as orders at no contact angle do.
///
/// # Errors
/// [`CliError`] for a case that cannot be read, or with keys of the bearing in space.
pub(super) fn in_the_plane(path: &Path, options: &Options) -> Result<Case, CliError> {
    let case = Case::load(path, &options.set)?;
    case.in_the_plane()?;
    Ok(case)
}

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
        .with_help(bearing_help(&name)))
}

/// Orders with their relative error: what was typed goes before what a case says. `None` where nothing says them.
pub(super) fn orders(
    asked: &AnalyzeArguments,
    catalogue: Option<&CatalogueBearing>,
    case: Option<&Case>,
    error: f64,
) -> Result<Option<FaultOrders>, CliError> {
    let in_row = |row: Result<DefectOrders, BearingError>| row.map_err(ComputeError::bearing("bearing: "));
    let angle = asked.contact_angle.unwrap_or(0.0).to_radians();
    let row: DefectOrders = match (&asked.orders, asked.balls, catalogue, case) {
        (Some(given), ..) => return Ok(Some(FaultOrders::new(given.0, error).map_err(ComputeError::from)?)),
        // clap sees to it that all three numbers are there
        (None, Some(balls), ..) => {
            let [ball, pitch] = [asked.ball_diameter, asked.pitch_diameter].map(|given| given.unwrap_or(f64::NAN));
            in_row(BallRow::new(balls, ball, pitch, angle).map(|row| row.orders()))?
        }
        (None, None, Some(bearing), _) => in_row(catalogue_orders(bearing, angle))?,
        (None, None, None, Some(case)) => {
            let geometry = bearing_geometry(case)?;
            geometry.ok_or_else(|| without_bearing(case))?.orders()
        }
        (None, None, None, None) => return Ok(None),
    };
    Ok(Some(FaultOrders::of(&row, error).map_err(ComputeError::from)?))
}

/// Orders of a bearing of the catalogue at a contact angle, rad.
pub(in crate::app::cli) fn catalogue_orders(
    bearing: &CatalogueBearing,
    angle: f64,
) -> Result<DefectOrders, BearingError> {
    Ok(BallRow::new(bearing.balls, bearing.ball_diameter, bearing.pitch_diameter, angle)?.orders())
}

/// Refuses a contact angle beside what has its own, or beside nothing.
fn refuse_contact_angle(asked: &AnalyzeArguments, beside: &str) -> Result<(), CliError> {
    let Some(degrees) = asked.contact_angle else { return Ok(()) };
    let what = format!(
        "--contact-angle: found {degrees} beside {beside}, expected --balls or a bearing of the catalogue (--bearing 6205)"
    );
    Err(CliError::input(what)
        .with_help("leave it out, or add --bearing NAME or --balls, --pitch-diameter and --ball-diameter"))
}

/// What is taken for granted of a bearing of the catalogue that was given by a name.
fn described(bearing: &CatalogueBearing, name: &Path, angle_deg: Option<f64>) -> String {
    let left_out = CatalogueBearing::left_out(&name.to_string_lossy());
    let left_out =
        left_out.map_or_else(String::new, |parts| format!(" Nothing is taken from {parts} beside its number."));
    format!(
        "Bearing {}: {} balls of {:.3} mm on a circle of {:.2} mm{}{} ({}).{left_out}",
        bearing.name,
        bearing.balls,
        1e3 * bearing.ball_diameter,
        1e3 * bearing.pitch_diameter,
        if bearing.pitch_published { "" } else { ", the mean of bore and outer diameter, for none is published" },
        angle_deg.map_or_else(String::new, |degrees| format!(", at a contact angle of {degrees} degrees")),
        bearing.source.citation()
    )
}

pub(super) fn without_bearing(case: &Case) -> CliError {
    CliError::input(format!("{}: expected a case with [bearing], found none", case.source.path.display()))
}
