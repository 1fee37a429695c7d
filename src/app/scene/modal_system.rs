//! Matrices of a case's housing, ring, or both in full, and their modes.

use super::housing::AssembledHousing;
use super::mode_set::{OwnModes, RingShapes};
use super::ring::ring_and_tie;
use super::watch::Watch;
use crate::app::case::{Case, DEFAULT_COUNT};
use crate::app::error::ComputeError;
use crate::fe::assembly::{CoupledMatrices, CoupledMotions};
use crate::fe::mesh::Mesh;
use crate::fe::modal::{ModalBasis, ModeRange, ModeSet, Participation};
use crate::fe::model::{HousingModel, Ring, RingFrame, RingTie};
use crate::numerics::linalg::{DenseMatrix, EigenProblem, scattered_rows, sparse_times_dense};

/// Housing and ring of a case, of which one may be missing.
pub(crate) struct Bodies {
    pub housing: Option<(Mesh, HousingModel)>,
    pub ring: Option<Ring>,
    pub tie: Option<RingTie>,
}

impl Bodies {
    /// The bodies and the matrices of all together; those of the housing alone are gone.
    ///
    /// # Errors
    /// [`ComputeError`] of mesh, model, elements, ring and tie.
    pub fn assemble(
        case: &Case,
        watch: &impl Watch,
    ) -> Result<(Self, CoupledMatrices), ComputeError> {
        let Some(asked) = &case.ring else {
            let housing = AssembledHousing::of(case, watch)?;
            let matrices = CoupledMatrices::of_housing(housing.matrices, &housing.model);
            let bodies = Self {
                housing: Some((housing.mesh, housing.model)),
                ring: None,
                tie: None,
            };
            return Ok((bodies, matrices));
        };
        let housing = AssembledHousing::build(case, watch)?;
        let (ring, tie) = ring_and_tie(case, asked, housing.as_ref())?;
        watch.stage("couple");
        let matrices = match (&housing, &tie) {
            (Some(housing), Some(tie)) => CoupledMatrices::new(&housing.matrices, tie, &ring),
            _ => CoupledMatrices::of_ring(&ring),
        };
        let bodies = Self {
            housing: housing.map(|housing| (housing.mesh, housing.model)),
            ring: Some(ring),
            tie,
        };
        Ok((bodies, matrices))
    }

    /// Modes at the nodes of the mesh and of the ring.
    pub fn mode_set(&self, modes: &FullModes) -> ModeSet {
        let all = modes.over_all_rows();
        let housing = self.housing.as_ref();
        let moved = housing.map(|(_, model)| modes.motions.housing(model, &all));
        let of_ring = self
            .ring
            .as_ref()
            .map(|ring| RingShapes::new(ring, &self.frame(), &modes.motions.ring(&all)));
        let with_shapes = housing.zip(moved.as_ref());
        let own = OwnModes {
            frequencies_hz: &modes.basis.frequencies_hz,
            housing: with_shapes.map(|((mesh, model), moved)| (mesh, model, moved)),
            ring: of_ring.as_ref(),
        };
        own.set()
    }

    /// Where the ring sits: in the mesh's axes, or in its own.
    pub fn frame(&self) -> RingFrame {
        let housing = self.housing.as_ref();
        housing.map_or_else(RingFrame::default, |(_, model)| *model.frame())
    }
}

/// Modes of a housing, a ring, or both.
pub(crate) struct FullModes {
    /// The modes over the free degrees of freedom.
    pub basis: ModalBasis,
    /// What the coordinates mean.
    pub motions: CoupledMotions,
    free: Vec<usize>,
    rows: usize,
}

impl FullModes {
    /// Modes over the free rows, at least one. The matrices are gone before they are factorised.
    ///
    /// # Errors
    /// [`ComputeError::Linalg`], [`ComputeError::NoModes`].
    pub fn of(
        matrices: CoupledMatrices,
        extent: ModeRange,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let solve = |problem: &EigenProblem, range, _: &CoupledMotions, _: &[usize], _| {
            Ok(ModalBasis::of(problem, range)?)
        };
        Self::by(matrices, extent, solve, watch)
    }

