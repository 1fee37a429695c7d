//! A plane housing: mesh, materials, supports, degrees of freedom. Node n has the displacements
//! 2n (x) and 2n + 1 (y).

use super::ModelError;
use super::spread::shares;
use super::support::{Constraint, HousingSupport, PointMass, SupportShare};
use crate::element::plane::{PlaneKind, PlaneProperties};
use crate::mesh::{ElementKind, Mesh, PhysicalGroup};

/// Properties of the elements of one group.
#[derive(Debug, Clone, PartialEq)]
pub struct PartProperties {
    /// The group.
    pub group: String,
    /// Material, plane assumption, thickness.
    pub properties: PlaneProperties,
}

/// One element, ready for its matrices.
#[derive(Debug, Clone, PartialEq)]
pub struct PlaneElement {
    /// gmsh's tag, for messages.
    pub tag: u64,
    /// Its kind.
    pub kind: PlaneKind,
    /// Node indices.
    pub nodes: Vec<usize>,
    /// Index into the model's parts.
    pub part: usize,
}

/// Spring to the ground at one node: `f = -matrix u`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NodeSpring {
    pub node: usize,
    pub matrix: [[f64; 2]; 2],
}

/// A housing with everything that its matrices need. Coordinates are taken from the ring's centre.
#[derive(Debug, Clone)]
pub struct HousingModel {
    /// Coordinates of all mesh nodes from the ring's centre, m.
    pub(crate) coordinates: Vec<[f64; 2]>,
    pub(crate) elements: Vec<PlaneElement>,
    pub(crate) parts: Vec<PartProperties>,
    pub(crate) springs: Vec<NodeSpring>,
    pub(crate) masses: Vec<(usize, f64)>,
    /// Fixed components, with the index of the support that fixes them.
    pub(crate) fixed: Vec<[Option<usize>; 2]>,
    /// Nodes that an element uses; the others have no degrees of freedom.
    pub(crate) used: Vec<bool>,
    pub(crate) supports: Vec<HousingSupport>,
    /// The mesh file, for messages.
    pub(crate) path: String,
    pub(crate) node_tags: Vec<u64>,
}

impl HousingModel {
    /// Builds the model of a plane mesh; `centre` is the ring's, in the mesh's own axes, m.
    ///
    /// # Errors
    /// [`ModelError`] for groups that are missing or of the wrong kind, elements in no part or in
    /// two, a mesh that is not plane, and supports or masses that would hang on nothing.
    pub fn new(
        mesh: &Mesh,
        parts: Vec<PartProperties>,
        supports: Vec<HousingSupport>,
        masses: &[PointMass],
        centre: [f64; 2],
    ) -> Result<Self, ModelError> {
        let path = mesh.source.display().to_string();
        check_plane(mesh, &path)?;
        let elements = assign_parts(mesh, &parts, &path)?;
        let mut used = vec![false; mesh.nodes.len()];
        for element in &elements {
            for &node in &element.nodes {
                used[node] = true;
            }
        }
        let coordinates = mesh
            .nodes
            .iter()
            .map(|node| [node[0] - centre[0], node[1] - centre[1]])
            .collect();
        let mut model = Self {
            coordinates,
            elements,
            parts,
            springs: Vec::new(),
            masses: Vec::new(),
            fixed: vec![[None; 2]; mesh.nodes.len()],
            used,
            supports,
            path,
            node_tags: mesh.node_tags.clone(),
        };
        for index in 0..model.supports.len() {
            model.attach_support(mesh, index)?;
        }
        for mass in masses {
            let group = model.group_on_housing(mesh, &mass.group, "the mass")?;
            for (node, share) in shares(mesh, group, &model.used)? {
                model.masses.push((node, share * mass.mass));
            }
        }
        Ok(model)
    }

    /// Number of degrees of freedom, those of unused nodes included (they stay out of every
    /// partition).
    pub fn dof(&self) -> usize {
        2 * self.coordinates.len()
    }

    /// Coordinates of a node from the ring's centre, m.
    pub fn coordinates(&self) -> &[[f64; 2]] {
        &self.coordinates
    }

    /// The elements.
    pub fn elements(&self) -> &[PlaneElement] {
        &self.elements
    }

    /// Whether an element uses a node.
    pub fn is_used(&self, node: usize) -> bool {
        self.used[node]
    }

