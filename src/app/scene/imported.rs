//! A superelement from a file in the housing's place.

use super::places::{Place, PlaceBodies, Spot, of_rings};
use super::ring::{refuse_outside, ring};
use crate::app::case;
use crate::app::case::{Case, SensorSpot};
use crate::app::error::ComputeError;
use crate::fe::model::{RingFrame, Rings};
use crate::fe::reduction::{Bound, Check, Superelement, check_matrices};
use crate::formats::{
    DofBody, DofLabel, FormatError, SuperelementRecord, read_superelement_npz, read_superelement_op4,
};
use crate::numerics::Brief;
use crate::numerics::linalg::DenseMatrix;
use crate::report::significant;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// A frequency at the end of a band lies within it, and numbers that were written and read are the same.
const ROUND_OFF: f64 = 1e-9;

/// Farthest that a node may be from where the ring has it, relative to the ring's radius: six digits of a position that
/// another program writes are better than this, another ring is not.
const POSITION: f64 = 1e-3;

/// Largest difference of a unit vector's component: a millionth of a radian counts as one direction.
const AXIS: f64 = 1e-6;

/// Largest ratio of a mode's frequency to the one below that is taken for two modes of an interior. Residual vectors of a flanged housing
/// follow its last mode, at 22.8 kHz, by factors of 1.65 and 1.22: it tells them from modes narrowly.
const CLOSE: f64 = 1.2;

/// The interface coordinates of a superelement, and who writes them.
const ORDER: &str = "`plummer condense` with interface = \"ring\" writes such a file: x, y, about_z of node after node, in space then z, about_x, about_y of node after node, nodes counter-clockwise from angle 0";

/// A condensed housing of which nothing but the file is known.
#[derive(Debug, Clone)]
pub struct ImportedHousing {
    /// The file.
    pub path: PathBuf,
    /// What it has.
    pub record: SuperelementRecord,
    /// The same as the ring takes it.
    pub element: Superelement,
    /// Checks of its matrices.
    pub checks: Vec<Check>,
    /// What a reader must know of it, in sentences.
    pub notes: Vec<String>,
}

impl ImportedHousing {
    /// Reads the file and makes the rings that fit it: in space if the interface has six motions a node.
    ///
    /// # Errors
    /// [`ComputeError`] for a file that cannot be read and for an interface that is not the rings', and
    /// of the rings.
    pub(crate) fn read(case: &Case, path: &Path) -> Result<(Self, Rings), ComputeError> {
        let seats = case.seats();
        let nodes = seats.iter().map(|seat| seat.ring.nodes).sum();
        let record = record(path, nodes)?;
        for seat in &seats {
            fits(case, seat, path, &record, seats.len() == 1)?;
        }
        let in_space = record.interface.len() == 6 * nodes;
        if !in_space {
            refuse_axial_springs(&seats, path)?;
        }
        let mut rest = record.interface.as_slice();
        let seated = seats.iter().map(|seat| {
            let ring = ring(case, seat.ring, in_space)?;
            let (own, others) = rest.split_at(ring.dof());
            rest = others;
            Ok((seat.label.clone(), ring, frame(path, own)?))
        });
        let rings = Rings::new(seated.collect::<Result<_, ComputeError>>()?).ok_or(ComputeError::NothingToCondense)?;
        check_labels(path, &record.interface, &rings)?;
        let element = Superelement {
            stiffness: record.stiffness.clone(),
            mass: record.mass.clone(),
            weight: weight(&record, &rings.first().frame),
            structural: record.structural.clone(),
            interface_dof: record.interface.len(),
        };
        let imported = Self {
            path: path.to_owned(),
            notes: notes(case, path, &record),
            checks: check_matrices(&element, None)?,
            record,
            element,
        };
        Ok((imported, rings))
    }

    /// Lets matrices pass that are those of a condensed housing.
    ///
    /// # Errors
    /// [`ComputeError`] with the first check that fails.
    pub(crate) fn accept(&self) -> Result<(), ComputeError> {
        match self.checks.iter().find(|check| !check.ok()) {
            None => Ok(()),
            Some(check) => {
                let bound = match check.bound {
                    Bound::AtMost => "at most",
                    Bound::AtLeast => "at least",
                };
                let Check { name, what, value, limit, .. } = check;
                Err(refused(
                    &self.path,
                    format!("check \"{name}\" ({what}): expected {bound} {}, found {}", Brief(*limit), Brief(*value)),
                    "`plummer condense` of this case lists all checks; expected are Craig-Bampton matrices in SI units, modes of mass 1 after the interface",
                ))
            }
        }
    }

