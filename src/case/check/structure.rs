//! Materials, housing and ring.

use super::super::path::quoted;
use super::super::{Axis, Bond, Case, Fit, Hold, Housing, RadiusRule, Ring, RingSupport, Spring};
use super::range::{
    above, above_zero, direction, each_once, known_material, not_empty, poisson, share,
    zero_or_more,
};
use super::rule::{BrokenRule, Rule};

pub(super) fn materials(case: &Case) -> Result<(), BrokenRule> {
    for (name, material) in &case.materials {
        let at = |key: &str| format!("materials.{}.{key}", quoted(name));
        above_zero(at("young"), material.young)?;
        poisson(at("poisson"), material.poisson)?;
        above_zero(at("density"), material.density)?;
    }
    Ok(())
}

pub(super) fn housing(case: &Case) -> Result<(), BrokenRule> {
    let Some(housing) = &case.housing else {
        return Ok(());
    };
    if let Some(plane) = &housing.plane {
        above_zero("housing.plane.thickness", plane.thickness)?;
    }
    not_empty("housing.parts", housing.parts.len(), "at least one part")?;
    for (index, part) in housing.parts.iter().enumerate() {
        let key = format!("housing.parts[{index}].material");
        known_material(case, key, &part.material)?;
    }
    let groups = housing.parts.iter().map(|part| part.group.as_str());
    each_once(groups, |index| format!("housing.parts[{index}].group"))?;
    housing_supports(housing)?;
    for (index, mass) in housing.masses.iter().enumerate() {
        above_zero(format!("housing.masses[{index}].mass"), mass.mass)?;
    }
    Ok(())
}

fn housing_supports(housing: &Housing) -> Result<(), BrokenRule> {
    let plane = housing.plane.is_some();
    for (index, support) in housing.supports.iter().enumerate() {
        let at = |key: &str| format!("housing.supports[{index}].{key}");
        match &support.hold {
            Hold::Fixed(axes) => {
                not_empty(at("fixed"), axes.len(), "at least one of x, y, z")?;
                let names = axes.iter().map(|axis| match axis {
                    Axis::X => "x",
                    Axis::Y => "y",
                    Axis::Z => "z",
                });
                each_once(names, |_| at("fixed"))?;
                if plane && axes.contains(&Axis::Z) {
                    return Err(Rule::NoZ.at(at("fixed")));
                }
            }
            Hold::Spring { spring, .. } => springs(&at("spring"), *spring, plane)?,
            Hold::Radial { stiffness, .. } => above_zero(at("radial"), *stiffness)?,
        }
    }
    Ok(())
}

fn springs(key: &str, spring: Spring, plane: bool) -> Result<(), BrokenRule> {
    let parts = [("x", spring.x), ("y", spring.y), ("z", spring.z)];
    for (name, stiffness) in parts {
        zero_or_more(format!("{key}.{name}"), stiffness)?;
    }
    let acting = parts.iter().filter(|(_, stiffness)| *stiffness > 0.0);
    not_empty(key, acting.count(), "a stiffness above 0")?;
    if plane && spring.z > 0.0 {
        return Err(Rule::NoZ.at(key));
    }
    Ok(())
}

pub(super) fn ring(case: &Case) -> Result<(), BrokenRule> {
    let Some(ring) = &case.ring else {
        return Ok(());
    };
    if !(8..=2000).contains(&ring.nodes) {
        let (found, expected) = (ring.nodes, "8 to 2000 nodes");
        return Err(Rule::Count { found, expected }.at("ring.nodes"));
    }
    sections(case, ring)?;
    for (index, support) in ring.supports.iter().enumerate() {
        ring_support(&format!("ring.supports[{index}]"), support)?;
    }
    tie(case, ring)
}

fn sections(case: &Case, ring: &Ring) -> Result<(), BrokenRule> {
    not_empty("ring.sections", ring.sections.len(), "at least one section")?;
    for (index, section) in ring.sections.iter().enumerate() {
        let at = |key: &str| format!("ring.sections[{index}].{key}");
        known_material(case, at("material"), &section.material)?;
        above_zero(at("area"), section.area)?;
        above_zero(at("inertia"), section.inertia)?;
        above_zero(at("radius"), section.radius)?;
        share(at("shear_coefficient"), section.shear_coefficient)?;
        if let Some(outer) = ring.outer_radius {
            above(
                "ring.outer_radius",
                outer,
                "the section's radius",
                section.radius,
            )?;
        }
    }
    if ring.bond == Bond::Composite && ring.radius_rule == RadiusRule::CommonCentroid {
        let other = "`ring.bond = \"slip\"`";
        return Err(Rule::Needs { other }.at("ring.radius_rule"));
    }
    Ok(())
}

fn ring_support(key: &str, support: &RingSupport) -> Result<(), BrokenRule> {
    let to = format!("{key}.to_deg");
    above(&to, support.to_deg, "`from_deg`", support.from_deg)?;
    let sector = support.to_deg - support.from_deg;
    if sector > 360.0 {
        return Err(Rule::Beyond {
            found: support.to_deg,
            how: "at most",
            what: "a full turn after `from_deg`",
            other: support.from_deg + 360.0,
        }
        .at(to));
    }
    springs(&format!("{key}.spring"), support.spring, true)
}

fn tie(case: &Case, ring: &Ring) -> Result<(), BrokenRule> {
    let tie = match (&ring.tie, &case.housing) {
        (None, None) => return Ok(()),
        (None, Some(_)) => return Err(Rule::Unconnected.at("ring")),
        (Some(_), None) => {
            let other = "[housing]";
            return Err(Rule::Needs { other }.at("ring.tie"));
        }
        (Some(tie), Some(_)) => tie,
    };
    direction("ring.tie.axis", tie.axis)?;
    direction("ring.tie.zero_deg", tie.zero_deg)?;
    let across = cross(tie.axis, tie.zero_deg);
    // Directions nearer than about a millionth of a turn count as one.
    if dot(across, across) <= 1e-12 * dot(tie.axis, tie.axis) * dot(tie.zero_deg, tie.zero_deg) {
        return Err(Rule::AlongAxis.at("ring.tie.zero_deg"));
    }
    if tie.fit == Fit::Sliding && ring.supports.is_empty() {
        return Err(Rule::FreeToTurn.at("ring.tie.fit"));
    }
    Ok(())
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
