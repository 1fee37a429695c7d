//! `plummer run`: equilibrium, transient, signals, analysis.

use super::damping::{damping, refuse_structural_damping};
use super::statics::Statics;
use super::structure::MODELLED;
use super::{StageError, StructureStage, Watch, WindowAnalysis, analyse, bearing_setup};
use super::{bearing_table, race_contacts};
use crate::bearing::{Race, RaceContacts};
use crate::case::{self, Case, ModesKept, StepLength};
use crate::report::Table;
use crate::series::TimeSeries;
use crate::system::{
    BallsInertia, BearingSetup, CoupledSystem, Equilibrium, Formulation, LoadedModes,
    ModeSelection, Recorder, RunRecord, StaticCondition,
};
use crate::transient::{Method, Schedule, Statistics, Stepping, TransientError, integrate};
use std::time::Instant;

/// `auto` step of the exponential method: phase of the stiffest ball vibration in one step, rad.
const AUTO_PHASE: f64 = 0.1;

/// Largest ball force that `auto` prepares for, in units of the largest static one: impacts in a
/// dent of the source's size reach five to ten times.
const AUTO_FORCE: f64 = 10.0;

/// The source's step for explicit Newmark, s (section 4.1).
const NEWMARK_STEP: f64 = 1.5e-8;

/// Tolerance of `dop853` unless one is given: far below one percent after some milliseconds of impacts.
const TOLERANCE: f64 = 1e-6;

/// Default of generalized-alpha: takes what is not resolved out within some tens of steps, and of a motion of 0.1 rad a step
/// 7e-8 of the amplitude.
const SPECTRAL_RADIUS: f64 = 0.8;

/// How a run ended.
#[derive(Debug)]
pub enum RunEnd {
    /// At the end of its time.
    Complete,
    /// The solution blew up; what was recorded before is there.
    BlewUp(TransientError),
}

/// Result of a run.
#[derive(Debug)]
pub struct RunResult {
    /// The linear model.
    pub stage: StructureStage,
    /// The bearing.
    pub setup: BearingSetup,
    /// Its contacts by Hertz from geometry and materials, whichever stiffness is in use.
    pub contacts: RaceContacts,
    /// Where it started.
    pub equilibrium: Equilibrium,
    /// That equilibrium among the others, and over a ball pass.
    pub statics: Statics,
    /// Modes linearised there.
    pub loaded: LoadedModes,
    /// Method used.
    pub method: Method,
    /// How the time was cut.
    pub schedule: Schedule,
    /// Kept modes of the structure.
    pub modes: usize,
    /// Whether the static residual of the others was in use.
    pub residual: bool,
    /// Steps and evaluations.
    pub statistics: Statistics,
    /// Simulated time, s.
    pub simulated_s: f64,
    /// Wall time of the stepping alone, s.
    pub stepping_s: f64,
    /// Signals.
    pub record: RunRecord,
    /// Analysed windows of all sensors.
    pub windows: Vec<WindowAnalysis>,
    /// Windows or sensors that could not be analysed, and why.
    pub not_analysed: Vec<String>,
    /// How it ended.
    pub end: RunEnd,
}

impl RunResult {
    /// Simulated time over wall time of the stepping.
    pub fn realtime_factor(&self) -> f64 {
        self.simulated_s / self.stepping_s.max(f64::MIN_POSITIVE)
    }

    /// Length of a step, s; of a method with steps of its own their mean.
    pub fn step_s(&self) -> f64 {
        if self.method.chooses_its_steps() {
            self.simulated_s / (self.statistics.steps.max(1) as f64)
        } else {
            self.schedule.step()
        }
    }

    /// Whether the outer race has no defect.
    pub fn outer_race_is_sound(&self) -> bool {
        let mut defects = self.setup.race_defects.iter();
        !defects.any(|defect| defect.race() == Race::Outer)
    }

    /// Everything about the bearing in one table.
    pub fn bearing_table(&self) -> Table {
        bearing_table(&self.setup, &self.contacts, Some(&self.equilibrium))
    }

