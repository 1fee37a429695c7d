//! Writes datasets 151, 164, 2411, 2412 and 55.
//!
//! Element descriptors and node order of dataset 2412.
//!
//! Source: SDRC I-DEAS finite element descriptors; surfaces are thin shells, which may lie anywhere in space. Middle nodes
//! stand between their corners: round the first face, then those between the faces, then round the second face.

use super::super::fortran::exponential;
use super::super::{FormatError, ModeShapes};
use crate::fe::mesh::{ElementId, ElementKind, Mesh};
use crate::files::{Fault, write_atomic};
use std::collections::HashSet;
use std::io;
use std::io::Write;
use std::path::Path;

/// Largest label of ten digits.
const LAST_LABEL: u64 = 9_999_999_999;

/// A node with its label.
type Node = (u64, [f64; 3]);

/// An element with its label, ready to be written.
type Element<'a> = (u64, Descriptor, &'a [usize]);

/// Writes mode shapes at some of the nodes of some elements of a mesh, whole or not at all: header, SI units, nodes,
/// elements, then one dataset 55 a mode (real, modal mass 1, no damping, 6 digits as the format has it). `description` is
/// the model's name; only its first line is used.
///
/// # Errors
/// [`FormatError`] for elements that the mesh does not have or that are points or lines, mode shapes that contradict
/// themselves or lie at other nodes, labels of more than ten digits, and when the file cannot be written.
pub fn write_uff(
    path: &Path,
    description: &str,
    mesh: &Mesh,
    elements: impl IntoIterator<Item = ElementId>,
    modes: &ModeShapes,
) -> Result<(), FormatError> {
    let mut used = vec![false; mesh.nodes.len()];
    let mut own = Vec::new();
    for id in elements {
        let block = mesh.blocks.get(id.block);
        let found = block.and_then(|block| Some((block.kind, *block.tags.get(id.index)?, block.element(id.index)?)));
        let (kind, label, nodes) = found.ok_or_else(|| FormatError::no_element(id))?;
        let descriptor = descriptor(kind)
            .ok_or_else(|| Fault::new("surface and solid elements", format_args!("a {}", kind.name())))?;
        nodes.iter().for_each(|&node| used[node] = true);
        own.push((label, descriptor, nodes));
    }
    let nodes: Vec<Node> =
        (0..used.len()).filter(|&node| used[node]).map(|node| (mesh.node_tags[node], mesh.nodes[node])).collect();
    let known: HashSet<u64> = nodes.iter().map(|&(tag, _)| tag).collect();
    let tags = tags_of(modes);
    if let Some(tag) = tags.iter().find(|tag| !known.contains(tag)) {
        let expected = "mode shapes at nodes of the elements";
        return Err(Fault::new(expected, format!("node {tag}")).into());
    }
    let labels = known.iter().copied().chain(own.iter().map(|&(label, ..)| label));
    modes.check().map_err(|fault| fault.of(path))?;
    check_label(labels)?;
    Ok(write_atomic(path, |to| {
        write_head(to, description)?;
        write_nodes(to, &nodes)?;
        write_elements(to, mesh, &own)?;
        write_modes(to, description, &tags, modes)
    })?)
}

/// Writes mode shapes without elements, and their points if they are known, whole or not at all. Points without labels are
/// numbered from 1.
///
/// # Errors
/// As [`write_uff`].
pub fn write_modes_uff(path: &Path, description: &str, modes: &ModeShapes) -> Result<(), FormatError> {
    let tags = tags_of(modes);
    modes.check().map_err(|fault| fault.of(path))?;
    check_label(tags.iter().copied())?;
    let points = modes.points.iter().flatten().copied();
    let nodes: Vec<Node> = tags.iter().copied().zip(points).collect();
    Ok(write_atomic(path, |to| {
        write_head(to, description)?;
        if !nodes.is_empty() {
            write_nodes(to, &nodes)?;
        }
        write_modes(to, description, &tags, modes)
    })?)
}

fn tags_of(modes: &ModeShapes) -> Vec<u64> {
    modes.node_tags.clone().unwrap_or_else(|| (1..=modes.count_points() as u64).collect())
}

/// Whether labels fit their column.
pub(super) fn check_label(mut labels: impl Iterator<Item = u64>) -> Result<(), Fault> {
    match labels.find(|&label| label > LAST_LABEL) {
        Some(label) => Err(Fault::new("labels of at most 10 digits", label)),
        None => Ok(()),
    }
}

pub(super) fn begin(to: &mut impl Write, dataset: u32) -> io::Result<()> {
    writeln!(to, "{:>6}\n{dataset:>6}", -1)
}

pub(super) fn end(to: &mut impl Write) -> io::Result<()> {
    writeln!(to, "{:>6}", -1)
}

