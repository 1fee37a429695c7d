//! What of a model may be meant otherwise, a sentence each: warnings of reports and results.

use super::bearing::race_contacts;
use super::contacts::contact_doubts;
use super::housing::{description, frame, read_mesh};
use super::ring::{BoreExtent, layer, metres};
use super::{deck, fit, plausible};
use crate::app::case;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::fe::element::continuum::LinearFormulation;
use crate::fe::mesh::{ElementKind, Mesh};
use crate::fe::modal::pieces_at;
use crate::fe::model::HousingModel;
use crate::numerics::{Brief, Unwatched};
use crate::report::{mass_in_words, significant};
use crate::system::{BearingSetup, Equilibrium};
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of a ring's width beyond its bore that is told. The width is that of a rectangle in the section's place, which
/// misses that of a grooved section by some percent.
const OVERHANG: f64 = 0.05;

/// Distance between a ring's outer face and its bore that is told, over the section's height: so far the section moves
/// the bore by a rigid arm.
const ARM: f64 = 0.5;

/// Angle without a node of the bore that is told: three times what a coarse bore of first order has between two nodes.
const FREE_TURN: f64 = FRAC_PI_2;

/// Densities of balls, kg/m^3: those of solids, from plastics to tungsten.
const BALL_DENSITIES: [f64; 2] = [800.0, 20_000.0];

/// Distance between the faces of two neighbouring sections that is told, over the lower one's height.
const GAP: f64 = 0.5;

/// Width of a section over the outer diameter of its ring that is told: rings and housings about a bearing are narrower.
const WIDTH: f64 = 2.0;

/// Lame's first constant over the shear modulus at a Poisson's ratio of 0.49, with round-off (docs/elements.md, chart of bending).
const VOLUME_KEEPS: f64 = 49.0 + 1e-9;

/// Elements of constant strain across their thickness, which lock in bending (docs/elements.md).
const STIFF_IN_BENDING: [ElementKind; 4] =
    [ElementKind::Tri3, ElementKind::Tet4, ElementKind::Wedge6, ElementKind::Pyramid5];

/// The doubts about a case: of its housing, of how the ring sits in it, and of the bearing under the load at rest.
///
/// # Errors
/// [`ComputeError`] of materials and of the bearing.
pub(crate) fn doubts(
    case: &Case,
    housing: Option<(&Mesh, &HousingModel)>,
    at_rest: Option<(&BearingSetup, &Equilibrium)>,
) -> Result<Vec<String>, ComputeError> {
    let mut found = plausible::materials(case);
    if let Some((mesh, model)) = housing {
        found.extend(mesh.notes.told.iter().map(|told| format!("{}: {told}", mesh.source.display())));
        found.extend(deck::doubts(case, mesh));
        found.extend(plausible::housing(case, model));
        found.extend(housing_doubts(mesh, model));
        found.extend(fit::centre_doubts(case, mesh, model));
    }
    for seat in case.seats() {
        let of_seat =
            [section_doubts(case, seat.ring)?, ring_doubts(case, &seat, housing)?, fit::bearing_doubts(case, &seat)?];
        found.extend(of_seat.into_iter().flatten().map(|doubt| seat.told(doubt)));
    }
    found.extend(plausible::shaft(case));
    if let (Some((setup, equilibrium)), Some(contacts)) = (at_rest, race_contacts(case)?) {
        found.extend(case.bearing.as_ref().and_then(case::Bearing::taken_from));
        found.extend(ball_density(setup));
        found.extend(plausible::contacts(case, setup, &contacts));
        found.extend(contact_doubts(setup, &contacts, equilibrium));
    }
    Ok(found)
}

/// The doubts about a case's housing and how the ring sits in it, of which nothing is computed.
///
/// # Errors
/// [`ComputeError`] of mesh, model and ring.
pub(crate) fn doubts_of_case(case: &Case) -> Result<Vec<String>, ComputeError> {
    let Some(housing) = case.meshed_housing() else {
        return doubts(case, None, None);
    };
    let mesh = read_mesh(case, housing, &Unwatched)?;
    let model = HousingModel::new(&mesh, description(case, housing)?)?;
    doubts(case, Some((&mesh, &model)), None)
}

