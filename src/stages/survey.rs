//! The modes of a case's housing, ring, or both, without contact and in full: nothing condensed.

use super::{HousingStage, StageError, StructureStage, Watch};
use crate::assembly::{CoupledMatrices, SystemMatrices};
use crate::case::ModeExtent;
use crate::linalg::{DenseMatrix, EigenProblem, SparseMatrix, TripletBuilder, sparse_times_dense};
use crate::mesh::Mesh;
use crate::modal::{
    EnergyShares, MassProperties, Mechanisms, ModalBasis, ModalError, ModeRange, Participation,
    over_all_dofs, rigid_motions,
};
use crate::model::{HousingModel, Ring, RingFrame};

/// Modes and all that is said of them.
#[derive(Debug, Clone)]
pub struct ModalSurvey {
    /// Degrees of freedom of ring and housing, fixed and tied ones included.
    pub dof: usize,
    /// Degrees of freedom that the modes were computed over.
    pub free_dof: usize,
    /// The modes with their proof.
    pub basis: ModalBasis,
    /// Mass, centroid and inertia, in the mesh's axes (of a ring alone: in its own).
    pub mass: MassProperties,
    /// Participation factors and effective masses, rotations about the centroid.
    pub participation: Participation,
    /// Where the energy of each mode is; of a housing alone, of several parts or on springs.
    pub shares: Option<EnergyShares>,
    /// Why modes without strain exist; of a housing alone, `None` too if it falls into too many bodies.
    pub mechanisms: Option<Mechanisms>,
    /// Displacements of the housing's degrees of freedom in the mesh's axes [dof x count].
    pub housing: Option<DenseMatrix>,
    /// How the ring moves.
    pub ring: Option<RingShapes>,
}

/// Displacements of a ring's nodes in the mesh's axes.
#[derive(Debug, Clone, PartialEq)]
pub struct RingShapes {
    /// The nodes, m.
    pub points: Vec<[f64; 3]>,
    /// Displacements, by mode and node.
    pub displacements: Vec<Vec<[f64; 3]>>,
}

/// Matrices with what the analysis of their modes needs.
struct System {
    stiffness: SparseMatrix,
    mass: SparseMatrix,
    free: Vec<usize>,
    dof: usize,
}

impl ModalSurvey {
    /// Modes of a housing alone; its matrices are used up.
    ///
    /// # Errors
    /// [`StageError`] of eigenvalue computation and analysis.
    pub fn of_housing(
        mesh: &Mesh,
        model: &HousingModel,
        matrices: SystemMatrices,
        extent: ModeExtent,
        watch: &impl Watch,
    ) -> Result<Self, StageError> {
        let mass = MassProperties::of_housing(&matrices, model)?;
        let rigid = rigid_motions(model.coordinates(), model.dimension(), centroid(&mass));
        let system = System {
            free: model.free_dofs(),
            dof: model.dof(),
            stiffness: matrices.stiffness,
            mass: matrices.mass,
        };
        let (basis, all, participation, free_dof) = system.solve(extent, &rigid, watch)?;
        watch.stage("analyse");
        let free = model.free_dofs();
        let shapes = over_all_dofs(model, &free, &rows(&all, &free))?;
        // one part without springs has all of the energy
        let several = model.part_names().len() > 1 || !model.spring_nodes().is_empty();
        let shares = several
            .then(|| EnergyShares::new(mesh, model, &shapes, basis.rigid_modes))
            .transpose()?;
        let mechanisms = match Mechanisms::find(mesh, model) {
            Ok(found) => Some(found),
            Err(ModalError::TooManyBodies { .. }) => None,
            Err(error) => return Err(error.into()),
        };
        Ok(Self {
            dof: model.dof(),
            free_dof,
            basis,
            mass,
            participation,
            shares,
            mechanisms,
            housing: Some(shapes),
            ring: None,
        })
    }

