//! The price of the tie: how much a rigid section in the bore raises the frequencies.
//!
//! The tie makes every point of the bore move with the ring's section at its angle, over the whole width of the bore. Here
//! the ring is meshed as a body of the same section and material, joined to the bore over its own width, and both
//! models are solved in full. The same ring alone, free, as beams and as a body, tells what part of the difference is
//! the beams'.

use super::body::{NoTiePrice, Points, RingBody, Stop, beam_shapes, section_nodes};
use crate::app::case;
use crate::app::case::Case;
use crate::app::error::ComputeError;
use crate::app::scene::AssembledHousing;
use crate::app::scene::housing::description;
use crate::app::scene::ring::{ring, rings_and_tie};
use crate::fe::assembly::{CoupledMatrices, SystemMatrices};
use crate::fe::mesh::{Mesh, MeshNotes};
use crate::fe::modal::{
    ComparisonOptions, FullModes, ModalComparison, ModeRange, ModeSet, Partner, partners, strain_products,
};
use crate::fe::model::{
    Connection, Fit, HousingDescription, HousingModel, HousingPart, Link, MeshedRing, ModelError, OverlapRule,
    PlaneModel, Ring, Rings, SpringStiffness, SupportShare,
};
use crate::numerics::Watch;
use crate::numerics::linalg::DenseMatrix;
use schemars::JsonSchema;
use serde::Serialize;

/// Elastic modes whose price is computed where nothing is said.
pub const TIE_PRICE_MODES: usize = 10;

/// Free degrees of freedom up to which a solid ring is affordable: a solid of 236 739 took 2.9 GiB (docs/performance.md).
pub(crate) const LARGEST: usize = 250_000;

/// Modes without strain that a ring in a free housing may have: six, and two if it slides.
pub(crate) const RIGID: usize = 8;

/// Modes sought beyond those asked for, least and as a part: their order may differ.
pub(crate) const MORE: [usize; 2] = [4, 4];

/// Stiffness of the radial springs of a sliding joint, in those of the ring's own height: E/h an area.
pub(crate) const SLIDING: f64 = 1e3;

/// The price of a tie, or why there is none.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum TiePrice {
    /// It was computed.
    Computed(Box<TieComparison>),
    /// It was not.
    NotComputed(NoTiePrice),
}

/// A ring of beams that is tied to the bore against the same ring as a body that is joined to it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TieComparison {
    /// The lowest elastic modes of housing and ring.
    pub modes: Vec<BeamAndSolid>,
    /// Modes without strain of both together, with the ring of beams and with the solid one.
    pub rigid_modes: [usize; 2],
    /// The lowest elastic modes of the ring alone, free: what differs here is the beams', not the tie's.
    pub ring_alone: Vec<BeamAndSolid>,
    /// Radius of the solid ring's centroid line, m.
    pub radius_m: f64,
    /// Radial side of its section, m.
    pub height_m: f64,
    /// Side of its section along the axis, m.
    pub width_m: f64,
    /// Its elements.
    pub elements: usize,
    /// Degrees of freedom that the modes were computed over, with the ring of beams and with the solid one.
    pub free_dof: [usize; 2],
    /// What the reader must know, a sentence each.
    pub notes: Vec<String>,
}

/// A mode with the ring as beams and with the ring as a body.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct BeamAndSolid {
    /// Index from 0 among the modes with beams, rigid ones included.
    pub mode: usize,
    /// Frequency with beams, Hz.
    pub beams_hz: f64,
    /// Frequency with the body, Hz; `None`: no mode there has this shape.
    pub solid_hz: Option<f64>,
    /// (beams - solid) / solid: positive if the beams and their tie are stiffer.
    pub relative_difference: Option<f64>,
    /// MAC of the shapes on the housing's own nodes and at the corners of the solid ring's sections, which the beams move
    /// as rigid ones (of the ring alone: there alone); repeated modes as spaces.
    pub mac: Option<f64>,
}

/// Computes the price of the tie of a case for its lowest `count` elastic modes.
///
/// # Errors
/// [`ComputeError`] of the ring, the tie and the eigenvalue computations.
pub(crate) fn tie_price(
    case: &Case,
    housing: &AssembledHousing,
    count: usize,
    watch: &impl Watch,
) -> Result<TiePrice, ComputeError> {
    if case.bearings.len() > 1 {
        return Ok(TiePrice::NotComputed(NoTiePrice::SeveralRings { count: case.bearings.len() }));
    }
    let both = case.ring.as_ref().zip(case.meshed_housing());
    let tied = both.and_then(|(asked, of)| Some((asked, of, asked.tie.as_ref()?)));
    let Some((asked, asked_housing, tie)) = tied else {
        return Ok(TiePrice::NotComputed(NoTiePrice::NoTie));
    };
    match (Tied { case, asked, tie, housing, count, watch }).compared(asked_housing) {
        Ok(comparison) => Ok(TiePrice::Computed(Box::new(comparison))),
        Err(Stop::Reason(reason)) => Ok(TiePrice::NotComputed(reason)),
        Err(Stop::Failed(error)) => Err(*error),
    }
}

