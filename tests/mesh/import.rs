//! Meshes as gmsh writes them: counts and groups against the geometry that they were made from.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use plummer::fe::element::continuum::measure;
use plummer::fe::mesh::{ElementKind, Mesh, MeshError};
use plummer::numerics::units::LengthUnit;

type Outcome = Result<(), MeshError>;

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn read(name: &str, unit: LengthUnit) -> Result<Mesh, MeshError> {
    Mesh::read_gmsh(&file(name), unit)
}

/// Nodes whose coordinates fulfil a condition, and nothing else, must be in the group.
fn assert_group(mesh: &Mesh, name: &str, inside: impl Fn(f64, f64) -> bool) -> Outcome {
    let group = mesh.group(name)?;
    let expected: Vec<usize> =
        (0..mesh.nodes.len()).filter(|&node| inside(mesh.nodes[node][0], mesh.nodes[node][1])).collect();
    assert!(!expected.is_empty(), "{name}: no node fulfils the condition");
    assert_eq!(group.nodes, expected, "{name} in {}", mesh.source.display());
    Ok(())
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

fn count(mesh: &Mesh, kind: ElementKind) -> usize {
    let elements = mesh.inventory().elements;
    elements.iter().find(|entry| entry.kind == kind).map_or(0, |entry| entry.count)
}

#[test]
fn reference_meshes_have_the_counts_of_their_reference() -> Outcome {
    let meshes = [
        ("fv32_quad8", ElementKind::Quad8, 433, 128),
        ("fv32_tri6", ElementKind::Tri6, 561, 256),
        ("ring2d_quad8", ElementKind::Quad8, 1008, 288),
        ("ring2d_tri6", ElementKind::Tri6, 1296, 576),
        ("ring2d_quad4_coarse", ElementKind::Quad4, 108, 72),
    ];
    for (name, kind, nodes, elements) in meshes {
        let mesh = read(&format!("tests/data/{name}.msh"), LengthUnit::Metre)?;
        assert_eq!(mesh.nodes.len(), nodes, "{name}");
        assert_eq!(count(&mesh, kind), elements, "{name}");
        assert_eq!(mesh.inventory().unused_nodes, 0, "{name}");
    }
    Ok(())
}

#[test]
fn ring_groups_are_where_the_geometry_says() -> Outcome {
    for name in ["ring2d_quad8", "ring2d_tri6", "ring2d_quad4_coarse", "ring2d_quad4_coarse_bin"] {
        let mesh = read(&format!("tests/data/{name}.msh"), LengthUnit::Metre)?;
        assert_group(&mesh, "bore", |x, y| near(x.hypot(y), 6e-3))?;
        assert_group(&mesh, "outer", |x, y| near(x.hypot(y), 9e-3))?;
        assert_group(&mesh, "outer_lower", |x, y| near(x.hypot(y), 9e-3) && y < 1e-9)?;
        assert_group(&mesh, "housing", |_, _| true)?;
    }
    Ok(())
}

#[test]
fn membrane_root_is_the_left_edge() -> Outcome {
    for name in ["fv32_quad8", "fv32_tri6"] {
        let mesh = read(&format!("tests/data/{name}.msh"), LengthUnit::Metre)?;
        assert_group(&mesh, "root", |x, _| near(x, 0.0))?;
        let extent = mesh.inventory().bounding_box.extent();
        assert!(near(extent[0], 10.0) && near(extent[1], 5.0) && near(extent[2], 0.0));
    }
    Ok(())
}

#[test]
fn gmsh_binary_reads_like_its_ascii() -> Outcome {
    let ascii = read("tests/data/ring2d_quad4_coarse.msh", LengthUnit::Metre)?;
    let binary = read("tests/data/ring2d_quad4_coarse_bin.msh", LengthUnit::Metre)?;
    // ASCII has 16 digits, binary all of them
    let pairs = ascii.nodes.iter().flatten().zip(binary.nodes.iter().flatten());
    assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-17));
    assert_eq!(ascii.node_tags, binary.node_tags);
    assert_eq!(ascii.blocks, binary.blocks);
    assert_eq!(ascii.groups, binary.groups);
    Ok(())
}

#[test]
fn example_rings_in_millimetres() -> Outcome {
    let rings = [
        ("ring_6_9", ElementKind::Quad8, 216),
        ("ring_6_9_coarse", ElementKind::Quad8, 40),
        ("ring_6_9_tri", ElementKind::Tri6, 452),
    ];
    for (name, kind, elements) in rings {
        let mesh = read(&format!("meshes/{name}.msh"), LengthUnit::Millimetre)?;
        assert_eq!(count(&mesh, kind), elements, "{name}");
        // middle nodes of curved edges are on the circle to rounding
        assert_group(&mesh, "bore", |x, y| (x.hypot(y) - 6e-3).abs() < 1e-15)?;
        assert_group(&mesh, "outer", |x, y| (x.hypot(y) - 9e-3).abs() < 1e-15)?;
        assert_group(&mesh, "lower", |x, y| near(x.hypot(y), 9e-3) && y < 1e-9)?;
        assert_group(&mesh, "top", |x, y| near(x, 0.0) && near(y, 9e-3))?;
        assert_group(&mesh, "housing", |_, _| true)?;
    }
    Ok(())
}

