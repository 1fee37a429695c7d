//! Element types of Abaqus and CalculiX, and their order of nodes and faces.
//!
//! Source: CalculiX CrunchiX user's manual 2.20, "Element types" and "*SURFACE"; Abaqus names the same ones alike.

use crate::fe::mesh::ElementKind;

/// What an element type is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Purpose {
    /// A solid, or a plane element of a plane mesh; in a mesh of solids that is a face.
    Body,
    /// A shell or membrane: a face of a mesh of solids, and no body.
    Shell,
    /// Of a body of revolution.
    Axisymmetric,
    /// A beam or truss: a curve.
    Curve,
}

/// What a type is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Type {
    Known(ElementKind, Purpose),
    /// A body of a shape that is not read.
    Refused,
    /// Springs, masses, rigid bodies and others that make no body.
    LeftOut,
}

/// Beginning of the name, what it is for, and the kind by the number that follows.
type Family = (&'static str, Purpose, &'static [(&'static str, ElementKind)]);

const SOLIDS: &[(&str, ElementKind)] = &[
    ("4", ElementKind::Tet4),
    ("6", ElementKind::Wedge6),
    ("8", ElementKind::Hex8),
    ("10", ElementKind::Tet10),
    ("15", ElementKind::Wedge15),
    ("20", ElementKind::Hex20),
];
const FLAT: &[(&str, ElementKind)] =
    &[("3", ElementKind::Tri3), ("4", ElementKind::Quad4), ("6", ElementKind::Tri6), ("8", ElementKind::Quad8)];
const LINES: &[(&str, ElementKind)] = &[("2", ElementKind::Line2), ("3", ElementKind::Line3)];
const BEAMS: &[(&str, ElementKind)] = &[("1", ElementKind::Line2), ("2", ElementKind::Line3)];

const FAMILIES: [Family; 14] = [
    ("C3D", Purpose::Body, SOLIDS),
    ("CPEG", Purpose::Body, FLAT),
    ("CPE", Purpose::Body, FLAT),
    ("CPS", Purpose::Body, FLAT),
    ("CAX", Purpose::Axisymmetric, FLAT),
    ("SFM3D", Purpose::Shell, FLAT),
    ("M3D", Purpose::Shell, FLAT),
    ("STRI3", Purpose::Shell, &[("", ElementKind::Tri3)]),
    ("STRI6", Purpose::Shell, &[("5", ElementKind::Tri6)]),
    ("S", Purpose::Shell, FLAT),
    ("T3D", Purpose::Curve, LINES),
    ("T2D", Purpose::Curve, LINES),
    ("B3", Purpose::Curve, BEAMS),
    ("B2", Purpose::Curve, BEAMS),
];

/// What a type is, by its name in capitals.
pub(super) fn of_name(name: &str) -> Type {
    for (start, purpose, kinds) in FAMILIES {
        let Some(rest) = name.strip_prefix(start) else {
            continue;
        };
        let digits = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
        let (number, suffix) = rest.split_at(digits);
        let kind = kinds.iter().find(|(known, _)| *known == number).map(|(_, kind)| *kind);
        // C3D15V and C3D27 have nodes on faces; S4R5 is a shell like S4
        match kind {
            Some(kind) if !suffix.contains('V') => return Type::Known(kind, purpose),
            _ if purpose == Purpose::Body && !number.is_empty() => return Type::Refused,
            _ => {}
        }
    }
    Type::LeftOut
}

/// The edges by their corners, in the order of their middle nodes.
fn edges(kind: ElementKind) -> &'static [[usize; 2]] {
    match kind {
        ElementKind::Tet10 => &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]],
        ElementKind::Hex20 => {
            &[[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]]
        }
        ElementKind::Wedge15 => &[[0, 1], [1, 2], [2, 0], [3, 4], [4, 5], [5, 3], [0, 3], [1, 4], [2, 5]],
        _ => kind.middle_edges(),
    }
}

/// For each node of an element in gmsh's order its place in the order of Abaqus and CalculiX.
pub(crate) fn inp_nodes(kind: ElementKind) -> Vec<usize> {
    let place = |ends: &[usize; 2]| edges(kind).iter().position(|own| own == ends || [own[1], own[0]] == *ends);
    let middles = kind.middle_edges().iter().filter_map(place).map(|edge| kind.corners() + edge);
    (0..kind.corners()).chain(middles).collect()
}

/// Index into the kind's faces of the face S1, S2, ...; `None` if it has none of this number.
pub(super) fn face(kind: ElementKind, number: usize) -> Option<usize> {
    face_order(kind).get(number.checked_sub(1)?).copied()
}

/// The number n of the face Sn, from 1, that a kind has at an index of its faces.
pub(crate) fn inp_face(kind: ElementKind, index: usize) -> Option<usize> {
    face_order(kind).iter().position(|own| *own == index).map(|place| place + 1)
}

/// Indices into a kind's faces in the order S1, S2, ...
fn face_order(kind: ElementKind) -> &'static [usize] {
    match (kind.dimension(), kind.corners()) {
        (3, 4) => &[0, 1, 3, 2],
        (3, 6) => &[0, 1, 2, 4, 3],
        (3, _) => &[0, 5, 1, 3, 4, 2],
        (2, 3) => &[0, 1, 2],
        (2, _) => &[0, 1, 2, 3],
        _ => &[],
    }
}
