//! The housing of a case, condensed on the interface that the case asks for.

use super::centres::{Centres, RingsAndCentres};
use super::housing::AssembledHousing;
use super::places::{PlaceBodies, of_housing, of_rings};
use super::ring::{Boundary, rings_and_tie};
use crate::app::case::{Case, FixedInterfaceModes, Interface, Rule};
use crate::app::error::ComputeError;
use crate::fe::assembly::{CoupledMatrices, StructuralStiffness, SystemMatrices};
use crate::fe::modal::{Bore, Mechanisms, rigid_motions, ring_motions};
use crate::fe::model::{HousingModel, NodeInterface, RingTie};
use crate::fe::reduction::{BasisChoice, BasisSize, CraigBampton, ReductionError, RigidMotions, craig_bampton_watched};
use crate::formats::DofLabel;
use crate::numerics::Watch;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, transpose_times_dense};
use std::borrow::Cow;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// A condensed housing and what it was condensed from.
#[derive(Debug, Clone)]
pub struct CondensedHousing {
    /// The housing.
    pub housing: AssembledHousing,
    /// What the housing is attached by.
    pub boundary: Boundary,
    /// Imaginary part of the stiffness of lossy parts over the housing's degrees of freedom, in the displacements that the
    /// partition uses, N/m; none without such parts.
    pub structural: Option<SparseMatrix>,
    /// What was asked of the basis.
    pub choice: BasisChoice,
    /// The condensed housing.
    pub condensed: CraigBampton,
}