    /// Up to which frequency the file has all vectors of the housing's interior, Hz: as the file says, else the band that it was condensed for,
    /// else the highest vector that follows the one before it closely. Residual vectors are far above the last mode, and far from each other.
    pub(crate) fn complete_hz(&self) -> f64 {
        let said = self.record.complete_hz.or(self.record.band_hz);
        said.unwrap_or_else(|| last_mode_hz(&self.record.modal_hz))
    }

    /// What is to be said of results up to a frequency: nothing within the band that the file was condensed for. A file that does not
    /// say its band is taken for good up to two thirds of its last mode, the usual rule for a fixed interface (R. R. Craig, A. J. Kurdila,
    /// *Fundamentals of Structural Dynamics*, 2006, chapter 17).
    pub(crate) fn doubt(&self, top_hz: f64) -> Option<String> {
        let (end, whose) = match self.record.band_hz {
            Some(band) => (band, "the band that it was condensed for"),
            None if self.record.modal_hz.is_empty() => return None,
            None => {
                (last_mode_hz(&self.record.modal_hz) / 1.5, "two thirds of its last vector that is close to others")
            }
        };
        (top_hz > end * (1.0 + ROUND_OFF)).then(|| {
            format!(
                "The superelement of {} is good up to {} Hz, {whose}; modes or responses are asked for up to {} Hz. Above, frequencies are too high and modes are missing. Condense it with a higher accuracy.band_hz, or use the mesh.",
                self.path.display(),
                significant(end, 5),
                significant(top_hz, 5)
            )
        })
    }

    /// What is to be said of responses. Those of a flanged housing that was condensed for their band erred by 196 % beside the mesh's. Those of a coarser
    /// mesh of it with 2 % of damping, condensed for five times the band, erred by 6 %.
    pub(crate) fn unknown_error(&self) -> String {
        format!(
            "No error of the responses from {} is known: it was condensed for frequencies. A mode whose frequency is off by 1 % errs by 1 % over its damping ratio at the resonance, and far more beside zeros. Use the mesh, of which `frf` estimates the error, or condense for several times the band and compare.",
            self.path.display()
        )
    }

    /// Refuses structural damping, which a simulation over time cannot have.
    ///
    /// # Errors
    /// [`ComputeError`] where there is any.
    pub(crate) fn refuse_structural_damping(&self) -> Result<(), ComputeError> {
        match &self.record.structural {
            Some(matrix) if matrix.norm_max() > 0.0 => Err(refused(
                &self.path,
                "array \"structural\" is structural damping, which has a meaning for harmonic motion alone; a run steps through time",
                "leave the array out and give [damping]",
            )),
            _ => Ok(()),
        }
    }

    /// The row of a place over the coordinates \[order\].
    ///
    /// # Errors
    /// [`ComputeError`] for a row that the file lacks, and of places on a ring; each names the sensor or force.
    pub(crate) fn row(&self, spot: Spot<'_>, rings: &Rings) -> Result<Vec<f64>, ComputeError> {
        let SensorSpot::Recovered(row) = spot.at else {
            let place = Place::new(PlaceBodies::of_rings(rings), spot)?;
            return Ok(place.on_rings(self.element.order()));
        };
        let sensors = &self.record.sensors;
        if let Some(found) = sensors.iter().find(|sensor| sensor.name == *row) {
            return Ok(found.row.clone());
        }
        let names: Vec<String> = sensors.iter().map(|s| format!("\"{}\"", s.name)).collect();
        let known = match names.is_empty() {
            true => "of array \"sensors\", which the file lacks".to_owned(),
            false => names.join(", "),
        };
        Err(refused(
            &self.path,
            format!("{spot}: expected one of the rows {known}, found \"{row}\""),
            "give one of these names as `recovered`, `ring_deg` for a place on the ring, or condense again with the sensor in its case",
        ))
    }
}

