//! What stands above the numbers of a table: names, units, and the times that belong to each channel.
//!
//! LabVIEW, Tektronix and Rigol write units and steps in lines of settings: `Y_Unit_Label`, `Vertical Units`, `X0` and `Delta_X`,
//! `Start` and `Increment`.

use ::csv::StringRecord;

use super::super::super::csv::line_of;
use super::super::channel::choose;
use super::super::names::{bracketless, is_stated, is_unit, name_and_unit, seconds, time_unit};
use super::super::{MeasuredError, SignalRequest};
use super::layout::{Layout, real};
use super::{Read, Table};

/// What is read of each line.
pub(super) struct Columns {
    /// How many columns there are.
    pub(super) count: usize,
    /// How many of them a line has at least.
    pub(super) least: usize,
    /// Whether there are several columns of times, whose channels may end before others.
    pub(super) blocks: bool,
    pub(super) timings: Vec<Timing>,
    pub(super) wanted: Vec<Wanted>,
}

/// A channel that is wanted.
#[derive(Clone)]
pub(super) struct Wanted {
    pub(super) place: usize,
    pub(super) name: String,
    pub(super) unit: String,
    /// Place of its [`Timing`].
    pub(super) timing: usize,
    pub(super) read: Read,
}

/// What says when the samples of channels were taken.
#[derive(Clone, PartialEq)]
pub(super) enum When {
    /// A column, and seconds in its unit; `None`: nothing states a unit.
    Column(usize, Option<f64>),
    /// First instant and step, s.
    Even(f64, f64),
    Unknown,
}

/// A column of times as it is read.
pub(super) struct Timing {
    pub(super) when: When,
    pub(super) read: Read,
    /// Whether the samples have ended, where other channels go on.
    pub(super) ended: bool,
}

/// What to do about times that are not those of the channel.
const RATE: &str = "--rate HZ takes the place of the times; or write a file of this channel and its times alone";

