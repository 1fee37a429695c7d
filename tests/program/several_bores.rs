//! Two bearings in one housing, and bores as centre nodes: condensed at once, against the full model and against themselves.

use plummer::app::case::Case;
use plummer::app::commands::condense::{Comparison, CondenseResult, compute_condense};
use plummer::app::commands::frf::compute_frf;
use plummer::app::commands::modes::compute_modes;
use plummer::numerics::Unwatched;
use std::path::Path;

const FREE: &str = "housing.supports=[]";
const SENSOR: &str = "sensors=[{name=\"top\",point=[0,11e-3,15e-3],direction=[0,1,0]}]";

fn load(set: &[&str]) -> Result<Case, String> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/housings/spindle_block.toml");
    let set: Vec<String> = set.iter().map(|&key| key.to_owned()).collect();
    Case::load(path, &set).map_err(|error| error.to_string())
}

fn condensed(set: &[&str]) -> CondenseResult {
    compute_condense(&load(set).unwrap(), Comparison::Full, &Unwatched).unwrap()
}

/// The first elastic frequencies of the free block are above the band that is the default.
const BAND: &str = "accuracy.band_hz=[0,100000]";

/// Centre nodes of both bores, tied in these ways.
fn centres(front: &str, rear: &str) -> String {
    format!(
        "condense.interface={{centres=[{{group=\"front bore\",point=[0,0,2.5e-3],tie=\"{front}\"}},\
         {{group=\"rear bore\",point=[0,0,27.5e-3],tie=\"{rear}\"}}]}}"
    )
}

#[test]
fn two_rings_are_in_the_modes_and_weigh_what_they_weigh() {
    let result = compute_modes(&load(&[FREE, "modes.count=12"]).unwrap(), &Unwatched).unwrap();
    let survey = &result.survey;
    assert_eq!((survey.basis.rigid_modes, survey.rings.len()), (6, 2));
    assert!(survey.basis.count() >= 12);
    // block, and twice 2 pi R rho A
    let ring = 2.0 * std::f64::consts::PI * 5.314e-3 * 5.37e-6 * 7850.0;
    let block = 2700.0 * volume(&result);
    let mass = survey.mass.as_ref().unwrap().mass;
    assert!((mass / (block + 2.0 * ring) - 1.0).abs() < 1e-6, "{mass} {block} {ring}");
    // each ring is where its seat is
    for (shapes, z) in survey.rings.iter().zip([2.5e-3, 27.5e-3]) {
        assert!(shapes.points.iter().all(|point| (point[2] - z).abs() < 1e-15));
    }
}

/// Of the housing's mesh, m^3, by the mass of its own.
fn volume(result: &plummer::app::commands::modes::ModesResult) -> f64 {
    let housing = result.bodies.as_ref().unwrap().housing.as_ref().unwrap();
    plummer::fe::modal::MassProperties::of_housing(&housing.matrices, &housing.model).unwrap().mass / 2700.0
}

#[test]
fn two_bores_condensed_at_once_have_a_whole_certificate() {
    for set in [&[][..], &[FREE]] {
        let result = condensed(set);
        for check in &result.checks {
            assert!(check.ok(), "{set:?}: {check:?}");
        }
        let full = result.full.unwrap();
        let errors = full.relative_errors.iter().flatten();
        let largest = errors.fold(0.0_f64, |largest, error| largest.max(error.abs()));
        // the estimate's target is 0.01
        assert!(largest < 1e-3, "{set:?}: {largest}");
        assert_eq!(result.stage.condensed.superelement.interface_dof, 2 * 6 * 24);
    }
}

/// A force at A felt at B is a force at B felt at A.
#[test]
fn transfer_paths_between_the_bearings_are_reciprocal() {
    let path = |from: &str, to: &str, direction: &str| {
        let force = format!("frf.from=[{{ring_deg=300,bearing=\"{from}\",direction={direction}}}]");
        let sensor = format!("sensors=[{{name=\"there\",ring_deg=300,bearing=\"{to}\",direction={direction}}}]");
        let case = load(&[&force, &sensor, "frf.check_hz=[]"]).unwrap();
        let result = compute_frf(&case, &Unwatched).unwrap();
        result.response.receptance().iter().map(|at| at[(0, 0)]).collect::<Vec<_>>()
    };
    for direction in ["[0,1,0]", "[0,0,1]"] {
        let [there, back] = [path("A", "B", direction), path("B", "A", direction)];
        let largest = there.iter().fold(0.0_f64, |largest, value| largest.max(value.norm()));
        for (a, b) in there.iter().zip(&back) {
            // two computations with the same vectors
            assert!((a - b).norm() < 1e-6 * largest, "{direction}: {a} {b}");
        }
    }
}

#[test]
fn rigid_bores_are_stiffer_than_bores_in_the_mean_which_change_nothing() {
    let lowest = |front: &str, rear: &str| {
        let result = condensed(&[FREE, SENSOR, BAND, &centres(front, rear)]);
        for check in &result.checks {
            assert!(check.ok(), "{front} {rear}: {check:?}");
        }
        let full = result.full.unwrap();
        full.frequencies_hz.into_iter().skip(6).take(3).collect::<Vec<f64>>()
    };
    let [rigid, mixed, mean] = [lowest("rigid", "rigid"), lowest("mean", "rigid"), lowest("mean", "mean")];
    for mode in 0..3 {
        assert!(rigid[mode] > mixed[mode] && mixed[mode] > mean[mode], "{rigid:?} {mixed:?} {mean:?}");
    }
}

