//! mshio as an independent reader: every value of every 4.1 mesh among the test data, bit for bit.

use std::path::Path;

use crate::fe::mesh::{ElementId, Mesh};
use crate::numerics::units::LengthUnit;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Nodes, elements and the elements of groups as both readers see them.
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
    let entities = file.data.entities.ok_or("entities")?;
    let mut physical: Vec<(usize, i32, &[i32])> = Vec::new();
    physical.extend(entities.points.iter().map(|point| (0, point.tag, point.physical_tags.as_slice())));
    physical.extend(entities.curves.iter().map(|curve| (1, curve.tag, curve.physical_tags.as_slice())));
    physical.extend(entities.surfaces.iter().map(|surface| (2, surface.tag, surface.physical_tags.as_slice())));
    physical.extend(entities.volumes.iter().map(|volume| (3, volume.tag, volume.physical_tags.as_slice())));
    for group in &mesh.groups {
        let of_group = physical.iter().filter(|(dimension, _, tags)| {
            *dimension == group.dimension && tags.iter().any(|tag| tag.abs() == group.tag)
        });
        let of_group: Vec<i32> = of_group.map(|&(_, tag, _)| tag).collect();
        let blocks = mesh
            .blocks
            .iter()
            .enumerate()
            .filter(|(_, block)| block.entity.dimension == group.dimension && of_group.contains(&block.entity.tag));
        let expected: Vec<ElementId> =
            blocks.flat_map(|(block, list)| (0..list.len()).map(move |index| ElementId { block, index })).collect();
        assert_eq!(group.elements, expected, "{}: {}", path.display(), group.name);
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
