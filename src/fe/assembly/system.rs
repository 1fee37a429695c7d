//! Stiffness and mass of a housing, its weight, its mass, and its structural damping: the stiffness of its parts weighted by
//! their loss factors.
//!
//! Element matrices in parallel, a batch at a time.

use super::pattern::{BlockMatrix, Columns, Coupling, Local, NodeGraph};
use crate::fe::element::ElementError;
use crate::fe::element::continuum::{mass_into, nodal_mass_into, stiffness_into};
use crate::fe::mesh::ElementKind;
use crate::fe::model::{HousingElement, HousingModel, ModelError, NodalMatrix, RingTie};
use crate::numerics::linalg::{
    DenseMatrix, Ordering, SparseMatrix, congruence, sparse_times_dense, transpose_times_dense,
};
use rayon::prelude::*;

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
    /// Order in which the free degrees of freedom are factorised, if it is known.
    pub(crate) ordering: Option<Ordering>,
}

impl SystemMatrices {
    /// Assembles a housing.
    ///
    /// # Errors
    /// [`ModelError::Refused`] with the tag of an element that is inverted or degenerate.
    pub fn assemble(model: &HousingModel) -> Result<Self, ModelError> {
        Self::with_order(model, |_| None)
    }

    /// Assembles a housing, and finds the order of its free degrees of freedom meanwhile.
    ///
    /// # Errors
    /// As [`SystemMatrices::assemble`].
    pub(crate) fn assemble_and_order(model: &HousingModel) -> Result<Self, ModelError> {
        // who factorises finds out again why there is none
        Self::with_order(model, |columns| Ordering::of_part(columns.pattern(), &model.free_dofs()).ok())
    }

    fn with_order(
        model: &HousingModel,
        order: impl FnOnce(&Columns) -> Option<Ordering> + Send,
    ) -> Result<Self, ModelError> {
        let graph = node_graph(model);
        let columns = Columns::new(&graph, model.dimension, Coupling::Full);
        let both = || -> Result<_, ModelError> {
            let mut k = stiffness(model, &graph, None)?;
            k.add(&locals(&model.springs));
            Ok((k, mass(model, &graph)?))
        };
        let tie = model.tie_matrix();
        // a tie changes the pattern
        let untied = tie.is_none();
        let (both, ordering) = rayon::join(both, || if untied { order(&columns) } else { None });
        let (stiffness, mut mass) = both?;
        let mut stiffness = stiffness.into_matrix(columns);
        if let Some(tie) = tie {
            stiffness = congruence(&stiffness, &tie);
            mass = congruence(&mass, &tie);
        }
        let d = model.dimension;
        let falls = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|v| model.frame().vector_to_mesh(v));
        let fall = DenseMatrix::from_fn(model.dof(), 2, |dof, column| falls[column][dof % d]);
        let weight = sparse_times_dense(&mass, &fall);
        // `a^T M a` of a unit acceleration a; tied nodes have empty rows and columns, so their mass counts once, where it was taken
        let total_mass = (0..model.dof()).map(|dof| fall[(dof, 0)] * weight[(dof, 0)]).sum();
        Ok(Self { stiffness, mass, weight, total_mass, ordering })
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
                total_mass: self.total_mass,
                ordering: None,
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
        let columns = Columns::new(&graph, model.dimension, Coupling::Full);
        let matrix = stiffness(model, &graph, Some(&loss_factors))?.into_matrix(columns);
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
    let formulation = model.description.formulation;
    let bubbles = |element: &HousingElement| formulation.bubbles(element.kind);
    let coupling = if model.elements.iter().any(bubbles) { Coupling::Full } else { Coupling::Same };
    let mut m = BlockMatrix::zeros(graph, model.dimension, coupling);
    in_batches(
        model,
        |kind| if formulation.bubbles(kind) { kind.dof().pow(2) } else { kind.nodes().pow(2) },
        |element, coordinates, out| {
            let (kind, properties) = (element.kind, &model.properties[element.part]);
            if formulation.bubbles(kind) {
                mass_into(kind, coordinates, properties, formulation, element.across_plate, out)
            } else {
                nodal_mass_into(kind, coordinates, properties, out)
            }
        },
        |locals| m.add(locals),
    )?;
    m.add(&locals(&model.masses));
    Ok(m.into_matrix(Columns::new(graph, model.dimension, coupling)))
}

fn locals(matrices: &[NodalMatrix]) -> Vec<Local<'_>> {
    matrices.iter().map(|NodalMatrix { nodes, matrix, .. }| Local { nodes, matrix: matrix.as_slice() }).collect()
}

/// Matrix entries of a batch, 8 MB: small beside the matrices of a mesh, large beside the cost of starting
/// threads.
const BATCH: usize = 1 << 20;

