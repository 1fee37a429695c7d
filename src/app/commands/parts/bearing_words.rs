//! A bearing, its faults and what moves and loads it, in words and units.

use super::phrases::{and, direction_words, length, listed};
use crate::app::case::{Bearing, Case, ContactStiffness, Defect, DentProfile, Load, Preload, Shaft, Slip, Speed};
use crate::app::commands::analyze::WindowAnalysis;
use crate::app::scene::race_contacts;
use crate::bearing::Race;
use crate::bearing::spatial::Thrust;
use crate::report::{Fact, given, quantity, significant};
use crate::signal::diagnosis::{Conclusion, Diagnosis, Fault};

/// Points of a profile that are told one by one.
const TOLD_POINTS: usize = 6;

/// The bearing with its faults and loads; with its speed and the time that is simulated where it `moves`.
pub(super) fn facts(case: &Case, moves: bool) -> Vec<Fact> {
    let mut facts = Vec::new();
    for (label, bearing) in case.all_bearings() {
        let mut own = vec![bearing_fact(bearing)];
        own.extend(axial(bearing));
        own.extend(contact(case, bearing));
        own.extend(imperfections(bearing));
        let name = "Fault of the bearing";
        let faults = listed(name, faults(bearing)).unwrap_or_else(|| Fact::new(name, NO_FAULT));
        own.push(Fact { note: felt(bearing), ..faults });
        facts.extend(own.into_iter().map(|fact| match label.as_str() {
            "" => fact,
            label => Fact { name: format!("{}, bearing {label}", fact.name), ..fact },
        }));
    }
    facts.extend(case.shaft.iter().flat_map(shaft));
    facts.extend(case.speed.iter().filter(|_| moves).map(|speed| Fact::new("Speed of the shaft", speed_words(speed))));
    if let (true, Some(transient)) = (moves, &case.transient) {
        let recorded = quantity(transient.output_hz, "Hz");
        let text = format!("from {} s to {} s, recorded at {recorded}", given(transient.start), given(transient.end));
        facts.push(Fact::new("Simulated time", text));
    }
    if let (true, Some(accuracy)) = (moves, &case.accuracy) {
        let [low, high] = accuracy.band_hz.map(|hz| quantity(hz, "Hz"));
        let text = format!("{} % of the signals' RMS between {low} and {high}", given(100.0 * accuracy.target));
        facts.push(Fact::new("Accuracy asked for", text));
    }
    facts
}

/// Of a bearing without defects.
pub(crate) const NO_FAULT: &str = "none, a sound bearing";

/// A bearing with its dimensions.
pub(crate) fn bearing_fact(bearing: &Bearing) -> Fact {
    let [inner, outer] = [bearing.inner_race_radius, bearing.outer_race_radius].map(|radius| length(2.0 * radius));
    let clearance = 2.0 * bearing.play();
    let clearance = match clearance < 0.0 {
        true => format!("a preload of {} over the diameter", length(-clearance)),
        false => format!("a diametral clearance of {}", length(clearance)),
    };
    let grooves = [bearing.inner_groove_radius, bearing.outer_groove_radius];
    let [inner_groove, outer_groove] = grooves.map(|radius| given(50.0 * radius / bearing.ball_radius));
    let name = bearing.name.as_ref().map_or_else(String::new, |name| format!("{name}, "));
    let text = format!(
        "{name}{} balls of {}, races of {inner} and {outer}, groove radii of {inner_groove} % and {outer_groove} % of the ball's diameter, {clearance}",
        bearing.balls,
        length(2.0 * bearing.ball_radius)
    );
    Fact::new("Bearing", text)
}

/// Contact angle, the way in which it holds thrust, and preload, as far as the case gives them.
fn axial(bearing: &Bearing) -> Option<Fact> {
    let angle = bearing.contact_angle_deg.map(|degrees| format!("free contact angle {}\u{b0}", given(degrees)));
    let thrust = match bearing.thrust_or_default() {
        Thrust::Both => None,
        Thrust::Positive => Some("holds thrust along +z".to_owned()),
        Thrust::Negative => Some("holds thrust along \u{2212}z".to_owned()),
    };
    let preload = bearing.preload.map(|preload| match preload {
        Preload::Force(newtons) => format!("preload {}", quantity(newtons, "N")),
        Preload::Displacement(metres) => format!("preload by a displacement of {}", length(metres)),
    });
    listed("Axial", [angle, thrust, preload].into_iter().flatten())
}

