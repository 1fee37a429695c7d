//! Reference: the file system before; the page's own scripts.
//! Goal: nothing in a case or a mesh makes the program write outside `--out`, reach a network or put markup into a report; any file name
//!   will do.
//! Sketch: a mesh and a case in which every name is markup, or a path that leads elsewhere, through every command; then all files of the
//!   folder around the results are compared, and every page is searched.
//! Conditions: names as gmsh and TOML take them: no double quotes in a mesh's.
//! Parameters: none.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::program::{errors, plummer, scratch};

/// What a page must not have as its own: it ends a script, begins one, and runs one without it.
const MARKUP: &str = "</script><script>alert(1)</script><img src=x onerror=alert(2)>]]>";
/// What must not become a path.
const ELSEWHERE: &str = "../../../elsewhere";

/// A bearing in an annulus with these names, short to compute.
fn case(folder: &Path, [bore, name, sensor]: [&str; 3], mesh: &str) -> String {
    let project = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(project.join("meshes/ring_6_9_24.msh")).unwrap();
    let text = text.replace("\"bore\"", &format!("\"{bore}\""));
    fs::write(folder.join(mesh), text).unwrap();
    let smooth = fs::read_to_string(project.join("examples/scenes/smooth.toml")).unwrap();
    let bearing = smooth[smooth.find("[bearing]").unwrap()..smooth.find("[[sensors]]").unwrap()]
        .replace("[bearing]", "[bearing]\nball_material = 'MATERIAL'");
    format!(
        "title = 'NAME'\n\
         [materials.'MATERIAL']\nyoung = 210e9\npoisson = 0.3\ndensity = 7850\n\
         [housing]\nmesh = '{mesh}'\nlength_unit = 'mm'\nplane = {{ assumption = 'stress', thickness = 4e-3 }}\n\
         parts = [{{ group = 'housing', material = 'MATERIAL' }}]\n\
         supports = [{{ group = 'outer', spring = {{ x = 1e5, y = 1e5 }} }}]\n\
         [ring]\nnodes = 24\nsections = [{{ material = 'MATERIAL', area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }}]\n\
         outer_radius = 6e-3\ntie = {{ group = '{bore}', fit = 'bonded', centre = [0, 0, 0] }}\n\
         {bearing}\
         [[sensors]]\nname = 'SENSOR'\nring_deg = 90\ndirection = [0, 1, 0]\n\
         [modes]\ncount = 6\nexpected = [{{ hz = 4559, within = 0.01, what = 'NAME' }}]\n\
         [frf]\nfrom = [{{ ring_deg = 270, direction = [0, -1, 0] }}]\nto = ['SENSOR']\nband_hz = [0, 50000]\n\
         [accuracy]\nband_hz = [0, 50000]\ntarget = 0.05\n\
         [transient]\nend = 20e-3\noutput_hz = 200000\n\
         [analysis]\nenvelope = [{{ from = 10e-3, to = 20e-3 }}]\nscalogram = {{ from = 10e-3, to = 20e-3, band_hz = [5000, 40000] }}\n"
    )
    .replace("NAME", name)
    .replace("SENSOR", sensor)
    .replace("MATERIAL", &format!("{name} steel"))
}

/// CASE and MESH are the names of these files, SENSOR that of the sensor.
const COMMANDS: &[&str] = &[
    "modes CASE --out results",
    "condense CASE --compare-full --out results",
    "frf CASE --out results",
    "run CASE --out results",
    "analyze results/signals.npz --channel SENSOR --balls 7 --pitch-diameter 7.51e-3 --ball-diameter 2e-3 --speed 3200 --window 0.01:0.02 \
     --out results/analyzed",
    "export CASE --to vtu --out results",
    "export CASE --to uff --out results",
    "export CASE --to npz --out results",
    "export CASE --to op4 --out results",
    "export CASE --to mtx --out results",
    "sweep CASE --command modes --vary ring.nodes=24,5 --out results",
    "inspect MESH --length-unit mm --out results",
    "init MESH --length-unit mm --out results/first.toml",
];

/// Every file below a folder with its content.
fn content(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(content(&path));
        } else {
            found.insert(path.clone(), fs::read(&path).unwrap());
        }
    }
    found
}

/// Computes every command on a case into `inner/results`; what is there then. Nothing beside it may change.
fn compute(name: &str, names: [&str; 3], files: [&str; 2]) -> BTreeMap<PathBuf, Vec<u8>> {
    let outer = scratch(name);
    let folder = outer.join("inner");
    let results = folder.join("results");
    fs::create_dir_all(&results).unwrap();
    fs::write(folder.join(files[0]), case(&folder, names, files[1])).unwrap();
    let before = content(&outer);
    for command in COMMANDS {
        let words = command.split_whitespace().map(|word| match word {
            "CASE" => files[0],
            "MESH" => files[1],
            "SENSOR" => names[2],
            word => word,
        });
        let words: Vec<&str> = words.chain(["--quiet", "--force"]).collect();
        let output = plummer(&folder, &words);
        let said = errors(&output);
        assert_eq!(output.status.code(), Some(0), "{command}: {said}");
    }
    let (inside, beside): (BTreeMap<_, _>, BTreeMap<_, _>) =
        content(&outer).into_iter().partition(|(path, _)| path.starts_with(&results));
    assert!(before == beside, "something beside the results has changed: {:?}", beside.keys());
    inside
}

#[test]
fn names_are_text_and_nothing_is_written_elsewhere() {
    let name = format!("{ELSEWHERE}{MARKUP}");
    let results = compute("untrusted", [MARKUP, &name, "P1"], ["case.toml", "ring.msh"]);
    let mut pages = 0;
    for (path, bytes) in &results {
        let ending = path.extension().unwrap_or_default();
        if ending != "html" && ending != "svg" {
            continue;
        }
        let text = String::from_utf8_lossy(bytes);
        for part in ["<script>alert", "<img src=x"] {
            assert!(!text.contains(part), "{} has {part}", path.display());
        }
        pages += usize::from(text.contains("onerror=alert(2)"));
    }
    // the names are shown, and not as what they pretend to be: modes, condense, frf, run, sweep, the first of its points
    assert_eq!(pages, 6);
}

#[test]
fn folders_and_files_may_be_named_as_one_likes() {
    let results = compute("Gehäuse & 軸受 $HOME", ["bore", "Прогон", "Датчик 1"], ["mein Fall.toml", "rohr (2) ß.msh"]);
    let page = results.iter().find(|(path, _)| path.ends_with("results/run-report.html"));
    let page = String::from_utf8(page.unwrap().1.clone()).unwrap();
    assert!(page.contains("rohr (2) ß.msh") && page.contains("plummer run &#x27;mein Fall.toml&#x27;"));
}

/// What a program does not import it cannot call: there is no way from it to a network.
#[test]
fn the_program_has_no_way_to_a_network() {
    let output =
        Command::new("nm").args(["--dynamic", "--undefined-only", env!("CARGO_BIN_EXE_plummer")]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let names = text.lines().filter_map(|line| line.split_whitespace().last());
    let names: Vec<&str> = names.filter_map(|name| name.split('@').next()).collect();
    let imported = |name: &&str| names.contains(name);
    // names of what it does call are found
    assert!(["write", "rename"].iter().all(imported), "{names:?}");
    let network = ["socket", "connect", "bind", "listen", "sendto", "getaddrinfo", "gethostbyname"];
    assert_eq!(network.iter().find(|name| imported(name)), None);
}
