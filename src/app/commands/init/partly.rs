//! Groups of which a part alone is a round hole: a bore that was named together with its shoulder.
//!
//! Faces that meet at a small angle are one patch; the largest patch that is a hole says the cylinder, and every face of the group that
//! lies on it counts.

use crate::fe::mesh::cylinder::{Cylinder, Facet, TOLERANCE, area_vector, fit};
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
    let sizes: Vec<f64> = facets.iter().map(|facet| area_vector(&facet.corners).norm()).collect();
    let total: f64 = sizes.iter().sum();
    let mut best: Option<(f64, Cylinder)> = None;
    for patch in patches(facets, corners) {
        let area: f64 = patch.iter().map(|&at| sizes[at]).sum();
        if best.as_ref().is_some_and(|(largest, _)| *largest >= area) {
            continue;
        }
        let own: Vec<Facet> = patch.iter().map(|&at| facets[at].clone()).collect();
        let nodes: Vec<[f64; 3]> = own.iter().flat_map(|facet| facet.corners.clone()).collect();
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
        if facet.corners.iter().all(on) && !across {
            curved += size;
        } else if across {
            flat += size;
        }
    }
    Some(PartlyHole { cylinder, share: curved / total, shoulder: flat > MOST * (total - curved) })
}

/// Unit normal; `None` for a face without area.
fn normal(facet: &Facet) -> Option<Vector3<f64>> {
    area_vector(&facet.corners).try_normalize(f64::MIN_POSITIVE)
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
    use crate::fe::mesh::cylinder::Facet;
    use std::f64::consts::{PI, TAU};

    /// A bore of radius 23.5 and length 14, and a shoulder beside it down to radius 20.
    #[test]
    fn a_bore_named_with_its_shoulder_is_told() {
        let round = 24;
        let ring = |radius: f64, z: f64| -> Vec<[f64; 3]> {
            (0..round)
                .map(|k| TAU * f64::from(k) / f64::from(round))
                .map(|a| [radius * a.cos(), radius * a.sin(), z])
                .collect()
        };
        let nodes = [ring(23.5, 0.0), ring(23.5, 14.0), ring(20.0, 14.0)].concat();
        let n = round as usize;
        let (mut facets, mut corners) = (Vec::new(), Vec::new());
        for (low, inwards) in [(0, 1.5), (n, 0.0)] {
            for k in 0..n {
                let next = (k + 1) % n;
                let own = vec![low + k, low + next, low + n + next, low + n + k];
                let at: Vec<[f64; 3]> = own.iter().map(|&node| nodes[node]).collect();
                let mut inside = [0.0; 3];
                for axis in 0..3 {
                    inside[axis] = at.iter().map(|corner| corner[axis] / 4.0).sum();
                }
                // outside of the bore, behind the shoulder
                let scale = 1.0 + inwards * 0.1;
                inside = [scale * inside[0], scale * inside[1], inside[2] + if inwards > 0.0 { 0.0 } else { 1.0 }];
                facets.push(Facet { corners: at, inside: Some(inside) });
                corners.push(own);
            }
        }
        let found = partly_hole(&facets, &corners).unwrap();
        assert!((found.cylinder.radius - 23.5).abs() < 1e-9);
        assert!(found.shoulder);
        // chords of 24 sides: 2 n R sin(pi / n) L beside n sin(2 pi / n) / 2 (R^2 - r^2)
        let (bore, shoulder) =
            (2.0 * 24.0 * 23.5 * (PI / 24.0).sin() * 14.0, 12.0 * (TAU / 24.0).sin() * (23.5 * 23.5 - 400.0));
        assert!((found.share - bore / (bore + shoulder)).abs() < 1e-9, "{}", found.share);
        assert!(partly_hole(&facets[n..], &corners[n..]).is_none());
    }
}
