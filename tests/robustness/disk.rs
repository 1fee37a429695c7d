//! Reference: the exit codes; the files that were there before.
//! Goal: a full disk, a folder that cannot be written, a file that may not be read: an error that names the path, exit code 1 or 2, and
//!   nothing half-written under a valid name.
//! Sketch: a file system of 256 KiB in memory; folders without the right to write, as another user than root.
//! Conditions: the tests of the disk and of rights need root, to mount and to become somebody else; without it they say so and end.
//! Parameters: none.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use super::program::{errors, scratch};

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name)
}

/// Whether this is root: the owner of a file that was just made.
fn root() -> bool {
    let made = scratch("who");
    std::os::unix::fs::MetadataExt::uid(&fs::metadata(made).unwrap()) == 0
}

/// A small file system while it lives.
struct SmallDisk(PathBuf);

impl SmallDisk {
    fn new(name: &str, size: &str) -> Option<Self> {
        let folder = scratch(name);
        let status = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &format!("size={size}"), "plummer"])
            .arg(&folder)
            .stderr(Stdio::null())
            .status();
        status.is_ok_and(|status| status.success()).then_some(Self(folder))
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(&self.0).status();
    }
}

fn plummer(words: &[&str], out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_plummer"));
    command.args(words).arg("--out").arg(out).arg("--quiet");
    command
}

/// Names in a folder that are not temporary.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned());
    let mut names: Vec<String> = names.filter(|name| !name.ends_with(".partial")).collect();
    names.sort();
    names
}

fn code(output: &Output) -> Option<i32> {
    output.status.code()
}

#[test]
fn a_full_disk_is_an_error_that_names_the_file() {
    let beam = example("tadina2011/beam.toml").display().to_string();
    let smooth = example("scenes/smooth.toml").display().to_string();
    let pedestal = example("scenes/pedestal.toml").display().to_string();
    for (name, words) in [
        ("modes", &["modes", &beam, "--set", "modes.variants=[]"][..]),
        ("run", &["run", &smooth]),
        ("export", &["export", &pedestal, "--to", "mtx"]),
    ] {
        let Some(disk) = SmallDisk::new(&format!("disk-{name}"), "64k") else {
            println!("not tried: a file system cannot be mounted here");
            return;
        };
        let output = plummer(words, &disk.0.join("out")).output().unwrap();
        let said = errors(&output);
        assert_eq!(code(&output), Some(1), "{name}: {said}");
        assert!(said.contains("No space left on device"), "{name}: {said}");
        assert!(said.contains(&disk.0.display().to_string()), "{name}: {said}");
        let checkpoint = disk.0.join("out/.run.partial/checkpoint").exists();
        assert_eq!(
            said.contains("\nhelp: make room, then go on from the last checkpoint with: "),
            checkpoint,
            "{said}"
        );
        let result = disk.0.join("out").join(format!("{name}.json"));
        assert!(!result.exists(), "{name}: a result without its files");
    }
}

#[test]
fn a_folder_that_cannot_be_written_is_an_error_before_anything_is_computed() {
    if !root() {
        println!("not tried: needs root to become somebody else");
        return;
    }
    let folder = std::env::temp_dir().join(format!("plummer-rights-{}", std::process::id()));
    fs::create_dir_all(folder.join("closed")).unwrap();
    fs::set_permissions(&folder, fs::Permissions::from_mode(0o755)).unwrap();
    fs::set_permissions(folder.join("closed"), fs::Permissions::from_mode(0o555)).unwrap();
    let case = folder.join("case.toml");
    let text = fs::read_to_string(example("tadina2011/beam.toml")).unwrap();
    let end = text.find("variants = [").unwrap();
    fs::write(&case, &text[..end]).unwrap();
    let program = folder.join("plummer");
    fs::copy(env!("CARGO_BIN_EXE_plummer"), &program).unwrap();
    let nobody = |words: &[&str]| {
        let mut command = Command::new(&program);
        // nobody and nogroup on Debian
        command.uid(65534).gid(65534).current_dir(&folder).args(words);
        command.output().unwrap()
    };
    let words = ["modes", "case.toml", "--quiet", "--out"];
    let output = nobody(&[&words[..], &["closed/out"]].concat());
    assert_eq!(code(&output), Some(2), "{}", errors(&output));
    assert!(errors(&output).contains("cannot make the folder closed/out"), "{}", errors(&output));
    let output = nobody(&[&words[..], &["closed"]].concat());
    assert!(matches!(code(&output), Some(1 | 2)), "{}", errors(&output));
    assert!(errors(&output).contains("closed"), "{}", errors(&output));
    assert!(names(&folder.join("closed")).is_empty());
    fs::set_permissions(&case, fs::Permissions::from_mode(0o000)).unwrap();
    let output = nobody(&[&words[..], &["/tmp"]].concat());
    assert_eq!(code(&output), Some(2));
    assert!(errors(&output).contains("cannot read the case file case.toml: Permission denied"), "{}", errors(&output));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_full_standard_output_is_an_error_and_a_closed_one_is_none() {
    let beam = example("tadina2011/beam.toml");
    for (name, target, expected) in [("full", "/dev/full", Some(1)), ("null", "/dev/null", Some(0))] {
        let out = scratch(&format!("stdout-{name}"));
        let status = Command::new(env!("CARGO_BIN_EXE_plummer"))
            .arg("modes")
            .arg(&beam)
            .args(["--set", "modes.variants=[]", "--out"])
            .arg(&out)
            .stdout(fs::OpenOptions::new().write(true).open(target).unwrap())
            .stderr(Stdio::null())
            .status()
            .unwrap();
        assert_eq!(status.code(), expected, "{target}");
        let help = Command::new(env!("CARGO_BIN_EXE_plummer"))
            .arg("--help")
            .stdout(fs::OpenOptions::new().write(true).open(target).unwrap())
            .stderr(Stdio::null())
            .status();
        assert_eq!(help.unwrap().code(), expected, "{target}");
    }
    let out = scratch("stdout-closed");
    let words = format!(
        "'{}' modes '{}' --set 'modes.variants=[]' --out '{}' | true; exit ${{PIPESTATUS[0]}}",
        env!("CARGO_BIN_EXE_plummer"),
        beam.display(),
        out.display()
    );
    let output = Command::new("bash").args(["-c", &words]).output().unwrap();
    assert_eq!(code(&output), Some(0), "{}", errors(&output));
    assert_eq!(errors(&output), "");
}

/// A decimal comma of the user's language changes neither what is read nor what is written.
#[test]
fn decimal_commas_of_a_locale_change_nothing() {
    let beam = example("tadina2011/beam.toml").display().to_string();
    let words = ["modes", &beam, "--set", "modes.variants=[]"];
    let frequencies = |name: &str, locale: &str| {
        let out = scratch(name);
        let status = plummer(&words, &out).env("LC_ALL", locale).env("LANG", locale).status().unwrap();
        assert!(status.success());
        let text = fs::read(out.join("modes.json")).unwrap();
        let json: serde_json::Value = serde_json::from_slice(&text).unwrap();
        json["frequencies_hz"].clone()
    };
    assert_eq!(frequencies("locale-c", "C"), frequencies("locale-de", "de_DE.UTF-8"));
}
