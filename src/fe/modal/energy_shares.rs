//! Where a mode's strain and kinetic energy sit: by part, by physical group, in the ring, by spring and by point mass.

use super::ModalError;
use super::energy_sums::element_sums;
use super::error::check_count;
use super::membership::Membership;
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, NodalMatrix, NodalSource, Ring};
use crate::numerics::linalg::DenseMatrix;
use schemars::JsonSchema;
use serde::Serialize;

/// Name of the springs between ring and ground among the others.
const RING_SPRINGS: &str = "ring supports";

/// Energy of modes by where it is. Numbers of a mode are in the order of the names here.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct EnergyShares {
    /// Groups of the parts, in the model's order. Every element is in one part.
    pub parts: Vec<String>,
    /// Physical groups of volumes (plane: surfaces), in the mesh's order. Groups may overlap or leave elements out.
    pub groups: Vec<String>,
    /// Supports and links with springs: the group, or `first - second`; supports first, in the order of the case; then
    /// the springs of the ring, as `ring supports`.
    pub springs: Vec<String>,
    /// Groups of the point masses, in the order of the case.
    pub masses: Vec<String>,
    /// The modes, in the order given.
    pub modes: Vec<ModeShares>,
}

/// Energy of one mode.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
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

/// Fractions of a mode's strain energy; `parts`, `ring` and `springs` together add up to 1.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct StrainShares {
    /// By part.
    pub parts: Vec<f64>,
    /// By physical group.
    pub groups: Vec<f64>,
    /// In the ring's beams; `None` without a ring.
    pub ring: Option<f64>,
    /// By support or link.
    pub springs: Vec<f64>,
}

/// Fractions of a mode's kinetic energy; `parts`, `ring` and `masses` together add up to 1.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct KineticShares {
    /// By part.
    pub parts: Vec<f64>,
    /// By physical group.
    pub groups: Vec<f64>,
    /// In the ring; `None` without a ring.
    pub ring: Option<f64>,
    /// By point mass.
    pub masses: Vec<f64>,
}

impl EnergyShares {
    /// Shares of the modes Phi [dof x count], `shapes`, over all degrees of freedom (tied nodes filled in); the first
    /// `rigid_modes` of them are motions without strain.
    ///
    /// All modes in one pass over the elements, `phi_e^T K_e phi_e` and `phi_e^T M_e phi_e`, in parallel; the
    /// result is the same to the bit for any number of threads. An element's mean translation and turn are taken out
    /// before its stiffness is applied, which changes nothing but round-off.
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
        let sums = HousingSums::new(mesh, model, shapes)?;
        Ok(Self::of(Some(sums), None, shapes.ncols(), rigid_modes))
    }

    /// The same of a housing and the ring in its bore, which moves by `ring_shapes` [ring dof x count]. The tie has no
    /// energy of its own.
    ///
    /// # Errors
    /// As [`EnergyShares::new`], [`ModalError::Shape`] also if the modes do not belong to the ring.
    pub(crate) fn with_ring(
        (mesh, model): (&Mesh, &HousingModel),
        ring: &Ring,
        shapes: &DenseMatrix,
        ring_shapes: &DenseMatrix,
        rigid_modes: usize,
    ) -> Result<Self, ModalError> {
        check_count("modes of the ring", shapes.ncols(), ring_shapes.ncols())?;
        let sums = HousingSums::new(mesh, model, shapes)?;
        let of_ring = RingSums::new(ring, ring_shapes)?;
        Ok(Self::of(Some(sums), Some(of_ring), shapes.ncols(), rigid_modes))
    }

    /// Shares of a ring alone and its springs.
    ///
    /// # Errors
    /// [`ModalError::Shape`] if the modes [ring dof x count] do not belong to the ring.
    pub(crate) fn of_ring(ring: &Ring, ring_shapes: &DenseMatrix, rigid_modes: usize) -> Result<Self, ModalError> {
        let sums = RingSums::new(ring, ring_shapes)?;
        Ok(Self::of(None, Some(sums), ring_shapes.ncols(), rigid_modes))
    }

    fn of(housing: Option<HousingSums>, ring: Option<RingSums>, count: usize, rigid_modes: usize) -> Self {
        let housing = housing.unwrap_or_default();
        let modes = (0..count).map(|mode| {
            let rows = |all: &[Vec<f64>]| all.get(mode).cloned().unwrap_or_default();
            let mut springs = rows(&housing.springs.sums);
            let masses = rows(&housing.masses.sums);
            let [[parts, groups], [heavy_parts, heavy_groups]] =
                housing.energies.get(mode).cloned().unwrap_or_default();
            let of_ring = ring.as_ref().map(|ring| ring.modes[mode]);
            springs.extend(of_ring.and_then(|ring| ring.springs));
            let sum = |values: [&[f64]; 2], ring: Option<f64>| -> f64 {
                values.into_iter().flatten().sum::<f64>() + ring.unwrap_or(0.0)
            };
            let strain = sum([&parts, &springs], of_ring.map(|ring| ring.strain));
            let kinetic = sum([&heavy_parts, &masses], of_ring.map(|ring| ring.kinetic));
            let over = |whole: f64, values: Vec<f64>| values.into_iter().map(|v| v / whole).collect();
            ModeShares {
                doubled_strain: strain,
                doubled_kinetic: kinetic,
                strain: (mode >= rigid_modes && strain > 0.0).then(|| StrainShares {
                    parts: over(strain, parts),
                    groups: over(strain, groups),
                    ring: of_ring.map(|ring| ring.strain / strain),
                    springs: over(strain, springs),
                }),
                kinetic: (kinetic > 0.0).then(|| KineticShares {
                    parts: over(kinetic, heavy_parts),
                    groups: over(kinetic, heavy_groups),
                    ring: of_ring.map(|ring| ring.kinetic / kinetic),
                    masses: over(kinetic, masses),
                }),
            }
        });
        let modes = modes.collect();
        let mut springs = housing.springs.names;
        if ring.is_some_and(|ring| ring.has_springs) {
            springs.push(RING_SPRINGS.to_owned());
        }
        Self { parts: housing.parts, groups: housing.groups, springs, masses: housing.masses.names, modes }
    }
}

