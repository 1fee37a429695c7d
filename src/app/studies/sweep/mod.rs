//! Many runs of one case: the values that its keys take, what became of each point, one table.
//!
//! A [`Plan`] is the product of its [`Axis`]es; it is a file, so that points can be computed by other processes, on other
//! machines, and at other times (`slurm_scripts`). Each point leaves the files of its command in a folder of its own and,
//! last, a [`PointRecord`]. [`SweepResult::collect`] reads them; `SweepResult::table`, `write_sweep_npz` and
//! `sweep_report` show them. Nothing here starts a process: that is the command line's.
//!
//! **Limitations.** Axes are combined as a product; keys that move together are two sweeps. Each point reads and condenses
//! its housing anew: condense a large one once and name it by `housing.superelement`.

mod axis;
mod outputs;
mod plan;
mod plots;
mod report;
mod result;
mod slurm;
mod summary;
mod tables;
mod unit;

pub use axis::Axis;
pub use outputs::{Output, PlotOf};
pub use plan::{Plan, SweepPoint, SweptCommand};
pub(crate) use report::sweep_report;
pub(crate) use result::write_sweep_npz;
pub use result::{PointRecord, PointResult, PointState, PointWarning, SweepResult};
pub use slurm::SlurmScripts;
pub(crate) use slurm::slurm_scripts;
pub use summary::{AxisSummary, ColumnSummary, FigureValue, PointSummary, ScriptsSummary, SweepSummary, TaskSummary};
