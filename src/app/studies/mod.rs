//! Studies that run one case many times.
//!
//! - [`chart`]: speed against accuracy over methods, steps and sizes of the model, and the stability map;
//! - [`sweep`]: other values of the case's keys, one table.

pub mod chart;
pub mod sweep;
