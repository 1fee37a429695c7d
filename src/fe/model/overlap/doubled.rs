//! Elements that stand on the corners of another one.

use super::bodies::{Bodies, Solid, at, both};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::Serialize;

/// Elements that stand on the corners of one before them: their mass and stiffness would count twice.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Doubled {
    /// How many, > 0.
    pub elements: usize,
    /// Tags of the first of them, in the order of the mesh, and of the element before it.
    pub tags: [u64; 2],
    /// Names of the parts of these two.
    pub parts: [String; 2],
    /// Mean of their corners, m.
    pub place: [f64; 3],
}

impl Doubled {
    /// What they are, in words.
    pub fn sentence(&self) -> String {
        let [first, second] = self.tags;
        format!(
            "{} on the corners of another element, the first are elements {first} and {second} of {} at {}",
            match self.elements {
                1 => "1 element stands".to_owned(),
                count => format!("{count} elements stand"),
            },
            both(&self.parts),
            at(self.place)
        )
    }
}

/// Corners of an element, sorted; `NO_CORNER` fills up.
pub(super) type Corners = [u32; 8];

const NO_CORNER: u32 = u32::MAX;

/// A mesh has fewer than 2^32 - 1 nodes, which the reader sees to.
pub(super) fn sorted_corners(solid: &Solid) -> Corners {
    let mut corners = [NO_CORNER; 8];
    for (slot, &node) in corners.iter_mut().zip(solid.corners()) {
        *slot = node as u32;
    }
    corners.sort_unstable();
    corners
}

impl Bodies<'_> {
    /// The elements on the corners of one before them; `None` if there are none. Order and kind do not matter: Hex8 and
    /// Hex20 on the same corners fill the same space.
    pub(crate) fn doubled(&self) -> Option<Doubled> {
        let solids = self.solids.par_iter().enumerate();
        let mut keys: Vec<(Corners, u32)> =
            solids.map(|(index, solid)| (sorted_corners(solid), index as u32)).collect();
        keys.par_sort_unstable();
        let mut elements = 0;
        let mut first: Option<[u32; 2]> = None;
        for pair in keys.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
            elements += 1;
            let pair = [pair[0].1, pair[1].1];
            if first.is_none_or(|first| pair[1] < first[1]) {
                first = Some(pair);
            }
        }
        let pair = first?.map(|index| &self.solids[index as usize]);
        Some(Doubled {
            elements,
            tags: pair.map(|solid| solid.tag),
            parts: self.names(pair.map(|solid| solid.part)),
            place: self.mean(pair[0].corners()),
        })
    }

    /// Mean of some nodes, m.
    pub(super) fn mean(&self, nodes: &[usize]) -> [f64; 3] {
        [0, 1, 2].map(|axis| {
            let sum: f64 = nodes.iter().map(|&node| self.points[node][axis]).sum();
            sum / nodes.len() as f64
        })
    }
}
