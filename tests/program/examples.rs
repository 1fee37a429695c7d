//! The case files under `examples/` are read as they stand and hold what they say.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use plummer::app::commands::modes::compute_modes;
use plummer::app::scene::CoupledStructure;
use plummer::fe::material::RadiusRule;
use plummer::fe::model::{SpringStiffness, SupportShare};
use plummer::numerics::{Unwatched, Watch};
use plummer::system::{Formulation, LoadedMode};

use plummer::app::case::{Case, Damping, Defect, Hold, Linearise, Method, Purpose, Variant};

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(name)
}

fn load(name: &str) -> Case {
    Case::load(path(name), &[]).unwrap()
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

#[test]
fn the_dent_is_all_that_distinguishes_the_faulty_bearing() {
    let mut dent = load("tadina2011/outer-dent.toml");
    let healthy = load("tadina2011/healthy.toml");
    dent.ready_for(Purpose::Run).unwrap();
    healthy.ready_for(Purpose::Run).unwrap();
    assert_ne!(dent.title, healthy.title);
    let bearing = dent.bearing.as_mut().unwrap();
    assert_eq!(bearing.defects.len(), 1);
    bearing.defects.clear();
    dent.title.clone_from(&healthy.title);
    assert_eq!(serde_json::to_value(&dent).unwrap(), serde_json::to_value(&healthy).unwrap());
}

#[test]
fn the_three_housings_hold_the_same_bearing_and_fault() {
    let stripped = |name: &str| {
        let case = load(&format!("housings/{name}.toml"));
        case.ready_for(Purpose::Run).unwrap();
        let mut value = serde_json::to_value(&case).unwrap();
        let fields = value.as_object_mut().unwrap();
        for of_its_own in ["title", "housing", "sensors"] {
            assert!(fields.remove(of_its_own).is_some(), "{name}: {of_its_own}");
        }
        fields["ring"].as_object_mut().unwrap().remove("tie");
        value
    };
    let ring = stripped("ring");
    for other in ["pillow_block", "end_shield"] {
        assert_eq!(stripped(other), ring, "{other}");
    }
}

#[test]
fn the_dent_case_holds_the_papers_table_and_the_stated_choices() {
    let case = load("tadina2011/outer-dent.toml");
    let bearing = case.bearing.as_ref().unwrap();
    assert!((bearing.play() - 2.5e-6).abs() < 1e-12);
    assert!(bearing.ball_mass.is_some_and(|mass| near(mass, 3.29e-5)));
    assert!(near(bearing.contact_damping, 2.0));
    assert!(matches!(&bearing.defects[0], Defect::Dent(dent) if near(dent.length, 0.75e-3)));
    assert!(matches!(case.damping, Some(Damping::Modal(ratio)) if near(ratio, 0.03)));
    let housing = case.meshed_housing().unwrap();
    assert_eq!(housing.mesh, path("tadina2011").join("../../meshes/ring_6_9.msh"));
    assert!(matches!(
        housing.supports[0].hold,
        Hold::Spring(SpringStiffness::Global([x, y, _]), SupportShare::PerGroup)
            if near(x, 36.0 * 1e5) && near(y, 36.0 * 1e5)
    ));
    let groups = ["housing", "bore", "outer", "lower", "top"].map(str::to_owned);
    case.check_groups(&groups).unwrap();
    // omega = 20 pi (t - 0.2): 10 Hz per second.
    let profile = &case.speed.as_ref().unwrap().profile;
    assert!(near((profile[1].frequency_hz - profile[0].frequency_hz) / (profile[1].time - profile[0].time), 10.0));
    let transient = case.transient.as_ref().unwrap();
    assert_eq!(transient.method, Method::Auto);
    assert!(near(transient.end, 2.6));
}

#[test]
fn the_beam_case_names_every_choice_of_the_fit() {
    let case = load("tadina2011/beam.toml");
    case.ready_for(Purpose::Modes).unwrap();
    assert!(case.housing.is_none());
    let ring = case.ring.as_ref().unwrap();
    assert_eq!(ring.radius_rule, RadiusRule::CommonCentroid);
    assert!(!ring.shear);
    let (width, height) = (4e-3, 3e-3_f64);
    assert!(near(ring.sections[1].area, width * height));
    assert!(near(ring.sections[1].inertia, width * height.powi(3) / 12.0));
    let bearing = case.bearing.as_ref().unwrap();
    assert_eq!(bearing.formulation, Formulation::Printed);
    // Half a ball spacing off the load: 270 + 360 / 7 / 2.
    assert!((bearing.first_ball_deg - (270.0 + 180.0 / 7.0)).abs() < 1e-3);
    assert_eq!(case.modes.linearise, Linearise::Static);
    for (item, hz) in case.modes.expected.iter().zip([8200.0, 11300.0, 36000.0]) {
        assert!(near(item.hz, hz));
    }
    assert_eq!(case.modes.expected.len(), 3);
    assert!(case.modes.expected.iter().all(|item| near(item.within, 0.015)));
}

#[test]
fn every_variant_of_the_beam_case_differs_from_it_and_from_the_others() {
    let case = load("tadina2011/beam.toml");
    let variants = case.variants().unwrap();
    assert_eq!(variants.len(), 13);
    let plain = |case: &Case| {
        let mut case = case.clone();
        case.modes.variants.clear();
        serde_json::to_string(&case).unwrap()
    };
    let mut seen = vec![plain(&case)];
    for variant in &variants {
        let text = plain(&variant.case);
        assert!(!seen.contains(&text), "{}", variant.what);
        seen.push(text);
    }
    let width = |index: usize| {
        let variant = &variants[index].case.ring.as_ref().unwrap().sections[1];
        (variant.area, variant.inertia)
    };
    for (index, millimetres) in [(11, 3.0), (12, 5.0)] {
        let (area, inertia) = width(index);
        assert!(near(area, millimetres * 1e-3 * 3e-3));
        assert!(near(inertia, millimetres * 1e-3 * 2.25e-9));
    }
}

#[test]
fn the_smooth_scene_is_preloaded_and_has_no_dent() {
    let case = load("scenes/smooth.toml");
    case.ready_for(Purpose::Run).unwrap();
    let bearing = case.bearing.as_ref().unwrap();
    assert!(near(bearing.play(), -1.5e-6));
    assert!(bearing.defects.is_empty());
    assert_eq!(case.speed.as_ref().unwrap().profile.len(), 1);
    let transient = case.transient.as_ref().unwrap();
    assert!(near(transient.end - transient.start, 10e-3));
    assert!(near(transient.output_hz, 4e5));
}

/// The scenes of the charts differ in the bearing and its speed alone: the same ring, shaft, damping and sensor.
#[test]
fn the_scenes_are_what_they_are_called() {
    let smooth = load("scenes/smooth.toml");
    for (name, dents, damping, hz) in [("healthy", 0, 1.0, 21.0), ("impact", 1, 2.0, 21.0), ("rattle", 0, 0.0, 45.0)] {
        let case = load(&format!("scenes/{name}.toml"));
        case.ready_for(Purpose::Chart).unwrap();
        let bearing = case.bearing.as_ref().unwrap();
        assert_eq!(bearing.defects.len(), dents, "{name}");
        assert!((bearing.contact_damping - damping).abs() < 1e-12, "{name}");
        assert!((bearing.play() - 2.5e-6).abs() < 1e-12, "{name}");
        assert!(near(case.speed.as_ref().unwrap().profile[0].frequency_hz, hz));
        let same = |case: &Case| {
            let parts = (&case.ring, &case.shaft, &case.damping, &case.sensors);
            serde_json::to_value(parts).unwrap()
        };
        assert_eq!(same(&case), same(&smooth), "{name}");
    }
    // what lifts the shaft off: m e omega^2 against m g
    let shaft = smooth.shaft.as_ref().unwrap();
    let unbalance = |hz: f64| shaft.unbalance * (std::f64::consts::TAU * hz).powi(2);
    let weight = -shaft.mass * shaft.gravity[1];
    assert!(unbalance(43.1) < weight && unbalance(45.0) > weight);
}

/// The solid pillow block: its ring has six degrees of freedom a node, its modes come in out-of-plane ones too.
#[test]
fn the_pedestal_vibrates() {
    let case = load("scenes/pedestal.toml");
    case.ready_for(Purpose::Run).unwrap();
    case.ready_for(Purpose::Modes).unwrap();
    let result = compute_modes(&case, &Unwatched).unwrap();
    assert_eq!(result.survey.basis.rigid_modes, 0);
    assert_eq!(result.bodies.as_ref().unwrap().rings.dof(), 6 * 72);
    let unloaded = &result.base.unloaded_hz;
    // this program's own numbers, with gmsh 4.8's mesh: pin it against itself, in full and condensed
    assert!((unloaded[0] / 16160.466530 - 1.0).abs() < 1e-9, "{unloaded:?}");
    let stage = CoupledStructure::build(&case, &Unwatched).unwrap().unwrap();
    assert_eq!(result.fixed_interface_modes, Some(stage.fixed_interface_modes));
    let condensed = stage.modes.frequency_hz(0);
    // accuracy.target is 0.01, from above
    let error = condensed / unloaded[0] - 1.0;
    assert!((0.0..0.01).contains(&error), "{error:e}");
    // the first mode tilts out of the plane: contact in the plane does not touch it
    let loaded = &result.base.loaded.as_ref().unwrap().modes;
    let tilting = |mode: &LoadedMode| (mode.frequency_hz / condensed - 1.0).abs() < 1e-6;
    assert!(loaded.iter().any(tilting));
}

/// Keeps the names of the stages; a stage that tells its share is named again, with a dot.
#[derive(Default)]
struct Stages(Mutex<Vec<String>>);

impl Watch for Stages {
    fn stage(&self, name: &str) {
        self.0.lock().unwrap().push(name.to_owned());
    }
    fn fraction(&self, done: f64) {
        assert!((0.0..=1.0).contains(&done), "{done}");
        let mut named = self.0.lock().unwrap();
        if let Some(stage) = named.last().filter(|stage| !stage.ends_with('.')).cloned() {
            named.push(format!("{stage}."));
        }
    }
}

/// Modes without load are those of housing and ring in full, of the case and of its variants: nothing is condensed for them.
#[test]
fn modes_without_load_condense_nothing() {
    let mut case = load("housings/ring.toml");
    let stages = |case: &Case| {
        let stages = Stages::default();
        let result = compute_modes(case, &stages).unwrap();
        (result, stages.0.into_inner().unwrap())
    };
    case.modes.linearise = Linearise::None;
    case.modes.variants = vec![Variant {
        what: "twenty modes".to_owned(),
        set: vec![
            "condense.fixed_interface_modes=20".to_owned(),
            "condense.enhanced=false".to_owned(),
            "modes.linearise=\"none\"".to_owned(),
        ],
    }];
    let (result, named) = stages(&case);
    assert!(!named.iter().any(|name| name == "constraint modes"), "{named:?}");
    assert!(named.iter().any(|name| name == "eigen."), "{named:?}");
    assert!(result.fixed_interface_modes.is_none() && result.base.loaded.is_none());
    let (base, coarse) = (&result.base, &result.variants[0]);
    assert_eq!(base.unloaded_hz.len(), coarse.unloaded_hz.len());
    for (a, b) in base.unloaded_hz.iter().zip(&coarse.unloaded_hz) {
        // the same matrices, computed twice
        assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    }
    (case.modes.linearise, case.modes.variants) = (Linearise::Static, Vec::new());
    let (result, named) = stages(&case);
    assert_eq!(named.iter().filter(|name| *name == "constraint modes").count(), 1, "{named:?}");
    assert!(named.iter().any(|name| name == "fixed-interface modes."), "{named:?}");
    assert!(result.fixed_interface_modes.is_some() && result.base.loaded.is_some());
    assert_eq!(result.base.unloaded_hz, base.unloaded_hz);
}
