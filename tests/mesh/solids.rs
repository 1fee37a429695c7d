//! Solid elements: every encoding of gmsh gives the same mesh, and their faces enclose their volume.

use std::path::{Path, PathBuf};

use plummer::fe::mesh::{BoundaryFace, ElementId, ElementKind, Mesh, MeshError};
use plummer::numerics::units::LengthUnit;

type Outcome = Result<(), MeshError>;

const CUBES: [(&str, ElementKind, usize); 3] =
    [("hex20", ElementKind::Hex20, 8), ("wedge15", ElementKind::Wedge15, 16), ("tet10", ElementKind::Tet10, 48)];

fn cube(name: &str, encoding: &str) -> Result<Mesh, MeshError> {
    let file = format!("tests/data/cube_{name}_{encoding}.msh");
    let path: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    Mesh::read_gmsh(&path, LengthUnit::Millimetre)
}

/// Elements of the blocks of a dimension.
fn of_dimension(mesh: &Mesh, dimension: usize) -> Vec<ElementId> {
    let blocks = mesh.blocks.iter().enumerate();
    let own = blocks.filter(|(_, block)| block.kind.dimension() == dimension);
    own.flat_map(|(number, block)| (0..block.len()).map(move |index| ElementId { block: number, index })).collect()
}

#[test]
fn every_encoding_gives_the_same_mesh() -> Outcome {
    for (name, kind, count) in CUBES {
        let expected = cube(name, "msh41_bin")?;
        let solids: usize = expected.blocks.iter().filter(|b| b.kind == kind).map(|b| b.len()).sum();
        assert_eq!(solids, count, "{name}");
        assert_eq!(of_dimension(&expected, 3).len(), count, "{name}");
        for encoding in ["msh41", "msh22", "msh22_bin"] {
            let found = cube(name, encoding)?;
            assert_eq!(found.format.binary, encoding.ends_with("bin"));
            assert_eq!(found.node_tags, expected.node_tags, "{name} {encoding}");
            assert_eq!(found.groups, expected.groups, "{name} {encoding}");
            let pairs = found.nodes.iter().flatten().zip(expected.nodes.iter().flatten());
            // ASCII has 16 digits
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-18), "{name} {encoding}");
            assert_eq!(found.blocks.len(), expected.blocks.len(), "{name} {encoding}");
            for (found, expected) in found.blocks.iter().zip(&expected.blocks) {
                assert_eq!((found.kind, found.entity), (expected.kind, expected.entity));
                assert_eq!(found.connectivity, expected.connectivity, "{name} {encoding}");
                assert_eq!(found.len(), expected.len());
            }
        }
    }
    Ok(())
}

/// Elements that 2.2 repeats for a second group are there once and belong to both.
#[test]
fn repeated_elements_are_one_of_several_groups() -> Outcome {
    for (name, _, count) in CUBES {
        let mesh = cube(name, "msh22")?;
        let [body, same] = ["body", "2"].map(|group| mesh.group(group));
        let (body, same) = (body?, same?);
        assert_eq!(body.elements.len(), count);
        assert_eq!((&body.elements, &body.nodes), (&same.elements, &same.nodes));
        let [support, contact] = ["support", "contact"].map(|group| mesh.group(group));
        let (support, contact) = (support?, contact?);
        assert!(support.elements.iter().all(|id| contact.elements.contains(id)));
        assert_eq!(contact.elements.len(), 2 * support.elements.len(), "{name}");
    }
    Ok(())
}

/// Volume inside flat-sided faces by the divergence theorem, sum of (x . n dA) / 3 over triangles of corners.
fn enclosed_volume(mesh: &Mesh, faces: &[BoundaryFace]) -> f64 {
    let mut total = 0.0;
    for face in faces {
        let corners: Vec<[f64; 3]> = face.nodes[..face.kind.corners()].iter().map(|&node| mesh.nodes[node]).collect();
        for end in 2..corners.len() {
            let [a, b, c] = [corners[0], corners[end - 1], corners[end]];
            total += (a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0]))
                / 6.0;
        }
    }
    total
}

fn distinct(items: impl Iterator<Item = [usize; 2]>) -> usize {
    let mut all: Vec<[usize; 2]> = items.collect();
    all.sort_unstable();
    all.dedup();
    all.len()
}

#[test]
fn surface_of_a_cube_is_closed_and_encloses_its_volume() -> Outcome {
    for (name, _, _) in CUBES {
        let mesh = cube(name, "msh41")?;
        let faces = mesh.boundary_faces(of_dimension(&mesh, 3).into_iter());
        let volume = enclosed_volume(&mesh, &faces);
        assert!((volume / 1e-9 - 1.0).abs() < 1e-12, "{name}: {volume}");
        let corners = |face: &BoundaryFace| face.nodes[..face.kind.corners()].to_vec();
        let vertices = distinct(faces.iter().flat_map(corners).map(|node| [node, node]));
        let edges: Vec<[usize; 2]> = faces
            .iter()
            .flat_map(|face| {
                let edges = face.kind.faces().iter();
                edges.map(|edge| [face.nodes[edge.nodes[0]], face.nodes[edge.nodes[1]]])
            })
            .collect();
        // every edge once in each direction
        assert_eq!(distinct(edges.iter().copied()), edges.len(), "{name}");
        assert!(edges.iter().all(|[a, b]| edges.contains(&[*b, *a])), "{name}");
        assert_eq!(vertices + faces.len(), edges.len() / 2 + 2, "{name}: Euler");
        // the plane elements of gmsh are among them
        let surface = mesh.group("contact")?;
        for id in &surface.elements {
            let block = &mesh.blocks[id.block];
            let mut nodes = block.element(id.index).unwrap_or_default().to_vec();
            nodes.sort_unstable();
            let same = faces.iter().filter(|face| {
                let mut own = face.nodes.clone();
                own.sort_unstable();
                own == nodes && face.kind == block.kind
            });
            assert_eq!(same.count(), 1, "{name}");
        }
    }
    Ok(())
}

/// Each solid by itself has positive volume: gmsh's node order is the one that the faces assume.
#[test]
fn faces_of_single_elements_lead_outwards() -> Outcome {
    for (name, _, count) in CUBES {
        let mesh = cube(name, "msh41")?;
        let mut total = 0.0;
        for id in of_dimension(&mesh, 3) {
            let volume = enclosed_volume(&mesh, &mesh.boundary_faces([id].into_iter()));
            assert!(volume > 1e-9 / count as f64 / 10.0, "{name}: {volume}");
            total += volume;
        }
        assert!((total / 1e-9 - 1.0).abs() < 1e-12, "{name}: {total}");
    }
    Ok(())
}

#[test]
fn rim_of_a_plane_mesh_runs_round_it() -> Outcome {
    let mesh = cube("hex20", "msh41")?;
    let support = mesh.group("support")?;
    let rim = mesh.boundary_faces(support.elements.iter().copied());
    assert_eq!(rim.len(), 8);
    assert!(rim.iter().all(|edge| edge.kind == ElementKind::Line3));
    let area: f64 = rim
        .iter()
        .map(|edge| [mesh.nodes[edge.nodes[0]], mesh.nodes[edge.nodes[1]]])
        .map(|[a, b]| (a[0] * b[1] - a[1] * b[0]) / 2.0)
        .sum();
    assert!((area.abs() / 1e-6 - 1.0).abs() < 1e-12, "{area}");
    Ok(())
}
