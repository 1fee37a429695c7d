//! Strain and kinetic energies of modes, summed element by element.

use super::ModalError;
use super::element_work::{CHUNK, ElementWork};
use super::membership::Membership;
use crate::fe::model::{HousingModel, ModelError};
use crate::numerics::linalg::DenseMatrix;
use rayon::prelude::*;

/// Sums by mode: strain of each part, of each group, then kinetic likewise.
pub(super) struct Sums {
    parts: usize,
    groups: usize,
    values: Vec<f64>,
}

impl Sums {
    fn zeros(parts: usize, groups: usize, modes: usize) -> Self {
        Self { parts, groups, values: vec![0.0; 2 * (parts + groups) * modes] }
    }

    fn width(&self) -> usize {
        self.parts + self.groups
    }

    /// Strain and kinetic energies of a mode, each by part and by group.
    pub(super) fn of_mode(&self, mode: usize) -> [[Vec<f64>; 2]; 2] {
        let width = self.width();
        [0, 1].map(|kind| {
            let row = &self.values[width * (2 * mode + kind)..][..width];
            let (parts, groups) = row.split_at(self.parts);
            [parts.to_vec(), groups.to_vec()]
        })
    }

    fn add(&mut self, mode: usize, part: usize, groups: &[usize], [strain, kinetic]: [f64; 2]) {
        let width = self.width();
        let own = &mut self.values[2 * width * mode..][..2 * width];
        for place in std::iter::once(part).chain(groups.iter().map(|group| self.parts + group)) {
            own[place] += strain;
            own[width + place] += kinetic;
        }
    }
}

/// Sums over all elements in one pass.
///
/// # Errors
/// [`ModalError::Model`] for the first element that is inverted or degenerate.
pub(super) fn element_sums(
    model: &HousingModel,
    membership: &Membership,
    shapes: &DenseMatrix,
) -> Result<Sums, ModalError> {
    let (parts, groups) = (model.properties.len(), membership.names.len());
    let zeros = || Sums::zeros(parts, groups, shapes.ncols());
    let chunks: Vec<Result<Sums, ModelError>> = model
        .elements
        .list
        .par_chunks(CHUNK)
        .enumerate()
        .map(|(chunk, elements)| {
            let mut sums = zeros();
            let mut work = ElementWork::new();
            for (place, element) in elements.iter().enumerate() {
                let element_groups = membership.of(CHUNK * chunk + place);
                work.load(model, element)?;
                for mode in 0..shapes.ncols() {
                    let energies = work.energies(model, element, shapes.col_as_slice(mode));
                    sums.add(mode, element.part, element_groups, energies);
                }
            }
            Ok(sums)
        })
        .collect();
    let mut total = zeros();
    for chunk in chunks {
        for (sum, value) in total.values.iter_mut().zip(chunk?.values) {
            *sum += value;
        }
    }
    Ok(total)
}
