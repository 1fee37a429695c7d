//! How many modes of ring and housing a run keeps.
//!
//! What leaving modes out does to the signals, estimated before anything is stepped.
//!
//! A force at the raceway reaches a sensor through `H(w) = sum phi_s phi_c / (w_i^2 - w^2 + i w c_i)`, and moves the raceway
//! under itself through the same with `phi_c phi_c`. With the first m modes and the static residual of the others the terms
//! beyond m lose `1 / (w_i^2 - w^2 + i w c_i) - 1 / w_i^2`, without it all of themselves. Over the band, for a force of equal
//! size at every frequency (Craig 1981, Structural Dynamics, section 11.3, for one frequency)
//!
//! ```text
//! path     rms of w^2 dH at the sensors over rms of w^2 H, the worst sensor
//! contact  rms of k dH at the raceway, the worst place: the relative change of a contact force; k both contacts in series
//! ```
//!
//! and the estimate is the root of the sum of both squares, and with the static residual of the square of what the loaded system
//! loses ([`LoadedErrors`]). Where nothing damps the contacts the balls' own vibration stays, far
//! above the band, and what a wrong raceway does to its period adds up: there the contact's frequencies go up to that of a ball
//! under an impact, and it counts [`ADDS_UP`] times.

use super::loaded_errors::LoadedErrors;
use super::model_choice::ChosenPart;
use super::quantities::{IMPACT, RunTask, ball_hz, judged, participations, radial_forces, tangent};
use crate::app::case::ModesKept;
use crate::app::error::ComputeError;
use crate::app::scene::Scene;
use crate::report::significant;
use crate::system::ModeSelection;
use std::f64::consts::TAU;

/// Part of the target that the modes left out may take: their estimate was found within a factor of three of the error on the
/// dented bearing of `examples/tadina2011`.
const MODES_SHARE: f64 = 0.2;

/// Modes closer than this belong together: one of two alone would give the ring a direction.
const PAIR: f64 = 1e-3;

/// Modes of ring and housing, and what leaving the others out costs.
pub(crate) fn modes(task: RunTask<'_>, errors: &ModeErrors, whole: bool) -> (ModeSelection, ChosenPart) {
    let RunTask { scene, asked, band_hz, target, .. } = task;
    let (all, known) = (scene.stage.structure.dof(), scene.stage.modes.count());
    let (selection, why) = match asked.modes {
        ModesKept::All => (ModeSelection::All, "given".to_owned()),
        ModesKept::Count(count) if count > known => {
            (ModeSelection::Count(known), format!("given: {count}, of which there are {known}"))
        }
        ModesKept::Count(count) => (ModeSelection::Count(count), "given".to_owned()),
        ModesKept::Auto if whole => {
            (ModeSelection::All, "the equations or the method need all displacements of the ring".to_owned())
        }
        ModesKept::Auto => {
            let share = MODES_SHARE * target;
            let fewest = with_pairs(scene, errors.fewest(share, asked.residual));
            let mut why = format!(
                "the fewest with a linear estimate of at most {} of the target in the band up to {} kHz",
                significant(MODES_SHARE, 2),
                significant(band_hz / 1e3, 4)
            );
            if let Some(ball_hz) = undamped_ball_hz(scene) {
                why += &format!(
                    ", and at contacts that nothing damps up to {} kHz, where balls vibrate",
                    significant(ball_hz / 1e3, 3)
                );
            }
            (ModeSelection::Count(fewest), why)
        }
    };
    let kept = match selection {
        ModeSelection::Count(count) => count,
        _ => known,
    };
    let highest = scene.stage.modes.frequency_hz(kept.saturating_sub(1));
    let left = match (kept < all, asked.residual) {
        (false, _) => "nothing left out",
        (true, true) => "of the others only their inertia is left out",
        (true, false) => "the others are left out",
    };
    let mut why = format!("{why}; {left}");
    let (looked_at, sensors) = (judged(scene).count(), scene.stage.structure.sensors().len());
    if looked_at < sensors {
        why += &format!("; estimated at {looked_at} of the {sensors} sensors");
    }
    let part = ChosenPart {
        what: "modes",
        chosen: format!(
            "{kept} of {all}, up to {} kHz{}",
            significant(highest / 1e3, 4),
            if kept < all && asked.residual { ", static residual of the others" } else { "" }
        ),
        why,
        estimated_error: Some(errors.with(kept, asked.residual)),
    };
    (selection, part)
}

/// So many modes, and those that belong to the last one.
fn with_pairs(scene: &Scene, count: usize) -> usize {
    let modes = &scene.stage.modes;
    let mut kept = count.clamp(1, modes.count());
    while kept < modes.count() && modes.frequency_hz(kept) <= (1.0 + PAIR) * modes.frequency_hz(kept - 1) {
        kept += 1;
    }
    kept
}

/// Frequencies at which the band is looked at, and places on the raceway between two balls.
const FREQUENCIES: usize = 64;
const PLACES: usize = 2;

