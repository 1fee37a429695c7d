//! `plummer run`: equilibrium, transient, signals, analysis.

use super::machine::{BearingModel, Machine, PlaneMachine, SpatialMachine};
use super::machine_verdict::MachineVerdict;
use super::recording::{Checkpoints, InMemory, Recording};
use super::scalogram::SensorScalogram;
use super::simulation::{RunEnd, Simulation, Span};
use crate::app::case::{AskedRun, Case, RunCase, SpatialCase, Transient};
use crate::app::commands::analyze::{AnalysisSettings, WindowAnalysis, analyse};
use crate::app::commands::run::choice::{Horizon, ModelChoice};
use crate::app::error::ComputeError;
use crate::app::scene::{CoupledStructure, MachineScene, Scene};
use crate::bearing::Cage;
use crate::bearing::kinematics::DefectOrders;
use crate::numerics::Watch;
use crate::report::significant;
use crate::signal::diagnosis::Kinematics;
use crate::system::{BearingSetup, EnergyBalance, LoadedModes, RunRecord, Statics};
use std::sync::Arc;

/// Samples up to which the balance of energy is taken unless the case says otherwise: it takes 4300 to 9700 instructions a sample
/// (callgrind, seven modes with residual), 0.2 s of the wall's clock then.
const ENERGY_SAMPLES: f64 = 1e5;

/// Why there is no balance of energy.
const NO_ENERGY: &str = "energy: a balance needs `bearing.formulation = \"consistent\"`, whose forces have potentials, and `bearing.balls_inertia = \"dynamic\"`";

/// Result of a run.
#[derive(Debug)]
pub struct RunResult<R = RunRecord> {
    /// What was simulated.
    pub machine: Machine,
    /// Which model of the bearing it is, and why.
    pub bearing_model: BearingModel,
    /// The model, and why it is this one.
    pub choice: ModelChoice,
    /// How long its estimated error was seen to hold; `None` where this was not measured.
    pub horizon: Option<Horizon>,
    /// The signals, and what they took.
    pub simulation: Simulation<R>,
    /// Analysed windows of all sensors, bearing by bearing.
    pub windows: Vec<WindowAnalysis>,
    /// Scalograms of all sensors, if the case asks for them.
    pub scalograms: Vec<SensorScalogram>,
    /// Windows or sensors that could not be analysed, and why.
    pub not_analysed: Vec<String>,
    /// The scene's doubts, and what of the model errs by more than the target.
    pub warnings: Vec<String>,
}

/// Carries the command out, its signals in memory.
///
/// # Errors
/// [`ComputeError`]; a solution that blows up is no error here but a [`RunEnd`](super::RunEnd).
pub fn compute_run(case: &Case, watch: &impl Watch) -> Result<RunResult, ComputeError> {
    compute_kept_run(case, watch, &mut InMemory)
}

/// The model that a case's run would take, without running it, and warnings about the case and it, a sentence each.
///
/// # Errors
/// As [`compute_run`].
pub(crate) fn explain_run(case: &Case, watch: &impl Watch) -> Result<(ModelChoice, Vec<String>), ComputeError> {
    let (choice, doubts) = match case.asked_run("`run`")? {
        AskedRun::InPlane(run) => {
            let scene = Scene::build(run, watch)?;
            watch.stage("choose the model");
            (ModelChoice::of_case(run, &scene)?, scene.doubts)
        }
        AskedRun::InSpace(spatial, asked) => {
            let scene = MachineScene::build(&spatial, [asked.start, asked.end], watch)?;
            watch.stage("choose the model");
            (ModelChoice::in_space(case, asked, &scene)?, scene.doubts)
        }
    };
    let warnings = [doubts, choice.warnings()].concat();
    Ok((choice, warnings))
}

/// Carries the command out with its signals where `checkpoints` has them, from the last one on.
///
/// # Errors
/// As [`compute_run`], [`ComputeError::Interrupted`] and what `checkpoints` returns.
pub fn compute_kept_run<C: Checkpoints>(
    case: &Case,
    watch: &impl Watch,
    checkpoints: &mut C,
) -> Result<RunResult<C::Record>, ComputeError> {
    match case.asked_run("`run`")? {
        AskedRun::InPlane(run) => run_in_plane(run, watch, checkpoints),
        AskedRun::InSpace(spatial, asked) => run_in_space(&spatial, asked, watch, checkpoints),
    }
}

