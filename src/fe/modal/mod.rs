//! Modes of a housing by itself, and what can be said of modes: which are rigid and why, the mass that each sets in
//! motion, where its energy is, which mode of another set it is, and how far the mesh is from its limit.
//!
//! Everything takes matrices, shapes and lists, and returns data; modes are columns over all degrees of freedom, zero
//! where the model is fixed, tied nodes filled in ([`over_all_dofs`]).

mod basis;
mod comparison;
mod convergence;
mod energy_shares;
mod error;
mod full_modes;
mod mass_properties;
mod mechanisms;
mod mode_shapes;
mod motions;
#[cfg(test)]
#[path = "samples_tests.rs"]
mod samples;
mod strain_products;
mod survey;

pub use basis::{FrequencyCount, ModalBasis, ModeRange};
pub use comparison::{ComparisonOptions, MatchedBy, ModalComparison, ModePair, ModeSet, PointMatch};
pub use convergence::{Behaviour, Convergence, MeshLevels, richardson};
pub use energy_shares::{EnergyShares, KineticShares, ModeShares, StrainShares};
pub use error::ModalError;
pub use full_modes::{FullModes, housing_modes};
pub use mass_properties::{MassDistribution, MassProperties, Participation, PrincipalInertia};
pub use mechanisms::{Body, Joint, Mechanisms, Piece};
pub(crate) use mechanisms::{Bore, pieces_at};
pub use mode_shapes::RingShapes;
pub(crate) use mode_shapes::{Partner, mode_set, partners};
pub use motions::over_all_dofs;
pub(crate) use motions::{rigid_motions, ring_motions};
pub use strain_products::strain_products;
pub use survey::ModalSurvey;
