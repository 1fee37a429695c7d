//! What the tie costs where it costs next to nothing, and where it costs much.

use super::price::*;
use super::*;
use crate::app::case::{Case, Source};
use crate::app::scene::AssembledHousing;
use crate::numerics::Unwatched;

const STEEL: &str = "[materials.steel]\nyoung = 210e9\npoisson = 0.3\ndensity = 7850\n";

/// The outer ring of the source's bearing (Table 1) in a bore of 6 mm.
const SECTION: &str = "{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }";

/// A case beside the repository's meshes; `more` belongs to the ring.
fn case(housing: &str, young: f64, sections: &str, more: &str) -> Case {
    let root = env!("CARGO_MANIFEST_DIR");
    let text = format!(
        "{STEEL}[materials.aluminium]\nyoung = {young:e}\npoisson = 0.33\ndensity = 2700\n\
         [housing]\n{housing}\n\
         parts = [{{ group = \"housing\", material = \"aluminium\" }}]\n\
         [ring]\nnodes = 72\nouter_radius = 6e-3\nsections = [{sections}]\n{more}\n"
    );
    Case::from_source(Source { path: format!("{root}/meshes/case.toml").into(), text, set: Vec::new() })
        .expect("a case")
}

const PLANE: &str = "mesh = \"ring_6_9_coarse.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }";
/// A pillow block on fixed feet, 4 mm wide, which is 5 % more than the ring's rectangle.
const NARROW: &str = "mesh = \"../tests/data/pedestal_10k.msh\"\nlength_unit = \"m\"\n\
    supports = [{ group = \"feet\", fixed = [\"x\", \"y\", \"z\"] }]";
/// Another one, 10 mm wide.
const WIDE: &str = "mesh = \"pedestal.msh\"\nlength_unit = \"mm\"\n\
    supports = [{ group = \"feet\", fixed = [\"x\", \"y\", \"z\"] }]";
const BONDED: &str = "tie = { group = \"bore\", fit = \"bonded\" }";

/// Largest magnitude of the relative differences; `None` if no mode was recognised.
fn largest(modes: &[BeamAndSolid]) -> Option<f64> {
    let differences = modes.iter().filter_map(|mode| mode.relative_difference);
    differences.map(f64::abs).reduce(f64::max)
}

fn price(case: &Case, count: usize) -> TiePrice {
    let housing = AssembledHousing::build(case, &Unwatched);
    let housing = housing.expect("a model").expect("a housing");
    tie_price(case, &housing, count, &Unwatched).expect("modes")
}

fn computed(case: &Case, count: usize) -> TieComparison {
    match price(case, count) {
        TiePrice::Computed(comparison) => *comparison,
        TiePrice::NotComputed(reason) => panic!("{reason}"),
    }
}

fn show(what: &str, found: &TieComparison) {
    println!(
        "{what}: {:.4e} x {:.4e} m at {:.4e} m, {} elements, free dof {:?}, rigid {:?}",
        found.height_m, found.width_m, found.radius_m, found.elements, found.free_dof, found.rigid_modes
    );
    found.notes.iter().for_each(|note| println!("  {note}"));
    for (name, modes) in [("in the bore", &found.modes), ("alone", &found.ring_alone)] {
        for mode in modes {
            println!(
                "  {name} {:2} {:11.2} {:11.2} {:+.3e} {:.6}",
                mode.mode,
                mode.beams_hz,
                mode.solid_hz.unwrap_or(f64::NAN),
                mode.relative_difference.unwrap_or(f64::NAN),
                mode.mac.unwrap_or(f64::NAN)
            );
        }
    }
}

fn differences(modes: &[BeamAndSolid]) -> Vec<f64> {
    let known = modes.iter().filter_map(|mode| mode.relative_difference);
    known.collect()
}

fn refused(case: &Case) -> NoTiePrice {
    match price(case, 2) {
        TiePrice::Computed(found) => panic!("computed: {found:?}"),
        TiePrice::NotComputed(reason) => reason,
    }
}

/// In the plane nothing of the bore lies beside the section: what differs is of the size that the beams themselves differ
/// from a body, 2 % for a ring whose height is a quarter of its radius.
#[test]
fn in_the_plane_the_tie_costs_what_the_beams_do() {
    for plane in [PLANE.to_owned(), PLANE.replace("stress", "strain")] {
        let found = computed(&case(&plane, 72e9, SECTION, BONDED), 10);
        show("plane", &found);
        assert_eq!(found.rigid_modes, [3, 3]);
        assert_eq!(differences(&found.modes).len(), 10);
        let floor = largest(&found.ring_alone).expect("recognised");
        assert!((0.015..0.025).contains(&floor), "{floor}");
        let largest = largest(&found.modes).expect("recognised");
        assert!(largest < 1.5 * floor, "{largest} {floor}");
        let like = |mode: &BeamAndSolid| mode.mac.is_some_and(|mac| mac > 0.98);
        assert!(found.modes.iter().chain(&found.ring_alone).all(like));
        // a plane stress ring either way
        let hz = found.ring_alone[0].solid_hz.expect("two waves");
        // 128 and 160 elements agree to 5e-5
        assert!((hz / 30_833.4 - 1.0).abs() < 2e-4, "{hz}");
    }
}