impl CondensedHousing {
    /// Builds and condenses the housing of a case; `None` without a housing, or if neither a ring is tied to it nor
    /// another interface asked for.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, ring, tie and reduction.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, ComputeError> {
        Self::with_basis(case, basis_choice(case), watch)
    }

    /// The same with another basis than the case asks for.
    ///
    /// # Errors
    /// As [`CondensedHousing::build`].
    pub(crate) fn with_basis(
        case: &Case,
        choice: BasisChoice,
        watch: &impl Watch,
    ) -> Result<Option<Self>, ComputeError> {
        // a run condenses a housing with rings as it is assembled for modes in full: the same numbers come of it here
        let housing = match case.has_rings() {
            true => AssembledHousing::build(case, watch)?,
            false => AssembledHousing::ordered(case, watch)?,
        };
        let Some(housing) = housing else {
            return Ok(None);
        };
        let asked = case.frf.as_ref().and_then(|frf| frf.band_hz).map_or(0.0, |[_, high]| high);
        // two digits of what is an estimate
        let highest = || format!("{:.1e}", highest_hz(&housing.matrices)).parse().unwrap_or(f64::INFINITY);
        if asked > 0.0
            && choice.band_hz >= asked
            && let highest = highest()
            && asked > highest
        {
            let limit = "at most what the mesh tells, half the frequency of a node while all others are held";
            let rule = Rule::beyond(asked, limit, highest).with_help("end the band below it, or make the mesh finer");
            return Err(case.broken(&rule.at("frf.band_hz[1]")).into());
        }
        let boundary = match &case.condense.interface {
            Interface::Ring if !case.has_rings() => return Ok(None),
            Interface::Ring => match rings_and_tie(case, Some(&housing))? {
                (rings, Some(tie)) => Boundary::Rings(Box::new((rings, tie))),
                (_, None) => return Ok(None),
            },
            Interface::Group(group) => {
                let group = housing.model.group_on_housing(&housing.mesh, group, "the interface")?;
                let used = |node: &usize| housing.model.used[*node];
                let nodes: Vec<usize> = group.nodes.iter().copied().filter(used).collect();
                Boundary::Nodes(NodeInterface::new(&housing.model, &nodes))
            }
            Interface::Centres { centres, rings } => {
                let centres = Centres::of(&housing, centres)?;
                match rings.then(|| rings_and_tie(case, Some(&housing))).transpose()? {
                    Some((rings, Some(tie))) => {
                        Boundary::Both(Box::new(RingsAndCentres::of(&housing.model, rings, tie, centres)?))
                    }
                    _ => Boundary::Centres(centres),
                }
            }
            Interface::Nodes(tags) => Boundary::Nodes(NodeInterface::new(&housing.model, &nodes_of(&housing, tags)?)),
        };
        if let Boundary::Nodes(nodes) = &boundary
            && nodes.coordinates.is_empty()
        {
            return Err(ComputeError::interface_held(nodes, &housing.model));
        }
        Ok(Some(Self::on(housing, boundary, choice, watch)?))
    }

    /// A housing, condensed on a boundary that is its own.
    ///
    /// # Errors
    /// [`ComputeError`] of the reduction, and for a housing that can move with the boundary held.
    pub(super) fn on(
        housing: AssembledHousing,
        boundary: Boundary,
        choice: BasisChoice,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        check_interior(&housing, &boundary)?;
        let (matrices, partition) = (boundary.matrices(&housing), boundary.partition());
        let condensed = craig_bampton_watched(&matrices, partition, choice, boundary.attached(), watch)
            .map_err(|error| located(error, &housing.model))?;
        drop(matrices);
        let structural = StructuralStiffness::assemble(&housing.model)?;
        let stage = Self {
            structural: structural.map(|structural| match boundary.rings() {
                Some((_, tie)) => structural.for_tie(tie).matrix().clone(),
                None => structural.matrix().clone(),
            }),
            housing,
            boundary,
            choice,
            condensed,
        };
        Ok(stage.with_structural())
    }

    /// The stage with the loss factors of the parts in its superelement.
    fn with_structural(mut self) -> Self {
        if let Some(structural) = &self.structural {
            self.condensed = self.condensed.with_structural(structural);
        }
        self
    }

    /// The same with a basis that is exact in statics for loads on the housing's degrees of freedom [dof x k], in the
    /// displacements that the partition uses.
    ///
    /// # Errors
    /// [`ComputeError::Reduction`].
    pub(crate) fn with_loads(self, loads: &DenseMatrix) -> Result<Self, ComputeError> {
        let forces = self.condensed.interior_of(loads);
        self.with_forces(forces)
    }

    /// The same with the static response to forces on the interior [interior x k] in the basis.
    ///
    /// # Errors
    /// [`ComputeError::Reduction`].
    pub(crate) fn with_forces(mut self, forces: DenseMatrix) -> Result<Self, ComputeError> {
        let weight = self.matrices().weight.clone();
        self.condensed = self.condensed.with_forces(forces, &weight)?;
        Ok(self.with_structural())
    }

    /// The bodies that a place may be on.
    pub(crate) fn bodies(&self) -> PlaceBodies<'_> {
        let rings = self.boundary.rings();
        PlaceBodies {
            housing: Some(&self.housing),
            rings: rings.map(|(rings, _)| rings),
            tie: rings.map(|(_, tie)| tie),
        }
    }

    /// Labels of the interface coordinates, in the axes that they are measured in.
    pub(crate) fn interface_labels(&self) -> Vec<DofLabel> {
        match &self.boundary {
            Boundary::Rings(bodies) => of_rings(&bodies.0),
            Boundary::Both(both) => of_rings(&both.rings).into_iter().chain(both.centres.labels()).collect(),
            Boundary::Centres(centres) => centres.labels(),
            Boundary::Nodes(_) => {
                let labels = of_housing(&self.housing.model, None);
                let driven = &self.boundary.partition().driven;
                driven.iter().map(|&dof| labels[dof]).collect()
            }
        }
    }

    /// Unit rigid motions about the bore's centre, over the housing and over the interface.
    pub(crate) fn rigid_motions(&self) -> RigidMotions {
        let model = &self.housing.model;
        let about = model.frame().centre();
        let motions = rigid_motions(model.coordinates(), model.dimension(), about);
        let of_partition = |tie: &RingTie, motions: DenseMatrix| match tie.rotation() {
            Some(rotation) => transpose_times_dense(rotation, &motions),
            None => motions,
        };
        match &self.boundary {
            Boundary::Rings(bodies) => {
                RigidMotions { interface: ring_motions(&bodies.0, about), housing: of_partition(&bodies.1, motions) }
            }
            Boundary::Both(both) => {
                let (of_rings, of_centres) = (ring_motions(&both.rings, about), both.centres.motions(about));
                RigidMotions {
                    interface: faer::concat![[of_rings], [of_centres]],
                    housing: of_partition(&both.tie, motions),
                }
            }
            Boundary::Centres(centres) => RigidMotions { interface: centres.motions(about), housing: motions },
            Boundary::Nodes(nodes) => {
                let driven = &nodes.partition.driven;
                RigidMotions {
                    interface: DenseMatrix::from_fn(driven.len(), motions.ncols(), |row, motion| {
                        motions[(driven[row], motion)]
                    }),
                    housing: motions,
                }
            }
        }
    }

    /// Matrices of the housing in the displacements that the partition uses.
    pub(crate) fn matrices(&self) -> Cow<'_, SystemMatrices> {
        self.boundary.matrices(&self.housing)
    }

    /// Matrices of the whole, nothing condensed.
    pub fn full_matrices(&self) -> CoupledMatrices {
        let AssembledHousing { model, matrices, .. } = &self.housing;
        match &self.boundary {
            Boundary::Rings(bodies) => CoupledMatrices::new(matrices, &bodies.1, &bodies.0),
            Boundary::Both(both) => CoupledMatrices::with_centres(matrices, &both.tie, &both.rings, both.partition()),
            Boundary::Centres(_) => CoupledMatrices::of_partition(matrices, self.boundary.partition()),
            Boundary::Nodes(_) => CoupledMatrices::of_housing(matrices.clone(), model),
        }
    }
}

