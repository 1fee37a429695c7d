//! `plummer export`: its examples and formats.

use clap::ValueEnum;

pub(super) const EXPORT_EXAMPLE: &str = "\
Examples: matrices for SciPy; the mode shapes of an earlier `plummer modes` for ParaView, without solving again; the condensed
housing for Nastran and pyYeti
  plummer export examples/scenes/pedestal.toml --to mtx
  plummer export out/pedestal --to vtu
  plummer export examples/scenes/pedestal.toml --to op4

Files:
  vtu  modes.vtu, ring.vtu: elements with a field a mode (ParaView, PyVista)
  uff  modes.uff, ring.uff: nodes, elements, mode shapes (universal file, datasets 2411, 2412, 55)
  mtx  stiffness.mtx, mass.mtx, dofs.csv: free degrees of freedom (Matrix Market; scipy.io.mmread)
  npz  stiffness.npz, mass.npz, dofs.npz, modes.npz (scipy.sparse.load_npz, numpy.load)
  op4  superelement.op4, superelement_dofs.csv: KAA, MAA, BAA, K4AA of the condensed housing, interface first (pyyeti.nastran.op4)
  dmig  superelement.bdf: grids and DMIG matrices of the condensed housing, Nastran bulk data
  inp  housing.inp: mesh, sets, surfaces, materials, held nodes, a *FREQUENCY step in SI (ccx -i housing)
  mbdyn  superelement.fem: data of MBDyn's modal joint";

/// A format of `plummer export`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ExportFormat {
    /// VTK grids with mode shapes
    Vtu,
    /// Universal files with mode shapes
    Uff,
    /// Matrices as Matrix Market files
    Mtx,
    /// Matrices and mode shapes as NumPy archives
    Npz,
    /// The condensed housing's matrices as Nastran's OUTPUT4 file
    Op4,
    /// The condensed housing as Nastran bulk data with DMIG matrices
    Dmig,
    /// The housing as an input file of CalculiX or Abaqus
    Inp,
    /// The condensed housing as a modal body of MBDyn
    Mbdyn,
}
