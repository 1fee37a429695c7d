//! A case in words and units, as the first page of every report says it: the housing, the ring and what holds them.

use super::bearing_words;
use super::phrases::{and, direction_words, length, listed};
use crate::app::case::{
    Axis, Bond, Case, Damping, Hold, Housing, Material, Purpose, Push, ReportDetails, Seat, Sensor, SensorSpot,
};
use crate::app::commands::analyze::report::capital;
use crate::app::scene::AssembledHousing;
use crate::fe::element::continuum::PlaneAssumption;
use crate::fe::element::curved_beam::RingInterpolation;
use crate::fe::mesh::Mesh;
use crate::fe::model::{Connection, Fit, HousingModel, SpringShare, SpringStiffness, SupportShare};
use crate::files::FileDigest;
use crate::report::{Document, Fact, MeshFile, Report, given, mass_in_words, quantity};

/// What a mesh says of a housing.
pub(crate) struct HousingSize {
    /// Extent along the mesh's axes, m.
    extent: [f64; 3],
    nodes: usize,
    elements: usize,
    /// Mass of the housing, kg, where it is known apart from that of the ring.
    mass: Option<f64>,
}

impl HousingSize {
    pub(crate) fn of(mesh: &Mesh, model: &HousingModel, mass: Option<f64>) -> Self {
        let nodes = model.dof() / model.dimension().max(1);
        Self { extent: mesh.inventory().bounding_box.extent(), nodes, elements: model.elements().len(), mass }
    }

    pub(crate) fn of_housing(housing: &AssembledHousing) -> Self {
        Self::of(&housing.mesh, &housing.model, Some(housing.matrices.total_mass()))
    }
}

/// The inputs of a computation: what of the case a command uses, with the size of its housing.
pub(crate) fn inputs(case: &Case, purpose: Purpose, size: Option<&HousingSize>) -> Vec<Fact> {
    let mut facts = Vec::new();
    if purpose == Purpose::Bearing {
        return bearing_words::facts(case, false);
    }
    match (case.meshed_housing(), case.superelement()) {
        (Some(housing), _) => facts.extend(housing_facts(case, housing, size)),
        (None, Some(path)) => {
            facts.push(Fact::new("Housing", format!("a superelement from the file {}", path.display())));
        }
        (None, None) => {}
    }
    facts.extend(case.seats().iter().flat_map(|seat| ring_facts(case, seat)));
    let moves = matches!(purpose, Purpose::Run | Purpose::Chart);
    if moves || case.modes.linearise == crate::app::case::Linearise::Static && purpose == Purpose::Modes {
        facts.extend(bearing_words::facts(case, moves));
    }
    if moves || purpose == Purpose::Frf {
        let damping = case.damping.as_ref().map_or_else(|| "none".to_owned(), damping_words);
        facts.push(Fact::new("Damping of ring and housing", damping));
        facts.extend(listed("Sensors", case.sensors.iter().map(sensor_words)));
    }
    if let (Purpose::Frf, Some(frf)) = (purpose, &case.frf) {
        facts.extend(listed("Forces", frf.from.iter().map(push_words)));
    }
    facts
}

/// A report with the entries of the case's `[report]` in its head.
pub(crate) fn with_details(mut report: Report, case: &Case) -> Report {
    let head = report.document.get_or_insert_with(|| Document::new().case(case.source.path.display().to_string()));
    head.case_hash = MeshFile::from(&FileDigest::of_bytes(&case.source.path, case.source.text.as_bytes())).hash;
    with_entries(report, case.report.as_ref())
}

/// A report with these entries in its head.
pub(crate) fn with_entries(mut report: Report, details: Option<&ReportDetails>) -> Report {
    let Some(details) = details else { return report };
    let head = report.document.get_or_insert_with(Document::new);
    for (key, text) in details.entries() {
        match (key, text) {
            ("title", Some(title)) => title.clone_into(&mut report.title),
            (_, Some(text)) => head.details.push(Fact::new(capital(key), text)),
            (_, None) => {}
        }
    }
    report
}

