//! A signal in memory, analysed.

use crate::case::Case;
use crate::work::compute;
use crate::{arrays, values};
use numpy::{PyArray1, PyReadonlyArray1};
use plummer::app::commands::analyze::{AnalysisSettings, AskedBand, EarlierSignal, compare_windows, signal_flaws};
use plummer::app::scene::bearing_setup;
use plummer::bearing::catalogue::CatalogueBearing;
use plummer::bearing::kinematics::BallRow;
use plummer::bearing::{SpeedKnot, SpeedProfile};
use plummer::formats::MeasuredSignal;
use plummer::numerics::series::{TimeSeries, TimeWindow};
use plummer::prelude::{ComputeError, WindowAnalysis, compute_analysis};
use plummer::signal::EnvelopeSpectrum;
use plummer::signal::diagnosis::{FaultOrders, Kinematics};
use plummer::system::BearingSetup;
use pyo3::prelude::*;
use pyo3::types::PyList;

/// An analysed signal.
#[pyclass(frozen, module = "plummer._plummer")]
pub(crate) struct Analysis {
    windows: Vec<WindowAnalysis>,
    warnings: Vec<String>,
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
    fn orders(&self, contact_angle_deg: f64, error: f64) -> Result<FaultOrders, ComputeError> {
        let wrong = |what: String, help: Option<String>| ComputeError::Input { what, help };
        let row = |balls, ball, pitch| {
            let row = BallRow::new(balls, ball, pitch, contact_angle_deg.to_radians());
            row.map(|row| row.orders()).map_err(|error| wrong(format!("bearing: {error}"), None))
        };
        let orders = match self {
            Self::Orders(outer, inner, ball, cage) => {
                return Ok(FaultOrders::new([*outer, *inner, *ball, *cage], error)?);
            }
            Self::Row(balls, ball, pitch) => row(*balls, *ball, *pitch)?,
            Self::Named(name) => {
                let found = CatalogueBearing::named(name).ok_or_else(|| {
                    let what = format!("bearing: found \"{name}\", expected a bearing of the catalogue");
                    wrong(what, Some("plummer init --list-bearings lists them".to_owned()))
                })?;
                row(found.balls, found.ball_diameter, found.pitch_diameter)?
            }
        };
        Ok(FaultOrders::of(&orders, error)?)
    }
}

/// Times (s) and speeds (Hz), straight between; one alone: constant.
type Speed = Vec<(f64, f64)>;

/// What is known of a signal.
#[derive(FromPyObject)]
pub(crate) struct Known {
    #[pyo3(item)]
    rate_hz: f64,
    #[pyo3(item)]
    start_s: f64,
    #[pyo3(item)]
    unit: String,
    #[pyo3(item)]
    channel: String,
    /// `None`: as a case says.
    #[pyo3(item)]
    speed_hz: Option<Speed>,
}

/// An earlier signal, what is known of it, and the window of it that counts, s.
type Earlier<'py> = (PyReadonlyArray1<'py, f64>, Known, Option<(f64, f64)>);

/// What is looked at of a signal.
#[derive(FromPyObject)]
pub(crate) struct Asked {
    /// `None`: that of a case.
    #[pyo3(item)]
    bearing: Option<Bearing>,
    #[pyo3(item)]
    contact_angle_deg: f64,
    #[pyo3(item)]
    geometry_error: f64,
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

    /// Orders of the bearing, those of a case's where none is named.
    fn orders(&self, of_case: Option<&BearingSetup>) -> Result<FaultOrders, ComputeError> {
        let wrong = |what: &str| ComputeError::Input { what: what.to_owned(), help: None };
        match (&self.bearing, of_case) {
            (Some(bearing), _) => bearing.orders(self.contact_angle_deg, self.geometry_error),
            (None, Some(setup)) => Ok(FaultOrders::of(&setup.geometry.orders(), self.geometry_error)?),
            (None, None) => Err(wrong("bearing: found a case without [bearing] or [shaft], expected one with both")),
        }
    }

