//! The surface of a housing and the line of its ring, with mode shapes, as the report shows them.

use super::compute::ModesResult;
use super::kinds::{ELASTIC, kinds};
use crate::fe::mesh::{BoundaryFace, ElementId, ElementKind, Mesh};
use crate::fe::modal::{ModalSurvey, RingShapes};
use crate::fe::model::HousingModel;
use crate::report::{ModeShapeView, ShapeFigures, ShapeGroup, ShapeLine, ShapeMode, ShapeTriangle, UpAxis};
use std::collections::BTreeMap;

/// A face by its sorted corners.
type Corners = Vec<usize>;

/// Largest displacement shown, as a part of the model's size.
const AMPLITUDE: f64 = 0.05;

/// Half the width at which a ring alone is drawn, as a part of its radius.
const BAND: f64 = 0.08;

/// The view of a result's modes.
pub(crate) fn shape_view(result: &ModesResult) -> ModeShapeView {
    let survey = &result.survey;
    let mut view = ModeShapeView {
        up: UpAxis::Y,
        amplitude: AMPLITUDE,
        figures: ShapeFigures::MeshAndModes,
        caption: Some(
            "Mode shapes: how the housing moves at each eigenfrequency. Look for where it moves most, which is where a support or a rib acts, and for nodes at rest, where a sensor is blind".to_owned(),
        ),
        ..ModeShapeView::new("Mode shapes")
    };
    if let Some((mesh, model)) = result.mesh_and_model() {
        add_surface(&mut view, mesh, model);
    }
    let no_surface = view.triangles.is_empty();
    for ring in &survey.rings {
        let first = view.points.len();
        view.points.extend(&ring.points);
        view.lines.push(ShapeLine {
            name: "ring".to_owned(),
            points: (first..first + ring.points.len()).collect(),
            closed: true,
        });
    }
    if no_surface {
        view.lines.clear();
        survey.rings.iter().for_each(|ring| add_band(&mut view, ring));
    }
    let (shapes, kinds) = (result.mode_shapes().shapes, kinds(survey));
    for mode in shown_order(survey) {
        let mut displacement = shapes[mode].as_chunks().0.to_vec();
        if no_surface {
            // both edges of a band move with their node
            displacement.extend(survey.rings.iter().flat_map(|ring| [&ring.displacements[mode]; 2]).flatten());
        }
        view.modes.push(ShapeMode {
            label: (mode + 1).to_string(),
            frequency_hz: survey.basis.frequencies_hz[mode],
            // the table of frequencies has the same words
            note: if kinds[mode] == ELASTIC { String::new() } else { kinds[mode].clone() },
            displacement,
        });
    }
    view.without_unused_points()
}

/// The modes in the order in which they are shown: elastic ones first, they are what one looks for.
fn shown_order(survey: &ModalSurvey) -> impl Iterator<Item = usize> {
    let rigid = survey.basis.rigid_modes;
    (rigid..survey.basis.count()).chain(0..rigid)
}

/// Place of each mode among those shown.
pub(crate) fn shown_places(survey: &ModalSurvey) -> Vec<Option<usize>> {
    let mut places = vec![None; survey.basis.count()];
    for (place, mode) in shown_order(survey).enumerate() {
        places[mode] = Some(place);
    }
    places
}

/// A ring alone as a band along its axis z, a line has no surface.
fn add_band(view: &mut ModeShapeView, ring: &RingShapes) {
    let nodes = ring.points.len();
    let reach = |point: &[f64; 3]| point[0].hypot(point[1]);
    let half = BAND * ring.points.iter().map(reach).fold(0.0, f64::max);
    let first = view.points.len();
    for side in [-half, half] {
        let edge = ring.points.iter().map(|point| [point[0], point[1], point[2] + side]);
        view.points.extend(edge);
    }
    view.groups.push(ShapeGroup { name: "ring".to_owned(), colour: 0 });
    for node in 0..nodes {
        let next = (node + 1) % nodes;
        let [a, b, c, d] = [node, next, nodes + next, nodes + node].map(|place| first + place);
        for corners in [[a, b, c], [a, c, d]] {
            view.triangles.push(ShapeTriangle { corners, group: 0 });
        }
        view.edges.extend([[a, b], [d, c], [a, d]]);
    }
}