/// Stiffness and damping of the contacts.
fn contact(case: &Case, bearing: &Bearing) -> Vec<Fact> {
    let text = |[inner, outer]: [f64; 2]| {
        let [inner, outer] = [inner, outer].map(|k| significant(1e-9 * k, 4));
        format!("{inner} (inner race) and {outer} (outer race) GN/m^(3/2)")
    };
    let stiffness = match bearing.stiffness {
        ContactStiffness::Given { inner, outer } => {
            Some(Fact::new("Contact stiffness", text([inner, outer])).note("as the case gives it"))
        }
        ContactStiffness::Hertz => race_contacts(case).ok().flatten().map(|contacts| {
            let value = text([contacts.inner.stiffness, contacts.outer.stiffness]);
            Fact::new("Contact stiffness", value).note("by Hertz from the geometry and the materials")
        }),
    };
    let damping = (bearing.contact_damping > 0.0)
        .then(|| Fact::new("Contact damping", format!("{} s/m (Hunt-Crossley)", given(bearing.contact_damping))));
    stiffness.into_iter().chain(damping).collect()
}

/// Slip, waves and balls of different size, as far as there are any.
fn imperfections(bearing: &Bearing) -> Vec<Fact> {
    let percent = |slip: f64| given(100.0 * slip);
    let between = |points: &[(f64, f64)], over: &str| {
        let (low, high) =
            points.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), (_, s)| (low.min(*s), high.max(*s)));
        Some(format!("{} % to {} % over {over}", percent(low), percent(high)))
    };
    let slip = match &bearing.slip {
        Slip::Constant(slip) if *slip == 0.0 => None,
        Slip::Constant(slip) => Some(format!("{} %", percent(*slip))),
        Slip::OverTime(points) => between(points, "the time"),
        Slip::OverSpeed(points) | Slip::OverRpm(points) => between(points, "the speed"),
    };
    let waves = bearing
        .waviness
        .iter()
        .map(|wave| format!("{} waves of {} on the {} race", wave.order, length(wave.amplitude), wave.on));
    let largest = bearing.ball_radius_differences.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
    let sizes = (largest > 0.0).then(|| format!("radii differ by up to {}", length(largest)));
    [listed("Slip of the cage", slip), listed("Waviness", waves), listed("Balls of different size", sizes)]
        .into_iter()
        .flatten()
        .collect()
}

/// Every fault of a bearing: what it is, its size and its place.
pub(crate) fn faults(bearing: &Bearing) -> Vec<String> {
    bearing.defects.iter().map(fault).collect()
}

fn fault(defect: &Defect) -> String {
    let place = |race: Race, degrees: f64| {
        let turns = if race == Race::Inner { " when the shaft's angle is zero" } else { "" };
        format!("in the {race} race at {}\u{b0}{turns}", given(degrees))
    };
    match defect {
        Defect::Dent(dent) => {
            let mut sizes = vec![format!("{} long", length(dent.length))];
            sizes.extend(dent.width.map(|width| format!("{} wide", length(width))));
            sizes.push(format!("{} deep", length(dent.depth)));
            let across = dent.across.map(|across| format!(", {} across the groove", length(across)));
            format!("a dent {} {}{}", and(&sizes), place(dent.on, dent.angle_deg), across.unwrap_or_default())
        }
        Defect::Measured(measured) => {
            let file = measured.profile.csv.file_name().unwrap_or_default().to_string_lossy().into_owned();
            format!("a measured profile ({file}) {}", place(measured.on, measured.angle_deg))
        }
        Defect::Flat(flat) => {
            let (radius, depth) = (length(flat.flat_radius), length(flat.depth));
            format!("a flat of radius {radius}, {depth} deep, on ball {}", flat.ball)
        }
    }
}

/// How a ball feels the dents; `None` without one.
fn felt(bearing: &Bearing) -> Option<String> {
    let dent = bearing.defects.iter().find_map(|defect| match defect {
        Defect::Dent(dent) => Some(dent.profile),
        Defect::Measured(_) | Defect::Flat(_) => None,
    });
    let felt = match dent? {
        DentProfile::InPlane => "in the plane of the bearing: as if the dent were as wide as the groove",
        DentProfile::Surface => "in three dimensions: the ball bridges the dent as far as its surface lets it",
    };
    Some(felt.to_owned())
}

