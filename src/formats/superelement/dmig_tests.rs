use super::super::samples::record;
use super::*;
use crate::formats::{DofBody, DofDirection, DofLabel};

/// Two centre nodes of six coordinates and three modes, numbers without pattern.
fn centres() -> SuperelementRecord {
    let of = |node: u64| (0..6).map(move |k| DofLabel::centre(node, k, [0.1 * node as f64, -1.0 / 3.0, 2e-7]));
    let interface: Vec<DofLabel> = (0..2).flat_map(of).collect();
    let entry = |row: usize, column: usize| {
        let (low, high) = (row.min(column) as f64, row.max(column) as f64);
        (1.7 * low + 0.3 * high + 1.0).sin() * 10.0_f64.powi((low + high) as i32 - 14)
    };
    let of = |diagonal: f64| {
        DenseMatrix::from_fn(15, 15, |row, column| match (row.max(column) < 12, row == column) {
            (_, true) => diagonal * (1.0 + row as f64 / 7.0),
            (true, false) => entry(row, column),
            (false, false) => 0.0,
        })
    };
    SuperelementRecord::of_matrices(of(3e10), of(2.0), interface).expect("symmetric")
}

/// What a reader of bulk data finds: points and lower triangles.
#[derive(Debug, Default)]
struct Read {
    grids: Vec<(u64, [f64; 3])>,
    scalars: Vec<u64>,
    headers: Vec<(String, [i64; 4])>,
    entries: BTreeMap<(String, [(u64, i64); 2]), f64>,
}

fn number(field: &str) -> f64 {
    field.trim().replace('D', "e").parse().expect("a number")
}

fn read(text: &str) -> Read {
    let mut found = Read::default();
    let (mut name, mut column, mut grid) = (String::new(), (0, 0), None);
    for line in text.lines().filter(|line| !line.starts_with('$')) {
        assert!(line.len() <= 8 + 4 * WIDTH && line.is_ascii(), "{line}");
        let part =
            |from: usize, width: usize| line.get(from..(from + width).min(line.len())).unwrap_or("").trim().to_owned();
        let wide = |k: usize| part(8 + WIDTH * k, WIDTH);
        match part(0, 8).as_str() {
            "GRID*" => grid = Some((wide(0).parse().expect("a number"), [number(&wide(2)), number(&wide(3))])),
            "SPOINT" => found.scalars.push(part(8, 8).parse().expect("a number")),
            "DMIG" => {
                let of = |k: usize| part(16 + 8 * k, 8).parse().expect("a number");
                found.headers.push((part(8, 8), [of(0), of(1), of(2), of(3)]));
            }
            "DMIG*" => {
                name = wide(0);
                column = (wide(1).parse().expect("a number"), wide(2).parse().expect("a number"));
            }
            "*" => match grid.take() {
                Some((id, [x, y])) => found.grids.push((id, [x, y, number(&wide(0))])),
                None => {
                    let row = (wide(0).parse().expect("a number"), wide(1).parse().expect("a number"));
                    let old = found.entries.insert((name.clone(), [row, column]), number(&wide(2)));
                    assert_eq!(old, None, "{name} {row:?} {column:?} twice");
                }
            },
            other => panic!("{other}"),
        }
    }
    found
}

fn written(record: &SuperelementRecord) -> String {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("superelement.bdf");
    write_superelement_dmig(&path, record).expect("written");
    std::fs::read_to_string(&path).expect("there")
}

#[test]
fn matrices_come_back_to_ten_digits() {
    let record = centres();
    let found = read(&written(&record));
    assert_eq!(found.grids.len(), 2);
    assert_eq!(found.grids[0].0, 1);
    assert!((found.grids[1].1[1] + 1.0 / 3.0).abs() < 1e-11);
    assert_eq!(found.scalars, [3, 4, 5]);
    let headers: Vec<&str> = found.headers.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(headers, ["KAAX", "MAAX"]);
    // form 6: symmetric; type in and out: real double, by the machine
    assert!(found.headers.iter().all(|(_, numbers)| *numbers == [0, 6, 2, 0]));
    let place = |row: usize| match row.checked_sub(12) {
        Some(mode) => (3 + mode as u64, 0),
        None => (1 + row as u64 / 6, 1 + row as i64 % 6),
    };
    for (name, matrix) in [("KAAX", &record.stiffness), ("MAAX", &record.mass)] {
        for column in 0..15 {
            for row in 0..15 {
                let entry = found.entries.get(&(name.to_owned(), [place(row), place(column)]));
                let expected =
                    if row < column || matrix[(row, column)] == 0.0 { None } else { Some(matrix[(row, column)]) };
                assert_eq!(entry.is_some(), expected.is_some(), "{name} {row} {column}");
                if let (Some(entry), Some(expected)) = (entry, expected) {
                    // half a unit of the tenth digit
                    assert!((entry / expected - 1.0).abs() < 5e-10, "{name} {row} {column}: {entry} {expected}");
                }
            }
        }
    }
}

