//! `plummer modes`: eigenfrequencies of housing, ring, or both, unloaded and loaded, and the
//! verification against expected ones.

use super::{HousingStage, StageError, StructureStage, Watch, bearing_setup};
use crate::case::{Case, Expected, Linearise, ModeExtent};
use crate::modal::{housing_modes, rigid_mode_count};
use crate::system::{Equilibrium, LoadedMode, LoadedModes};
use serde::Serialize;

/// An expected frequency and what was found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExpectedMode {
    /// Expected, Hz.
    pub hz: f64,
    /// What it is expected to be.
    pub what: String,
    /// Nearest mode that is not the balls' own, Hz; `None`: there is none.
    pub found_hz: Option<f64>,
    /// (found - expected) / expected.
    pub relative_error: Option<f64>,
    /// Largest magnitude of it that passes.
    pub within: f64,
    /// Whether it passes.
    pub ok: bool,
}

/// One reading of a case: the case itself or one of its variants.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// What it changes; empty for the case itself.
    pub what: String,
    /// The keys that it sets.
    pub set: Vec<String>,
    /// Modes without contact, Hz, ascending, as many as asked for.
    pub unloaded_hz: Vec<f64>,
    /// Modes linearised at the static equilibrium, if asked for.
    pub loaded: Option<LoadedModes>,
    /// The equilibrium that they belong to.
    pub equilibrium: Option<Equilibrium>,
    /// Expected frequencies against these.
    pub expected: Vec<ExpectedMode>,
}

/// Result of the command.
#[derive(Debug, Clone)]
pub struct ModesResult {
    /// The case itself.
    pub base: Reading,
    /// Its variants, in order.
    pub variants: Vec<Reading>,
    /// Degrees of freedom before condensation, ring and housing.
    pub dof: usize,
    /// Coordinates that the eigenproblem was solved for.
    pub free_dof: usize,
    /// Number of rigid modes among the unloaded ones.
    pub rigid_modes: usize,
    /// Mass of ring and housing, kg.
    pub mass_kg: f64,
    /// Residuals of the modes, for a housing alone.
    pub residuals: Vec<f64>,
    /// The linear model, for the picture; `None` for a housing alone.
    pub structure: Option<StructureStage>,
    /// The housing, for the picture, if it stands alone.
    pub housing: Option<HousingStage>,
}

impl ModesResult {
    /// Whether every expected frequency was found.
    pub fn passes(&self) -> bool {
        self.base.expected.iter().all(|expected| expected.ok)
    }
}

impl Reading {
    /// Frequencies that the verification looks at: loaded ones if there are any.
    pub fn frequencies_hz(&self) -> Vec<f64> {
        match &self.loaded {
            Some(loaded) => loaded.modes.iter().map(|mode| mode.frequency_hz).collect(),
            None => self.unloaded_hz.clone(),
        }
    }

    /// Nearest mode to a frequency among those that are not the balls' own, Hz.
    pub fn nearest_hz(&self, hz: f64) -> Option<f64> {
        match &self.loaded {
            Some(loaded) => loaded
                .nearest(hz)
                .map(|mode: &LoadedMode| mode.frequency_hz),
            None => self
                .unloaded_hz
                .iter()
                .copied()
                .min_by(|a, b| (a - hz).abs().total_cmp(&(b - hz).abs())),
        }
    }
}

/// Carries the command out.
///
/// # Errors
/// [`StageError`] of the stages that it goes through.
pub fn compute_modes(case: &Case, watch: &impl Watch) -> Result<ModesResult, StageError> {
    let Some(stage) = StructureStage::build(case, watch)? else {
        return housing_alone(case, watch);
    };
    watch.stage("linearise");
    let base = reading(case, &stage, String::new(), Vec::new())?;
    watch.stage("variants");
    let cases = case.variants()?;
    let mut variants = Vec::with_capacity(cases.len());
    for (index, variant) in cases.iter().enumerate() {
        watch.fraction(index as f64 / cases.len() as f64);
        let set = case.modes.variants[index].set.clone();
        let built = StructureStage::build(&variant.case, &super::Unwatched)?;
        if let Some(built) = built {
            variants.push(reading(&variant.case, &built, variant.what.clone(), set)?);
        }
    }
    let rigid = stage.structure.ring().rigid_motion(1.0, 0.0, 0.0);
    let ring_mass: f64 = mass_of(stage.structure.ring().mass(), &rigid);
    let housing_mass = stage
        .housing
        .as_ref()
        .map_or(0.0, |housing| housing.matrices.total_mass());
    let housing_dof = stage
        .housing
        .as_ref()
        .map_or(0, |housing| housing.model.dof());
    Ok(ModesResult {
        base,
        variants,
        dof: stage.structure.ring().dof() + housing_dof,
        free_dof: stage.structure.dof(),
        rigid_modes: rigid_mode_count(&stage.modes.squared_frequencies),
        mass_kg: ring_mass + housing_mass,
        residuals: Vec::new(),
        structure: Some(stage),
        housing: None,
    })
}

