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
    let of_static = whole.replace(" 2    1MODAL", " 0    1     ").replace("MODAL", "     ");
    let of_static = of_static.replace("                     2    ", "                     0    ");
    assert_eq!(refused(&of_static), refused(""));
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
    // a row, an element or a component less than the head of its block says, or more
    let without = |start: &str, after: usize| {
        let place = after + whole.lines().skip(after).position(|line| line.starts_with(start)).unwrap();
        let lines = whole.lines().enumerate().filter(|(number, _)| *number != place).map(|(_, line)| line);
        refused(&lines.collect::<Vec<_>>().join("\n"))
    };
    assert_eq!(without(" -1", 0), "line 12: expected 125 rows -1 in the block, as its head says, found 124");
    assert_eq!(without(" -1", 138), "line 139: expected 96 rows -1 in the block, as its head says, found 95");
    let of_mode = format!("line {}: expected 125 rows -1 in the block, as its head says, found 124", block + 1);
    assert_eq!(without(" -1", block), of_mode);
    let of_kind = format!("line {}: expected 4 components -5 in the block, as its head says, found 3", block + 2);
    assert_eq!(without(" -5", block), of_kind);
    let of_static = of_static.replacen("0.00000E+00         125 ", "0.00000E+00         126 ", 1);
    assert_eq!(refused(&of_static), of_mode.replace("125", "126").replace("124", "125"));
    // never a panic, whatever is cut or changed
    for at in (0..whole.len()).step_by(997) {
        let _ = Reader::new(&whole[..at]).modes(1.0);
        let mut text = whole.clone();
        text.replace_range(at..=at, "\u{e4}");
        let _ = Reader::new(&text).modes(1.0);
    }
}
