//! Reference: Tadina and Boltezar 2011, sections 4.1 and 4.2: "8.2 kHz (bearing/housing-pedestal system)",
//!   "11.3 kHz (shaft on the balls)", "36 kHz (ring)"; the linearisation against differences of the
//!   system's own force.
//! Goal: the source's own equations (`printed`) give its three eigenfrequencies for one stated set of its
//!   unreported choices; the `consistent` equations are symmetric, and what that means.
//! Sketch: shaft, 7 balls on their two contacts, ring on 36 springs, linearised where two balls share the
//!   load.
//! Conditions: zero speed, equilibrium under the weight, first ball at 295.714 degrees (one case: 270).
//! Parameters: k from the geometry at 206 GPa; steel 210 GPa and aluminium 72 GPa slipping on the common
//!   centroid radius 6.262 mm, no shear, aluminium 4 mm wide; springs of 1e5 N/m in x and y at 72 nodes'
//!   lower half, attached at the aluminium's centre line (7.5 mm) or at the node radius; see `setup`.
//!
//! The three figures are rounded to 1 % and rest on choices that the source does not report, so agreement
//! shows that the set-up can be reproduced, not that it is right.

use plummer::fe::reduction::frf::ModalDamping;
use std::f64::consts::TAU;

use nalgebra::DMatrix;
use plummer::bearing::defect::{BallFlat, CurvatureReading, Dent, DentShape, FlatShape, RaceDefect};
use plummer::bearing::{Race, Wave};
use plummer::numerics::linalg::{DenseMatrix, general_spectrum};
use plummer::numerics::ode::{SecondOrderSystem, State};
use plummer::system::{
    BearingSetup, CoupledSystem, Equilibrium, FlatOnBall, Formulation, LoadedModes, ModeSelection, StaticCondition,
    Structure, StructureModes,
};

use crate::setup::{
    ContactForces, SYMMETRIC_DEG, column, contact_forces, paper_bearing, paper_section, paper_structure,
};

/// Everything about one equilibrium.
struct Scene {
    structure: Structure,
    modes: StructureModes,
    setup: BearingSetup,
    rest: Equilibrium,
    system: CoupledSystem,
    state: State,
}

impl Scene {
    /// `offset`: how far outside the node radius the springs are attached, m.
    fn new(offset: f64, first_deg: f64, formulation: Formulation) -> Self {
        Self::of(offset, paper_bearing(first_deg, formulation))
    }

    fn of(offset: f64, setup: BearingSetup) -> Self {
        let structure = paper_structure(72, offset);
        let modes = structure.modes().unwrap();
        let rest = Equilibrium::find(&structure, &setup, StaticCondition::at(&setup, 0.0)).unwrap();
        let undamped = ModalDamping::Uniform(0.0);
        let all = ModeSelection::All;
        let system = CoupledSystem::new(&structure, &modes, setup.clone(), all, &undamped, false).unwrap();
        Self { state: system.state_at(0.0, &rest, &modes), structure, modes, setup, rest, system }
    }

    fn loaded(&self) -> LoadedModes {
        LoadedModes::at(&self.structure, &self.modes, &self.setup, &self.rest).unwrap()
    }

    fn mass(&self, coordinate: usize) -> f64 {
        match coordinate.checked_sub(self.modes.count()) {
            None => 1.0,
            Some(0 | 1) => self.setup.shaft.mass,
            Some(_) => self.setup.geometry.ball_mass(),
        }
    }

