use super::*;
use crate::fe::reduction::parts::dense;
use crate::fe::reduction::samples::{both_ends, rod};
use crate::fe::reduction::{BasisChoice, BasisSize, choose_basis};
use crate::numerics::Unwatched;
use crate::numerics::linalg::symmetric_generalised_eigen;

const NODES: usize = 80;

/// Frequencies of the free rod, Hz.
fn full_hz() -> Vec<f64> {
    let rod = rod(NODES);
    let full = symmetric_generalised_eigen(&dense(&rod.stiffness), &dense(&rod.mass));
    let values = full.expect("free").values;
    values.iter().map(|value| value.abs().sqrt() / TAU).collect()
}

fn basis(substructure: &Substructure, size: BasisSize, enhanced: bool, band_hz: f64) -> InteriorBasis {
    let choice = BasisChoice { size, enhanced, band_hz };
    choose_basis(substructure, choice, None, &Unwatched).expect("a basis")
}

#[test]
fn estimates_are_honest_for_every_size_and_band() {
    let substructure = Substructure::new(&rod(NODES), &both_ends(NODES)).expect("connected");
    let full = full_hz();
    let (mut judged, mut range) = (0, [f64::INFINITY, 0.0_f64]);
    for band_hz in [0.01, 0.03, 0.08] {
        for count in [0, 1, 3, 8, 20] {
            for enhanced in [false, true] {
                let basis = basis(&substructure, BasisSize::Count(count), enhanced, band_hz);
                let estimate = ErrorEstimate::of(&substructure, &basis, None, band_hz);
                let estimate = estimate.expect("finite");
                for (mode, hz) in estimate.modes.iter().zip(&full).skip(1) {
                    let error = mode.frequency_hz / hz - 1.0;
                    // below it both are round-off of the dense solver
                    if error > 1e-9 {
                        judged += 1;
                        let factor = mode.relative_error / error;
                        range = [range[0].min(factor), range[1].max(factor)];
                    }
                }
            }
        }
    }
    assert!(judged > 50, "{judged}");
    // an estimate is not to be too small; what is left to extrapolation is at most a quarter of it
    assert!(range[0] > 0.9 && range[1] < 2.0, "{range:?}");
}

#[test]
fn the_rigid_mode_has_no_error() {
    let substructure = Substructure::new(&rod(NODES), &both_ends(NODES)).expect("connected");
    let basis = basis(&substructure, BasisSize::Count(2), false, 0.01);
    let estimate = ErrorEstimate::of(&substructure, &basis, None, 0.01).expect("finite");
    assert!(estimate.modes[0].relative_error < f64::MIN_POSITIVE);
    assert!(estimate.modes[1].relative_error > 1e-8);
}

#[test]
fn all_vectors_kept_leave_no_error() {
    let substructure = Substructure::new(&rod(20), &both_ends(20)).expect("connected");
    let basis = basis(&substructure, BasisSize::Count(18), false, 0.2);
    assert!(basis.complete_below.is_infinite());
    let estimate = ErrorEstimate::of(&substructure, &basis, None, 0.2).expect("finite");
    assert!(estimate.converged && estimate.largest() < 1e-10, "{estimate:?}");
}

#[test]
fn a_residual_vector_a_mode_squares_the_error_away() {
    let substructure = Substructure::new(&rod(NODES), &both_ends(NODES)).expect("connected");
    let largest = |enhanced| {
        let basis = basis(&substructure, BasisSize::Count(12), enhanced, 0.03);
        assert_eq!(basis.count(), 12);
        let estimate = ErrorEstimate::of(&substructure, &basis, None, 0.03);
        estimate.expect("finite").largest()
    };
    // six modes and six residual vectors against twelve modes
    assert!(largest(true) < 0.1 * largest(false), "{:e} {:e}", largest(true), largest(false));
}

#[test]
fn auto_is_the_smallest_of_its_family() {
    let substructure = Substructure::new(&rod(NODES), &both_ends(NODES)).expect("connected");
    for (enhanced, target) in [(false, 1e-4), (true, 1e-4), (true, 1e-7)] {
        let chosen = basis(&substructure, BasisSize::Auto(target), enhanced, 0.03);
        let error = |basis: &InteriorBasis| {
            let estimate = ErrorEstimate::of(&substructure, basis, None, 0.03);
            estimate.expect("finite").largest()
        };
        assert!(error(&chosen) <= target);
        if !enhanced {
            let count = chosen.count();
            let fewer = basis(&substructure, BasisSize::Count(count - 1), false, 0.03);
            assert!(error(&fewer) > target, "{count}");
        } else {
            let plain = basis(&substructure, BasisSize::Auto(target), false, 0.03);
            assert!(chosen.count() < plain.count(), "{} {}", chosen.count(), plain.count());
        }
    }
}

#[test]
fn a_target_out_of_reach_is_an_error() {
    let substructure = Substructure::new(&rod(12), &both_ends(12)).expect("connected");
    let choice = BasisChoice { size: BasisSize::Auto(-1.0), enhanced: false, band_hz: 0.05 };
    let error = choose_basis(&substructure, choice, None, &Unwatched).expect_err("out of reach").to_string();
    assert!(error.starts_with("no basis of up to 10 vectors brings the estimated error"), "{error}");
}
