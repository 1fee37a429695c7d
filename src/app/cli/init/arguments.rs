//! What `plummer init` takes.

use std::path::PathBuf;

use clap::Args;

use crate::numerics::units::LengthUnit;

/// A mesh, and what is known of it.
#[derive(Debug, Clone, Args)]
pub struct InitArguments {
    /// Mesh file (gmsh MSH 4.1 or 2.2)
    #[arg(value_name = "HOUSING.msh", required_unless_present = "list_bearings")]
    pub mesh: Option<PathBuf>,
    /// Unit of the mesh's coordinates: m, cm, mm, um or in (default: the one in which the bearing fits, else a guess by the size)
    #[arg(long, value_name = "UNIT", value_parser = LengthUnit::parse)]
    pub length_unit: Option<LengthUnit>,
    /// Deep groove ball bearing of the catalogue (default: one whose outer diameter is the bore's within 1 %)
    #[arg(long, value_name = "NAME")]
    pub bearing: Option<String>,
    /// List the bearings of the catalogue with their dimensions and sources
    #[arg(long, conflicts_with_all = ["mesh", "length_unit", "bearing"])]
    pub list_bearings: bool,
}