fn housing_facts(case: &Case, housing: &Housing, size: Option<&HousingSize>) -> Vec<Fact> {
    let file = housing.mesh.file_name().unwrap_or(housing.mesh.as_os_str()).to_string_lossy();
    let mut text = file.into_owned();
    if let Some(HousingSize { extent, nodes, elements, mass }) = size {
        // a plane mesh has no third extent
        let extent: Vec<String> = extent.iter().filter(|m| **m > 0.0).map(|metres| given(1e3 * metres)).collect();
        text += &format!(", {} mm", extent.join(" x "));
        text.extend(mass.map(|kg| format!(", {}", mass_in_words(kg, 5))));
        text += &format!(", {nodes} nodes, {elements} elements");
    }
    let mut facts = vec![Fact::new("Housing", text)];
    if let Some(plane) = housing.plane {
        let assumption = match plane.assumption {
            PlaneAssumption::Stress => "stress",
            PlaneAssumption::Strain => "strain",
        };
        facts.push(Fact::new("Plane model", format!("plane {assumption}, {} thick", length(plane.thickness))));
    }
    let material = |part: &crate::app::case::Part| format!("{}: {}", part.group, material_words(case, &part.material));
    facts.extend(listed("Materials of the housing", housing.parts.iter().map(material)));
    let supports: Vec<String> =
        housing.supports.iter().map(|s| format!("{} {}", s.group, hold_words(&s.hold))).collect();
    facts.push(listed("Supports", supports).unwrap_or_else(|| Fact::new("Supports of the housing", "none")));
    let masses = housing.masses.iter().map(|mass| format!("{} kg on {}", given(mass.mass), mass.group));
    facts.extend(listed("Added masses", masses));
    let links = housing.links.iter().map(|link| {
        let [a, b] = &link.between;
        match &link.connection {
            Connection::Tie => format!("{a} and {b} move as one"),
            Connection::Spring(stiffness, share) => {
                format!("{a} and {b} are connected by {}", springs_words(stiffness, *share == SupportShare::PerNode))
            }
        }
    });
    facts.extend(listed("Links", links));
    facts
}

fn ring_facts(case: &Case, seat: &Seat<'_>) -> Vec<Fact> {
    let ring = seat.ring;
    let named = |what: &str| format!("{what} {}", seat.label).trim_end().to_owned();
    let sections = ring.sections.iter().map(|section| {
        format!(
            "{}, area {} mm\u{b2}, second moment of area {} mm\u{2074}, radius of its centroid {}",
            section.material,
            given(1e6 * section.area),
            given(1e12 * section.inertia),
            length(section.radius)
        )
    });
    let together = match (ring.sections.len(), ring.bond) {
        (1, _) => "",
        (_, Bond::Slip) => "; in radial contact, free to slide",
        (_, Bond::Composite) => "; as one body",
    };
    let element = match ring.element {
        RingInterpolation::ExactArc => "curved beams, exact circular arcs",
        RingInterpolation::Raveendranath => "curved beams with Raveendranath's polynomials",
    };
    let with = |on: bool| if on { "with" } else { "without" };
    let kind =
        format!("{} {element}, {} shear, {} rotary inertia", ring.nodes, with(ring.shear), with(ring.rotary_inertia));
    let sections: Vec<String> = sections.collect();
    let mut facts = vec![Fact::new(named("Outer ring"), sections.join("; ") + together).note(kind)];
    let materials: std::collections::BTreeSet<&str> = ring.sections.iter().map(|s| s.material.as_str()).collect();
    facts.extend(listed(&named("Materials of the ring"), materials.into_iter().map(|name| material_words(case, name))));
    facts.extend(ring.tie.as_ref().map(|tie| {
        let fit = match tie.fit {
            Fit::Bonded => "bonded in every direction",
            Fit::Sliding => "free to slide in the bore",
        };
        Fact::new(named("Fit of the ring"), format!("in the bore (group \"{}\"), {fit}", tie.group))
    }));
    let supports = ring.supports.iter().map(|support| {
        let stiffness = SpringStiffness::from(support.spring);
        let springs = springs_words(&stiffness, support.per == SpringShare::PerNode);
        format!("{springs}, from {}\u{b0} to {}\u{b0}", given(support.from_deg), given(support.to_deg))
    });
    facts.extend(listed(&named("Supports of the ring"), supports));
    facts
}

/// A material with its constants.
fn material_words(case: &Case, name: &str) -> String {
    let constants = match case.material(name) {
        Some(Material::Isotropic(m)) => format!("E = {} GPa, \u{3bd} = {}", given(1e-9 * m.young), given(m.poisson)),
        Some(Material::Orthotropic(m)) => {
            let young = m.young.map(|young| given(1e-9 * young));
            let poisson = m.poisson.map(given);
            let shear = m.shear.map(|shear| given(1e-9 * shear));
            format!(
                "orthotropic, E = {} GPa, \u{3bd} = {}, G = {} GPa",
                young.join(" / "),
                poisson.join(" / "),
                shear.join(" / ")
            )
        }
        None => return name.to_owned(),
    };
    let density = case.material(name).map_or(0.0, Material::density);
    let loss = case.material(name).map_or(0.0, Material::loss_factor);
    let loss = if loss > 0.0 { format!(", loss factor {}", given(loss)) } else { String::new() };
    format!("{name} ({constants}, \u{3c1} = {} kg/m\u{b3}{loss})", given(density))
}

fn hold_words(hold: &Hold) -> String {
    match hold {
        Hold::All => "held in every direction".to_owned(),
        Hold::Fixed(axes) => {
            let axes: Vec<String> = axes.iter().map(|axis| axis_name(*axis).to_owned()).collect();
            format!("held along {}", and(&axes))
        }
        Hold::Spring(stiffness, share) => format!("on {}", springs_words(stiffness, *share == SupportShare::PerNode)),
    }
}

const fn axis_name(axis: Axis) -> &'static str {
    match axis {
        Axis::X => "x",
        Axis::Y => "y",
        Axis::Z => "z",
    }
}

