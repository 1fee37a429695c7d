//! `plummer bearing`: its example, and a speed.

use super::number::number;

pub(super) const BEARING_EXAMPLE: &str = "\
Example: the bearing of a case under thrust beside its weight, at 3000 rpm
  plummer bearing examples/scenes/smooth.toml --rpm 3000 --set 'shaft.loads=[{ force = [0, 0, 20] }]'

Both rings are rigid. The shaft has three displacements and two tilts; its weight acts at the bearing's centre.

Files:
  bearing.json  equilibrium, balls, stiffness, orders, rating life; curves over load (0.1 to 10), speed (0 to 2) and preload
  report.html   the same as tables and plots";

/// A speed that can be: at most 6e7 rpm either way.
pub(super) fn revolutions(text: &str) -> Result<f64, String> {
    number(text, |rpm| rpm.abs() <= 6e7, "revolutions per minute from -6e7 to 6e7")
}
