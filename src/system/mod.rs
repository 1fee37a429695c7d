//! Structure, balls and shaft as one system: small, diagonal in its linear part, nonlinear in its
//! contacts.
//!
//! [`Structure`] (ring with or without housing) -> [`StructureModes`] -> [`CoupledSystem`], which a
//! time integrator steps. [`Equilibrium`] finds where everything rests, [`LoadedModes`] linearises
//! there.

mod balls;
mod bearing_setup;
mod coupled;
mod energy;
mod equilibrium;
mod error;
mod force;
mod inner;
mod loaded;
mod powers;
mod race;
mod raceway;
mod record;
mod recorder;
mod residual;
mod resting;
mod simulated;
mod spatial;
mod statics;
mod structure;
mod turning;

pub use bearing_setup::{BallsInertia, BearingSetup, FlatOnBall, Formulation, LoadProfile, Shaft};
pub use coupled::{CoupledSystem, ModeSelection};
pub use energy::{EnergyBalance, EnergyMeter};
pub use equilibrium::{BallLoad, Equilibrium, StaticCondition};
pub use error::{Pressed, SystemError};
pub use loaded::{LoadedMode, LoadedModes, LoadedPass, LoadedPoint, LoadedShapes};
pub use powers::Powers;
pub use record::{Column, RecordLayout, RunRecord};
pub use recorder::Recorder;
pub use simulated::Simulated;
pub(crate) use spatial::with_static_vectors;
pub use spatial::{
    BearingInPlace, SpatialBallLoad, SpatialCondition, SpatialEquilibrium, SpatialLoad, SpatialSetup, SpatialShaft,
    SpatialSystem, Unbalance,
};
pub(crate) use statics::stiffness_along;
pub use statics::{PassPoint, Statics};
pub use structure::{Sensor, Structure, StructureModes};
