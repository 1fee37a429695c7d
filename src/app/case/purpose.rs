//! What a command needs of a case, a case that has what a simulation needs, and what a result depends on.

use super::document::Document;
use super::error::CaseError;
use super::{Bearing, Case, Defect, Ensemble, Interface, Linearise, Ring, Seat, Shaft, Speed, Transient};
use crate::bearing::spatial::{RaceControl, Thrust};
use crate::files::{self, FileDigest};
use sha2::{Digest, Sha256};
use std::path::Path;

/// What a case is to be used for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// Eigenfrequencies.
    Modes,
    /// A condensed housing.
    Condense,
    /// Transfer paths.
    Frf,
    /// The simulation in time.
    Run,
    /// Speed against accuracy of the simulation.
    Chart,
    /// The bearing in space, at rest.
    Bearing,
}

/// A case with every part that bearings in space need.
#[derive(Debug, Clone)]
pub struct SpatialCase<'c> {
    /// The whole case.
    pub case: &'c Case,
    /// Every ring, which has its bearing.
    pub seats: Vec<Seat<'c>>,
    /// The shaft with the inner rings.
    pub shaft: &'c Shaft,
    /// Moment of inertia about an axis across the shaft, kg m^2.
    pub transverse_inertia: f64,
    /// What the bearing in its plane does not know, in words.
    pub reason: String,
}

/// A case with what its model of the bearing needs; see [`Case::asked_run`].
#[derive(Debug, Clone)]
pub enum AskedRun<'c> {
    /// One bearing whose forces stay in its plane.
    InPlane(RunCase<'c>),
    /// Bearings that carry axial load and tilt.
    InSpace(SpatialCase<'c>, &'c Transient),
}

/// A case with every part that a simulation in time needs; see [`Case::for_run`].
#[derive(Debug, Clone, Copy)]
pub struct RunCase<'c> {
    /// The whole case: what has a default or may be absent, such as damping and analysis, is taken from it.
    pub case: &'c Case,
    /// The ring.
    pub ring: &'c Ring,
    /// Balls, races and contacts.
    pub bearing: &'c Bearing,
    /// The shaft with the inner ring.
    pub shaft: &'c Shaft,
    /// Shaft speed over time.
    pub speed: &'c Speed,
    /// The simulation in time; that of the case, or another in its place.
    pub transient: &'c Transient,
}

/// A bearing, and what stands before its keys.
type PrefixedBearing<'c> = (String, &'c Bearing);

impl<'c> AskedRun<'c> {
    /// The whole case.
    pub(crate) fn case(&self) -> &'c Case {
        match self {
            Self::InPlane(run) => run.case,
            Self::InSpace(run, _) => run.case,
        }
    }

    /// The simulation in time.
    pub(crate) fn transient(&self) -> &'c Transient {
        match self {
            Self::InPlane(run) => run.transient,
            Self::InSpace(_, transient) => transient,
        }
    }
}

impl Case {
    /// Checks that the case has the tables that a purpose needs.
    ///
    /// # Errors
    /// [`CaseError`] with the first table that it lacks.
    pub fn ready_for(&self, purpose: Purpose) -> Result<(), CaseError> {
        let interface = self.seats().iter().any(|seat| seat.ring.tie.is_some())
            || self.superelement().is_some()
            || self.condense.interface != Interface::Ring;
        let (by, needs) = match purpose {
            Purpose::Bearing => return self.for_bearing().map(|_| ()),
            Purpose::Run => return self.asked_run("`run`").map(|_| ()),
            Purpose::Chart => return self.asked_run("`chart`").map(|_| ()),
            Purpose::Modes => {
                let modelled = self.housing.is_some() || self.ring.is_some();
                self.needed("`modes`", "[housing] or [ring]", modelled.then_some(()))?;
                return match self.modes.linearise {
                    Linearise::None => Ok(()),
                    Linearise::Static => {
                        let by = "`modes.linearise = \"static\"`";
                        match self.in_space(by)? {
                            Some(_) => Ok(()),
                            None => self.at_rest(by).map(|_| ()),
                        }
                    }
                };
            }
            Purpose::Condense => {
                let table = "ring.tie, or condense.interface = { group = \"NAME\" }";
                ("`condense`", vec![("[housing]", self.housing.is_some()), (table, interface)])
            }
            Purpose::Frf => {
                let damped = self.damping.is_some() || self.lossy_part().is_some();
                let needs = vec![
                    ("[housing]", self.housing.is_some()),
                    ("[frf]", self.frf.is_some()),
                    ("[[sensors]]", !self.sensors.is_empty()),
                    ("[damping], or loss_factor of a material", damped),
                    ("ring.tie, or condense.interface = { nodes = [TAGS] }", interface),
                ];
                ("`frf`", needs)
            }
        };
        needs.into_iter().try_for_each(|(table, present)| self.needed(by, table, present.then_some(())))
    }