/// Computes a matrix of `entries(kind)` entries for each element in parallel and hands them on in an order that depends on the mesh
/// alone.
///
/// # Errors
/// [`ModelError::Refused`] for the first element of the mesh for which `compute` fails.
pub(super) fn in_batches(
    model: &HousingModel,
    entries: impl Fn(ElementKind) -> usize,
    compute: impl Fn(&HousingElement, &[[f64; 3]], &mut [f64]) -> Result<(), ElementError> + Sync,
    mut consume: impl FnMut(&[Local<'_>]),
) -> Result<(), ModelError> {
    let one = |element: &HousingElement, out: &mut [f64]| {
        let mut coordinates = [[0.0; 3]; crate::fe::element::continuum::MAX_NODES];
        let nodes = model.elements.nodes(element);
        for (to, &node) in coordinates.iter_mut().zip(nodes) {
            *to = model.coordinates[node];
        }
        compute(element, &coordinates[..nodes.len()], out).map_err(|source| (element.tag, source))
    };
    let mut buffer = Vec::new();
    let in_order = neighbours_in_turn(model);
    let mut rest = in_order.as_slice();
    while !rest.is_empty() {
        let mut total = 0;
        let fits = |element: &&&HousingElement| {
            total += entries(element.kind);
            total <= BATCH
        };
        // at least one element, however large
        let count = rest.iter().take_while(fits).count().max(1);
        let (batch, others) = rest.split_at(count);
        rest = others;
        buffer.resize(batch.iter().map(|element| entries(element.kind)).sum(), 0.0);
        let mut work = Vec::with_capacity(batch.len());
        let mut free = buffer.as_mut_slice();
        for element in batch {
            let (own, after) = free.split_at_mut(entries(element.kind));
            work.push((element, own));
            free = after;
        }
        if work.par_iter_mut().any(|(element, out)| one(element, out).is_err()) {
            let mut failures = model.elements.iter().filter_map(|element| {
                let mut out = vec![0.0; entries(element.kind)];
                one(element, &mut out).err()
            });
            if let Some((tag, source)) = failures.next() {
                return Err(ModelError::element(&model.path, tag, &source));
            }
        }
        let locals: Vec<Local<'_>> =
            work.iter().map(|(element, out)| Local { nodes: model.elements.nodes(element), matrix: out }).collect();
        consume(&locals);
    }
    Ok(())
}

/// The elements of a housing one beside the other in space: those of a batch then add to columns that are few, and stay in the
/// cache. The order is that of Morton's curve through their first nodes, on a grid of 1024 cells along each axis.
fn neighbours_in_turn(model: &HousingModel) -> Vec<&HousingElement> {
    let first = |element: &HousingElement| model.coordinates[model.elements.nodes(element)[0]];
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for point in model.elements.iter().map(first) {
        for axis in 0..3 {
            ends[0][axis] = ends[0][axis].min(point[axis]);
            ends[1][axis] = ends[1][axis].max(point[axis]);
        }
    }
    let cell = |element: &&HousingElement| {
        let point = first(element);
        // a span of zero gives NaN, which is cell 0
        let along = |axis: usize| (1023.0 * (point[axis] - ends[0][axis]) / (ends[1][axis] - ends[0][axis])) as u32;
        (0..3).map(|axis| spread(along(axis)) << axis).sum::<u32>()
    };
    let mut elements: Vec<&HousingElement> = model.elements.iter().collect();
    elements.sort_by_cached_key(cell);
    elements
}

/// Ten bits, each two places behind the one before.
fn spread(bits: u32) -> u32 {
    (0..10).map(|bit| (bits >> bit & 1) << (3 * bit)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fe::material::Material;
    use crate::fe::mesh::Mesh;
    use crate::fe::model::{
        Connection, Constraint, HousingDescription, HousingPart, HousingSupport, Link, SupportShare,
    };
    use crate::numerics::linalg::Pattern;
    use crate::numerics::units::LengthUnit;
    use std::path::Path;

    fn model(file: &str, parts: &[&str], feet: &str, links: Vec<Link>) -> HousingModel {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(file);
        let mesh = Mesh::read_gmsh(&path, LengthUnit::Millimetre).expect("a mesh");
        let material = Material::new(70e9, 0.33, 2700.0).expect("aluminium");
        let part = |group: &&str| HousingPart { group: (*group).to_owned(), material: material.into() };
        let support = HousingSupport {
            group: feet.to_owned(),
            constraint: Constraint::Fixed([true, true, false]),
            share: SupportShare::PerNode,
        };
        let parts = parts.iter().map(part).collect();
        let description = HousingDescription { parts, supports: vec![support], links, ..HousingDescription::default() };
        HousingModel::new(&mesh, description).expect("a model")
    }

    /// The order that is found before there is a value is that of the stiffness, on any number of threads.
    #[test]
    fn the_order_found_meanwhile_is_that_of_the_matrix() {
        let held = model("pedestal_10k.msh", &["housing"], "feet", Vec::new());
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
            let found = pool.install(|| SystemMatrices::assemble_and_order(&held)).expect("matrices");
            let expected = Ordering::of_part(Pattern::of(&found.stiffness), &held.free_dofs()).expect("an order");
            assert_eq!(found.ordering, Some(expected), "{threads}");
        }
    }

    /// A tie gives the followed nodes the neighbours of those that follow: the graph of the elements is not the matrix's.
    #[test]
    fn a_tied_housing_is_ordered_by_its_matrix() {
        let link = Link { between: ["foot", "seat"].map(str::to_owned), connection: Connection::Tie };
        let tied = model("two_blocks.msh", &["lower", "upper"], "base", vec![link]);
        assert_eq!(SystemMatrices::assemble_and_order(&tied).expect("matrices").ordering, None);
    }
}
