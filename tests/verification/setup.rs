//! Reference: Tadina and Boltezar 2011, table 1 (in SI; misprints put right) for bearing and outer ring.
//! Goal: the one bearing, the rings and the housings that the verification cases share.
//! Sketch: bearing with 7 balls in a steel ring; around it either an aluminium ring 6-9 mm as a second
//!   layer of the same beam, or as a plane mesh tied to the steel ring at its bore.
//!
//! ```text
//!            top (0, 9)                 y up, x right, gravity -y
//!          .-----------.                bore radius 6 mm, outside 9 mm
//!        .'  .-------.  '.              ring nodes at 0, 5, 10 ... degrees
//!        |  ( o  o  o )  |
//!        '.  '-------'  .'
//!          '-----------'   springs on the lower half
//! ```
//!
//! Conditions: shaft at rest, no dents, no contact damping unless a case says otherwise.
//! Parameters: steel 210 GPa (layer), 206 GPa (contacts, ring of a meshed housing), nu 0.3, 7850 kg/m^3;
//!   aluminium 72 GPa, nu 0.33, 2700 kg/m^3, 4 mm wide; shaft 0.15 kg.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use plummer::app::verification::BEARING;
use plummer::bearing::{BearingGeometry, Cage, ContactMaterial, RaceContacts, SlipProfile, SpeedProfile};
use plummer::fe::assembly::{CoupledMatrices, SystemMatrices};
use plummer::fe::element::continuum::PlaneAssumption;
use plummer::fe::element::curved_beam::RingInterpolation;
use plummer::fe::material::{BeamSection, Bond, Material, RadiusRule, RingLayer};
use plummer::fe::mesh::Mesh;
use plummer::fe::model::{
    Constraint, Fit, HousingDescription, HousingModel, HousingPart, HousingSupport, PlaneModel, Ring, RingSupport,
    RingTie, SpringShare, SpringStiffness, SupportShare,
};
use plummer::fe::reduction::{BasisChoice, BasisSize, Superelement, craig_bampton};
use plummer::numerics::linalg::{DenseMatrix, SparseMatrix};
use plummer::numerics::ode::State;
use plummer::numerics::ode::{Method, Schedule, Stepping, integrate};
use plummer::numerics::units::LengthUnit;
use plummer::system::{BallsInertia, BearingSetup, CoupledSystem, Formulation, Recorder, Shaft, Structure};

/// Standard gravity as the source rounds it, m/s^2.
pub const GRAVITY: [f64; 2] = [0.0, -9.81];

/// Angle of the first ball at which two balls stand symmetrically below the shaft, degrees.
pub const SYMMETRIC_DEG: f64 = 270.0 + 180.0 / 7.0;

/// Density of aluminium, kg/m^3.
pub const ALUMINIUM_DENSITY: f64 = 2700.0;

/// Thickness of the meshed housings, m.
pub const HOUSING_WIDTH: f64 = 4e-3;

/// Radius of the bore, m.
pub const BORE_RADIUS: f64 = 6e-3;

/// The meshes of the aluminium ring: matching the ring's nodes, not matching, triangles.
pub const MESHES: [&str; 3] = ["ring_6_9", "ring_6_9_coarse", "ring_6_9_tri"];

fn layer(young: f64, poisson: f64, density: f64, size: [f64; 3]) -> RingLayer {
    let [area, inertia, radius] = size;
    RingLayer {
        material: Material::new(young, poisson, density).unwrap(),
        area,
        inertia,
        axial_inertia: None,
        torsion: None,
        radius,
        shear_coefficient: 5.0 / 6.0,
    }
}

/// Steel ring alone, free, 72 nodes.
pub fn steel_ring() -> Ring {
    let steel = layer(206e9, 0.3, 7850.0, [5.37e-6, 8.88e-13, 5.314e-3]);
    let section = BeamSection::combine(&[steel], Bond::Slip(RadiusRule::Own)).unwrap();
    Ring::new(72, section, RingInterpolation::ExactArc).unwrap()
}

/// Steel and aluminium ring on the common centroid radius, without shear: the section that reproduces
/// the source's 36 kHz.
pub fn paper_section() -> BeamSection {
    let layers = [
        layer(210e9, 0.3, 7850.0, [5.37e-6, 8.88e-13, 5.314e-3]),
        layer(72e9, 0.33, ALUMINIUM_DENSITY, [12e-6, 9e-12, 7.5e-3]),
    ];
    let bond = Bond::Slip(RadiusRule::CommonCentroid);
    BeamSection::combine(&layers, bond).unwrap().without_shear()
}

/// The source's ring on 36 springs of 1e5 N/m in x and y over its lower half, `offset` (m) outside
/// the node radius; with another number of nodes the same total stiffness.
pub fn paper_ring(nodes: usize, offset: f64) -> Ring {
    let mut ring = Ring::new(nodes, paper_section(), RingInterpolation::ExactArc).unwrap();
    ring.add_support(&RingSupport {
        from: PI,
        to: TAU,
        spring: [3.6e6, 3.6e6, 0.0],
        share: SpringShare::Total,
        offset,
    })
    .unwrap();
    ring
}

/// [`paper_ring`] under its weight.
pub fn paper_structure(nodes: usize, offset: f64) -> Structure {
    Structure::ring_alone(paper_ring(nodes, offset), GRAVITY)
}