    /// A part of the case that something needs, named as in the file.
    fn needed<T>(&self, by: &str, table: &str, part: Option<T>) -> Result<T, CaseError> {
        part.ok_or_else(|| {
            let what = format!("{by} needs {table}, which the case file lacks");
            let spot = if self.has_rings() { "ring_deg = 270" } else { "group = \"NAME\"" };
            let lines = match table {
                "[frf]" => format!(" with from = [{{ {spot}, direction = [0, 1, 0] }}]"),
                "[[sensors]]" => format!(" with name = \"P1\", {spot} and direction = [0, 1, 0]"),
                "[speed]" => " with profile = [{ time = 0, rpm = 1500 }]".to_owned(),
                "[transient]" => " with end = 0.6 and output_hz = 51200".to_owned(),
                "[shaft]" => " with mass, in kg".to_owned(),
                _ if table.starts_with("[damping]") => ", for example modal = 0.02".to_owned(),
                _ => String::new(),
            };
            let help = format!("add {table} to the case file{lines}");
            CaseError::at(self.source.path.display(), what).with_help(Some(help))
        })
    }

    /// The first key that only the model of the bearing in space knows, with what it is.
    fn spatial_key(&self) -> Option<(String, &'static str)> {
        let seats = self.seats();
        let bearings = seats.iter().filter_map(|seat| Some((seat, seat.bearing?)));
        let of_bearing = bearings.flat_map(|(seat, bearing)| {
            [
                ("contact_angle_deg", bearing.contact_angle_deg.is_some()),
                // what the plane model has too
                ("thrust", bearing.thrust.is_some_and(|thrust| thrust != Thrust::Both)),
                ("race_control", bearing.race_control.is_some_and(|control| control != RaceControl::Outer)),
                ("preload", bearing.preload.is_some()),
            ]
            .into_iter()
            .filter(|(_, given)| *given)
            .map(|(key, _)| (seat.key(&format!("bearing.{key}")), "a key of the bearing in space"))
            .chain(bearing.defects.iter().enumerate().filter_map(|(index, defect)| match defect {
                Defect::Dent(dent) if dent.across.is_some() => {
                    Some((seat.key(&format!("bearing.defects[{index}].across")), "a place across the groove"))
                }
                _ => None,
            }))
            .collect::<Vec<_>>()
        });
        let of_shaft = self.shaft.iter().flat_map(|shaft| {
            let loads = shaft.loads.iter().enumerate().filter(|(_, load)| !load.is_in_plane());
            let loads = loads.map(|(index, _)| {
                (format!("shaft.loads[{index}]"), "a force along z, a moment, or a place off the bearing's centre")
            });
            let unbalances = shaft.unbalances.first().map(|_| "unbalances");
            let centre = shaft.centre.filter(|centre| centre.abs() > 0.0).map(|_| "centre");
            let keys = unbalances.into_iter().chain(centre);
            loads.chain(keys.map(|key| (format!("shaft.{key}"), "a place off the bearing's centre")))
        });
        of_bearing.chain(of_shaft).next()
    }

    /// Refuses keys that only the model of the bearing in space knows: a command of the plane model would ignore them.
    ///
    /// # Errors
    /// [`CaseError`] with the first such key.
    pub fn in_the_plane(&self) -> Result<(), CaseError> {
        let Some((key, found)) = self.spatial_key() else {
            return Ok(());
        };
        let what = format!("`{key}`: found {found}, expected none: this command's bearing stays in its plane");
        let help = format!("leave `{key}` out, or use `plummer run` or `plummer bearing`, which know it");
        Err(CaseError::at(self.place_of(&key), what).with_help(Some(help)))
    }

    /// File and line of a key, or the file.
    fn place_of(&self, key: &str) -> String {
        let place = Document::read(&self.source).map(|document| document.place(key));
        place.unwrap_or_else(|_| self.source.path.display().to_string())
    }

