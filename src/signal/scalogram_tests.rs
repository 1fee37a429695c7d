//! The wavelet transform against convolution in time, tones, chirps and its own parts.

use super::*;
use crate::signal::samples::{gaussian, items, load, numbers, worst};

fn series(samples: usize, rate_hz: f64, x: impl Fn(f64) -> f64) -> TimeSeries {
    let step_s = 1.0 / rate_hz;
    let values = (0..samples).map(|k| x(k as f64 * step_s)).collect();
    TimeSeries::new(0.0, step_s, "m/s^2", values).expect("a valid series")
}

fn transform(from_hz: f64, to_hz: f64, count: usize, cycles: f64) -> WaveletTransform {
    WaveletTransform { frequencies: FrequencyAxis::Logarithmic { from_hz, to_hz, count }, cycles, decimation: 1 }
}

#[test]
fn agrees_with_convolution_in_the_time_domain() {
    let reference = load("cwt");
    let x = numbers(&reference["x"]);
    let input = TimeSeries::new(0.0, 1e-3, "N", x).expect("a valid series");
    let cycles = reference["cycles"].as_f64().expect("a number");
    let rows = items(&reference["rows"]);
    for (hz, row) in numbers(&reference["frequency"]).into_iter().zip(rows) {
        let found = transform(hz, hz + 200.0, 2, cycles).scalogram(&input).expect("scalogram");
        let every_fifth: Vec<f64> = found.row(0).iter().copied().step_by(5).collect();
        // rounding of transforms and sums over 400 points
        assert!(worst(&every_fifth, &numbers(row)) < 1e-12, "{hz} Hz");
    }
}

#[test]
fn a_tone_comes_out_at_its_frequency_with_its_amplitude() {
    let tone = series(10_000, 5e3, |t| 7.0 + 2.5 * (2.0 * PI * 197.35 * t + 0.4).cos());
    for cycles in [2.0, 3.0, 6.0, 40.0] {
        let found = transform(100.0, 400.0, 120, cycles).scalogram(&tone).expect("scalogram");
        let peak = found.ridge(100.0, 400.0)[5000].expect("a ridge");
        // the parabola of log amplitude is short by the wavelet's mean correction at few cycles, and by what the ends of
        // the tone leave
        assert!((peak.frequency_hz / 197.35 - 1.0).abs() < 1e-4, "{cycles}: {peak:?}");
        assert!((peak.amplitude / 2.5 - 1.0).abs() < 1e-4, "{cycles}: {peak:?}");
    }
    // named by a scale itself
    let exact = transform(197.35, 400.0, 2, 6.0).scalogram(&tone).expect("scalogram");
    assert!((exact.row(0)[5000] / 2.5 - 1.0).abs() < 1e-9);
}

#[test]
fn the_ridge_of_a_chirp_follows_its_frequency() {
    // 100 Hz rising by 300 Hz/s; 20 cycles are 16 ms at 200 Hz, over which it rises by 5 Hz
    let chirp = series(10_000, 5e3, |t| (2.0 * PI * (100.0 * t + 150.0 * t * t)).sin());
    let found = transform(50.0, 1500.0, 200, 20.0).scalogram(&chirp).expect("scalogram");
    let ridge = found.ridge(50.0, 1500.0);
    for (t, peak) in found.time_s.iter().zip(&ridge).skip(1000).take(8000).step_by(50) {
        let expected = 100.0 + 300.0 * t;
        let found = peak.expect("a ridge").frequency_hz;
        // the wavelets' bandwidth grows along the chirp
        assert!((found / expected - 1.0).abs() < 2e-3, "{t} s: {found} Hz");
    }
}

#[test]
fn the_cone_holds_what_the_ends_spoil() {
    let tone = series(4000, 2e3, |t| (2.0 * PI * 50.0 * t).cos());
    let found = transform(50.0, 60.0, 2, 6.0).scalogram(&tone).expect("scalogram");
    let deviation = 6.0 / (2.0 * PI * 50.0);
    assert!((found.cone_s[0] / (2_f64.sqrt() * deviation) - 1.0).abs() < 1e-12);
    let edge = (found.cone_s[0] * 2e3) as usize;
    // a Gaussian cut sqrt(2) deviations from its middle has lost 7.9 % of its area
    let lost = 1.0 - found.row(0)[edge];
    assert!((lost - 0.079).abs() < 5e-3, "{lost}");
    assert!((found.row(0)[4 * edge] - 1.0).abs() < 1e-6);
}

