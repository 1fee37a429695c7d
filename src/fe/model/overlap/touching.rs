//! Faces that lie on each other and have no nodes in common.

use super::bodies::{Bodies, at, both, common_size, part};
use super::facets::Facet;
use super::outline::{BoxTree, centre, holds};
use crate::numerics::Brief;
use nalgebra::Vector3;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};

/// Cosine from which on the outward normals of two faces that lie on each other oppose: within 60 degrees.
const OPPOSED: f64 = -0.5;

/// Two parts, or one in itself, with faces that lie on each other: nothing holds them together there.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Touching {
    /// Names of the parts; twice the same for faces of one part.
    pub parts: [String; 2],
    /// Faces (edges in the plane) whose centre lies on a face that looks the other way, > 0.
    pub faces: usize,
    /// Their area, m^2 (length, m, in the plane), of the part that has more of it.
    pub size: f64,
    /// Largest distance of such a centre from the face that it lies on, m: zero but for round-off on planes that touch. On
    /// curved surfaces up to what flat faces miss; smaller gaps than that are not told from contact. Where one body
    /// reaches into the other, the depth.
    pub gap: f64,
    /// Pairs of their corners that are in one place.
    pub node_pairs: usize,
    /// Centre of the first face, m.
    pub place: [f64; 3],
    /// 2 or 3.
    pub dimension: usize,
    /// Whether one body has sunk into the other by more than what flat faces miss.
    #[serde(skip)]
    pub(super) sunk: bool,
}

impl Touching {
    /// What touches where, in words; `unit` is that of lengths.
    pub fn sentence(&self, unit: &str) -> String {
        let (what, power) = match self.dimension {
            2 => ("edges", ""),
            _ => ("faces", "^2"),
        };
        let parts = match &self.parts {
            [a, b] if a == b => format!("{what} of {} lie on each other", part(a)),
            parts => format!("the parts {} touch", both(parts)),
        };
        format!(
            "{parts} without common nodes: {} {what} on {} {unit}{power}, at most {} {unit} apart or into one another, {} pairs of nodes in one place, the first at {}",
            self.faces,
            Brief::rounded(self.size, 4),
            Brief::rounded(self.gap, 2),
            self.node_pairs,
            at(self.place, unit)
        )
    }
}

/// The facet that the centre of another one lies on.
#[derive(Debug, Clone, Copy)]
struct Behind {
    facet: usize,
    /// From its plane, m.
    distance: f64,
    /// Whether that is behind it, and more than what flat faces miss.
    sunk: bool,
}

/// What touches between two parts, with the sizes of the faces of the first and of the second, and the pairs of corners in
/// one place.
type Between = (Touching, [f64; 2], BTreeSet<[usize; 2]>);

impl Bodies<'_> {
    /// Faces on each other, by pairs of parts; those left out whose corners, or those of the face that they lie on, are
    /// all `linked`.
    ///
    /// Faces of one body lie on each other if they do so within round-off. Those of two may be apart by as much as flat
    /// facets miss a curved surface, and one may have sunk into the outermost element of the other.
    pub(crate) fn touching(&self, linked: impl Fn(usize) -> bool) -> Vec<Touching> {
        if !self.is_flat_or_solid() {
            return Vec::new();
        }
        let facets = self.facets();
        // with the whole element behind it: the face of another body may have sunk into it
        let bounds = facets.iter().map(|facet| self.extent(self.solids[facet.solid].nodes).grown(facet.reach));
        let tree = BoxTree::new(bounds.collect());
        let order = tree.order().par_iter();
        let mut on: Vec<(usize, Behind)> = order
            .filter_map(|&index| {
                let behind = self.lies_on(&facets, index as usize, &tree)?;
                Some((index as usize, behind))
            })
            .collect();
        on.sort_unstable_by_key(|pair| pair.0);
        let mut found: BTreeMap<[usize; 2], Between> = BTreeMap::new();
        let is_linked = |facet: &Facet| facet.corners.iter().all(|&node| linked(node));
        let pairs = on.into_iter();
        let pairs = pairs.map(|(index, behind)| (&facets[index], &facets[behind.facet], behind));
        for (facet, other, behind) in pairs.filter(|(a, b, _)| !is_linked(a) && !is_linked(b)) {
            let [part, of_other] = [facet, other].map(|facet| self.solids[facet.solid].part);
            let parts = [part.min(of_other), part.max(of_other)];
            let (touching, sizes, node_pairs) = found.entry(parts).or_insert_with(|| {
                let touching = Touching {
                    parts: self.names(parts),
                    faces: 0,
                    size: 0.0,
                    gap: 0.0,
                    node_pairs: 0,
                    place: facet.centre.into(),
                    dimension: self.solids[facet.solid].kind.dimension(),
                    sunk: false,
                };
                (touching, [0.0; 2], BTreeSet::new())
            });
            sizes[usize::from(part > of_other)] += facet.size;
            node_pairs.extend(self.node_pairs(facet, other));
            touching.faces += 1;
            touching.size = common_size(parts, *sizes);
            touching.gap = touching.gap.max(behind.distance);
            touching.node_pairs = node_pairs.len();
            touching.sunk |= behind.sunk;
        }
        found.into_values().map(|(touching, ..)| touching).collect()
    }

    /// The nearest facet that looks the other way and that the centre of this one lies on or is sunk behind.
    fn lies_on(&self, facets: &[Facet], index: usize, tree: &BoxTree) -> Option<Behind> {
        let facet = &facets[index];
        let mut best: Option<Behind> = None;
        let reach = facet.reach + self.tolerance;
        tree.visit(facet.centre.into(), reach, |number| {
            let other = &facets[number];
            if other.normal.dot(&facet.normal) > OPPOSED {
                return;
            }
            let limit = match other.body == facet.body {
                true => self.tolerance,
                false => reach + other.reach,
            };
            let Some(height) = self.height(other, &facet.centre) else {
                return;
            };
            let nearer = best.is_none_or(|best| (height.abs(), number) < (best.distance, best.facet));
            let touches = height.abs() <= limit;
            let is_within = || {
                let solid = &self.solids[other.solid];
                holds(self, solid, &centre(self, solid), &facet.centre)
            };
            let sunk = || other.body != facet.body && height < 0.0 && is_within();
            if nearer && (touches || sunk()) {
                best = Some(Behind { facet: number, distance: height.abs(), sunk: !touches });
            }
        });
        best
    }

    /// Corners of two facets that are in one place and are not one.
    fn node_pairs(&self, facet: &Facet, other: &Facet) -> Vec<[usize; 2]> {
        let near = |a: usize, b: usize| {
            let apart = Vector3::from(self.points[a]) - Vector3::from(self.points[b]);
            a != b && apart.norm() <= self.tolerance
        };
        let corners = facet.corners.iter().flat_map(|&a| other.corners.iter().map(move |&b| (a, b)));
        let pairs = corners.filter(|&(a, b)| near(a, b));
        pairs.map(|(a, b)| [a.min(b), a.max(b)]).collect()
    }
}