fn run_in_plane<C: Checkpoints>(
    run: RunCase<'_>,
    watch: &impl Watch,
    checkpoints: &mut C,
) -> Result<RunResult<C::Record>, ComputeError> {
    let (case, asked) = (run.case, run.transient);
    let mut scene = Scene::build(run, watch)?;
    told_first(scene.heavy_damping(asked.end - asked.start), watch);
    let statics = Statics::compute(&scene.stage.structure, &scene.setup, asked.start)?;
    watch.stage("linearise");
    let loaded = LoadedModes::at(&scene.stage.structure, &scene.stage.modes, &scene.setup, &scene.equilibrium)?;
    watch.stage("choose the model");
    let mut choice = ModelChoice::of_case(run, &scene)?;
    scene.setup.balls_inertia = choice.model.balls_inertia;
    watch.stage("compare with a finer run");
    let horizon = Horizon::of_any(case, asked, &scene, &mut choice);
    watch.stage("step");
    let (span, energy) = (span(asked), takes_energy(case, asked, &choice));
    let fraction = |done| watch.fraction(done);
    let simulation = Simulation::kept_from_rest(&scene, &choice.model, span, energy, checkpoints, fraction)?;
    let machine = Machine::InPlane(Box::new(PlaneMachine { scene, statics, loaded }));
    watch.stage("analyse");
    Ok(RunResult::analysed(case, machine, BearingModel::in_plane(), choice, horizon, simulation))
}

/// Tells why a run takes long before it does.
fn told_first(doubts: impl IntoIterator<Item = String>, watch: &impl Watch) {
    doubts.into_iter().for_each(|doubt| watch.note(&format!("warning: {doubt}")));
}

fn run_in_space<C: Checkpoints>(
    spatial: &SpatialCase<'_>,
    asked: &Transient,
    watch: &impl Watch,
    checkpoints: &mut C,
) -> Result<RunResult<C::Record>, ComputeError> {
    let case = spatial.case;
    let scene = MachineScene::build(spatial, [asked.start, asked.end], watch)?;
    told_first(scene.heavy_damping(&spatial.seats, asked.end - asked.start), watch);
    let equilibria = scene.equilibria()?;
    watch.stage("linearise");
    let loaded = scene.loaded_modes()?;
    watch.stage("choose the model");
    let mut choice = ModelChoice::in_space(case, asked, &scene)?;
    watch.stage("compare with a finer run");
    let horizon = Horizon::of_any(case, asked, &scene, &mut choice);
    watch.stage("compare with sound bearings");
    let damage = scene.damage_shown(case, asked, &choice.model);
    watch.stage("step");
    let (span, energy) = (span(asked), takes_energy(case, asked, &choice));
    let (system, state) = scene.at_rest(&choice.model, scene.start)?;
    let fraction = |done| watch.fraction(done);
    let simulation = Simulation::kept(system, state, &choice.model, span, energy, checkpoints, fraction)?;
    let machine = Machine::InSpace(Box::new(SpatialMachine { scene, equilibria, loaded, damage }));
    watch.stage("analyse");
    Ok(RunResult::analysed(case, machine, BearingModel::in_space(spatial), choice, horizon, simulation))
}

/// The signals of a run alone: without what its page says of rest, modes and verdicts.
pub(crate) struct SteppedRun<R> {
    /// The model, and why it is this one.
    pub(crate) choice: ModelChoice,
    /// The signals.
    pub(crate) simulation: Simulation<R>,
    /// Of each bearing its cage, the number of its balls and the orders of pure rolling.
    pub(crate) bearings: Vec<(Cage, u32, DefectOrders)>,
}

