//! Where a mode's strain and kinetic energy sit: by part, by physical group, by spring and by point mass.

use super::ModalError;
use super::energy_sums::element_sums;
use super::error::check_count;
use super::membership::Membership;
use crate::linalg::DenseMatrix;
use crate::mesh::Mesh;
use crate::model::{HousingModel, NodalMatrix, NodalSource};
use serde::Serialize;

/// Energy of modes by where it is. Numbers of a mode are in the order of the names here.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct EnergyShares {
    /// Groups of the parts, in the model's order. Every element is in one part.
    pub parts: Vec<String>,
    /// Physical groups of volumes (plane: surfaces), in the mesh's order. Groups may overlap or leave elements out.
    pub groups: Vec<String>,
    /// Supports and links with springs: the group, or `first - second`; supports first, in the order of the case.
    pub springs: Vec<String>,
    /// Groups of the point masses, in the order of the case.
    pub masses: Vec<String>,
    /// The modes, in the order given.
    pub modes: Vec<ModeShares>,
}

/// Energy of one mode.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModeShares {
    /// Twice the strain energy, summed element by element and spring by spring: `phi^T K phi`, 1/s^2 if
    /// mass-normalised.
    pub doubled_strain: f64,
    /// `phi^T M phi`, summed likewise, 1 if mass-normalised: kinetic energy at unit frequency, doubled.
    pub doubled_kinetic: f64,
    /// Fractions of the strain energy; `None` for a rigid mode, whose energy is round-off
    /// ([`ModalBasis::rigid_modes`](super::ModalBasis::rigid_modes)).
    pub strain: Option<StrainShares>,
    /// Fractions of the kinetic energy; `None` for a mode that moves no mass.
    pub kinetic: Option<KineticShares>,
}

/// Fractions of a mode's strain energy; `parts` and `springs` together add up to 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StrainShares {
    /// By part.
    pub parts: Vec<f64>,
    /// By physical group.
    pub groups: Vec<f64>,
    /// By support or link.
    pub springs: Vec<f64>,
}

/// Fractions of a mode's kinetic energy; `parts` and `masses` together add up to 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct KineticShares {
    /// By part.
    pub parts: Vec<f64>,
    /// By physical group.
    pub groups: Vec<f64>,
    /// By point mass.
    pub masses: Vec<f64>,
}

impl EnergyShares {
    /// Shares of the modes Phi [dof x count], `shapes`, over all degrees of freedom (tied nodes filled in); the first
    /// `rigid_modes` of them are motions without strain.
    ///
    /// All modes in one pass over the elements, `phi_e^T K_e phi_e` and `phi_e^T M_e phi_e`, in parallel; the
    /// result is the same to the bit for any number of threads. An element's mean translation is taken out before
    /// its stiffness is applied, which changes nothing but round-off.
    ///
    /// # Errors
    /// [`ModalError::Shape`] if the modes or the mesh do not belong to the model, [`ModalError::Model`] with the
    /// tag of an element that is inverted or degenerate.
    pub fn new(
        mesh: &Mesh,
        model: &HousingModel,
        shapes: &DenseMatrix,
        rigid_modes: usize,
    ) -> Result<Self, ModalError> {
        check_count("rows of the modes", model.dof(), shapes.nrows())?;
        check_count(
            "nodes of the mesh",
            model.coordinates.len(),
            mesh.nodes.len(),
        )?;
        let membership = Membership::new(mesh, model)?;
        let sums = element_sums(model, &membership, shapes)?;
        let springs = Attached::springs(model, shapes);
        let masses = Attached::masses(model, shapes);
        let modes = (0..shapes.ncols()).map(|mode| {
            let rows = sums.of_mode(mode);
            let (springs, masses) = (&springs.sums[mode], &masses.sums[mode]);
            let strain: f64 = rows.strain_parts().chain(springs.iter().copied()).sum();
            let kinetic: f64 = rows.kinetic_parts().chain(masses.iter().copied()).sum();
            let of = |whole: f64, values: &[f64]| values.iter().map(|v| v / whole).collect();
            let by = |whole: f64, values: &mut dyn Iterator<Item = f64>| {
                values.map(|value| value / whole).collect()
            };
            ModeShares {
                doubled_strain: strain,
                doubled_kinetic: kinetic,
                strain: (mode >= rigid_modes && strain > 0.0).then(|| StrainShares {
                    parts: by(strain, &mut rows.strain_parts()),
                    groups: by(strain, &mut rows.strain_groups()),
                    springs: of(strain, springs),
                }),
                kinetic: (kinetic > 0.0).then(|| KineticShares {
                    parts: by(kinetic, &mut rows.kinetic_parts()),
                    groups: by(kinetic, &mut rows.kinetic_groups()),
                    masses: of(kinetic, masses),
                }),
            }
        });
        let modes = modes.collect();
        Ok(Self {
            parts: model.part_groups.clone(),
            groups: membership.names,
            springs: springs.names,
            masses: masses.names,
            modes,
        })
    }
}

/// Sums of what hangs on nodes, by mode and by name.
struct Attached {
    names: Vec<String>,
    sums: Vec<Vec<f64>>,
}

impl Attached {
    fn springs(model: &HousingModel, shapes: &DenseMatrix) -> Self {
        let name = |source| match source {
            NodalSource::Support(index) => model.supports.get(index).map(|s| s.group.clone()),
            NodalSource::Link(index) => {
                let link = model.links.get(index);
                link.map(|link| format!("{} - {}", link.between[0], link.between[1]))
            }
            NodalSource::Mass(_) => None,
        };
        Self::new(&model.springs, shapes, model.dimension, name)
    }

    /// A mass has one row a node, the same for every component.
    fn masses(model: &HousingModel, shapes: &DenseMatrix) -> Self {
        let name = |source| match source {
            NodalSource::Mass(index) => model.point_masses.get(index).map(|m| m.group.clone()),
            _ => None,
        };
        Self::new(&model.masses, shapes, model.dimension, name)
    }

    fn new(
        matrices: &[NodalMatrix],
        shapes: &DenseMatrix,
        d: usize,
        name: impl Fn(NodalSource) -> Option<String>,
    ) -> Self {
        let mut sources: Vec<NodalSource> = matrices.iter().map(|matrix| matrix.source).collect();
        sources.sort_unstable();
        sources.dedup();
        let mut sums = vec![vec![0.0; sources.len()]; shapes.ncols()];
        for NodalMatrix {
            nodes,
            matrix,
            source,
        } in matrices
        {
            let Ok(place) = sources.binary_search(source) else {
                continue;
            };
            // rows of a node: its components together (masses), or each by itself (springs)
            let rows = matrix.nrows() / nodes.len().max(1);
            for (mode, sums) in sums.iter_mut().enumerate() {
                let at =
                    |row: usize, i: usize| shapes[(d * nodes[row / rows] + row % rows + i, mode)];
                for b in 0..matrix.ncols() {
                    for a in 0..matrix.nrows() {
                        let components = if rows == d { 1 } else { d };
                        let dot: f64 = (0..components).map(|i| at(a, i) * at(b, i)).sum();
                        sums[place] += matrix[(a, b)] * dot;
                    }
                }
            }
        }
        Self {
            names: sources
                .into_iter()
                .map(|source| name(source).unwrap_or_default())
                .collect(),
            sums,
        }
    }
}

#[cfg(test)]
#[path = "energy_shares_tests.rs"]
mod tests;
