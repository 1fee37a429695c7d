//! Numbers of an input file: those of nodes and elements, and coordinates.

use super::MshError;
use super::block::Block;
use crate::fe::mesh::gmsh::{NodeIndex, quoted};

/// Largest number of a node or element: Abaqus allows no larger one.
const LARGEST: u64 = 999_999_999;

/// Largest coordinate: sums and squares of such ones are finite in any unit.
const FARTHEST: f64 = 1e100;

/// Nodes or elements by their numbers.
pub(super) struct Numbers {
    index: NodeIndex,
    /// In the order of the file.
    pub(super) listed: Vec<u64>,
}

impl Numbers {
    pub(super) fn for_blocks<'b, 'a: 'b>(blocks: impl Iterator<Item = &'b Block<'a>>) -> Self {
        let lines = blocks.map(|block| block.lines().count()).sum();
        Self { index: NodeIndex::for_count(lines), listed: Vec::with_capacity(lines) }
    }

    pub(super) fn get(&self, number: u64) -> Option<usize> {
        self.index.get(number)
    }

    /// Indices of those from `first` to `last` in steps that occur.
    pub(super) fn between(&self, first: u64, last: u64, step: u64) -> Vec<u32> {
        if (last - first) / step > self.listed.len() as u64 {
            let is_in = |number: u64| (first..=last).contains(&number) && (number - first).is_multiple_of(step);
            let listed = (0..).zip(&self.listed);
            return listed.filter(|(_, number)| is_in(**number)).map(|(index, _)| index).collect();
        }
        let numbers = (first..=last).step_by(step as usize);
        numbers.filter_map(|number| Some(self.get(number)? as u32)).collect()
    }

    pub(super) fn push(&mut self, number: u64) {
        // the numbers themselves are below 2^32, and different
        self.index.insert(number, self.listed.len() as u32);
        self.listed.push(number);
    }
}

/// A whole number from 1 on.
pub(super) fn number(block: &Block<'_>, line: usize, what: &str, word: &[u8]) -> Result<u64, MshError> {
    let text = std::str::from_utf8(word).ok();
    let found = text.and_then(|text| text.parse().ok()).filter(|number| (1..=LARGEST).contains(number));
    found.ok_or_else(|| block.fault(line, format_args!("expected {what}, 1 to {LARGEST}, found {}", quoted(word))))
}

/// A coordinate; Fortran writes 1.D-3 and 1.-3.
pub(super) fn coordinate(word: &[u8]) -> Option<f64> {
    let text = std::str::from_utf8(word).ok()?;
    let value = text.parse().ok().or_else(|| {
        let text = text.replace(['d', 'D'], "e");
        let sign = text.rfind(['+', '-']).filter(|&at| at > 0 && !text.contains(['e', 'E']));
        sign.map_or(text.clone(), |at| format!("{}e{}", &text[..at], &text[at..])).parse().ok()
    });
    value.filter(|value: &f64| value.abs() <= FARTHEST)
}
