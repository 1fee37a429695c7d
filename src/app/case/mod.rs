//! The case file: what a user writes, read into types and checked before anything is computed.
//!
//! [`Case::load`] goes through these stages, each of which names file and line (or `--set KEY`), key, what was found
//! and what was expected:
//!
//! 1. text to a tree of values, every one with its line; `--set` arguments change single values;
//! 2. keys and values of the format that this version cannot honour are refused, never ignored;
//! 3. the tree becomes a [`Case`]; unknown keys and names come with the nearest valid one;
//! 4. `Case::validate`: ranges, and values that contradict each other;
//! 5. the same for each of [`Case::variants`].
//!
//! What a command needs is checked by [`Case::ready_for`] (of a run, its parts are in a [`RunCase`]), what the mesh must have by [`Case::check_groups`].
//! Everything is in SI units unless a name says otherwise (`_deg`, `_hz`); x points right, y up.
//!
//! A [`Case`] serialises to the form of the file, all defaults filled in: the echo that results carry.
//!
//! **Limitations**: the first error is reported, not all of them; of several commands only those of [`Purpose`] are
//! known here.

mod bearing;
#[cfg(test)]
mod bearing_tests;
mod built_in_materials;
mod check;
mod condense;
mod decode;
mod defect;
mod document;
mod envelope_band;
mod error;
mod frf;
mod housing;
mod load;
mod material;
mod modes;
mod motion;
mod named_bearing;
mod purpose;
mod report;
mod ring;
mod schema;
mod seat;
mod set;
mod spring;
mod taken_from;
#[cfg(test)]
mod tests;
mod transient;
mod tree;
mod union;
mod value;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use bearing::{Bearing, ContactStiffness, Preload, RaceMaterial, Slip, Wave};
pub(in crate::app) use built_in_materials::built_in_like;
pub use built_in_materials::{BUILT_IN_MATERIALS, BuiltInMaterial};
pub(crate) use check::short;
pub use check::{BrokenRule, Rule};
pub use condense::{Centre, Condense, FixedInterfaceModes, Interface, InterfaceModes};
pub use defect::{Defect, DentDefect, DentProfile, FlatDefect, MeasuredDefect, ProfileFile};
pub(in crate::app) use document::Document;
pub use document::Source;
pub use envelope_band::EnvelopeBand;
pub use error::CaseError;
pub use frf::{Frf, Push, Sensor, SensorSpot};
pub use housing::{Axis, Hold, Housing, HousingSource, Part, Support};
pub use load::VariantCase;
pub use material::{IsotropicMaterial, Material, OrthotropicMaterial};
pub use modes::{ComparedModes, ConvergenceMeshes, Expected, Linearise, Modes, Variant};
pub use motion::{Damping, Load, LoadPoint, RatioAt, Shaft, SpatialLoadPoint, Speed, UnbalanceAt};
pub(in crate::app) use named_bearing::{FIT, bearing_help, other_size};
pub use purpose::{AskedRun, Purpose, RunCase, SpatialCase};
pub use report::ReportDetails;
pub use ring::{Bond, Ring, RingSupport, Section, Tie};
pub(in crate::app) use schema::{file_schema, in_words};
pub use seat::{Seat, SeatedBearing};
pub use set::replaced_argument;
pub(crate) use set::split_argument;
pub use spring::Spring;
pub use transient::{Accuracy, Analysis, Ensemble, Method, ModesKept, ScalogramWindow, StepLength, Transient};

