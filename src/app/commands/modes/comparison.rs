//! Computed modes against those of a file: which belong together, and whether they agree.

use crate::app::case::{Case, ComparedModes};
use crate::app::error::ComputeError;
use crate::fe::mesh::Mesh;
use crate::fe::modal::{ComparisonOptions, MatchedBy, ModalComparison, ModalError, ModalSurvey, ModePair, ModeSet};
use crate::fe::model::HousingModel;
use crate::formats::{ModeShapes, read_mode_shapes_in};
use crate::numerics::linalg::DenseMatrix;
use crate::numerics::units::LengthUnit;
use schemars::JsonSchema;
use serde::Serialize;
use std::cmp::Ordering;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// What a pair of modes, or a mode without a partner, misses.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Miss {
    /// The shapes differ by more than the limit.
    Mac,
    /// The frequencies do.
    Frequency,
    /// A group of repeated modes has more modes on one side than on the other.
    Count,
    /// There is no partner.
    Partner,
}

impl Miss {
    /// In a few words, for tables.
    pub(crate) fn describe(self) -> &'static str {
        match self {
            Self::Mac => "MAC",
            Self::Frequency => "frequency",
            Self::Count => "number of modes",
            Self::Partner => "no partner",
        }
    }
}

/// Modes that belong together; indices count from 0 in each list of frequencies.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ComparedPair {
    /// Modes of this case; several are a group of repeated ones.
    pub here: Vec<usize>,
    /// Modes of the file.
    pub there: Vec<usize>,
    /// Mean frequency of this case's, Hz.
    pub here_hz: f64,
    /// Mean frequency of the file's, Hz.
    pub there_hz: f64,
    /// (here - there) / there; `None` for modes without stiffness, which have no frequency to speak of.
    pub relative_difference: Option<f64>,
    /// Squared cosine of the largest angle between the spaces that they span: the MAC for one mode each.
    pub mac: f64,
    /// Mean squared cosine.
    pub mean_mac: f64,
    /// What it misses; empty: it passes.
    pub misses: Vec<Miss>,
}

/// A mode without a partner.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LoneMode {
    /// Index from 0 in its list of frequencies.
    pub mode: usize,
    /// Its frequency, Hz.
    pub hz: f64,
    /// Whether its partner would be within what the other side covers: then it counts as missing.
    pub missing: bool,
}

/// The points that were compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct ComparedPoints {
    /// How they were found.
    pub by: MatchedBy,
    /// Number of common points.
    pub matched: usize,
    /// Points of this case.
    pub here: usize,
    /// Points of the file.
    pub there: usize,
    /// Largest distance of two that were taken as one, m.
    pub largest_distance_m: f64,
}

/// The modes of a case against those of a file.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct FileComparison {
    /// The file.
    pub file: PathBuf,
    /// Where its modes come from.
    pub what: String,
    /// Smallest MAC that passes.
    pub mac_limit: f64,
    /// Largest relative difference of frequencies that passes.
    pub within: f64,
    /// Which points were compared.
    pub points: ComparedPoints,
    /// Frequencies of the file, Hz.
    pub there_hz: Vec<f64>,
    /// What belongs together, by frequency.
    pub pairs: Vec<ComparedPair>,
    /// Modes of this case without a partner.
    pub lone_here: Vec<LoneMode>,
    /// Modes of the file without a partner.
    pub lone_there: Vec<LoneMode>,
    /// MAC of every mode of this case with every one of the file, by row.
    pub mac: Vec<Vec<f64>>,
    /// Whether every pair passes, no mode is missing, and there is a pair at all.
    pub ok: bool,
}

impl FileComparison {
    /// Modes of this case that agree, and those that were judged.
    pub(crate) fn agreeing(&self) -> [usize; 2] {
        let of = |pair: &ComparedPair| pair.here.len();
        let passed = self.pairs.iter().filter(|pair| pair.misses.is_empty()).map(of).sum();
        let missing = self.lone_here.iter().filter(|mode| mode.missing).count();
        [passed, self.pairs.iter().map(of).sum::<usize>() + missing]
    }