fn of_race(race: Race) -> Fault {
    match race {
        Race::Inner => Fault::InnerRace,
        Race::Outer => Fault::OuterRace,
    }
}

/// That a case has damage of which a signal shows nothing: a judged part that is damaged and not indicated. `None` where all damage
/// is indicated or none could be judged.
pub(crate) fn not_shown(case: &Case, window: &WindowAnalysis) -> Option<String> {
    missed_by(case, window.bearing.as_deref().unwrap_or_default(), window.diagnosis.as_ref().ok()?)
}

/// The same by the label of the bearing, empty for the only one.
fn missed_by(case: &Case, label: &str, diagnosis: &Diagnosis) -> Option<String> {
    let damaged = |defect: &Defect| match defect {
        Defect::Dent(dent) => (of_race(dent.on), format!("a dent in the {} race", dent.on)),
        Defect::Measured(profile) => (of_race(profile.on), format!("a measured profile in the {} race", profile.on)),
        Defect::Flat(_) => (Fault::Ball, "a flat on a ball".to_owned()),
    };
    let judged = |part: &Fault| diagnosis.faults.iter().find(|verdict| verdict.fault == *part);
    let missed = |part: &Fault| {
        judged(part).is_some_and(|verdict| verdict.false_alarm.is_some())
            && !diagnosis.named().any(|verdict| verdict.fault == *part)
    };
    let in_doubt = |part: &Fault| judged(part).is_some_and(|verdict| verdict.conclusion == Conclusion::NotEnough);
    let seats = case.seats();
    let own = seats.iter().filter(|seat| seat.label == label);
    let defects = own.filter_map(|seat| seat.bearing).flat_map(|bearing| &bearing.defects).map(damaged);
    let (parts, mut missed): (Vec<Fault>, Vec<String>) = defects.filter(|(part, _)| missed(part)).unzip();
    missed.dedup();
    // what is not enough evidence is not nothing
    let shows = match diagnosis.by_signal_alone.is_empty() && !parts.iter().any(in_doubt) {
        true => "does not show it",
        false => "does not prove it",
    };
    (!missed.is_empty()).then(|| format!("the case has {}; the signal {shows}", and(&missed)))
}

fn shaft(shaft: &Shaft) -> Vec<Fact> {
    let mut text = format!("{} kg", given(shaft.mass));
    text += &match shaft.gravity {
        [0.0, 0.0] => ", without weight".to_owned(),
        gravity => format!(", gravity {}", vector(gravity, "m/s\u{b2}")),
    };
    if shaft.unbalance > 0.0 {
        text += &format!(", unbalance {} g mm", given(1e6 * shaft.unbalance));
    }
    for unbalance in &shaft.unbalances {
        text += &format!(
            ", unbalance {} g mm at {}\u{b0}, {} along the shaft",
            given(1e6 * unbalance.moment),
            given(unbalance.angle_deg),
            length(unbalance.at)
        );
    }
    if let Some(transverse) = shaft.transverse_inertia {
        let polar = given(1e6 * shaft.polar_inertia.unwrap_or(0.0));
        text += &format!(
            ", moments of inertia {} kg mm\u{b2} across and {polar} kg mm\u{b2} along",
            given(1e6 * transverse)
        );
    }
    let load = |load: &Load| match load {
        Load::Constant(force) => vector(*force, "N"),
        Load::Spatial { force, moment, at } => {
            let [force, moment] = [&force[..], &moment[..]]
                .map(|parts| parts.iter().map(|part| given(*part)).collect::<Vec<_>>().join(", "));
            format!("({force}) N, moment ({moment}) N m, at {}", length(*at))
        }
        Load::SpatialProfile { profile, at } => format!("a profile of {} points, at {}", profile.len(), length(*at)),
        Load::Profile(points) if points.len() > TOLD_POINTS => format!("a profile of {} points", points.len()),
        Load::Profile(points) => {
            let points = points.iter().map(|point| format!("{} at {} s", vector(point.force, "N"), given(point.time)));
            points.collect::<Vec<_>>().join(", ")
        }
    };
    let loads = listed("Loads on the shaft", shaft.loads.iter().map(load));
    let loads = loads.unwrap_or_else(|| Fact::new("Loads on the shaft", "none but its weight and unbalance"));
    vec![Fact::new("Shaft", text), loads]
}

/// Size and direction of a vector in the plane of the bearing.
fn vector(vector: [f64; 2], unit: &str) -> String {
    let size = vector[0].hypot(vector[1]);
    if size == 0.0 { format!("0 {unit}") } else { format!("{} {unit} {}", given(size), direction_words(&vector)) }
}

