//! Contact of a ball with a race, healthy or not: forces, and what they store and take.

mod contact;
mod energy;

pub(super) use contact::{Damage, RaceContact, RaceForce, RacePlace};
pub(super) use energy::RaceEnergy;
