//! The shear load over the end face, consistent.

use super::beam::HEIGHT;
use plummer::fe::element::continuum::{QuadratureRule, measure, shape_values};
use plummer::fe::mesh::ElementKind;
use plummer::fe::mesh::Mesh;
use std::error::Error;

/// Force along z of every node: `int N tau dA`, `tau = 1 - (2 z / h)^2`.
pub fn end_load(mesh: &Mesh, kind: ElementKind, length: f64) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut load = vec![0.0; mesh.nodes.len()];
    let end = length * (1.0 - 1e-9);
    for element in mesh.blocks[0].elements() {
        let on_end = |node: &&usize| mesh.nodes[**node][0] > end;
        let mut corners: Vec<usize> = element[..kind.corners()].iter().filter(on_end).copied().collect();
        let face = match (corners.len(), kind.middle_edges().is_empty()) {
            (3, true) => ElementKind::Tri3,
            (3, false) => ElementKind::Tri6,
            (4, true) => ElementKind::Quad4,
            (4, false) => ElementKind::Quad8,
            _ => continue,
        };
        let flat = |node: usize| [mesh.nodes[node][1], mesh.nodes[node][2], 0.0];
        let count = corners.len() as f64;
        let centre = [0, 1].map(|i| corners.iter().map(|&n| flat(n)[i]).sum::<f64>() / count);
        let angle = |node: &usize| {
            let [y, z, _] = flat(*node);
            (z - centre[1]).atan2(y - centre[0])
        };
        corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        let mut nodes = corners.clone();
        for &[a, b] in face.middle_edges() {
            let ends = [corners[a], corners[b]];
            let place = |node: usize| element.iter().position(|&other| other == node);
            let same = |edge: &[usize; 2]| ends.iter().all(|&n| edge.iter().any(|&e| Some(e) == place(n)));
            let edge = kind.middle_edges().iter().position(same).ok_or("an edge of the face")?;
            nodes.push(element[kind.corners() + edge]);
        }
        let coords: Vec<_> = nodes.iter().map(|&node| flat(node)).collect();
        let rule = if corners.len() == 3 { QuadratureRule::Triangle12 } else { QuadratureRule::Square4 };
        let natural: f64 = rule.points().iter().map(|point| point.weight).sum();
        // triangles and rectangles: the Jacobian is constant
        let jacobian = measure(face, &coords)? / natural;
        for point in rule.points() {
            let values = shape_values(face, point.natural);
            let z: f64 = coords.iter().zip(values).map(|(x, value)| x[1] * value).sum();
            let shear = 1.0 - (2.0 * z / HEIGHT).powi(2);
            for (&node, value) in nodes.iter().zip(values) {
                load[node] += point.weight * jacobian * shear * value;
            }
        }
    }
    Ok(load)
}
