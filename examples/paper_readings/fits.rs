//! Which readings give all three frequencies, and what they have in common.

use crate::choices::{Factor, Levels};
use crate::paper::errors;
use crate::study::{ReadingResult, Study, agrees};
use std::collections::BTreeMap;

/// Largest relative distance from each of the paper's figures that counts as given: twice the rounding of "around 8.2 kHz".
pub const WITHIN: f64 = 0.02;

/// A reading that gives all three frequencies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// The reading.
    pub reading: ReadingResult,
    /// Relative distances from the paper's three.
    pub errors: [f64; 3],
    /// Whether each of the three is the mode with the shape that the paper speaks of.
    pub shaped: [bool; 3],
}

/// How often one value of a choice occurs among the readings that fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LevelCount {
    /// The choice.
    pub factor: Factor,
    /// Which of the grid's values.
    pub level: usize,
    /// Readings with it.
    pub readings: usize,
    /// Those of them that fit.
    pub fits: usize,
    /// Those that fit, and by mode shape too.
    pub shaped_fits: usize,
}

/// Readings that fit and are one in the choices that act most.
#[derive(Debug, Clone, PartialEq)]
pub struct FitGroup {
    /// What they share: indices into the grid, one for each of [`FitGroup::SHARED`].
    pub shared: Vec<usize>,
    /// How many fit.
    pub fits: usize,
    /// How many of them by mode shape too.
    pub shaped_fits: usize,
    /// How many readings share these choices, fitting or not.
    pub readings: usize,
    /// The best of them.
    pub best: Fit,
    /// Values of the other choices that occur among those that fit, one list for each of [`FitGroup::OPEN`].
    pub open: Vec<Vec<usize>>,
}

impl FitGroup {
    /// Choices that a group shares.
    pub const SHARED: [Factor; 6] =
        [Factor::Equations, Factor::Contact, Factor::Bond, Factor::Shear, Factor::Springs, Factor::Cage];

    /// Choices that differ within a group.
    pub const OPEN: [Factor; 6] =
        [Factor::Width, Factor::SpringArc, Factor::RotaryInertia, Factor::Steel, Factor::Aluminium, Factor::Load];
}

/// The readings that give all three frequencies.
#[derive(Debug, Clone, PartialEq)]
pub struct Fits {
    /// All of them, the best first.
    pub fits: Vec<Fit>,
    /// How often each value of each choice occurs among them.
    pub counts: Vec<LevelCount>,
    /// The same by the choices that act most, the largest group first.
    pub groups: Vec<FitGroup>,
    /// Choices of which all that fit take the same value, and that value.
    pub determined: Vec<(Factor, usize)>,
    /// Readings of which at least one of the nearest modes has not the shape that the paper speaks of.
    pub misnamed: usize,
}

impl Fit {
    /// Judges a reading; `None` unless all three frequencies are within [`WITHIN`].
    pub fn of(reading: &ReadingResult) -> Option<Self> {
        let errors = errors(reading.nearest_hz);
        let fits = errors.iter().all(|error| error.abs() <= WITHIN);
        fits.then(|| Self { reading: *reading, errors, shaped: shaped(reading) })
    }

    /// The largest of the three relative distances.
    pub fn worst(&self) -> f64 {
        self.errors.iter().fold(0.0, |worst, e| worst.max(e.abs()))
    }

    /// Whether all three modes have the shapes that the paper speaks of.
    pub fn all_shaped(&self) -> bool {
        self.shaped.iter().all(|shaped| *shaped)
    }
}

/// Whether each of the nearest modes is the one that its shape says.
fn shaped(reading: &ReadingResult) -> [bool; 3] {
    let by_shape = reading.by_shape;
    [
        agrees(reading.nearest_hz[0], by_shape.sway),
        agrees(reading.nearest_hz[1], by_shape.bounce),
        // of the pair either one
        reading.shapes[2].two_waves > 0.5,
    ]
}

impl Fits {
    /// Finds them.
    pub fn of(study: &Study) -> Self {
        let mut fits: Vec<Fit> = study.readings.iter().filter_map(Fit::of).collect();
        fits.sort_by(|a, b| a.worst().total_cmp(&b.worst()));
        let counts = counts(study, &fits);
        let determined = Factor::ALL
            .into_iter()
            .filter_map(|factor| {
                let mut occurring = counts.iter().filter(|count| count.factor == factor && count.fits > 0);
                match (occurring.next(), occurring.next()) {
                    (Some(only), None) => Some((factor, only.level)),
                    _ => None,
                }
            })
            .collect();
        let misnamed = study.readings.iter().filter(|reading| {
            let shaped = shaped(reading);
            !shaped.iter().all(|shaped| *shaped)
        });
        Self { groups: groups(study, &fits), misnamed: misnamed.count(), counts, determined, fits }
    }

