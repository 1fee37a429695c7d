//! Reading a case: what is understood, and the exact message of what is not.

use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::{
    BallInertia, Case, CaseError, ContactStiffness, Damping, Defect, DentProfile,
    FixedInterfaceModes, Hold, Integration, InterfaceModes, Joint, LinearElements, Linearise, Link,
    Material, Method, ModeExtent, ModesKept, PerNodeOrGroup, Purpose, SensorSpot, Source,
    StepLength,
};

/// A case with every table and every form of value.
pub(super) const FULL: &str = include_str!("full.toml");

pub(super) fn read(text: &str, set: &[&str]) -> Result<Case, CaseError> {
    Case::from_source(Source {
        path: PathBuf::from("folder/case.toml"),
        text: text.to_owned(),
        set: set.iter().map(|&argument| argument.to_owned()).collect(),
    })
}

/// Message and help of the error that `FULL` gives with these keys set.
pub(super) fn refusal(set: &[&str]) -> (String, Option<String>) {
    let error = read(FULL, set).unwrap_err();
    (error.to_string(), error.help())
}

pub(super) fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

#[test]
fn every_key_of_the_full_case_arrives() {
    let case = read(FULL, &[]).unwrap();
    assert_eq!(case.title, "Everything");
    assert!(near(
        case.material("my alloy")
            .unwrap()
            .isotropic()
            .unwrap()
            .young,
        71e9
    ));
    let housing = case.meshed_housing().unwrap();
    assert_eq!(housing.mesh, Path::new("folder/pedestal.msh"));
    assert!(near(housing.length_unit.to_metres(), 1e-3));
    assert!(matches!(
        housing.supports[1].hold,
        Hold::Spring { spring, per: PerNodeOrGroup::Group } if near(spring.y, 2e5)
    ));
    assert!(matches!(
        housing.supports[2].hold,
        Hold::Radial { stiffness, per: PerNodeOrGroup::Node } if near(stiffness, 3e5)
    ));
    assert_eq!(
        (housing.integration, housing.linear),
        (Integration::FourPoint, LinearElements::Plain)
    );
    let between = ["lid seat", "case seat"].map(str::to_owned);
    assert_eq!(
        housing.links[0],
        Link {
            between,
            joint: Joint::Tie
        }
    );
    assert!(matches!(
        housing.links[1].joint,
        Joint::Spring { spring, per: PerNodeOrGroup::Group } if near(spring.y, 2e6)
    ));
    assert!(matches!(
        housing.links[2].joint,
        Joint::Radial { stiffness, per: PerNodeOrGroup::Node } if near(stiffness, 3e6)
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
    assert_eq!(case.modes.extent, ModeExtent::UpToHz(1e5));
    let compare = &case.modes.compare[0];
    assert_eq!(compare.file, Path::new("folder/calculix.csv"));
    assert_eq!(compare.name(), "CalculiX 2.20");
    assert!(near(compare.mac, 0.9) && near(compare.within, 0.02));
    assert!(compare.points_within.is_some_and(|d| near(d, 1e-5)));
    let convergence = case.modes.convergence.as_ref().unwrap();
    assert_eq!(convergence.meshes[1], Path::new("folder/pedestal_fine.msh"));
    assert!(convergence.order.is_some_and(|p| near(p, 2.0)));
    assert_eq!(
        case.condense.fixed_interface_modes,
        FixedInterfaceModes::UpToHz(2e5)
    );
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
    assert!(
        expected.iter().all(|line| written.contains(line)),
        "{written}"
    );
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
    assert_eq!(
        (ring.nodes, ring.shear, ring.rotary_inertia),
        (72, true, true)
    );
    let bearing = case.bearing.as_ref().unwrap();
    assert!(near(bearing.first_ball_deg, 270.0));
    assert!((bearing.play() - 2.5e-6).abs() < 1e-12);
    assert_eq!(bearing.stiffness, ContactStiffness::Hertz);
    assert_eq!(bearing.ball_inertia(), BallInertia::Material);
    assert!((case.ball_mass().unwrap() - 3.2882e-5).abs() < 1e-9);
    assert!(near(case.shaft.as_ref().unwrap().gravity[1], -9.81));
    assert_eq!(case.modes.extent, ModeExtent::Count(20));
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
    assert!(near(
        case.material("steel").unwrap().isotropic().unwrap().young,
        206e9
    ));
    assert!(near(
        case.material("aluminium")
            .unwrap()
            .isotropic()
            .unwrap()
            .young,
        70e9
    ));
}

#[test]
fn a_given_material_takes_the_place_of_a_built_in_one() {
    let case = read(
        FULL,
        &["materials.steel={young=1e9,poisson=0.1,density=1000}"],
    )
    .unwrap();
    assert!(near(
        case.material("steel").unwrap().isotropic().unwrap().young,
        1e9
    ));
    assert!(near(
        case.material("bearing steel")
            .unwrap()
            .isotropic()
            .unwrap()
            .young,
        206e9
    ));
}

#[test]
fn the_echo_reads_back_as_the_same_case() {
    for set in [
        &[][..],
        &[
            "bearing.stiffness=hertz",
            "damping={modal=0.02}",
            "modes={count=3}",
        ][..],
        &[
            "damping={alpha=1,beta=1e-7}",
            "transient.step=auto",
            "transient.modes=all",
        ][..],
        &[
            "condense.fixed_interface_modes=40",
            "condense.interface_modes=30",
            "bearing.race_material=steel",
        ][..],
    ] {
        let case = read(FULL, set).unwrap();
        let echo = toml::to_string(&case).unwrap();
        let again = Case::from_source(Source {
            path: PathBuf::from("case.toml"),
            text: echo.clone(),
            set: Vec::new(),
        })
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

#[test]
fn misspelt_keys_and_names_come_with_the_nearest() {
    let (message, help) = refusal(&["bearing.ball_raduis=1e-3"]);
    assert_eq!(
        message,
        "--set bearing.ball_raduis=1e-3: unknown key `bearing.ball_raduis`"
    );
    assert!(
        help.unwrap()
            .starts_with("did you mean `ball_radius`? keys here: balls, ball_radius, ball_mass,")
    );
    let (message, help) = refusal(&["ring.bond=slipp"]);
    assert_eq!(
        message,
        "--set ring.bond=slipp: `ring.bond` is \"slipp\", expected one of `slip`, `composite`"
    );
    assert_eq!(
        help.unwrap(),
        "did you mean `slip`? names here: slip, composite"
    );
    let (message, help) = refusal(&["transient.modes=every"]);
    assert_eq!(
        message,
        "--set transient.modes=every: `transient.modes` is \"every\", expected one of `auto`, `all`"
    );
    assert_eq!(help.unwrap(), "names here: auto, all");
    let (message, help) = refusal(&["transcient.end=1"]);
    assert_eq!(message, "--set transcient.end=1: unknown key `transcient`");
    assert!(help.unwrap().starts_with("did you mean `transient`?"));
}

#[test]
fn errors_in_the_file_name_its_line() {
    for (from, to, line, rest) in [
        (
            "balls = 7",
            "bals = 7",
            "balls = 7",
            "unknown key `bearing.bals`",
        ),
        (
            "balls = 7",
            "balls = 7.5",
            "balls = 7",
            "`bearing.balls`: found 7.5, expected a whole number, 0 or more",
        ),
        (
            "depth = 0.015e-3",
            "depth = \"deep\"",
            "depth = 0.015e-3",
            "`bearing.defects[0].depth`: found \"deep\", expected a number",
        ),
        (
            "on = \"outer\"",
            "",
            "[[bearing.defects]]",
            "`bearing.defects[0]` lacks the required key `on`",
        ),
        (
            "length_unit = \"mm\"",
            "",
            "[housing]",
            "`housing` lacks the required key `length_unit`",
        ),
        (
            "group = \"case\", material",
            "grup = \"case\", material",
            "group = \"case\", material",
            "unknown key `housing.parts[0].grup`",
        ),
    ] {
        let number = 1 + FULL.lines().position(|text| text.contains(line)).unwrap();
        let error = read(&FULL.replacen(from, to, 1), &[]).unwrap_err();
        assert_eq!(
            error.to_string(),
            format!("folder/case.toml:{number}: {rest}")
        );
    }
}

#[test]
fn values_of_the_wrong_kind_are_named() {
    for (set, rest) in [
        ("title=3", "`title`: found 3, expected a string"),
        (
            "ring.shear=1",
            "`ring.shear`: found 1, expected true or false",
        ),
        (
            "bearing.balls=-3",
            "`bearing.balls`: found -3, expected a whole number, 0 or more",
        ),
        (
            "bearing.ball_radius=nan",
            "`bearing.ball_radius`: found NaN, expected a finite number",
        ),
        (
            "shaft.mass=2011-01-01",
            "`shaft.mass`: found the date 2011-01-01, expected a number",
        ),
        (
            "ring.bond=1",
            "`ring.bond`: found 1, expected one of `slip`, `composite`",
        ),
        (
            "housing.plane=[1]",
            "`housing.plane`: found an array of 1, expected a table",
        ),
        ("sensors=1", "`sensors`: found 1, expected an array"),
        ("materials=1", "`materials`: found 1, expected a table"),
        (
            "shaft.gravity=[0]",
            "`shaft.gravity`: found an array of 1, expected an array of 2",
        ),
        (
            "shaft.gravity=[0,-1,0]",
            "`shaft.gravity`: found an array of 3, expected an array of 2",
        ),
        (
            "shaft.gravity=[0,true]",
            "`shaft.gravity[1]`: found true, expected a number",
        ),
        (
            "bearing.stiffness=3e9",
            "`bearing.stiffness`: found 3000000000, expected \"hertz\", or { inner = NUMBER, outer = NUMBER }",
        ),
        (
            "bearing.race_material=[]",
            "`bearing.race_material`: found an array, expected a material's name, or { inner = NAME, outer = NAME }",
        ),
        (
            "transient.step={a=1}",
            "`transient.step`: found a table, expected \"auto\" or a number",
        ),
        (
            "transient.step=true",
            "`transient.step`: found true, expected \"auto\" or a number",
        ),
        (
            "transient.modes=-1",
            "`transient.modes`: found -1, expected \"auto\", \"all\" or a whole number",
        ),
        (
            "condense.fixed_interface_modes=1.5",
            "`condense.fixed_interface_modes`: found 1.5, expected \"auto\", a whole number or { up_to_hz = NUMBER }",
        ),
        (
            "condense.interface_modes=1.5",
            "`condense.interface_modes`: found 1.5, expected \"none\", a whole number or { up_to_hz = NUMBER }",
        ),
    ] {
        assert_eq!(refusal(&[set]).0, format!("--set {set}: {rest}"));
    }
}

#[test]
fn keys_that_exclude_each_other_are_named() {
    const SUPPORT: &str = "exactly one of `fixed`, `spring`, `radial`";
    const DAMPING: &str = "exactly one of `ratios`, `alpha` with `beta`, `modal`";
    const SENSOR: &str = "exactly one of `group`, `ring_deg`, `node`, `point`, `recovered`";
    for (set, key, found, expected) in [
        (
            "housing.supports[0]={group='a'}",
            "housing.supports[0]",
            "none of them",
            SUPPORT,
        ),
        (
            "housing.supports[0]={group='a',fixed=['x'],radial=1}",
            "housing.supports[0]",
            "several",
            SUPPORT,
        ),
        (
            "housing.supports[0]={group='a',fixed=['x'],per='node'}",
            "housing.supports[0]",
            "`per` beside `fixed`",
            "`per` beside `spring` or `radial` only",
        ),
        ("damping={}", "damping", "none of them", DAMPING),
        ("damping={modal=0.1,alpha=1}", "damping", "several", DAMPING),
        (
            "damping={alpha=1}",
            "damping",
            "`alpha` without `beta`",
            DAMPING,
        ),
        (
            "damping={beta=1}",
            "damping",
            "`beta` without `alpha`",
            DAMPING,
        ),
        (
            "sensors[0]={name='a',direction=[0,1,0]}",
            "sensors[0]",
            "none of them",
            SENSOR,
        ),
        (
            "sensors[0]={name='a',group='a',ring_deg=1,direction=[0,1,0]}",
            "sensors[0]",
            "several",
            SENSOR,
        ),
        (
            "modes={count=1,up_to_hz=1}",
            "modes",
            "several",
            "one of `count`, `up_to_hz`, `band_hz`",
        ),
        (
            "modes={band_hz=[1,2],up_to_hz=1}",
            "modes",
            "several",
            "one of `count`, `up_to_hz`, `band_hz`",
        ),
    ] {
        let message = format!("--set {set}: `{key}`: found {found}, expected {expected}");
        assert_eq!(refusal(&[set]).0, message);
    }
}

#[test]
fn text_and_arguments_that_are_malformed_are_named() {
    let error = read("title = \n", &[]).unwrap_err().to_string();
    assert!(
        error.starts_with("folder/case.toml:1: not valid TOML: "),
        "{error}"
    );
    assert_eq!(
        refusal(&["ring.nodes"]).0,
        "--set ring.nodes: found no `=`, expected KEY=VALUE"
    );
    let error = Case::load("no/such.toml", &[]).unwrap_err().to_string();
    assert!(error.starts_with("cannot read the case file no/such.toml: "));
}

#[test]
fn variants_are_read_with_the_command_lines_keys() {
    let case = read(FULL, &["ring.nodes=36"]).unwrap();
    let variants = case.variants().unwrap();
    assert_eq!(variants.len(), 1);
    assert_eq!(variants[0].what, "one ball fewer");
    let variant = &variants[0].case;
    assert_eq!(variant.bearing.as_ref().unwrap().balls, 6);
    assert_eq!(variant.ring.as_ref().unwrap().nodes, 36);
    assert!(variant.modes.variants.is_empty());
}

#[test]
fn a_bad_variant_is_found_when_the_case_is_read() {
    let error = read(&FULL.replace("bearing.balls=6", "bearing.bals=6"), &[]).unwrap_err();
    let line = 1 + FULL
        .lines()
        .position(|text| text.contains("one ball fewer"))
        .unwrap();
    assert_eq!(
        error.to_string(),
        format!(
            "folder/case.toml:{line}: variant \"one ball fewer\": \
             --set bearing.bals=6: unknown key `bearing.bals`"
        )
    );
    assert!(error.help().unwrap().starts_with("did you mean `balls`?"));
}

#[test]
fn a_command_names_the_table_that_it_lacks() {
    let case = read(FULL, &[]).unwrap();
    case.ready_for(Purpose::Run).unwrap();
    case.ready_for(Purpose::Modes).unwrap();
    type Removal = (&'static str, fn(&mut Case));
    let removals: [Removal; 6] = [
        ("[bearing]", |case| case.bearing = None),
        ("[shaft]", |case| case.shaft = None),
        ("[speed]", |case| case.speed = None),
        ("[transient]", |case| case.transient = None),
        ("[[sensors]]", |case| case.sensors.clear()),
        ("a support in [housing] or [ring]", |case| {
            case.housing = None;
            case.ring.as_mut().unwrap().supports.clear();
        }),
    ];
    for (table, remove) in removals {
        let mut poorer = case.clone();
        remove(&mut poorer);
        for (purpose, command) in [(Purpose::Run, "run"), (Purpose::Chart, "chart")] {
            assert_eq!(
                poorer.ready_for(purpose).unwrap_err().to_string(),
                format!("folder/case.toml: `{command}` needs {table}, which the case file lacks")
            );
        }
    }
    let mut poorer = case.clone();
    poorer.ring = None;
    assert_eq!(
        poorer.ready_for(Purpose::Modes).unwrap_err().to_string(),
        "folder/case.toml: `modes.linearise = \"static\"` needs [ring], which the case file lacks"
    );
    poorer.modes.linearise = Linearise::None;
    poorer.ready_for(Purpose::Modes).unwrap();
}

#[test]
fn a_group_that_the_mesh_lacks_is_named_with_the_nearest() {
    let case = read(FULL, &[]).unwrap();
    let all = [
        "case",
        "feet",
        "lower",
        "rim",
        "lid",
        "bore",
        "top",
        "lid seat",
        "case seat",
        "plug",
    ];
    let groups: Vec<String> = all.iter().map(|&name| name.to_owned()).collect();
    case.check_groups(&groups).unwrap();
    for (missing, key) in [
        ("case", "housing.parts[0].group"),
        ("feet", "housing.supports[0].group"),
        ("lid", "housing.masses[0].group"),
        ("plug", "housing.links[2].between"),
        ("bore", "ring.tie.group"),
        ("top", "sensors[0].group"),
    ] {
        let mut groups = groups.clone();
        groups
            .iter_mut()
            .filter(|name| *name == missing)
            .for_each(|name| name.push('s'));
        let error = case.check_groups(&groups).unwrap_err();
        let CaseError::UnknownName {
            place,
            key: named,
            names,
            ..
        } = &error
        else {
            panic!("{error}");
        };
        assert_eq!(
            (named.as_str(), names.nearest.as_deref()),
            (key, Some(format!("{missing}s").as_str()))
        );
        let line: usize = place
            .to_string()
            .rsplit(':')
            .next()
            .unwrap()
            .parse()
            .unwrap();
        assert!(FULL.lines().nth(line - 1).unwrap().contains(missing));
    }
}
