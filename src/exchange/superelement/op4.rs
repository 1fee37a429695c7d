//! A superelement's matrices under Nastran's names.

use std::path::Path;

use super::{SuperelementError, SuperelementRecord};
use crate::exchange::op4::{Op4Error, Op4Format, write_op4};

/// Writes the matrices \[n x n\] of a superelement, whole or not at all: `KAA` (stiffness), `MAA` (mass) and, where there
/// are any, `BAA` (viscous damping) and `K4AA` (imaginary part of the stiffness). Rows are those of
/// [`SuperelementRecord::labels`]: the boundary set first, then the modes, as Nastran's external superelements have them.
///
/// # Errors
/// [`Op4Error::Superelement`] for one that contradicts itself, else as [`write_op4`].
pub fn write_superelement_op4(
    path: &Path,
    record: &SuperelementRecord,
    format: Op4Format,
) -> Result<(), Op4Error> {
    let fault = |fault: SuperelementError| Op4Error::Superelement {
        fault: Box::new(fault),
    };
    record.check().map_err(fault)?;
    let mut matrices = vec![("KAA", &record.stiffness), ("MAA", &record.mass)];
    matrices.extend(record.damping.iter().map(|c| ("BAA", c)));
    matrices.extend(record.structural.iter().map(|k4| ("K4AA", k4)));
    write_op4(path, &matrices, format)
}
