//! Reference: a list of triplets added up one after the other; the same assembly on another number of threads.
//! Goal: pattern from the node graph, element matrices in parallel, sums that depend on the model alone.
//! Sketch: two blocks tied by springs and carrying a mass; the annulus of Tet10, free.
//! Conditions: base fixed (which does not change the matrices).
//! Parameters: aluminium, E 70 GPa, nu 0.33, rho 2700.
//!
//! Limits: bit for bit between threads; 1e-12 of the largest entry against triplets, which sum in another order.

use crate::reference_frequencies::data;
use plummer::fe::assembly::SystemMatrices;
use plummer::fe::element::continuum::{ContinuumProperties, Formulation, mass, stiffness};
use plummer::fe::material::{ElasticMaterial, Material};
use plummer::fe::mesh::{ElementBlock, ElementId, ElementKind, Entity, Mesh, PhysicalGroup};
use plummer::fe::model::{
    Connection, HousingDescription, HousingModel, HousingPart, HousingSupport, Link, PointMass, SpringStiffness,
    SupportShare,
};
use plummer::numerics::linalg::{SparseMatrix, TripletBuilder};
use plummer::numerics::units::LengthUnit;

fn aluminium() -> ElasticMaterial {
    Material::new(70e9, 0.33, 2700.0).unwrap().into()
}

fn part(group: &str) -> HousingPart {
    HousingPart { group: group.to_owned(), material: aluminium() }
}

/// Two blocks with springs to the ground and between them, and a mass on top.
fn blocks() -> HousingModel {
    let mesh = Mesh::read_gmsh(&data("two_blocks.msh"), LengthUnit::Millimetre).unwrap();
    let springs = SpringStiffness::Global([1e6, 2e6, 3e6]);
    let ground = HousingSupport {
        group: "base".to_owned(),
        constraint: plummer::fe::model::Constraint::Spring(springs),
        share: SupportShare::PerGroup,
    };
    let link = Link {
        between: ["foot", "seat"].map(str::to_owned),
        connection: Connection::Spring(springs, SupportShare::PerNode),
    };
    let mass = PointMass { group: "top".to_owned(), mass: 1e-3 };
    let description = HousingDescription {
        parts: vec![part("lower"), part("upper")],
        supports: vec![ground],
        links: vec![link],
        masses: vec![mass],
        ..HousingDescription::default()
    };
    HousingModel::new(&mesh, description).unwrap()
}

fn annulus() -> HousingModel {
    let mesh = Mesh::read_gmsh(&data("ring3d_tet10.msh"), LengthUnit::Metre).unwrap();
    let description = HousingDescription { parts: vec![part("housing")], ..HousingDescription::default() };
    HousingModel::new(&mesh, description).unwrap()
}

fn on_threads(threads: usize, model: &HousingModel) -> SystemMatrices {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.unwrap().install(|| SystemMatrices::assemble(model).unwrap())
}

fn bits(matrix: &SparseMatrix) -> Vec<u64> {
    matrix.data().iter().map(|value| value.to_bits()).collect()
}

#[test]
fn the_number_of_threads_does_not_change_a_bit() {
    for model in [blocks(), annulus()] {
        let one = on_threads(1, &model);
        for threads in [2, 3, 8] {
            let several = on_threads(threads, &model);
            assert_eq!(one.stiffness.indices(), several.stiffness.indices());
            assert_eq!(bits(&one.stiffness), bits(&several.stiffness), "{threads}");
            assert_eq!(bits(&one.mass), bits(&several.mass), "{threads}");
        }
    }
}

