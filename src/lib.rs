//! `plummer`: an FE housing coupling toolkit, named after the plummer block, the standard bearing
//! housing.
//!
//! A housing mesh from gmsh is condensed by Craig-Bampton onto the curved-beam outer ring of a ball
//! bearing; the nonlinear ball-contact transient runs on the reduced coupled system through a run-up
//! with faults; the signal is diagnosed. Source of the bearing model: Tadina and Boltezar, J. Sound
//! Vib. (2011), with its equations put right where that was needed (`docs/theory/bearing.md`).
//!
//! The data flows one way:
//!
//! 1. [`case`]: a TOML file to checked types; [`units`], SI inside; [`files`] that a user
//!    named; [`shell_word`], arguments as they are typed.
//! 2. [`mesh`]: gmsh import with physical names and a validator.
//! 3. [`material`], [`element`]: plane and solid elements and the curved beam; [`model`]: properties,
//!    supports, links, the ring and the tie of the bore to its interpolation.
//! 4. [`assembly`]: sparse stiffness and mass; [`linalg`]: factorisation, eigenpairs with a proof, dense problems.
//! 5. [`modal`], [`reduction`]: modes; constraint and fixed-interface modes to a superelement.
//! 6. [`bearing`]: geometry, Hertz contact, dents, cage, speed; [`catalogue`]: bearings that can be bought; [`closed_form`]: known
//!    answers.
//! 7. [`system`]: structure, balls and shaft; equilibrium, loaded modes, contact forces.
//! 8. [`dynamics`], [`transient`]: what a system shows to an integrator, and the integrators.
//! 9. [`series`], [`signal`], [`diagnosis`]: recorded signals; filters, spectra, scalograms, orders, kurtograms; verdicts on
//!    each part.
//! 10. [`exchange`], [`report`], [`stages`], [`cli`]: files that other programs read and write, one
//!     self-contained HTML page, commands.
//! 11. [`verification`]: the built-in checks of `plummer verify`; [`chart`]: speed against accuracy of the simulation;
//!     [`sweep`]: many runs of one case.
//!
//! ```no_run
//! use plummer::app::case::Case;
//! use plummer::app::commands::run::compute_run;
//! use crate::numerics::Unwatched;
//! let case = Case::load("examples/tadina2011/outer-dent.toml", &[])?;
//! let run = compute_run(&case, &Unwatched)?;
//! assert_eq!(run.simulation.record.sensors[0].0, "P1");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Limitations
//!
//! Linear elasticity, no shells and no pyramids; MSH 4.1 and 2.2; ring sections stay rigid in the bore; shaft, balls and defects in the
//! bearing's plane; slip prescribed; no lubricant film. All of them: `docs/limits.md`.

pub mod app;
pub mod bearing;
pub mod fe;
pub mod files;
pub mod formats;
pub mod numerics;
pub mod report;
pub mod signal;
pub mod system;
