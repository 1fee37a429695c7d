//! What the groups of a mesh are for, by dimension and name.

use crate::app::case::{BUILT_IN_MATERIALS, built_in_like};
use crate::fe::mesh::{ConsistentUnits, DeckMaterial, Mesh, PhysicalGroup};
use serde::Serialize;
use std::collections::{HashMap, HashSet};

/// Parts of names of what is held.
const SUPPORTS: [&str; 11] =
    ["foot", "feet", "base", "bolt", "support", "fix", "clamp", "mount", "ground", "root", "screw"];

/// Parts of names of points where something is measured.
const SENSORS: [&str; 5] = ["sensor", "accel", "probe", "pickup", "top"];

/// Parts of names of what is made of steel.
const STEEL: [&str; 3] = ["shaft", "bolt", "screw"];

/// What a part is made of where its name says nothing.
const USUAL_MATERIAL: &str = "aluminium";

const AXES: [&str; 3] = ["x", "y", "z"];

/// What says that a group is held.
pub(crate) const BY_NAME: &str = "guess, by its name";
pub(crate) const BY_SHAPE: &str = "guess, the largest flat outside that shares no nodes with the bore";
pub(crate) const BY_FILE: &str = "mesh: *BOUNDARY holds it";

/// Whether a name has one of these words.
pub(crate) fn says(name: &str, words: &[&str]) -> bool {
    let name = name.to_lowercase();
    words.iter().any(|word| name.contains(word))
}

/// A material of the file, in SI.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct FileMaterial {
    /// What the case calls it.
    pub name: String,
    /// Young's modulus, Pa, as the file has it and in Pa.
    pub young: [f64; 2],
    pub poisson: f64,
    /// Density, as the file has it and in kg/m^3.
    pub density: [f64; 2],
}

impl FileMaterial {
    /// One of the materials of the file, by a name that no other has.
    fn of(units: ConsistentUnits, own: &DeckMaterial, all: &[DeckMaterial]) -> Option<Self> {
        let [young, poisson, density] = units.to_si(own)?;
        let mut name = own.name.clone();
        // a ring may be of a built-in one
        while BUILT_IN_MATERIALS.iter().any(|known| known.name == name)
            || name != own.name && all.iter().any(|other| other.name == name)
        {
            name.push_str(" of the mesh");
        }
        Some(Self { name, young: [own.elastic?[0], young], poisson, density: [own.density?, density] })
    }
}

/// A part with its material.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct PartGuess {
    /// Name of the group.
    pub group: String,
    /// Name of a material, built in or of the file.
    pub material: String,
    /// What says the material; "guess" if nothing does.
    pub from: &'static str,
}

/// A group that is held.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct SupportGuess {
    /// Name of the group.
    pub group: String,
    /// "x", "y", "z".
    pub axes: Vec<&'static str>,
}

/// A group that is left to the user.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub(crate) struct Other {
    /// Name of the group.
    pub group: String,
    /// 0 to 3.
    pub dimension: usize,
    /// Why it is not used, or what it may be for.
    pub note: Option<&'static str>,
}

/// What the groups are for.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(crate) struct Groups {
    /// Units of the file's materials, if they show them.
    pub units: Option<ConsistentUnits>,
    /// Materials of the file that parts are of.
    pub materials: Vec<FileMaterial>,
    /// Parts of the housing that share no element.
    pub parts: Vec<PartGuess>,
    /// Elements of the highest dimension in no part.
    pub without_part: usize,
    /// Groups that are held.
    pub supports: Vec<SupportGuess>,
    /// What says so: [`BY_NAME`], [`BY_SHAPE`] or [`BY_FILE`].
    pub held_by: &'static str,
    /// Groups that are named like supports and share nodes with the bore.
    pub at_bore: Vec<String>,
    /// A point where a sensor may stand.
    pub sensor: Option<String>,
    /// The rest, but for the bores.
    pub others: Vec<Other>,
}

/// Whether a case file that names this group means it: no other group takes its name away, and it has elements.
pub(crate) fn usable(mesh: &Mesh, group: &PhysicalGroup) -> bool {
    let body = group.dimension == mesh.dimension();
    let meant = if body { mesh.body(&group.name) } else { mesh.group(&group.name) };
    meant.is_ok_and(|meant| std::ptr::eq(meant, group))
}

