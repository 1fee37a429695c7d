//! The ring of a case as a body of elements that stands for the beams: its section, its material, its elements, and the points at which
//! modes with beams and with the body are compared.
//!
//! Why the price of a tie was not computed.

use crate::app::case;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::AssembledHousing;
use crate::app::scene::ring::{BoreExtent, layer, metres};
use crate::fe::element::continuum::PlaneAssumption;
use crate::fe::material::{Material, RingLayer};
use crate::fe::modal::{FullModes, ModeSet};
use crate::fe::model::{HousingModel, MeshedRing, PlaneModel, Ring, RingFrame, SolidRing};
use crate::numerics::linalg::DenseMatrix;
use crate::report::{quantity, signed};
use schemars::JsonSchema;
use serde::Serialize;
use thiserror::Error;

/// Gap between the rectangle's outer face and the bore that the joint may bridge, over the rectangle's height. A
/// larger one is closed by moving the section.
const LARGEST_GAP: f64 = 0.1;

/// Farthest that the section is moved, over the radius of its centroid line: bending stiffness goes with the cube.
const LARGEST_SHIFT: f64 = 0.1;

/// Elements round the ring, least and most. With 64 Hex20 round a ring of the same proportions frequencies are within
/// 1e-3 of three-dimensional elasticity (`rings_of_solids` among the verification cases).
const AROUND: [usize; 2] = [64, 720];

/// Elements round the ring over sqrt(R/h), least: curved quadratic elements of length l lock by about `(l^2 / (R h))^2 / 20`,
/// which measured 1.7e-3 for 64 round a ring of R/h = 19.5 and is 1e-4 with this.
const SHORT: f64 = 30.0;

/// How much denser than the bore's the nodes of the ring's face are, so that it is the ring's that follow.
const DENSER: f64 = 1.1;

/// A solid ring in place of a ring of beams.
#[derive(Debug, Clone)]
pub(crate) struct RingBody {
    /// Its mesh, to be.
    pub ring: SolidRing,
    /// What it is made of.
    pub material: Material,
    /// What the reader must know, a sentence each.
    pub notes: Vec<String>,
}

impl RingBody {
    /// The rectangle with the section's area and second moment, with its outer face at the bore.
    ///
    /// # Errors
    /// [`NoTiePrice`] for a ring that one rectangle cannot stand for; [`ComputeError`] of its material.
    pub(crate) fn of(
        case: &Case,
        asked: &case::Ring,
        tie: &case::Tie,
        housing: &AssembledHousing,
    ) -> Result<Self, Stop> {
        let [section] = asked.sections.as_slice() else {
            return Err(NoTiePrice::SeveralSections { count: asked.sections.len() }.into());
        };
        let layer = layer(case, section)?;
        let [height, width] = layer.rectangle();
        let bore = asked.outer_radius.ok_or(NoTiePrice::NoOuterRadius)?;
        let mut notes = Vec::new();
        let radius = placed(&layer, height, bore, &mut notes)?;
        if layer_is_not_rectangular(&layer) && housing.model.dimension() == 3 {
            notes.push(format!(
                "The case gives the ring a second moment about its radial axis of {} and a torsion constant of {}; the rectangle has {} and {}.",
                quantity(layer.out_of_plane_inertia(), "m^4"),
                quantity(layer.torsion_constant(), "m^4"),
                quantity(rectangular(&layer).out_of_plane_inertia(), "m^4"),
                quantity(rectangular(&layer).torsion_constant(), "m^4"),
            ));
        }
        if !asked.shear || !asked.rotary_inertia {
            notes.push("The beams leave out shear or rotary inertia, which a body has: see the ring alone.".to_owned());
        }
        let seat = BoreExtent::of(&housing.mesh, &housing.model, housing.model.frame(), &tie.group)?;
        if housing.model.dimension() == 3 && seat.share_outside(width) > 1e-6 {
            notes.push(format!(
                "The ring, {} wide, reaches beyond the bore, whose nodes lie from {} to {} along its axis.",
                metres(width),
                metres(seat.from),
                metres(seat.to)
            ));
        }
        let mut ring = SolidRing {
            radius,
            height,
            width,
            around: ((SHORT * (radius / height).sqrt()).ceil() as usize).clamp(AROUND[0], AROUND[1]),
            across: even(height / width, 4),
            along: even(width / height, 12),
        };
        seat.refine(&mut ring, housing.model.dimension());
        if !asked.supports.is_empty() {
            // a section at each node, for its spring
            ring.around = ring.around.next_multiple_of(asked.nodes);
        }
        Ok(Self { ring, material: layer.material, notes })
    }

