//! A scalogram of 0.3 s at 100 kHz, 200 frequencies from 0.5 to 40 kHz, on one thread: at every sample, and decimated.

use criterion::{Criterion, criterion_group, criterion_main};
use plummer::numerics::series::TimeSeries;
use plummer::signal::{FrequencyAxis, WaveletTransform};
use std::hint::black_box;

fn scalogram(criterion: &mut Criterion) {
    let values = (0..30_000_u64).map(|k| (k * k * 31 % 977) as f64 - 488.0);
    let series = TimeSeries::new(0.0, 1e-5, "m/s^2", values.collect()).expect("finite");
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("a thread");
    for decimation in [1, 10, 100] {
        let transform = WaveletTransform {
            frequencies: FrequencyAxis::Logarithmic { from_hz: 500.0, to_hz: 40e3, count: 200 },
            cycles: 6.0,
            decimation,
        };
        criterion.bench_function(&format!("scalogram, decimated by {decimation}"), |bencher| {
            bencher.iter(|| pool.install(|| transform.scalogram(black_box(&series))));
        });
    }
}

criterion_group!(benches, scalogram);
criterion_main!(benches);
