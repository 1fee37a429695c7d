//! Structured meshes of the unit square and cube, of every continuum element, made in code.

use crate::fe::mesh::ElementKind;
use crate::fe::mesh::{ElementBlock, ElementId, Entity, Face, Mesh, MeshNotes, MshFormat, MshVersion, PhysicalGroup};

/// The group of all elements.
pub const BODY: &str = "body";

/// A grid of cells, each one hexahedron, two wedges, six tetrahedra or six pyramids about its centre (in the plane one
/// quadrilateral or two triangles), with a node at every half step, of pyramids at every quarter; those that the kind does
/// not use hang on nothing.
#[derive(Debug, Clone)]
pub struct StructuredMesh {
    /// Nodes row by row along x, then y, then z, m; one block of elements, all in the group [`BODY`].
    pub mesh: Mesh,
    kind: ElementKind,
    /// Steps along each axis; the third is 0 in the plane.
    steps: [usize; 3],
}

impl StructuredMesh {
    /// `cells` along each axis, 1 or more (the third is not used in the plane); `place` maps the unit square or cube to the
    /// body, m. Every node, middle ones too, is placed by it, so that edges curve as the map does.
    pub fn new(kind: ElementKind, cells: [usize; 3], place: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let plane = kind.dimension() == 2;
        let side = steps_of_a_cell(kind);
        let steps = [side * cells[0], side * cells[1], if plane { 0 } else { side * cells[2] }];
        let [a, b, c] = steps.map(|n| n + 1);
        let unit = |i: usize, axis: usize| i as f64 / steps[axis].max(1) as f64;
        let nodes: Vec<[f64; 3]> =
            (0..a * b * c).map(|n| place([unit(n % a, 0), unit(n / a % b, 1), unit(n / a / b, 2)])).collect();
        let layers = if plane { 1 } else { cells[2] };
        let mut connectivity = Vec::new();
        for cell in 0..cells[0] * cells[1] * layers {
            let [i, j, k] = [cell % cells[0], cell / cells[0] % cells[1], cell / cells[0] / cells[1]];
            for element in elements_of_a_cell(kind) {
                connectivity.extend(element.map(|[x, y, z]| side * i + x + a * (side * j + y + b * (side * k + z))));
            }
        }
        Self { mesh: mesh(kind, nodes, connectivity), kind, steps }
    }

    /// Whether a node lies on one of the two faces across an axis.
    #[must_use]
    pub fn is_on_face(&self, node: usize, axis: usize) -> bool {
        let [a, b, _] = self.steps.map(|n| n + 1);
        let step = [node % a, node / a % b, node / a / b][axis];
        step == 0 || step == self.steps[axis]
    }

    /// Puts the middle nodes on the straight line between the corners, and those of centres in the mean of theirs.
    pub fn straighten(&mut self) {
        let (block, nodes) = (&self.mesh.blocks[0], &mut self.mesh.nodes);
        let kind = self.kind;
        for element in block.elements() {
            for (around, &middle) in kind.beyond_corners().zip(&element[kind.corners()..]) {
                let mean = |i: usize| around.iter().map(|&at| nodes[element[at]][i]).sum::<f64>() / around.len() as f64;
                nodes[middle] = [0, 1, 2].map(mean);
            }
        }
    }
}

/// Steps between the nodes of a cell along an edge of it: the edges of pyramids end in its centre.
fn steps_of_a_cell(kind: ElementKind) -> usize {
    if kind.dimension() == 3 && kind.corners() == 5 { 4 } else { 2 }
}

/// Nodes of the elements of a cell, in steps from its lowest corner.
fn elements_of_a_cell(kind: ElementKind) -> Vec<impl Iterator<Item = [usize; 3]> + use<>> {
    let whole = |shape: ElementKind| -> Vec<[usize; 3]> {
        let far = steps_of_a_cell(kind);
        let steps = |&x: &f64| if x > 0.0 { far } else { 0 };
        // -1 and 1 to the ends; the third coordinate of a quadrilateral is 0
        shape.natural_nodes()[..shape.corners()].iter().map(|x| [0, 1, 2].map(|i| steps(&x[i]))).collect()
    };
    let corners: Vec<Vec<[usize; 3]>> = match kind.corners() {
        // both triangles and both wedges have the diagonal from the second to the fourth corner
        3 => vec![vec![[0, 0, 0], [2, 0, 0], [0, 2, 0]], vec![[2, 2, 0], [0, 2, 0], [2, 0, 0]]],
        6 => [[[0, 0], [2, 0], [0, 2]], [[2, 2], [0, 2], [2, 0]]]
            .map(|base| [0, 2].map(|z| base.map(|[x, y]| [x, y, z])).concat())
            .to_vec(),
        4 if kind.dimension() == 3 => tetrahedra(),
        5 => {
            let cell = whole(ElementKind::Hex8);
            // each face as seen from the centre, which is the apex
            let base = |face: &Face| face.nodes.iter().rev().map(|&corner| cell[corner]).chain([[2; 3]]).collect();
            ElementKind::Hex8.faces().iter().map(base).collect()
        }
        _ => vec![whole(kind)],
    };
    let with_middles = move |corners: Vec<[usize; 3]>| {
        let mean =
            |around: &[usize]| [0, 1, 2].map(|i| around.iter().map(|&at| corners[at][i]).sum::<usize>() / around.len());
        let middles: Vec<_> = kind.beyond_corners().map(mean).collect();
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
