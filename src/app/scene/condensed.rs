//! The housing of a case, condensed on the interface that the case asks for.

use super::error::StageError;
use super::free_system::{of_housing, of_ring};
use super::housing::HousingStage;
use super::loose::{check_interior, located};
use super::structure::ring_and_tie;
use super::watch::Watch;
use crate::app::case::{Case, FixedInterfaceModes, Interface};
use crate::fe::assembly::{CoupledMatrices, StructuralStiffness, SystemMatrices};
use crate::fe::modal::{rigid_motions, ring_motions};
use crate::fe::model::{HousingPartition, NodeInterface, Ring, RingTie};
use crate::fe::reduction::{
    Attached, BasisChoice, BasisSize, CraigBampton, RigidMotions, craig_bampton,
};
use crate::formats::DofLabel;
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, transpose_times_dense};
use std::borrow::Cow;
use std::collections::HashMap;

/// Top of the band of a case that names none, Hz: that of the source's figures.
const DEFAULT_BAND_HZ: f64 = 40e3;

/// A condensed housing and what it was condensed from.
#[derive(Debug, Clone)]
pub struct CondensedStage {
    /// The housing.
    pub housing: HousingStage,
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

/// What a housing is attached by.
#[derive(Debug, Clone)]
pub enum Boundary {
    /// A ring through its tie.
    Ring(Box<(Ring, RingTie)>),
    /// Nodes of the mesh themselves.
    Nodes(NodeInterface),
}

impl CondensedStage {
    /// Builds and condenses the housing of a case; `None` without a housing, or if neither a ring is tied to it nor
    /// another interface asked for.
    ///
    /// # Errors
    /// [`StageError`] of mesh, model, ring, tie and reduction.
    pub fn build(case: &Case, watch: &impl Watch) -> Result<Option<Self>, StageError> {
        Self::with_basis(case, basis_choice(case), watch)
    }

    /// The same with another basis than the case asks for.
    ///
    /// # Errors
    /// As [`CondensedStage::build`].
    pub(crate) fn with_basis(
        case: &Case,
        choice: BasisChoice,
        watch: &impl Watch,
    ) -> Result<Option<Self>, StageError> {
        match HousingStage::build(case, watch)? {
            Some(housing) => Self::of(case, housing, choice, watch),
            None => Ok(None),
        }
    }

    fn of(
        case: &Case,
        housing: HousingStage,
        choice: BasisChoice,
        watch: &impl Watch,
    ) -> Result<Option<Self>, StageError> {
        let boundary = match (&case.condense.interface, &case.ring) {
            (Interface::Ring, Some(asked)) => match ring_and_tie(case, asked, Some(&housing))? {
                (ring, Some(tie)) => Boundary::Ring(Box::new((ring, tie))),
                (_, None) => return Ok(None),
            },
            (Interface::Ring, None) => return Ok(None),
            (Interface::Group(group), _) => {
                let group =
                    housing
                        .model
                        .group_on_housing(&housing.mesh, group, "the interface")?;
                let used = |node: &usize| housing.model.is_used(*node);
                let nodes: Vec<usize> = group.nodes.iter().copied().filter(used).collect();
                Boundary::Nodes(NodeInterface::new(&housing.model, &nodes))
            }
            (Interface::Nodes(tags), _) => {
                let nodes = nodes_of(&housing, tags)?;
                Boundary::Nodes(NodeInterface::new(&housing.model, &nodes))
            }
        };
        if let Boundary::Nodes(nodes) = &boundary
            && nodes.coordinates.is_empty()
        {
            return Err(StageError::interface_held(nodes, &housing.model));
        }
        check_interior(&housing, &boundary)?;
        watch.stage("condense");
        let condensed = craig_bampton(
            &boundary.matrices(&housing),
            boundary.partition(),
            choice,
            boundary.attached(),
        )
        .map_err(|error| located(error, &housing.model))?;
        let structural = StructuralStiffness::assemble(&housing.model)?;
        let stage = Self {
            structural: structural.map(|structural| match boundary.ring() {
                Some((_, tie)) => structural.for_tie(tie).matrix().clone(),
                None => structural.matrix().clone(),
            }),
            housing,
            boundary,
            choice,
            condensed,
        };
        Ok(Some(stage.with_structural()))
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
    /// [`StageError::Reduction`].
    pub(crate) fn with_loads(mut self, loads: &DenseMatrix) -> Result<Self, StageError> {
        let weight = self.matrices().weight.clone();
        self.condensed = self.condensed.with_loads(loads, &weight)?;
        Ok(self.with_structural())
    }

    /// The same with the static response to forces on the interior [interior x k] in the basis.
    ///
    /// # Errors
    /// [`StageError::Reduction`].
    pub(crate) fn with_forces(mut self, forces: DenseMatrix) -> Result<Self, StageError> {
        let weight = self.matrices().weight.clone();
        self.condensed = self.condensed.with_forces(forces, &weight)?;
        Ok(self.with_structural())
    }

    /// Labels of the interface coordinates, in the axes that they are measured in.
    pub fn interface_labels(&self) -> Vec<DofLabel> {
        match &self.boundary {
            Boundary::Ring(bodies) => of_ring(&bodies.0, self.housing.model.frame()),
            Boundary::Nodes(_) => {
                let labels = of_housing(&self.housing.model, None);
                let driven = &self.boundary.partition().driven;
                driven.iter().map(|&dof| labels[dof]).collect()
            }
        }
    }

    /// Unit rigid motions about the bore's centre, over the housing and over the interface.
    pub fn rigid_motions(&self) -> RigidMotions {
        let model = &self.housing.model;
        let about = model.frame().centre();
        let motions = rigid_motions(model.coordinates(), model.dimension(), about);
        match &self.boundary {
            Boundary::Ring(bodies) => RigidMotions {
                interface: ring_motions(&bodies.0, model.frame(), about),
                housing: match bodies.1.rotation() {
                    Some(rotation) => transpose_times_dense(rotation, &motions),
                    None => motions,
                },
            },
            Boundary::Nodes(nodes) => {
                let driven = &nodes.partition.driven;
                RigidMotions {
                    interface: DenseMatrix::from_fn(
                        driven.len(),
                        motions.ncols(),
                        |row, motion| motions[(driven[row], motion)],
                    ),
                    housing: motions,
                }
            }
        }
    }

    /// Matrices of the housing in the displacements that the partition uses.
    pub fn matrices(&self) -> Cow<'_, SystemMatrices> {
        self.boundary.matrices(&self.housing)
    }

