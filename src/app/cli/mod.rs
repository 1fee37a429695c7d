//! The command line: arguments to a case, a case to a computation, its outcome to files and text.
//!
//! Computations return data; only this module prints. Exit codes: 0 done; 1 it ran and the answer is bad, or could not
//! be computed; 2 the input is wrong. A result goes to standard output, progress and errors to standard error.

mod analyze;
mod arguments;
mod bearing;
mod chart;
mod condense;
mod dataset;
mod earlier_results;
mod export;
mod failure;
mod frf;
#[allow(unsafe_code)]
mod heap;
mod init;
mod inspect;
mod modes;
mod output;
mod progress;
mod progress_lines;
mod report;
mod results;
mod run;
mod schema;
mod share;
mod shell;
mod sweep;
mod verify;

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::Path;
use std::time::Duration;

use clap::Parser;

pub use analyze::{AnalyzeArguments, GivenOrders, GivenSpeed};
pub use arguments::{Arguments, ChartPart, Command, ExportFormat, InitArguments, Options, ResultOf};
use arguments::{typed, word};
pub use dataset::DatasetArguments;
use earlier_results::{left_in, lost_with, result_of};
pub use failure::CliError;
use output::printed;
pub use output::{Outcome, OutputFolder};
pub(crate) use output::{emit, write_atomic};
pub use progress::Progress;
pub use report::write_report;
use results::Job;
pub use share::Share;
pub use sweep::SweepArguments;

use crate::app::case::{Case, Purpose};
use crate::app::program;
use crate::app::scene::doubts_of_case;
use crate::app::shell_word::{cut, printable};

/// Stack of the thread that computes, in bytes: what Linux gives a process by default, whatever `ulimit -s` says.
const STACK: usize = 8 << 20;

/// Runs the program on the process's arguments, and ends with its exit code.
pub fn main() -> ! {
    let code = main_of(std::env::args_os().skip(1).collect());
    #[cfg(feature = "mumps-mpi")]
    crate::numerics::linalg::leave();
    let _ = io::stdout().flush();
    // at once: what OpenBLAS does last is to wait for its threads, which wait for ever where memory is short
    signal_hook::low_level::exit(code.into())
}

/// Runs the program on `arguments`, which do not begin with its name, and returns its exit code: 0, 1 or 2. Once a process;
/// signals belong to the program from then on.
#[must_use]
pub fn main_of(arguments: Vec<OsString>) -> u8 {
    heap::keep_freed_memory();
    // before MPI begins, which takes the signals that nobody has taken
    if let Err(error) = failure::fail_at_limits() {
        return told(&error);
    }
    #[cfg(feature = "mumps-mpi")]
    if crate::numerics::linalg::joined() {
        return 0;
    }
    program::declare_arguments(arguments);
    let named = std::thread::Builder::new().name("main".to_owned());
    match named.stack_size(STACK).spawn(on_arguments) {
        Ok(work) => work.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        Err(error) => {
            let _ = writeln!(
                io::stderr(),
                "error: a thread with a stack of {} MiB could not be started: {error}\nhelp: raise the limits of memory and threads (ulimit -v, ulimit -u)",
                STACK >> 20
            );
            1
        }
    }
}

fn on_arguments() -> u8 {
    let words = program::arguments();
    if let Some(word) = words.iter().find(|word| word.to_str().is_none()) {
        let word = word.to_string_lossy();
        let _ = writeln!(
            io::stderr(),
            "error: argument \"{word}\": expected text in UTF-8, found other bytes\nhelp: rename the file or its folder"
        );
        return 2;
    }
    let arguments = match Arguments::try_parse_from([OsString::from("plummer")].into_iter().chain(words)) {
        Ok(arguments) => arguments,
        Err(error) => {
            let text = error.render().to_string();
            let short = cut(&text);
            let written = if short == text { error.print() } else { writeln!(io::stderr(), "{short}") };
            let code = u8::try_from(error.exit_code()).unwrap_or(2);
            return if code == 0 { printed(written).map_or_else(|error| told(&error), |()| 0) } else { code };
        }
    };
    match failure::catch_interrupts().and_then(|()| execute(&arguments, &mut io::stdout().lock())) {
        Ok(()) => 0,
        Err(error) => told(&error),
    }
}

/// The exit code of an error, which is told.
fn told(error: &CliError) -> u8 {
    error.report(&mut io::stderr().lock());
    error.exit_code()
}

/// Address space of a thread, bytes: its stack of 2 MB, and what it allocates to begin.
const OF_THREAD: usize = (2 << 20) + (256 << 10);

