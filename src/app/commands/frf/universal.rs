//! Receptances in a universal file, as other programs read them.

use super::FrfResult;
use crate::app::case::{Case, SensorSpot};
use crate::app::error::ComputeError;
use crate::fe::reduction::frf::FrfQuantity;
use crate::formats::{FrequencyResponse, ResponseKind, ResponsePoint, write_responses_uff};
use std::path::Path;

impl FrfResult {
    /// Writes the receptances (m/N) of all paths of its case as a universal file, data sets 58.
    ///
    /// # Errors
    /// [`ComputeError`] for a file that cannot be written.
    pub fn write_uff(&self, path: &Path, case: &Case) -> Result<(), ComputeError> {
        Ok(write_responses_uff(path, &case.title, &responses(case, self)?)?)
    }
}

fn responses(case: &Case, result: &FrfResult) -> Result<Vec<FrequencyResponse>, ComputeError> {
    let point = |name: &str| {
        let pushes = case.frf.iter().flat_map(|frf| &frf.from);
        let push = pushes.filter(|push| push.name == name).map(|push| (&push.spot, push.direction));
        let sensors = case.sensors.iter().filter(|sensor| sensor.name == name);
        let given = push.chain(sensors.map(|sensor| (&sensor.spot, sensor.direction))).next();
        let node = match given {
            Some((SensorSpot::Node(tag), _)) => Some(*tag),
            _ => None,
        };
        let direction = given.and_then(|(_, direction)| unit(direction));
        ResponsePoint { name: name.to_owned(), node, direction }
    };
    let mut responses = Vec::with_capacity(result.paths.len());
    for path in &result.paths {
        let (sensor, load) = path.place;
        let values = result.response.path(sensor, load, FrfQuantity::Receptance)?;
        let response = FrequencyResponse {
            name: format!("{} to {}", path.from, path.to),
            frequency_hz: result.response.frequencies_hz().to_vec(),
            value: values.iter().map(|h| [h.re, h.im]).collect(),
            kind: ResponseKind::Receptance,
            from: point(&path.from),
            to: point(&path.to),
        };
        responses.push(response.told_apart());
    }
    Ok(responses)
}

/// A direction of the case, which may have any length; none where the case has none, as of a superelement's sensor.
fn unit(direction: [f64; 3]) -> Option<[f64; 3]> {
    let length = direction.iter().map(|part| part * part).sum::<f64>().sqrt();
    (length > 0.0).then(|| direction.map(|part| part / length))
}

#[cfg(test)]
mod tests {
    use super::unit;

    #[test]
    fn directions_have_length_one_or_are_not_known() {
        assert_eq!(unit([0.0, -2.0, 0.0]), Some([0.0, -1.0, 0.0]));
        assert_eq!(unit([3.0, 0.0, 4.0]), Some([0.6, 0.0, 0.8]));
        assert_eq!(unit([0.0; 3]), None);
    }
}
