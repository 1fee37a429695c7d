//! Small meshes of cubes and squares, and all their modes by a dense solver, for the tests of this module.

use super::over_all_dofs;
use crate::assembly::SystemMatrices;
use crate::element::continuum::PlaneAssumption;
use crate::linalg::{DenseMatrix, sparse_times_dense, submatrix, symmetric_generalised_eigen};
use crate::material::Material;
use crate::mesh::{
    ElementBlock, ElementId, ElementKind, Entity, Mesh, MshFormat, MshVersion, PhysicalGroup,
};
use crate::model::{
    Constraint, HousingDescription, HousingModel, HousingPart, HousingSupport, PlaneModel,
    SupportShare,
};
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
                format: MshFormat {
                    version: MshVersion::V41,
                    binary: false,
                },
                source: PathBuf::from("cells.msh"),
            },
        }
    }

    pub fn node(&mut self, copy: usize, at: [i32; 3]) -> usize {
        let mesh = &mut self.mesh;
        let pitch = self.pitch;
        *self.nodes.entry((copy, at)).or_insert_with(|| {
            mesh.nodes
                .push([0, 1, 2].map(|i| f64::from(at[i]) * pitch[i]));
            mesh.node_tags.push(mesh.nodes.len() as u64);
            mesh.nodes.len() - 1
        })
    }

    fn add(&mut self, group: &str, kind: ElementKind, elements: &[Vec<usize>]) {
        let block = self.mesh.blocks.len();
        let first = 1 + self
            .mesh
            .blocks
            .iter()
            .map(ElementBlock::len)
            .sum::<usize>() as u64;
        let dimension = kind.dimension();
        self.mesh.blocks.push(ElementBlock {
            kind,
            tags: (first..).take(elements.len()).collect(),
            connectivity: elements.concat(),
            entity: Entity {
                dimension,
                tag: block as i32 + 1,
            },
        });
        let ids = (0..elements.len()).map(|index| ElementId { block, index });
        let known = self
            .mesh
            .groups
            .iter()
            .position(|known| known.name == group);
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
    pub fn block(mut self, group: &str, copy: usize, from: [i32; 3], to: [i32; 3]) -> Self {
        const RING: [[i32; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];
        let layers = if self.plane { 0..1 } else { from[2]..to[2] };
        let mut elements = Vec::new();
        for z in layers {
            for y in from[1]..to[1] {
                for x in from[0]..to[0] {
                    let levels = if self.plane { 1 } else { 2 };
                    let corners =
                        (0..levels).flat_map(|up| RING.map(|[i, j]| [x + i, y + j, z + up]));
                    let corners: Vec<[i32; 3]> = corners.collect();
                    elements.push(corners.iter().map(|&at| self.node(copy, at)).collect());
                }
            }
        }
        let kind = if self.plane {
            ElementKind::Quad4
        } else {
            ElementKind::Hex8
        };
        self.add(group, kind, &elements);
        self
    }

    /// A group of points.
    pub fn points(mut self, group: &str, copy: usize, at: &[[i32; 3]]) -> Self {
        let nodes: Vec<Vec<usize>> = at.iter().map(|&at| vec![self.node(copy, at)]).collect();
        self.add(group, ElementKind::Point, &nodes);
        self
    }

    /// A group of quadrilaterals at the height z, or of lines at the height y in the plane.
    pub fn face(mut self, group: &str, copy: usize, from: [i32; 3], to: [i32; 3]) -> Self {
        let mut elements = Vec::new();
        for x in from[0]..to[0] {
            if self.plane {
                let ends = [x, x + 1].map(|x| self.node(copy, [x, from[1], 0]));
                elements.push(ends.to_vec());
                continue;
            }
            for y in from[1]..to[1] {
                let corners = [[x, y], [x + 1, y], [x + 1, y + 1], [x, y + 1]];
                elements.push(
                    corners
                        .map(|[x, y]| self.node(copy, [x, y, from[2]]))
                        .to_vec(),
                );
            }
        }
        let kind = if self.plane {
            ElementKind::Line2
        } else {
            ElementKind::Quad4
        };
        self.add(group, kind, &elements);
        self
    }
}

/// A description with these parts, of steel times `scale` in stiffness.
pub(super) fn description(cells: &Cells, parts: &[&str], scale: f64) -> HousingDescription {
    let material = Material::new(2.1e11 * scale, 0.3, 7800.0).expect("steel");
    let part = |group: &&str| HousingPart {
        group: (*group).to_owned(),
        material: material.into(),
    };
    HousingDescription {
        parts: parts.iter().map(part).collect(),
        plane: cells.plane.then_some(PlaneModel {
            assumption: PlaneAssumption::Stress,
            thickness: 0.01,
        }),
        ..HousingDescription::default()
    }
}

/// A support with a value for each node.
pub(super) fn support(group: &str, constraint: Constraint) -> HousingSupport {
    HousingSupport {
        group: group.to_owned(),
        constraint,
        share: SupportShare::PerNode,
    }
}

/// A model with its matrices and all its modes over all degrees of freedom.
pub(super) struct Solved {
    pub model: HousingModel,
    pub matrices: SystemMatrices,
    pub eigenvalues: Vec<f64>,
    pub shapes: DenseMatrix,
}

pub(super) fn solve(mesh: &Mesh, description: HousingDescription) -> Solved {
    let model = HousingModel::new(mesh, description).expect("a model");
    let matrices = SystemMatrices::assemble(&model).expect("matrices");
    let free = model.free_dofs();
    let dense = |a: &crate::linalg::SparseMatrix| {
        let part = submatrix(a, &free, &free);
        sparse_times_dense(&part, &DenseMatrix::identity(free.len(), free.len()))
    };
    let spectrum = symmetric_generalised_eigen(&dense(&matrices.stiffness), &dense(&matrices.mass))
        .expect("a spectrum");
    Solved {
        shapes: over_all_dofs(&model, &free, &spectrum.vectors).expect("of its order"),
        eigenvalues: spectrum.values,
        model,
        matrices,
    }
}
