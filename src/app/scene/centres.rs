//! Centre nodes of bores as the interface of a case's housing.

use super::housing::AssembledHousing;
use crate::app::case;
use crate::app::error::ComputeError;
use crate::fe::model::{CentreNode, HousingModel, HousingPartition, RingTie, Rings};
use crate::fe::reduction::Attached;
use crate::formats::DofLabel;
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
        let node = |(place, centre): (usize, &case::Centre)| {
            let node = CentreNode::new(mesh, model, &centre.group, centre.point, centre.tie)
                .map_err(|error| ComputeError::from(error).of_key(&format!("condense.interface.centres[{place}]")))?;
            Ok((centre.group.clone(), node))
        };
        let nodes = asked.iter().enumerate().map(node).collect::<Result<Vec<_>, ComputeError>>()?;
        let parts: Vec<_> = nodes.iter().map(|(group, node)| (group.as_str(), node.partition())).collect();
        let partition = HousingPartition::joined(model, &parts)?;
        Ok(Self { nodes, partition })
    }

    /// How the housing's degrees of freedom are split.
    pub(super) fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// Unit rigid motions of the whole housing at the nodes, along and about axes through a point (m) [coordinates x 3 or 6].
    pub(super) fn motions(&self, about: [f64; 3]) -> DenseMatrix {
        let kinds = self.nodes.first().map_or(&[][..], |(_, node)| node.coordinates());
        let [x, y, z] = about;
        // a turn about the point carries the mesh's origin by rotation x (0 - about)
        let carried = [[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]];
        let motion = |&kind: &usize| -> Vec<f64> {
            let mut unit = [0.0; 3];
            unit[kind % 3] = 1.0;
            let (displacement, rotation) = if kind < 3 { (unit, [0.0; 3]) } else { (carried[kind % 3], unit) };
            self.nodes.iter().flat_map(|(_, node)| node.rigid_motion(displacement, rotation)).collect()
        };
        let motions: Vec<Vec<f64>> = kinds.iter().map(motion).collect();
        DenseMatrix::from_fn(self.partition.tie.cols(), motions.len(), |row, column| motions[column][row])
    }

    /// Labels of the coordinates.
    pub(super) fn labels(&self) -> Vec<DofLabel> {
        let of_node = |(place, (_, node)): (usize, &(String, CentreNode))| {
            let kinds = node.coordinates().iter();
            kinds.map(|&kind| DofLabel::centre(place as u64, kind, node.point)).collect::<Vec<_>>()
        };
        self.nodes.iter().enumerate().flat_map(of_node).collect()
    }
}

/// Rings in some bores and centre nodes of others: coordinates of the rings first.
#[derive(Debug, Clone)]
pub struct RingsAndCentres {
    /// The rings.
    pub rings: Rings,
    /// How they sit in their bores.
    pub tie: RingTie,
    /// The centre nodes.
    pub centres: Centres,
    partition: HousingPartition,
    /// Stiffness and mass of the rings over all coordinates.
    of_rings: [DenseMatrix; 2],
}

impl RingsAndCentres {
    /// Joins the two.
    ///
    /// # Errors
    /// [`ComputeError::Model`] for a node that belongs to both.
    pub(super) fn of(model: &HousingModel, rings: Rings, tie: RingTie, centres: Centres) -> Result<Self, ComputeError> {
        let partition = HousingPartition::joined(model, &[("ring", tie.partition()), ("centres", &centres.partition)])?;
        let (own, order) = (rings.dof(), partition.tie.cols());
        let of_rings = [rings.stiffness(), rings.mass()].map(|matrix| {
            DenseMatrix::from_fn(order, order, |row, column| match row.max(column) < own {
                true => matrix[(row, column)],
                false => 0.0,
            })
        });
        Ok(Self { rings, tie, centres, partition, of_rings })
    }

    /// How the housing's degrees of freedom are split.
    pub(super) fn partition(&self) -> &HousingPartition {
        &self.partition
    }

    /// What sits on the interface: the rings, nothing on the centre nodes.
    pub(super) fn attached(&self) -> Attached<'_> {
        let [stiffness, mass] = &self.of_rings;
        Attached { stiffness, mass }
    }
}

#[cfg(test)]
mod tests {
    use crate::app::case::{Case, Source};
    use crate::app::scene::{CondensedHousing, doubts_of_case};
    use crate::numerics::Unwatched;

    fn refused(case: &Case) -> String {
        let error = CondensedHousing::build(case, &Unwatched).unwrap_err();
        assert!(error.is_input(), "{error}");
        error.to_string()
    }

    fn with_centre(centre: &str) -> Case {
        let text = format!(
            "[housing]\nmesh = \"ring_6_9_coarse.msh\"\nlength_unit = \"mm\"\n\
             plane = {{ assumption = \"stress\", thickness = 4e-3 }}\n\
             parts = [{{ group = \"housing\", material = \"steel\" }}]\n\
             [condense]\ninterface = {{ centres = [{centre}] }}\n"
        );
        let path = format!("{}/meshes/small.toml", env!("CARGO_MANIFEST_DIR"));
        Case::from_source(Source { path: path.into(), text, set: Vec::new() }).unwrap()
    }

    #[test]
    fn a_centre_that_cannot_be_is_named_by_its_key() {
        let said = |centre: &str| refused(&with_centre(centre));
        let far = said("{ group = \"bore\", point = [1e200, 0, 0], tie = \"mean\" }");
        assert!(far.starts_with("condense.interface.centres[0]: ") && far.contains("give `point` in m"), "{far}");
    }

    #[test]
    fn a_centre_beside_its_bore_is_told() {
        // the bore has a radius of 6 mm: the box about it ends there, and the diagonal's tenth is 1.7 mm
        let told = |x: &str| {
            doubts_of_case(&with_centre(&format!("{{ group = \"bore\", point = [{x}, 0, 0], tie = \"rigid\" }}")))
                .unwrap()
        };
        let of_point =
            |x: &str| told(x).into_iter().filter(|doubt| doubt.contains("centres[0].point")).collect::<Vec<_>>();
        assert_eq!(of_point("7e-3"), Vec::<String>::new());
        let far = of_point("36e-3");
        // a node of the circle near the axis of x lies 2.6 um inside of it
        let said =
            "condense.interface.centres[0].point lies 0.0300026 m beside its bore \"bore\", which reaches from (";
        assert!(far.len() == 1 && far[0].starts_with(said), "{far:?}");
    }

    #[test]
    fn the_tie_of_one_of_several_rings_is_named_by_its_key() {
        let case = Case::example("housings/spindle_block", &["bearings[1].ring.outer_radius=6.5e-3"]);
        let said = refused(&case);
        assert!(said.starts_with("bearings[1].ring.tie: the tie finds no nodes"), "{said}");
    }
}
