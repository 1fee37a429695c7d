//! `plummer modes`: eigenfrequencies of housing, ring, or both, unloaded and loaded, the verification against
//! expected ones, and the shapes as other programs read them.

use super::comparison::{ComparedFile, FileComparison};
use super::convergence::{MeshConvergence, MeshSequence, mesh_convergence};
use crate::app::case::{Case, Linearise, Rule, SpatialCase};
use crate::app::commands::parts::ExpectedMode;
use crate::app::error::ComputeError;
use crate::app::scene::contacts::accept_contacts;
use crate::app::scene::structure::needed_modes;
use crate::app::scene::{
    AssembledHousing, CoupledStructure, MachineScene, RingsInHousing, bearing_setup, contrast, doubts, race_contacts,
};
use crate::fe::mesh::Mesh;
use crate::fe::modal::{FullModes, Mechanisms, ModalSurvey, ModeRange};
use crate::fe::model::HousingModel;
use crate::formats::ModeShapes;
use crate::numerics::linalg::LinalgError;
use crate::numerics::{Unwatched, Watch};
use crate::report::significant;
use crate::system::{BearingSetup, Equilibrium, LoadedModes, LoadedPass, StaticCondition, Statics};
use schemars::JsonSchema;
use serde::Serialize;
use std::sync::Arc;

/// One reading of a case: the case itself or one of its variants.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct Reading {
    /// What it changes; empty for the case itself.
    pub what: String,
    /// The keys that it sets.
    pub set: Vec<String>,
    /// Modes without contact in full, Hz, ascending, as many as asked for.
    #[serde(rename = "frequencies_hz")]
    pub unloaded_hz: Vec<f64>,
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
    /// Rings, and the housing around them.
    pub bodies: Option<RingsInHousing>,
    /// Number of vectors of the condensed housing's interior; `None` without loaded modes: nothing is condensed for others.
    pub fixed_interface_modes: Option<usize>,
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
    /// Nothing but the case itself.
    fn new(base: Reading, survey: ModalSurvey, doubts: Vec<String>) -> Self {
        Self {
            base,
            variants: Vec::new(),
            survey,
            bodies: None,
            fixed_interface_modes: None,
            housing: None,
            comparisons: Vec::new(),
            convergence: None,
            statics: None,
            loaded_pass: None,
            doubts,
        }
    }

    /// Mesh and model of the housing, if there is one.
    pub(crate) fn mesh_and_model(&self) -> Option<(&Mesh, &HousingModel)> {
        let alone = self.housing.as_ref().map(|(mesh, model)| (mesh, model));
        alone.or(self.bodies.as_ref().and_then(RingsInHousing::mesh_and_model))
    }

    /// Frequencies and shapes as other programs read them; the rings' nodes stand after those of the mesh.
    #[must_use]
    pub fn mode_shapes(&self) -> ModeShapes {
        mode_shapes(&self.survey, self.mesh_and_model())
    }

    /// That nothing is known of some modes, with the largest of their error bounds; `None` if all are known.
    pub(crate) fn unknown(&self) -> Option<String> {
        let basis = &self.survey.basis;
        let unknown = basis.unknown(self.survey.mechanisms.as_ref().map(Mechanisms::total));
        let largest = unknown.iter().map(|&mode| basis.error_bounds_hz[mode]).reduce(f64::max)?;
        Some(format!(
            "{} of {} eigenfrequencies are not known: round-off of the stiffness hides them, with error bounds up to {} Hz",
            unknown.len(),
            basis.count(),
            significant(largest, 2)
        ))
    }

    /// Whether every frequency is known, every expected one was found, and every comparison passes.
    pub(crate) fn passes(&self) -> bool {
        self.unknown().is_none()
            && self.base.expected.iter().all(|expected| expected.ok)
            && self.comparisons.iter().all(|comparison| comparison.ok)
    }
}

impl Reading {
    /// Nearest mode to a frequency among those that are not the balls' own, Hz.
    pub(crate) fn nearest_hz(&self, hz: f64) -> Option<f64> {
        match &self.loaded {
            Some(loaded) => loaded.nearest(hz).map(|mode| mode.frequency_hz),
            None => self.unloaded_hz.iter().copied().min_by(|a, b| (a - hz).abs().total_cmp(&(b - hz).abs())),
        }
    }

    /// With the expected frequencies of a case beside the nearest ones.
    fn judged(mut self, case: &Case) -> Self {
        let expected = case.modes.expected.iter();
        self.expected = expected.map(|expected| ExpectedMode::of(expected, self.nearest_hz(expected.hz))).collect();
        self
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
        result.convergence = mesh_convergence(case, sequence, &result.survey, housing, watch)?;
    }
    Ok(result)
}