/// What an error of the contact makes of itself where nothing damps it: on the rattling shaft of `examples/scenes` an estimate of
/// 1.2e-3 without it made 4.2 % over two milliseconds, and one of 1.7e-3 with it makes 0.8 %.
/// Calibrated on that scene alone.
const ADDS_UP: f64 = 10.0;

/// Estimates for every number of kept modes.
#[derive(Debug, Clone)]
pub(crate) struct ModeErrors {
    /// With the lowest m modes, from none to all: without and with the static residual of the others.
    by_count: Vec<[f64; 2]>,
}

/// Real and imaginary part.
type Complex = [f64; 2];

impl ModeErrors {
    /// For a band up to `band_hz`, with what the loaded system loses.
    ///
    /// # Errors
    /// [`ComputeError`] for damping out of range.
    pub(crate) fn of(scene: &Scene, band_hz: f64, loaded: &LoadedErrors) -> Result<Self, ComputeError> {
        let modes = &scene.stage.modes;
        let rates = scene.damping.rates(&modes.squared_frequencies)?;
        let count = PLACES * scene.setup.balls();
        // all round the raceway
        let contacts = radial_forces(scene, (0..count).map(|number| TAU * number as f64 / count as f64));
        let sensors: Vec<Vec<f64>> = judged(scene).map(|sensor| participations(modes, &sensor.row)).collect();
        let stiffness = in_series(scene);
        let frequencies: Vec<f64> = (1..=FREQUENCIES).map(|k| TAU * band_hz * k as f64 / FREQUENCIES as f64).collect();
        let highest = undamped_ball_hz(scene).map_or(band_hz, |ball_hz| ball_hz.max(band_hz));
        let widening = highest / band_hz;
        let adds_up = undamped_ball_hz(scene).map_or(1.0, |_| ADDS_UP);
        let mut paths = Lost::new(sensors.len() * contacts.len() * FREQUENCIES);
        let mut places = Lost::new(contacts.len() * FREQUENCIES);
        let count = modes.count();
        let mut by_count = vec![[0.0; 2]; count + 1];
        let mut lost = Vec::with_capacity(count);
        for mode in (0..count).rev() {
            let share = |w: f64| shares(modes.squared_frequencies[mode], rates[mode], w);
            let weighted: Vec<_> = frequencies.iter().map(|&w| (w * w, share(w))).collect();
            let mut place = 0;
            for sensor in &sensors {
                for contact in &contacts {
                    for (square, share) in &weighted {
                        paths.add(place, square * sensor[mode] * contact[mode], share);
                        place += 1;
                    }
                }
            }
            let wide: Vec<_> = frequencies.iter().map(|&w| share(widening * w)).collect();
            for (number, contact) in contacts.iter().enumerate() {
                for (k, share) in wide.iter().enumerate() {
                    let scale = adds_up * stiffness * contact[mode] * contact[mode];
                    places.add(number * FREQUENCIES + k, scale, share);
                }
            }
            let by_sensor = paths.squares(contacts.len() * FREQUENCIES);
            let by_place = places.squares(FREQUENCIES);
            lost.push((by_sensor, by_place));
        }
        // with no mode left the sums are those of the whole
        let whole = paths.squares(contacts.len() * FREQUENCIES);
        for (mode, (by_sensor, by_place)) in (0..count).rev().zip(lost) {
            for kind in 0..2 {
                let path = by_sensor.iter().zip(&whole);
                let path = path.map(|(lost, whole)| lost[kind] / whole[0].max(f64::MIN_POSITIVE));
                let contact = by_place.iter().map(|lost| lost[kind] / FREQUENCIES as f64);
                let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
                by_count[mode][kind] = (most(&mut path.into_iter()) + most(&mut contact.into_iter())).sqrt();
            }
            let [_, with_residual] = &mut by_count[mode];
            *with_residual = with_residual.hypot(loaded.with(mode));
        }
        Ok(Self { by_count })
    }

    /// With so many of the lowest modes.
    pub(crate) fn with(&self, modes: usize, residual: bool) -> f64 {
        self.by_count.get(modes).map_or(0.0, |errors| errors[usize::from(residual)])
    }

    /// The fewest modes with an estimate of at most `target`, at least one.
    pub(crate) fn fewest(&self, target: f64, residual: bool) -> usize {
        let kind = usize::from(residual);
        let enough = |errors: &[f64; 2]| errors[kind] <= target;
        // from above: an estimate may fall below the target and rise again
        let last = self.by_count.iter().rposition(|errors| !enough(errors));
        last.map_or(1, |last| last + 1).max(1)
    }
}

/// What is lost at some entries, without and with the residual.
struct Lost([Vec<Complex>; 2]);

impl Lost {
    fn new(entries: usize) -> Self {
        Self([vec![[0.0; 2]; entries], vec![[0.0; 2]; entries]])
    }

    fn add(&mut self, entry: usize, scale: f64, shares: &[Complex; 2]) {
        for (sums, share) in self.0.iter_mut().zip(shares) {
            for (sum, part) in sums[entry].iter_mut().zip(share) {
                *sum += scale * part;
            }
        }
    }

