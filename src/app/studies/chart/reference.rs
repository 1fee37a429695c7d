//! What the chart measures by: two methods of different kind on the fullest model, refined until they agree.

use super::starts::Ready;
use super::trace::Trace;
use super::{Growth, Settings, Start, Starts};
use crate::app::error::ComputeError;
use crate::app::scene::{RunModel, Scene};
use crate::numerics::ode::Method;
use crate::system::{BallsInertia, ModeSelection};
use rayon::prelude::*;

/// First step of the method with fixed steps, in output intervals, and first tolerance of the other: the roughest that
/// agreed to a ten-thousandth in the dented bearing of `examples/tadina2011`.
const FIRST: (f64, f64) = (1.0 / 128.0, 1e-6);

/// Time between the samples of the method that chooses its steps, in output intervals: what the sensor shows above half
/// this rate would fold into the band.
const SAMPLES: f64 = 1.0 / 16.0;

/// Refinements: step halved, tolerance a tenth.
const REFINEMENTS: usize = 3;

/// Part of the target below which the two methods agree well enough to stop refining, and to measure by.
const WANTED: f64 = 0.01;
const AGREED: f64 = 0.1;

/// The reference of one start.
#[derive(Debug, Clone)]
pub struct StartReference {
    /// The start.
    pub start: Start,
    /// Signals of the method that chooses its steps, over the chart's span.
    pub trace: Trace,
    /// Distance of a perturbed solution by the other method.
    pub growth: Growth,
    /// Distance of the two methods.
    pub between: Growth,
    /// Time over which nearby solutions stay together, s.
    pub horizon_s: f64,
    /// Relative difference of the two methods over it.
    pub disagreement: f64,
    /// Refinements that it took.
    pub refinements: usize,
}

/// The reference of a chart.
#[derive(Debug, Clone)]
pub struct Reference {
    /// Of every start, in order.
    pub starts: Vec<StartReference>,
    /// The model and method measured by and the one beside it, as the last refined start has them.
    pub models: [RunModel; 2],
    /// Mean of the starts' disagreements: the floor of the chart.
    pub disagreement: f64,
    /// Whether it is well below the target.
    pub agreed: bool,
}

impl Reference {
    /// Finds the reference of every start, in parallel; `done` is called after each.
    ///
    /// # Errors
    /// [`ComputeError::Failed`] if a method fails; that of signals that cannot be compared.
    pub fn find(
        scene: &Scene,
        starts: &Starts,
        settings: &Settings,
        done: impl Fn() + Sync,
    ) -> Result<Self, ComputeError> {
        let [by, _] = models(settings, 0);
        let system = Ready::of(scene, &by)?;
        let found = starts.starts.par_iter().map(|start| {
            let found = of_start(&system, start, settings);
            done();
            found
        });
        let starts = found.collect::<Result<Vec<_>, _>>()?;
        let count = starts.len() as f64;
        let disagreement = starts.iter().map(|start| start.disagreement).sum::<f64>() / count;
        let most = starts.iter().map(|start| start.refinements).max();
        Ok(Self {
            models: models(settings, most.unwrap_or(0)),
            disagreement,
            agreed: disagreement <= AGREED * settings.target,
            starts,
        })
    }

    /// Mean of the starts' horizons, s.
    pub(crate) fn mean_horizon_s(&self) -> f64 {
        let sum: f64 = self.starts.iter().map(|start| start.horizon_s).sum();
        sum / self.starts.len() as f64
    }

    /// Least of the starts' horizons, s.
    pub(crate) fn least_horizon_s(&self) -> f64 {
        let horizons = self.starts.iter().map(|start| start.horizon_s);
        horizons.fold(f64::INFINITY, f64::min)
    }

    /// Mean rate of growth, 1/s, over the starts that have one.
    pub(crate) fn growth_rate_per_s(&self) -> Option<f64> {
        let rates = self.starts.iter().filter_map(|s| s.growth.rate_per_s());
        let rates: Vec<f64> = rates.collect();
        (!rates.is_empty()).then(|| rates.iter().sum::<f64>() / rates.len() as f64)
    }
}

/// The fullest model by the method measured by, and by that beside it, refined so often.
pub(super) fn models(settings: &Settings, refinements: usize) -> [RunModel; 2] {
    let (step, tolerance) = FIRST;
    // a few refinements
    let times = refinements as i32;
    let fullest = |method, step| RunModel {
        modes: ModeSelection::All,
        residual: false,
        balls_inertia: BallsInertia::Dynamic,
        method,
        step,
    };
    [
        fullest(
            Method::Dop853 { tolerance: tolerance * 0.1_f64.powi(times), events: true },
            SAMPLES * settings.interval(),
        ),
        fullest(Method::ExponentialAdams { tolerance: None }, step * settings.interval() * 0.5_f64.powi(times)),
    ]
}

fn of_start(system: &Ready, start: &Start, settings: &Settings) -> Result<StartReference, ComputeError> {
    let (span, window) = (settings.span_s, settings.window_s);
    let run = |model: &RunModel, perturbed| -> Result<Trace, ComputeError> {
        let run = system.simulate(start, model, settings.simulated(span), perturbed);
        run.and_then(|run| Trace::of_run(&run, settings))
            .map_err(|failure| no_reference(model.method.name(), start.time_s, &failure.reason))
    };
    let [mut by, mut beside] = models(settings, 0);
    let mut witness = run(&beside, None)?;
    let nearby = run(&beside, Some(settings.ensemble))?;
    let growth = Growth::between(&nearby, &witness, span, window)?;
    let horizon_s = growth.horizon_s(1.0 / settings.target);
    let mut refinements = 0;
    loop {
        let trace = run(&by, None)?;
        let disagreement = witness.error(&trace, 0.0, horizon_s)?;
        if disagreement <= WANTED * settings.target || refinements == REFINEMENTS {
            return Ok(StartReference {
                between: Growth::between(&witness, &trace, span, window)?,
                start: start.clone(),
                trace,
                growth,
                horizon_s,
                disagreement,
                refinements,
            });
        }
        refinements += 1;
        [by, beside] = models(settings, refinements);
        witness = run(&beside, None)?;
    }
}

/// The error of a method that failed from the start at `start_s` (s): there is nothing to compare with.
fn no_reference(method: &str, start_s: f64, reason: &str) -> ComputeError {
    ComputeError::failed(
        format!("the reference by {method} failed at the start at {start_s} s: {reason}"),
        "`plummer run` with transient.modes = \"all\" shows what happens there; another transient.start begins elsewhere",
    )
}

#[cfg(test)]
mod tests {
    use super::no_reference;

    #[test]
    fn a_reference_that_fails_is_not_the_input() {
        let error = no_reference("dop853", 2.3, "the solution blew up");
        assert!(!error.is_input());
        assert_eq!(error.to_string(), "the reference by dop853 failed at the start at 2.3 s: the solution blew up");
        assert_eq!(
            error.help().unwrap(),
            "`plummer run` with transient.modes = \"all\" shows what happens there; another transient.start begins elsewhere"
        );
    }
}