    /// Stiffness by central differences of the force about the equilibrium, row i times the mass of i.
    fn differenced(&mut self) -> DenseMatrix {
        let order = self.state.y.len();
        let modes = self.modes.count();
        let rest = vec![0.0; order];
        let (mut up, mut down) = (vec![0.0; order], vec![0.0; order]);
        let mut k = DenseMatrix::zeros(order, order);
        let mut y = self.state.y.clone();
        for column in 0..order {
            // 1e-12 m at a contact (mode shapes are up to 30 per root kg): a thousandth of the smallest
            // penetration, 1e-9 m under a ball's own weight, and 1e10 times the round-off of a gap
            let h = if column < modes { 1e-12 / 30.0 } else { 1e-12 };
            y[column] = self.state.y[column] + h;
            self.system.force_into(0.0, &y, &rest, &mut up);
            y[column] = self.state.y[column] - h;
            self.system.force_into(0.0, &y, &rest, &mut down);
            y[column] = self.state.y[column];
            for row in 0..order {
                k[(row, column)] = -self.mass(row) * (up[row] - down[row]) / (2.0 * h);
            }
            k[(column, column)] += self.mass(column) * self.system.linear()[column].squared_frequency;
        }
        k
    }

    /// `M^-1/2 K M^-1/2`.
    fn per_mass(&self, k: &DenseMatrix) -> DenseMatrix {
        DenseMatrix::from_fn(k.nrows(), k.ncols(), |row, column| {
            k[(row, column)] / (self.mass(row) * self.mass(column)).sqrt()
        })
    }

    /// Contact forces before and after a translation (m) of shaft, ring and, as far as their
    /// coordinates are measured from a fixed point, balls.
    fn translated(&mut self, by: [f64; 2], with_ring: bool) -> [ContactForces; 2] {
        let modes = self.modes.count();
        let mut moved = self.state.clone();
        for (place, by) in moved.y[modes..].iter_mut().zip(by) {
            *place += by;
        }
        if with_ring {
            let ring = column(&self.structure.ring().rigid_motion(by[0], by[1], 0.0));
            let momentum = self.structure.mass() * ring;
            let momentum: Vec<f64> = momentum.col(0).iter().copied().collect();
            for mode in 0..modes {
                moved.y[mode] += self.modes.participation(mode, &momentum);
            }
            if self.setup.formulation == Formulation::Consistent {
                for (place, ball) in self.rest.balls.iter().enumerate() {
                    let (sin, cos) = ball.angle.sin_cos();
                    moved.y[modes + 2 + place] += by[0] * cos + by[1] * sin;
                }
            }
        }
        [&self.state, &moved].map(|state| contact_forces(&mut self.system, state))
    }
}

/// Distance of the aluminium's centre line from the node radius, m.
fn to_the_centre_line() -> f64 {
    7.5e-3 - paper_section().radius
}

/// Largest `|k_ij - k_ji| / sqrt(k_ii k_jj)`.
fn asymmetry(k: &DenseMatrix) -> f64 {
    let mut worst: f64 = 0.0;
    for i in 0..k.nrows() {
        for j in 0..i {
            let scale = (k[(i, i)] * k[(j, j)]).abs().sqrt();
            worst = worst.max((k[(i, j)] - k[(j, i)]).abs() / scale);
        }
    }
    worst
}

fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}

/// Frequencies of the modes that are not the balls' own, Hz.
fn without_ball_modes(loaded: &LoadedModes) -> Vec<f64> {
    let own = loaded.modes.iter().filter(|mode| !mode.is_ball_mode());
    own.map(|mode| mode.frequency_hz).collect()
}

fn assert_digits(found: &[f64], expected: &[f64]) {
    for (found, expected) in found.iter().zip(expected) {
        // expected: this program's own, all digits given
        assert!((found / expected - 1.0).abs() < 2e-4, "{found} Hz, expected {expected} Hz");
    }
}

#[test]
fn the_published_eigenfrequencies() {
    assert!((to_the_centre_line() - 1.2377e-3).abs() < 1e-7);
    let loaded = Scene::new(to_the_centre_line(), SYMMETRIC_DEG, Formulation::Printed).loaded();
    for published in [8.2e3, 11.3e3, 36e3] {
        let found = loaded.nearest(published).unwrap().frequency_hz;
        // the source's two to three digits
        assert!((found / published - 1.0).abs() < 0.015, "{found} Hz, published {published} Hz");
    }
    // shaft on ring and springs twice, then one that the source does not name, then its three, the
    // ring's as a pair
    let frequencies = without_ball_modes(&loaded);
    assert_digits(&frequencies[..7], &[317.03, 480.76, 4839.6, 8292.8, 11265.0, 35707.0, 35853.0]);
    assert_eq!((loaded.without_stiffness, loaded.unstable), (0, 0));
}

