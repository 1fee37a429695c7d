//! Small meshes of cubes and squares, and all their modes by a dense solver, for the tests of this module.

use super::{ModalBasis, ModeRange, over_all_dofs, strain_products};
use crate::fe::assembly::{CoupledMatrices, SystemMatrices};
use crate::fe::element::continuum::PlaneAssumption;
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::{BeamSection, Bond, Material, RingLayer};
use crate::fe::mesh::{
    ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
};
use crate::fe::model::{
    Constraint, Fit, HousingDescription, HousingModel, HousingPart, HousingSupport, PlaneModel, Ring, RingFrame,
    RingTie, Rings, SupportShare,
};
use crate::numerics::linalg::{DenseMatrix, EigenProblem, scattered_rows};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// Hex8 or Quad4 cells on a lattice. Cells of one copy share the nodes of the lattice, those of different copies
/// none, even where they touch.
pub(super) struct Cells {
    pitch: [f64; 3],
    plane: bool,
    nodes: BTreeMap<(usize, [i32; 3]), usize>,
    pub mesh: Mesh,
}

impl Cells {
    pub fn new(dimension: usize, pitch: [f64; 3]) -> Self {
        Self {
            pitch,
            plane: dimension == 2,
            nodes: BTreeMap::new(),
            mesh: Mesh {
                nodes: Vec::new(),
                node_tags: Vec::new(),
                blocks: Vec::new(),
                groups: Vec::new(),
                format: MshFormat { version: MshVersion::V41, binary: false },
                notes: MeshNotes::default(),
                source: PathBuf::from("cells.msh"),
            },
        }
    }

    pub(crate) fn node(&mut self, copy: usize, at: [i32; 3]) -> usize {
        let mesh = &mut self.mesh;
        let pitch = self.pitch;
        *self.nodes.entry((copy, at)).or_insert_with(|| {
            mesh.nodes.push([0, 1, 2].map(|i| f64::from(at[i]) * pitch[i]));
            mesh.node_tags.push(mesh.nodes.len() as u64);
            mesh.nodes.len() - 1
        })
    }

    fn add(&mut self, group: &str, kind: ElementKind, elements: &[Vec<usize>]) {
        let block = self.mesh.blocks.len();
        let first = 1 + self.mesh.blocks.iter().map(ElementBlock::len).sum::<usize>() as u64;
        let dimension = kind.dimension();
        self.mesh.blocks.push(ElementBlock {
            kind,
            tags: (first..).take(elements.len()).collect(),
            connectivity: elements.concat(),
            entity: Entity { dimension, tag: block as i32 + 1 },
        });
        let ids = (0..elements.len()).map(|index| ElementId { block, index });
        let known = self.mesh.groups.iter().position(|known| known.name == group);
        let place = known.unwrap_or_else(|| {
            self.mesh.groups.push(PhysicalGroup {
                name: group.to_owned(),
                dimension,
                tag: block as i32 + 1,
                nodes: Vec::new(),
                elements: Vec::new(),
            });
            self.mesh.groups.len() - 1
        });
        let group = &mut self.mesh.groups[place];
        group.elements.extend(ids);
        group.nodes.extend(elements.concat());
        group.nodes.sort_unstable();
        group.nodes.dedup();
    }

