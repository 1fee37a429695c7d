//! Input files of CalculiX and Abaqus (`.inp`): a mesh with its groups as sets, materials, held nodes and a `*FREQUENCY`
//! step. Units are SI.
//!
//! Source of the keywords: CalculiX CrunchiX user's manual 2.20.

use crate::fe::element::continuum::{LinearFormulation, PlaneAssumption};
use crate::fe::material::ElasticMaterial;
use crate::fe::mesh::{ElementId, ElementKind, Mesh, PhysicalGroup, inp_face, inp_nodes};
use crate::fe::model::PlaneModel;
use crate::files::{Fault, write_atomic};
use crate::formats::FormatError;
use std::collections::{HashMap, HashSet};
use std::io::{self, Write};
use std::path::Path;

/// Largest number of a node or element that Abaqus takes.
const LARGEST: u64 = 999_999_999;

/// Items of a line: CalculiX takes no more.
const ITEMS: usize = 16;

/// What a file holds beside the mesh.
pub(crate) struct InpJob<'a> {
    /// Lines for the head.
    pub(crate) comments: &'a [String],
    /// Each group that is a part, with the name of its material and the material.
    pub(crate) parts: Vec<(&'a str, &'a str, ElasticMaterial)>,
    pub(crate) plane: Option<PlaneModel>,
    pub(crate) linear: LinearFormulation,
    /// Each group that is held, and along which axes.
    pub(crate) held: Vec<(&'a str, [bool; 3])>,
    /// Number of modes asked for.
    pub(crate) modes: usize,
}

/// Writes an input file, whole or not at all.
///
/// # Errors
/// [`FormatError`] for elements and numbers that the format does not have, and when the file cannot be written.
pub(crate) fn write_inp(path: &Path, mesh: &Mesh, job: &InpJob<'_>) -> Result<(), FormatError> {
    let dimension = mesh.dimension();
    let mut used = vec![false; mesh.nodes.len()];
    for block in mesh.blocks.iter().filter(|block| block.kind.dimension() == dimension && !block.is_empty()) {
        if element_type(block.kind, job).is_none() {
            let expected =
                "elements that CalculiX has: mesh again in gmsh with Mesh.SecondOrderIncomplete = 1, without pyramids";
            return Err(Fault::new(expected, format!("a {}", block.kind.name())).of(&mesh.source).into());
        }
        block.connectivity.iter().for_each(|&node| used[node] = true);
    }
    let element_tags = mesh.blocks.iter().flat_map(|block| &block.tags);
    if let Some(tag) = mesh.node_tags.iter().chain(element_tags).find(|tag| **tag > LARGEST) {
        return Err(Fault::new(format!("numbers up to {LARGEST}"), tag).of(path).into());
    }
    let writer = Writer { mesh, job, used, names: Names::of(mesh), dimension };
    Ok(write_atomic(path, |to| writer.write(to))?)
}

