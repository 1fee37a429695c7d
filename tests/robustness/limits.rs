//! Reference: the exit codes.
//! Goal: limits of the system and requests beyond all measure end in a message and exit code 1 or 2, not in a signal.
//! Sketch: the program under `ulimit`, with little memory and files that may not grow; steps that no computer would end.
//! Conditions: a shell with `ulimit`; a C compiler.
//! Parameters: 60 to 400 MB of address space, 50 KiB a file.

use std::path::Path;
use std::process::{Command, Output};

use super::program::{errors, scratch};

/// The healthy scene's run under limits of the shell.
fn limited(name: &str, limit: &str, set: &str) -> Output {
    limited_to(name, limit, &format!("run CASE --set transient.end=0.1 {set}"))
}

/// Any command on the case `CASE`.
fn limited_to(name: &str, limit: &str, command: &str) -> Output {
    let scene = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/scenes/healthy.toml");
    let line = format!(
        "ulimit {limit}; exec {} {} --quiet --out out --force",
        env!("CARGO_BIN_EXE_plummer"),
        command.replace("CASE", &scene.display().to_string())
    );
    let mut command = Command::new("sh");
    command.args(["-c", &line]).env("RUST_BACKTRACE", "0").env("OPENBLAS_NUM_THREADS", "1");
    command.current_dir(scratch(name)).output().unwrap()
}

/// Whether the program and its libraries are loaded at all: the loader's failure has a code of its own.
fn begins(limit: &str) -> bool {
    let line = format!("ulimit {limit}; exec {} --version", env!("CARGO_BIN_EXE_plummer"));
    let output = Command::new("sh").args(["-c", &line]).env("OPENBLAS_NUM_THREADS", "1").output().unwrap();
    output.status.code() != Some(127)
}

#[test]
fn a_file_that_may_not_grow_is_an_error() {
    let output = limited("file-size", "-f 100", "");
    assert_eq!(output.status.code(), Some(1), "{:?}", output.status);
    assert!(errors(&output).contains("File too large"), "{}", errors(&output));
}

#[test]
fn memory_that_does_not_suffice_is_an_error() {
    let mut failures = 0;
    for megabytes in [60, 100, 150, 200, 300, 400] {
        let limit = format!("-v {}", 1000 * megabytes);
        if !begins(&limit) {
            continue;
        }
        let output = limited("memory", &limit, "--threads 2");
        let code = output.status.code();
        let said = errors(&output);
        assert!(matches!(code, Some(0..=2)), "{megabytes} MB: {:?}: {said}", output.status);
        assert!(code == Some(0) || said.contains("\nhelp: "), "{megabytes} MB: {said}");
        failures += usize::from(code != Some(0));
    }
    assert!(failures > 0, "no limit was too low");
}

/// A matrix of 6000 rows has 288 MB; it says so by a panic of its own.
#[test]
fn memory_that_does_not_suffice_for_a_matrix_is_an_error() {
    let output = limited_to("matrix", "-v 300000", "modes CASE --set ring.nodes=2000");
    assert_eq!(output.status.code(), Some(1), "{:?}", output.status);
    let said = "error: the memory does not suffice for a matrix\n";
    assert!(errors(&output).starts_with(said), "{}", errors(&output));
}

#[test]
fn steps_beyond_measure_are_refused() {
    let output = limited("steps", "-v 4000000", "--set transient.step=1e-14");
    assert_eq!(output.status.code(), Some(2), "{:?}", output.status);
    let text = errors(&output);
    assert!(text.starts_with("error: step must be at least a millionth of the output interval"), "{text}");
}

#[test]
fn threads_that_cannot_be_started_are_an_error() {
    // each thread has a stack of 2 MB: of the limits that let the program itself begin, the lowest leave none
    let outputs = (20..200).map(|megabytes| limited("threads", &format!("-v {}", 1000 * megabytes), "--threads 2"));
    let text = outputs.map(|output| (output.status.code(), errors(&output)));
    let mut found = text.filter(|(_, text)| text.contains("error: the threads that compute cannot be started"));
    assert_eq!(found.next().expect("a limit").0, Some(1));
}

