//! Who factorises a matrix: our own factor where it fits into the memory; MUMPS, where the program is built with it, if it does
//! not or if several processes compute together.

use super::symbolic::{Symbolic, analysed};
use super::{LinalgError, SymmetricMatrix};
#[cfg(feature = "mumps")]
use super::{
    memory::{self, SMALL},
    mumps::{self, Way},
};
use schemars::JsonSchema;
use serde::Serialize;

/// Who factorised in the place of our own factor.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, JsonSchema)]
pub struct FactorChoice {
    /// Library and how it keeps factors.
    pub by: String,
    /// Why.
    pub why: String,
}

impl FactorChoice {
    /// It as a sentence.
    pub(crate) fn sentence(&self) -> String {
        format!("factorised by {}: {}", self.by, self.why)
    }
}

/// Who factorises all matrices of one pattern.
#[derive(Debug)]
pub(super) enum Plan {
    /// Our own factor, with where its entries are.
    Own(Symbolic),
    /// MUMPS.
    #[cfg(feature = "mumps")]
    Mumps {
        /// Number of rows.
        order: usize,
        /// How it keeps a factor in single precision.
        way: Way,
        /// Why not our own.
        why: String,
    },
}

/// Variable that says who factorises: `own`, `mumps`, `mumps-low-rank`, `mumps-out-of-core`.
const CHOICE: &str = "PLUMMER_FACTOR";

/// Share of the memory that is free up to which a factor of low rank may take it, and of what a limit of the process leaves any factor:
/// fronts and the iteration's vectors need the rest.
#[cfg(feature = "mumps")]
const SHARE: f64 = 0.5;

/// Entries of a factor of low rank beside those of the whole one.
#[cfg(feature = "mumps")]
const COMPRESSED: f64 = 0.5;

/// Who is asked to factorise.
#[cfg(feature = "mumps")]
enum Asked {
    Nobody,
    Own,
    Mumps(Way, &'static str),
}

#[cfg(feature = "mumps")]
fn asked() -> Result<Asked, LinalgError> {
    let asked = std::env::var_os(CHOICE).unwrap_or_default();
    Ok(match asked.to_string_lossy().as_ref() {
        "" => Asked::Nobody,
        "own" => Asked::Own,
        "mumps" => Asked::Mumps(Way::InCore, "mumps"),
        "mumps-low-rank" => Asked::Mumps(Way::LowRank, "mumps-low-rank"),
        "mumps-out-of-core" => Asked::Mumps(Way::OutOfCore, "mumps-out-of-core"),
        other => {
            return Err(LinalgError::Refused(format!(
                "the variable {CHOICE} is \"{other}\"; expected own, mumps, mumps-low-rank or mumps-out-of-core"
            )));
        }
    })
}

/// Checks the variables that say who factorises, and where files of a factor are written.
///
/// # Errors
/// [`LinalgError::Refused`] for a choice that is none, or a folder that cannot be written.
#[cfg(feature = "mumps")]
pub(crate) fn check_asked() -> Result<(), LinalgError> {
    match asked()? {
        Asked::Own | Asked::Mumps(Way::InCore, _) => Ok(()),
        Asked::Nobody | Asked::Mumps(..) => mumps::check_root(),
    }
}

/// Refuses a choice that this build cannot serve.
///
/// # Errors
/// [`LinalgError::Refused`] for any but our own factor.
#[cfg(not(feature = "mumps"))]
pub(crate) fn check_asked() -> Result<(), LinalgError> {
    match std::env::var_os(CHOICE) {
        Some(asked) if !asked.is_empty() && asked != "own" => Err(LinalgError::Refused(format!(
            "the variable {CHOICE} is \"{}\", and this plummer is built without MUMPS; expected own; unset the variable, or build with --features mumps",
            asked.to_string_lossy()
        ))),
        _ => Ok(()),
    }
}

impl Plan {
    /// Analyses the pattern of a matrix in the order in which it is factorised, and says who does it.
    ///
    /// # Errors
    /// [`LinalgError::TooLarge`] for a factor that does not fit, unless MUMPS is there; [`LinalgError::Factorisation`] if memory
    /// does not suffice for the analysis; [`LinalgError::Refused`] for a choice that is none.
    pub(super) fn of(a: &SymmetricMatrix) -> Result<Self, LinalgError> {
        #[cfg(feature = "mumps")]
        return Self::chosen(a);
        #[cfg(not(feature = "mumps"))]
        analysed(a).map(Self::Own)
    }

    #[cfg(feature = "mumps")]
    fn chosen(a: &SymmetricMatrix) -> Result<Self, LinalgError> {
        let order = a.order();
        let by_mumps = |way: Way, why: String| Ok(Self::Mumps { order, way, why });
        match asked()? {
            Asked::Own => return analysed(a).map(Self::Own),
            Asked::Mumps(way, name) => return by_mumps(way, format!("{CHOICE}={name} asks for it")),
            Asked::Nobody => {}
        }
        let ranks = mumps::ranks();
        let too_large = |entries: u64, limit: String| {
            // fronts of full rank are allocated at once, which a limit of the process does not bear
            let fits = memory::available().is_none_or(|room| {
                let free = room.bytes as f64 * ranks as f64;
                !room.is_of_process() && COMPRESSED * 4.0 * (entries as f64) < SHARE * free
            });
            let way = if fits { Way::LowRank } else { Way::OutOfCore };
            by_mumps(way, format!("the factor's {entries} entries do not fit: {limit}"))
        };
        let own = match analysed(a) {
            Err(LinalgError::TooLarge { entries, limit, .. }) => return too_large(entries, limit),
            own => own?,
        };
        let bytes = memory::bytes_of(own.entries()) as f64;
        let narrow = |room: &memory::Room| room.is_of_process() && bytes > SHARE * room.bytes as f64;
        if let Some(room) = memory::available().filter(narrow) {
            return too_large(own.entries() as u64, format!("{room}, and the work beside them takes as much again"));
        }
        if ranks > 1 && own.entries() > SMALL {
            return by_mumps(Way::InCore, format!("{ranks} processes compute together"));
        }
        Ok(Self::Own(own))
    }

    /// Who factorises, if not our own factor.
    pub(super) fn choice(&self) -> Option<FactorChoice> {
        match self {
            Self::Own(_) => None,
            #[cfg(feature = "mumps")]
            Self::Mumps { way, why, .. } => Some(FactorChoice { by: format!("MUMPS, {way}"), why: why.clone() }),
        }
    }

    /// Number of rows.
    pub(super) fn order(&self) -> usize {
        match self {
            Self::Own(symbolic) => symbolic.order(),
            #[cfg(feature = "mumps")]
            Self::Mumps { order, .. } => *order,
        }
    }

    /// Where the entries of our own factor are.
    #[cfg(test)]
    pub(super) fn own(&self) -> &Symbolic {
        match self {
            Self::Own(symbolic) => symbolic,
            #[cfg(feature = "mumps")]
            Self::Mumps { .. } => panic!("a factor of our own was expected"),
        }
    }

    /// Number of entries of a factor; those of MUMPS, which are not known, count as more than any.
    pub(super) fn entries(&self) -> usize {
        match self {
            Self::Own(symbolic) => symbolic.entries(),
            #[cfg(feature = "mumps")]
            Self::Mumps { .. } => usize::MAX,
        }
    }
}
