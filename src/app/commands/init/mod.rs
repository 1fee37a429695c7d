//! `plummer init`: a commented case file from a mesh.

pub(crate) mod bore;
pub(crate) mod draft;
mod entities;
pub(crate) mod found;
pub(crate) mod groups;
pub(crate) mod page;
mod partly;
pub(crate) mod pit;
pub(crate) mod run_text;
pub(crate) mod scene;
pub(crate) mod seat;
mod shaft;
pub(crate) mod summary;
#[cfg(test)]
mod tests;
pub(crate) mod text;

pub use draft::{Draft, DraftBearing};
pub use found::DraftRequest;
pub use seat::FoundCylinder;
pub use summary::{CatalogueEntry, CatalogueResult, DraftResult, MaterialSummary, MaterialsResult};