fn add_surface(view: &mut ModeShapeView, mesh: &Mesh, model: &HousingModel) {
    view.points.clone_from(&mesh.nodes);
    let dimension = model.dimension();
    let ids = || mesh.element_ids(dimension);
    let faces: Vec<BoundaryFace> = match dimension {
        3 => mesh.boundary_faces(ids()),
        _ => ids().filter_map(|id| plane_face(mesh, id)).collect(),
    };
    // a model's elements are those of the highest dimension, in the order of the mesh
    let parts: BTreeMap<ElementId, usize> = ids().zip(model.elements().iter().map(|element| element.part)).collect();
    let named = named_faces(mesh, dimension);
    // parts first, then the groups of faces that were met
    let mut groups: Vec<String> = model.part_groups();
    for face in &faces {
        let mut corners = face.nodes[..face.kind.corners()].to_vec();
        corners.sort_unstable();
        let part = parts.get(&face.element);
        let group = match named.get(&corners) {
            Some(&name) => groups.iter().position(|group| group == name).unwrap_or_else(|| {
                groups.push(name.to_owned());
                groups.len() - 1
            }),
            None => part.copied().unwrap_or_default(),
        };
        for corners in triangles(face.kind) {
            let corners = corners.map(|local| face.nodes[local]);
            view.triangles.push(ShapeTriangle { corners, group });
        }
        for side in face.kind.faces() {
            let along: Vec<usize> = side.nodes.iter().map(|&local| face.nodes[local]).collect();
            match along.as_slice() {
                [a, b, middle] => view.edges.extend([[*a, *middle], [*middle, *b]]),
                [a, b] => view.edges.push([*a, *b]),
                _ => {}
            }
        }
    }
    for edge in &mut view.edges {
        edge.sort_unstable();
    }
    view.edges.sort_unstable();
    view.edges.dedup();
    view.groups = groups.into_iter().enumerate().map(|(colour, name)| ShapeGroup { name, colour }).collect();
}

/// A plane element as its own face.
fn plane_face(mesh: &Mesh, element: ElementId) -> Option<BoundaryFace> {
    let block = mesh.blocks.get(element.block)?;
    Some(BoundaryFace { element, kind: block.kind, nodes: block.element(element.index)?.to_vec() })
}

/// Names of the groups of faces, by the corners of a face.
fn named_faces(mesh: &Mesh, dimension: usize) -> BTreeMap<Corners, &str> {
    let mut named = BTreeMap::new();
    for group in mesh.groups.iter().filter(|group| dimension == 3 && group.dimension == 2) {
        for &id in &group.elements {
            let block = &mesh.blocks[id.block];
            let nodes = block.element(id.index).unwrap_or_default();
            let mut corners = nodes[..block.kind.corners().min(nodes.len())].to_vec();
            corners.sort_unstable();
            named.insert(corners, group.name.as_str());
        }
    }
    named
}

/// A face in triangles of its local nodes, mid nodes included.
fn triangles(kind: ElementKind) -> &'static [[usize; 3]] {
    match kind {
        ElementKind::Tri3 => &[[0, 1, 2]],
        ElementKind::Tri6 => &[[0, 3, 5], [3, 1, 4], [5, 4, 2], [3, 4, 5]],
        ElementKind::Quad4 => &[[0, 1, 2], [0, 2, 3]],
        ElementKind::Quad8 => &[[0, 4, 7], [4, 1, 5], [5, 2, 6], [6, 3, 7], [4, 5, 6], [4, 6, 7]],
        ElementKind::Quad9 => &[[0, 4, 8], [4, 1, 8], [1, 5, 8], [5, 2, 8], [2, 6, 8], [6, 3, 8], [3, 7, 8], [7, 0, 8]],
        _ => &[],
    }
}
