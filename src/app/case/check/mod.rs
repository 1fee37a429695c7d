//! The one place where values are checked against their ranges and against each other.

mod contact;
mod range;
mod report;
mod rule;
mod structure;
#[cfg(test)]
mod tests;
mod time;

pub(super) use range::{known_isotropic, known_material};
pub(super) use report::report;
pub(crate) use rule::short;
pub use rule::{BrokenRule, Rule};

use super::{Case, Interface, SensorSpot};

impl Case {
    /// Checks every range and every relation between values that can be checked without the mesh.
    ///
    /// # Errors
    /// The first [`BrokenRule`], in the order of the tables in the file's documentation.
    pub(crate) fn validate(&self) -> Result<(), BrokenRule> {
        if self.housing.is_none() && !self.has_rings() && self.bearing.is_none() {
            return Err(Rule::nothing_to_model().at("housing"));
        }
        report::title(&self.title)?;
        self.report.iter().try_for_each(report)?;
        structure::materials(self)?;
        structure::housing(self)?;
        self.check_bearings()?;
        for seat in self.seats() {
            let own = |found: Result<(), BrokenRule>| found.map_err(|broken| seat.broken(broken));
            own(structure::ring(self, &seat))?;
            own(seat.bearing.map_or(Ok(()), |bearing| contact::bearing(self, bearing, Some(seat.ring))))?;
        }
        if let (Some(bearing), false) = (&self.bearing, self.has_rings()) {
            // a bearing by itself is one for `plummer bearing`
            range::needs("bearing", "[ring]", self.housing.is_none())?;
            contact::bearing(self, bearing, None)?;
        }
        self.shaft.iter().try_for_each(time::shaft)?;
        self.damping.iter().try_for_each(time::damping)?;
        self.speed.iter().try_for_each(time::speed)?;
        time::sensors(self)?;
        time::modes(self)?;
        time::condense(self)?;
        self.frf.iter().try_for_each(|frf| time::frf(self, frf))?;
        self.accuracy.iter().try_for_each(time::accuracy)?;
        self.transient.iter().try_for_each(|transient| time::transient(self, transient))?;
        time::analysis(self)
    }
}

impl Case {
    /// Returns every mesh group that the case names, with the key that names it.
    pub(crate) fn groups(&self) -> Vec<(String, &str)> {
        let mut groups = Vec::new();
        let mut name = |key: String, group| groups.push((key, group));
        if let Some(housing) = self.meshed_housing() {
            for (index, part) in housing.parts.iter().enumerate() {
                name(format!("housing.parts[{index}].group"), part.group.as_str());
            }
            for (index, support) in housing.supports.iter().enumerate() {
                name(format!("housing.supports[{index}].group"), &support.group);
            }
            for (index, mass) in housing.masses.iter().enumerate() {
                name(format!("housing.masses[{index}].group"), &mass.group);
            }
            for (index, link) in housing.links.iter().enumerate() {
                link.between.iter().for_each(|group| name(format!("housing.links[{index}].between"), group));
            }
        }
        for seat in self.seats() {
            if let Some(tie) = &seat.ring.tie {
                name(seat.key("ring.tie.group"), &tie.group);
            }
        }
        match &self.condense.interface {
            Interface::Group(group) => name("condense.interface.group".to_owned(), group),
            Interface::Centres { centres, .. } => centres.iter().enumerate().for_each(|(index, centre)| {
                name(format!("condense.interface.centres[{index}].group"), &centre.group);
            }),
            Interface::Ring | Interface::Nodes(_) => {}
        }
        let pushes = self.frf.iter().flat_map(|frf| &frf.from).map(|push| &push.spot).enumerate();
        let pushes = pushes.map(|(index, spot)| (format!("frf.from[{index}].group"), spot));
        let sensors = self.sensors.iter().map(|sensor| &sensor.spot).enumerate();
        let sensors = sensors.map(|(index, spot)| (format!("sensors[{index}].group"), spot));
        for (key, spot) in pushes.chain(sensors) {
            if let SensorSpot::Group(group) = spot {
                name(key, group);
            }
        }
        groups
    }
}