fn springs_words(stiffness: &SpringStiffness, per_node: bool) -> String {
    let along = match stiffness {
        SpringStiffness::Global(stiffness) => {
            let along: Vec<(f64, &str)> =
                stiffness.iter().copied().zip(["x", "y", "z"]).filter(|(k, _)| *k > 0.0).collect();
            let axes: Vec<String> = along.iter().map(|(_, axis)| (*axis).to_owned()).collect();
            match along.as_slice() {
                [(first, _), rest @ ..] if rest.iter().all(|(k, _)| k.total_cmp(first).is_eq()) => {
                    format!("{} along {}", quantity(*first, "N/m"), and(&axes))
                }
                all => {
                    let each = all.iter().map(|(k, axis)| format!("{} along {axis}", quantity(*k, "N/m")));
                    and(&each.collect::<Vec<_>>())
                }
            }
        }
        SpringStiffness::Radial(k) => format!("{} along the radius", quantity(*k, "N/m")),
    };
    format!("springs of {along} {}", if per_node { "at each node" } else { "in the sum of all nodes" })
}

/// Damping of ring and housing, in words.
pub(super) fn damping_words(damping: &Damping) -> String {
    let percent = |ratio: f64| format!("{} % of critical", given(100.0 * ratio));
    match damping {
        Damping::Ratios(points) => {
            let points = points.each_ref().map(|at| format!("{} at {} Hz", percent(at.ratio), given(at.frequency_hz)));
            format!("{} (Rayleigh)", points.join(" and "))
        }
        Damping::Rayleigh { alpha, beta } => {
            format!("Rayleigh, {} 1/s times the mass and {} s times the stiffness", given(*alpha), given(*beta))
        }
        Damping::Modal(ratio) => format!("{} in every mode", percent(*ratio)),
    }
}

fn sensor_words(sensor: &Sensor) -> String {
    let direction = match sensor.spot {
        SensorSpot::Recovered(_) => String::new(),
        _ => format!(", {}", direction_words(&sensor.direction)),
    };
    format!("{}: {}{direction}", sensor.name, spot_words(&sensor.spot, sensor.bearing.as_deref()))
}

fn push_words(push: &Push) -> String {
    format!(
        "1 N at {}: {}, {}",
        push.name,
        spot_words(&push.spot, push.bearing.as_deref()),
        direction_words(&push.direction)
    )
}

fn spot_words(spot: &SensorSpot, bearing: Option<&str>) -> String {
    match spot {
        SensorSpot::Group(group) => format!("mean over {group}"),
        SensorSpot::RingDeg(degrees) => {
            let of = bearing.map_or_else(String::new, |label| format!(" of bearing {label}"));
            format!("on the ring{of} at {}\u{b0}", given(*degrees))
        }
        SensorSpot::Node(tag) => format!("node {tag}"),
        SensorSpot::Point(point) => {
            let [x, y, z] = point.map(|metres| given(1e3 * metres));
            format!("the node nearest to ({x}, {y}, {z}) mm")
        }
        SensorSpot::Recovered(row) => format!("row {row} of the superelement"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(case: &Case, purpose: Purpose) -> String {
        let facts = inputs(case, purpose, None);
        facts.iter().map(|fact| format!("{}: {}\n", fact.name, fact.value)).collect()
    }

    #[test]
    fn a_case_is_said_in_words_and_units() {
        let case = Case::example("housings/ring", &["damping.modal=0.02", "bearing.defects.0.depth=5e-6"]);
        let run = said(&case, Purpose::Run);
        for line in [
            "Housing: ring_6_9.msh\n",
            "Plane model: plane stress, 4 mm thick\n",
            "Materials of the housing: housing: aluminium (E = 70 GPa, \u{3bd} = 0.33, \u{3c1} = 2700 kg/m\u{b3})\n",
            "Supports: lower on springs of 3.6 MN/m along x and y in the sum of all nodes\n",
            "Fit of the ring: in the bore (group \"bore\"), bonded in every direction\n",
            "Fault of the bearing: a dent 0.75 mm long, 0.41 mm wide and 5 \u{b5}m deep in the outer race at 270\u{b0}\n",
            "Shaft: 0.15 kg, gravity 9.81 m/s\u{b2} along \u{2212}y, unbalance 20 g mm\n",
            "Loads on the shaft: none but its weight and unbalance\n",
            "Speed of the shaft: constant, 22 Hz (1320 rpm)\n",
            "Simulated time: from 0 s to 0.7 s, recorded at 100 kHz\n",
            "Damping of ring and housing: 2 % of critical in every mode\n",
            "Sensors: P1: mean over top, along +y\n",
        ] {
            assert!(run.contains(line), "{line}{run}");
        }
        // a condensed housing has no bearing and no speed
        let condensed = said(&case, Purpose::Condense);
        assert!(condensed.contains("Supports: ") && !condensed.contains("Bearing") && !condensed.contains("Speed"));
    }
}