    /// A sensor's acceleration as a series, m/s^2.
    ///
    /// # Errors
    /// [`StageError::Series`] if nothing was recorded.
    pub fn signal(&self, sensor: usize) -> Result<TimeSeries, StageError> {
        let start = self.record.time_s.first().copied().unwrap_or(0.0);
        let values = self.record.sensors[sensor].1.clone();
        Ok(TimeSeries::new(
            start,
            self.schedule.interval,
            "m/s^2",
            values,
        )?)
    }
}

/// Carries the command out.
///
/// # Errors
/// [`StageError`]; a solution that blows up is no error here but a [`RunEnd`].
pub fn compute_run(case: &Case, watch: &impl Watch) -> Result<RunResult, StageError> {
    refuse_structural_damping(case)?;
    let stage = StructureStage::build(case, watch)?;
    // a run without ring, bearing, shaft or transient was refused with the case
    let bearing = (bearing_setup(case)?, race_contacts(case)?);
    let (Some(stage), (Some(setup), Some(contacts)), Some(asked)) =
        (stage, bearing, case.transient.as_ref())
    else {
        return Err(crate::system::SystemError::NotSupported.into());
    };
    if let Some(imported) = &stage.imported {
        imported.refuse_structural_damping()?;
    }
    watch.stage("equilibrium");
    let statics = Statics::compute(&stage, &setup, asked.start)?;
    let condition = StaticCondition::at(&setup, asked.start);
    let equilibrium = Equilibrium::find(&stage.structure, &setup, condition)?;
    watch.stage("linearise");
    let loaded = LoadedModes::at(&stage.structure, &stage.modes, &setup, &equilibrium)?;
    let method = method(asked);
    let mut system = CoupledSystem::new(
        &stage.structure,
        &stage.modes,
        setup.clone(),
        selection(case, &setup, method),
        damping(case)?,
        asked.residual,
    )?;
    let step = match asked.step {
        StepLength::Seconds(step) => step,
        StepLength::Auto => auto_step(method, &setup, &equilibrium, &system),
    };
    let interval = 1.0 / asked.output_hz;
    let mut schedule = Schedule::covering(asked.end - asked.start, interval, step)?;
    let wanted = usize::try_from(schedule.intervals)
        .unwrap_or(usize::MAX)
        .saturating_add(1);
    let mut recorder = Recorder::new(
        &system,
        schedule.steps_per_interval,
        schedule.step(),
        wanted,
    )?;
    schedule.intervals += recorder.intervals_past_the_end();
    let mut state = system.state_at(asked.start, &equilibrium, &stage.modes);
    watch.stage("step");
    let clock = Instant::now();
    let report_every = (schedule.intervals / 1000).max(1);
    let stepped = integrate(
        &mut system,
        method,
        &schedule,
        &mut state,
        &mut recorder,
        |done, total| {
            if done.is_multiple_of(report_every) {
                watch.fraction(done as f64 / total as f64);
            }
            Stepping::Continue
        },
    );
    let stepping_s = clock.elapsed().as_secs_f64();
    let simulated_s = state.t - asked.start;
    let modes = system.modes();
    let residual = system.has_residual();
    let (statistics, end, record) = match stepped {
        Ok(statistics) => (statistics, RunEnd::Complete, recorder.finish()),
        Err(error) => {
            let TransientError::BlewUp {
                good_intervals,
                statistics,
                ..
            } = error
            else {
                return Err(error.into());
            };
            let record = recorder.finish_after(good_intervals);
            (statistics, RunEnd::BlewUp(error), record)
        }
    };
    let mut result = RunResult {
        modes,
        residual,
        stage,
        setup,
        contacts,
        equilibrium,
        statics,
        loaded,
        method,
        schedule,
        statistics,
        simulated_s,
        stepping_s,
        record,
        windows: Vec::new(),
        not_analysed: Vec::new(),
        end,
    };
    watch.stage("analyse");
    result.analyse(case);
    Ok(result)
}

