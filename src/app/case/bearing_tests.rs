//! The bearing's tables in a case: slip, loads, defects, waves, and what they refuse.

use std::path::Path;

use super::tests::{FULL, near, read, refusal};
use super::{Defect, DentProfile, Load, Slip};
use crate::bearing::Race;
use crate::system::BallsInertia;

#[test]
fn slip_is_a_number_or_a_table_over_time_or_speed() {
    let slip = |set: &str| read(FULL, &[&format!("bearing.slip={set}")]).map(|case| case.bearing.unwrap().slip);
    assert!(matches!(slip("0.5").unwrap(), Slip::Constant(slip) if near(slip, 0.5)));
    let over = slip("{profile=[{time=0,slip=0.1},{time=1,slip=0}]}").unwrap();
    assert!(matches!(over, Slip::OverTime(points) if near(points[1].0, 1.0)));
    let over = slip("{profile=[{hz=0,slip=0.1},{hz=20,slip=0}]}").unwrap();
    assert!(matches!(over, Slip::OverSpeed(points) if near(points[1].0, 20.0)));
    let over = slip("{profile=[{rpm=0,slip=0.1},{rpm=1200,slip=0}]}").unwrap();
    assert!(matches!(over, Slip::OverRpm(points) if near(points[1].0, 1200.0)));
    for (set, message) in [
        (
            "{profile=[{hz=0,slip=0.1},{rpm=20,slip=0}]}",
            "found points with none, several, or now the one and now the other, expected `time` in every point, or `hz` in every point, or `rpm` in every point",
        ),
        ("[0,0.1]", "found an array, expected a number, or { profile = [{ time, hz or rpm, slip }, ...] }"),
        ("{profile=[{rpm=-60,slip=0.1}]}", "`bearing.slip.profile[0].rpm`: found -60, expected a number not below 0"),
        ("{profile=[{hz=-1,slip=0.1}]}", "`bearing.slip.profile[0].hz`: found -1, expected a number not below 0"),
        ("{profile=[{hz=1,slip=1}]}", "`bearing.slip.profile[0].slip`: found 1, expected a number from 0 to below 1"),
        (
            "{profile=[{time=1,slip=0},{time=1,slip=0}]}",
            "`bearing.slip.profile[1].time`: found 1, expected more than the one before it (1)",
        ),
        ("{profile=[]}", "expected at least one point"),
    ] {
        let error = slip(set).unwrap_err().to_string();
        assert!(error.contains(message), "{set}: {error}");
    }
}

#[test]
fn a_speed_is_in_hz_or_in_rpm() {
    let speed = |set: &[&str]| read(FULL, set).map(|case| case.speed.unwrap().profile);
    let profile = speed(&["speed.profile=[{time=0,rpm=1500},{time=2,hz=30}]"]).unwrap();
    assert!(near(profile[0].frequency_hz, 25.0) && near(profile[1].frequency_hz, 30.0));
    // of the two, what is set takes the place of what is there
    let profile = speed(&["speed.profile=[{time=0,hz=10}]", "speed.profile[0].rpm=1770"]).unwrap();
    assert!(near(profile[0].frequency_hz, 29.5));
    let profile = speed(&["speed.profile=[{time=0,rpm=10}]", "speed.profile[0].hz=29.5"]).unwrap();
    assert!(near(profile[0].frequency_hz, 29.5));
    for (set, message) in [
        ("[{time=0}]", "`speed.profile[0]`: found none of them, expected exactly one of `hz`, `rpm`"),
        ("[{time=0,hz=25,rpm=1500}]", "`speed.profile[0]`: found both, expected exactly one of `hz`, `rpm`"),
        ("[{time=0,rpm=\"fast\"}]", "`speed.profile[0].rpm`: found \"fast\", expected a number"),
        ("[{time=0,rpms=1500}]", "unknown key `speed.profile[0].rpms`"),
    ] {
        let error = speed(&[&format!("speed.profile={set}")]).unwrap_err().to_string();
        assert!(error.contains(message), "{set}: {error}");
    }
}