    /// Modes of a ring, in a housing if the case has one.
    ///
    /// # Errors
    /// [`StageError`] of eigenvalue computation and analysis.
    pub fn of_structure(
        stage: &StructureStage,
        extent: ModeExtent,
        watch: &impl Watch,
    ) -> Result<Self, StageError> {
        let ring = stage.structure.ring();
        match (&stage.housing, &stage.tie) {
            (Some(housing), Some(tie)) => {
                let coupled = CoupledMatrices::new(&housing.matrices, tie, ring);
                Self::of_coupled(housing, ring, coupled, extent, watch)
            }
            _ => Self::of_ring(ring, extent, watch),
        }
    }

    fn of_coupled(
        housing: &HousingStage,
        ring: &Ring,
        coupled: CoupledMatrices,
        extent: ModeExtent,
        watch: &impl Watch,
    ) -> Result<Self, StageError> {
        let (model, frame) = (&housing.model, housing.model.frame());
        let rigid_about = |about: [f64; 3]| {
            let of_housing = rigid_motions(model.coordinates(), model.dimension(), about);
            coupled.coordinates(&of_housing, &ring_motions(ring, frame, about))
        };
        let inertia = |about: [f64; 3]| {
            let rigid = rigid_about(about);
            let inertia = rigid.transpose() * sparse_times_dense(&coupled.mass, &rigid);
            MassProperties::from_rigid_inertia(&inertia, about)
        };
        // a second time about the centroid itself, where nothing is left to subtract
        let mass = inertia(centroid(&inertia(frame.centre())?))?;
        let rigid = rigid_about(centroid(&mass));
        let system = System {
            free: coupled.free_dofs.clone(),
            dof: coupled.mass.rows(),
            stiffness: coupled.stiffness.clone(),
            mass: coupled.mass.clone(),
        };
        let (basis, all, participation, free_dof) = system.solve(extent, &rigid, watch)?;
        watch.stage("analyse");
        Ok(Self {
            dof: model.dof() + ring.dof(),
            free_dof,
            basis,
            mass,
            participation,
            shares: None,
            mechanisms: None,
            housing: Some(coupled.housing(model, &all)),
            ring: Some(RingShapes::new(ring, frame, &coupled.ring(&all))),
        })
    }

    fn of_ring(ring: &Ring, extent: ModeExtent, watch: &impl Watch) -> Result<Self, StageError> {
        let frame = RingFrame::default();
        let rigid = ring_motions(ring, &frame, [0.0; 3]);
        let system = System {
            free: (0..ring.dof()).collect(),
            dof: ring.dof(),
            stiffness: sparse(ring.stiffness()),
            mass: sparse(ring.mass()),
        };
        let inertia = rigid.transpose() * sparse_times_dense(&system.mass, &rigid);
        let mass = MassProperties::from_rigid_inertia(&inertia, [0.0; 3])?;
        let (basis, all, participation, free_dof) = system.solve(extent, &rigid, watch)?;
        Ok(Self {
            dof: ring.dof(),
            free_dof,
            basis,
            mass,
            participation,
            shares: None,
            mechanisms: None,
            housing: None,
            ring: Some(RingShapes::new(ring, &frame, &all)),
        })
    }
}

impl System {
    /// Modes, their shapes over all rows, and their participation. The stiffness is gone before it is factorised.
    fn solve(
        self,
        extent: ModeExtent,
        rigid: &DenseMatrix,
        watch: &impl Watch,
    ) -> Result<(ModalBasis, DenseMatrix, Participation, usize), StageError> {
        let Self {
            stiffness,
            mass,
            free,
            dof,
        } = self;
        watch.stage("order");
        let problem = EigenProblem::restricted(&stiffness, &mass, &free)?;
        drop(stiffness);
        watch.stage("eigen");
        let basis = ModalBasis::of(&problem, range(extent, free.len()))?;
        drop(problem);
        let mut all = DenseMatrix::zeros(dof, basis.count());
        for (row, &at) in free.iter().enumerate() {
            for mode in 0..basis.count() {
                all[(at, mode)] = basis.shapes[(row, mode)];
            }
        }
        let participation = Participation::of_normalised(&mass, &all, rigid)?;
        Ok((basis, all, participation, free.len()))
    }
}

