//! What can go wrong on the way from a case to a result: what failed, whose fault it is and what to do.

use crate::app::case::CaseError;
use crate::bearing::{BearingError, Race};
use crate::fe::element::ElementError;
use crate::fe::material::MaterialError;
use crate::fe::mesh::MeshError;
use crate::fe::modal::ModalError;
use crate::fe::model::{HousingModel, ModelError, NodeInterface, RingError};
use crate::fe::reduction::ReductionError;
use crate::fe::reduction::frf::FrfError;
use crate::files::{Fault, FileError, Place};
use crate::formats::{FormatError, MeasuredError};
use crate::numerics::linalg::HarmonicError;
use crate::numerics::linalg::LinalgError;
use crate::numerics::ode::TransientError;
use crate::numerics::series::SeriesError;
use crate::report::ReportError;
use crate::signal::SignalError;
use crate::signal::diagnosis::DiagnosisError;
use crate::system::SystemError;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Failure of a stage.
#[derive(Debug, Error)]
pub enum ComputeError {
    /// Input that nothing can be computed with.
    #[error("{what}")]
    Input {
        /// What is wrong, and where.
        what: String,
        /// What to do about it.
        help: Option<String>,
    },
    /// The case file.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A file of signals.
    #[error(transparent)]
    Measured(#[from] MeasuredError),
    /// A signal that cannot be judged.
    #[error(transparent)]
    Diagnosis(#[from] DiagnosisError),
    /// The mesh file.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// A mesh has another content than when it was read.
    #[error("{} was changed while it was used: the result belongs to what it was before", path.display())]
    MeshChanged {
        /// The mesh.
        path: PathBuf,
    },
    /// Mesh and case do not fit.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// A material out of range.
    #[error("materials.{name}: {source}")]
    Material {
        /// Name in the case file.
        name: String,
        /// What is wrong with it.
        source: MaterialError,
    },
    /// Plane properties out of range.
    #[error("housing.plane: {0}")]
    Plane(#[from] ElementError),
    /// A ring section out of range.
    #[error("ring.sections: {0}")]
    Section(#[from] MaterialError),
    /// Modes that cannot be analysed.
    #[error(transparent)]
    Modal(ModalError),
    /// A file of mode shapes that cannot be read.
    #[error(transparent)]
    ModeShapes(FormatError),
    /// Mode shapes at points that are nowhere.
    #[error("{}: expected mode shapes at points, found {found}", file.display())]
    PointsUnknown {
        /// The file.
        file: PathBuf,
        /// What it has instead.
        found: &'static str,
    },
    /// Modes of a file that cannot be compared.
    #[error("{}: {source}", file.display())]
    Compared {
        /// The file.
        file: PathBuf,
        /// What is wrong.
        source: Box<ModalError>,
    },
    /// Another mesh of the case that fails.
    #[error("modes.convergence.meshes[{index}] ({}): {source}", path.display())]
    OtherMesh {
        /// Which one, from 0.
        index: usize,
        /// Its file.
        path: PathBuf,
        /// What is wrong with it.
        source: Box<ComputeError>,
    },
    /// A mesh of something else.
    #[error("expected a mesh of the same body, of area or volume {own:.4e} (m^2, m^3), found {found:.4e}")]
    OtherBody {
        /// Area or volume of the case's mesh, m^2 or m^3.
        own: f64,
        /// That of the other.
        found: f64,
    },
    /// Meshes that make no sequence.
    #[error("modes.convergence: {0}")]
    Sequence(ModalError),
    /// The ring.
    #[error("ring: {0}")]
    Ring(#[from] RingError),
    /// A part of the bearing or its motion out of range.
    #[error("{place}{source}")]
    Bearing {
        /// Where in the case it stands, with a colon; nothing where the message says it.
        place: String,
        /// What is wrong with it.
        source: BearingError,
    },
    /// A contact that is as wide as the ball.
    #[error(
        "bearing.{race}_groove_radius: the contact of a ball with the {race} race would have a half-axis of {half_axis:.3e} m under the largest force at rest, {force:.3e} N, and the ball's radius is {ball_radius:.3e} m: expected a patch well below it, found a groove of {groove:e} m, {:.7} of the ball's diameter (0.51 to 0.54 are built); check the groove, the ball and the load on the shaft",
        0.5 * groove / ball_radius
    )]
    WidePatch {
        /// The race.
        race: Race,
        /// Radius of its groove, m.
        groove: f64,
        /// Radius of the ball, m.
        ball_radius: f64,
        /// Largest force of a ball on it, N.
        force: f64,
        /// Longer half-axis of the patch under that force, m.
        half_axis: f64,
    },
    /// A pressure that no solid bears.
    #[error(
        "bearing: the pressure between a ball and the {race} race would be {:.0} MPa under the largest force at rest, {force:.3e} N: expected below {:.0} MPa, a tenth of the effective modulus, beyond which no solid is elastic (bearing steel is rated to 4200 MPa, ISO 76); check the load on the shaft, bearing.ball_radius and the groove radii",
        1e-6 * pressure, 1e-6 * limit
    )]
    Pressure {
        /// The race.
        race: Race,
        /// Largest force of a ball on it, N.
        force: f64,
        /// Largest pressure under that force, Pa.
        pressure: f64,
        /// Largest pressure that is accepted, Pa.
        limit: f64,
    },
    /// A file with a profile that cannot be read.
    #[error("{}{line}: {what} (bearing.defects[{index}].profile)", path.display())]
    ProfileFile {
        /// Which defect, from 0.
        index: usize,
        /// The file.
        path: PathBuf,
        /// Colon and line, or nothing.
        line: String,
        /// What was found, and what was expected.
        what: String,
    },
    /// Two defects in one place.
    #[error(
        "bearing.defects[{first}] and bearing.defects[{second}] overlap (arcs {apart_deg:.2} degrees apart, {needed_deg:.2} needed): move one or make it shorter"
    )]
    DefectsOverlap {
        /// The one, from 0.
        first: usize,
        /// The other.
        second: usize,
        /// Distance of their middles, degrees.
        apart_deg: f64,
        /// Distance that keeps them apart, degrees.
        needed_deg: f64,
    },
    /// Rayleigh damping that drives.
    #[error(
        "damping: these values mean alpha = {alpha:.4e} 1/s and beta = {beta:.4e} s; a negative coefficient drives some modes: bring the two ratios closer together, or use damping.modal"
    )]
    NegativeDamping {
        /// Mass coefficient, 1/s.
        alpha: f64,
        /// Stiffness coefficient, s.
        beta: f64,
    },
    /// Structural damping in a simulation over time.
    #[error(
        "materials.{material}: loss_factor = {loss_factor} is structural damping, which has a meaning for harmonic motion alone (frf); a run steps through time: leave the key out and give [damping]"
    )]
    StructuralDamping {
        /// Name of the material.
        material: String,
        /// Its loss factor.
        loss_factor: f64,
    },
    /// A sensor or a force that points out of the plane of a plane model.
    #[error(
        "{name}: direction has a part across the bearing's plane, {across}: a plane model moves in its plane alone; give direction = [0, 1, 0] or the like"
    )]
    SensorDirection {
        /// What stands there, with its name.
        name: String,
        /// The unit vector's part across the plane.
        across: f64,
    },
    /// A sensor that is nowhere.
    #[error(
        "{name}: the nearest node of the housing to ({x:e}, {y:e}, {z:e}) m is {distance:.3e} m away; give a point on the mesh, in metres",
        x = point[0], y = point[1], z = point[2]
    )]
    SensorPlace {
        /// What stands there, with its name.
        name: String,
        /// Where it should be, m.
        point: [f64; 3],
        /// Distance of the nearest node, m.
        distance: f64,
    },
    /// A sensor that cannot move.
    #[error(
        "{name} stands where the support \"{support}\" holds the housing in its direction, so that it measures zero: expected a place that moves; give another place or direction, or another support"
    )]
    SensorHeld {
        /// What stands there, with its name.
        name: String,
        /// Group of the support.
        support: String,
    },
    /// A sensor on a group without a housing.
    #[error("{name} stands on {place}, but the case has no housing: use ring_deg for a place on the ring")]
    SensorNeedsHousing {
        /// What stands there, with its name.
        name: String,
        /// What it stands on.
        place: String,
    },
    /// A sensor on a ring that is not there.
    #[error("{name} stands on the ring, but no ring is attached here: give group, node or point")]
    SensorNeedsRing {
        /// What stands there, with its name.
        name: String,
    },
    /// A sensor on a node that is not there.
    #[error(
        "{name}: {} {tag}",
        if *in_mesh { "no element of the housing has node" } else { "the mesh has no node" }
    )]
    SensorNode {
        /// What stands there, with its name.
        name: String,
        /// gmsh's tag.
        tag: u64,
        /// Whether the mesh has it.
        in_mesh: bool,
    },
    /// Directions of the tie that make no frame.
    #[error("ring.tie: `zero_deg` lies along `axis`: expected a direction across it")]
    TieFrame,
    /// A case without an interface.
    #[error("nothing to condense the housing on: expected ring.tie, or condense.interface = {{ group = \"NAME\" }}")]
    NothingToCondense,
    /// An interface that the ring is not attached by.
    #[error(
        "condense.interface: a ring is attached by itself; `group` and `nodes` are for `condense` and `frf` of the housing alone"
    )]
    InterfaceOfRing,
    /// A node of the interface that is not there.
    #[error(
        "condense.interface.nodes[{index}]: {} {tag}",
        if *in_mesh { "no element of the housing has node" } else { "the mesh has no node" }
    )]
    InterfaceNode {
        /// Which one, from 0.
        index: usize,
        /// gmsh's tag.
        tag: u64,
        /// Whether the mesh has it.
        in_mesh: bool,
    },
    /// An interface that cannot move.
    #[error(
        "condense.interface: all {displacements} displacements of its nodes are held by {holders}: expected at least one that is free"
    )]
    InterfaceHeld {
        /// How many.
        displacements: usize,
        /// Supports, a link or both, in words.
        holders: String,
    },
    /// A housing that can still move while its interface is held.
    #[error(
        "with the interface held, the housing can still move, so that it cannot be condensed: {}", what.join("; ")
    )]
    LooseInterior {
        /// A sentence for each piece or joint.
        what: Vec<String>,
    },
    /// A part that is held too softly, or not at all.
    #[error("part \"{part}\", near node {tag}: {source}")]
    SoftPart {
        /// The part.
        part: String,
        /// gmsh's tag of a node.
        tag: u64,
        /// What was found.
        source: ReductionError,
    },
    /// Craig-Bampton.
    #[error(transparent)]
    Reduction(#[from] ReductionError),
    /// Frequency responses.
    #[error("frf: {0}")]
    Frf(#[from] FrfError),
    /// Harmonic response of the full model.
    #[error("frf: {0}")]
    Harmonic(#[from] HarmonicError),
    /// Coupling, equilibrium, linearisation.
    #[error(transparent)]
    System(#[from] SystemError),
    /// Linear algebra.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
    /// Time integration.
    #[error(transparent)]
    Transient(#[from] TransientError),
    /// A file of a run that cannot be read or written.
    #[error(transparent)]
    File(#[from] FileError),
    /// A run that was asked to stop; it can go on.
    #[error("interrupted at t = {at_s:.6} s of {end_s} s")]
    Interrupted {
        /// How far it came, s.
        at_s: f64,
        /// How far it was to go, s.
        end_s: f64,
    },
    /// Records.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// Signal analysis.
    #[error("analysis: {0}")]
    Signal(#[from] SignalError),
    /// Results that cannot be written.
    #[error(transparent)]
    Format(#[from] FormatError),
    /// The report.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// A study, or one of its files, that failed.
    #[error("{what}")]
    Failed {
        /// What happened, and where.
        what: String,
        /// What to do about it.
        help: Option<String>,
    },
}

impl From<ModalError> for ComputeError {
    fn from(error: ModalError) -> Self {
        match error {
            ModalError::Linalg(error) => Self::Linalg(error),
            ModalError::Model(error) => Self::Model(error),
            error => Self::Modal(error),
        }
    }
}

impl ComputeError {
    /// Wrong input, and what to do about it.
    pub(crate) fn input(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Input { what: what.into(), help: Some(help.into()) }
    }

    /// What to do with a run that cannot go on.
    pub(crate) const ANEW: &'static str = "begin anew with --force";

    /// A study that failed, and what to do about it.
    pub(crate) fn failed(what: impl Into<String>, help: impl Into<String>) -> Self {
        Self::Failed { what: what.into(), help: Some(help.into()) }
    }

    /// A file or folder that the system does not let read or write.
    pub(crate) fn io(path: &Path) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.to_owned();
        move |source| Self::Failed { what: format!("{}: {source}", path.display()), help: None }
    }

    /// The error of what stands at a `place` of the case, which ends with a colon and a blank.
    pub(crate) fn bearing(place: impl Into<String>) -> impl FnOnce(BearingError) -> Self {
        |source| Self::Bearing { place: place.into(), source }
    }

    /// The error of an interface without a free displacement.
    pub(crate) fn interface_held(nodes: &NodeInterface, model: &HousingModel) -> Self {
        Self::InterfaceHeld { displacements: nodes.held.len(), holders: nodes.holders(model) }
    }

    /// What to do about it, where the message does not say it already.
    pub(crate) fn help(&self) -> Option<String> {
        match self {
            Self::Input { help, .. } => help.clone(),
            Self::Case(error) => error.help(),
            Self::Measured(error) => error.help(),
            Self::OtherMesh { source, .. } => source.help(),
            Self::Format(FormatError::CutColumn { .. }) => Some(Self::ANEW.to_owned()),
            Self::InterfaceHeld { .. } => Some(
                "name other nodes in condense.interface, or take the support off them".to_owned(),
            ),
            Self::LooseInterior { .. } => Some(
                "join the part (merge its nodes in gmsh, housing.links), hold it (housing.supports), put three of its nodes \
                 that are not in line into the interface, or leave it out of housing.parts"
                    .to_owned(),
            ),
            Self::Modal(ModalError::NoModes { .. }) => Some(
                "another band, or `modes.count = 1`, which finds the lowest wherever it is".to_owned(),
            ),
            Self::SoftPart { .. } => Some(
                "check the units of the springs that hold it and its flattest elements (`plummer inspect`); hold it by \
                 stiffer springs or a link, or leave it out of housing.parts"
                    .to_owned(),
            ),
            Self::ModeShapes(FormatError::File(FileError::Content {
                path,
                fault: Fault { place: Place::Line(_), .. },
            })) if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("csv")) => Some(
                "frequencies without shapes are checked by `modes.expected` in the case file".to_owned(),
            ),
            Self::Compared { source, .. } if matches!(**source, ModalError::TooFewPoints { .. }) => Some(
                "points are in m; `points_within` beside `file` is the distance up to which two are one".to_owned(),
            ),
            Self::Failed { help, .. } => help.clone(),
            Self::MeshChanged { .. } => {
                Some("run the command again when the mesh is complete".to_owned())
            }
            _ => None,
        }
    }

    /// Whether the input is wrong, rather than the computation failed.
    pub(crate) fn is_input(&self) -> bool {
        match self {
            Self::Reduction(error) => !matches!(error, ReductionError::Linalg(_)),
            Self::System(error) => matches!(error, SystemError::Refused(_) | SystemError::NoModesKept { .. }),
            Self::Transient(error) => !matches!(error, TransientError::BlewUp(_)),
            Self::Linalg(error) => matches!(error, LinalgError::TooManyModes { .. } | LinalgError::NoFrequency { .. }),
            Self::Modal(error) => !matches!(error, ModalError::Linalg(_)),
            Self::OtherMesh { source, .. } => source.is_input(),
            Self::Signal(_) => true,
            Self::Format(error) => matches!(error, FormatError::CutColumn { .. }),
            Self::Failed { .. } | Self::Interrupted { .. } | Self::File(_) => false,
            Self::MeshChanged { .. } | Self::Series(_) | Self::Report(_) => false,
            _ => true,
        }
    }
}