/// An identification line: at most 80 characters, "NONE" if there is nothing to say, which the format asks for.
pub(super) fn identification(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default().trim();
    let plain = line.chars().map(|c| if c.is_ascii_graphic() { c } else { ' ' });
    match line {
        "" | "-1" => "NONE".to_owned(),
        _ => plain.take(80).collect(),
    }
}

/// Datasets 151 and 164. Dates are fixed, so that the same results give the same bytes.
pub(super) fn write_head(to: &mut impl Write, description: &str) -> io::Result<()> {
    let program = concat!("plummer ", env!("CARGO_PKG_VERSION"));
    let date = format!("{:<10}{:<10}", "01-Jan-00", "00:00:00");
    begin(to, 151)?;
    writeln!(to, "{}\nNONE\n{program}", identification(description))?;
    writeln!(to, "{date}{:>10}{:>10}{:>10}", 0, 0, 0)?;
    writeln!(to, "{date}\n{program}\n{date}")?;
    end(to)?;
    begin(to, 164)?;
    // SI: metre, newton; temperatures (there are none) in kelvin.
    writeln!(to, "{:>10}{:<20}{:>10}", 1, "SI: metre (newton)", 1)?;
    let number = |value| exponential(value, 25, 17, 'D');
    writeln!(to, "{0}{0}{0}\n{1}", number(1.0), number(273.15))?;
    end(to)
}

/// Dataset 2411; coordinate systems 0 are global.
fn write_nodes(to: &mut impl Write, nodes: &[Node]) -> io::Result<()> {
    begin(to, 2411)?;
    for (tag, point) in nodes {
        writeln!(to, "{tag:>10}{:>10}{:>10}{:>10}", 0, 0, 11)?;
        let [x, y, z] = point.map(|value| exponential(value, 25, 16, 'D'));
        writeln!(to, "{x}{y}{z}")?;
    }
    end(to)
}

/// Dataset 2412; properties and materials are tables 1, which are not in the file.
fn write_elements(to: &mut impl Write, mesh: &Mesh, elements: &[Element]) -> io::Result<()> {
    begin(to, 2412)?;
    for (label, Descriptor { id, order }, nodes) in elements {
        writeln!(to, "{label:>10}{id:>10}{:>10}{:>10}{:>10}{:>10}", 1, 1, 7, order.len())?;
        for line in order.chunks(8) {
            let tags = line.iter().map(|&place| format!("{:>10}", mesh.node_tags[nodes[place]]));
            writeln!(to, "{}", tags.collect::<String>())?;
        }
    }
    end(to)
}

/// One dataset 55 a mode.
fn write_modes(to: &mut impl Write, description: &str, tags: &[u64], modes: &ModeShapes) -> io::Result<()> {
    let number = |value| exponential(value, 13, 5, 'E');
    for (index, (&frequency, shape)) in modes.frequencies_hz.iter().zip(&modes.shapes).enumerate() {
        let mode = index + 1;
        begin(to, 55)?;
        writeln!(to, "{}\nmode shape\nNONE\nNONE", identification(description))?;
        writeln!(to, "Mode {mode} Frequency {frequency} Hz")?;
        // structural, normal mode, 3 translations, displacement, real, 3 values a node
        writeln!(to, "{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}", 1, 2, 2, 8, 2, 3)?;
        // 2 whole numbers (load case, mode) and 4 reals (frequency, modal mass, viscous and hysteretic damping)
        writeln!(to, "{:>10}{:>10}{:>10}{mode:>10}", 2, 4, 1)?;
        writeln!(to, "{}{}{2}{2}", number(frequency), number(1.0), number(0.0))?;
        for (tag, displacement) in tags.iter().zip(shape.chunks_exact(3)) {
            let displacement: String = displacement.iter().map(|&value| number(value)).collect();
            writeln!(to, "{tag:>10}\n{displacement}")?;
        }
        end(to)?;
    }
    Ok(())
}

/// Descriptor and, for each place in the dataset, the place in gmsh's order.
pub(super) struct Descriptor {
    pub(super) id: u32,
    pub(super) order: &'static [usize],
}

const SAME: [usize; 8] = [0, 1, 2, 3, 4, 5, 6, 7];

