//! The records of a file.

use std::io::{self, Write};
use std::path::Path;

use super::nodes::Node;
use super::rigid::Inertia;
use crate::files::{FileError, write_atomic};
use crate::numerics::linalg::DenseMatrix;

/// What goes into a file.
pub(super) struct Body {
    pub(super) nodes: Vec<Node>,
    /// Ascending, 1/s^2.
    pub(super) eigenvalues: Vec<f64>,
    /// \[n x modes\], modal mass 1.
    pub(super) vectors: DenseMatrix,
    /// \[modes x modes\].
    pub(super) damping: Option<DenseMatrix>,
    pub(super) inertia: Option<Inertia>,
}

pub(super) fn write(path: &Path, body: &Body) -> Result<(), FileError> {
    write_atomic(path, |to| {
        let modes = body.eigenvalues.len();
        writeln!(to, "** MBDyn modal data, SI units, axes of the mesh")?;
        head(to, 1, "HEADER")?;
        writeln!(to, "** REVISION, NODES, NORMAL, ATTACHED, CONSTRAINT, REJECTED MODES")?;
        writeln!(to, "REV0 {} {modes} 0 0 0\n**", body.nodes.len())?;
        head(to, 2, "FINITE ELEMENT NODE LIST")?;
        for names in body.nodes.chunks(6) {
            let names: Vec<&str> = names.iter().map(|node| node.name.as_str()).collect();
            writeln!(to, "{}", names.join(" "))?;
        }
        writeln!(to, "**")?;
        for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            head(to, 5 + axis, &format!("NODAL {name} COORDINATES"))?;
            body.nodes.iter().try_for_each(|node| line(to, &[node.position[axis]]))?;
            writeln!(to, "**")?;
        }
        shapes(to, body)?;
        let diagonal = |value: &dyn Fn(usize) -> f64| {
            DenseMatrix::from_fn(modes, modes, |i, j| if i == j { value(i) } else { 0.0 })
        };
        head(to, 9, "MODAL MASS MATRIX. COLUMN-MAJOR FORM")?;
        matrix(to, &diagonal(&|_| 1.0))?;
        head(to, 10, "MODAL STIFFNESS MATRIX. COLUMN-MAJOR FORM")?;
        matrix(to, &diagonal(&|mode| body.eigenvalues[mode]))?;
        if let Some(inertia) = &body.inertia {
            head(to, 12, "GLOBAL INERTIA PROPERTIES")?;
            line(to, &[inertia.mass])?;
            line(to, &inertia.centre)?;
            inertia.moments.iter().try_for_each(|row| line(to, row))?;
            writeln!(to, "**")?;
        }
        if let Some(damping) = &body.damping {
            head(to, 13, "MODAL DAMPING MATRIX. COLUMN-MAJOR FORM")?;
            matrix(to, damping)?;
        }
        writeln!(to, "** END OF FILE")
    })
}

fn head(to: &mut impl Write, record: usize, name: &str) -> io::Result<()> {
    writeln!(to, "** RECORD GROUP {record}, {name}")
}

/// Displacements and rotations of each node in each mode.
fn shapes(to: &mut impl Write, body: &Body) -> io::Result<()> {
    head(to, 8, "MODE SHAPES")?;
    for mode in 0..body.eigenvalues.len() {
        // MBDyn expects exactly one line before each shape, beginning with **
        writeln!(to, "** NORMAL MODE SHAPE # {}", mode + 1)?;
        for node in &body.nodes {
            let motion = |axis: usize| {
                let parts = node.motions[axis].iter();
                parts.map(|&(row, factor)| factor * body.vectors[(row, mode)]).sum()
            };
            line(to, &[0, 1, 2, 3, 4, 5].map(motion))?;
        }
    }
    writeln!(to, "**")
}

/// A symmetric matrix, six numbers a line as the format wants them.
fn matrix(to: &mut impl Write, matrix: &DenseMatrix) -> io::Result<()> {
    for column in matrix.col_iter() {
        let values: Vec<f64> = column.iter().copied().collect();
        for values in values.chunks(6) {
            line(to, values)?;
        }
    }
    writeln!(to, "**")
}

/// 17 digits, which give back every bit.
fn line(to: &mut impl Write, values: &[f64]) -> io::Result<()> {
    let values: Vec<String> = values.iter().map(|value| format!("{value:.16e}")).collect();
    writeln!(to, "{}", values.join(" "))
}
