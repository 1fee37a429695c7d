//! The elimination tree in parts that threads share: subtrees of little work, and single supernodes above them.
//!
//! The parts do not depend on the number of threads, nor do results.

use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard};

/// No supernode or node.
pub(super) const NONE: u32 = u32::MAX;

/// Share of the whole work above which a subtree is divided.
const SHARE: f64 = 1.0 / 64.0;

/// Work of a subtree, in products, that is not worth dividing.
const LITTLE: f64 = 2e7;

/// A part of the tree: supernodes one behind the other.
#[derive(Debug)]
struct Part {
    supernodes: Range<usize>,
    parent: Option<usize>,
    children: Vec<usize>,
}

/// The parts, children before their parents.
#[derive(Debug)]
pub(super) struct Tree {
    parts: Vec<Part>,
    /// The part of every supernode.
    part_of: Vec<u32>,
}

impl Tree {
    /// Divides the tree of supernodes with these parents and so much work each.
    pub(super) fn new(parents: &[u32], work: &[f64]) -> Self {
        let count = parents.len();
        let mut below = work.to_vec();
        // first supernode of every subtree, and how many it has
        let mut first: Vec<usize> = (0..count).collect();
        let mut size = vec![1; count];
        for (index, &parent) in parents.iter().enumerate() {
            if parent != NONE {
                let parent = parent as usize;
                below[parent] += below[index];
                first[parent] = first[parent].min(first[index]);
                size[parent] += size[index];
            }
        }
        let limit = LITTLE.max(SHARE * work.iter().sum::<f64>());
        // in a postorder subtrees are consecutive
        let consecutive = (0..count).all(|index| index + 1 - first[index] == size[index]);
        let mut parts: Vec<Part> = Vec::new();
        let mut part_of = vec![0; count];
        let mut begin = 0;
        for (index, &parent) in parents.iter().enumerate() {
            let whole = parent == NONE || below[parent as usize] > limit;
            let ends = if consecutive { below[index] > limit || whole } else { index + 1 == count };
            if ends {
                part_of[begin..=index].fill(parts.len() as u32);
                parts.push(Part { supernodes: begin..index + 1, parent: None, children: Vec::new() });
                begin = index + 1;
            }
        }
        for part in 0..parts.len() {
            let parent = parents[parts[part].supernodes.end - 1];
            if parent != NONE {
                let parent = part_of[parent as usize] as usize;
                parts[part].parent = Some(parent);
                parts[parent].children.push(part);
            }
        }
        Self { parts, part_of }
    }

    pub(super) fn len(&self) -> usize {
        self.parts.len()
    }

    pub(super) fn supernodes(&self, part: usize) -> Range<usize> {
        self.parts[part].supernodes.clone()
    }

    /// The part that a supernode belongs to.
    pub(super) fn part_of(&self, supernode: usize) -> usize {
        self.part_of[supernode] as usize
    }

    fn in_one_go(&self) -> bool {
        self.parts.len() < 2 || rayon::current_num_threads() < 2
    }

    /// Handles every part after its children.
    pub(super) fn upwards(&self, handle: impl Fn(usize) + Sync) {
        if self.in_one_go() {
            (0..self.len()).for_each(handle);
            return;
        }
        let open: Vec<AtomicUsize> = self.parts.iter().map(|part| AtomicUsize::new(part.children.len())).collect();
        let leaves = (0..self.len()).filter(|&part| self.parts[part].children.is_empty());
        // a thread takes the last one first, and others take the first
        let leaves: Vec<usize> = leaves.rev().collect();
        let climb = |mut part: usize| {
            loop {
                handle(part);
                match self.parts[part].parent {
                    Some(parent) if open[parent].fetch_sub(1, Ordering::AcqRel) == 1 => part = parent,
                    _ => return,
                }
            }
        };
        let climb = &climb;
        rayon::scope(|scope| leaves.iter().for_each(|&leaf| scope.spawn(move |_| climb(leaf))));
    }

    /// Handles every part before its children.
    pub(super) fn downwards(&self, handle: impl Fn(usize) + Sync) {
        if self.in_one_go() {
            (0..self.len()).rev().for_each(handle);
            return;
        }
        let handle = &handle;
        let roots = (0..self.len()).filter(|&part| self.parts[part].parent.is_none());
        rayon::scope(|scope| roots.for_each(|root| scope.spawn(move |scope| self.descend(root, handle, scope))));
    }

    fn descend<'s>(&'s self, mut part: usize, handle: &'s (impl Fn(usize) + Sync), scope: &rayon::Scope<'s>) {
        loop {
            handle(part);
            let Some((&last, others)) = self.parts[part].children.split_last() else { return };
            others.iter().for_each(|&child| scope.spawn(move |scope| self.descend(child, handle, scope)));
            part = last;
        }
    }
}

/// What a mutex holds, whatever became of another thread that held it.
pub(super) fn lock<V>(mutex: &Mutex<V>) -> MutexGuard<'_, V> {
    mutex.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
}
