//! CAD entities in the place of groups that a mesh lacks: bodies as parts, cylindrical holes for a bore, flat faces to stand on.

use super::bore::{Cylinders, cylinders};
use super::groups::usable;
use crate::fe::mesh::surfaces::{CadSurface, SurfaceShape};
use crate::fe::mesh::{Mesh, Rim, entity_name};

/// Holes, and flat faces, that are offered at most.
const OFFERED: usize = 8;

/// What was offered.
#[derive(Default)]
pub(crate) struct Offered {
    /// Flat faces with the whole body behind them, largest first.
    pub flat: Vec<String>,
    /// Surfaces that were looked at; 0 where a group is the bore.
    pub surfaces: usize,
}

/// Makes groups of the bodies that are in none. If no group is a bore, the largest cylindrical holes and flat outsides become
/// groups too. Returns the cylinders of all groups.
pub(crate) fn offer(mesh: &mut Mesh, dimension: usize, rim: &Rim) -> (Cylinders, Offered) {
    let bodies = mesh.entities_without_group(dimension);
    let names: Vec<String> = bodies.into_iter().map(|tag| entity_name(dimension, &[tag])).collect();
    mesh.add_entity_groups(names.iter().map(String::as_str));
    let found = cylinders(mesh, dimension, rim, |group| usable(mesh, group));
    if found.bore.is_some() {
        return (found, Offered::default());
    }
    let tags = mesh.entities(|_| true, dimension - 1);
    let surfaces = CadSurface::joined(mesh, rim, &tags);
    let named = |own: &CadSurface| entity_name(dimension - 1, &own.tags);
    let is_hole = |own: &&CadSurface| match &own.shape {
        SurfaceShape::Cylinder(cylinder) => cylinder.hole == Some(true),
        _ => false,
    };
    let holes: Vec<String> = surfaces.iter().filter(is_hole).map(named).take(OFFERED).collect();
    let flat = surfaces.iter().filter(|own| own.is_flat_outside(mesh));
    let flat: Vec<String> = flat.map(named).take(OFFERED).collect();
    mesh.add_entity_groups(holes.iter().chain(&flat).map(String::as_str));
    let found = cylinders(mesh, dimension, rim, |group| usable(mesh, group));
    (found, Offered { flat, surfaces: tags.len() })
}
