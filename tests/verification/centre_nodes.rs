//! Reference: Exudyn 1.13.6 (`FEMinterface.ComputeHurtyCraigBamptonModes`, RBE2 and RBE3) on the same K and M, and CalculiX 2.20
//!   (`*RIGID BODY`, `*DISTRIBUTING COUPLING`) on the same mesh; docs/python/centre_exudyn.py and centre_calculix.py repeat them.
//! Goal: centre nodes of bores, rigid and in the mean.
//! Sketch: the pedestal of meshes/pedestal.msh, Tet10; centre nodes in the bore and at the feet.
//! Conditions: free, both centres held; feet held, and a mass of 50 g or springs at the centre of the bore.
//! Parameters: 70 GPa, 0.33, 2700 kg/m^3.
//!
//! Exudyn prints nine digits: limit 1e-8 of the fixed-interface modes, of those on the same number of modes 1e-7, whose values
//! its static modes round. CalculiX integrates with four points, the mass too, and prints seven digits: limit 1e-4.
//!
//! `*DISTRIBUTING COUPLING` is the mean displacement of the nodes alone: its reference node has no rotation, and it does not
//! matter where the node is. That is a mean centre in the middle of its nodes without moments. `*COUPLING` with `*DISTRIBUTING` carries
//! loads only; a mass or a spring on its reference node has no effect there.

use plummer::fe::assembly::SystemMatrices;
use plummer::fe::element::continuum::{Formulation, Integration};
use plummer::fe::material::Material;
use plummer::fe::mesh::Mesh;
use plummer::fe::model::{
    CentreNode, CentreTie, Constraint, HousingDescription, HousingModel, HousingPart, HousingPartition, HousingSupport,
    SupportShare,
};
use plummer::fe::reduction::{
    Attached, BasisChoice, BasisSize, CraigBampton, InteriorBasis, Substructure, craig_bampton,
};
use plummer::numerics::linalg::{DenseMatrix, symmetric_generalised_eigen};
use plummer::numerics::units::LengthUnit;
use std::f64::consts::TAU;
use std::path::Path;

/// Means of the nodes, m.
const BORE: [f64; 3] = [-2.7044141631804253e-5, -4.127769562000267e-5, 3.7387613728153537e-6];
const FEET: [f64; 3] = [2.1431528471191147e-7, -0.013, 0.0001336425771000694];

