//! Structured meshes of the unit square and cube, of every continuum element, made in code.

use crate::fe::mesh::ElementKind;
use crate::fe::mesh::{ElementBlock, ElementId, Entity, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup};

/// The group of all elements.
pub const BODY: &str = "body";

/// A grid of cells, each one hexahedron, two wedges or six tetrahedra (in the plane one quadrilateral or two
/// triangles), with a node at every half step; those that the kind does not use hang on nothing.
#[derive(Debug, Clone)]
pub struct StructuredMesh {
    /// Nodes row by row along x, then y, then z, m; one block of elements, all in the group [`BODY`].
    pub mesh: Mesh,
    kind: ElementKind,
    /// Half steps along each axis; the third is 0 in the plane.
    half_steps: [usize; 3],
}

impl StructuredMesh {
    /// `cells` along each axis, 1 or more (the third is not used in the plane); `place` maps the unit square or cube to the
    /// body, m. Every node, middle ones too, is placed by it, so that edges curve as the map does.
    pub fn new(kind: ElementKind, cells: [usize; 3], place: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let plane = kind.dimension() == 2;
        let half_steps = [2 * cells[0], 2 * cells[1], if plane { 0 } else { 2 * cells[2] }];
        let [a, b, c] = half_steps.map(|n| n + 1);
        let unit = |i: usize, axis: usize| i as f64 / half_steps[axis].max(1) as f64;
        let nodes: Vec<[f64; 3]> =
            (0..a * b * c).map(|n| place([unit(n % a, 0), unit(n / a % b, 1), unit(n / a / b, 2)])).collect();
        let layers = if plane { 1 } else { cells[2] };
        let mut connectivity = Vec::new();
        for cell in 0..cells[0] * cells[1] * layers {
            let [i, j, k] = [cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]];
            for element in elements_of_a_cell(kind) {
                connectivity.extend(element.map(|[x, y, z]| 2 * i + x + a * (2 * j + y + b * (2 * k + z))));
            }
        }
        Self { mesh: mesh(kind, nodes, connectivity), kind, half_steps }
    }

    /// Half steps of a node from the origin, along each axis.
    pub(crate) fn steps(&self, node: usize) -> [usize; 3] {
        let [a, b, _] = self.half_steps.map(|n| n + 1);
        [node % a, node / a % b, node / a / b]
    }

    /// Whether a node lies on one of the two faces across an axis.
    #[must_use]
    pub fn is_on_face(&self, node: usize, axis: usize) -> bool {
        let step = self.steps(node)[axis];
        step == 0 || step == self.half_steps[axis]
    }

    /// Puts the middle nodes on the straight line between the corners.
    pub fn straighten(&mut self) {
        let (block, nodes) = (&self.mesh.blocks[0], &mut self.mesh.nodes);
        let kind = self.kind;
        for element in block.elements() {
            for (&[a, b], &middle) in kind.middle_edges().iter().zip(&element[kind.corners()..]) {
                let ends = [nodes[element[a]], nodes[element[b]]];
                nodes[middle] = [0, 1, 2].map(|i| f64::midpoint(ends[0][i], ends[1][i]));
            }
        }
    }
}

/// Nodes of the elements of a cell, in half steps from its lowest corner.
fn elements_of_a_cell(kind: ElementKind) -> Vec<impl Iterator<Item = [usize; 3]> + use<>> {
    let corners: Vec<Vec<[usize; 3]>> = match kind.corners() {
        // both triangles and both wedges have the diagonal from the second to the fourth corner
        3 => vec![vec![[0, 0, 0], [2, 0, 0], [0, 2, 0]], vec![[2, 2, 0], [0, 2, 0], [2, 0, 0]]],
        6 => [[[0, 0], [2, 0], [0, 2]], [[2, 2], [0, 2], [2, 0]]]
            .map(|base| [0, 2].map(|z| base.map(|[x, y]| [x, y, z])).concat())
            .to_vec(),
        4 if kind.dimension() == 3 => tetrahedra(),
        _ => {
            let steps = |&x: &f64| if x > 0.0 { 2 } else { 0 };
            let natural = kind.natural_nodes()[..kind.corners()].iter();
            // -1 and 1 to 0 and 2; the third coordinate of a quadrilateral is 0
            vec![natural.map(|x| [steps(&x[0]), steps(&x[1]), steps(&x[2])]).collect()]
        }
    };
    let with_middles = move |corners: Vec<[usize; 3]>| {
        let middle = |[a, b]: [usize; 2]| [0, 1, 2].map(|i| usize::midpoint(corners[a][i], corners[b][i]));
        let middles: Vec<_> = kind.middle_edges().iter().map(|&edge| middle(edge)).collect();
        corners.into_iter().chain(middles)
    };
    corners.into_iter().map(with_middles).collect()
}

/// Six tetrahedra about the diagonal of a cell, which fit those of the next cells (Kuhn).
fn tetrahedra() -> Vec<Vec<[usize; 3]>> {
    const PATHS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
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
    PATHS.into_iter().enumerate().map(along).collect()
}

fn mesh(kind: ElementKind, nodes: Vec<[f64; 3]>, connectivity: Vec<usize>) -> Mesh {
    let count = connectivity.len() / kind.nodes();
    let dimension = kind.dimension();
    let entity = Entity { dimension, tag: 1 };
    Mesh {
        node_tags: (1..=nodes.len() as u64).collect(),
        groups: vec![PhysicalGroup {
            name: BODY.to_owned(),
            dimension,
            tag: 1,
            nodes: (0..nodes.len()).collect(),
            elements: (0..count).map(|index| ElementId { block: 0, index }).collect(),
        }],
        blocks: vec![ElementBlock { kind, tags: (1..=count as u64).collect(), connectivity, entity }],
        nodes,
        format: MshFormat { version: MshVersion::V41, binary: false },
        notes: MeshNotes::default(),
        source: "structured grid".into(),
    }
}
