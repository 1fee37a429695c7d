//! Tied nodes that do not lie on the face that they follow.

use super::bodies::{Bodies, at};
use super::facets::Facet;
use crate::fe::model::support::{TiedNode, sorted};
use crate::numerics::Brief;
use nalgebra::Vector3;
use std::collections::BTreeMap;

/// Nodes of a tie that are farther from the face that they follow than flat faces miss a curved surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Apart {
    /// Names of the groups that are tied.
    pub between: [String; 2],
    /// How many nodes, > 0.
    pub nodes: usize,
    /// Nodes that the link ties.
    pub tied: usize,
    /// Largest distance, m.
    pub distance: f64,
    /// The same over the size of the face.
    pub share: f64,
    /// gmsh's tag of that node.
    pub tag: u64,
    /// Its place, m.
    pub place: [f64; 3],
    /// Nodes within the body that they are tied to.
    pub inside: usize,
    /// Mass that would fill the space between the sides, and mass that counts twice where they lie in one another, kg;
    /// of the material of the tied nodes, where whole faces are apart.
    pub masses: [f64; 2],
}

impl Apart {
    /// What is apart where, in words; `unit` is that of lengths.
    pub fn sentence(&self, unit: &str) -> String {
        let [a, b] = &self.between;
        let inside = match self.inside {
            0 => String::new(),
            count => format!(", {count} of them into the other body"),
        };
        let [gap, twice] = self.masses.map(|mass| format!("{} kg", Brief::rounded(mass, 4)));
        let masses = match self.masses {
            [0.0, 0.0] => String::new(),
            [_, 0.0] => format!("; about {gap} of material would fill the gap"),
            [0.0, _] => format!("; about {twice} count twice"),
            _ => format!("; about {gap} of material would fill the gap, about {twice} count twice"),
        };
        format!(
            "the tie of \"{a}\" and \"{b}\" bridges up to {} m, {:.2} of the size of a face: {} of {} tied nodes are not on the other side{inside}, the farthest is node {} at {}{masses}",
            Brief::rounded(self.distance, 3),
            self.share,
            self.nodes,
            self.tied,
            self.tag,
            at(self.place, unit)
        )
    }
}

impl Bodies<'_> {
    /// The nodes of one link that are not on the face that they follow; `None` if all are. `density` is that of each
    /// part, kg/m^3, in the plane times the thickness.
    pub(in crate::fe::model) fn apart(
        &self,
        between: &[String; 2],
        tied: &[(usize, &TiedNode)],
        tags: &[u64],
        density: &[f64],
    ) -> Option<Apart> {
        let facets = self.facets();
        let mut reach = vec![0.0_f64; self.points.len()];
        let mut at_corners: BTreeMap<Vec<usize>, &Facet> = BTreeMap::new();
        for facet in &facets {
            for &node in &facet.corners {
                reach[node] = reach[node].max(facet.reach);
            }
            at_corners.insert(sorted(&facet.corners), facet);
        }
        let mut found: Option<Apart> = None;
        let mut heights: BTreeMap<usize, f64> = BTreeMap::new();
        for &(node, TiedNode { foot, .. }) in tied {
            let corners = &foot.nodes[..foot.kind.corners()];
            let facet = at_corners.get(&sorted(corners));
            let gap = Vector3::from(self.points[node]) - Vector3::from(foot.place);
            let distance = gap.norm();
            let of_face = corners.iter().map(|&corner| reach[corner]).fold(0.0, f64::max);
            let limit = self.tolerance + reach[node] + of_face;
            let height = facet.map_or(distance, |facet| facet.normal.dot(&gap));
            heights.insert(node, height);
            if distance <= limit {
                continue;
            }
            let apart =
                found.get_or_insert_with(|| Apart { between: between.clone(), tied: tied.len(), ..Apart::default() });
            apart.nodes += 1;
            apart.inside += usize::from(height < -limit);
            if distance > apart.distance {
                apart.distance = distance;
                apart.share = distance / foot.size;
                apart.tag = tags[node];
                apart.place = self.points[node];
            }
        }
        let mut apart = found?;
        for facet in &facets {
            let own: Option<Vec<f64>> = facet.corners.iter().map(|node| heights.get(node).copied()).collect();
            let Some(own) = own else { continue };
            let weight = density[self.solids[facet.solid].part] * facet.size / own.len() as f64;
            for height in own.into_iter().filter(|height| height.abs() > self.tolerance) {
                apart.masses[usize::from(height < 0.0)] += weight * height.abs();
            }
        }
        Some(apart)
    }
}
