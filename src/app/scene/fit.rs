//! Whether bearing, ring and bore fit into each other as those of any bearing do, a sentence each where they do not.
//!
//! From the axis outwards: balls between the races, the outer race in the innermost section of the ring, all sections in the bore;
//! in the place of a ring, the bore's centre node.
//! What cannot be is refused where the case is read, or with the bore (`super::ring`).

use super::ring::{BoreExtent, layer, metres};
use crate::app::case::{self, Case};
use crate::app::error::ComputeError;
use crate::fe::mesh::Mesh;
use crate::fe::model::HousingModel;

/// Distance of the outer race from the material of its ring that is told, over the section's height: rectangles miss
/// the faces of grooved sections.
const APART: f64 = 0.5;

/// Wall between groove and bore over the ball's diameter that is told. Those of the catalogue have 0.28 to 0.45, the bearing of Tadina
/// and Boltezar (2011) has 0.62. Other bearings, none of which the catalogue is from, have 0.20 to 0.35: SKF's 6200 to 6306 in a table of
/// 13 for vibration analysis (GitHub), 6203 and 6205 of the CWRU bench, the 6305 of minzhun/ISO16281 (11.1 mm on 43.5 mm in 62 mm).
const WALL: f64 = 1.25;

/// Play or preload over the ball's radius that is told. The widest clearance that is sold, C5 of ISO 5753-1, leaves 0.02 in the
/// smallest bearings.
const PLAY: f64 = 0.03;

/// What of the bearing's dimensions is possible and in doubt, a sentence each.
///
/// # Errors
/// [`ComputeError`] of the ring's material.
pub(super) fn bearing_doubts(case: &Case, seat: &case::Seat<'_>) -> Result<Vec<String>, ComputeError> {
    let (ring, Some(bearing)) = (seat.ring, seat.bearing) else {
        return Ok(Vec::new());
    };
    let mut found = Vec::new();
    found.extend(race_in_ring(case, ring, bearing)?);
    let play = bearing.play();
    if play.abs() > PLAY * bearing.ball_radius {
        let keys = match bearing.radial_play {
            Some(_) => "bearing.radial_play is",
            None => "bearing.outer_race_radius, inner_race_radius and ball_radius leave a radial play of",
        };
        found.push(format!(
            "{keys} {}, {:.1} % of the ball's radius: bearings are sold with at most 2 % (C5 of ISO 5753-1); check that it is in m",
            metres(play),
            100.0 * play / bearing.ball_radius
        ));
    }
    Ok(found)
}

/// Whether the outer race is in the innermost section of its ring, and how thick the wall outside of it is.
fn race_in_ring(case: &Case, ring: &case::Ring, bearing: &case::Bearing) -> Result<Option<String>, ComputeError> {
    let innermost = ring.sections.iter().enumerate().min_by(|a, b| a.1.radius.total_cmp(&b.1.radius));
    let Some((index, section)) = innermost else {
        return Ok(None);
    };
    let layer = layer(case, section)?;
    let [height, _] = layer.rectangle();
    let (race, half) = (bearing.outer_race_radius, 0.5 * height);
    let faces = [layer.radius - half, layer.radius + half];
    let near = faces[0] - APART * height..faces[1];
    if !near.contains(&race) {
        return Ok(Some(format!(
            "bearing.outer_race_radius is {} and the innermost of ring.sections reaches from about {} to {}: the race is cut into that ring; check both",
            metres(race),
            metres(faces[0]),
            metres(faces[1])
        )));
    }
    if race > section.radius {
        return Ok(Some(format!(
            "bearing.outer_race_radius is {} and the centroid of its ring lies at {} (ring.sections[{index}].radius): a groove takes less than half of a ring's height; check both",
            metres(race),
            metres(section.radius)
        )));
    }
    let outer = if ring.sections.len() == 1 { ring.outer_radius.unwrap_or(faces[1]) } else { faces[1] };
    let wall = (outer - race) / (2.0 * bearing.ball_radius);
    Ok((wall > WALL).then(|| {
        format!(
            "the wall of the outer ring is {}, from bearing.outer_race_radius to its outer face, {wall:.1} times the diameter of a ball: bearings have 0.2 to 0.6; check that ring and bearing belong together",
            metres(outer - race)
        )
    }))
}

/// Distance of the nodes of a bore from the outer face of the ring that is told, over the section's height.
const ARM: f64 = 0.5;

/// Where `ring.outer_radius` does not say which radius the bore has: whether the sections, whose outer face is at `face` and
/// which are `height` high there, fill the bore.
pub(super) fn filled(bore: &str, seat: &BoreExtent, face: f64, height: f64) -> Option<String> {
    let [nearest, farthest] = seat.radii;
    let gap = (face - nearest).abs().max((farthest - face).abs());
    (gap > ARM * height).then(|| {
        format!(
            "the nodes of the bore \"{bore}\" lie {} to {} from the axis and the outer face of ring.sections at about {}: the tie bridges up to {} as a rigid arm; check housing.length_unit, ring.tie.centre and ring.sections, and give ring.outer_radius",
            metres(nearest),
            metres(farthest),
            metres(face),
            metres(gap)
        )
    })
}

/// Distance of a centre node from the box about its bore that is told, over the diagonal of the box. The box about half a bore
/// ends at its axis.
const BESIDE: f64 = 0.1;

/// Centre nodes that lie beside their bores. Groups that cannot be bores are refused where the housing is condensed.
pub(super) fn centre_doubts(case: &Case, mesh: &Mesh, model: &HousingModel) -> Vec<String> {
    let told = |(index, centre): (usize, &case::Centre)| {
        let bore = model.group_on_housing(mesh, &centre.group, "the centre node").ok()?;
        let nodes = bore.nodes.iter().filter(|&&node| model.used[node]).map(|&node| model.coordinates()[node]);
        let [low, high] = nodes.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], place| {
            [[0, 1, 2].map(|k| place[k].min(low[k])), [0, 1, 2].map(|k| place[k].max(high[k]))]
        });
        let length = |of: &dyn Fn(usize) -> f64| (0..model.dimension).map(|k| of(k).powi(2)).sum::<f64>().sqrt();
        let beside = length(&|k| (low[k] - centre.point[k]).max(centre.point[k] - high[k]).max(0.0));
        (beside > BESIDE * length(&|k| high[k] - low[k])).then(|| {
            let corner = |place: [f64; 3]| place[..model.dimension].iter().map(|&x| metres(x)).collect::<Vec<_>>().join(", ");
            format!(
                "condense.interface.centres[{index}].point lies {} beside its bore \"{}\", which reaches from ({}) to ({}): the tie bridges that as a rigid arm; check the point (m, in the mesh's axes)",
                metres(beside),
                centre.group,
                corner(low),
                corner(high)
            )
        })
    };
    case.condense.interface.centres().iter().enumerate().filter_map(told).collect()
}