    /// The material with which elements of the housing's plane model are those of a ring as wide as its section under
    /// plane stress, as the beams are; in space the material itself.
    ///
    /// Stiffness and mass of a plane element go with E t and rho t, and with `E (1 + 2 nu) / (1 + nu)^2` and
    /// `nu / (1 + nu)` plane strain is plane stress with E and nu (Timoshenko and Goodier, Theory of Elasticity, 3rd
    /// ed., section 16).
    ///
    /// # Errors
    /// [`ComputeError::Input`].
    pub(crate) fn material_in(&self, plane: Option<PlaneModel>) -> Result<Material, ComputeError> {
        let Some(plane) = plane else {
            return Ok(self.material);
        };
        let Material { young, poisson, density, .. } = self.material;
        let (young, poisson) = match plane.assumption {
            PlaneAssumption::Stress => (young, poisson),
            PlaneAssumption::Strain => {
                let more = 1.0 + poisson;
                (young * (more + poisson) / more.powi(2), poisson / more)
            }
        };
        let part = self.ring.width / plane.thickness;
        Material::new(part * young, poisson, part * density)
            .map_err(|source| ComputeError::wrong(format!("materials.the solid ring's: {source}")))
    }
}

/// An even number of elements for a side so many times as long as the other, `most` at most.
fn even(sides: f64, most: usize) -> usize {
    2 * ((sides / 2.0).ceil() as usize).clamp(1, most / 2)
}

/// Radius of the section's centroid line: its own, or one that brings the outer face to the bore.
fn placed(layer: &RingLayer, height: f64, bore: f64, notes: &mut Vec<String>) -> Result<f64, NoTiePrice> {
    let gap = bore - (layer.radius + 0.5 * height);
    let refused = NoTiePrice::Rectangle { height_m: height, outside_m: layer.radius + 0.5 * height, bore_m: bore };
    if gap.abs() <= LARGEST_GAP * height {
        if gap.abs() > 1e-6 * bore {
            let side = if gap > 0.0 { "inside" } else { "outside" };
            notes.push(format!(
                "The outer face of the rectangle lies {} {side} the bore's radius; the joint bridges that as a rigid arm, as the beams' tie does.",
                metres(gap.abs())
            ));
        }
        // also false for sizes that are no numbers
        let hollow = layer.radius > 0.5 * height;
        return if hollow { Ok(layer.radius) } else { Err(refused) };
    }
    let moved = layer.radius + gap;
    let fits = gap.abs() <= LARGEST_SHIFT * layer.radius && moved > 0.5 * height;
    if !fits {
        return Err(refused);
    }
    let share = gap / layer.radius;
    notes.push(format!(
        "To bring the outer face of the rectangle to the bore, the solid ring's centroid line was moved by {} ({} %): EA and EI are the beams', EI/R^3 is {} % off.",
        metres(gap),
        signed(100.0 * share, 2),
        signed(100.0 * ((1.0 + share).powi(-3) - 1.0), 2),
    ));
    Ok(moved)
}

fn rectangular(layer: &RingLayer) -> RingLayer {
    RingLayer { axial_inertia: None, torsion: None, ..*layer }
}

/// Whether what was given beyond area and second moment differs from the rectangle's by more than a thousandth.
fn layer_is_not_rectangular(layer: &RingLayer) -> bool {
    let own = rectangular(layer);
    let differs = |a: f64, b: f64| (a / b - 1.0).abs() > 1e-3;
    differs(layer.out_of_plane_inertia(), own.out_of_plane_inertia())
        || differs(layer.torsion_constant(), own.torsion_constant())
}

impl BoreExtent {
    /// Makes the ring's face finer than the bore's, if it is not: the nodes of the finer one follow.
    fn refine(&self, ring: &mut SolidRing, dimension: usize) {
        let round = |sides: f64| (sides.ceil() as usize).clamp(AROUND[0], AROUND[1]);
        if dimension != 3 {
            // two nodes an edge
            ring.around = ring.around.max(round(0.5 * DENSER * self.nodes as f64));
            return;
        }
        // a face of Quad8 has three nodes to itself
        let share = ring.width / (self.to - self.from).max(ring.width);
        let needed = DENSER * self.nodes as f64 * share / 3.0;
        let finer = (needed / (ring.around * ring.along) as f64).sqrt();
        if finer > 1.0 {
            ring.around = round(finer * ring.around as f64);
            ring.along = 2 * (0.5 * finer * ring.along as f64).ceil() as usize;
        }
    }
}

/// Corner nodes of all sections of a solid ring.
pub(crate) fn section_nodes(meshed: &MeshedRing) -> impl Iterator<Item = usize> + '_ {
    meshed.sections.iter().flatten().map(|&(node, _)| node)
}

/// Nodes at which modes are compared.
pub(crate) struct Points {
    /// Their indices in the mesh.
    pub nodes: Vec<usize>,
    /// Where they are, m.
    pub places: Vec<[f64; 3]>,
    tags: Vec<u64>,
}

