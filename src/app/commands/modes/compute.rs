//! `plummer modes`: eigenfrequencies of housing, ring, or both, unloaded and loaded, and the
//! verification against expected ones.

use super::comparison::{ComparedFile, FileComparison};
use super::convergence::{MeshConvergence, mesh_convergence};
use super::mesh_sequence::MeshSequence;
use super::shapes::mode_shapes;
use crate::app::case::{Case, Expected, Linearise};
use crate::app::commands::parts::tables::ExpectedMode;
use crate::app::error::ComputeError;
use crate::app::scene::contact_limits::accept_contacts;
use crate::app::scene::structure_modes::UnloadedModes;
use crate::app::scene::{AssembledHousing, CoupledStructure, bearing_setup, doubts, race_contacts};
use crate::fe::mesh::Mesh;
use crate::fe::modal::{ModalSurvey, ModeRange};
use crate::fe::model::HousingModel;
use crate::formats::ModeShapes;
use crate::numerics::{Unwatched, Watch};
use crate::system::LoadedPass;
use crate::system::Statics;
use crate::system::{BearingSetup, Equilibrium, LoadedMode, LoadedModes, StaticCondition};
use schemars::JsonSchema;
use serde::Serialize;

/// One reading of a case: the case itself or one of its variants.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Reading {
    /// What it changes; empty for the case itself.
    pub what: String,
    /// The keys that it sets.
    pub set: Vec<String>,
    /// Modes without contact in full, Hz, ascending, as many as asked for.
    #[serde(rename = "frequencies_hz")]
    pub unloaded_hz: Vec<f64>,
    /// How far condensing the housing moves them: the largest relative difference of the frequencies of the condensed
    /// model from these, over the elastic modes listed. Loaded modes are those of the condensed model. `None` where
    /// nothing is condensed.
    pub condensation_difference: Option<f64>,
    /// Modes linearised at the static equilibrium, if asked for, with the housing condensed.
    pub loaded: Option<LoadedModes>,
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
    /// Modes without contact in full, with their proof.
    pub survey: ModalSurvey,
    /// The linear model of a case with a ring, its housing condensed.
    pub structure: Option<CoupledStructure>,
    /// Mesh and model of a housing alone.
    pub housing: Option<(Mesh, HousingModel)>,
    /// These modes against those of other programs or measurements, in the order of the case file.
    pub comparisons: Vec<FileComparison>,
    /// The same modes on other meshes.
    pub convergence: Option<MeshConvergence>,
    /// The bearing at rest, if modes are linearised with it.
    pub statics: Option<Statics>,
    /// Loaded modes over a ball pass and over the load, if asked for.
    pub loaded_pass: Option<LoadedPass>,
    /// What of the model may be meant otherwise, a sentence each.
    pub doubts: Vec<String>,
}

impl ModesResult {
    /// Mesh and model of the housing, if there is one.
    pub(crate) fn mesh_and_model(&self) -> Option<(&Mesh, &HousingModel)> {
        let alone = self.housing.as_ref().map(|(mesh, model)| (mesh, model));
        let coupled = self.structure.as_ref().and_then(|stage| stage.housing.as_ref());
        alone.or(coupled.map(|housing| (&housing.mesh, &housing.model)))
    }

    /// Frequencies and shapes as other programs read them; the ring's nodes stand after those of the mesh.
    pub(crate) fn mode_shapes(&self) -> ModeShapes {
        mode_shapes(&self.survey, self.mesh_and_model())
    }

    /// Whether every expected frequency was found and every comparison passes.
    pub(crate) fn passes(&self) -> bool {
        self.base.expected.iter().all(|expected| expected.ok) && self.comparisons.iter().all(|comparison| comparison.ok)
    }
}

impl Reading {
    /// Frequencies that the verification looks at: loaded ones if there are any.
    pub(crate) fn frequencies_hz(&self) -> Vec<f64> {
        match &self.loaded {
            Some(loaded) => loaded.modes.iter().map(|mode| mode.frequency_hz).collect(),
            None => self.unloaded_hz.clone(),
        }
    }

    /// Nearest mode to a frequency among those that are not the balls' own, Hz.
    pub(crate) fn nearest_hz(&self, hz: f64) -> Option<f64> {
        match &self.loaded {
            Some(loaded) => loaded.nearest(hz).map(|mode: &LoadedMode| mode.frequency_hz),
            None => self.unloaded_hz.iter().copied().min_by(|a, b| (a - hz).abs().total_cmp(&(b - hz).abs())),
        }
    }
}

/// Carries the command out.
///
/// # Errors
/// [`ComputeError`] of the stages that it goes through.
pub fn compute_modes(case: &Case, watch: &impl Watch) -> Result<ModesResult, ComputeError> {
    // what is wrong with the files is told before anything is computed
    let files = ComparedFile::read_all(case)?;
    let sequence = MeshSequence::read(case)?;
    let mut result = own_modes(case, watch)?;
    if !files.is_empty() {
        watch.stage("compare");
    }
    for file in &files {
        let comparison = file.compare(&result.survey, result.mesh_and_model())?;
        result.comparisons.push(comparison);
    }
    if let Some(sequence) = sequence {
        result.doubts.extend(sequence.doubts());
        let housing = result.mesh_and_model();
        result.convergence = mesh_convergence(case, &sequence, &result.survey, housing, watch)?;
    }
    Ok(result)
}

