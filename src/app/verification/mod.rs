//! Built-in checks: the program against published numbers and closed forms, with the assumptions of each in words.
//!
//! [`suite`] carries out all sections; each is a function that gives a [`SectionResult`]: curved beams, whole housings, condensation,
//! simulation, signals, [`paper_numbers`], the source's own figures, orders of convergence, and [`reading_study`], how unique the
//! reading is that gives its frequencies. Meshes and examples that they need are part of the program. Whoever runs the suite writes what they hand on.

mod beams;
mod check;
mod condensation;
mod error;
mod housings;
mod orders;
mod paper;
mod paper_numbers;
mod paper_report;
mod reading_report;
pub mod readings;
pub mod ring;
mod section;
mod signals;
mod simulation;
mod stiffness;
mod structured_mesh;
mod suite;
mod summary;

pub use check::{Check, CheckSummary, Information};
pub use error::VerificationError;
pub use orders::OrdersSummary;
pub use paper::{
    BEAM_CASE, BEARING, GRAVITY, PAPER, PaperFrequencies, TABLE_ONE, TableStiffness, beam_case,
    table_one,
};
pub use paper_numbers::{FormulationRow, paper_numbers};
pub use reading_report::reading_study;
pub use section::SectionResult;
pub use stiffness::{Hypothesis, hypotheses};
pub use structured_mesh::{BODY, StructuredMesh};
pub use suite::suite;
pub use summary::{SectionValues, VerifyResult};
