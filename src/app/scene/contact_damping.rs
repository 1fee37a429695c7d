//! Contact damping against what is critical for a ball: far beyond, a run takes steps by the damper alone.

use crate::app::case::short;
use crate::numerics::Brief;
use crate::report::{quantity, significant};

/// Damping over the critical one that is told. Steps are those of the damper from about there on, and no ball rebounds.
const HEAVY: f64 = 10.0;

/// Steps of the default method in units of the time in which the damper of the most loaded ball stops it: in
/// `examples/scenes/healthy.toml` 0.27 with 1e6 s/m, 0.38 with 30.
const STEP: f64 = 0.27;

/// The most loaded ball of a bearing between its races.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PressedBall {
    /// Sum of its contact forces, N.
    force: f64,
    /// Sum of its contacts' stiffnesses, N/m.
    spring: f64,
    mass: f64,
}

impl PressedBall {
    /// The one of `loads`, forces (N) at the inner and the outer race, whose `stiffness` (N/m^(3/2)) is as given; `mass` is that of a ball, kg.
    /// `None` where none is loaded.
    pub(crate) fn of(stiffness: [f64; 2], mass: f64, loads: impl Iterator<Item = [f64; 2]>) -> Option<Self> {
        let tangent = |(k, force): (f64, f64)| 1.5 * k.cbrt().powi(2) * force.cbrt();
        let most = loads.max_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])))?;
        let force = most[0] + most[1];
        let spring = stiffness.into_iter().zip(most).map(tangent).sum();
        (force > 0.0).then_some(Self { force, spring, mass })
    }

    /// Contact damping (s/m) by which it is critically damped: with `F = k delta^(3/2) (1 + c delta')` the damper is `c F`, and
    /// `2 sqrt(k' m)` is critical with `k' = 3/2 k^(2/3) F^(1/3)`.
    pub(crate) fn critical(self) -> f64 {
        2.0 * (self.spring * self.mass).sqrt() / self.force
    }

    /// What is to be known of the damping (s/m) that a key gives, in a run of so many seconds.
    pub(super) fn doubt(self, key: &str, damping: f64, duration: f64) -> Option<String> {
        let critical = self.critical();
        let step: f64 = STEP * self.mass / (damping * self.force);
        let step = format!("{step:.1e}").parse().unwrap_or(step);
        (damping > HEAVY * critical).then(|| {
            format!(
                "{key} is {} s/m, {} times what damps the most loaded ball critically ({} s/m): it forces steps of about {}, {} of them in the {} s of the run; check that it is in s/m",
                short(damping),
                significant(damping / critical, 2),
                significant(critical, 2),
                quantity(step, "s"),
                Brief::rounded(duration / step, 2),
                Brief(duration)
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damping_far_beyond_the_critical_is_told_with_its_steps() {
        // the second ball: springs of 1.5 (1e12)^(1/3 * 2) 64^(1/3) = 6e8 N/m each
        let ball = PressedBall::of([1e12; 2], 3e-3, [[1.0, 1.0], [64.0, 64.0]].into_iter()).unwrap();
        let critical = ball.critical();
        assert!((critical / (2.0 * (1.2e9_f64 * 3e-3).sqrt() / 128.0) - 1.0).abs() < 1e-12, "{critical}");
        assert_eq!(ball.doubt("bearing.contact_damping", 9.9 * critical, 1.0), None);
        assert_eq!(
            ball.doubt("bearing.contact_damping", 1e6, 0.5).unwrap(),
            "bearing.contact_damping is 1e6 s/m, 34\u{202f}000 times what damps the most loaded ball critically (30 s/m): it forces steps of about 6.3 ps, 7.9e10 of them in the 0.5 s of the run; check that it is in s/m"
        );
        assert!(PressedBall::of([1e12; 2], 3e-3, [[0.0; 2]].into_iter()).is_none());
    }
}
