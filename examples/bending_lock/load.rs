//! The shear load over the end face, consistent.

use super::beam::HEIGHT;
use plummer::fe::element::continuum::{QuadratureRule, measure, shape_values};
use plummer::fe::mesh::{ElementKind, Face, Mesh};
use std::error::Error;

/// Force along z of every node: `int N tau dA`, `tau = 1 - (2 z / h)^2`.
pub fn end_load(mesh: &Mesh, kind: ElementKind, length: f64) -> Result<Vec<f64>, Box<dyn Error>> {
    let mut load = vec![0.0; mesh.nodes.len()];
    let end = length * (1.0 - 1e-9);
    let on_end = |node: &usize| mesh.nodes[*node][0] > end;
    let faces = mesh.blocks[0].elements().flat_map(|element| {
        let nodes_of = |face: &Face| face.nodes.iter().map(|&local| element[local]).collect::<Vec<usize>>();
        kind.faces().iter().map(move |face| (face.kind, nodes_of(face)))
    });
    for (face, nodes) in faces.filter(|(_, nodes)| nodes.iter().all(on_end)) {
        let coords: Vec<_> = nodes.iter().map(|&node| [mesh.nodes[node][1], mesh.nodes[node][2], 0.0]).collect();
        let rule = if face.corners() == 3 { QuadratureRule::Triangle12 } else { QuadratureRule::Square4 };
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
