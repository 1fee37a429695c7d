//! What stands above the numbers of a table: names, units, and the times that belong to each channel.
//!
//! LabVIEW, Tektronix and Rigol write units and steps in lines of settings: `Y_Unit_Label`, `Vertical Units`, `X0` and `Delta_X`,
//! `Start` and `Increment`.

use super::super::super::csv::line_of;
use super::super::channel::{Clock, choose};
use super::super::names::{bracketless, is_stated, is_unit, name_and_unit, same, seconds, time_unit};
use super::super::{MeasuredError, SignalRequest};
use super::layout::{Layout, Read, Table, real};

/// What is read of each line.
pub(super) struct Columns {
    /// How many columns there are.
    pub(super) count: usize,
    /// Whether there are several columns of times, whose channels may end before others.
    pub(super) blocks: bool,
    pub(super) timings: Vec<Timing>,
    pub(super) wanted: Vec<Wanted>,
}

/// A channel as it is read.
#[derive(Clone)]
pub(super) struct Wanted {
    pub(super) place: usize,
    pub(super) name: String,
    pub(super) unit: String,
    /// Place of its [`Timing`].
    pub(super) timing: usize,
    pub(super) read: Read,
}

impl Wanted {
    fn new(place: usize, (name, unit): (String, String)) -> Self {
        Self { place, name, unit, timing: 0, read: Read::default() }
    }
}

/// A column, and seconds in its unit; `None`: nothing states a unit.
type Time = (usize, Option<f64>);

/// What says when the samples of channels were taken.
pub(super) struct Timing {
    /// A column of times; without one the clock.
    pub(super) time: Option<Time>,
    pub(super) clock: Clock,
    pub(super) read: Read,
    /// Whether the samples have ended, where other channels go on.
    pub(super) ended: bool,
}

/// What to do about times that are not those of the channel.
const RATE: &str = "--rate HZ takes the place of the times; or write a file of this channel and its times alone";
const UNITS_OF_TIME: &str = "s, ms, us or ns as unit of the time";