/// Distance in degrees from an angle to the nearest of the 72 nodes of a ring.
fn from_ring_node([x, y, _]: [f64; 3]) -> f64 {
    let steps = y.atan2(x).to_degrees() / 5.0;
    5.0 * (steps - steps.round()).abs()
}

#[test]
fn bores_match_a_ring_of_72_nodes_or_do_not() -> Outcome {
    let fine = read("meshes/ring_6_9.msh", LengthUnit::Millimetre)?;
    let bore = fine.group("bore")?;
    let matching = bore.nodes.iter().filter(|&&n| from_ring_node(fine.nodes[n]) < 1e-9);
    assert_eq!((bore.nodes.len(), matching.count()), (144, 72));
    let coarse = read("meshes/ring_6_9_coarse.msh", LengthUnit::Millimetre)?;
    let bore = coarse.group("bore")?;
    assert_eq!(bore.nodes.len(), 40);
    assert!(bore.nodes.iter().all(|&n| from_ring_node(coarse.nodes[n]) > 0.2));
    Ok(())
}

#[test]
fn pillow_block_stands_on_two_feet() -> Outcome {
    let mesh = read("meshes/pillow_block.msh", LengthUnit::Millimetre)?;
    assert!(mesh.nodes.len() < 3000);
    assert_eq!(count(&mesh, ElementKind::Tri6), 851);
    assert_group(&mesh, "bore", |x, y| (x.hypot(y) - 6e-3).abs() < 1e-15)?;
    let bolted = |x: f64| x.abs() > 11e-3 - 1e-9 && x.abs() < 19e-3 + 1e-9;
    assert_group(&mesh, "feet", |x, y| near(y, -13e-3) && bolted(x))?;
    assert_group(&mesh, "top", |x, y| near(x, 0.0) && near(y, 10e-3))?;
    assert_group(&mesh, "housing", |_, _| true)
}

/// Every element of the examples has a positive Jacobian, and together they fill the drawing (quadratic
/// edges on arcs miss its area by 2.0e-5 with 20 elements round, 1.2e-7 with 72).
#[test]
fn example_meshes_fill_their_drawings() -> Result<(), Box<dyn std::error::Error>> {
    let ring = PI * (81.0 - 36.0);
    let pillow_block = 44.0 * 5.0 + 20.0 * 8.0 + PI * 100.0 / 2.0 - PI * 36.0;
    let drawings =
        [("ring_6_9", ring), ("ring_6_9_coarse", ring), ("ring_6_9_tri", ring), ("pillow_block", pillow_block)];
    for (name, square_mm) in drawings {
        let mesh = read(&format!("meshes/{name}.msh"), LengthUnit::Millimetre)?;
        let mut total = 0.0;
        for block in &mesh.blocks {
            let surface = (block.kind.dimension() == 2).then_some(block.kind);
            for element in block.elements() {
                let coords: Vec<[f64; 3]> = element.iter().map(|&n| mesh.nodes[n]).collect();
                total += surface.map_or(Ok(0.0), |kind| measure(kind, &coords))?;
            }
        }
        let error = total / (square_mm * 1e-6) - 1.0;
        assert!(error.abs() < 3e-5, "{name}: {total} m^2, {error}");
    }
    Ok(())
}

#[test]
fn messages_name_the_file() {
    let message = |name: &str| match read(name, LengthUnit::Metre) {
        Ok(_) => "accepted".to_owned(),
        Err(error) => error.to_string(),
    };
    let missing = file("tests/data/missing.msh");
    assert_eq!(
        message("tests/data/missing.msh"),
        format!("cannot read the mesh {}: No such file or directory (os error 2)", missing.display())
    );
    let rust = file("tests/mesh/import.rs");
    assert_eq!(
        message("tests/mesh/import.rs"),
        format!(
            "{}: not a gmsh mesh: expected $MeshFormat at the start, found \"//! Meshes as gmsh writes them: \
             counts a\"",
            rust.display()
        )
    );
}

/// Each command was tried with gmsh 4.8.4.
#[test]
fn a_mesh_that_gmsh_converts_is_told_how() {
    for (name, start) in [("a.unv", "    -1\n"), ("a.BDF", "$ Nastran\n"), ("a.nas", "SOL 101\n"), ("a.vtk", "# vtk\n")]
    {
        let error = Mesh::from_bytes(start, Path::new(name), LengthUnit::Metre).unwrap_err().to_string();
        let ending = name[2..].to_lowercase();
        let command = format!("; convert it: gmsh IN.{ending} -save -format msh22 -o OUT.msh");
        assert!(error.starts_with(&format!("{name}: not a gmsh mesh")) && error.ends_with(&command), "{error}");
    }
}