/// The descriptor of a surface or solid element; none for points and lines. The dataset has no nodes in centres, which are
/// left out, and no pyramids, which are bricks whose upper face is the apex.
pub(super) fn descriptor(kind: ElementKind) -> Option<Descriptor> {
    let (id, order): (u32, &[usize]) = match kind {
        ElementKind::Point | ElementKind::Line2 | ElementKind::Line3 => return None,
        ElementKind::Tri3 => (91, &SAME[..3]),
        ElementKind::Tri6 => (92, &[0, 3, 1, 4, 2, 5]),
        ElementKind::Quad4 => (94, &SAME[..4]),
        ElementKind::Quad8 | ElementKind::Quad9 => (95, &[0, 4, 1, 5, 2, 6, 3, 7]),
        ElementKind::Tet4 => (111, &SAME[..4]),
        ElementKind::Wedge6 => (112, &SAME[..6]),
        ElementKind::Wedge15 | ElementKind::Wedge18 => (113, &[0, 6, 1, 9, 2, 7, 8, 10, 11, 3, 12, 4, 14, 5, 13]),
        ElementKind::Hex8 => (115, &SAME),
        ElementKind::Pyramid5 => (115, &[0, 1, 2, 3, 4, 4, 4, 4]),
        ElementKind::Hex20 | ElementKind::Hex27 => {
            (116, &[0, 8, 1, 11, 2, 13, 3, 9, 10, 12, 14, 15, 4, 16, 5, 18, 6, 19, 7, 17])
        }
        ElementKind::Pyramid13 | ElementKind::Pyramid14 => {
            (116, &[0, 5, 1, 8, 2, 10, 3, 6, 7, 9, 11, 12, 4, 4, 4, 4, 4, 4, 4, 4])
        }
        ElementKind::Tet10 => (118, &[0, 4, 1, 5, 2, 6, 7, 9, 8, 3]),
    };
    Some(Descriptor { id, order })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Places of the dataset: a middle node and the two corners that it stands between.
    fn ring(first: usize, corners: usize) -> Vec<[usize; 3]> {
        let places = 2 * corners;
        let odd = (0..corners).map(|k| 2 * k + 1);
        odd.map(|k| [first + k, first + k - 1, first + (k + 1) % places]).collect()
    }

    #[allow(clippy::float_cmp)] // halves of small integers are exact
    #[test]
    fn middle_nodes_stand_between_their_corners() {
        let between = |first: usize, corners: usize| {
            let sides = (0..corners).map(move |k| {
                let above = first + corners + 2 * k;
                [first + k, 2 * k, above]
            });
            sides.collect::<Vec<_>>()
        };
        let tet10: Vec<[usize; 3]> = (0..3).map(|k| [6 + k, 2 * k, 9]).collect();
        let kinds = [
            (ElementKind::Tri6, ring(0, 3)),
            (ElementKind::Quad8, ring(0, 4)),
            (ElementKind::Tet10, [ring(0, 3), tet10].concat()),
            (ElementKind::Hex20, [ring(0, 4), between(8, 4), ring(12, 4)].concat()),
            (ElementKind::Wedge15, [ring(0, 3), between(6, 3), ring(9, 3)].concat()),
            (ElementKind::Quad9, ring(0, 4)),
            (ElementKind::Hex27, [ring(0, 4), between(8, 4), ring(12, 4)].concat()),
            (ElementKind::Wedge18, [ring(0, 3), between(6, 3), ring(9, 3)].concat()),
            (ElementKind::Pyramid13, [ring(0, 4), between(8, 4)].concat()),
            (ElementKind::Pyramid14, [ring(0, 4), between(8, 4)].concat()),
        ];
        for (kind, middles) in kinds {
            let order = descriptor(kind).unwrap().order;
            let mut sorted = order.to_vec();
            sorted.sort_unstable();
            sorted.dedup();
            assert_eq!(sorted, (0..kind.corners() + middles.len()).collect::<Vec<_>>(), "{kind:?}");
            assert_eq!(middles.len(), kind.middle_edges().len(), "{kind:?}");
            for [middle, from, to] in middles {
                let place = |own: usize| kind.natural_nodes()[order[own]];
                let (from, to) = (place(from), place(to));
                let expected = [0, 1, 2].map(|axis| (from[axis] + to[axis]) / 2.0);
                assert_eq!(place(middle), expected, "{kind:?} node {middle}");
            }
        }
    }

    /// gmsh 4's own UNV export of the first element of tests/data/cube_*_msh41.msh against its MSH numbers.
    #[test]
    fn order_is_that_of_gmsh() {
        let cases: [(ElementKind, &[u64], &[u64]); 3] = [
            (ElementKind::Tet10, &[1, 9, 18, 81, 10, 46, 20, 87, 83, 100], &[1, 10, 9, 46, 18, 20, 87, 100, 83, 81]),
            (
                ElementKind::Hex20,
                &[1, 9, 45, 18, 33, 50, 75, 65, 10, 20, 34, 46, 51, 47, 76, 66, 52, 69, 77, 78],
                &[1, 10, 9, 46, 45, 47, 18, 20, 34, 51, 76, 66, 33, 52, 50, 77, 75, 78, 65, 69],
            ),
            (
                ElementKind::Wedge15,
                &[1, 9, 18, 33, 54, 69, 10, 20, 34, 46, 55, 70, 56, 73, 84],
                &[1, 10, 9, 46, 18, 20, 34, 55, 70, 33, 56, 54, 84, 69, 73],
            ),
        ];
        for (kind, own, expected) in cases {
            let order = descriptor(kind).unwrap().order;
            let found: Vec<u64> = order.iter().map(|&place| own[place]).collect();
            assert_eq!(found, expected, "{kind:?}");
        }
    }
}
