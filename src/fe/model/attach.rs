//! Supports and point masses on the nodes of a housing.

use super::ModelError;
use super::housing::HousingModel;
use super::spread::{Share, shares};
use super::support::{Constraint, NodalMatrix, NodalSource, PointMass, SpringStiffness, SupportShare};
use crate::fe::mesh::Mesh;
use nalgebra::DMatrix;

impl HousingModel {
    pub(super) fn attach_mass(&mut self, mesh: &Mesh, index: usize) -> Result<(), ModelError> {
        let mass = self.description.masses[index].clone();
        let group = self.group_on_housing(mesh, &mass.group, "the mass")?;
        for Share { nodes, matrix } in shares(mesh, group, &self.used, "the mass")? {
            let matrix = matrix * mass.mass;
            self.masses.push(NodalMatrix { nodes, matrix, source: NodalSource::Mass(index) });
        }
        Ok(())
    }

    /// Point masses on nodes that supports hold in every direction.
    pub(crate) fn held_masses(&self) -> impl Iterator<Item = &PointMass> {
        let is_held = |node: &usize| self.fixed[*node][..self.dimension].iter().all(Option::is_some);
        let numbered = self.description.masses.iter().enumerate();
        let held = numbered.filter(move |(index, _)| {
            let of_mass = |matrix: &&NodalMatrix| matches!(matrix.source, NodalSource::Mass(own) if own == *index);
            let mut nodes = self.masses.iter().filter(of_mass).flat_map(|matrix| &matrix.nodes);
            nodes.all(is_held)
        });
        held.map(|(_, mass)| mass)
    }

    pub(super) fn attach_support(&mut self, mesh: &Mesh, index: usize) -> Result<(), ModelError> {
        let support = self.description.supports[index].clone();
        let group = self.group_on_housing(mesh, &support.group, "the support")?;
        let on_housing = group.nodes.iter().copied().filter(|&node| self.used[node]);
        let stiffness = match support.constraint {
            Constraint::Spring(stiffness) => stiffness,
            Constraint::Fixed(components) => {
                for node in on_housing {
                    for (slot, fixed) in self.fixed[node].iter_mut().zip(components) {
                        if fixed {
                            *slot = Some(index);
                        }
                    }
                }
                return Ok(());
            }
        };
        let shares = match support.share {
            SupportShare::PerNode => on_housing.map(Share::of_node).collect(),
            SupportShare::PerGroup => shares(mesh, group, &self.used, "the support")?,
        };
        for share in shares {
            let matrix = self.spring_matrix(&share, stiffness);
            self.springs.push(NodalMatrix { nodes: share.nodes, matrix, source: NodalSource::Support(index) });
        }
        Ok(())
    }

    /// `w_ab S` (global) or `k w_ab r_a r_b^T` with the radial directions r at the nodes (radial).
    pub(super) fn spring_matrix(&self, share: &Share, stiffness: SpringStiffness) -> DMatrix<f64> {
        let d = self.dimension;
        let radial = |node: usize| self.frame.polar_axes(self.coordinates[node])[0];
        DMatrix::from_fn(d * share.nodes.len(), d * share.nodes.len(), |row, column| {
            let (a, b, i, j) = (row / d, column / d, row % d, column % d);
            let weight = share.matrix[(a, b)];
            match stiffness {
                SpringStiffness::Global(along) if i == j => weight * along[i],
                SpringStiffness::Global(_) => 0.0,
                SpringStiffness::Radial(k) => weight * k * radial(share.nodes[a])[i] * radial(share.nodes[b])[j],
            }
        })
    }
}
