//! A run that has not ended: its rows and its last checkpoint in a folder of their own, from which it goes on.
//!
//! `checkpoint` holds all that the rest of the run depends on, and how many rows of the columns beside it
//! ([`ColumnFiles`]) belong to it. The rows reach the disk before the checkpoint that counts them takes the place of the one
//! before: whenever the program ends, the checkpoint that is there and the rows that it counts are whole.

use super::checkpoint::{self, Checkpoint, RunIdentity};
use crate::app::commands::run::{Checkpoints, RunRequest};
use crate::app::error::ComputeError;
use crate::files;
use crate::formats::ColumnFiles;
use crate::numerics::ode::Snapshot;
use crate::system::RecordLayout;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Wall time between checkpoints unless another is asked for, s.
pub const CHECKPOINT_S: f64 = 10.0;

/// Least wall time between checkpoints in units of what the last one took: they take 4 % of the time at most.
pub(crate) const LEAST_PAUSE: u32 = 25;

/// The checkpoint in the folder.
pub(crate) const FILE: &str = "checkpoint";

/// What is asked of a run from outside, by signals.
#[derive(Debug, Clone, Default)]
pub struct StopRequest {
    /// To keep a checkpoint and stop.
    pub asked: Arc<AtomicBool>,
    /// Whether nobody would listen: a request then ends the program at once.
    pub deaf: Arc<AtomicBool>,
}

/// The folder of an unfinished run.
#[derive(Debug)]
pub struct UnfinishedRun {
    /// Where it is.
    pub(crate) folder: PathBuf,
    identity: RunIdentity,
    /// Wall time between checkpoints, if they do not take too much of it.
    pub(crate) every: Duration,
    /// What is asked of it from outside.
    pub(crate) stop: StopRequest,
    /// To go on from.
    resumed: Option<Checkpoint>,
    last: Instant,
    cost: Duration,
}

impl UnfinishedRun {
    /// Whether a folder holds a checkpoint.
    pub(crate) fn is_in(folder: &Path) -> bool {
        folder.join(FILE).exists()
    }

    /// A run that begins: the folder is made when it comes to stepping, and an earlier run in it given up then.
    #[must_use]
    pub fn begin(folder: &Path, identity: RunIdentity) -> Self {
        Self {
            folder: folder.to_owned(),
            identity,
            every: Duration::from_secs_f64(CHECKPOINT_S),
            stop: StopRequest::default(),
            resumed: None,
            last: Instant::now(),
            cost: Duration::ZERO,
        }
    }

    /// The run in a folder, to go on.
    ///
    /// # Errors
    /// [`ComputeError`] if there is none, if what it was begun with is not what it would go on with, or if it is damaged.
    pub(crate) fn resume(folder: &Path, identity: RunIdentity) -> Result<Self, ComputeError> {
        files::no_link(folder).map_err(of_folder(folder))?;
        if !Self::is_in(folder) {
            return Err(ComputeError::input(
                format!("{} has no checkpoint: there is no unfinished run to go on with", folder.display()),
                "leave --resume out to begin a run",
            ));
        }
        let checkpoint = Checkpoint::read(&folder.join(FILE))?;
        let changes = checkpoint.identity.changes(&identity);
        if !changes.is_empty() {
            return Err(ComputeError::input(
                format!("the run in {} was begun with something else: {}", folder.display(), changes.join("; ")),
                format!("go on with what it was begun with, or {}", ComputeError::ANEW),
            ));
        }
        Ok(Self { resumed: Some(checkpoint), ..Self::begin(folder, identity) })
    }

    /// Removes what a run keeps in the folder, the checkpoint first: it has ended and its results are written, or another begins.
    /// Files of others stay, and the folder with them.
    ///
    /// # Errors
    /// [`ComputeError`] when the system refuses.
    pub(crate) fn remove(&self) -> Result<(), ComputeError> {
        let folder = &self.folder;
        files::no_link(folder).map_err(of_folder(folder))?;
        files::remove(&folder.join(FILE)).map_err(of_folder(folder))?;
        let own = |path: &Path| {
            path.is_file() && path.extension().is_some_and(|ending| ending == "f64" || ending == "partial")
        };
        let mut is_empty = true;
        for entry in fs::read_dir(folder).into_iter().flatten() {
            let path = entry.map_err(of_folder(folder))?.path();
            if own(&path) {
                fs::remove_file(&path).map_err(of_folder(folder))?;
            } else {
                is_empty = false;
            }
        }
        if is_empty && folder.exists() {
            fs::remove_dir(folder).map_err(of_folder(folder))?;
        }
        Ok(())
    }
}

/// What a failure to make or remove a folder is.
fn of_folder(folder: &Path) -> impl FnOnce(io::Error) -> ComputeError {
    |source| ComputeError::Failed {
        what: format!("cannot make or remove the folder {}: {source}", folder.display()),
        help: None,
    }
}

impl Checkpoints for UnfinishedRun {
    type Record = ColumnFiles;

    fn open(&mut self, layout: RecordLayout) -> Result<(ColumnFiles, Option<Snapshot>), ComputeError> {
        let opened = match self.resumed.take() {
            None => {
                self.remove()?;
                fs::create_dir_all(&self.folder).map_err(of_folder(&self.folder))?;
                (ColumnFiles::create(&self.folder, layout)?, None)
            }
            Some(checkpoint) => {
                let record = ColumnFiles::resume(&self.folder, layout, checkpoint.rows)?;
                if record.digest() != checkpoint.columns_sha256 {
                    let what = "the rows in its columns are not those that the checkpoint counts";
                    return Err(checkpoint::damaged(&self.folder, what));
                }
                (record, Some(checkpoint.snapshot))
            }
        };
        // long columns take their time, in which an interrupt ends the program at once
        self.stop.deaf.store(false, Ordering::SeqCst);
        self.last = Instant::now();
        Ok(opened)
    }

    fn request(&mut self) -> RunRequest {
        if self.stop.asked.load(Ordering::Relaxed) {
            RunRequest::Stop
        } else if self.last.elapsed() >= self.every.max(LEAST_PAUSE * self.cost) {
            RunRequest::Checkpoint
        } else {
            RunRequest::GoOn
        }
    }

    fn save(&mut self, record: &ColumnFiles, t: f64, snapshot: &Snapshot) -> Result<(), ComputeError> {
        let began = Instant::now();
        record.sync()?;
        let path = self.folder.join(FILE);
        checkpoint::write(&path, &self.identity, record, t, snapshot)?;
        self.last = Instant::now();
        self.cost = self.last - began;
        Ok(())
    }

    fn close(&mut self) {
        self.stop.deaf.store(true, Ordering::SeqCst);
    }
}
