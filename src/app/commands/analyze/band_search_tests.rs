//! Which band is taken, and when none is.

use std::f64::consts::TAU;

use super::band_search::{AskedBand, UsedBand, band_facts, kurtogram_plot};
use crate::numerics::series::{TimeSeries, TimeWindow};
use crate::signal::diagnosis::FaultOrders;
use crate::signal::samples::gaussian;

const WINDOW: TimeWindow = TimeWindow { from: 0.2, to: 0.6 };

/// Orders of which the highest is 5.
fn orders() -> FaultOrders {
    FaultOrders::new([Some(3.0), Some(5.0), None, None], 0.0).unwrap()
}

/// Of noise of deviation 1, 0.8 s at `rate_hz`, and what is added at each instant.
fn signal(rate_hz: f64, added: impl Fn(f64) -> f64) -> TimeSeries {
    let mut values = gaussian((0.8 * rate_hz) as usize, 11);
    for (k, value) in values.iter_mut().enumerate() {
        *value += added(k as f64 / rate_hz);
    }
    TimeSeries::new(0.0, 1.0 / rate_hz, "m/s^2", values).unwrap()
}

/// A ring of `hz`, 5 % damping, struck 60 times a second.
fn rings(hz: f64, time: f64) -> f64 {
    let since = time - (60.0 * time).floor() / 60.0;
    (-0.05 * TAU * hz * since).exp() * (TAU * hz * since).sin()
}

fn used_in(asked: AskedBand, window: TimeWindow, signal: &TimeSeries, speed_hz: f64) -> UsedBand {
    let read = |window: TimeWindow, margin_s: f64| {
        let span = signal.span();
        let (from, to) = (window.from - margin_s, window.to + margin_s);
        Ok(signal.window(from.max(span.from), to.min(span.to))?)
    };
    UsedBand::of(Some(asked), window, read, speed_hz, &orders()).unwrap()
}

/// By kurtogram, at 20 Hz: bands from 800 Hz on, that wide.
fn used(signal: &TimeSeries) -> UsedBand {
    used_in(AskedBand::Kurtogram, WINDOW, signal, 20.0)
}

fn facts(band: &UsedBand) -> Vec<String> {
    let facts = band_facts(band).into_iter();
    facts.map(|fact| format!("{}: {}", fact.name, fact.value)).collect()
}

#[test]
fn the_band_that_rings_is_taken() {
    // beside it a vibration of the shaft's 10th multiple, a hundred times the noise
    let signal = signal(50e3, |t| 8.0 * rings(8e3, t) + 100.0 * (TAU * 200.0 * t).sin());
    let band = used(&signal);
    let [from, to] = band.band_hz.expect("a band");
    assert!((from..to).contains(&8e3), "{from} {to}");
    assert_eq!((band.high_pass_hz, band.low_pass_hz), (Some(from), Some(to)));
    let search = band.found().unwrap();
    assert!((search.width_hz - 800.0).abs() < 1e-9 && (search.from_hz - 800.0).abs() < 1e-9);
    assert!(to - from >= 800.0 && from >= 800.0);
    assert!(search.best.kurtosis > search.best.limit);
    let plot = kurtogram_plot("P1", search);
    let raster = plot.raster.as_ref().unwrap();
    // 32 bands of 781 Hz are too narrow; the tree ends with 24 of 1042 Hz, all thirds of a power of two
    assert_eq!(search.kurtogram.bands.last().unwrap().bands, 24);
    assert_eq!(raster.columns % 24, 0);
    assert_eq!(raster.values.len() % raster.columns, 0);
    let most = raster.values.iter().copied().fold(0.0, f64::max);
    assert!((most / search.kurtogram.largest().unwrap().kurtosis - 1.0).abs() < 1e-12);
    let facts = facts(&band);
    assert!(facts[0].starts_with("Band: "), "{facts:?}");
    assert!(facts[1].starts_with("Band by kurtogram: ") && facts[1].ends_with(" Hz"));
}

#[test]
fn a_band_up_to_the_end_of_the_signal_has_no_low_pass() {
    let signal = signal(20e3, |t| 8.0 * rings(7.5e3, t));
    // at 100 Hz a band is 4 kHz wide at least: there is one
    let band = used_in(AskedBand::Kurtogram, WINDOW, &signal, 100.0);
    assert_eq!(band.band_hz, Some([5e3, 10e3]));
    assert_eq!((band.high_pass_hz, band.low_pass_hz), (Some(5e3), None));
}

#[test]
fn noise_alone_has_no_band() {
    let band = used(&signal(50e3, |_| 0.0));
    assert_eq!(band.band_hz, None);
    assert_eq!((band.high_pass_hz, band.low_pass_hz), (Some(5e3), None));
    let search = band.found().expect("a search");
    assert!(search.best.kurtosis <= search.best.limit);
    let facts = facts(&band);
    assert!(
        facts[1]
            .starts_with("Band by kurtogram: none, the high-pass is the usual one: Gaussian noise may be as impulsive"),
        "{facts:?}"
    );
}

