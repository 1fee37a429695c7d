//! What is tried: methods, their steps or tolerances, and sizes of the model. The one list of candidates.

use super::{Effort, Settings};
use crate::app::scene::RunModel;
use crate::numerics::ode::Method;
use crate::system::{BallsInertia, ModeSelection};
use schemars::JsonSchema;
use serde::Serialize;

/// Spectral radius of generalized-alpha, as the program's own choice.
const SPECTRAL_RADIUS: f64 = 0.8;

/// Longest step, in halvings of the output interval: 1.2e-6 s in a band up to 40 kHz.
const LONGEST_STEP: i32 = 2;

/// Shortest step of a full and of a quick chart, in halvings of the output interval: eight are 2e-8 s in a band up to 40 kHz.
const SHORTEST_STEP: [i32; 2] = [8, 6];

/// How many of the longest steps are tried of the implicit method in all modes.
const IMPLICIT_STEPS: usize = 4;

/// Steps tried of the source's method in all modes beside its own, in units of that: the first two are beyond its limit or
/// near to it.
const SOURCE_STEPS: [f64; 4] = [4.0, 3.0, 2.0, 1.0];

/// Tolerances of a method that chooses its steps.
const TOLERANCES: [f64; 6] = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-8];

/// Those of exponential-adams, which bounds another quantity.
const FORCE_TOLERANCES: [f64; 6] = [1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5];

/// Kept modes, in units of the band's highest frequency.
const BANDS: [f64; 4] = [1.0, 2.0, 3.0, 6.0];

/// The families that a chart tries, each the candidates of one method on one model from the roughest to the finest; `frequencies_hz` are those of all modes, ascending, and `source` is the source paper's
/// method as it is used there.
pub(super) fn families(
    settings: &Settings,
    frequencies_hz: &[f64],
    [chosen, source]: &[RunModel; 2],
) -> Vec<Vec<RunModel>> {
    let all = (ModeSelection::All, false);
    let up_to = |bands: f64, residual| (ModeSelection::UpTo(bands * settings.band_hz), residual);
    // the basis on which all methods are compared beside that of all modes
    let usual = (chosen.modes, chosen.residual);
    let mut bases = vec![usual, all];
    if settings.effort == Effort::Full {
        let others = BANDS.into_iter();
        bases.extend(others.flat_map(|bands| [up_to(bands, true), up_to(bands, false)]));
    }
    let bases = distinct(bases, frequencies_hz);
    let with_inertia = RunModel { balls_inertia: BallsInertia::Dynamic, ..*chosen };
    let fixed = |method, (modes, residual)| -> Vec<RunModel> {
        let steps = (LONGEST_STEP..=settings.effort.pick(SHORTEST_STEP))
            .map(|halvings| settings.interval() * 0.5_f64.powi(halvings));
        steps.map(|step| RunModel { modes, residual, method, step, ..with_inertia }).collect()
    };
    let by_tolerance = |(modes, residual)| -> Vec<RunModel> {
        // fine enough that nothing folds into the band
        let step = settings.interval() / 16.0;
        let methods = TOLERANCES.map(|tolerance| Method::Dop853 { tolerance, events: true });
        methods.map(|method| RunModel { modes, residual, method, step, ..with_inertia }).to_vec()
    };
    let adams_by_tolerance = |(modes, residual)| -> Vec<RunModel> {
        let methods = FORCE_TOLERANCES.map(|tolerance| Method::ExponentialAdams { tolerance: Some(tolerance) });
        methods.map(|method| RunModel { modes, residual, method, ..*chosen }).to_vec()
    };
    let mut families = Vec::new();
    let adams = Method::ExponentialAdams { tolerance: None };
    for method in [Method::Exponential, adams] {
        families.extend(bases.iter().map(|&basis| fixed(method, basis)));
    }
    families.extend(bases.iter().map(|&basis| adams_by_tolerance(basis)));
    let alpha = Method::GeneralizedAlpha { spectral_radius: SPECTRAL_RADIUS };
    let others = [Method::NewmarkExplicit, Method::Newmark, alpha, Method::Splitting];
    families.extend(others.map(|method| fixed(method, usual)));
    families.push(by_tolerance(usual));
    if settings.effort == Effort::Full {
        // a step of it solves for all modes: what is shorter would take longer than all others together
        let mut implicit = fixed(Method::Newmark, all);
        implicit.truncate(IMPLICIT_STEPS);
        families.push(implicit);
        families.push(by_tolerance(all));
        families.push(SOURCE_STEPS.map(|times| RunModel { step: times * source.step, ..*source }).to_vec());
    } else {
        families.push(vec![*source]);
    }
    families
}

/// Without those that keep the same modes as one before.
fn distinct(bases: Vec<(ModeSelection, bool)>, frequencies_hz: &[f64]) -> Vec<(ModeSelection, bool)> {
    let mut seen = Vec::new();
    let new = |(selection, residual): &(ModeSelection, bool)| {
        let count = kept(*selection, frequencies_hz);
        // nothing is left out of all modes
        let key = (count, *residual && count < frequencies_hz.len());
        let new = !seen.contains(&key);
        seen.push(key);
        new
    };
    bases.into_iter().filter(new).collect()
}

/// How many modes of these frequencies a selection keeps.
pub(super) fn kept(selection: ModeSelection, frequencies_hz: &[f64]) -> usize {
    match selection {
        ModeSelection::All => frequencies_hz.len(),
        ModeSelection::Count(count) => count.min(frequencies_hz.len()),
        ModeSelection::UpTo(hz) => frequencies_hz.iter().filter(|&&f| f <= hz).count(),
    }
}

/// The modes of a model in words: "modes up to 120 kHz + residual".
pub(crate) fn model_name(model: &RunModel) -> String {
    let modes = match model.modes {
        ModeSelection::All => return "all modes".to_owned(),
        ModeSelection::Count(count) => format!("{count} modes"),
        ModeSelection::UpTo(hz) => format!("modes up to {} kHz", hz / 1e3),
    };
    if model.residual { format!("{modes} + residual") } else { modes }
}

/// What of a model is refined, and how far.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Parameter {
    /// Length of a step, s.
    StepS(f64),
    /// Relative tolerance of a step.
    Tolerance(f64),
}

impl Parameter {
    /// That of a model.
    pub(crate) fn of(model: &RunModel) -> Self {
        match model.method {
            Method::Dop853 { tolerance, .. } | Method::ExponentialAdams { tolerance: Some(tolerance) } => {
                Self::Tolerance(tolerance)
            }
            _ => Self::StepS(model.step),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_that_keep_the_same_modes_are_tried_once() {
        let up_to = |hz, residual| (ModeSelection::UpTo(hz), residual);
        let all = (ModeSelection::All, false);
        let bases =
            vec![up_to(3.0, true), all, up_to(3.5, true), up_to(3.5, false), up_to(5.0, true), up_to(5.0, false)];
        assert_eq!(distinct(bases, &[1.0, 3.0, 4.0]), [up_to(3.0, true), all, up_to(3.5, false)]);
    }
}