/// Energies of a housing's modes.
#[derive(Default)]
struct HousingSums {
    parts: Vec<String>,
    groups: Vec<String>,
    /// Strain and kinetic energies of each mode, by part and by group.
    energies: Vec<[[Vec<f64>; 2]; 2]>,
    springs: Attached,
    masses: Attached,
}

impl HousingSums {
    fn new(mesh: &Mesh, model: &HousingModel, shapes: &DenseMatrix) -> Result<Self, ModalError> {
        check_count("rows of the modes", model.dof(), shapes.nrows())?;
        check_count("nodes of the mesh", model.coordinates.len(), mesh.nodes.len())?;
        let membership = Membership::new(mesh, model)?;
        let sums = element_sums(model, &membership, shapes)?;
        Ok(Self {
            parts: model.part_groups(),
            groups: membership.names,
            energies: (0..shapes.ncols()).map(|mode| sums.of_mode(mode)).collect(),
            springs: Attached::springs(model, shapes),
            masses: Attached::masses(model, shapes),
        })
    }
}

/// Energies of a ring's modes.
struct RingSums {
    has_springs: bool,
    modes: Vec<RingEnergies>,
}

#[derive(Clone, Copy)]
struct RingEnergies {
    strain: f64,
    kinetic: f64,
    /// `None` for a ring without.
    springs: Option<f64>,
}

impl RingSums {
    fn new(ring: &Ring, shapes: &DenseMatrix) -> Result<Self, ModalError> {
        check_count("rows of the ring's modes", ring.dof(), shapes.nrows())?;
        let heavy = ring.mass() * shapes;
        let has_springs = !ring.springs.is_empty();
        let energies = |mode: usize| {
            let own = ring.strain_products(&shapes.subcols(mode, 1).to_owned());
            RingEnergies {
                strain: own.beams[(0, 0)],
                kinetic: shapes.col(mode).transpose() * heavy.col(mode),
                springs: has_springs.then(|| own.springs[(0, 0)]),
            }
        };
        Ok(Self { has_springs, modes: (0..shapes.ncols()).map(energies).collect() })
    }
}

/// Sums of what hangs on nodes, by mode and by name.
#[derive(Default)]
struct Attached {
    names: Vec<String>,
    sums: Vec<Vec<f64>>,
}

impl Attached {
    fn springs(model: &HousingModel, shapes: &DenseMatrix) -> Self {
        let name = |source| match source {
            NodalSource::Support(index) => model.description.supports.get(index).map(|s| s.group.clone()),
            NodalSource::Link(index) => {
                let link = model.description.links.get(index);
                link.map(|link| format!("{} - {}", link.between[0], link.between[1]))
            }
            NodalSource::Mass(_) => None,
        };
        Self::new(&model.springs, shapes, model.dimension, name)
    }

    /// A mass has one row a node, the same for every component.
    fn masses(model: &HousingModel, shapes: &DenseMatrix) -> Self {
        let name = |source| match source {
            NodalSource::Mass(index) => model.description.masses.get(index).map(|m| m.group.clone()),
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
        for NodalMatrix { nodes, matrix, source } in matrices {
            let Ok(place) = sources.binary_search(source) else {
                continue;
            };
            // rows of a node: its components together (masses), or each by itself (springs)
            let rows = matrix.nrows() / nodes.len().max(1);
            for (mode, sums) in sums.iter_mut().enumerate() {
                let at = |row: usize, i: usize| shapes[(d * nodes[row / rows] + row % rows + i, mode)];
                for b in 0..matrix.ncols() {
                    for a in 0..matrix.nrows() {
                        let components = if rows == d { 1 } else { d };
                        let dot: f64 = (0..components).map(|i| at(a, i) * at(b, i)).sum();
                        sums[place] += matrix[(a, b)] * dot;
                    }
                }
            }
        }
        Self { names: sources.into_iter().map(|source| name(source).unwrap_or_default()).collect(), sums }
    }
}

#[cfg(test)]
#[path = "energy_shares_tests.rs"]
mod tests;
