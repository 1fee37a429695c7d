//! Writes a table of mode shapes.

use std::io::Write;
use std::path::Path;

use super::super::{FormatError, ModeShapes};
use super::read::{BY_NODE, BY_POINT};
use crate::files::{Fault, write_atomic};

/// Writes mode shapes, whole or not at all: by node labels if there are any, else by points. Numbers have as many digits
/// as give back every bit.
///
/// # Errors
/// [`FormatError::File`] for mode shapes that contradict themselves and when the file cannot be written,
/// [`FormatError::Data`] without labels and points.
pub fn write_modes_csv(path: &Path, modes: &ModeShapes) -> Result<(), FormatError> {
    modes.check().map_err(|fault| fault.of(path))?;
    let (header, places): (&[&str], Vec<Vec<String>>) = match (&modes.node_tags, &modes.points) {
        (Some(tags), _) => (&BY_NODE, tags.iter().map(|tag| vec![tag.to_string()]).collect()),
        (None, Some(points)) => {
            let place = |point: &[f64; 3]| point.iter().map(f64::to_string).collect();
            (&BY_POINT, points.iter().map(place).collect())
        }
        (None, None) => {
            let expected = "mode shapes with node labels or points";
            return Err(Fault::new(expected, "neither").into());
        }
    };
    let written = write_atomic(path, |to| {
        let mut table = ::csv::Writer::from_writer(&mut *to);
        table.write_record(header)?;
        for (index, (frequency, shape)) in modes.frequencies_hz.iter().zip(&modes.shapes).enumerate() {
            let mode = [(index + 1).to_string(), frequency.to_string()];
            for (place, displacement) in places.iter().zip(shape.chunks_exact(3)) {
                let displacement: Vec<String> = displacement.iter().map(f64::to_string).collect();
                table.write_record(mode.iter().chain(place).chain(&displacement))?;
            }
        }
        table.flush()?;
        drop(table);
        to.flush()
    });
    Ok(written?)
}