/// One case: everything that a command computes from, but the mesh.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("anyOf" = schema::one_of(&["housing", "ring", "bearing", "bearings"]), "allOf" = named_bearing::named_or_sections()))]
pub struct Case {
    /// What the case is about; the file's name where the file says nothing.
    #[serde(default)]
    pub title: String,
    /// For whom and by whom reports are made.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub report: Option<ReportDetails>,
    /// Materials by name, the built-in ones included: steel, bearing steel, 1.4301, EN-GJL-200, EN-GJL-250, EN-GJS-400-15, aluminium,
    /// cast aluminium, cast magnesium, brass, POM, PA66-GF30, silicon nitride (`plummer init --list-materials`).
    #[serde(default)]
    pub materials: BTreeMap<String, Material>,
    /// The housing; `None`: the ring on its springs alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub housing: Option<HousingSource>,
    /// The ring; `None`: the housing alone.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ring: Option<Ring>,
    /// Balls, races and contacts; or the name of a bearing of the catalogue, which gives them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[schemars(schema_with = "bearing::named_or_table")]
    pub bearing: Option<Bearing>,
    /// Several bearings in one housing, in the place of `ring` and `bearing`.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub bearings: Vec<SeatedBearing>,
    /// The shaft with the inner ring.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shaft: Option<Shaft>,
    /// Damping of ring and housing; `None`: undamped.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping: Option<Damping>,
    /// Shaft speed over time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub speed: Option<Speed>,
    /// Accelerometers.
    #[serde(default)]
    pub sensors: Vec<Sensor>,
    /// What the `modes` command computes.
    #[serde(default)]
    pub modes: Modes,
    /// How the housing is condensed.
    #[serde(default)]
    pub condense: Condense,
    /// Transfer paths.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frf: Option<Frf>,
    /// What the signals must be good for; see [`Case::band_hz`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// The simulation in time.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transient: Option<Transient>,
    /// What is made of the signals.
    #[serde(default)]
    pub analysis: Analysis,
    /// Where the case came from.
    #[serde(skip)]
    pub source: Source,
    /// Files that are at hand, by their resolved paths: what is here is not read from the disk.
    #[serde(skip)]
    pub(crate) contents: BTreeMap<PathBuf, Arc<[u8]>>,
}

/// Default of what is on unless it is switched off.
const fn yes() -> bool {
    true
}

impl Case {
    /// Returns a material by name, given or built in.
    #[must_use]
    pub fn material(&self, name: &str) -> Option<&Material> {
        self.materials.get(name)
    }

    /// Returns the mass of one ball in kg: given, or that of a full sphere, m = 4/3 pi rho_b^3 times the density.
    ///
    /// `None` without a bearing, or when its ball material is none of the case's (which `Case::validate` refuses).
    #[must_use]
    pub fn ball_mass(&self) -> Option<f64> {
        self.mass_of_ball(self.bearing.as_ref()?).ok()
    }

    /// The same of a bearing.
    pub(crate) fn mass_of_ball(&self, bearing: &Bearing) -> Result<f64, CaseError> {
        let volume = 4.0 / 3.0 * std::f64::consts::PI * bearing.ball_radius.powi(3);
        Ok(match (bearing.ball_mass, bearing.density) {
            (Some(mass), _) => mass,
            (None, Some(density)) => density * volume,
            (None, None) => {
                let material = self.known_material("bearing.ball_material", &bearing.ball_material)?;
                material.density() * volume
            }
        })
    }

    /// Returns the frequencies of interest in Hz, lowest first: those of `[accuracy]`, else from 0 to half the sampling
    /// rate; `None` when the case has neither.
    #[must_use]
    pub fn band_hz(&self) -> Option<[f64; 2]> {
        match (&self.accuracy, &self.transient) {
            (Some(accuracy), _) => Some(accuracy.band_hz),
            (None, Some(transient)) => Some([0.0, 0.5 * transient.output_hz]),
            (None, None) => None,
        }
    }

    /// The band, or that of the source paper's figures.
    pub(crate) fn band_or_default(&self) -> [f64; 2] {
        self.band_hz().unwrap_or([0.0, 40e3])
    }

    /// Returns the relative error that the frequencies in the band may have: that of `[accuracy]`, else 0.01.
    #[must_use]
    pub fn target(&self) -> f64 {
        self.accuracy.as_ref().map_or(0.01, |accuracy| accuracy.target)
    }

    /// Takes the content of a mesh file that the case names, so that it is not read from the disk. `file` is its name in
    /// the case.
    #[must_use]
    pub fn with_content(mut self, file: impl AsRef<Path>, content: Arc<[u8]>) -> Self {
        let path = self.source.path.parent().unwrap_or(Path::new("")).join(file);
        self.contents.insert(path, content);
        self
    }

    /// The content of a file that is at hand.
    pub(crate) fn content(&self, path: &Path) -> Option<&Arc<[u8]>> {
        self.contents.get(path)
    }

    /// Returns the case file's name without folder and ending, or `case` if it has none.
    #[must_use]
    pub fn name(&self) -> String {
        self.source.path.file_stem().map_or_else(|| "case".to_owned(), |stem| stem.to_string_lossy().into_owned())
    }
}