/// A ring that is tied to a housing, and what is asked of it.
struct Tied<'a, W> {
    case: &'a Case,
    asked: &'a case::Ring,
    tie: &'a case::Tie,
    housing: &'a AssembledHousing,
    /// Elastic modes.
    count: usize,
    watch: &'a W,
}

impl<W: Watch> Tied<'_, W> {
    fn compared(&self, asked_housing: &case::Housing) -> Result<TieComparison, Stop> {
        let AssembledHousing { mesh, model, matrices } = self.housing;
        let (rings, tie) = rings_and_tie(self.case, Some(self.housing))?;
        let ring = &rings.first().ring;
        let tie = tie.ok_or(NoTiePrice::NoTie)?;
        self.watch.stage("solid ring");
        let body = RingBody::of(self.case, self.asked, self.tie, self.housing)?;
        let description = description(self.case, asked_housing)?;
        let plane = description.plane;
        let (with_body, meshed) = self.joined(description, &body, ring)?;
        let matrices = CoupledMatrices::new(matrices, &tie, &rings);
        let mut beams = FullModes::of(matrices, ModeRange::AtMost(self.sought()), None, self.watch)?;
        beams.sharpen(&|motions, all| {
            let of_ring = ring.strain_products(&motions.rings(all));
            let of_housing = strain_products(model, &motions.housing(model, all))?;
            Ok(of_housing + of_ring.beams + of_ring.springs)
        })?;
        let solid = self.modes_of(&with_body)?;
        // the housing's own nodes come first in both, and the ring's after them
        let of_housing = beams.motions.housing(model, &beams.over_all_rows());
        let of_ring = beams.motions.rings(&beams.over_all_rows());
        let nodes = mesh.nodes.len();
        let points = Points::new(&meshed, (0..nodes).chain(section_nodes(&meshed)));
        let dimension = model.dimension();
        let carried = beam_shapes(ring, model.frame(), &of_ring, &points.places[nodes..]);
        let of_beams = DenseMatrix::from_fn(3 * points.nodes.len(), of_ring.ncols(), |row, mode| {
            match row.checked_sub(3 * nodes) {
                Some(row) => carried[(row, mode)],
                None if row % 3 < dimension => of_housing[(dimension * (row / 3) + row % 3, mode)],
                None => 0.0,
            }
        });
        let sets = [points.set(&beams, of_beams), points.of_body(&solid, &with_body)];
        let mut notes = body.notes.clone();
        if self.tie.fit == Fit::Sliding {
            notes.push(format!(
                "The solid ring slides in the bore on radial springs as stiff as a layer of its material of 1/{SLIDING:.0} of its height."
            ));
        }
        if !ring.springs.is_empty() {
            let text =
                "The ring's springs hold the mean motion of the solid ring's sections at the angles of the nodes.";
            notes.push(text.to_owned());
        }
        Ok(TieComparison {
            modes: self.side_by_side(&sets, beams.basis.rigid_modes)?,
            rigid_modes: [beams.basis.rigid_modes, solid.basis.rigid_modes],
            ring_alone: self.ring_alone(&body, plane)?,
            radius_m: body.ring.radius,
            height_m: body.ring.height,
            width_m: body.ring.width,
            elements: body.ring.elements(dimension),
            free_dof: [beams.free_dof(), solid.free_dof()],
            notes,
        })
    }

    /// How many modes are sought.
    fn sought(&self) -> usize {
        self.count + RIGID + MORE[0].max(self.count / MORE[1])
    }

    /// The housing with the solid ring in its bore.
    fn joined(
        &self,
        mut description: HousingDescription,
        body: &RingBody,
        ring: &Ring,
    ) -> Result<(HousingModel, MeshedRing), Stop> {
        let AssembledHousing { mesh, model, .. } = self.housing;
        let meshed = body.ring.added_to(mesh, model.frame(), model.dimension());
        let material = body.material_in(description.plane)?.into();
        description.parts.push(HousingPart { group: meshed.body.clone(), material });
        let outside = body.ring.radius + 0.5 * body.ring.height;
        let area = std::f64::consts::TAU * outside * body.ring.width;
        let connection = match self.tie.fit {
            Fit::Bonded => Connection::Tie,
            Fit::Sliding => {
                let stiffness = SLIDING * body.material.young / body.ring.height * area;
                Connection::Spring(SpringStiffness::Radial(stiffness), SupportShare::PerGroup)
            }
        };
        // the housing itself is sound: what is wrong now is the ring's joint
        let joint = |error: ModelError| NoTiePrice::Joint { message: error.to_string() };
        // the rectangle may reach into the housing by a small part of its height
        description.overlap = OverlapRule::Allow;
        description.links.push(Link { between: [meshed.outer_face.clone(), self.tie.group.clone()], connection });
        let mut with_body = HousingModel::new(&meshed.mesh, description).map_err(joint)?;
        with_body.attach_ring_springs(&meshed, ring).map_err(joint)?;
        affordable(with_body.free_dofs().len())?;
        Ok((with_body, meshed))
    }

    /// The lowest modes of a model of continuum elements.
    fn modes_of(&self, model: &HousingModel) -> Result<FullModes, ComputeError> {
        let matrices = CoupledMatrices::of_housing(SystemMatrices::assemble_and_order(model)?, model);
        let mut modes = FullModes::of(matrices, ModeRange::AtMost(self.sought()), None, self.watch)?;
        modes.sharpen(&|motions, all| strain_products(model, &motions.housing(model, all)))?;
        Ok(modes)
    }

    /// The ring alone and free, as beams and as a body.
    fn ring_alone(&self, body: &RingBody, plane: Option<PlaneModel>) -> Result<Vec<BeamAndSolid>, ComputeError> {
        let in_space = plane.is_none();
        let free = case::Ring { supports: Vec::new(), ..self.asked.clone() };
        let beams = ring(self.case, &free, in_space)?;
        let alone = Rings::one(beams.clone(), *self.housing.model.frame());
        let range = ModeRange::AtMost(self.sought());
        let mut of_beams = FullModes::of(CoupledMatrices::of_rings(&alone), range, None, self.watch)?;
        of_beams.sharpen(&|_, all| {
            let strain = beams.strain_products(all);
            Ok(strain.beams + strain.springs)
        })?;
        let frame = self.housing.model.frame();
        let nothing = Mesh {
            nodes: Vec::new(),
            node_tags: Vec::new(),
            blocks: Vec::new(),
            groups: Vec::new(),
            format: self.housing.mesh.format,
            notes: MeshNotes::default(),
            source: "solid ring".into(),
        };
        let meshed = body.ring.added_to(&nothing, frame, if in_space { 3 } else { 2 });
        let description = HousingDescription {
            parts: vec![HousingPart { group: meshed.body.clone(), material: body.material_in(plane)?.into() }],
            plane,
            frame: *frame,
            ..HousingDescription::default()
        };
        let model = HousingModel::new(&meshed.mesh, description)?;
        let solid = self.modes_of(&model)?;
        let points = Points::new(&meshed, section_nodes(&meshed));
        let on_beams = beam_shapes(&beams, frame, &of_beams.over_all_rows(), &points.places);
        let sets = [points.set(&of_beams, on_beams), points.of_body(&solid, &model)];
        self.side_by_side(&sets, of_beams.basis.rigid_modes)
    }

    /// The first elastic modes of the first set with what belongs to them in the second.
    fn side_by_side(&self, [beams, solid]: &[ModeSet; 2], rigid: usize) -> Result<Vec<BeamAndSolid>, ComputeError> {
        let found = ModalComparison::new(beams, solid, ComparisonOptions::default())?;
        let partners = partners(beams, solid, &found);
        let elastic = partners.iter().enumerate().skip(rigid).take(self.count);
        let row = |(mode, &partner): (usize, &Option<Partner>)| {
            let beams_hz = beams.frequencies_hz[mode];
            BeamAndSolid {
                mode,
                beams_hz,
                solid_hz: partner.map(|partner| partner.hz),
                relative_difference: partner.map(|partner| beams_hz / partner.hz - 1.0),
                mac: partner.map(|partner| partner.mac),
            }
        };
        Ok(elastic.map(row).collect())
    }
}

/// Whether a model with a solid ring is small enough.
pub(super) fn affordable(free_dof: usize) -> Result<(), NoTiePrice> {
    match free_dof <= LARGEST {
        true => Ok(()),
        false => Err(NoTiePrice::TooLarge { free_dof, limit: LARGEST }),
    }
}