    /// Cells from one corner to the other; in the plane z does not count.
    pub(crate) fn block(mut self, group: &str, copy: usize, from: [i32; 3], to: [i32; 3]) -> Self {
        const RING: [[i32; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let layers = if self.plane { 0..1 } else { from[2]..to[2] };
        let mut elements = Vec::new();
        for z in layers {
            for y in from[1]..to[1] {
                for x in from[0]..to[0] {
                    let levels = if self.plane { 1 } else { 2 };
                    let corners = (0..levels).flat_map(|up| RING.map(|[i, j]| [x + i, y + j, z + up]));
                    let corners: Vec<[i32; 3]> = corners.collect();
                    elements.push(corners.iter().map(|&at| self.node(copy, at)).collect());
                }
            }
        }
        let kind = if self.plane { ElementKind::Quad4 } else { ElementKind::Hex8 };
        self.add(group, kind, &elements);
        self
    }

    /// A group of points.
    pub(crate) fn points(mut self, group: &str, copy: usize, at: &[[i32; 3]]) -> Self {
        let nodes: Vec<Vec<usize>> = at.iter().map(|&at| vec![self.node(copy, at)]).collect();
        self.add(group, ElementKind::Point, &nodes);
        self
    }

    /// A group of quadrilaterals at the height z, or of lines at the height y in the plane.
    pub(crate) fn face(mut self, group: &str, copy: usize, from: [i32; 3], to: [i32; 3]) -> Self {
        let mut elements = Vec::new();
        for x in from[0]..to[0] {
            if self.plane {
                let ends = [x, x + 1].map(|x| self.node(copy, [x, from[1], 0]));
                elements.push(ends.to_vec());
                continue;
            }
            for y in from[1]..to[1] {
                let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
                elements.push(corners.map(|[x, y]| self.node(copy, [x, y, from[2]])).to_vec());
            }
        }
        let kind = if self.plane { ElementKind::Line2 } else { ElementKind::Quad4 };
        self.add(group, kind, &elements);
        self
    }
}

/// A description with these parts, of steel times `scale` in stiffness.
pub(super) fn description(cells: &Cells, parts: &[&str], scale: f64) -> HousingDescription {
    let material = Material::new(2.1e11 * scale, 0.3, 7800.0).expect("steel");
    let part = |group: &&str| HousingPart { group: (*group).to_owned(), material: material.into() };
    HousingDescription {
        parts: parts.iter().map(part).collect(),
        plane: cells.plane.then_some(PlaneModel { assumption: PlaneAssumption::Stress, thickness: 0.01 }),
        ..HousingDescription::default()
    }
}

/// A support with a value for each node.
pub(super) fn support(group: &str, constraint: Constraint) -> HousingSupport {
    HousingSupport { group: group.to_owned(), constraint, share: SupportShare::PerNode }
}

/// A model with its matrices and all its modes over all degrees of freedom.
pub(super) struct Solved {
    pub model: HousingModel,
    pub matrices: SystemMatrices,
    pub eigenvalues: Vec<f64>,
    pub shapes: DenseMatrix,
    pub rigid_modes: usize,
}

pub(super) fn solve(mesh: &Mesh, description: HousingDescription) -> Solved {
    let model = HousingModel::new(mesh, description).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    let free = model.free_dofs();
    let basis = sharp_modes(&model, &matrices, free.len());
    Solved {
        shapes: over_all_dofs(&model, &free, &basis.shapes).expect("of its order"),
        rigid_modes: basis.rigid_modes,
        eigenvalues: basis.eigenvalues,
        model,
        matrices,
    }
}

/// The lowest modes over the free degrees of freedom, those near zero by the energies of elements.
pub(super) fn sharp_modes(model: &HousingModel, matrices: &SystemMatrices, count: usize) -> ModalBasis {
    let free = model.free_dofs();
    let problem = EigenProblem::restricted(&matrices.stiffness, &matrices.mass, &free);
    let problem = problem.expect("an order");
    let mut basis = ModalBasis::of(&problem, ModeRange::Count(count)).expect("converges");
    basis.sharpen(|shapes| strain_products(model, &over_all_dofs(model, &free, shapes)?)).expect("of its order");
    basis
}

/// A housing with a ring in it, and its lowest modes, nothing condensed.
pub(super) struct Ringed {
    pub model: HousingModel,
    pub matrices: SystemMatrices,
    pub tie: RingTie,
    pub rings: Rings,
    pub basis: ModalBasis,
    /// Shapes of the housing, tied nodes filled in [dof x count].
    pub housing: DenseMatrix,
    /// Shapes of the ring [ring dof x count].
    pub of_ring: DenseMatrix,
}

/// A block of 2 x 2 (x 2) cells of 0.1 m about the origin of its frame; its corners are the bore, 0.1414 m away.
pub(super) fn block_round_a_ring(dimension: usize) -> (Cells, RingFrame) {
    let levels: &[i32] = if dimension == 2 { &[0] } else { &[0, 2] };
    let corners = levels.iter().flat_map(|&z| [[0, 0, z], [2, 0, z], [2, 2, z], [0, 2, z]]);
    let cells = Cells::new(dimension, [0.1; 3]).block("body", 0, [0; 3], [2, 2, 2]).points(
        "bore",
        0,
        &corners.collect::<Vec<_>>(),
    );
    let frame = RingFrame::new([0.1, 0.1, 0.0], [0.0, 0.0, 1.0], [1.0, 0.5, 0.0]);
    (cells, frame.expect("two axes"))
}

/// A steel ring that fits into it.
pub(super) fn ring_for_block(dimension: usize) -> Ring {
    let layer = RingLayer {
        material: Material::new(2.06e11, 0.3, 7850.0).expect("steel"),
        area: 1e-4,
        inertia: 8e-10,
        axial_inertia: Some(9e-10),
        torsion: Some(1.4e-9),
        radius: 0.135,
        shear_coefficient: 5.0 / 6.0,
    };
    let section = BeamSection::combine(&[layer], Bond::Composite).expect("a section");
    let ring = match dimension {
        2 => Ring::new(24, section, RingInterpolation::ExactArc),
        _ => Ring::in_space(24, section, RingInterpolation::ExactArc),
    };
    ring.expect("24 nodes")
}

pub(super) fn ringed(mesh: &Mesh, description: HousingDescription, ring: Ring, fit: Fit, count: usize) -> Ringed {
    let model = HousingModel::new(mesh, description).expect("a model");
    let radius = 0.1 * 2.0_f64.sqrt();
    let tie = RingTie::new(mesh, &model, "bore", &ring, radius, fit).expect("at the ring");
    let rings = Rings::one(ring.clone(), *model.frame());
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    let CoupledMatrices { stiffness, mass, free_dofs, motions, .. } = CoupledMatrices::new(&matrices, &tie, &rings);
    let problem = EigenProblem::restricted(&stiffness, &mass, &free_dofs).expect("an order");
    let mut basis = ModalBasis::of(&problem, ModeRange::Count(count)).expect("converges");
    let over_all = |shapes: &DenseMatrix| scattered_rows(shapes, &free_dofs, mass.rows());
    let products = |shapes: &DenseMatrix| {
        let all = over_all(shapes);
        let strain = ring.strain_products(&motions.rings(&all));
        let housing = strain_products(&model, &motions.housing(&model, &all))?;
        Ok::<_, super::ModalError>(housing + strain.beams + strain.springs)
    };
    basis.sharpen(products).expect("of its order");
    let all = over_all(&basis.shapes);
    Ringed { housing: motions.housing(&model, &all), of_ring: motions.rings(&all), model, matrices, tie, rings, basis }
}