fn housing_alone(case: &Case, watch: &impl Watch) -> Result<ModesResult, StageError> {
    let Some(housing) = HousingStage::build(case, watch)? else {
        // a case with neither ring nor housing was refused before
        return Err(crate::linalg::LinalgError::TooManyModes {
            asked: 1,
            available: 0,
        }
        .into());
    };
    watch.stage("eigen");
    let free = housing.model.free_dofs();
    let mut count = match case.modes.extent {
        ModeExtent::Count(count) => count,
        ModeExtent::UpToHz(_) => 20,
    };
    let modes = loop {
        let modes = housing_modes(&housing.matrices, &free, count.min(free.len()))?;
        match case.modes.extent {
            ModeExtent::UpToHz(hz) if count < free.len() => {
                if modes.frequencies_hz.last().is_some_and(|&last| last > hz) {
                    break modes;
                }
                count *= 2;
            }
            _ => break modes,
        }
    };
    let unloaded_hz = limited(&modes.frequencies_hz, case.modes.extent);
    let mut base = Reading {
        what: String::new(),
        set: Vec::new(),
        unloaded_hz,
        loaded: None,
        equilibrium: None,
        expected: Vec::new(),
    };
    base.expected = judge(&base, &case.modes.expected);
    Ok(ModesResult {
        base,
        variants: Vec::new(),
        dof: housing.model.dof(),
        free_dof: free.len(),
        rigid_modes: rigid_mode_count(&modes.eigenvalues),
        mass_kg: housing.matrices.total_mass(),
        residuals: modes.residuals,
        structure: None,
        housing: Some(housing),
    })
}

fn reading(
    case: &Case,
    stage: &StructureStage,
    what: String,
    set: Vec<String>,
) -> Result<Reading, StageError> {
    let all: Vec<f64> = (0..stage.modes.count())
        .map(|mode| stage.modes.frequency_hz(mode))
        .collect();
    let (loaded, equilibrium) = match (case.modes.linearise, bearing_setup(case)?) {
        (Linearise::Static, Some(setup)) => {
            let t = case
                .transient
                .as_ref()
                .map_or(0.0, |transient| transient.start);
            let equilibrium = Equilibrium::find(&stage.structure, &setup, t)?;
            let loaded = LoadedModes::at(&stage.structure, &stage.modes, &setup, &equilibrium)?;
            (Some(loaded), Some(equilibrium))
        }
        _ => (None, None),
    };
    let mut reading = Reading {
        what,
        set,
        unloaded_hz: limited(&all, case.modes.extent),
        loaded,
        equilibrium,
        expected: Vec::new(),
    };
    reading.expected = judge(&reading, &case.modes.expected);
    Ok(reading)
}

fn limited(frequencies_hz: &[f64], extent: ModeExtent) -> Vec<f64> {
    let ascending = frequencies_hz.iter().copied();
    match extent {
        ModeExtent::Count(count) => ascending.take(count).collect(),
        ModeExtent::UpToHz(hz) => ascending.take_while(|&frequency| frequency <= hz).collect(),
    }
}

fn judge(reading: &Reading, expected: &[Expected]) -> Vec<ExpectedMode> {
    expected
        .iter()
        .map(|expected| {
            let found_hz = reading.nearest_hz(expected.hz);
            let relative_error = found_hz.map(|found| found / expected.hz - 1.0);
            ExpectedMode {
                hz: expected.hz,
                what: expected.what.clone(),
                found_hz,
                relative_error,
                within: expected.within,
                ok: relative_error.is_some_and(|error| error.abs() <= expected.within),
            }
        })
        .collect()
}

/// `r^T M r`.
fn mass_of(mass: &crate::linalg::DenseMatrix, motion: &[f64]) -> f64 {
    let mut sum = 0.0;
    for (column, right) in motion.iter().enumerate() {
        for (row, left) in motion.iter().enumerate() {
            sum += left * mass[(row, column)] * right;
        }
    }
    sum
}
