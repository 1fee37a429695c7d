use super::*;
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::material::{BeamSection, Bond, Material, RingLayer};
use crate::fe::mesh::{Mesh, MeshNotes, MshFormat, MshVersion};
use crate::fe::model::{HousingDescription, HousingPart, PlaneModel, RingFrame, RingSupport, SolidRing, SpringShare};
use crate::numerics::linalg::DenseMatrix;
use std::path::PathBuf;

const RADIUS: f64 = 0.05;
const SIDES: [f64; 2] = [0.01, 0.03];

fn steel() -> Material {
    Material::new(2.06e11, 0.3, 7850.0).expect("steel")
}

/// A ring of 12 nodes on springs along all axes, off its centroid line.
fn ring(in_space: bool) -> Ring {
    let layer = RingLayer {
        material: steel(),
        area: SIDES[0] * SIDES[1],
        inertia: SIDES[1] * SIDES[0].powi(3) / 12.0,
        axial_inertia: None,
        torsion: None,
        radius: RADIUS,
        shear_coefficient: 5.0 / 6.0,
    };
    let section = BeamSection::combine(&[layer], Bond::Composite).expect("a section");
    let ring = match in_space {
        true => Ring::in_space(12, section, RingInterpolation::ExactArc),
        false => Ring::new(12, section, RingInterpolation::ExactArc),
    };
    let mut ring = ring.expect("twelve nodes");
    let support =
        RingSupport { from: 0.3, to: 4.0, spring: [3e6, 2e6, 1e6], share: SpringShare::PerNode, offset: 4e-3 };
    ring.add_support(&support).expect("nodes there");
    ring
}

fn solid(dimension: usize, around: usize, frame: RingFrame) -> (MeshedRing, HousingModel) {
    let nothing = Mesh {
        nodes: Vec::new(),
        node_tags: Vec::new(),
        blocks: Vec::new(),
        groups: Vec::new(),
        format: MshFormat { version: MshVersion::V41, binary: false },
        notes: MeshNotes::default(),
        source: PathBuf::from("ring"),
    };
    let solid = SolidRing { radius: RADIUS, height: SIDES[0], width: SIDES[1], around, across: 2, along: 2 };
    let solid = solid.added_to(&nothing, &frame, dimension);
    let description = HousingDescription {
        parts: vec![HousingPart { group: solid.body.clone(), material: steel().into() }],
        plane: (dimension == 2).then_some(PlaneModel {
            assumption: crate::fe::element::continuum::PlaneAssumption::Stress,
            thickness: SIDES[1],
        }),
        frame,
        ..HousingDescription::default()
    };
    let model = HousingModel::new(&solid.mesh, description).expect("a model");
    (solid, model)
}

/// In every rigid motion the springs store the same energy on elements as on beams.
#[test]
fn rigid_motions_stretch_the_same_springs() {
    for dimension in [2, 3] {
        let (axis, zero) = match dimension {
            3 => ([1.0, 2.0, 3.0], [1.0, 0.0, 0.0]),
            _ => ([0.0, 0.0, -1.0], [0.3, 1.0, 0.0]),
        };
        let frame = RingFrame::new([0.5, -1.0, 2.0], axis, zero).expect("a frame");
        let ring = ring(dimension == 3);
        let (solid, mut model) = solid(dimension, 24, frame);
        model.attach_ring_springs(&solid, &ring).expect("a section at each node");
        for motion in 0..6 {
            let unit = |k: usize| f64::from(u8::from(motion == k));
            let along = Vector3::new(unit(0), unit(1), unit(2));
            let about = Vector3::new(unit(3), unit(4), unit(5)) / RADIUS;
            if dimension == 2 && [2, 3, 4].contains(&motion) {
                continue; // out of the plane
            }
            let d = ring.rigid_motion_in_space(along.into(), about.into());
            let on_beams = ring.strain_products(&DenseMatrix::from_fn(d.len(), 1, |row, _| d[row]));
            let moves = |node: usize| {
                let own = along + about.cross(&Vector3::from(model.ring_coordinates(node)));
                model.frame.vector_to_mesh(own.into())
            };
            let on_elements: f64 = model
                .springs
                .iter()
                .map(|spring| {
                    let nodes = spring.nodes.iter();
                    let u = nodes.flat_map(|&node| moves(node)[..dimension].to_vec());
                    let u = DVector::from_iterator(spring.matrix.nrows(), u);
                    (&spring.matrix * &u).dot(&u)
                })
                .sum();
            let expected = on_beams.springs[(0, 0)];
            assert!(expected > 1e6);
            // sums of a few hundred products
            assert!((on_elements / expected - 1.0).abs() < 1e-12, "{dimension} {motion}: {on_elements} {expected}");
        }
    }
}

#[test]
fn a_spring_between_two_sections_is_refused() {
    let ring = ring(false);
    let (solid, mut model) = solid(2, 16, RingFrame::default());
    let refused = model.attach_ring_springs(&solid, &ring).map_err(|error| error.to_string());
    let expected = "springs at 12 ring nodes need as many sections of the solid ring or a multiple, found 16";
    assert_eq!(refused, Err(expected.to_owned()));
}
