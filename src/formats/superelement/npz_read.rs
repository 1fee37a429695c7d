//! A superelement from a NumPy archive, this program's or another's.
//!
//! A superelement as a NumPy archive.

use super::check::{INTERFACE, LabelArrays, RECOVERED, same_shape, square};
use super::{FieldRecovery, InterfaceRecovery, SensorRow, SuperelementRecord};
use crate::files::Fault;
use crate::formats::npz::npz_labels;
use crate::formats::{DofBody, DofDirection, DofLabel, FormatError, NpzReader, NpzWriter};
use crate::numerics::linalg::DenseMatrix;
use std::path::Path;

/// Reads a superelement as [`write_superelement_npz`](super::write_superelement_npz) describes it.
///
/// Required are `k`, `m` and one of
/// - `interface_dofs` \[b x 2\] (node, component). Without `interface_bodies` the nodes are the housing's; without
///   `interface_axes` those along and about x, y, z are unit vectors, others not known (NaN); without
///   `interface_positions` positions are not known.
/// - `n_interface`, one whole number b: the first b coordinates, with no labels but their numbers
///   ([`DofBody::Interface`]). Left out of account where `interface_dofs` is there.
///
/// Everything else may be missing: `modal_hz` then comes from the diagonals of `k` and `m`. Numbers may have 4 or 8 bytes
/// in either byte order. Matrices that are symmetric within the limit of [`SuperelementRecord::check`] become exactly so:
/// the mean of both triangles. Other arrays are left out.
///
/// # Errors
/// [`FormatError`] naming file and array, for what cannot be read, is missing, or does not fit.
pub fn read_superelement_npz(path: &Path) -> Result<SuperelementRecord, FormatError> {
    let npz = NpzReader::open(path)?;
    let mut file = Source { path, npz };
    let fault = |fault: Fault| fault.of(path);
    let stiffness = file.matrix("k", None)?;
    let order = stiffness.nrows();
    let mass = file.matrix("m", Some(order))?;
    let interface = match file.npz.has("interface_dofs") {
        true => file.labels(&INTERFACE, order)?,
        false => file.numbered(order)?,
    };
    let mut record = SuperelementRecord::of_matrices(stiffness, mass, interface).map_err(fault)?;
    record.damping = file.optional("c", order)?;
    record.structural = file.optional("structural", order)?;
    record.weight = file.optional("weight", 3)?;
    if file.npz.has("modal_hz") {
        record.modal_hz = file.list("modal_hz")?;
    }
    record.band_hz = file.positive("band_hz")?;
    record.complete_hz = file.positive("complete_hz")?;
    record.outer_radius = file.positive("outer_radius")?;
    record.interface_recovery = file.interface_recovery(record.interface.len())?;
    record.sensors = file.sensors(order)?;
    record.field = file.field(order)?;
    record.check().map_err(fault)?;
    record.symmetrise();
    Ok(record)
}

/// An archive and its name.
struct Source<'a> {
    path: &'a Path,
    npz: NpzReader,
}

