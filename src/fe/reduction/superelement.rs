//! A condensed housing as others use it: small matrices on its interface and on modal amplitudes.

use crate::numerics::linalg::DenseMatrix;

/// A housing condensed on its interface. Coordinates: the interface first, then the amplitudes of the interior's
/// vectors.
#[derive(Debug, Clone, PartialEq)]
pub struct Superelement {
    /// k [order x order], N/m.
    pub stiffness: DenseMatrix,
    /// m [order x order], kg.
    pub mass: DenseMatrix,
    /// Mass times unit accelerations along the bearing's x and y, on the coordinates [order x 2], kg.
    pub weight: DenseMatrix,
    /// Imaginary part of the stiffness by the parts' loss factors [order x order], N/m; `None` without any.
    pub structural: Option<DenseMatrix>,
    /// Number of interface coordinates, <= order.
    pub interface_dof: usize,
}

impl Superelement {
    /// Number of coordinates.
    pub fn order(&self) -> usize {
        self.stiffness.nrows()
    }

    /// Number of modal amplitudes.
    pub fn modal_dof(&self) -> usize {
        self.order() - self.interface_dof
    }

    /// Weight on the coordinates for a gravity vector in m/s^2 \[order\].
    pub fn gravity_load(&self, gravity: [f64; 2]) -> Vec<f64> {
        (0..self.order()).map(|row| self.weight[(row, 0)] * gravity[0] + self.weight[(row, 1)] * gravity[1]).collect()
    }
}
