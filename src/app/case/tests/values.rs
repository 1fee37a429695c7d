//! What is understood of a case: every key, the defaults, and that a case written is the case read.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::{FULL, near, read};
use crate::app::case::{
    BUILT_IN_MATERIALS, Case, ContactStiffness, Damping, Defect, DentProfile, FixedInterfaceModes, Hold,
    InterfaceModes, Linearise, Material, Method, ModesKept, SensorSpot, Source, StepLength,
};
use crate::fe::element::continuum::{Integration, LinearFormulation};
use crate::fe::modal::ModeRange;
use crate::fe::model::{Connection, Link, OverlapRule, SpringStiffness, SupportShare};

fn young(case: &Case, name: &str) -> f64 {
    match case.material(name) {
        Some(Material::Isotropic(material)) => material.young,
        other => panic!("{other:?}"),
    }
}

#[test]
fn every_key_of_the_full_case_arrives() {
    let case = read(FULL, &[]).unwrap();
    assert_eq!(case.title, "Everything");
    assert!(near(young(&case, "my alloy"), 71e9));
    let housing = case.meshed_housing().unwrap();
    assert_eq!(housing.mesh, Path::new("folder/pedestal.msh"));
    assert!(near(housing.length_unit.to_metres(), 1e-3));
    assert!(matches!(
        housing.supports[1].hold,
        Hold::Spring(SpringStiffness::Global([_, y, _]), SupportShare::PerGroup) if near(y, 2e5)
    ));
    assert!(matches!(
        housing.supports[2].hold,
        Hold::Spring(SpringStiffness::Radial(stiffness), SupportShare::PerNode) if near(stiffness, 3e5)
    ));
    assert_eq!(
        (housing.formulation.integration, housing.formulation.linear),
        (Integration::FourPoint, LinearFormulation::Plain)
    );
    assert_eq!(housing.overlap, OverlapRule::Allow);
    let between = ["lid seat", "case seat"].map(str::to_owned);
    assert_eq!(housing.links[0], Link { between, connection: Connection::Tie });
    assert!(matches!(
        housing.links[1].connection,
        Connection::Spring(SpringStiffness::Global([_, y, _]), SupportShare::PerGroup) if near(y, 2e6)
    ));
    assert!(matches!(
        housing.links[2].connection,
        Connection::Spring(SpringStiffness::Radial(stiffness), SupportShare::PerNode) if near(stiffness, 3e6)
    ));
    let Some(Material::Orthotropic(printed)) = case.material("printed") else {
        panic!("not orthotropic");
    };
    assert!(near(printed.young[2], 2.4e9) && near(printed.y_axis[2], 1.0));
    let ring = case.ring.as_ref().unwrap();
    assert!(near(ring.sections[0].shear_coefficient, 5.0 / 6.0));
    assert!(ring.sections[0].axial_inertia.is_none());
    assert!(ring.sections[1].torsion.is_some_and(|j| near(j, 19.5e-12)));
    assert!(near(ring.supports[0].offset, 1e-3));
    let bearing = case.bearing.as_ref().unwrap();
    assert_eq!(bearing.race_material.outer, "my alloy");
    assert!(near(bearing.play(), -1e-6));
    assert!(matches!(
        bearing.stiffness,
        ContactStiffness::Given { inner, .. } if near(inner, 3.828e9)
    ));
    assert!(matches!(&bearing.defects[0], Defect::Dent(dent)
        if near(dent.rim_radius, 0.04e-3) && dent.profile == DentProfile::Surface));
    assert!(matches!(case.damping, Some(Damping::Ratios(points)) if near(points[1].ratio, 0.03)));
    assert_eq!(case.sensors[1].spot, SensorSpot::RingDeg(90.0));
    assert_eq!(case.sensors[2].spot, SensorSpot::Point([0.0, 9e-3, 0.0]));
    assert_eq!(case.modes.extent, ModeRange::UpToHz(1e5));
    let compare = &case.modes.compare[0];
    assert_eq!(compare.file, Path::new("folder/calculix.csv"));
    assert_eq!(compare.name(), "CalculiX 2.20");
    assert!(near(compare.mac, 0.9) && near(compare.within, 0.02));
    assert!(compare.points_within.is_some_and(|d| near(d, 1e-5)));
    let convergence = case.modes.convergence.as_ref().unwrap();
    assert_eq!(convergence.meshes[1], Path::new("folder/pedestal_fine.msh"));
    assert!(convergence.order.is_some_and(|p| near(p, 2.0)));
    assert_eq!(case.condense.fixed_interface_modes, FixedInterfaceModes::UpToHz(2e5));
    assert_eq!(case.condense.interface_modes, InterfaceModes::UpToHz(6e4));
    let transient = case.transient.as_ref().unwrap();
    assert_eq!(transient.step, StepLength::Seconds(1e-7));
    assert_eq!(transient.modes, ModesKept::Count(11));
    assert!(!transient.residual);
    assert_eq!((transient.ensemble.runs, transient.ensemble.seed), (64, 7));
    assert!(near(transient.ensemble.perturbation, 1e-8));
    assert_eq!(case.band_hz(), Some([0.0, 40e3]));
}