#[test]
fn decimation_keeps_level_and_energy_and_folds_nothing() {
    // 20 kHz; a carrier of 4 kHz whose envelope moves with 450 Hz, seen every 2 ms: 450 Hz would fold to 50 Hz
    let modulated = series(20_000, 2e4, |t| (1.0 + 0.5 * (2.0 * PI * 450.0 * t).cos()) * (2.0 * PI * 4e3 * t).cos());
    let full = transform(4e3, 5e3, 2, 6.0);
    let coarse = WaveletTransform { decimation: 40, ..full };
    let full = full.scalogram(&modulated).expect("scalogram");
    let coarse = coarse.scalogram(&modulated).expect("scalogram");
    assert_eq!(coarse.time_s.len(), 500);
    assert!((coarse.time_s[1] - 2e-3).abs() < 1e-15);
    let inside = &coarse.row(0)[50..450];
    let power = |row: &[f64]| row.iter().map(|a| a * a).sum::<f64>() / row.len() as f64;
    let level = power(inside).sqrt();
    let spread = inside.iter().fold(0.0, |w: f64, a| w.max((a / level - 1.0).abs()));
    assert!(spread < 1e-6, "{spread:e}");
    // the squares over whole periods of the modulation
    assert!((power(inside) / power(&full.row(0)[2000..18_000]) - 1.0).abs() < 1e-6);
    assert!(coarse.cone_s[0] > full.cone_s[0] + 3.9e-3);
    // where the envelope is slow every value is that of the whole transform
    let slow = series(20_000, 2e4, |t| (1.0 + 0.5 * (2.0 * PI * 2.0 * t).cos()) * (2.0 * PI * 4e3 * t).cos());
    let settings = transform(3e3, 5e3, 9, 6.0);
    let full = settings.scalogram(&slow).expect("scalogram");
    let coarse = WaveletTransform { decimation: 20, ..settings };
    let coarse = coarse.scalogram(&slow).expect("scalogram");
    for index in 0..9 {
        let largest = full.row(index).iter().fold(0.0, |w: f64, a| w.max(*a));
        for k in 20..980 {
            let apart = (full.row(index)[20 * k] - coarse.row(index)[k]).abs();
            // smoothing over 1 ms of a 2 Hz modulation, (2 pi 2 1e-3)^2 / 2
            assert!(apart < 2e-4 * largest, "{index} {k}: {apart}");
        }
    }
}

#[test]
fn decimation_of_noise_is_the_smoothed_power() {
    let noise = gaussian(6000, 1);
    let input = TimeSeries::new(0.0, 1e-3, "N", noise).expect("a valid series");
    // spectra that end at neither zero nor half the rate: cut there a wavelet would ring to the ends
    let settings = transform(60.0, 250.0, 4, 10.0);
    let full = settings.scalogram(&input).expect("scalogram");
    for decimation in [2, 30] {
        let coarse = WaveletTransform { decimation, ..settings };
        let coarse = coarse.scalogram(&input).expect("scalogram");
        for index in 0..4 {
            for middle in [1800, 2310, 3000, 3930] {
                let reach = 9 * decimation;
                let around = (middle - reach..=middle + reach).map(|k| {
                    let deviations = (k as f64 - middle as f64) / decimation as f64;
                    ((-0.5 * deviations * deviations).exp(), full.row(index)[k].powi(2))
                });
                let (weights, sum) = around.fold((0.0, 0.0), |(w, s), (a, b)| (w + a, s + a * b));
                let expected = (sum / weights).sqrt();
                let found = coarse.row(index)[middle / decimation];
                // a Gaussian cut at nine deviations, rounding
                assert!((found / expected - 1.0).abs() < 1e-12, "{decimation} {index} {middle}");
            }
        }
    }
}

#[test]
fn threads_change_no_bit() {
    let input = series(3000, 1e4, |t| (2.0 * PI * 900.0 * t * t).sin() + (1e5 * t * t * t).cos());
    for decimation in [1, 7] {
        let settings = WaveletTransform { decimation, ..transform(50.0, 4e3, 40, 5.0) };
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("a pool").install(|| settings.scalogram(&input).expect("scalogram"))
        };
        assert_eq!(with(1), with(3));
    }
}

#[test]
fn errors_fire_with_their_exact_messages() {
    let input = series(100, 1e3, |t| t);
    let message = |settings: WaveletTransform| settings.scalogram(&input).expect_err("must fail").to_string();
    let good = transform(20.0, 400.0, 5, 6.0);
    assert_eq!(message(WaveletTransform { cycles: 1.9, ..good }), "a wavelet must have 2 to 1000 cycles, found 1.9");
    assert!(message(WaveletTransform { cycles: f64::NAN, ..good }).ends_with("found NaN"));
    assert_eq!(
        message(WaveletTransform { decimation: 0, ..good }),
        "decimation of 100 samples must be by 1 to half as many, found 0"
    );
    assert!(message(WaveletTransform { decimation: 51, ..good }).ends_with("found 51"));
    assert_eq!(
        message(transform(9.0, 400.0, 5, 6.0)),
        "frequencies must satisfy 10 Hz <= from < to < 500 Hz and be 2 to 65536, found 5 from 9 Hz to 400 Hz"
    );
    let long = series(10_000, 1e3, |t| t);
    let many = transform(20.0, 400.0, 30_000, 6.0).scalogram(&long).expect_err("must fail");
    assert_eq!(many.to_string(), "300000000 points are needed, at most 268435456 are offered: take a shorter stretch");
    for cycles in [2.0, 1000.0] {
        let few = WaveletTransform { decimation: 50, ..transform(10.0, 11.0, 2, cycles) };
        assert_eq!(few.scalogram(&input).expect("scalogram").amplitude.len(), 4);
    }
    let longest = transform(10.0, 400.0, 5, 1000.0).scalogram(&input).expect("scalogram");
    assert_eq!(longest.amplitude.len(), 500);
    assert!(longest.row(5).is_empty());
}