fn housing_doubts(mesh: &Mesh, model: &HousingModel) -> Vec<String> {
    let merge = deck::merge_nodes(mesh);
    let order = deck::second_order(mesh);
    let overlaps = model.overlaps.iter().map(|overlap| {
        format!("{}; housing.overlap allows it, mass and stiffness count twice there", overlap.sentence("m"))
    });
    let touching = model.touching.iter().map(|touching| {
        let [a, b] = &touching.parts;
        let help = match a == b {
            true => format!("where they are one body, merge their nodes ({merge})"),
            false => format!(
                "nothing holds them together there; where they are one body, use BooleanFragments in gmsh, merge their nodes ({merge}), or add {{ between = [\"{a}\", \"{b}\"], tie = true }} to housing.links"
            ),
        };
        format!("{}; {help}", touching.sentence("m"))
    });
    let crossings = model.crossings.iter().map(|crossing| {
        format!(
            "{}; mass and stiffness count twice there: cut one from the other in gmsh (BooleanDifference or BooleanFragments), or move it",
            crossing.sentence("m")
        )
    });
    let apart = model.apart.iter().map(|apart| {
        format!(
            "{}; the tie is rigid across that distance: draw the parts on each other, or give it the faces that are",
            apart.sentence("m")
        )
    });
    let links = model.description.links.iter().zip(&model.common_nodes);
    let shared = links.filter(|(_, common)| **common > 0).map(|(link, common)| {
        let [a, b] = &link.between;
        format!(
            "the groups \"{a}\" and \"{b}\" of a link share {common} of their nodes, which move as one without it; give the faces of each body a group of its own if that is not meant"
        )
    });
    let flat = model.flat_layers().map(|flat| {
        let [x, y, z] = flat.place;
        format!(
            "flat layers of first order with incompatible modes stand on held faces, {} of their faces, and may be far too soft: the longest edge is {:.1} times the height of the layer at element {}, ({x:.6}, {y:.6}, {z:.6}) m; supports, stiff springs or a body at least ten times as stiff hold these faces; give shorter edges along them, elements of second order, or housing.linear = \"plain\"",
            flat.faces, flat.flatness, flat.tag
        )
    });
    let trapezoids = model.trapezoids().map(|found| {
        let [x, y, z] = found.place;
        format!(
            "part \"{}\" has elements of first order ({}) with tilted sides in thin places, where they are far too stiff in bending: frequencies may be up to {:.1} times too high; the worst is element {}, ({x:.6}, {y:.6}, {z:.6}) m; mesh with second order ({order}), or with sides straight across the thickness",
            model.description.parts[found.part].group, found.elements, found.factor, found.tag
        )
    });
    let thin = model.thin_plates().map(|found| {
        let skewed = match found.skew.to_degrees() {
            skew if skew < 10.0 => String::new(),
            skew => format!(", {skew:.0} degrees off square,"),
        };
        format!(
            "Hex8 ({}) are in thin plates, with edges up to {} times as long as the plate is thick{} at element {} of part \"{}\": the frequencies of bending are too high where a wave spans few of them; give shorter edges, or mesh with second order ({order})",
            found.elements, significant(found.slenderness, 2), skewed, found.tag, model.description.parts[found.part].group
        )
    });
    let curved = model.curved_walls().map(|found| {
        format!(
            "elements of second order ({}) of part \"{}\" stand alone across curved walls, where bending stretches them: frequencies may be 40 % too high where the sagitta of an edge is 0.4 of the thickness, and several times at 2; it is up to {}, at element {}; give shorter edges along the curve",
            found.elements, model.description.parts[found.part].group, significant(found.sagitta, 2), found.tag
        )
    });
    let confined = model.confined().map(|found| {
        format!(
            "elements of first order ({}) stand alone between held faces in layers that hardly change their volume: their frequencies of pressure may be twice too high; the first is element {} of part \"{}\"; give two elements across, or mesh with second order ({order})",
            found.elements, found.tag, model.description.parts[found.part].group
        )
    });
    let is_plain = model.description.formulation.linear == LinearFormulation::Plain;
    let stiff = model.description.parts.iter().enumerate().flat_map(|(part, described)| {
        let of_kind = move |kind: ElementKind| {
            let own = model.elements().iter().filter(|element| element.part == part && element.kind == kind);
            (own.count(), kind)
        };
        let plain = [ElementKind::Quad4, ElementKind::Hex8].into_iter().filter(|_| is_plain);
        let counts = STIFF_IN_BENDING.into_iter().chain(plain).map(of_kind).filter(|(count, _)| *count > 0);
        counts.map(|(count, kind)| {
            let [plain, way] = match STIFF_IN_BENDING.contains(&kind) {
                true => ["", ""],
                false => ["plain ", "leave housing.linear = \"plain\" out, or "],
            };
            let lost = if kind == ElementKind::Pyramid5 { "48 %" } else { "75 %" };
            format!(
                "part \"{}\" has {count} {plain}{} elements, which are far too stiff in bending: with one layer across a thickness, they lose {lost} of the deflection and more; {way}mesh with second order ({order})",
                described.group,
                kind.name()
            )
        })
    });
    let parts = model.description.parts.iter().zip(&model.properties);
    let soft = parts.filter(|(_, own)| own.lame_over_shear() > VOLUME_KEEPS).map(|(part, _)| {
        format!(
            "part \"{}\" has a Poisson's ratio above 0.49, at which every element is too stiff in bending: with one layer across a thickness, long elements of second order lose 28 % of the deflection and more; give several layers of elements as long as they are high",
            part.group
        )
    });
    let held = model.held_masses().map(|mass| {
        format!(
            "the mass of {} kg on the group \"{}\" is where supports hold every direction: it counts in the mass of the model and moves nothing",
            mass.mass, mass.group
        )
    });
    let tied = overlaps.chain(touching).chain(crossings).chain(apart);
    tied.chain(shared)
        .chain(flat)
        .chain(trapezoids)
        .chain(thin)
        .chain(curved)
        .chain(confined)
        .chain(stiff)
        .chain(soft)
        .chain(held)
        .collect()
}

