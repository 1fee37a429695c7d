//! What moves, what is recorded, and how finely.

use super::super::{
    Accuracy, Case, Damping, EnvelopeBand, FixedInterfaceModes, Frf, Interface, InterfaceModes, Linearise, Load,
    Method, ModesKept, SensorSpot, Shaft, Speed, StepLength, Transient,
};
use super::range::{
    self, ABOVE_ZERO, CYCLES, DEGREES, FRACTION, RATIO, SHARE, ZERO_OR_MORE, ZERO_TO_ONE, above, below, direction,
    each_once, kept, known_sensor, needs, not_beside, not_empty,
};
use super::rule::{BrokenRule, Rule, short};
use crate::fe::modal::ModeRange;
use crate::formats::is_array_name;

/// Signals that every simulation records under these names.
const RESERVED_NAMES: [&str; 14] = [
    "time_s",
    "shaft_x",
    "shaft_y",
    "ball_radius",
    "outer_force",
    "inner_force",
    "shaft_speed_hz",
    "shaft_angle_rad",
    "shaft_z",
    "tilt_x",
    "tilt_y",
    "ball_axial",
    "outer_angle",
    "inner_angle",
];

pub(super) fn shaft(shaft: &Shaft) -> Result<(), BrokenRule> {
    ABOVE_ZERO.check("shaft.mass", shaft.mass)?;
    range::MASS.check("shaft.mass", shaft.mass)?;
    ZERO_OR_MORE.check("shaft.unbalance", shaft.unbalance)?;
    range::LOAD.check("shaft.unbalance", shaft.unbalance)?;
    if let Some(inertia) = shaft.transverse_inertia {
        ABOVE_ZERO.check("shaft.transverse_inertia", inertia)?;
        range::MASS.check("shaft.transverse_inertia", inertia)?;
    }
    if let Some(polar) = shaft.polar_inertia {
        ZERO_OR_MORE.check("shaft.polar_inertia", polar)?;
        // no body has more: I_p = sum (x^2 + y^2) dm, and I_t = I_p / 2 + sum z^2 dm
        let most = 2.0 * shaft.transverse_inertia.unwrap_or(f64::INFINITY);
        kept(polar <= most, "shaft.polar_inertia".to_owned(), || {
            Rule::beyond(polar, "at most twice shaft.transverse_inertia", most)
        })?;
    }
    let place = |key: String, place: f64| range::PLACE.check(key, place);
    shaft.centre.iter().try_for_each(|centre| place("shaft.centre".to_owned(), *centre))?;
    for (index, unbalance) in shaft.unbalances.iter().enumerate() {
        let at = |key: &str| format!("shaft.unbalances[{index}].{key}");
        ZERO_OR_MORE.check(at("moment"), unbalance.moment)?;
        range::LOAD.check(at("moment"), unbalance.moment)?;
        DEGREES.check(at("angle_deg"), unbalance.angle_deg)?;
        place(at("at"), unbalance.at)?;
    }
    let loads = |key: String, force: &[f64]| force.iter().try_for_each(|&part| range::LOAD.check(key.clone(), part));
    loads("shaft.gravity".to_owned(), &shaft.gravity)?;
    for (index, load) in shaft.loads.iter().enumerate() {
        let key = format!("shaft.loads[{index}]");
        match load {
            Load::Constant(force) => loads(key, force)?,
            Load::Spatial { force, moment, at } => {
                loads(key.clone(), force)?;
                loads(key.clone(), moment)?;
                place(format!("{key}.at"), *at)?;
            }
            Load::SpatialProfile { profile, at } => {
                place(format!("{key}.at"), *at)?;
                let key = format!("{key}.profile");
                increasing(&key, profile.iter().map(|point| point.time))?;
                for point in profile {
                    loads(key.clone(), &point.force)?;
                    loads(key.clone(), &point.moment)?;
                }
            }
            Load::Profile(points) => {
                let key = format!("{key}.profile");
                increasing(&key, points.iter().map(|point| point.time))?;
                points.iter().try_for_each(|point| loads(key.clone(), &point.force))?;
            }
        }
    }
    Ok(())
}