impl Groups {
    /// Looks at every group; `bores` are those that rings sit in.
    pub(crate) fn of(mesh: &Mesh, dimension: usize, bores: &[&str]) -> Self {
        let units = ConsistentUnits::of(&mesh.notes.materials);
        let mut found = Self { units, ..Self::default() };
        let (mut taken, mut taken_materials) = (HashSet::new(), HashSet::new());
        let mut on_housing = vec![false; mesh.nodes.len()];
        // large groups first: of two that overlap the one that holds more is the part; where the file says what bodies are
        // made of, those of one material before all
        let mut solids: Vec<&PhysicalGroup> =
            mesh.groups.iter().filter(|group| group.dimension == dimension && usable(mesh, group)).collect();
        let of_file =
            mesh.notes.materials.iter().flat_map(|own| own.groups.iter().map(move |group| (group.as_str(), own)));
        let of_file: HashMap<&str, &DeckMaterial> = of_file.collect();
        let is_mixed = |group: &PhysicalGroup| !of_file.is_empty() && !of_file.contains_key(group.name.as_str());
        solids.sort_by_key(|group| (is_mixed(group), std::cmp::Reverse(group.elements.len())));
        for group in solids {
            if group.elements.iter().any(|id| taken.contains(id)) {
                found.others.push(Other {
                    group: group.name.clone(),
                    dimension,
                    note: Some("shares elements with a part: an element has one material"),
                });
                continue;
            }
            taken.extend(group.elements.iter().copied());
            for &node in &group.nodes {
                on_housing[node] = true;
            }
            let known = built_in_like(&group.name).or_else(|| says(&group.name, &STEEL).then_some("steel"));
            let said =
                of_file.get(group.name.as_str()).and_then(|own| FileMaterial::of(units?, own, &mesh.notes.materials));
            let (material, from) = match (&said, known) {
                (Some(said), _) => (said.name.as_str(), "mesh"),
                (None, Some(known)) => (known, "by its name"),
                (None, None) => (USUAL_MATERIAL, "guess"),
            };
            found.parts.push(PartGuess { group: group.name.clone(), material: material.to_owned(), from });
            found.materials.extend(said.filter(|said| taken_materials.insert(said.name.clone())));
        }
        let bodies = mesh.groups.iter().enumerate().filter(|(_, own)| own.dimension == dimension);
        let order: HashMap<&str, usize> = bodies.map(|(place, own)| (own.name.as_str(), place)).collect();
        found.parts.sort_by_key(|part| order.get(part.group.as_str()));
        found.without_part = mesh.element_ids(dimension).filter(|id| !taken.contains(id)).count();
        let bores: Vec<&PhysicalGroup> = bores.iter().filter_map(|name| mesh.group(name).ok()).collect();
        found.held_by = if mesh.notes.supports.is_empty() { BY_NAME } else { BY_FILE };
        let held: HashMap<&str, [bool; 3]> =
            mesh.notes.supports.iter().map(|held| (held.group.as_str(), held.fixed)).collect();
        for group in &mesh.groups {
            if bores.iter().any(|bore| std::ptr::eq(*bore, group)) {
                continue;
            }
            let name = group.name.as_str();
            let mut leave = |note| {
                found.others.push(Other { group: name.to_owned(), dimension: group.dimension, note });
            };
            // both lists are sorted
            let touches_bore = bores.iter().any(|bore| {
                let mut nodes = group.nodes.iter();
                nodes.any(|node| bore.nodes.binary_search(node).is_ok())
            });
            let named = held.get(name);
            let fixed = named.copied().unwrap_or([found.held_by == BY_NAME && says(name, &SUPPORTS); 3]);
            let axes = AXES[..dimension].iter().zip(fixed).filter(|(_, fixed)| *fixed).map(|(axis, _)| *axis);
            let axes: Vec<&'static str> = axes.collect();
            let whole = group.nodes.iter().all(|&node| on_housing[node]);
            if group.elements.is_empty() {
                leave(Some("has no elements"));
            } else if !usable(mesh, group) {
                leave(Some("another group has this name too: give each its own in gmsh"));
            } else if group.dimension < dimension && !axes.is_empty() {
                if !whole {
                    leave(Some("looks like a support, but lies on no part"));
                } else if touches_bore {
                    leave(Some("looks like a support, but shares nodes with the bore, which follow the ring"));
                    found.at_bore.push(name.to_owned());
                } else {
                    found.supports.push(SupportGuess { group: name.to_owned(), axes });
                }
            } else if group.dimension == 0 && found.sensor.is_none() && says(name, &SENSORS) && whole {
                found.sensor = Some(name.to_owned());
            } else if group.dimension < dimension {
                let bore = "shares nodes with the bore, which follow the ring and cannot be fixed too";
                let unused = "*BOUNDARY of the file names it: look there for what is held";
                leave(touches_bore.then_some(bore).or(named.map(|_| unused)));
            }
        }
        found
    }

    /// Holds the first of the flat faces, given largest first, that shares no nodes with the bore, if no group is named like
    /// a support.
    pub(crate) fn hold_flat(&mut self, flat: &[String], dimension: usize) {
        if self.held_by == BY_FILE || !(self.supports.is_empty() && self.at_bore.is_empty()) {
            return;
        }
        let free = |name: &&String| self.others.iter().any(|other| other.group == **name && other.note.is_none());
        if let Some(name) = flat.iter().find(free).cloned() {
            self.others.retain(|other| other.group != name);
            self.supports.push(SupportGuess { group: name, axes: AXES[..dimension].to_vec() });
            self.held_by = BY_SHAPE;
        }
    }
}
