//! Room for the powers of a system at an instant.

use crate::numerics::lanes::{self, Lanes};

/// Loads, rotation, modal damping, contact damping, blending.
pub(super) const FLOWS: usize = 5;

/// Powers at an instant, and what else has to be summed up.
#[derive(Debug, Clone)]
pub struct Powers {
    /// As `FLOWS` counts them, W; that of contact damping without what the static residual's displacements
    /// take from it.
    pub(super) flows: [f64; FLOWS],
    /// What damping adds to the outer force of each ball, N, and the static residual's displacement of the race there, m.
    pub(super) yielding: Vec<[f64; 2]>,
    /// Room for the modes.
    pub(super) velocities: Vec<Lanes>,
    pub(super) row: Vec<Lanes>,
}

impl Powers {
    /// Room for the powers of a system with so many modes and balls.
    pub(super) fn new(modes: usize, balls: usize) -> Self {
        let groups = lanes::column(modes, 0.0);
        Self { flows: [0.0; FLOWS], yielding: vec![[0.0; 2]; balls], velocities: groups.clone(), row: groups }
    }
}
