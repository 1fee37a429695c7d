//! The lowest pairs, and beside the iteration the count that proves them.

use super::super::lowest::Search;
use super::super::{CountCheck, EigenPairs, EigenProblem, EigenTimes, Factor, FactorMemory, LinalgError, memory};
use super::cuts::FIRM;
use crate::numerics::Told;
use std::sync::Arc;
use std::time::Instant;

/// Gap in which it is counted, relative to the distance from the shift.
const SMALLEST_GAP: f64 = 1e-5;

/// How often missing pairs, or a gap, are looked for.
const ROUNDS: usize = 5;

/// Missing pairs beyond which it is asked first whether the wanted ones are the lowest all the same: a crowd of hundreds of equal
/// eigenvalues would take a space larger than itself.
const MISSING: usize = 16;

/// Rounds after which equal eigenvalues are taken for a crowd without end.
const CROWDED: usize = 3;

/// Pairs pursued beyond those wanted: among them a gap is found in which to count.
pub(super) const BEYOND: usize = 4;

/// Share of the shift's distance from zero below which the last wanted value is too near to the others, seen from the shift.
const FAR: f64 = 0.1;

/// First correction, as an angle, beyond which it is the same below the whole distance: three to five corrections are usual from
/// smaller ones, twenty were needed from 0.06.
const SLOW: f64 = 0.01;

/// Bytes of an entry of a large factor.
const SINGLE: u64 = 4;

/// Pairs, and a count of eigenvalues below a value behind those wanted; `None` if they end in a crowd.
struct Iterated {
    /// Ritz values of all pairs pursued.
    values: Vec<f64>,
    pairs: EigenPairs,
    counted: Option<(f64, usize)>,
}

impl EigenProblem {
    /// The `count` lowest pairs by one search, counted in a gap behind them.
    pub(super) fn lowest_at_once(&self, count: usize, told: Told<'_>) -> Result<EigenPairs, LinalgError> {
        let order = self.order();
        let mut times = EigenTimes { order: self.order_s, ..EigenTimes::default() };
        let mut beyond = BEYOND.min(order - count);
        let mut check = None;
        for round in 1..=ROUNDS {
            let Iterated { values, pairs, counted } = self.iterate([count, beyond], round, &mut times, told)?;
            let before = || self.count_before(&values, count, pairs.shift);
            let Some((value, counted)) = counted else {
                if round >= CROWDED
                    && let Some(found) = before()
                {
                    return self.finished(pairs, found, times);
                }
                beyond = (2 * beyond + BEYOND).min(order - count);
                continue;
            };
            let below = values.iter().filter(|&&found| found < value).count();
            let found = CountCheck::from_lowest(value, counted, below);
            if counted == below {
                return self.finished(pairs, found, times);
            }
            if counted > below + MISSING
                && let Some(found) = before()
            {
                return self.finished(pairs, found, times);
            }
            check = Some(found);
            beyond = (beyond + counted.saturating_sub(below) + BEYOND).min(order - count);
        }
        Err(check.map_or_else(|| LinalgError::no_gap(count), CountCheck::missing))
    }

    /// The pairs, and how many eigenvalues lie below a value in a gap behind those wanted.
    fn iterate(
        &self,
        [count, beyond]: [usize; 2],
        rounds: usize,
        times: &mut EigenTimes,
        told: Told<'_>,
    ) -> Result<Iterated, LinalgError> {
        let started = Instant::now();
        let (shift, mut factor) = self.definite_factor()?;
        times.factor += started.elapsed().as_secs_f64();
        let started = Instant::now();
        let mut search = Search::new(&self.stiffness, &self.mass, shift, [count, beyond], told);
        for _ in 0..rounds {
            search.explore(&factor)?;
        }
        self.come_nearer(&mut search, &mut factor, count, FAR)?;
        // six digits by now: enough to say where to count, which takes as long as what is left of the iteration
        let mut near = search.approach(&factor)?;
        if search.largest_step > SLOW && self.come_nearer(&mut search, &mut factor, count, 1.0)? {
            near = search.approach(&factor)?;
        }
        let shift = search.shift;
        let early = widest_gap(&near, count, shift);
        let iteration = || {
            let ritz = search.converge(&factor)?;
            drop(search);
            let pairs = EigenPairs::judged(&self.stiffness, &self.mass, &factor, shift, &ritz, count);
            factor.check()?;
            Ok((ritz.values, pairs, started.elapsed().as_secs_f64()))
        };
        let (iterated, mut counted) = match early {
            Some(gap) if rayon::current_num_threads() > 1 && self.has_room() => {
                let count = || self.count_in(gap, FactorMemory::default());
                let (iterated, counted) = rayon::join(iteration, count);
                (iterated?, Some(counted?))
            }
            _ => (iteration()?, None),
        };
        let (values, pairs, elapsed) = iterated;
        times.iterate += elapsed;
        let mut memory = Arc::into_inner(factor).map_or_else(FactorMemory::default, Factor::into_memory);
        if let (Some(gap), None) = (early, &counted) {
            counted = Some(self.count_in(gap, std::mem::take(&mut memory))?);
        }
        // a value among those wanted says nothing of the last of them
        let behind = |value: f64| values[count - 1] < value;
        if !counted.is_some_and(|(value, ..)| behind(value)) {
            times.count += counted.map_or(0.0, |(.., elapsed)| elapsed);
            counted = match widest_gap(&values, count, shift) {
                Some(gap) => Some(self.count_in(gap, memory)?),
                None => None,
            };
        }
        times.count += counted.map_or(0.0, |(.., elapsed)| elapsed);
        Ok(Iterated { values, pairs, counted: counted.map(|(value, counted, _)| (value, counted)) })
    }

