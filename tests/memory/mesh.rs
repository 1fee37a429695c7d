//! Memory of an import: never more than ten times the file and a fixed allowance, whatever is in it.
//!
//! One test at a time: the allocator counts for the whole process.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use plummer::fe::mesh::Mesh;
use plummer::numerics::units::LengthUnit;

use super::{alone, peak};

/// For any file, however small: messages, paths, the system's buffers.
const ALLOWANCE: usize = 64 * 1024;

fn ascii(version: &str, sections: &str) -> String {
    format!("$MeshFormat\n{version} 0 8\n$EndMeshFormat\n{sections}")
}

const ONE_NODE: &str = "$Nodes\n1 1 1 1\n0 1 0 1\n1\n0 0 0\n$EndNodes\n";
const ONE_NODE_V22: &str = "$Nodes\n1\n1 0 0 0\n$EndNodes\n";

/// Lines made from the numbers 1 to `count`.
fn lines(count: usize, mut line: impl FnMut(usize) -> String) -> String {
    let mut out = String::new();
    for number in 1..=count {
        let _ = writeln!(out, "{}", line(number));
    }
    out
}

/// Files that hold as much as they can in few bytes, or that announce more than they hold.
fn greedy() -> Vec<(&'static str, String)> {
    const N: usize = 20_000;
    let nodes = |tags: String, coordinates: usize| {
        format!("$Nodes\n1 {N} 1 {N}\n0 1 0 {N}\n{tags}{}$EndNodes\n", "0 0 0\n".repeat(coordinates))
    };
    let point = "$Elements\n1 1 1 1\n0 1 15 1\n1 1\n$EndElements\n";
    let all = |line: &dyn Fn(usize) -> String| lines(N, line);
    let points = all(&|n| format!("{n} 1"));
    let one_block = format!("$Elements\n1 {N} 1 {N}\n0 1 15 {N}\n{points}$EndElements\n");
    let blocks = all(&|n| format!("0 {n} 15 1\n{n} 1"));
    let many_blocks = format!("$Elements\n{N} {N} 1 {N}\n{blocks}$EndElements\n");
    let same_entity = all(&|n| format!("0 1 15 1\n{n} 1"));
    let same_entity = format!("$Elements\n{N} {N} 1 {N}\n{same_entity}$EndElements\n");
    let own_group = all(&|n| format!("{n} 0 0 0 1 {n}"));
    let own_group = format!("$Entities\n{N} 0 0 0\n{own_group}$EndEntities\n");
    let tags = all(&|n| n.to_string());
    let all_groups = format!("$Entities\n1 0 0 0\n1 0 0 0 {N}\n{tags}$EndEntities\n");
    let plain = all(&|n| format!("{n} 0 0 0 0"));
    let curves = all(&|n| format!("{n} 0 0 0 0 0 0 0 0"));
    let v22 = |elements: String| format!("{ONE_NODE_V22}$Elements\n{N}\n{elements}$EndElements\n");
    let names = all(&|n| format!("0 {n} \"\""));
    vec![
        ("nodes", ascii("4.1", &(nodes(tags.clone(), N) + point))),
        ("sparse nodes", ascii("4.1", &nodes(all(&|n| (n * n * 1000).to_string()), N))),
        ("nodes announced", ascii("4.1", &nodes(tags.clone(), 0))),
        ("points", ascii("4.1", &format!("{all_groups}{ONE_NODE}{point}"))),
        ("elements", ascii("4.1", &format!("{ONE_NODE}{one_block}"))),
        ("elements in all groups", ascii("4.1", &format!("{all_groups}{ONE_NODE}{one_block}"))),
        ("blocks", ascii("4.1", &format!("{ONE_NODE}{many_blocks}"))),
        ("blocks of own groups", ascii("4.1", &format!("{own_group}{ONE_NODE}{many_blocks}"))),
        ("blocks in all groups", ascii("4.1", &format!("{all_groups}{ONE_NODE}{same_entity}"))),
        ("entities", ascii("4.1", &format!("$Entities\n{N} 0 0 0\n{plain}$EndEntities\n{ONE_NODE}{point}"))),
        ("curves", ascii("4.1", &format!("$Entities\n0 {N} 0 0\n{curves}$EndEntities\n{ONE_NODE}{point}"))),
        ("names", ascii("4.1", &format!("$PhysicalNames\n{N}\n{names}$EndPhysicalNames\n{ONE_NODE}{point}"))),
        ("2.2 elements", ascii("2.2", &v22(all(&|n| format!("{n} 15 0 1"))))),
        ("2.2 entities", ascii("2.2", &v22(all(&|n| format!("{n} 15 2 0 {n} 1"))))),
        ("2.2 groups", ascii("2.2", &v22(all(&|n| format!("{n} 15 1 {n} 1"))))),
        ("2.2 groups and entities", ascii("2.2", &v22(all(&|n| format!("{n} 15 2 {n} {n} 1"))))),
        ("2.2 in turn", ascii("2.2", &v22(all(&|n| format!("{n} 15 2 {} {} 1", n % 2, n % 3))))),
        ("2.2 cut", ascii("2.2", &v22(all(&|n| format!("{n} 15 2 0 {n} 1"))))[..300_000].to_owned()),
    ]
}

#[test]
fn no_file_takes_more_than_ten_times_its_length() -> Result<(), std::io::Error> {
    let _alone = alone();
    let mut paths: Vec<PathBuf> = Vec::new();
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    for folder in [data.join("damaged"), data] {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "msh") {
                paths.push(path);
            }
        }
    }
    let scratch = tempfile::tempdir()?;
    for (name, content) in greedy() {
        let path = scratch.path().join(name);
        std::fs::write(&path, content)?;
        paths.push(path);
    }
    let mut failures = Vec::new();
    for path in paths {
        let length = std::fs::metadata(&path)?.len() as usize;
        let peak = peak(|| drop(Mesh::read_gmsh(&path, LengthUnit::Metre)));
        let factor = peak.saturating_sub(ALLOWANCE) as f64 / length.max(1) as f64;
        if length > 50_000 {
            println!("{}: {factor:.1} times {length} bytes", path.display());
        }
        if peak > 10 * length + ALLOWANCE {
            failures.push(format!("{}: {peak} bytes for {length}", path.display()));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
    Ok(())
}
