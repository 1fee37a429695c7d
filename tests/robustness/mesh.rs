//! Meshes that are made here, and moved, mirrored, split and numbered anew.

use std::fmt::Write as _;

use super::Dice;

/// An element: gmsh's type, the place of its group and its nodes from 0.
#[derive(Clone)]
struct Element {
    kind: usize,
    group: usize,
    nodes: Vec<usize>,
}

/// Nodes in metres, elements and groups.
#[derive(Clone)]
pub struct Mesh {
    pub solid: bool,
    /// What a metre is in the file's unit.
    pub metre: f64,
    nodes: Vec<[f64; 3]>,
    elements: Vec<Element>,
    /// Dimension and name of each group.
    groups: Vec<(usize, String)>,
    /// The number of each node in the file.
    tags: Vec<usize>,
}

/// A turn and then a shift.
pub struct Motion {
    rows: [[f64; 3]; 3],
    shift: [f64; 3],
}

impl Motion {
    pub fn none() -> Self {
        Self { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] }
    }

    /// By odd angles, within the plane of a plane mesh.
    pub fn turned(solid: bool) -> Self {
        Self::by(solid, [0.7, 1.9], [0.011, -0.023, 0.037])
    }

    /// By any angles, by up to a hundred times the annulus.
    pub fn at_random(solid: bool, dice: &mut Dice) -> Self {
        let mut number = |most: f64| most * dice.fraction();
        let angles = [0; 2].map(|_| number(std::f64::consts::TAU));
        Self::by(solid, angles, [0; 3].map(|_| number(1.0)))
    }

    fn by(solid: bool, [first, second]: [f64; 2], mut shift: [f64; 3]) -> Self {
        let (sin, cos) = first.sin_cos();
        let about_z = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        if !solid {
            shift[2] = 0.0;
            return Self { rows: about_z, shift };
        }
        let (sin, cos) = second.sin_cos();
        let about_x = [[1.0, 0.0, 0.0], [0.0, cos, -sin], [0.0, sin, cos]];
        let entry = |i: usize, j: usize| (0..3).map(|k| about_x[i][k] * about_z[k][j]).sum();
        Self { rows: [0, 1, 2].map(|i| [0, 1, 2].map(|j| entry(i, j))), shift }
    }

    pub fn direction(&self, along: [f64; 3]) -> [f64; 3] {
        let row = |row: &[f64; 3]| row.iter().zip(along).map(|(a, x)| a * x).sum();
        [row(&self.rows[0]), row(&self.rows[1]), row(&self.rows[2])]
    }

    pub fn place(&self, at: [f64; 3]) -> [f64; 3] {
        let turned = self.direction(at);
        [0, 1, 2].map(|i| turned[i] + self.shift[i])
    }
}

const AROUND: usize = 16;
const RADII: [f64; 3] = [6e-3, 7.4e-3, 9e-3];
const HEIGHTS: [f64; 3] = [-2e-3, 0.3e-3, 2e-3];

/// An annulus of two parts, with the groups `bore`, and `foot` on an eighth of its outside; of Quad4, or of Hex8.
pub fn annulus(solid: bool) -> Mesh {
    let heights = if solid { &HEIGHTS[..] } else { &[0.0] };
    let layers = heights.len();
    let number = |around: usize, radius: usize, layer: usize| around % AROUND + AROUND * (radius + RADII.len() * layer);
    let mut nodes = Vec::new();
    for &z in heights {
        for radius in RADII {
            for around in 0..AROUND {
                let (sin, cos) = (std::f64::consts::TAU * around as f64 / AROUND as f64).sin_cos();
                nodes.push([radius * cos, radius * sin, z]);
            }
        }
    }
    let groups = [(2, "left"), (2, "right"), (1, "bore"), (1, "foot")];
    let groups = groups.map(|(dimension, name)| (dimension + usize::from(solid), name.to_owned()));
    let mut elements = Vec::new();
    for layer in 0..(layers - 1).max(1) {
        for around in 0..AROUND {
            let edge = |radius: usize| {
                let ends = [around, around + 1];
                let below = ends.map(|end| number(end, radius, layer));
                match solid {
                    true => {
                        let above = ends.map(|end| number(end, radius, layer + 1));
                        vec![below[0], below[1], above[1], above[0]]
                    }
                    false => below.to_vec(),
                }
            };
            for radius in 0..2 {
                let face = |layer: usize| {
                    [
                        number(around, radius, layer),
                        number(around, radius + 1, layer),
                        number(around + 1, radius + 1, layer),
                        number(around + 1, radius, layer),
                    ]
                };
                let group = usize::from(!(5..13).contains(&around));
                let (kind, nodes) = match solid {
                    true => (5, [face(layer), face(layer + 1)].concat()),
                    false => (3, face(layer).to_vec()),
                };
                elements.push(Element { kind, group, nodes });
            }
            let kind = if solid { 3 } else { 1 };
            let mut boundary = |group, nodes| elements.push(Element { kind, group, nodes });
            boundary(2, edge(0));
            if (11..13).contains(&around) {
                boundary(3, edge(2));
            }
        }
    }
    Mesh { solid, metre: 1.0, tags: (1..=nodes.len()).collect(), nodes, elements, groups: groups.to_vec() }
}

