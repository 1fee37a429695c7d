//! `[housing]`: mesh, parts, supports and added masses.
//!
//! `[housing]`: a mesh with its parts, or a superelement that was condensed elsewhere.

use super::Case;
use super::schema::{one_of, together, words};
use super::spring::{Spring, SpringKeys};
use super::union::{exactly_one, given, mismatch, missing, none_beside, read_as, written_as};
use crate::fe::element::continuum::{Formulation, Integration, LinearFormulation};
use crate::fe::model::{Link, OverlapRule, PlaneModel, PointMass, SpringStiffness, SupportShare};
use crate::numerics::units::LengthUnit;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::value::SeqAccessDeserializer;
use serde::de::{self, Deserializer, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Serialize};
use serde_json::json;
use std::fmt;
use std::path::{Path, PathBuf};

/// The housing around the ring. Frame: the mesh's own, which the ring's tie relates to the bearing.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Housing {
    /// Mesh file. Relative paths in a case file are relative to that file; here they are resolved.
    pub mesh: PathBuf,
    /// Unit of the mesh's coordinates.
    pub length_unit: LengthUnit,
    /// How a plane mesh stands for a solid; `None` for a mesh of solids.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plane: Option<PlaneModel>,
    /// Stiffness of ten-noded tetrahedra (`integration`), four-noded quadrilaterals and eight-noded hexahedra (`linear`).
    #[serde(flatten)]
    pub formulation: Formulation,
    /// Which group is made of what; at least one.
    pub parts: Vec<Part>,
    /// What holds the housing; may be empty.
    pub supports: Vec<Support>,
    /// Masses without size, each spread over a group; may be empty.
    pub masses: Vec<PointMass>,
    /// Connections between its groups; may be empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub links: Vec<Link>,
    /// Whether bodies may lie in one another.
    #[serde(skip_serializing_if = "is_refused")]
    pub overlap: OverlapRule,
    /// Whether folded elements of second order are mended.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub straighten: bool,
}

fn is_refused(rule: &OverlapRule) -> bool {
    *rule == OverlapRule::Refuse
}

/// A group of elements and its material.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// A group of the mesh: a physical group, a set, or CAD entities as "surface 7".
    pub group: String,
    /// Name of a material.
    pub material: String,
}

/// A direction of the mesh's frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// First coordinate.
    X,
    /// Second coordinate.
    Y,
    /// Third coordinate; solid meshes only.
    Z,
}

/// What holds a group of nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// A group of the mesh: a physical group, a set, or CAD entities as "surface 7".
    pub group: String,
    /// How it is held.
    pub hold: Hold,
}

/// How a group is held.
#[derive(Debug, Clone, PartialEq)]
pub enum Hold {
    /// All displacements are zero.
    All,
    /// These displacements are zero.
    Fixed(Vec<Axis>),
    /// By springs to the ground. Radial ones alone leave a round housing free to turn and to slide along the axis.
    Spring(SpringStiffness, SupportShare),
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["fixed", "spring", "radial"]), "not" = together(&["fixed", "per"])))]
/// What holds a group of nodes: `fixed`, `spring` or `radial`.
struct SupportForm {
    /// A group of the mesh: a physical group, a set, or CAD entities as "surface 7".
    group: String,
    /// These displacements are zero: "all", or a list of "x", "y" and "z".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    fixed: Option<Fixed>,
    /// Stiffnesses of springs to the ground along the axes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    spring: Option<Spring>,
    /// Stiffness in N/m of springs to the ground along the radius from the bearing's axis, > 0.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    radial: Option<f64>,
    /// What the stiffness belongs to; not beside `fixed`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    per: Option<SupportShare>,
}

// The displacements that `fixed` makes zero; what a key says of it is in the schema, not this.
#[derive(Serialize, JsonSchema)]
#[serde(untagged)]
#[schemars(inline)]
enum Fixed {
    All(#[schemars(schema_with = "all")] &'static str),
    Axes(Vec<Axis>),
}

const ALL: &str = "all";

fn all(_: &mut SchemaGenerator) -> Schema {
    words(&[ALL])
}

impl<'de> Deserialize<'de> for Fixed {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(FixedVisitor)
    }
}

