//! `plummer inspect`: a look at a mesh.

use std::fmt::Write as _;
use std::path::Path;

use super::earlier_results::result_of;
use super::output::json;
use super::{CliError, Options, Outcome, OutputFolder};
use crate::app::case::{Case, short};
use crate::app::commands::result::VERSION;
use crate::app::commands::{InspectResult, Inspection, SurfaceKind};
use crate::app::scene::size_doubt;
use crate::fe::mesh::{ConsistentUnits, DeckMaterial};
use crate::numerics::units::LengthUnit;
use crate::report::{counted, mass_in_words, significant, size_in_words};

/// Densities (kg/m^3) for which the mass is shown when none is asked for.
const DENSITIES: [(f64, &str); 2] = [(2700.0, "of aluminium"), (7850.0, "of steel")];

/// What to do with a mesh of surfaces in space.
const SHELLS: &str = "mesh the volume (gmsh PART.step -3 -order 2 -o PART.msh, with -algo hxt or smaller elements where gmsh makes no volumes), or draw a plane model in x and y";

/// Inspects a mesh, or that of a case; writes `inspect.json` if a folder was named with `--out`.
///
/// # Errors
/// [`CliError`] when the mesh cannot be read or the result cannot be written.
pub(crate) fn inspect(
    path: &Path,
    unit: Option<LengthUnit>,
    density: Option<f64>,
    straight: bool,
    options: &Options,
) -> Result<Outcome, CliError> {
    let started = std::time::Instant::now();
    // a case stands for its mesh
    let case = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    let case = case.then(|| Case::load(path, &[])).transpose()?;
    let housing = case.as_ref().map(|case| {
        let without = format!("{}: expected a case with `housing.mesh`, found none", path.display());
        case.meshed_housing().ok_or_else(|| CliError::input(without))
    });
    let housing = housing.transpose()?;
    let path = housing.map_or(path, |housing| &housing.mesh);
    let unit = unit.or(housing.map(|housing| housing.length_unit));
    let straight = straight || housing.is_some_and(|housing| housing.straighten);
    let found = Inspection::of_file(path, unit, straight)?;
    if found.shells {
        let what = "the mesh is of surfaces that do not lie in a plane z = const, and shells are not modelled";
        return Err(CliError::input(format!("{}: {what}", path.display())).with_help(SHELLS));
    }
    let result = json(&InspectResult {
        plummer: VERSION,
        command: "inspect",
        mesh: path,
        wall_s: started.elapsed().as_secs_f64(),
        mass_kg: density.filter(|_| unit.is_some()).map(|density| density * found.size),
        found: &found,
    })?;
    let mut written = Vec::new();
    if let Some(folder) = &options.out {
        let folder = OutputFolder::at(folder);
        folder.claim_unless(&["inspect.json"], options.force, |earlier| {
            (result_of("inspect", earlier)["mesh"] != result["mesh"]).then_some("")
        })?;
        written.push(folder.write_json("inspect.json", &result)?.0);
    }
    Ok(Outcome { summary: summary(path, &found, density), result, written, verdict: verdict(&found) })
}

/// A mesh is good unless elements of it are folded or count twice.
pub(super) fn verdict(found: &Inspection) -> Result<(), CliError> {
    let unit = found.length_unit.map_or("unit", |_| "m");
    let overlapping: Vec<String> = found.overlapping.iter().map(|overlap| overlap.sentence(unit)).collect();
    let (what, help) = match (found.invalid.first(), &found.doubled, &found.mixed_orders) {
        (None, None, None) if overlapping.is_empty() => return Ok(()),
        (None, None, None) => {
            let advice = found.overlapping[0].advice();
            let help = format!("{advice}; with housing.overlap = \"allow\" a case takes them as they are");
            return Err(CliError::failed(overlapping.join("; ")).with_help(help));
        }
        (None, None, Some(mixed)) => (
            mixed.sentence(unit),
            "all elements of a body are of one order: mesh the geometry again, gmsh PART.step -3 -order 2 -o PART.msh",
        ),
        (None, Some(doubled), _) => (
            doubled.sentence(unit),
            "keep each element once: put every volume (surface of a plane mesh) into one physical group, and save the mesh again",
        ),
        (Some(first), ..) => (
            format!(
                "{} inverted, folded or without size (the first is element {})",
                counted(found.invalid_elements, "element"),
                first.tag
            ),
            match found.folded_elements {
                0 => "mesh again, or look at them in gmsh (Tools, Visibility)",
                count if count < found.invalid_elements => {
                    "--straighten (housing.straighten = true in a case) mends some of them; mesh again for the others"
                }
                _ => {
                    "--straighten (housing.straighten = true in a case) mends them; or mesh again, finer where the surface is curved"
                }
            },
        ),
    };
    Err(CliError::failed(what).with_help(help))
}

