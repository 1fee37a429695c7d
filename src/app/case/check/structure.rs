//! Materials, housing and ring.

use super::super as case;
use super::super::other_size;
use super::super::tree::quoted;
use super::super::{Axis, Bond, Case, Hold, Housing, HousingSource, Material, Ring, RingSupport, Seat};
use super::range::{
    self, ABOVE_ZERO, DEGREES, DENSITY, LOSS_FACTOR, MODULUS, POISSON, SHARE, ZERO_OR_MORE, above, below, count,
    direction, each_once, kept, known_isotropic, known_material, needs, not_beside, not_empty,
};
use super::rule::{BrokenRule, Rule};
use crate::bearing::catalogue::CatalogueBearing;
use crate::fe::material::{MaterialError, OrthotropicMaterial, RadiusRule};
use crate::fe::model::{Connection, Fit, SpringStiffness};

pub(super) fn materials(case: &Case) -> Result<(), BrokenRule> {
    for (name, material) in &case.materials {
        let at = |key: &str| format!("materials.{}.{key}", quoted(name));
        match material {
            Material::Isotropic(material) => {
                ABOVE_ZERO.check(at("young"), material.young)?;
                MODULUS.check(at("young"), material.young)?;
                POISSON.check(at("poisson"), material.poisson)?;
            }
            Material::Orthotropic(material) => {
                for (key, values) in [("young", material.young), ("shear", material.shear)] {
                    for (place, value) in values.into_iter().enumerate() {
                        let key = format!("{}[{place}]", at(key));
                        ABOVE_ZERO.check(key.as_str(), value)?;
                        MODULUS.check(key, value)?;
                    }
                }
                direction(at("x_axis"), material.x_axis)?;
                direction(at("y_axis"), material.y_axis)?;
                let case::OrthotropicMaterial { young, poisson, shear, x_axis, y_axis, .. } = *material;
                // the density has its own rule
                let stable = OrthotropicMaterial::new(young, poisson, shear, 1.0, x_axis, y_axis);
                stable.map_err(|error| {
                    let key = match error {
                        MaterialError::ParallelAxes { .. } => "y_axis",
                        _ => "poisson",
                    };
                    Rule::new(error.to_string()).at(at(key))
                })?;
            }
        }
        ABOVE_ZERO.check(at("density"), material.density())?;
        DENSITY.check(at("density"), material.density())?;
        LOSS_FACTOR.check(at("loss_factor"), material.loss_factor())?;
    }
    Ok(())
}

pub(super) fn housing(case: &Case) -> Result<(), BrokenRule> {
    let Some(housing) = case.meshed_housing() else {
        return needs("housing.superelement", "[ring]", case.superelement().is_none() || case.has_rings());
    };
    ABOVE_ZERO.check("housing.plane.thickness", housing.plane.map(|plane| plane.thickness))?;
    not_empty("housing.parts", housing.parts.len(), "at least one part")?;
    for (index, part) in housing.parts.iter().enumerate() {
        known_material(case, &format!("housing.parts[{index}].material"), &part.material)?;
    }
    let groups = housing.parts.iter().map(|part| part.group.as_str());
    each_once(groups, |index| format!("housing.parts[{index}].group"))?;
    housing_supports(housing)?;
    links(housing)?;
    for (index, mass) in housing.masses.iter().enumerate() {
        ABOVE_ZERO.check(format!("housing.masses[{index}].mass"), mass.mass)?;
        range::MASS.check(format!("housing.masses[{index}].mass"), mass.mass)?;
    }
    Ok(())
}

fn housing_supports(housing: &Housing) -> Result<(), BrokenRule> {
    let plane = housing.plane.is_some();
    for (index, support) in housing.supports.iter().enumerate() {
        let at = |key: &str| format!("housing.supports[{index}].{key}");
        match &support.hold {
            Hold::All => {}
            Hold::Fixed(axes) => {
                not_empty(at("fixed"), axes.len(), "at least one of x, y, z")?;
                let names = axes.iter().map(|axis| match axis {
                    Axis::X => "x",
                    Axis::Y => "y",
                    Axis::Z => "z",
                });
                each_once(names, |_| at("fixed"))?;
                kept(!plane || !axes.contains(&Axis::Z), at("fixed"), no_z)?;
            }
            Hold::Spring(stiffness, _) => springs(at, *stiffness, plane)?,
        }
    }
    Ok(())
}

fn links(housing: &Housing) -> Result<(), BrokenRule> {
    let plane = housing.plane.is_some();
    for (index, link) in housing.links.iter().enumerate() {
        let at = |key: &str| format!("housing.links[{index}].{key}");
        each_once(link.between.iter().map(String::as_str), |_| at("between"))?;
        if let Connection::Spring(stiffness, _) = link.connection {
            springs(at, stiffness, plane)?;
        }
    }
    Ok(())
}

