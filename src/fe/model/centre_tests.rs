use super::*;
use crate::fe::material::Material;
use crate::fe::mesh::{ElementBlock, ElementId, ElementKind, Entity, MeshNotes, MshFormat, MshVersion, PhysicalGroup};
use crate::fe::model::{Constraint, HousingDescription, HousingPart, HousingSupport, SupportShare};
use std::path::PathBuf;

const POINT: [f64; 3] = [0.3, -0.2, 1.4];

/// One hexahedron with groups of its corners.
fn hexahedron(supports: Vec<HousingSupport>) -> (Mesh, HousingModel) {
    let corners: [[f64; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.1, 0.0],
        [1.1, 1.0, 0.0],
        [0.0, 0.9, 0.1],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.2],
        [1.0, 1.0, 1.0],
        [0.1, 1.0, 1.0],
    ];
    let mut mesh = Mesh {
        nodes: corners.to_vec(),
        node_tags: (1..=8).collect(),
        blocks: Vec::new(),
        groups: Vec::new(),
        format: MshFormat { version: MshVersion::V41, binary: false },
        notes: MeshNotes::default(),
        source: PathBuf::from("cell.msh"),
    };
    let groups: [(&str, &[usize]); 6] = [
        ("body", &[0, 1, 2, 3, 4, 5, 6, 7]),
        ("bore", &[4, 5, 6, 7]),
        ("two", &[0, 6]),
        ("one", &[3]),
        ("base", &[0, 1]),
        ("more", &[3, 4]),
    ];
    for (place, (name, nodes)) in groups.into_iter().enumerate() {
        let kind = if place == 0 { ElementKind::Hex8 } else { ElementKind::Point };
        let count = nodes.len() / kind.nodes();
        let (dimension, tag) = (kind.dimension(), place as i32 + 1);
        mesh.blocks.push(ElementBlock {
            kind,
            tags: (0..count as u64).map(|k| 10 * tag as u64 + k).collect(),
            connectivity: nodes.to_vec(),
            entity: Entity { dimension, tag },
        });
        let elements = (0..count).map(|index| ElementId { block: place, index }).collect();
        let mut nodes = nodes.to_vec();
        nodes.sort_unstable();
        mesh.groups.push(PhysicalGroup { name: name.to_owned(), dimension, tag, nodes, elements });
    }
    let material = Material::new(1.0, 0.3, 1.0).expect("a material").into();
    let parts = vec![HousingPart { group: "body".to_owned(), material }];
    let description = HousingDescription { parts, supports, ..HousingDescription::default() };
    let model = HousingModel::new(&mesh, description).expect("a model");
    (mesh, model)
}

fn centre(group: &str, tie: CentreTie) -> Result<CentreNode, ModelError> {
    let (mesh, model) = hexahedron(Vec::new());
    CentreNode::new(&mesh, &model, group, POINT, tie)
}

/// `W R = 1`, and W is the least-squares inverse: what a mean misses of a displacement is orthogonal to all rigid motions.
#[test]
fn a_mean_is_the_nearest_rigid_motion() {
    let (mesh, model) = hexahedron(Vec::new());
    let of = |tie| CentreNode::new(&mesh, &model, "bore", POINT, tie).expect("a centre");
    let (rigid, mean) = (of(CentreTie::Rigid), of(CentreTie::Mean));
    let (driven, r) = (&rigid.partition().driven, &rigid.partition().tie);
    let weights = &mean.partition().mean.weights;
    let w = |motion: usize, row: usize| weights.get(driven[row], motion).copied().unwrap_or(0.0);
    let r = |row: usize, motion: usize| r.get(row, motion).copied().unwrap_or(0.0);
    for motion in 0..6 {
        for other in 0..6 {
            let product: f64 = (0..driven.len()).map(|row| w(motion, row) * r(row, other)).sum();
            let expected = f64::from(u8::from(motion == other));
            assert!((product - expected).abs() < 1e-14, "{motion} {other}: {product}");
        }
    }
    // a displacement without pattern
    let u: Vec<f64> = (0..driven.len()).map(|row| ((row + 1) as f64 * 1.414).sin()).collect();
    let c: Vec<f64> = (0..6).map(|motion| (0..u.len()).map(|row| w(motion, row) * u[row]).sum()).collect();
    let left: Vec<f64> = (0..u.len()).map(|row| u[row] - (0..6).map(|k| r(row, k) * c[k]).sum::<f64>()).collect();
    for motion in 0..6 {
        let along: f64 = (0..u.len()).map(|row| r(row, motion) * left[row]).sum();
        assert!(along.abs() < 1e-13, "{motion}: {along}");
    }
    // the interior has every node of the bore that drives nothing
    assert_eq!(mean.partition().interior.len(), 24);
    assert_eq!(rigid.partition().interior.len(), 12);
}

