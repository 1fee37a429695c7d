//! VTK XML unstructured grids (`.vtu`), as ParaView and PyVista open them.
//!
//! The grid has the nodes that the given elements use, in the order of the mesh, and the elements in the given order.
//! Numbers are appended after the XML in base64 (little-endian, each array preceded by its length in bytes as UInt64):
//! every bit arrives, and the file stays well-formed XML. Source: VTK file formats, section "XML file formats", unstructured grid and appended data.

#[cfg(test)]
mod tests;
mod write;

pub use write::{Field, FieldValues, write_vtu};
