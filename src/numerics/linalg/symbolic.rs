//! Where the entries of a factor are: supernodes, columns with one pattern, in the tree in which they are eliminated.
//!
//! The analysis works on nodes: consecutive columns with the same rows below them, as the unknowns of a mesh node have. A
//! node's pattern is that of its columns and of its children in the elimination tree (Liu, SIAM J. Matrix Anal. Appl. 11
//! (1990) 134-172). Small supernodes are merged with their parents at the price of a few zeros (Ashcraft and Grimes, ACM
//! Trans. Math. Softw. 15 (1989) 291-309).

use super::memory::{affordable, available};
use super::trapezoid::Trapezoid;
use super::tree::{NONE, Tree};
use super::{LinalgError, SymmetricMatrix};
use std::ops::Range;

/// Supernodes that are merged: so many columns with at most this fraction of zeros.
const RELAXATION: &[(usize, f64)] = &[(8, 1.0), (24, 0.6), (64, 0.15), (usize::MAX, 0.05)];

/// A supernode: columns from `start` on, and the rows below them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Supernode<'a> {
    pub start: usize,
    pub columns: usize,
    /// Rows of the matrix below the columns, ascending.
    pub below: &'a [u32],
    /// Where they are among the columns and rows of the parent.
    pub relative: &'a [u32],
}

impl Supernode<'_> {
    /// Columns and rows below.
    pub(super) fn rows(&self) -> usize {
        self.columns + self.below.len()
    }

    /// How its entries are stored.
    pub(super) fn layout(&self) -> Trapezoid {
        Trapezoid::of_columns(self.columns, self.below.len())
    }
}

/// Supernodes of a matrix, their patterns and their tree.
#[derive(Debug)]
pub(super) struct Symbolic {
    order: usize,
    /// First column of every supernode, and the order.
    starts: Vec<u32>,
    /// Where the rows below begin in `rows` and `relative`.
    row_begins: Vec<usize>,
    rows: Vec<u32>,
    relative: Vec<u32>,
    /// Where the children begin in `children`.
    child_begins: Vec<u32>,
    children: Vec<u32>,
    /// Where the entries begin.
    value_begins: Vec<usize>,
    /// Parts of the tree that threads share.
    pub tree: Tree,
}

impl Symbolic {
    /// Order of the matrix.
    pub(super) fn order(&self) -> usize {
        self.order
    }

    /// Entries of the factor as it is stored.
    pub(super) fn entries(&self) -> usize {
        self.value_begins.last().copied().unwrap_or(0)
    }

    pub(super) fn supernodes(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn supernode(&self, index: usize) -> Supernode<'_> {
        let rows = self.row_begins[index]..self.row_begins[index + 1];
        let start = self.starts[index] as usize;
        Supernode {
            start,
            columns: self.starts[index + 1] as usize - start,
            below: &self.rows[rows.clone()],
            relative: &self.relative[rows],
        }
    }

    /// Supernodes whose rows below begin in a supernode, ascending.
    pub(super) fn children(&self, index: usize) -> impl Iterator<Item = usize> {
        let range = self.child_begins[index] as usize..self.child_begins[index + 1] as usize;
        self.children[range].iter().map(|&child| child as usize)
    }

    /// Columns of some supernodes.
    pub(super) fn columns(&self, supernodes: &Range<usize>) -> Range<usize> {
        self.starts[supernodes.start] as usize..self.starts[supernodes.end] as usize
    }

    /// Where the entries of some supernodes are.
    pub(super) fn values(&self, supernodes: &Range<usize>) -> Range<usize> {
        self.value_begins[supernodes.start]..self.value_begins[supernodes.end]
    }

