//! Modes of a housing by itself, and how many of a structure's modes are rigid.

mod housing_modes;
mod rigid;

pub use housing_modes::{HousingModes, housing_modes};
pub use rigid::rigid_mode_count;
