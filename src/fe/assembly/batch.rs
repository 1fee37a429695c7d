//! Element matrices in parallel, a batch at a time.

use super::pattern::Local;
use crate::fe::element::ElementError;
use crate::fe::mesh::ElementKind;
use crate::fe::model::{HousingElement, HousingModel, ModelError};
use rayon::prelude::*;

/// Matrix entries of a batch, 8 MB: small beside the matrices of a mesh, large beside the cost of starting
/// threads.
const BATCH: usize = 1 << 20;

/// Computes a matrix of `entries(kind)` entries for each element in parallel and hands them on in the order of
/// the elements.
///
/// # Errors
/// [`ModelError::Refused`] for the first element, in that order, for which `compute` fails.
pub(super) fn in_batches(
    model: &HousingModel,
    entries: impl Fn(ElementKind) -> usize,
    compute: impl Fn(&HousingElement, &[[f64; 3]], &mut [f64]) -> Result<(), ElementError> + Sync,
    mut consume: impl FnMut(&[Local<'_>]),
) -> Result<(), ModelError> {
    let mut buffer = Vec::new();
    let mut rest = model.elements.list.as_slice();
    while !rest.is_empty() {
        let mut total = 0;
        let fits = |element: &&HousingElement| {
            total += entries(element.kind);
            total <= BATCH
        };
        // at least one element, however large
        let count = rest.iter().take_while(fits).count().max(1);
        let (batch, others) = rest.split_at(count);
        rest = others;
        buffer.resize(batch.iter().map(|element| entries(element.kind)).sum(), 0.0);
        let mut work = Vec::with_capacity(batch.len());
        let mut free = buffer.as_mut_slice();
        for element in batch {
            let (own, after) = free.split_at_mut(entries(element.kind));
            work.push((element, own));
            free = after;
        }
        let failed = work.par_iter_mut().find_map_first(|(element, out)| {
            let mut coordinates = [[0.0; 3]; crate::fe::element::continuum::MAX_NODES];
            let nodes = model.elements.nodes(element);
            for (to, &node) in coordinates.iter_mut().zip(nodes) {
                *to = model.coordinates[node];
            }
            compute(element, &coordinates[..nodes.len()], out).err().map(|source| (element.tag, source))
        });
        if let Some((tag, source)) = failed {
            return Err(ModelError::element(&model.path, tag, &source));
        }
        let locals: Vec<Local<'_>> =
            work.iter().map(|(element, out)| Local { nodes: model.elements.nodes(element), matrix: out }).collect();
        consume(&locals);
    }
    Ok(())
}