    /// Nodes with a spring to the ground.
    pub fn spring_nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.springs.iter().map(|spring| spring.node)
    }

    /// Degrees of freedom that are neither fixed nor without an element.
    pub fn free_dofs(&self) -> Vec<usize> {
        (0..self.dof())
            .filter(|&dof| self.used[dof / 2] && self.fixed[dof / 2][dof % 2].is_none())
            .collect()
    }

    /// A group of which at least one node is on the housing.
    ///
    /// # Errors
    /// [`ModelError::Mesh`], [`ModelError::NotOnHousing`].
    pub fn group_on_housing<'m>(
        &self,
        mesh: &'m Mesh,
        name: &str,
        purpose: &'static str,
    ) -> Result<&'m PhysicalGroup, ModelError> {
        let group = mesh.group(name)?;
        if group.nodes.iter().any(|&node| self.used[node]) {
            Ok(group)
        } else {
            Err(ModelError::NotOnHousing {
                path: self.path.clone(),
                group: name.to_owned(),
                purpose,
            })
        }
    }

    fn attach_support(&mut self, mesh: &Mesh, index: usize) -> Result<(), ModelError> {
        let support = self.supports[index].clone();
        let group = self.group_on_housing(mesh, &support.group, "the support")?;
        let carried = match support.share {
            SupportShare::PerNode => group.nodes.iter().map(|&node| (node, 1.0)).collect(),
            SupportShare::PerGroup => shares(mesh, group, &self.used)?,
        };
        for (node, share) in carried.into_iter().filter(|&(node, _)| self.used[node]) {
            let matrix = match support.constraint {
                Constraint::Fixed(components) => {
                    for (slot, fixed) in self.fixed[node].iter_mut().zip(components) {
                        if fixed {
                            *slot = Some(index);
                        }
                    }
                    continue;
                }
                Constraint::Spring([x, y]) => [[share * x, 0.0], [0.0, share * y]],
                Constraint::Radial(stiffness) => {
                    let [x, y] = self.coordinates[node];
                    let scale = share * stiffness / (x * x + y * y).max(f64::MIN_POSITIVE);
                    [
                        [scale * x * x, scale * x * y],
                        [scale * x * y, scale * y * y],
                    ]
                }
            };
            self.springs.push(NodeSpring { node, matrix });
        }
        Ok(())
    }
}

fn check_plane(mesh: &Mesh, path: &str) -> Result<(), ModelError> {
    let first = mesh.nodes.first().map_or(0.0, |node| node[2]);
    let size = mesh.nodes.iter().fold(0.0_f64, |size, node| {
        size.max(node[0].abs()).max(node[1].abs())
    });
    // gmsh writes 16 digits: what is off by more is meant
    let tolerance = 1e-9 * size;
    match mesh
        .nodes
        .iter()
        .position(|node| (node[2] - first).abs() > tolerance)
    {
        Some(index) => Err(ModelError::NotPlane {
            path: path.to_owned(),
            tag: mesh.node_tags[index],
            z: mesh.nodes[index][2],
            first,
        }),
        None => Ok(()),
    }
}

fn assign_parts(
    mesh: &Mesh,
    parts: &[PartProperties],
    path: &str,
) -> Result<Vec<PlaneElement>, ModelError> {
    let mut owner: Vec<Vec<Option<usize>>> = mesh
        .blocks
        .iter()
        .map(|block| vec![None; block.len()])
        .collect();
    for (part, properties) in parts.iter().enumerate() {
        let group = mesh.group(&properties.group)?;
        if group.dimension != 2 {
            return Err(ModelError::GroupDimension {
                path: path.to_owned(),
                group: properties.group.clone(),
                found: ["points", "curves", "surfaces", "volumes"][group.dimension.min(3)],
                expected: "surfaces",
                purpose: "a part of a plane housing",
            });
        }
        for element in &group.elements {
            let slot = &mut owner[element.block][element.index];
            if let Some(first) = slot.filter(|&first| first != part) {
                return Err(ModelError::TwoParts {
                    path: path.to_owned(),
                    tag: mesh.blocks[element.block].tags[element.index],
                    first: parts[first].group.clone(),
                    second: properties.group.clone(),
                });
            }
            *slot = Some(part);
        }
    }
    let mut elements = Vec::new();
    let (mut unassigned, mut first_tag) = (0, 0);
    for (block, owners) in mesh.blocks.iter().zip(&owner) {
        let Some(kind) = plane_kind(block.kind) else {
            continue;
        };
        for ((nodes, &tag), owner) in block.elements().zip(&block.tags).zip(owners) {
            match owner {
                Some(part) => elements.push(PlaneElement {
                    tag,
                    kind,
                    nodes: nodes.to_vec(),
                    part: *part,
                }),
                None => {
                    first_tag = if unassigned == 0 { tag } else { first_tag };
                    unassigned += 1;
                }
            }
        }
    }
    if unassigned > 0 {
        return Err(ModelError::Unassigned {
            path: path.to_owned(),
            count: unassigned,
            total: unassigned + elements.len(),
            tag: first_tag,
        });
    }
    Ok(elements)
}

fn plane_kind(kind: ElementKind) -> Option<PlaneKind> {
    match kind {
        ElementKind::Tri3 => Some(PlaneKind::Tri3),
        ElementKind::Tri6 => Some(PlaneKind::Tri6),
        ElementKind::Quad4 => Some(PlaneKind::Quad4),
        ElementKind::Quad8 => Some(PlaneKind::Quad8),
        ElementKind::Point | ElementKind::Line2 | ElementKind::Line3 => None,
    }
}
