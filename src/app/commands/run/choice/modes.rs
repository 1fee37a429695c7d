//! How many modes of ring and housing a run keeps.

use super::mode_errors::{ModeErrors, undamped_ball_hz};
use super::model_choice::ChosenPart;
use super::quantities::{RunTask, judged};
use crate::app::case::ModesKept;
use crate::app::scene::Scene;
use crate::report::significant;
use crate::system::ModeSelection;

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
