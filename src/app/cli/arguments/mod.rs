//! What can be written on the command line: the commands here, what each takes in a file of its own, the options of all in `options`.

mod bearing;
mod chart;
mod examples;
mod export;
mod init;
mod inspect;
mod number;
mod options;
mod run;
mod schema;
#[cfg(test)]
mod tests;

use super::{AnalyzeArguments, CliError, DatasetArguments, SweepArguments};
use crate::app::case::replaced_argument;
use crate::app::commands::run::unfinished::CHECKPOINT_S;
use crate::numerics::units::LengthUnit;
use bearing::{BEARING_EXAMPLE, revolutions};
use chart::{CHART_EXAMPLE, budget};
use clap::{Parser, Subcommand, ValueEnum};
use examples::{
    ANALYZE_EXAMPLE, COMPLETIONS_EXAMPLE, CONDENSE_EXAMPLE, DATASET_EXAMPLE, FRF_EXAMPLE, MAN_EXAMPLE, MODES_EXAMPLE,
    REPORT_EXAMPLE, SWEEP_EXAMPLE, VERIFY_EXAMPLE,
};
use export::EXPORT_EXAMPLE;
use init::INIT_EXAMPLE;
use inspect::{INSPECT_EXAMPLE, density};
use run::{RUN_EXAMPLE, pause};
use schema::SCHEMA_EXAMPLE;
use serde_json::Value;
use std::path::PathBuf;
use std::time::Duration;

pub use chart::ChartPart;
pub use export::ExportFormat;
pub use init::InitArguments;
pub use options::Options;
pub(super) use options::typed;
pub use schema::ResultOf;

const EXAMPLES: &str = "\
Examples:
  plummer inspect meshes/ring_6_9.msh --length-unit mm
  plummer run examples/tadina2011/outer-dent.toml
  plummer modes examples/tadina2011/beam.toml --set ring.shear=true --out out/with-shear --json
  plummer export examples/scenes/pedestal.toml --to mtx
  plummer verify

Exit codes:
  0  done
  1  it ran and the answer is bad, or could not be computed
  2  the input is wrong: the message names file, line or key, what was found and what was expected";

/// Computes vibration signals from a housing mesh and a ball bearing's data, and diagnoses them.
#[derive(Debug, Clone, Parser)]
#[command(name = "plummer", version, after_help = EXAMPLES, arg_required_else_help = true)]
pub struct Arguments {
    /// What to compute.
    #[command(subcommand)]
    pub command: Command,
    /// How, and where the results go.
    #[command(flatten)]
    pub options: Options,
}