/// The same element begun at another corner.
fn turned(element: &mut Element) {
    match element.kind {
        5 => {
            element.nodes[..4].rotate_left(1);
            element.nodes[4..].rotate_left(1);
        }
        3 => element.nodes.rotate_left(1),
        _ => {}
    }
}

impl Mesh {
    /// Numbers nodes anew with gaps, begins elements at other corners and lists both, and groups, in another order.
    pub fn shuffle(&mut self, dice: &mut Dice) {
        shuffle(&mut self.elements, dice);
        for element in &mut self.elements {
            (0..dice.below(4)).for_each(|_| turned(element));
        }
        for tag in &mut self.tags {
            *tag *= 3;
        }
        shuffle(&mut self.tags, dice);
        // places of nodes too
        let mut order: Vec<usize> = (0..self.nodes.len()).collect();
        shuffle(&mut order, dice);
        self.nodes = order.iter().map(|&old| self.nodes[old]).collect();
        let mut new = vec![0; order.len()];
        for (place, &old) in order.iter().enumerate() {
            new[old] = place;
        }
        let nodes = self.elements.iter_mut().flat_map(|element| &mut element.nodes);
        nodes.for_each(|node| *node = new[*node]);
    }

    /// Moves the nodes between bore and outside by up to a twentieth of a millimetre, so that nothing is even.
    pub fn scatter(&mut self, dice: &mut Dice) {
        for node in &mut self.nodes {
            if (node[0].hypot(node[1]) / RADII[1] - 1.0).abs() < 0.01 {
                let moved = [0, 1].map(|axis| node[axis] + 1e-4 * (dice.fraction() - 0.5));
                node[..2].copy_from_slice(&moved);
            }
        }
    }

    /// Turns left into right; elements keep their sense of turning.
    pub fn mirror(&mut self) {
        for node in &mut self.nodes {
            node[1] = -node[1];
        }
        for element in &mut self.elements {
            match element.kind {
                5 => {
                    element.nodes[..4].reverse();
                    element.nodes[4..].reverse();
                }
                _ => element.nodes.reverse(),
            }
        }
    }

    /// Gives every second element of a group to a new one.
    pub fn split(&mut self, group: &str, rest: &str) {
        let place = self.groups.iter().position(|(_, name)| name == group);
        let place = place.unwrap();
        self.groups.push((self.groups[place].0, rest.to_owned()));
        let own = self.elements.iter_mut().filter(|element| element.group == place);
        for element in own.skip(1).step_by(2) {
            element.group = self.groups.len() - 1;
        }
    }

    /// MSH 2.2, with nodes at other places.
    pub fn text(&self, place: &dyn Fn([f64; 3]) -> [f64; 3]) -> String {
        let mut text = format!("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n", self.groups.len());
        for (group, (dimension, name)) in (1..).zip(&self.groups) {
            writeln!(text, "{dimension} {group} \"{name}\"").unwrap();
        }
        writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", self.nodes.len()).unwrap();
        for (node, tag) in self.nodes.iter().zip(&self.tags) {
            let [x, y, z] = place(*node).map(|x| x * self.metre);
            writeln!(text, "{tag} {x:e} {y:e} {z:e}").unwrap();
        }
        writeln!(text, "$EndNodes\n$Elements\n{}", self.elements.len()).unwrap();
        for (tag, element) in (1..).zip(&self.elements) {
            let Element { kind, group, nodes } = element;
            let group = group + 1;
            write!(text, "{tag} {kind} 2 {group} {group}").unwrap();
            for &node in nodes {
                write!(text, " {}", self.tags[node]).unwrap();
            }
            text.push('\n');
        }
        text.push_str("$EndElements\n");
        text
    }
}

fn shuffle<T>(items: &mut [T], dice: &mut Dice) {
    for last in (1..items.len()).rev() {
        items.swap(last, dice.below(last + 1));
    }
}