    /// Modes as `solve` finds them: from the problem over the free rows and the range, with what the coordinates mean, the free rows and the
    /// number of all.
    fn by(
        matrices: CoupledMatrices,
        extent: ModeRange,
        solve: impl FnOnce(
            &EigenProblem,
            ModeRange,
            &CoupledMotions,
            &[usize],
            usize,
        ) -> Result<ModalBasis, ComputeError>,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let CoupledMatrices {
            stiffness,
            mass,
            free_dofs: free,
            motions,
        } = matrices;
        let rows = mass.rows();
        watch.stage("order");
        let problem = EigenProblem::restricted(&stiffness, &mass, &free)?;
        drop((stiffness, mass));
        watch.stage("eigen");
        let basis = solve(&problem, range(extent, free.len()), &motions, &free, rows)?;
        if basis.count() == 0 {
            return Err(ComputeError::NoModes { extent });
        }
        Ok(Self {
            basis,
            motions,
            free,
            rows,
        })
    }

    /// Modes with those near zero by the energies of elements, their shapes over all rows, and their participation in
    /// the unit motions `rigid`. `products` gives `Phi^T K Phi` of shapes over all rows, element by element.
    ///
    /// # Errors
    /// [`ComputeError::Linalg`], and what `products` reports.
    pub fn analysed(
        matrices: CoupledMatrices,
        extent: ModeRange,
        rigid: &DenseMatrix,
        products: impl Fn(&CoupledMotions, &DenseMatrix) -> Result<DenseMatrix, ComputeError>,
        watch: &impl Watch,
    ) -> Result<(Self, DenseMatrix, Participation), ComputeError> {
        let moved = sparse_times_dense(&matrices.mass, rigid);
        let solve =
            |problem: &EigenProblem, range, motions: &CoupledMotions, free: &[usize], rows| {
                ModalBasis::sharpened(problem, range, |shapes| {
                    products(motions, &scattered_rows(shapes, free, rows))
                })
            };
        let modes = Self::by(matrices, extent, solve, watch)?;
        let all = modes.over_all_rows();
        let participation = Participation::of_normalised(&moved, &all, rigid)?;
        Ok((modes, all, participation))
    }

    /// The lowest `count` modes, or all if there are fewer.
    ///
    /// # Errors
    /// [`ComputeError::Linalg`].
    pub fn lowest(
        matrices: CoupledMatrices,
        count: usize,
        watch: &impl Watch,
    ) -> Result<Self, ComputeError> {
        let count = count.min(matrices.free_dofs.len()).max(1);
        Self::of(matrices, ModeRange::Count(count), watch)
    }

    /// Computes the modes near zero again by the energies of elements: `products` as above.
    ///
    /// # Errors
    /// What `products` reports, and [`ComputeError::Linalg`].
    pub fn sharpen(
        &mut self,
        products: impl Fn(&CoupledMotions, &DenseMatrix) -> Result<DenseMatrix, ComputeError>,
    ) -> Result<(), ComputeError> {
        let Self {
            basis,
            motions,
            free,
            rows,
        } = self;
        basis.sharpen(|shapes| products(motions, &scattered_rows(shapes, free, *rows)))
    }

    /// Number of degrees of freedom that the modes were computed over.
    pub fn free_dof(&self) -> usize {
        self.free.len()
    }

    /// Shapes over all rows of the matrices [rows x count].
    pub fn over_all_rows(&self) -> DenseMatrix {
        scattered_rows(&self.basis.shapes, &self.free, self.rows)
    }
}

/// The modes of a model with so many degrees of freedom: fewer than the case's default if it has fewer. What was asked for by name stays.
fn range(extent: ModeRange, free_dof: usize) -> ModeRange {
    match extent {
        ModeRange::Count(DEFAULT_COUNT) => ModeRange::Count(DEFAULT_COUNT.min(free_dof).max(1)),
        asked => asked,
    }
}
