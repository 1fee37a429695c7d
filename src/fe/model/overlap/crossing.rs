//! Bodies that reach into one another between the centres of all their elements.

use super::bodies::{Bodies, Solid, at, both, part};
use super::outline::{BoxTree, corners_of, normal};
use super::{Overlap, Touching};
use crate::numerics::Brief;
use nalgebra::Vector3;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Part of an element's size below which two directions are one: their cross product is round-off.
const PARALLEL: f64 = 1e-9;

/// Two parts, or one in itself, whose elements have places in common.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Crossing {
    /// Names of the parts; twice the same within one part.
    pub parts: [String; 2],
    /// Pairs of elements that reach into one another, > 0.
    pub pairs: usize,
    /// The deepest of them: the least distance that would part the two elements, m.
    pub depth: f64,
    /// Tags of these two.
    pub tags: [u64; 2],
    /// Middle of the box that both have in common, m.
    pub place: [f64; 3],
}

impl Crossing {
    /// What crosses where, in words; `unit` is that of lengths.
    pub fn sentence(&self, unit: &str) -> String {
        let [first, second] = self.tags;
        let parts = match &self.parts {
            [a, b] if a == b => format!("bodies of {}", part(a)),
            parts => format!("the parts {}", both(parts)),
        };
        format!(
            "{parts} reach into one another: {} pairs of elements do, by up to {} {unit}, the deepest are elements {first} and {second} at {}",
            self.pairs,
            Brief::rounded(self.depth, 2),
            at(self.place, unit)
        )
    }
}

impl Bodies<'_> {
    /// What is not connected by nodes and has nodes that are not `linked`: faces on each other, and bodies that reach into one another by more
    /// than what flat faces miss, known `overlaps` left out.
    pub(crate) fn unconnected(
        &self,
        linked: impl Fn(usize) -> bool + Sync,
        overlaps: &[Overlap],
    ) -> (Vec<Touching>, Vec<Crossing>) {
        let mut touching = self.touching(&linked);
        let crossings = self.crossings(linked, overlaps, &touching);
        let crosses = |touching: &Touching| { crossings.iter() }.any(|crossing| crossing.parts == touching.parts);
        touching.retain(|touching| !crosses(touching));
        (touching, crossings)
    }

    /// Elements of different bodies without common nodes that fill common space, by pairs of parts. Left out are pairs of
    /// which each has a node that is `linked`, and pairs of parts that are known to overlap, or to touch without reaching into one another.
    ///
    /// An element stands for the convex hull of its corners: the separating axis theorem (Gottschalk, Lin and Manocha, SIGGRAPH
    /// 1996) says how far one must move to be clear of the other.
    fn crossings(
        &self,
        linked: impl Fn(usize) -> bool + Sync,
        overlaps: &[Overlap],
        touching: &[Touching],
    ) -> Vec<Crossing> {
        if !self.is_flat_or_solid() {
            return Vec::new();
        }
        let (outer, body) = self.outer_faces();
        if body.iter().all(|own| *own == body[0]) {
            return Vec::new();
        }
        let bounds = self.solids.par_iter().map(|solid| self.extent(solid.corners()));
        let tree = BoxTree::new(bounds.collect());
        let mut outer: Vec<usize> = outer.into_iter().map(|(solid, _)| solid).collect();
        outer.dedup();
        let held = |solid: &Solid| solid.nodes.iter().any(|&node| linked(node));
        let pairs = outer.par_iter().flat_map_iter(|&index| {
            let solid = &self.solids[index];
            let own = self.extent(solid.corners());
            let mut found = Vec::new();
            tree.visit([0, 1, 2].map(|axis| own.middle(axis)), 0.5 * own.longest_side(), |other| {
                let of_other = &self.solids[other];
                let common = || solid.nodes.iter().any(|node| of_other.nodes.contains(node));
                if body[other] == body[index] || common() || held(solid) && held(of_other) {
                    return;
                }
                if let Some(depth) = self.depth(solid, of_other) {
                    found.push(([index.min(other), index.max(other)], depth));
                }
            });
            found
        });
        let mut pairs: Vec<([usize; 2], f64)> = pairs.collect();
        pairs.sort_unstable_by_key(|pair| pair.0);
        pairs.dedup_by_key(|pair| pair.0);
        let mut found: BTreeMap<[usize; 2], Crossing> = BTreeMap::new();
        for (pair, depth) in pairs {
            let pair = pair.map(|index| &self.solids[index]);
            let mut parts = pair.map(|solid| solid.part);
            parts.sort_unstable();
            let crossing = found.entry(parts).or_insert_with(|| Crossing {
                parts: self.names(parts),
                pairs: 0,
                depth: 0.0,
                tags: [0; 2],
                place: [0.0; 3],
            });
            crossing.pairs += 1;
            if depth > crossing.depth {
                let [a, b] = pair.map(|solid| self.extent(solid.corners()));
                crossing.depth = depth;
                crossing.tags = pair.map(|solid| solid.tag);
                crossing.place =
                    [0, 1, 2].map(|axis| 0.5 * (a.min[axis].max(b.min[axis]) + a.max[axis].min(b.max[axis])));
            }
        }
        let is_known = |crossing: &Crossing| {
            let on_faces = |touching: &Touching| !touching.sunk && touching.parts == crossing.parts;
            overlaps.iter().any(|overlap| overlap.parts == crossing.parts) || touching.iter().any(on_faces)
        };
        found.into_values().filter(|crossing| !is_known(crossing)).collect()
    }

    /// The least distance that would part two elements, if that is more than round-off, m.
    fn depth(&self, a: &Solid, b: &Solid) -> Option<f64> {
        let mut least = f64::INFINITY;
        let mut try_axis = |axis: Vector3<f64>| {
            let [a, b] = [a, b].map(|solid| {
                let along = solid.corners().iter();
                along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &node| {
                    let x = axis.dot(&Vector3::from(self.points[node]));
                    [low.min(x), high.max(x)]
                })
            });
            least = least.min((a[1] - b[0]).min(b[1] - a[0]));
            least > self.tolerance
        };
        let [(normals_a, edges_a), (normals_b, edges_b)] = [a, b].map(|solid| self.axes(solid));
        let mut normals = normals_a.into_iter().chain(normals_b);
        if !normals.all(&mut try_axis) {
            return None;
        }
        if a.kind.dimension() == 3 {
            for first in &edges_a {
                for second in &edges_b {
                    let across = first.cross(second);
                    if across.norm() > PARALLEL && !try_axis(across.normalize()) {
                        return None;
                    }
                }
            }
        }
        Some(least)
    }

    /// Unit normals of the faces of an element, and unit vectors along its edges, parallel ones once.
    fn axes(&self, solid: &Solid) -> (Vec<Vector3<f64>>, Vec<Vector3<f64>>) {
        let (mut normals, mut edges): (Vec<Vector3<f64>>, Vec<Vector3<f64>>) = Default::default();
        let add = |list: &mut Vec<Vector3<f64>>, vector: Vector3<f64>| {
            let Some(unit) = vector.try_normalize(0.0) else {
                return;
            };
            if list.iter().all(|known| known.cross(&unit).norm() > PARALLEL) {
                list.push(unit);
            }
        };
        for face in solid.kind.faces() {
            let places = self.places(&corners_of(solid, face));
            add(&mut normals, normal(&places));
            for (from, to) in places.iter().zip(places.iter().cycle().skip(1)) {
                add(&mut edges, to - from);
            }
        }
        (normals, edges)
    }
}
