//! Balls on defects of a race: one at a time, for few are there at once.

use super::groove_lanes::Felt;
use crate::bearing::Race;
use crate::bearing::spatial::{DamagedGroove, DefectState, GrooveContact, SpatialBearing, blending_on, felt_on};
use crate::numerics::lanes::{Lanes, each, positive};
use nalgebra::{Vector2, Vector3};

/// A race with defects, and the balls that feel them.
#[derive(Debug, Clone)]
pub(super) struct DamagedRace {
    contact: GrooveContact,
    defects: Vec<DamagedGroove>,
    /// Hunt-Crossley coefficient, s/m.
    damping: f64,
    /// At the last evaluation.
    pub met: Vec<Met>,
}

/// A ball on defects.
#[derive(Debug, Clone, Copy)]
pub(super) struct Met {
    pub ball: usize,
    pub place: Touch,
    pub state: DefectState,
    /// Rate of penetration, m/s, and what damping adds to the load, N.
    pub approach: f64,
    pub damped: f64,
}

/// Where a ball stands to a race, and how it moves.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    /// Vector from the groove's centre, m.
    pub d: Vector2<f64>,
    /// In the race's frame, rad.
    pub azimuth: f64,
    /// Rates of both, m/s and rad/s.
    pub rates: Vector3<f64>,
    /// Rate of the azimuth by the prescribed rotation of cage and shaft alone, rad/s, in a frame that moves with all coordinates.
    pub driven: f64,
}

impl DamagedRace {
    /// Those of the inner and the outer race of a bearing.
    pub(crate) fn both(bearing: &SpatialBearing, damping: f64) -> [Option<Self>; 2] {
        [(Race::Inner, &bearing.law().inner), (Race::Outer, &bearing.law().outer)].map(|(race, contact)| {
            let defects = bearing.defects().iter().filter(|defect| defect.race() == race);
            let defects: Vec<_> = defects.cloned().collect();
            let met = Vec::with_capacity(bearing.balls());
            (!defects.is_empty()).then(|| Self { contact: contact.clone(), defects, damping, met })
        })
    }

    /// Zero or positive for balls in directions (unit vectors in the race's frame) that may feel a defect.
    #[inline(always)]
    pub(crate) fn inside(&self, [cos, sin]: [&Lanes; 2]) -> Lanes {
        self.defects
            .iter()
            .fold([f64::NEG_INFINITY; 4], |most, defect| each(|l| most[l].max(defect.inside([cos[l], sin[l]]))))
    }

    /// The force of a ball at a place where it may feel a defect, by the three coordinates of [`Touch`]; sets what the lane holds of the
    /// contact. None where it feels the whole race alone.
    #[inline(never)]
    pub(crate) fn meet(&mut self, ball: usize, lane: usize, place: Touch, felt: &mut Felt) -> Option<&Met> {
        let state = felt_on(&self.defects, &self.contact, place.d, place.azimuth)?;
        let approach = state.push.dot(&place.rates);
        let damped = state.load * (positive(1.0 + self.damping * approach) - 1.0);
        felt.load[lane] = state.load;
        felt.gradient[0][lane] = state.gradient.x;
        felt.gradient[1][lane] = state.gradient.y;
        self.met.push(Met { ball, place, state, approach, damped });
        self.met.last()
    }

    /// Energy of the contacts beyond what their loads and overlaps say, J; `plain` is what these say of a ball.
    pub(crate) fn energy_beyond(&self, plain: impl Fn(usize) -> f64) -> f64 {
        self.met.iter().map(|met| met.state.energy - plain(met.ball)).sum()
    }

    /// Power by prescribed rotation, and power that contacts get without being pressed, W.
    pub(crate) fn powers(&self) -> [f64; 2] {
        self.met.iter().fold([0.0; 2], |[driven, blending], met| {
            let Touch { d, azimuth, rates, .. } = met.place;
            [
                driven + met.gradient().z * met.place.driven,
                blending + blending_on(&self.defects, &self.contact, d, azimuth, rates),
            ]
        })
    }
}

impl Met {
    /// Force with damping: along the vector from the groove's centre, N, and around, N m.
    #[inline]
    pub(crate) fn gradient(&self) -> Vector3<f64> {
        self.state.gradient + self.damped * self.state.push
    }
}
