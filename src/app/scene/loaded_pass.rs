//! Loaded eigenfrequencies as the balls go round, and under more or less load.

use super::structure::CoupledStructure;
use crate::app::error::ComputeError;
use crate::numerics::Watch;
use crate::report::{Abscissa, Axis, Curve, CurveStyle, Plot, Section};
use crate::system::{BearingSetup, Equilibrium, LoadedModes, StaticCondition, SystemError};
use rayon::prelude::*;

/// Cage angles over one ball spacing, both ends included.
const ANGLES: usize = 29;

/// Loads, each in units of the case's, from a tenth to ten times.
const LOADS: usize = 17;

/// Frequencies drawn.
const DRAWN: usize = 8;

/// Loaded modes at one cage angle or load.
#[derive(Debug, Clone)]
pub struct LoadedPoint {
    /// Angle that the cage is turned on by, rad, or load in units of the case's.
    pub at: f64,
    /// `None` where no equilibrium was found.
    pub modes: Option<LoadedModes>,
}

/// Loaded modes over a ball pass and over the load.
#[derive(Debug, Clone)]
pub struct LoadedPass {
    /// Over one ball spacing.
    pub over_angle: Vec<LoadedPoint>,
    /// From a tenth of the force on the shaft to ten times.
    pub over_load: Vec<LoadedPoint>,
}

impl LoadedPass {
    /// Linearises at the equilibrium of every angle and load, from cage and loads as they are at `time` (s).
    ///
    /// # Errors
    /// [`ComputeError::System`] for what is no missing equilibrium.
    pub fn compute(
        stage: &CoupledStructure,
        setup: &BearingSetup,
        time: f64,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        watch.stage("ball pass");
        let condition = StaticCondition::at(setup, time);
        let point = |at: f64, condition: StaticCondition| {
            let rest = match Equilibrium::find(&stage.structure, setup, condition) {
                Err(SystemError::NoEquilibrium { .. }) => {
                    return Ok(LoadedPoint { at, modes: None });
                }
                found => found?,
            };
            let modes = LoadedModes::at(&stage.structure, &stage.modes, setup, &rest)?;
            Ok(LoadedPoint {
                at,
                modes: Some(modes),
            })
        };
        let angle = |place: usize| {
            let turned = setup.cage.spacing() * place as f64 / (ANGLES - 1) as f64;
            point(turned, condition.turned_by(setup, turned))
        };
        let load = |place: usize| {
            let factor = 10_f64.powf(2.0 * place as f64 / (LOADS - 1) as f64 - 1.0);
            point(factor, condition.loaded(factor))
        };
        let all =
            |points: usize, at: &(dyn Fn(usize) -> Result<LoadedPoint, ComputeError> + Sync)| {
                (0..points)
                    .into_par_iter()
                    .map(at)
                    .collect::<Result<Vec<_>, _>>()
            };
        Ok(Self {
            over_angle: all(ANGLES, &angle)?,
            over_load: all(LOADS, &load)?,
        })
    }
}

/// The section of a report.
pub(crate) fn loaded_pass_section(pass: &LoadedPass) -> Section {
    let angle = chart(
        "Loaded frequencies over a ball pass",
        Axis::new("Cage turned by", "deg"),
        &pass.over_angle,
        f64::to_degrees,
    );
    let load = chart(
        "Loaded frequencies over the load",
        Axis::new("Load on the shaft, in units of the case's", "").log(),
        &pass.over_load,
        |factor| factor,
    );
    Section::new("Loaded frequencies as the balls go round")
        .plot(angle)
        .plot(load)
}

/// The lowest frequencies of modes that are not the balls' own, by their number.
fn chart(title: &str, x: Axis, points: &[LoadedPoint], show: impl Fn(f64) -> f64) -> Plot {
    let places: Vec<f64> = points.iter().map(|point| show(point.at)).collect();
    let frequencies: Vec<Vec<f64>> = points
        .iter()
        .map(|point| {
            let modes = point.modes.iter().flat_map(|loaded| &loaded.modes);
            let held = modes.filter(|mode| !mode.is_ball_mode());
            held.map(|mode| mode.frequency_hz).take(DRAWN).collect()
        })
        .collect();
    let mut plot = Plot::new(title, x, Axis::new("Frequency", "Hz").log()).caption(
        "Each angle and load at its own equilibrium, without the modes that are the balls' own; numbered by frequency, so that two curves that come close may exchange their modes.",
    );
    for mode in 0..DRAWN {
        let values = frequencies
            .iter()
            .map(|found| found.get(mode).copied().unwrap_or(f64::NAN));
        let values: Vec<f64> = values.collect();
        if values.iter().any(|value| value.is_finite()) {
            let curve = Curve::new(
                format!("mode {}", mode + 1),
                Abscissa::Points(places.clone()),
                values,
            );
            plot = plot.curve(curve.style(CurveStyle::Line));
        }
    }
    plot
}
