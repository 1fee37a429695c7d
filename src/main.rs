//! The `plummer` program; everything it does is in the library.

fn main() {
    plummer::app::cli::main()
}