/// Speed over time, in Hz and in revolutions per minute.
pub(crate) fn speed_words(speed: &Speed) -> String {
    let both = |hz: f64| format!("{} Hz ({} rpm)", given(hz), given(60.0 * hz));
    match speed.profile.as_slice() {
        [] => "not given".to_owned(),
        [first, rest @ ..] if rest.iter().all(|point| point.frequency_hz.total_cmp(&first.frequency_hz).is_eq()) => {
            format!("constant, {}", both(first.frequency_hz))
        }
        [first, last] => {
            let what = if last.frequency_hz.abs() > first.frequency_hz.abs() { "run-up" } else { "run-down" };
            let from = match first.frequency_hz {
                0.0 => "0".to_owned(),
                hz => both(hz),
            };
            format!("{what} from {from} to {} in {} s", both(last.frequency_hz), given(last.time - first.time))
        }
        points if points.len() > TOLD_POINTS => format!("a profile of {} points", points.len()),
        points => {
            let points = points.iter().map(|point| format!("{} at {} s", both(point.frequency_hz), given(point.time)));
            points.collect::<Vec<_>>().join(", ")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::diagnosis::{EnvelopeOrderSpectrum, FaultVerdict, SpeedSource};

    fn diagnosis(conclusion: Conclusion, false_alarm: Option<f64>) -> Diagnosis {
        let (order, amplitude, unit) = (Vec::new(), Vec::new(), String::new());
        let verdict = FaultVerdict { fault: Fault::InnerRace, conclusion, false_alarm, ..FaultVerdict::default() };
        Diagnosis {
            envelope: String::new(),
            envelopes: 1,
            spectrum: EnvelopeOrderSpectrum { order, amplitude, unit, turns: 30.0, mean: 0.0, highest: 0.0 },
            speed_hz: 25.0,
            given_speed_hz: 25.0,
            speed_error: 0.0,
            speed_source: SpeedSource::Exact,
            faults: vec![verdict],
            unexplained: Vec::new(),
            by_signal_alone: Vec::new(),
            grew: Vec::new(),
        }
    }

    #[test]
    fn damage_that_a_verdict_does_not_see_is_told() {
        let case = Case::example("tadina2011/inner-dent", &[]);
        let told = |conclusion, chance| missed_by(&case, "", &diagnosis(conclusion, chance));
        let expected = "the case has a dent in the inner race; the signal does not show it";
        assert_eq!(told(Conclusion::NotSeen, Some(0.5)).as_deref(), Some(expected));
        let unproved = "the case has a dent in the inner race; the signal does not prove it";
        assert_eq!(told(Conclusion::NotEnough, Some(4e-11)).as_deref(), Some(unproved));
        assert_eq!(told(Conclusion::Named, Some(1e-9)), None);
        // too short a window says so itself
        assert_eq!(told(Conclusion::NotEnough, None), None);
        let sound = Case::example("tadina2011/healthy", &[]);
        assert_eq!(missed_by(&sound, "", &diagnosis(Conclusion::NotSeen, Some(0.5))), None);
    }

    #[test]
    fn a_bearing_of_the_catalogue_is_named() {
        let mut bearing = Case::example("tadina2011/healthy", &[]).bearing.unwrap();
        assert!(bearing_fact(&bearing).value.starts_with("7 balls of "));
        bearing.name = Some("6305".to_owned());
        assert!(bearing_fact(&bearing).value.starts_with("6305, 7 balls of "));
    }

    #[test]
    fn speeds_are_in_hertz_and_revolutions_per_minute() {
        let words = |points: &[(f64, f64)]| {
            let knot = |&(time, frequency_hz): &(f64, f64)| crate::bearing::SpeedKnot { time, frequency_hz };
            speed_words(&Speed { profile: points.iter().map(knot).collect() })
        };
        assert_eq!(words(&[(0.0, 0.0), (1.0, 25.0)]), "run-up from 0 to 25 Hz (1500 rpm) in 1 s");
        assert_eq!(words(&[(0.0, 25.0), (2.5, 20.0)]), "run-down from 25 Hz (1500 rpm) to 20 Hz (1200 rpm) in 2.5 s");
        assert_eq!(words(&[(0.0, 22.0)]), "constant, 22 Hz (1320 rpm)");
    }
}
