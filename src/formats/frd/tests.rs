//! A file of CalculiX 2.20 (`tests/data/frd/cube.inp` makes it), and damaged ones.

use super::{Path, Reader, read_modes_frd};

fn cube() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frd/cube.frd");
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn modes_of_calculix_are_read() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/frd/cube.frd");
    let modes = read_modes_frd(&path, 1e-3).unwrap();
    assert_eq!((modes.count_modes(), modes.count_points()), (9, 125));
    // as cube.dat lists it, cycles per time; digits as the file has them
    assert!((modes.frequencies_hz[6] / 1_531_366.230 - 1.0).abs() < 1e-12);
    assert_eq!(modes.node_tags.as_ref().unwrap()[..3], [1, 2, 3]);
    // the cube's side is one of the file's units
    let [x, y, z] = modes.points.as_ref().unwrap()[6];
    assert!([x, y, z].iter().all(|side| (side - 1e-3).abs() < 1e-15));
    // three numbers without a blank between
    let row = cube();
    let row = row.lines().skip_while(|line| !line.contains("100CL")).find(|line| line.starts_with(" -1")).unwrap();
    assert!(row.contains("E+03-"), "{row}");
    let first: f64 = row[13..25].trim().parse().unwrap();
    assert!((modes.shapes[0][0] - first).abs() < 1e-12 * first.abs());
}

#[test]
fn what_is_no_file_of_modes_is_refused_with_its_line() {
    let whole = cube();
    let refused = |text: &str| Reader::new(text).modes(1.0).unwrap_err().to_string();
    let until = |lines: usize| whole.lines().take(lines).collect::<Vec<_>>().join("\n");
    let block = whole.lines().position(|line| line.contains("100CL")).unwrap();
    assert_eq!(refused(""), "expected displacements of modes (*FREQUENCY with *NODE FILE and U), found none");
    assert_eq!(
        refused(
            &whole.replace(" 2    1MODAL", " 0    1MODAL").lines().take(block + 100).collect::<Vec<_>>().join("\n")
        ),
        "expected displacements of modes (*FREQUENCY with *NODE FILE and U), found none"
    );
    let cut = refused(&until(block + 20));
    assert_eq!(cut, format!("line {}: expected the end -3 of the block, found the end of the file", block + 20));
    let complex = refused(&whole.replacen("-4  DISP ", "-4  DISPI", 1));
    assert_eq!(complex, format!("line {}: expected real displacements (DISP), found \"DISPI\"", block + 2));
    let number = refused(&whole.replacen("1.00000E+00", "1.0000xE+00", 1));
    assert!(number.ends_with("expected a number in 12 columns, found \"1.0000xE+00\""), "{number}");
    let binary = whole.lines().map(|line| match line.starts_with("    2C") {
        true => format!("{}3", &line[..73]),
        false => line.to_owned(),
    });
    let binary = refused(&binary.collect::<Vec<_>>().join("\n"));
    assert!(binary.ends_with("expected text of format 0 or 1 (binary files are not read), found \"3\""), "{binary}");
    // never a panic, whatever is cut or changed
    for at in (0..whole.len()).step_by(997) {
        let _ = Reader::new(&whole[..at]).modes(1.0);
        let mut text = whole.clone();
        text.replace_range(at..=at, "\u{e4}");
        let _ = Reader::new(&text).modes(1.0);
    }
}