/// Carries out one command and writes its result to `to`.
///
/// # Errors
/// [`CliError`] when the input is wrong, the computation fails, its answer is bad, or a file cannot be written.
pub(crate) fn execute(arguments: &Arguments, to: &mut impl Write) -> Result<(), CliError> {
    arguments::check_set(arguments)?;
    crate::numerics::linalg::check_asked().map_err(|error| CliError::input(error.to_string()))?;
    let options = &arguments.options;
    let threads = options.cores();
    if let Some(asked) = options.threads.filter(|asked| asked.get() > threads && options.shows_progress()) {
        let _ = writeln!(
            io::stderr(),
            "note: --threads {asked} is more than this process has cores, which would take turns: {threads} compute"
        );
    }
    let cannot = |why: &str| {
        CliError::failed(format!("the threads that compute cannot be started: {why}"))
            .with_help("use fewer with --threads, or raise the limits of memory and threads (ulimit -v, ulimit -u)")
    };
    // a thread that begins without memory ends the program before it can say why
    let mut room: Vec<u8> = Vec::new();
    if room.try_reserve_exact(threads.saturating_mul(OF_THREAD)).is_err() {
        return Err(cannot("the memory does not suffice"));
    }
    drop(std::hint::black_box(room));
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    // a pool that is already there stays: results do not depend on the number of threads
    if let Err(error) = pool.build_global()
        && let Some(source) = std::error::Error::source(&error)
    {
        return Err(cannot(&source.to_string()));
    }
    let outcome = match &arguments.command {
        Command::Completions { shell } => return shell::completions(*shell, to),
        Command::Man => return shell::man(options, to),
        Command::Run { case, explain: true, .. } => compute(case, Purpose::Run, arguments, run::explain),
        Command::Run { case, resume, checkpoint_every, .. } => compute(case, Purpose::Run, arguments, |job| {
            run::run(job, *resume, Duration::from_secs_f64(*checkpoint_every))
        }),
        Command::Modes { case } => compute(case, Purpose::Modes, arguments, modes::modes),
        Command::Condense { case, compare_full } => {
            compute(case, Purpose::Condense, arguments, |job| condense::condense(job, *compare_full))
        }
        Command::Bearing { case, rpm, hold_tilt } => {
            compute(case, Purpose::Bearing, arguments, |job| bearing::bearing(job, *rpm, *hold_tilt))
        }
        Command::Frf { case } => compute(case, Purpose::Frf, arguments, frf::frf),
        Command::Chart { case, quick, budget, only } => {
            let asked = chart::Asked::new(*quick, *budget, *only);
            compute(case, Purpose::Chart, arguments, |job| chart::chart(job, asked))
        }
        Command::Export { from, to } => export::export(from, *to, options),
        Command::Analyze(asked) => analyze::analyze(asked, options),
        Command::Sweep(asked) => sweep::sweep(asked, options),
        Command::Dataset(asked) => dataset::dataset(asked, options),
        Command::Report { folder } => report::report(folder, options),
        Command::Verify { full } => verify::verify(*full, options),
        Command::Schema { results, dataset } => return emit(to, &format!("{:#}", schema::schema(*results, *dataset))),
        Command::Init(asked) => init::init(asked, options),
        Command::Inspect { mesh, length_unit, density, straighten } => {
            inspect::inspect(mesh, *length_unit, *density, *straighten, options)
        }
    }?;
    outcome.show(options, to)?;
    outcome.verdict
}

/// Reads a case, takes the folder for its results, and does `work` with it.
fn compute(
    path: &Path,
    purpose: Purpose,
    arguments: &Arguments,
    work: impl FnOnce(&Job<'_>) -> Result<Outcome, CliError>,
) -> Result<Outcome, CliError> {
    let options = &arguments.options;
    let case = Case::load(path, &options.set)?;
    case.ready_for(purpose)?;
    let cache = match arguments.command {
        // writes nothing of its own accord
        Command::Run { explain: true, .. } => options.cache.clone(),
        _ => options.cache_in(&OutputFolder::of(&case, options).path),
    };
    let progress = Progress::new(options.shows_progress()).with_cache(cache);
    let job = Job::new(arguments.command.name(), &case, options, &progress);
    match arguments.command {
        Command::Run { explain: true, .. } => {}
        Command::Run { resume: true, .. } => run::claim_unfinished(&job.folder, options.force)?,
        _ => job.folder.claim_unless(&arguments.command.result_files(), options.force, |path| {
            let earlier = result_of(job.command, path);
            arguments.command.lost_with(&earlier).or_else(|| lost_with(&earlier, &case))
        })?,
    }
    failure::on_interrupt(left_in(&job.folder.path, job.command, options.force));
    let outcome = work(&job);
    progress.finish();
    if outcome.as_ref().is_err_and(|error| !error.is_input) {
        // what of the input is in doubt may be why nothing could be computed
        for doubt in doubts_of_case(&case).unwrap_or_default() {
            let _ = writeln!(io::stderr(), "warning: {}", printable(&doubt));
        }
    }
    outcome.map(|outcome| {
        let summary = progress.reused().into_iter().chain([outcome.summary]).collect::<Vec<_>>().join("\n");
        Outcome { summary, ..outcome }
    })
}