impl Source<'_> {
    /// A matrix of so many columns, or a square one. This is checked before it is made, as a matrix of few rows takes more
    /// memory than its numbers.
    fn matrix(&mut self, name: &'static str, columns: Option<usize>) -> Result<DenseMatrix, FormatError> {
        let read = self.npz.real(name)?;
        let &[rows, found] = read.shape.as_slice() else {
            return Err(self.npz.wrong_shape(name, "two dimensions", &read.shape));
        };
        let checked = match columns {
            None => square(rows, found),
            Some(columns) => same_shape(name, [rows, columns], [rows, found]),
        };
        checked.map_err(|fault| fault.of(self.path))?;
        Ok(DenseMatrix::from_fn(rows, found, |row, column| read.values[row * found + column]))
    }

    fn optional(&mut self, name: &'static str, columns: usize) -> Result<Option<DenseMatrix>, FormatError> {
        self.npz.has(name).then(|| self.matrix(name, Some(columns))).transpose()
    }

    fn list(&mut self, name: &str) -> Result<Vec<f64>, FormatError> {
        let read = self.npz.real(name)?;
        if read.shape.len() != 1 {
            return Err(self.npz.wrong_shape(name, "one dimension", &read.shape));
        }
        Ok(read.values)
    }

    /// The one number of an array, above zero; `None` for an array that is not there or empty.
    fn positive(&mut self, name: &str) -> Result<Option<f64>, FormatError> {
        let values = if self.npz.has(name) { self.list(name)? } else { Vec::new() };
        match values[..] {
            [] => Ok(None),
            [value] if value > 0.0 && value.is_finite() => Ok(Some(value)),
            _ => Err(self.npz.wrong(name, "one number above zero", format!("{values:?}"))),
        }
    }

    fn texts(&mut self, name: &str, count: usize) -> Result<Vec<String>, FormatError> {
        let read = self.npz.texts(name)?;
        if read.shape != [count] {
            return Err(self.npz.wrong_shape(name, "as many entries as its array has rows", &read.shape));
        }
        Ok(read.values)
    }

    /// Vectors \[count x 3\].
    fn vectors(&mut self, name: &str, count: usize) -> Result<Vec<[f64; 3]>, FormatError> {
        let read = self.npz.real(name)?;
        if read.shape != [count, 3] {
            return Err(self.npz.wrong_shape(name, "three numbers for each of its nodes", &read.shape));
        }
        Ok(read.values.as_chunks::<3>().0.to_vec())
    }

    /// What the rows of `names` are, at most so many.
    fn labels(&mut self, names: &LabelArrays, most: usize) -> Result<Vec<DofLabel>, FormatError> {
        let name = names.array("dofs");
        let dofs = self.npz.whole(&name)?;
        let count = match dofs.shape.as_slice() {
            &[count, 2] => count,
            // NumPy's empty list
            &[0] => 0,
            found => return Err(self.npz.wrong_shape(&name, "a shape [interface, 2]", found)),
        };
        // labels take more memory than the numbers that they come from
        if count > most {
            let found = format!("{count} rows, where \"{}\" has {most}", names.matrix);
            return Err(self.npz.wrong(&name, names.expected, found));
        }
        let mut labels = Vec::with_capacity(count);
        for &[node, component] in dofs.values.as_chunks::<2>().0 {
            let node = u64::try_from(node).map_err(|_| self.npz.wrong(&name, "nodes >= 0", node))?;
            let direction = DofDirection::of_component(component)
                .ok_or_else(|| self.npz.wrong(&name, "components 0 to 9", component))?;
            let (body, axis) = (DofBody::Housing, unit_vector(direction));
            labels.push(DofLabel { body, node, direction, position: [f64::NAN; 3], axis });
        }
        let bodies = names.array("bodies");
        if self.npz.has(&bodies) {
            for (label, name) in labels.iter_mut().zip(self.texts(&bodies, count)?) {
                label.body = DofBody::of_name(&name).ok_or_else(|| {
                    let expected = "\"housing\", \"ring\", \"interface\" or \"modal\"";
                    self.npz.wrong(&bodies, expected, format!("\"{name}\""))
                })?;
            }
        }
        type Vector = fn(&mut DofLabel) -> &mut [f64; 3];
        let [position, axis]: [Vector; 2] = [|label| &mut label.position, |label| &mut label.axis];
        for (what, of) in [("positions", position), ("axes", axis)] {
            let name = names.array(what);
            if self.npz.has(&name) {
                let read = self.vectors(&name, count)?;
                labels.iter_mut().zip(read).for_each(|(label, vector)| *of(label) = vector);
            }
        }
        Ok(labels)
    }

    /// The way back to an interface of which the first `interface` coordinates are modes.
    fn interface_recovery(&mut self, interface: usize) -> Result<Option<InterfaceRecovery>, FormatError> {
        let Some(modes) = self.optional("interface_modes", interface)? else {
            return Ok(None);
        };
        let labels = self.labels(&RECOVERED, modes.nrows())?;
        Ok(Some(InterfaceRecovery { labels, modes }))
    }

    /// Labels of an interface of which the number is all that is known.
    fn numbered(&mut self, order: usize) -> Result<Vec<DofLabel>, FormatError> {
        const NAME: &str = "n_interface";
        if !self.npz.has(NAME) {
            return Err(self.npz.missing("interface_dofs\" or \"n_interface"));
        }
        let read = self.npz.whole(NAME)?;
        let &[number] = read.values.as_slice() else {
            return Err(self.npz.wrong_shape(NAME, "one number", &read.shape));
        };
        if !(0..=order as i64).contains(&number) {
            return Err(self.npz.wrong(NAME, "a number from 0 to that of the rows of \"k\"", number));
        }
        Ok((0..number as u64).map(DofLabel::interface).collect())
    }

    fn sensors(&mut self, order: usize) -> Result<Vec<SensorRow>, FormatError> {
        let Some(rows) = self.optional("sensors", order)? else {
            return Ok(Vec::new());
        };
        let names = match self.npz.has("sensor_names") {
            true => self.texts("sensor_names", rows.nrows())?,
            false => (1..=rows.nrows()).map(|n| format!("sensor {n}")).collect(),
        };
        let row = |(name, row): (String, usize)| SensorRow { name, row: rows.row(row).iter().copied().collect() };
        Ok(names.into_iter().zip(0..).map(row).collect())
    }

    fn field(&mut self, order: usize) -> Result<Option<FieldRecovery>, FormatError> {
        let Some(recovery) = self.optional("field_recovery", order)? else {
            return Ok(None);
        };
        let nodes = recovery.nrows() / 3;
        let positions = self.vectors("field_positions", nodes)?;
        const TAGS: &str = "field_node_tags";
        let tags = self.npz.whole(TAGS)?;
        if tags.shape != [nodes] {
            return Err(self.npz.wrong_shape(TAGS, "a tag for three rows of \"field_recovery\"", &tags.shape));
        }
        let tag = |&tag: &i64| u64::try_from(tag).map_err(|_| self.npz.wrong(TAGS, "tags >= 0", tag));
        let node_tags = tags.values.iter().map(tag).collect::<Result<_, _>>()?;
        Ok(Some(FieldRecovery { node_tags, positions, recovery }))
    }
}

/// Along or about x, y, z of the mesh, where that is what the direction says.
fn unit_vector(direction: DofDirection) -> [f64; 3] {
    match direction {
        DofDirection::Along(axis) | DofDirection::About(axis) => {
            [0, 1, 2].map(|own| if own == axis { 1.0 } else { 0.0 })
        }
        DofDirection::Polar(_) | DofDirection::Generalised => [f64::NAN; 3],
    }
}

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