    /// The place of a reading among those that fit, from 1; `None`: it does not.
    pub fn rank(&self, levels: &Levels) -> Option<usize> {
        let place = self.fits.iter().position(|fit| fit.reading.levels == *levels);
        place.map(|place| place + 1)
    }
}

fn counts(study: &Study, fits: &[Fit]) -> Vec<LevelCount> {
    let mut counts = Vec::new();
    for (place, factor) in Factor::ALL.into_iter().enumerate() {
        for level in 0..study.grid.sizes()[place] {
            let here = |levels: &Levels| levels[place] == level;
            let with = fits.iter().filter(|fit| here(&fit.reading.levels));
            counts.push(LevelCount {
                factor,
                level,
                readings: study.readings.iter().filter(|r| here(&r.levels)).count(),
                fits: with.clone().count(),
                shaped_fits: with.filter(|fit| fit.all_shaped()).count(),
            });
        }
    }
    counts
}

fn groups(study: &Study, fits: &[Fit]) -> Vec<FitGroup> {
    let key =
        |levels: &Levels| -> Vec<usize> { FitGroup::SHARED.iter().map(|factor| levels[*factor as usize]).collect() };
    let mut by_key: BTreeMap<Vec<usize>, Vec<&Fit>> = BTreeMap::new();
    for fit in fits {
        by_key.entry(key(&fit.reading.levels)).or_default().push(fit);
    }
    let mut sizes: BTreeMap<Vec<usize>, usize> = BTreeMap::new();
    for reading in &study.readings {
        *sizes.entry(key(&reading.levels)).or_default() += 1;
    }
    let mut groups: Vec<FitGroup> = by_key
        .into_iter()
        .filter_map(|(shared, members)| {
            let open = FitGroup::OPEN.iter().map(|factor| {
                let mut levels: Vec<usize> = members.iter().map(|fit| fit.reading.levels[*factor as usize]).collect();
                levels.sort_unstable();
                levels.dedup();
                levels
            });
            Some(FitGroup {
                fits: members.len(),
                shaped_fits: members.iter().filter(|fit| fit.all_shaped()).count(),
                readings: sizes.get(&shared).copied().unwrap_or(0),
                // the best stand first
                best: **members.first()?,
                open: open.collect(),
                shared,
            })
        })
        .collect();
    groups.sort_by_key(|group| std::cmp::Reverse(group.fits));
    groups
}

/// What one choice does to the three frequencies of a reading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moved {
    /// The choice.
    pub factor: Factor,
    /// Its value, an index into the grid.
    pub level: usize,
    /// The three frequencies, Hz.
    pub hz: [f64; 3],
    /// How far they moved, relatively.
    pub by: [f64; 3],
    /// Whether each is still the mode with the shape that the paper speaks of.
    pub shaped: [bool; 3],
}

/// The base reading with one choice changed at a time; its own values are left out.
pub fn moved_by_one_choice(study: &Study, base: &Levels) -> Vec<Moved> {
    let index: BTreeMap<&Levels, &ReadingResult> = study
        .readings
        .iter()
        .filter(|reading| differs_in_one(&reading.levels, base))
        .map(|reading| (&reading.levels, reading))
        .collect();
    let Some(reference) = index.get(base) else {
        return Vec::new();
    };
    let mut moved = Vec::new();
    for (place, factor) in Factor::ALL.into_iter().enumerate() {
        for level in (0..study.grid.sizes()[place]).filter(|level| *level != base[place]) {
            let mut levels = *base;
            levels[place] = level;
            if let Some(reading) = index.get(&levels) {
                moved.push(Moved {
                    factor,
                    level,
                    hz: reading.nearest_hz,
                    by: [0, 1, 2].map(|k| reading.nearest_hz[k] / reference.nearest_hz[k] - 1.0),
                    shaped: shaped(reading),
                });
            }
        }
    }
    moved
}

fn differs_in_one(a: &Levels, b: &Levels) -> bool {
    a.iter().zip(b).filter(|(a, b)| a != b).count() <= 1
}
