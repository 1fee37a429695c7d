//! The two integrators on the same scenes, and the truncated basis against all modes.
//!
//! On the smooth scene (preload, constant 20 Hz, 10 ms) and on the healthy bearing with light
//! contact damping (2 ms from equilibrium at 2.3 s of the run-up), in all modes, the source's explicit
//! Newmark and the exponential method must give the same acceleration at P1, band-limited to 40 kHz
//! and sampled at the same instants. The truncated basis with its static residual is compared with
//! all modes by one method.
//!
//! ```text
//! cargo run --release --example compare_integrators
//! ```

use plummer::app::case::Case;
use plummer::app::commands::run::{RunResult, compute_run};
use plummer::numerics::Unwatched;
use plummer::numerics::series::TimeSeries;
use plummer::signal::{band_limit, relative_difference};
use std::error::Error;
use std::io::Write;

/// Band in which signals are compared, Hz.
const BAND_HZ: f64 = 40e3;

/// Compared with each other: what, case, settings of both, largest difference that passes.
struct Scene {
    name: &'static str,
    case: &'static str,
    common: &'static [&'static str],
}

const SCENES: [Scene; 2] = [
    Scene { name: "smooth, 10 ms", case: "examples/scenes/smooth.toml", common: &[] },
    Scene {
        name: "healthy, 2 ms",
        case: "examples/tadina2011/healthy.toml",
        common: &[
            "bearing.contact_damping=1.0",
            "transient.start=2.3",
            "transient.end=2.302",
            "transient.output_hz=400000",
            "analysis.envelope=[]",
        ],
    },
];

/// Settings of one run beside the scene's.
const NEWMARK: [&str; 3] = ["transient.method=newmark-explicit", "transient.step=1.5e-8", "transient.modes=all"];
const EXPONENTIAL: [&str; 3] = ["transient.method=exponential", "transient.step=2.5e-8", "transient.modes=all"];
const TRUNCATED: [&str; 3] = ["transient.method=exponential", "transient.step=2.5e-8", "transient.modes=auto"];

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = std::io::stdout().lock();
    writeln!(
        out,
        "{:<14} {:<34} {:>9} {:>10} {:>10} {:>14} {:>16}",
        "scene", "method", "modes", "step [s]", "steps", "wall [s]", "wall per sim. s"
    )?;
    for (scene, limit) in SCENES.iter().zip([1e-3, 1e-2]) {
        let newmark = run(scene, &NEWMARK)?;
        let exponential = run(scene, &EXPONENTIAL)?;
        let truncated = run(scene, &TRUNCATED)?;
        for result in [&newmark, &exponential, &truncated] {
            row(&mut out, scene, result)?;
        }
        let methods = relative_difference(&limited(&exponential)?, &limited(&newmark)?)?;
        let basis = relative_difference(&limited(&truncated)?, &limited(&exponential)?)?;
        writeln!(out, "{:<14} exponential against newmark-explicit: {methods:.2e} (limit {limit:.0e})", scene.name)?;
        writeln!(out, "{:<14} truncated basis against all modes:    {basis:.2e} (limit 1e-2)", scene.name)?;
        // the two limits on the methods are those that the scenes were made for: nothing but
        // integration error is left on the smooth one, sensitivity to it grows with the contacts
        // that open and close on the healthy one
        assert!(methods < limit, "{}: the integrators differ by {methods:.3e}", scene.name);
        assert!(basis < 1e-2, "{}: the truncated basis differs by {basis:.3e}", scene.name);
    }
    Ok(())
}

fn run(scene: &Scene, settings: &[&str]) -> Result<RunResult, Box<dyn Error>> {
    let path = format!("{}/{}", env!("CARGO_MANIFEST_DIR"), scene.case);
    let set: Vec<String> = scene.common.iter().chain(settings).map(|setting| (*setting).to_owned()).collect();
    Ok(compute_run(&Case::load(path, &set)?, &Unwatched)?)
}

/// Acceleration of the first sensor in the band.
fn limited(result: &RunResult) -> Result<TimeSeries, Box<dyn Error>> {
    Ok(band_limit(&result.simulation.signal(0)?, BAND_HZ)?)
}

fn row(out: &mut impl Write, scene: &Scene, result: &RunResult) -> std::io::Result<()> {
    let basis = if result.simulation.residual { " + residual" } else { "" };
    writeln!(
        out,
        "{:<14} {:<34} {:>9} {:>10.3e} {:>10} {:>14.3} {:>16.1}",
        scene.name,
        format!("{}{basis}", result.simulation.method.name()),
        result.simulation.modes,
        result.simulation.schedule.step(),
        result.simulation.statistics.steps,
        result.simulation.stepping_s,
        result.simulation.stepping_s / result.simulation.simulated_s,
    )
}
