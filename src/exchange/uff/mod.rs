//! Universal File Format (`.uff`, `.unv`), which modal analysis programs exchange.
//!
//! Written: datasets 151 (header), 164 (units, SI), 2411 (nodes), 2412 (elements), 55 (data at nodes: normal modes).
//! Read: 55 with nodes from 2411, 781 or 15. A dataset stands between lines `-1`, its number first. Source: University of
//! Cincinnati, Structural Dynamics Research Laboratory, "Universal file formats for modal analysis testing".
//!
//! # Limitations
//! Dataset 55 has 6 digits. Displacements along axes of their own (datasets 18, 2420) are refused when read.

mod cursor;
mod element;
mod error;
mod mode;
mod read;
#[cfg(test)]
mod tests;
mod write;

pub use error::UffError;
pub use read::{modes_from_bytes, read_modes_uff};
pub use write::{write_modes_uff, write_uff};
