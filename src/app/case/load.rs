//! Reading a case in stages.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::check::{BrokenRule, known_isotropic, known_material, report};
use super::document::{Document, Source};
use super::error::{CaseError, names_help, one_of};
use super::{BUILT_IN_MATERIALS, Case, Defect, HousingSource, IsotropicMaterial, Material, ReportDetails};

/// A variant of a case, read.
#[derive(Debug, Clone)]
pub struct VariantCase {
    /// What differs, in words.
    pub what: String,
    /// The whole case with the variant's keys set.
    pub case: Case,
}

/// What arguments may set where there is no case.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WithoutCase {
    #[serde(default)]
    report: Option<ReportDetails>,
}

impl ReportDetails {
    /// Entries of `KEY=VALUE` arguments for a command without a case, `report.customer=...`; `None` without any.
    ///
    /// # Errors
    /// [`CaseError`]: an argument that is none, another key than those of `report`, an entry that does not fit the report's head.
    pub(crate) fn of_arguments(set: &[String]) -> Result<Option<Self>, CaseError> {
        let source = Source { set: set.to_vec(), ..Source::default() };
        let document = Document::read(&source)?;
        let read: WithoutCase = document.decode()?;
        let checked = read.report.iter().try_for_each(report);
        checked.map_err(|broken| document.broken(&broken))?;
        Ok(read.report)
    }
}

impl Case {
    /// Reads a case file and applies `KEY=VALUE` arguments in order.
    ///
    /// A value is TOML; a bare word stands for itself. Items of arrays are reached by `[0]` or `.0`.
    ///
    /// # Errors
    /// [`CaseError`] when the file cannot be read, is not TOML, has unknown, missing or unsupported keys or values, or
    /// breaks a rule of `Case::validate`; the same for any of its variants.
    pub fn load(path: impl AsRef<Path>, set: &[String]) -> Result<Self, CaseError> {
        let path = path.as_ref();
        let text = crate::files::read_text(path)
            .map_err(|source| CaseError::new(format!("cannot read the case file {}: {source}", path.display())))?;
        Self::from_source(Source { path: path.to_owned(), text, set: set.to_vec() })
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
        let mut case: Self = document.decode()?;
        for built_in in BUILT_IN_MATERIALS {
            case.materials.entry(built_in.name.to_owned()).or_insert(built_in.as_given());
        }
        if let Some(folder) = source.path.parent() {
            for path in case.paths_mut() {
                *path = folder.join(&path);
            }
        }
        case.validate().map_err(|broken| document.broken(&broken))?;
        case.source = source;
        if case.title.is_empty() {
            case.title = case.name();
        }
        Ok(case)
    }

    /// Every file that the case names.
    pub(super) fn paths_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        let housing = self.housing.iter_mut().map(HousingSource::path_mut);
        let compared = self.modes.compare.iter_mut().map(|other| &mut other.file);
        let meshes = self.modes.convergence.iter_mut();
        let defects = self.bearing.iter_mut().flat_map(|bearing| &mut bearing.defects);
        housing
            .chain(compared)
            .chain(defects.filter_map(Defect::path_mut))
            .chain(meshes.flat_map(|convergence| &mut convergence.meshes))
    }

    /// Returns the variants under `modes.variants`: this case again, with the command line's and then the variant's
    /// keys set.
    ///
    /// # Errors
    /// [`CaseError`] when one of them is not a valid case. A case from [`Case::load`] has valid ones only.
    pub fn variants(&self) -> Result<Vec<VariantCase>, CaseError> {
        self.read_variants(&self.modes.variants, "modes.variants")
    }

    /// Returns the variants under `frf.variants`.
    ///
    /// # Errors
    /// As [`Case::variants`].
    pub(crate) fn frf_variants(&self) -> Result<Vec<VariantCase>, CaseError> {
        let variants = self.frf.as_ref().map_or(&[][..], |frf| &frf.variants);
        self.read_variants(variants, "frf.variants")
    }

    fn read_variants(&self, variants: &[super::Variant], key: &str) -> Result<Vec<VariantCase>, CaseError> {
        let read = |(index, variant): (usize, &super::Variant)| {
            let mut source = self.source.clone();
            source.set.extend(variant.set.iter().cloned());
            match Self::without_variants(source) {
                Ok(mut case) => {
                    case.contents.clone_from(&self.contents);
                    case.modes.variants.clear();
                    if let Some(frf) = &mut case.frf {
                        frf.variants.clear();
                    }
                    Ok(VariantCase { what: variant.what.clone(), case })
                }
                Err(error) => {
                    let place = self.place(&format!("{key}[{index}]"));
                    let what = format!("variant \"{}\": {error}", variant.what);
                    Err(CaseError::at(place, what).with_help(error.help()))
                }
            }
        };
        variants.iter().enumerate().map(read).collect()
    }

    /// Returns where a key was written: file and line, or `--set` argument.
    fn place(&self, key: &str) -> String {
        match Document::read(&self.source) {
            Ok(document) => document.place(key),
            Err(_) => self.source.path.display().to_string(),
        }
    }

    /// Says where the case breaks a rule.
    pub(crate) fn broken(&self, broken: &BrokenRule) -> CaseError {
        CaseError::broken(self.place(&broken.key), broken)
    }

    /// Returns the material that a key names.
    ///
    /// # Errors
    /// [`CaseError`] for a name that no material has, of a case that was changed after it was checked.
    pub(crate) fn known_material(&self, key: &str, name: &str) -> Result<&Material, CaseError> {
        known_material(self, key, name).map_err(|broken| self.broken(&broken))
    }

    /// Returns the material of a ring or a contact that a key names.
    ///
    /// # Errors
    /// As [`Case::known_material`], and for a material that is not isotropic or has a loss factor.
    pub(crate) fn isotropic(&self, key: &str, name: &str) -> Result<&IsotropicMaterial, CaseError> {
        known_isotropic(self, key, name).map_err(|broken| self.broken(&broken))
    }

    /// Checks that the mesh has every group that the case names.
    ///
    /// # Errors
    /// [`CaseError`] with the first that it lacks and the nearest that it has.
    pub fn check_groups(&self, groups: &[String]) -> Result<(), CaseError> {
        let missing = |(_, name): &(String, &str)| !groups.iter().any(|group| group == name);
        match self.groups().into_iter().find(missing) {
            None => Ok(()),
            Some((key, found)) => {
                let valid: Vec<&str> = groups.iter().map(String::as_str).collect();
                let what = format!("`{key}` is \"{found}\", expected {}", one_of(&valid));
                let help = names_help(found, &valid, "names");
                Err(CaseError::at(self.place(&key), what).with_help(Some(help)).with_valid(&valid))
            }
        }
    }
}