fn own_modes(case: &Case, watch: &impl Watch) -> Result<ModesResult, ComputeError> {
    let Some(stage) = CoupledStructure::build(case, watch)? else {
        return housing_alone(case, watch);
    };
    let survey = stage.survey(case.modes.extent, watch)?;
    watch.stage("linearise");
    let unloaded =
        UnloadedModes { frequencies_hz: survey.basis.frequencies_hz.clone(), rigid: survey.basis.rigid_modes };
    let base = reading(case, &stage, unloaded, String::new(), Vec::new())?;
    let statics = match linearised_setup(case)? {
        Some(setup) => Some(Statics::compute(&stage.structure, &setup, start_time(case))?),
        None => None,
    };
    let loaded_pass = match linearised_setup(case)?.filter(|_| case.modes.ball_pass) {
        Some(setup) => Some(LoadedPass::compute((&stage.structure, &stage.modes), &setup, start_time(case), watch)?),
        None => None,
    };
    watch.stage("variants");
    let cases = case.variants()?;
    let mut variants = Vec::with_capacity(cases.len());
    for (index, variant) in cases.iter().enumerate() {
        watch.fraction(index as f64 / cases.len() as f64);
        let set = case.modes.variants[index].set.clone();
        let built = CoupledStructure::build(&variant.case, &Unwatched)?;
        if let Some(built) = built {
            let unloaded = built.unloaded_modes(variant.case.modes.extent)?;
            let what = variant.what.clone();
            variants.push(reading(&variant.case, &built, unloaded, what, set)?);
        }
    }
    let housing = stage.housing.as_ref();
    let housing = housing.map(|housing| (&housing.mesh, &housing.model));
    let setup = linearised_setup(case)?;
    let at_rest = statics.iter().flat_map(|statics| &statics.equilibria).next();
    let imported = stage.imported.iter();
    let top_hz = survey.basis.frequencies_hz.iter().copied().fold(0.0, f64::max);
    let asked_hz = match case.modes.extent {
        ModeRange::UpToHz(top_hz) | ModeRange::BandHz([_, top_hz]) => top_hz,
        ModeRange::Count(_) | ModeRange::AtMost(_) => 0.0,
    };
    let top_hz = top_hz.max(asked_hz);
    let beyond = imported.filter_map(|imported| imported.doubt(top_hz));
    let mut doubts = doubts(case, housing, setup.as_ref().zip(at_rest))?;
    doubts.extend(beyond);
    Ok(ModesResult {
        base,
        variants,
        survey,
        housing: None,
        comparisons: Vec::new(),
        convergence: None,
        doubts,
        structure: Some(stage),
        statics,
        loaded_pass,
    })
}

fn housing_alone(case: &Case, watch: &impl Watch) -> Result<ModesResult, ComputeError> {
    let AssembledHousing { mesh, model, matrices } = AssembledHousing::of(case, watch)?;
    let survey = ModalSurvey::of_housing(&mesh, &model, matrices, case.modes.extent, watch)?;
    let mut base = Reading {
        what: String::new(),
        set: Vec::new(),
        unloaded_hz: survey.basis.frequencies_hz.clone(),
        condensation_difference: None,
        loaded: None,
        expected: Vec::new(),
    };
    base.expected = judge(&base, &case.modes.expected);
    Ok(ModesResult {
        base,
        variants: Vec::new(),
        survey,
        structure: None,
        doubts: doubts(case, Some((&mesh, &model)), None)?,
        housing: Some((mesh, model)),
        comparisons: Vec::new(),
        convergence: None,
        statics: None,
        loaded_pass: None,
    })
}

/// The bearing, if modes are linearised with it.
fn linearised_setup(case: &Case) -> Result<Option<BearingSetup>, ComputeError> {
    match case.modes.linearise {
        Linearise::Static => bearing_setup(case),
        Linearise::None => Ok(None),
    }
}

/// When the bearing is looked at, s.
fn start_time(case: &Case) -> f64 {
    let transient = case.transient.as_ref();
    transient.map_or(0.0, |transient| transient.start)
}

fn reading(
    case: &Case,
    stage: &CoupledStructure,
    unloaded: UnloadedModes,
    what: String,
    set: Vec<String>,
) -> Result<Reading, ComputeError> {
    let loaded = match linearised_setup(case)? {
        Some(setup) => {
            let condition = StaticCondition::at(&setup, start_time(case));
            let equilibrium = Equilibrium::find(&stage.structure, &setup, condition)?;
            if let Some(contacts) = race_contacts(case)? {
                accept_contacts(&setup, &contacts, &equilibrium)?;
            }
            let modes = LoadedModes::at(&stage.structure, &stage.modes, &setup, &equilibrium)?;
            Some(modes)
        }
        None => None,
    };
    let mut reading = Reading {
        what,
        set,
        condensation_difference: condensation_difference(stage, &unloaded, case.modes.extent),
        unloaded_hz: unloaded.frequencies_hz,
        loaded,
        expected: Vec::new(),
    };
    reading.expected = judge(&reading, &case.modes.expected);
    Ok(reading)
}

/// Largest relative difference of the condensed frequencies from those in full; `None` if nothing is condensed, or
/// there are no elastic modes to compare.
fn condensation_difference(stage: &CoupledStructure, full: &UnloadedModes, extent: ModeRange) -> Option<f64> {
    stage.housing.as_ref()?;
    let condensed: Vec<f64> = (0..stage.modes.count()).map(|mode| stage.modes.frequency_hz(mode)).collect();
    let largest = |first: usize| {
        let pairs = condensed.get(first..)?.iter().zip(&full.frequencies_hz);
        let differences = pairs.skip(full.rigid).map(|(own, full)| (own / full - 1.0).abs());
        differences.reduce(f64::max)
    };
    match extent {
        ModeRange::Count(_) | ModeRange::AtMost(_) | ModeRange::UpToHz(_) => largest(0),
        // how many modes lie below the band is not known: where they fit best
        ModeRange::BandHz(_) => {
            (0..=condensed.len().saturating_sub(full.frequencies_hz.len())).filter_map(largest).min_by(f64::total_cmp)
        }
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
