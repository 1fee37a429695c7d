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
mod error;
mod modal;
mod response;
mod system;

pub use band::{BandVariant, FrequencyGrid, RankedVariant, Resonance};
pub(crate) use band::{frequency_list, rank_in_band};
pub use error::FrfError;
pub use modal::{ModalBasis, ModalSuperposition, ModeShare, PathShares};
pub use response::{FrequencyResponse, FrfQuantity, direct_response};
pub use system::{FrfPaths, ModalDamping, ReducedSystem};

#[cfg(test)]
mod tests;