/// What to compute.
#[derive(Debug, Clone, Subcommand)]
pub enum Command {
    /// Simulate a run: static equilibrium, transient of the run-up, signals, analysis and report
    #[command(after_help = RUN_EXAMPLE)]
    Run {
        /// Case file (TOML)
        case: PathBuf,
        /// Only say which model the run would take and why, with the estimated errors
        #[arg(long, conflicts_with = "resume")]
        explain: bool,
        /// Go on with the unfinished run in the folder for the results
        #[arg(long)]
        resume: bool,
        /// Seconds between checkpoints; more where they would take above 4 % of the time
        #[arg(long, allow_hyphen_values = true, value_name = "S", value_parser = pause, default_value_t = CHECKPOINT_S)]
        checkpoint_every: f64,
    },
    /// Write a commented case file for a mesh: bore, parts and supports from its named groups, and a bearing that fits
    #[command(after_help = INIT_EXAMPLE)]
    Init(InitArguments),
    /// Show what a mesh contains: groups, elements, size, mass, worst element, loose parts
    #[command(after_help = INSPECT_EXAMPLE)]
    Inspect {
        /// Mesh file (gmsh MSH 2 or 4, .inp of Abaqus or CalculiX), or a case file: its mesh
        mesh: PathBuf,
        /// Unit of the mesh's coordinates: m, cm, mm, um or in (the file does not say)
        #[arg(long, value_name = "UNIT", value_parser = LengthUnit::parse)]
        length_unit: Option<LengthUnit>,
        /// Density in kg/m^3 for the mass (default: those of aluminium and of steel)
        #[arg(long, allow_hyphen_values = true, value_name = "RHO", value_parser = density)]
        density: Option<f64>,
        /// Mend folded elements of second order by nodes between corners, and say which
        #[arg(long)]
        straighten: bool,
    },
    /// Compute eigenfrequencies of housing, ring, or both coupled, and compare them with expected ones
    #[command(after_help = MODES_EXAMPLE)]
    Modes {
        /// Case file (TOML)
        case: PathBuf,
    },
    /// Condense a housing to a Craig-Bampton superelement, estimate its error and check it
    #[command(after_help = CONDENSE_EXAMPLE)]
    Condense {
        /// Case file (TOML)
        case: PathBuf,
        /// Compare with the full model too, and show the error against the superelement's size
        #[arg(long)]
        compare_full: bool,
    },
    /// Compute transfer paths from forces to sensors with the reduced model, and compare with the full one
    #[command(after_help = FRF_EXAMPLE)]
    Frf {
        /// Case file (TOML)
        case: PathBuf,
    },
    /// Find where a rigid shaft rests in its ball bearings in space: displacements, ball loads and angles, stiffness, orders
    #[command(after_help = BEARING_EXAMPLE)]
    Bearing {
        /// Case file (TOML)
        case: PathBuf,
        /// Speed of the shaft in revolutions per minute (default: the highest of the case's profile)
        #[arg(long, allow_hyphen_values = true, value_name = "RPM", value_parser = revolutions)]
        rpm: Option<f64>,
        /// Hold the shaft's tilt at zero, as a second bearing does, and show the moment that holds it
        #[arg(long)]
        hold_tilt: bool,
    },
    /// Chart how fast and how accurate methods, steps and model sizes are, and map where they are stable
    #[command(after_help = CHART_EXAMPLE)]
    Chart {
        /// Case file (TOML)
        case: PathBuf,
        /// Take a first look within 45 s: fewer starts, models, conditions and steps, and shorter runs
        #[arg(long)]
        quick: bool,
        /// End within this time, such as 45s, 2min or 1h, with what is cheapest and tells most; what was left out is said
        #[arg(long, allow_hyphen_values = true, value_name = "TIME", value_parser = budget)]
        budget: Option<Duration>,
        /// Make one of the two charts alone
        #[arg(long, value_name = "PART", value_enum)]
        only: Option<ChartPart>,
    },
    /// Tell which part of a bearing is damaged, from the signal of a run or a measured one
    #[command(after_help = ANALYZE_EXAMPLE)]
    Analyze(Box<AnalyzeArguments>),
    /// Run many variants of a case into one table, on all cores or on a cluster
    #[command(after_help = SWEEP_EXAMPLE)]
    Sweep(Box<SweepArguments>),
    /// Compute labelled vibration signals of bearings drawn from distributions, for machine learning
    #[command(after_help = DATASET_EXAMPLE)]
    Dataset(Box<DatasetArguments>),
    /// Write matrices and mode shapes in the formats of other programs
    #[command(after_help = EXPORT_EXAMPLE)]
    Export {
        /// Case file (TOML), or a folder with results of `plummer modes`
        #[arg(value_name = "CASE|DIR")]
        from: PathBuf,
        /// Format of the files
        #[arg(long, value_name = "FORMAT", value_enum)]
        to: ExportFormat,
    },
    /// Print the completions of this command line for a shell
    #[command(after_help = COMPLETIONS_EXAMPLE)]
    Completions {
        /// The shell
        #[arg(value_name = "SHELL", value_enum)]
        shell: clap_complete::Shell,
    },
    /// Print the manual page, or with --out write one for each command
    #[command(after_help = MAN_EXAMPLE)]
    Man,
    /// Draw the pages, tables and figures of earlier results again, with this version of the program
    #[command(after_help = REPORT_EXAMPLE)]
    Report {
        /// Folder with the results of one or more commands
        #[arg(value_name = "DIR")]
        folder: PathBuf,
    },
    /// Run built-in checks against published numbers and closed forms; they need no files
    #[command(after_help = VERIFY_EXAMPLE)]
    Verify {
        /// Check orders of convergence too (half a minute)
        #[arg(long)]
        full: bool,
    },
    /// Print the JSON Schema of case files, for editors, or of a command's results
    #[command(after_help = SCHEMA_EXAMPLE)]
    Schema {
        /// Print the schema of what this command writes as COMMAND.json and prints with --json
        #[arg(long, value_name = "COMMAND", value_enum)]
        results: Option<ResultOf>,
        /// Print the schema of specifications for `plummer dataset`
        #[arg(long, conflicts_with = "results")]
        dataset: bool,
    },
}