impl Table<'_> {
    /// The columns that are wanted, by what stands above the numbers.
    pub(super) fn columns(&self, layout: &Layout, request: &SignalRequest) -> Result<Columns, MeasuredError> {
        let Layout { rows, start, own, .. } = layout;
        let no_rate = request.rate_hz.is_none();
        let (mut times, mut channels) = (Vec::new(), Vec::new());
        let count = match layout.names {
            None => {
                // without names the first column is the time, unless a rate is given
                let time = own.first().filter(|_| no_rate && own.len() > 1);
                times.extend(time.map(|&place| (place, None)));
                let others = own.iter().filter(|place| Some(*place) != time);
                channels.extend(others.map(|&place| (place, format!("column {}", place + 1), String::new())));
                rows[*start].len()
            }
            Some(names) => {
                // acceleration has axes too
                let axes = rows[names].iter().any(|cell| cell.eq_ignore_ascii_case("y-axis"));
                for (place, cell) in rows[names].iter().enumerate() {
                    let first = rows.get(*start).and_then(|row| row.get(place)).unwrap_or_default();
                    let remark = matches!(cell.to_lowercase().as_str(), "" | "comment" | "start" | "increment");
                    let below = rows.get(names + 1).and_then(|row| row.get(place)).unwrap_or_default();
                    // Rigol's time has no name
                    let by_unit = seconds(bracketless(below)).filter(|_| own.first() == Some(&place));
                    let is_axis = axes && cell.eq_ignore_ascii_case("x-axis");
                    let named = time_unit(cell).filter(|_| !is_axis);
                    if let Some(unit) = named.or(by_unit) {
                        if no_rate && !own.contains(&place) && !first.is_empty() {
                            return Err(self.content(
                                line_of(self.text, &rows[*start]),
                                "a number for the time",
                                first,
                            ));
                        }
                        times.push((place, Some(unit).filter(|_| named.is_none() || is_stated(cell))));
                    } else if own.contains(&place) || !remark && first.is_empty() {
                        let (name, unit) = name_and_unit(cell);
                        channels.push((place, name, unit));
                    }
                }
                self.units(layout, names, &mut times, &mut channels, no_rate)?;
                rows[names].len()
            }
        };
        let places = times.iter().map(|time| time.0).chain(channels.iter().map(|channel| channel.0));
        let last = places.max().map_or(count, |last| last + 1);
        times.retain(|(place, _)| own.contains(place));
        let settings = Settings { table: self, rows, names: layout.names };
        let horizontal = settings.cell(&["horizontal units"], 1 + usize::from(layout.names.is_none()));
        if let Some((line, found)) = horizontal {
            if no_rate && seconds(found).is_none() {
                return Err(self.content(line, UNITS_OF_TIME, found));
            }
            times.iter_mut().for_each(|(_, unit)| *unit = unit.or(seconds(found)));
        }
        for (place, name, unit) in &mut channels {
            let cell = settings.cell(&["y_unit_label", "vertical units"], *place);
            if let Some((_, stated)) = cell.filter(|(_, stated)| stated != unit && !stated.contains(':')) {
                // what LabVIEW has in brackets is the name's own
                *name = layout.names.map_or(name.clone(), |names| rows[names][*place].to_owned());
                stated.clone_into(unit);
            }
        }
        let all: Vec<String> = channels.iter().map(|(_, name, _)| name.clone()).collect();
        for (place, name, _) in &mut channels {
            if all.iter().filter(|other| *other == name).count() > 1 {
                *name = format!("{name} (column {})", *place + 1);
            }
        }
        let even = |place| settings.even(place).filter(|_| times.is_empty());
        if no_rate && times.is_empty() && channels.iter().all(|channel| even(channel.0).is_none()) {
            return Err(MeasuredError::NoTime { path: self.path.to_owned() });
        }
        let only: Vec<String> = channels.iter().map(|(_, name, _)| name.clone()).collect();
        let (mut timings, mut wanted) = (Vec::<Timing>::new(), Vec::new());
        for chosen in choose(self.path, &only, request)? {
            let (place, name, unit) = channels[chosen].clone();
            let left = times.iter().rev().find(|time| time.0 < place);
            if no_rate && let Some((line, expected, found)) = settings.contradiction(&times, own, place) {
                let path = self.path.display();
                let message = format!("{path}:{line}: expected {expected} for {name}, found {found}");
                return Err(MeasuredError::refused_with(message, RATE));
            }
            let when = match left.or(times.first()) {
                Some(&(time, unit)) => When::Column(time, unit),
                None => even(place).map_or(When::Unknown, |(start_s, step_s)| When::Even(start_s, step_s)),
            };
            let timing = timings.iter().position(|timing| timing.when == when).unwrap_or_else(|| {
                timings.push(Timing { when, read: Read::default(), ended: false });
                timings.len() - 1
            });
            wanted.push(Wanted { place, name, unit, timing, read: Read::default() });
        }
        let blocks = times.len() > 1;
        Ok(Columns { count, least: if blocks { 0 } else { last }, blocks, timings, wanted })
    }

    /// Takes units from the lines about the names: from those with units of times, and from the only one below the names.
    fn units(
        &self,
        layout: &Layout,
        names: usize,
        times: &mut [(usize, Option<f64>)],
        channels: &mut [(usize, String, String)],
        no_rate: bool,
    ) -> Result<(), MeasuredError> {
        let text = |row: &StringRecord, place: usize| bracketless(row.get(place).unwrap_or_default()).to_owned();
        let lines = (names.saturating_sub(2)..layout.start).filter(|&line| line != names);
        let has_units = |line: &usize| times.iter().all(|time| seconds(&text(&layout.rows[*line], time.0)).is_some());
        let (units, others): (Vec<usize>, Vec<usize>) = lines.partition(|line| !times.is_empty() && has_units(line));
        for &line in units.iter().chain(&others) {
            let (row, of_times) = (&layout.rows[line], units.contains(&line));
            for (place, unit) in times.iter_mut().filter(|_| of_times || line > names) {
                let found = text(row, *place);
                let expected = match (*unit, seconds(&found)) {
                    (_, None) if found.is_empty() || unit.is_some() => continue,
                    (None, None) => UNITS_OF_TIME,
                    (Some(before), Some(own)) if before != own => "the unit of the time that the names state",
                    (_, own) => {
                        *unit = own;
                        continue;
                    }
                };
                if no_rate {
                    return Err(self.content(line_of(self.text, row), expected, &found));
                }
            }
            let alone = line > names && layout.start == names + 2;
            if of_times || alone || times.is_empty() && channels.iter().all(|channel| is_unit(&text(row, channel.0))) {
                for (place, _, unit) in channels.iter_mut().filter(|channel| channel.2.is_empty()) {
                    *unit = text(row, *place);
                }
            }
        }
        Ok(())
    }
}