/// Steps a run around rings and housing that are built already, of a case that has the same.
///
/// # Errors
/// As [`compute_run`].
pub(crate) fn step_run<C: Checkpoints>(
    run: &AskedRun<'_>,
    stage: Arc<CoupledStructure>,
    checkpoints: &mut C,
) -> Result<SteppedRun<C::Record>, ComputeError> {
    match run {
        AskedRun::InPlane(run) => {
            let mut scene = Scene::around(stage, *run)?;
            let choice = ModelChoice::of_case(*run, &scene)?;
            scene.setup.balls_inertia = choice.model.balls_inertia;
            let span = span(run.transient);
            let simulation = Simulation::kept_from_rest(&scene, &choice.model, span, false, checkpoints, |_| ())?;
            let BearingSetup { cage, geometry, .. } = scene.setup;
            Ok(SteppedRun { choice, simulation, bearings: vec![(cage, geometry.balls(), geometry.orders())] })
        }
        AskedRun::InSpace(spatial, asked) => {
            let scene = MachineScene::around(stage, spatial, [asked.start, asked.end])?;
            let choice = ModelChoice::in_space(spatial.case, asked, &scene)?;
            let (system, state) = scene.at_rest(&choice.model, scene.start)?;
            let simulation = Simulation::kept(system, state, &choice.model, span(asked), false, checkpoints, |_| ())?;
            let own = scene.setup.bearings.into_iter().zip(scene.orders);
            let bearings = own.map(|(own, orders)| (own.cage, own.bearing.geometry().balls(), orders)).collect();
            Ok(SteppedRun { choice, simulation, bearings })
        }
    }
}

fn span(asked: &Transient) -> Span {
    Span { duration: asked.end - asked.start, output_hz: asked.output_hz }
}

fn takes_energy(case: &Case, asked: &Transient, choice: &ModelChoice) -> bool {
    let samples = (asked.end - asked.start) / choice.model.step;
    case.analysis.energy.unwrap_or(samples <= ENERGY_SAMPLES)
}

/// Energy that does not add up, in units of what was exchanged, from which on a run is doubted. Runs in steps that resolve their contacts missed by 6e-3
/// at most. One in steps that did not missed by 0.075, as a burst of 6 ms in 48 ms was 18 times too loud, another by 0.9.
const ENERGY_GAP: f64 = 0.01;
/// What is exchanged where nothing moves but by round-off is less, J: at rest 1e-17 were.
const LEAST_EXCHANGED_J: f64 = 1e-12;

fn energy_warning(energy: Option<&EnergyBalance>) -> Option<String> {
    let gap = energy.filter(|energy| energy.exchanged_j > LEAST_EXCHANGED_J)?.error();
    (gap.abs() > ENERGY_GAP).then(|| {
        format!(
            "The energy balance misses by {} of all that was exchanged: the steps make energy, and the signals cannot be trusted. Leave transient.step to the program, or shorten it until the balance closes.",
            significant(gap.abs(), 2)
        )
    })
}