#[test]
fn comments_name_every_row() {
    let text = written(&centres());
    for line in [
        "$ condensed housing of plummer: 12 interface coordinates, 3 modes\n",
        "$ case control: K2GG = KAAX, M2GG = MAAX\n",
        "$ 1, 1, 1: centre 0, x, m\n",
        "$ 12, 2, 6: centre 1, about_z, rad\n",
        "$ 13, 3, 0: mode 1, ",
        "$ KAAX: stiffness\n",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

#[test]
fn nodes_of_the_mesh_keep_their_numbers() {
    let mut record = record();
    let found = read(&written(&record));
    assert_eq!(found.grids.iter().map(|grid| grid.0).collect::<Vec<_>>(), [7]);
    assert_eq!(found.scalars, [8, 9]);
    assert_eq!(
        found.headers.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(),
        ["KAAX", "MAAX", "BAAX", "K4AAX"]
    );
    // a centre comes after the largest of them
    record.interface[0].body = DofBody::Centre;
    assert_eq!(read(&written(&record)).grids.iter().map(|grid| grid.0).collect::<Vec<_>>(), [7, 8]);
    assert_eq!(read(&written(&record)).scalars, [9, 10]);
}

/// A node whose coordinates are along turned axes has them as its displacement system; the other one has the mesh's.
#[test]
fn turned_axes_are_a_displacement_system() {
    let mut record = centres();
    let axes = [[0.6, 0.8, 0.0], [0.0, 0.0, 1.0], [0.8, -0.6, 0.0]];
    for (place, label) in record.interface.iter_mut().take(6).enumerate() {
        label.axis = axes[place % 3];
    }
    let text = written(&record);
    let lines: Vec<&str> = text.lines().filter(|line| !line.starts_with('$')).take(7).collect();
    let fields = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    // origin, a point on z, a point in the plane of z and x
    assert!(lines[0].starts_with(&format!("{:<8}{:>WIDTH$}{:>WIDTH$}", "CORD2R*", 1, 0)), "{text}");
    let values: Vec<f64> = [&lines[1][8..], &lines[2][8..]]
        .iter()
        .flat_map(|line| line.as_bytes().chunks(WIDTH))
        .map(|part| number(std::str::from_utf8(part).expect("ascii")))
        .collect();
    assert_eq!(values, [0.0, 0.8, -0.6, 0.0, 0.6, 0.8, 0.0]);
    assert_eq!(fields(lines[4]).last().map(String::as_str), Some("1"), "{text}");
    assert_eq!(fields(lines[6]).len(), 2, "{text}");
    // axes that are no right-handed system
    record.interface.iter_mut().take(6).for_each(|label| label.axis[2] *= -1.0);
    let folder = tempfile::tempdir().expect("a folder");
    let error = write_superelement_dmig(&folder.path().join("a.bdf"), &record).expect_err("left-handed").to_string();
    assert!(error.contains("right-handed axes of every node"), "{error}");
}

#[test]
fn fields_hold_as_many_digits_as_fit() {
    for (value, expected) in [
        (1.0 / 3.0, "3.33333333333D-1"),
        (-2.0 / 3.0e10, "-6.666666667D-11"),
        (-12_345_678_901.25, "-1.2345678901D10"),
        (2.0e9 / 3.0, "6.6666666666667D8"),
        (0.0, "0.0000000000000D0"),
        (-1.0 / 3.0 * 1e-100, "-3.33333333D-101"),
    ] {
        let found = field(value);
        assert_eq!(found.len(), WIDTH, "{found}");
        let expected = &expected[..expected.len().min(WIDTH + 1)];
        assert!((number(&found) - value).abs() <= 5e-9 * value.abs(), "{found} {expected}");
    }
    assert_eq!(field(-12_345_678_901.25), "-1.2345678901D10");
    assert_eq!(field(1.0 / 3.0), "3.33333333333D-1");
}

fn refused(change: impl Fn(&mut DofLabel)) -> String {
    let mut record = centres();
    change(&mut record.interface[1]);
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("superelement.bdf");
    let error = write_superelement_dmig(&path, &record).expect_err("refused").to_string();
    assert!(!path.exists());
    error
}

#[test]
fn coordinates_that_no_grid_point_has_are_refused() {
    let turned = refused(|label| label.axis = [0.6, 0.8, 0.0]);
    assert!(turned.contains("displacements and rotations of centre 0 about the same axes"), "{turned}");
    assert!(turned.contains("(0.6, 0.8, 0) and (0, 1, 0)"), "{turned}");
    let short = refused(|label| label.axis = [0.6, 0.0, 0.0]);
    assert!(short.contains("a unit vector for \"y\" of centre 0, found (0.6, 0, 0)"), "{short}");
    let polar = refused(|label| label.direction = DofDirection::Polar(0));
    assert!(polar.contains("\"radial\" of centre 0"), "{polar}");
    let nowhere = refused(|label| label.position = [f64::NAN; 3]);
    assert!(nowhere.contains("the place of centre 0 in m"), "{nowhere}");
}
