//! Files that other programs read and write.
//!
//! | format | ending | written | read |
//! |---|---|---|---|
//! | VTK XML unstructured grid ([`vtu`]) | `.vtu` | mesh, fields | |
//! | Universal File Format ([`uff`]) | `.uff`, `.unv` | mesh, mode shapes, frequency responses | mode shapes, frequency responses |
//! | NumPy archive ([`npz`]) | `.npz` | arrays, sparse matrices, mode shapes | arrays, mode shapes |
//! | result file of CalculiX ([`frd`]) | `.frd` | | mode shapes |
//! | input file of CalculiX, Abaqus | `.inp` | mesh, sets, materials, a step | by [`Mesh::read`](crate::fe::mesh::Mesh::read) |
//! | comma-separated values ([`csv`]) | `.csv` | mode shapes | mode shapes |
//! | Matrix Market ([`matrix_market`]) | `.mtx` | symmetric matrices, sparse and dense | |
//! | Nastran OUTPUT4 ([`op4`]) | `.op4` | matrices | matrices |
//! | superelement ([`superelement`]) | `.npz`, `.op4`, `.bdf`, `.fem` | everything of a condensed housing | `.npz` |
//! | columns of a run under way ([`ColumnFiles`]) | `.f64` | time, sensors, forces | the same |
//! | measured signals ([`measured`]) | `.npz`, `.mat`, `.csv`, `.wav`, `.uff` | | signals over time |
//! | table of degrees of freedom ([`dof_table`]) | `.csv`, `.npz` | rows of matrices | |
//!
//! Every file is written under a temporary name and renamed: a half-written file never carries its name.
//! Mode shapes are [`ModeShapes`] in all formats; [`read_mode_shapes`] picks the format by the file's ending.

mod bytes;
mod columns;
pub mod csv;
pub mod dof_table;
mod error;
mod fortran;
pub mod frd;
mod inp;
pub mod matrix_market;
pub mod measured;
mod mode_shapes;
pub mod npz;
pub mod op4;
mod parquet;
mod read_modes;
pub mod superelement;
pub mod uff;
pub mod vtu;

pub use columns::ColumnFiles;
pub(crate) use columns::column_name;
pub use csv::{read_modes_csv, write_modes_csv};
pub use dof_table::{DofBody, DofDirection, DofLabel, write_dofs_csv, write_dofs_npz};
pub use error::FormatError;
pub use frd::read_modes_frd;
pub(crate) use inp::{InpJob, write_inp};
pub use matrix_market::{write_dense_matrix_market, write_matrix_market};
pub use measured::{MeasuredError, MeasuredSignal, SignalRequest, read_signals};
pub use mode_shapes::ModeShapes;
pub use npz::{NpzArray, NpzReader, NpzWriter, is_array_name, read_modes_npz, write_modes_npz, write_sparse_npz};
pub use op4::{Op4Format, Op4Matrix, op4_from_bytes, read_op4, write_op4};
pub(crate) use parquet::{ParquetColumn, ParquetValues, write_parquet};
pub use read_modes::read_mode_shapes;
pub(crate) use read_modes::read_mode_shapes_in;
pub use superelement::{
    FieldRecovery, InterfaceRecovery, MbdynReference, MbdynSummary, SensorRow, SuperelementRecord,
    read_superelement_npz, read_superelement_op4, write_mbdyn_fem, write_superelement_dmig, write_superelement_npz,
    write_superelement_op4,
};
pub use uff::{
    FrequencyResponse, ResponseKind, ResponsePoint, read_modes_uff, read_responses_uff, write_modes_uff,
    write_responses_uff, write_uff,
};
pub use vtu::{Field, FieldValues, write_vtu};
