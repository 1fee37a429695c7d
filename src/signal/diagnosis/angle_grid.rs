//! Instants at equal angles of the shaft, and the means of a signal between them.

use super::DiagnosisError;
use crate::numerics::series::TimeWindow;

/// Values a turn for each order that is to be seen: two would do. A mean over 1 / P of a turn has the gain
/// sinc(order / P), 0.76 at the highest order and 0.90 at a quarter of P.
const VALUES_AN_ORDER: f64 = 2.5;
/// Fewest values at equal angles.
const FEWEST: usize = 16;

/// Instants at equal angles of the shaft within a window.
#[derive(Debug, Clone)]
pub(super) struct AngleGrid {
    /// One more than there are values, s.
    times: Vec<f64>,
    /// Values a turn.
    pub(super) per_turn: f64,
    /// Highest speed in the window, Hz.
    pub(super) fastest_hz: f64,
}

impl AngleGrid {
    /// Grid for orders up to `highest` > 0 in a window (s); `turns` is the shaft's angle at a time (s), in turns, looked at every
    /// `step_s`.
    ///
    /// # Errors
    /// [`DiagnosisError::Refused`] for a shaft that rests or turns back, and for too few samples.
    pub(super) fn new(
        window: TimeWindow,
        step_s: f64,
        turns: impl Fn(f64) -> f64,
        highest: f64,
    ) -> Result<Self, DiagnosisError> {
        let samples = ((window.to - window.from) / step_s + 1e-6).floor().max(1.0) as usize;
        let time = |k: usize| window.from + k as f64 * step_s;
        let origin = turns(window.from);
        let sign = (turns(time(samples)) - origin).signum();
        let angles: Vec<f64> = (0..=samples).map(|k| sign * (turns(time(k)) - origin)).collect();
        let mut fastest = 0.0_f64;
        for (k, pair) in angles.windows(2).enumerate() {
            let step = pair[1] - pair[0];
            // NaN does not turn on either
            if step.is_nan() || step <= 0.0 {
                return Err(DiagnosisError::Refused(format!(
                    "from {} s to {} s: expected a shaft that turns one way all the time, found one that rests or turns \
                     back at {} s",
                    window.from,
                    window.to,
                    time(k)
                )));
            }
            fastest = fastest.max(step);
        }
        // every mean has a sample of its own at least
        let per_turn = (VALUES_AN_ORDER * highest).min(0.9 / fastest);
        let count = (angles[samples] * per_turn).floor() as usize;
        if count < FEWEST {
            return Err(DiagnosisError::Refused(format!(
                "from {} s to {} s: expected at least {FEWEST} samples at equal angles, found {count}: a longer window, or \
                 a higher sampling rate",
                window.from, window.to
            )));
        }
        let mut times = Vec::with_capacity(count + 1);
        let mut place = 0;
        for value in 0..=count {
            let angle = value as f64 / per_turn;
            while place + 1 < samples && angles[place + 1] < angle {
                place += 1;
            }
            let part = (angle - angles[place]) / (angles[place + 1] - angles[place]);
            times.push(time(place) + part * step_s);
        }
        Ok(Self { times, per_turn, fastest_hz: fastest / step_s })
    }

    /// Turns of the shaft.
    pub(super) fn turns(&self) -> f64 {
        (self.times.len() - 1) as f64 / self.per_turn
    }

    /// Highest order that its means show.
    pub(super) fn highest(&self) -> f64 {
        self.per_turn / VALUES_AN_ORDER
    }

    /// Means of a series between the instants; each value of it holds for a step, the first from `start_s` on. Beyond its ends the
    /// series goes on with its last value.
    pub(super) fn means(&self, start_s: f64, step_s: f64, values: &[f64]) -> Vec<f64> {
        let (mut whole, mut sum) = (0, 0.0);
        // integral of the values up to a place; places grow
        let mut up_to = |place: f64| {
            let wanted = (place.max(0.0) as usize).min(values.len() - 1).max(whole);
            for value in &values[whole..wanted] {
                sum += value;
            }
            whole = wanted;
            sum + (place - whole as f64) * values[whole]
        };
        let places = self.times.iter().map(|time| (time - start_s) / step_s);
        let mut ends = places.map(|place| (place, up_to(place)));
        let mut last = ends.next().unwrap_or((0.0, 0.0));
        ends.map(|end| {
            let mean = (end.1 - last.1) / (end.0 - last.0);
            last = end;
            mean
        })
        .collect()
    }
}