/// Indices of the nodes with these tags.
fn nodes_of(housing: &AssembledHousing, tags: &[u64]) -> Result<Vec<usize>, ComputeError> {
    let model = &housing.model;
    let place: HashMap<u64, usize> = model.node_tags.iter().enumerate().map(|(index, &tag)| (tag, index)).collect();
    let found = |(index, tag): (usize, &u64)| {
        let missing = match place.get(tag) {
            Some(&node) if model.used[node] => return Ok(node),
            Some(_) => "no element of the housing has node",
            None => "the mesh has no node",
        };
        Err(ComputeError::wrong(format!("condense.interface.nodes[{index}]: {missing} {tag}")))
    };
    tags.iter().enumerate().map(found).collect()
}

/// Highest frequency of which a mesh tells something, Hz. A node alone vibrates as in a wave of two to three nodes, the shortest there
/// is; at half of its frequency a wave has four to six, and 5 to 10 % of all modes lie below.
fn highest_hz(matrices: &SystemMatrices) -> f64 {
    let SystemMatrices { stiffness, mass, .. } = matrices;
    let alone = |dof| Some(stiffness.get(dof, dof)? / mass.get(dof, dof).filter(|mass| **mass > 0.0)?);
    let mut squares: Vec<f64> = (0..mass.rows()).filter_map(alone).collect();
    squares.sort_unstable_by(f64::total_cmp);
    let middle = squares.get(squares.len() / 2);
    middle.map_or(f64::INFINITY, |square| 0.5 * square.sqrt() / TAU)
}

/// The basis that a case asks for.
pub(crate) fn basis_choice(case: &Case) -> BasisChoice {
    BasisChoice {
        size: match case.condense.fixed_interface_modes {
            FixedInterfaceModes::Count(count) => BasisSize::Count(count),
            FixedInterfaceModes::UpToHz(hz) => BasisSize::UpTo(hz),
            FixedInterfaceModes::Auto => BasisSize::Auto(case.target()),
        },
        enhanced: case.condense.enhanced,
        band_hz: case.band_or_default()[1],
    }
}

/// Every part of the housing hangs on the interface or on a support: otherwise `K_ii` is singular, and round-off may hide it
/// from a factorisation.
///
/// # Errors
/// [`ComputeError::Input`].
fn check_interior(housing: &AssembledHousing, boundary: &Boundary) -> Result<(), ComputeError> {
    let partition = boundary.partition();
    if partition.tie.cols() == 0 || partition.interior.is_empty() {
        return Ok(()); // refused for this
    }
    let rotation = boundary.rings().and_then(|(_, tie)| tie.rotation());
    let held: Vec<usize> = partition.driven.iter().copied().chain(partition.mean.dofs()).collect();
    match Mechanisms::find_in(&housing.mesh, &housing.model, &Bore::Held(&held, rotation))? {
        Some(found) if found.total() > 0 => Err(ComputeError::input(
            format!(
                "with the interface held, the housing can still move, so that it cannot be condensed: {}",
                found.sentences().join("; ")
            ),
            "join the part (merge its nodes in gmsh, housing.links), hold it (housing.supports), put three of its nodes \
             that are not in line into the interface, or leave it out of housing.parts",
        )),
        _ => Ok(()),
    }
}

/// A reduction that failed at a degree of freedom of the housing, with the part that it belongs to.
fn located(error: ReductionError, model: &HousingModel) -> ComputeError {
    let dof = match error {
        ReductionError::FloatingInterior { dof, .. } | ReductionError::SoftInterior { dof, .. } => dof,
        other => return other.into(),
    };
    let node = dof / model.dimension();
    let mut elements = model.elements().iter();
    let of_node = elements.find(|element| model.elements().nodes(element).contains(&node));
    let part = of_node.and_then(|element| model.description.parts.get(element.part));
    match (part, model.node_tags.get(node)) {
        (Some(part), Some(tag)) => ComputeError::input(
            format!("part \"{}\", near node {tag}: {error}", part.group),
            "check the units of the springs that hold it and its flattest elements (`plummer inspect`); hold it by \
             stiffer springs or a link, or leave it out of housing.parts",
        ),
        _ => error.into(),
    }
}