    /// Modes of the file that this case should have and has not.
    pub(crate) fn missing_here(&self) -> usize {
        self.lone_there.iter().filter(|mode| mode.missing).count()
    }
}

/// A file that was read, with what is asked of it.
pub(crate) struct ComparedFile<'c> {
    asked: &'c ComparedModes,
    modes: ModeShapes,
}

impl<'c> ComparedFile<'c> {
    /// Reads every file that the case names, before anything is computed.
    ///
    /// # Errors
    /// [`ComputeError::ModeShapes`] with file and line.
    pub(crate) fn read_all(case: &'c Case) -> Result<Vec<Self>, ComputeError> {
        let read = |asked: &'c ComparedModes| {
            let of_mesh = case.meshed_housing().map(|housing| housing.length_unit);
            let metres = asked.length_unit.or(of_mesh).map_or(1.0, LengthUnit::to_metres);
            let modes = read_mode_shapes_in(&asked.file, metres).map_err(ComputeError::ModeShapes)?;
            Ok(Self { asked, modes })
        };
        case.modes.compare.iter().map(read).collect()
    }

    /// Compares with what was computed.
    ///
    /// # Errors
    /// [`ComputeError::Input`] for points that do not meet the model's.
    pub(crate) fn compare(
        &self,
        survey: &ModalSurvey,
        housing: Option<(&Mesh, &HousingModel)>,
    ) -> Result<FileComparison, ComputeError> {
        let (asked, check) = (self.asked, survey.basis.count_check);
        let covered = [check.above_hz.unwrap_or(0.0), check.below_hz];
        let own = &Side { set: survey.mode_set(housing), covers_hz: covered };
        let there = placed(&asked.file, &self.modes, housing.map(|(mesh, _)| mesh))?;
        let failed = |source: ModalError| {
            ComputeError::Input {
            what: format!("{}: {source}", asked.file.display()),
            help: matches!(source, ModalError::TooFewPoints { .. }).then(|| {
                "points are in m; `points_within` beside `file` is the distance up to which two are one, `length_unit` the unit of a .frd file".to_owned()
            }),
        }
        };
        let mut options = ComparisonOptions::default();
        // what passes must be paired
        options.least_mac = options.least_mac.min(asked.mac);
        if let Some(distance) = asked.points_within {
            options.point_tolerance = (distance / own.set.diagonal()).min(1.0);
        }
        let found = ModalComparison::new(&own.set, &there, options).map_err(failed)?;
        let frequencies = there.frequencies_hz.iter();
        let ends = [f64::INFINITY, f64::NEG_INFINITY];
        let covered = frequencies.fold(ends, |[low, high], &hz| [low.min(hz), high.max(hz)]);
        let there = Side { set: there, covers_hz: covered };
        let rigid = survey.basis.rigid_modes;
        let pairs = found.pairs.iter().map(|pair| compared(asked, pair, [own, &there], rigid));
        let pairs: Vec<ComparedPair> = pairs.collect();
        let lone_here = own.lone(&found.unpaired_here, &there, asked.within);
        let lone_there = there.lone(&found.unpaired_there, own, asked.within);
        let missing = lone_here.iter().chain(&lone_there).any(|mode| mode.missing);
        let passed = pairs.iter().all(|pair| pair.misses.is_empty());
        Ok(FileComparison {
            file: asked.file.clone(),
            what: asked.name(),
            mac_limit: asked.mac,
            within: asked.within,
            points: ComparedPoints {
                by: found.points.by,
                matched: found.points.pairs.len(),
                here: own.set.points.len(),
                there: there.set.points.len(),
                largest_distance_m: found.points.largest_distance,
            },
            mac: (0..found.mac.nrows()).map(|row| found.mac.row(row).iter().copied().collect()).collect(),
            ok: passed && !missing && !pairs.is_empty(),
            pairs,
            lone_here,
            lone_there,
            there_hz: there.set.frequencies_hz,
        })
    }
}

/// Modes, and the frequencies between which none is left out.
struct Side {
    set: ModeSet,
    covers_hz: [f64; 2],
}

impl Side {
    /// Whether a partner of a mode of the other side would be among these: not above what they cover, be it as much
    /// higher as the limit allows.
    fn covers(&self, hz: f64, within: f64) -> bool {
        let [low, high] = self.covers_hz;
        hz >= low && hz * (1.0 + within) <= high
    }

