//! Universal File Format (`.uff`, `.unv`), which modal analysis programs exchange.
//!
//! Written: datasets 151 (header), 164 (units, SI), 2411 (nodes), 2412 (elements), 55 (data at nodes: normal modes), 58
//! (functions at nodes: frequency responses). Read: 55 with nodes from 2411, 781 or 15; 58; 58b of signals over time. A dataset stands between lines `-1`, its number first. Source: University of
//! Cincinnati, Structural Dynamics Research Laboratory, "Universal file formats for modal analysis testing".
//!
//! # Limitations
//! Dataset 55 has 6 digits, dataset 58 has 13 and frequencies with 6. Binary frequency responses (58b) are not read. Displacements along axes of their own (datasets 18, 2420) are refused when read.

mod binary;
mod cursor;
mod function;
mod read;
mod read_response;
mod read_time;
mod response;
#[cfg(test)]
mod response_tests;
#[cfg(test)]
mod tests;
mod write;
mod write_response;

pub use read::{modes_from_bytes, read_modes_uff};
pub use read_response::{read_responses_uff, responses_from_bytes};
pub use read_time::{TimeAxis, TimeResponse, read_times_uff, times_from_bytes};
pub use response::{FrequencyResponse, ResponseKind, ResponsePoint};
pub use write::{write_modes_uff, write_uff};
pub use write_response::write_responses_uff;
