//! The spatial system as integrators see it.

use super::force::evaluate;
use super::springs::find_own_springs;
use super::system::SpatialSystem;
use crate::numerics::ode::{Divergence, LinearCoordinate, SecondOrderSystem, Tangent, all_finite};

impl SecondOrderSystem for SpatialSystem {
    fn linear(&self) -> &[LinearCoordinate] {
        &self.linear
    }

    fn force_into(&mut self, t: f64, y: &[f64], v: &[f64], g: &mut [f64]) {
        evaluate(self, t, y, v, g);
    }

    fn own_springs_into(&self, springs: &mut [f64], sizes: &mut [f64]) {
        find_own_springs(self, springs, sizes);
    }

    fn events(&self) -> usize {
        2 * self.setup.balls()
    }

    /// The overlap of each ball with the outer and the inner race, m, bearing by bearing.
    fn events_into(&mut self, t: f64, y: &[f64], v: &[f64], events: &mut [f64]) {
        let mut force = std::mem::take(&mut self.work.force);
        force.resize(y.len(), 0.0);
        evaluate(self, t, y, v, &mut force);
        self.work.force = force;
        let overlaps = self.bearings.iter().flat_map(|bearing| {
            let outer = bearing.all(|ball| &ball.outer.penetration);
            outer.chain(bearing.all(|ball| &ball.inner.penetration))
        });
        for (event, overlap) in events.iter_mut().zip(overlaps) {
            *event = overlap;
        }
    }

    /// By differences, with four evaluations a coordinate: enough for limits of steps, slow for implicit methods.
    fn tangent_into(&mut self, t: f64, y: &[f64], v: &[f64], tangent: &mut Tangent) {
        let [by_place, by_speed] = self.derivatives(t, y, v);
        for (columns, of_speed) in [(by_place, false), (by_speed, true)] {
            for column in 0..y.len() {
                let term = tangent.add();
                term.left.copy_from_slice(columns.col_as_slice(column));
                let row = if of_speed { term.velocity } else { term.position };
                row[column] = 1.0;
            }
        }
        evaluate(self, t, y, v, &mut vec![0.0; y.len()]);
    }

    fn next_change(&self, t: f64) -> f64 {
        let loads = self.setup.shaft.loads.iter().map(|load| load.profile.next_knot(t));
        let cages = self.setup.bearings.iter().map(|bearing| bearing.cage.rotation.next_knot(t));
        loads.chain(cages).fold(f64::INFINITY, f64::min)
    }

    fn check(&self, y: &[f64], v: &[f64]) -> Result<(), Divergence> {
        if !(all_finite(y) && all_finite(v)) {
            return Err(Divergence::NotFinite);
        }
        // beyond half a ball's radius neither Hertz theory nor the geometry holds
        let balls = self.setup.bearings.iter().map(|own| 0.5 * own.bearing.geometry().ball_radius());
        let limit = balls.fold(f64::INFINITY, f64::min);
        let tilt = 0.1;
        for (place, (what, limit, unit)) in [
            ("shaft displacement x", limit, "m"),
            ("shaft displacement y", limit, "m"),
            ("shaft displacement z", limit, "m"),
            ("tilt of the shaft about x", tilt, "rad"),
            ("tilt of the shaft about y", tilt, "rad"),
        ]
        .into_iter()
        .enumerate()
        {
            let value = y[self.modes + place];
            if value.abs() > limit {
                return Err(Divergence::OutOfRange { what: what.to_owned(), value, limit, unit });
            }
        }
        for ((first, count), own) in self.ball_ranges().zip(&self.setup.bearings) {
            let places = y[first..first + 2 * count].iter();
            if let Some((place, &value)) = places.enumerate().find(|(_, value)| value.abs() > limit) {
                let way = if place < count { "radial" } else { "axial" };
                let what = format!("{way} place of ball {} of bearing {}", place % count + 1, own.label);
                return Err(Divergence::OutOfRange { what, value, limit, unit: "m" });
            }
        }
        Ok(())
    }
}
