//! Built-in checks: the program against published numbers and closed forms, with the assumptions of each in words.
//!
//! `suite` carries out all sections. Each is a function that gives a `SectionResult`: curved beams, whole housings, condensation,
//! simulation, signals, the numbers of Tadina & Boltezar (2011), orders of convergence. Meshes and cases that they need are part of
//! the program. Read `section` first. Which readings of the paper give its eigenfrequencies is studied by the example `paper_readings`.

mod beams;
mod condensation;
mod housings;
mod orders;
mod paper;
pub(crate) mod section;
mod signals;
mod simulation;
mod structured_mesh;
mod suite;

pub(crate) use section::SectionResult;
pub use section::{BEAM_CASE, BEARING, Check, VerifyResult};
pub use structured_mesh::{BODY, StructuredMesh};
pub(crate) use suite::suite;
