//! `plummer inspect`: what a mesh contains, how large it is and how well its elements are shaped.

use crate::fe::element::continuum::{ShapeQuality, measure, quality, surface_weights};
use crate::fe::mesh::{ElementId, ElementKind, Inventory, Mesh, MeshError};
use crate::fe::model::{Bodies, Crossing, Doubled, MixedOrders, Overlap, Touching};
use crate::numerics::units::LengthUnit;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;
use std::path::Path;

/// Bad elements that are listed one by one.
const LISTED: usize = 10;

/// The shape of one element.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ElementShape {
    /// gmsh's tag.
    pub tag: u64,
    /// Its kind.
    pub kind: ElementKind,
    /// Its Jacobian.
    #[serde(flatten)]
    pub shape: ShapeQuality,
}

/// Length (m), area (m^2) or volume (m^3) of a group of curves, surfaces or volumes.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct GroupSize {
    /// The group.
    pub name: String,
    /// 1 to 3.
    pub dimension: usize,
    /// Sum over its valid elements.
    pub size: f64,
}

/// The result of `plummer inspect`.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct InspectResult<'a> {
    /// Version of the program.
    pub plummer: &'static str,
    /// "inspect".
    pub command: &'static str,
    /// The mesh.
    pub mesh: &'a Path,
    /// Wall time, s.
    pub wall_s: f64,
    /// Mass, kg; `None` unless unit and density were given.
    pub mass_kg: Option<f64>,
    /// What was found.
    #[serde(flatten)]
    pub found: &'a Inspection,
}

/// What was found.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Inspection {
    /// Unit of the file's coordinates; `None`: not given, one unit was taken as 1 m.
    pub length_unit: Option<LengthUnit>,
    /// Counts, groups, extent, and what hangs in the air.
    #[serde(flatten)]
    pub inventory: Inventory,
    /// Area (m^2) of a plane mesh, volume (m^3) of a solid one; elements without valid shape left out.
    pub size: f64,
    /// The same for every group.
    pub group_sizes: Vec<GroupSize>,
    /// The element with the smallest scaled Jacobian among those of the highest dimension.
    pub worst: Option<ElementShape>,
    /// Number of elements that are inverted, folded or without size.
    pub invalid_elements: usize,
    /// The first of them.
    pub invalid: Vec<ElementShape>,
    /// Elements of the highest dimension on the corners of another one.
    pub doubled: Option<Doubled>,
    /// Edges on which elements of the highest dimension do not have the same middle node.
    pub mixed_orders: Option<MixedOrders>,
    /// Groups of the highest dimension that lie in one another.
    pub overlapping: Vec<Overlap>,
    /// Groups of the highest dimension whose faces lie on each other without common nodes.
    pub touching: Vec<Touching>,
    /// Groups of the highest dimension that reach into one another, of which the other lists say nothing.
    pub crossing: Vec<Crossing>,
}

impl Inspection {
    /// Reads a mesh and looks at it; without a unit its coordinates are taken as metres.
    ///
    /// # Errors
    /// [`MeshError`] if it cannot be read.
    pub(crate) fn of_file(path: &Path, unit: Option<LengthUnit>) -> Result<Self, MeshError> {
        let mesh = Mesh::read(path, unit.unwrap_or(LengthUnit::Metre))?;
        Ok(Self::of_mesh(&mesh, unit))
    }

    /// Looks at a mesh that was read with this unit, as metres without one.
    #[must_use]
    pub(crate) fn of_mesh(mesh: &Mesh, unit: Option<LengthUnit>) -> Self {
        let inventory = mesh.inventory();
        let bodies = Bodies::of_mesh(mesh);
        let overlapping = bodies.overlaps();
        let (touching, crossing) = bodies.unconnected(|_| false, &overlapping);
        let groups = mesh.groups.iter().filter(|group| group.dimension > 0);
        let group_sizes = groups.map(|group| GroupSize {
            name: group.name.clone(),
            dimension: group.dimension,
            size: size(mesh, group.elements.iter().copied()),
        });
        let dimension = inventory.dimension;
        let ids = || mesh.element_ids(dimension);
        let mut found = Self {
            length_unit: unit,
            size: size(mesh, ids()),
            group_sizes: group_sizes.collect(),
            worst: None,
            invalid_elements: 0,
            invalid: Vec::new(),
            doubled: bodies.doubled(),
            mixed_orders: bodies.mixed_orders(),
            crossing,
            overlapping,
            touching,
            inventory,
        };
        ids().for_each(|id| found.look_at(mesh, id));
        found
    }

    fn look_at(&mut self, mesh: &Mesh, id: ElementId) {
        let block = &mesh.blocks[id.block];
        let kind = block.kind;
        // coordinates are finite and as many as the kind has nodes: the reader has seen to it
        let Ok(shape) = quality(kind, &coordinates(mesh, id)) else {
            return;
        };
        let shape = ElementShape { tag: block.tags[id.index], kind, shape };
        if measure(kind, &coordinates(mesh, id)).is_err() {
            self.invalid_elements += 1;
            if self.invalid.len() < LISTED {
                self.invalid.push(shape.clone());
            }
        }
        let worse = |worst: &ElementShape| shape.shape.scaled_jacobian < worst.shape.scaled_jacobian;
        if self.worst.as_ref().is_none_or(worse) {
            self.worst = Some(shape);
        }
    }
}

fn coordinates(mesh: &Mesh, id: ElementId) -> Vec<[f64; 3]> {
    let nodes = mesh.blocks[id.block].element(id.index).unwrap_or_default();
    nodes.iter().map(|&node| mesh.nodes[node]).collect()
}

/// Sum of lengths, areas or volumes; elements on the same nodes count once, as supports and masses take them.
pub(crate) fn size(mesh: &Mesh, elements: impl Iterator<Item = ElementId>) -> f64 {
    let mut seen = BTreeSet::new();
    elements
        .filter(|id| {
            let mut nodes = mesh.blocks[id.block].element(id.index).unwrap_or_default().to_vec();
            nodes.sort_unstable();
            seen.insert(nodes)
        })
        .map(|id| {
            let kind = mesh.blocks[id.block].kind;
            let at = coordinates(mesh, id);
            match kind.dimension() {
                3 => measure(kind, &at).unwrap_or(0.0),
                _ => surface_weights(kind, &at).map_or(0.0, |w| w.iter().sum()),
            }
        })
        .sum()
}
