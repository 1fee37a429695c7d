//! What can be wrong inside an MSH file.

use std::fmt;

use thiserror::Error;

use crate::fe::mesh::kind::unsupported;
use crate::fe::mesh::{ElementKind, Entity};

/// Where in a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// Line, from 1 (ASCII files).
    Line(usize),
    /// Offset in bytes, from 0 (binary files).
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(offset) => write!(f, "byte {offset}"),
        }
    }
}

/// Content of an MSH file that cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MshError {
    /// Not an MSH file at all.
    #[error("not a gmsh mesh: expected $MeshFormat at the start, found {found}")]
    NotMsh {
        /// The first line, or what there is of it.
        found: String,
    },
    /// An MSH version that is not read.
    #[error("MSH version {found}: expected 4.1 or 2.2; convert it with: gmsh IN.msh -save -format msh41 -o OUT.msh")]
    Version {
        /// The version found.
        found: String,
    },
    /// The file ends before the section does.
    #[error("the file ends inside ${section}: expected {expected}; is it complete?")]
    Truncated {
        /// The section, without the dollar sign.
        section: String,
        /// What should have come.
        expected: String,
    },
    /// Something else than what the format asks for.
    #[error("${section}, {place}: expected {expected}, found {found}")]
    Malformed {
        /// The section, without the dollar sign.
        section: String,
        /// Where.
        place: Place,
        /// What the format asks for.
        expected: String,
        /// What is there.
        found: String,
    },
    /// More items announced than the rest of the file can hold.
    #[error(
        "${section}, {place}: {declared} announced as {what}, but only {remaining} bytes follow; \
         is the file complete?"
    )]
    Count {
        /// The section, without the dollar sign.
        section: String,
        /// Where.
        place: Place,
        /// What is counted.
        what: String,
        /// The number found.
        declared: u64,
        /// Bytes left in the file.
        remaining: usize,
    },
    /// A section that every mesh has is missing.
    #[error("the file has no ${section} section: expected one{hint}")]
    MissingSection {
        /// The section, without the dollar sign.
        section: &'static str,
        /// What to do, beginning with a blank or empty.
        hint: &'static str,
    },
    /// A section that may occur once occurs twice.
    #[error("{place}: a second ${section} section, expected one")]
    RepeatedSection {
        /// The section, without the dollar sign.
        section: String,
        /// Where.
        place: Place,
    },
    /// A feature of gmsh that is not read.
    #[error("${section}, {place}: {feature} cannot be read; {advice}")]
    Feature {
        /// The section, without the dollar sign.
        section: String,
        /// Where.
        place: Place,
        /// What it is.
        feature: &'static str,
        /// What to do.
        advice: &'static str,
    },
    /// A mesh without elements.
    #[error("the mesh has no elements: expected at least one (is a Physical group defined, is the geometry meshed?)")]
    NoElements,
    /// A coordinate that is infinite or not a number.
    #[error("$Nodes, {place}: node {tag} has the coordinate {found}: expected a finite number")]
    NotFinite {
        /// Where.
        place: Place,
        /// Tag of the node.
        tag: u64,
        /// The coordinate.
        found: f64,
    },
    /// Two nodes of the same tag.
    #[error("$Nodes, {place}: node tag {tag} occurs a second time: expected every tag once")]
    DuplicateNode {
        /// Where the second one is.
        place: Place,
        /// The tag.
        tag: u64,
    },
    /// Two elements of the same tag.
    #[error("$Elements, {place}: element tag {tag} occurs a second time: expected every tag once")]
    DuplicateElement {
        /// Where the second one is.
        place: Place,
        /// The tag.
        tag: u64,
    },
    /// An element on a node that is not there.
    #[error("$Elements, {place}: element {element} refers to node {node}: expected a tag listed in $Nodes")]
    DanglingNode {
        /// Where.
        place: Place,
        /// Tag of the element.
        element: u64,
        /// Tag of the node.
        node: u64,
    },
    /// An element with the same node twice.
    #[error("$Elements, {place}: element {element} has the node {node} twice: expected different nodes")]
    RepeatedNode {
        /// Where.
        place: Place,
        /// Tag of the element.
        element: u64,
        /// Tag of the node.
        node: u64,
    },
    /// An element type that the program has no element for.
    #[error(
        "$Elements, {place}: element type {gmsh_type} ({}){}: expected one of {}; {}",
        unsupported(*gmsh_type).name, on_entity(*entity), known_kinds(), unsupported(*gmsh_type).advice
    )]
    UnsupportedElement {
        /// Where.
        place: Place,
        /// gmsh's number of the type.
        gmsh_type: i32,
        /// The entity that it lies on, where the file gives it before the type (MSH 4.1).
        entity: Option<Entity>,
    },
    /// Groups that would take many times the memory of the file: every entity in every one of many.
    #[error(
        "the physical groups would take {needed} bytes of memory or more, too many for a file of \
         {file_bytes} bytes: expected each entity in a few groups"
    )]
    TooManyMembers {
        /// Bytes that the groups counted so far would take.
        needed: u64,
        /// Length of the file.
        file_bytes: usize,
    },
    /// A disagreement with the reader library on a `$Entities` section that passed our own walk.
    #[error("{what}: expected what the MSH 4.1 format prescribes")]
    Reader {
        /// What the library said.
        what: String,
    },
}

fn on_entity(entity: Option<Entity>) -> String {
    entity.map_or(String::new(), |Entity { dimension, tag }| format!(" on entity {tag} of dimension {dimension}"))
}

fn known_kinds() -> String {
    let names: Vec<&str> = ElementKind::all().map(ElementKind::name).collect();
    names.join(", ")
}
