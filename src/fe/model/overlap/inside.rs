//! Bodies that lie in one another: elements whose centre is within another element.

use super::bodies::{Bodies, at, both, common_size, part};
use super::outline::{BoxTree, centre, holds};
use crate::numerics::Brief;
use nalgebra::Vector3;
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What is done with bodies that lie in one another.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OverlapRule {
    /// They are refused.
    #[default]
    Refuse,
    /// They are allowed, with a warning; the mass and stiffness of both count where they overlap.
    Allow,
}

/// Two parts that fill one space, or a part that fills it twice.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Overlap {
    /// Names of the parts; twice the same for elements of one part.
    pub parts: [String; 2],
    /// Elements whose centre lies in an element of the other part, > 0.
    pub elements: usize,
    /// Area (m^2) or volume (m^3) of these elements, of the part that has more of it, or half of all within one part:
    /// what about counts twice.
    pub size: f64,
    /// Tags of the first of them and of the element that it lies in.
    pub tags: [u64; 2],
    /// Centre of the first, m.
    pub place: [f64; 3],
    /// 2 or 3.
    pub dimension: usize,
}

impl Overlap {
    /// What overlaps where, in words; `unit` is that of lengths.
    pub fn sentence(&self, unit: &str) -> String {
        let [first, second] = self.tags;
        let parts = match &self.parts {
            [a, b] if a == b => format!("elements of {} lie in one another", part(a)),
            parts => format!("the parts {} lie in one another", both(parts)),
        };
        format!(
            "{parts}: {} elements have their centre in another element, on about {} {unit}^{}, the first is element \
             {first} in element {second} at {}",
            self.elements,
            Brief::rounded(self.size, 4),
            self.dimension,
            at(self.place, unit)
        )
    }

    /// What to do about it.
    pub(crate) fn advice(&self) -> &'static str {
        match &self.parts {
            [a, b] if a == b => "mesh the geometry again, or delete the copy where it holds a body twice",
            _ => "cut one body from the other in gmsh (BooleanDifference or BooleanFragments), or delete the copy",
        }
    }
}

impl Bodies<'_> {
    /// Parts that lie in one another, by pairs in the order of the parts. Elements on the same corners are left to
    /// [`Bodies::doubled`], elements without valid shape to the assembly.
    pub(crate) fn overlaps(&self) -> Vec<Overlap> {
        if !self.is_flat_or_solid() {
            return Vec::new();
        }
        let bounds = self.solids.par_iter().map(|solid| self.extent(solid.nodes));
        let tree = BoxTree::new(bounds.collect());
        let centres = self.solids.par_iter().map(|solid| centre(self, solid));
        let centres: Vec<Vector3<f64>> = centres.collect();
        let order = tree.order().par_iter();
        let mut within: Vec<[usize; 2]> = order
            .filter_map(|&index| {
                let index = index as usize;
                Some([index, self.lies_in(index, &centres, &tree)?])
            })
            .collect();
        within.sort_unstable();
        // with the sizes of the elements of the first part and of the second
        let mut found: BTreeMap<[usize; 2], (Overlap, [f64; 2])> = BTreeMap::new();
        for [index, other] in within {
            let pair = [index, other].map(|index| &self.solids[index]);
            let [part, of_other] = pair.map(|solid| solid.part);
            let parts = [part.min(of_other), part.max(of_other)];
            let (overlap, sizes) = found.entry(parts).or_insert_with(|| {
                let overlap = Overlap {
                    parts: self.names(parts),
                    elements: 0,
                    size: 0.0,
                    tags: pair.map(|solid| solid.tag),
                    place: centres[index].into(),
                    dimension: pair[0].kind.dimension(),
                };
                (overlap, [0.0; 2])
            });
            overlap.elements += 1;
            sizes[usize::from(part > of_other)] += self.size(pair[0]).unwrap_or(0.0);
            overlap.size = common_size(parts, *sizes);
        }
        found.into_values().map(|(overlap, _)| overlap).collect()
    }

    /// The first element other than this one that its centre lies in.
    fn lies_in(&self, index: usize, centres: &[Vector3<f64>], tree: &BoxTree) -> Option<usize> {
        let (solid, point) = (&self.solids[index], &centres[index]);
        let mut found: Option<usize> = None;
        tree.visit((*point).into(), 0.0, |other| {
            let earlier = found.is_none_or(|found| other < found);
            if other != index && earlier && holds(self, &self.solids[other], &centres[other], point) {
                found = Some(other);
            }
        });
        let other = &self.solids[found?];
        let valid = self.size(solid).is_some() && self.size(other).is_some();
        found.filter(|_| valid && solid.sorted_corners() != other.sorted_corners())
    }
}
