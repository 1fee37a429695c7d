use super::*;
use crate::app::case::Case;
use crate::app::commands::run::compute_run;
use crate::app::scene::CoupledStructure;
use std::process::Command;
use std::sync::Mutex;

/// A folder, the stages, and what was said of the folder.
struct Noted {
    folder: Option<PathBuf>,
    stages: Mutex<Vec<String>>,
    said: Mutex<Vec<String>>,
}

impl Watch for Noted {
    fn stage(&self, name: &str) {
        self.stages.lock().unwrap().push(name.to_owned());
    }
    fn fraction(&self, _done: f64) {}
    fn cache(&self) -> Option<&Path> {
        self.folder.as_deref()
    }
    fn reuse(&self, sentence: String) {
        self.said.lock().unwrap().push(sentence);
    }
}

impl Noted {
    fn of(folder: Option<&Path>) -> Self {
        Self { folder: folder.map(Path::to_owned), stages: Mutex::default(), said: Mutex::default() }
    }
}

/// The structure of the plane ring with these keys, whether its housing was condensed, and what was said.
fn built(folder: Option<&Path>, set: &[&str]) -> (CoupledStructure, bool, Vec<String>) {
    let set = [&["condense.fixed_interface_modes=8"], set].concat();
    let case = Case::example("housings/ring", &set);
    let noted = Noted::of(folder);
    let stage = CoupledStructure::build(&case, &noted).unwrap().unwrap();
    let condensed = noted.stages.into_inner().unwrap().iter().any(|name| name == "constraint modes");
    (stage, condensed, noted.said.into_inner().unwrap())
}

fn bits(matrix: &DenseMatrix) -> Vec<u64> {
    (0..matrix.ncols()).flat_map(|column| matrix.col_as_slice(column)).map(|value| value.to_bits()).collect()
}

fn same(a: &CoupledStructure, b: &CoupledStructure) {
    assert_eq!(bits(a.structure.stiffness()), bits(b.structure.stiffness()));
    assert_eq!(bits(a.structure.mass()), bits(b.structure.mass()));
    assert_eq!(bits(&a.modes.shapes), bits(&b.modes.shapes));
    let numbers = |stage: &CoupledStructure| {
        let rows = stage.structure.sensors().iter().flat_map(|sensor| sensor.row.clone());
        let all = rows.chain(stage.structure.gravity().iter().copied()).chain([stage.complete_hz]);
        all.map(f64::to_bits).collect::<Vec<_>>()
    };
    assert_eq!(numbers(a), numbers(b));
    assert_eq!(a.fixed_interface_modes, b.fixed_interface_modes);
}

fn kept(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.filter(|path| path.extension() == Some(OsStr::new(EXTENSION))).collect()
}

/// The same bits from a file, for every case whose housing, ring and sensors are the same; another housing, ring, basis or sensor is
/// condensed by itself.
#[test]
fn a_kept_housing_is_that_of_the_same_structure_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let folder = &folder.path().join("cache");
    let (without, condensed, said) = built(None, &[]);
    assert!(condensed && said.is_empty());
    let (first, condensed, said) = built(Some(folder), &[]);
    assert!(condensed && said.is_empty(), "{said:?}");
    assert_eq!(kept(folder).len(), 1);
    for of_no_matter in ["bearing.radial_play=3e-6", "shaft.mass=0.2", "damping.modal=0.01", "condense.enhanced=true"] {
        let (second, condensed, said) = built(Some(folder), &[of_no_matter]);
        assert!(!condensed, "{of_no_matter}");
        let start = format!("condensed housing: from {}, condensed 20", kept(folder)[0].display());
        assert!(said[0].starts_with(&start) && said[0].ends_with(" s saved"), "{said:?}");
        if of_no_matter.starts_with("condense") {
            same(&second, &without);
            same(&second, &first);
        }
    }
    for (number, other) in [
        "materials.aluminium.density=2701",
        "ring.shear=false",
        "ring.sections.0.area=5.38e-6",
        "condense.fixed_interface_modes=9",
        "accuracy.band_hz=[0,41000]",
        "sensors.0.direction=[1,1,0]",
        "housing.supports.0.spring.x=6e6",
    ]
    .into_iter()
    .enumerate()
    {
        let (_, condensed, said) = built(Some(folder), &[other]);
        assert!(condensed && said.is_empty(), "{other}: {said:?}");
        assert_eq!(kept(folder).len(), number + 2, "{other}");
    }
}