/// The word by which a value of an option is typed.
pub(super) fn word(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

impl Command {
    /// Returns the command's word, which is also its result file's name: `run` writes `run.json`; `analyze` alone writes
    /// `analysis.json`, and `dataset` `manifest.json`.
    #[must_use]
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::Run { .. } => "run",
            Self::Modes { .. } => "modes",
            Self::Condense { .. } => "condense",
            Self::Frf { .. } => "frf",
            Self::Bearing { .. } => "bearing",
            Self::Chart { .. } => "chart",
            Self::Analyze(_) => "analyze",
            Self::Inspect { .. } => "inspect",
            Self::Sweep(_) => "sweep",
            Self::Dataset(_) => "dataset",
            Self::Completions { .. } => "completions",
            Self::Man => "man",
            Self::Init(_) => "init",
            Self::Export { .. } => "export",
            Self::Report { .. } => "report",
            Self::Verify { .. } => "verify",
            Self::Schema { .. } => "schema",
        }
    }

    /// What an earlier result of the command has that this one would lack, behind "an earlier run".
    pub(super) fn lost_with(&self, earlier: &Value) -> Option<&'static str> {
        match self {
            // hours of computing, whose extent the options choose
            Self::Chart { .. } => Some(""),
            Self::Condense { compare_full: false, .. } if !earlier["full_frequencies_hz"].is_null() => {
                Some(" with --compare-full")
            }
            _ => None,
        }
    }

    /// The result files that it writes, which an earlier result is known by.
    #[must_use]
    pub(crate) fn result_files(&self) -> Vec<String> {
        let names: &[&str] = match self {
            Self::Chart { only: None, .. } => &["chart", "stability"],
            Self::Chart { only: Some(ChartPart::Stability), .. } => &["stability"],
            Self::Analyze(_) => &["analysis"],
            Self::Dataset(_) => &["manifest"],
            other => &[other.name()],
        };
        names.iter().map(|name| format!("{name}.json")).collect()
    }
}

/// Refuses `--set` where nothing would come of it: in a command that reads no case, and where a later argument replaces it.
///
/// # Errors
/// [`CliError`] that names the arguments.
pub(super) fn check_set(arguments: &Arguments) -> Result<(), CliError> {
    let set = &arguments.options.set;
    let Some(argument) = set.first() else {
        return Ok(());
    };
    if let Some(command) = without_case(&arguments.command) {
        return Err(CliError::input(format!(
            "--set {argument}: `plummer {command}` reads no case that it could change"
        ))
        .with_help("leave it out; the command has options of its own, which --help lists"));
    }
    match replaced_argument(set) {
        Some([earlier, later]) => {
            Err(CliError::input(format!("--set {later} replaces --set {earlier}: expected each key once"))
                .with_help("leave one of the two out"))
        }
        None => Ok(()),
    }
}

/// The command, if it reads no case of its own.
fn without_case(command: &Command) -> Option<&'static str> {
    match command {
        Command::Sweep(asked) if asked.task.is_some() => Some("sweep --task"),
        Command::Sweep(asked) if asked.merge => Some("sweep --merge"),
        Command::Dataset(asked) if asked.task.is_some() => Some("dataset --task"),
        Command::Dataset(asked) if asked.merge => Some("dataset --merge"),
        Command::Run { .. }
        | Command::Modes { .. }
        | Command::Condense { .. }
        | Command::Frf { .. }
        | Command::Bearing { .. }
        | Command::Chart { .. }
        | Command::Export { .. }
        | Command::Analyze(_)
        | Command::Sweep(_)
        | Command::Dataset(_) => None,
        other => Some(other.name()),
    }
}
