//! In its plane the spatial system is the plane one, and costs little more.

use super::*;

/// One deep groove bearing under a radial load, as the plane system and as the spatial one, each with its start at rest.
struct Twins {
    plane: (CoupledSystem, State, Equilibrium),
    spatial: (SpatialSystem, State, SpatialEquilibrium),
}

impl Twins {
    fn new(kept: ModeSelection, dents: &[(Race, f64)]) -> Self {
        let geometry = geometry().with_radial_play(-1.5e-6).unwrap();
        let stiffness: ContactStiffness = RaceContacts::new(&geometry, STEEL, STEEL, STEEL).unwrap().stiffness();
        let setup = BearingSetup {
            cage: cage(&geometry, FIRST, 30.0),
            geometry,
            stiffness,
            contact_damping: 0.5,
            formulation: Formulation::Consistent,
            balls_inertia: BallsInertia::Dynamic,
            waves: Vec::new(),
            oversizes: Vec::new(),
            race_defects: dents.iter().map(|&place| dent(place, &geometry, stiffness)).collect(),
            flats: Vec::new(),
            shaft: Shaft { mass: 0.15, unbalance: 2e-5, loads: vec![LoadProfile::constant([1.0, -6.0])] },
            gravity: [0.0, -9.81],
        };
        let damping = ModalDamping::Uniform(0.01);
        let structure = Structure::ring_alone(ring(false, 1.0), [0.0, -9.81]);
        let modes = structure.modes().unwrap();
        let rest = Equilibrium::find(&structure, &setup, StaticCondition::at(&setup, 0.0)).unwrap();
        let plane = CoupledSystem::new(&structure, &modes, setup, kept, &damping, false).unwrap();
        let start = plane.state_at(0.0, &rest, &modes);
        let plane = (plane, start, rest);

        let mut own = bearing(Thrust::Both, 0.0, 0.0, 30.0);
        own.bearing = dented(&own.bearing.with_stiffness(stiffness), dents, None);
        own.contact_damping = 0.5;
        let shaft = SpatialShaft {
            unbalances: vec![Unbalance { moment: 2e-5, angle: 0.0, place: 0.0 }],
            ..shaft(vec![SpatialLoad { place: 0.0, profile: LoadProfile::constant([1.0, -6.0, 0.0, 0.0, 0.0]) }])
        };
        let setup = SpatialSetup { shaft, bearings: vec![own], gravity: [0.0, -9.81, 0.0] };
        let structure = Structure::ring_alone(ring(true, 1.0), [0.0, -9.81]);
        let modes = structure.modes().unwrap();
        let rest = SpatialEquilibrium::find(&structure, &setup, &SpatialCondition::at(&setup, 0.0)).unwrap();
        let spatial = SpatialSystem::new(&structure, &modes, setup, kept, &damping).unwrap();
        let start = spatial.state_at(0.0, &rest, &modes);
        Self { plane, spatial: (spatial, start, rest) }
    }
}

/// A radial load in the plane: to the same motion as the plane system's.
#[test]
fn in_the_plane_it_is_the_plane_system() {
    let Twins { plane: (mut of_plane, start, rest), spatial: (mut spatial, spatial_start, found) } =
        Twins::new(ModeSelection::All, &[]);
    for (ball, expected) in found.bearings[0].iter().zip(&rest.balls) {
        // both searches end at a force out of balance of 1e-11 of the load
        assert!((ball.load[0] - expected.inner).abs() < 1e-9, "{ball:?} {expected:?}");
        assert!((ball.load[1] - expected.outer).abs() < 1e-9, "{ball:?} {expected:?}");
    }
    let method = Method::ExponentialAdams { tolerance: None };
    let expected = states(&mut of_plane, start, method, 1e-7, 10, 500);
    let found = states(&mut spatial, spatial_start, method, 1e-7, 10, 500);
    let (n, m) = (of_plane.modes(), spatial.modes);
    let geometry = of_plane.setup().geometry;
    let touching = geometry.outer_race_radius() - geometry.ball_radius() - spatial.bearings[0].base;
    for (found, expected) in found.iter().zip(&expected) {
        for k in 0..2 {
            let [a, b] = [found.y[m + k], expected.y[n + k]];
            // 1e-9 of a displacement of microns: round-off of a step, grown over five thousand
            assert!((a - b).abs() < 1e-15, "{} s: {a:e} {b:e}", found.t);
        }
        for ball in 0..7 {
            let [a, b] = [found.y[m + 5 + ball] - touching, expected.y[n + 2 + ball]];
            assert!((a - b).abs() < 1e-15, "{} s, ball {ball}: {a:e} {b:e}", found.t);
            assert!(found.y[m + 12 + ball].abs() < 1e-18);
        }
    }
}

