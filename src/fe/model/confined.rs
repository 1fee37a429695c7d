//! Single elements of first order between held faces, of a material that hardly changes its volume: a rubber pad between metals.
//!
//! What is pressed out between the faces bulges at the sides. The nodes of one element between them cannot bulge, and bubbles
//! leave the mean change of its volume as it is. So it is as stiff against pressure as the bulk. Two elements are enough.

use super::HousingModel;

/// Lame's first constant over the shear modulus from which on the layer is told: a Poisson's ratio of 0.398. Measured were six
/// frequencies of a block on a pad of one Hex8. They are up to 12 % too high at a ratio of 0.3, 26 % at 0.4, 56 % at 0.45 and 126 %
/// at 0.48. With two Hex8 they are up to 6 % too high.
const VOLUME_KEEPS: f64 = 3.9;

/// Single elements of first order between held faces.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Confined {
    /// Index of the part of the first one.
    pub part: usize,
    /// How many there are, > 0.
    pub elements: usize,
    /// gmsh's tag of the first one.
    pub tag: u64,
}

impl HousingModel {
    /// Elements that are too stiff against pressure between held faces; `None` without.
    pub(crate) fn confined(&self) -> Option<Confined> {
        let keeps: Vec<bool> = self.properties.iter().map(|own| own.lame_over_shear() >= VOLUME_KEEPS).collect();
        if !keeps.contains(&true) {
            return None;
        }
        let holds = self.holds();
        let is_confined = |index: &usize| {
            self.storeys(*index).iter().any(|storey| {
                let height = (self.mean(&storey.top) - self.mean(&storey.bottom)).norm();
                let ply = self.ply(&self.elements.list[*index], &storey.bottom);
                [&storey.bottom, &storey.top].iter().all(|face| self.held(face, ply, &holds) * height >= ply.shear)
            })
        };
        let own = (0..self.elements.len()).filter(|&index| keeps[self.elements.list[index].part]);
        let found: Vec<usize> = own.filter(is_confined).collect();
        let first = &self.elements.list[*found.first()?];
        Some(Confined { part: first.part, elements: found.len(), tag: first.tag })
    }
}
