//! Frequency response functions.

use crate::files::Fault;

/// What responds to a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResponseKind {
    /// Displacement by force, m/N.
    Receptance,
    /// Velocity by force, m/(N s).
    Mobility,
    /// Acceleration by force, m/(N s^2).
    Accelerance,
}

/// Where something is measured or a force acts.
#[derive(Debug, Clone, PartialEq)]
pub struct ResponsePoint {
    /// Its name; may be empty.
    pub name: String,
    /// The node's label, where it is one.
    pub node: Option<u64>,
    /// Unit vector in the mesh's axes; `None` where it is not known.
    pub direction: Option<[f64; 3]>,
}

/// A frequency response function `x(f) = H(f) F(f)`, with the time dependence `exp(i 2 pi f t)`.
#[derive(Debug, Clone, PartialEq)]
pub struct FrequencyResponse {
    /// What it is.
    pub name: String,
    /// Frequencies, Hz: >= 0, ascending.
    pub frequency_hz: Vec<f64>,
    /// Real and imaginary part at each frequency, in the unit of `kind`.
    pub value: Vec<[f64; 2]>,
    /// What responds.
    pub kind: ResponseKind,
    /// Where the force acts.
    pub from: ResponsePoint,
    /// What responds to it.
    pub to: ResponsePoint,
}

/// What the identification lines of the points begin with.
pub(super) const REFERENCE: &str = "Force at ";
pub(super) const RESPONSE: &str = "Response at ";

/// A direction's length may differ from 1 by this much: what six digits in each component leave.
const UNIT_LIMIT: f64 = 1e-5;
/// A direction is along an axis where the other components are below this, which turns forces by less than 1e-9.
const AXIS_LIMIT: f64 = 1e-9;

impl ResponseKind {
    /// Its name as identification lines have it; what responds, the format's number for that and its unit.
    pub(super) fn numerator(self) -> (&'static str, &'static str, u32, &'static str) {
        match self {
            Self::Receptance => ("Receptance", "Displacement", 8, "m"),
            Self::Mobility => ("Mobility", "Velocity", 11, "m/s"),
            Self::Accelerance => ("Accelerance", "Acceleration", 12, "m/s2"),
        }
    }

    pub(super) fn of_numerator(number: i64) -> Option<Self> {
        let all = [Self::Receptance, Self::Mobility, Self::Accelerance];
        all.into_iter().find(|kind| i64::from(kind.numerator().2) == number)
    }
}

impl ResponsePoint {
    /// 1, 2, 3 along x, y, z, below zero against them, 0 for every other direction.
    pub(super) fn signed_axis(&self) -> i64 {
        let Some(direction) = self.direction else {
            return 0;
        };
        let along = |axis: usize| (0..3).all(|own| own == axis || direction[own].abs() < AXIS_LIMIT);
        match (0..3).find(|&axis| along(axis)) {
            Some(axis) if direction[axis] > 0.0 => axis as i64 + 1,
            Some(axis) => -(axis as i64 + 1),
            None => 0,
        }
    }

    pub(super) fn direction_of(signed_axis: i64) -> Option<[f64; 3]> {
        let axis = usize::try_from(signed_axis.unsigned_abs()).ok()?;
        let mut direction = [0.0; 3];
        *direction.get_mut(axis.checked_sub(1)?)? = if signed_axis > 0 { 1.0 } else { -1.0 };
        Some(direction)
    }
}

impl FrequencyResponse {
    /// Whether frequencies ascend, values are numbers, directions are unit vectors.
    ///
    /// # Errors
    /// [`Fault`]: the first thing that does not fit.
    pub fn check(&self) -> Result<(), Fault> {
        let (frequencies, values) = (self.frequency_hz.len(), self.value.len());
        let found = format_args!("{frequencies} frequencies and {values} values");
        let fits = frequencies == values && frequencies > 0;
        Fault::unless(fits, "at least one frequency and a value for each", found)?;
        let mut last = None;
        for (place, &found) in self.frequency_hz.iter().enumerate() {
            let ascends = last.is_none_or(|last| found > last) && found >= 0.0 && found.is_finite();
            Fault::unless(ascends, "ascending frequencies >= 0 Hz", format_args!("{found} at [{place}]"))?;
            last = Some(found);
        }
        let wrong = |value: &[f64; 2]| !value.iter().all(|part| part.is_finite());
        if let Some(place) = self.value.iter().position(wrong) {
            return Err(Fault::new("finite values", format_args!("{:?} at [{place}]", self.value[place])));
        }
        for point in [&self.from, &self.to] {
            if let Some(found) = point.direction {
                let length = found.iter().map(|part| part * part).sum::<f64>().sqrt();
                // NaN is no length either
                let is_unit = (length - 1.0).abs() <= UNIT_LIMIT;
                let expected = format!("a unit vector as direction of \"{}\"", point.name);
                Fault::unless(is_unit, expected, format_args!("{found:?}"))?;
            }
        }
        Ok(())
    }

    /// As [`check`](Self::check), of the response with this place in a file, counted from 0.
    pub(super) fn check_as(&self, index: usize) -> Result<(), Fault> {
        self.check().map_err(|fault| fault.within(format!("frequency response {index}")))
    }
}
