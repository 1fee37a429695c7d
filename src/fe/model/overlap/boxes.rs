//! Boxes in a tree: which of many hold a point.

use crate::fe::mesh::BoundingBox;

/// Most boxes in a leaf.
const LEAF: usize = 8;

impl BoundingBox {
    fn holds(&self, point: [f64; 3], reach: f64) -> bool {
        (0..3).all(|axis| self.min[axis] - reach <= point[axis] && point[axis] <= self.max[axis] + reach)
    }

    /// Middle between both sides along an axis, m.
    pub(super) fn middle(&self, axis: usize) -> f64 {
        0.5 * (self.min[axis] + self.max[axis])
    }
}

/// A branch, whose left part is the node behind it, or a leaf.
#[derive(Debug)]
struct Node {
    bounds: BoundingBox,
    /// Places in the order, of a leaf.
    range: std::ops::Range<u32>,
    /// Index of the right part; none of a leaf.
    right: Option<u32>,
}

/// Fewer than 2^32 boxes.
#[derive(Debug)]
pub(super) struct BoxTree {
    /// In the order, so that a leaf's lie side by side.
    boxes: Vec<BoundingBox>,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl BoxTree {
    pub(super) fn new(boxes: Vec<BoundingBox>) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = Vec::new();
        if !boxes.is_empty() {
            split(&boxes, &mut order, 0, &mut nodes);
        }
        Self { boxes: order.iter().map(|&index| boxes[index as usize]).collect(), order, nodes }
    }

    /// Indices of the boxes, neighbours in space near each other: searches in this order find the tree in the cache.
    pub(super) fn order(&self) -> &[u32] {
        &self.order
    }

    /// Calls `visit` with the index of every box that holds the point or is nearer than `reach` (m) along each axis.
    pub(super) fn visit(&self, point: [f64; 3], reach: f64, mut visit: impl FnMut(usize)) {
        let mut open: Vec<usize> = (0..self.nodes.len().min(1)).collect();
        while let Some(number) = open.pop() {
            let node = &self.nodes[number];
            if !node.bounds.holds(point, reach) {
                continue;
            }
            match node.right {
                Some(right) => open.extend([right as usize, number + 1]),
                None => {
                    let range = node.range.start as usize..node.range.end as usize;
                    let own = self.boxes[range.clone()].iter().zip(&self.order[range]);
                    own.filter(|(bounds, _)| bounds.holds(point, reach)).for_each(|(_, &index)| visit(index as usize));
                }
            }
        }
    }
}

/// Adds the node of a part of the order that begins at `first`, and those below it.
fn split(boxes: &[BoundingBox], order: &mut [u32], first: u32, nodes: &mut Vec<Node>) {
    let ends = order.iter().flat_map(|&index| [boxes[index as usize].min, boxes[index as usize].max]);
    let bounds = BoundingBox::of(ends);
    let number = nodes.len();
    nodes.push(Node { bounds, range: first..first + order.len() as u32, right: None });
    if order.len() <= LEAF {
        return;
    }
    let side = |axis: usize| bounds.max[axis] - bounds.min[axis];
    let axis = (1..3).fold(0, |long, axis| if side(axis) > side(long) { axis } else { long });
    let half = order.len() / 2;
    order.select_nth_unstable_by(half, |&a, &b| {
        let middle = |index: u32| boxes[index as usize].middle(axis);
        middle(a).total_cmp(&middle(b)).then(a.cmp(&b))
    });
    let (left, right) = order.split_at_mut(half);
    split(boxes, left, first, nodes);
    nodes[number].right = Some(nodes.len() as u32);
    split(boxes, right, first + half as u32, nodes);
}
