//! The study as charts: what one choice moves, and all readings by their first two frequencies.

use crate::choices::{Equations, Factor};
use crate::fits::{Fits, Moved};
use crate::paper::{BOUNCE, SWAY};
use crate::study::{ReadingResult, Study};
use crate::tables::NAMES;
use plummer::report::{Abscissa, Axis, Curve, CurveStyle, Marker, Plot, SpanPoint, SpanRow, Spans, significant};

/// The charts of the study.
pub struct Charts {
    /// What one choice moves: name of the file, and the chart of each frequency.
    pub moved: Vec<(&'static str, Spans)>,
    /// All readings by their first two frequencies.
    pub scatter: Plot,
}

/// Most points of a curve in the scatter plot.
const MOST_POINTS: usize = 1500;

impl Charts {
    /// Draws a study; `base` is the built-in reading and `moved` what one choice does to it.
    pub fn of(study: &Study, fits: &Fits, base: Option<&ReadingResult>, moved: &[Moved]) -> Self {
        let names = ["readings-sway", "readings-bounce", "readings-ring"];
        let charts = names.into_iter().enumerate().filter_map(|(k, name)| {
            let base = base?.nearest_hz[k];
            (!moved.is_empty()).then(|| (name, spans(study, moved, k, base)))
        });
        Self { moved: charts.collect(), scatter: scatter(study, fits) }
    }
}

/// What each choice by itself does to one frequency.
fn spans(study: &Study, moved: &[Moved], k: usize, base: f64) -> Spans {
    let rows = Factor::ALL.into_iter().filter_map(|factor| {
        let points: Vec<SpanPoint> = moved
            .iter()
            .filter(|moved| moved.factor == factor)
            .map(|moved| {
                let label = study.grid.label(factor, moved.level);
                SpanPoint { label: if moved.shaped[k] { label } else { format!("{label} *") }, at: moved.hz[k] / 1e3 }
            })
            .collect();
        (!points.is_empty()).then(|| SpanRow { name: factor.name().to_owned(), points })
    });
    Spans {
        title: format!("What one choice does to the mode nearest to {}", NAMES[k]),
        caption: Some(format!(
            "The mode nearest to {} of the built-in reading ({} kHz, the line) with one choice changed at a time. A star: that mode has another shape than the one that the paper speaks of.",
            NAMES[k],
            significant(base / 1e3, 4)
        )),
        axis: "Nearest mode [kHz]".to_owned(),
        base: base / 1e3,
        rows: rows.collect(),
    }
}

/// First against second frequency, by shape, of both kinds of equations, and the readings that fit.
fn scatter(study: &Study, fits: &Fits) -> Plot {
    let x = Axis::new("Ring across the load and turning", "Hz").range(3e3, 12e3);
    let y = Axis::new("Ring along the load", "Hz").range(4e3, 14e3);
    let mut plot = Plot::new("First and second frequency of the readings", x, y).caption(format!(
        "By mode shape, at most {MOST_POINTS} readings of each kind of equations. The paper: 8.2 and 11.3 kHz. Readings with radial springs stand on the left.",
    ));
    let points = |readings: &[&ReadingResult]| -> (Vec<f64>, Vec<f64>) {
        let stride = readings.len().div_ceil(MOST_POINTS).max(1);
        readings
            .iter()
            .step_by(stride)
            .filter_map(|reading| Some((reading.by_shape.sway?, reading.by_shape.bounce?)))
            .unzip()
    };
    for (level, equations) in study.grid.equations.iter().enumerate() {
        let with: Vec<&ReadingResult> =
            study.readings.iter().filter(|reading| reading.levels[Factor::Equations as usize] == level).collect();
        let (x, y) = points(&with);
        let name = match equations {
            Equations::Printed => "printed equations",
            Equations::Consistent => "consistent equations",
        };
        plot = plot.curve(Curve::new(name, Abscissa::Points(x), y).style(CurveStyle::Points));
    }
    let fitting: Vec<&ReadingResult> =
        fits.fits.iter().filter(|fit| fit.all_shaped()).map(|fit| &fit.reading).collect();
    let (x, y) = points(&fitting);
    let fitting = Curve::new("all three given", Abscissa::Points(x), y);
    let line = Curve::new("11.3 kHz", Abscissa::Points(vec![3e3, 12e3]), vec![BOUNCE; 2]);
    plot.curve(fitting.style(CurveStyle::Points))
        .curve(line.style(CurveStyle::Dashed))
        .marker(Marker::new(SWAY, "8.2 kHz"))
}
