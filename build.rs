//! Links Debian's ARPACK (`libarpack2-dev`), found by pkg-config under the name `arpack`; with a feature for it, MUMPS
//! (`libmumps-seq-dev`, or `libmumps-dev` for several processes).

use std::fs;

/// MUMPS's header, and the version whose structure `src/numerics/linalg/mumps/structure.rs` repeats.
const HEADER: &str = "/usr/include/dmumps_c.h";
const VERSION: &str = "MUMPS_VERSION \"5.5.";

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if let Err(error) = pkg_config::Config::new().probe("arpack") {
        refuse(&format!("ARPACK was not found by pkg-config: {error}"), "libarpack2-dev pkg-config");
    }
    let [mumps, mpi] = ["CARGO_FEATURE_MUMPS", "CARGO_FEATURE_MUMPS_MPI"].map(|name| std::env::var_os(name).is_some());
    if !mumps {
        return;
    }
    println!("cargo:rerun-if-changed={HEADER}");
    let packages = if mpi { "libmumps-dev" } else { "libmumps-seq-dev" };
    match fs::read_to_string(HEADER) {
        Ok(header) if header.contains(VERSION) => {}
        Ok(_) => refuse(&format!("{HEADER} is of another version than 5.5"), packages),
        Err(error) => refuse(&format!("MUMPS was not found: {HEADER}: {error}"), packages),
    }
    let libraries: &[&str] = if mpi {
        &["smumps", "dmumps", "mumps_common", "mpi"]
    } else {
        &["smumps_seq", "dmumps_seq", "mumps_common_seq", "mpiseq_seq"]
    };
    for library in libraries {
        println!("cargo:rustc-link-lib={library}");
    }
    // MUMPS must find ours (src/numerics/linalg/mumps/ffi.rs)
    println!("cargo:rustc-link-arg=-Wl,--export-dynamic-symbol=scotchfgraphbuild_");
}

fn refuse(what: &str, packages: &str) {
    println!("cargo:warning={what}");
    println!("cargo:warning=on Debian: apt-get install {packages}");
    std::process::exit(1);
}
