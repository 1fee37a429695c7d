//! Lines that have a reason already: multiples of the shaft, and the lines of what was found before.

use super::fault::{Fault, FaultOrders};
use super::line_spectrum::LineSpectrum;

/// A line takes so many times the resolution to each side; a strong one, whose foot stands above the floor, one more.
const HALF_WIDTH: f64 = 1.5;
pub(super) const STRONG_HALF_WIDTH: f64 = 2.5;
/// Lines of a short window, tapered less, are narrower by this.
pub(super) const SHORT_WIDTH: f64 = 0.8;
/// Power over the floor of a strong line, 13 dB: the Hann window's foot is 15 dB lower at 1.5 bins, 32 dB at 2.5.
const STRONG: f64 = 20.0;
/// Relative uncertainty of an explained line's order: slip that varies within the window.
const WANDERING: f64 = 5e-4;
/// Side lines of a part: to so many revolutions of the shaft, and of the cage, on each side of a harmonic; and where the resolution is
/// coarser than this order to one, since they would cover everything.
const SHAFT_SIDES: u32 = 3;
const CAGE_SIDES: u32 = 2;
const FINE_RESOLUTION: f64 = 0.03;
/// A comb beside a stronger one, so many revolutions away: its k-th tooth is the stronger one's k-th harmonic and k times as many
/// sidebands. In a 6203 the inner race less one is within 1 % of the ball, and less two of the outer race.
pub(super) const COMBS_BESIDE: u32 = 2;
const HARMONICS_BESIDE: u32 = 8;
/// Multiples of the cage's order that the balls make as they come into the load one after the other.
const CAGE_MULTIPLES: u32 = 5;

/// A line that has a reason, and which.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct KnownLine {
    pub(super) order: f64,
    /// Relative uncertainty of the order.
    pub(super) error: f64,
    pub(super) name: String,
    /// Order of the harmonic that a sideband of a race at the cage's distance belongs to: impacts all have one sign, and so has what
    /// modulates them, so that no sideband is stronger than its carrier. `None`: any power is explained.
    pub(super) carrier: Option<f64>,
    /// Whether it is of something that is no part of the bearing.
    pub(super) foreign: bool,
}

impl KnownLine {
    fn new(order: f64, error: f64, name: String) -> Self {
        Self { order, error, name, carrier: None, foreign: false }
    }

    /// Whether it may have so much power over the floor.
    pub(super) fn explains(&self, spectrum: &LineSpectrum, ratio: f64) -> bool {
        self.carrier.is_none_or(|carrier| ratio <= spectrum.ratio(carrier))
    }
}

/// Multiples of the shaft's order up to one; its speed is known within a relative error.
pub(super) fn shaft_lines(highest: f64, error: f64) -> Vec<KnownLine> {
    let count = highest.max(0.0) as u32;
    (1..=count).map(|k| KnownLine::new(f64::from(k), error, format!("{k} x shaft"))).collect()
}

/// What carries a fault through the load zone.
pub(super) fn carrier(fault: Fault) -> &'static str {
    match fault {
        Fault::Ball => "cage",
        _ => "shaft",
    }
}

/// What a line of a part is called: "2 x ball -1 x cage".
pub(crate) fn line_name(fault: Fault, harmonic: u32, side: i32) -> String {
    let name = fault.name();
    match side {
        0 => format!("{harmonic} x {name}"),
        _ => format!("{harmonic} x {name} {side:+} x {}", carrier(fault)),
    }
}

/// What strikes at an order: a part, or something else.
pub(super) struct Strikes<'a> {
    pub(super) fault: Option<Fault>,
    pub(super) name: &'a str,
    pub(super) order: f64,
}

impl Strikes<'_> {
    /// All lines up to an order that it explains: those of its impacts, and of a part those of the balls that enter the load.
    pub(super) fn lines(
        &self,
        orders: &FaultOrders,
        speed_error: f64,
        highest: f64,
        resolution: f64,
    ) -> Vec<KnownLine> {
        let cage = orders.order(Fault::Cage);
        let cage = cage.filter(|_| self.fault != Some(Fault::Cage));
        let mut lines = self.impact_lines(cage, highest, resolution);
        if let (Some(_), Some(cage)) = (self.fault, cage) {
            let error = orders.error(Fault::Cage) + speed_error;
            lines.extend((1..=CAGE_MULTIPLES).map(|multiple| {
                let name = format!("{multiple} x entry of one ball into the load zone");
                KnownLine::new(f64::from(multiple) * cage, error, name)
            }));
        }
        lines
    }

    /// Lines of its impacts beside a cage of this order: harmonics up to an order, and those beside them at the distance of the shaft
    /// and of the cage, since load and sensor see an impact once a revolution of either. The sidebands of a race at the cage's distance
    /// are weaker than their carriers.
    pub(super) fn impact_lines(&self, cage: Option<f64>, highest: f64, resolution: f64) -> Vec<KnownLine> {
        let of_race = matches!(self.fault, Some(Fault::OuterRace | Fault::InnerRace));
        let known = |order: f64, name: String, carrier: Option<f64>| KnownLine {
            carrier,
            foreign: self.fault.is_none(),
            ..KnownLine::new(order, WANDERING, name)
        };
        let fine = resolution < FINE_RESOLUTION;
        let sides = |count: u32| if fine { count } else { 1 };
        let count = (highest / self.order).min(10_000.0) as u32 + 1;
        let mut lines = Vec::new();
        for harmonic in 1..=count {
            let line = f64::from(harmonic) * self.order;
            let name = format!("{harmonic} x {}", self.name);
            lines.push(known(line, name.clone(), None));
            let mut beside = |(spacing, carrier): (f64, &str), step: u32, count: u32| {
                // lines nearer than they are wide are not told apart
                if spacing < 2.0 * STRONG_HALF_WIDTH * resolution {
                    return;
                }
                let offsets = (1..=count).flat_map(|side| {
                    let offset = f64::from(step * side);
                    [-offset, offset]
                });
                lines.extend(offsets.map(|offset| {
                    let weaker_than = (of_race && carrier == "cage").then_some(line);
                    known(line + offset * spacing, format!("{name} {offset:+} x {carrier}"), weaker_than)
                }));
            };
            let shaft = (1.0, "shaft");
            beside(shaft, 1, sides(SHAFT_SIDES));
            if harmonic <= HARMONICS_BESIDE {
                beside(shaft, harmonic, COMBS_BESIDE);
            }
            if let Some(cage) = cage {
                beside((cage, "cage"), 1, sides(CAGE_SIDES));
            }
        }
        lines.retain(|line| line.order > 0.0);
        lines
    }
}

/// Half of the width, in orders, that a known line takes in a spectrum.
pub(super) fn half_width(spectrum: &LineSpectrum, line: &KnownLine) -> f64 {
    let mut widths = if spectrum.ratio(line.order) > STRONG { STRONG_HALF_WIDTH } else { HALF_WIDTH };
    if spectrum.is_short() {
        widths *= SHORT_WIDTH;
    }
    widths * spectrum.resolution + line.error * line.order
}

/// The known line that takes an order, the nearest.
pub(super) fn coincidence<'a>(spectrum: &LineSpectrum, order: f64, known: &'a [KnownLine]) -> Option<&'a KnownLine> {
    let distance = |line: &KnownLine| (line.order - order).abs();
    let ratio = spectrum.ratio(order);
    let about =
        known.iter().filter(|line| distance(line) <= half_width(spectrum, line) && line.explains(spectrum, ratio));
    about.min_by(|a, b| distance(a).total_cmp(&distance(b)))
}
