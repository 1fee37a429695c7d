//! Mesh and properties with degrees of freedom: the ring, the housing, its supports and links, and the tie
//! between ring and housing.

mod attach;
mod centre;
mod confined;
mod curved;
mod error;
mod flat;
mod frame;
mod housing;
mod link;
mod mean;
mod overlap;
mod parts;
mod plates;
mod ring;
mod rings;
mod section_springs;
mod solid_ring;
mod spread;
mod stack;
mod straighten;
mod support;
mod surface;
mod tie;
mod trapezoid;

pub use centre::{CENTRE_COORDINATES, CentreNode, CentreTie};
pub use error::ModelError;
pub use flat::FlatLayer;
pub use frame::RingFrame;
pub use housing::{HousingDescription, HousingModel, PlaneModel};
pub use mean::MeanTie;
pub use overlap::{Apart, Bodies, Crossing, Doubled, MixedOrders, Overlap, OverlapRule, Touching};
pub use parts::{HousingElement, HousingElements, HousingPart};
pub use ring::{RadialSupport, Ring, RingError, RingRows, RingSpaceRows, RingStrain, RingSupport, SpringShare};
pub use rings::{RingSeat, Rings};
pub use solid_ring::{MeshedRing, SolidRing};
pub(crate) use straighten::{folds, straighten};
pub use support::{Connection, Constraint, HousingSupport, Link, PointMass, SpringStiffness, SupportShare};
pub(crate) use support::{NodalMatrix, NodalSource};
pub use tie::{Bore, Fit, HousingPartition, NodeInterface, RingTie};
