//! Measured signals, from the files of recorders and of this program.
//!
//! | ending | time | channels |
//! |---|---|---|
//! | `.npz` | array `time_s`, `time` or `t`, or a rate `rate_hz`, `fs` or `sampling_rate` (Hz) | arrays as long as the time; without one, every array of one dimension |
//! | `.mat` (MATLAB 5 to 7) | the same beside the signal, in its struct or in the file; more names of rates | vectors; columns of tables `x(:,1)`; fields of structs `bearing.gs` |
//! | `.csv`, `.txt`, `.tsv`, `.asc`, `.lvm` | a column `time`, `time_s`, `t`, `Zeit`, with a unit `(ms)`, `[us]`, `/ ns` or `in s`; of several the nearest to the left; without a header the first column; LabVIEW's `Delta_X` | the others; names and units from the header, `P1 (m/s^2)`; lines above it are left out |
//! | `.wav` | the file's rate | one a channel, full scale 1 (`channel 1`, `channel 2`) |
//! | `.uff`, `.unv` | of the data set | data sets 58 and 58b of function type 1 over time |
//!
//! Archives and MATLAB files may state the shaft's speed too, by a number called `speed_hz`, `shaft_speed_hz` or `...rpm`; MATLAB
//! files also by `rate` beside a sampling rate in one struct.
//!
//! A rate that is asked for goes before what the file says of time; the first instant stays the file's. A time that is not
//! uniform is refused ([`MeasuredError::Refused`]): a spectrum of such samples has lines that the signal does not have.
//!
//! What it hands on is a [`TimeSeries`](crate::numerics::series::TimeSeries). Memory stays below ten times the file's size (npz arrays: what [`NpzReader`](super::NpzReader) says;
//! MATLAB files: 20 times, or 20 000 times where variables are packed): sizes that a file only promises are not believed.

mod channel;
mod csv;
mod error;
mod mat;
mod names;
mod npz;
#[cfg(test)]
mod npz_tests;
mod read;
#[cfg(test)]
mod tests;
mod wav;
#[cfg(test)]
mod wav_tests;

pub use channel::{MeasuredSignal, SignalRequest};
pub use error::MeasuredError;
pub use mat::signals_from_mat;
pub use read::read_signals;
