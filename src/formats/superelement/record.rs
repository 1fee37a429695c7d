//! A superelement's matrices, labels, sensors and its way back to the nodes.

use std::f64::consts::TAU;

use super::super::DofLabel;
use crate::files::Fault;
use crate::numerics::linalg::DenseMatrix;

/// A superelement: `m q'' + c q' + (k + i structural) q = f` in n coordinates q, of which the first b are those of the
/// interface and the others amplitudes of modes.
#[derive(Debug, Clone, PartialEq)]
pub struct SuperelementRecord {
    /// k \[n x n\], symmetric, N/m between displacements.
    pub stiffness: DenseMatrix,
    /// m \[n x n\], symmetric, kg between displacements.
    pub mass: DenseMatrix,
    /// c \[n x n\], viscous damping, symmetric, N s/m between displacements.
    pub damping: Option<DenseMatrix>,
    /// Imaginary part of the stiffness \[n x n\], symmetric, N/m between displacements.
    pub structural: Option<DenseMatrix>,
    /// What the interface coordinates are \[b\], b <= n; those after them are amplitudes of modes.
    pub interface: Vec<DofLabel>,
    /// The way back to the interface, where modes of it are the coordinates.
    pub interface_recovery: Option<InterfaceRecovery>,
    /// `sqrt(k_jj / m_jj) / 2 pi` of the modes \[n - b\], Hz: with a fixed interface, their eigenfrequencies.
    pub modal_hz: Vec<f64>,
    /// Top of the band that it was condensed for, Hz; `None` where the file does not say.
    pub band_hz: Option<f64>,
    /// Frequency of the first vector of the interior that was left out, or of the highest where none was, Hz; `None` where the file does not say.
    pub complete_hz: Option<f64>,
    /// Radius of the bore that a ring is tied to, m; `None` for other interfaces, and where the file does not say.
    pub outer_radius: Option<f64>,
    /// Mass times unit accelerations along the mesh's x, y, z \[n x 3\], kg for a displacement.
    pub weight: Option<DenseMatrix>,
    /// Points that are watched, names differ.
    pub sensors: Vec<SensorRow>,
    /// The way back to the nodes.
    pub field: Option<FieldRecovery>,
}

/// Displacements of an interface from amplitudes of its modes, `d = modes p`; the p are the first b coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct InterfaceRecovery {
    /// What the displacements are \[d\].
    pub labels: Vec<DofLabel>,
    /// \[d x b\], kg^(-1/2) for displacements.
    pub modes: DenseMatrix,
}

/// A measured quantity, `row q`.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorRow {
    /// Its name.
    pub name: String,
    /// Displacement a unit of each coordinate \[n\], m/m for an interface displacement.
    pub row: Vec<f64>,
}

/// Displacements of nodes from the coordinates, `u = recovery q`.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldRecovery {
    /// gmsh's tags \[N\], each once.
    pub node_tags: Vec<u64>,
    /// Positions in the mesh's axes \[N\], m.
    pub positions: Vec<[f64; 3]>,
    /// \[3 N x n\]: x, y, z of the first node, then of the next, m/m for an interface displacement.
    pub recovery: DenseMatrix,
}

impl SuperelementRecord {
    /// A superelement of nothing but its matrices: `modal_hz` comes from their diagonals.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn of_matrices(stiffness: DenseMatrix, mass: DenseMatrix, interface: Vec<DofLabel>) -> Result<Self, Fault> {
        let mut record = Self {
            stiffness,
            mass,
            damping: None,
            structural: None,
            interface,
            interface_recovery: None,
            modal_hz: Vec::new(),
            band_hz: None,
            complete_hz: None,
            outer_radius: None,
            weight: None,
            sensors: Vec::new(),
            field: None,
        };
        record.check_matrices()?;
        record.modal_hz = record.diagonal_hz()?;
        Ok(record)
    }

    /// Both triangles of each matrix become their mean.
    pub(super) fn symmetrise(&mut self) {
        let others = [&mut self.damping, &mut self.structural];
        let matrices = [&mut self.stiffness, &mut self.mass].into_iter().chain(others.into_iter().flatten());
        for matrix in matrices {
            for row in 0..matrix.nrows() {
                for column in 0..row {
                    let mean = 0.5 * matrix[(row, column)] + 0.5 * matrix[(column, row)];
                    matrix[(row, column)] = mean;
                    matrix[(column, row)] = mean;
                }
            }
        }
    }

    /// Number n of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// What each coordinate is \[n\], modes after the interface.
    pub fn labels(&self) -> Vec<DofLabel> {
        let modes = self.order().saturating_sub(self.interface.len());
        let modes = (0..modes as u64).map(DofLabel::modal);
        self.interface.iter().copied().chain(modes).collect()
    }

    /// `sqrt(k_jj / m_jj) / 2 pi` of the modes; a diagonal below zero, which rounding gives a rigid mode, counts as zero.
    pub(super) fn diagonal_hz(&self) -> Result<Vec<f64>, Fault> {
        let modes = self.interface.len()..self.order();
        let frequency = |j: usize| {
            let (k, m) = (self.stiffness[(j, j)], self.mass[(j, j)]);
            if m > 0.0 {
                Ok((k.max(0.0) / m).sqrt() / TAU)
            } else {
                let expected = format!("a mass > 0 of modal coordinate {j}");
                Err(Fault::new(expected, m).within("array \"m\""))
            }
        };
        modes.map(frequency).collect()
    }
}