#[test]
fn a_load_is_constant_or_over_time() {
    let loads = |set: &str| read(FULL, &[&format!("shaft.loads={set}")]).map(|case| case.shaft.unwrap().loads);
    let two = loads("[{force=[1,2]},{profile=[{time=0,force=[0,0]},{time=2,force=[3,4]}]}]").unwrap();
    assert!(matches!(two[0], Load::Constant([x, _]) if near(x, 1.0)));
    assert!(matches!(&two[1], Load::Profile(points) if near(points[1].force[1], 4.0)));
    for (set, message) in [
        ("[{}]", "neither"),
        ("[{force=[0,1],profile=[]}]", "both"),
        ("[{profile=[]}]", "`shaft.loads[0].profile`: "),
        (
            "[{profile=[{time=1,force=[0,0]},{time=0,force=[0,0]}]}]",
            "`shaft.loads[0].profile[1].time`: found 0, expected more than the time before it (1)",
        ),
    ] {
        let error = loads(set).unwrap_err().to_string();
        assert!(error.contains(message), "{set}: {error}");
    }
}

#[test]
fn a_defect_is_a_dent_a_measured_profile_or_a_flat() {
    let defects =
        |set: &str| read(FULL, &[&format!("bearing.defects=[{set}]")]).map(|case| case.bearing.unwrap().defects);
    let dent = defects("{on='inner',angle_deg=10,length=0.8e-3,depth=15e-6}").unwrap();
    assert!(matches!(&dent[0], Defect::Dent(dent)
        if dent.on == Race::Inner && near(dent.rim_radius, 0.05e-3)));
    assert!(matches!(&dent[0], Defect::Dent(dent) if dent.profile == DentProfile::InPlane && dent.width.is_none()));
    // wider than the ball, which is not felt in the plane
    for (profile, width, read) in [("in-plane", 3e-3, DentProfile::InPlane), ("surface", 0.41e-3, DentProfile::Surface)]
    {
        let set = format!("{{on='outer',angle_deg=1,length=1e-3,depth=1e-5,width={width},profile='{profile}'}}");
        assert!(matches!(&defects(&set).unwrap()[0], Defect::Dent(dent)
            if dent.profile == read && dent.width.is_some_and(|found| near(found, width))));
    }
    let measured = defects("{on='outer',angle_deg=10,profile={csv='scan.csv'}}").unwrap();
    assert!(matches!(&measured[0], Defect::Measured(measured)
        if measured.profile.csv == Path::new("folder/scan.csv")));
    let flat = defects("{on='ball',ball=5,flat_radius=2e-3,depth=1e-5}").unwrap();
    assert!(matches!(&flat[0], Defect::Flat(flat) if flat.ball == 5 && flat.angle_deg.abs() < 1e-300));
    for (set, message) in [
        ("{on='inner',length=1e-3,depth=1e-5}", "`bearing.defects[0]` lacks the required key `angle_deg`"),
        (
            "{on='inner',angle_deg=0,length=1e-3,depth=1e-5,ball=1}",
            "found `ball` beside a race, expected keys of a race's defect",
        ),
        (
            "{on='outer',angle_deg=0,profile={csv='a.csv'},depth=1e-5}",
            "found `depth` beside a file, expected the profile in the file alone",
        ),
        (
            "{on='ball',ball=1,flat_radius=2e-3,depth=1e-5,length=1e-3}",
            "found `length` beside a ball, expected keys of a ball's flat",
        ),
        (
            "{on='ball',ball=7,flat_radius=2e-3,depth=1e-5}",
            "`bearing.defects[0].ball`: found 7, expected the number of a ball, counted from 0",
        ),
        (
            "{on='ball',ball=1,flat_radius=1e-3,depth=1e-5}",
            "`bearing.defects[0].flat_radius`: found 0.001, expected more than `bearing.ball_radius` (0.001)",
        ),
        (
            "{on='ball',ball=1,flat_radius=2e-3,depth=1e-5},{on='ball',ball=1,flat_radius=2e-3,depth=1e-5}",
            "`bearing.defects[1].ball`",
        ),
        ("{on='inner',angle_deg=0,length=18e-3,depth=1e-5}", "`bearing.defects[0].length`"),
        (
            "{on='inner',angle_deg=0,length=1e-3,depth=1e-5,profile='surface'}",
            "found profile = \"surface\" without `width`, expected the dent's extent across the race as `width`, or profile = \"in-plane\"",
        ),
        (
            "{on='inner',angle_deg=0,length=1e-3,depth=1e-5,profile='surface',width=2e-3}",
            "`bearing.defects[0].width`: found 0.002, expected below twice `bearing.ball_radius` (0.002)",
        ),
        (
            "{on='inner',angle_deg=0,length=1e-3,depth=1e-5,profile='surface',width=0}",
            "`bearing.defects[0].width`: found 0, expected a number above 0",
        ),
        (
            "{on='inner',angle_deg=0,length=1e-3,depth=1e-5,profile='surfaces',width=2e-4}",
            "`bearing.defects[0].profile` is \"surfaces\", expected one of `in-plane`, `surface`",
        ),
        (
            "{on='ball',ball=1,flat_radius=2e-3,depth=1e-5,profile='surface'}",
            "found profile = \"surface\" beside a ball, expected keys of a ball's flat",
        ),
    ] {
        let error = defects(set).unwrap_err().to_string();
        assert!(error.contains(message), "{set}: {error}");
    }
}