    /// Moves the shift of a search for `count` pairs up to their negative if the last of them is nearer to zero than this share of its
    /// distance: a shift far below the wanted values makes all of them look alike. Beside a rigid motion it stays, or the factor
    /// would be round-off.
    fn come_nearer(
        &self,
        search: &mut Search<'_>,
        factor: &mut Arc<Factor>,
        count: usize,
        share: f64,
    ) -> Result<bool, LinalgError> {
        let last = search.value(count - 1)?;
        if last <= FIRM * search.round_off || last >= -share * search.shift {
            return Ok(false);
        }
        let Ok(better) = self.definite(&self.stiffness.shifted(-last, &self.mass), false) else {
            return Ok(false);
        };
        *factor = Arc::new(better);
        search.shift = -last;
        search.explore(factor)?;
        Ok(true)
    }

    /// Counts close before the crowd of equal eigenvalues that the wanted pairs end in: if no pair is missing there, the lowest
    /// are known, whichever vectors of the crowd were found. `None` if one is missing, or if it cannot be counted there.
    fn count_before(&self, values: &[f64], count: usize, shift: f64) -> Option<CountCheck> {
        let gap = |place: usize| {
            let low = place.checked_sub(1).map_or(shift, |last| values[last]);
            [low, values[place]]
        };
        let wide = |place: &usize| {
            let [low, high] = gap(*place);
            high - low > SMALLEST_GAP * (high - shift)
        };
        let found = (0..count).rev().find(wide)?;
        let [low, high] = gap(found);
        let near = SMALLEST_GAP * (high - shift);
        if values[count - 1] - high > near {
            // not one crowd: what is missing may be lower than the last of them
            return None;
        }
        let place = [low.max(high - 2.0 * near), high - near];
        let (below, counted) = self.count_between(place, FactorMemory::default()).ok()?;
        let check = CountCheck::from_lowest(below, counted, found);
        (counted == found).then_some(check)
    }

    /// Whether a second factor can stand beside the first without filling the memory.
    fn has_room(&self) -> bool {
        let bytes = SINGLE.saturating_mul(self.plan.entries() as u64);
        memory::available().is_none_or(|free| free.bytes / 2 > bytes)
    }

    /// Where in a gap it was counted, how many eigenvalues lie below, and how long that took, s.
    fn count_in(&self, gap: [f64; 2], memory: FactorMemory) -> Result<(f64, usize, f64), LinalgError> {
        let started = Instant::now();
        let (value, counted) = self.count_between(gap, memory)?;
        Ok((value, counted, started.elapsed().as_secs_f64()))
    }
}

/// The widest gap between the last wanted value and the last pursued one, relative to the distance from the shift;
/// `None` if all are too narrow to count in.
fn widest_gap(values: &[f64], count: usize, shift: f64) -> Option<[f64; 2]> {
    let width = |place: usize| (values[place] - values[place - 1]) / (values[place] - shift);
    let widest = (count..values.len()).max_by(|&a, &b| width(a).total_cmp(&width(b)));
    match widest {
        Some(place) if width(place) > SMALLEST_GAP => Some([values[place - 1], values[place]]),
        Some(_) => None,
        // every eigenvalue of the problem was asked for
        None => values.last().map(|&last| [last, 2.0 * last - shift]),
    }
}
