//! Mode shapes for programs that show and compare them. The ring, which is no part of the mesh, gets a file of its own.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use super::source::Source;
use super::{CliError, Export};
use crate::app::case::Case;
use crate::app::cli::{OutputFolder, Progress};
use crate::fe::mesh::{ElementBlock, ElementId, ElementKind, Entity, Mesh, MeshNotes, MshFormat, MshVersion};
use crate::formats::{Field, FieldValues, ModeShapes, write_modes_uff, write_uff, write_vtu};

/// Mode shapes cut in two.
struct Bodies {
    housing: Option<(Mesh, ModeShapes)>,
    ring: Option<ModeShapes>,
}

/// `modes.vtu` of the housing's elements, `ring.vtu` of the ring's line.
pub(super) fn vtu(source: &Source, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let bodies = Bodies::of(source, progress)?;
    progress.stage("write");
    let mut files = Vec::new();
    if let Some((mesh, shapes)) = &bodies.housing {
        let elements = volumes(mesh);
        let (parts, names) = part_numbers(&source.case, mesh, &elements);
        let part = Field { name: "part", values: FieldValues::Integers(&parts) };
        write_grid(folder, "modes.vtu", mesh, &elements, shapes, &[part])?;
        let what = format!(
            "elements of the housing, a point field a mode (displacements along the mesh's axes); cell field part: {names}"
        );
        files.push(("modes.vtu", what));
    }
    if let Some(shapes) = &bodies.ring {
        let mesh = ring_line(shapes);
        let elements: Vec<ElementId> = mesh.element_ids(1).collect();
        write_grid(folder, "ring.vtu", &mesh, &elements, shapes, &[])?;
        let what = "the ring's line, a point field a mode (displacements along the mesh's axes)";
        files.push(("ring.vtu", what.to_owned()));
    }
    Ok(bodies.exported(files))
}

/// `modes.uff` of the housing's elements, `ring.uff` of the ring's nodes.
pub(super) fn uff(source: &Source, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let bodies = Bodies::of(source, progress)?;
    progress.stage("write");
    let title = &source.case.title;
    let mut files = Vec::new();
    if let Some((mesh, shapes)) = &bodies.housing {
        let elements = volumes(mesh);
        let own = at_used_nodes(mesh, &elements, shapes);
        write_uff(&folder.path.join("modes.uff"), title, mesh, elements, &own)?;
        let what = "nodes, elements and mode shapes (dataset 55) of the housing, SI, labels of the mesh";
        files.push(("modes.uff", what.to_owned()));
    }
    if let Some(shapes) = &bodies.ring {
        write_modes_uff(&folder.path.join("ring.uff"), title, shapes)?;
        let what = "nodes and mode shapes (dataset 55) of the ring, SI, labels from 1";
        files.push(("ring.uff", what.to_owned()));
    }
    Ok(bodies.exported(files))
}

impl Bodies {
    fn of(source: &Source, progress: &Progress) -> Result<Self, CliError> {
        let (mesh, shapes) = source.shapes(progress)?;
        let nodes = mesh.as_ref().map_or(0, |mesh| mesh.nodes.len());
        let part = |from: usize, to: usize| ModeShapes {
            frequencies_hz: shapes.frequencies_hz.clone(),
            node_tags: None,
            points: shapes.points.as_ref().map(|points| points[from..to].to_vec()),
            shapes: shapes.shapes.iter().map(|shape| shape[3 * from..3 * to].to_vec()).collect(),
            directions: None,
        };
        let all = shapes.count_points();
        let housing = mesh.map(|mesh| (mesh, part(0, nodes)));
        let ring = (all > nodes).then(|| part(nodes, all));
        Ok(Self { housing, ring })
    }