/// The source's bearing at zero speed, k from its geometry at 206 GPa, ball 0 at `first_deg`.
pub fn paper_bearing(first_deg: f64, formulation: Formulation) -> BearingSetup {
    let geometry = BearingGeometry::new(BEARING).unwrap();
    let steel = ContactMaterial { young: 206e9, poisson: 0.3 };
    BearingSetup {
        cage: rolling_cage(&geometry, first_deg, 0.0),
        geometry,
        stiffness: RaceContacts::new(&geometry, steel, steel, steel).unwrap().stiffness(),
        contact_damping: 0.0,
        formulation,
        balls_inertia: BallsInertia::Dynamic,
        waves: Vec::new(),
        oversizes: Vec::new(),
        race_defects: Vec::new(),
        flats: Vec::new(),
        shaft: Shaft { mass: 0.15, unbalance: 2e-5, loads: Vec::new() },
        gravity: GRAVITY,
    }
}

/// Without slip, at constant speed.
pub fn rolling_cage(geometry: &BearingGeometry, first_deg: f64, frequency_hz: f64) -> Cage {
    let speed = SpeedProfile::constant(frequency_hz).unwrap();
    let slip = SlipProfile::constant(0.0).unwrap();
    Cage::new(geometry, speed, slip, first_deg.to_radians()).unwrap()
}

/// The preloaded variant: radial play -1.5 um keeps every ball in contact.
pub fn preloaded_bearing(first_deg: f64, frequency_hz: f64) -> BearingSetup {
    let plain = paper_bearing(first_deg, Formulation::Consistent);
    let geometry = plain.geometry.with_radial_play(-1.5e-6).unwrap();
    BearingSetup { cage: rolling_cage(&geometry, first_deg, frequency_hz), geometry, ..plain }
}

/// The aluminium ring as a mesh, tied to the steel ring.
pub struct Housing {
    pub model: HousingModel,
    pub ring: Ring,
    pub tie: RingTie,
    /// In the displacements that the tie's partition uses.
    pub matrices: SystemMatrices,
}

impl Housing {
    /// One of the repository's meshes; supported by the source's springs (3.6e6 N/m in x and y over the
    /// lower half of the outside) or free.
    pub fn new(mesh: &str, supported: bool, fit: Fit) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("meshes/{mesh}.msh"));
        let mesh = Mesh::read_gmsh(&path, LengthUnit::parse("mm").unwrap()).unwrap();
        let aluminium = Material::new(72e9, 0.33, ALUMINIUM_DENSITY).unwrap();
        let parts = vec![HousingPart { group: "housing".into(), material: aluminium.into() }];
        let springs = HousingSupport {
            group: "lower".into(),
            constraint: Constraint::Spring(SpringStiffness::Global([3.6e6, 3.6e6, 0.0])),
            share: SupportShare::PerGroup,
        };
        let supports = if supported { vec![springs] } else { vec![] };
        let plane = PlaneModel { assumption: PlaneAssumption::Stress, thickness: HOUSING_WIDTH };
        let description = HousingDescription { parts, plane: Some(plane), supports, ..HousingDescription::default() };
        let model = HousingModel::new(&mesh, description).unwrap();
        let ring = steel_ring();
        let tie = RingTie::new(&mesh, &model, "bore", &ring, BORE_RADIUS, fit).unwrap();
        let matrices = SystemMatrices::assemble(&model).unwrap().for_tie(&tie);
        Self { model, ring, tie, matrices }
    }

    pub fn superelement(&self, fixed_interface_modes: usize) -> Superelement {
        let choice = BasisChoice { size: BasisSize::Count(fixed_interface_modes), enhanced: false, band_hz: 40e3 };
        let condensed = craig_bampton(&self.matrices, self.tie.partition(), choice, None);
        condensed.unwrap().superelement
    }

    pub fn structure(&self, fixed_interface_modes: usize) -> Structure {
        let superelement = self.superelement(fixed_interface_modes);
        Structure::with_housing(self.ring.clone(), &superelement, GRAVITY).unwrap()
    }

    /// Ring and housing without any reduction: (K, M) over ring displacements, then interior ones.
    pub fn full(&self) -> (SparseMatrix, SparseMatrix) {
        // the coupling turns the housing's displacements itself
        let matrices = SystemMatrices::assemble(&self.model).unwrap();
        let coupled = CoupledMatrices::new(&matrices, &self.tie, &self.ring.clone().into());
        let first = coupled.stiffness.rows() - self.ring.dof();
        let (interior, ring): (Vec<usize>, Vec<usize>) = coupled.free_dofs.iter().partition(|&&dof| dof < first);
        let order = [ring, interior].concat();
        let part = |whole: &SparseMatrix| plummer::numerics::linalg::submatrix(whole, &order, &order);
        (part(&coupled.stiffness), part(&coupled.mass))
    }
}

/// A sparse matrix with all its zeros.
pub fn dense(sparse: &SparseMatrix) -> DenseMatrix {
    let identity = DenseMatrix::identity(sparse.cols(), sparse.cols());
    plummer::numerics::linalg::sparse_times_dense(sparse, &identity)
}

/// A vector as a matrix of one column.
pub fn column(values: &[f64]) -> DenseMatrix {
    DenseMatrix::from_fn(values.len(), 1, |row, _| values[row])
}

/// Contact forces in a state, N.
pub struct ContactForces {
    pub inner: Vec<f64>,
    pub outer: Vec<f64>,
}

/// What the record of a run of no steps says; for a structure without sensors.
pub fn contact_forces(system: &mut CoupledSystem, state: &State) -> ContactForces {
    let mut recorder = Recorder::new(system, 1, 1e-8, 1).unwrap();
    let schedule = Schedule { interval: 1e-8, steps_per_interval: 1, intervals: 0 };
    let mut state = state.clone();
    integrate(system, Method::Exponential, &schedule, &mut state, &mut recorder, |_, _| Stepping::Continue).unwrap();
    let record = recorder.finish();
    ContactForces { inner: record.inner_force, outer: record.outer_force }
}