impl Table<'_> {
    /// The columns that are wanted, by what stands above the numbers.
    pub(super) fn columns(&self, layout: &Layout, request: &SignalRequest) -> Result<Columns, MeasuredError> {
        let Layout { rows, start, own, .. } = layout;
        let no_rate = request.rate_hz.is_none();
        let (mut times, mut channels) = (Vec::<Time>::new(), Vec::<Wanted>::new());
        for (place, cell) in layout.names.map_or(&rows[*start], |names| &rows[names]).iter().enumerate() {
            let here = own.contains(&place);
            let Some(names) = layout.names else {
                // without names the first column is the time, unless a rate is given
                match own.first() == Some(&place) && no_rate && own.len() > 1 {
                    true => times.push((place, None)),
                    false if here => {
                        channels.push(Wanted::new(place, (format!("column {}", place + 1), String::new())))
                    }
                    false => {}
                }
                continue;
            };
            let at = |row: usize| rows.get(row).and_then(|row| row.get(place)).unwrap_or_default();
            // acceleration has axes too
            let has_axes = || rows[names].iter().any(|cell| cell.eq_ignore_ascii_case("y-axis"));
            let named = time_unit(cell).filter(|_| !cell.eq_ignore_ascii_case("x-axis") || !has_axes());
            // Rigol's time has no name
            let by_unit = seconds(bracketless(at(names + 1))).filter(|_| own.first() == Some(&place));
            if let Some(unit) = named.or(by_unit) {
                if no_rate && !here && !at(*start).is_empty() {
                    return Err(self.content(line_of(self.text, &rows[*start]), "a number for the time", at(*start)));
                }
                times.push((place, Some(unit).filter(|_| named.is_none() || is_stated(cell))));
            } else if here
                || at(*start).is_empty() && !matches!(&*cell.to_lowercase(), "" | "comment" | "start" | "increment")
            {
                channels.push(Wanted::new(place, name_and_unit(cell)));
            }
        }
        self.units(layout, &mut times, &mut channels, no_rate)?;
        times.retain(|(place, _)| own.contains(place));
        let all: Vec<String> = channels.iter().map(|channel| channel.name.clone()).collect();
        for channel in
            channels.iter_mut().filter(|channel| all.iter().filter(|other| **other == channel.name).count() > 1)
        {
            channel.name = format!("{} (column {})", channel.name, channel.place + 1);
        }
        let even = |place| layout.even(place).filter(|_| times.is_empty());
        if no_rate && times.is_empty() && channels.iter().all(|channel| even(channel.place).is_none()) {
            return Err(MeasuredError::NoTime { path: self.path.to_owned() });
        }
        let names: Vec<String> = channels.iter().map(|channel| channel.name.clone()).collect();
        let (mut timings, mut wanted) = (Vec::<Timing>::new(), Vec::new());
        for chosen in choose(self.path, &names, request)? {
            let mut channel = channels[chosen].clone();
            if no_rate {
                self.belong(layout, &times, &channel)?;
            }
            let time = times.iter().rev().find(|time| time.0 < channel.place).or(times.first()).copied();
            let clock = even(channel.place).unwrap_or(Clock::Unknown);
            let known = timings.iter().position(|timing| timing.time == time && timing.clock == clock);
            channel.timing = known.unwrap_or_else(|| {
                timings.push(Timing { time, clock, read: Read::default(), ended: false });
                timings.len() - 1
            });
            wanted.push(channel);
        }
        let count = rows[layout.names.unwrap_or(*start)].len();
        Ok(Columns { count, blocks: times.len() > 1, timings, wanted })
    }

    /// Takes units from the lines about the names, those with units of times first, and the only one below; then from settings.
    fn units(
        &self,
        layout: &Layout,
        times: &mut [Time],
        channels: &mut [Wanted],
        no_rate: bool,
    ) -> Result<(), MeasuredError> {
        let names = layout.names.unwrap_or(layout.start);
        let text = |line: usize, place: usize| bracketless(layout.rows[line].get(place).unwrap_or_default());
        let refused = |line: usize, expected: &str, found: &str| {
            if no_rate { Err(self.content(line_of(self.text, &layout.rows[line]), expected, found)) } else { Ok(()) }
        };
        let lines = (names.saturating_sub(2)..layout.start).filter(|&line| line != names);
        let has_units = |line: usize| times.iter().all(|time| seconds(text(line, time.0)).is_some());
        let (units, others): (Vec<usize>, Vec<usize>) = lines.partition(|&line| !times.is_empty() && has_units(line));
        for &line in units.iter().chain(&others) {
            let of_times = units.contains(&line);
            for (place, unit) in times.iter_mut().filter(|_| of_times || line > names) {
                let found = text(line, *place);
                match (*unit, seconds(found)) {
                    (None, None) if !found.is_empty() => refused(line, UNITS_OF_TIME, found)?,
                    (Some(before), Some(own)) if !same(before, own) => {
                        refused(line, "the unit of the time that the names state", found)?;
                    }
                    (before, own) => *unit = before.or(own),
                }
            }
            let alone = line > names && layout.start == names + 2;
            if of_times || alone || times.is_empty() && channels.iter().all(|own| is_unit(text(line, own.place))) {
                channels
                    .iter_mut()
                    .filter(|own| own.unit.is_empty())
                    .for_each(|own| text(line, own.place).clone_into(&mut own.unit));
            }
        }
        if let Some((line, found)) = layout.setting("horizontal units", 1 + usize::from(layout.names.is_none())) {
            if seconds(found).is_none() {
                refused(line, UNITS_OF_TIME, found)?;
            }
            times.iter_mut().for_each(|(_, unit)| *unit = unit.or(seconds(found)));
        }
        for Wanted { place, name, unit, .. } in channels {
            let labels = ["y_unit_label", "vertical units"].map(|key| layout.setting(key, *place));
            if let Some((_, stated)) =
                labels[0].or(labels[1]).filter(|(_, stated)| stated != unit && !stated.contains(':'))
            {
                // what LabVIEW has in brackets is the name's own
                *name = layout.names.map_or(name.clone(), |names| layout.rows[names][*place].to_owned());
                stated.clone_into(unit);
            }
        }
        Ok(())
    }

    /// Refuses times that are not those of a channel.
    fn belong(&self, layout: &Layout, times: &[Time], channel: &Wanted) -> Result<(), MeasuredError> {
        let refused = |line: usize, expected: &str, found: String| {
            let (path, line) = (self.path.display(), line_of(self.text, &layout.rows[line]));
            let message = format!("{path}:{line}: expected {expected} for {}, found {found}", channel.name);
            Err(MeasuredError::refused_with(message, RATE))
        };
        let of = |key, place| layout.setting(key, place);
        match of("x_dimension", channel.place) {
            Some((line, found)) if !found.eq_ignore_ascii_case("time") => {
                return refused(line, "times", format!("\"X_Dimension {found}\""));
            }
            _ => {}
        }
        let left = times.iter().rposition(|time| time.0 < channel.place);
        let beside = left.is_some_and(|at| at > 0 && times[at - 1].0 + 1 == times[at].0);
        let names = layout.names.filter(|_| times.len() > 1);
        if let Some(line) = names.filter(|_| beside || layout.own.first() != Some(&times[0].0)) {
            let found: Vec<String> = times.iter().map(|time| format!("\"{}\"", &layout.rows[line][time.0])).collect();
            return refused(line, "one column of times, or each with its channels to its right,", found.join(", "));
        }
        // LabVIEW: one column of times is that of the first channel
        let first = left.and_then(|left| of("delta_x", times[left].0 + 1));
        match first.zip(of("delta_x", channel.place)) {
            Some(((_, expected), (line, found))) if expected != found => {
                refused(line, "the step of the times", format!("\"Delta_X {found}\""))
            }
            _ => Ok(()),
        }
    }
}

impl Layout {
    /// The line of settings with this name in the first column, and its text for a column; without names of columns the nearest
    /// text to its left.
    fn setting(&self, key: &str, place: usize) -> Option<(usize, &str)> {
        let lines = 0..self.names.unwrap_or(self.rows.len());
        let line = lines.rev().find(|&line| self.rows[line].get(0).is_some_and(|own| own.eq_ignore_ascii_case(key)))?;
        let text = |place: usize| self.rows[line].get(place).filter(|cell| !cell.is_empty());
        let nearest = || (1..place).rev().filter_map(text).find(|cell| real(cell).is_none());
        Some((line, if self.names.is_some() { text(place)? } else { nearest()? }))
    }

    /// First instant and step that are stated for a column.
    fn even(&self, place: usize) -> Option<Clock> {
        let below = |key: &str| {
            let place = self.rows[self.names?].iter().position(|cell| cell.eq_ignore_ascii_case(key))?;
            real(self.rows.get(self.names? + 1)?.get(place)?)
        };
        let number = |key: &str| real(self.setting(key, place)?.1);
        let step_s = number("delta_x").or_else(|| below("increment")).filter(|step| *step > 0.0)?;
        Some(Clock::Even { start_s: number("x0").or_else(|| below("start")).unwrap_or(0.0), step_s })
    }
}
