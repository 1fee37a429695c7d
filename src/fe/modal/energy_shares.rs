//! Where a mode's strain and kinetic energy sit: by part, by physical group, in the ring, by spring and by point mass.
//!
//! Which physical groups the elements of a housing are in.

use super::error::{ModalError, check_count};
use super::strain_products::sum_over_elements;
use crate::fe::mesh::Mesh;
use crate::fe::model::{HousingModel, NodalMatrix, NodalSource, RingSeat, Rings};
use crate::numerics::linalg::DenseMatrix;
use schemars::JsonSchema;
use serde::Serialize;
use std::iter::once;

/// Name of the springs between a ring and the ground among the others.
const RING_SPRINGS: &str = "ring supports";

/// Energy of modes by where it is. Numbers of a mode are in the order of the names here.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct EnergyShares {
    /// Groups of the parts, in the model's order. Every element is in one part.
    pub parts: Vec<String>,
    /// Physical groups of volumes (plane: surfaces), in the mesh's order. Groups may overlap or leave elements out.
    pub groups: Vec<String>,
    /// Supports and links with springs: the group, or `first - second`; supports first, in the order of the case; then
    /// the springs of each ring, as `ring supports` or `ring supports A`.
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
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct StrainShares {
    /// By part.
    pub parts: Vec<f64>,
    /// By physical group.
    pub groups: Vec<f64>,
    /// In the beams of all rings; `None` without a ring.
    pub ring: Option<f64>,
    /// By support or link.
    pub springs: Vec<f64>,
}

/// Fractions of a mode's kinetic energy; `parts`, `ring` and `masses` together add up to 1.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct KineticShares {
    /// By part.
    pub parts: Vec<f64>,
    /// By physical group.
    pub groups: Vec<f64>,
    /// In all rings; `None` without a ring.
    pub ring: Option<f64>,
    /// By point mass.
    pub masses: Vec<f64>,
}

/// Energies of one mode, not yet divided by their sums.
type Energies = (StrainShares, KineticShares);

impl EnergyShares {
    /// Shares of the modes of a housing and of the rings in its bores, or of one of them; the first `rigid_modes` are motions without
    /// strain. Of the housing: modes Phi [dof x count] over all degrees of freedom (tied nodes filled in); of the rings: their part of
    /// the same modes [ring dof x count]. A tie has no energy of its own.
    ///
    /// All modes in one pass over the elements, `phi_e^T K_e phi_e` and `phi_e^T M_e phi_e`, in parallel; the
    /// result is the same to the bit for any number of threads. An element's mean translation and turn are taken out
    /// before its stiffness is applied, which changes nothing but round-off.
    ///
    /// # Errors
    /// [`ModalError::Shape`] if the modes, the mesh or the ring do not belong together, [`ModalError::Model`] with the
    /// tag of an element that is inverted or degenerate.
    pub fn new(
        housing: Option<(&Mesh, &HousingModel, &DenseMatrix)>,
        rings: Option<(&Rings, &DenseMatrix)>,
        rigid_modes: usize,
    ) -> Result<Self, ModalError> {
        let of_rings = rings.map(|(_, shapes)| shapes.ncols());
        let count = housing.map(|(.., shapes)| shapes.ncols()).or(of_rings).unwrap_or(0);
        check_count("modes of the ring", count, of_rings.unwrap_or(count))?;
        let mut energies = vec![Energies::default(); count];
        let mut shares = Self::default();
        if let Some((mesh, model, shapes)) = housing {
            shares.add_housing(mesh, model, shapes, &mut energies)?;
        }
        if let Some((rings, shapes)) = rings {
            check_count("rows of the ring's modes", rings.dof(), shapes.nrows())?;
            for seat in rings.seats() {
                shares.add_ring(seat, &shapes.subrows(seat.first, seat.ring.dof()).to_owned(), &mut energies);
            }
        }
        let modes = energies.into_iter().enumerate().map(|(mode, (strain, kinetic))| {
            let sum = |values: [&[f64]; 2], ring: Option<f64>| -> f64 {
                values.into_iter().flatten().sum::<f64>() + ring.unwrap_or(0.0)
            };
            let doubled_strain = sum([&strain.parts, &strain.springs], strain.ring);
            let doubled_kinetic = sum([&kinetic.parts, &kinetic.masses], kinetic.ring);
            let over = |whole: f64, values: Vec<f64>| values.into_iter().map(|v| v / whole).collect();
            ModeShares {
                doubled_strain,
                doubled_kinetic,
                strain: (mode >= rigid_modes && doubled_strain > 0.0).then(|| StrainShares {
                    parts: over(doubled_strain, strain.parts),
                    groups: over(doubled_strain, strain.groups),
                    ring: strain.ring.map(|ring| ring / doubled_strain),
                    springs: over(doubled_strain, strain.springs),
                }),
                kinetic: (doubled_kinetic > 0.0).then(|| KineticShares {
                    parts: over(doubled_kinetic, kinetic.parts),
                    groups: over(doubled_kinetic, kinetic.groups),
                    ring: kinetic.ring.map(|ring| ring / doubled_kinetic),
                    masses: over(doubled_kinetic, kinetic.masses),
                }),
            }
        });
        shares.modes = modes.collect();
        Ok(shares)
    }

