//! Faces that lie on each other and have no nodes in common.

use super::bodies::{Bodies, at, both};
use super::boxes::BoxTree;
use super::facets::Facet;
use super::outline::{centre, holds};
use crate::fe::mesh::BoundingBox;
use nalgebra::Vector3;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

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
    /// What touches where, in words.
    pub fn sentence(&self) -> String {
        let (what, power) = match self.dimension {
            2 => ("edges", ""),
            _ => ("faces", "^2"),
        };
        let parts = match &self.parts {
            [a, b] if a == b => format!("{what} of the part \"{a}\" lie on each other"),
            parts => format!("the parts {} touch", both(parts)),
        };
        format!(
            "{parts} without common nodes: {} {what} on {:.3e} m{power}, at most {:.1e} m apart or into one another, {} pairs of nodes in one place, the first at {}",
            self.faces,
            self.size,
            self.gap,
            self.node_pairs,
            at(self.place)
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

struct Sum {
    faces: usize,
    sizes: [f64; 2],
    gap: f64,
    node_pairs: Vec<[usize; 2]>,
    place: Vector3<f64>,
    sunk: bool,
}

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
        let bounds = facets.iter().map(|facet| {
            let nodes = self.solids[facet.solid].nodes.iter();
            BoundingBox::of(nodes.map(|&node| self.points[node])).grown(facet.reach)
        });
        let tree = BoxTree::new(bounds.collect());
        let order = tree.order().par_iter();
        let mut on: Vec<(usize, Behind)> = order
            .filter_map(|&index| {
                let behind = self.lies_on(&facets, index as usize, &tree)?;
                Some((index as usize, behind))
            })
            .collect();
        on.sort_unstable_by_key(|pair| pair.0);
        let mut sums: BTreeMap<[usize; 2], Sum> = BTreeMap::new();
        let is_linked = |facet: &Facet| facet.corners.iter().all(|&node| linked(node));
        let pairs = on.into_iter();
        let pairs = pairs.map(|(index, behind)| (&facets[index], &facets[behind.facet], behind));
        for (facet, other, behind) in pairs.filter(|(a, b, _)| !is_linked(a) && !is_linked(b)) {
            let [part, of_other] = [facet, other].map(|facet| self.solids[facet.solid].part);
            let sum = sums.entry([part.min(of_other), part.max(of_other)]).or_insert_with(|| Sum {
                faces: 0,
                sizes: [0.0; 2],
                gap: 0.0,
                node_pairs: Vec::new(),
                place: facet.centre,
                sunk: false,
            });
            sum.faces += 1;
            sum.gap = sum.gap.max(behind.distance);
            sum.sunk |= behind.sunk;
            sum.sizes[usize::from(part > of_other)] += facet.size;
            sum.node_pairs.extend(self.node_pairs(facet, other));
        }
        let found = sums.into_iter().map(|(parts, mut sum)| {
            sum.node_pairs.sort_unstable();
            sum.node_pairs.dedup();
            Touching {
                parts: self.names(parts),
                faces: sum.faces,
                size: match parts {
                    [a, b] if a == b => 0.5 * sum.sizes[0],
                    _ => sum.sizes[0].max(sum.sizes[1]),
                },
                gap: sum.gap,
                node_pairs: sum.node_pairs.len(),
                place: sum.place.into(),
                dimension: self.solids.first().map_or(3, |solid| solid.kind.dimension()),
                sunk: sum.sunk,
            }
        });
        found.collect()
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
            let sunk = || other.body != facet.body && height < 0.0 && self.is_within(facet, other);
            if nearer && (touches || sunk()) {
                best = Some(Behind { facet: number, distance: height.abs(), sunk: !touches });
            }
        });
        best
    }

    /// Whether the centre of a facet lies within the element behind another one.
    fn is_within(&self, facet: &Facet, other: &Facet) -> bool {
        let solid = &self.solids[other.solid];
        holds(self, solid, &centre(self, solid), &facet.centre)
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