struct FixedVisitor;

impl<'de> Visitor<'de> for FixedVisitor {
    type Value = Fixed;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("\"all\", or a list such as [\"x\", \"y\", \"z\"]")
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<Self::Value, E> {
        match word {
            ALL => Ok(Fixed::All(ALL)),
            _ => Err(E::invalid_value(Unexpected::Str(word), &self)),
        }
    }

    fn visit_seq<A: SeqAccess<'de>>(self, axes: A) -> Result<Self::Value, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(axes)).map(Fixed::Axes)
    }
}

written_as!(Support, SupportForm, |form| {
    const ONE: &str = "exactly one of `fixed`, `spring`, `radial`";
    let per = form.per.unwrap_or_default();
    let holds = [
        form.fixed.map(|fixed| match fixed {
            Fixed::All(_) => Hold::All,
            Fixed::Axes(axes) => Hold::Fixed(axes),
        }),
        form.spring.map(|spring| Hold::Spring(spring.into(), per)),
        form.radial.map(|radial| Hold::Spring(SpringStiffness::Radial(radial), per)),
    ];
    match exactly_one(holds, ONE)? {
        Hold::All | Hold::Fixed(_) if form.per.is_some() => {
            Err(mismatch("`per` beside `fixed`", "`per` beside `spring` or `radial` only"))
        }
        hold => Ok(Self { group: form.group, hold }),
    }
});

impl From<Support> for SupportForm {
    fn from(support: Support) -> Self {
        let (fixed, keys) = match support.hold {
            Hold::All => (Some(Fixed::All(ALL)), SpringKeys::default()),
            Hold::Fixed(axes) => (Some(Fixed::Axes(axes)), SpringKeys::default()),
            Hold::Spring(stiffness, share) => (None, SpringKeys::of(stiffness, share)),
        };
        Self { group: support.group, fixed, spring: keys.spring, radial: keys.radial, per: keys.per }
    }
}

/// Where the housing comes from.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum HousingSource {
    /// A file of condensed matrices on the ring's degrees of freedom, SI units: a NumPy archive (`.npz`) or Nastran's
    /// OUTPUT4 (`.op4`). Relative paths in a case file are relative to that file; here they are resolved.
    Superelement(PathBuf),
    /// A mesh with materials and supports.
    #[serde(untagged)]
    Mesh(Box<Housing>),
}

impl HousingSource {
    /// The file that it is read from.
    #[must_use]
    pub(crate) fn path(&self) -> &Path {
        match self {
            Self::Mesh(housing) => &housing.mesh,
            Self::Superelement(path) => path,
        }
    }

    pub(super) fn path_mut(&mut self) -> &mut PathBuf {
        match self {
            Self::Mesh(housing) => &mut housing.mesh,
            Self::Superelement(path) => path,
        }
    }
}

impl Case {
    /// Returns the housing, if the case has one with a mesh.
    #[must_use]
    pub fn meshed_housing(&self) -> Option<&Housing> {
        match &self.housing {
            Some(HousingSource::Mesh(housing)) => Some(housing),
            _ => None,
        }
    }

