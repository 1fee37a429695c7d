//! Contact of a ball with a race, healthy or not: forces, and what they store and take.

mod contact;

pub(super) use contact::{Damage, RaceContact, RaceEnergy, RaceForce, RacePlace};