/// What rings below the 40th multiple of the shaft's speed may be the machine's own.
#[test]
fn bands_keep_clear_of_the_shaft() {
    let band = used(&signal(50e3, |t| 30.0 * rings(400.0, t)));
    let search = band.found().unwrap();
    assert!(search.kurtogram.largest().unwrap().centre_hz < 1600.0);
    assert!(search.best.edges_hz()[0] >= 800.0, "{:?}", search.best);
}

/// Beyond 0.4 of the rate a low-pass before the sampling leaves nothing.
#[test]
fn bands_keep_clear_of_the_end() {
    let band = used(&signal(50e3, |t| 8.0 * rings(23e3, t)));
    let search = band.found().unwrap();
    let most = search.kurtogram.largest().unwrap();
    assert!(most.centre_hz > 20e3, "{most:?}");
    assert!(search.best.centre_hz <= 20e3, "{:?}", search.best);
}

/// One pulse before the window, far stronger than anything in it.
#[test]
fn the_window_alone_decides() {
    let pulse = |t: f64| {
        let since = t - 0.1;
        let rings = (-2e3 * since).exp() * (TAU * 15e3 * since).sin();
        if since < 0.0 { 0.0 } else { 1e3 * rings }
    };
    let alone = used(&signal(50e3, |t| 8.0 * rings(8e3, t)));
    let with_pulse = used(&signal(50e3, |t| 8.0 * rings(8e3, t) + pulse(t)));
    assert_eq!(alone.band_hz, with_pulse.band_hz);
    assert!(alone.band_hz.is_some());
}

#[test]
fn where_no_search_can_be_made_the_usual_high_pass_says_why() {
    let reason = |band: &UsedBand| band.search.clone().unwrap().unwrap_err();
    let slow = signal(2e3, |_| 0.0);
    let by = |window, speed_hz| used_in(AskedBand::Kurtogram, window, &slow, speed_hz);
    let narrow = by(WINDOW, 20.0);
    assert_eq!(narrow.high_pass_hz, Some(250.0));
    assert_eq!(reason(&narrow), "no band of 800 Hz or more fits between 800 Hz and the end of the signal at 1000 Hz");
    assert_eq!(
        reason(&by(WINDOW, 25.0)),
        "bands would have to begin at 1000 Hz or above, and the signal ends at 1000 Hz"
    );
    assert_eq!(reason(&by(WINDOW, 0.0)), "the shaft rests");
    let short = TimeWindow { from: 0.2, to: 0.3 };
    assert_eq!(reason(&by(short, 5.0)), "series has 200 samples, the filter or transform needs at least 344");
    assert_eq!(facts(&by(WINDOW, 0.0))[1], "Band by kurtogram: none, the high-pass is the usual one: the shaft rests");
}

#[test]
fn what_is_asked_for_is_used() {
    let signal = signal(50e3, |_| 0.0);
    let by = |asked| used_in(asked, WINDOW, &signal, 20.0);
    let corner = by(AskedBand::HighPass(3e3));
    assert_eq!((corner.high_pass_hz, corner.low_pass_hz), (Some(3e3), None));
    assert_eq!((corner.band_hz, corner.search.is_none()), (None, true));
    let between = by(AskedBand::Between([3e3, 9e3]));
    assert_eq!(between.band_hz, Some([3e3, 9e3]));
    assert_eq!(facts(&between), ["Band: 3000 to 9000 Hz, Butterworth high-pass and Kaiser low-pass, zero phase"]);
    for (asked, corner_hz) in
        [(AskedBand::HighPass(3e3), 3e3), (AskedBand::Between([2e3, 9e3]), 2e3), (AskedBand::Kurtogram, 1e3)]
    {
        assert!((asked.corner_hz(8e3) - corner_hz).abs() < 1e-9);
    }
}

/// A simulated signal is not judged where it is not accurate, unless that end is asked for.
#[test]
fn a_verdict_looks_no_higher_than_a_simulated_signal_is_good_for() {
    let judged = |asked, good_to_hz| UsedBand::default().judged_hz(asked, good_to_hz);
    let above = Some(AskedBand::HighPass(5e3));
    assert_eq!(judged(above, Some(40e3)), Some([5e3, 40e3]));
    assert_eq!(judged(above, None), Some([5e3, f64::INFINITY]));
    assert_eq!(judged(None, Some(40e3)), Some([0.0, 40e3]));
    assert_eq!(judged(None, None), None);
    let between = Some(AskedBand::Between([5e3, 45e3]));
    assert_eq!(judged(between, Some(40e3)), Some([5e3, 45e3]));
}
