//! Computing the points of a sweep: each a process of this program, as many at once as there are cores.

use std::ffi::OsStr;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use super::super::earlier_results::PARTIAL;
use super::super::output::is_taken;
use super::super::{CliError, Options, write_atomic};
use super::Share;
use crate::app::commands::run::unfinished::{StopRequest, UnfinishedRun};
use crate::app::error::ComputeError;
use crate::app::program::Program;
use crate::app::studies::sweep::{Plan, PointRecord, SweepPoint, SweptCommand};
use crate::files;

/// Pause between two looks at a process.
const LOOK: Duration = Duration::from_millis(10);
/// How long a process may take to end by itself after a signal that may have reached it too.
const PATIENCE: Duration = Duration::from_secs(1);

/// This program.
///
/// # Errors
/// [`ComputeError::Failed`] if the system does not say where it is.
pub(super) fn program() -> Result<Program, ComputeError> {
    Program::this().map_err(ComputeError::io(Path::new("plummer")))
}

/// So many processes at once, so many threads each.
#[derive(Debug)]
pub(super) struct Workers {
    program: Program,
    count: usize,
    threads: usize,
    /// Where the points look for condensed housings, and leave them for one another.
    cache: Option<PathBuf>,
    stop: StopRequest,
}

impl Workers {
    /// As many as `--threads` says or there are cores, but no more than points; cores that are left over become the processes'
    /// threads.
    ///
    /// # Errors
    /// [`ComputeError::Failed`] if the system does not say where this program is.
    pub(super) fn new(
        options: &Options,
        folder: &Path,
        points: usize,
        stop: StopRequest,
    ) -> Result<Self, ComputeError> {
        let cores = options.cores();
        let count = cores.min(points).max(1);
        let threads = (cores / count).max(1);
        Ok(Self { program: program()?, count, threads, cache: options.cache_in(folder), stop })
    }

