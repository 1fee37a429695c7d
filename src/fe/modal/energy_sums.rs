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

/// The sums of one mode.
#[derive(Clone, Copy)]
pub(super) struct Rows<'s> {
    sums: &'s Sums,
    first: usize,
}

impl Sums {
    fn zeros(parts: usize, groups: usize, modes: usize) -> Self {
        Self { parts, groups, values: vec![0.0; 2 * (parts + groups) * modes] }
    }

    fn width(&self) -> usize {
        self.parts + self.groups
    }

    pub(super) fn of_mode(&self, mode: usize) -> Rows<'_> {
        Rows { sums: self, first: 2 * self.width() * mode }
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

impl<'s> Rows<'s> {
    fn slice(self, from: usize, count: usize) -> impl Iterator<Item = f64> + 's {
        self.sums.values[self.first + from..][..count].iter().copied()
    }

    pub(super) fn strain_parts(self) -> impl Iterator<Item = f64> + 's {
        self.slice(0, self.sums.parts)
    }

    pub(super) fn strain_groups(self) -> impl Iterator<Item = f64> + 's {
        self.slice(self.sums.parts, self.sums.groups)
    }

    pub(super) fn kinetic_parts(self) -> impl Iterator<Item = f64> + 's {
        self.slice(self.sums.width(), self.sums.parts)
    }

    pub(super) fn kinetic_groups(self) -> impl Iterator<Item = f64> + 's {
        self.slice(self.sums.width() + self.sums.parts, self.sums.groups)
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
        .as_slice()
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
