//! Where an accelerometer may stand: on the outside of the housing, above the bearing.

use nalgebra::Vector3;

use super::bore::Rim;
use crate::fe::mesh::Mesh;
use crate::fe::mesh::cylinder::{Facet, area_vector};

/// Cosine of the angle between a face and the direction of the sensor up to which it may stand there.
const FACING: f64 = 0.7;

/// How far beside the axis, over the bore's radius.
const BESIDE: f64 = 0.35;

/// Looks from `centre` along `up` (unit vectors; lengths in the mesh's unit): the corner of the first face beyond `radius` that
/// faces that way, beside the line and along `axis` by no more than a part of the radius. Without one the highest corner of all.
pub(crate) fn spot(
    mesh: &Mesh,
    rim: &Rim,
    centre: [f64; 3],
    radius: f64,
    [up, axis]: [[f64; 3]; 2],
) -> Option<[f64; 3]> {
    let (centre, up, axis) = (Vector3::from(centre), Vector3::from(up), Vector3::from(axis));
    let side = up.cross(&axis);
    let height = |point: &Vector3<f64>| up.dot(&(point - centre));
    let beside = |point: &Vector3<f64>| {
        let arm = point - centre;
        side.dot(&arm).hypot(axis.dot(&arm))
    };
    let mut best: Option<(f64, Vector3<f64>)> = None;
    let mut highest: Option<Vector3<f64>> = None;
    for facet in rim.facets(mesh) {
        let corners: Vec<Vector3<f64>> = facet.corners.iter().map(|&c| Vector3::from(c)).collect();
        for corner in &corners {
            if highest.is_none_or(|other| height(corner) > height(&other)) {
                highest = Some(*corner);
            }
        }
        if outwards(&facet, &corners).is_none_or(|normal| normal.dot(&up) < FACING) {
            continue;
        }
        let near = corners.iter().min_by(|a, b| beside(a).total_cmp(&beside(b)));
        let Some(corner) = near.filter(|corner| height(corner) > 1.001 * radius) else {
            continue;
        };
        let off = beside(corner);
        // the nearest face first, then the corner nearest to the line
        let cost = height(corner) + off;
        if off <= BESIDE * radius && best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, *corner));
        }
    }
    best.map(|(_, corner)| corner).or(highest).map(Into::into)
}

/// Unit normal of a face away from its element; `None` for a face without area.
fn outwards(facet: &Facet, corners: &[Vector3<f64>]) -> Option<Vector3<f64>> {
    let normal = match corners {
        [a, b] => {
            let along = b - a;
            Vector3::new(along.y, -along.x, 0.0)
        }
        _ => area_vector(&facet.corners),
    };
    let normal = normal.try_normalize(f64::MIN_POSITIVE)?;
    let inside = Vector3::from(facet.inside?);
    let out = normal.dot(&(corners[0] - inside));
    Some(if out < 0.0 { -normal } else { normal })
}