#[test]
fn springs_at_the_node_radius_lower_the_sway() {
    // attached 1.24 mm further in, the springs hold the ring's rotation less: the sway with rotation
    // falls from 8.29 to 7.79 kHz, the others hardly move
    let loaded = Scene::new(0.0, SYMMETRIC_DEG, Formulation::Printed).loaded();
    let frequencies = without_ball_modes(&loaded);
    assert_digits(&frequencies[3..7], &[7791.0, 11236.0, 35784.0, 35925.0]);
}

#[test]
fn consistent_equations_are_symmetric_and_printed_ones_are_not() {
    for first_deg in [SYMMETRIC_DEG, 270.0] {
        let mut consistent = Scene::new(0.0, first_deg, Formulation::Consistent);
        // differences of step 1e-12 m about penetrations of 1e-9 m and more; found 7e-8
        let found = asymmetry(&consistent.differenced());
        assert!(found < 1e-6, "{first_deg}: {found:e}");
        let mut printed = Scene::new(0.0, first_deg, Formulation::Printed);
        // found 3.2 and 3.1
        let found = asymmetry(&printed.differenced());
        assert!(found > 0.1, "{first_deg}: {found:e}");
    }
}

#[test]
fn the_linearisation_is_that_of_the_force() {
    for first_deg in [SYMMETRIC_DEG, 270.0] {
        let mut scene = Scene::new(0.0, first_deg, Formulation::Consistent);
        let k = scene.differenced();
        let k = scene.per_mass(&k);
        let order = k.nrows();
        let symmetric = DMatrix::from_fn(order, order, |i, j| 0.5 * (k[(i, j)] + k[(j, i)]));
        // another library's solver than the program's
        let mut squares: Vec<f64> = symmetric.symmetric_eigenvalues().iter().copied().collect();
        compare(&mut squares, &scene.loaded());

        let mut scene = Scene::new(0.0, first_deg, Formulation::Printed);
        let k = scene.differenced();
        let spectrum = general_spectrum(&scene.per_mass(&k)).unwrap();
        let mut squares: Vec<f64> = spectrum.values.iter().map(|value| value.re).collect();
        compare(&mut squares, &scene.loaded());
    }
}

/// A ball beside the middle of a dent, in either race, and a ball on its flat; shallower than the play, so that the ball
/// carries load.
#[test]
fn the_linearisation_on_what_is_no_circle_is_that_of_the_force() {
    let sound = paper_bearing(SYMMETRIC_DEG, Formulation::Consistent);
    let (geometry, stiffness) = (sound.geometry, sound.stiffness);
    let below = SYMMETRIC_DEG.to_radians();
    let dent = |race, aside: f64| {
        let shape = DentShape {
            angle: below + aside,
            length: 0.75e-3,
            width: None,
            depth: 0.3e-6,
            rim_radius: 0.05e-3,
            curvature: CurvatureReading::Total,
        };
        let dent = Dent::new(&geometry, race, shape, stiffness).unwrap();
        vec![RaceDefect::Dent(dent)]
    };
    let flat = |angle: f64| {
        let shape =
            FlatShape { radius: 1.2e-3, depth: 0.3e-6, rim_radius: 0.05e-3, curvature: CurvatureReading::Total };
        vec![FlatOnBall { ball: 0, shape: BallFlat::new(&geometry, shape, stiffness).unwrap(), angle }]
    };
    let waves = [Race::Inner, Race::Outer].map(|race| Wave { race, order: 14, amplitude: 0.5e-6, phase: 0.3 });
    let oversizes: Vec<f64> = (0..7).map(|ball| 1e-7 * f64::from(ball)).collect();
    for (race_defects, flats, waves, oversizes) in [
        (dent(Race::Outer, 0.01), vec![], vec![], vec![]),
        (dent(Race::Inner, 0.02), vec![], vec![], vec![]),
        (vec![], flat(0.03), vec![], vec![]),
        (vec![], flat(std::f64::consts::PI - 0.02), vec![], vec![]),
        (vec![], vec![], waves.to_vec(), vec![]),
        (vec![], vec![], vec![], oversizes),
    ] {
        let setup = BearingSetup { race_defects, flats, waves, oversizes, ..sound.clone() };
        let mut scene = Scene::of(0.0, setup);
        assert!(scene.rest.is_stable());
        let force = scene.rest.balls[0].inner;
        assert!(force > 0.1, "the damaged place is under load: {force} N");
        let k = scene.differenced();
        let k = scene.per_mass(&k);
        let order = k.nrows();
        let symmetric = DMatrix::from_fn(order, order, |i, j| 0.5 * (k[(i, j)] + k[(j, i)]));
        let mut squares: Vec<f64> = symmetric.symmetric_eigenvalues().iter().copied().collect();
        compare(&mut squares, &scene.loaded());
    }
}

