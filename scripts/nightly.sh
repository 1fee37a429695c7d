#!/bin/sh
# What takes too long for each day: the tests marked `ignored`, property tests with many cases, and each reader under libFuzzer
# where nightly Rust and cargo-fuzz are. PLUMMER_ROUNDS, PLUMMER_MINUTES, PLUMMER_SEED, PLUMMER_ONLY, PLUMMER_KIND, PROPTEST_CASES and
# FUZZ_SECONDS make it longer or shorter (docs/robustness.md). `make nightly` calls it.
set -u
cd "$(dirname "$0")/.."
failed=""

# a test name's end, or what went wrong at the end
step() {
    echo "== $*"
    "$@" || failed="$failed
    $*"
}

# one after the other: what they print is kept, and each uses all cores
step cargo test --release --test robustness -- --ignored --nocapture --test-threads 1
step cargo test --release --test program -- --ignored --nocapture --test-threads 1
step env PROPTEST_CASES="${PROPTEST_CASES:-10000}" cargo test --release --lib

if [ -e /usr/include/dmumps_c.h ] && command -v mpirun >/dev/null 2>&1; then
    step cargo test --release --features mumps-mpi --test mumps
else
    echo "== MUMPS is not tested: it is missing (apt-get install libmumps-dev openmpi-bin)"
fi

if cargo +nightly fuzz --version >/dev/null 2>&1; then
    for target in tests/fuzz/fuzz_targets/*.rs; do
        step cargo +nightly fuzz run "$(basename "$target" .rs)" --fuzz-dir tests/fuzz -- -max_total_time="${FUZZ_SECONDS:-600}"
    done
else
    echo "== not fuzzed: cargo +nightly fuzz is missing (rustup toolchain install nightly; cargo install cargo-fuzz)"
fi

[ -z "$failed" ] || { echo "failed:$failed" >&2; exit 1; }