impl RingShapes {
    fn new(ring: &Ring, frame: &RingFrame, shapes: &DenseMatrix) -> Self {
        let radius = ring.section().radius;
        let centre = frame.centre();
        let points = (0..ring.nodes()).map(|node| {
            let (sin, cos) = ring.node_angle(node).sin_cos();
            let arm = frame.vector_to_mesh([radius * cos, radius * sin, 0.0]);
            [0, 1, 2].map(|axis| centre[axis] + arm[axis])
        });
        let displacements = (0..shapes.ncols())
            .map(|mode| {
                let shape = shapes.col_as_slice(mode);
                (0..ring.nodes())
                    .map(|node| frame.vector_to_mesh(ring.node_displacement(node, shape)))
                    .collect()
            })
            .collect();
        Self {
            points: points.collect(),
            displacements,
        }
    }
}

fn range(extent: ModeExtent, free_dof: usize) -> ModeRange {
    match extent.of_model(free_dof) {
        ModeExtent::Count(count) => ModeRange::Count(count),
        ModeExtent::UpToHz(hz) => ModeRange::UpToHz(hz),
        ModeExtent::BandHz(band) => ModeRange::BandHz(band),
    }
}

fn centroid(mass: &MassProperties) -> [f64; 3] {
    mass.centroid().map(|component| component.unwrap_or(0.0))
}

/// Rigid motions of a ring [ring dof x 3 or 6] in the order of [`rigid_motions`]: along and about the mesh's axes.
fn ring_motions(ring: &Ring, frame: &RingFrame, about: [f64; 3]) -> DenseMatrix {
    let centre = frame.centre();
    let arm = [0, 1, 2].map(|axis| centre[axis] - about[axis]);
    let motion = |translation: [f64; 3], rotation: [f64; 3]| {
        let [x, y, z] = rotation;
        let carried = [
            y * arm[2] - z * arm[1],
            z * arm[0] - x * arm[2],
            x * arm[1] - y * arm[0],
        ];
        let of_centre = [0, 1, 2].map(|axis| translation[axis] + carried[axis]);
        ring.rigid_motion_in_space(frame.vector(of_centre), frame.vector(rotation))
    };
    let along = |axis: usize| {
        let mut unit = [0.0; 3];
        unit[axis] = 1.0;
        unit
    };
    let motions: Vec<Vec<f64>> = if ring.is_in_space() {
        let translations = (0..3).map(|axis| motion(along(axis), [0.0; 3]));
        let rotations = (0..3).map(|axis| motion([0.0; 3], along(axis)));
        translations.chain(rotations).collect()
    } else {
        let translations = (0..2).map(|axis| motion(along(axis), [0.0; 3]));
        let rotation = motion([0.0; 3], along(2));
        translations.chain([rotation]).collect()
    };
    DenseMatrix::from_fn(ring.dof(), motions.len(), |row, column| {
        motions[column][row]
    })
}

fn sparse(dense: &DenseMatrix) -> SparseMatrix {
    let mut entries = TripletBuilder::new(dense.nrows(), dense.ncols());
    for column in 0..dense.ncols() {
        for row in 0..dense.nrows() {
            if dense[(row, column)] != 0.0 {
                entries.add(row, column, dense[(row, column)]);
            }
        }
    }
    entries.build()
}

/// Some rows of a matrix.
fn rows(a: &DenseMatrix, chosen: &[usize]) -> DenseMatrix {
    DenseMatrix::from_fn(chosen.len(), a.ncols(), |row, column| {
        a[(chosen[row], column)]
    })
}