pub(super) fn damping(damping: &Damping) -> Result<(), BrokenRule> {
    match damping {
        Damping::Modal(modal) => RATIO.check("damping.modal", *modal),
        Damping::Rayleigh { alpha, beta } => {
            ZERO_OR_MORE.check("damping.alpha", *alpha)?;
            ZERO_OR_MORE.check("damping.beta", *beta)
        }
        Damping::Ratios(points) => {
            for (index, point) in points.iter().enumerate() {
                let at = |key: &str| format!("damping.ratios[{index}].{key}");
                ABOVE_ZERO.check(at("frequency_hz"), point.frequency_hz)?;
                RATIO.check(at("ratio"), point.ratio)?;
            }
            let [first, second] = points.map(|point| point.frequency_hz);
            above("damping.ratios[1].frequency_hz", second, "the frequency before it", first)
        }
    }
}

pub(super) fn speed(speed: &Speed) -> Result<(), BrokenRule> {
    for (index, point) in speed.profile.iter().enumerate() {
        // `hz` or `rpm`; further out, squares leave the numbers
        let speed = point.frequency_hz;
        kept(speed.abs() <= 1e6, format!("speed.profile[{index}]"), || {
            let found = format!("{} Hz ({} rpm)", short(speed), short(60.0 * speed));
            Rule::found(found, "a speed of at most 1e6 Hz (6e7 rpm) either way")
        })?;
        range::TIME.check(format!("speed.profile[{index}].time"), point.time)?;
    }
    increasing("speed.profile", speed.profile.iter().map(|point| point.time))
}

/// Times of the points under `key`, of which there is at least one.
fn increasing(key: &str, times: impl Iterator<Item = f64>) -> Result<(), BrokenRule> {
    let times: Vec<f64> = times.collect();
    not_empty(key, times.len(), "at least one point")?;
    for (index, pair) in times.windows(2).enumerate() {
        let key = format!("{key}[{}].time", index + 1);
        above(key, pair[1], "the time before it", pair[0])?;
    }
    Ok(())
}

pub(super) fn sensors(case: &Case) -> Result<(), BrokenRule> {
    for (index, sensor) in case.sensors.iter().enumerate() {
        let at = |key: &str| format!("sensors[{index}].{key}");
        not_empty(at("name"), sensor.name.len(), "a name")?;
        let name = sensor.name.as_str();
        kept(is_array_name(name), at("name"), || {
            let expected = "letters, digits, `_`, `-`, `.` and spaces: the signal is saved under this name";
            Rule::found(format!("\"{}\"", name.escape_debug()), expected)
        })?;
        let reserved = RESERVED_NAMES.contains(&name);
        kept(!reserved, at("name"), || Rule::new(format!("\"{name}\" is the name of another signal")))?;
        if !matches!(sensor.spot, SensorSpot::Recovered(_)) {
            direction(at("direction"), sensor.direction)?;
        }
        let mesh = match case.superelement() {
            None => "[housing]",
            Some(_) => "`housing.mesh` (a superelement has rows of its own sensors: `recovered = \"NAME\"`)",
        };
        let meshed = case.meshed_housing().is_some();
        let (key, other, present) = match sensor.spot {
            SensorSpot::Group(_) => ("group", mesh, meshed),
            SensorSpot::Node(_) => ("node", mesh, meshed),
            SensorSpot::Point(_) => ("point", mesh, meshed),
            SensorSpot::RingDeg(_) => ("ring_deg", "[ring]", case.has_rings()),
            SensorSpot::Recovered(_) => ("recovered", "`housing.superelement`", case.superelement().is_some()),
        };
        needs(at(key), other, present)?;
        if let SensorSpot::RingDeg(angle) = sensor.spot {
            DEGREES.check(at("ring_deg"), angle)?;
        }
    }
    let names = case.sensors.iter().map(|sensor| sensor.name.as_str());
    each_once(names, |index| format!("sensors[{index}].name"))
}

