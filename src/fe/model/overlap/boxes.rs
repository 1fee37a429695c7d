//! Boxes in a tree: which of many hold a point.

/// Most boxes in a leaf.
const LEAF: usize = 8;

/// A box with sides along the axes, m.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bounds {
    pub low: [f64; 3],
    pub high: [f64; 3],
}

impl Bounds {
    /// The smallest that holds these points, grown by `reach` (m) to all sides.
    pub(super) fn of(points: impl Iterator<Item = [f64; 3]>, reach: f64) -> Self {
        let mut found = Self::empty();
        points.for_each(|point| found.add(point, point));
        Self { low: found.low.map(|x| x - reach), high: found.high.map(|x| x + reach) }
    }

    /// Length of the diagonal, m.
    pub(super) fn diagonal(&self) -> f64 {
        let [x, y, z] = [0, 1, 2].map(|axis| self.high[axis] - self.low[axis]);
        x.hypot(y).hypot(z)
    }

    fn empty() -> Self {
        Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] }
    }

    fn add(&mut self, low: [f64; 3], high: [f64; 3]) {
        for axis in 0..3 {
            self.low[axis] = self.low[axis].min(low[axis]);
            self.high[axis] = self.high[axis].max(high[axis]);
        }
    }

    fn holds(&self, point: [f64; 3], reach: f64) -> bool {
        (0..3).all(|axis| self.low[axis] - reach <= point[axis] && point[axis] <= self.high[axis] + reach)
    }

    fn middle(&self, axis: usize) -> f64 {
        0.5 * (self.low[axis] + self.high[axis])
    }
}

/// A branch, whose left part is the node behind it, or a leaf.
#[derive(Debug)]
struct Node {
    bounds: Bounds,
    /// Places in the order, of a leaf.
    range: std::ops::Range<u32>,
    /// Index of the right part; none of a leaf.
    right: Option<u32>,
}

/// Fewer than 2^32 boxes.
#[derive(Debug)]
pub(super) struct BoxTree {
    /// In the order, so that a leaf's lie side by side.
    boxes: Vec<Bounds>,
    order: Vec<u32>,
    nodes: Vec<Node>,
}

impl BoxTree {
    pub(super) fn new(boxes: Vec<Bounds>) -> Self {
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
fn split(boxes: &[Bounds], order: &mut [u32], first: u32, nodes: &mut Vec<Node>) {
    let mut bounds = Bounds::empty();
    for &index in order.iter() {
        let own = &boxes[index as usize];
        bounds.add(own.low, own.high);
    }
    let number = nodes.len();
    nodes.push(Node { bounds, range: first..first + order.len() as u32, right: None });
    if order.len() <= LEAF {
        return;
    }
    let side = |axis: usize| bounds.high[axis] - bounds.low[axis];
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
