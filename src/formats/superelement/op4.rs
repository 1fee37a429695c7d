//! A superelement's matrices under Nastran's names.

use std::path::Path;

use super::SuperelementRecord;
use crate::files::Fault;
use crate::formats::op4::{Op4Format, Op4Matrix, read_op4, write_op4};
use crate::formats::{DofLabel, FormatError};
use crate::numerics::linalg::DenseMatrix;

/// Names of 1 x 1 matrices: top of the band that it was condensed for, and the first vector that was left out, Hz.
const BAND: &str = "BANDHZ";
const COMPLETE: &str = "COMPLHZ";

/// Name of the table of the boundary set.
const BOUNDARY: &str = "BSET";

/// Stiffness between modes, relative to both diagonals, that is round-off of a computation.
const BLOCK: f64 = 1e-8;

/// Reads the matrices that [`write_superelement_op4`] names, whether in capitals or not; `KAA` and `MAA` are required.
/// Matrices that are symmetric within the limit of [`SuperelementRecord::check`] become exactly so.
///
/// The file does not say how many coordinates are those of the interface. `interface` has what it may be, ascending:
/// the first after which the stiffness is that of modes, a diagonal with nothing beside it, else the largest that the
/// matrices have rows for; all rows if they are too few for any. Labels are numbers alone ([`DofLabel::interface`]).
///
/// # Errors
/// [`FormatError::File`] for files that cannot be read and for matrices that are missing, [`FormatError::Data`] for matrices
/// that contradict each other.
pub fn read_superelement_op4(path: &Path, interface: &[usize]) -> Result<SuperelementRecord, FormatError> {
    let matrices = read_op4(path)?;
    let dense = |name: &str| {
        let mut matrices = matrices.iter();
        let found = matrices.find(|matrix| matrix.name().eq_ignore_ascii_case(name));
        found.map(Op4Matrix::dense).transpose()
    };
    let required = |name: &'static str| {
        let known = || match matrices.iter().map(Op4Matrix::name).collect::<Vec<_>>() {
            names if names.is_empty() => "none".to_owned(),
            names => names.join(", "),
        };
        dense(name)?.ok_or_else(|| FormatError::from(Fault::new(format!("a matrix \"{name}\""), known()).of(path)))
    };
    let (stiffness, mass) = (required("KAA")?, required("MAA")?);
    let count = interface_of(&stiffness, interface);
    let labels = (0..count as u64).map(DofLabel::interface).collect();
    let mut record = SuperelementRecord::of_matrices(stiffness, mass, labels)?;
    (record.damping, record.structural) = (dense("BAA")?, dense("K4AA")?);
    let frequency = |name: &str| -> Result<Option<f64>, Fault> {
        let matrix = dense(name)?.filter(|matrix| matrix.nrows() == 1 && matrix.ncols() == 1);
        let value = matrix.map(|matrix| matrix[(0, 0)]);
        Ok(value.filter(|hz| *hz > 0.0 && hz.is_finite()))
    };
    (record.band_hz, record.complete_hz) = (frequency(BAND)?, frequency(COMPLETE)?);
    record.check()?;
    record.symmetrise();
    Ok(record)
}

/// How many of the coordinates are those of the interface.
fn interface_of(stiffness: &DenseMatrix, candidates: &[usize]) -> usize {
    let order = stiffness.nrows().min(stiffness.ncols());
    let fitting = || candidates.iter().copied().filter(|&count| count <= order);
    let modal = |&first: &usize| (first..order).all(|mode| is_modal(stiffness, order, mode));
    let found = fitting().find(modal);
    found.or_else(|| fitting().next_back()).unwrap_or(order)
}

/// Whether a coordinate's stiffness is its own alone.
fn is_modal(stiffness: &DenseMatrix, order: usize, mode: usize) -> bool {
    let own = stiffness[(mode, mode)];
    (0..order).filter(|&row| row != mode).all(|row| {
        let scale = (own * stiffness[(row, row)]).abs().sqrt();
        stiffness[(row, mode)].abs() <= BLOCK * scale
    })
}

/// Writes the matrices \[n x n\] of a superelement, whole or not at all: `KAA` (stiffness), `MAA` (mass) and, where there
/// are any, `BAA` (viscous damping) and `K4AA` (imaginary part of the stiffness), and as 1 x 1 matrices what is known of `BANDHZ` (top of the band that
/// it was condensed for, Hz) and `COMPLHZ` (the first vector that was left out, Hz). Rows are those of
/// [`SuperelementRecord::labels`]: the boundary set first, then the modes, as Nastran's external superelements have them. `BSET`
/// \[b x 2\] has node and component ([`DofDirection::component`](crate::formats::DofDirection::component)) of each of its b rows.
///
/// # Errors
/// [`FormatError::Data`] for one that contradicts itself, else as [`write_op4`].
pub fn write_superelement_op4(path: &Path, record: &SuperelementRecord, format: Op4Format) -> Result<(), FormatError> {
    record.check()?;
    let mut matrices = vec![("KAA", &record.stiffness), ("MAA", &record.mass)];
    matrices.extend(record.damping.iter().map(|c| ("BAA", c)));
    matrices.extend(record.structural.iter().map(|k4| ("K4AA", k4)));
    let boundary = DenseMatrix::from_fn(record.interface.len(), 2, |row, column| {
        let label = &record.interface[row];
        if column == 0 { label.node as f64 } else { label.direction.component() as f64 }
    });
    matrices.extend((!record.interface.is_empty()).then_some((BOUNDARY, &boundary)));
    let [band, complete] = [record.band_hz, record.complete_hz].map(|hz| hz.map(|hz| DenseMatrix::full(1, 1, hz)));
    matrices.extend(band.iter().map(|hz| (BAND, hz)));
    matrices.extend(complete.iter().map(|hz| (COMPLETE, hz)));
    write_op4(path, &matrices, format)
}
