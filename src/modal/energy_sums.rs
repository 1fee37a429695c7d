//! Strain and kinetic energies of modes, summed element by element.

use super::ModalError;
use super::membership::Membership;
use crate::element::ElementError;
use crate::element::continuum::{MAX_NODES, nodal_mass_into, stiffness_into};
use crate::linalg::DenseMatrix;
use crate::model::{HousingElement, HousingModel, ModelError};
use rayon::prelude::*;

/// Elements that one thread sums in a row. A constant, so that the order of the sums does not depend on the number
/// of threads.
const CHUNK: usize = 512;

/// Largest degrees of freedom of an element.
const MAX_DOF: usize = 3 * MAX_NODES;

/// Sums by mode: strain of each part, of each group, then kinetic likewise.
pub(super) struct Sums {
    parts: usize,
    groups: usize,
    values: Vec<f64>,
}

/// The sums of one mode.
#[derive(Clone, Copy)]
pub(super) struct Rows<'s> {
    sums: &'s Sums,
    first: usize,
}

impl Sums {
    fn zeros(parts: usize, groups: usize, modes: usize) -> Self {
        Self {
            parts,
            groups,
            values: vec![0.0; 2 * (parts + groups) * modes],
        }
    }

    fn width(&self) -> usize {
        self.parts + self.groups
    }

    pub fn of_mode(&self, mode: usize) -> Rows<'_> {
        Rows {
            sums: self,
            first: 2 * self.width() * mode,
        }
    }

    fn add(&mut self, mode: usize, part: usize, groups: &[usize], [strain, kinetic]: [f64; 2]) {
        let width = self.width();
        let own = &mut self.values[2 * width * mode..][..2 * width];
        for place in std::iter::once(part).chain(groups.iter().map(|group| self.parts + group)) {
            own[place] += strain;
            own[width + place] += kinetic;
        }
    }
}

impl<'s> Rows<'s> {
    fn slice(self, from: usize, count: usize) -> impl Iterator<Item = f64> + 's {
        self.sums.values[self.first + from..][..count]
            .iter()
            .copied()
    }

    pub fn strain_parts(self) -> impl Iterator<Item = f64> + 's {
        self.slice(0, self.sums.parts)
    }

    pub fn strain_groups(self) -> impl Iterator<Item = f64> + 's {
        self.slice(self.sums.parts, self.sums.groups)
    }

    pub fn kinetic_parts(self) -> impl Iterator<Item = f64> + 's {
        self.slice(self.sums.width(), self.sums.parts)
    }

    pub fn kinetic_groups(self) -> impl Iterator<Item = f64> + 's {
        self.slice(self.sums.width() + self.sums.parts, self.sums.groups)
    }
}

/// Sums over all elements in one pass.
///
/// # Errors
/// [`ModalError::Model`] for the first element that is inverted or degenerate.
pub(super) fn element_sums(
    model: &HousingModel,
    membership: &Membership,
    shapes: &DenseMatrix,
) -> Result<Sums, ModalError> {
    let (parts, groups) = (model.properties.len(), membership.names.len());
    let zeros = || Sums::zeros(parts, groups, shapes.ncols());
    let chunks: Vec<Result<Sums, ModelError>> = model
        .elements
        .as_slice()
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, elements)| {
            let mut sums = zeros();
            let mut work = ElementWork::new();
            for (place, element) in elements.iter().enumerate() {
                let element_groups = membership.of(CHUNK * chunk + place);
                work.load(model, element)
                    .map_err(|source| ModelError::Element {
                        path: model.path.clone(),
                        tag: element.tag,
                        source: Box::new(source),
                    })?;
                for mode in 0..shapes.ncols() {
                    let energies = work.energies(model, element, shapes, mode);
                    sums.add(mode, element.part, element_groups, energies);
                }
            }
            Ok(sums)
        })
        .collect();
    let mut total = zeros();
    for chunk in chunks {
        for (sum, value) in total.values.iter_mut().zip(chunk?.values) {
            *sum += value;
        }
    }
    Ok(total)
}

/// Matrices of one element, and room for its displacements.
struct ElementWork {
    stiffness: Vec<f64>,
    mass: Vec<f64>,
    nodes: usize,
    dof: usize,
}

impl ElementWork {
    fn new() -> Self {
        Self {
            stiffness: vec![0.0; MAX_DOF * MAX_DOF],
            mass: vec![0.0; MAX_NODES * MAX_NODES],
            nodes: 0,
            dof: 0,
        }
    }

    fn load(&mut self, model: &HousingModel, element: &HousingElement) -> Result<(), ElementError> {
        let mut coordinates = [[0.0; 3]; MAX_NODES];
        let nodes = model.elements.nodes(element);
        for (to, &node) in coordinates.iter_mut().zip(nodes) {
            *to = model.coordinates[node];
        }
        (self.nodes, self.dof) = (nodes.len(), element.kind.dof());
        let (at, properties) = (&coordinates[..nodes.len()], &model.properties[element.part]);
        let stiffness = &mut self.stiffness[..self.dof * self.dof];
        stiffness_into(element.kind, at, properties, model.formulation, stiffness)?;
        let mass = &mut self.mass[..self.nodes * self.nodes];
        nodal_mass_into(element.kind, at, properties, mass)
    }

    /// `[phi_e^T K_e phi_e, phi_e^T M_e phi_e]`.
    fn energies(
        &self,
        model: &HousingModel,
        element: &HousingElement,
        shapes: &DenseMatrix,
        mode: usize,
    ) -> [f64; 2] {
        let d = model.dimension;
        let mut moves = [0.0; MAX_DOF];
        for (a, &node) in model.elements.nodes(element).iter().enumerate() {
            for i in 0..d {
                moves[d * a + i] = shapes[(d * node + i, mode)];
            }
        }
        let mut kinetic = 0.0;
        for b in 0..self.nodes {
            for a in 0..self.nodes {
                let dot: f64 = (0..d).map(|i| moves[d * a + i] * moves[d * b + i]).sum();
                kinetic += self.mass[self.nodes * b + a] * dot;
            }
        }
        for i in 0..d {
            let mean = (0..self.nodes).map(|a| moves[d * a + i]).sum::<f64>() / self.nodes as f64;
            (0..self.nodes).for_each(|a| moves[d * a + i] -= mean);
        }
        let moves = &moves[..self.dof];
        let columns = self.stiffness[..self.dof * self.dof].chunks_exact(self.dof);
        let strain = columns.zip(moves).map(|(column, own)| {
            let force: f64 = column.iter().zip(moves).map(|(k, u)| k * u).sum();
            own * force
        });
        [strain.sum(), kinetic]
    }
}
