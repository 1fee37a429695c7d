//! Families of candidates, refined side by side: the cheapest of all first, until refining brings nothing more or the time ends.

use super::points::{Comparison, Point};
use super::trace::FailureKind;
use super::{Parameter, model_name};
use crate::app::scene::RunModel;
use crate::report::significant;
use rayon::prelude::*;

/// An error from which a refinement is expected to bring something, and what it must then bring to go on.
const CONVERGING: f64 = 0.3;
const GAIN: f64 = 0.85;

/// Points in a row that differ by less than this part, where the error is larger: refining does not reach what is wrong.
const STUCK: (usize, f64) = (3, 0.1);

/// Part of the target below which nothing finer is tried.
const FINE: f64 = 0.01;

/// What came of the candidates.
#[derive(Debug, Default)]
pub(super) struct Found {
    /// Points by family, each from the roughest on.
    pub(super) points: Vec<Point>,
    /// What a simulated second of each took, s, while other runs were under way; `None` without an error.
    pub(super) taken: Vec<Option<f64>>,
    /// What there was no time for, a sentence a family.
    pub(super) unrefined: Vec<String>,
}

/// The candidates of one method on one model, from the roughest to the finest, and how far it is.
#[derive(Debug)]
struct Family<'f> {
    models: &'f [RunModel],
    points: Vec<(Point, Option<f64>)>,
    means: Vec<f64>,
    ended: bool,
}

impl Family<'_> {
    /// The next candidate; `None` where refining is at its end.
    fn next(&self) -> Option<&RunModel> {
        if self.ended { None } else { self.models.get(self.points.len()) }
    }

    /// Takes in the next point, and ends where that is refused, far below the target, at the floor, or no better than the one
    /// before, what is left being the model's own error.
    fn take(&mut self, (point, taken): (Point, Option<f64>), on: Comparison<'_>) {
        let (mean, refused) = match &point.error {
            Ok(error) => (Some(error.mean), false),
            Err(failure) => (failure.error, failure.kind == FailureKind::Refused),
        };
        self.points.push((point, taken));
        match mean {
            Some(mean) => self.means.push(mean),
            None => self.means.clear(),
        }
        let fine = on.reference.disagreement.max(FINE * on.settings.target);
        let fine_enough = self.means.last().is_some_and(|mean| *mean <= fine);
        self.ended = refused || fine_enough || gains_nothing(&self.means);
    }

    /// What is expected of the next point, s: of halved steps twice what the last one took.
    fn expected_s(&self, next: &RunModel, on: Comparison<'_>) -> f64 {
        let Some((last, Some(taken))) = self.points.last() else {
            return 0.0;
        };
        let dearer = if next.step < last.model.step { last.model.step / next.step } else { 1.0 };
        let seconds: f64 = on.reference.starts.iter().map(|start| start.horizon_s + on.settings.edge_s).sum();
        dearer * taken * seconds / (on.settings.point_stride() * rayon::current_num_threads()) as f64
    }
}

/// Computes the points of families, roughest first and starts in parallel; `known` are points that are there already. `found` is
/// called with each, `done` with the number of families that are at their end.
pub(super) fn refine(
    families: &[Vec<RunModel>],
    known: &[(Point, Option<f64>)],
    on: Comparison<'_>,
    found: impl Fn(&Point) + Sync,
    done: impl Fn(usize),
) -> Found {
    let begin = |models| Family { models, points: Vec::new(), means: Vec::new(), ended: false };
    let mut all: Vec<Family<'_>> = families.iter().map(|models| begin(models.as_slice())).collect();
    let mut unrefined = Vec::new();
    loop {
        let mut open: Vec<&mut Family<'_>> = all.iter_mut().filter(|family| family.next().is_some()).collect();
        done(families.len() - open.len());
        if open.is_empty() {
            break;
        }
        let cut: Vec<Option<String>> = open
            .par_iter_mut()
            .map(|family| {
                let next = *family.next()?;
                let point = known.iter().find(|(point, _)| point.model == next).cloned();
                let point = point.or_else(|| {
                    let fits = on.until.is_never() || family.expected_s(&next, on) <= on.until.left_s();
                    let computed = fits.then(|| on.point(&next));
                    let computed = computed.filter(|(point, _)| !is_out_of_time(point));
                    if let Some((point, _)) = &computed {
                        found(point);
                    }
                    computed
                });
                match point {
                    Some(point) => {
                        family.take(point, on);
                        None
                    }
                    None => {
                        family.ended = true;
                        Some(from_on(&next))
                    }
                }
            })
            .collect();
        unrefined.extend(cut.into_iter().flatten());
    }
    let (points, taken) = all.into_iter().flat_map(|family| family.points).unzip();
    Found { points, taken, unrefined }
}

/// Whether a point was cut short.
pub(super) fn is_out_of_time(point: &Point) -> bool {
    point.error.as_ref().is_err_and(|failure| failure.kind == FailureKind::OutOfTime)
}

/// A family from a candidate on.
fn from_on(model: &RunModel) -> String {
    let from = match Parameter::of(model) {
        Parameter::StepS(step) => format!("without steps of {} µs and shorter", significant(1e6 * step, 3)),
        Parameter::Tolerance(tolerance) => format!("without tolerances of {} and smaller", significant(tolerance, 2)),
    };
    format!("{}, {}: {from}", model.method.name(), model_name(model))
}

/// Whether the last of a family's errors, from the roughest on, say that refining brings nothing more.
fn gains_nothing(means: &[f64]) -> bool {
    let [.., before, last] = means else {
        return false;
    };
    let (count, part) = STUCK;
    let stuck =
        means.len() >= count && means[means.len() - count..].iter().all(|mean| (mean / last - 1.0).abs() < part);
    (*last < CONVERGING && *last > GAIN * before) || stuck
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn refining_ends_where_it_brings_nothing() {
        assert!(!gains_nothing(&[0.01]));
        assert!(!gains_nothing(&[0.1, 0.05]));
        assert!(gains_nothing(&[0.1, 0.05, 0.049]));
        // far from converged: errors that are alike by chance go on, three of them do not
        assert!(!gains_nothing(&[1.47, 1.46]));
        assert!(!gains_nothing(&[3.0, 1.47, 1.46]));
        assert!(gains_nothing(&[1.47, 1.46, 1.47]));
    }
}