fn own_modes(case: &Case, watch: &impl Watch) -> Result<ModesResult, ComputeError> {
    if !case.has_rings() {
        return housing_alone(case, watch);
    }
    let (mut loaded, mut statics, mut loaded_pass, mut fixed_interface_modes) = (None, None, None, None);
    let linearised = Linearised::of(case)?;
    let bodies = match &linearised {
        Linearised::Nothing => RingsInHousing::build(case, watch)?,
        Linearised::InSpace(spatial) => {
            let scene = MachineScene::build(spatial, [start_time(case); 2], watch)?;
            watch.stage("linearise");
            loaded = Some(scene.loaded_modes()?);
            fixed_interface_modes = Some(scene.stage.fixed_interface_modes);
            Arc::unwrap_or_clone(scene.stage).bodies
        }
        Linearised::InPlane(setup) => {
            let stage = CoupledStructure::around_rings(case, needed_modes(case), watch)?;
            let start = start_time(case);
            watch.stage("linearise");
            loaded = Some(loaded_modes(case, &stage, setup)?);
            statics = Some(Statics::compute(&stage.structure, setup, start)?);
            if case.modes.ball_pass {
                loaded_pass = Some(LoadedPass::compute((&stage.structure, &stage.modes), setup, start, watch)?);
            }
            fixed_interface_modes = Some(stage.fixed_interface_modes);
            stage.bodies
        }
    };
    let survey = bodies.survey(case.modes.extent, watch).map_err(asked_for(case))?;
    let unloaded_hz = survey.basis.frequencies_hz.clone();
    let base = Reading { unloaded_hz, loaded, ..Reading::default() }.judged(case);
    watch.stage("variants");
    let cases = case.variants()?;
    let mut variants = Vec::with_capacity(cases.len());
    for (index, variant) in cases.iter().enumerate() {
        watch.fraction(index as f64 / cases.len() as f64);
        let set = case.modes.variants[index].set.clone();
        let what = variant.what.clone();
        variants.extend(variant_reading(&variant.case)?.map(|reading| Reading { what, set, ..reading }));
    }
    let at_rest = statics.iter().flat_map(|statics| &statics.equilibria).next();
    let top_hz = survey.basis.frequencies_hz.iter().copied().fold(0.0, f64::max);
    let asked_hz = match case.modes.extent {
        ModeRange::UpToHz(top_hz) | ModeRange::BandHz([_, top_hz]) => top_hz,
        ModeRange::Count(_) | ModeRange::AtMost(_) => 0.0,
    };
    let beyond = bodies.imported.iter().filter_map(|imported| imported.doubt(top_hz.max(asked_hz)));
    let mut doubts = doubts(case, bodies.mesh_and_model(), linearised.setup().zip(at_rest))?;
    doubts.extend(beyond);
    let bodies = Some(bodies);
    let result = ModesResult::new(base, survey, doubts);
    Ok(ModesResult { variants, bodies, fixed_interface_modes, statics, loaded_pass, ..result })
}

fn housing_alone(case: &Case, watch: &impl Watch) -> Result<ModesResult, ComputeError> {
    let AssembledHousing { mesh, model, matrices } = AssembledHousing::of(case, watch)?;
    let survey = ModalSurvey::of_housing(&mesh, &model, matrices, case.modes.extent, watch)
        .map_err(|error| asked_for(case)(error.into()))?;
    let unloaded_hz = survey.basis.frequencies_hz.clone();
    let base = Reading { unloaded_hz, ..Reading::default() }.judged(case);
    let doubts = doubts(case, Some((&mesh, &model)), None)?;
    Ok(ModesResult { housing: Some((mesh, model)), ..ModesResult::new(base, survey, doubts) })
}

/// Names the place of the key that asks for more modes than the model has, or the parts whose stiffnesses are too far apart.
fn asked_for(case: &Case) -> impl FnOnce(ComputeError) -> ComputeError {
    move |error| match (case.modes.extent, error) {
        (ModeRange::Count(count), ComputeError::Linalg(LinalgError::TooManyModes { available, .. })) => {
            let expected = format!("at most {available}, as many as the model has");
            let rule = Rule::found(count, &expected).with_help(
                "ask for fewer, or leave `count` out, which then is 20 or all that there are; a finer mesh has more",
            );
            case.broken(&rule.at("modes.count")).into()
        }
        (
            _,
            ComputeError::Linalg(
                error @ (LinalgError::Iteration(_)
                | LinalgError::NotPositiveDefinite { .. }
                | LinalgError::NearlySingular { .. }
                | LinalgError::IllConditioned { .. }),
            ),
        ) => ComputeError::Failed { what: error.to_string(), help: contrast(case) },
        (_, error) => error,
    }
}

/// What modes are linearised with.
enum Linearised<'c> {
    Nothing,
    InPlane(Box<BearingSetup>),
    InSpace(Box<SpatialCase<'c>>),
}

