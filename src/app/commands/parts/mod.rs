//! Sections that several reports show: model, bearing, statics.

pub(crate) mod bearing_table;
pub(crate) mod bearing_words;
pub(crate) mod case_words;
pub(crate) mod drawing;
pub(crate) mod machine_tables;
pub(crate) mod phrases;
pub(crate) mod statics_report;
pub(crate) mod summary;
pub(crate) mod tables;

pub(crate) use bearing_table::bearing_table;
pub(crate) use bearing_words::{NO_FAULT, bearing_fact, faults, not_shown};
pub(crate) use case_words::{HousingSize, inputs, with_details, with_entries};
pub(crate) use drawing::draw;
pub(crate) use machine_tables::{LIFE_NOTE, assumptions_in_space, bearings_table, shaft_at_rest};
pub(crate) use statics_report::{statics_section, without_round_off};
pub use summary::{CheckSummary, SuperelementSummary};
pub use tables::ExpectedMode;
pub(crate) use tables::{assumptions, expected_table, mode_table, model_facts, signed_report};
