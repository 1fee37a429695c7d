use super::*;
use crate::reduction::frf::direct_response;
use crate::reduction::samples::{both_ends, rod};
use crate::reduction::substructure::dense;
use crate::reduction::{BasisChoice, BasisSize, craig_bampton};

const NODES: usize = 80;
/// Of stiffness-proportional damping statics lack nothing.
const UNDAMPED: InteriorDamping<'_> = InteriorDamping {
    structural: None,
    mass: 0.0,
    by_mode: false,
};
/// Stiffness-proportional damping: 0.6 % at 0.02 Hz.
const BETA: f64 = 0.1;

fn system(k: DenseMatrix, m: DenseMatrix) -> ReducedSystem {
    let system = ReducedSystem::new(k, m).expect("square");
    system.with_rayleigh(0.0, BETA).expect("damped")
}

fn condensed(modes: usize) -> CraigBampton {
    let choice = BasisChoice {
        size: BasisSize::Count(modes),
        enhanced: false,
        band_hz: 0.03,
    };
    craig_bampton(&rod(NODES), &both_ends(NODES), choice, None).expect("connected")
}

/// A force and a sensor inside, at nodes of the rod, and one at its end.
const FORCE: usize = 20;
const SENSORS: [usize; 2] = [55, 0];

fn full_paths() -> FrfPaths {
    FrfPaths {
        loads: DenseMatrix::from_fn(NODES, 1, |row, _| f64::from(u8::from(row == FORCE))),
        sensors: DenseMatrix::from_fn(2, NODES, |sensor, row| {
            f64::from(u8::from(row == SENSORS[sensor]))
        }),
    }
}

fn with_statics(condensed: CraigBampton) -> CraigBampton {
    let at = [FORCE, SENSORS[0]];
    let loads = DenseMatrix::from_fn(NODES, 2, |row, end| f64::from(u8::from(row == at[end])));
    let weight = rod(NODES).weight;
    condensed.with_loads(&loads, &weight).expect("finite")
}

fn reduced(condensed: &CraigBampton) -> (ReducedSystem, FrfPaths) {
    let element = &condensed.superelement;
    let row = |node: usize| condensed.recovery_row(node).expect("free");
    let (force, sensors) = (row(FORCE), SENSORS.map(row));
    let paths = FrfPaths {
        loads: DenseMatrix::from_fn(force.len(), 1, |place, _| force[place]),
        sensors: DenseMatrix::from_fn(2, force.len(), |sensor, place| sensors[sensor][place]),
    };
    (
        system(element.stiffness.clone(), element.mass.clone()),
        paths,
    )
}

fn frequencies() -> Vec<f64> {
    (1..=150).map(|step| 2e-4 * f64::from(step)).collect()
}

/// Largest relative errors of the two paths, estimated and true, at each frequency.
fn errors(condensed: &CraigBampton) -> (ResponseEstimate, Vec<f64>) {
    let (system, paths) = reduced(condensed);
    let modes = ModalBasis::new(&system).expect("finite");
    let hz = frequencies();
    let estimate = ResponseEstimate::new(condensed, UNDAMPED, &system, &modes, &paths, &hz);
    let rod = rod(NODES);
    let full = self::system(dense(&rod.stiffness), dense(&rod.mass));
    let full = direct_response(&full, &full_paths(), &hz).expect("damped");
    let own = direct_response(&system, &paths, &hz).expect("damped");
    let errors = full.receptance().iter().zip(own.receptance());
    let errors = errors.map(|(full, own)| {
        let of = |sensor: usize| {
            let full = full[(sensor, 0)];
            (own[(sensor, 0)] - full).norm() / full.norm()
        };
        of(0).max(of(1))
    });
    (estimate.expect("finite"), errors.collect())
}

#[test]
fn estimates_are_honest_at_every_frequency() {
    let (mut judged, mut range) = (0, [f64::INFINITY, 0.0_f64]);
    for modes in [6, 8, 12, 20] {
        let (estimate, errors) = errors(&with_statics(condensed(modes)));
        for (estimated, error) in estimate.relative_errors.iter().zip(&errors) {
            // above it the first order is not enough, below it round-off counts
            if (1e-9..0.01).contains(error) {
                judged += 1;
                range = [
                    range[0].min(estimated / error),
                    range[1].max(estimated / error),
                ];
            }
        }
    }
    // of the order of the largest error: an estimate of first order; measured 0.97 to 1.17 or nearer to one
    assert!(judged > 300, "{judged}");
    assert!(range[0] > 0.9 && range[1] < 1.3, "{range:?}");
}

#[test]
fn residual_vectors_of_responses_reach_any_target() {
    let mut condensed = with_statics(condensed(6));
    let weight = rod(NODES).weight;
    let largest = |errors: &[f64]| errors.iter().copied().fold(0.0, f64::max);
    let (mut estimate, before) = errors(&condensed);
    assert!(largest(&before) > 1.0);
    for target in [1e-2, 1e-4, 1e-6] {
        let (mut vectors, mut true_errors) = (0, Vec::new());
        while estimate.largest().is_some_and(|(_, error)| error > target) {
            vectors += 2;
            assert!(
                vectors <= 8,
                "each pair takes an order of magnitude, found {estimate:?}"
            );
            condensed = condensed
                .with_forces(estimate.forces().clone(), &weight)
                .expect("finite");
            (estimate, true_errors) = errors(&condensed);
        }
        // the estimate is right to a few per cent
        assert!(largest(&true_errors) < 1.1 * target, "{target}");
    }
}

#[test]
fn a_complete_basis_has_no_error() {
    let (estimate, _) = errors(&condensed(NODES - 2));
    let (_, largest) = estimate.largest().unwrap_or_default();
    assert!(largest < 1e-9, "{largest:e}");
}