/// Signals are the same bit by bit, of another dent too, which the kept housing does not depend on.
#[test]
fn signals_with_a_kept_housing_are_those_without() {
    let folder = tempfile::tempdir().unwrap();
    for (length, times) in [("0.75e-3", 0), ("0.5e-3", 1)] {
        let dent = format!("bearing.defects.0.length={length}");
        let keys = ["condense.fixed_interface_modes=8", "transient.end=5e-4", "analysis.envelope=[]", &dent];
        let case = Case::example("housings/ring", &keys);
        let noted = Noted::of(Some(folder.path()));
        let with = compute_run(&case, &noted).unwrap().simulation.record;
        assert_eq!(noted.said.into_inner().unwrap().len(), times);
        let without = compute_run(&case, &Noted::of(None)).unwrap().simulation.record;
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&with.sensors[0].1), bits(&without.sensors[0].1));
        assert_eq!(bits(&with.outer_force), bits(&without.outer_force));
    }
}

/// A damaged file is told, not used, and replaced.
#[test]
fn a_damaged_file_is_not_used() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (first, ..) = built(Some(folder), &[]);
    let file = &kept(folder)[0];
    let whole = fs::read(file).unwrap();
    let mut turned = whole.clone();
    let middle = turned.len() / 2;
    turned[middle] ^= 1;
    for bytes in [&turned, &whole[..whole.len() - 8], &whole[..10], &[]] {
        fs::write(file, bytes).unwrap();
        let (again, condensed, said) = built(Some(folder), &[]);
        assert!(condensed);
        assert_eq!(said, [format!("condensed housing: {} is damaged, condensed again", file.display())]);
        same(&again, &first);
        assert!(!built(Some(folder), &[]).1, "it was not replaced");
    }
}

/// A folder that cannot be made, or leads elsewhere, is told and stops nothing.
#[test]
fn a_folder_that_keeps_nothing_stops_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let link = folder.path().join("link");
    std::os::unix::fs::symlink(folder.path(), &link).unwrap();
    for place in [&file, &link] {
        let (_, condensed, said) = built(Some(place), &[]);
        assert!(condensed);
        assert!(said[0].starts_with(&format!("condensed housing: not kept in {}: ", place.display())), "{said:?}");
    }
}

/// A process that holds the lock and was stopped is named, and the housing is condensed without the folder.
#[test]
fn a_stopped_process_is_not_waited_for_for_ever() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let (first, ..) = built(Some(folder), &[]);
    let lock = kept(folder)[0].with_extension("lock");
    let script = "echo $$ > $0; exec flock --no-fork $0 sleep 600";
    let mut holder = Command::new("sh").args(["-c", script]).arg(&lock).spawn().unwrap();
    let number = holder.id().to_string();
    while !fs::read_to_string(format!("/proc/{number}/comm")).unwrap().starts_with("sleep") {
        thread::sleep(Duration::from_millis(5));
    }
    assert!(Command::new("kill").args(["-STOP", &number]).status().unwrap().success());
    let (again, condensed, said) = built(Some(folder), &[]);
    holder.kill().unwrap();
    holder.wait().unwrap();
    assert!(condensed);
    same(&again, &first);
    let held = format!("process {number} holds {} for more than 1 s, end it if it is stopped", lock.display());
    assert_eq!(said, [format!("condensed housing: not kept in {}: {held}", folder.display())]);
    assert!(!built(Some(folder), &[]).1, "it is used again");
}

#[test]
fn files_used_longest_ago_go_first() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name);
    for (age, name) in
        ["new.condensed", "middle.condensed", "old.condensed", "written.condensed", "other.txt"].into_iter().enumerate()
    {
        fs::write(file(name), [0; 100]).unwrap();
        let at = SystemTime::now() - Duration::from_secs(100 * age as u64);
        File::options().append(true).open(file(name)).unwrap().set_modified(at).unwrap();
    }
    trim(&file("written.condensed"), 250).unwrap();
    let there = ["new", "middle", "old", "written"].map(|name| file(&format!("{name}.condensed")).exists());
    assert_eq!(there, [true, false, false, true]);
    assert!(file("other.txt").exists());
}

/// Leap days of 2000 and 2024, and the ends of years. Source: `date -u -d @SECONDS`.
#[test]
fn dates_are_those_of_the_calendar() {
    for (seconds, expected) in [
        (0, "1970-01-01 00:00"),
        (951_782_399, "2000-02-28 23:59"),
        (951_782_400, "2000-02-29 00:00"),
        (1_709_164_800, "2024-02-29 00:00"),
        (1_735_689_599, "2024-12-31 23:59"),
        (1_795_725_060, "2026-11-26 20:31"),
    ] {
        assert_eq!(date(seconds), expected);
    }
}