/// Sections that do not touch their neighbours, or that are wider than a ring: a value in another unit.
fn section_doubts(case: &Case, ring: &case::Ring) -> Result<Vec<String>, ComputeError> {
    let mut sections = Vec::new();
    for (index, section) in ring.sections.iter().enumerate() {
        let layer = layer(case, section)?;
        sections.push((index, layer.radius, layer.rectangle()));
    }
    sections.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut found = Vec::new();
    for (index, radius, [height, width]) in &sections {
        if *width > WIDTH * (2.0 * radius + height) {
            let [width, height, radius] = [*width, *height, *radius].map(metres);
            found.push(format!(
                "ring.sections[{index}] is about {width} wide by its area and inertia, and {height} high at a radius of {radius}: no ring is as wide; check area (m^2) and inertia (m^4)"
            ));
        }
    }
    for pair in sections.windows(2) {
        let [(inner, low, [inner_height, _]), (outer, high, [outer_height, _])] = pair else {
            continue;
        };
        let gap = (high - 0.5 * outer_height) - (low + 0.5 * inner_height);
        if gap.abs() > GAP * inner_height.min(*outer_height) {
            let how = match gap > 0.0 {
                true => "lie apart by",
                false => "reach into each other by",
            };
            found.push(format!(
                "ring.sections[{inner}] and ring.sections[{outer}] {how} about {} by their radii, areas and inertias: rings that are fitted into each other touch; check radius (m), area (m^2) and inertia (m^4)",
                metres(gap.abs())
            ));
        }
    }
    Ok(found)
}