#[test]
fn rigid_rows_turn_about_the_point() {
    let rigid = centre("bore", CentreTie::Rigid).expect("a centre");
    let turn = [0.2, -0.5, 0.7];
    let c = rigid.rigid_motion([0.0; 3], turn);
    let (_, model) = hexahedron(Vec::new());
    for (row, &dof) in rigid.partition().driven.iter().enumerate() {
        let x = model.coordinates()[dof / 3];
        let moved: Vector3<f64> = Vector3::from(turn).cross(&Vector3::from(x));
        let found: f64 = (0..6).map(|k| rigid.partition().tie.get(row, k).copied().unwrap_or(0.0) * c[k]).sum();
        assert!((found - moved[dof % 3]).abs() < 1e-15, "{dof}");
    }
}

#[test]
fn nodes_that_leave_a_rotation_open_are_refused() {
    for tie in [CentreTie::Rigid, CentreTie::Mean] {
        let message = |group: &str| centre(group, tie).expect_err("refused").to_string();
        let found = message("two");
        assert!(found.starts_with("cell.msh: the bore \"two\" has 2 nodes on the housing"), "{found}");
        assert!(message("one").contains("has 1 node on the housing"), "{}", message("one"));
    }
}

#[test]
fn nodes_in_a_line_are_refused() {
    let (mut mesh, _) = hexahedron(Vec::new());
    mesh.nodes[0] = [0.5, 0.5, 0.5];
    mesh.nodes[4] = [0.0, 0.0, 0.0];
    mesh.nodes[6] = [1.0, 1.0, 1.0];
    let group = mesh.groups.iter_mut().find(|group| group.name == "two").expect("there");
    group.nodes = vec![0, 4, 6];
    let (_, mut model) = hexahedron(Vec::new());
    model.coordinates = mesh.nodes.clone();
    let found = CentreNode::new(&mesh, &model, "two", POINT, CentreTie::Mean).expect_err("refused").to_string();
    assert!(found.contains("all 3 nodes of the bore \"two\" lie in one line"), "{found}");
}

#[test]
fn a_point_that_is_no_number_is_refused() {
    let (mesh, model) = hexahedron(Vec::new());
    let found = CentreNode::new(&mesh, &model, "bore", [0.0, f64::NAN, 1.0], CentreTie::Mean);
    let found = found.expect_err("refused").to_string();
    assert!(found.contains("the centre node of the bore \"bore\" is at (0, NaN, 1)"), "{found}");
}

#[test]
fn a_fixed_node_is_refused() {
    let constraint = Constraint::Fixed([true, false, false]);
    let support = HousingSupport { group: "more".to_owned(), constraint, share: SupportShare::PerNode };
    let (mesh, model) = hexahedron(vec![support]);
    let found = CentreNode::new(&mesh, &model, "bore", POINT, CentreTie::Mean).expect_err("refused").to_string();
    assert!(found.contains("node 5 is tied by group \"bore\" and fixed by group \"more\""), "{found}");
}

#[test]
fn a_node_of_two_interfaces_is_refused() {
    let (mesh, model) = hexahedron(Vec::new());
    for ties in [[CentreTie::Rigid, CentreTie::Mean], [CentreTie::Mean; 2]] {
        let of = |tie| CentreNode::new(&mesh, &model, "bore", POINT, tie).expect("a centre");
        let both = ties.map(of);
        let parts = [("one", both[0].partition()), ("other", both[1].partition())];
        let found = HousingPartition::joined(&model, &parts).expect_err("refused").to_string();
        assert!(found.starts_with("cell.msh: node 5 belongs to two interfaces, \"one\" and \"other\""), "{found}");
    }
}

#[test]
fn joined_interfaces_keep_their_coordinates() {
    let (mesh, model) = hexahedron(Vec::new());
    let mean = CentreNode::new(&mesh, &model, "bore", POINT, CentreTie::Mean).expect("a centre");
    let nodes = super::super::NodeInterface::new(&model, &[0, 2]);
    let parts = [("nodes", &nodes.partition), ("bore", mean.partition())];
    let joined = HousingPartition::joined(&model, &parts).expect("apart");
    assert_eq!((joined.tie.rows(), joined.tie.cols()), (6, 12));
    assert_eq!(joined.mean.coordinates, [6, 7, 8, 9, 10, 11]);
    assert_eq!(joined.mean.weights, mean.partition().mean.weights);
    assert_eq!(joined.interior.len(), 18);
    assert_eq!(joined.driven, [0, 1, 2, 6, 7, 8]);
}