#[test]
fn loss_factors_are_read_and_written_back() {
    let lossy = "materials.lossy={young=2e11,poisson=0.3,density=7800,loss_factor=0.002}";
    let case = read(FULL, &[lossy]).unwrap();
    let of = |name: &str| case.material(name).unwrap().loss_factor();
    assert!(near(of("lossy"), 0.002) && near(of("printed"), 0.04));
    assert_eq!(of("steel").to_bits(), 0.0_f64.to_bits());
    let written = toml::to_string(&case.materials).unwrap();
    let expected = ["loss_factor = 0.002", "loss_factor = 0.04"];
    assert!(expected.iter().all(|line| written.contains(line)), "{written}");
    assert_eq!(written.matches("loss_factor").count(), 2, "{written}");
}

#[test]
fn defaults_are_those_of_the_format() {
    let text = "[ring]\nsections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n\
        [bearing]\nballs = 7\nball_radius = 1e-3\ninner_race_radius = 2.754e-3\nouter_race_radius = 4.7565e-3\n\
        inner_groove_radius = 1.04e-3\nouter_groove_radius = 1.07e-3\n[shaft]\nmass = 0.15\n\
        [transient]\nend = 1\noutput_hz = 1e5\n";
    let case = read(text, &[]).unwrap();
    assert_eq!(case.title, "case");
    let ring = case.ring.as_ref().unwrap();
    assert_eq!((ring.nodes, ring.shear, ring.rotary_inertia), (72, true, true));
    let bearing = case.bearing.as_ref().unwrap();
    assert!(near(bearing.first_ball_deg, 270.0));
    assert!((bearing.play() - 2.5e-6).abs() < 1e-12);
    assert_eq!(bearing.stiffness, ContactStiffness::Hertz);
    assert_eq!((bearing.ball_mass, bearing.density), (None, None));
    assert!((case.ball_mass().unwrap() - 3.2882e-5).abs() < 1e-9);
    assert!(near(case.shaft.as_ref().unwrap().gravity[1], -9.81));
    assert_eq!(case.modes.extent, ModeRange::AtMost(20));
    assert_eq!(case.modes.linearise, Linearise::None);
    assert!(case.condense.enhanced);
    assert_eq!(case.condense.interface_modes, InterfaceModes::None);
    let transient = case.transient.as_ref().unwrap();
    assert_eq!(transient.method, Method::Auto);
    assert_eq!(transient.step, StepLength::Auto);
    assert!(transient.tolerance.is_none() && transient.spectral_radius.is_none());
    assert_eq!(transient.modes, ModesKept::Auto);
    assert!(transient.residual);
    assert_eq!((transient.ensemble.runs, transient.ensemble.seed), (20, 1));
    assert!(near(transient.ensemble.perturbation, 1e-9));
    assert_eq!(case.band_hz(), Some([0.0, 5e4]));
    assert!(near(young(&case, "steel"), 206e9));
    assert!(near(young(&case, "aluminium"), 70e9));
}

#[test]
fn a_given_material_takes_the_place_of_a_built_in_one() {
    let case = read(FULL, &["materials.steel={young=1e9,poisson=0.1,density=1000}"]).unwrap();
    assert!(near(young(&case, "steel"), 1e9));
    assert!(near(young(&case, "bearing steel"), 206e9));
    let case =
        read(FULL, &["bearing.ball_material='silicon nitride'", "housing.parts[0].material=EN-GJL-250"]).unwrap();
    assert!(near(young(&case, "EN-GJL-250"), 110e9) && near(young(&case, "silicon nitride"), 310e9));
    let described = Case::schema()["properties"]["materials"]["description"].to_string();
    assert!(BUILT_IN_MATERIALS.iter().all(|built_in| described.contains(built_in.name)), "{described}");
}

#[test]
fn the_echo_reads_back_as_the_same_case() {
    for set in [
        &[][..],
        &["bearing.stiffness=hertz", "damping={modal=0.02}", "modes={count=3}"][..],
        &["damping={alpha=1,beta=1e-7}", "transient.step=auto", "transient.modes=all"][..],
        &["condense.fixed_interface_modes=40", "condense.interface_modes=30", "bearing.race_material=steel"][..],
    ] {
        let case = read(FULL, set).unwrap();
        let echo = toml::to_string(&case).unwrap();
        let again = Case::from_source(Source { path: PathBuf::from("case.toml"), text: echo.clone(), set: Vec::new() })
            .unwrap();
        let content = |mut case: Case| {
            case.source = Source::default();
            format!("{case:#?}").replace("folder/", "")
        };
        assert_eq!(content(again.clone()), content(case.clone()));
        assert_eq!(toml::to_string(&again).unwrap(), echo);
        let json = serde_json::to_value(&case).unwrap();
        assert_eq!(Case::deserialize(json.clone()).unwrap().title, "Everything");
        assert_eq!(json, serde_json::to_value(&again).unwrap());
    }
}
