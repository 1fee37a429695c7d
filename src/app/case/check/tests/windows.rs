//! Stretches of time that the analysis takes.

use super::{breaks, full, holds};
use crate::app::case::tests::{FULL, read};

#[test]
fn windows_lie_within_the_simulation() {
    for (argument, from, to) in
        [("analysis.envelope[0]={from=0.4,to=1}", "0.4", "1"), ("analysis.envelope[0]={from=2,to=2.9}", "2", "2.9")]
    {
        let rule = format!("found {from} to {to} s, expected a window within the simulation (0.5 to 2.8 s)");
        full(argument, &rule);
    }
    let help = |set: &str| read(FULL, &[set]).unwrap_err().help().unwrap();
    assert_eq!(
        help("analysis.envelope[0]={from=2,to=2.9}"),
        "simulate it all, `transient.end` = 2.9; or look at less, `analysis.envelope[0].from` = 2 and `analysis.envelope[0].to` = 2.8"
    );
    assert!(help("analysis.envelope[0]={from=3,to=4}").ends_with("from` = 1.65 and `analysis.envelope[0].to` = 2.8"));
    holds(FULL, &["analysis.envelope[0]={from=0.5,to=2.8}"]);
}

#[test]
fn a_scalogram_lies_within_the_simulation_and_its_sampling_rate() {
    let with = |window: &str| format!("analysis.scalogram={{{window}}}");
    for (window, key, rule) in [
        (
            "from=0.4,to=1,band_hz=[500,40000]",
            "",
            "found 0.4 to 1 s, expected a window within the simulation (0.5 to 2.8 s)",
        ),
        ("from=2,to=2,band_hz=[500,40000]", ".to", "found 2, expected more than `from` (2)"),
        ("from=1,to=2,band_hz=[0,40000]", ".band_hz[0]", "found 0, expected a number above 0"),
        ("from=1,to=2,band_hz=[500,500]", ".band_hz[1]", "found 500, expected more than the lowest frequency (500)"),
        (
            "from=1,to=2,band_hz=[500,50000]",
            ".band_hz[1]",
            "found 50000, expected below half of `transient.output_hz` (50000)",
        ),
        ("from=1,to=2,band_hz=[500,40000],cycles=1", ".cycles", "found 1, expected a number from 2 to 1000"),
    ] {
        let key = format!("analysis.scalogram{key}");
        breaks(FULL, &[&with(window)], &key, rule);
    }
    holds(FULL, &[&with("from=1,to=2,band_hz=[500,40000],cycles=12")]);
}
