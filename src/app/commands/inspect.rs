//! `plummer inspect`: what a mesh contains, how large it is and how well its elements are shaped.

use crate::app::error::ComputeError;
use crate::fe::element::continuum::{ShapeQuality, measure, quality, surface_weights};
use crate::fe::mesh::cylinder::Cylinder;
use crate::fe::mesh::surfaces::{CadSurface, SurfaceShape};
use crate::fe::mesh::{ElementId, ElementKind, Inventory, Mesh, Rim, entity_name};
use crate::fe::model::{Bodies, Crossing, Doubled, MixedOrders, Overlap, Touching, folds, straighten};
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

/// What a CAD surface is, or a curve of a plane mesh. Lengths in m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "shape")]
pub enum SurfaceKind {
    /// A cylinder; a circle about z in a plane mesh.
    Cylinder {
        /// Diameter.
        diameter: f64,
        /// Unit vector along its axis.
        axis: [f64; 3],
        /// Whether the body is outside of it; `None`: it bounds no body.
        hole: Option<bool>,
        /// Share of the full turn that it covers, 0 to 1.
        turn: f64,
    },
    /// A plane; a straight line in a plane mesh.
    Plane {
        /// Unit normal, away from the body that it bounds.
        normal: [f64; 3],
    },
    /// Neither.
    Other,
}

/// A CAD surface that is in no group, or a curve of a plane mesh.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SurfaceSummary {
    /// What a case calls it, as "surface 7".
    pub name: String,
    /// gmsh's tag of the entity.
    pub tag: i32,
    /// What it is.
    #[serde(flatten)]
    pub kind: SurfaceKind,
    /// Area, m^2; length of a curve, m.
    pub size: f64,
    /// Number of elements.
    pub elements: usize,
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
    /// CAD surfaces (curves of a plane mesh) that are in no group, in the order of their tags: a case may name them.
    pub surfaces: Vec<SurfaceSummary>,
    /// The element with the smallest scaled Jacobian among those of the highest dimension.
    pub worst: Option<ElementShape>,
    /// Number of elements that are inverted, folded or without size.
    pub invalid_elements: usize,
    /// Number of those that straight edges mend.
    pub folded_elements: usize,
    /// The first of the invalid elements.
    pub invalid: Vec<ElementShape>,
    /// The elements are plane and do not lie in one plane z = const, which no command takes.
    pub shells: bool,
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
    /// Reads a mesh, straightens its folded elements where that is wanted, and looks at it; without a unit its coordinates
    /// are taken as metres.
    ///
    /// # Errors
    /// [`ComputeError`] if it cannot be read, or straightened.
    pub(crate) fn of_file(path: &Path, unit: Option<LengthUnit>, straight: bool) -> Result<Self, ComputeError> {
        let mut mesh = Mesh::read(path, unit.unwrap_or(LengthUnit::Metre))?;
        if straight {
            straighten(&mut mesh)?;
        }
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
            surfaces: surfaces(mesh, dimension),
            worst: None,
            invalid_elements: 0,
            folded_elements: 0,
            invalid: Vec::new(),
            shells: dimension == 2 && mesh.node_off_plane().is_some(),
            doubled: bodies.doubled(),
            mixed_orders: bodies.mixed_orders(),
            crossing,
            overlapping,
            touching,
            inventory,
        };
        if !found.shells {
            ids().for_each(|id| found.look_at(mesh, id));
        }
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
            self.folded_elements += usize::from(folds(mesh, id));
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

/// The CAD surfaces of a body that are in no group.
fn surfaces(mesh: &Mesh, dimension: usize) -> Vec<SurfaceSummary> {
    let tags = if dimension < 2 { Vec::new() } else { mesh.entities_without_group(dimension - 1) };
    if tags.is_empty() {
        return Vec::new();
    }
    let found = CadSurface::all(mesh, &Rim::of(mesh, dimension), &tags);
    let summary = found.into_iter().zip(tags).map(|(own, tag)| SurfaceSummary {
        name: entity_name(dimension - 1, &[tag]),
        tag,
        kind: match own.shape {
            SurfaceShape::Cylinder(Cylinder { radius, axis, hole, turn, .. }) => {
                SurfaceKind::Cylinder { diameter: 2.0 * radius, axis, hole, turn }
            }
            SurfaceShape::Plane(normal, _) => SurfaceKind::Plane { normal: normal.into() },
            SurfaceShape::Other => SurfaceKind::Other,
        },
        size: size(mesh, own.elements.iter().copied()),
        elements: own.elements.len(),
    });
    summary.collect()
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
