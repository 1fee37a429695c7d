//! Built-in checks: the program against published numbers and closed forms, with the assumptions of each in words.
//!
//! A section of the suite is a function that gives a [`SectionResult`]: [`paper_numbers`], the source's own figures, and
//! [`reading_study`], how unique the reading is that gives its frequencies. Whoever runs the suite writes what they hand on.

mod check;
mod error;
mod paper;
mod paper_numbers;
mod paper_report;
mod reading_report;
pub mod readings;
mod section;
mod stiffness;

pub use check::{Check, Information};
pub use error::VerificationError;
pub use paper::{
    BEAM_CASE, BEARING, GRAVITY, PAPER, PaperFrequencies, TABLE_ONE, TableStiffness, beam_case,
    table_one,
};
pub use paper_numbers::{FormulationRow, paper_numbers};
pub use reading_report::reading_study;
pub use section::SectionResult;
pub use stiffness::{Hypothesis, hypotheses};
