//! `[condense]`: what a condensed housing is attached by, and how many vectors a reduction keeps.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::schema::{one_of, or_table, whole, words};
use super::union::{Loose, exactly_one, none_beside, read_as};
use crate::fe::model::CentreTie;

/// How the housing is condensed onto the ring.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct Condense {
    /// What the condensed housing is attached by.
    pub interface: Interface,
    /// How many vectors of the interior are kept, residual vectors among them.
    pub fixed_interface_modes: FixedInterfaceModes,
    /// Whether residual vectors stand beside the fixed-interface modes; false: plain Craig-Bampton.
    pub enhanced: bool,
    /// Whether modes of the interface replace its coordinates; for `plummer condense` alone.
    pub interface_modes: InterfaceModes,
}

impl Default for Condense {
    fn default() -> Self {
        Self {
            interface: Interface::default(),
            fixed_interface_modes: FixedInterfaceModes::default(),
            enhanced: true,
            interface_modes: InterfaceModes::default(),
        }
    }
}

/// What a condensed housing is attached by.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Interface {
    /// The ring's degrees of freedom.
    #[default]
    Ring,
    /// The nodes of a group of the mesh, each with its displacements.
    Group(String),
    /// Nodes of the mesh by gmsh's tags, each with its displacements.
    Nodes(Vec<u64>),
    /// Bores as one node each, with displacements and rotations.
    #[serde(untagged)]
    Centres {
        /// The nodes.
        centres: Vec<Centre>,
        /// Whether the rings of the case come before them.
        #[serde(skip_serializing_if = "std::ops::Not::not")]
        rings: bool,
    },
}

impl Interface {
    /// The centre nodes.
    pub fn centres(&self) -> &[Centre] {
        match self {
            Self::Centres { centres, .. } => centres,
            Self::Ring | Self::Group(_) | Self::Nodes(_) => &[],
        }
    }
}

/// The centre node of a bore.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Centre {
    /// The group of the bore's nodes.
    pub group: String,
    /// Place of the node in the mesh's frame, in m.
    pub point: [f64; 3],
    /// How node and bore move with each other.
    pub tie: CentreTie,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = one_of(&["group", "nodes", "centres"])))]
struct InterfaceForm {
    /// The nodes of this group of the mesh, each with its displacements.
    group: Option<String>,
    /// Nodes of the mesh by gmsh's tags, each with its displacements.
    nodes: Option<Vec<u64>>,
    /// Bores as one node each, with displacements and rotations: for rotor and multibody programs.
    centres: Option<Vec<Centre>>,
    /// Whether the rings of the case are part of the interface, before the centre nodes.
    rings: Option<bool>,
}

read_as!(Interface, Loose<InterfaceForm>, or_table::<InterfaceForm>(vec![words(&["ring"])]), |form| {
    const FORMS: &str = "\"ring\", { group = \"NAME\" }, { nodes = [TAGS] } or { centres = [...] }";
    const ONE: &str = "one of `group`, `nodes`, `centres`";
    match form {
        Loose::Word(word) if word == "ring" => Ok(Self::Ring),
        Loose::Table(InterfaceForm { group, nodes, centres, rings }) => {
            let other = [("rings", rings.is_some() && centres.is_none())];
            none_beside(&other, "`group` or `nodes`", "`rings` beside `centres` alone")?;
            let centres = centres.map(|centres| Self::Centres { centres, rings: rings.unwrap_or(false) });
            exactly_one([group.map(Self::Group), nodes.map(Self::Nodes), centres], ONE)
        }
        other => Err(other.mismatch(&["ring"], FORMS)),
    }
});

/// How many characteristic constraint modes replace the coordinates of an interface.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum InterfaceModes {
    /// None: the interface keeps its coordinates.
    #[default]
    None,
    /// All up to this frequency in Hz, > 0.
    UpToHz(f64),
    /// So many, > 0.
    #[serde(untagged)]
    Count(usize),
}

read_as!(InterfaceModes, Loose<UpToForm>, or_table::<UpToForm>(vec![words(&["none"]), whole()]), |form| match form {
    Loose::Word(word) if word == "none" => Ok(Self::None),
    Loose::Whole(count) => Ok(Self::Count(count)),
    Loose::Table(UpToForm { up_to_hz }) => Ok(Self::UpToHz(up_to_hz)),
    other => Err(other.mismatch(&["none"], "\"none\", a whole number or { up_to_hz = NUMBER }")),
});

/// How many fixed-interface modes are kept.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FixedInterfaceModes {
    /// As many as the accuracy asked for needs.
    #[default]
    Auto,
    /// All below this frequency in Hz, > 0.
    UpToHz(f64),
    /// So many, from 0.
    #[serde(untagged)]
    Count(usize),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct UpToForm {
    /// All up to this frequency in Hz, > 0.
    up_to_hz: f64,
}

read_as!(
    FixedInterfaceModes,
    Loose<UpToForm>,
    or_table::<UpToForm>(vec![words(&["auto"]), whole()]),
    |form| match form {
        Loose::Word(word) if word == "auto" => Ok(Self::Auto),
        Loose::Whole(count) => Ok(Self::Count(count)),
        Loose::Table(UpToForm { up_to_hz }) => Ok(Self::UpToHz(up_to_hz)),
        other => Err(other.mismatch(&["auto"], "\"auto\", a whole number or { up_to_hz = NUMBER }")),
    }
);
