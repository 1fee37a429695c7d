//! What can go wrong on the way from a case to a result.
//!
//! [`ComputeError`] says what failed, whose fault it is and what to do; [`ImportError`] and [`UnfinishedError`] are its parts
//! for a superelement from a file and for a run that cannot go on.

mod compute;
mod import;
mod unfinished;

pub use compute::ComputeError;
pub use import::ImportError;
pub use unfinished::UnfinishedError;
