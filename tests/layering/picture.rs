//! The picture of the house, `docs/figures/architecture.svg`: a box a wing with its rooms, each with its size and the first sentence
//! of its documentation, and the arrows between the wings.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use super::imports::Arrow;
use super::source::Source;
use super::{room, wing};

const WIDTH: f64 = 1000.0;
const LINE: f64 = 17.0;
/// Where the arrows run, left of the boxes.
const LEFT: f64 = 130.0;
const GAP: f64 = 14.0;
/// So many letters of a sentence stand in a line.
const LETTERS: usize = 112;

/// The wings from the highest one down, each with its rooms.
pub fn svg(wings: &[(&str, &[&str])], sources: &[Source], arrows: &[Arrow]) -> String {
    let mut rooms: BTreeMap<&str, BTreeMap<String, (usize, String)>> = BTreeMap::new();
    for source in sources.iter().filter(|source| !source.code.is_empty()) {
        let name = room(&source.path);
        let entry = rooms.entry(wing(&source.path)).or_default();
        let (lines, says) = entry.entry(name.clone()).or_default();
        *lines += source.code.len();
        let face = [format!("{name}.rs"), format!("{name}/mod.rs")];
        if face.contains(&source.path) {
            says.clone_from(&source.says);
        }
    }
    let mut tops = BTreeMap::new();
    let mut y = 20.0;
    for (name, _) in wings.iter().rev() {
        let count = rooms.get(name).map_or(0, |rooms| shown(rooms, name).len());
        let height = LINE * (count as f64 + 1.0) + 14.0;
        tops.insert(*name, (y, height));
        y += height + GAP;
    }
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {y}\" font-family=\"sans-serif\" font-size=\"12\">\n<title>The house of plummer</title>\n<rect width=\"{WIDTH}\" height=\"{y}\" fill=\"#ffffff\"/>\n"
    );
    draw_arrows(&mut out, wings, arrows, &tops);
    for (name, (top, height)) in &tops {
        let x = LEFT;
        let lines: usize = rooms.get(name).into_iter().flatten().map(|(_, room)| room.0).sum();
        let _ = writeln!(
            out,
            "<rect x=\"{x}\" y=\"{top}\" width=\"{}\" height=\"{height}\" rx=\"5\" fill=\"#eef3fa\" stroke=\"#33557f\"/>\n<text x=\"{}\" y=\"{}\" fill=\"#1b2a3d\" font-size=\"14\" font-weight=\"bold\">{name}/</text><text x=\"{}\" y=\"{}\" fill=\"#5b6b80\">{} lines</text>",
            WIDTH - x - 10.0,
            x + 10.0,
            top + 18.0,
            x + 110.0,
            top + 18.0,
            size(lines)
        );
        let Some(rooms) = rooms.get(name) else {
            continue;
        };
        for (place, (room, (lines, says))) in shown(rooms, name).into_iter().enumerate() {
            let y = top + 18.0 + LINE * (place as f64 + 1.0);
            let _ = writeln!(
                out,
                "<text x=\"{}\" y=\"{y}\" fill=\"#1b2a3d\">{room}</text><text x=\"{}\" y=\"{y}\" fill=\"#5b6b80\" font-size=\"10\" text-anchor=\"end\">{}</text><text x=\"{}\" y=\"{y}\" fill=\"#3d4b5f\" font-size=\"10.5\">{}</text>",
                x + 20.0,
                x + 225.0,
                size(lines),
                x + 235.0,
                cut(&says)
            );
        }
    }
    out.push_str("</svg>\n");
    out
}

/// Rooms that are more than the wing's own face: name, lines, what they say.
fn shown(rooms: &BTreeMap<String, (usize, String)>, wing: &str) -> Vec<(String, (usize, String))> {
    let below = |name: &String| name.strip_prefix(&format!("{wing}/")).map(str::to_owned);
    let rooms = rooms.iter().filter(|(name, _)| !name.ends_with("/mod"));
    rooms.filter_map(|(name, room)| Some((below(name)?, room.clone()))).collect()
}

/// Arrows between wings that are not already those of a wing below.
fn draw_arrows(out: &mut String, wings: &[(&str, &[&str])], arrows: &[Arrow], tops: &BTreeMap<&str, (f64, f64)>) {
    let mut pairs = BTreeSet::new();
    for arrow in arrows {
        let (from, to) = (wing(&arrow.from), wing(&arrow.to));
        if from != to {
            pairs.insert((from, to));
        }
    }
    let place = |name: &str| wings.iter().position(|(of, _)| *of == name);
    let implied = |from: &str, to: &str| {
        let others = pairs.iter().filter(|pair| pair.0 == from && pair.1 != to);
        others.into_iter().any(|pair| pairs.contains(&(pair.1, to)))
    };
    let mut bends: usize = 0;
    for (from, to) in pairs.iter().filter(|pair| !implied(pair.0, pair.1)) {
        let (Some(a), Some(b)) = (tops.get(from), tops.get(to)) else {
            continue;
        };
        let reach = place(from).unwrap_or(0).abs_diff(place(to).unwrap_or(0)) as f64;
        let (y0, y1) = (a.0 + 24.0 + bends as f64 % 5.0 * 5.0, b.0 + 14.0);
        let x = LEFT - 14.0 * reach;
        bends += 1;
        let _ = writeln!(
            out,
            "<path d=\"M{LEFT} {y0} C{x} {y0} {x} {y1} {} {y1}\" fill=\"none\" stroke=\"#7a8aa0\" stroke-width=\"1.3\"/><path d=\"M{} {} L{LEFT} {y1} L{} {} Z\" fill=\"#7a8aa0\"/>",
            LEFT - 6.0,
            LEFT - 8.0,
            y1 - 4.0,
            LEFT - 8.0,
            y1 + 4.0
        );
    }
}

/// A sentence that fits its line, with the letters that XML needs.
fn cut(says: &str) -> String {
    let mut text: String = says.chars().take(LETTERS).collect();
    if text.len() < says.len() {
        let end = text.rfind(' ').unwrap_or(text.len());
        text.truncate(end);
        text.push('…');
    }
    text.replace('&', "&amp;").replace('<', "&lt;")
}

/// Lines of code to a digit or two, so that the picture does not change with every line.
fn size(lines: usize) -> usize {
    let unit = match lines {
        0..1000 => 100,
        1000..10_000 => 500,
        _ => 1000,
    };
    ((lines + unit / 2) / unit * unit).max(unit)
}