    /// Returns the parts that `bearing` needs: every bearing with what stands before its keys, and the shaft.
    ///
    /// # Errors
    /// [`CaseError`] with the first table that the case lacks.
    pub(crate) fn for_bearing<'c>(&'c self) -> Result<(Vec<PrefixedBearing<'c>>, &'c Shaft), CaseError> {
        let by = "`bearing`";
        let bearings = match self.bearings.is_empty() {
            true => vec![(String::new(), self.needed(by, "[bearing]", self.bearing.as_ref())?)],
            false => {
                let of_seat = |seat: Seat<'c>| {
                    let bearing = self.needed(by, &format!("[{}]", seat.key("bearing")), seat.bearing)?;
                    Ok((seat.key(""), bearing))
                };
                self.seats().into_iter().map(of_seat).collect::<Result<_, CaseError>>()?
            }
        };
        let shaft = self.needed(by, "[shaft]", self.shaft.as_ref())?;
        Ok((bearings, shaft))
    }

    /// Returns the parts that a simulation in time needs, which `by` asks for: of the bearing in its plane where nothing asks for more.
    ///
    /// # Errors
    /// [`CaseError`] with the first table or key that the case lacks.
    pub fn asked_run(&self, by: &str) -> Result<AskedRun<'_>, CaseError> {
        let Some(spatial) = self.in_space(by)? else {
            return self.simulated(by).map(AskedRun::InPlane);
        };
        self.needed(by, "[speed]", self.speed.as_ref())?;
        let transient = self.needed(by, "[transient]", self.transient.as_ref())?;
        self.needed(by, "[[sensors]]", self.sensors.first())?;
        Ok(AskedRun::InSpace(spatial, transient))
    }

    /// Returns what bearings in space need, which rest under their load; `None` where the bearing in its plane is enough.
    ///
    /// # Errors
    /// [`CaseError`] with the first table or key that the case lacks.
    pub(crate) fn in_space(&self, by: &str) -> Result<Option<SpatialCase<'_>>, CaseError> {
        let reason = match (self.bearings.len(), self.spatial_key()) {
            (0, None) => return Ok(None),
            (0, Some((key, what))) => format!("`{key}` is {what}"),
            (count, _) => format!("{count} bearings share the loads of one shaft"),
        };
        let seats = self.seats();
        self.needed(by, "[ring]", seats.first())?;
        for seat in &seats {
            self.needed(by, &format!("[{}]", seat.key("bearing")), seat.bearing)?;
        }
        let shaft = self.needed(by, "[shaft]", self.shaft.as_ref())?;
        self.needed(by, "a support in [housing]", self.is_held().then_some(()))?;
        let transverse_inertia = shaft.transverse_inertia.ok_or_else(|| {
            let what = format!("shaft.transverse_inertia: found none, expected one, since {reason} and the shaft may tilt");
            let help = "give the moment of inertia about an axis across the shaft through its centre of mass, in kg m^2: for a \
                        cylinder m (3 r^2 + l^2) / 12; and shaft.polar_inertia, m r^2 / 2";
            CaseError::at(self.place_of("shaft"), what).with_help(Some(help.to_owned()))
        })?;
        Ok(Some(SpatialCase { case: self, seats, shaft, transverse_inertia, reason }))
    }

    /// Whether something holds ring or housing to the ground.
    fn is_held(&self) -> bool {
        self.seats().iter().any(|seat| !seat.ring.supports.is_empty())
            || (self.meshed_housing()).is_some_and(|housing| !housing.supports.is_empty())
            // what holds it is in its stiffness
            || self.superelement().is_some()
    }

    /// Returns the parts that `run` needs of a bearing in its plane.
    ///
    /// # Errors
    /// [`CaseError`] with the first table that the case lacks.
    pub fn for_run(&self) -> Result<RunCase<'_>, CaseError> {
        self.simulated("`run`")
    }

    /// Returns the parts that a map of stable steps needs: those of a run in the plane.
    ///
    /// # Errors
    /// As [`Case::for_run`].
    pub(crate) fn for_stability(&self) -> Result<RunCase<'_>, CaseError> {
        self.simulated("`chart --only stability`")
    }

    fn simulated(&self, by: &str) -> Result<RunCase<'_>, CaseError> {
        let (ring, bearing, shaft) = self.at_rest(by)?;
        let speed = self.needed(by, "[speed]", self.speed.as_ref())?;
        let transient = self.needed(by, "[transient]", self.transient.as_ref())?;
        self.needed(by, "[[sensors]]", self.sensors.first())?;
        Ok(RunCase { case: self, ring, bearing, shaft, speed, transient })
    }

    /// What an equilibrium under the load needs.
    fn at_rest(&self, by: &str) -> Result<(&Ring, &Bearing, &Shaft), CaseError> {
        if !self.bearings.is_empty() {
            let what = format!("{by} takes one bearing, found [[bearings]] with {}", self.bearings.len());
            let help = "write one of them as [ring] and [bearing]; `run`, `modes`, `condense` and `frf` take several";
            return Err(CaseError::at(self.source.path.display(), what).with_help(Some(help.to_owned())));
        }
        self.in_the_plane()?;
        let ring = self.needed(by, "[ring]", self.ring.as_ref())?;
        let bearing = self.needed(by, "[bearing]", self.bearing.as_ref())?;
        let shaft = self.needed(by, "[shaft]", self.shaft.as_ref())?;
        self.needed(by, "a support in [housing] or [ring]", self.is_held().then_some(()))?;
        Ok((ring, bearing, shaft))
    }

    /// The first part of the housing whose material has a loss factor: the material's name, and its loss factor.
    pub(crate) fn lossy_part(&self) -> Option<(&str, f64)> {
        let mut parts = self.meshed_housing().into_iter().flat_map(|housing| &housing.parts);
        parts.find_map(|part| {
            let loss_factor = self.material(&part.material)?.loss_factor();
            (loss_factor > 0.0).then_some((part.material.as_str(), loss_factor))
        })
    }
}

