//! `plummer`: an FE housing coupling toolkit, named after the plummer block, the standard bearing
//! housing.
//!
//! A housing mesh from gmsh is condensed by Craig-Bampton onto the curved-beam outer ring of a ball
//! bearing; the nonlinear ball-contact transient runs on the reduced coupled system through a run-up
//! with faults; the signal is diagnosed. Source of the bearing model: Tadina and Boltezar, J. Sound
//! Vib. (2011), with its equations put right where that was needed (`docs/theory/bearing.md`).
//!
//! # From a mesh to its modes
//!
//! ```
//! use plummer::prelude::*;
//!
//! let mesh = Mesh::read_gmsh("meshes/pedestal.msh".as_ref(), LengthUnit::Millimetre)?;
//! let aluminium = Material::new(70e9, 0.33, 2700.0)?;
//! let model = HousingModel::new(
//!     &mesh,
//!     HousingDescription {
//!         parts: vec![HousingPart { group: "housing".to_owned(), material: aluminium.into() }],
//!         ..HousingDescription::default()
//!     },
//! )?;
//! let modes = model.modes(ModeRange::Count(10))?;
//! assert_eq!(modes.rigid_modes, 6);
//! println!("first elastic mode: {:.0} Hz", modes.frequencies_hz[6]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # From a case to a verdict
//!
//! ```
//! use plummer::prelude::*;
//!
//! let windows = "analysis.envelope=[{from=1.0, to=2.6}]".to_owned();
//! let case = Case::load("examples/tadina2011/outer-dent.toml", &[windows])?;
//! let run = compute_run(&case, &Unwatched)?;
//! let diagnosis = run.windows[0].diagnosis.as_ref().map_err(Clone::clone)?;
//! println!("{}", diagnosis.sentence());
//! let outer = diagnosis.faults.iter().find(|verdict| verdict.fault == Fault::OuterRace);
//! assert_eq!(outer.map(|verdict| verdict.conclusion), Some(Conclusion::Named));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # A superelement for NumPy
//!
//! ```
//! use plummer::prelude::*;
//!
//! let case = Case::load("examples/housings/ring.toml", &[])?;
//! let condensed = compute_condense(&case, Comparison::None, &Unwatched)?;
//! let record = superelement_record(&case, &condensed.stage)?;
//! let file = std::env::temp_dir().join("plummer-superelement.npz");
//! write_superelement_npz(&file, &record)?;
//! assert_eq!(read_superelement_npz(&file)?.order(), record.order());
//! # std::fs::remove_file(&file)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The wings
//!
//! The library has nine modules. Each uses only modules that stand above it in this list:
//!
//! 1. [`files`]: reads and writes the files that a user names, each whole or not at all, with one error type;
//! 2. [`numerics`]: linear algebra, integrators, series, units;
//! 3. [`fe`]: mesh, elements, model, assembly, modes, reduction;
//! 4. [`bearing`]: geometry, contact, kinematics, defects, catalogue; [`signal`]: filters, spectra, diagnosis;
//! 5. [`system`]: ring, shaft and housing as one structure; contact forces, equilibrium, energy;
//! 6. [`formats`]: files that other programs read and write; [`report`]: one HTML page from plain data;
//! 7. [`app`]: case files, commands, studies, verification, command line.
//!
//! [`prelude`] has what most programs need.
//!
//! # Limitations
//!
//! Linear elasticity, no shells; MSH 2 and 4; ring sections stay rigid in the bore; shaft, balls and defects in the
//! bearing's plane; slip prescribed; no lubricant film. All of them: `docs/limits.md`.

pub mod app;
pub mod bearing;
pub mod fe;
pub mod files;
pub mod formats;
pub mod numerics;
pub mod prelude;
pub mod report;
pub mod signal;
pub mod system;
