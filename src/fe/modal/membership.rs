//! Which physical groups the elements of a housing are in.

use super::ModalError;
use super::error::check_count;
use crate::fe::mesh::Mesh;
use crate::fe::model::HousingModel;

/// Which physical groups each element belongs to.
pub(super) struct Membership {
    /// Groups of the elements' dimension, in the mesh's order.
    pub names: Vec<String>,
    /// Start of each element's list in `groups`, and the end of the last.
    starts: Vec<usize>,
    groups: Vec<usize>,
}

impl Membership {
    /// A model takes the elements of the highest dimension in the mesh's order, so that counting them block by
    /// block gives their place in it.
    pub(super) fn new(mesh: &Mesh, model: &HousingModel) -> Result<Self, ModalError> {
        let mut first = Vec::with_capacity(mesh.blocks.len());
        let mut count = 0;
        for block in &mesh.blocks {
            first.push(count);
            if block.kind.dimension() == model.dimension {
                count += block.len();
            }
        }
        check_count("elements of the mesh", model.elements.len(), count)?;
        let own = mesh.groups.iter().filter(|group| group.dimension == model.dimension);
        let mut pairs = Vec::new();
        let mut names = Vec::new();
        for group in own {
            for id in &group.elements {
                if let Some(start) = first.get(id.block) {
                    pairs.push((start + id.index, names.len()));
                }
            }
            names.push(group.name.clone());
        }
        pairs.sort_unstable();
        let starts = (0..=count).map(|element| pairs.partition_point(|pair| pair.0 < element)).collect();
        Ok(Self { names, starts, groups: pairs.into_iter().map(|pair| pair.1).collect() })
    }

    /// Groups of an element, as places in `names`.
    pub(super) fn of(&self, element: usize) -> &[usize] {
        let range = self.starts[element]..self.starts[element + 1];
        &self.groups[range]
    }
}
