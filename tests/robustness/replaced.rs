//! Reference: the exit codes; the SHA-256 of the mesh that was read.
//! Goal: a mesh that is overwritten while it is read, or that is no file at all, gives a result of one of its contents or an error.
//! Sketch: a thread replaces a mesh, now whole, now half, now other elements, as fast as it can, while modes are computed of it.
//! Conditions: both by renaming, as careful programs write, and in place.
//! Parameters: 8 runs each.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use super::program::{errors, plummer, scratch};

fn mesh(name: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes").join(name)).unwrap()
}

/// A case of a free annulus with its mesh beside it.
fn case(name: &str) -> PathBuf {
    let folder = scratch(name);
    fs::write(
        folder.join("case.toml"),
        "[housing]\nmesh = \"ring.msh\"\nlength_unit = \"mm\"\nplane = { assumption = \"stress\", thickness = 4e-3 }\n\
         parts = [{ group = \"housing\", material = \"aluminium\" }]\n[modes]\ncount = 6\n",
    )
    .unwrap();
    fs::write(folder.join("ring.msh"), mesh("ring_6_9_24.msh")).unwrap();
    folder
}

fn modes(folder: &Path) -> Output {
    plummer(folder, &["modes", "case.toml", "--force", "--quiet"])
}

#[test]
fn a_mesh_that_changes_gives_one_of_its_results_or_an_error() {
    let contents = [mesh("ring_6_9_24.msh"), mesh("ring_6_9_48.msh")];
    let half = contents[0][..contents[0].len() / 2].to_vec();
    for in_place in [false, true] {
        let folder = case(if in_place { "in-place" } else { "renamed" });
        let expected: Vec<(String, String)> = contents
            .iter()
            .map(|content| {
                fs::write(folder.join("ring.msh"), content).unwrap();
                let output = modes(&folder);
                assert_eq!(output.status.code(), Some(0), "{}", errors(&output));
                result(&folder)
            })
            .collect();
        let done = AtomicBool::new(false);
        thread::scope(|scope| {
            scope.spawn(|| {
                let mut round = 0;
                while !done.load(Ordering::SeqCst) {
                    let content = [&contents[0], &contents[1], &half][round % 3];
                    if in_place {
                        fs::write(folder.join("ring.msh"), content).unwrap();
                    } else {
                        fs::write(folder.join("new.msh"), content).unwrap();
                        fs::rename(folder.join("new.msh"), folder.join("ring.msh")).unwrap();
                    }
                    round += 1;
                }
            });
            // a failed assertion ends the other thread too
            let _ends = Ends(&done);
            for round in 0..8 {
                let output = modes(&folder);
                match output.status.code() {
                    // what is said to have been read is what was computed
                    Some(0) => assert!(expected.contains(&result(&folder)), "round {round}: another result"),
                    Some(1 | 2) => {
                        assert!(errors(&output).contains("ring.msh"), "{}", errors(&output))
                    }
                    code => panic!("round {round}: {code:?} {}", errors(&output)),
                }
            }
        });
    }
}

/// Says that it is over when it goes.
struct Ends<'a>(&'a AtomicBool);

impl Drop for Ends<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::SeqCst);
    }
}

/// The hash of the mesh that the result names, and its frequencies.
fn result(folder: &Path) -> (String, String) {
    let text = fs::read(folder.join("out/case/modes.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&text).unwrap();
    (json["meshes"][0]["sha256"].to_string(), json["frequencies_hz"].to_string())
}

#[test]
fn what_is_no_file_is_an_error() {
    for (name, target) in [("folder", "."), ("device", "/dev/null"), ("nothing", "no-such-file")] {
        let folder = case(&format!("no-file-{name}"));
        let path = folder.join("ring.msh");
        fs::remove_file(&path).unwrap();
        std::os::unix::fs::symlink(target, &path).unwrap();
        let output = modes(&folder);
        assert_eq!(output.status.code(), Some(2), "{name}: {}", errors(&output));
        assert!(errors(&output).contains("ring.msh"), "{name}: {}", errors(&output));
    }
}