/// Ring and housing of the same section and material but for the width of the bore: beams stiffen the part of the bore
/// that lies beside the ring, and a bore that is hardly wider has no such part.
#[test]
fn a_bore_wider_than_the_ring_is_stiffened() {
    let narrow = computed(&case(NARROW, 70e9, SECTION, BONDED), 10);
    show("4 mm", &narrow);
    let wide = computed(&case(WIDE, 70e9, SECTION, BONDED), 10);
    show("10 mm", &wide);
    for found in [&narrow, &wide] {
        assert_eq!(found.rigid_modes, [0, 0]);
        assert_eq!(differences(&found.modes).len(), 10);
        assert_eq!(differences(&found.ring_alone).len(), 10);
        // beams are softer than the body, which bends across its width as well
        assert!(differences(&found.ring_alone).iter().all(|&d| d < 0.0));
    }
    for difference in differences(&narrow.modes) {
        assert!((-0.015..0.002).contains(&difference), "{difference}");
    }
    for difference in differences(&wide.modes) {
        assert!((0.01..0.05).contains(&difference), "{difference}");
    }
}

/// A ring in a housing a thousand times as soft moves as a rigid body, in which beams and bodies do not differ.
#[test]
fn in_a_soft_housing_the_price_is_small() {
    let found = computed(&case(PLANE, 72e6, SECTION, BONDED), 6);
    show("soft", &found);
    let [largest, floor] = [largest(&found.modes), largest(&found.ring_alone)].map(Option::unwrap);
    assert!(largest < 0.2 * floor, "{largest} {floor}");
}

/// The ring's springs are carried over: the modes in which everything goes to and fro on them are the same, and the turn
/// of the free housing is without strain.
#[test]
fn a_sliding_ring_keeps_its_springs_and_its_freedom() {
    let springs = "tie = { group = \"bore\", fit = \"sliding\" }\n\
        supports = [{ from_deg = 0, to_deg = 360, spring = { x = 1e3, y = 1e3 }, per = \"total\" }]";
    let found = computed(&case(PLANE, 72e9, SECTION, springs), 8);
    show("sliding", &found);
    assert_eq!(found.rigid_modes, [1, 1]);
    let differences = differences(&found.modes);
    assert_eq!(differences.len(), 8);
    // masses and springs are the same but for arcs that are parabolas
    assert!(differences[..2].iter().all(|d| d.abs() < 1e-6));
    // the ring's turn: about its centre a body has rho A R^2 (1 + h^2 / (4 R^2)) a length, beams have h^2 / (12 R^2)
    let slim = (found.height_m / found.radius_m).powi(2);
    let expected = ((1.0 + slim / 4.0) / (1.0 + slim / 12.0)).sqrt() - 1.0;
    // the next power of h / R is 5e-3 of it; the housing does not turn along
    assert!((differences[2] / expected - 1.0).abs() < 1e-2, "{differences:?} {expected}");
    assert!(found.notes.iter().any(|note| note.contains("slides")));
    assert!(found.notes.iter().any(|note| note.contains("springs hold")));
}

#[test]
fn a_section_that_does_not_reach_the_bore_is_moved_there() {
    let thinner = SECTION.replace("5.314e-3", "5.1e-3");
    let found = computed(&case(PLANE, 72e9, &thinner, BONDED), 2);
    assert!((found.radius_m + 0.5 * found.height_m - 6e-3).abs() < 1e-15);
    assert!(found.notes.iter().any(|note| note.contains("was moved by")));
    let kept = computed(&case(PLANE, 72e9, SECTION, BONDED), 2);
    assert!((kept.radius_m - 5.314e-3).abs() < 1e-15);
    assert!(kept.notes.iter().any(|note| note.contains("rigid arm")));
}

#[test]
fn what_has_no_solid_counterpart_is_refused_with_its_reason() {
    let two = format!("{SECTION}, {SECTION}");
    let several = refused(&case(PLANE, 72e9, &two, BONDED));
    assert_eq!(several, NoTiePrice::SeveralSections { count: 2 });
    let far = SECTION.replace("5.314e-3", "4.5e-3");
    let reason = refused(&case(PLANE, 72e9, &far, BONDED));
    assert!(matches!(reason, NoTiePrice::Rectangle { .. }), "{reason}");
    let tied = case(PLANE, 72e9, SECTION, BONDED);
    let housing = AssembledHousing::build(&tied, &Unwatched).expect("a model");
    let alone = Case { ring: None, ..tied };
    let found = tie_price(&alone, &housing.expect("a housing"), 2, &Unwatched);
    let found = found.expect("nothing to compute");
    assert_eq!(found, TiePrice::NotComputed(NoTiePrice::NoTie));
    assert_eq!(affordable(LARGEST), Ok(()));
    let too_large = affordable(LARGEST + 1).expect_err("too large");
    assert!(too_large.to_string().contains("250001 degrees of freedom, more than 250000"));
}