/// Rings in both bores and the foot as a node: coordinates of the rings, then of the node. The free block moves rigidly, and a node
/// in the mean leaves its frequencies as `modes` finds them.
#[test]
fn rings_and_a_centre_node_are_one_interface() {
    let modes =
        compute_modes(&load(&[FREE, "modes.count=10"]).unwrap(), &Unwatched).unwrap().survey.basis.frequencies_hz;
    let mut lowest = [0.0; 2];
    for (tie, lowest) in ["mean", "rigid"].into_iter().zip(&mut lowest) {
        let foot = format!(
            "condense.interface={{centres=[{{group=\"foot\",point=[0,-11e-3,15e-3],tie=\"{tie}\"}}],rings=true}}"
        );
        let result = condensed(&[FREE, SENSOR, BAND, &foot]);
        for check in &result.checks {
            assert!(check.ok(), "{tie}: {check:?}");
        }
        for name in ["rigid modes", "rigid motions carried", "frequencies"] {
            assert!(result.checks.iter().any(|check| check.name == name), "{tie}: {name}");
        }
        assert_eq!(result.stage.condensed.superelement.interface_dof, 2 * 6 * 24 + 6);
        let full = result.full.unwrap();
        let largest = full.relative_errors.iter().flatten().fold(0.0_f64, |largest, error| largest.max(error.abs()));
        assert!(largest < 1e-2, "{tie}: {largest}");
        *lowest = full.frequencies_hz[6];
        if tie == "mean" {
            for (found, expected) in full.frequencies_hz.iter().zip(&modes).skip(6) {
                assert!((found / expected - 1.0).abs() < 1e-8, "{found} {expected}");
            }
        }
    }
    assert!(lowest[1] > lowest[0], "{lowest:?}");
}

#[test]
fn what_contradicts_itself_is_refused_by_name() {
    let end = |set: &[&str]| load(set).unwrap_err();
    let seat = "{ring={nodes=24,sections=[{material=\"steel\",area=5e-6,inertia=9e-13,radius=5.3e-3}],outer_radius=6e-3,tie={group=\"front bore\"}}}";
    for (set, expected) in [
        (format!("bearings=[{seat}]"), "`bearings`: found one item, expected two or more"),
        (
            "bearings[1].label=A".to_owned(),
            "`bearings[1].label`: found \"A\" twice, expected a label of its own for each bearing",
        ),
        ("bearings[0].ring.nodes=3".to_owned(), "`bearings[0].ring.nodes`: found 3, expected 8 to 2000 nodes"),
        ("bearings[1].bearing=62049".to_owned(), "`bearings[1].bearing.name`: found \"62049\", expected a bearing"),
        ("bearings[1].ring.tie.axis=[1,0,0]".to_owned(), "`bearings[1].ring.tie.zero_deg`: found the direction"),
        (
            "sensors=[{name=\"a\",point=[0,0,0],bearing=\"A\",direction=[0,1,0]}]".to_owned(),
            "`bearing` beside `ring_deg` alone",
        ),
    ] {
        let found = end(&[&set]);
        assert!(found.contains(expected), "{set}: {found}");
    }
    for (interface, expected) in [
        ("{group=\"foot\",rings=true}", "`rings` beside `group` or `nodes`"),
        (
            "{centres=[{group=\"rear bore\",point=[0,0,0],tie=\"mean\"}],rings=true}",
            "belongs to two interfaces, \"ring\"",
        ),
    ] {
        let set = format!("condense.interface={interface}");
        let found = load(&[&set]).and_then(|case| {
            compute_condense(&case, Comparison::None, &Unwatched)
                .map(|_| String::new())
                .map_err(|error| error.to_string())
        });
        let found = found.unwrap_err();
        assert!(found.contains(expected), "{interface}: {found}");
    }
    let found = end(&["bearing=6204"]);
    assert!(found.contains("`bearings`: found `bearings` beside [bearing], expected one of the two"), "{found}");
    let refused =
        |set: &[&str]| compute_condense(&load(set).unwrap(), Comparison::None, &Unwatched).unwrap_err().to_string();
    let found = refused(&["bearings[1].ring.tie={group=\"front bore\",centre=[0,0,2.5e-3]}"]);
    assert!(found.contains("is in the bores \"front bore\" and \"front bore\""), "{found}");
    let of_frf = |set: &[&str]| compute_frf(&load(set).unwrap(), &Unwatched).unwrap_err().to_string();
    let found = of_frf(&["frf.from=[{ring_deg=270,direction=[0,1,0]}]"]);
    assert!(found.contains("the case has several: add bearing = LABEL, one of \"A\", \"B\""), "{found}");
    let found = of_frf(&["frf.from=[{ring_deg=270,bearing=\"C\",direction=[0,1,0]}]"]);
    assert!(found.contains("found bearing = \"C\", expected one of \"A\", \"B\""), "{found}");
}