fn summary(path: &Path, found: &Inspection, density: Option<f64>) -> String {
    let mut text = String::new();
    let inventory = &found.inventory;
    let unit = found.length_unit.map_or("unit", |_| "m");
    let counts = |kinds: &[crate::fe::mesh::KindCount]| {
        let names = kinds.iter().map(|kind| format!("{} {}", kind.count, kind.kind.name()));
        names.collect::<Vec<_>>().join(", ")
    };
    let mut line = |name: &str, value: String| {
        // writing to a String cannot fail
        let _ = writeln!(text, "{name:<18}{value}");
    };
    line("file", format!("{} ({})", path.display(), inventory.format));
    inventory.notes.told.iter().for_each(|note| line("warning", note.to_string()));
    inventory.notes.as_points.iter().for_each(|note| line("points", note.clone()));
    if !inventory.notes.passed_over.is_empty() {
        line("not read", inventory.notes.passed_over.join(", "));
    }
    let notes = &inventory.notes;
    let units = ConsistentUnits::of(&notes.materials).map_or("units unknown", |units| units.name);
    notes.materials.iter().for_each(|material| line("material", of_file(material, units)));
    for held in notes.supports.iter().filter(|held| held.fixed.contains(&true)) {
        let axes = ["x", "y", "z"].into_iter().zip(held.fixed).filter(|(_, fixed)| *fixed).map(|(axis, _)| axis);
        line("held", format!("\"{}\" along {}", held.group, axes.collect::<Vec<_>>().join(", ")));
    }
    notes.not_supports.iter().for_each(|note| line("boundaries", note.clone()));
    line("elements", counts(&inventory.elements));
    line("nodes", format!("{}{}", inventory.nodes, node_faults(found)));
    let extent = inventory.bounding_box.extent();
    let [x, y, z] = extent.map(|side| significant(side, 5));
    match found.length_unit {
        Some(_) => line("extent", size_in_words(extent)),
        None => line("extent", format!("{x} x {y} x {z} {unit}")),
    }
    let solid = inventory.dimension == 3;
    let what = if solid { "volume" } else { "area" };
    let power = if solid { 3 } else { 2 };
    line(what, format!("{} {unit}^{power}", significant(found.size, 7)));
    if solid {
        line("mass", masses(found, density));
    }
    if let Some(told) = found.length_unit.and_then(|unit| size_doubt(extent, unit, "--length-unit")) {
        line("warning", told);
    }
    if let Some(worst) = &found.worst {
        let [x, y, z] = worst.shape.position.map(|at| significant(at, 5));
        let shape = format!(
            "Jacobian ratio {} at element {} ({}), ({x}, {y}, {z}) {unit}",
            significant(worst.shape.scaled_jacobian, 3),
            worst.tag,
            worst.kind.name()
        );
        line("worst shape", shape);
    }
    if found.invalid_elements > 0 {
        let tags: Vec<String> = found.invalid.iter().map(|bad| bad.tag.to_string()).collect();
        let more = if found.invalid_elements > tags.len() { ", ..." } else { "" };
        line("INVALID", format!("{}: {}{more}", counted(found.invalid_elements, "element"), tags.join(", ")));
    }
    found.doubled.iter().for_each(|doubled| line("DOUBLED", doubled.sentence(unit)));
    found.mixed_orders.iter().for_each(|mixed| line("MIXED ORDERS", mixed.sentence(unit)));
    found.overlapping.iter().for_each(|overlap| line("OVERLAP", overlap.sentence(unit)));
    found.touching.iter().for_each(|touching| line("warning", touching.sentence(unit)));
    found.crossing.iter().for_each(|crossing| line("warning", crossing.sentence(unit)));
    line("connected parts", inventory.parts.len().to_string());
    if inventory.parts.len() > 1 {
        for part in &inventory.parts {
            let [x, y, z] = part.bounding_box.extent().map(|side| significant(side, 4));
            let size = format!("{}, {x} x {y} x {z} {unit}", counted(part.elements, "element"));
            line("", format!("{size}, node {}", part.node_tag));
        }
    }
    if inventory.ungrouped_elements > 0 {
        line("in no group", counted(inventory.ungrouped_elements, "element"));
    }
    for overlap in &inventory.overlaps {
        let [a, b] = &overlap.names;
        line("overlap", format!("\"{a}\" and \"{b}\": {}", counted(overlap.elements, "element")));
    }
    let _ = write!(text, "groups");
    for group in &inventory.groups {
        let what = ["points", "curves", "surfaces", "volumes"][group.dimension.min(3)];
        let (name, tag) = (format!("\"{}\"", group.name), group.tag);
        let _ = write!(text, "\n  {name:<22}{what:<9} tag {tag:<5}{:>8} nodes  ", group.nodes);
        let _ = write!(text, "{}", counts(&group.kinds));
        let mut sizes = found.group_sizes.iter();
        if let Some(size) = sizes.find(|size| size.name == group.name && size.dimension == group.dimension) {
            let power = ["", "", "^2", "^3"][group.dimension.min(3)];
            let _ = write!(text, "  {} {unit}{power}", significant(size.size, 5));
        }
    }
    text += &surfaces(found, unit);
    if found.length_unit.is_none() {
        let _ = write!(
            text,
            "\nThe file does not say its unit of length; give --length-unit mm (m, cm, um, in) for sizes in metres."
        );
    }
    text
}

