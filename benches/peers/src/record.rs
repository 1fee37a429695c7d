//! From states at equal intervals to the sensor's acceleration, by the program's own recorder, for all integrators alike.

use crate::equations::Equations;
use plummer::numerics::ode::{Instant, NoRecord, Observer, SecondOrderSystem};
use plummer::numerics::ode::{Method, Schedule, Stepping, integrate};
use plummer::numerics::series::TimeSeries;
use plummer::signal::band_limit;
use plummer::system::Recorder;
use std::error::Error;

/// Tolerance of what goes on from a step's end to the samples before the next one's.
const BETWEEN: f64 = 1e-11;

/// Acceleration of the first sensor every `ratio` intervals, m/s^2, limited to `band_hz`; `states` one behind the other.
pub fn acceleration(
    equations: &mut Equations,
    states: &[f64],
    interval: f64,
    ratio: u32,
    band_hz: f64,
) -> Result<Vec<f64>, Box<dyn Error>> {
    let rows = states.chunks_exact(equations.size());
    let mut recorder = Recorder::new(equations.system_mut(), ratio, interval, rows.len())?;
    let mut force = vec![0.0; equations.size() / 2];
    for (step, x) in (0..).zip(rows) {
        let state = equations.state(step as f64 * interval, x);
        let system = equations.system_mut();
        system.force_into(state.t, &state.y, &state.v, &mut force);
        let now = Instant { step, t: state.t, y: &state.y, v: &state.v };
        recorder.observe(system, now);
    }
    let record = recorder.finish();
    let (_, values) = record.sensors.into_iter().next().ok_or("no sensor")?;
    let series = TimeSeries::new(0.0, f64::from(ratio) * interval, "m/s^2", values)?;
    Ok(band_limit(&series, band_hz)?.values().to_vec())
}

/// States at equal intervals from those at the steps of an integrator that has nothing between them: from each of them on by
/// `dop853` at a far smaller tolerance, so that the error is that of the steps.
pub fn between_steps(
    equations: &mut Equations,
    times: &[f64],
    states: &[f64],
    interval: f64,
    samples: usize,
) -> Result<Vec<f64>, Box<dyn Error>> {
    let size = equations.size();
    let mut out = vec![0.0; samples * size];
    let (mut step, mut state) = (0, equations.state(times[0], &states[..size]));
    for (sample, x) in out.chunks_exact_mut(size).enumerate() {
        let t = sample as f64 * interval;
        while step + 1 < times.len() && times[step + 1] <= t {
            step += 1;
            state = equations.state(times[step], &states[step * size..(step + 1) * size]);
        }
        let left = equations.rest().t + t - state.t;
        // what round-off leaves of an instant is none
        if left > 1e-6 * interval {
            let method = Method::Dop853 { tolerance: BETWEEN, events: false };
            let schedule = Schedule::covering(left, left, left)?;
            let go_on = |_, _| Stepping::Continue;
            let system = equations.system_mut();
            integrate(system, method, &schedule, &mut state, &mut NoRecord, go_on)?;
        }
        equations.measure(&state.y, &state.v, x);
    }
    Ok(out)
}
