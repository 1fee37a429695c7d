//! Stiffness and mass of a housing, its weight, its mass, and its structural damping: the stiffness of its parts weighted by
//! their loss factors.

use super::batch::in_batches;
use super::pattern::{BlockMatrix, Coupling, Local, NodeGraph};
use crate::fe::element::continuum::{nodal_mass_into, stiffness_into};
use crate::fe::model::{HousingModel, ModelError, NodalMatrix, RingTie};
use crate::numerics::linalg::{DenseMatrix, SparseMatrix, congruence, sparse_times_dense, transpose_times_dense};

/// Matrices of a housing over all its degrees of freedom.
///
/// Rows and columns of nodes that a link ties are empty: such a node's share is with those that it follows.
#[derive(Debug, Clone)]
pub struct SystemMatrices {
    /// Stiffness with springs [dof x dof], N/m.
    pub stiffness: SparseMatrix,
    /// Consistent mass with point masses [dof x dof], kg.
    pub mass: SparseMatrix,
    /// Mass times unit accelerations along the bearing's x and y [dof x 2], kg.
    pub weight: DenseMatrix,
    pub(crate) total_mass: f64,
}

impl SystemMatrices {
    /// Assembles a housing.
    ///
    /// # Errors
    /// [`ModelError::Refused`] with the tag of an element that is inverted or degenerate.
    pub fn assemble(model: &HousingModel) -> Result<Self, ModelError> {
        let graph = node_graph(model);
        let mut k = stiffness(model, &graph, None)?;
        k.add(&locals(&model.springs));
        let (mut stiffness, mut mass) = (k.into_matrix(), mass(model, &graph)?);
        if let Some(tie) = model.tie_matrix() {
            stiffness = congruence(&stiffness, &tie);
            mass = congruence(&mass, &tie);
        }
        let d = model.dimension;
        let falls = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|v| model.frame().vector_to_mesh(v));
        let fall = DenseMatrix::from_fn(model.dof(), 2, |dof, column| falls[column][dof % d]);
        let weight = sparse_times_dense(&mass, &fall);
        // `a^T M a` of a unit acceleration a; tied nodes have empty rows and columns, so their mass counts once, where it was taken
        let total_mass = (0..model.dof()).map(|dof| fall[(dof, 0)] * weight[(dof, 0)]).sum();
        Ok(Self { stiffness, mass, weight, total_mass })
    }

    /// Mass of the housing with its point masses, kg.
    pub fn total_mass(&self) -> f64 {
        self.total_mass
    }

    /// The same matrices in the displacements that a tie's partition uses.
    pub fn for_tie(self, tie: &RingTie) -> Self {
        match tie.rotation() {
            None => self,
            Some(rotation) => Self {
                stiffness: congruence(&self.stiffness, rotation),
                mass: congruence(&self.mass, rotation),
                weight: transpose_times_dense(rotation, &self.weight),
                ..self
            },
        }
    }
}

/// `K_s = sum_e eta_e K_e` over the elements e: with it the stiffness under harmonic motion is `K + i K_s`. Springs lose
/// nothing. It has the pattern of the stiffness, and is assembled where a response asks for it, apart from
/// [`SystemMatrices`]: nothing else needs it.
#[derive(Debug, Clone)]
pub struct StructuralStiffness {
    matrix: SparseMatrix,
}

impl StructuralStiffness {
    /// Assembles a housing's; `None` if every loss factor is zero, which costs nothing.
    ///
    /// # Errors
    /// [`ModelError::Refused`] with the tag of an element that is inverted or degenerate.
    pub fn assemble(model: &HousingModel) -> Result<Option<Self>, ModelError> {
        let parts = model.description.parts.iter();
        let loss_factors: Vec<f64> = parts.map(|part| part.material.loss_factor()).collect();
        if loss_factors.iter().all(|&factor| factor == 0.0) {
            return Ok(None);
        }
        let graph = node_graph(model);
        let matrix = stiffness(model, &graph, Some(&loss_factors))?.into_matrix();
        let matrix = match model.tie_matrix() {
            Some(tie) => congruence(&matrix, &tie),
            None => matrix,
        };
        Ok(Some(Self { matrix }))
    }

    /// The same in the displacements that a tie's partition uses.
    pub fn for_tie(self, tie: &RingTie) -> Self {
        match tie.rotation() {
            None => self,
            Some(rotation) => Self { matrix: congruence(&self.matrix, rotation) },
        }
    }

    /// K_s [dof x dof], N/m; the degrees of freedom are those of the stiffness.
    pub fn matrix(&self) -> &SparseMatrix {
        &self.matrix
    }
}

/// Which nodes an element, a spring or a point mass couples.
fn node_graph(model: &HousingModel) -> NodeGraph {
    let elements = model.elements.iter().map(|element| model.elements.nodes(element));
    let extra = model.springs.iter().chain(&model.masses);
    let groups = elements.chain(extra.map(|extra| extra.nodes.as_slice()));
    NodeGraph::new(model.coordinates.len(), &groups.collect::<Vec<_>>())
}

/// `sum_e f_e K_e` over the elements e, f by part; without factors the plain sum.
fn stiffness<'g>(
    model: &HousingModel,
    graph: &'g NodeGraph,
    factors: Option<&[f64]>,
) -> Result<BlockMatrix<'g>, ModelError> {
    let mut k = BlockMatrix::zeros(graph, model.dimension, Coupling::Full);
    in_batches(
        model,
        |kind| kind.dof() * kind.dof(),
        |element, coordinates, out| {
            let factor = factors.map(|factors| factors[element.part]);
            if factor == Some(0.0) {
                out.fill(0.0);
                return Ok(());
            }
            stiffness_into(
                element.kind,
                coordinates,
                &model.properties[element.part],
                model.description.formulation,
                out,
            )?;
            if let Some(factor) = factor {
                out.iter_mut().for_each(|entry| *entry *= factor);
            }
            Ok(())
        },
        |locals| k.add(locals),
    )?;
    Ok(k)
}

fn mass(model: &HousingModel, graph: &NodeGraph) -> Result<SparseMatrix, ModelError> {
    let mut m = BlockMatrix::zeros(graph, model.dimension, Coupling::Same);
    in_batches(
        model,
        |kind| kind.nodes() * kind.nodes(),
        |element, coordinates, out| nodal_mass_into(element.kind, coordinates, &model.properties[element.part], out),
        |locals| m.add(locals),
    )?;
    m.add(&locals(&model.masses));
    Ok(m.into_matrix())
}

fn locals(matrices: &[NodalMatrix]) -> Vec<Local<'_>> {
    matrices.iter().map(|NodalMatrix { nodes, matrix, .. }| Local { nodes, matrix: matrix.as_slice() }).collect()
}
