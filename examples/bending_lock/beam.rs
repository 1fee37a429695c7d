//! A cantilever in one material, meshed in code, and its compliance.

use super::load::end_load;

use plummer::fe::assembly::SystemMatrices;
use plummer::fe::element::continuum::{Formulation, shape_values};
use plummer::fe::material::Material;
use plummer::fe::mesh::{
    ElementBlock, ElementId, ElementKind, Entity, Face, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
};
use plummer::fe::model::{HousingDescription, HousingModel, HousingPart};
use plummer::numerics::linalg::{SparseCholesky, submatrix};
use std::error::Error;

/// Side of the square section, m.
pub const HEIGHT: f64 = 0.01;
/// Young's modulus, Pa: no ratio depends on it.
pub const YOUNG: f64 = 200e9;

/// A beam along x, clamped at x = 0, its section about the x axis or the quarter of it in y, z > 0.
pub struct Beam {
    /// x of the lines of nodes across the beam at the axis, m, ascending.
    pub lines: Vec<f64>,
    /// dx/dz of each of these lines.
    pub tilts: Vec<f64>,
    /// Elements across each side of the section, or of the quarter.
    pub across: usize,
    /// The quarter alone: bending is antisymmetric in z and symmetric in y.
    pub quarter: bool,
}

impl Beam {
    /// `count` equal elements, one over the section.
    pub fn uniform(length: f64, count: usize) -> Self {
        Self {
            lines: (0..=count).map(|i| length * i as f64 / count as f64).collect(),
            tilts: vec![0.0; count + 1],
            across: 1,
            quarter: false,
        }
    }

    /// Lines inside tilted by an angle, to and fro (trapezoids) or all alike (parallelograms).
    pub fn tilted(mut self, degrees: f64, alternate: bool) -> Self {
        let last = self.tilts.len() - 1;
        for (line, tilt) in self.tilts.iter_mut().enumerate().take(last).skip(1) {
            let sign = if alternate && line % 2 == 1 { -1.0 } else { 1.0 };
            *tilt = sign * degrees.to_radians().tan();
        }
        self
    }

    /// A quarter of the section with `across` squared elements, in lengths that grow from one element's height at
    /// the clamped end to half the height of the section: for reference.
    pub fn fine(length: f64, across: usize) -> Self {
        let mut steps = vec![0.5 * HEIGHT / across as f64];
        let mut end = steps[0];
        while end < length {
            let step = (1.25 * steps[steps.len() - 1]).min(0.5 * HEIGHT).max(steps[0]);
            steps.push(step);
            end += step;
        }
        let mut lines = vec![0.0];
        for step in &steps {
            lines.push(lines[lines.len() - 1] + step * length / end);
        }
        Self { tilts: vec![0.0; lines.len()], lines, across, quarter: true }
    }

    fn length(&self) -> f64 {
        self.lines[self.lines.len() - 1]
    }

    /// Position of a place counted in cells along x, y and z, m.
    fn place(&self, [i, j, k]: [f64; 3]) -> [f64; 3] {
        let side = |cells: f64| HEIGHT * (cells / self.across as f64 - if self.quarter { 0.0 } else { 0.5 });
        let z = if self.quarter { 0.5 * side(k) } else { side(k) };
        let line = |i: usize| self.lines[i] + self.tilts[i] * z;
        let cell = (i as usize).min(self.lines.len() - 2);
        let [from, to] = [line(cell), line(cell + 1)];
        [from + (i - cell as f64) * (to - from), if self.quarter { 0.5 * side(j) } else { side(j) }, z]
    }