    /// How the machine of a signal moves.
    fn motion<'a>(&self, known: &Known, of_case: Option<&'a BearingSetup>) -> Result<Kinematics<'a>, ComputeError> {
        let orders = self.orders(of_case)?;
        let wrong = |what: String| ComputeError::Input { what, help: None };
        let speed = match (known.speed_hz.as_deref(), of_case) {
            (Some([(_, constant)]), _) => SpeedProfile::constant(*constant),
            (Some(points), _) => {
                let knot = |&(time, frequency_hz): &(f64, f64)| SpeedKnot { time, frequency_hz };
                SpeedProfile::new(&points.iter().map(knot).collect::<Vec<_>>())
            }
            (None, Some(setup)) => {
                let (rolling, balls) = (setup.geometry.orders(), setup.geometry.balls());
                return Ok(Kinematics::Cage { cage: &setup.cage, balls, rolling, error: self.geometry_error });
            }
            (None, None) => return Err(wrong("speed_hz: found nothing, expected the speed of the shaft".to_owned())),
        };
        Ok(Kinematics::Given { orders, speed: speed.map_err(|error| wrong(format!("speed_hz: {error}")))? })
    }
}

impl Known {
    /// The signal with its values.
    fn signal(&self, values: Vec<f64>) -> Result<MeasuredSignal, ComputeError> {
        let series = TimeSeries::new(self.start_s, 1.0 / self.rate_hz, self.unit.clone(), values);
        let series =
            series.map_err(|error| ComputeError::Input { what: format!("{}: {error}", self.channel), help: None })?;
        Ok(MeasuredSignal::in_memory(self.channel.clone(), series)?)
    }
}

/// Analyses a signal, and compares it with an earlier one: what `plummer analyze` says of a file.
#[pyfunction]
pub(crate) fn analyze(
    py: Python<'_>,
    signal: PyReadonlyArray1<'_, f64>,
    known: Known,
    asked: Asked,
    case: Option<PyRef<'_, Case>>,
    earlier: Option<Earlier<'_>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Analysis> {
    let values = signal.as_array().to_vec();
    let earlier = earlier.map(|(values, known, window)| (values.as_array().to_vec(), known, window));
    let case = case.map(|case| case.library());
    let (windows, warnings) = compute(py, progress, move |told| {
        let setup = case.map(|case| {
            case.in_the_plane()?;
            bearing_setup(&case)
        });
        let setup = setup.transpose()?.flatten();
        let settings = asked.settings();
        let kinematics = asked.motion(&known, setup.as_ref())?;
        let signal = known.signal(values)?;
        let mut windows = compute_analysis(std::slice::from_ref(&signal), &settings, &kinematics, told)?;
        let mut warnings = signal_flaws(&signal, &settings.windows, None, Some(&kinematics));
        if let Some((values, known, window)) = earlier {
            let before = asked.motion(&known, setup.as_ref())?;
            let earlier = EarlierSignal {
                name: &known.channel,
                signal: &known.signal(values)?,
                window: window.map(|(from, to)| TimeWindow { from, to }),
                kinematics: &before,
                settings: &AnalysisSettings { windows: Vec::new(), ..settings.clone() },
            };
            compare_windows(&mut windows, &settings, &signal, &kinematics, &earlier)?;
            warnings.extend(signal_flaws(earlier.signal, earlier.window.as_slice(), None, Some(&before)));
        }
        for window in &windows {
            warnings.extend(window.doubts());
            warnings.extend(window.change.iter().flat_map(|change| change.warnings.clone()));
        }
        Ok((windows, warnings))
    })?;
    Ok(Analysis { windows, warnings })
}

#[pymethods]
impl Analysis {
    /// What analysis.json says of each window.
    fn windows<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyList>> {
        let windows = self.windows.iter().map(|window| values::dict(py, window)).collect::<PyResult<Vec<_>>>()?;
        PyList::new(py, windows)
    }

    /// What is wrong with the signals, a sentence each.
    #[getter]
    fn warnings(&self) -> Vec<String> {
        self.warnings.clone()
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