/// Tie, its point, a mass there, springs along and about the axes, and frequencies in Hz.
type Case = (CentreTie, [f64; 3], f64, [[f64; 3]; 2], &'static [f64]);

struct Pedestal {
    mesh: Mesh,
    model: HousingModel,
    matrices: SystemMatrices,
}

fn pedestal(integration: Integration, held: bool) -> Pedestal {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/pedestal.msh");
    let mesh = Mesh::read_gmsh(&path, LengthUnit::Millimetre).unwrap();
    let material = Material::new(70e9, 0.33, 2700.0).unwrap().into();
    let feet = HousingSupport {
        group: "feet".to_owned(),
        constraint: Constraint::Fixed([true; 3]),
        share: SupportShare::PerNode,
    };
    let description = HousingDescription {
        parts: vec![HousingPart { group: "housing".to_owned(), material }],
        formulation: Formulation { integration, ..Formulation::default() },
        supports: if held { vec![feet] } else { Vec::new() },
        ..HousingDescription::default()
    };
    let model = HousingModel::new(&mesh, description).unwrap();
    let matrices = SystemMatrices::assemble(&model).unwrap();
    Pedestal { mesh, model, matrices }
}

impl Pedestal {
    fn partition(&self, centres: &[(&str, [f64; 3])], tie: CentreTie) -> HousingPartition {
        let made = centres.iter().map(|(group, point)| CentreNode::new(&self.mesh, &self.model, group, *point, tie));
        let made: Vec<CentreNode> = made.map(Result::unwrap).collect();
        let named = centres.iter().zip(&made).map(|((group, _), centre)| (*group, centre.partition()));
        HousingPartition::joined(&self.model, &named.collect::<Vec<_>>()).unwrap()
    }
}

fn hertz(values: &[f64]) -> Vec<f64> {
    values.iter().map(|value| value.abs().sqrt() / TAU).collect()
}

fn agree(what: &str, found: &[f64], expected: &[f64], limit: f64) {
    assert!(found.len() >= expected.len(), "{what}");
    for (found, expected) in found.iter().zip(expected) {
        assert!((found / expected - 1.0).abs() < limit, "{what}: {found} {expected}");
    }
}

#[test]
fn two_centres_of_a_free_housing_are_those_of_exudyn() {
    let pedestal = pedestal(Integration::Full, false);
    let expected: [(CentreTie, [f64; 12], [f64; 14]); 2] = [
        (
            CentreTie::Rigid,
            [
                133057.547, 133619.769, 144270.011, 144832.321, 147750.728, 152905.464, 153138.574, 160066.767,
                164658.805, 171078.791, 173619.883, 175231.409,
            ],
            [
                57101.1663, 67459.7825, 95572.0716, 111841.605, 119264.219, 148662.899, 153012.574, 154631.641,
                168966.508, 203538.336, 223421.933, 235882.647, 245801.059, 283045.694,
            ],
        ),
        (
            CentreTie::Mean,
            [
                34124.3982, 36717.94, 38859.3562, 44447.6119, 50530.1457, 54738.3399, 60771.1254, 64463.0724,
                65484.2747, 74183.5625, 77607.3515, 87194.5068,
            ],
            [
                18116.4905, 22080.2614, 24371.0721, 26186.0215, 37787.9254, 38554.4726, 39120.9574, 42067.8266,
                50293.4108, 52069.6461, 60844.8159, 77749.1079, 85246.8957, 86293.3613,
            ],
        ),
    ];
    for (tie, fixed, reduced) in expected {
        let partition = pedestal.partition(&[("bore", BORE), ("feet", FEET)], tie);
        let substructure = Substructure::new(&pedestal.matrices, &partition).unwrap();
        let pairs = substructure.lowest_modes(13).unwrap();
        agree(&format!("{tie:?}, held"), &hertz(&pairs.values[..12]), &fixed, 1e-8);
        let basis = InteriorBasis::of_modes(&substructure, &pairs, 12);
        let condensed = CraigBampton::new(substructure, basis, &pedestal.matrices.weight);
        let (k, m) = (&condensed.superelement.stiffness, &condensed.superelement.mass);
        let values = symmetric_generalised_eigen(k, m).unwrap().values;
        agree(&format!("{tie:?}, free"), &hertz(&values[6..]), &reduced, 1e-7);
    }
}

/// A rigid centre off the middle of the bore: alone, with a mass, with springs against displacements and rotations. A mean
/// centre in the middle: with the mass, with springs against displacements.
#[test]
fn a_bore_with_a_mass_or_springs_is_that_of_calculix() {
    let pedestal = pedestal(Integration::FourPoint, true);
    let off = [0.5e-3, 0.3e-3, 1e-3];
    let (mass, springs) = (0.05, [2e7, 5e7, 3e7]);
    let turning = [2e3, 4e3, 3e3];
    let none = [0.0; 3];
    let cases: [Case; 5] = [
        (CentreTie::Rigid, off, 0.0, [none; 2], &[22948.51, 39938.75, 49049.52]),
        (CentreTie::Rigid, off, mass, [none; 2], &[7962.26, 14132.57, 28124.16]),
        (CentreTie::Rigid, off, 0.0, [springs, turning], &[26237.56, 41458.47, 52863.66]),
        (CentreTie::Mean, BORE, mass, [none; 2], &[6454.97, 7563.76, 17471.13]),
        (CentreTie::Mean, BORE, 0.0, [springs, none], &[18407.68, 21260.56, 29896.21]),
    ];
    for (tie, point, mass, [along, about], expected) in cases {
        let partition = pedestal.partition(&[("bore", point)], tie);
        let part = |entry: &dyn Fn(usize) -> f64| {
            DenseMatrix::from_fn(6, 6, |row, column| if row == column { entry(row) } else { 0.0 })
        };
        let stiffness = part(&|k| if k < 3 { along[k] } else { about[k - 3] });
        let inertia = part(&|k| if k < 3 { mass } else { 0.0 });
        let attached = Attached { stiffness: &stiffness, mass: &inertia };
        let choice = BasisChoice { size: BasisSize::Auto(1e-5), enhanced: true, band_hz: 53e3 };
        let condensed = craig_bampton(&pedestal.matrices, &partition, choice, Some(attached)).unwrap();
        let (mut k, mut m) = (condensed.superelement.stiffness.clone(), condensed.superelement.mass.clone());
        for coordinate in 0..6 {
            k[(coordinate, coordinate)] += stiffness[(coordinate, coordinate)];
            m[(coordinate, coordinate)] += inertia[(coordinate, coordinate)];
        }
        let found = hertz(&symmetric_generalised_eigen(&k, &m).unwrap().values);
        agree(&format!("{tie:?} {mass} {along:?}"), &found, expected, 1e-4);
    }
}
