//! Mode shapes as comma-separated values.
//!
//! The first line is the header, either `mode,frequency_hz,x,y,z,ux,uy,uz` or `mode,frequency_hz,node,ux,uy,uz`; one line
//! a mode and point follows. Coordinates in m, frequencies in Hz, displacements in any unit. Lines that begin with `#` and
//! blank lines are left out. Separator: comma or semicolon, whichever the header has; with semicolons, numbers may have a
//! decimal comma. Every mode has the same points in the same order; modes are in the order of first appearance.
//!
//! ```text
//! # measured on the bench
//! mode,frequency_hz,node,ux,uy,uz
//! 1,523.4,12,0.0,1.0,0.1
//! 1,523.4,17,0.2,0.9,0.0
//! 2,880.1,12,0.5,0.0,0.3
//! 2,880.1,17,0.4,-0.1,0.2
//! ```

mod error;
mod read;
#[cfg(test)]
mod tests;

use std::io::Write;
use std::path::Path;

pub use error::CsvError;
pub(super) use read::line_of;
pub use read::{modes_from_bytes, read_modes_csv};

use super::ModeShapes;
use crate::files::write_atomic;

const BY_POINT: [&str; 8] = ["mode", "frequency_hz", "x", "y", "z", "ux", "uy", "uz"];
const BY_NODE: [&str; 6] = ["mode", "frequency_hz", "node", "ux", "uy", "uz"];

/// Writes mode shapes, whole or not at all: by node labels if there are any, else by points. Numbers have as many digits
/// as give back every bit.
///
/// # Errors
/// [`CsvError::Modes`] for mode shapes that contradict themselves, [`CsvError::NoPlaces`] without labels and points,
/// [`CsvError::Write`].
pub fn write_modes_csv(path: &Path, modes: &ModeShapes) -> Result<(), CsvError> {
    modes.check().map_err(|fault| CsvError::Modes {
        path: path.to_owned(),
        fault,
    })?;
    let (header, places): (&[&str], Vec<Vec<String>>) = match (&modes.node_tags, &modes.points) {
        (Some(tags), _) => (
            &BY_NODE,
            tags.iter().map(|tag| vec![tag.to_string()]).collect(),
        ),
        (None, Some(points)) => {
            let place = |point: &[f64; 3]| point.iter().map(f64::to_string).collect();
            (&BY_POINT, points.iter().map(place).collect())
        }
        (None, None) => return Err(CsvError::NoPlaces),
    };
    let written = write_atomic(path, |to| {
        let mut table = ::csv::Writer::from_writer(&mut *to);
        table.write_record(header)?;
        for (index, (frequency, shape)) in
            modes.frequencies_hz.iter().zip(&modes.shapes).enumerate()
        {
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
    written.map_err(|source| CsvError::Write {
        path: path.to_owned(),
        source,
    })
}
