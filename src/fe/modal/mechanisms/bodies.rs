//! Bodies of a housing: elements that hang together through whole faces, edges in the plane.

use crate::fe::mesh::{Sets, sorted_faces};
use crate::fe::model::{HousingModel, RingSeat};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Which body each element and node belongs to.
pub(super) struct BodyMap {
    /// Body of each element.
    pub of_element: Vec<usize>,
    /// Place and size of each body.
    pub extents: Vec<Extent>,
    /// First body of each node; `None` for a node that no element uses.
    first: Vec<Option<usize>>,
    /// Bodies after the first of the nodes that several share.
    pub shared: BTreeMap<usize, Vec<usize>>,
    /// The rings in the bores, in their order; they have no nodes here.
    pub rings: Vec<usize>,
}

/// Where a body is.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extent {
    pub elements: usize,
    /// Mean of the middles of its elements, m.
    pub centre: [f64; 3],
    /// Largest distance of a node from there, m.
    pub radius: f64,
}

impl BodyMap {
    pub(super) fn new(model: &HousingModel) -> Self {
        let of_element = joined_through_faces(model);
        let count = of_element.iter().max().map_or(0, |last| last + 1);
        let mut first = vec![None; model.coordinates.len()];
        let mut shared: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut extents = vec![Extent { elements: 0, centre: [0.0; 3], radius: 0.0 }; count];
        for (element, &body) in model.elements.iter().zip(&of_element) {
            let nodes = model.elements.nodes(element);
            let extent = &mut extents[body];
            extent.elements += 1;
            for &node in nodes {
                for (sum, x) in extent.centre.iter_mut().zip(model.coordinates[node]) {
                    *sum += x / nodes.len() as f64;
                }
                if *first[node].get_or_insert(body) != body {
                    let others = shared.entry(node).or_default();
                    if !others.contains(&body) {
                        others.push(body);
                    }
                }
            }
        }
        for extent in &mut extents {
            extent.centre = extent.centre.map(|sum| sum / extent.elements.max(1) as f64);
        }
        for (element, &body) in model.elements.iter().zip(&of_element) {
            let extent = &mut extents[body];
            for &node in model.elements.nodes(element) {
                extent.radius = extent.radius.max(apart(extent.centre, model.coordinates[node]));
            }
        }
        Self { of_element, extents, first, shared, rings: Vec::new() }
    }

    /// Adds a ring as the last body.
    pub(super) fn add_ring(&mut self, RingSeat { ring, frame, .. }: &RingSeat) {
        self.rings.push(self.extents.len());
        self.extents.push(Extent { elements: ring.nodes(), centre: frame.centre(), radius: ring.section().radius });
    }

    /// A body that the node belongs to; `None` for a node that no element uses.
    pub(super) fn of_node(&self, node: usize) -> Option<usize> {
        *self.first.get(node)?
    }
}

pub(super) fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// Body of each element, numbered as met. A mesh has fewer than 2^32 - 1 nodes and elements, which the reader sees to.
fn joined_through_faces(model: &HousingModel) -> Vec<usize> {
    let elements = model.elements.list.par_iter();
    let faces = sorted_faces(elements.map(|element| (element.kind, model.elements.nodes(element))));
    let mut sets = Sets::new(model.elements.len());
    for pair in faces.windows(2) {
        if pair[0].0 == pair[1].0 {
            sets.join(pair[0].1 as usize, pair[1].1 as usize);
        }
    }
    let mut numbers = vec![None; model.elements.len()];
    let mut count = 0..;
    (0..model.elements.len())
        .filter_map(|element| {
            let number = &mut numbers[sets.root(element)];
            *number = number.or_else(|| count.next());
            *number
        })
        .collect()
}
