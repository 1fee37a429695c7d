//! What kind of motion a mode is, in the words of tables and of the viewer alike.

use crate::fe::modal::ModalSurvey;

/// Relative difference up to which neighbours are one repeated mode, which a mesh splits.
pub(crate) const REPEATED: f64 = 1e-4;

/// A mode with strain and with a frequency of its own.
pub(crate) const ELASTIC: &str = "elastic";

/// What kind of motion each mode is: rigid or elastic, and with which others it has one frequency.
pub(crate) fn kinds(survey: &ModalSurvey) -> Vec<String> {
    let basis = &survey.basis;
    let hz = &basis.frequencies_hz;
    let same = |a: usize, b: usize| (hz[b] - hz[a]).abs() <= REPEATED * hz[b];
    let mut kinds = Vec::new();
    while kinds.len() < basis.rigid_modes.min(basis.count()) {
        kinds.push("rigid".to_owned());
    }
    while kinds.len() < basis.count() {
        let first = kinds.len();
        let last = (first..basis.count() - 1).find(|&mode| !same(mode, mode + 1)).unwrap_or(basis.count() - 1);
        let kind = match last - first + 1 {
            1 => ELASTIC.to_owned(),
            2 => format!("elastic, pair of modes {} and {}", first + 1, last + 1),
            _ => format!("elastic, group of modes {} to {}", first + 1, last + 1),
        };
        kinds.extend((first..=last).map(|_| kind.clone()));
    }
    kinds
}