pub(super) fn modes(case: &Case) -> Result<(), BrokenRule> {
    match case.modes.extent {
        ModeRange::Count(count) | ModeRange::AtMost(count) => range::count("modes.count", count, 1.., "at least 1")?,
        ModeRange::UpToHz(limit) => ABOVE_ZERO.check("modes.up_to_hz", limit)?,
        ModeRange::BandHz(band) => band_of("modes.band_hz", band)?,
    }
    let passes = !case.modes.ball_pass || case.modes.linearise != Linearise::None;
    needs("modes.ball_pass", "`modes.linearise = \"static\"`", passes)?;
    for (index, expected) in case.modes.expected.iter().enumerate() {
        ABOVE_ZERO.check(format!("modes.expected[{index}].hz"), expected.hz)?;
        FRACTION.check(format!("modes.expected[{index}].within"), expected.within)?;
    }
    for (index, variant) in case.modes.variants.iter().enumerate() {
        let key = format!("modes.variants[{index}].set");
        not_empty(key, variant.set.len(), "at least one KEY=VALUE")?;
    }
    mode_checks(case)
}

fn mode_checks(case: &Case) -> Result<(), BrokenRule> {
    for (index, other) in case.modes.compare.iter().enumerate() {
        let at = |key: &str| format!("modes.compare[{index}].{key}");
        SHARE.check(at("mac"), other.mac)?;
        FRACTION.check(at("within"), other.within)?;
        ABOVE_ZERO.check(at("points_within"), other.points_within)?;
        let frd = other.file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("frd"));
        kept(other.length_unit.is_none() || frd, at("length_unit"), || {
            Rule::new(format!("{} says its own unit or is in m", other.file.display()))
                .with_help("`length_unit` is for files of CalculiX (.frd)")
        })?;
    }
    let Some(convergence) = &case.modes.convergence else {
        return Ok(());
    };
    let Some(housing) = case.meshed_housing() else {
        let other = if case.superelement().is_none() { "[housing]" } else { "`housing.mesh`" };
        return needs("modes.convergence", other, false);
    };
    let key = "modes.convergence.meshes";
    not_empty(key, convergence.meshes.len(), "at least one other mesh")?;
    // the case's own mesh is the first of the sequence
    let own = housing.mesh.to_string_lossy();
    let others = convergence.meshes.iter().map(|mesh| mesh.to_string_lossy());
    let names: Vec<_> = [own].into_iter().chain(others).collect();
    let names = names.iter().map(AsRef::as_ref);
    each_once(names, |place| format!("{key}[{}]", place.saturating_sub(1)))?;
    ABOVE_ZERO.check("modes.convergence.order", convergence.order)
}

/// A band begins at zero or above and ends above its beginning.
fn band_of(key: &str, [lowest, highest]: [f64; 2]) -> Result<(), BrokenRule> {
    ZERO_OR_MORE.check(format!("{key}[0]"), lowest)?;
    above(format!("{key}[1]"), highest, "the lowest frequency", lowest)
}

pub(super) fn condense(case: &Case) -> Result<(), BrokenRule> {
    if case.superelement().is_some() {
        let other = "housing.superelement";
        not_beside("condense.interface", other, case.condense.interface != Interface::Ring)?;
        not_beside("condense.interface_modes", other, case.condense.interface_modes != InterfaceModes::None)?;
    }
    match case.condense.interface_modes {
        InterfaceModes::None => {}
        InterfaceModes::Count(count) => ABOVE_ZERO.check("condense.interface_modes", count as f64)?,
        InterfaceModes::UpToHz(limit) => ABOVE_ZERO.check("condense.interface_modes.up_to_hz", limit)?,
    }
    if let Interface::Centres { centres, rings } = &case.condense.interface {
        let tied = case.seats().iter().any(|seat| seat.ring.tie.is_some());
        needs("condense.interface.rings", "`ring.tie`", tied || !rings)?;
        not_empty("condense.interface.centres", centres.len(), "at least one bore")?;
        let groups = centres.iter().map(|centre| centre.group.as_str());
        each_once(groups, |index| format!("condense.interface.centres[{index}].group"))?;
    }
    if let Interface::Nodes(nodes) = &case.condense.interface {
        not_empty("condense.interface.nodes", nodes.len(), "at least one node")?;
        let names: Vec<String> = nodes.iter().map(u64::to_string).collect();
        each_once(names.iter().map(String::as_str), |index| format!("condense.interface.nodes[{index}]"))?;
    }
    match case.condense.fixed_interface_modes {
        FixedInterfaceModes::Auto | FixedInterfaceModes::Count(_) => Ok(()),
        FixedInterfaceModes::UpToHz(limit) => ABOVE_ZERO.check("condense.fixed_interface_modes.up_to_hz", limit),
    }
}

