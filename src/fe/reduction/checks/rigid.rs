//! Rigid-body motions of a superelement, and its mass properties, against those of the mesh.

use super::super::parts::symmetric;
use super::matrices::{largest, pairs};
use super::{Check, CraigBampton, InterfaceReduction, ReductionError, Superelement};
use crate::fe::assembly::SystemMatrices;
use crate::numerics::linalg::{DenseMatrix, acting_generalised_eigen, sparse_times_dense, symmetric_eigen, times};

/// Energy of a motion that the matrices let pass, relative to the sum of the magnitudes of its terms: round-off of a sum
/// of many terms.
const FREE: f64 = 1e-10;

/// Frequency of a rigid mode beside the first elastic one: the limit that the field uses for a tie that carries rigid
/// motions.
const RIGID: f64 = 1e-5;

/// Frequency of the lowest mode of a held housing beside its first fixed-interface one, below which it is a mechanism.
const HELD: f64 = 1e-6;

/// Motions and masses, relative: they come from solutions with ten digits.
const PROPERTIES: f64 = 1e-7;

/// Unit rigid motions of a housing (3 in the plane, 6 in space), at its degrees of freedom and at the interface.
#[derive(Debug, Clone)]
pub struct RigidMotions {
    /// Over all degrees of freedom of the housing, in the axes of its matrices [dof x r].
    pub housing: DenseMatrix,
    /// Over the interface coordinates [interface x r].
    pub interface: DenseMatrix,
}

impl RigidMotions {
    /// The motions of the interface that nothing holds [interface x free].
    ///
    /// # Errors
    /// What the dense eigenvalue solver reports.
    pub(crate) fn free_interface(
        &self,
        condensed: &CraigBampton,
        matrices: &SystemMatrices,
    ) -> Result<DenseMatrix, ReductionError> {
        Ok(&self.interface * self.free(condensed, matrices)?)
    }

    pub(super) fn checks(
        &self,
        condensed: &CraigBampton,
        reduction: Option<&InterfaceReduction>,
        matrices: &SystemMatrices,
    ) -> Result<Vec<Check>, ReductionError> {
        let free = self.free(condensed, matrices)?;
        let element = reduction.map_or(&condensed.superelement, |reduced| &reduced.superelement);
        let mut checks = vec![zero_modes(condensed, element, free.ncols())];
        checks.extend(self.effective_mass(condensed));
        if free.ncols() == 0 {
            return Ok(checks);
        }
        let interface = &self.interface * &free;
        let housing = self.moving(condensed) * &free;
        let whole =
            faer::concat![[interface.as_ref()], [DenseMatrix::zeros(condensed.basis.count(), interface.ncols())]];
        // round-off of k is that of the large terms that it was summed from, on the interface itself
        let made_of = &condensed.substructure.made_of;
        let scale = largest((0..interface.ncols()).map(|motion| -> f64 {
            made_of.iter().enumerate().map(|(row, made_of)| made_of * interface[(row, motion)].powi(2)).sum()
        }));
        let scale = scale.max(magnitude(&whole, &condensed.superelement.stiffness));
        let (coordinates, on_interface) = match reduction {
            Some(reduced) => {
                let nearest = reduced.nearest(&interface);
                let expanded = &reduced.transform * &nearest;
                (nearest, expanded)
            }
            None => (whole.clone(), whole),
        };
        let field = condensed.field(&on_interface, housing.nrows());
        let (k, m) = (&element.stiffness, &element.mass);
        let partition = &condensed.substructure.partition;
        let dofs = || partition.interior.iter().chain(&partition.driven);
        let difference = largest(dofs().flat_map(|&dof| {
            let (field, housing) = (&field, &housing);
            (0..field.ncols()).map(move |column| field[(dof, column)] - housing[(dof, column)])
        }));
        let energy = coordinates.transpose() * (k * &coordinates);
        let reduced = coordinates.transpose() * (m * &coordinates);
        let full = housing.transpose() * sparse_times_dense(&matrices.mass, &housing);
        checks.extend([
            Check::at_most(
                "rigid motions carried",
                "largest difference of the field from the rigid motion, relative to the motion",
                difference / housing.norm_max().max(f64::MIN_POSITIVE),
                PROPERTIES,
            ),
            Check::at_most(
                "rigid energy",
                "strain energy of the rigid motions, relative to what it is summed from",
                largest((0..energy.ncols()).map(|motion| energy[(motion, motion)])) / scale,
                FREE,
            ),
            Check::at_most(
                "mass properties",
                "largest difference of the rigid-body mass matrix from the mesh's, relative to both diagonals",
                largest(pairs(full.ncols()).map(|(row, column)| {
                    (reduced[(row, column)] - full[(row, column)]) / (full[(row, row)] * full[(column, column)]).sqrt()
                })),
                PROPERTIES,
            ),
        ]);
        Ok(checks)
    }