/// The bore of a ring is the one that the file was condensed with, as far as the file of one ring tells it.
fn fits(
    case: &Case,
    seat: &case::Seat<'_>,
    path: &Path,
    record: &SuperelementRecord,
    only: bool,
) -> Result<(), ComputeError> {
    let Some(file) = record.outer_radius.filter(|_| only) else {
        return Ok(());
    };
    if let Some(case) = seat.ring.outer_radius
        && (case - file).abs() > ROUND_OFF * file
    {
        return Err(refused(
            path,
            format!(
                "ring.outer_radius is {case} m, but the superelement was condensed with {file} m (array \"outer_radius\")"
            ),
            "the tie to the bore is within the superelement: give its value, leave the key out, or condense again",
        ));
    }
    refuse_outside(case, seat, &format!("the bore in {}", path.display()), [file; 2])
}

/// A plane superelement has no motion along z.
fn refuse_axial_springs(seats: &[case::Seat<'_>], path: &Path) -> Result<(), ComputeError> {
    for seat in seats {
        let mut supports = seat.ring.supports.iter();
        if let Some(index) = supports.position(|support| support.spring.z > 0.0) {
            let key = seat.key(&format!("ring.supports[{index}].spring"));
            let what = format!(
                "{key} has a component z, expected x and y only: the superelement is plane, three motions a node"
            );
            return Err(refused(path, what, None));
        }
    }
    Ok(())
}

/// The error of a superelement that cannot take the housing's place, and what to do about it.
fn refused<'a>(path: &Path, what: impl Display, help: impl Into<Option<&'a str>>) -> ComputeError {
    ComputeError::Input {
        what: format!("housing.superelement: {}: {what}", path.display()),
        help: help.into().map(str::to_owned),
    }
}

/// The highest of some frequencies (Hz) that lies within [`CLOSE`] of the next lower one; the lowest where none does, zero without any.
fn last_mode_hz(modal_hz: &[f64]) -> f64 {
    let mut sorted = modal_hz.to_vec();
    sorted.sort_by(f64::total_cmp);
    let mut pairs = sorted.windows(2).rev();
    let last = pairs.find(|pair| pair[1] <= CLOSE * pair[0]).map(|pair| pair[1]);
    last.or(sorted.first().copied()).unwrap_or(0.0)
}

/// A file's content, its interface as long as that of a ring of so many nodes.
fn record(path: &Path, nodes: usize) -> Result<SuperelementRecord, ComputeError> {
    let unreadable = |error: FormatError| refused(path, error, None);
    let ending = path.extension().unwrap_or_default().to_ascii_lowercase();
    let (record, found) = match ending.to_str() {
        Some("npz") => {
            let record = read_superelement_npz(path).map_err(unreadable)?;
            let found = record.interface.len();
            if let Some(recovery) = &record.interface_recovery {
                let what = format!(
                    "expected the ring's own coordinates, found {found} modes of an interface of {} coordinates (array \"interface_modes\"): condense without condense.interface_modes",
                    recovery.labels.len()
                );
                return Err(refused(path, what, None));
            }
            (record, found)
        }
        Some("op4") => {
            let record = read_superelement_op4(path, &[3 * nodes, 6 * nodes]).map_err(unreadable)?;
            let order = record.order();
            (record, order)
        }
        _ => return Err(refused(path, "expected a file that ends in .npz or .op4", None)),
    };
    let [plane, solid] = [3 * nodes, 6 * nodes];
    if [plane, solid].contains(&record.interface.len()) {
        return Ok(record);
    }
    let what = format!(
        "expected {plane} interface coordinates for ring.nodes = {nodes} (x, y, about_z of each) or {solid} (in a solid housing then z, about_x, about_y of each), found {found}"
    );
    Err(refused(path, what, ORDER))
}

/// Whether a file says what its interface coordinates are.
fn labelled(interface: &[DofLabel]) -> bool {
    interface.iter().any(|label| label.body != DofBody::Interface)
}

