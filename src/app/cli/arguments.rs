//! What can be written on the command line.

use super::{AnalyzeArguments, CliError, SweepArguments};
use crate::app::case::replaced_argument;
use crate::app::commands::run::unfinished::CHECKPOINT_S;
use crate::app::shell_word::shell_word;
use crate::numerics::units::LengthUnit;
use clap::{Args, Parser, Subcommand, ValueEnum};
use serde_json::Value;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::time::Duration;

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

const RUN_EXAMPLE: &str = "\
Examples: the dented bearing with a deeper dent, in a folder of its own; the same run goes on after Ctrl-C or a power failure
  plummer run examples/tadina2011/outer-dent.toml --set 'bearing.defects[0].depth=2e-5' --out out/deeper
  plummer run examples/tadina2011/outer-dent.toml --set 'bearing.defects[0].depth=2e-5' --out out/deeper --resume

Long runs: memory does not grow with the simulated time. Signals go to DIR/.run.partial, with a checkpoint every 10 s. Ctrl-C
keeps a checkpoint and ends with exit code 1; a second Ctrl-C ends at once. With --resume the run goes on. With the same program,
case, --set and meshes its signals are those of a run without a stop, bit by bit.";

const INIT_EXAMPLE: &str = "\
Examples: a case file beside a mesh, with the bearing that fits its bore; the bearings and the materials that the program knows
  plummer init housing.msh --length-unit mm
  plummer init housing.msh --length-unit mm --bearing 6205 --out motor.toml
  plummer init --list-bearings
  plummer init --list-materials