    /// Returns the file of the superelement that stands for the housing, if there is one.
    #[must_use]
    pub(crate) fn superelement(&self) -> Option<&Path> {
        match &self.housing {
            Some(HousingSource::Superelement(path)) => Some(path),
            _ => None,
        }
    }
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = json!([
    { "required": ["superelement"], "maxProperties": 1 },
    { "required": ["mesh", "length_unit", "parts"], "not": { "required": ["superelement"] } },
])))]
/// The housing: `mesh` with its keys, or `superelement` alone.
struct SourceForm {
    /// File of condensed matrices on the ring's degrees of freedom, SI units: a NumPy archive (`.npz`) or Nastran's OUTPUT4
    /// (`.op4`), relative to the case file; without any other key.
    superelement: Option<PathBuf>,
    /// Mesh file (gmsh MSH 2 or 4, .inp of Abaqus or CalculiX), relative to the case file.
    mesh: Option<PathBuf>,
    /// Unit of the mesh's coordinates.
    length_unit: Option<LengthUnit>,
    /// How a plane mesh stands for a solid; plane meshes only.
    plane: Option<PlaneModel>,
    /// Integration of the stiffness of ten-noded tetrahedra.
    integration: Option<Integration>,
    /// Formulation of four-noded quadrilaterals and eight-noded hexahedra.
    linear: Option<LinearFormulation>,
    /// Which group is made of what; at least one.
    parts: Option<Vec<Part>>,
    /// What holds the housing; may be empty.
    supports: Option<Vec<Support>>,
    /// Masses without size, each spread over a group; may be empty.
    masses: Option<Vec<PointMass>>,
    /// Connections between its groups; may be empty.
    links: Option<Vec<Link>>,
    /// Whether bodies may lie in one another; refused unless "allow".
    overlap: Option<OverlapRule>,
    /// Whether folded elements of second order are mended; they are refused unless true.
    straighten: Option<bool>,
}

