//! The study against `plummer modes` on the same settings: two ways through different code.

use crate::choices::{ContactSource, Equations, Factor, Grid, RingBond, SpringArc, Springs};
use crate::fits::{Fit, Fits, moved_by_one_choice};
use crate::paper::{BOUNCE, SWAY, beam_case, outside_of_ring};
use crate::study::{SharedBearing, Study, agrees, nearest, ring};
use plummer::app::commands::modes::compute_modes;
use plummer::numerics::Unwatched;
use plummer::system::{Equilibrium, LoadedModes, Structure, StructureModes};

/// A corner of the full grid with the known reading in it: 144 readings of 6 rings.
fn small() -> Grid {
    Grid {
        widths: vec![4e-3],
        springs: vec![Springs::CentreLine, Springs::Outside, Springs::Radial],
        arcs: vec![SpringArc::HalfOpen],
        bonds: vec![RingBond::CommonCentroid, RingBond::OwnRadius],
        shear: vec![false],
        rotary_inertia: vec![true],
        steel: vec![210e9],
        aluminium: vec![72e9],
        equations: vec![Equations::Printed, Equations::Consistent],
        contacts: vec![ContactSource::Geometry, ContactSource::TableOne],
        loads: vec![1.0, 2.0],
        cages: vec![0.0, 0.5, 1.0],
    }
}

fn study(grid: Grid) -> Study {
    Study::compute(grid).unwrap()
}

/// The case's keys that make a reading; those that it does not list are as in the built-in case.
struct Twin {
    change: fn(&mut Grid),
    set: &'static [&'static str],
}

const TWINS: [Twin; 7] = [
    Twin { change: |_| {}, set: &[] },
    Twin {
        change: |grid| {
            grid.equations = vec![Equations::Consistent];
            grid.contacts = vec![ContactSource::TableOne];
        },
        set: &["bearing.formulation=consistent", "bearing.stiffness={ inner = 3.828e9, outer = 3.867e9 }"],
    },
    Twin {
        change: |grid| {
            grid.widths = vec![3e-3];
            grid.springs = vec![Springs::CommonNodes];
            grid.rotary_inertia = vec![false];
        },
        set: &[
            "ring.sections[1].area=9e-6",
            "ring.sections[1].inertia=6.75e-12",
            "ring.supports[0].offset=0",
            "ring.rotary_inertia=false",
        ],
    },
    Twin {
        change: |grid| {
            grid.bonds = vec![RingBond::Composite];
            grid.shear = vec![true];
            grid.steel = vec![200e9];
            grid.aluminium = vec![69e9];
            // the attachment is given from the node radius, which goes with the moduli
            grid.springs = vec![Springs::CommonNodes];
        },
        set: &[
            "ring.bond=composite",
            "ring.radius_rule=own",
            "ring.shear=true",
            "materials.steel.young=200e9",
            "materials.aluminium.young=69e9",
            "ring.supports[0].offset=0",
        ],
    },
    Twin {
        change: |grid| {
            grid.bonds = vec![RingBond::OwnRadius];
            grid.arcs = vec![SpringArc::Closed];
            grid.springs = vec![Springs::Outside];
        },
        set: &["ring.radius_rule=own", "ring.supports[0].to_deg=361", "ring.supports[0].offset=3.686e-3"],
    },
    Twin {
        change: |grid| {
            grid.loads = vec![2.0];
            grid.cages = vec![1.0];
        },
        set: &[
            "bearing.first_ball_deg=270",
            // once more the weight of 0.15 kg
            "shaft.loads=[{ force = [0, -1.4715] }]",
        ],
    },
    Twin {
        change: |grid| {
            grid.contacts = vec![ContactSource::RingSteel];
            // at 0.5 a ball is level with the centre: how stiffly it lies depends on the last digits of its angle
            grid.cages = vec![0.4];
        },
        set: &[
            "materials.\"bearing steel\"={ young = 210e9, poisson = 0.3, density = 7850 }",
            "bearing.first_ball_deg=285.428571429",
        ],
    },
];

/// The known reading alone.
fn known() -> Grid {
    Grid {
        springs: vec![Springs::CentreLine],
        bonds: vec![RingBond::CommonCentroid],
        equations: vec![Equations::Printed],
        contacts: vec![ContactSource::Geometry],
        loads: vec![1.0],
        cages: vec![0.0],
        ..small()
    }
}

