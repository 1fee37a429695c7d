//! `plummer._plummer`: what `import plummer` computes with. Each class is a result of the library's front door, handed on as NumPy arrays, as
//! the content of the command's JSON file, and as its report.

mod analyze;
mod arrays;
mod case;
mod condense;
mod errors;
mod frf;
mod mesh;
mod modes;
mod page;
mod program;
mod record;
mod run;
mod threads;
mod values;
mod work;

/// The extension module.
#[pyo3::pymodule]
mod _plummer {
    #[pymodule_export]
    use crate::analyze::{Analysis, analyze};
    #[pymodule_export]
    use crate::case::{Case, toml_value};
    #[pymodule_export]
    use crate::condense::Superelement;
    #[pymodule_export]
    use crate::frf::Frf;
    #[pymodule_export]
    use crate::mesh::{Mesh, node_order};
    #[pymodule_export]
    use crate::modes::Modes;
    #[pymodule_export]
    use crate::program::main;
    #[pymodule_export]
    use crate::record::Record;
    #[pymodule_export]
    use crate::run::Run;
    #[pymodule_export]
    use crate::threads::{set_threads, threads};
}
