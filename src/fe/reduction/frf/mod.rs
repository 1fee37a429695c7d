//! Frequency response of small dense systems: condensed housings, rings, or any set of modes.
//!
//! From matrices ([`ReducedSystem`]) and where forces act and motions are read ([`FrfPaths`]) to receptance, mobility or
//! accelerance over frequency ([`FrequencyResponse`]): directly for any damping ([`direct_response`]), or as a sum of
//! modes ([`ModalSuperposition`]) that says which mode carries a path. `frequency_list` chooses the frequencies,
//! `rank_in_band` compares variants. Amplitudes follow `exp(+i w t)`.
//!
//! **Limitations**: one dense factorisation for each frequency in the direct method; modal superposition neglects what
//! damping couples between modes.

mod band;
mod damping;
mod direct;
mod error;
mod list;
mod modal;
mod response;
mod share;
mod system;

pub(crate) use band::rank_in_band;
pub use band::{BandVariant, RankedVariant};
pub use damping::ModalDamping;
pub use direct::direct_response;
pub use error::FrfError;
pub(crate) use list::frequency_list;
pub use list::{FrequencyGrid, Resonance};
pub use modal::{ModalBasis, ModalSuperposition};
pub use response::{FrequencyResponse, FrfQuantity};
pub use share::{ModeShare, PathShares};
pub use system::{FrfPaths, ReducedSystem};

#[cfg(test)]
mod tests;