    fn mesh(&self, kind: ElementKind) -> Mesh {
        let cells = [self.lines.len() - 1, self.across, self.across];
        let steps = steps_of_a_cell(kind);
        let [a, b, c] = cells.map(|n| steps * n + 1);
        let index = |p: [usize; 3]| p[0] + a * (p[1] + b * p[2]);
        let at = |n: usize| [n % a, n / a % b, n / a / b].map(|step| step as f64 / steps as f64);
        let mut nodes: Vec<_> = (0..a * b * c).map(|n| self.place(at(n))).collect();
        let beyond = beyond_corners(kind);
        let mut connectivity = Vec::new();
        for cell in 0..cells.iter().product() {
            let origin = [cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]];
            for corners in corners_in_a_cell(kind) {
                let corners: Vec<_> = corners.iter().map(|p| [0, 1, 2].map(|i| steps * origin[i] + p[i])).collect();
                let mean = |shares: &Vec<f64>| {
                    [0, 1, 2].map(|i| {
                        let parts = corners.iter().zip(shares).map(|(corner, share)| corner[i] as f64 * share);
                        parts.sum::<f64>().round() as usize
                    })
                };
                connectivity.extend(corners.iter().copied().chain(beyond.iter().map(mean)).map(index));
            }
        }
        // the diagonals of a tilted cell are straight, too
        for element in connectivity.chunks_exact(kind.nodes()) {
            for (shares, &node) in beyond.iter().zip(&element[kind.corners()..]) {
                let parts =
                    |i: usize| element.iter().zip(shares).map(|(&corner, share)| nodes[corner][i] * share).sum();
                nodes[node] = [0, 1, 2].map(parts);
            }
        }
        let count = connectivity.len() / kind.nodes();
        let entity = Entity { dimension: 3, tag: 1 };
        let group = PhysicalGroup {
            name: "beam".to_owned(),
            dimension: 3,
            tag: 1,
            nodes: (0..nodes.len()).collect(),
            elements: (0..count).map(|index| ElementId { block: 0, index }).collect(),
        };
        let block = ElementBlock { kind, tags: (1..=count as u64).collect(), connectivity, entity };
        Mesh {
            node_tags: (1..=nodes.len() as u64).collect(),
            nodes,
            blocks: vec![block],
            groups: vec![group],
            format: MshFormat { version: MshVersion::V41, binary: false },
            notes: MeshNotes::default(),
            source: "cantilever".into(),
        }
    }

    /// Deflection of the end per unit load, m/N: `F.u / F^2` with the load F as a parabolic shear stress over the end
    /// face, consistent, so that it is the mean deflection with that weight. From below for conforming elements.
    pub fn compliance(&self, kind: ElementKind, formulation: Formulation, poisson: f64) -> Result<f64, Box<dyn Error>> {
        let mesh = self.mesh(kind);
        let part = HousingPart { group: "beam".to_owned(), material: Material::new(YOUNG, poisson, 7800.0)?.into() };
        let description = HousingDescription { parts: vec![part], formulation, ..HousingDescription::default() };
        let model = HousingModel::new(&mesh, description)?;
        let stiffness = SystemMatrices::assemble(&model)?.stiffness;
        let mut free = model.free_dofs();
        free.retain(|dof| {
            let [x, y, z] = mesh.nodes[dof / 3];
            let held = match dof % 3 {
                0 => self.quarter && z == 0.0,
                1 => self.quarter && (z == 0.0 || y == 0.0),
                _ => false,
            };
            !(held || x == 0.0)
        });
        let load = end_load(&mesh, kind, self.length())?;
        let total: f64 = load.iter().sum();
        let force = |dof: usize| if dof % 3 == 2 { load[dof / 3] } else { 0.0 };
        let mut u: Vec<f64> = free.iter().map(|&dof| force(dof)).collect();
        SparseCholesky::new(&submatrix(&stiffness, &free, &free))?.solve_vector(&mut u)?;
        let work: f64 = free.iter().zip(&u).map(|(&dof, u)| force(dof) * u).sum();
        // a quarter of the section carries a quarter of the load
        Ok(work / (total * total) / if self.quarter { 4.0 } else { 1.0 })
    }
}

/// Nodes along an edge of a cell, less one: edges end in the centre of a cell of pyramids.
fn steps_of_a_cell(kind: ElementKind) -> usize {
    if kind.corners() == 5 { 4 } else { 2 }
}

/// Shares of the corners in each node behind them, on a straight element.
fn beyond_corners(kind: ElementKind) -> Vec<Vec<f64>> {
    let linear = match kind.corners() {
        4 => ElementKind::Tet4,
        5 => ElementKind::Pyramid5,
        6 => ElementKind::Wedge6,
        _ => ElementKind::Hex8,
    };
    kind.natural_nodes()[kind.corners()..].iter().map(|&at| shape_values(linear, at).to_vec()).collect()
}

/// Corners of the elements of a cell, in steps.
fn corners_in_a_cell(kind: ElementKind) -> Vec<Vec<[usize; 3]>> {
    let far = steps_of_a_cell(kind);
    let whole = ElementKind::Hex8.natural_nodes().iter().map(|x| x.map(|x| if x > 0.0 { far } else { 0 }));
    let whole: Vec<[usize; 3]> = whole.collect();
    match kind.corners() {
        4 => tetrahedra(),
        5 => {
            // each face as seen from the centre, which is the apex
            let base = |face: &Face| face.nodes.iter().rev().map(|&corner| whole[corner]).chain([[2; 3]]).collect();
            ElementKind::Hex8.faces().iter().map(base).collect()
        }
        6 => [[[0, 0], [2, 0], [0, 2]], [[2, 2], [0, 2], [2, 0]]]
            .map(|base| [0, 2].map(|y| base.map(|[z, x]| [x, y, z])).concat())
            .to_vec(),
        _ => vec![whole],
    }
}

/// Six tetrahedra about the diagonal of a cell (Kuhn).
fn tetrahedra() -> Vec<Vec<[usize; 3]>> {
    let paths = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let along = |(number, path): (usize, [usize; 3])| {
        let mut corners = vec![[0; 3]; 4];
        for (step, axis) in path.into_iter().enumerate() {
            corners[step + 1..].iter_mut().for_each(|corner| corner[axis] += 2);
        }
        if number > 2 {
            corners.swap(1, 2); // the odd paths turn the other way round
        }
        corners
    };
    paths.into_iter().enumerate().map(along).collect()
}
