//! Stiffness and mass for numerical programs.

use super::source::Source;
use super::{CliError, Export};
use crate::app::case::Case;
use crate::app::cli::{OutputFolder, Progress};
use crate::app::scene::FreeSystem;
use crate::formats::{write_dofs_csv, write_dofs_npz, write_matrix_market, write_modes_npz, write_sparse_npz};

const STIFFNESS: &str = "stiffness with springs over the free degrees of freedom, SI (N/m, N, N m)";
const MASS: &str = "consistent mass with point masses over the free degrees of freedom, SI (kg, kg m, kg m^2)";

/// `stiffness.mtx`, `mass.mtx`, `dofs.csv`.
pub(super) fn mtx(case: &Case, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let system = FreeSystem::build(case, progress)?;
    progress.stage("write");
    let comment = |what: &str| {
        format!(
            "plummer {}, case {}\n{what}\nK x = (2 pi f)^2 M x gives the case's eigenfrequencies f in Hz\n\
             rows and columns: mtx_row of dofs.csv",
            env!("CARGO_PKG_VERSION"),
            case.source.path.display()
        )
    };
    let at = |name: &str| folder.path.join(name);
    write_matrix_market(&at("stiffness.mtx"), &system.stiffness, &comment(STIFFNESS))?;
    write_matrix_market(&at("mass.mtx"), &system.mass, &comment(MASS))?;
    write_dofs_csv(&at("dofs.csv"), &system.rows)?;
    let files = [
        ("stiffness.mtx", STIFFNESS),
        ("mass.mtx", MASS),
        ("dofs.csv", "which row is which degree of freedom: row from 0, mtx_row from 1"),
    ];
    Ok(Export { files: files.map(|(name, what)| (name, what.to_owned())).into(), summary: summary(&system) })
}

/// `stiffness.npz`, `mass.npz`, `dofs.npz` and `modes.npz`, which stays if it is the source itself.
pub(super) fn npz(source: &Source, folder: &OutputFolder, progress: &Progress) -> Result<Export, CliError> {
    let system = FreeSystem::build(&source.case, progress)?;
    let (_, shapes) = source.shapes(progress)?;
    progress.stage("write");
    let at = |name: &str| folder.path.join(name);
    write_sparse_npz(&at("stiffness.npz"), &system.stiffness)?;
    write_sparse_npz(&at("mass.npz"), &system.mass)?;
    write_dofs_npz(&at("dofs.npz"), &system.rows)?;
    if source.folder.as_ref() != Some(&folder.path) {
        write_modes_npz(&at("modes.npz"), &shapes)?;
    }
    let files = [
        ("stiffness.npz", STIFFNESS),
        ("mass.npz", MASS),
        ("dofs.npz", "which row is which degree of freedom, in the order of the rows"),
        ("modes.npz", "frequencies (Hz) and mode shapes at all nodes, those of the ring after those of the mesh"),
    ];
    Ok(Export {
        files: files.map(|(name, what)| (name, what.to_owned())).into(),
        summary: format!("{}, {} modes", summary(&system), shapes.count_modes()),
    })
}

fn summary(system: &FreeSystem) -> String {
    format!(
        "{} free degrees of freedom, {} entries of the stiffness, {} of the mass",
        system.rows.len(),
        system.stiffness.nnz(),
        system.mass.nnz()
    )
}
