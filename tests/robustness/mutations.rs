//! Reference: the exit codes, 0 done, 1 a bad answer, 2 a wrong input; a memory limit of the system's.
//! Goal: no text of a case file or a mesh makes the program panic, or take more memory than stated; what it says to be done is whole.
//! Sketch: cases that run in a fraction of a second, changed at random in bytes, numbers, words, lines and tables; each is given to a
//!   command. The campaign takes the examples too, changes meshes, and asks the questions of `relations` with random numbers between.
//! Conditions: address space of 2 GiB beside that of matrix products, above which the system refuses memory (an abort: no exit code); 20 s, after which a case that
//!   asks for a long computation is ended and counted apart.
//! Parameters: 120 mutations with the other tests, 10 000 in the long form; the campaign lasts `PLUMMER_MINUTES` (10) from the seed
//!   `PLUMMER_SEED` (1).

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use plummer::files;

use super::program::scratch;
use super::{Dice, ended_within, relations, rounds, setting};

/// Address space of the program, KiB: what `ulimit -v` takes. 2 GiB, and what products of matrices reserve beforehand in each of the two
/// threads: twice the last cache, which is 480 MiB on some servers.
fn memory_kib() -> usize {
    let cache = fs::read_to_string("/sys/devices/system/cpu/cpu0/cache/index3/size");
    let cache = cache.map_or(0, |text| text.trim_end_matches("K\n").parse().unwrap_or(0));
    (2 << 20) + 4 * cache
}
const TIME: Duration = Duration::from_secs(20);

/// A case and what can be done with it in a fraction of a second.
struct Base {
    text: String,
    commands: &'static [&'static str],
}

fn meshes() -> String {
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes");
    meshes.display().to_string()
}

/// An example with whole paths.
fn read(name: &str) -> String {
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let text = fs::read_to_string(examples.join(name)).unwrap();
    let modal = examples.join("modal").display().to_string();
    text.replace("../../meshes", &meshes()).replace("\nfile = \"", &format!("\nfile = \"{modal}/"))
}

/// The examples of the documents, runs of them a millisecond long.
fn examples() -> impl Iterator<Item = Base> {
    let all: [(&str, &[&str]); 9] = [
        ("scenes/impact.toml", &["run"]),
        ("scenes/rattle.toml", &["run"]),
        ("scenes/pedestal.toml", &["run", "modes"]),
        ("housings/ring.toml", &["run"]),
        ("tadina2011/ball-flat.toml", &["run"]),
        ("tadina2011/inner-dent.toml", &["run"]),
        ("modal/ring.toml", &["modes"]),
        ("modal/pedestal.toml", &["modes"]),
        ("transfer/pedestal.toml", &["condense", "frf"]),
    ];
    all.into_iter().map(|(name, commands)| {
        let text = read(name);
        let kept = text.lines().take_while(|line| *line != "[analysis]");
        let lines = kept.map(|line| match line.starts_with("end = ") {
            true => "end = 1e-3",
            false => line,
        });
        let text = lines.collect::<Vec<_>>().join("\n");
        Base { text, commands }
    })
}

