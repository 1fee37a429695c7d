//! Meshes of boxes for the tests beside: grids of Hex8 or Quad4 in MSH 2.2, and cases of them.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::Output;

use super::program::plummer;

/// A mesh under construction.
#[derive(Default)]
pub struct Grids {
    pub nodes: Vec<[f64; 3]>,
    elements: Vec<String>,
    groups: Vec<(usize, String)>,
}

/// `cells` intervals from `from` to `to`.
pub fn steps(from: f64, to: f64, cells: usize) -> Vec<f64> {
    let at = |i: usize| from + (to - from) * i as f64 / cells as f64;
    (0..=cells).map(at).collect()
}

impl Grids {
    fn group(&mut self, dimension: usize, name: &str) -> usize {
        let wanted = (dimension, name.to_owned());
        let place = self.groups.iter().position(|group| *group == wanted);
        1 + place.unwrap_or_else(|| {
            self.groups.push(wanted);
            self.groups.len() - 1
        })
    }

    /// Adds an element of gmsh's type `kind`, its nodes counted from 1; each group is one entity.
    pub fn element(&mut self, kind: usize, dimension: usize, name: &str, nodes: &[usize]) {
        let entity = self.group(dimension, name);
        self.element_on(entity, kind, dimension, name, nodes);
    }

    /// The same on an entity of this tag.
    pub fn element_on(&mut self, entity: usize, kind: usize, dimension: usize, name: &str, nodes: &[usize]) {
        let group = self.group(dimension, name);
        let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
        self.elements.push(format!("{kind} 2 {group} {entity} {}", nodes.join(" ")));
    }

    /// The node at a place, an old one if `merge` and there is one.
    pub fn node(&mut self, place: [f64; 3], merge: bool) -> usize {
        let near = |node: &[f64; 3]| (0..3).all(|axis| (node[axis] - place[axis]).abs() < 1e-12);
        let found = self.nodes.iter().position(near).filter(|_| merge);
        1 + found.unwrap_or_else(|| {
            self.nodes.push(place);
            self.nodes.len() - 1
        })
    }

    /// Adds a grid of Hex8 as the group `name`, its lowest and highest faces as `name_bottom` and `name_top`; `merge` joins it to what is there. Returns
    /// the nodes of each element.
    pub fn solid(&mut self, name: &str, [xs, ys, zs]: [&[f64]; 3], merge: bool) -> Vec<Vec<usize>> {
        let mut at = Vec::new();
        for &z in zs {
            for &y in ys {
                for &x in xs {
                    at.push(self.node([x, y, z], merge));
                }
            }
        }
        let of = |x: usize, y: usize, z: usize| at[x + xs.len() * (y + ys.len() * z)];
        let mut cells = Vec::new();
        for z in 0..zs.len() - 1 {
            for y in 0..ys.len() - 1 {
                for x in 0..xs.len() - 1 {
                    let face = |z| [of(x, y, z), of(x + 1, y, z), of(x + 1, y + 1, z), of(x, y + 1, z)];
                    let cell = [face(z), face(z + 1)].concat();
                    self.element(5, 3, name, &cell);
                    cells.push(cell);
                    if z == 0 {
                        self.element(3, 2, &format!("{name}_bottom"), &face(z));
                    }
                    if z + 2 == zs.len() {
                        self.element(3, 2, &format!("{name}_top"), &face(z + 1));
                    }
                }
            }
        }
        cells
    }

    /// Writes the mesh as `grid.msh`.
    pub fn write(&self, folder: &Path) {
        let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", self.groups.len());
        for (tag, (dimension, name)) in (1..).zip(&self.groups) {
            let _ = writeln!(text, "{dimension} {tag} \"{name}\"");
        }
        let _ = writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", self.nodes.len());
        for (tag, [x, y, z]) in (1..).zip(&self.nodes) {
            let _ = writeln!(text, "{tag} {x} {y} {z}");
        }
        let _ = writeln!(text, "$EndNodes\n$Elements\n{}", self.elements.len());
        for (tag, element) in (1..).zip(&self.elements) {
            let _ = writeln!(text, "{tag} {element}");
        }
        text.push_str("$EndElements\n");
        fs::write(folder.join("grid.msh"), text).unwrap();
    }
}

/// Runs `plummer modes` on `grid.msh` with these lines of `[housing]` after `mesh` and `length_unit`.
pub fn modes(folder: &Path, housing: &str) -> Output {
    let case = format!(
        "[materials.rubber]\nyoung = 5e6\npoisson = 0.45\ndensity = 1100\n[housing]\nmesh = 'grid.msh'\nlength_unit = 'm'\n{housing}\n[modes]\ncount = 4\n"
    );
    fs::write(folder.join("case.toml"), case).unwrap();
    plummer(folder, &["modes", "case.toml", "--out", "out", "--force"])
}

/// The warnings and the lowest frequency, Hz, of a run of `modes` that went well.
pub fn result(folder: &Path, output: &Output) -> (String, f64) {
    assert_eq!(output.status.code(), Some(0), "{}", super::program::errors(output));
    let json = fs::read_to_string(folder.join("out/modes.json")).unwrap();
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    let warnings = json["warnings"].to_string();
    (warnings, json["frequencies_hz"][0].as_f64().unwrap())
}
