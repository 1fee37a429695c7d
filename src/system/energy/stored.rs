//! What a state stores.

use crate::numerics::ode::Instant;
use crate::system::{BallsInertia, CoupledSystem, Formulation};

impl CoupledSystem {
    /// Whether forces have potentials and all coordinates inertia.
    pub(in crate::system) fn keeps_energy(&self) -> bool {
        self.setup.formulation == Formulation::Consistent && self.setup.balls_inertia == BallsInertia::Dynamic
    }

    /// Kinetic and elastic energy of a state at which the force was evaluated last, J.
    pub(in crate::system) fn energy_at(&self, &Instant { t, y, v, .. }: &Instant<'_>) -> f64 {
        let modes = self.modes;
        let of_modes: f64 = (0..modes).map(|i| v[i] * v[i] + self.linear[i].squared_frequency * y[i] * y[i]).sum();
        let squares = |v: &[f64]| v.iter().map(|v| v * v).sum::<f64>();
        let kinetic = self.setup.shaft.mass * squares(&v[modes..modes + 2])
            + self.setup.geometry.ball_mass() * squares(&v[modes + 2..]);
        let contacts: f64 = (0..self.balls.count).map(|j| self.contact_energy(t, j)).sum();
        0.5 * (of_modes + kinetic) + contacts
    }

    /// Elastic energy of a ball's contacts and of its share in the static residual, J.
    fn contact_energy(&self, t: f64, j: usize) -> f64 {
        let mut energy = 0.0;
        if self.balls.get(j, |ball| &ball.inner.penetration) > -self.inner.rise {
            let shaft = self.setup.cage.shaft().motion(t);
            let gap = self.balls.inner_gap(j);
            let (damage, place) = self.inner_place(j, &gap, [0.0; 2], &shaft);
            energy += self.inner.energy(damage, &place, 0.0).elastic;
        }
        let displaced = self.race_displacement(j);
        let overlap = self.balls.get(j, |ball| &ball.gap) - displaced;
        if overlap > -self.outer.rise {
            let (damage, place) = self.outer_place(j, overlap);
            energy += self.outer.energy(damage, &place, 0.0).elastic;
            energy += 0.5 * displaced * self.balls.get(j, |ball| &ball.outer_radial);
        }
        energy
    }
}