    /// Completes starts and rows of supernodes.
    fn new(order: usize, groups: Groups) -> Self {
        let Groups { starts, row_begins, rows } = groups;
        let count = starts.len() - 1;
        let mut supernode_of = vec![0_u32; order];
        for index in 0..count {
            supernode_of[starts[index] as usize..starts[index + 1] as usize].fill(index as u32);
        }
        let parent = |index: usize| -> u32 {
            let range = row_begins[index]..row_begins[index + 1];
            rows[range].first().map_or(NONE, |&row| supernode_of[row as usize])
        };
        let parents: Vec<u32> = (0..count).map(parent).collect();
        let mut child_begins = vec![0_u32; count + 1];
        parents.iter().filter(|&&parent| parent != NONE).for_each(|&parent| child_begins[parent as usize + 1] += 1);
        for index in 0..count {
            child_begins[index + 1] += child_begins[index];
        }
        let mut next = child_begins.clone();
        let mut children = vec![0; child_begins[count] as usize];
        let mut relative = vec![0; rows.len()];
        let mut value_begins = vec![0; count + 1];
        let mut work = vec![0.0; count];
        for index in 0..count {
            let range = row_begins[index]..row_begins[index + 1];
            let columns = (starts[index + 1] - starts[index]) as usize;
            value_begins[index + 1] = value_begins[index] + Trapezoid::of_columns(columns, range.len()).len();
            work[index] = columns as f64 * ((columns + range.len()) as f64).powi(2);
            let parent = parents[index] as usize;
            if parents[index] == NONE {
                continue;
            }
            children[next[parent] as usize] = index as u32;
            next[parent] += 1;
            let (start, end) = (starts[parent], starts[parent + 1]);
            let below = &rows[row_begins[parent]..row_begins[parent + 1]];
            let mut place = 0;
            for (relative, &row) in relative[range.clone()].iter_mut().zip(&rows[range]) {
                *relative = if row < end {
                    row - start
                } else {
                    place += below[place..].iter().take_while(|&&other| other < row).count();
                    end - start + place as u32
                };
            }
        }
        let tree = Tree::new(&parents, &work);
        Self { order, starts, row_begins, rows, relative, child_begins, children, value_begins, tree }
    }
}

/// Analyses the pattern of a matrix.
///
/// # Errors
/// [`LinalgError::TooLarge`] if there is no memory for the factor.
pub(super) fn analysed(a: &SymmetricMatrix) -> Result<Symbolic, LinalgError> {
    let nodes = Nodes::of(a);
    let merged = nodes.eliminated().merged(&nodes);
    affordable(a.order(), merged.entries(), available())?;
    Ok(Symbolic::new(a.order(), merged.of_columns(&nodes)))
}

/// Supernodes: where they start, and the rows below them.
struct Groups {
    starts: Vec<u32>,
    row_begins: Vec<usize>,
    rows: Vec<u32>,
}

impl Groups {
    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    fn below(&self, index: usize) -> &[u32] {
        &self.rows[self.row_begins[index]..self.row_begins[index + 1]]
    }
}

/// Nodes of the matrix's graph: consecutive columns with the same rows below.
struct Nodes {
    /// First column of every node, and the order.
    starts: Vec<u32>,
    /// Where the neighbours begin.
    begins: Vec<usize>,
    /// Nodes below that a node is coupled with, ascending.
    neighbours: Vec<u32>,
}

impl Nodes {
    fn of(a: &SymmetricMatrix) -> Self {
        let order = a.order();
        let column = |index: usize| &a.rows[a.offsets[index] as usize..a.offsets[index + 1] as usize];
        // a diagonal that is not stored ends a node, which costs no more than time
        let follows = |index: usize| {
            let (before, own) = (column(index - 1), column(index));
            before.first() == Some(&(index as u32 - 1)) && own.first() == Some(&(index as u32)) && before[1..] == *own
        };
        let mut starts: Vec<u32> =
            (0..order).filter(|&index| index == 0 || !follows(index)).map(|index| index as u32).collect();
        starts.push(order as u32);
        let mut node_of = vec![0_u32; order];
        for node in 0..starts.len() - 1 {
            node_of[starts[node] as usize..starts[node + 1] as usize].fill(node as u32);
        }
        let (mut begins, mut neighbours) = (vec![0], Vec::new());
        for (node, pair) in starts.windows(2).enumerate() {
            let mut last = node as u32;
            for &row in column(pair[0] as usize) {
                let other = node_of[row as usize];
                if other > last {
                    neighbours.push(other);
                    last = other;
                }
            }
            begins.push(neighbours.len());
        }
        Self { starts, begins, neighbours }
    }

    fn count(&self) -> usize {
        self.starts.len() - 1
    }

    fn below(&self, node: usize) -> &[u32] {
        &self.neighbours[self.begins[node]..self.begins[node + 1]]
    }

    /// Number of columns of some nodes.
    fn columns(&self, nodes: &[u32]) -> usize {
        nodes.iter().map(|&node| (self.starts[node as usize + 1] - self.starts[node as usize]) as usize).sum()
    }

