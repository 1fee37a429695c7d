//! Reference: what the case file, the commands and `docs/robustness.md` promise.
//! Goal: no input that looks ordinary ends in a wrong answer with exit code 0 and without a word.
//! Sketch: the list beside, a command a line with the exit code and the words that it must have.
//! Conditions: a shell; each command in an empty folder.
//! Parameters: none; there is no tolerance.
//!
//! The same list as a table, of this program or of another one:
//!
//! ```text
//! PLUMMER_PROGRAM=/path/to/plummer cargo test --release --test robustness -- --ignored --nocapture attacks_as_a_table
//! ```

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::Dice;
use super::program::scratch;

const LIST: &str = include_str!("attacks.txt");

/// What the list's commands use.
const SHELL: &str = r#"
short() { cp "$H" h.toml; "$P" run h.toml --set transient.end=1e-3 --out o "$@"; }
ring() { cp "$E"/../meshes/ring_6_9.msh .; printf '[housing]\nmesh="ring_6_9.msh"\nlength_unit="mm"\nplane={assumption="stress",thickness=4e-3}\nparts=[{group="housing",material="aluminium"}]\n[modes]\ncount=5\n[materials.aluminium]\nyoung=70e9\npoisson=0.33\ndensity=2700\n' > ring.toml; "$P" modes ring.toml "$@"; }
seat() { "$P" modes "$E/housings/pillow_block.toml" --set modes.count=6 --out o --set "$1"; }
flat() { "$P" modes "$E/housings/ring.toml" --set modes.count=6 --out o --set "$1"; }
analyze() { name=$1; shift; "$P" analyze "$S/$name" --rate 12000 --speed 25Hz --out o "$@"; }
super() {
  "$P" condense "$E/housings/ring.toml" --quiet --out c "$@" || true
  sed -e '/^mesh\|^length_unit\|^plane\|^parts\|^supports\|^tie/d' -e 's|^\[housing\]|[housing]\nsuperelement = "c/superelement.npz"|' \
    -e 's|^group = "top"|ring_deg = 90|' "$E/housings/ring.toml" > s.toml
}
path() { "$P" frf "$1" --out r --set "frf={from=[{name='f',ring_deg=270,direction=$2}]}" "${@:3}"; }
fed() { "$P" run s.toml --set transient.end=2e-3 --set analysis.envelope=[] --out r "$@"; }
"#;

/// Exit code, command and words of the lines under one heading.
fn lines(heading: &str) -> Vec<(i32, &'static str, &'static str)> {
    let sections = LIST.split("\n## ").skip(1);
    let section = { sections }.find(|section| section.starts_with(heading));
    let lines = section.expect("a heading").lines().skip(1);
    let lines = lines.filter(|line| !line.is_empty());
    let fields = lines.map(|line| {
        let fields: Vec<_> = line.splitn(3, " | ").map(str::trim).collect();
        let [code, command, words] = fields[..] else {
            panic!("three fields: {line}");
        };
        (code.parse().unwrap(), command, words)
    });
    fields.collect()
}

/// Signals of 24 000 samples that are none, or hardly.
fn signals(folder: &Path) -> PathBuf {
    let mut dice = Dice(1);
    let noise: Vec<f64> = (0..24_000).map(|_| dice.fraction() - 0.5).collect();
    let write = |name: &str, values: &[f64]| {
        let mut text = "P1\n".to_owned();
        for value in values {
            writeln!(text, "{value:e}").unwrap();
        }
        fs::write(folder.join(name), text).unwrap();
    };
    let with = |place: usize, value: f64| {
        let mut signal = noise.clone();
        signal[place] = value;
        signal
    };
    let times = |factor: f64| noise.iter().map(|x| factor * x).collect::<Vec<_>>();
    write("noise.csv", &noise);
    write("zero.csv", &[0.0; 24_000]);
    write("constant.csv", &[1.0; 24_000]);
    write("huge.csv", &times(1e200));
    write("tiny.csv", &times(1e-200));
    write("nan.csv", &with(777, f64::NAN));
    write("inf.csv", &with(777, f64::INFINITY));
    write("spike.csv", &with(777, 1e9));
    let offset: Vec<f64> = noise.iter().map(|x| x + 1e4).collect();
    write("offset.csv", &offset);
    write("short.csv", &noise[..3]);
    write("empty.csv", &[]);
    folder.to_owned()
}

/// Exit code and what it wrote.
fn ran(program: &str, folder: &Path, signals: &Path, command: &str) -> (Option<i32>, String) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new("timeout")
        .args(["60", "bash", "-c", &format!("{SHELL}\n{command}")])
        .current_dir(folder)
        .env("P", program)
        .env("E", root.join("examples"))
        .env("M", root.join("meshes"))
        .env("H", root.join("examples/scenes/healthy.toml"))
        .env("S", signals)
        .env("RUST_BACKTRACE", "0")
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code(), String::from_utf8_lossy(&text).into_owned())
}

fn hold(heading: &str) {
    let name = heading.replace(' ', "-");
    let signals = signals(&scratch(&format!("{name}-signals")));
    let mut wrong = String::new();
    for (expected, command, words) in lines(heading) {
        let folder = scratch(&name);
        let program = env!("CARGO_BIN_EXE_plummer");
        let (code, text) = ran(program, &folder, &signals, command);
        if code != Some(expected) || !text.contains(words) {
            writeln!(wrong, "{command}: {code:?}, expected {expected} and \"{words}\":\n{text}").unwrap();
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn two_processes_in_one_folder() {
    hold("Two processes in one folder");
}

#[test]
fn impossible_bearings_and_rings() {
    hold("Impossible bearings and rings");
}

#[test]
fn rings_that_do_not_fit_their_bore() {
    hold("Rings that do not fit their bore");
}

#[test]
fn words_that_contradict_each_other() {
    hold("Words that contradict each other");
}

#[test]
fn directions_across_a_plane() {
    hold("Directions across a plane");
}

#[test]
fn runs_from_a_superelement() {
    hold("Runs from a superelement");
}

#[test]
fn limits_and_requests_beyond_measure() {
    hold("Limits of the system");
}

#[test]
fn degenerate_signals_and_numbers() {
    hold("Degenerate signals and numbers");
}

#[test]
fn links_in_the_folder_for_results() {
    hold("Links in the folder for results");
}

#[test]
#[ignore = "a table to read, of any program"]
fn attacks_as_a_table() {
    let program = std::env::var("PLUMMER_PROGRAM");
    let program = program.unwrap_or_else(|_| env!("CARGO_BIN_EXE_plummer").to_owned());
    let signals = signals(&scratch("attacks-table-signals"));
    println!("| command | wanted | exit code | as wanted | first line of the message |\n|---|---|---|---|---|");
    let headings = LIST.split("\n## ").skip(1);
    for heading in headings.filter_map(|section| section.lines().next()) {
        let (mut held, mut all) = (0, 0);
        for (expected, command, words) in lines(heading) {
            let (code, text) = ran(&program, &scratch("attacks-table"), &signals, command);
            let as_wanted = code == Some(expected) && text.contains(words);
            let message = text.lines().find(|line| line.starts_with("error") || line.starts_with("warning"));
            let code = code.map_or("signal".to_owned(), |code| code.to_string());
            let command = command.replace('|', "\\|");
            println!(
                "| `{command}` | {expected} | {code} | {} | {} |",
                if as_wanted { "yes" } else { "**no**" },
                message.unwrap_or_default().replace('|', "\\|")
            );
            held += usize::from(as_wanted);
            all += 1;
        }
        println!("| **{heading}** | | | {held} of {all} | |");
    }
}
