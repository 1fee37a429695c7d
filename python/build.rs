//! With the feature `static-arpack`, for wheels that go to other machines: ARPACK and what it needs of LAPACK and BLAS become part of the module,
//! from the archives of Debian's libarpack2-dev. The linker takes a library from the first folder that has it.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo:rerun-if-changed=build.rs");
    if env::var_os("CARGO_FEATURE_STATIC_ARPACK").is_none() {
        return Ok(());
    }
    let folder = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default()).join("archives");
    fs::create_dir_all(&folder)?;
    for (name, archive) in [("arpack", "libarpack.a"), ("lapack", "liblapack_pic.a"), ("blas", "libblas.a")] {
        let from = Path::new("/usr/lib/x86_64-linux-gnu").join(archive);
        fs::copy(from, folder.join(format!("lib{name}.a")))?;
    }
    println!("cargo:rustc-link-search=native={}", folder.display());
    for library in ["arpack", "lapack", "blas", ":libgfortran.so.5"] {
        println!("cargo:rustc-link-arg-cdylib=-l{library}");
    }
    Ok(())
}