    /// Sums of the squares over stretches of so many entries.
    fn squares(&self, stretch: usize) -> Vec<[f64; 2]> {
        let [without, with] = &self.0;
        let square = |entries: &[Complex]| entries.iter().flatten().map(|x| x * x).sum::<f64>();
        let both = without.chunks(stretch).zip(with.chunks(stretch));
        both.map(|(without, with)| [square(without), square(with)]).collect()
    }
}

/// What a mode of unit participation and a damping (1/s) contributes, and what of it the static residual does not give.
fn shares(squared_frequency: f64, damping: f64, w: f64) -> [Complex; 2] {
    let stiff = squared_frequency - w * w;
    let damp = w * damping;
    let size = (stiff * stiff + damp * damp).max(f64::MIN_POSITIVE);
    let whole = [stiff / size, -damp / size];
    let softness = 1.0 / squared_frequency.max(f64::MIN_POSITIVE);
    [whole, [whole[0] - softness, whole[1]]]
}

/// How fast a ball vibrates under ten times the largest static force where contact damping takes nothing from it, Hz.
pub(crate) fn undamped_ball_hz(scene: &Scene) -> Option<f64> {
    let force = IMPACT * largest_force(scene);
    (scene.setup.contact_damping <= 0.0).then(|| ball_hz(scene, force, force))
}

fn largest_force(scene: &Scene) -> f64 {
    let forces = scene.equilibrium.balls.iter();
    forces.fold(0.0, |most: f64, ball| most.max(ball.inner.max(ball.outer)))
}

/// Stiffness of both contacts of the ball with the largest load in series, `k' = 3/2 k^(2/3) F^(1/3)` each, N/m.
fn in_series(scene: &Scene) -> f64 {
    let largest = largest_force(scene);
    let stiffness = &scene.setup.stiffness;
    1.0 / (1.0 / tangent(stiffness.inner(), largest) + 1.0 / tangent(stiffness.outer(), largest))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::case::Case;
    use crate::app::commands::run::choice::loaded_errors::RESPONSE_SAFETY;
    use crate::numerics::Unwatched;

    fn errors(scene: &Scene) -> ModeErrors {
        let loaded = LoadedErrors::of(scene, None, 40e3, 5e-3).unwrap();
        ModeErrors::of(scene, 40e3, &loaded).unwrap()
    }

    fn dented() -> Scene {
        dented_with(&[])
    }

    fn dented_with(keys: &[&str]) -> Scene {
        let set = [&["transient.start=2.3"], keys].concat();
        let case = Case::example("tadina2011/outer-dent", &set);
        Scene::build(case.for_run().unwrap(), &Unwatched).unwrap()
    }

    /// Measured with dop853 against all 216 modes over 5 ms from 2.3 s: 4.4e-3 (5 modes and residual), 6.4e-4 (7), 2.4e-4 (13);
    /// over the impacts until 6 ms, which dominate without residual, 7.3e-2 (7), 3.4e-2 (13), 8e-3 (31).
    #[test]
    fn estimates_are_near_the_errors_of_runs() {
        let errors = errors(&dented());
        for (modes, measured) in [(5, 4.4e-3), (7, 6.4e-4), (13, 2.4e-4)] {
            let ratio = errors.with(modes, true) / (RESPONSE_SAFETY * measured);
            // a flat spectrum of forces stands for that of the scene
            assert!((0.25..4.0).contains(&ratio), "{modes}: {ratio}");
        }
        for (modes, measured) in [(7, 7.3e-2), (13, 3.4e-2), (31, 8e-3)] {
            let ratio = errors.with(modes, false) / measured;
            assert!((0.1..4.0).contains(&ratio), "{modes}: {ratio}");
        }
    }

    #[test]
    fn the_fewest_modes_hold_the_target_and_one_less_does_not() {
        let scene = dented();
        let errors = errors(&scene);
        for target in [1e-2, 1e-3, 1e-4] {
            for residual in [false, true] {
                let fewest = errors.fewest(target, residual);
                assert!(errors.with(fewest, residual) <= target);
                assert!(fewest == 1 || errors.with(fewest - 1, residual) > target);
            }
            assert!(errors.fewest(target, true) < errors.fewest(target, false));
        }
        assert!(errors.with(scene.stage.modes.count(), false) < f64::MIN_POSITIVE);
    }

    #[test]
    fn contacts_that_nothing_damps_ask_for_the_balls_own_frequency() {
        let (damped, undamped) = (dented(), dented_with(&["bearing.contact_damping=0"]));
        assert!(undamped_ball_hz(&damped).is_none());
        let hz = undamped_ball_hz(&undamped).unwrap();
        // the 80 to 117 kHz of a ball under the weight, times ten to the power 1/6
        assert!((117e3..175e3).contains(&hz), "{hz}");
        let fewest = |scene: &Scene| errors(scene).fewest(2e-3, true);
        let kept = fewest(&undamped);
        assert!(kept > fewest(&damped) + 4, "{kept}");
        // all that a ball can be in resonance with
        assert!(undamped.stage.modes.frequency_hz(kept - 1) > hz);
    }
}
