//! Reading a case in stages, and what a command needs of it.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::check::{BrokenRule, groups_of};
use super::document::{Document, Source};
use super::error::{CaseError, Place};
use super::nearest::Choices;
use super::{Case, Defect, HousingSource, Interface, Linearise, material};

/// What a case is to be used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Eigenfrequencies.
    Modes,
    /// A condensed housing.
    Condense,
    /// Transfer paths.
    Frf,
    /// The simulation in time.
    Run,
    /// Speed against accuracy of the simulation.
    Chart,
}

/// A variant of a case, read.
#[derive(Debug, Clone)]
pub struct VariantCase {
    /// What differs, in words.
    pub what: String,
    /// The whole case with the variant's keys set.
    pub case: Case,
}

impl Case {
    /// Reads a case file and applies `KEY=VALUE` arguments in order.
    ///
    /// A value is TOML; a bare word stands for itself. Items of arrays are reached by `[0]` or `.0`.
    ///
    /// # Errors
    /// [`CaseError`] when the file cannot be read, is not TOML, has unknown, missing or unsupported keys or values, or
    /// breaks a rule of [`Case::validate`]; the same for any of its variants.
    pub fn load(path: impl AsRef<Path>, set: &[String]) -> Result<Self, CaseError> {
        let path = path.as_ref();
        let text = crate::files::read_text(path).map_err(|source| CaseError::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::from_source(Source {
            path: path.to_owned(),
            text,
            set: set.to_vec(),
        })
    }

    /// Reads a case from text that is at hand; see [`Case::load`].
    ///
    /// # Errors
    /// As [`Case::load`], but for reading the file.
    pub fn from_source(source: Source) -> Result<Self, CaseError> {
        let case = Self::without_variants(source)?;
        case.variants()?;
        case.frf_variants()?;
        Ok(case)
    }

    fn without_variants(source: Source) -> Result<Self, CaseError> {
        let document = Document::read(&source)?;
        let mut case = Self::deserialize(&document.root).map_err(|fault| document.error(fault))?;
        material::add_built_in(&mut case.materials);
        if let Some(folder) = source.path.parent() {
            for path in case.paths_mut() {
                *path = folder.join(&path);
            }
        }
        case.validate()
            .map_err(|BrokenRule { key, rule }| CaseError::Rule {
                place: document.place(&key),
                key,
                rule,
            })?;
        case.source = source;
        if case.title.is_empty() {
            case.title = case.name();
        }
        Ok(case)
    }

    /// Every file that the case names.
    fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let housing = self.housing.iter_mut().map(HousingSource::path_mut);
        let compared = self.modes.compare.iter_mut().map(|other| &mut other.file);
        let meshes = self.modes.convergence.iter_mut();
        let defects = self
            .bearing
            .iter_mut()
            .flat_map(|bearing| &mut bearing.defects);
        housing
            .chain(compared)
            .chain(defects.filter_map(Defect::path_mut))
            .chain(meshes.flat_map(|convergence| &mut convergence.meshes))
    }

    /// Returns the variants under `modes.variants`: this case again, with the command line's and then the variant's
    /// keys set.
    ///
    /// # Errors
    /// [`CaseError::Variant`] when one of them is not a valid case. A case from [`Case::load`] has valid ones only.
    pub fn variants(&self) -> Result<Vec<VariantCase>, CaseError> {
        self.read_variants(&self.modes.variants, "modes.variants")
    }

    /// Returns the variants under `frf.variants`.
    ///
    /// # Errors
    /// As [`Case::variants`].
    pub fn frf_variants(&self) -> Result<Vec<VariantCase>, CaseError> {
        let variants = self.frf.as_ref().map_or(&[][..], |frf| &frf.variants);
        self.read_variants(variants, "frf.variants")
    }

    fn read_variants(
        &self,
        variants: &[super::Variant],
        key: &str,
    ) -> Result<Vec<VariantCase>, CaseError> {
        let read = |(index, variant): (usize, &super::Variant)| {
            let mut source = self.source.clone();
            source.set.extend(variant.set.iter().cloned());
            match Self::without_variants(source) {
                Ok(mut case) => {
                    case.modes.variants.clear();
                    if let Some(frf) = &mut case.frf {
                        frf.variants.clear();
                    }
                    Ok(VariantCase {
                        what: variant.what.clone(),
                        case,
                    })
                }
                Err(error) => Err(CaseError::Variant {
                    place: self.place(&format!("{key}[{index}]")),
                    what: variant.what.clone(),
                    source: Box::new(error),
                }),
            }
        };
        variants.iter().enumerate().map(read).collect()
    }