    /// Computes the points of a share that have no result yet; how many of them are there if it was asked to stop before the
    /// last, else `None`.
    ///
    /// # Errors
    /// [`CliError`] when a process cannot be started or a file of a point cannot be written; the first one.
    pub(super) fn compute(
        &self,
        plan: &Plan,
        sweep: &Path,
        share: Share,
        watch: &(dyn Fn(f64) + Sync),
    ) -> Result<Option<usize>, CliError> {
        let points: Vec<SweepPoint> = plan.points().filter(|point| share.has(point.number)).collect();
        let (next, done) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let failure = Mutex::new(None);
        let failed = || failure.lock().unwrap_or_else(PoisonError::into_inner).is_some();
        self.stop.deaf.store(false, Ordering::SeqCst);
        let work = || {
            while !self.stopping() && !failed() {
                let Some(point) = points.get(next.fetch_add(1, Ordering::SeqCst)) else {
                    return;
                };
                match self.point(plan, sweep, point) {
                    Ok(true) => {
                        let done = done.fetch_add(1, Ordering::SeqCst) + 1;
                        watch(done as f64 / points.len() as f64);
                    }
                    Ok(false) => return,
                    Err(error) => {
                        let mut first = failure.lock().unwrap_or_else(PoisonError::into_inner);
                        first.get_or_insert(error);
                    }
                }
            }
        };
        thread::scope(|scope| {
            for _ in 0..self.count {
                scope.spawn(work);
            }
        });
        self.stop.deaf.store(true, Ordering::SeqCst);
        if let Some(error) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            return Err(error);
        }
        let done = done.into_inner();
        Ok((done < points.len()).then_some(done))
    }

    fn stopping(&self) -> bool {
        self.stop.asked.load(Ordering::SeqCst)
    }

    /// Computes one point unless it has a result; false if it was stopped.
    fn point(&self, plan: &Plan, sweep: &Path, point: &SweepPoint) -> Result<bool, CliError> {
        let folder = plan.folder(sweep, point.number);
        // a sweep that was killed leaves its processes, which end their points
        while is_taken(&folder) {
            if self.stopping() {
                return Ok(false);
            }
            thread::sleep(LOOK);
        }
        let result = folder.join(format!("{}.json", plan.command.name()));
        let record = PointRecord::read(&folder);
        if PointRecord::state(record.as_ref(), result.exists()).has_result() {
            return Ok(true);
        }
        let begun = Instant::now();
        let io = ComputeError::io;
        let name = folder.strip_prefix(sweep).unwrap_or(&folder);
        files::make_below(sweep, name).map_err(io(&folder))?;
        // of an earlier try
        let file = PointRecord::file(&folder);
        files::remove(&file).map_err(io(&file))?;
        let log = folder.join("log.txt");
        files::no_link(&log).map_err(io(&log))?;
        let unfinished = UnfinishedRun::is_in(&folder.join(PARTIAL));
        let resume = plan.command == SweptCommand::Run && unfinished;
        let mut status = self.attempt(plan, point, &folder, &log, if resume { "--resume" } else { "--force" })?;
        // one that cannot go on begins anew, and so does whatever else is there
        if resume && status.code() == Some(2) {
            status = self.attempt(plan, point, &folder, &log, "--force")?;
        }
        if self.stopping() && !result.exists() {
            return Ok(false);
        }
        let text = fs::read_to_string(&log).map_err(io(&log))?;
        let record = PointRecord {
            exit_code: status.code(),
            message: message(&text, status),
            wall_s: begun.elapsed().as_secs_f64(),
        };
        let json = serde_json::to_string_pretty(&record).unwrap_or_default();
        write_atomic(&PointRecord::file(&folder), format!("{json}\n").as_bytes())?;
        Ok(true)
    }

    /// Computes a point by a process of its own, which says to `log` what it says.
    fn attempt(
        &self,
        plan: &Plan,
        point: &SweepPoint,
        folder: &Path,
        log: &Path,
        beginning: &str,
    ) -> Result<ExitStatus, ComputeError> {
        let io = ComputeError::io;
        let file = File::create(log).map_err(io(log))?;
        let mut command = self.program.command();
        command
            .arg(plan.command.name())
            .arg(&plan.case)
            .arg("--out")
            .arg(folder)
            .args(["--quiet", "--threads", &self.threads.to_string()])
            .args(point.set.iter().flat_map(|set| ["--set", set]))
            .arg(beginning)
            .args(self.cache.iter().flat_map(|cache| [OsStr::new("--cache"), cache.as_os_str()]))
            .args(self.cache.is_none().then_some("--no-cache"))
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::from(file));
        let child = command.spawn().map_err(io(&self.program.code))?;
        self.wait(child).map_err(io(&self.program.code))
    }

    /// Waits for a process, and asks it to end when this one is asked to.
    fn wait(&self, mut child: Child) -> std::io::Result<ExitStatus> {
        let mut asked_at = None;
        loop {
            if let Some(status) = child.try_wait()? {
                return Ok(status);
            }
            if self.stopping() {
                let since = *asked_at.get_or_insert_with(Instant::now);
                if since.elapsed() > PATIENCE {
                    // the signal has not reached it: a terminal's does, one to this process alone does not
                    let id = child.id().to_string();
                    Command::new("kill").args(["-TERM", &id]).status()?;
                    return child.wait();
                }
            }
            thread::sleep(LOOK);
        }
    }
}

/// What a process said when it failed: its error line and what to do, or the last line there is.
fn message(log: &str, status: ExitStatus) -> String {
    if status.success() {
        return String::new();
    }
    let lines: Vec<&str> = log.lines().collect();
    let error = lines.iter().position(|line| line.starts_with("error: "));
    match (error, lines.last()) {
        (Some(place), _) => lines[place..].join("\n").replacen("error: ", "", 1),
        (None, Some(last)) => (*last).to_owned(),
        (None, None) => status.to_string(),
    }
}
