//! Transfer paths of a small housing: estimated errors are true, `auto` reaches its target, variants are ranked.

use super::*;
use crate::app::case::{Case, Purpose, Source};
use crate::app::commands::condense::superelement_record;
use crate::app::scene::CondensedHousing;
use crate::formats::write_superelement_npz;
use crate::numerics::Unwatched;

const HOUSING: &str = "title = \"small\"\n\
    [materials.aluminium]\nyoung = 70e9\npoisson = 0.33\ndensity = 2700\n\
    [housing]\nmesh = \"ring_6_9_coarse.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }\n\
    parts = [{ group = \"housing\", material = \"aluminium\" }]\n\
    supports = [{ group = \"lower\", spring = { x = 1e7, y = 1e7 } }]\n\
    [ring]\nnodes = 24\nouter_radius = 6e-3\n\
    sections = [{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }]\n\
    tie = { group = \"bore\", centre = [0, 0, 0], axis = [0, 0, 1], zero_deg = [1, 0, 0] }\n\
    [[sensors]]\nname = \"top\"\npoint = [0, 9e-3, 0]\ndirection = [0, 1, 0]\n\
    [frf]\nfrom = [{ name = \"load zone\", ring_deg = 270, direction = [0, -1, 0] },\n\
      { name = \"aside\", ring_deg = 0, direction = [1, 0, 0] }]\n";

const DAMPED: &str =
    "[damping]\nratios = [{ frequency_hz = 3000, ratio = 0.01 }, { frequency_hz = 60000, ratio = 0.01 }]\n";

fn case(text: String, set: &[&str]) -> Case {
    let root = env!("CARGO_MANIFEST_DIR");
    let case = Case::from_source(Source {
        path: format!("{root}/meshes/small.toml").into(),
        text,
        set: set.iter().map(|key| (*key).to_owned()).collect(),
    });
    case.unwrap()
}

fn result(rest: &str, set: &[&str]) -> FrfResult {
    compute_frf(&case(format!("{HOUSING}{rest}"), set), &Unwatched).unwrap()
}

/// Several modes, zeros between them, and a band up to where the first modes that are left out begin.
fn accuracy(target: &str) -> String {
    format!("{DAMPED}[accuracy]\nband_hz = [0, 60000]\ntarget = {target}\n")
}

#[test]
fn auto_reaches_the_target_and_no_more_than_it_needs() {
    let mut vectors = 0;
    for target in ["1e-2", "1e-4", "1e-6"] {
        let found = result(&accuracy(target), &[]);
        assert!(found.passes(), "{target}: {:?}", found.largest_difference());
        let (_, difference) = found.largest_difference().unwrap();
        assert!(difference <= found.target);
        let count = found.housing.element().modal_dof();
        assert!(count > vectors, "{target}: {count} vectors");
        vectors = count;
    }
}

/// The coarse ring has elements of about 1 mm, whose nodes alone vibrate at 1.5 MHz.
#[test]
fn a_band_beyond_what_the_mesh_tells_is_refused() {
    let refused = case(format!("{HOUSING}{}", accuracy("1e-2")), &["frf.band_hz=[0,1e9]"]);
    let error = compute_frf(&refused, &Unwatched).unwrap_err();
    let told = error.to_string();
    let start = "--set frf.band_hz=[0,1e9]: `frf.band_hz[1]`: found 1e9, expected at most what the mesh tells, half the frequency of a node while all others are held (";
    let highest = told.strip_prefix(start).unwrap_or_else(|| panic!("{told}")).trim_end_matches(')');
    assert!((2e5..2e6).contains(&highest.parse::<f64>().unwrap()), "{told}");
    assert!(error.is_input() && error.help().is_some_and(|help| help.contains("make the mesh finer")));
}

/// A force downwards at the foot of a housing that is the same left and right moves its top in x by round-off alone.
#[test]
fn a_path_that_symmetry_closes_is_told_and_no_error() {
    let even = "housing.mesh=\"ring_6_9_24.msh\"";
    let sideways = "sensors.0.direction=[1,0,0]";
    let found = result(&accuracy("1e-2"), &[even, sideways]);
    let closed: Vec<bool> = found.paths.iter().map(TransferPath::is_closed).collect();
    assert_eq!(closed, [true, false]);
    assert!(found.passes(), "{:?}", found.largest_difference());
    // of a mesh that is not even both carry something
    let uneven = result(&accuracy("1e-2"), &[sideways]);
    assert!(!uneven.paths.iter().any(TransferPath::is_closed));
}

