//! The one place where values are checked against their ranges and against each other.

mod contact;
mod range;
mod rule;
mod structure;
#[cfg(test)]
mod tests;
mod time;

pub(super) use range::{known_isotropic, known_material};
pub use rule::{BrokenRule, Rule};

use super::{Case, Interface, SensorSpot};

impl Case {
    /// Checks every range and every relation between values that can be checked without the mesh.
    ///
    /// # Errors
    /// The first [`BrokenRule`], in the order of the tables in the file's documentation.
    pub(crate) fn validate(&self) -> Result<(), BrokenRule> {
        if self.housing.is_none() && self.ring.is_none() {
            return Err(Rule::nothing_to_model().at("housing"));
        }
        structure::materials(self)?;
        structure::housing(self)?;
        structure::ring(self)?;
        contact::bearing(self)?;
        contact::defects(self)?;
        time::shaft(self)?;
        time::damping(self)?;
        time::speed(self)?;
        time::sensors(self)?;
        time::modes(self)?;
        time::condense(self)?;
        time::frf(self)?;
        time::accuracy(self)?;
        time::transient(self)?;
        time::analysis(self)
    }
}

/// Returns every mesh group that a case names, with the key that names it.
pub(super) fn groups_of(case: &Case) -> Vec<(String, &str)> {
    let mut groups = Vec::new();
    if let Some(housing) = case.meshed_housing() {
        for (index, part) in housing.parts.iter().enumerate() {
            groups.push((format!("housing.parts[{index}].group"), part.group.as_str()));
        }
        for (index, support) in housing.supports.iter().enumerate() {
            let key = format!("housing.supports[{index}].group");
            groups.push((key, support.group.as_str()));
        }
        for (index, mass) in housing.masses.iter().enumerate() {
            groups.push((format!("housing.masses[{index}].group"), mass.group.as_str()));
        }
        for (index, link) in housing.links.iter().enumerate() {
            for group in &link.between {
                groups.push((format!("housing.links[{index}].between"), group.as_str()));
            }
        }
    }
    if let Some(tie) = case.ring.as_ref().and_then(|ring| ring.tie.as_ref()) {
        groups.push(("ring.tie.group".to_owned(), tie.group.as_str()));
    }
    if let Interface::Group(group) = &case.condense.interface {
        groups.push(("condense.interface.group".to_owned(), group.as_str()));
    }
    for (index, push) in case.frf.iter().flat_map(|frf| &frf.from).enumerate() {
        if let SensorSpot::Group(group) = &push.spot {
            groups.push((format!("frf.from[{index}].group"), group.as_str()));
        }
    }
    for (index, sensor) in case.sensors.iter().enumerate() {
        if let SensorSpot::Group(group) = &sensor.spot {
            groups.push((format!("sensors[{index}].group"), group.as_str()));
        }
    }
    groups
}
