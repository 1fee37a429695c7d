//! Bodies, the pieces that they are joined to, and the motions of these.

use super::super::ModalError;
use super::super::energy_shares::Membership;
use super::super::motions::{rigid_component, rigid_count};
use super::bodies::{BodyMap, Extent, apart};
use super::rows::{AllConstraints, Between, Constraints, rank, ring_spring_rows};
use crate::fe::mesh::{Mesh, Sets};
use crate::fe::model::{HousingModel, RingSeat, RingTie, Rings};
use crate::numerics::linalg::SparseMatrix;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeSet;

/// Most bodies that are looked at: the dense problem has 6 unknowns each.
const MOST_BODIES: usize = 200;

/// What is in the bores, or at another interface.
pub(crate) enum Bore<'m> {
    Empty,
    Rings(&'m RingTie, &'m Rings),
    /// Displacements are held there, in the axes that the matrix turns to the mesh's.
    Held(&'m [usize], Option<&'m SparseMatrix>),
}

/// Elements that hang together through whole faces (edges in the plane).
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Body {
    /// Whether it is a ring, which has neither parts nor groups.
    pub is_ring: bool,
    /// What a sentence calls it if it is a ring.
    #[serde(skip)]
    pub(super) ring_name: String,
    /// Parts that it has elements of.
    pub parts: Vec<String>,
    /// Physical groups of volumes (plane: surfaces) that it has elements of.
    pub groups: Vec<String>,
    /// Number of elements.
    pub elements: usize,
    /// Mean of the middles of its elements, m.
    pub centroid: [f64; 3],
    /// Which piece it belongs to.
    pub piece: usize,
}

/// Bodies that are joined somehow, directly or through others.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Piece {
    /// Its bodies, largest first, rings last.
    pub bodies: Vec<usize>,
    /// Number of elements.
    pub elements: usize,
    /// Motions without energy as one rigid body: 6 (plane: 3) if nothing holds it, 0 if it is held.
    pub rigid: usize,
    /// Further motions without energy, of its bodies against each other.
    pub internal: usize,
}

/// What joins some bodies directly, and lets them move against each other.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Joint {
    /// The bodies; two, unless a tied node or a spring acts on more at once.
    pub bodies: Vec<usize>,
    /// Mesh tags of the nodes that they share.
    pub nodes: Vec<u64>,
    /// Links by springs between them, `first - second`.
    pub links: Vec<String>,
    /// Whether a tie joins them.
    pub tied: bool,
    /// Motions that this joint alone leaves them against each other, > 0. Other joints may prevent them.
    pub motions: usize,
}

/// Motions without energy of a housing, by their reason.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct Mechanisms {
    /// 2 or 3.
    pub dimension: usize,
    /// The bodies, in the order of the mesh.
    pub bodies: Vec<Body>,
    /// The pieces; first those of rings, then the largest.
    pub pieces: Vec<Piece>,
    /// Joints that let bodies of a piece with internal motions move.
    pub joints: Vec<Joint>,
    /// Rigid motions of the whole: 6 (plane: 3) if nothing holds any piece, otherwise 0.
    pub of_whole: usize,
    /// Rigid motions of pieces that are connected neither to the ground nor to the rest.
    pub of_loose_pieces: usize,
    /// Motions of bodies against each other, and of pieces that are held and can still move.
    pub mechanisms: usize,
}

impl Mechanisms {
    /// Finds them in O(elements log elements), and a dense problem on the bodies.
    ///
    /// # Errors
    /// [`ModalError::TooManyBodies`] for more than 200 bodies, [`ModalError::Shape`] for another mesh than the model's.
    pub fn find(mesh: &Mesh, model: &HousingModel) -> Result<Self, ModalError> {
        Self::of_bodies(mesh, model, &Bore::Empty)
    }

    /// The same with something in the bores. A ring is one more body, joined by the tie; where displacements are held besides the
    /// supports, what can still move makes the stiffness of the others singular. `None` for too many bodies: that is worth no
    /// error where only reasons were asked for.
    ///
    /// # Errors
    /// [`ModalError::Shape`] for another mesh than the model's.
    pub(crate) fn find_in(mesh: &Mesh, model: &HousingModel, bore: &Bore<'_>) -> Result<Option<Self>, ModalError> {
        match Self::of_bodies(mesh, model, bore) {
            Err(ModalError::TooManyBodies { .. }) => Ok(None),
            found => found.map(Some),
        }
    }

