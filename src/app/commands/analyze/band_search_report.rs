//! The band before an envelope in a report, and the kurtogram that it is from.

use super::band_search::{BandSearch, UsedBand};
use crate::report::{Abscissa, Axis, Curve, Fact, Marker, Plot, Raster, significant};
use crate::signal::KurtogramBand;

/// Cells of the picture an octave of width: levels are 0.42 octaves apart at least.
const ROWS_AN_OCTAVE: f64 = 12.0;
/// Most cells in a row, what a picture on a page can show.
const MOST_COLUMNS: usize = 1200;
/// The picture ends so far above the widest and below the narrowest band, in octaves.
const BORDER: f64 = 0.25;

/// Facts about the band before the envelope.
pub(crate) fn band_facts(band: &UsedBand) -> Vec<Fact> {
    let hz = |value: f64| significant(value, 4);
    let filters = match (band.high_pass_hz, band.low_pass_hz) {
        (None, None) => Fact::new("High-pass", "none"),
        (None, Some(to)) => Fact::new("Low-pass", format!("{} Hz, Kaiser window", hz(to))),
        (Some(from), None) => Fact::new("High-pass", format!("{} Hz, Butterworth, zero phase", hz(from))),
        (Some(from), Some(to)) => Fact::new(
            "Band",
            format!("{} to {} Hz, Butterworth high-pass and Kaiser low-pass, zero phase", hz(from), hz(to)),
        ),
    };
    let mut facts = vec![filters];
    match &band.search {
        None => {}
        Some(Err(reason)) => {
            facts.push(Fact::new("Band by kurtogram", format!("none, the high-pass is the usual one: {reason}")))
        }
        Some(Ok(search)) => facts.extend(search_facts(search)),
    }
    facts
}

fn search_facts(search: &BandSearch) -> [Fact; 2] {
    let [from, to] = search.best.edges_hz().map(|edge| significant(edge, 4));
    let (kurtosis, limit) = (search.best.kurtosis, search.best.limit);
    let percent = significant(100.0 * search.kurtogram.confidence, 3);
    let chosen = match search.chosen() {
        Some(_) => format!("{from} to {to} Hz"),
        None => format!(
            "none, the high-pass is the usual one: Gaussian noise may be as impulsive as the best, {from} to {to} Hz"
        ),
    };
    [
        Fact::new("Band by kurtogram", chosen).note(format!(
            "of those from {} Hz on and at least {} Hz wide",
            significant(search.from_hz, 4),
            significant(search.width_hz, 4)
        )),
        Fact::new("Kurtosis of that band", significant(kurtosis, 4)).note(format!(
            "0 for Gaussian noise, in {percent} of 100 windows below {} in all bands",
            significant(limit, 3)
        )),
    ]
}

/// Kurtosis over frequency and width of the band.
pub(crate) fn kurtogram_plot(sensor: &str, search: &BandSearch) -> Plot {
    // by width, widest first
    let levels: Vec<&[KurtogramBand]> = search.kurtogram.bands.chunk_by(|a, b| a.bands == b.bands).collect();
    let widest = levels.first().map_or(1.0, |level| level[0].width_hz);
    let narrowest = levels.last().map_or(1.0, |level| level[0].width_hz);
    let octaves = (widest / narrowest).log2() + 2.0 * BORDER;
    let rows = (octaves * ROWS_AN_OCTAVE).ceil();
    let lowest = narrowest * (-BORDER).exp2();
    let width_of = |row: f64| lowest * ((row + 0.5) / rows * octaves).exp2();
    // three times a power of two: every band's edges are edges of cells
    let finest = levels.last().map_or(1, |level| level.len());
    let columns = (6 * finest).min(MOST_COLUMNS);
    let mut values = Vec::with_capacity(columns * rows as usize);
    for row in 0..rows as usize {
        let width = width_of(row as f64);
        let apart = |level: &&[KurtogramBand]| (level[0].width_hz / width).log2().abs();
        let nearest = levels.iter().copied().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or_default();
        let value = |column: usize| {
            let band = nearest.get(column * nearest.len() / columns);
            band.map_or(0.0, |band| band.kurtosis)
        };
        values.extend((0..columns).map(value));
    }
    let most = values.iter().copied().fold(search.best.limit, f64::max);
    let [from, to] = search.best.edges_hz();
    let name = match search.chosen() {
        Some(_) => "chosen band",
        None => "best band, not chosen",
    };
    let edges = Abscissa::Points(vec![from, to]);
    Plot::new(
        format!("Kurtogram of {sensor}"),
        Axis::new("Frequency", "Hz").range(0.0, widest),
        Axis::new("Width of the band", "Hz").log(),
    )
    .raster(Raster {
        x: [0.0, widest],
        y: [lowest, lowest * octaves.exp2()],
        columns,
        values,
        colours: Axis::new("Kurtosis", "").range(0.0, most),
    })
    .curve(Curve::new(name, edges, vec![search.best.width_hz; 2]))
    .marker(Marker::new(search.from_hz, "bands may begin"))
    .caption("Kurtosis of the envelope in bands of many widths, less 2: 0 for Gaussian noise, -1 for a tone, large for impacts. A single large pulse has a large one too.")
}