/// A material of the file, in the file's numbers.
fn of_file(material: &DeckMaterial, units: &str) -> String {
    let elastic = material.elastic.map(|[young, poisson]| format!("E {}, nu {poisson}", short(young)));
    let density = material.density.map(|density| format!("density {}", short(density)));
    let elastic = elastic.or_else(|| material.other_law.clone()).unwrap_or_else(|| "no isotropic modulus".to_owned());
    let density = density.unwrap_or_else(|| "no density".to_owned());
    let groups: Vec<String> = material.groups.iter().map(|group| format!("\"{group}\"")).collect();
    let of = if groups.is_empty() { "no group".to_owned() } else { groups.join(", ") };
    let first = if material.first_line { ", the first line of several over temperature" } else { "" };
    format!("\"{}\": {elastic}, {density}{first} ({units}) of {of}", material.name)
}

/// Surfaces that the summary lists.
const SURFACES: usize = 24;

/// The CAD surfaces that are in no group, largest first.
fn surfaces(found: &Inspection, unit: &str) -> String {
    let mut text = String::new();
    let mut surfaces: Vec<_> = found.surfaces.iter().collect();
    if surfaces.is_empty() {
        return text;
    }
    surfaces.sort_by(|a, b| b.size.total_cmp(&a.size));
    let (what, power) = if found.inventory.dimension == 3 { ("surfaces", "^2") } else { ("curves", "") };
    // writing to a String cannot fail
    let _ = write!(text, "\nCAD {what} in no group, which a case names by kind and tag");
    // the fit's round-off is no direction
    let plain = |part: f64| if part.abs() < 1e-9 { 0.0 } else { part };
    let vector = |vector: [f64; 3]| vector.map(|part| significant(plain(part), 3)).join(", ");
    for surface in surfaces.iter().take(SURFACES) {
        let kind = match surface.kind {
            SurfaceKind::Cylinder { diameter, axis, hole, turn } => format!(
                "{} of diameter {} {unit} along ({}), {} % of the turn",
                if hole == Some(true) { "hole" } else { "cylinder" },
                significant(diameter, 5),
                vector(axis),
                significant(100.0 * turn, 3)
            ),
            SurfaceKind::Plane { normal } => format!("plane, normal ({})", vector(normal)),
            SurfaceKind::Other => "neither cylinder nor plane".to_owned(),
        };
        let (name, size) = (format!("\"{}\"", surface.name), significant(surface.size, 5));
        let _ = write!(text, "\n  {name:<22}{kind}, {size} {unit}{power}, {}", counted(surface.elements, "element"));
    }
    if surfaces.len() > SURFACES {
        let _ = write!(text, "\n  and {} smaller ones, which --json lists", surfaces.len() - SURFACES);
    }
    text
}

fn node_faults(found: &Inspection) -> String {
    let (unused, doubled) = (&found.inventory.unused, &found.inventory.duplicates);
    let mut faults = String::new();
    if unused.count > 0 {
        faults += &format!(", {} unused (tags {:?} ...)", unused.count, unused.first_tags);
    }
    if doubled.count > 0 {
        faults += &format!(", {} in the place of another (pairs {:?} ...)", doubled.count, doubled.first_pairs);
    }
    faults
}

/// Mass for the density asked for, else for common ones; without a unit for millimetres and metres.
fn masses(found: &Inspection, density: Option<f64>) -> String {
    let common = DENSITIES.map(|(density, material)| (density, material.to_owned())).to_vec();
    let densities = density.map_or(common, |density| vec![(density, format!("at {density} kg/m^3"))]);
    let units = match found.length_unit {
        Some(_) => vec![(1.0, "")],
        None => vec![(1e-9, " if in mm"), (1.0, " if in m")],
    };
    let words = units.into_iter().flat_map(|(scale, unit)| {
        densities.iter().map(move |(density, material)| {
            format!("{} {material}{unit}", mass_in_words(density * scale * found.size, 5))
        })
    });
    words.collect::<Vec<_>>().join(", ")
}