impl RunResult {
    /// Envelope analysis of every sensor; a window that the record does not reach is named instead.
    fn analyse(&mut self, case: &Case) {
        for (index, (name, _)) in self.record.sensors.clone().iter().enumerate() {
            let analysed = self
                .signal(index)
                .and_then(|signal| analyse(case, name, &signal, &self.setup));
            match analysed {
                Ok(windows) => self.windows.extend(windows),
                Err(error) => self.not_analysed.push(format!("{name}: {error}")),
            }
        }
    }
}

/// The method that a case asks for.
fn method(asked: &case::Transient) -> Method {
    match asked.method {
        case::Method::Auto | case::Method::Exponential => Method::Exponential,
        case::Method::NewmarkExplicit => Method::NewmarkExplicit,
        case::Method::ExponentialAdams => Method::ExponentialAdams,
        case::Method::Splitting => Method::Splitting,
        case::Method::Newmark => Method::Newmark,
        case::Method::GeneralizedAlpha => Method::GeneralizedAlpha {
            spectral_radius: asked.spectral_radius.unwrap_or(SPECTRAL_RADIUS),
        },
        case::Method::Dop853 => Method::Dop853 {
            tolerance: asked.tolerance.unwrap_or(TOLERANCE),
            events: true,
        },
    }
}

fn selection(case: &Case, setup: &BearingSetup, method: Method) -> ModeSelection {
    let top = case.band_hz().map_or(40e3, |band| band[1]);
    let kept = case
        .transient
        .as_ref()
        .map_or(ModesKept::Auto, |transient| transient.modes);
    match kept {
        ModesKept::All => ModeSelection::All,
        ModesKept::Count(count) => ModeSelection::Count(count),
        // the source's method steps all ring displacements, and its equations need them
        ModesKept::Auto
            if method == Method::NewmarkExplicit || setup.formulation == Formulation::Printed =>
        {
            ModeSelection::All
        }
        // the static residual stands for the rest
        ModesKept::Auto => ModeSelection::UpTo(MODELLED * top),
    }
}

