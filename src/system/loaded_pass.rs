//! Loaded eigenfrequencies as the balls go round, and under more or less load.

use super::{BearingSetup, Equilibrium, LoadedModes, StaticCondition, Structure, StructureModes, SystemError};
use crate::numerics::Watch;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// Cage angles over one ball spacing, both ends included.
const ANGLES: usize = 29;

/// Loads, each in units of the case's, from a tenth to ten times.
const LOADS: usize = 17;

/// Loaded modes at one cage angle or load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LoadedPoint {
    /// Angle that the cage is turned on by, rad, or load in units of the case's.
    pub at: f64,
    /// `None` where no equilibrium was found. Results have the frequencies alone, Hz.
    #[serde(rename = "frequencies_hz", serialize_with = "frequencies_alone")]
    #[schemars(with = "Option<Vec<f64>>")]
    pub modes: Option<LoadedModes>,
}

/// Loaded modes over a ball pass and over the load.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct LoadedPass {
    /// Over one ball spacing, each at an angle of the cage, rad.
    #[serde(rename = "over_angle_rad")]
    pub over_angle: Vec<LoadedPoint>,
    /// From a tenth of the force on the shaft to ten times.
    pub over_load: Vec<LoadedPoint>,
}

fn frequencies_alone<S: Serializer>(modes: &Option<LoadedModes>, to: S) -> Result<S::Ok, S::Error> {
    let frequencies = modes.as_ref().map(|loaded| loaded.modes.iter().map(|mode| mode.frequency_hz));
    frequencies.map(Iterator::collect::<Vec<f64>>).serialize(to)
}

impl LoadedPass {
    /// Linearises at the equilibrium of every angle and load, from cage and loads as they are at `time` (s).
    ///
    /// # Errors
    /// [`SystemError`] for what is no missing equilibrium.
    pub fn compute(
        (structure, modes): (&Structure, &StructureModes),
        setup: &BearingSetup,
        time: f64,
        watch: &impl Watch,
    ) -> Result<Self, SystemError> {
        watch.stage("ball pass");
        let condition = StaticCondition::at(setup, time);
        let point = |at: f64, condition: StaticCondition| -> Result<LoadedPoint, SystemError> {
            let rest = match Equilibrium::find(structure, setup, condition) {
                Err(SystemError::NoEquilibrium { .. }) => {
                    return Ok(LoadedPoint { at, modes: None });
                }
                found => found?,
            };
            let modes = LoadedModes::at(structure, modes, setup, &rest)?;
            Ok(LoadedPoint { at, modes: Some(modes) })
        };
        let over_angle = (0..ANGLES).into_par_iter().map(|place| {
            let turned = setup.cage.spacing * place as f64 / (ANGLES - 1) as f64;
            point(turned, condition.turned_by(setup, turned))
        });
        let over_load = (0..LOADS).into_par_iter().map(|place| {
            let factor = 10_f64.powf(2.0 * place as f64 / (LOADS - 1) as f64 - 1.0);
            point(factor, condition.loaded(factor))
        });
        Ok(Self { over_angle: over_angle.collect::<Result<_, _>>()?, over_load: over_load.collect::<Result<_, _>>()? })
    }
}