    /// The motions of rings alone that their springs leave.
    pub(crate) fn of_rings(rings: &Rings) -> Self {
        let dimension = if rings.are_in_space() { 3 } else { 2 };
        let full = rigid_count(dimension);
        let piece = |(number, seat): (usize, &RingSeat)| {
            let rows: Vec<Vec<f64>> = ring_spring_rows(seat).into_iter().map(|row| row[..full].to_vec()).collect();
            Piece { bodies: vec![number], elements: seat.ring.nodes(), rigid: full - rank(&rows), internal: 0 }
        };
        let pieces: Vec<Piece> = rings.seats().iter().enumerate().map(piece).collect();
        let bodies = rings.seats().iter().enumerate().map(|(piece, seat)| Body { piece, ..ring_body(seat) });
        Self::counted(dimension, bodies.collect(), pieces, Vec::new())
    }

    fn of_bodies(mesh: &Mesh, model: &HousingModel, bore: &Bore<'_>) -> Result<Self, ModalError> {
        let mut map = BodyMap::new(model);
        let rings = if let Bore::Rings(_, rings) = bore { rings.seats() } else { &[] };
        rings.iter().for_each(|seat| map.add_ring(seat));
        if map.extents.len() > MOST_BODIES {
            return Err(ModalError::TooManyBodies { found: map.extents.len(), limit: MOST_BODIES });
        }
        let mut constraints = AllConstraints::new(model, &map);
        match *bore {
            Bore::Empty => {}
            Bore::Rings(tie, rings) => constraints.add_rings(tie, rings),
            Bore::Held(dofs, rotation) => constraints.hold(dofs, rotation),
        }
        let mut bodies = described(mesh, model, &map, rings)?;
        let full = rigid_count(model.dimension);
        let mut pieces = Vec::new();
        for members in pieces_of(&map, &constraints) {
            let rows = assembled(&members, &constraints, full);
            let all = full * members.len() - rank(&rows);
            let rigid = full - rank(&moved_as_one(&rows, &members, &map, model.dimension));
            pieces.push(Piece {
                elements: members.iter().map(|&body| map.extents[body].elements).sum(),
                bodies: members,
                rigid,
                internal: all.saturating_sub(rigid),
            });
        }
        let has_ring = |piece: &Piece| map.rings.iter().any(|ring| piece.bodies.contains(ring));
        pieces.sort_by_key(|piece| std::cmp::Reverse((has_ring(piece), piece.elements)));
        for (number, piece) in pieces.iter().enumerate() {
            piece.bodies.iter().for_each(|&body| bodies[body].piece = number);
        }
        let internal = |body: usize| pieces[bodies[body].piece].internal > 0;
        let joints = constraints
            .between
            .iter()
            .filter(|(between, _)| !between.ground && between.bodies.iter().any(|&b| internal(b)))
            .filter_map(|(between, own)| joint(between, own, model, full))
            .collect();
        Ok(Self::counted(model.dimension, bodies, pieces, joints))
    }

    /// Sums up what the pieces leave free.
    fn counted(dimension: usize, bodies: Vec<Body>, pieces: Vec<Piece>, joints: Vec<Joint>) -> Self {
        let full = rigid_count(dimension);
        let nothing_held = pieces.iter().all(|piece| piece.rigid == full);
        let of_whole = if nothing_held && !pieces.is_empty() { full } else { 0 };
        let free: usize = pieces.iter().map(|p| p.rigid).filter(|&rigid| rigid == full).sum();
        let total: usize = pieces.iter().map(|piece| piece.rigid + piece.internal).sum();
        Self { dimension, bodies, joints, of_whole, of_loose_pieces: free - of_whole, mechanisms: total - free, pieces }
    }

    /// Number of modes that must have no energy.
    pub fn total(&self) -> usize {
        self.of_whole + self.of_loose_pieces + self.mechanisms
    }
}

/// The pieces of a housing that have some of these nodes: the parts of each.
///
/// # Errors
/// As [`Mechanisms::find`].
pub(crate) fn pieces_at(mesh: &Mesh, model: &HousingModel, nodes: &[usize]) -> Result<Vec<Vec<String>>, ModalError> {
    let found = Mechanisms::find(mesh, model)?;
    let map = BodyMap::new(model);
    let at_nodes: BTreeSet<usize> = nodes.iter().filter_map(|&node| map.of_node(node)).collect();
    let pieces: BTreeSet<usize> = at_nodes.iter().map(|&body| found.bodies[body].piece).collect();
    let parts_of = |piece: &usize| {
        let members = found.pieces[*piece].bodies.iter();
        let parts: BTreeSet<&String> = members.flat_map(|&body| &found.bodies[body].parts).collect();
        parts.into_iter().cloned().collect()
    };
    Ok(pieces.iter().map(parts_of).collect())
}

