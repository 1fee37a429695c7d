//! Centre nodes of bores as the interface of a case's housing.

use super::housing::AssembledHousing;
use crate::app::case;
use crate::app::error::ComputeError;
use crate::fe::model::{CentreNode, HousingPartition};
use crate::formats::{DofBody, DofDirection, DofLabel};
use crate::numerics::linalg::DenseMatrix;

/// Centre nodes of bores, one after the other.
#[derive(Debug, Clone)]
pub struct Centres {
    /// Each with the group of its bore.
    pub nodes: Vec<(String, CentreNode)>,
    partition: HousingPartition,
}

impl Centres {
    /// The centre nodes that a case asks for.
    ///
    /// # Errors
    /// [`ComputeError::Model`] for bores that have none, and that share nodes.
    pub(super) fn of(housing: &AssembledHousing, asked: &[case::Centre]) -> Result<Self, ComputeError> {
        let AssembledHousing { mesh, model, .. } = housing;
        let node = |centre: &case::Centre| {
            let node = CentreNode::new(mesh, model, &centre.group, centre.point, centre.tie)?;
            Ok((centre.group.clone(), node))
        };
        let nodes = asked.iter().map(node).collect::<Result<Vec<_>, ComputeError>>()?;
        let parts: Vec<_> = nodes.iter().map(|(group, node)| (group.as_str(), node.partition())).collect();
        let partition = HousingPartition::joined(model, &parts)?;
        Ok(Self { nodes, partition })
    }

    /// How the housing's degrees of freedom are split.
    pub(super) fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// Unit rigid motions of the whole housing at the nodes [coordinates x 3 or 6], about a point (m).
    pub(super) fn motions(&self, about: [f64; 3]) -> DenseMatrix {
        let in_space = self.nodes.iter().all(|(_, node)| node.dof() == 6);
        let motion = |index: usize| -> Vec<f64> {
            let (axis, turns) = if in_space { (index % 3, index >= 3) } else { ([0, 1, 2][index], index == 2) };
            let mut unit = [0.0; 3];
            unit[axis] = 1.0;
            let [x, y, z] = about;
            let (displacement, rotation) = match (turns, axis) {
                (false, _) => (unit, [0.0; 3]),
                // rotation x (0 - about)
                (true, 0) => ([0.0, z, -y], unit),
                (true, 1) => ([-z, 0.0, x], unit),
                (true, _) => ([y, -x, 0.0], unit),
            };
            self.nodes.iter().flat_map(|(_, node)| node.rigid_motion(displacement, rotation)).collect()
        };
        let motions: Vec<Vec<f64>> = (0..if in_space { 6 } else { 3 }).map(motion).collect();
        DenseMatrix::from_fn(self.partition.tie.cols(), motions.len(), |row, column| motions[column][row])
    }

    /// Labels of the coordinates.
    pub(super) fn labels(&self) -> Vec<DofLabel> {
        let of_node = |(place, (_, node)): (usize, &(String, CentreNode))| {
            let directions: &[(DofDirection, usize)] = match node.dof() {
                6 => &[
                    (DofDirection::Along(0), 0),
                    (DofDirection::Along(1), 1),
                    (DofDirection::Along(2), 2),
                    (DofDirection::About(0), 0),
                    (DofDirection::About(1), 1),
                    (DofDirection::About(2), 2),
                ],
                _ => &[(DofDirection::Along(0), 0), (DofDirection::Along(1), 1), (DofDirection::About(2), 2)],
            };
            let label = |&(direction, along): &(DofDirection, usize)| {
                let mut axis = [0.0; 3];
                axis[along] = 1.0;
                DofLabel { body: DofBody::Centre, node: place as u64, direction, position: node.point, axis }
            };
            directions.iter().map(label).collect::<Vec<_>>()
        };
        self.nodes.iter().enumerate().flat_map(of_node).collect()
    }
}