/// Step that resolves the fastest motion on the contacts at [`AUTO_FORCE`] times the largest static force, with
/// `k' = 3/2 k^(2/3) F^(1/3)`: that of a ball between both, `h = AUTO_PHASE / sqrt((k_i' + k_o') / m_b)`, or without the
/// balls' inertia that of race and shaft on both in series.
fn auto_step(
    method: Method,
    setup: &BearingSetup,
    equilibrium: &Equilibrium,
    system: &CoupledSystem,
) -> f64 {
    let largest = equilibrium
        .balls
        .iter()
        .map(|ball| ball.inner.max(ball.outer))
        .fold(setup.geometry.ball_mass() * 9.81, f64::max);
    let tangent = |stiffness: f64| 1.5 * stiffness.cbrt().powi(2) * (AUTO_FORCE * largest).cbrt();
    let [inner, outer] = [setup.stiffness.inner(), setup.stiffness.outer()].map(tangent);
    let stiffness = match setup.balls_inertia {
        BallsInertia::Dynamic => inner + outer,
        BallsInertia::QuasiStatic => inner * outer / (inner + outer),
    };
    let resolved = AUTO_PHASE / (stiffness * system.contact_mobility()).sqrt();
    if method == Method::NewmarkExplicit {
        let highest = system.highest_squared_frequency().sqrt();
        // half the stability limit, and never above the source's own step
        NEWMARK_STEP.min(1.0 / highest.max(f64::MIN_POSITIVE))
    } else {
        resolved
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Source;
    use crate::stages::Unwatched;

    /// What a run of an example says with these keys set.
    fn message(set: &[&str]) -> String {
        let root = env!("CARGO_MANIFEST_DIR");
        let path = format!("{root}/examples/tadina2011/outer-dent.toml");
        let case = Case::from_source(Source {
            text: std::fs::read_to_string(&path).unwrap(),
            path: path.into(),
            set: set.iter().map(|set| (*set).to_owned()).collect(),
        });
        compute_run(&case.unwrap(), &Unwatched)
            .unwrap_err()
            .to_string()
    }

    fn smooth(set: &[&str]) -> RunResult {
        let root = env!("CARGO_MANIFEST_DIR");
        let path = format!("{root}/examples/scenes/smooth.toml");
        let set = ["transient.end=1e-3"].iter().chain(set);
        let case = Case::from_source(Source {
            text: std::fs::read_to_string(&path).unwrap(),
            path: path.into(),
            set: set.map(|set| (*set).to_owned()).collect(),
        });
        compute_run(&case.unwrap(), &Unwatched).unwrap()
    }

    /// A smooth scene, 1 ms: from rest the unbalance and the turning balls excite it.
    #[test]
    fn implicit_methods_give_the_signal_of_the_exponential_one() {
        let step = "transient.step=2e-8";
        let expected = smooth(&[step]).signal(0).unwrap();
        let rms = |values: &mut dyn Iterator<Item = f64>| {
            let squares: Vec<f64> = values.map(|value| value * value).collect();
            (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
        };
        let size = rms(&mut expected.values().iter().copied());
        for set in [
            ["transient.method=newmark", step],
            ["transient.method=generalized-alpha", step],
            ["transient.method=newmark", "transient.step=1e-7"],
        ] {
            let result = smooth(&set);
            let found = result.signal(0).unwrap();
            let pairs = found.values().iter().zip(expected.values());
            let difference = rms(&mut pairs.map(|(a, b)| a - b)) / size;
            let counts = result.statistics;
            let solves = counts.solves as f64 / counts.steps as f64;
            let cost = result.stepping_s / counts.steps as f64;
            println!(
                "{set:?}: {difference:.1e} of {size:.1e} m/s^2, {solves:.2} solves and {cost:.1e} s a step"
            );
            // found 1.7e-5 and 1.8e-5, and 5.0e-4 at the longer step: the period's error (w h)^2 / 12
            assert!(difference < 1e-3, "{set:?}: {difference:e}");
            // two corrections find it, the second without being applied anew
            assert!(solves < 2.5, "{set:?}: {solves}");
        }
    }

    /// The first ball climbs out of a dent, and the others lift off and land.
    #[test]
    fn implicit_methods_solve_impacts() {
        let dented = |method: &str| {
            let method = format!("transient.method={method}");
            smooth(&[
                "transient.end=4e-3",
                "transient.step=1e-7",
                "bearing.radial_play=2.5e-6",
                "bearing.defects=[{on='outer',angle_deg=270,length=0.75e-3,width=0.41e-3,depth=15e-6,rim_radius=0.05e-3}]",
                &method,
            ])
        };
        let expected = dented("exponential");
        let peak = |result: &RunResult| {
            let values = result.record.outer_force.iter();
            values.fold(0.0, |most: f64, force| most.max(*force))
        };
        for method in ["newmark", "generalized-alpha"] {
            let result = dented(method);
            assert!(matches!(result.end, RunEnd::Complete), "{:?}", result.end);
            let solves = result.statistics.solves as f64 / result.statistics.steps as f64;
            let (found, expected) = (peak(&result), peak(&expected));
            println!("{method}: {solves:.2} solves a step, {found:.3} N, {expected:.3} N");
            assert!(solves < 3.0, "{method}: {solves}");
            // many times the static force: impacts
            assert!(found > 3.0, "{method}: {found} N");
            assert!((found / expected - 1.0).abs() < 0.02, "{method}: {found} N");
        }
    }

    #[test]
    fn structural_damping_is_refused_before_anything_is_computed() {
        let (lossy, nowhere) = (
            "materials.aluminium.loss_factor=0.01",
            "housing.mesh=nowhere.msh",
        );
        assert_eq!(
            message(&[lossy, nowhere]),
            "materials.aluminium: loss_factor = 0.01 is structural damping, which has a meaning for harmonic motion alone (frf); a run steps through time: leave the key out and give [damping]"
        );
        let none = message(&["materials.aluminium.loss_factor=0", nowhere]);
        assert!(none.contains("nowhere.msh"), "{none}");
    }
}
