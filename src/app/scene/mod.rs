//! A checked case as domain objects: bearing, housing, ring, structure, modes.
//!
//! A case comes in, with the files that it names; objects of `fe`, `bearing` and `system` go out. A [`Scene`] is all that a run simulates
//! and where it starts, a [`CoupledStructure`] ring and housing alone, a [`CondensedHousing`] a superelement and what it was made from.
//! Read `at_rest.rs` first, then `structure.rs`.

pub(crate) mod at_rest;
pub(crate) mod bearing;
mod centres;
pub(crate) mod condensed;
pub(crate) mod contact_damping;
pub(crate) mod contacts;
pub(crate) mod damping;
mod deck;
pub(crate) mod doubts;
mod fit;
#[cfg(test)]
mod free_system_tests;
pub(crate) mod housing;
pub(crate) mod imported;
#[cfg(test)]
mod imported_tests;
pub(crate) mod in_full;
mod kept;
pub(crate) mod machine;
mod machine_checks;
pub(crate) mod places;
mod plausible;
pub(crate) mod ring;
pub(crate) mod spatial;
mod start;
pub(crate) mod structure;
pub mod tie_price;

pub use at_rest::{RunModel, Scene};
pub use bearing::bearing_setup;
pub(crate) use bearing::{bearing_geometry, race_contacts};
pub use centres::{Centres, RingsAndCentres};
pub use condensed::CondensedHousing;
pub(crate) use doubts::{doubts, doubts_of_case};
pub use housing::AssembledHousing;
pub(crate) use housing::{description, mesh_digests, read_mesh};
pub use imported::ImportedHousing;
pub use in_full::RingsInHousing;
pub use machine::MachineScene;
pub(crate) use plausible::{contrast, size_doubt};
pub use ring::Boundary;
pub use structure::{CoupledStructure, FreeSystem};
