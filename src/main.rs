//! The `plummer` program; everything it does is in the library.

use std::process::ExitCode;

fn main() -> ExitCode {
    plummer::app::cli::main()
}
