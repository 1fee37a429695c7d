//! Computed against closed forms, published values, other methods and other programs' numbers.

mod craig_bampton;
mod equilibrium;
mod loaded_modes;
mod plane_frequencies;
mod ring_element;
mod setup;
mod tie;
mod transient;