const UNITS_OF_TIME: &str = "s, ms, us or ns as unit of the time";

/// The lines of settings, with what is named in the first column.
struct Settings<'a> {
    table: &'a Table<'a>,
    rows: &'a [StringRecord],
    names: Option<usize>,
}

impl Settings<'_> {
    /// Line and text of the setting of one of these names for a column; without names of columns the nearest text to its left.
    fn cell(&self, keys: &[&str], place: usize) -> Option<(u64, &str)> {
        let rows = &self.rows[..self.names.unwrap_or(self.rows.len())];
        let row = rows.iter().rev().find(|row| row.get(0).is_some_and(|key| keys.contains(&&*key.to_lowercase())))?;
        let text = |place: &usize| row.get(*place).filter(|cell| !cell.is_empty());
        let found = match self.names {
            Some(_) => text(&place),
            None => (1..place).rev().filter_map(|place| text(&place)).find(|cell| real(cell).is_none()),
        };
        Some((line_of(self.table.text, row), found?))
    }

    /// First instant and step that are stated for a column, s.
    fn even(&self, place: usize) -> Option<(f64, f64)> {
        let below = |key: &str| {
            let names = &self.rows[self.names?];
            let place = names.iter().position(|cell| cell.eq_ignore_ascii_case(key))?;
            real(self.rows.get(self.names? + 1)?.get(place)?)
        };
        let number = |key: &str| real(self.cell(&[key], place)?.1);
        let step_s = number("delta_x").or_else(|| below("increment")).filter(|step| *step > 0.0)?;
        Some((number("x0").or_else(|| below("start")).unwrap_or(0.0), step_s))
    }

    /// Line, what was expected and what was found, where times are not those of a channel.
    fn contradiction(
        &self,
        times: &[(usize, Option<f64>)],
        own: &[usize],
        place: usize,
    ) -> Option<(u64, &'static str, String)> {
        if let Some((line, found)) = self.cell(&["x_dimension"], place)
            && !found.eq_ignore_ascii_case("time")
        {
            return Some((line, "times", format!("\"X_Dimension {found}\"")));
        }
        let left = times.iter().rposition(|time| time.0 < place);
        let beside = left.is_some_and(|at| at > 0 && times[at - 1].0 + 1 == times[at].0);
        if times.len() > 1 && (beside || own.first() != Some(&times[0].0)) {
            let row = &self.rows[self.names?];
            let names: Vec<String> = times.iter().map(|time| format!("\"{}\"", &row[time.0])).collect();
            let expected = "one column of times, or each with its channels to its right,";
            return Some((line_of(self.table.text, row), expected, names.join(", ")));
        }
        // LabVIEW: one column of times is that of the first channel
        let first = times.get(left?)?.0 + 1;
        let [(_, expected), (line, found)] = [self.cell(&["delta_x"], first)?, self.cell(&["delta_x"], place)?];
        (expected != found).then(|| (line, "the step of the times", format!("\"Delta_X {found}\"")))
    }
}