/// How the ring sits in the housing.
fn ring_doubts(
    case: &Case,
    seat: &case::Seat<'_>,
    housing: Option<(&Mesh, &HousingModel)>,
) -> Result<Vec<String>, ComputeError> {
    let ring = seat.ring;
    let (Some((mesh, model)), Some(tie)) = (housing, &ring.tie) else {
        return Ok(Vec::new());
    };
    let mut found = Vec::new();
    let (mut width, mut face, mut height) = (0.0_f64, 0.0_f64, 0.0_f64);
    for section in &ring.sections {
        let layer = layer(case, section)?;
        let [radial, along] = layer.rectangle();
        // a groove takes from the area and hardly from the second moment: the smaller of two estimates
        let by_inertia = (12.0 * layer.out_of_plane_inertia() / layer.area).sqrt();
        width = width.max(along.min(by_inertia));
        if layer.radius + 0.5 * radial > face {
            (face, height) = (layer.radius + 0.5 * radial, radial);
        }
    }
    let extent = BoreExtent::of(mesh, model, &frame(seat)?, &tie.group)?;
    if extent.free_turn > FREE_TURN {
        found.push(format!(
            "the bore \"{}\" leaves {:.0} degrees of the turn free, where nothing holds the ring: check that the group has all faces of the bore",
            tie.group,
            extent.free_turn.to_degrees()
        ));
    }
    found.extend(bore_in_pieces(mesh, model, &tie.group)?);
    if model.dimension() == 3 {
        let outside = extent.share_outside(width);
        if outside > OVERHANG {
            found.push(format!(
                "{:.0} % of the ring's width lies outside the bore \"{}\": the ring is about {} wide by its sections and the bore reaches from {} to {} along the axis, from the ring's plane; the overhang is tied as a rigid arm; check ring.tie.centre, ring.tie.axis and ring.sections",
                100.0 * outside,
                tie.group,
                metres(width),
                metres(extent.from),
                metres(extent.to)
            ));
        }
    }
    let Some(outer) = ring.outer_radius else {
        found.extend(fit::filled(&tie.group, &extent, face, height));
        return Ok(found);
    };
    if (outer - face).abs() > ARM * height {
        found.push(format!(
            "ring.outer_radius is {} and the outer face of ring.sections lies at about {}: the tie bridges {} between them as a rigid arm; check both",
            metres(outer),
            metres(face),
            metres((outer - face).abs())
        ));
    }
    Ok(found)
}

/// Whether the bore is of bodies that nothing but the ring joins.
fn bore_in_pieces(mesh: &Mesh, model: &HousingModel, bore: &str) -> Result<Option<String>, ComputeError> {
    let group = model.group_on_housing(mesh, bore, "the tie")?;
    // bodies that are too many to be looked at are told with the modes
    let pieces = pieces_at(mesh, model, &group.nodes).unwrap_or_default();
    if pieces.len() < 2 {
        return Ok(None);
    }
    let named: Vec<String> = pieces.iter().map(|parts| format!("\"{}\"", parts.join("\", \""))).collect();
    Ok(Some(format!(
        "the bore \"{bore}\" is in {} bodies that nothing but the ring joins, of the parts {}: where they are one in the machine, use BooleanFragments in gmsh, merge their nodes ({}), or add a link to housing.links",
        pieces.len(),
        named.join(" and "),
        deck::merge_nodes(mesh)
    )))
}

/// Density of a ball of the given mass.
fn ball_density(setup: &BearingSetup) -> Option<String> {
    let (radius, mass) = (setup.geometry.ball_radius(), setup.geometry.ball_mass());
    let density = mass / (4.0 / 3.0 * PI * radius.powi(3));
    let [least, most] = BALL_DENSITIES;
    (!(least..=most).contains(&density)).then(|| {
        format!(
            "a ball of {} and {} radius has a density of {} kg/m^3, which no solid ball has: check bearing.ball_mass, bearing.density and bearing.ball_radius",
            mass_in_words(mass, 4),
            metres(radius),
            Brief::rounded(density, 4)
        )
    })
}
