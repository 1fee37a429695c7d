//! A signal in memory, analysed.

use crate::work::compute;
use crate::{arrays, values};
use numpy::{PyArray1, PyReadonlyArray1};
use plummer::app::commands::analyze::{AnalysisSettings, AskedBand};
use plummer::bearing::catalogue::CatalogueBearing;
use plummer::bearing::kinematics::BallRow;
use plummer::bearing::{SpeedKnot, SpeedProfile};
use plummer::formats::MeasuredSignal;
use plummer::numerics::series::{TimeSeries, TimeWindow};
use plummer::prelude::{ComputeError, WindowAnalysis, compute_analysis};
use plummer::signal::EnvelopeSpectrum;
use plummer::signal::diagnosis::{FaultOrders, Kinematics};
use pyo3::prelude::*;
use pyo3::types::PyList;

/// An analysed signal.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Analysis {
    windows: Vec<WindowAnalysis>,
}

/// What is known of the bearing: a name of the catalogue; number of balls, their diameter and that of their circle; or its orders outer,
/// inner, ball, cage.
#[derive(FromPyObject)]
pub(crate) enum Bearing {
    Named(String),
    Row(u32, f64, f64),
    Orders(Option<f64>, Option<f64>, Option<f64>, Option<f64>),
}

impl Bearing {
    fn orders(self, contact_angle_deg: f64, error: f64) -> Result<FaultOrders, ComputeError> {
        let wrong = |what: String, help: Option<String>| ComputeError::Input { what, help };
        let row = |balls, ball, pitch| {
            let row = BallRow::new(balls, ball, pitch, contact_angle_deg.to_radians());
            row.map(|row| row.orders()).map_err(|error| wrong(format!("bearing: {error}"), None))
        };
        let orders = match self {
            Self::Orders(outer, inner, ball, cage) => {
                return Ok(FaultOrders::new([outer, inner, ball, cage], error)?);
            }
            Self::Row(balls, ball, pitch) => row(balls, ball, pitch)?,
            Self::Named(name) => {
                let found = CatalogueBearing::named(&name).ok_or_else(|| {
                    let what = format!("bearing: found \"{name}\", expected a bearing of the catalogue");
                    wrong(what, Some("plummer init --list-bearings lists them".to_owned()))
                })?;
                row(found.balls, found.ball_diameter, found.pitch_diameter)?
            }
        };
        Ok(FaultOrders::of(&orders, error)?)
    }
}

/// What is looked at of a signal.
#[derive(FromPyObject)]
pub(crate) struct Asked {
    #[pyo3(item)]
    rate_hz: f64,
    #[pyo3(item)]
    start_s: f64,
    #[pyo3(item)]
    unit: String,
    #[pyo3(item)]
    channel: String,
    #[pyo3(item)]
    bearing: Bearing,
    #[pyo3(item)]
    contact_angle_deg: f64,
    #[pyo3(item)]
    geometry_error: f64,
    /// Time (s) and speed (Hz), straight between; one alone: constant.
    #[pyo3(item)]
    speed_hz: Vec<(f64, f64)>,
    #[pyo3(item)]
    windows_s: Vec<(f64, f64)>,
    #[pyo3(item)]
    high_pass_hz: Option<f64>,
    #[pyo3(item)]
    band_hz: Option<(f64, f64)>,
    #[pyo3(item)]
    kurtogram: bool,
    #[pyo3(item)]
    whiten: bool,
}

impl Asked {
    fn settings(&self) -> AnalysisSettings {
        let between = self.band_hz.map(|(from, to)| AskedBand::Between([from, to]));
        let band = self.high_pass_hz.map(AskedBand::HighPass).or(between);
        AnalysisSettings {
            band: band.or(self.kurtogram.then_some(AskedBand::Kurtogram)),
            whiten: self.whiten,
            windows: self.windows_s.iter().map(|&(from, to)| TimeWindow { from, to }).collect(),
            ..AnalysisSettings::default()
        }
    }

    fn speed(&self) -> Result<SpeedProfile, ComputeError> {
        let made = match self.speed_hz.as_slice() {
            [(_, constant)] => SpeedProfile::constant(*constant),
            points => {
                let knot = |&(time, frequency_hz): &(f64, f64)| SpeedKnot { time, frequency_hz };
                SpeedProfile::new(&points.iter().map(knot).collect::<Vec<_>>())
            }
        };
        made.map_err(|error| ComputeError::Input { what: format!("speed_hz: {error}"), help: None })
    }
}

/// Analyses a signal: what `plummer analyze` says of a file.
#[pyfunction]
pub(crate) fn analyze(
    py: Python<'_>,
    signal: PyReadonlyArray1<'_, f64>,
    asked: Asked,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Analysis> {
    let values = signal.as_array().to_vec();
    let windows = compute(py, progress, move |told| {
        let settings = asked.settings();
        let speed = asked.speed()?;
        let orders = asked.bearing.orders(asked.contact_angle_deg, asked.geometry_error)?;
        let series = TimeSeries::new(asked.start_s, 1.0 / asked.rate_hz, asked.unit, values);
        let series = series.map_err(|error| ComputeError::Input { what: format!("signal: {error}"), help: None })?;
        let signal = MeasuredSignal {
            name: asked.channel,
            series,
            speed_hz: None,
            own_rate_hz: Some(asked.rate_hz),
            doubts: Vec::new(),
        };
        compute_analysis(&[signal], &settings, &Kinematics::Given { orders, speed }, told)
    })?;
    Ok(Analysis { windows })
}

#[pymethods]
impl Analysis {
    /// What analysis.json says of each window.
    fn windows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let windows = self.windows.iter().map(|window| values::dict(py, window)).collect::<PyResult<Vec<_>>>()?;
        PyList::new(py, windows)
    }

    /// Frequencies (Hz) and amplitudes of each window's envelope.
    fn spectra<'py>(&self, py: Python<'py>) -> Vec<[Bound<'py, PyArray1<f64>>; 2]> {
        let spectra = self.windows.iter().map(|window| &window.spectrum);
        let arrays = |found: &EnvelopeSpectrum| {
            [arrays::vector(py, found.frequency_hz.clone()), arrays::vector(py, found.amplitude.clone())]
        };
        spectra.map(arrays).collect()
    }
}
