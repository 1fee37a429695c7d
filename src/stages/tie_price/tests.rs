//! What the tie costs where it costs next to nothing, and where it costs much.

use super::*;
use crate::case::Source;
use crate::stages::Unwatched;

const STEEL: &str = "[materials.steel]\nyoung = 210e9\npoisson = 0.3\ndensity = 7850\n";

/// The outer ring of the source's bearing (Table 1) in a bore of 6 mm.
const SECTION: &str =
    "{ material = \"steel\", area = 5.37e-6, inertia = 8.88e-13, radius = 5.314e-3 }";

/// A case beside the repository's meshes; `more` belongs to the ring.
fn case(housing: &str, young: f64, sections: &str, more: &str) -> Case {
    let root = env!("CARGO_MANIFEST_DIR");
    let text = format!(
        "{STEEL}[materials.aluminium]\nyoung = {young:e}\npoisson = 0.33\ndensity = 2700\n\
         [housing]\n{housing}\n\
         parts = [{{ group = \"housing\", material = \"aluminium\" }}]\n\
         [ring]\nnodes = 72\nouter_radius = 6e-3\nsections = [{sections}]\n{more}\n"
    );
    Case::from_source(Source {
        path: format!("{root}/meshes/case.toml").into(),
        text,
        set: Vec::new(),
    })
    .expect("a case")
}

const PLANE: &str = "mesh = \"ring_6_9_coarse.msh\"\nlength_unit = \"mm\"\n\
    plane = { assumption = \"stress\", thickness = 4e-3 }";
/// The same annulus as a solid, 4 mm wide.
const SOLID: &str = "mesh = \"../tests/data/ring3d_hex20.msh\"\nlength_unit = \"m\"";
/// The pillow block, whose bore is 10 mm wide.
const PEDESTAL: &str = "mesh = \"../tests/data/pedestal_10k.msh\"\nlength_unit = \"m\"";
const FEET: &str = "\nsupports = [{ group = \"feet\", fixed = [\"x\", \"y\", \"z\"] }]";
const BONDED: &str = "tie = { group = \"bore\", fit = \"bonded\" }";

fn price(case: &Case, count: usize) -> TiePrice {
    let housing = HousingStage::build(case, &Unwatched);
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
        found.height_m,
        found.width_m,
        found.radius_m,
        found.elements,
        found.free_dof,
        found.rigid_modes
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

fn all_recognised(found: &TieComparison, count: usize) {
    assert_eq!(found.modes.len(), count);
    assert_eq!(found.ring_alone.len(), count);
    for mode in found.modes.iter().chain(&found.ring_alone) {
        assert!(mode.mac.is_some_and(|mac| mac > 0.9), "{mode:?}");
    }
}

#[test]
fn explore() {
    let Ok(list) = std::env::var("TIE_CASES") else {
        return;
    };
    for path in std::fs::read_to_string(list).unwrap().lines() {
        let text = std::fs::read_to_string(path).unwrap();
        let root = env!("CARGO_MANIFEST_DIR");
        let case = Case::from_source(Source {
            path: format!("{root}/meshes/case.toml").into(),
            text,
            set: Vec::new(),
        });
        let case = match case {
            Ok(case) => case,
            Err(error) => {
                println!("{path}: {error:?}");
                continue;
            }
        };
        let started = std::time::Instant::now();
        match price(&case, 10) {
            TiePrice::Computed(found) => show(path, &found),
            TiePrice::NotComputed(reason) => println!("{path}: {reason}"),
        }
        println!("{:?}", started.elapsed());
    }
}
