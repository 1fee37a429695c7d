//! `plummer init`: a mesh, and what is known of it.

use crate::numerics::units::LengthUnit;
use clap::Args;
use std::path::PathBuf;

pub(super) const INIT_EXAMPLE: &str = "\
Examples: a case file beside a mesh, with the bearing that fits its bore; the bearings and the materials that the program knows
  plummer init housing.msh --length-unit mm
  plummer init housing.msh --length-unit mm --bearing 6205 --out motor.toml
  plummer init --list-bearings
  plummer init --list-materials

--out FILE names the case file (default: the mesh's name, ending in .toml). It says of every value whether it is from the mesh,
the catalogue, usual or a guess. Tables that the mesh says nothing of are templates, commented out. plummer modes FILE runs at
once where the mesh allows it.

The bore is the named surface (in a plane mesh the curve) that lies on a cylinder with the housing outside of it. Several on one
axis, named like bores, carry one shaft: the case has a bearing for each ([[bearings]]). Supports are groups named like a foot,
base, bolt, clamp or support.";

/// A mesh, and what is known of it.
#[derive(Debug, Clone, Args)]
pub struct InitArguments {
    /// Mesh file (gmsh MSH 2 or 4, .inp of Abaqus or CalculiX)
    #[arg(value_name = "HOUSING.msh", required_unless_present_any = ["list_bearings", "list_materials"])]
    pub mesh: Option<PathBuf>,
    /// Unit of the mesh's coordinates: m, cm, mm, um or in (default: the one in which the bearing fits, else a guess by the size)
    #[arg(long, value_name = "UNIT", value_parser = LengthUnit::parse)]
    pub length_unit: Option<LengthUnit>,
    /// Deep groove ball bearing of the catalogue (default: one whose outer diameter is the bore's within 1 %)
    #[arg(long, value_name = "NAME")]
    pub bearing: Option<String>,
    /// Mend folded elements of second order, here and in the case
    #[arg(long)]
    pub straighten: bool,
    /// List the bearings of the catalogue with their dimensions and sources
    #[arg(long, conflicts_with_all = ["mesh", "length_unit", "bearing", "straighten"])]
    pub list_bearings: bool,
    /// List the materials that a case may name, with their ranges and sources
    #[arg(long, conflicts_with_all = ["mesh", "length_unit", "bearing", "straighten", "list_bearings"])]
    pub list_materials: bool,
}
