//! A superelement as a NumPy archive.

use std::path::Path;

use super::SuperelementRecord;
use super::check::{INTERFACE, LabelArrays, RECOVERED};
use crate::formats::npz::npz_labels;
use crate::formats::{DofLabel, FormatError, NpzWriter};
use crate::numerics::linalg::DenseMatrix;

/// Writes everything of a superelement, whole or not at all. n coordinates, b of them of the interface; arrays of what
/// there is not are left out.
///
/// | array | shape | what it is |
/// |---|---|---|
/// | `k`, `m`, `c`, `structural` | \[n x n\] | stiffness, mass, viscous damping, imaginary part of the stiffness |
/// | `interface_dofs` | \[b x 2\] | node and component: 1, 2, 3 along x, y, z; 4, 5, 6 about them; 7, 8, 9 radial, tangential, axial; 0 generalised |
/// | `interface_bodies` | \[b\] | `housing`, `ring`, `interface` |
/// | `interface_positions`, `interface_axes` | \[b x 3\] | m and unit vector, mesh axes, NaN where not known |
/// | `interface_modes` | \[d x b\] | displacements of the interface from the first b coordinates, where these are amplitudes of modes |
/// | `recovered_dofs`, `_bodies`, `_positions`, `_axes` | as above for d | what these displacements are |
/// | `modal_hz` | \[n - b\] | Hz |
/// | `band_hz` | \[1\] | top of the band that it was condensed for, Hz |
/// | `complete_hz` | \[1\] | frequency of the first vector of the interior that was left out, Hz |
/// | `outer_radius` | \[1\] | radius of the bore that the ring is tied to, m |
/// | `weight` | \[n x 3\] | mass times unit accelerations along x, y, z |
/// | `sensors`, `sensor_names` | \[s x n\], \[s\] | displacement a unit of each coordinate |
/// | `field_node_tags`, `field_positions`, `field_recovery` | \[N\], \[N x 3\], \[3 N x n\] | nodes, m, displacements x, y, z of node after node |
///
/// # Errors
/// [`FormatError::Data`] for one that contradicts itself and for tags beyond i64, else as [`NpzWriter`].
pub fn write_superelement_npz(path: &Path, record: &SuperelementRecord) -> Result<(), FormatError> {
    record.check()?;
    let mut npz = NpzWriter::create(path)?;
    matrix(&mut npz, "k", &record.stiffness)?;
    matrix(&mut npz, "m", &record.mass)?;
    for (name, values) in [("c", &record.damping), ("structural", &record.structural), ("weight", &record.weight)] {
        if let Some(values) = values {
            matrix(&mut npz, name, values)?;
        }
    }
    labels(&mut npz, &record.interface, &INTERFACE)?;
    if let Some(recovery) = &record.interface_recovery {
        matrix(&mut npz, "interface_modes", &recovery.modes)?;
        labels(&mut npz, &recovery.labels, &RECOVERED)?;
    }
    npz.array("modal_hz", &record.modal_hz)?;
    for (name, value) in
        [("band_hz", record.band_hz), ("complete_hz", record.complete_hz), ("outer_radius", record.outer_radius)]
    {
        if let Some(value) = value {
            npz.array(name, &[value])?;
        }
    }
    if !record.sensors.is_empty() {
        let mut rows = npz.begin("sensors", &[record.sensors.len(), record.order()])?;
        for sensor in &record.sensors {
            rows.extend(&sensor.row)?;
        }
        rows.end()?;
        let names = record.sensors.iter().map(|sensor| sensor.name.as_str());
        npz.texts("sensor_names", &names.collect::<Vec<_>>())?;
    }
    if let Some(field) = &record.field {
        npz.array("field_node_tags", &npz_labels(field.node_tags.iter().copied())?)?;
        npz.matrix("field_positions", field.positions.len(), 3, field.positions.as_flattened())?;
        matrix(&mut npz, "field_recovery", &field.recovery)?;
    }
    npz.finish()
}

/// What coordinates are.
fn labels(npz: &mut NpzWriter, labels: &[DofLabel], names: &LabelArrays) -> Result<(), FormatError> {
    let nodes = npz_labels(labels.iter().map(|dof| dof.node))?;
    let dofs = nodes.into_iter().zip(labels).map(|(node, dof)| [node, dof.direction.component()]);
    npz.matrix(&names.array("dofs"), labels.len(), 2, dofs.collect::<Vec<_>>().as_flattened())?;
    npz.texts(&names.array("bodies"), &labels.iter().map(|dof| dof.body.name()).collect::<Vec<_>>())?;
    let (positions, axes): (Vec<_>, Vec<_>) = labels.iter().map(|dof| (dof.position, dof.axis)).unzip();
    for (what, vectors) in [("positions", positions), ("axes", axes)] {
        npz.matrix(&names.array(what), vectors.len(), 3, vectors.as_flattened())?;
    }
    Ok(())
}

/// Row by row, as NumPy has it.
fn matrix(npz: &mut NpzWriter, name: &str, matrix: &DenseMatrix) -> Result<(), FormatError> {
    let mut array = npz.begin::<f64>(name, &[matrix.nrows(), matrix.ncols()])?;
    let mut line = Vec::with_capacity(matrix.ncols());
    for row in matrix.row_iter() {
        line.clear();
        line.extend(row.iter());
        array.extend(&line)?;
    }
    array.end()
}