#[test]
fn a_reading_is_the_case_with_its_keys() {
    for Twin { change, set } in TWINS {
        let mut grid = known();
        change(&mut grid);
        let study = study(grid);
        assert_eq!((study.readings.len(), study.without_equilibrium), (1, 0));
        let found = study.readings[0].nearest_hz;
        let case = beam_case(set).unwrap();
        let modes = compute_modes(&case, &Unwatched).unwrap();
        let loaded = modes.base.loaded.unwrap();
        let ring = nearest(&loaded, |hz| outside_of_ring(hz).abs()).unwrap();
        let expected = [
            loaded.nearest(SWAY).unwrap().frequency_hz,
            loaded.nearest(BOUNCE).unwrap().frequency_hz,
            loaded.modes[ring].frequency_hz,
        ];
        for (found, expected) in found.iter().zip(expected) {
            // modes above 300 kHz by their static response; angles of the case are given to a thousandth of a degree
            let error = found / expected - 1.0;
            assert!(error.abs() < 1e-5, "{set:?}: {found} and {expected} Hz, {error:e}");
        }
    }
}

#[test]
fn the_known_reading_fits_and_is_what_one_choice_is_counted_from() {
    let grid = small();
    let study = study(grid.clone());
    assert_eq!(study.readings.len(), grid.readings());
    let known = grid.known().unwrap();
    let fits = Fits::of(&study);
    let place = fits.rank(&known).unwrap();
    let fit = fits.fits[place - 1];
    assert!(fit.all_shaped() && fit.worst() < 0.012, "{fit:?}");
    // 8292.8, 11265.0 and 35707.2 Hz: this program's own, all digits given
    for (found, expected) in fit.reading.nearest_hz.iter().zip([8292.8, 11265.0, 35707.2]) {
        assert!((found / expected - 1.0).abs() < 1e-5, "{found}");
    }
    let counted: usize = fits.counts.iter().filter(|count| count.factor == Factor::Cage).map(|count| count.fits).sum();
    assert_eq!(counted, fits.fits.len());
    let grouped: usize = fits.groups.iter().map(|group| group.fits).sum();
    assert_eq!(grouped, fits.fits.len());
    let moved = moved_by_one_choice(&study, &known);
    // springs 2, rings 1, equations 1, stiffness 1, load 1, cage 2
    assert_eq!(moved.len(), 8);
    let springs = moved
        .iter()
        .find(|moved| moved.factor == Factor::Springs && grid.label(Factor::Springs, moved.level).contains("outside"));
    assert!(springs.unwrap().by[0] > 0.05 && springs.unwrap().by[2].abs() < 1e-2);
}

/// The shaft's weight held by two balls, the ring alone moving along the load: by its shape a bounce, whatever is nearest.
#[test]
fn shapes_name_modes_where_the_nearest_is_another() {
    let study = study(small());
    let level = |springs| study.grid.springs.iter().position(|s| *s == springs).unwrap();
    let radial = level(Springs::Radial);
    for reading in &study.readings {
        let shares = reading.shapes[2];
        let sum = shares.across + shares.along + shares.turning + shares.two_waves;
        assert!(sum + shares.shaft + shares.balls < 1.0 + 1e-6, "{shares:?}");
        if reading.levels[1] == radial {
            // nothing but contacts and springs across: below what springs with x and y give
            let sway = reading.by_shape.sway.unwrap();
            assert!(sway < 7e3, "{sway}");
            assert!(Fit::of(reading).is_none_or(|fit| !fit.all_shaped()));
        }
    }
    let differing = study.readings.iter().filter(|reading| !agrees(reading.nearest_hz[1], reading.by_shape.bounce));
    assert!(differing.count() > 10);
}

/// Without residual vectors the same basis is wrong by far more than the study's tolerance.
#[test]
fn the_static_response_of_the_modes_left_out_is_what_makes_few_modes_enough() {
    let shared = SharedBearing::new().unwrap();
    let grid = known();
    let levels = grid.structures()[0];
    let structure = Structure::ring_alone(ring(&grid, &levels).unwrap(), shared.setup.gravity);
    let modes = structure.modes().unwrap();
    let (basis, _) = shared.basis(&structure, &modes, 0.0).unwrap();
    let kept = basis.count() - 7;
    let few = StructureModes {
        squared_frequencies: basis.squared_frequencies[..kept].to_vec(),
        shapes: basis.shapes.subcols(0, kept).to_owned(),
        has_more: false,
    };
    let rest = Equilibrium::find(&structure, &shared.setup, shared.condition(0.0)).unwrap();
    let bounce = |modes: &StructureModes| {
        let loaded = LoadedModes::at(&structure, modes, &shared.setup, &rest).unwrap();
        loaded.nearest(11.3e3).unwrap().frequency_hz
    };
    let (exact, with, without) = (bounce(&modes), bounce(&basis), bounce(&few));
    // modes that know of others bring that response themselves
    let knowing = bounce(&StructureModes { has_more: true, ..few });
    assert!((knowing / exact - 1.0).abs() < 1e-5, "{knowing} and {exact}");
    assert!(kept < 20 && modes.count() == 216, "{kept}");
    assert!((with / exact - 1.0).abs() < 1e-5, "{with} and {exact}");
    assert!((without / exact - 1.0).abs() > 5e-5, "{without} and {exact}");
}
