//! The band of a signal whose envelope is taken: as asked for, or the most impulsive one of a window.
//!
//! The band before an envelope in a report, and the kurtogram that it is from.

use crate::app::case::{Case, EnvelopeBand};
use crate::app::error::ComputeError;
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::report::{Abscissa, Axis, Curve, Fact, Marker, Plot, Raster, significant};
use crate::signal::diagnosis::{FaultOrders, JUDGED_HARMONICS};
use crate::signal::{
    Butterworth, DEFAULT_ORDER, FilterBand, Kurtogram, KurtogramBand, SignalError, kurtogram, usual_high_pass_hz,
};
use schemars::JsonSchema;
use serde::Serialize;

/// Multiples of the shaft's speed that a machine's own lines may reach, which are not to be taken for a resonance: unbalance,
/// couplings, blades, teeth of a first gear.
const SHAFT_ORDERS: f64 = 40.0;

/// Confidence of the limit that Gaussian noise keeps below, for all bands together.
const CONFIDENCE: f64 = 0.99;

/// Highest middle of a band over the sampling rate. What samples has a low-pass before it, and beyond about 0.4 of the rate there is
/// nothing: kurtosis does not know how weak a band is.
const HIGHEST_PART: f64 = 0.4;

/// Most levels of halving, 4096 bands: finer is no picture, and a window that long is another's work.
const MOST_LEVELS: usize = 12;

/// Periods of a corner that are read before and after a window: filter and envelope err there, by the ends of what is read, by
/// 1 / (pi 2 pi n) of the signal n periods from an end.
const MARGIN_PERIODS: f64 = 200.0;

/// The band before the envelope as it is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AskedBand {
    /// All above a corner, Hz.
    HighPass(f64),
    /// Between two frequencies, Hz.
    Between([f64; 2]),
    /// The most impulsive band of each window.
    Kurtogram,
}

impl AskedBand {
    /// What a case asks for; `None`: the signal as it is.
    #[must_use]
    pub(crate) fn of(case: &Case) -> Option<Self> {
        let corner = case.analysis.high_pass_hz.map(Self::HighPass);
        corner.or(case.analysis.band_hz.map(Self::from))
    }

    /// Corner of the high-pass that is nearest to it, Hz, for figures that have to be of one band in all runs; of a kurtogram
    /// the usual one at that sampling rate.
    #[must_use]
    pub(crate) fn corner_hz(self, rate_hz: f64) -> f64 {
        match self {
            Self::HighPass(corner) | Self::Between([corner, _]) => corner,
            Self::Kurtogram => usual_high_pass_hz(rate_hz),
        }
    }
}

impl From<EnvelopeBand> for AskedBand {
    fn from(band: EnvelopeBand) -> Self {
        match band {
            EnvelopeBand::Between(edges) => Self::Between(edges),
            EnvelopeBand::Kurtogram => Self::Kurtogram,
        }
    }
}

/// The band before the envelope as it was used.
#[derive(Debug, Clone, Default, PartialEq, Serialize, JsonSchema)]
pub struct UsedBand {
    /// Corner of the high-pass before the envelope, Hz; `None`: none.
    pub high_pass_hz: Option<f64>,
    /// End of the band, Hz; `None`: that of the signal.
    #[serde(skip)]
    pub low_pass_hz: Option<f64>,
    /// Band that a search found or that was asked for, Hz; `None`: not a band between two frequencies.
    pub band_hz: Option<[f64; 2]>,
    /// Spectral kurtosis of the best band of a search.
    pub kurtosis_of_band: Option<f64>,
    /// What noise alone stays below.
    pub kurtosis_limit: Option<f64>,
    /// The search that it is from, or why there was none; `None`: not asked for.
    #[serde(skip)]
    pub search: Option<Result<BandSearch, String>>,
}

impl UsedBand {
    /// The band for a window (s) of a signal at a mean speed (Hz). `read` gives the stretch that holds the window, with so many
    /// seconds before and after as there are.
    ///
    /// A search that finds nothing, or cannot be made, leaves the high-pass of [`usual_high_pass_hz`].
    ///
    /// # Errors
    /// Of `read`.
    pub(crate) fn of(
        asked: Option<AskedBand>,
        window: TimeWindow,
        read: impl Fn(TimeWindow, f64) -> Result<TimeSeries, ComputeError>,
        speed_hz: f64,
        orders: &FaultOrders,
    ) -> Result<Self, ComputeError> {
        match asked {
            None => Ok(Self::default()),
            Some(AskedBand::HighPass(corner)) => Ok(Self::above(corner)),
            Some(AskedBand::Between([from, to])) => {
                Ok(Self { low_pass_hz: Some(to), band_hz: Some([from, to]), ..Self::above(from) })
            }
            Some(AskedBand::Kurtogram) => {
                let limits = SearchLimits::new(speed_hz, orders);
                let stretch = read(window, margin_s(limits.from_hz))?;
                let search = limits.search(&stretch, window);
                let chosen = search.as_ref().ok().and_then(BandSearch::chosen);
                let used = chosen.map_or_else(
                    || Self::above(usual_high_pass_hz(stretch.rate_hz())),
                    |band| {
                        let [from, to] = band.edges_hz();
                        let ends = to > (1.0 - 1e-9) * 0.5 * stretch.rate_hz();
                        let low_pass_hz = (!ends).then_some(to);
                        Self { low_pass_hz, band_hz: Some([from, to]), ..Self::above(from) }
                    },
                );
                let best = search.as_ref().ok().map(|search| search.best);
                Ok(Self {
                    kurtosis_of_band: best.map(|best| best.kurtosis),
                    kurtosis_limit: best.map(|best| best.limit),
                    search: Some(search),
                    ..used
                })
            }
        }
    }