    fn exported(&self, files: Vec<(&'static str, String)>) -> Export {
        let of_ring = self.ring.as_ref();
        let shapes = self.housing.as_ref().map(|(_, shapes)| shapes).or(of_ring);
        let modes = shapes.map_or(0, ModeShapes::count_modes);
        let nodes = self.housing.as_ref().map_or(0, |(mesh, _)| mesh.nodes.len());
        let ring = of_ring.map_or(0, ModeShapes::count_points);
        Export { files, summary: format!("{modes} modes at {nodes} nodes of the mesh and {ring} of the ring") }
    }
}

/// Elements that a housing consists of: those of the mesh's highest dimension.
fn volumes(mesh: &Mesh) -> Vec<ElementId> {
    let dimensions = mesh.blocks.iter().map(|block| block.kind.dimension());
    mesh.element_ids(dimensions.max().unwrap_or(0)).collect()
}

/// Number of each element's part, from 1 in the order of `housing.parts`, and what the numbers mean.
fn part_numbers(case: &Case, mesh: &Mesh, elements: &[ElementId]) -> (Vec<i64>, String) {
    let parts = case.meshed_housing().into_iter().flat_map(|housing| &housing.parts);
    let mut numbers = BTreeMap::new();
    let mut names = Vec::new();
    for (number, part) in (1..).zip(parts) {
        names.push(format!("{number} {}", part.group));
        if let Ok(group) = mesh.body(&part.group) {
            numbers.extend(group.elements.iter().map(|&id| (id, number)));
        }
    }
    let number = |id: &ElementId| numbers.get(id).copied().unwrap_or(0);
    (elements.iter().map(number).collect(), names.join(", "))
}

fn write_grid(
    folder: &OutputFolder,
    name: &str,
    mesh: &Mesh,
    elements: &[ElementId],
    shapes: &ModeShapes,
    cells: &[Field],
) -> Result<(), CliError> {
    // as many digits as the last mode has, so that programs that sort names keep the order
    let digits = shapes.count_modes().to_string().len();
    let title = |(index, hz): (usize, &f64)| format!("mode {:0digits$}, {hz:.4} Hz", index + 1);
    let names: Vec<String> = shapes.frequencies_hz.iter().enumerate().map(title).collect();
    let fields: Vec<Field> = names
        .iter()
        .zip(&shapes.shapes)
        .map(|(name, shape)| Field { name, values: FieldValues::Vectors(shape) })
        .collect();
    Ok(write_vtu(&folder.path.join(name), mesh, elements.iter().copied(), &fields, cells)?)
}

/// A closed line of straight elements through the ring's nodes.
fn ring_line(shapes: &ModeShapes) -> Mesh {
    let nodes = shapes.points.clone().unwrap_or_default();
    let count = nodes.len();
    let tags: Vec<u64> = (1..=count as u64).collect();
    let ends = (0..count).flat_map(|node| [node, (node + 1) % count]);
    let (node_tags, entity) = (tags.clone(), Entity { dimension: 1, tag: 1 });
    let line = ElementBlock { kind: ElementKind::Line2, tags, connectivity: ends.collect(), entity };
    let format = MshFormat { version: MshVersion::V41, binary: false };
    Mesh {
        node_tags,
        blocks: vec![line],
        nodes,
        groups: Vec::new(),
        format,
        notes: MeshNotes::default(),
        source: PathBuf::new(),
    }
}

/// Shapes at those nodes of a mesh that its elements use, with their labels.
fn at_used_nodes(mesh: &Mesh, elements: &[ElementId], shapes: &ModeShapes) -> ModeShapes {
    let of_element = |id: &ElementId| mesh.blocks[id.block].element(id.index).unwrap_or_default();
    let nodes: BTreeSet<usize> = elements.iter().flat_map(of_element).copied().collect();
    let of_nodes = |shape: &Vec<f64>| {
        let values = nodes.iter().flat_map(|&node| &shape[3 * node..3 * node + 3]);
        values.copied().collect()
    };
    ModeShapes {
        frequencies_hz: shapes.frequencies_hz.clone(),
        node_tags: Some(nodes.iter().map(|&node| mesh.node_tags[node]).collect()),
        points: Some(nodes.iter().map(|&node| mesh.nodes[node]).collect()),
        shapes: shapes.shapes.iter().map(of_nodes).collect(),
        directions: None,
    }
}