pub(super) fn frf(case: &Case, frf: &Frf) -> Result<(), BrokenRule> {
    not_empty("frf.from", frf.from.len(), "at least one force")?;
    for (index, push) in frf.from.iter().enumerate() {
        direction(format!("frf.from[{index}].direction"), push.direction)?;
        if let SensorSpot::RingDeg(angle) = push.spot {
            DEGREES.check(format!("frf.from[{index}].ring_deg"), angle)?;
        }
    }
    let names = frf.from.iter().map(|push| push.name.as_str());
    each_once(names, |index| format!("frf.from[{index}].name"))?;
    each_once(frf.to.iter().map(String::as_str), |index| format!("frf.to[{index}]"))?;
    for (index, name) in frf.to.iter().enumerate() {
        known_sensor(case, format!("frf.to[{index}]"), name)?;
    }
    frf.band_hz.iter().try_for_each(|&band| band_of("frf.band_hz", band))?;
    // the condensed housing is made for the band: above, a difference from the full model says nothing
    let highest = frf.band_hz.unwrap_or(case.band_or_default())[1];
    for (index, &hz) in frf.check_hz.iter().flatten().enumerate() {
        let key = format!("frf.check_hz[{index}]");
        ZERO_OR_MORE.check(key.clone(), hz)?;
        kept(hz <= highest, key, || {
            Rule::beyond(hz, "at most the highest frequency of the band", highest).with_help(
                "the band is that of `frf.band_hz`, else of `accuracy.band_hz`: raise it or leave this frequency out",
            )
        })?;
    }
    Ok(())
}

pub(super) fn accuracy(accuracy: &Accuracy) -> Result<(), BrokenRule> {
    band_of("accuracy.band_hz", accuracy.band_hz)?;
    FRACTION.check("accuracy.target", accuracy.target)?;
    range::TARGET.check("accuracy.target", accuracy.target)
}

pub(super) fn transient(case: &Case, transient: &Transient) -> Result<(), BrokenRule> {
    ZERO_OR_MORE.check("transient.start", transient.start)?;
    range::TIME.check("transient.start", transient.start)?;
    range::TIME.check("transient.end", transient.end)?;
    above("transient.end", transient.end, "`transient.start`", transient.start)?;
    if let Some(radius) = transient.spectral_radius {
        ZERO_TO_ONE.check("transient.spectral_radius", radius)?;
        let other = "`transient.method = \"generalized-alpha\"`";
        needs("transient.spectral_radius", other, transient.method == Method::GeneralizedAlpha)?;
    }
    if let StepLength::Seconds(step) = transient.step {
        ABOVE_ZERO.check("transient.step", step)?;
        below("transient.step", step, "the simulated time", transient.end - transient.start)?;
    }
    if let Some(tolerance) = transient.tolerance {
        FRACTION.check("transient.tolerance", tolerance)?;
        let other = "`transient.method = \"dop853\"` or `\"exponential-adams\"`";
        let chooses = matches!(transient.method, Method::Dop853 | Method::ExponentialAdams);
        needs("transient.tolerance", other, chooses)?;
    }
    if let ModesKept::Count(count) = transient.modes {
        range::count("transient.modes", count, 1.., "at least 1")?;
    }
    range::count("transient.ensemble.runs", transient.ensemble.runs, 2..=10_000, "2 to 10000 runs")?;
    FRACTION.check("transient.ensemble.perturbation", transient.ensemble.perturbation)?;
    ABOVE_ZERO.check("transient.output_hz", transient.output_hz)?;
    range::RATE.check("transient.output_hz", transient.output_hz)?;
    let interval = 1.0 / transient.output_hz;
    kept(transient.end - transient.start >= (1.0 - 1e-9) * interval, "transient.end", || {
        let first = transient.start + interval;
        Rule::beyond(transient.end, "at least one interval of `transient.output_hz` after `transient.start`", first)
    })?;
    let Some(accuracy) = &case.accuracy else {
        return Ok(());
    };
    let (found, other) = (transient.output_hz, 2.0 * accuracy.band_hz[1]);
    kept(found >= other, "transient.output_hz", || {
        Rule::beyond(found, "at least twice the highest frequency of `accuracy.band_hz`", other)
            .with_help("raise the sampling rate or narrow `accuracy.band_hz`")
    })?;
    // the recording filter's length grows with the ratio: at this one it takes 80 MB
    let (found, other) = (accuracy.band_hz[1], (1e-5 * transient.output_hz).min(1.0));
    kept(found >= other, "accuracy.band_hz[1]", || {
        Rule::beyond(found, "at least 1 Hz, or a hundred-thousandth of `transient.output_hz` where that is less", other)
            .with_help("widen the band, or record at a lower `transient.output_hz`")
    })
}

