//! What a front leaves of the rows below, on the way to its parent.

use super::precision::Precision;
use super::trapezoid::Trapezoid;
use super::tree::lock;
use std::sync::Mutex;

/// Width of the blocks in which the rest of a front is stored, for fewer rows than [`MANY`] and for more.
const WIDTHS: [usize; 2] = [32, 64];
const MANY: usize = 256;

/// What a supernode leaves to its parent: the lower triangle over its rows below.
#[derive(Debug)]
pub(super) struct Rest<T> {
    layout: Trapezoid,
    entries: Vec<T>,
}

impl<T> Rest<T> {
    pub(super) fn layout(&self) -> Trapezoid {
        self.layout
    }

    pub(super) fn entries(&mut self) -> &mut [T] {
        &mut self.entries[..self.layout.len()]
    }

    /// A column from the diagonal down.
    pub(super) fn column(&self, index: usize) -> &[T] {
        let (block, first) = (index / self.layout.width, index - index % self.layout.width);
        let rows = self.layout.rows - first;
        let begin = self.layout.begin(block) + (index - first) * rows;
        &self.entries[begin + index - first..begin + rows]
    }
}

/// Memory of rests, used again and again: to touch new memory costs as much as to fill it.
#[derive(Debug)]
pub(super) struct Pool<T>(Mutex<Vec<Vec<T>>>);

impl<T: Precision> Pool<T> {
    pub(super) fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The rest of a front with so many rows below, its entries to be filled.
    pub(super) fn take(&self, rows: usize) -> Rest<T> {
        let layout = Trapezoid { rows, columns: rows, width: WIDTHS[usize::from(rows >= MANY)] };
        Rest { layout, entries: self.memory(layout.len()) }
    }

    fn memory(&self, length: usize) -> Vec<T> {
        if length == 0 {
            return Vec::new();
        }
        let mut pool = lock(&self.0);
        let place = pool.partition_point(|memory| memory.len() < length);
        if place < pool.len() {
            return pool.remove(place);
        }
        // the largest will hardly serve again
        pool.pop();
        drop(pool);
        vec![T::default(); length]
    }

    pub(super) fn give_back(&self, rest: Rest<T>) {
        if !rest.entries.is_empty() {
            let mut pool = lock(&self.0);
            let place = pool.partition_point(|memory| memory.len() < rest.entries.len());
            pool.insert(place, rest.entries);
        }
    }
}