read_as!(HousingSource, SourceForm, |form| {
    if let Some(path) = form.superelement {
        let of_mesh = given!(form: mesh, length_unit, plane, integration, linear, parts, supports, masses, links, overlap, straighten);
        none_beside(&of_mesh, "`superelement`", "`superelement` alone, or `mesh` with its keys")?;
        return Ok(Self::Superelement(path));
    }
    Ok(Self::Mesh(Box::new(Housing {
        mesh: form.mesh.ok_or_else(|| missing("mesh"))?,
        length_unit: form.length_unit.ok_or_else(|| missing("length_unit"))?,
        plane: form.plane,
        formulation: Formulation {
            integration: form.integration.unwrap_or_default(),
            linear: form.linear.unwrap_or_default(),
        },
        parts: form.parts.ok_or_else(|| missing("parts"))?,
        supports: form.supports.unwrap_or_default(),
        masses: form.masses.unwrap_or_default(),
        links: form.links.unwrap_or_default(),
        overlap: form.overlap.unwrap_or_default(),
        straighten: form.straighten.unwrap_or_default(),
    })))
});

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::app::case::{Case, CaseError, Hold, HousingSource, Source};

    const CASE: &str = "[housing]\nsuperelement = \"s.npz\"\n\n[ring]\n\
        sections = [{ material = \"steel\", area = 5e-6, inertia = 9e-13, radius = 5.3e-3 }]\n";

    fn read(set: &[&str]) -> Result<Case, CaseError> {
        Case::from_source(Source {
            path: "folder/case.toml".into(),
            text: CASE.to_owned(),
            set: set.iter().map(|&set| set.to_owned()).collect(),
        })
    }

    #[test]
    fn a_superelement_stands_alone_and_is_beside_the_case() {
        let case = read(&["sensors=[{name='a',recovered='P1'}]"]).unwrap();
        assert_eq!(case.superelement(), Some(Path::new("folder/s.npz")));
        assert!(case.meshed_housing().is_none());
        // the echo has the form of the file
        let echo = serde_json::to_value(&case).unwrap();
        assert_eq!(
            (&echo["housing"], &echo["sensors"]),
            (
                &serde_json::json!({ "superelement": "folder/s.npz" }),
                &serde_json::json!([{ "name": "a", "recovered": "P1" }])
            )
        );
        let again: Case = serde_json::from_value(echo).unwrap();
        assert!(matches!(again.housing, Some(HousingSource::Superelement(_))));
        assert_eq!(again.sensors, case.sensors);
    }

    #[test]
    fn what_contradicts_it_is_named() {
        for (set, message) in [
            (
                "housing.mesh=a.msh",
                "folder/case.toml:1: `housing`: found `mesh` beside `superelement`, expected `superelement` alone, or \
                 `mesh` with its keys",
            ),
            (
                "housing.supports=[]",
                "folder/case.toml:1: `housing`: found `supports` beside `superelement`, expected `superelement` alone, or \
                 `mesh` with its keys",
            ),
            (
                "ring.tie={group='bore'}",
                "--set ring.tie={group='bore'}: `ring.tie`: found beside `housing.superelement`, expected one of the two",
            ),
            (
                "condense.interface={nodes=[1]}",
                "--set condense.interface={nodes=[1]}: `condense.interface`: found beside `housing.superelement`, expected \
                 one of the two",
            ),
            (
                "condense.interface_modes=9",
                "--set condense.interface_modes=9: `condense.interface_modes`: found beside `housing.superelement`, expected \
                 one of the two",
            ),
            (
                "sensors=[{name='a',point=[0,0,0],direction=[1,0,0]}]",
                "--set sensors=[{name='a',point=[0,0,0],direction=[1,0,0]}]: `sensors[0].point`: needs `housing.mesh` \
                 (a superelement has rows of its own sensors: `recovered = \"NAME\"`), which the case lacks",
            ),
            (
                "sensors=[{name='a',recovered='P1',direction=[1,0,0]}]",
                "--set sensors=[{name='a',recovered='P1',direction=[1,0,0]}]: `sensors[0]`: found `direction` beside \
                 `recovered`, expected `recovered` alone: its row has a direction",
            ),
            (
                "sensors=[{name='a',ring_deg=0}]",
                "--set sensors=[{name='a',ring_deg=0}]: `sensors[0]` lacks the required key `direction`",
            ),
            (
                "modes.convergence={meshes=['b.msh']}",
                "--set modes.convergence={meshes=['b.msh']}: `modes.convergence`: needs `housing.mesh`, which the case \
                 lacks",
            ),
        ] {
            assert_eq!(read(&[set]).unwrap_err().to_string(), message);
        }
        let bare = Case::from_source(Source {
            path: "a.toml".into(),
            text: "[housing]\nsuperelement = \"s.npz\"\n".to_owned(),
            set: Vec::new(),
        });
        assert_eq!(
            bare.unwrap_err().to_string(),
            "a.toml:2: `housing.superelement`: needs [ring], which the case lacks"
        );
        let recovered = "[[sensors]]\nname = \"a\"\nrecovered = \"P1\"\n";
        let ring = Case::from_source(Source {
            path: "a.toml".into(),
            text: CASE[CASE.find("[ring]").unwrap()..].to_owned() + recovered,
            set: Vec::new(),
        });
        assert_eq!(
            ring.unwrap_err().to_string(),
            "a.toml:5: `sensors[0].recovered`: needs `housing.superelement`, which the case lacks"
        );
    }

    #[test]
    fn all_motions_are_held_by_one_word() {
        let held = |fixed: &str| {
            let text = format!(
                "[housing]\nmesh = \"a.msh\"\nlength_unit = \"mm\"\nparts = [{{ group = \"a\", material = \"steel\" }}]\n\
                 supports = [{{ group = \"feet\", fixed = {fixed} }}]\n"
            );
            Case::from_source(Source { path: "case.toml".into(), text, set: Vec::new() })
        };
        let case = held("\"all\"").unwrap();
        assert_eq!(case.meshed_housing().unwrap().supports[0].hold, Hold::All);
        let echo = serde_json::to_value(&case).unwrap();
        assert_eq!(echo["housing"]["supports"][0]["fixed"], "all");
        let plane = case.source.text.replace("parts", "plane = { assumption = \"stress\", thickness = 1e-3 }\nparts");
        assert!(Case::from_source(Source { text: plane, ..case.source }).is_ok());
        for (fixed, found) in [("\"bottom\"", "\"bottom\""), ("true", "true"), ("3", "3")] {
            let message = held(fixed).unwrap_err().to_string();
            let rule = format!("found {found}, expected \"all\", or a list such as [\"x\", \"y\", \"z\"]");
            assert!(message.ends_with(&rule), "{message}");
        }
        assert!(held("[\"x\", \"w\"]").unwrap_err().to_string().contains("`housing.supports[0].fixed[1]` is \"w\""));
    }
}
