//! Computed against closed forms, published values, other methods and other programs' numbers.

mod assembly;
mod centre_nodes;
mod craig_bampton;
mod element_convergence;
mod energy;
mod equilibrium;
mod faults;
mod frf;
mod impact;
mod loaded_modes;
mod modal_runs;
mod quasi_static;
mod reference_frequencies;
mod ring_element;
mod ring_in_space;
mod rings_of_solids;
mod setup;
mod superelement;
mod surface_dents;
mod tet10_integration;
mod tie;
mod tie_in_space;
mod transient;
