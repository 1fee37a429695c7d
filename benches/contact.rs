//! One evaluation of all contacts and forces of the source's bearing: 7 balls against ten modes of the ring, at the states
//! of a run over the dent, so that what a ball in the dent costs counts as often as it is there.

use criterion::{Criterion, criterion_group, criterion_main};
use plummer::app::case::Case;
use plummer::app::scene::{CoupledStructure, bearing_setup};
use plummer::fe::reduction::frf::ModalDamping;
use plummer::numerics::Unwatched;
use plummer::numerics::ode::{Instant, Observer, SecondOrderSystem};
use plummer::numerics::ode::{Method, Schedule, Stepping, integrate};
use plummer::system::{CoupledSystem, Equilibrium, ModeSelection, StaticCondition};
use std::hint::black_box;

const CASE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/tadina2011/outer-dent.toml");
const STEP: f64 = 1e-7;
/// Simulated time, s: at 21 Hz a ball passes the dent every 18.5 ms.
const DURATION: f64 = 0.1;
/// Steps between two states that are kept.
const KEPT: u64 = 50;

/// Time, coordinates and velocities, one state behind the other: a run has its state in the cache.
#[derive(Default)]
struct States(Vec<f64>);

impl Observer<CoupledSystem> for States {
    fn observe(&mut self, _system: &CoupledSystem, now: Instant<'_>) {
        if now.step.is_multiple_of(KEPT) {
            self.0.push(now.t);
            self.0.extend_from_slice(now.y);
            self.0.extend_from_slice(now.v);
        }
    }
}

fn evaluation(criterion: &mut Criterion) {
    for (name, residual, damping) in [
        ("contacts alone", false, "0"),
        ("with contact damping", false, "2"),
        ("with damping and static residual", true, "2"),
    ] {
        let set = ["speed.profile=[{time=0,hz=21}]".to_owned(), format!("bearing.contact_damping={damping}")];
        let case = Case::load(CASE, &set).expect("an example of the repository");
        let stage = CoupledStructure::build(&case, &Unwatched);
        let stage = stage.expect("meshed").expect("with a ring");
        let setup = bearing_setup(&case).expect("valid").expect("with a bearing");
        let rest = Equilibrium::find(&stage.structure, &setup, StaticCondition::at(&setup, 0.0));
        let mut system = CoupledSystem::new(
            &stage.structure,
            &stage.modes,
            setup,
            ModeSelection::Count(10),
            &ModalDamping::Uniform(0.03),
            residual,
        )
        .expect("supported");
        let mut state = system.state_at(0.0, &rest.expect("at rest"), &stage.modes);
        let mut states = States::default();
        let schedule = Schedule { interval: STEP, steps_per_interval: 1, intervals: (DURATION / STEP) as u64 };
        let run =
            integrate(&mut system, Method::Exponential, &schedule, &mut state, &mut states, |_, _| Stepping::Continue);
        run.expect("stable");
        let mut force = vec![0.0; state.y.len()];
        let mut next = states.0.chunks_exact(1 + 2 * force.len()).cycle();
        criterion.bench_function(&format!("7 balls, 10 modes, a dent: {name}"), |bencher| {
            bencher.iter(|| {
                if let Some(state) = next.next() {
                    let (y, v) = state[1..].split_at(force.len());
                    system.force_into(state[0], black_box(y), black_box(v), &mut force);
                }
                black_box(&force);
            });
        });
    }
}

criterion_group!(benches, evaluation);
criterion_main!(benches);