    /// The motions over what is not fixed [dof x r].
    fn moving(&self, condensed: &CraigBampton) -> DenseMatrix {
        let partition = &condensed.substructure.partition;
        let mut moving = DenseMatrix::zeros(self.housing.nrows(), self.housing.ncols());
        for &dof in partition.interior.iter().chain(&partition.driven) {
            for motion in 0..moving.ncols() {
                moving[(dof, motion)] = self.housing[(dof, motion)];
            }
        }
        moving
    }

    /// Combinations of the motions that nothing holds [r x free].
    fn free(&self, condensed: &CraigBampton, matrices: &SystemMatrices) -> Result<DenseMatrix, ReductionError> {
        let moving = self.moving(condensed);
        let energy = moving.transpose() * sparse_times_dense(&matrices.stiffness, &moving);
        let count = energy.ncols();
        let scale: Vec<f64> = (0..count)
            .map(|motion| {
                let column = moving.subcols(motion, 1).to_owned();
                sparse_magnitude(&column, matrices).max(f64::MIN_POSITIVE).sqrt()
            })
            .collect();
        let energy = symmetric(&energy);
        let scaled =
            DenseMatrix::from_fn(count, count, |row, column| energy[(row, column)] / (scale[row] * scale[column]));
        let spectrum = symmetric_eigen(&scaled)?;
        let free = spectrum.values.partition_point(|&value| value <= FREE);
        Ok(DenseMatrix::from_fn(count, free, |row, column| spectrum.vectors[(row, column)] / scale[row]))
    }

    /// Effective mass of the interior vectors against the mass that they can have: `sum_j (q_j^T M_ii r)^2 <= r^T
    /// M_ii r` (Bessel), of every unit motion.
    fn effective_mass(&self, condensed: &CraigBampton) -> Option<Check> {
        let substructure = &condensed.substructure;
        if condensed.basis.count() == 0 {
            return None;
        }
        let motions = condensed.interior_of(&self.housing);
        let moved = substructure.interior.mass_times(&motions);
        let factors = times(condensed.basis.vectors.transpose(), moved.as_ref());
        let shares: Vec<f64> = (0..motions.ncols())
            .map(|motion| {
                let kept: f64 = (0..factors.nrows()).map(|q| factors[(q, motion)].powi(2)).sum();
                let all: f64 =
                    motions.col_as_slice(motion).iter().zip(moved.col_as_slice(motion)).map(|(x, y)| x * y).sum();
                if all > 0.0 { kept / all } else { 0.0 }
            })
            .collect();
        let listed: Vec<String> = shares.iter().map(|share| format!("{:.1} %", 100.0 * share)).collect();
        Some(Check::at_most(
            "effective mass",
            format!(
                "largest effective mass of the interior's vectors / mass of the interior; of each rigid motion: {}",
                listed.join(", ")
            ),
            largest(shares.into_iter()),
            1.0 + PROPERTIES,
        ))
    }
}

/// The modes that should be rigid, and that there is none more.
fn zero_modes(condensed: &CraigBampton, element: &Superelement, expected: usize) -> Check {
    // matrices that have no modes fail here too, and say why among the checks of the matrices
    let values = acting_generalised_eigen(&element.stiffness, &element.mass)
        .map_or(vec![f64::NAN; expected + 1], |modes| modes.values);
    let at = |place: usize| values.get(place).copied().unwrap_or(f64::INFINITY);
    let elastic = at(expected);
    if expected > 0 {
        let rigid = largest((0..expected).map(at));
        return Check::at_most(
            "rigid modes",
            format!("frequency of the {expected} rigid modes / first elastic frequency"),
            if elastic > 0.0 { (rigid / elastic).sqrt() } else { f64::INFINITY },
            RIGID,
        );
    }
    let fixed = condensed.basis.values().first().copied().unwrap_or(condensed.basis.complete_below);
    Check::at_least(
        "held",
        "lowest frequency / first fixed-interface frequency; below the limit the housing is a mechanism",
        if elastic > 0.0 { (elastic / fixed).sqrt() } else { 0.0 },
        HELD,
    )
}

/// Largest `|x|^T |A| |x|` of the columns.
fn magnitude(x: &DenseMatrix, a: &DenseMatrix) -> f64 {
    let of = |motion: usize| -> f64 {
        let terms = pairs(a.nrows());
        terms.map(|(row, column)| (x[(row, motion)] * a[(row, column)] * x[(column, motion)]).abs()).sum()
    };
    largest((0..x.ncols()).map(of)).max(f64::MIN_POSITIVE)
}

/// `|x|^T |K| |x|`.
fn sparse_magnitude(x: &DenseMatrix, matrices: &SystemMatrices) -> f64 {
    let x = x.col_as_slice(0);
    let of_column = |(column, entries): (usize, sprs::CsVecView<'_, f64>)| {
        entries.iter().map(|(row, value)| (x[row] * value).abs()).sum::<f64>() * x[column].abs()
    };
    matrices.stiffness.outer_iterator().enumerate().map(of_column).sum()
}