/// Tables that say how results are looked at, not what they are.
const VIEWS: [&str; 3] = ["analysis", "title", "report"];

/// What modes without contact do not depend on, as they are those of ring and housing in full.
const OF_CONTACT: [&str; 9] =
    ["frf", "speed", "transient", "damping", "bearing", "shaft", "accuracy", "condense", "sensors"];

/// What a bearing in space does not depend on.
const OF_STRUCTURE: [&str; 9] =
    ["frf", "modes", "transient", "damping", "accuracy", "condense", "sensors", "housing", "ring"];

impl Case {
    /// SHA-256 of what the result of a command depends on, 64 hexadecimal digits: the values, and the content of its tables. Meshes
    /// stand by their own digests in results. `None` of values that have no JSON.
    #[must_use]
    pub fn digest(&self, command: &str) -> Option<String> {
        let mut text = self.values(command, &VIEWS)?;
        for table in self.tables(command) {
            // one that cannot be read is named where it is needed
            text.extend(FileDigest::of_file(table).map(|file| file.sha256));
        }
        Some(files::hex(Sha256::new_with_prefix(text)))
    }

    /// The values that the result of a command depends on, defaults filled in and each in one unit, without the tables `left_out`. Files
    /// are named as the case names them.
    pub(crate) fn values(&self, command: &str, left_out: &[&str]) -> Option<String> {
        let mut case = self.clone();
        let folder = self.source.path.parent();
        for path in case.paths_mut() {
            if let Some(Ok(named)) = folder.map(|folder| path.strip_prefix(folder)) {
                *path = named.to_owned();
            }
        }
        if let (Some(transient), false) = (&mut case.transient, command == "chart") {
            transient.ensemble = Ensemble::default();
        }
        let mut values = serde_json::to_value(&case).ok()?;
        let tables = values.as_object_mut()?;
        tables
            .retain(|table, _| !left_out.contains(&table.as_str()) && !self.unread(command).contains(&table.as_str()));
        // of the materials those that something names
        let mut materials = tables.remove("materials")?;
        let rest = values.to_string();
        let named = |name: &str| rest.contains(serde_json::Value::from(name).to_string().trim_matches('"'));
        materials.as_object_mut()?.retain(|name, _| named(name));
        Some(format!("{rest}{materials}"))
    }

    /// Files beside meshes that the result of a command depends on: measured profiles, and modes from elsewhere.
    pub(crate) fn tables(&self, command: &str) -> impl Iterator<Item = &Path> {
        let unread = self.unread(command);
        let bearing = self.bearing.iter().filter(|_| !unread.contains(&"bearing"));
        let profiles = bearing.flat_map(|bearing| &bearing.defects).filter_map(|defect| match defect {
            Defect::Measured(measured) => Some(measured.profile.csv.as_path()),
            Defect::Dent(_) | Defect::Flat(_) => None,
        });
        let compared = self.modes.compare.iter().filter(|_| !unread.contains(&"modes"));
        profiles.chain(compared.map(|other| other.file.as_path()))
    }