/// The element type for a kind, of the formulation that is nearest to this program's.
fn element_type(kind: ElementKind, job: &InpJob<'_>) -> Option<&'static str> {
    let strain = job.plane.is_some_and(|plane| plane.assumption == PlaneAssumption::Strain);
    let either = |stress, in_strain| Some(if strain { in_strain } else { stress });
    match kind {
        ElementKind::Tri3 => either("CPS3", "CPE3"),
        ElementKind::Tri6 => either("CPS6", "CPE6"),
        ElementKind::Quad4 => either("CPS4", "CPE4"),
        ElementKind::Quad8 => either("CPS8", "CPE8"),
        ElementKind::Tet4 => Some("C3D4"),
        ElementKind::Tet10 => Some("C3D10"),
        ElementKind::Hex8 if job.linear == LinearFormulation::Incompatible => Some("C3D8I"),
        ElementKind::Hex8 => Some("C3D8"),
        ElementKind::Hex20 => Some("C3D20"),
        ElementKind::Wedge6 => Some("C3D6"),
        ElementKind::Wedge15 => Some("C3D15"),
        _ => None,
    }
}

/// Names of groups as sets: letters, digits, `_` and `-`, different without regard to case.
struct Names(HashMap<(usize, String), String>);

impl Names {
    fn of(mesh: &Mesh) -> Self {
        let mut taken = HashSet::new();
        let mut names = HashMap::new();
        for group in &mesh.groups {
            let plain = plain(&group.name);
            let numbered = (2..).map(|number| format!("{plain}_{number}"));
            let mut names_to_try = std::iter::once(plain.clone()).chain(numbered);
            if let Some(name) = names_to_try.find(|name| !taken.contains(&name.to_uppercase())) {
                taken.insert(name.to_uppercase());
                names.insert((group.dimension, group.name.clone()), name);
            }
        }
        Self(names)
    }

    fn get(&self, group: &PhysicalGroup) -> &str {
        self.0.get(&(group.dimension, group.name.clone())).map_or("", String::as_str)
    }
}

/// A name of letters, digits, `_` and `-` that begins with a letter and has at most 60 of them.
fn plain(name: &str) -> String {
    let fitting = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
    let first = if name.starts_with(|c: char| c.is_ascii_alphabetic()) { "" } else { "G" };
    first.chars().chain(name.chars().map(fitting)).take(60).collect()
}

struct Writer<'a> {
    mesh: &'a Mesh,
    job: &'a InpJob<'a>,
    /// Nodes of the bodies.
    used: Vec<bool>,
    names: Names,
    dimension: usize,
}