/// Modes by differences of the force: every one of the plane system is there, and the others are across the plane.
#[test]
fn loaded_modes_in_the_plane_are_those_of_the_plane_system() {
    let Twins { plane: (of_plane, _, rest), spatial: (mut spatial, state, _) } = Twins::new(ModeSelection::All, &[]);
    let structure = Structure::ring_alone(ring(false, 1.0), [0.0, -9.81]);
    let modes = structure.modes().unwrap();
    let expected = LoadedModes::at(&structure, &modes, of_plane.setup(), &rest).unwrap();
    // the plane's are without damping
    spatial.linear.iter_mut().for_each(|linear| linear.damping = 0.0);
    spatial.setup.bearings[0].contact_damping = 0.0;
    let law = &mut spatial.bearings[0];
    (law.inner.damping, law.outer.damping) = (0.0, 0.0);
    let found = spatial.loaded_modes(&state).unwrap();
    assert_eq!((expected.unstable, found.unstable), (0, 0));
    let nearest = |hz: f64| {
        let apart = |mode: &crate::system::LoadedMode| (mode.frequency_hz / hz - 1.0).abs();
        found.modes.iter().min_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap()
    };
    let mut worst = 0.0_f64;
    for mode in &expected.modes {
        let own = nearest(mode.frequency_hz);
        worst = worst.max((own.frequency_hz / mode.frequency_hz - 1.0).abs());
        assert!((own.shaft_share - mode.shaft_share).abs() < 1e-4, "{own:?} {mode:?}");
    }
    println!("{} modes of {}: {worst:e}", expected.modes.len(), found.modes.len());
    // central differences over a ten-thousandth of the overlap: 1e-8 of the stiffness, and round-off of forces over them
    assert!(worst < 1e-6, "{worst:e}");
    assert!(found.modes.len() > expected.modes.len() + 7);
}

/// Dents over the whole groove are those of the plane system: balls run into them and out again.
#[test]
fn in_the_plane_a_dent_is_that_of_the_plane_system() {
    let dents = [(Race::Outer, FIRST + 0.08), (Race::Inner, FIRST + TAU / 7.0 - 0.12)];
    let Twins { plane, spatial } = Twins::new(ModeSelection::All, &dents);
    let Twins { spatial: whole, .. } = Twins::new(ModeSelection::All, &[]);
    let (n, m) = (plane.0.modes(), spatial.0.modes);
    let method = Method::ExponentialAdams { tolerance: Some(1e-6) };
    fn run<S: SecondOrderSystem + Clone, E>((mut system, start, _): (S, State, E), method: Method) -> Vec<State> {
        states(&mut system, start, method, 1e-7, 10, 2000)
    }
    let [found, sound] = [spatial, whole].map(|of| run(of, method));
    let expected = run(plane, method);
    let (mut apart, mut moved) = (0.0_f64, 0.0_f64);
    for ((found, sound), expected) in found.iter().zip(&sound).zip(&expected) {
        for k in 0..2 {
            apart = apart.max((found.y[m + k] - expected.y[n + k]).abs());
            moved = moved.max((found.y[m + k] - sound.y[m + k]).abs());
        }
    }
    println!("{apart:e} of {moved:e}");
    // the plane takes the azimuth on the race at the ball's own radius, the force by it left out: 1e-4 of the race's displacement
    assert!(moved > 1e-8 && apart < 1e-4 * moved, "{apart:e} of {moved:e}");
}

/// What a step costs against the plane system's: seven balls, as many modes, one thread. Both take turns, so that what else the machine
/// does meets both.
#[test]
#[ignore = "prints a measurement: run it alone and in release"]
fn price_of_a_step() {
    // short against the time that the machine gives a thread at once
    const STEPS: u32 = 400;
    /// From the first observation to the last: what an integrator needs to begin does not count.
    #[derive(Default)]
    struct Clock([Option<std::time::Instant>; 2]);
    impl<S> Observer<S> for Clock {
        fn observe(&mut self, _: &S, now: Instant<'_>) {
            self.0[usize::from(now.step > 0)] = Some(std::time::Instant::now());
        }
    }
    fn seconds<S: SecondOrderSystem>(system: &mut S, start: &State, method: Option<Method>) -> f64 {
        let (mut g, mut clock, mut state) = (vec![0.0; start.y.len()], Clock::default(), start.clone());
        let now = |step: u64| Instant { step, t: start.t, y: &start.y, v: &start.v };
        if let Some(method) = method {
            let schedule = Schedule { interval: 1e-7 * f64::from(STEPS), steps_per_interval: STEPS, intervals: 1 };
            integrate(system, method, &schedule, &mut state, &mut clock, |_, _| Stepping::Continue).unwrap();
        } else {
            clock.observe(system, now(0));
            (0..STEPS).for_each(|_| system.force_into(start.t, &start.y, &start.v, &mut g));
            clock.observe(system, now(1));
        }
        let [first, last] = clock.0.map(Option::unwrap);
        (last - first).as_secs_f64() / f64::from(STEPS)
    }
    let median = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    };
    let adams = |tolerance| Some(Method::ExponentialAdams { tolerance });
    for modes in [8, 12, 24, 40] {
        let Twins { mut plane, mut spatial } = Twins::new(ModeSelection::Count(modes), &[]);
        for (what, method) in [("evaluation", None), ("step", adams(None)), ("with a tolerance", adams(Some(1e-4)))] {
            let pairs: Vec<[f64; 2]> = (0..101)
                .map(|_| [seconds(&mut plane.0, &plane.1, method), seconds(&mut spatial.0, &spatial.1, method)])
                .collect();
            let [a, b] = [0, 1].map(|k| 1e9 * median(pairs.iter().map(|pair| pair[k]).collect()));
            let ratio = median(pairs.iter().map(|[a, b]| b / a).collect());
            println!("{modes} modes, {what}: {a:.0} ns in the plane, {b:.0} ns in space, ratio {ratio:.2}");
        }
    }
}