/// A cube whose factor takes 150 MB, under limits of which some leave it too little; with MUMPS that takes its place.
#[cfg(not(feature = "mumps"))]
#[test]
fn a_factor_beyond_the_limits_of_the_process_is_refused_with_its_size() {
    use super::grids::{Grids, steps};
    let folder = scratch("factor-limits");
    let mut mesh = Grids::default();
    let edge = steps(0.0, 0.1, 26);
    mesh.solid("block", [&edge, &edge, &edge], false);
    mesh.write(&folder);
    let housing = "mesh = 'grid.msh'\nlength_unit = 'm'\nparts = [{ group = 'block', material = 'aluminium' }]\n\
        supports = [{ group = 'block_bottom', fixed = 'all' }]";
    std::fs::write(folder.join("case.toml"), format!("[housing]\n{housing}\n[modes]\ncount = 4\n")).unwrap();
    for (option, words) in [("-v", "process's address space (ulimit -v)"), ("-d", "process's data (ulimit -d)")] {
        let under = |megabytes: usize| {
            let program = env!("CARGO_BIN_EXE_plummer");
            let line =
                format!("ulimit {option} {}; exec {program} modes case.toml --quiet --threads 1", 1000 * megabytes);
            Command::new("sh").arg("-c").arg(line).env("RUST_BACKTRACE", "0").current_dir(&folder).output().unwrap()
        };
        let refused = (1..40).map(|step| under(40 * step)).find(|output| errors(output).contains(words));
        let refused = refused.expect("a limit that is too low");
        assert_eq!(refused.status.code(), Some(1));
        assert!(errors(&refused).starts_with("error: the factor of a "), "{}", errors(&refused));
    }
}

/// What OpenBLAS 0.3.21 does: a thread of its own from the beginning, a buffer a thread, no end without memory for it, and a wait for
/// that thread at the end.
const OPENBLAS: &str = r#"
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
static int threads = 2;
static pthread_t worker;
static void *buffers[2];
static void *take(void *place) {
    volatile char *volatile buffer = *(void **)place;
    while (!buffer) buffer = malloc(128u << 20);
    *(void **)place = (void *)buffer;
    return NULL;
}
__attribute__((constructor)) static void begin(void) { pthread_create(&worker, NULL, take, &buffers[1]); }
__attribute__((destructor)) static void end(void) { pthread_join(worker, NULL); }
int openblas_get_num_threads(void) { return threads; }
void openblas_set_num_threads(int count) { threads = count; }
void cblas_dsyrk(int order, int triangle, int transposed, int n, int k, double alpha, const double *a, int lda, double beta, double *c, int ldc) {
    take(&buffers[0]);
    fprintf(stderr, "buffer for %d\n", threads);
}
"#;

#[test]
fn openblas_without_memory_is_an_error_and_no_wait() {
    let folder = scratch("openblas");
    std::fs::write(folder.join("openblas.c"), OPENBLAS).unwrap();
    let library = ["-shared", "-fPIC", "-o", "openblas.so", "openblas.c"];
    let compiled = Command::new("cc").args(library).current_dir(&folder).status().unwrap();
    assert!(compiled.success());
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("meshes/pedestal.msh");
    let case = format!(
        "[housing]\nmesh = {mesh:?}\nlength_unit = 'mm'\nparts = [{{ group = 'housing', material = 'aluminium' }}]\n\
        supports = [{{ group = 'feet', fixed = 'all' }}]\n[modes]\nband_hz = [7e4, 9e4]\n"
    );
    std::fs::write(folder.join("case.toml"), case).unwrap();
    let under = |limit: &str| {
        let program = env!("CARGO_BIN_EXE_plummer");
        let line = format!(
            "ulimit -v {limit}; exec timeout 60 env LD_PRELOAD=./openblas.so {program} modes case.toml --quiet --threads 1 --out out --force"
        );
        Command::new("sh").arg("-c").arg(line).env("RUST_BACKTRACE", "0").current_dir(&folder).output().unwrap()
    };
    let output = under("unlimited");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success() && said.contains("buffer for 1"), "{said}");
    // up to where products reserve as much as a processor with large caches asks for
    let outputs = (4..60).map(|step| under(&(25_000 * step).to_string()));
    let mut ended =
        outputs.inspect(|output| assert!(matches!(output.status.code(), Some(0..=2)), "{:?}", output.status));
    let refused = ended.find(|output| errors(output).contains("OpenBLAS"));
    assert_eq!(refused.expect("a limit that is too low").status.code(), Some(1));
}