    /// Tables that the result of a command does not depend on, beside those that say how results are looked at.
    fn unread(&self, command: &str) -> &'static [&'static str] {
        let loaded = self.modes.linearise != Linearise::None;
        match command {
            "run" | "chart" => &["frf", "modes"],
            "condense" => &["frf", "modes", "speed"],
            "frf" => &["modes", "speed"],
            "bearing" => &OF_STRUCTURE,
            // a variant may ask for loaded modes, and a superelement tells which of these keys do not act
            "modes" if loaded || !self.modes.variants.is_empty() || self.superelement().is_some() => &["frf"],
            "modes" => &OF_CONTACT,
            _ => &[],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Case;

    /// Every table of a case changes the digests of those results that depend on it, and of no others.
    #[test]
    fn a_digest_is_of_what_its_result_depends_on() {
        let all = ["modes", "condense", "frf", "run", "chart"];
        let unloaded = "modes.linearise=none";
        for (set, base, changes) in [
            ("frf={from=[{name=\"a\",ring_deg=90,direction=[0,1,0]}]}", unloaded, &["frf"][..]),
            ("speed.profile=[{time=0,hz=23}]", unloaded, &["run", "chart"]),
            ("shaft.mass=0.2", unloaded, &["condense", "frf", "run", "chart"]),
            ("bearing.radial_play=1e-6", unloaded, &["condense", "frf", "run", "chart"]),
            ("bearing.radial_play=1e-6", "modes.linearise=static", &all),
            ("condense.enhanced=false", "modes.linearise=static", &all),
            ("condense.enhanced=false", unloaded, &["condense", "frf", "run", "chart"]),
            ("modes.count=7", unloaded, &["modes"]),
            ("ring.shear=false", unloaded, &all),
            ("materials.aluminium.density=2701", unloaded, &all),
            ("housing.length_unit=m", unloaded, &all),
            ("materials.spare={young=1e9,poisson=0.3,density=1e3}", unloaded, &[]),
            ("transient.ensemble.runs=7", unloaded, &["chart"]),
            ("title=other", unloaded, &[]),
            ("analysis.high_pass_hz=2000", unloaded, &[]),
        ] {
            let [before, after] = [&[base][..], &[base, set]].map(|set| Case::example("scenes/pedestal", set));
            let found =
                all.into_iter().filter(|command| before.digest(command).unwrap() != after.digest(command).unwrap());
            assert_eq!(found.collect::<Vec<_>>(), changes, "{set}");
        }
        // the same values: in another unit, by a default that is written down, by the name of a bearing and by its numbers
        let digest = |set: &[&str]| Case::example("scenes/pedestal", set).digest("run");
        let speed = "speed.profile=[{time=0,hz=20}]";
        assert_eq!(
            digest(&[speed]),
            digest(&["speed.profile=[{time=0.0,rpm=1200}]", "ring.shear=true", "shaft.unbalance=0.2e-4"])
        );
        assert_ne!(digest(&[speed]), digest(&["speed.profile=[{time=0,hz=20.000000000000004}]"]));
        // a variant may be of loaded modes
        let variant = "modes.variants=[{what=\"a\",set=[\"modes.linearise=static\"]}]";
        let cases = [&[unloaded, variant][..], &[unloaded, variant, "shaft.mass=0.2"]];
        let [before, after] = cases.map(|set| Case::example("scenes/pedestal", set).digest("modes"));
        assert_ne!(before, after);
    }

    /// A file that is not as it was is another value; of a command that does not read it, it is not.
    #[test]
    fn a_digest_is_of_the_content_of_files() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let profile = format!("bearing.defects=[{{on=\"outer\",angle_deg=0,profile={{csv={:?}}}}}]", path("pit.csv"));
        let compared = format!("modes.compare=[{{file={:?}}}]", path("modes.csv"));
        let case = Case::example("scenes/pedestal", &[&profile, &compared, "modes.linearise=none"]);
        let digests = || ["modes", "frf", "run"].map(|command| case.digest(command).unwrap());
        let mut last = digests();
        for (file, changes) in [("pit.csv", [false, true, true]), ("modes.csv", [true, false, false])] {
            for content in ["1", "2"] {
                std::fs::write(path(file), content).unwrap();
                let now = digests();
                assert_eq!([0, 1, 2].map(|command| now[command] != last[command]), changes, "{file}");
                last = now;
            }
        }
    }
}
