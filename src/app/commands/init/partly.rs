//! Groups of which a part alone is a round hole: a bore that was named together with its shoulder.
//!
//! Faces that meet at a small angle are one patch; the largest patch that is a hole says the cylinder, and every face of the group that
//! lies on it counts.

use crate::fe::mesh::cylinder::{Cylinder, Facet, TOLERANCE, fit};
use nalgebra::Vector3;
use std::collections::HashMap;

/// Cosine of the angle between two faces of one patch, 43 degrees: those of a bore with ten faces round the turn meet at 36, a chamfer
/// at 45.
const SMOOTH: f64 = 0.73;

/// Cosine of the angle between a normal and the axis from which on a face lies across the axis, and the share of the rest that does.
const ACROSS: f64 = 0.95;
const MOST: f64 = 0.95;

/// A group of which a part is a hole.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PartlyHole {
    /// The cylinder of that part.
    pub cylinder: Cylinder,
    /// Share of the group's area (of its length in a plane mesh) that lies on it, 0 to 1.
    pub share: f64,
    /// Whether the rest is flat and lies across the axis.
    pub shoulder: bool,
}

/// The hole of a group that is none as a whole; `corners` are the nodes at each facet's corners.
pub(crate) fn partly_hole(facets: &[Facet], corners: &[Vec<usize>]) -> Option<PartlyHole> {
    let sizes: Vec<f64> = facets.iter().map(|facet| facet.area().norm()).collect();
    let total: f64 = sizes.iter().sum();
    let mut best: Option<(f64, Cylinder)> = None;
    for patch in patches(facets, corners) {
        let area: f64 = patch.iter().map(|&at| sizes[at]).sum();
        if best.as_ref().is_some_and(|(largest, _)| *largest >= area) {
            continue;
        }
        let own: Vec<Facet> = patch.iter().map(|&at| facets[at].clone()).collect();
        let nodes: Vec<[f64; 3]> = own.iter().flat_map(|facet| facet.nodes.clone()).collect();
        let found = fit(&own, &nodes).filter(|found| found.hole == Some(true) && found.is_round());
        best = found.map(|found| (area, found)).or(best);
    }
    let (_, cylinder) = best?;
    let (axis, centre) = (Vector3::from(cylinder.axis), Vector3::from(cylinder.centre));
    let on = |corner: &[f64; 3]| {
        let arm = Vector3::from(*corner) - centre;
        ((arm - axis * axis.dot(&arm)).norm() - cylinder.radius).abs() <= TOLERANCE * cylinder.radius
    };
    let along = |facet: &Facet| normal(facet).is_some_and(|normal| normal.dot(&axis).abs() > ACROSS);
    let (mut curved, mut flat) = (0.0, 0.0);
    for (facet, size) in facets.iter().zip(&sizes) {
        let across = along(facet);
        if facet.nodes.iter().all(on) && !across {
            curved += size;
        } else if across {
            flat += size;
        }
    }
    Some(PartlyHole { cylinder, share: curved / total, shoulder: flat > MOST * (total - curved) })
}

/// Unit normal; `None` for a face without area.
fn normal(facet: &Facet) -> Option<Vector3<f64>> {
    facet.area().try_normalize(f64::MIN_POSITIVE)
}

