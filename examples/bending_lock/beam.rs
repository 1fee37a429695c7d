//! A cantilever in one material, meshed in code, and its compliance.

use super::load::end_load;

use plummer::fe::assembly::SystemMatrices;
use plummer::fe::element::continuum::Formulation;
use plummer::fe::material::Material;
use plummer::fe::mesh::{
    ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup,
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

    /// Position of half step i along x, j along y, k along z, m.
    fn place(&self, [i, j, k]: [usize; 3]) -> [f64; 3] {
        let share = |step: usize| step as f64 / (2 * self.across) as f64;
        let side = |step| HEIGHT * if self.quarter { 0.5 * share(step) } else { share(step) - 0.5 };
        let z = side(k);
        let line = |i: usize| self.lines[i] + self.tilts[i] * z;
        [f64::midpoint(line(i / 2), line(i.div_ceil(2))), side(j), z]
    }

    fn mesh(&self, kind: ElementKind) -> Mesh {
        let cells = [self.lines.len() - 1, self.across, self.across];
        let [a, b, c] = cells.map(|n| 2 * n + 1);
        let index = |p: [usize; 3]| p[0] + a * (p[1] + b * p[2]);
        let mut nodes: Vec<_> = (0..a * b * c).map(|n| self.place([n % a, n / a % b, n / a / b])).collect();
        let mut connectivity = Vec::new();
        for cell in 0..cells.iter().product() {
            let origin = [cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]];
            for corners in corners_in_a_cell(kind) {
                let corners: Vec<_> = corners.iter().map(|p| [0, 1, 2].map(|i| 2 * origin[i] + p[i])).collect();
                let middle = |[a, b]: [usize; 2]| [0, 1, 2].map(|i| usize::midpoint(corners[a][i], corners[b][i]));
                connectivity.extend(corners.iter().copied().map(index));
                connectivity.extend(kind.middle_edges().iter().map(|&edge| index(middle(edge))));
            }
        }
        // the diagonals of a tilted cell are straight, too
        for element in connectivity.chunks_exact(kind.nodes()) {
            for (&[a, b], &middle) in kind.middle_edges().iter().zip(&element[kind.corners()..]) {
                let ends: [[f64; 3]; 2] = [nodes[element[a]], nodes[element[b]]];
                nodes[middle] = [0, 1, 2].map(|i| f64::midpoint(ends[0][i], ends[1][i]));
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
        let block = ElementBlock {
            kind: ElementKind::all().find(|k| k.name() == kind.name()).expect("has its mesh kind"),
            tags: (1..=count as u64).collect(),
            connectivity,
            entity,
        };
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

/// Corners of the elements of a cell, in half steps.
fn corners_in_a_cell(kind: ElementKind) -> Vec<Vec<[usize; 3]>> {
    match kind.corners() {
        4 => tetrahedra(),
        6 => [[[0, 0], [2, 0], [0, 2]], [[2, 2], [0, 2], [2, 0]]]
            .map(|base| [0, 2].map(|y| base.map(|[z, x]| [x, y, z])).concat())
            .to_vec(),
        _ => {
            let steps = |x: f64| if x > 0.0 { 2 } else { 0 };
            vec![kind.natural_nodes()[..8].iter().map(|x| x.map(steps)).collect()]
        }
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
