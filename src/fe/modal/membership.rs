//! Which physical groups the elements of a housing are in.

use super::error::{ModalError, check_count};
use crate::fe::mesh::Mesh;
use crate::fe::model::HousingModel;

/// Which physical groups each element belongs to.
pub(super) struct Membership {
    /// Groups of the elements' dimension, in the mesh's order.
    pub names: Vec<String>,
    /// Elements and their groups, ascending.
    pairs: Vec<(usize, usize)>,
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
        Ok(Self { names, pairs })
    }

    /// Groups of an element, as places in `names`.
    pub(super) fn of(&self, element: usize) -> impl Iterator<Item = usize> {
        let start = self.pairs.partition_point(|pair| pair.0 < element);
        self.pairs[start..].iter().take_while(move |pair| pair.0 == element).map(|pair| pair.1)
    }
}