impl Writer<'_> {
    fn write(&self, to: &mut impl Write) -> io::Result<()> {
        for line in self.job.comments.iter().flat_map(|comment| comment.lines()) {
            writeln!(to, "** {line}")?;
        }
        self.write_mesh(to)?;
        self.write_groups(to)?;
        self.write_materials(to)?;
        for (group, axes) in &self.job.held {
            let Ok(group) = self.mesh.group(group) else { continue };
            writeln!(to, "*BOUNDARY")?;
            for (axis, _) in (1..).zip(axes).filter(|(_, held)| **held) {
                writeln!(to, "{},{axis},{axis}", self.names.get(group))?;
            }
        }
        writeln!(to, "*STEP\n*FREQUENCY\n{}\n*NODE FILE\nU\n*END STEP", self.job.modes)
    }

    fn write_mesh(&self, to: &mut impl Write) -> io::Result<()> {
        writeln!(to, "*NODE")?;
        let nodes = self.mesh.node_tags.iter().zip(&self.mesh.nodes).zip(&self.used);
        for ((tag, [x, y, z]), _) in nodes.filter(|(_, used)| **used) {
            writeln!(to, "{tag},{x:.12e},{y:.12e},{z:.12e}")?;
        }
        for block in self.mesh.blocks.iter().filter(|block| block.kind.dimension() == self.dimension) {
            let order = inp_nodes(block.kind);
            // gmsh's node at each place of the file
            let mut places = vec![0; order.len()];
            order.iter().enumerate().for_each(|(own, &place)| places[place] = own);
            writeln!(to, "*ELEMENT,TYPE={}", element_type(block.kind, self.job).unwrap_or_default())?;
            for (tag, nodes) in block.tags.iter().zip(block.elements()) {
                let nodes = places.iter().map(|&own| self.mesh.node_tags[nodes[own]]);
                write_items(to, std::iter::once(*tag).chain(nodes))?;
            }
        }
        Ok(())
    }

    fn write_groups(&self, to: &mut impl Write) -> io::Result<()> {
        let faces = self.faces();
        for group in &self.mesh.groups {
            let name = self.names.get(group);
            if group.dimension == self.dimension {
                writeln!(to, "*ELSET,ELSET={name}")?;
                let tag = |id: &ElementId| self.mesh.blocks[id.block].tags[id.index];
                write_items(to, group.elements.iter().map(tag))?;
                if !self.is_held(group) {
                    continue;
                }
            }
            let nodes = group.nodes.iter().filter(|&&node| self.used[node]);
            let mut nodes = nodes.map(|&node| self.mesh.node_tags[node]).peekable();
            if nodes.peek().is_some() {
                writeln!(to, "*NSET,NSET={name}")?;
                write_items(to, nodes)?;
            }
            let corners = |id: &ElementId| {
                let block = &self.mesh.blocks[id.block];
                sorted(&block.nodes_of(id.index)[..block.kind.corners()])
            };
            let own = group.elements.iter().filter_map(|id| faces.get(&corners(id)));
            let mut own = own.peekable();
            if group.dimension + 1 == self.dimension && own.peek().is_some() {
                writeln!(to, "*SURFACE,NAME={name},TYPE=ELEMENT")?;
                for (tag, face) in own {
                    writeln!(to, "{tag},S{face}")?;
                }
            }
        }
        Ok(())
    }

    /// Element and number of each face on the outside of the bodies, by its corners.
    fn faces(&self) -> HashMap<Vec<usize>, (u64, usize)> {
        let outside = self.mesh.boundary_faces(self.mesh.element_ids(self.dimension));
        let numbered = outside.iter().filter_map(|face| {
            let block = &self.mesh.blocks[face.element.block];
            let nodes = block.nodes_of(face.element.index);
            let is_this = |number: &usize| {
                let own = block.kind.faces()[*number].nodes;
                own.len() == face.nodes.len() && own.iter().zip(&face.nodes).all(|(&local, &node)| nodes[local] == node)
            };
            let index = (0..block.kind.faces().len()).find(is_this)?;
            let corners = sorted(&face.nodes[..face.kind.corners()]);
            Some((corners, (block.tags[face.element.index], inp_face(block.kind, index)?)))
        });
        numbered.collect()
    }

    fn write_materials(&self, to: &mut impl Write) -> io::Result<()> {
        for (number, (group, name, material)) in (1..).zip(&self.job.parts) {
            // of one name with other values there is one a part
            let name = format!("{}_{number}", plain(name));
            writeln!(to, "*MATERIAL,NAME={name}")?;
            let mut orientation = String::new();
            match material {
                ElasticMaterial::Isotropic(own) => writeln!(to, "*ELASTIC\n{:e},{:e}", own.young, own.poisson)?,
                ElasticMaterial::Orthotropic(own) => {
                    let ([e1, e2, e3], [n12, n23, n13], [g12, g23, g13]) = (own.young, own.poisson, own.shear);
                    writeln!(to, "*ELASTIC,TYPE=ENGINEERING CONSTANTS")?;
                    writeln!(to, "{e1:e},{e2:e},{e3:e},{n12:e},{n13:e},{n23:e},{g12:e},{g13:e}\n{g23:e}")?;
                    orientation = format!(",ORIENTATION=AXES_{number}");
                }
            }
            writeln!(to, "*DENSITY\n{:e}", material.density())?;
            if let ElasticMaterial::Orthotropic(own) = material {
                let [[a, b, c], [d, e, f], _] = own.axes;
                writeln!(to, "*ORIENTATION,NAME=AXES_{number},SYSTEM=RECTANGULAR")?;
                writeln!(to, "{a:.12e},{b:.12e},{c:.12e},{d:.12e},{e:.12e},{f:.12e}")?;
            }
            let Ok(body) = self.mesh.body(group) else { continue };
            writeln!(to, "*SOLID SECTION,ELSET={},MATERIAL={name}{orientation}", self.names.get(body))?;
            if let Some(plane) = self.job.plane {
                writeln!(to, "{:e}", plane.thickness)?;
            }
        }
        Ok(())
    }

    fn is_held(&self, group: &PhysicalGroup) -> bool {
        self.job.held.iter().any(|(name, _)| self.mesh.group(name).is_ok_and(|held| std::ptr::eq(held, group)))
    }
}

fn sorted(corners: &[usize]) -> Vec<usize> {
    let mut sorted = corners.to_vec();
    sorted.sort_unstable();
    sorted
}

/// Writes items in lines that go on after a comma.
fn write_items(to: &mut impl Write, items: impl Iterator<Item = u64>) -> io::Result<()> {
    let items: Vec<String> = items.map(|item| item.to_string()).collect();
    let lines: Vec<String> = items.chunks(ITEMS).map(|line| line.join(",")).collect();
    writeln!(to, "{}", lines.join(",\n"))
}