/// Facets by their places, those together that meet smoothly at an edge (curves: at a node).
fn patches(facets: &[Facet], corners: &[Vec<usize>]) -> Vec<Vec<usize>> {
    let mut at_edge: HashMap<[usize; 2], Vec<usize>> = HashMap::new();
    for (place, nodes) in corners.iter().enumerate() {
        for (k, &node) in nodes.iter().enumerate() {
            let next = nodes[(k + 1) % nodes.len()];
            let edge = if nodes.len() == 2 { [node, node] } else { [node.min(next), node.max(next)] };
            at_edge.entry(edge).or_default().push(place);
        }
    }
    let normals: Vec<Option<Vector3<f64>>> = facets.iter().map(normal).collect();
    let mut neighbours = vec![Vec::new(); facets.len()];
    for places in at_edge.values() {
        for &a in places {
            for &b in places.iter().filter(|&&b| b != a) {
                // neighbours in a group may be turned against each other
                if normals[a].zip(normals[b]).is_some_and(|(a, b)| a.dot(&b).abs() > SMOOTH) {
                    neighbours[a].push(b);
                }
            }
        }
    }
    let mut seen = vec![false; facets.len()];
    let mut found = Vec::new();
    for first in 0..facets.len() {
        let (mut open, mut patch) = (vec![first], Vec::new());
        while let Some(place) = open.pop() {
            if !std::mem::replace(&mut seen[place], true) {
                patch.push(place);
                open.extend(&neighbours[place]);
            }
        }
        if !patch.is_empty() {
            patch.sort_unstable();
            found.push(patch);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::partly_hole;
    use crate::fe::mesh::ElementKind;
    use crate::fe::mesh::cylinder::Facet;
    use std::f64::consts::{PI, TAU};

    /// Facets, and the nodes at their corners, of a bore of radius 23.5 and length 14, and of a shoulder beside it down to radius 20.
    fn bore_and_shoulder(kind: ElementKind, round: usize) -> (Vec<Facet>, Vec<Vec<usize>>) {
        let at = |radius: f64, step: f64, z: f64| {
            let angle = TAU * step / round as f64;
            [radius * angle.cos(), radius * angle.sin(), z]
        };
        let (mut facets, mut corners) = (Vec::new(), Vec::new());
        for (ring, [(r, z), (s, t)]) in
            [[(23.5, 0.0), (23.5, 14.0)], [(23.5, 14.0), (20.0, 14.0)]].into_iter().enumerate()
        {
            for k in 0..round {
                let (from, half, to) = (k as f64, k as f64 + 0.5, k as f64 + 1.0);
                let mut nodes = vec![at(r, from, z), at(r, to, z), at(s, to, t), at(s, from, t)];
                let (middle, height) = (0.5 * (r + s), 0.5 * (z + t));
                nodes.extend([at(r, half, z), at(middle, to, height), at(s, half, t), at(middle, from, height)]);
                nodes.truncate(kind.nodes());
                // outside of the bore, behind the shoulder
                let inside = if ring == 0 { at(1.1 * r, half, height) } else { at(middle, half, 15.0) };
                facets.push(Facet { kind, nodes, inside: Some(inside) });
                let next = (k + 1) % round;
                corners.push(
                    [(ring, k), (ring, next), (ring + 1, next), (ring + 1, k)].map(|(row, k)| row * round + k).to_vec(),
                );
            }
        }
        (facets, corners)
    }

    #[test]
    fn a_bore_named_with_its_shoulder_is_told() {
        let (facets, corners) = bore_and_shoulder(ElementKind::Quad4, 24);
        let found = partly_hole(&facets, &corners).unwrap();
        assert!((found.cylinder.radius - 23.5).abs() < 1e-9);
        assert!(found.shoulder);
        // chords of 24 sides: 2 n R sin(pi / n) L beside n sin(2 pi / n) / 2 (R^2 - r^2)
        let (bore, shoulder) =
            (2.0 * 24.0 * 23.5 * (PI / 24.0).sin() * 14.0, 12.0 * (TAU / 24.0).sin() * (23.5 * 23.5 - 400.0));
        assert!((found.share - bore / (bore + shoulder)).abs() < 1e-9, "{}", found.share);
        assert!(partly_hole(&facets[24..], &corners[24..]).is_none());
    }

    /// Six curved faces meet at 60 degrees: each tells the cylinder.
    #[test]
    fn so_is_one_of_six_curved_faces_a_turn() {
        let (facets, corners) = bore_and_shoulder(ElementKind::Quad8, 6);
        let found = partly_hole(&facets, &corners).unwrap();
        assert!((found.cylinder.radius - 23.5).abs() < 1e-9 && found.shoulder, "{found:?}");
    }
}
