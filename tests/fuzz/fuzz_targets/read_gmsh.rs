//! Any bytes: an error with a message or a sound mesh, never a panic.

#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use plummer::fe::mesh::Mesh;
use plummer::numerics::units::LengthUnit;

fuzz_target!(|bytes: &[u8]| {
    match Mesh::from_bytes(bytes, Path::new("fuzz.msh"), LengthUnit::Millimetre) {
        Ok(mesh) => check(&mesh),
        // the walk accepts what mshio cannot read: the two must agree
        Err(error) => {
            let message = error.to_string();
            assert!(!message.ends_with("expected what the MSH 4.1 format prescribes"), "mshio disagrees: {message}");
            assert!((1..1000).contains(&message.len()));
        }
    }
});

/// What later stages rely on.
fn check(mesh: &Mesh) {
    let nodes = mesh.nodes.len();
    assert!(nodes > 0 && mesh.node_tags.len() == nodes);
    assert!(mesh.nodes.iter().flatten().all(|x| x.is_finite()));
    for block in &mesh.blocks {
        assert_eq!(block.connectivity.len(), block.len() * block.kind.nodes());
        assert!(block.connectivity.iter().all(|&node| node < nodes));
        assert_eq!(block.kind.dimension(), block.entity.dimension);
    }
    for group in &mesh.groups {
        assert!(group.nodes.is_sorted_by(|a, b| a < b));
        assert!(group.elements.is_sorted_by(|a, b| a < b));
        assert!(group.nodes.iter().all(|&node| node < nodes));
        assert!(group.elements.iter().all(|id| id.index < mesh.blocks[id.block].len()));
    }
    let inventory = mesh.inventory();
    assert_eq!(inventory.nodes, nodes);
    for (number, block) in mesh.blocks.iter().enumerate() {
        let ids = (0..block.len()).map(|index| plummer::fe::mesh::ElementId { block: number, index });
        let faces = mesh.boundary_faces(ids);
        assert!(faces.iter().flat_map(|face| &face.nodes).all(|&node| node < nodes));
    }
}
