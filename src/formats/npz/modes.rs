//! Mode shapes in an archive, as this program keeps them.

use std::f64::consts::TAU;
use std::path::Path;

use super::super::{FormatError, ModeShapes};
use super::writer::npz_labels;
use super::{NpzReader, NpzWriter};

/// Writes mode shapes, whole or not at all: `frequencies_hz` \[count\], `eigenvalues` \[count\] (`(2 pi f)^2`, 1/s^2),
/// `shapes` \[count x nodes x 3\] and, if they are known, `nodes` \[nodes x 3\], m, and `node_tags` \[nodes\].
///
/// # Errors
/// [`FormatError::Data`] for mode shapes that contradict themselves or labels beyond i64, else as [`NpzWriter`].
pub fn write_modes_npz(path: &Path, modes: &ModeShapes) -> Result<(), FormatError> {
    modes.check()?;
    let mut npz = NpzWriter::create(path)?;
    npz.array("frequencies_hz", &modes.frequencies_hz)?;
    let eigenvalue = |frequency: &f64| (TAU * frequency).powi(2);
    let eigenvalues: Vec<f64> = modes.frequencies_hz.iter().map(eigenvalue).collect();
    npz.array("eigenvalues", &eigenvalues)?;
    let mut shapes = npz.begin("shapes", &[modes.count_modes(), modes.count_points(), 3])?;
    for shape in &modes.shapes {
        shapes.extend(shape)?;
    }
    shapes.end()?;
    if let Some(points) = &modes.points {
        npz.matrix("nodes", points.len(), 3, points.as_flattened())?;
    }
    if let Some(tags) = &modes.node_tags {
        npz.array("node_tags", &npz_labels(tags.iter().copied())?)?;
    }
    npz.finish()
}

/// Reads mode shapes: `frequencies_hz`, `shapes` and, where they are there, `nodes` and `node_tags`; other arrays are left
/// out.
///
/// # Errors
/// [`FormatError`] for archives that cannot be read, and for arrays that are missing or do not fit each other.
pub fn read_modes_npz(path: &Path) -> Result<ModeShapes, FormatError> {
    let mut npz = NpzReader::open(path)?;
    let frequencies = npz.f64("frequencies_hz")?;
    let shapes = npz.f64("shapes")?;
    let &[count] = frequencies.shape.as_slice() else {
        return Err(npz.wrong_shape("frequencies_hz", "one dimension", &frequencies.shape));
    };
    let count_points = match shapes.shape.as_slice() {
        &[modes, points, 3] if modes == count => points,
        found => return Err(npz.wrong_shape("shapes", "a shape [modes, nodes, 3]", found)),
    };
    let mut points = None;
    if npz.has("nodes") {
        let nodes = npz.f64("nodes")?;
        if nodes.shape != [count_points, 3] {
            return Err(npz.wrong_shape("nodes", "a shape [nodes, 3]", &nodes.shape));
        }
        points = Some(nodes.values.as_chunks::<3>().0.to_vec());
    }
    let mut node_tags = None;
    if npz.has("node_tags") {
        let tags = npz.i64("node_tags")?;
        if tags.shape != [count_points] {
            return Err(npz.wrong_shape("node_tags", "a shape [nodes]", &tags.shape));
        }
        let label = |&tag: &i64| u64::try_from(tag).map_err(|_| npz.wrong("node_tags", "labels >= 0", tag));
        node_tags = Some(tags.values.iter().map(label).collect::<Result<_, _>>()?);
    }
    // a chunk of no values does not exist: `check` tells of modes without points
    let shapes = shapes.values.chunks_exact(count_points.saturating_mul(3).max(1));
    let modes = ModeShapes {
        frequencies_hz: frequencies.values,
        node_tags,
        points,
        shapes: shapes.map(<[f64]>::to_vec).collect(),
        directions: None,
    };
    modes.check().map_err(|fault| fault.of(path))?;
    Ok(modes)
}
