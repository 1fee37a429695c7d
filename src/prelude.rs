//! What most programs on this library need: `use plummer::prelude::*;`.

pub use crate::app::case::Case;
pub use crate::app::commands::analyze::{WindowAnalysis, compute_analysis};
pub use crate::app::commands::computed::Computed;
pub use crate::app::commands::condense::{Comparison, compute_condense, superelement_record};
pub use crate::app::commands::frf::compute_frf;
pub use crate::app::commands::modes::compute_modes;
pub use crate::app::commands::run::compute_run;
pub use crate::app::error::ComputeError;
pub use crate::fe::assembly::SystemMatrices;
pub use crate::fe::material::Material;
pub use crate::fe::mesh::Mesh;
pub use crate::fe::modal::{ModalBasis, ModeRange};
pub use crate::fe::model::{Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport};
pub use crate::formats::{read_superelement_npz, write_superelement_npz};
pub use crate::numerics::units::LengthUnit;
pub use crate::numerics::{Unwatched, Watch};
pub use crate::signal::diagnosis::{Conclusion, Fault};
