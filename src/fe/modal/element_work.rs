//! One element at a time: its matrices, and its displacements less their rigid part.

use crate::fe::element::continuum::{MAX_NODES, nodal_mass_into, stiffness_into};
use crate::fe::model::{HousingElement, HousingModel, ModelError};
use nalgebra::{Matrix3, Vector3};

/// Elements that one thread sums in a row. A constant, so that the order of the sums does not depend on the number
/// of threads.
pub(super) const CHUNK: usize = 512;

/// Largest degrees of freedom of an element.
pub(super) const MAX_DOF: usize = 3 * MAX_NODES;

/// Matrices of one element, and room for its displacements.
pub(super) struct ElementWork {
    stiffness: Vec<f64>,
    mass: Vec<f64>,
    nodes: usize,
    dof: usize,
    /// Nodes from their mean, m.
    arms: [[f64; 3]; MAX_NODES],
    /// `(sum |a|^2 1 - a a^T)^-1` of the arms a: from the moment of displacements to the mean turn.
    turn: Matrix3<f64>,
}

impl ElementWork {
    pub(super) fn new() -> Self {
        Self {
            stiffness: vec![0.0; MAX_DOF * MAX_DOF],
            mass: vec![0.0; MAX_NODES * MAX_NODES],
            nodes: 0,
            dof: 0,
            arms: [[0.0; 3]; MAX_NODES],
            turn: Matrix3::zeros(),
        }
    }

    /// Degrees of freedom of the element.
    pub(super) fn dof(&self) -> usize {
        self.dof
    }

    /// Computes the matrices of an element.
    ///
    /// # Errors
    /// [`ModelError::Refused`] with its tag if it is inverted or degenerate.
    pub(super) fn load(&mut self, model: &HousingModel, element: &HousingElement) -> Result<(), ModelError> {
        let mut coordinates = [[0.0; 3]; MAX_NODES];
        let nodes = model.elements.nodes(element);
        for (to, &node) in coordinates.iter_mut().zip(nodes) {
            *to = model.coordinates[node];
        }
        (self.nodes, self.dof) = (nodes.len(), element.kind.dof());
        let (at, properties) = (&coordinates[..nodes.len()], &model.properties[element.part]);
        let stiffness = &mut self.stiffness[..self.dof * self.dof];
        let mass = &mut self.mass[..self.nodes * self.nodes];
        stiffness_into(element.kind, at, properties, model.description.formulation, stiffness)
            .and_then(|()| nodal_mass_into(element.kind, at, properties, mass))
            .map_err(|source| ModelError::element(&model.path, element.tag, &source))?;
        self.turn_from(at);
        Ok(())
    }

    fn turn_from(&mut self, at: &[[f64; 3]]) {
        let count = at.len() as f64;
        let mean = [0, 1, 2].map(|i| at.iter().map(|x| x[i]).sum::<f64>() / count);
        let mut inertia = Matrix3::zeros();
        for (arm, x) in self.arms.iter_mut().zip(at) {
            *arm = [0, 1, 2].map(|i| x[i] - mean[i]);
            let a = Vector3::from(*arm);
            inertia += Matrix3::identity() * a.norm_squared() - a * a.transpose();
        }
        // nodes in line have no volume and were refused
        self.turn = inertia.try_inverse().unwrap_or_default();
    }

    /// Displacements of the element's nodes in a mode.
    pub(super) fn moves(
        &self,
        model: &HousingModel,
        element: &HousingElement,
        shape: &[f64],
        moves: &mut [f64; MAX_DOF],
    ) {
        let d = model.dimension;
        for (a, &node) in model.elements.nodes(element).iter().enumerate() {
            moves[d * a..d * a + d].copy_from_slice(&shape[d * node..d * node + d]);
        }
    }

    /// Takes the mean translation and the mean turn out: K_e does not resist them, and round-off of what is left
    /// is relative to the element's own deformation.
    pub(super) fn take_rigid_out(&self, d: usize, moves: &mut [f64; MAX_DOF]) {
        for i in 0..d {
            let mean = (0..self.nodes).map(|a| moves[d * a + i]).sum::<f64>() / self.nodes as f64;
            (0..self.nodes).for_each(|a| moves[d * a + i] -= mean);
        }
        let component = |moves: &[f64; MAX_DOF], a: usize, i: usize| {
            if i < d { moves[d * a + i] } else { 0.0 }
        };
        let mut moment = Vector3::zeros();
        for (a, arm) in self.arms.iter().enumerate().take(self.nodes) {
            let u = Vector3::from([0, 1, 2].map(|i| component(moves, a, i)));
            moment += Vector3::from(*arm).cross(&u);
        }
        let turn = self.turn * moment;
        for (a, arm) in self.arms.iter().enumerate().take(self.nodes) {
            let carried = turn.cross(&Vector3::from(*arm));
            (0..d).for_each(|i| moves[d * a + i] -= carried[i]);
        }
    }

    /// `K_e u`.
    pub(super) fn force(&self, moves: &[f64; MAX_DOF], force: &mut [f64; MAX_DOF]) {
        let moves = &moves[..self.dof];
        let columns = self.stiffness[..self.dof * self.dof].chunks_exact(self.dof);
        for (to, column) in force.iter_mut().zip(columns) {
            *to = column.iter().zip(moves).map(|(k, u)| k * u).sum();
        }
    }

    /// `[phi_e^T K_e phi_e, phi_e^T M_e phi_e]`.
    pub(super) fn energies(&self, model: &HousingModel, element: &HousingElement, shape: &[f64]) -> [f64; 2] {
        let d = model.dimension;
        let (mut moves, mut force) = ([0.0; MAX_DOF], [0.0; MAX_DOF]);
        self.moves(model, element, shape, &mut moves);
        let mut kinetic = 0.0;
        for b in 0..self.nodes {
            for a in 0..self.nodes {
                let dot: f64 = (0..d).map(|i| moves[d * a + i] * moves[d * b + i]).sum();
                kinetic += self.mass[self.nodes * b + a] * dot;
            }
        }
        self.take_rigid_out(d, &mut moves);
        self.force(&moves, &mut force);
        let pairs = moves.iter().zip(&force).take(self.dof);
        [pairs.map(|(u, f)| u * f).sum(), kinetic]
    }
}