    /// Chains of nodes in which each is the only child of the next and adds no row: the fundamental supernodes, of nodes.
    fn eliminated(&self) -> Groups {
        let count = self.count();
        let mut groups = Groups { starts: Vec::new(), row_begins: vec![0], rows: Vec::new() };
        // supernodes that wait for a node, as lists
        let mut waiting = vec![NONE; count];
        let mut next = Vec::new();
        let mut marks = vec![NONE; count];
        // rows of the open supernode below its nodes so far, in `rows` from here on
        let mut open = 0;
        for node in 0..count {
            let current = groups.starts.len() as u32;
            let follows = node > 0
                && waiting[node] == NONE
                && groups.rows.get(open) == Some(&(node as u32))
                && self.below(node).iter().all(|&row| marks[row as usize] == current - 1);
            if follows {
                open += 1;
                continue;
            }
            if current > 0 {
                close(&mut groups, &mut waiting, &mut next, open);
            }
            let from = groups.rows.len();
            let own = self.below(node);
            groups.rows.extend(own);
            own.iter().for_each(|&row| marks[row as usize] = current);
            let mut child = waiting[node];
            while child != NONE {
                let range = groups.row_begins[child as usize]..groups.row_begins[child as usize + 1];
                for place in range {
                    let row = groups.rows[place];
                    if row as usize > node && marks[row as usize] != current {
                        marks[row as usize] = current;
                        groups.rows.push(row);
                    }
                }
                child = next[child as usize];
            }
            groups.rows[from..].sort_unstable();
            groups.starts.push(node as u32);
            open = from;
        }
        if count > 0 {
            close(&mut groups, &mut waiting, &mut next, open);
        }
        groups.starts.push(count as u32);
        groups
    }
}

/// Ends the open supernode, whose rows below are those from `open` on, and lets it wait for its parent.
fn close(groups: &mut Groups, waiting: &mut [u32], next: &mut Vec<u32>, open: usize) {
    let begin = groups.row_begins.last().copied().unwrap_or(0);
    groups.rows.drain(begin..open);
    let parent = groups.rows.get(begin).copied();
    groups.row_begins.push(groups.rows.len());
    let index = next.len() as u32;
    next.push(NONE);
    if let Some(parent) = parent {
        next[index as usize] = std::mem::replace(&mut waiting[parent as usize], index);
    }
}

/// Supernodes of nodes and the entries that they have.
struct Merged {
    groups: Groups,
    entries: usize,
}

impl Groups {
    /// Merges supernodes with the parents right behind them where few zeros come in.
    fn merged(self, nodes: &Nodes) -> Merged {
        let count = self.count();
        // columns, rows below and zeros of what a supernode has become with all that was merged into it
        let mut columns: Vec<usize> = Vec::with_capacity(count);
        let mut below: Vec<usize> = Vec::with_capacity(count);
        for index in 0..count {
            columns.push(
                (nodes.starts[self.starts[index + 1] as usize] - nodes.starts[self.starts[index] as usize]) as usize,
            );
            below.push(nodes.columns(self.below(index)));
        }
        let entries = |columns: usize, below: usize| columns * (columns + 1) / 2 + columns * below;
        let mut zeros = vec![0; count];
        let mut goes_on = vec![false; count];
        for child in 0..count.saturating_sub(1) {
            let parent = child + 1;
            if self.below(child).first() != Some(&self.starts[parent]) {
                continue;
            }
            let together = columns[child] + columns[parent];
            let merged = entries(together, below[parent]);
            let apart = entries(columns[child], below[child]) + entries(columns[parent], below[parent]);
            let new = merged - apart + zeros[child] + zeros[parent];
            let allowed = RELAXATION.iter().find(|(most, _)| together <= *most).map_or(0.0, |&(_, share)| share);
            if new as f64 <= allowed * merged as f64 {
                columns[parent] = together;
                zeros[parent] = new;
                goes_on[child] = true;
            }
        }
        let mut groups = Groups { starts: Vec::new(), row_begins: vec![0], rows: Vec::new() };
        let mut total = 0;
        let mut fresh = true;
        for index in 0..count {
            if fresh {
                groups.starts.push(self.starts[index]);
            }
            fresh = !goes_on[index];
            if fresh {
                groups.rows.extend(self.below(index));
                groups.row_begins.push(groups.rows.len());
                total += Trapezoid::of_columns(columns[index], below[index]).len();
            }
        }
        groups.starts.push(nodes.count() as u32);
        Merged { groups, entries: total }
    }
}

impl Merged {
    fn entries(&self) -> usize {
        self.entries
    }

    /// The same with columns and rows of the matrix in the place of nodes.
    fn of_columns(self, nodes: &Nodes) -> Groups {
        let groups = self.groups;
        let starts = groups.starts.iter().map(|&node| nodes.starts[node as usize]).collect();
        let (mut row_begins, mut rows) = (vec![0], Vec::new());
        for index in 0..groups.count() {
            let members = groups.below(index).iter().map(|&node| node as usize);
            rows.extend(members.flat_map(|node| nodes.starts[node]..nodes.starts[node + 1]));
            row_begins.push(rows.len());
        }
        Groups { starts, row_begins, rows }
    }
}
