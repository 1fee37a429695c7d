//! mshio as an independent reader: every value of every 4.1 mesh among the test data, bit for bit.

use std::path::Path;

use crate::fe::mesh::Mesh;
use crate::numerics::units::LengthUnit;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Nodes and elements as both readers see them.
fn compare(path: &Path) -> Result<bool, Box<dyn std::error::Error>> {
    let bytes = std::fs::read(path)?;
    if !bytes.starts_with(b"$MeshFormat\n4.1") {
        return Ok(false);
    }
    let mesh = Mesh::from_gmsh_bytes(&bytes, path, LengthUnit::Metre)?;
    let file = mshio::parse_msh_bytes(&bytes).map_err(|error| error.to_string())?;
    let (nodes, elements) = (file.data.nodes.ok_or("nodes")?, file.data.elements.ok_or("elements")?);
    let blocks = nodes.node_blocks.iter();
    let coordinates: Vec<[u64; 3]> =
        blocks.flat_map(|block| &block.nodes).map(|node| [node.x, node.y, node.z].map(f64::to_bits)).collect();
    let own: Vec<[u64; 3]> = mesh.nodes.iter().map(|node| node.map(f64::to_bits)).collect();
    assert_eq!(own, coordinates, "{}", path.display());
    assert_eq!(mesh.blocks.len(), elements.element_blocks.len());
    for (own, other) in mesh.blocks.iter().zip(&elements.element_blocks) {
        assert_eq!(own.kind.gmsh_type(), other.element_type as i32);
        assert_eq!((own.entity.dimension as i32, own.entity.tag), (other.entity_dim, other.entity_tag));
        let tags: Vec<u64> = other.elements.iter().map(|element| element.element_tag).collect();
        assert_eq!(own.tags, tags);
        let tags: Vec<u64> = other.elements.iter().flat_map(|element| element.nodes.clone()).collect();
        let own: Vec<u64> = own.connectivity.iter().map(|&node| mesh.node_tags[node]).collect();
        assert_eq!(own, tags, "{}", path.display());
    }
    Ok(true)
}

#[test]
fn all_values_are_those_of_mshio() -> Outcome {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let mut count = 0;
    for entry in std::fs::read_dir(data)? {
        let path = entry?.path();
        let is_mesh = path.extension().is_some_and(|extension| extension == "msh");
        count += usize::from(is_mesh && compare(&path)?);
    }
    assert!(count >= 12, "{count}");
    Ok(())
}
