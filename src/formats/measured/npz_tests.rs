//! Archives: a time or a rate, shapes, the shaft's speed.

use super::read_signals;
use super::tests::{archive, assert_samples, only, put, request, samples};

#[test]
fn archives_are_read_with_a_time_or_a_rate() {
    let values = samples(50);
    let times: Vec<f64> = (0..50).map(|k| 2.0 + f64::from(k) / 1024.0).collect();
    let (_kept, path) = archive("run.npz", |npz| {
        put(npz, "time_s", &[50], &times);
        put(npz, "P1", &[50], &values);
        put(npz, "ball_radius", &[50, 2], &[0.0; 100]);
        put(npz, "short", &[49], &values[..49]);
    });
    let found = only(read_signals(&path, &request(&["P1"], None)).unwrap());
    assert_samples(&found, 2.0, 1.0 / 1024.0, &values, 0.0);
    let message = |name: &str| {
        let error = read_signals(&path, &request(&[name], None)).unwrap_err();
        error.to_string().replace(&path.display().to_string(), "F")
    };
    assert_eq!(
        message("ball_radius"),
        "F: array \"ball_radius\": expected a signal of 50 samples, as the time has, found shape [50, 2]"
    );
    assert_eq!(
        message("short"),
        "F: array \"short\": expected a signal of 50 samples, as the time has, found shape [49]"
    );
    for (rate, known) in [(Some(2048.0), None), (None, Some(2048.0))] {
        let (_kept, path) = archive("rate.npz", |npz| {
            put(npz, "x", &[50], &values);
            if let Some(rate) = known {
                put(npz, "fs", &[1], &[rate]);
            }
        });
        let found = only(read_signals(&path, &request(&[], rate)).unwrap());
        assert_samples(&found, 0.0, 1.0 / 2048.0, &values, 0.0);
    }
    let (_kept, path) = archive("none.npz", |npz| put(npz, "x", &[50], &values));
    let error = read_signals(&path, &request(&[], None)).unwrap_err();
    assert_eq!(error.help().unwrap(), "give the sampling rate with --rate HZ");
}

#[test]
fn two_times_are_refused_without_a_rate() {
    let (_kept, path) = archive("two.npz", |npz| {
        for (name, step) in [("t", 1e-3), ("time", 1e-4), ("x", 1.0)] {
            put(npz, name, &[4], &[0.0, 1.0, 2.0, 3.0].map(|k| step * k));
        }
    });
    let error = read_signals(&path, &request(&["x"], None)).unwrap_err().to_string();
    assert!(error.ends_with("array \"time\": expected one array of times, found \"t\" beside it"), "{error}");
    let typed = only(read_signals(&path, &request(&["x"], Some(2e3))).unwrap());
    assert_eq!(typed.series.values(), [0.0, 1.0, 2.0, 3.0]);
}

#[test]
fn a_time_and_a_rate_that_contradict_each_other_are_refused() {
    let (_kept, path) = archive("both.npz", |npz| {
        let times: Vec<f64> = (0..64).map(|k| f64::from(k) / 1000.0).collect();
        put(npz, "time", &[64], &times);
        put(npz, "fs", &[1], &[2000.0]);
        put(npz, "x", &[64], &samples(64));
    });
    let error = read_signals(&path, &request(&[], None)).unwrap_err().to_string();
    assert!(error.contains("found 2000 Hz in \"fs\" and 1000"), "{error}");
    let found = only(read_signals(&path, &request(&[], Some(2000.0))).unwrap());
    assert!((found.series.rate_hz() / 2000.0 - 1.0).abs() < 1e-12);
}

#[test]
fn archives_may_state_the_speed() {
    let values = samples(50);
    let found = |speeds: &[(&str, &[f64])], channels: &[&str]| {
        let (_kept, path) = archive("speed.npz", |npz| {
            put(npz, "x", &[50], &values);
            put(npz, "fs", &[1], &[2048.0]);
            for (name, speed) in speeds {
                put(npz, name, &[speed.len()], speed);
            }
        });
        let found = read_signals(&path, &request(channels, None)).unwrap();
        found.iter().map(|own| own.speed_hz).collect::<Vec<_>>()
    };
    assert_eq!(found(&[], &[]), [None]);
    // a number that states the speed is no signal
    assert_eq!(found(&[("speed_hz", &[29.5])], &[]), [Some(29.5)]);
    assert_eq!(found(&[("Motor_RPM", &[1770.0])], &[]), [Some(29.5)]);
    let both: [(&str, &[f64]); 2] = [("rpm", &[1770.0]), ("speed_hz", &[29.0])];
    assert_eq!(found(&both, &[]), [None]);
    // a speed over time is one, and states nothing
    let over_time = [("rpm", &values[..])];
    assert_eq!(found(&over_time, &["x", "rpm"]), [None, None]);
}