/// The response to a force is the sum of those to its parts, across the ring's plane too.
#[test]
fn a_force_on_a_ring_in_space_has_three_parts() {
    let parts = [[1.0, 0.5, 2.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let from = parts
        .iter()
        .enumerate()
        .map(|(number, direction)| format!("{{ name = \"{number}\", ring_deg = 30, direction = {direction:?} }}"));
    let from = format!("frf.from=[{}]", from.collect::<Vec<_>>().join(","));
    let sensor = "sensors=[{name='s',ring_deg=100,direction=[0.3,0.4,0.5]}]";
    let set = [&*from, sensor, "frf.to=['s']", "frf.check_hz=[5000, 15000]", "frf.band_hz=[0, 20000]"];
    let case = Case::example("transfer/pedestal", &set);
    let found = compute_frf(&case, &Unwatched).unwrap();
    assert!(found.passes(), "{:?}", found.largest_difference());
    for at in found.response.receptance() {
        let of = |load: usize| at[(0, load)];
        let sum = of(1) + of(2) * 0.5 + of(3) * 2.0;
        let whole = of(0) * (5.25_f64).sqrt();
        assert!((whole - sum).norm() < 1e-9 * sum.norm(), "{whole} {sum}");
        assert!(of(3).norm() > 1e-3 * of(1).norm());
    }
}

#[test]
fn a_direction_across_a_plane_model_is_refused() {
    let message = |key: &str| {
        let case = case(format!("{HOUSING}{}", accuracy("1e-2")), &[key]);
        compute_frf(&case, &Unwatched).unwrap_err().to_string()
    };
    let force = message("frf.from=[{name='axial',ring_deg=270,direction=[0,1,1]}]");
    assert!(force.starts_with("force \"axial\": direction has a part across"), "{force}");
    let sensor = message("sensors.0.direction=[0,1,0.01]");
    assert!(sensor.starts_with("sensor \"top\": direction has a part across"), "{sensor}");
}

#[test]
fn estimates_are_those_of_the_full_model() {
    let sizes = ["8", "12", "20"].map(|size| format!("condense.fixed_interface_modes={size}"));
    let check = "frf.check_hz=[1000, 9000, 17000, 25000, 33000, 41000, 49000, 57000]";
    let mut judged = 0;
    for size in &sizes {
        let found = result(&accuracy("0.01"), &[size, check]);
        for at in &found.compared {
            let factor = at.estimated.unwrap() / at.difference;
            // above a per cent the first order is not enough, below 1e-9 both solutions are round-off
            if (1e-9..0.01).contains(&at.difference) {
                judged += 1;
                assert!((0.8..3.0).contains(&factor), "{size}: {at:?}");
            }
        }
    }
    assert!(judged >= 12, "{judged}");
}

/// Damping in proportion to mass takes forces of the interior as inertia does: at 1e6 /s it is 16 times as large at 10 kHz.
#[test]
fn strong_mass_damping_is_estimated() {
    let check = "frf.check_hz=[1000, 9000, 17000, 25000, 33000, 41000, 49000, 57000]";
    for alpha in ["1e5", "1e6"] {
        let damping = format!("damping={{alpha={alpha},beta=0}}");
        let set = ["condense.fixed_interface_modes=20", check, &damping];
        let found = result(&accuracy("0.01"), &set);
        for at in &found.compared {
            let factor = at.estimated.unwrap() / at.difference;
            if (1e-9..0.1).contains(&at.difference) {
                assert!((0.5..5.0).contains(&factor), "{alpha}: {at:?}");
            }
        }
        assert!(found.compared.iter().any(|at| at.difference > 1e-9), "{alpha}");
    }
}

#[test]
fn a_basis_that_is_too_small_does_not_pass() {
    let small = ["condense.fixed_interface_modes=0", "condense.enhanced=false"];
    let found = result(&accuracy("1e-4"), &small);
    assert!(!found.passes());
    // the estimate alone tells
    let mut unchecked = small.to_vec();
    unchecked.push("frf.check_hz=[]");
    let found = result(&accuracy("1e-4"), &unchecked);
    assert!(found.compared.is_empty() && !found.passes());
}

#[test]
fn undamped_and_lossy_housings_are_compared_too() {
    let band = "[accuracy]\nband_hz = [0, 5000]\ntarget = 1e-3\n";
    let found = result(band, &["frf.check_hz=[500, 2500]"]);
    assert_eq!(found.compared.len(), 2);
    assert!(found.passes(), "{:?}", found.compared);
    // a loss factor that the ring does not have couples the modes: no sum of modes
    let lossy =
        result(&accuracy("1e-3"), &["materials.aluminium={young=70e9, poisson=0.33, density=2700, loss_factor=0.05}"]);
    assert!(lossy.passes(), "{:?}", lossy.largest_difference());
    let imaginary = |found: &FrfResult| found.response.receptance()[10][(0, 0)].im.abs();
    assert!(imaginary(&lossy) > 10.0 * imaginary(&result(&accuracy("1e-3"), &[])));
}

/// One ratio for every mode has a counterpart in the full model. With all vectors of the interior both are the same; with the program's
/// choice the difference is what was estimated.
#[test]
fn one_ratio_for_every_mode_is_compared_with_the_full_model() {
    let damping = ["damping={modal=0.02}"];
    let found = result("[accuracy]\nband_hz = [0, 60000]\ntarget = 1e-3\n", &damping);
    assert!(found.compared.len() > 4 && found.not_compared.is_none() && found.passes(), "{:?}", found.compared);
    let of_full = found.full_damping.unwrap();
    assert!(of_full.modes > 4 && of_full.ritz_vectors > 4 && of_full.up_to_hz >= 90e3, "{of_full:?}");
    assert!(of_full.left_out < 1e-4, "{of_full:?}");
    // what the damping above lacks, beside what the estimate says
    for at in &found.compared {
        assert!(at.residual < 1e-10 && at.difference < 1.5 * at.estimated.unwrap() + of_full.left_out, "{at:?}");
    }
    let all = ["damping={modal=0.02}", "condense.fixed_interface_modes={up_to_hz=1e9}"];
    let whole = result("[accuracy]\nband_hz = [0, 60000]\ntarget = 1e-3\n", &all);
    let (_, difference) = whole.largest_difference().unwrap();
    println!("{difference:e} {:?}", whole.full_damping);
    assert!(difference < 2.0 * whole.full_damping.unwrap().left_out, "{difference:e}");
}

/// Where nothing is compared, a warning says why.
#[test]
fn what_is_not_compared_is_a_warning() {
    let found = result(&accuracy("1e-2"), &["frf.check_hz=[]"]);
    let told = "nothing was compared with the full model: no frequency was asked for";
    assert!(found.doubts.iter().any(|doubt| doubt == told), "{:?}", found.doubts);
    assert!(!result(&accuracy("1e-2"), &[]).doubts.iter().any(|doubt| doubt.contains("compared")));
}

#[test]
fn the_modes_that_carry_a_path_add_up_to_it() {
    let found = result(&accuracy("1e-3"), &[]);
    let path = &found.paths[0];
    let strongest = &path.carried[0];
    let peak = found.response.frequencies_hz().iter().position(|hz| *hz >= strongest.frequency_hz).unwrap();
    let whole = found.response.receptance()[peak][path.place];
    // at its own resonance a mode of 1 % damping is nearly all
    assert!((strongest.receptance[peak] - whole).norm() < 0.1 * whole.norm());
}

#[test]
fn the_variant_with_softer_supports_transmits_less_above_its_resonance() {
    let variants = "frf.variants=[{what=\"soft\", set=[\"housing.supports[0].spring={x=1e6, y=1e6}\"]}]";
    let found = result(&accuracy("1e-2"), &[variants]);
    let names: Vec<&str> = found.ranking[0].variants.iter().map(|variant| &*variant.name).collect();
    assert_eq!(names.len(), 2);
    let level = |name: &str| {
        let at = names.iter().position(|own| *own == name).unwrap();
        found.ranking[0].variants[at].mean_db
    };
    assert!(level("soft").is_finite() && level("as given").is_finite());
    assert!(found.ranking[0].variants[0].mean_db <= found.ranking[0].variants[1].mean_db);
}

/// Between places on the ring a basis of given size is all that there is: the superelement of `condense` is the same.
#[test]
fn a_superelement_from_a_file_has_the_responses_that_it_came_with() {
    let size = ["condense.fixed_interface_modes=12"];
    let race = "[[sensors]]\nname = \"race\"\nring_deg = 30\ndirection = [0, 1, 0]\n";
    let meshed = format!("{HOUSING}to = [\"race\"]\n{race}{}", accuracy("0.1"));
    let expected = compute_frf(&case(meshed.clone(), &size), &Unwatched).unwrap();
    assert!(expected.estimate.is_some());

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("superelement.npz");
    let whole = case(meshed, &size);
    let stage = CondensedHousing::build(&whole, &Unwatched).unwrap().unwrap();
    write_superelement_npz(&path, &superelement_record(&whole, &stage).unwrap()).unwrap();
    let ring = &HOUSING[HOUSING.find("[ring]").unwrap()..HOUSING.find("tie = ").unwrap()];
    let frf = &HOUSING[HOUSING.find("[frf]").unwrap()..];
    let imported = format!("[housing]\nsuperelement = {path:?}\n{ring}{race}{frf}{}", accuracy("0.1"));
    let imported = case(imported, &[]);
    imported.ready_for(Purpose::Frf).unwrap();
    let found = compute_frf(&imported, &Unwatched).unwrap();
    assert!(found.estimate.is_none() && found.compared.is_empty() && found.passes());
    assert!(found.not_compared.unwrap().contains("superelement from a file"));
    let both = found.response.receptance().iter().zip(expected.response.receptance());
    assert_eq!(found.paths.len(), 2);
    for (found, expected) in both {
        for load in 0..2 {
            let expected = expected[(0, load)];
            // the same matrices, from a file that keeps every bit; modes are summed in the same order
            assert!((found[(0, load)] - expected).norm() <= 1e-12 * expected.norm());
        }
    }
    // a force cannot act on a mesh that is not known
    let on_mesh = case(
        format!("[housing]\nsuperelement = {path:?}\n{ring}{race}{frf}{}", accuracy("0.1")),
        &["frf.from=[{node=1, direction=[0, 1, 0]}]"],
    );
    let error = compute_frf(&on_mesh, &Unwatched).unwrap_err();
    assert!(error.is_input() && error.to_string().contains("node 1"), "{error}");
}