    /// Those of its modes without a partner among those of the `other` side.
    fn lone(&self, modes: &[usize], other: &Self, within: f64) -> Vec<LoneMode> {
        let of = |&mode: &usize| {
            let hz = self.set.frequencies_hz[mode];
            LoneMode { mode, hz, missing: other.covers(hz, within) }
        };
        modes.iter().map(of).collect()
    }

    fn mean(&self, modes: &[usize]) -> f64 {
        let sum: f64 = modes.iter().map(|&mode| self.set.frequencies_hz[mode]).sum();
        sum / modes.len().max(1) as f64
    }
}

/// A pair, and what it misses; the first `rigid` modes of this case have no stiffness.
fn compared(asked: &ComparedModes, pair: &ModePair, [own, there]: [&Side; 2], rigid: usize) -> ComparedPair {
    let within = asked.within;
    let [here_hz, there_hz] = [own.mean(&pair.here), there.mean(&pair.there)];
    // a motion without stiffness has a frequency of round-off: it must be small beside the first elastic one
    let first = own.set.frequencies_hz.get(rigid);
    let rigid = pair.here.iter().all(|&mode| mode < rigid);
    let difference = (!rigid && there_hz > 0.0).then(|| here_hz / there_hz - 1.0);
    let agrees = match difference {
        Some(difference) => difference.abs() <= within,
        None => rigid && first.is_none_or(|first| there_hz <= within * first),
    };
    let short = match pair.here.len().cmp(&pair.there.len()) {
        Ordering::Equal => false,
        Ordering::Less => own.covers(there_hz, within),
        Ordering::Greater => there.covers(here_hz, within),
    };
    let [here, there] = [&pair.here, &pair.there].map(|modes| {
        let mut modes = modes.clone();
        modes.sort_unstable();
        modes
    });
    let misses = [(pair.mac < asked.mac, Miss::Mac), (!agrees, Miss::Frequency), (short, Miss::Count)];
    ComparedPair {
        here,
        there,
        here_hz,
        there_hz,
        relative_difference: difference,
        mac: pair.mac,
        mean_mac: pair.mean_mac,
        misses: misses.into_iter().filter(|miss| miss.0).map(|miss| miss.1).collect(),
    }
}

/// Modes of a file at points: its own, or those of the nodes of `mesh` that it names.
///
/// # Errors
/// [`ComputeError::Input`] if neither gives their places.
fn placed(file: &Path, modes: &ModeShapes, mesh: Option<&Mesh>) -> Result<ModeSet, ComputeError> {
    let unknown =
        |found: &str| ComputeError::wrong(format!("{}: expected mode shapes at points, found {found}", file.display()));
    // index in the file of each point, and where it is
    let (rows, points): (Vec<usize>, Vec<[f64; 3]>) = match (&modes.points, &modes.node_tags, mesh) {
        (Some(points), ..) => (0..points.len()).zip(points.iter().copied()).unzip(),
        (None, Some(tags), Some(mesh)) => {
            let places: HashMap<u64, usize> = mesh.node_tags.iter().copied().zip(0..).collect();
            let known = |(row, tag): (usize, &u64)| Some((row, mesh.nodes[*places.get(tag)?]));
            tags.iter().enumerate().filter_map(known).unzip()
        }
        (None, Some(_), None) => return Err(unknown("node labels, and the case has no mesh")),
        (None, None, _) => return Err(unknown("neither points nor node labels")),
    };
    let tags = modes.node_tags.as_ref();
    Ok(ModeSet {
        frequencies_hz: modes.frequencies_hz.clone(),
        node_tags: tags.map(|tags| rows.iter().map(|&row| tags[row]).collect()),
        directions: modes.directions.as_ref().map(|all| rows.iter().map(|&row| all[row]).collect()),
        shapes: DenseMatrix::from_fn(3 * rows.len(), modes.count_modes(), |row, mode| {
            modes.shapes[mode][3 * rows[row / 3] + row % 3]
        }),
        points,
    })
}

#[cfg(test)]
mod tests;