    fn add_housing(
        &mut self,
        mesh: &Mesh,
        model: &HousingModel,
        shapes: &DenseMatrix,
        energies: &mut [Energies],
    ) -> Result<(), ModalError> {
        check_count("rows of the modes", model.dof(), shapes.nrows())?;
        check_count("nodes of the mesh", model.coordinates.len(), mesh.nodes.len())?;
        let membership = Membership::new(mesh, model)?;
        let parts = model.properties.len();
        let size = [parts + membership.names.len(), 2 * shapes.ncols()];
        let sums = sum_over_elements(model, size, |work, place, element, sums| {
            let groups = membership.of(place).map(|group| parts + group);
            let rows: Vec<usize> = once(element.part).chain(groups).collect();
            for mode in 0..shapes.ncols() {
                let [strain, kinetic] = work.energies(model, element, shapes.col_as_slice(mode));
                for &row in &rows {
                    sums[(row, 2 * mode)] += strain;
                    sums[(row, 2 * mode + 1)] += kinetic;
                }
            }
        })?;
        let (springs, masses) = (attached(model, &model.springs, shapes), attached(model, &model.masses, shapes));
        for (mode, (strain, kinetic)) in energies.iter_mut().enumerate() {
            let split = |column: usize| {
                let (parts, groups) = sums.col_as_slice(column).split_at(parts);
                (parts.to_vec(), groups.to_vec())
            };
            (strain.parts, strain.groups) = split(2 * mode);
            (kinetic.parts, kinetic.groups) = split(2 * mode + 1);
            strain.springs = springs.1.col_as_slice(mode).to_vec();
            kinetic.masses = masses.1.col_as_slice(mode).to_vec();
        }
        (self.parts, self.groups) = (model.part_groups(), membership.names);
        (self.springs, self.masses) = (springs.0, masses.0);
        Ok(())
    }

    /// Adds the energies of a ring from modes over its own coordinates [ring dof x count].
    fn add_ring(&mut self, RingSeat { ring, label, .. }: &RingSeat, shapes: &DenseMatrix, energies: &mut [Energies]) {
        let heavy = ring.mass() * shapes;
        for (mode, (strain, kinetic)) in energies.iter_mut().enumerate() {
            let own = ring.strain_products(&shapes.subcols(mode, 1).to_owned());
            *strain.ring.get_or_insert(0.0) += own.beams[(0, 0)];
            *kinetic.ring.get_or_insert(0.0) += shapes.col(mode).transpose() * heavy.col(mode);
            strain.springs.extend((!ring.springs.is_empty()).then(|| own.springs[(0, 0)]));
        }
        let name = format!("{RING_SPRINGS} {label}");
        self.springs.extend((!ring.springs.is_empty()).then(|| name.trim_end().to_owned()));
    }
}

/// What hangs on nodes: names of the sources, and their energies [sources x modes].
fn attached(model: &HousingModel, matrices: &[NodalMatrix], shapes: &DenseMatrix) -> (Vec<String>, DenseMatrix) {
    let mut sources: Vec<NodalSource> = matrices.iter().map(|matrix| matrix.source).collect();
    sources.sort_unstable();
    sources.dedup();
    let d = model.dimension;
    let mut sums = DenseMatrix::zeros(sources.len(), shapes.ncols());
    for NodalMatrix { nodes, matrix, source } in matrices {
        let place = sources.partition_point(|other| other < source);
        // rows of a node: its components together (masses: the same for every component), or each by itself (springs)
        let rows = matrix.nrows() / nodes.len().max(1);
        let components = if rows == d { 1 } else { d };
        for mode in 0..shapes.ncols() {
            let at = |row: usize, i: usize| shapes[(d * nodes[row / rows] + row % rows + i, mode)];
            for b in 0..matrix.ncols() {
                for a in 0..matrix.nrows() {
                    let dot: f64 = (0..components).map(|i| at(a, i) * at(b, i)).sum();
                    sums[(place, mode)] += matrix[(a, b)] * dot;
                }
            }
        }
    }
    let name = |source: &NodalSource| match *source {
        NodalSource::Support(index) => model.description.supports.get(index).map(|support| support.group.clone()),
        NodalSource::Link(index) => model.description.links.get(index).map(|link| link.between.join(" - ")),
        NodalSource::Mass(index) => model.description.masses.get(index).map(|mass| mass.group.clone()),
    };
    (sources.iter().map(|source| name(source).unwrap_or_default()).collect(), sums)
}

/// Which physical groups each element belongs to.
pub(super) struct Membership {
    /// Groups of the elements' dimension, in the mesh's order.
    pub names: Vec<String>,
    /// Elements and their groups, ascending.
    pairs: Vec<(usize, usize)>,
}

impl Membership {
    /// A model takes the elements of the highest dimension in the mesh's order, so that counting them block by
    /// block gives their place in it.
    pub(super) fn new(mesh: &Mesh, model: &HousingModel) -> Result<Self, ModalError> {
        let mut first = Vec::with_capacity(mesh.blocks.len());
        let mut count = 0;
        for block in &mesh.blocks {
            first.push(count);
            if block.kind.dimension() == model.dimension {
                count += block.len();
            }
        }
        check_count("elements of the mesh", model.elements.len(), count)?;
        let own = mesh.groups.iter().filter(|group| group.dimension == model.dimension);
        let mut pairs = Vec::new();
        let mut names = Vec::new();
        for group in own {
            for id in &group.elements {
                if let Some(start) = first.get(id.block) {
                    pairs.push((start + id.index, names.len()));
                }
            }
            names.push(group.name.clone());
        }
        pairs.sort_unstable();
        Ok(Self { names, pairs })
    }

    /// Groups of an element, as places in `names`.
    pub(super) fn of(&self, element: usize) -> impl Iterator<Item = usize> {
        let start = self.pairs.partition_point(|pair| pair.0 < element);
        self.pairs[start..].iter().take_while(move |pair| pair.0 == element).map(|pair| pair.1)
    }
}

#[cfg(test)]
#[path = "energy_shares_tests.rs"]
mod tests;
