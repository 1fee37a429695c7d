//! A bearing at rest: its equilibria, and what changes while the cage turns.

use super::{BearingSetup, Equilibrium, StaticCondition, Structure, SystemError};
use rayon::prelude::*;

/// Cage angles over one ball spacing, both ends included.
const ANGLES: usize = 57;

/// A bearing at rest.
#[derive(Debug, Clone)]
pub struct Statics {
    /// All equilibria that were found; the first one is taken.
    pub equilibria: Vec<Equilibrium>,
    /// The equilibrium at every cage angle of a ball pass.
    pub ball_pass: Vec<PassPoint>,
}

/// The equilibrium at a cage angle.
#[derive(Debug, Clone)]
pub struct PassPoint {
    /// Angle by which the cage is turned on, rad: 0 to a ball spacing.
    pub turned: f64,
    /// Where everything rests; `None` where no equilibrium was found.
    pub equilibrium: Option<Equilibrium>,
}

impl Statics {
    /// Equilibria with cage and loads as they are at `time` (s), and those of a ball pass from there.
    ///
    /// # Errors
    /// [`SystemError`] if there is no equilibrium.
    pub fn compute(structure: &Structure, setup: &BearingSetup, time: f64) -> Result<Self, SystemError> {
        let condition = StaticCondition::at(setup, time);
        let equilibria = Equilibrium::find_all(structure, setup, condition)?;
        let point = |place: usize| {
            let turned = setup.cage.spacing * place as f64 / (ANGLES - 1) as f64;
            let condition = condition.turned_by(setup, turned);
            PassPoint { turned, equilibrium: Equilibrium::find(structure, setup, condition).ok() }
        };
        Ok(Self { equilibria, ball_pass: (0..ANGLES).into_par_iter().map(point).collect() })
    }

    /// Smallest and largest value over the ball pass; `None` where nothing was found.
    pub fn range(&self, value: impl Fn(&Equilibrium) -> f64) -> Option<[f64; 2]> {
        let found = self.ball_pass.iter();
        let values = found.filter_map(|point| point.equilibrium.as_ref().map(&value));
        values.map(|value| [value; 2]).reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])])
    }
}

/// Stiffness that a further force in a `direction` meets, N/m: the force over the part of the displacement along it.
pub(crate) fn stiffness_along(equilibrium: &Equilibrium, direction: [f64; 2]) -> f64 {
    let [[xx, xy], [yx, yy]] = equilibrium.shaft_stiffness;
    let [x, y] = direction;
    let determinant = xx * yy - xy * yx;
    // n . K^-1 n
    let compliance = (yy * x * x - (xy + yx) * x * y + xx * y * y) / determinant;
    1.0 / compliance
}
