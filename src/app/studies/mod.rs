//! Studies that run one case many times: in comes a case with what is varied, out go tables, plots and a report.
//!
//! - [`chart`]: speed against accuracy over methods, steps and sizes of the model, and the stability map;
//! - [`dataset`]: labelled signals of bearings drawn from distributions;
//! - [`sweep`]: other values of the case's keys, one table.

pub mod chart;
pub mod dataset;
pub mod sweep;