    fn above(corner: f64) -> Self {
        Self { high_pass_hz: Some(corner), ..Self::default() }
    }

    /// Seconds that are to be read before and after a window.
    pub(crate) fn margin_s(&self) -> f64 {
        self.high_pass_hz.map_or(0.0, margin_s)
    }

    /// The band that a verdict is sought in, Hz: what was asked for and found, of a simulated signal no higher than `good_to_hz`, where it
    /// is accurate, unless that end was asked for. `None`: all.
    #[must_use]
    pub(crate) fn judged_hz(&self, asked: Option<AskedBand>, good_to_hz: Option<f64>) -> Option<[f64; 2]> {
        let end_hz = good_to_hz.unwrap_or(f64::INFINITY);
        match asked {
            None => good_to_hz.map(|end_hz| [0.0, end_hz]),
            Some(AskedBand::HighPass(corner)) => Some([corner, end_hz]),
            Some(AskedBand::Between(edges)) => Some(edges),
            Some(AskedBand::Kurtogram) => {
                let [from, to] = self.band_hz?;
                Some([from, to.min(end_hz)])
            }
        }
    }

    /// The search, if there was one.
    #[must_use]
    pub(crate) fn found(&self) -> Option<&BandSearch> {
        self.search.as_ref()?.as_ref().ok()
    }
}

fn margin_s(corner_hz: f64) -> f64 {
    if corner_hz > 0.0 { MARGIN_PERIODS / corner_hz } else { 0.0 }
}

/// Where bands may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
struct SearchLimits {
    from_hz: f64,
    width_hz: f64,
}

impl SearchLimits {
    /// A band is as wide as the envelope's highest harmonic that is judged: the envelope of a band of width B has nothing beyond B.
    /// It begins no lower, or its envelope is that of no carrier, and above the shaft's own lines.
    fn new(speed_hz: f64, orders: &FaultOrders) -> Self {
        let width_hz = f64::from(JUDGED_HARMONICS) * orders.highest() * speed_hz;
        Self { from_hz: width_hz.max(SHAFT_ORDERS * speed_hz), width_hz }
    }

    fn allow(self, band: &KurtogramBand, rate_hz: f64) -> bool {
        let [from, _] = band.edges_hz();
        from >= self.from_hz && band.width_hz >= self.width_hz && band.centre_hz <= HIGHEST_PART * rate_hz
    }

    fn search(self, stretch: &TimeSeries, window: TimeWindow) -> Result<BandSearch, String> {
        let half_hz = 0.5 * stretch.rate_hz();
        if self.width_hz <= 0.0 {
            return Err("the shaft rests".to_owned());
        }
        if self.from_hz >= half_hz {
            return Err(format!(
                "bands would have to begin at {:.0} Hz or above, and the signal ends at {half_hz:.0} Hz",
                self.from_hz
            ));
        }
        let kurtogram = self.kurtogram(stretch, window);
        let kurtogram = kurtogram.map_err(|error| error.to_string())?;
        let allowed = kurtogram.of_those(|band| self.allow(band, stretch.rate_hz()));
        let best = allowed.largest().copied();
        let best = best.ok_or_else(|| {
            format!(
                "no band of {:.0} Hz or more fits between {:.0} Hz and the end of the signal at {half_hz:.0} Hz",
                self.width_hz, self.from_hz
            )
        })?;
        Ok(BandSearch {
            best: allowed.most_impulsive().copied().unwrap_or(best),
            kurtogram,
            from_hz: self.from_hz,
            width_hz: self.width_hz,
        })
    }

    /// Of the window's signal without what lies below the limits, which would leak into the lower bands.
    fn kurtogram(self, stretch: &TimeSeries, window: TimeWindow) -> Result<Kurtogram, SignalError> {
        let filter = Butterworth { band: FilterBand::HighPass { cut_off_hz: self.from_hz }, order: DEFAULT_ORDER };
        let part = filter.zero_phase(stretch)?.window(window.from, window.to)?;
        let halvings = (0.5 * part.rate_hz() / self.width_hz).log2();
        let levels = (halvings.floor() as usize).clamp(1, MOST_LEVELS);
        kurtogram(&part, levels, CONFIDENCE)
    }
}

/// Search for the band whose envelope says most of impacts: the fast kurtogram of a window.
///
/// Allowed are bands at least as wide as eight times the highest order's frequency, from that frequency and the 40th multiple of the
/// shaft's on, with their middle below 0.4 of the sampling rate.
///
/// Source: J. Antoni, "Fast computation of the kurtogram for the detection of transient faults", Mechanical Systems and Signal
/// Processing 21 (2007) 108-124.
#[derive(Debug, Clone, PartialEq)]
pub struct BandSearch {
    /// Kurtosis of all bands, those included that are not allowed.
    pub kurtogram: Kurtogram,
    /// Lowest frequency at which a band may begin, Hz.
    pub from_hz: f64,
    /// Least width of a band, Hz.
    pub width_hz: f64,
    /// Of the allowed bands beyond their limits that of the largest kurtosis; if none is beyond, of all allowed ones.
    pub best: KurtogramBand,
}

impl BandSearch {
    /// The band to demodulate; `None`: no allowed band can be told from Gaussian noise.
    #[must_use]
    pub(crate) fn chosen(&self) -> Option<&KurtogramBand> {
        Some(&self.best).filter(|band| band.kurtosis > band.limit)
    }
}

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