/// Springs of the table whose keys `at` names.
fn springs(at: impl Fn(&str) -> String, stiffness: SpringStiffness, plane: bool) -> Result<(), BrokenRule> {
    let [x, y, z] = match stiffness {
        SpringStiffness::Radial(stiffness) => return ABOVE_ZERO.check(at("radial"), stiffness),
        SpringStiffness::Global(along) => along,
    };
    let key = at("spring");
    let parts = [("x", x), ("y", y), ("z", z)];
    for (name, stiffness) in parts {
        ZERO_OR_MORE.check(format!("{key}.{name}"), stiffness)?;
        range::STIFFNESS.check(format!("{key}.{name}"), stiffness)?;
    }
    let acting = parts.iter().filter(|(_, stiffness)| *stiffness > 0.0);
    not_empty(key.as_str(), acting.count(), "a stiffness above 0")?;
    kept(!plane || z <= 0.0, key, no_z)
}

fn no_z() -> Rule {
    Rule::found("a component z", "x and y only in a plane model")
}

pub(super) fn ring(case: &Case, seat: &Seat<'_>) -> Result<(), BrokenRule> {
    let ring = seat.ring;
    count("ring.nodes", ring.nodes, 8..=2000, "8 to 2000 nodes")?;
    sections(case, seat)?;
    for (index, support) in ring.supports.iter().enumerate() {
        // whether a superelement is plane is told by its file
        let plane =
            case.superelement().is_none() && (case.meshed_housing()).is_none_or(|housing| housing.plane.is_some());
        ring_support(&format!("ring.supports[{index}]"), support, plane)?;
    }
    tie(case, ring)
}

fn sections(case: &Case, seat: &Seat<'_>) -> Result<(), BrokenRule> {
    let ring = seat.ring;
    not_empty("ring.sections", ring.sections.len(), "at least one section")?;
    for (index, section) in ring.sections.iter().enumerate() {
        let at = |key: &str| format!("ring.sections[{index}].{key}");
        known_isotropic(case, &at("material"), &section.material)?;
        ABOVE_ZERO.check(at("area"), section.area)?;
        ABOVE_ZERO.check(at("inertia"), section.inertia)?;
        ABOVE_ZERO.check(at("axial_inertia"), section.axial_inertia)?;
        ABOVE_ZERO.check(at("torsion"), section.torsion)?;
        ABOVE_ZERO.check(at("radius"), section.radius)?;
        below(
            at("inertia"),
            section.inertia,
            "area radius^2 / 3, that of a section which reaches the ring's axis",
            section.area * section.radius.powi(2) / 3.0,
        )?;
        SHARE.check(at("shear_coefficient"), section.shear_coefficient)?;
        if let Some(outer) = ring.outer_radius {
            let name = seat.bearing.and_then(|bearing| bearing.name.as_deref());
            let bearing = name.filter(|_| section.radius >= outer).and_then(CatalogueBearing::named);
            if let Some(rule) = bearing.and_then(|own| other_size(own, "`ring.outer_radius`", [outer; 2], "it")) {
                return Err(rule.at("bearing.name"));
            }
            above("ring.outer_radius", outer, "the section's radius", section.radius)?;
        }
    }
    let slips = ring.bond == Bond::Slip || ring.radius_rule == RadiusRule::Own;
    needs("ring.radius_rule", "`ring.bond = \"slip\"`", slips)
}

fn ring_support(key: &str, support: &RingSupport, plane: bool) -> Result<(), BrokenRule> {
    DEGREES.check(format!("{key}.from_deg"), support.from_deg)?;
    let to = format!("{key}.to_deg");
    above(&to, support.to_deg, "`from_deg`", support.from_deg)?;
    kept(support.to_deg - support.from_deg <= 360.0, to, || {
        Rule::beyond(support.to_deg, "at most a full turn after `from_deg`", support.from_deg + 360.0)
    })?;
    let at = |name: &str| format!("{key}.{name}");
    springs(at, support.spring.into(), plane)
}

fn tie(case: &Case, ring: &Ring) -> Result<(), BrokenRule> {
    let tie = match (&ring.tie, &case.housing) {
        // the interface of a superelement is the ring itself
        (None, None | Some(HousingSource::Superelement(_))) => return Ok(()),
        (Some(_), Some(HousingSource::Superelement(_))) => {
            return not_beside("ring.tie", "housing.superelement", true);
        }
        (None, Some(HousingSource::Mesh(_))) => {
            return Err(Rule::new("found a housing and no `ring.tie`, which leaves the ring unconnected")
                .with_help("add tie = { group = \"NAME OF THE BORE\" } to [ring]")
                .at("ring"));
        }
        (Some(_), None) => return needs("ring.tie", "[housing]", false),
        (Some(tie), Some(HousingSource::Mesh(_))) => tie,
    };
    direction("ring.tie.axis", tie.axis)?;
    direction("ring.tie.zero_deg", tie.zero_deg)?;
    let across = cross(tie.axis, tie.zero_deg);
    // Directions nearer than about a millionth of a turn count as one.
    if dot(across, across) <= 1e-12 * dot(tie.axis, tie.axis) * dot(tie.zero_deg, tie.zero_deg) {
        return Err(Rule::found("the direction of `ring.tie.axis`", "one across it").at("ring.tie.zero_deg"));
    }
    kept(tie.fit != Fit::Sliding || !ring.supports.is_empty(), "ring.tie.fit", || {
        Rule::new("found \"sliding\" and no springs in `ring.supports`, which leaves the ring free to turn").with_help(
            "use fit = \"bonded\", or add springs in x and y (in a solid housing in z too) to `ring.supports`",
        )
    })
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