impl<'c> Linearised<'c> {
    fn of(case: &'c Case) -> Result<Self, ComputeError> {
        if case.modes.linearise == Linearise::None {
            return Ok(Self::Nothing);
        }
        if let Some(spatial) = case.in_space("`modes.linearise = \"static\"`")? {
            return Ok(Self::InSpace(Box::new(spatial)));
        }
        Ok(bearing_setup(case)?.map_or(Self::Nothing, |setup| Self::InPlane(Box::new(setup))))
    }

    /// The bearing in its plane.
    fn setup(&self) -> Option<&BearingSetup> {
        match self {
            Self::InPlane(setup) => Some(setup),
            Self::Nothing | Self::InSpace(_) => None,
        }
    }
}

/// When the bearing is looked at, s.
fn start_time(case: &Case) -> f64 {
    let transient = case.transient.as_ref();
    transient.map_or(0.0, |transient| transient.start)
}

/// Frequencies of a variant; `None` without a ring.
fn variant_reading(case: &Case) -> Result<Option<Reading>, ComputeError> {
    if !case.has_rings() {
        return Ok(None);
    }
    let (bodies, loaded) = match Linearised::of(case)? {
        Linearised::Nothing => (RingsInHousing::build(case, &Unwatched)?, None),
        Linearised::InSpace(spatial) => {
            let scene = MachineScene::build(&spatial, [start_time(case); 2], &Unwatched)?;
            let loaded = scene.loaded_modes()?;
            (Arc::unwrap_or_clone(scene.stage).bodies, Some(loaded))
        }
        Linearised::InPlane(setup) => {
            let stage = CoupledStructure::around_rings(case, needed_modes(case), &Unwatched)?;
            let loaded = loaded_modes(case, &stage, &setup)?;
            (stage.bodies, Some(loaded))
        }
    };
    let full = FullModes::of(bodies.matrices()?, case.modes.extent, None, &Unwatched)
        .map_err(|error| asked_for(case)(error.into()))?;
    let reading = Reading { unloaded_hz: full.basis.frequencies_hz, loaded, ..Reading::default() };
    Ok(Some(reading.judged(case)))
}

/// Modes at the static equilibrium.
fn loaded_modes(case: &Case, stage: &CoupledStructure, setup: &BearingSetup) -> Result<LoadedModes, ComputeError> {
    let condition = StaticCondition::at(setup, start_time(case));
    let equilibrium = Equilibrium::find(&stage.structure, setup, condition)?;
    if let Some(contacts) = race_contacts(case)? {
        accept_contacts(setup, &contacts, &equilibrium)?;
    }
    Ok(LoadedModes::at(&stage.structure, &stage.modes, setup, &equilibrium)?)
}

/// Frequencies and shapes of a survey along the mesh's axes: all nodes of the mesh, then those of the rings.
fn mode_shapes(survey: &ModalSurvey, housing: Option<(&Mesh, &HousingModel)>) -> ModeShapes {
    let mut points = Vec::new();
    let mut shapes = vec![Vec::new(); survey.basis.count()];
    if let (Some((mesh, model)), Some(moved)) = (housing, &survey.housing) {
        points.extend(&mesh.nodes);
        let d = model.dimension();
        for (mode, shape) in shapes.iter_mut().enumerate() {
            for node in moved.col_as_slice(mode).chunks_exact(d) {
                // nothing moves across a plane
                shape.extend((0..3).map(|axis| node.get(axis).copied().unwrap_or(0.0)));
            }
        }
    }
    for ring in &survey.rings {
        points.extend(&ring.points);
        for (shape, moved) in shapes.iter_mut().zip(&ring.displacements) {
            shape.extend(moved.as_flattened());
        }
    }
    let node_tags = housing.filter(|_| survey.rings.is_empty()).map(|(mesh, _)| mesh.node_tags.clone());
    ModeShapes {
        frequencies_hz: survey.basis.frequencies_hz.clone(),
        node_tags,
        points: Some(points),
        shapes,
        directions: None,
    }
}

/// Computes the modes of a case, as many as it asks for, and nothing else: the mesh, if it has one, and the shapes.
///
/// # Errors
/// [`ComputeError`] of the stages that it goes through.
pub(crate) fn compute_mode_shapes(case: &Case, watch: &impl Watch) -> Result<(Option<Mesh>, ModeShapes), ComputeError> {
    let extent = case.modes.extent;
    if case.has_rings() {
        let bodies = RingsInHousing::build(case, watch)?;
        let survey = bodies.survey(extent, watch)?;
        let shapes = mode_shapes(&survey, bodies.mesh_and_model());
        return Ok((bodies.housing.map(|housing| housing.mesh), shapes));
    }
    let AssembledHousing { mesh, model, matrices } = AssembledHousing::of(case, watch)?;
    let survey = ModalSurvey::of_housing(&mesh, &model, matrices, extent, watch)?;
    let shapes = mode_shapes(&survey, Some((&mesh, &model)));
    Ok((Some(mesh), shapes))
}
