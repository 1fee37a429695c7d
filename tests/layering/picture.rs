//! The picture of the modules, `docs/figures/architecture.svg`, made from the table of layers and the imports that the code has.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// Modules with the ones that each imports.
pub type Graph = BTreeMap<String, BTreeSet<String>>;

const WIDTH: f64 = 980.0;
const ROW: f64 = 68.0;
const BOX: [f64; 2] = [128.0, 36.0];

/// A module's place, and how many lines of code it has.
struct Spot {
    x: f64,
    y: f64,
    lines: usize,
}

/// The picture: a row of modules under the other, what each does not reach by others joined by a line.
pub fn svg(rows: &[(u32, &str)], graph: &Graph, lines: &BTreeMap<String, usize>) -> String {
    let last = rows.iter().map(|row| row.0).max().unwrap_or(0);
    let mut spots = BTreeMap::new();
    for row in 0..=last {
        let names: Vec<&str> = rows
            .iter()
            .filter(|(of, _)| *of == row)
            .map(|row| row.1)
            .collect();
        for (place, name) in names.iter().enumerate() {
            let share = match names.len() {
                // alternately left and right of the middle, or lines to the rows below would run through boxes
                1 => [0.4, 0.6][row as usize % 2],
                count => (place as f64 + 1.0) / (count as f64 + 1.0),
            };
            let spot = Spot {
                x: WIDTH * share,
                y: 40.0 + ROW * f64::from(row),
                lines: lines.get(*name).copied().unwrap_or(0),
            };
            spots.insert(*name, spot);
        }
    }
    let height = 40.0 + ROW * f64::from(last) + 40.0;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" font-family=\"sans-serif\" font-size=\"13\">\n<title>Modules of plummer</title>\n<rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for (importer, imported) in reduced(graph) {
        let (Some(from), Some(to)) = (spots.get(imported.as_str()), spots.get(importer.as_str()))
        else {
            continue;
        };
        let [y0, y1] = [from.y + 0.5 * BOX[1], to.y - 0.5 * BOX[1]];
        let middle = 0.5 * (y0 + y1);
        let _ = writeln!(
            out,
            "<path d=\"M{:.0} {y0:.0} C{:.0} {middle:.0} {:.0} {middle:.0} {:.0} {y1:.0}\" fill=\"none\" stroke=\"#7a8aa0\" stroke-width=\"1.2\"/>",
            from.x, from.x, to.x, to.x
        );
    }
    for (name, spot) in &spots {
        let (x, y) = (spot.x - 0.5 * BOX[0], spot.y - 0.5 * BOX[1]);
        let _ = writeln!(
            out,
            "<rect x=\"{x:.0}\" y=\"{y:.0}\" width=\"{}\" height=\"{}\" rx=\"5\" fill=\"#eef3fa\" stroke=\"#33557f\"/>\n<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#1b2a3d\">{name}</text>\n<text x=\"{:.0}\" y=\"{:.0}\" text-anchor=\"middle\" fill=\"#5b6b80\" font-size=\"10\">{}</text>",
            BOX[0],
            BOX[1],
            spot.x,
            spot.y,
            spot.x,
            spot.y + 13.0,
            size(spot.lines)
        );
    }
    out.push_str("</svg>\n");
    out
}

/// Lines of code to a digit or two, so that the picture does not change with every line.
fn size(lines: usize) -> String {
    let unit = match lines {
        0..1000 => 100,
        1000..10_000 => 500,
        _ => 1000,
    };
    let rounded = ((lines + unit / 2) / unit * unit).max(unit);
    format!("{rounded} lines")
}

/// Imports that are not already those of an imported module: pairs (importer, imported).
fn reduced(graph: &Graph) -> Vec<(String, String)> {
    let mut pairs = Vec::new();
    for (importer, imports) in graph {
        for imported in imports {
            let others = imports.iter().filter(|other| *other != imported);
            let implied = others
                .into_iter()
                .any(|other| reaches(graph, other, imported));
            if !implied {
                pairs.push((importer.clone(), imported.clone()));
            }
        }
    }
    pairs
}

/// Whether a module imports another, itself or by others. The rows leave no circles.
fn reaches(graph: &Graph, from: &str, to: &str) -> bool {
    let imports = graph.get(from).into_iter().flatten();
    imports
        .into_iter()
        .any(|next| next == to || reaches(graph, next, to))
}

#[test]
fn what_others_imply_is_not_drawn() {
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let graph: Graph = [
        ("c".to_owned(), names(&["a", "b"])),
        ("b".to_owned(), names(&["a"])),
    ]
    .into();
    let pair = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    assert_eq!(reduced(&graph), [pair("b", "a"), pair("c", "b")]);
    let picture = svg(
        &[(0, "a"), (1, "b"), (2, "c")],
        &graph,
        &[("a".to_owned(), 1234)].into(),
    );
    assert_eq!(picture.matches("<path").count(), 2);
    assert!(picture.contains("1000 lines") && picture.contains(">c</text>"));
}