/// The frame of the first node's axes about the mean of the nodes; the file's axes where it has none.
fn frame(path: &Path, interface: &[DofLabel]) -> Result<RingFrame, ComputeError> {
    let known = |vector: &[f64; 3]| vector.iter().all(|part| part.is_finite());
    let (Some(first), Some(third)) = (interface.first(), interface.get(2)) else {
        return Ok(RingFrame::default());
    };
    let (x, z) = (first.axis, third.axis);
    if !labelled(interface) || !known(&x) || !known(&z) {
        return Ok(RingFrame::default());
    }
    let mut centre = [0.0; 3];
    if interface.iter().all(|label| known(&label.position)) {
        for label in interface {
            for (mean, part) in centre.iter_mut().zip(label.position) {
                *mean += part / interface.len() as f64;
            }
        }
    }
    RingFrame::new(centre, z, x).ok_or_else(|| {
        let what = format!("expected axes x and z of ring node 0 at right angles, found {x:?} and {z:?}");
        refused(path, what, None)
    })
}

/// Whether labels are the rings' in the rings' order; what the file does not say passes.
fn check_labels(path: &Path, interface: &[DofLabel], rings: &Rings) -> Result<(), ComputeError> {
    if !labelled(interface) {
        return Ok(());
    }
    let reach = POSITION * rings.first().ring.section().radius;
    for (row, (own, label)) in of_rings(rings).iter().zip(interface).enumerate() {
        if (own.body, own.node, own.direction) != (label.body, label.node, label.direction) {
            let what = format!("interface coordinate {row} (from 0): expected {}, found {}", name(own), name(label));
            return Err(refused(path, what, ORDER));
        }
        for (what, limit, expected, found) in
            [("position in m", reach, own.position, label.position), ("axis", AXIS, own.axis, label.axis)]
        {
            // not so for what is not known
            if (0..3).any(|k| (expected[k] - found[k]).abs() > limit) {
                return Err(refused(
                    path,
                    format!(
                        "interface coordinate {row} (from 0), {what} of {}: expected {expected:?}, found {found:?}",
                        name(own)
                    ),
                    "ring.sections (their radius), ring.nodes and ring.bond must be those that were condensed, or condense again",
                ));
            }
        }
    }
    Ok(())
}

fn name(label: &DofLabel) -> String {
    let direction = label.direction.name();
    format!("{} node {}, {direction}", label.body.name(), label.node)
}

/// The file's weight along the bearing's x and y [order x 2]; zero without one.
fn weight(record: &SuperelementRecord, frame: &RingFrame) -> DenseMatrix {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|axis| frame.vector_to_mesh(axis));
    DenseMatrix::from_fn(record.order(), 2, |row, column| match &record.weight {
        Some(weight) => (0..3).map(|k| weight[(row, k)] * axes[column][k]).sum(),
        None => 0.0,
    })
}

/// That the case's damping takes the place of the file's, where that has one.
pub(crate) fn unused_damping(path: &Path, record: &SuperelementRecord) -> Option<String> {
    let damping = record.damping.as_ref();
    damping.map(|_| format!("The viscous damping in {} is not used: [damping] of the case counts.", path.display()))
}

fn notes(case: &Case, path: &Path, record: &SuperelementRecord) -> Vec<String> {
    let file = path.display();
    let mut notes = vec![format!(
        "The housing is the superelement of {file}, {} interface coordinates and {} modes. Not available without its mesh: \
         the modes in full, the error of condensation, mass and effective masses, shares of energy, shapes and drawing of \
         the housing.",
        record.interface.len(),
        record.modal_hz.len()
    )];
    if !labelled(&record.interface) {
        notes.push(format!(
            "{file} does not say what its coordinates are: the first {} are taken for the ring's in the ring's order. Only \
             their number was checked.",
            record.interface.len()
        ));
    }
    let idle = [
        (
            "ring.outer_radius",
            record.outer_radius.is_none() && case.seats().iter().any(|seat| seat.ring.outer_radius.is_some()),
        ),
        ("condense.fixed_interface_modes", case.condense.fixed_interface_modes != case::FixedInterfaceModes::Auto),
        ("condense.enhanced", !case.condense.enhanced),
    ];
    for (key, _) in idle.iter().filter(|(_, given)| *given) {
        notes
            .push(format!("{key} of the case does not act: {file} was condensed before, and does not say with which."));
    }
    if record.weight.is_none() && case.shaft.is_some() {
        notes.push(format!("{file} has no array \"weight\": the weight of the housing does not act."));
    }
    notes.extend(unused_damping(path, record));
    if record.structural.is_some() {
        notes.push(format!("The structural damping in {file} is not used: modes are undamped."));
    }
    notes
}
