//! Bodies of a housing: elements that hang together through whole faces, edges in the plane.

use crate::fe::mesh::{Sets, sorted_faces};
use crate::fe::model::{HousingModel, Ring};
use rayon::prelude::*;
use std::collections::BTreeMap;

const NO_BODY: u32 = u32::MAX;

/// Which body each element and node belongs to.
pub(super) struct BodyMap {
    /// Body of each element.
    pub of_element: Vec<u32>,
    /// Place and size of each body.
    pub extents: Vec<Extent>,
    first: Vec<u32>,
    /// Bodies after the first of the nodes that several share.
    pub shared: BTreeMap<usize, Vec<usize>>,
    /// The ring in the bore; it has no nodes here.
    pub ring: Option<usize>,
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
        let count = of_element.iter().max().map_or(0, |last| *last as usize + 1);
        let mut first = vec![NO_BODY; model.coordinates.len()];
        let mut shared: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        let mut extents = vec![Extent { elements: 0, centre: [0.0; 3], radius: 0.0 }; count];
        for (element, &body) in model.elements.iter().zip(&of_element) {
            let nodes = model.elements.nodes(element);
            let extent = &mut extents[body as usize];
            extent.elements += 1;
            for &node in nodes {
                for (sum, x) in extent.centre.iter_mut().zip(model.coordinates[node]) {
                    *sum += x / nodes.len() as f64;
                }
                if first[node] == NO_BODY {
                    first[node] = body;
                } else if first[node] != body {
                    let others = shared.entry(node).or_default();
                    if !others.contains(&(body as usize)) {
                        others.push(body as usize);
                    }
                }
            }
        }
        for extent in &mut extents {
            extent.centre = extent.centre.map(|sum| sum / extent.elements.max(1) as f64);
        }
        for (element, &body) in model.elements.iter().zip(&of_element) {
            let extent = &mut extents[body as usize];
            for &node in model.elements.nodes(element) {
                extent.radius = extent.radius.max(apart(extent.centre, model.coordinates[node]));
            }
        }
        Self { of_element, extents, first, shared, ring: None }
    }

    /// Adds the ring in the bore as the last body.
    pub(super) fn add_ring(&mut self, model: &HousingModel, ring: &Ring) {
        self.ring = Some(self.extents.len());
        self.extents.push(Extent {
            elements: ring.nodes(),
            centre: model.frame.centre(),
            radius: ring.section().radius,
        });
    }

    /// A body that the node belongs to; `None` for a node that no element uses.
    pub(super) fn of_node(&self, node: usize) -> Option<usize> {
        let body = *self.first.get(node)?;
        (body != NO_BODY).then_some(body as usize)
    }
}

pub(super) fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1]).hypot(a[2] - b[2])
}

/// Body of each element, numbered as met. A mesh has fewer than 2^32 - 1 nodes and elements, which the reader sees to.
fn joined_through_faces(model: &HousingModel) -> Vec<u32> {
    let elements = model.elements.list.par_iter();
    let faces = sorted_faces(elements.map(|element| (element.kind, model.elements.nodes(element))));
    let mut sets = Sets::new(model.elements.len());
    for pair in faces.windows(2) {
        if pair[0].0 == pair[1].0 {
            sets.join(pair[0].1 as usize, pair[1].1 as usize);
        }
    }
    let mut number = vec![NO_BODY; model.elements.len()];
    let mut count = 0;
    (0..model.elements.len())
        .map(|element| {
            let root = sets.root(element);
            if number[root] == NO_BODY {
                number[root] = count;
                count += 1;
            }
            number[root]
        })
        .collect()
}
