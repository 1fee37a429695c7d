//! Meshes of a tube or a part of one, of hexahedra, anywhere in space: MSH 2.2 as text.

use std::fmt::Write as _;

/// A tube with the groups "housing", "bore" (its inside) and "base" (a part of its outside, below). Lengths in the mesh's unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Tube {
    pub inner: f64,
    pub outer: f64,
    pub length: f64,
    /// First and last angle in degrees; 0 to 360 closes it.
    pub from: f64,
    pub to: f64,
    /// Largest error of a node on the bore along the radius.
    pub noise: f64,
    /// Directions of the tube's own x, y and z.
    pub axes: [[f64; 3]; 3],
    pub centre: [f64; 3],
}

impl Default for Tube {
    fn default() -> Self {
        Self {
            inner: 6.0,
            outer: 9.0,
            length: 4.0,
            from: 0.0,
            to: 360.0,
            noise: 0.0,
            axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            centre: [0.0; 3],
        }
    }
}

/// Elements round a turn, from bore to outside, and along.
const ROUND: usize = 36;
const THICK: usize = 2;
const LONG: usize = 3;

impl Tube {
    pub fn msh(&self) -> String {
        let share = (self.to - self.from) / 360.0;
        let closed = share > 0.999;
        let round = ((ROUND as f64) * share).round() as usize;
        let columns = if closed { round } else { round + 1 };
        let mut state = 2024_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            2.0 * f64::from(state) / f64::from(u32::MAX) - 1.0
        };
        let node = |step: usize, layer: usize, row: usize| 1 + (step % columns) + columns * (layer + (THICK + 1) * row);
        let mut nodes = String::new();
        for row in 0..=LONG {
            for layer in 0..=THICK {
                for step in 0..columns {
                    let angle = (self.from + (self.to - self.from) * step as f64 / round as f64).to_radians();
                    let mut radius = self.inner + (self.outer - self.inner) * layer as f64 / THICK as f64;
                    if layer == 0 {
                        radius += self.noise * random();
                    }
                    let along = self.length * (row as f64 / LONG as f64 - 0.5);
                    let own = [radius * angle.cos(), radius * angle.sin(), along];
                    let at = [0, 1, 2]
                        .map(|k| self.centre[k] + (0..3).map(|axis| own[axis] * self.axes[axis][k]).sum::<f64>());
                    let _ = writeln!(nodes, "{} {:e} {:e} {:e}", node(step, layer, row), at[0], at[1], at[2]);
                }
            }
        }
        let mut elements = Vec::new();
        for row in 0..LONG {
            for step in 0..round {
                let quad = |layer: usize| {
                    [(step, row), (step + 1, row), (step + 1, row + 1), (step, row + 1)]
                        .map(|(step, row)| node(step, layer, row))
                };
                elements.push((3, 2, 2, quad(0).to_vec()));
                let middle = self.from + (self.to - self.from) * (step as f64 + 0.5) / round as f64;
                if (225.0..315.0).contains(&middle) {
                    elements.push((3, 3, 3, quad(THICK).to_vec()));
                }
                for layer in 0..THICK {
                    let corners = |row: usize| {
                        [(step, layer), (step, layer + 1), (step + 1, layer + 1), (step + 1, layer)]
                            .map(|(step, layer)| node(step, layer, row))
                    };
                    // positive volume: radius, angle, axis are right-handed
                    elements.push((5, 1, 1, [corners(row), corners(row + 1)].concat()));
                }
            }
        }
        let mut lines = String::new();
        for (place, (kind, group, entity, nodes)) in elements.iter().enumerate() {
            let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
            let _ = writeln!(lines, "{} {kind} 2 {group} {entity} {}", place + 1, nodes.join(" "));
        }
        let count = columns * (THICK + 1) * (LONG + 1);
        format!(
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"housing\"\n2 2 \"bore\"\n2 3 \"base\"\n$EndPhysicalNames\n\
             $Nodes\n{count}\n{nodes}$EndNodes\n$Elements\n{}\n{lines}$EndElements\n",
            elements.len()
        )
    }
}