impl Points {
    /// Some nodes of the mesh that a ring was added to.
    pub(crate) fn new(meshed: &MeshedRing, nodes: impl Iterator<Item = usize>) -> Self {
        let nodes: Vec<usize> = nodes.collect();
        let mesh = &meshed.mesh;
        Self {
            places: nodes.iter().map(|&node| mesh.nodes[node]).collect(),
            tags: nodes.iter().map(|&node| mesh.node_tags[node]).collect(),
            nodes,
        }
    }

    /// Modes of a body of continuum elements at the nodes.
    pub(crate) fn of_body(&self, modes: &FullModes, model: &HousingModel) -> ModeSet {
        let (moved, dimension) = (modes.motions.housing(model, &modes.over_all_rows()), model.dimension());
        let shapes = DenseMatrix::from_fn(3 * self.nodes.len(), moved.ncols(), |row, mode| match row % 3 < dimension {
            true => moved[(dimension * self.nodes[row / 3] + row % 3, mode)],
            false => 0.0,
        });
        self.set(modes, shapes)
    }

    /// Modes with their shapes at the nodes.
    pub(crate) fn set(&self, modes: &FullModes, shapes: DenseMatrix) -> ModeSet {
        ModeSet {
            frequencies_hz: modes.basis.frequencies_hz.clone(),
            points: self.places.clone(),
            node_tags: Some(self.tags.clone()),
            shapes,
            directions: None,
        }
    }
}

/// Displacements of points of a ring's rigid sections, in the mesh's axes [3 points x modes].
pub(crate) fn beam_shapes(ring: &Ring, frame: &RingFrame, modes: &DenseMatrix, points: &[[f64; 3]]) -> DenseMatrix {
    let mut shapes = DenseMatrix::zeros(3 * points.len(), modes.ncols());
    for (place, point) in points.iter().enumerate() {
        let [x, y, z] = frame.point(*point);
        let (arm, angle) = (x.hypot(y) - ring.section().radius, y.atan2(x));
        let axes = frame.polar_axes(*point);
        let (in_space, plane) = (ring.space_rows_at(angle), ring.rows_at(angle));
        for mode in 0..modes.ncols() {
            let d = modes.col_as_slice(mode);
            let polar = match &in_space {
                Some(rows) => rows.displacement_at(arm, z).map(|row| rows.apply(&row, d)),
                None => {
                    let tangential = plane.tangential_at(arm);
                    [plane.apply(&plane.radial, d), plane.apply(&tangential, d), 0.0]
                }
            };
            for axis in 0..3 {
                shapes[(3 * place + axis, mode)] = (0..3).map(|k| polar[k] * axes[k][axis]).sum();
            }
        }
    }
    shapes
}

/// Why the price of a tie was not computed.
#[derive(Debug, Clone, PartialEq, Error, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum NoTiePrice {
    /// Nothing is tied.
    #[error("the case has no ring that is tied to a housing")]
    NoTie,
    /// More than one ring.
    #[error(
        "the case has {count} bearings: the price is computed for one ring; give the others' bores as parts of the housing"
    )]
    SeveralRings {
        /// How many.
        count: usize,
    },
    /// Rings fitted into each other.
    #[error(
        "the ring has {count} sections: there is no one body that bends as rings that slip on each other or are bonded at unknown radii"
    )]
    SeveralSections {
        /// How many.
        count: usize,
    },
    /// A ring of unknown outer radius.
    #[error("the case does not give `ring.outer_radius`, the radius of the bore")]
    NoOuterRadius,
    /// A rectangle that does not go into the bore.
    #[error(
        "the rectangle of the section's area and second moment is {} high, so that its outer face lies at a radius of {}, and the bore at {}: too far apart for one to stand in the other",
        metres(*.height_m),
        metres(*.outside_m),
        metres(*.bore_m)
    )]
    Rectangle {
        /// Height of the rectangle, m.
        height_m: f64,
        /// Radius of its outer face, m.
        outside_m: f64,
        /// Radius of the bore, m.
        bore_m: f64,
    },
    /// A ring that cannot be joined to the bore.
    #[error("the solid ring cannot be joined to the bore: {message}")]
    Joint {
        /// What the joint says.
        message: String,
    },
    /// A model that is too large.
    #[error("with a solid ring the model has {free_dof} degrees of freedom, more than {limit}")]
    TooLarge {
        /// Free degrees of freedom.
        free_dof: usize,
        /// How many are computed at most.
        limit: usize,
    },
}

/// Why a computation ended before its result.
#[derive(Debug)]
pub(crate) enum Stop {
    Reason(NoTiePrice),
    Failed(Box<ComputeError>),
}

impl From<NoTiePrice> for Stop {
    fn from(reason: NoTiePrice) -> Self {
        Self::Reason(reason)
    }
}

impl<E: Into<ComputeError>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Failed(Box::new(error.into()))
    }
}