impl<R: Recording> RunResult<R> {
    /// Why the signals cannot be trusted, if they cannot: a warning has the figures.
    #[must_use]
    pub fn distrust(&self) -> Option<&'static str> {
        let unbalanced = energy_warning(self.simulation.energy.as_ref()).map(|_| "the energy balance does not close");
        unbalanced.or_else(|| self.choice.distrust())
    }

    /// What the signals of all sensors say of all bearings, in words.
    pub(crate) fn verdict_on_machine(&self) -> String {
        MachineVerdict::of(&self.windows).words(&self.machine.bearings())
    }

    /// Kept modes, and the vectors that stand for the others, in words.
    pub(crate) fn kept_words(&self) -> String {
        let (modes, dof) = (self.simulation.modes, self.machine.stage().structure.dof());
        let vectors = match self.machine {
            Machine::InPlane(_) => 0,
            Machine::InSpace(_) => modes - self.choice.model.modes.count(&self.machine.stage().modes).min(modes),
        };
        match vectors {
            0 if self.simulation.residual => format!("{modes} of {dof} modes with static residual"),
            0 => format!("{modes} of {dof} modes"),
            vectors => format!("{} of {dof} modes and {vectors} static vectors", modes - vectors),
        }
    }

    /// The estimated error of the signals, and for how long it holds.
    pub(crate) fn estimate_sentence(&self) -> String {
        let choice = &self.choice;
        let Some(error) = choice.estimated_error else {
            return "the error of the signals is not estimated".to_owned();
        };
        let horizon = match error < 1.0 {
            true => self.horizon.map(|horizon| horizon.sentence()),
            false => Some("as large as the signals: compare spectra and verdicts, not samples".to_owned()),
        };
        format!(
            "estimated error of the signals in the band: {} of their RMS (target {}{}), {}",
            significant(error, 2),
            significant(choice.target, 2),
            if error > choice.target { ", missed" } else { "" },
            horizon.as_deref().unwrap_or("while nearby solutions stay together"),
        )
    }

    /// The result of a simulation that has ended, its signals analysed.
    fn analysed(
        case: &Case,
        machine: Machine,
        bearing_model: BearingModel,
        choice: ModelChoice,
        horizon: Option<Horizon>,
        simulation: Simulation<R>,
    ) -> Self {
        let mut warnings = [machine.doubts(), &choice.warnings()].concat();
        warnings.extend(horizon.and_then(|horizon| horizon.warning(choice.estimated_error)));
        warnings.extend(energy_warning(simulation.energy.as_ref()));
        warnings.extend(machine.alike());
        let mut result = Self {
            machine,
            bearing_model,
            choice,
            horizon,
            simulation,
            windows: Vec::new(),
            scalograms: Vec::new(),
            not_analysed: Vec::new(),
            warnings,
        };
        result.analyse(case);
        let complete = matches!(result.simulation.end, RunEnd::Complete);
        if case.analysis.energy == Some(true) && complete && result.simulation.energy.is_none() {
            result.not_analysed.push(NO_ENERGY.to_owned());
        }
        result
    }

    /// Envelope analysis of every sensor for every bearing; a window that the record does not reach is named instead.
    fn analyse(&mut self, case: &Case) {
        let bearings = self.machine.bearings();
        let several: Vec<_> = bearings.iter().filter(|_| bearings.len() > 1).map(|bearing| bearing.orders).collect();
        for (bearing, seat) in bearings.iter().zip(case.seats()) {
            let settings = AnalysisSettings::of(case, seat.bearing, bearing.damage);
            let kinematics = Kinematics::of(bearing.cage, bearing.balls, bearing.orders);
            for (index, name) in self.simulation.record.layout().sensors.iter().enumerate() {
                let read = |window, margin| self.simulation.stretch(index, window, margin);
                match analyse(name, &settings, read, &kinematics) {
                    Ok(windows) => {
                        let windows = windows.into_iter().map(|window| window.of_bearing(bearing.label, &several));
                        self.windows.extend(windows);
                    }
                    Err(error) if seat.is_first() => self.not_analysed.push(format!("{name}: {error}")),
                    Err(_) => {}
                }
            }
        }
        let Some(window) = case.analysis.scalogram else { return };
        for (index, name) in self.simulation.record.layout().sensors.iter().enumerate() {
            match SensorScalogram::of(&self.simulation, index, window) {
                Ok(scalogram) => self.scalograms.push(scalogram),
                Err(error) => self.not_analysed.push(format!("{name}: {error}")),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::commands::run::RunEnd;
    use crate::numerics::Unwatched;
    use crate::numerics::series::TimeSeries;
    use crate::signal::relative_difference;

    /// What a run of an example says with these keys set.
    fn message(set: &[&str]) -> String {
        let case = Case::example("tadina2011/outer-dent", set);
        compute_run(&case, &Unwatched).unwrap_err().to_string()
    }

    /// In seven modes, whose figures are the tests': what a run chooses is another matter.
    fn smooth(set: &[&str]) -> RunResult {
        let set = [&["transient.end=1e-3", "transient.modes=7"], set].concat();
        compute_run(&Case::example("scenes/smooth", &set), &Unwatched).unwrap()
    }

    #[test]
    fn an_error_as_large_as_the_signals_is_told_in_the_place_of_a_horizon() {
        let mut result = smooth(&[]);
        let told = |result: &mut RunResult, error: f64| {
            result.choice.estimated_error = Some(error);
            result.estimate_sentence()
        };
        let head = |error: &str| {
            format!("estimated error of the signals in the band: {error} of their RMS (target 0.010, missed), ")
        };
        assert_eq!(
            told(&mut result, 1.0),
            head("1.0") + "as large as the signals: compare spectra and verdicts, not samples"
        );
        result.horizon = None;
        assert_eq!(told(&mut result, 0.99), head("0.99") + "while nearby solutions stay together");
    }

    /// Relative to what is expected, root mean square.
    fn difference(result: &RunResult, expected: &TimeSeries) -> f64 {
        let found = result.simulation.signal(0).unwrap();
        relative_difference(&found, expected).unwrap()
    }

    /// The signal is a thousandth of what the static forces would make: a tolerance that refers to these does not see how the contacts'
    /// vibrations grow in steps beyond the stable one, and four samples an output interval may be beyond it.
    #[test]
    fn a_signal_small_beside_the_loads_is_right_at_low_output_rates() {
        for rate in ["100e3", "200e3"] {
            let rate = format!("transient.output_hz={rate}");
            let keys = [&rate, "transient.end=2e-3"];
            let by = |more: &[&str]| smooth(&[&keys, more].concat());
            let fine = by(&["transient.method=exponential-adams", "transient.step=1e-7"]);
            let expected = fine.simulation.signal(0).unwrap();
            let difference = difference(&by(&[]), &expected);
            println!("{rate}: {difference:.1e}");
            // the target
            assert!(difference < 1e-2, "{rate}: {difference:e}");
        }
    }

    /// A smooth scene, 1 ms: from rest the unbalance and the turning balls excite it.
    #[test]
    fn implicit_methods_give_the_signal_of_the_exponential_one() {
        let step = "transient.step=2e-8";
        let expected = smooth(&[step]).simulation.signal(0).unwrap();
        for set in [
            ["transient.method=newmark", step],
            ["transient.method=generalized-alpha", step],
            ["transient.method=newmark", "transient.step=1e-7"],
        ] {
            let result = smooth(&set);
            let difference = difference(&result, &expected);
            let counts = result.simulation.statistics;
            let solves = counts.solves as f64 / counts.steps as f64;
            let cost = result.simulation.stepping_s / counts.steps as f64;
            println!("{set:?}: {difference:.1e}, {solves:.2} solves and {cost:.1e} s a step");
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
            let values = result.simulation.record.outer_force.iter();
            values.fold(0.0, |most: f64, force| most.max(*force))
        };
        for method in ["newmark", "generalized-alpha"] {
            let result = dented(method);
            assert!(matches!(result.simulation.end, RunEnd::Complete), "{:?}", result.simulation.end);
            let solves = result.simulation.statistics.solves as f64 / result.simulation.statistics.steps as f64;
            let (found, expected) = (peak(&result), peak(&expected));
            println!("{method}: {solves:.2} solves a step, {found:.3} N, {expected:.3} N");
            assert!(solves < 3.0, "{method}: {solves}");
            // many times the static force: impacts
            assert!(found > 3.0, "{method}: {found} N");
            assert!((found / expected - 1.0).abs() < 0.02, "{method}: {found} N");
        }
    }

    /// The balls are held by both races all the time, so that the limit at one instant is nearly that of the run.
    #[test]
    fn a_blow_up_names_a_step_that_holds_and_leaves_the_instants_before() {
        for method in ["exponential", "exponential-adams"] {
            let with_step = |step: f64| {
                let [method, step] =
                    [format!("method={method}"), format!("step={step:e}")].map(|key| format!("transient.{key}"));
                smooth(&[&method, &step, "transient.output_hz=1e5", "transient.end=2e-3"]).simulation
            };
            let far_too_long = with_step(1e-5);
            let RunEnd::BlewUp(blow_up) = &far_too_long.end else {
                panic!("{method} takes 1e-5 s");
            };
            println!("{blow_up}");
            assert!(blow_up.time - blow_up.good_until < 4.5e-5);
            let limit = blow_up.limit.expect("contacts vibrate").step_s;
            assert!((2e-7..1e-5).contains(&limit), "{limit}");
            // what was good until then is there: the rows whose low-pass does not reach beyond it
            let good = usize::try_from(blow_up.good_intervals).unwrap();
            let instants = far_too_long.record.time_s.len();
            assert!(instants <= good && instants + 15 >= good, "{instants} {good}");
            assert!(matches!(with_step(0.5 * limit).end, RunEnd::Complete));
        }
    }

    #[test]
    fn structural_damping_is_refused_before_anything_is_computed() {
        let (lossy, nowhere) = ("materials.aluminium.loss_factor=0.01", "housing.mesh=nowhere.msh");
        assert_eq!(
            message(&[lossy, nowhere]),
            "materials.aluminium: loss_factor = 0.01 is structural damping, which has a meaning for harmonic motion alone (frf); a run steps through time: leave the key out and give [damping]"
        );
        let none = message(&["materials.aluminium.loss_factor=0", nowhere]);
        assert!(none.contains("nowhere.msh"), "{none}");
    }
}