/// All eigenvalues of a differenced matrix against the linearised modes.
fn compare(squares: &mut [f64], loaded: &LoadedModes) {
    squares.sort_by(f64::total_cmp);
    assert_eq!(squares.len(), loaded.modes.len());
    for (square, mode) in squares.iter().zip(&loaded.modes) {
        let error = (square.sqrt() / TAU / mode.frequency_hz - 1.0).abs();
        // differences are good to (1e-12 / 1e-9)^2 in the softest contact; found 2e-7 there
        assert!(error < 2e-6, "{} Hz: {error:e}", mode.frequency_hz);
    }
}

#[test]
fn the_curvature_of_an_equilibrium_is_that_of_the_force() {
    for first_deg in [SYMMETRIC_DEG, 270.0] {
        let mut scene = Scene::new(0.0, first_deg, Formulation::Consistent);
        let k = scene.differenced();
        let (modes, order) = (scene.modes.count(), k.nrows());
        let block = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
            DMatrix::from_fn(rows.len(), columns.len(), |i, j| {
                let (i, j) = (rows.start + i, columns.start + j);
                0.5 * (k[(i, j)] + k[(j, i)])
            })
        };
        // shaft and balls with the structure following statically
        let (structure, rest) = (0..modes, modes..order);
        let coupling = block(structure.clone(), rest.clone());
        let follow = block(structure.clone(), structure).lu().solve(&coupling).unwrap();
        let condensed = block(rest.clone(), rest) - coupling.transpose() * follow;
        let softest = condensed.symmetric_eigenvalues().min();
        let error = scene.rest.least_curvature / softest - 1.0;
        // differences as above; the geometric term of the wrong sign shows as 4e-4
        assert!(error.abs() < 2e-6, "{first_deg}: {softest} N/m, {error:e}");
    }
}

#[test]
fn a_common_translation_presses_nothing_unless_printed() {
    let by = [3e-9, -5e-9];
    let mut consistent = Scene::new(0.0, SYMMETRIC_DEG, Formulation::Consistent);
    let [before, after] = consistent.translated(by, true);
    // outer contacts: round-off (found 3e-15 N of 0.8 N)
    let outer = largest_difference(&before.outer, &after.outer);
    assert!(outer < 1e-12, "{outer:e} N");
    // inner contacts: the cage holds the balls sideways, and their normals lean by the shaft's
    // displacement over the pitch radius, 1e-3; so does the change against that of a shaft moving alone
    let inner = largest_difference(&before.inner, &after.inner);
    let [_, alone] = consistent.translated(by, false);
    let alone = largest_difference(&before.inner, &alone.inner);
    assert!(inner < 1e-3 * alone, "{inner:e} N, shaft alone {alone:e} N");
    // printed: rigid motion of the ring is counted twice in the outer contacts; found 0.041 N, the
    // contact's 7e6 N/m times the translation along the ball
    let mut printed = Scene::new(0.0, SYMMETRIC_DEG, Formulation::Printed);
    let [before, after] = printed.translated(by, true);
    let outer = largest_difference(&before.outer, &after.outer);
    assert!(outer > 0.03, "{outer:e} N");
}