pub(super) fn analysis(case: &Case) -> Result<(), BrokenRule> {
    if let Some(corner) = case.analysis.high_pass_hz {
        ABOVE_ZERO.check("analysis.high_pass_hz", corner)?;
        below_half_the_rate(case, "analysis.high_pass_hz", corner)?;
    }
    if let Some(band) = case.analysis.band_hz {
        let key = "analysis.band_hz";
        not_beside(key, "analysis.high_pass_hz", case.analysis.high_pass_hz.is_some())?;
        if let EnvelopeBand::Between(edges) = band {
            within_rate(case, key, edges)?;
        }
    }
    for (index, window) in case.analysis.envelope.iter().enumerate() {
        let key = format!("analysis.envelope[{index}]");
        within_run(case, &key, [window.from, window.to])?;
    }
    if let Some(scalogram) = &case.analysis.scalogram {
        let key = "analysis.scalogram";
        within_run(case, key, [scalogram.from, scalogram.to])?;
        within_rate(case, &format!("{key}.band_hz"), scalogram.band_hz)?;
        CYCLES.check(format!("{key}.cycles"), scalogram.cycles)?;
    }
    Ok(())
}

/// A band of that key is one above zero, and lies below half the sampling rate.
fn within_rate(case: &Case, key: &str, [low, high]: [f64; 2]) -> Result<(), BrokenRule> {
    ABOVE_ZERO.check(format!("{key}[0]"), low)?;
    above(format!("{key}[1]"), high, "the lowest frequency", low)?;
    below_half_the_rate(case, &format!("{key}[1]"), high)
}

fn below_half_the_rate(case: &Case, key: &str, frequency_hz: f64) -> Result<(), BrokenRule> {
    match &case.transient {
        Some(transient) => below(key, frequency_hz, "half of `transient.output_hz`", 0.5 * transient.output_hz),
        None => Ok(()),
    }
}

/// A window of that key is one, and lies in the simulation.
fn within_run(case: &Case, key: &str, [from, to]: [f64; 2]) -> Result<(), BrokenRule> {
    above(format!("{key}.to"), to, "`from`", from)?;
    let Some(&Transient { start, end, .. }) = case.transient.as_ref() else {
        return Ok(());
    };
    kept(from >= start && to <= end, key, || {
        // as much of the window as is simulated, else the second half of the simulation
        let within = if from < end { from.max(start) } else { 0.5 * (start + end) };
        let [from, to, start, end, within] = [from, to, start, end, within].map(short);
        Rule::found(format!("{from} to {to} s"), &format!("a window within the simulation ({start} to {end} s)"))
            .with_help(format!("simulate it all, `transient.end` = {to}; or look at less, `{key}.from` = {within} and `{key}.to` = {end}"))
    })
}