fn described(mesh: &Mesh, model: &HousingModel, map: &BodyMap, rings: &[RingSeat]) -> Result<Vec<Body>, ModalError> {
    let membership = Membership::new(mesh, model)?;
    let mut parts = vec![BTreeSet::new(); map.extents.len()];
    let mut groups = vec![BTreeSet::new(); map.extents.len()];
    for (number, (element, &body)) in model.elements.iter().zip(&map.of_element).enumerate() {
        parts[body].insert(element.part);
        groups[body].extend(membership.of(number));
    }
    let names = |list: &[String], chosen: &BTreeSet<usize>| -> Vec<String> {
        chosen.iter().filter_map(|&place| list.get(place).cloned()).collect()
    };
    let of_elements = map.extents.len() - rings.len();
    let described = map.extents.iter().enumerate().take(of_elements).map(|(number, extent)| Body {
        is_ring: false,
        ring_name: String::new(),
        parts: names(&model.part_groups(), &parts[number]),
        groups: names(&membership.names, &groups[number]),
        elements: extent.elements,
        centroid: extent.centre,
        piece: 0,
    });
    Ok(described.chain(rings.iter().map(ring_body)).collect())
}

fn ring_body(seat: &RingSeat) -> Body {
    Body {
        is_ring: true,
        ring_name: seat.name(),
        parts: Vec::new(),
        groups: Vec::new(),
        elements: seat.ring.nodes(),
        centroid: seat.frame.centre(),
        piece: 0,
    }
}

/// Sets of joined bodies; the largest body of each first, rings last.
fn pieces_of(map: &BodyMap, constraints: &AllConstraints) -> Vec<Vec<usize>> {
    let count = map.extents.len();
    let mut sets = Sets::new(count);
    for between in constraints.between.keys() {
        for pair in between.bodies.windows(2) {
            sets.join(pair[0], pair[1]);
        }
    }
    let mut members: Vec<Vec<usize>> = vec![Vec::new(); count];
    (0..count).for_each(|body| members[sets.root(body)].push(body));
    members.retain(|members| !members.is_empty());
    for members in &mut members {
        // rings last: a piece is named by its first
        let key = |body: &usize| (!map.rings.contains(body), map.extents[*body].elements);
        members.sort_by_key(|body| std::cmp::Reverse(key(body)));
    }
    members
}

/// The constraints of one piece over the motions of its bodies, `full` each.
fn assembled(members: &[usize], constraints: &AllConstraints, full: usize) -> Vec<Vec<f64>> {
    let mut rows = Vec::new();
    for (between, own) in &constraints.between {
        let place = |body: &usize| members.iter().position(|member| member == body);
        let Some(places) = between.bodies.iter().map(place).collect::<Option<Vec<_>>>() else {
            continue; // another piece
        };
        rows.extend(own.scaled_rows().map(|row| {
            let mut wide = vec![0.0; full * members.len()];
            for (part, place) in row.chunks_exact(full).zip(&places) {
                wide[full * place..][..full].copy_from_slice(part);
            }
            wide
        }));
    }
    rows
}

/// The constraints of a piece on the motions of all its bodies as one.
fn moved_as_one(rows: &[Vec<f64>], members: &[usize], map: &BodyMap, d: usize) -> Vec<Vec<f64>> {
    let full = rigid_count(d);
    let extents: Vec<Extent> = members.iter().map(|&body| map.extents[body]).collect();
    let Some(&Extent { centre, .. }) = extents.first() else {
        return Vec::new();
    };
    let reach = |own: &Extent| apart(centre, own.centre) + own.radius;
    let size = extents.iter().map(reach).fold(f64::MIN_POSITIVE, f64::max);
    let as_one = |row: &Vec<f64>, motion: usize| -> f64 {
        let moved = row.chunks_exact(full).zip(&extents).map(|(part, own)| {
            let arm = [0, 1, 2].map(|axis| (own.centre[axis] - centre[axis]) / size);
            let along: f64 = (0..d).map(|i| part[i] * rigid_component(d, arm, i, motion)).sum();
            let turn = if motion < d { 0.0 } else { part[motion] * own.radius / size };
            along + turn
        });
        moved.sum()
    };
    rows.iter().map(|row| (0..full).map(|motion| as_one(row, motion)).collect()).collect()
}

/// A joint that lets its bodies move.
fn joint(between: &Between, own: &Constraints, model: &HousingModel, full: usize) -> Option<Joint> {
    let rows: Vec<Vec<f64>> = own.scaled_rows().collect();
    let free = full * between.bodies.len() - rank(&rows);
    let motions = free.saturating_sub(full);
    let link = |&link: &usize| Some(model.description.links.get(link)?.between.join(" - "));
    let tags = own.shared_nodes.iter().filter_map(|&node| model.node_tags.get(node).copied());
    (motions > 0).then(|| Joint {
        bodies: between.bodies.clone(),
        nodes: tags.collect(),
        links: own.links.iter().filter_map(link).collect(),
        tied: own.tied,
        motions,
    })
}