#[test]
fn waves_and_ball_sizes_are_checked() {
    let bearing = |set: &str| read(FULL, &[set]).map(|case| case.bearing.unwrap());
    let wavy = bearing("bearing.waviness=[{on='inner',order=9,amplitude=1e-7}]").unwrap();
    assert!(wavy.waviness[0].on == Race::Inner && wavy.waviness[0].order == 9);
    for (set, message) in [
        (
            "bearing.waviness=[{on='inner',order=0,amplitude=1e-7}]",
            "`bearing.waviness[0].order`: found 0, expected at least 1",
        ),
        ("bearing.waviness=[{on='outer',order=2,amplitude=-1e-7}]", "`bearing.waviness[0].amplitude`: found -1e-7"),
        (
            "bearing.ball_radius_differences=[1e-7]",
            "`bearing.ball_radius_differences`: found 1, expected as many numbers as there are balls",
        ),
        (
            "bearing.ball_radius_differences=[0,0,0,0,0,0,-2e-5]",
            "`bearing.ball_radius_differences[6]`: found -2e-5, expected more than minus a hundredth of the ball's radius",
        ),
    ] {
        let error = bearing(set).unwrap_err().to_string();
        assert!(error.contains(message), "{set}: {error}");
    }
}

#[test]
fn a_ball_pass_needs_loaded_modes() {
    let (message, _) = refusal(&["modes.linearise=none", "modes.ball_pass=true"]);
    assert!(message.contains("`modes.ball_pass`"), "{message}");
    assert!(message.contains("modes.linearise"), "{message}");
    assert!(read(FULL, &["modes.linearise=static", "modes.ball_pass=true"]).unwrap().modes.ball_pass);
}

#[test]
fn a_ball_weighs_what_the_file_says() {
    let mass = |set: &[&str]| read(FULL, set).unwrap().ball_mass().unwrap();
    assert!(near(mass(&[]), 3.29e-5));
    let text = FULL.replace("ball_mass = 3.29e-5", "density = 7800");
    let sphere = 7800.0 * 4.0 / 3.0 * std::f64::consts::PI * 1e-9;
    let case = read(&text, &[]).unwrap();
    assert!(near(case.ball_mass().unwrap(), sphere));
}

