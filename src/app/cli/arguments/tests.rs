//! What can be typed, and what is refused.

use clap::{CommandFactory, Parser, ValueEnum};

use super::chart::budget;
use super::options::without_manner;
use super::{Arguments, ChartPart, Command, ExportFormat, word};

fn parse(words: &str) -> Result<Arguments, clap::Error> {
    Arguments::try_parse_from(words.split(' '))
}

#[test]
fn the_definition_is_consistent() {
    Arguments::command().debug_assert();
}

#[test]
fn a_budget_has_its_unit() {
    for (text, seconds) in [("45s", 45.0), ("2min", 120.0), ("2 min", 120.0), ("1.5h", 5400.0), ("1e2s", 100.0)] {
        assert!((budget(text).unwrap().as_secs_f64() - seconds).abs() < 1e-9, "{text}");
    }
    for text in ["45", "2m", "", "min", "-1min", "0s", "0.5s", "nans", "infh", "1e9h", "2 weeks", "1:30min"] {
        let error = budget(text).unwrap_err();
        let expected = format!("expected a time from 1s to 8000h, such as 45s, 2min or 1h, found \"{text}\"");
        assert_eq!(error, expected);
    }
    let Arguments { command, .. } = parse("plummer chart a.toml --budget 2min").unwrap();
    assert!(matches!(command, Command::Chart { budget: Some(time), quick: false, .. } if time.as_secs() == 120));
}

#[test]
fn what_was_typed_can_be_typed_again() {
    let words = ["--out", "a b", "run", "a.toml", "--cache=c", "--set", "x=1", "--force", "--threads", "2", "--quick"];
    let line = without_manner(words.into_iter().map(str::to_owned));
    assert_eq!(line, "plummer --out 'a b' run a.toml --set 'x=1' --quick");
}

#[test]
fn options_stand_before_or_after_the_command() {
    for words in [
        "plummer run a.toml --out o --threads 3 --force --set a=1 --set b=2",
        "plummer --out o --threads 3 --force --set a=1 --set b=2 run a.toml",
    ] {
        let Arguments { command, options } = parse(words).unwrap();
        assert!(matches!(command, Command::Run { case, resume: false, .. } if case.as_os_str() == "a.toml"));
        assert_eq!(options.out.unwrap().as_os_str(), "o");
        assert_eq!(options.threads.unwrap().get(), 3);
        assert!(options.force && !options.quiet && !options.json);
        assert_eq!(options.set, ["a=1", "b=2"]);
    }
}

#[test]
fn wrong_arguments_are_exit_code_2_and_help_is_0() {
    for words in [
        "plummer",
        "plummer run",
        "plummer rnu a.toml",
        "plummer run a.toml --threads 0",
        "plummer run a.toml --threads 1025",
        "plummer run a.toml --threads 100000",
        "plummer modes a.toml --fast",
        "plummer inspect a.msh --length-unit feet",
        "plummer inspect a.msh --density -1",
        "plummer export a.toml",
        "plummer export a.toml --to stl",
        "plummer chart a.toml --only speed",
        "plummer run a.toml --checkpoint-every -1",
        "plummer run a.toml --checkpoint-every NaN",
        "plummer analyze",
        "plummer analyze a.csv --window 3:2",
        "plummer analyze a.csv --speed fast",
        "plummer analyze a.csv --balls 9",
        "plummer analyze a.csv --orders outer=3.6 --bearing a.toml",
        "plummer analyze a.csv --rate 0",
        "plummer analyze a.csv --bearing 6205 --contact-angle 90",
        "plummer analyze a.csv --orders outer=3.6 --contact-angle 15",
        "plummer init",
        "plummer init a.msh --length-unit feet",
        "plummer init a.msh --list-bearings",
        "plummer init --list-bearings --list-materials",
    ] {
        assert_eq!(parse(words).unwrap_err().exit_code(), 2, "{words}");
    }
    for words in ["plummer --help", "plummer run --help", "plummer --version"] {
        assert_eq!(parse(words).unwrap_err().exit_code(), 0, "{words}");
    }
}

#[test]
fn values_that_begin_with_a_minus_are_values() {
    for (words, said) in [
        ("plummer analyze a.csv --speed -30Hz", "-30Hz"),
        ("plummer analyze a.csv --rate -5", "expected a number above 0"),
        ("plummer inspect a.msh --density -1", "expected a number of kg/m^3 above 0"),
    ] {
        match parse(words) {
            Ok(Arguments { command: Command::Analyze(asked), .. }) => {
                assert_eq!(asked.speed.unwrap().text, said);
            }
            Ok(_) => panic!("{words}"),
            Err(error) => {
                let text = error.to_string();
                assert!(text.contains(said) && !text.contains("use '--"), "{text}");
            }
        }
    }
}

#[test]
fn every_help_has_an_example() {
    for words in [
        "plummer --help",
        "plummer run --help",
        "plummer modes --help",
        "plummer condense --help",
        "plummer frf --help",
        "plummer chart --help",
        "plummer inspect --help",
        "plummer init --help",
        "plummer analyze --help",
        "plummer export --help",
        "plummer verify --help",
        "plummer schema --help",
    ] {
        let help = parse(words).unwrap_err().to_string();
        assert!(help.contains("Example"), "{words}");
        assert!(help.contains("  plummer "), "{words}");
    }
}

#[test]
fn formats_are_called_what_is_typed() {
    for format in ExportFormat::value_variants() {
        let words = format!("plummer export a.toml --to {}", word(*format));
        let command = parse(&words).unwrap().command;
        assert!(matches!(command, Command::Export { to, .. } if to == *format));
    }
}

#[test]
fn parts_of_a_chart_are_called_what_is_typed_and_have_their_files() {
    let files = |words: &str| parse(words).unwrap().command.result_files();
    assert_eq!(files("plummer chart a"), ["chart.json", "stability.json"]);
    for (part, file) in [(ChartPart::Accuracy, "chart.json"), (ChartPart::Stability, "stability.json")] {
        let words = format!("plummer chart a --only {}", word(part));
        assert_eq!(files(&words), [file]);
    }
    assert_eq!(files("plummer run a"), ["run.json"]);
    assert_eq!(files("plummer analyze a"), ["analysis.json"]);
}

#[test]
fn quiet_and_json_hide_progress() {
    let shown = |words| parse(words).unwrap().options.shows_progress();
    assert!(shown("plummer run a"));
    assert!(!shown("plummer run a --quiet"));
    assert!(!shown("plummer run a --json"));
}