fn bases() -> Vec<Base> {
    let beam = read("tadina2011/beam.toml");
    let beam = beam[..beam.find("expected = [").unwrap()].replace("nodes = 72", "nodes = 24");
    let smooth = read("scenes/smooth.toml").replace("end = 10e-3", "end = 0.5e-3").replace("nodes = 72", "nodes = 24");
    let meshed = "title = \"Ring\"\n\
        [housing]\nmesh = \"MESHES/ring_6_9_24.msh\"\nlength_unit = \"mm\"\n\
        plane = { assumption = \"stress\", thickness = 4e-3 }\n\
        parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
        supports = [{ group = \"outer\", spring = { x = 1e5, y = 1e5 } }]\n\
        [ring]\nnodes = 24\nsections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n\
        outer_radius = 6e-3\n\
        tie = { group = \"bore\", fit = \"bonded\", centre = [0, 0, 0] }\n\
        [damping]\nratios = [{ frequency_hz = 8200, ratio = 0.02 }, { frequency_hz = 36000, ratio = 0.02 }]\n\
        [[sensors]]\nname = \"P1\"\nring_deg = 90\ndirection = [0, 1, 0]\n\
        [frf]\nfrom = [{ ring_deg = 270, direction = [0, -1, 0] }]\nto = [\"P1\"]\nband_hz = [0, 50000]\n\
        [accuracy]\nband_hz = [0, 50000]\ntarget = 0.01\n\
        [modes]\ncount = 6\n"
        .replace("MESHES", &meshes());
    vec![
        Base { text: beam, commands: &["modes"] },
        Base { text: smooth, commands: &["run", "modes"] },
        Base { text: meshed, commands: &["modes", "condense", "frf"] },
    ]
}

const NUMBERS: &[&str] = &[
    "0",
    "-0.0",
    "-1",
    "1",
    "1e308",
    "-1e308",
    "1e-320",
    "nan",
    "inf",
    "-inf",
    "1e18",
    "9223372036854775807",
    "-9223372036854775808",
    "0.5",
    "3",
    "1e-9",
    "1000000",
    "4294967296",
    "1e400",
    "0x7fffffff",
    "1_000",
];
const WORDS: &[&str] = &[
    "true",
    "false",
    "\"\"",
    "[]",
    "{}",
    "[[]]",
    "\"steel\"",
    "\"bore\"",
    "\"auto\"",
    "\"none\"",
    "[1, 2, 3]",
    "[nan, 0, 0]",
    "\"<script>\"",
    "'''\n'''",
    "1979-05-27",
    "{ x = 1 }",
    "[{}]",
    "\"\\u0000\"",
    "\"é\"",
    "[1e300, 1e300, 1e300]",
];
const LINES: &[&str] = &[
    "[housing]",
    "[ring]",
    "[bearing]",
    "[[bearing.defects]]",
    "[[sensors]]",
    "[modes]",
    "[transient]",
    "[frf]",
    "[shaft]",
    "x = 1",
    "balls = 0",
    "nodes = 3",
    "count = 100000",
    "up_to_hz = 1e12",
    "mesh = \"/dev/zero\"",
    "mesh = \"/etc/passwd\"",
    "mesh = \"..\"",
    "on = \"ball\"",
    "linearise = \"static\"",
    "end = 1e9",
    "step = 1e-30",
    "output_hz = 1e15",
    "radial_play = 1",
    "order = 9",
    "tolerance = 0",
    "method = \"newmark\"",
    "runs = 1000000",
    "slip = 2",
];

/// The text with one to four changes.
fn mutated(text: &str, dice: &mut Dice) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for _ in 0..=dice.below(4) {
        change(&mut bytes, dice);
    }
    bytes
}

fn change(bytes: &mut Vec<u8>, dice: &mut Dice) {
    if bytes.is_empty() {
        bytes.push(b'=');
    }
    let lines: Vec<(usize, usize)> = {
        let ends = bytes.iter().enumerate().filter(|(_, b)| **b == b'\n');
        let ends: Vec<usize> = ends.map(|(at, _)| at + 1).chain([bytes.len()]).collect();
        let starts = std::iter::once(0).chain(ends.iter().copied());
        starts.zip(ends.iter().copied()).collect()
    };
    match dice.below(10) {
        0 => {
            let at = dice.below(bytes.len());
            bytes[at] ^= 1 << dice.below(8);
        }
        1 => {
            let at = dice.below(bytes.len());
            let end = (at + 1 + dice.below(12)).min(bytes.len());
            bytes.drain(at..end);
        }
        2 => {
            let at = dice.below(bytes.len());
            bytes.insert(at, *dice.of(b"[]{}=\"'#,.\n\0\xff9e-"));
        }
        3 => {
            let (start, end) = *dice.of(&lines);
            bytes.drain(start..end);
        }
        4 => {
            let (start, end) = *dice.of(&lines);
            let line = bytes[start..end].to_vec();
            let at = dice.of(&lines).0;
            bytes.splice(at..at, line);
        }
        5 => {
            let at = dice.of(&lines).0;
            let line = format!("{}\n", dice.of(LINES));
            bytes.splice(at..at, line.into_bytes());
        }
        kind => {
            // the value behind an `=`, up to what ends it
            let signs: Vec<usize> = (0..bytes.len()).filter(|&at| bytes[at] == b'=').collect();
            if signs.is_empty() {
                return;
            }
            let start = *dice.of(&signs) + 1;
            let length = bytes[start..].iter().position(|b| b",}]\n#".contains(b));
            let end = length.map_or(bytes.len(), |length| start + length);
            let value = if kind < 9 { dice.of(NUMBERS) } else { dice.of(WORDS) };
            bytes.splice(start..end, format!(" {value}").into_bytes());
        }
    }
}

/// Every base as it is ends with 0.
fn try_bases(folder: &Path, bases: &[Base]) {
    for base in bases {
        for command in base.commands {
            let found = run(folder, base.text.as_bytes(), command);
            assert_eq!(found.0, Some(0), "{command}: {}\n{}", found.1, base.text);
            check_digests(folder, command);
        }
    }
}

/// One change of one of the bases, of its mesh at times: 0, 1, 2 or, still running, 3.
fn attempt(folder: &Path, bases: &[Base], round: u64, meshes_too: bool) -> usize {
    let mut dice = Dice(round);
    let base = dice.of(bases);
    let command = *dice.of(base.commands);
    let own = base.text.find(&meshes()).filter(|_| meshes_too && dice.below(3) == 0);
    let text = match own {
        None => mutated(&base.text, &mut dice),
        Some(start) => {
            let length = base.text[start..].find('"').unwrap();
            let path = &base.text[start..start + length];
            let mesh = mutated(&fs::read_to_string(path).unwrap(), &mut dice);
            fs::write(folder.join("mesh.msh"), mesh).unwrap();
            base.text.replace(path, "mesh.msh").into_bytes()
        }
    };
    let (code, said) = run(folder, &text, command);
    match code {
        Some(code @ 0..=2) if !said.contains("panicked") => {
            let silent = code != 0 && !said.contains("error: ");
            assert!(!silent, "round {round}: {command} gave {code} without a reason");
            if code == 0 {
                check_digests(folder, command);
            }
            code as usize
        }
        Some(-1) => 3,
        code => {
            let kept = folder.join(format!("fault-{round}.toml"));
            fs::write(&kept, &text).unwrap();
            panic!("round {round}: {command} {} gave {code:?}: {said}", kept.display());
        }
    }
}

/// The arrays beside a result are those that it speaks of.
fn check_digests(folder: &Path, command: &str) {
    let out = folder.join("out");
    let result = fs::read(out.join(format!("{command}.json"))).unwrap();
    let result: serde_json::Value = serde_json::from_slice(&result).unwrap();
    let arrays = result["arrays"].as_object();
    assert_eq!(arrays.is_some(), ["run", "modes"].contains(&command));
    for (name, digest) in arrays.into_iter().flatten() {
        let file = fs::File::open(out.join(name)).unwrap();
        let found = files::hex(files::sha256(file).unwrap());
        assert_eq!(*digest, *found, "{command}: {name}");
    }
}

/// How many ended with 0, 1 and 2, and how many were still running.
fn many(name: &str, count: usize, seed: u64) -> [usize; 4] {
    let folder = scratch(name);
    let bases = bases();
    try_bases(&folder, &bases);
    let mut ends = [0; 4];
    for round in 0..count as u64 {
        ends[attempt(&folder, &bases, seed + round, false)] += 1;
    }
    ends
}

/// The exit code of a command on a case: `Some(-1)` if it was still running; and what it said.
fn run(folder: &Path, text: &[u8], command: &str) -> (Option<i32>, String) {
    fs::write(folder.join("case.toml"), text).unwrap();
    let errors = fs::File::create(folder.join("errors.txt")).unwrap();
    let mut child = Command::new("sh")
        .current_dir(folder)
        .args(["-c", &format!("ulimit -v {}; exec \"$0\" \"$@\"", memory_kib())])
        .arg(env!("CARGO_BIN_EXE_plummer"))
        .args([command, "case.toml", "--out", "out", "--force", "--quiet", "--threads", "1"])
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(errors)
        .spawn()
        .unwrap();
    let code = match ended_within(&mut child, TIME) {
        Some(status) => status.code(),
        None => Some(-1),
    };
    let said = fs::read(folder.join("errors.txt")).unwrap();
    (code, String::from_utf8_lossy(&said).into_owned())
}

#[test]
fn damaged_cases_end_with_an_exit_code_and_a_reason() {
    let ends = many("mutations", 120, 1);
    println!("exit codes 0, 1, 2, still running: {ends:?}");
    // some are harmless, most are refused
    assert!(ends[0] > 5 && ends[2] > 40, "{ends:?}");
}

#[test]
#[ignore = "long"]
fn ten_thousand_damaged_cases() {
    let count = rounds(10_000);
    let ends = many("mutations-long", count, 1_000_000);
    println!("{count} mutations, exit codes 0, 1, 2, still running: {ends:?}");
}

/// All attacks on the input as long as one likes: the round in a message makes the same change again as `PLUMMER_SEED`.
#[test]
#[ignore = "long"]
fn campaign() {
    let folder = scratch("campaign");
    let mut bases = bases();
    bases.extend(examples());
    try_bases(&folder, &bases);
    let end = Instant::now() + Duration::from_secs(60 * setting("PLUMMER_MINUTES", 10));
    let (mut ends, mut asked, mut round) = ([0; 4], 0, setting("PLUMMER_SEED", 1));
    while Instant::now() < end {
        ends[attempt(&folder, &bases, round, true)] += 1;
        round += 1;
        if round % 20 == 0 {
            relations::ask_at_random(&mut Dice(round));
            asked += 1;
        }
    }
    println!("up to round {round}: exit codes 0, 1, 2, still running: {ends:?}; {asked} relations");
}
