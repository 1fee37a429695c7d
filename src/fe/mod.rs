//! Finite elements: from a gmsh file to modes and superelements.
//!
//! In come a mesh file, materials, supports and links; out go matrices, modes with residuals, superelements and frequency responses.
//! The data goes through the rooms in this order:
//!
//! - [`mesh`]: gmsh import with physical names, validator, inventory;
//! - [`material`], [`element`]: elasticity; matrices of planes, solids and curved beams;
//! - [`model`]: properties, degrees of freedom, supports, links, the bearing's ring and its tie to the bore;
//! - [`assembly`]: sparse stiffness and mass;
//! - [`modal`]: modes with residuals, effective mass, comparison, convergence;
//! - [`reduction`]: Craig-Bampton superelements with error estimates, and frequency responses.
//!
//! Read [`model::HousingModel`] first.

pub mod assembly;
pub mod element;
pub mod material;
pub mod mesh;
pub mod modal;
pub mod model;
pub mod reduction;