#[test]
fn balls_without_inertia_have_no_contact_damping_and_no_printed_equations() {
    let set = |other: &str| {
        let quasi_static = "bearing.balls_inertia=quasi-static";
        let undamped = "bearing.contact_damping=0";
        read(FULL, &[quasi_static, undamped, other]).map(|case| case.bearing.unwrap().balls_inertia)
    };
    let taken = set("bearing.formulation=consistent").unwrap();
    assert_eq!(taken, Some(BallsInertia::QuasiStatic));
    for (other, message) in [
        (
            "bearing.contact_damping=1",
            "`bearing.contact_damping`: found beside `bearing.balls_inertia = \"quasi-static\"`, expected one of the two",
        ),
        (
            "bearing.formulation=printed",
            "`bearing.formulation`: found beside `bearing.balls_inertia = \"quasi-static\"`, expected one of the two",
        ),
    ] {
        let error = set(other).unwrap_err().to_string();
        assert!(error.contains(message), "{error}");
    }
}

/// A bearing by itself with keys of the bearing in space.
const SPATIAL: &str = "[bearing]\nname = \"6204\"\ncontact_angle_deg = 25\npreload = { force = 40 }\n\
    [shaft]\nmass = 1\nloads = [{ force = [1, -2, 30], moment = [0.1, 0] }, { force = [5, 6] }]\n";

#[test]
fn keys_of_the_bearing_in_space_are_read() {
    use crate::app::case::Preload;
    use crate::bearing::spatial::Thrust;
    let case = read(SPATIAL, &[]).unwrap();
    let bearing = case.bearing.as_ref().unwrap();
    // the angle gives the play, c = A (1 - cos a), in the place of the catalogue's
    let between = bearing.inner_groove_radius + bearing.outer_groove_radius - 2.0 * bearing.ball_radius;
    assert!((bearing.play() / (between * (1.0 - 25_f64.to_radians().cos())) - 1.0).abs() < 1e-12);
    assert!(bearing.radial_play.is_none());
    assert_eq!(bearing.thrust_or_default(), Thrust::Positive);
    assert_eq!(bearing.preload, Some(Preload::Force(40.0)));
    let loads = &case.shaft.as_ref().unwrap().loads;
    assert_eq!(loads[0], Load::Spatial { force: [1.0, -2.0, 30.0], moment: [0.1, 0.0], at: 0.0 });
    assert_eq!(loads[1], Load::Constant([5.0, 6.0]));
    // what case results echo is read again
    let echo = serde_json::to_value(&case).unwrap();
    let load = serde_json::json!({ "force": [1.0, -2.0, 30.0], "moment": [0.1, 0.0], "at": 0.0 });
    assert_eq!(echo["shaft"]["loads"][0], load);
    assert_eq!(echo["bearing"]["preload"], serde_json::json!({ "force": 40.0 }));
    let both = read(SPATIAL, &["bearing.thrust=both", "shaft.loads[0].force=[1,-2,0]", "shaft.loads[0].moment=[0,0]"]);
    let both = both.unwrap();
    assert_eq!(both.bearing.unwrap().thrust_or_default(), Thrust::Both);
    assert_eq!(both.shaft.unwrap().loads[0], Load::Constant([1.0, -2.0]));
}