--out FILE names the case file (default: the mesh's name, ending in .toml). It says of every value whether it is from the mesh,
the catalogue, usual or a guess. Tables that the mesh says nothing of are templates, commented out. plummer modes FILE runs at
once where the mesh allows it.

The bore is the named surface (in a plane mesh the curve) that lies on a cylinder with the housing outside of it. Several on one
axis, named like bores, carry one shaft: the case has a bearing for each ([[bearings]]). Supports are groups named like a foot,
base, bolt, clamp or support.";

const INSPECT_EXAMPLE: &str = "\
Example: a solid housing drawn in millimetres
  plummer inspect meshes/pedestal.msh --length-unit mm --density 2700

The command writes inspect.json only where --out names a folder.";

const MODES_EXAMPLE: &str = "\
Example: the published frequencies with the consistent equations instead of the printed ones
  plummer modes examples/tadina2011/beam.toml --set bearing.formulation=consistent --out out/consistent";

const CONDENSE_EXAMPLE: &str = "\
Example: a housing on the nodes of its bore, its frequencies against those of the full model
  plummer condense examples/scenes/pedestal.toml --compare-full

Files:
  superelement.npz  k, m (interface first), labels, sensors (numpy.load); other formats: plummer export --to op4, mbdyn;
                    in another case [housing] superelement = \"superelement.npz\" puts it in the housing's place
  condense.json     checks with limits and verdicts, estimated errors

Large interfaces: condense.interface_modes = 30 in the case puts modes of the interface in the place of its coordinates. Only this
command does so: run, modes and frf keep the whole interface, export --to op4 and mbdyn refuse the key.";

const FRF_EXAMPLE: &str = "\
Example: responses of the sensors to a force on the raceway, compared with the full model at the peaks
  plummer frf examples/transfer/pedestal.toml

Files:
  frf.json  receptances (m/N) of the reduced and, where compared, of the full model; what carries each path
  frf.uff   the same for test software (universal file, dataset 58)";

const BEARING_EXAMPLE: &str = "\
Example: the bearing of a case under thrust beside its weight, at 3000 rpm
  plummer bearing examples/scenes/smooth.toml --rpm 3000 --set 'shaft.loads=[{ force = [0, 0, 20] }]'

Both rings are rigid. The shaft has three displacements and two tilts; its weight acts at the bearing's centre.

Files:
  bearing.json  equilibrium, balls, stiffness, orders; curves over load (0.1 to 10), speed (0 to 2) and preload
  report.html   the same as tables and plots";

const CHART_EXAMPLE: &str = "\
Examples: which method and step the dented bearing needs; a first look in a fraction of the time
  plummer chart examples/scenes/impact.toml
  plummer chart examples/scenes/smooth.toml --quick
  plummer chart examples/scenes/impact.toml --budget 5min
  plummer chart examples/scenes/impact.toml --only stability

Files:
  chart.json      points, front, the program's choice, omissions with their reasons, horizon, statistics of the ensemble
  chart.svg       error against wall time
  stability.json  method x step x condition: stable, resonant or unstable, with predicted and measured limits
  stability.svg   the same as a map; resonance.svg: a mode in resonance with the step
  report.html     the same to zoom into, and tables

Points are shown as they come, and are in chart.csv.partial until chart.json is there.
Wall times are measured on one thread, one run at a time: run nothing else on the machine meanwhile.";

const ANALYZE_EXAMPLE: &str = "\
Examples: a run of this program; a recorder's table, with a bearing by its drawing, and by its name; a run-up of a bearing with orders of a catalogue;
many files in one table
  plummer analyze out/outer-dent --window 1.0:2.6
  plummer analyze bench.csv --channel P1 --balls 9 --pitch-diameter 39.04 --ball-diameter 7.94 --speed 29.95
  plummer analyze bench.csv --channel P1 --bearing 6205 --speed 1797rpm
  plummer analyze rise.wav --orders BPFO=3.585,BPFI=5.415,BSF=2.357,FTF=0.398 --speed 0:600rpm,8:3000rpm --band 6000:12000
  plummer analyze records/*.csv --bearing 6205 --speed 1797rpm --out out/records

Signals: .npz (an array time_s, time or t, or a rate fs), .mat (MATLAB 5 to 7; the same), .csv, .txt, .tsv, .asc or .lvm (a column
time; units in the header: P1 (m/s^2); decimal points or commas), .wav, .uff or .unv (data sets 58 and 58b over time).

Several files: the table has a row for each file, channel and window. Every channel counts unless --channel names some. What
cannot be analysed has a row that says why, the others are analysed, and the exit code is 2.

Verdicts: fault indicated, not enough evidence, not seen. Each has its evidence and the probability that noise alone looks like it;
docs/diagnosis.md explains them. A window needs at least 16 events of a part: 7 shaft turns for most bearings.

Results of a run go into its own folder, of one file into out/ and its name, of several files into out/analysis.

Files:
  analysis.json  windows with strongest peaks and verdicts
  analysis.csv   a row for each window: RMS, kurtosis, verdict and reason; conclusion, probability and strength of each part
  report.html    signal, envelope, spectrum over orders, verdicts with harmonics and reasons; of several files their table, and
                 plots of up to 12 windows";

const EXPORT_EXAMPLE: &str = "\
Examples: matrices for SciPy; the mode shapes of an earlier `plummer modes` for ParaView, without solving again; the condensed
housing for Nastran and pyYeti
  plummer export examples/scenes/pedestal.toml --to mtx
  plummer export out/pedestal --to vtu
  plummer export examples/scenes/pedestal.toml --to op4

Files:
  vtu  modes.vtu, ring.vtu: elements with a field a mode (ParaView, PyVista)
  uff  modes.uff, ring.uff: nodes, elements, mode shapes (universal file, datasets 2411, 2412, 55)
  mtx  stiffness.mtx, mass.mtx, dofs.csv: free degrees of freedom (Matrix Market; scipy.io.mmread)
  npz  stiffness.npz, mass.npz, dofs.npz, modes.npz (scipy.sparse.load_npz, numpy.load)
  op4  superelement.op4, superelement_dofs.csv: KAA, MAA, BAA, K4AA of the condensed housing, interface first (pyyeti.nastran.op4)
  inp  housing.inp: mesh, sets, surfaces, materials, held nodes, a *FREQUENCY step in SI (ccx -i housing)
  mbdyn  superelement.fem: data of MBDyn's modal joint";

const SWEEP_EXAMPLE: &str = "\
Examples: play and dent of the paper's bearing on all cores; the frequencies over the springs' stiffness; the first on a cluster
  plummer sweep examples/tadina2011/outer-dent.toml --vary bearing.radial_play=1e-6:4e-6:4 --vary 'bearing.defects[0].depth=5e-6,15e-6'
  plummer sweep examples/tadina2011/beam.toml --command modes --vary ring.nodes=36,72,144
  plummer sweep examples/tadina2011/outer-dent.toml --vary bearing.radial_play=1e-6:4e-6:4 --out out/play --slurm && sh out/play/sweep/submit.sh

Points that fail are listed and do not stop the others: the exit code is 0 if any point has a result. Ctrl-C keeps checkpoints;
the sweep goes on with --resume. Each point is a process with a folder of its own, DIR/sweep/NUMBER, as `plummer run` or
`plummer modes` leaves it.

Files:
  sweep.csv    a row for each point: values, state, wall time, figures of its result
  sweep.npz    the same as arrays (numpy.load); shape: the lengths of the axes, for reshape
  sweep.json   the axes; state, exit code and message of each point
  report.html  plots over what was varied, points that are not done, the table";

const COMPLETIONS_EXAMPLE: &str = "\
Example: for bash, from the next shell on
  plummer completions bash > ~/.local/share/bash-completion/completions/plummer";

const MAN_EXAMPLE: &str = "\
Examples: to read it; the pages of all commands, for man
  plummer man | man -l -
  plummer man --out ~/.local/share/man/man1";

const REPORT_EXAMPLE: &str = "\
Example: the pages of results that an earlier version computed
  plummer report out/outer-dent

The command computes nothing and leaves the results as they are. It draws each page from its content, which lies beside it as
report.cbor.gz (CBOR, packed by gzip).";

const VERIFY_EXAMPLE: &str = "\
Examples: the checks that take seconds; the orders of convergence too, which take half a minute
  plummer verify
  plummer verify --full --out out/full

Files, in out/verify unless --out names another folder:
  verify.json   checks with computed value, reference, source, assumptions, error, limit and verdict
  report.html   the same as tables; with --full the charts of orders";

const SCHEMA_EXAMPLE: &str = "\
Examples: a schema by which an editor with taplo or Even Better TOML completes and checks case files; that of modes.json
  plummer schema > plummer.schema.json
  plummer schema --results modes

The first line of a case file names the schema, relative to the case: #:schema plummer.schema.json
The schema has the keys, kinds of values, options, and keys that exclude each other. Ranges, and what depends on the mesh, are
checked by every command that reads a case.";

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
    /// Find where a rigid shaft rests in its ball bearing in space: displacements, ball loads and angles, stiffness, orders
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
    },
}

/// A mesh, and what is known of it.
#[derive(Debug, Clone, Args)]
pub struct InitArguments {
    /// Mesh file (gmsh MSH 2 or 4, .inp of Abaqus or CalculiX)
    #[arg(value_name = "HOUSING.msh", required_unless_present_any = ["list_bearings", "list_materials"])]
    pub mesh: Option<PathBuf>,
    /// Unit of the mesh's coordinates: m, cm, mm, um or in (default: the one in which the bearing fits, else a guess by the size)
    #[arg(long, value_name = "UNIT", value_parser = LengthUnit::parse)]
    pub length_unit: Option<LengthUnit>,
    /// Deep groove ball bearing of the catalogue (default: one whose outer diameter is the bore's within 1 %)
    #[arg(long, value_name = "NAME")]
    pub bearing: Option<String>,
    /// Mend folded elements of second order, here and in the case
    #[arg(long)]
    pub straighten: bool,
    /// List the bearings of the catalogue with their dimensions and sources
    #[arg(long, conflicts_with_all = ["mesh", "length_unit", "bearing", "straighten"])]
    pub list_bearings: bool,
    /// List the materials that a case may name, with their ranges and sources
    #[arg(long, conflicts_with_all = ["mesh", "length_unit", "bearing", "straighten", "list_bearings"])]
    pub list_materials: bool,
}

/// A part of `plummer chart`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ChartPart {
    /// Speed against accuracy
    Accuracy,
    /// Which steps a method can take, under which conditions
    Stability,
}

/// A format of `plummer export`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExportFormat {
    /// VTK grids with mode shapes
    Vtu,
    /// Universal files with mode shapes
    Uff,
    /// Matrices as Matrix Market files
    Mtx,
    /// Matrices and mode shapes as NumPy archives
    Npz,
    /// The condensed housing's matrices as Nastran's OUTPUT4 file
    Op4,
    /// The condensed housing as Nastran bulk data with DMIG matrices
    Dmig,
    /// The housing as an input file of CalculiX or Abaqus
    Inp,
    /// The condensed housing as a modal body of MBDyn
    Mbdyn,
}

/// The word by which a value of an option is typed.
pub(super) fn word(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}

impl Command {
    /// Returns the command's word, which is also its result file's name: `run` writes `run.json`; `analyze` alone writes
    /// `analysis.json`.
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
            other => &[other.name()],
        };
        names.iter().map(|name| format!("{name}.json")).collect()
    }
}

/// Most threads: more than any machine that the program is for has cores.
const MOST_THREADS: usize = 1024;

fn number_of_threads(text: &str) -> Result<NonZeroUsize, String> {
    let number = text.parse().ok().filter(|number: &NonZeroUsize| number.get() <= MOST_THREADS);
    number.ok_or_else(|| format!("expected a whole number from 1 to {MOST_THREADS}"))
}

/// Options that every command takes.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Options of every command")]
pub struct Options {
    /// Folder for the results (default: one of its own in out/)
    #[arg(long, global = true, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Number of threads (default: all cores)
    #[arg(long, global = true, allow_hyphen_values = true, value_name = "N", value_parser = number_of_threads)]
    pub threads: Option<NonZeroUsize>,
    /// Print errors only, no progress and no summary
    #[arg(long, global = true)]
    pub quiet: bool,
    /// Print the result as JSON instead of the summary
    #[arg(long, global = true)]
    pub json: bool,
    /// Replace results of another case, and give up an unfinished run
    #[arg(long, global = true)]
    pub force: bool,
    /// Folder that keeps condensed housings for the next command (default: cache/ in the folder for the results)
    #[arg(long, global = true, value_name = "DIR", conflicts_with = "no_cache")]
    pub cache: Option<PathBuf>,
    /// Condense anew, and keep nothing
    #[arg(long, global = true)]
    pub no_cache: bool,
    /// Set a key of the case, as bearing.balls=8 or bearing.defects.0.depth=2e-5; can be repeated. `analyze` takes report.title,
    /// .customer, .project, .author and .remark without a case too
    #[arg(long, global = true, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}

/// A pause between checkpoints: not negative, at most a year.
fn pause(text: &str) -> Result<f64, String> {
    number(text, |pause| (0.0..=3.2e7).contains(&pause), "seconds from 0 to 3.2e7")
}

/// A time with its unit: positive, at most a year.
fn budget(text: &str) -> Result<Duration, String> {
    const UNITS: [(&str, f64); 3] = [("min", 60.0), ("h", 3600.0), ("s", 1.0)];
    let read = UNITS.iter().find_map(|(unit, seconds)| {
        let number: f64 = text.trim().strip_suffix(unit)?.trim().parse().ok()?;
        Some(number * seconds).filter(|time| (1.0..=3.2e7).contains(time))
    });
    let read =
        read.ok_or_else(|| format!("expected a time from 1s to 8000h, such as 45s, 2min or 1h, found \"{text}\""));
    read.map(Duration::from_secs_f64)
}

/// A speed that can be: at most 6e7 rpm either way.
fn revolutions(text: &str) -> Result<f64, String> {
    number(text, |rpm| rpm.abs() <= 6e7, "revolutions per minute from -6e7 to 6e7")
}

/// A density: positive and finite.
fn density(text: &str) -> Result<f64, String> {
    number(text, |density| density > 0.0 && density.is_finite(), "a number of kg/m^3 above 0")
}

fn number(text: &str, fits: fn(f64) -> bool, expected: &str) -> Result<f64, String> {
    let value = text.parse().ok().filter(|&value| fits(value));
    value.ok_or_else(|| format!("expected {expected}, found \"{text}\""))
}

/// The command line as it was typed, without options that the result does not depend on.
pub(super) fn typed() -> String {
    without_manner(std::env::args().skip(1))
}

fn without_manner(mut words: impl Iterator<Item = String>) -> String {
    let mut line = "plummer".to_owned();
    while let Some(word) = words.next() {
        match word.as_str() {
            "--force" | "--resume" | "--quiet" | "--json" | "--no-cache" => {}
            "--threads" | "--cache" | "--checkpoint-every" => drop(words.next()),
            other if ["--threads=", "--cache=", "--checkpoint-every="].iter().any(|name| other.starts_with(name)) => {}
            other => line = format!("{line} {}", shell_word(other)),
        }
    }
    line
}

impl Options {
    /// Returns whether progress may be shown at all.
    #[must_use]
    pub(crate) fn shows_progress(&self) -> bool {
        !self.quiet && !self.json
    }

    /// The folder that keeps condensed housings beside results in `folder`; `None`: nothing is kept.
    pub(crate) fn cache_in(&self, folder: &Path) -> Option<PathBuf> {
        let beside = || folder.join("cache");
        (!self.no_cache).then(|| self.cache.clone().unwrap_or_else(beside))
    }
}

/// A result that has a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ResultOf {
    /// modes.json
    Modes,
    /// condense.json, of a mesh or of a superelement from a file
    Condense,
    /// frf.json
    Frf,
    /// bearing.json
    Bearing,
    /// run.json, and what run --explain prints
    Run,
    /// analysis.json, of one input or of several
    Analyze,
    /// chart.json
    Chart,
    /// stability.json
    Stability,
    /// sweep.json, and what --task and --slurm print
    Sweep,
    /// verify.json
    Verify,
    /// inspect.json
    Inspect,
    /// What init prints, of a case file or of the catalogue
    Init,
    /// export.json
    Export,
    /// What report prints
    Report,
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
        Command::Run { .. }
        | Command::Modes { .. }
        | Command::Condense { .. }
        | Command::Frf { .. }
        | Command::Bearing { .. }
        | Command::Chart { .. }
        | Command::Export { .. }
        | Command::Analyze(_)
        | Command::Sweep(_) => None,
        other => Some(other.name()),
    }
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser, ValueEnum};

    use super::{Arguments, ChartPart, Command, ExportFormat, word};

    fn parse(words: &str) -> Result<Arguments, clap::Error> {
        Arguments::try_parse_from(words.split(' '))
    }

    #[test]
    fn the_definition_is_consistent() {
        Arguments::command().debug_assert();
    }

    #[test]
    fn a_budget_has_its_unit() {
        for (text, seconds) in [("45s", 45.0), ("2min", 120.0), ("2 min", 120.0), ("1.5h", 5400.0), ("1e2s", 100.0)] {
            assert!((super::budget(text).unwrap().as_secs_f64() - seconds).abs() < 1e-9, "{text}");
        }
        for text in ["45", "2m", "", "min", "-1min", "0s", "0.5s", "nans", "infh", "1e9h", "2 weeks", "1:30min"] {
            let error = super::budget(text).unwrap_err();
            let expected = format!("expected a time from 1s to 8000h, such as 45s, 2min or 1h, found \"{text}\"");
            assert_eq!(error, expected);
        }
        let Arguments { command, .. } = parse("plummer chart a.toml --budget 2min").unwrap();
        assert!(matches!(command, Command::Chart { budget: Some(time), quick: false, .. } if time.as_secs() == 120));
    }

    #[test]
    fn what_was_typed_can_be_typed_again() {
        let words =
            ["--out", "a b", "run", "a.toml", "--cache=c", "--set", "x=1", "--force", "--threads", "2", "--quick"];
        let line = super::without_manner(words.into_iter().map(str::to_owned));
        assert_eq!(line, "plummer --out 'a b' run a.toml --set 'x=1' --quick");
    }

    #[test]
    fn options_stand_before_or_after_the_command() {
        for words in [
            "plummer run a.toml --out o --threads 3 --force --set a=1 --set b=2",
            "plummer --out o --threads 3 --force --set a=1 --set b=2 run a.toml",
        ] {
            let Arguments { command, options } = parse(words).unwrap();
            assert!(matches!(command, Command::Run { case, resume: false, .. } if case.as_os_str() == "a.toml"));
            assert_eq!(options.out.unwrap().as_os_str(), "o");
            assert_eq!(options.threads.unwrap().get(), 3);
            assert!(options.force && !options.quiet && !options.json);
            assert_eq!(options.set, ["a=1", "b=2"]);
        }
    }

    #[test]
    fn wrong_arguments_are_exit_code_2_and_help_is_0() {
        for words in [
            "plummer",
            "plummer run",
            "plummer rnu a.toml",
            "plummer run a.toml --threads 0",
            "plummer run a.toml --threads 1025",
            "plummer run a.toml --threads 100000",
            "plummer modes a.toml --fast",
            "plummer inspect a.msh --length-unit feet",
            "plummer inspect a.msh --density -1",
            "plummer export a.toml",
            "plummer export a.toml --to stl",
            "plummer chart a.toml --only speed",
            "plummer run a.toml --checkpoint-every -1",
            "plummer run a.toml --checkpoint-every NaN",
            "plummer analyze",
            "plummer analyze a.csv --window 3:2",
            "plummer analyze a.csv --speed fast",
            "plummer analyze a.csv --balls 9",
            "plummer analyze a.csv --orders outer=3.6 --bearing a.toml",
            "plummer analyze a.csv --rate 0",
            "plummer analyze a.csv --bearing 6205 --contact-angle 90",
            "plummer analyze a.csv --orders outer=3.6 --contact-angle 15",
            "plummer init",
            "plummer init a.msh --length-unit feet",
            "plummer init a.msh --list-bearings",
            "plummer init --list-bearings --list-materials",
        ] {
            assert_eq!(parse(words).unwrap_err().exit_code(), 2, "{words}");
        }
        for words in ["plummer --help", "plummer run --help", "plummer --version"] {
            assert_eq!(parse(words).unwrap_err().exit_code(), 0, "{words}");
        }
    }

    #[test]
    fn values_that_begin_with_a_minus_are_values() {
        for (words, said) in [
            ("plummer analyze a.csv --speed -30Hz", "-30Hz"),
            ("plummer analyze a.csv --rate -5", "expected a number above 0"),
            ("plummer inspect a.msh --density -1", "expected a number of kg/m^3 above 0"),
        ] {
            match parse(words) {
                Ok(Arguments { command: Command::Analyze(asked), .. }) => {
                    assert_eq!(asked.speed.unwrap().text, said);
                }
                Ok(_) => panic!("{words}"),
                Err(error) => {
                    let text = error.to_string();
                    assert!(text.contains(said) && !text.contains("use '--"), "{text}");
                }
            }
        }
    }

    #[test]
    fn every_help_has_an_example() {
        for words in [
            "plummer --help",
            "plummer run --help",
            "plummer modes --help",
            "plummer condense --help",
            "plummer frf --help",
            "plummer chart --help",
            "plummer inspect --help",
            "plummer init --help",
            "plummer analyze --help",
            "plummer export --help",
            "plummer verify --help",
            "plummer schema --help",
        ] {
            let help = parse(words).unwrap_err().to_string();
            assert!(help.contains("Example"), "{words}");
            assert!(help.contains("  plummer "), "{words}");
        }
    }

    #[test]
    fn formats_are_called_what_is_typed() {
        for format in ExportFormat::value_variants() {
            let words = format!("plummer export a.toml --to {}", word(*format));
            let command = parse(&words).unwrap().command;
            assert!(matches!(command, Command::Export { to, .. } if to == *format));
        }
    }

    #[test]
    fn parts_of_a_chart_are_called_what_is_typed_and_have_their_files() {
        let files = |words: &str| parse(words).unwrap().command.result_files();
        assert_eq!(files("plummer chart a"), ["chart.json", "stability.json"]);
        for (part, file) in [(ChartPart::Accuracy, "chart.json"), (ChartPart::Stability, "stability.json")] {
            let words = format!("plummer chart a --only {}", word(part));
            assert_eq!(files(&words), [file]);
        }
        assert_eq!(files("plummer run a"), ["run.json"]);
        assert_eq!(files("plummer analyze a"), ["analysis.json"]);
    }

    #[test]
    fn quiet_and_json_hide_progress() {
        let shown = |words| parse(words).unwrap().options.shows_progress();
        assert!(shown("plummer run a"));
        assert!(!shown("plummer run a --quiet"));
        assert!(!shown("plummer run a --json"));
    }
}
