//! From a case to results: each command's computation in stages, and its report.
//!
//! [`HousingStage`] and [`StructureStage`] build the linear model, [`bearing_setup`] the bearing;
//! [`compute_modes`] and [`compute_run`] carry a command out. Nothing here prints; progress goes through
//! [`Watch`].

mod analysis;
mod analysis_change;
mod analysis_change_report;
mod analysis_report;
mod analysis_survey;
mod analysis_table;
mod band_search;
mod band_search_report;
#[cfg(test)]
mod band_search_tests;
mod bearing;
mod bearing_defects;
mod bearing_motion;
mod bearing_table;
mod choice;
mod comparison;
mod condense;
mod condense_report;
mod condensed;
mod contact_limits;
mod convergence;
mod damping;
mod dent_drops;
mod doubts;
mod draft;
mod drawing;
mod energy_tables;
mod error;
mod free_system;
#[cfg(test)]
mod free_system_tests;
mod frf;
mod frf_report;
mod housing;
mod import_error;
mod imported;
mod imported_report;
#[cfg(test)]
mod imported_tests;
mod inspect;
mod keeper;
mod kinematics;
mod loaded_pass;
mod loose;
mod measured;
mod mesh_digest;
mod mesh_sequence;
mod modal_system;
mod modal_tables;
mod mode_checks_report;
mod mode_set;
mod mode_shapes;
mod modes;
mod modes_report;
mod no_signs;
mod places;
mod recording;
mod reduced_interface;
mod reduced_interface_report;
mod run;
mod run_model;
mod run_report;
mod scalogram;
mod scene;
mod seat;
mod shape_view;
mod simulation;
#[cfg(test)]
mod simulation_tests;
mod size_chart;
mod statics;
mod statics_report;
mod structure;
mod superelement_record;
mod survey;
mod tables;
mod tie_price;
mod unfinished;

pub use analysis::{AnalysisSettings, WindowAnalysis, analyse};
pub use analysis_change::{EarlierSignal, WindowChange, compare_window};
pub use analysis_report::analysis_report;
pub use analysis_survey::{SHOWN_WINDOWS, survey_report, survey_section};
pub use analysis_table::{AnalysisRow, ChangeFigures, PartFigures, WindowFigures, analysis_table};
pub use band_search::{AskedBand, BandSearch, UsedBand};
pub use bearing::{bearing_geometry, bearing_setup, race_contacts};
pub use bearing_table::bearing_table;
pub use choice::{ChosenPart, Horizon, Measured, ModelChoice};
pub use comparison::{ComparedPair, ComparedPoints, FileComparison, LoneMode, Miss};
pub use condense::{Comparison, CondenseResult, FullComparison, compute_condense};
pub use condense_report::condense_report;
pub use condensed::{Boundary, CondensedStage};
pub use convergence::{MeshConvergence, ModeOnMeshes, SequenceMesh};
pub use doubts::{doubts, doubts_of_case};
pub use draft::{Draft, DraftError, DraftRequest, FoundCylinder, UnitFrom};
pub use error::StageError;
pub use free_system::FreeSystem;
pub use frf::{
    CarriedPart, ComparedResponse, FrfHousing, FrfResult, RankedPath, TransferPath, compute_frf,
};
pub use frf_report::frf_report;
pub use housing::HousingStage;
pub use import_error::ImportError;
pub use imported::ImportedHousing;
pub use imported_report::imported_report;
pub use inspect::{ElementShape, GroupSize, Inspection};
pub use keeper::{InMemory, Keeper, Wish};
pub use kinematics::Kinematics;
pub use loaded_pass::{LoadedPass, LoadedPoint};
pub use measured::compute_analysis;
pub use mesh_digest::{MeshDigest, mesh_digests};
pub use modal_tables::free_motions;
pub use mode_checks_report::{error_text, misses_text, mode_numbers, plain, signed};
pub use mode_shapes::compute_mode_shapes;
pub use modes::{ExpectedMode, ModesResult, Reading, compute_modes};
pub use modes_report::modes_report;
pub use recording::Recording;
pub use reduced_interface::ReducedInterface;
pub use run::{RunResult, compute_kept_run, compute_run, explain_run};
pub use run_model::RunModel;
pub use run_report::run_report;
pub use scalogram::SensorScalogram;
pub use scene::Scene;
pub use simulation::{RunEnd, Simulation, Span};
pub use statics::{PassPoint, Statics};
pub use structure::StructureStage;
pub use superelement_record::{reduced_superelement_record, superelement_record};
pub use survey::{ModalSurvey, RingShapes};
pub(crate) use tables::{assumptions, model_facts};
pub use tie_price::{
    BeamAndSolid, NoTiePrice, TIE_PRICE_MODES, TieComparison, TiePrice, tie_price,
};
pub use unfinished::{CHECKPOINT_S, RunIdentity, StopRequest, UnfinishedError, UnfinishedRun};

/// Where a computation tells how far it is.
pub trait Watch {
    /// A stage begins.
    fn stage(&self, name: &str);
    /// Part of the stage that is done, 0 to 1; the first is where it begins.
    fn fraction(&self, done: f64);
    /// A mesh was read, and this was its content.
    fn read(&self, _file: &MeshDigest) {}
}

/// Watches nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn stage(&self, _name: &str) {}
    fn fraction(&self, _done: f64) {}
}