    /// Returns where a key was written: file and line, or `--set` argument.
    #[must_use]
    pub fn place(&self, key: &str) -> Place {
        match Document::read(&self.source) {
            Ok(document) => document.place(key),
            Err(_) => Place::File {
                path: self.source.path.clone(),
            },
        }
    }

    /// Checks that the case has the tables that a purpose needs.
    ///
    /// # Errors
    /// [`CaseError::MissingTable`] with the first table that it lacks.
    pub fn ready_for(&self, purpose: Purpose) -> Result<(), CaseError> {
        let bearing_and_shaft = [
            ("[ring]", self.ring.is_some()),
            ("[bearing]", self.bearing.is_some()),
            ("[shaft]", self.shaft.is_some()),
        ];
        let held = self
            .ring
            .as_ref()
            .is_some_and(|ring| !ring.supports.is_empty())
            || (self.meshed_housing()).is_some_and(|housing| !housing.supports.is_empty())
            // what holds it is in its stiffness
            || self.superelement().is_some();
        let equilibrium = ("a support in [housing] or [ring]", held);
        let tied = self.ring.as_ref().is_some_and(|ring| ring.tie.is_some());
        let (needed_by, needed) = match purpose {
            Purpose::Frf => (
                "`frf`",
                vec![
                    ("[housing]", self.housing.is_some()),
                    ("[frf]", self.frf.is_some()),
                    ("[[sensors]]", !self.sensors.is_empty()),
                    (
                        "[damping], or loss_factor of a material",
                        self.damping.is_some() || self.has_loss_factor(),
                    ),
                    (
                        "ring.tie, or condense.interface = { nodes = [TAGS] }",
                        tied || self.superelement().is_some()
                            || self.condense.interface != Interface::Ring,
                    ),
                ],
            ),
            Purpose::Condense => (
                "`condense`",
                vec![
                    ("[housing]", self.housing.is_some()),
                    (
                        "ring.tie, or condense.interface = { group = \"NAME\" }",
                        tied || self.superelement().is_some()
                            || self.condense.interface != Interface::Ring,
                    ),
                ],
            ),
            Purpose::Modes => match self.modes.linearise {
                Linearise::None => return Ok(()),
                Linearise::Static => (
                    "`modes.linearise = \"static\"`",
                    [&bearing_and_shaft[..], &[equilibrium]].concat(),
                ),
            },
            Purpose::Run | Purpose::Chart => (
                if purpose == Purpose::Run {
                    "`run`"
                } else {
                    "`chart`"
                },
                [
                    &bearing_and_shaft[..],
                    &[
                        equilibrium,
                        ("[speed]", self.speed.is_some()),
                        ("[transient]", self.transient.is_some()),
                        ("[[sensors]]", !self.sensors.is_empty()),
                    ],
                ]
                .concat(),
            ),
        };
        match needed.iter().find(|(_, present)| !present) {
            None => Ok(()),
            Some(&(table, _)) => Err(CaseError::MissingTable {
                place: Place::File {
                    path: self.source.path.clone(),
                },
                table,
                needed_by,
            }),
        }
    }

    /// Whether a part of the housing is of a material with a loss factor.
    fn has_loss_factor(&self) -> bool {
        let mut parts = self
            .meshed_housing()
            .into_iter()
            .flat_map(|housing| &housing.parts);
        parts.any(|part| {
            let material = self.material(&part.material);
            material.is_some_and(|material| material.loss_factor() > 0.0)
        })
    }

    /// Checks that the mesh has every physical group that the case names.
    ///
    /// # Errors
    /// [`CaseError::UnknownName`] with the first that it lacks and the nearest that it has.
    pub fn check_groups(&self, groups: &[String]) -> Result<(), CaseError> {
        let missing = |(_, name): &(String, &str)| !groups.iter().any(|group| group == name);
        match groups_of(self).into_iter().find(missing) {
            None => Ok(()),
            Some((key, found)) => Err(CaseError::UnknownName {
                place: self.place(&key),
                key,
                names: Box::new(Choices::new(found, groups.to_vec())),
                found: found.to_owned(),
            }),
        }
    }
}
