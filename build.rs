//! Links Debian's ARPACK (`libarpack2-dev`), found by pkg-config under the name `arpack`.

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    if let Err(error) = pkg_config::Config::new().probe("arpack") {
        println!("cargo:warning=ARPACK was not found by pkg-config: {error}");
        println!("cargo:warning=on Debian: apt-get install libarpack2-dev pkg-config");
        std::process::exit(1);
    }
}
