//! Mode shapes as comma-separated values.
//!
//! The first line is the header, either `mode,frequency_hz,x,y,z,ux,uy,uz` or `mode,frequency_hz,node,ux,uy,uz`; one line
//! a mode and point follows. Coordinates in m, frequencies in Hz, displacements in any unit. Lines that begin with `#` and
//! blank lines are left out. Separator: comma or semicolon, whichever the header has; with semicolons, numbers may have a
//! decimal comma. Every mode has the same points in the same order; modes are in the order of first appearance.
//!
//! A measurement by accelerometers of one axis has `mode,frequency_hz,x,y,z,direction,value` or
//! `mode,frequency_hz,node,direction,value`, after it `imaginary` where shapes are complex: a line a mode and direction of a
//! place, as in a roving test. A direction is an axis (`x`, `-y`, `+z`) or three numbers with blanks between (`0.6 0.8 0`).
//! Complex shapes are turned by the angle that makes their imaginary part least, then their real part is taken.
//!
//! ```text
//! # measured on the bench
//! mode,frequency_hz,node,ux,uy,uz
//! 1,523.4,12,0.0,1.0,0.1
//! 1,523.4,17,0.2,0.9,0.0
//! 2,880.1,12,0.5,0.0,0.3
//! 2,880.1,17,0.4,-0.1,0.2
//! ```

mod read;
#[cfg(test)]
mod tests;
mod write;

pub use read::read_modes_csv;
pub(super) use read::{first_line, line_of, table_of};
pub use write::write_modes_csv;