    /// Matrices of the whole, nothing condensed.
    pub fn full_matrices(&self) -> CoupledMatrices {
        let HousingStage {
            model, matrices, ..
        } = &self.housing;
        match self.boundary.ring() {
            Some((ring, tie)) => CoupledMatrices::new(matrices, tie, ring),
            None => CoupledMatrices::of_housing(matrices.clone(), model),
        }
    }
}

impl Boundary {
    /// How the housing's degrees of freedom are split.
    pub fn partition(&self) -> &HousingPartition {
        match self {
            Self::Ring(bodies) => bodies.1.partition(),
            Self::Nodes(nodes) => &nodes.partition,
        }
    }

    fn matrices<'h>(&self, housing: &'h HousingStage) -> Cow<'h, SystemMatrices> {
        match self.ring() {
            Some((_, tie)) if tie.rotation().is_some() => {
                Cow::Owned(housing.matrices.clone().for_tie(tie))
            }
            _ => Cow::Borrowed(&housing.matrices),
        }
    }

    /// What sits on the interface.
    pub fn attached(&self) -> Option<Attached<'_>> {
        match self {
            Self::Ring(bodies) => Some(Attached {
                stiffness: bodies.0.stiffness(),
                mass: bodies.0.mass(),
            }),
            Self::Nodes(_) => None,
        }
    }

    /// Ring and tie, if that is what it is.
    pub fn ring(&self) -> Option<(&Ring, &RingTie)> {
        match self {
            Self::Ring(bodies) => Some((&bodies.0, &bodies.1)),
            Self::Nodes(_) => None,
        }
    }
}

/// Indices of the nodes with these tags.
fn nodes_of(housing: &HousingStage, tags: &[u64]) -> Result<Vec<usize>, StageError> {
    let model = &housing.model;
    let place: HashMap<u64, usize> = model
        .node_tags
        .iter()
        .enumerate()
        .map(|(index, &tag)| (tag, index))
        .collect();
    let found = |(index, tag): (usize, &u64)| match place.get(tag) {
        Some(&node) if model.is_used(node) => Ok(node),
        other => Err(StageError::InterfaceNode {
            index,
            tag: *tag,
            in_mesh: other.is_some(),
        }),
    };
    tags.iter().enumerate().map(found).collect()
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
        band_hz: case.band_hz().map_or(DEFAULT_BAND_HZ, |band| band[1]),
    }
}
