//! `plummer schema`: its examples, and the results that have one.

use clap::ValueEnum;

pub(super) const SCHEMA_EXAMPLE: &str = "\
Examples: a schema by which an editor with taplo or Even Better TOML completes and checks case files; that of modes.json
  plummer schema > plummer.schema.json
  plummer schema --results modes

The first line of a case file names the schema, relative to the case: #:schema plummer.schema.json
The schema has the keys, kinds of values, options, and keys that exclude each other. Ranges, and what depends on the mesh, are
checked by every command that reads a case.";

/// A result that has a schema.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ResultOf {
    /// modes.json
    Modes,
    /// condense.json, of a mesh or of a superelement from a file
    Condense,
    /// frf.json
    Frf,
    /// bearing.json
    Bearing,
    /// run.json, and what run --explain prints
    Run,
    /// analysis.json, of one input or of several
    Analyze,
    /// chart.json
    Chart,
    /// stability.json
    Stability,
    /// sweep.json, and what --task and --slurm print
    Sweep,
    /// manifest.json
    Dataset,
    /// verify.json
    Verify,
    /// inspect.json
    Inspect,
    /// What init prints, of a case file or of the catalogue
    Init,
    /// export.json
    Export,
    /// What report prints
    Report,
}