#[test]
fn a_list_of_triplets_adds_up_to_the_same() {
    let model = annulus();
    let found = SystemMatrices::assemble(&model).unwrap();
    let properties = ContinuumProperties::solid(&aluminium());
    let mut k = TripletBuilder::new(model.dof(), model.dof());
    let mut m = TripletBuilder::new(model.dof(), model.dof());
    for element in model.elements().iter() {
        let nodes = model.elements().nodes(element);
        let at: Vec<[f64; 3]> = nodes.iter().map(|&node| model.coordinates()[node]).collect();
        let own_k = stiffness(element.kind, &at, &properties, Formulation::default()).unwrap();
        let own_m = mass(element.kind, &at, &properties, Formulation::default()).unwrap();
        for (a, &row) in nodes.iter().enumerate() {
            for (b, &column) in nodes.iter().enumerate() {
                for i in 0..3 {
                    m.add(3 * row + i, 3 * column + i, own_m[(3 * a + i, 3 * b + i)]);
                    for j in 0..3 {
                        let value = own_k[(3 * a + i, 3 * b + j)];
                        k.add(3 * row + i, 3 * column + j, value);
                    }
                }
            }
        }
    }
    for (found, listed) in [(&found.stiffness, k.build()), (&found.mass, m.build())] {
        let largest = |matrix: &SparseMatrix| {
            let size = |size: f64, value: &f64| size.max(value.abs());
            matrix.data().iter().fold(0.0, size)
        };
        let difference: SparseMatrix = found - &listed;
        let ratio = largest(&difference) / largest(&listed);
        assert!(ratio < 1e-12, "{ratio:e}");
        assert_eq!(found.nnz(), listed.nnz());
    }
}

/// A mass of one gram and springs spread over a face: their sums, whatever the mesh.
#[test]
fn what_is_spread_over_a_face_adds_up() {
    let (with, without) = (blocks(), {
        let mesh = Mesh::read_gmsh(&data("two_blocks.msh"), LengthUnit::Millimetre).unwrap();
        let description =
            HousingDescription { parts: vec![part("lower"), part("upper")], ..HousingDescription::default() };
        HousingModel::new(&mesh, description).unwrap()
    });
    let loaded = SystemMatrices::assemble(&with).unwrap();
    let bare = SystemMatrices::assemble(&without).unwrap();
    let added = loaded.total_mass() - bare.total_mass();
    assert!((added / 1e-3 - 1.0).abs() < 1e-10, "{added}");
    // a translation along y feels the springs to the ground alone, all of them
    let (mut force, mut bending): (f64, f64) = (0.0, 0.0);
    for (column, entries) in loaded.stiffness.outer_iterator().enumerate() {
        for (row, value) in entries.iter() {
            if column % 3 == 1 && row % 3 == 1 {
                force += value;
            } else if column % 3 == 1 {
                bending += value;
            }
        }
    }
    // sums of 1e5 entries, which cancel: 1e3 times the rounding of the largest
    let stiffest = loaded.stiffness.data().iter().fold(0.0_f64, |k, v| k.max(*v));
    assert!((force - 2e6).abs() < 1e-12 * stiffest * 1e3, "{force}");
    assert!(bending.abs() < 1e-12 * stiffest * 1e3, "{bending}");
}

/// An edge that leads away from the housing carries nothing: a stiffness spread over it would vanish silently.
#[test]
fn a_group_without_a_whole_element_on_the_housing_is_refused() {
    let mut mesh = Mesh::read_gmsh(&data("one_block.msh"), LengthUnit::Millimetre).unwrap();
    let (on, off) = (0, mesh.nodes.len());
    mesh.nodes.push([0.0, 0.0, -1.0]);
    mesh.node_tags.push(1_000_000);
    let entity = Entity { dimension: 1, tag: 99 };
    mesh.blocks.push(ElementBlock {
        kind: ElementKind::Line2,
        tags: vec![1_000_000],
        connectivity: vec![on, off],
        entity,
    });
    let (block, index) = (mesh.blocks.len() - 1, 0);
    mesh.groups.push(PhysicalGroup {
        name: "loose end".to_owned(),
        dimension: 1,
        tag: 99,
        nodes: vec![on, off],
        elements: vec![ElementId { block, index }],
    });
    let refusal = |share| {
        let stiffness = SpringStiffness::Global([1e6; 3]);
        let description = HousingDescription {
            parts: vec![part("block")],
            supports: vec![HousingSupport {
                group: "loose end".to_owned(),
                constraint: plummer::fe::model::Constraint::Spring(stiffness),
                share,
            }],
            ..HousingDescription::default()
        };
        HousingModel::new(&mesh, description).map_err(|error| error.to_string())
    };
    let message = refusal(SupportShare::PerGroup).unwrap_err();
    assert!(
        message.ends_with("no part of it belongs to an element of the housing, so the support would hang on nothing"),
        "{message}"
    );
    // a spring at each node finds the one that is on the housing
    assert_eq!(refusal(SupportShare::PerNode).unwrap().spring_nodes(), [on]);
}