#[test]
fn keys_of_the_bearing_in_space_that_are_wrong_are_named() {
    for (set, rest) in [
        (
            "bearing.contact_angle_deg=90",
            "`bearing.contact_angle_deg`: found 90, expected an angle above 0 and below 90 degrees",
        ),
        (
            "bearing.radial_play=1e-6",
            "`bearing.contact_angle_deg`: found beside `bearing.radial_play`, expected one of the two",
        ),
        (
            "bearing.preload={}",
            "`bearing.preload`: found none of them, expected exactly one of `force`, `displacement`",
        ),
        (
            "bearing.preload={force=1,displacement=1}",
            "`bearing.preload`: found several, expected exactly one of `force`, `displacement`",
        ),
        ("bearing.preload.force=-1", "`bearing.preload.force`: found -1, expected a number above 0"),
        ("bearing.thrust=up", "`bearing.thrust` is \"up\", expected one of `both`, `positive`, `negative`"),
        (
            "shaft.loads[0].force=[1,2,3,4]",
            "`shaft.loads[0].force`: found an array of 4, expected an array of 2, or of 3 in space",
        ),
        (
            "shaft.loads[0]={moment=[1,2]}",
            "`shaft.loads[0]`: found `moment` without `force`, expected `force` = [x, y], or `profile` = [{ time, force }, ...]",
        ),
        ("shaft.loads[0].moment=[1e300,0]", "`shaft.loads[0]`: found 1e300, expected at most 1e15 either way"),
    ] {
        let error = read(SPATIAL, &[set]).unwrap_err().to_string();
        // rules of a whole item stand at its line
        let line = if set.contains("loads[0].moment") { 7 } else { 3 };
        let places = [format!("--set {set}: "), format!("folder/case.toml:{line}: ")];
        assert!(places.iter().any(|place| error == format!("{place}{rest}")), "{error}");
    }
    let no_angle = SPATIAL.replace("contact_angle_deg = 25\n", "thrust = \"negative\"\nradial_play = -1e-6\n");
    let error = read(&no_angle, &[]).unwrap_err().to_string();
    assert!(
        error.contains("`bearing.thrust`: found a one-way thrust with a radial play of -1e-6 m, expected play above 0"),
        "{error}"
    );
}

/// Every command of the plane model refuses the first key that it would ignore, with its place; `bearing` takes all.
#[test]
fn the_plane_model_refuses_keys_of_the_bearing_in_space() {
    use crate::app::case::{Case, Purpose};
    let case = |set: &[&str]| Case::example("scenes/smooth", set);
    for (set, key) in [
        ("bearing.thrust=positive", "bearing.thrust"),
        ("bearing.race_control=shared", "bearing.race_control"),
        ("bearing.preload={displacement=1e-6}", "bearing.preload"),
        ("shaft.loads=[{force=[0,1]},{force=[0,0,1]}]", "shaft.loads[1]"),
        ("shaft.loads=[{force=[0,0],moment=[0,1]}]", "shaft.loads[0]"),
        ("shaft.loads=[{force=[0,1],at=1e-3}]", "shaft.loads[0]"),
        ("shaft.centre=1e-3", "shaft.centre"),
    ] {
        let case = case(&[set, "bearing.radial_play=1e-6"]);
        let error = case.for_stability().unwrap_err();
        assert!(error.to_string().starts_with(&format!("--set {set}: `{key}`: found ")), "{error}");
        assert!(error.help().unwrap().ends_with("or use `plummer run` or `plummer bearing`, which know it"));
        assert!(case.for_run().is_err());
        case.ready_for(Purpose::Bearing).unwrap();
        // a run takes them, if it knows how hard the shaft is to tilt
        let error = case.ready_for(Purpose::Run).unwrap_err();
        assert!(error.to_string().contains("shaft.transverse_inertia: found none, expected one, since `"), "{error}");
    }
    let plane = ["bearing.thrust=both", "bearing.race_control=outer", "shaft.loads=[{force=[0,1,0]}]"];
    case(&plane).ready_for(Purpose::Run).unwrap();
    let alone = SPATIAL
        .replace("contact_angle_deg = 25\npreload = { force = 40 }\n", "")
        .replace(", 30], moment = [0.1, 0]", "]");
    let error = read(&alone, &[]).unwrap().ready_for(Purpose::Modes).unwrap_err();
    assert!(error.to_string().contains("`modes` needs [housing] or [ring], which the case file lacks"), "{error}");
    let error =
        read("[ring]\nsections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n", &[]);
    let error = error.unwrap().ready_for(Purpose::Bearing).unwrap_err();
    assert!(error.to_string().contains("`bearing` needs [bearing], which the case file lacks"), "{error}");
}
