//! What the interior of a condensed housing may do while the interface is held.
//!
//! Fixed-interface modes alone converge slowly where the interface is stiff: every mode that is left out is missing as
//! a static correction. Residual vectors put that correction back for the modes that matter (see `residual`). Both
//! kinds stand in one basis Q with
//!
//! ```text
//! Q^T M_ii Q = 1,    Q^T K_ii Q = diag(values)
//! ```
//!
//! so that a superelement looks the same with or without them: K_bq = 0, M_qq = 1, static response exact.
//!
//! Modes of a condensed housing with what is attached to its interface, and how far they miss their equations.
//!
//! The vectors that a basis is made of: fixed-interface modes, and residual vectors for modes of the coupled structure.
//!
//! A residual vector `K_ii^-1 r` is the static response of the interior to what a mode of the reduced structure lacks:
//! the residual flexibility of all modes left out, applied to the inertia that this mode puts on them. (Residual
//! flexibility: MacNeal, Computers and Structures 1 (1971) 581-601. Kim and Lee, International Journal for Numerical
//! Methods in Engineering 103 (2015) 79-93, fold it into the constraint modes instead, at no coordinate; that takes
//! m^-1 k of the reduced structure, whose highest eigenvalues drown the correction where a ring of beams is attached.)

use super::parts::{diagonal, normalised, symmetric};
use super::{ReductionError, Substructure};
use crate::numerics::Watch;
use crate::numerics::linalg::{
    DenseMatrix, EigenPairs, SymmetricSpectrum, symmetric_eigen, symmetric_generalised_eigen, times,
};
use faer::MatRef;

/// Directions of new vectors that are dropped as dependent: squared length, relative to the longest.
const DEPENDENT: f64 = 1e-12;

/// Length of a vector beside what it was before the projection, below which it is round-off: it lay in the basis.
const CONTAINED: f64 = 1e-9;

/// A mode is quasi-static up to this share of the first fixed-interface eigenvalue: what the interior's inertia does in it
/// is below that share, and so are its residual and its relative error. Among them are the rigid modes.
const QUASI_STATIC: f64 = 1e-10;

/// Vectors of the interior with their Ritz values.
#[derive(Debug, Clone)]
pub struct InteriorBasis {
    /// The vectors Q [interior x q].
    pub(super) vectors: DenseMatrix,
    pub(super) values: Vec<f64>,
    /// `Q^T A` [q x interface]: how the interface's accelerations drive them, kg^(1/2).
    pub(super) participation: DenseMatrix,
    /// How many of the vectors are residual vectors.
    pub(crate) residual_vectors: usize,
    /// Eigenvalue of the lowest fixed-interface mode that is left out, 1/s^2; infinite if none is.
    pub(crate) complete_below: f64,
}

impl InteriorBasis {
    /// The first `count` of some fixed-interface modes, of which one more is known unless there are no more.
    pub fn of_modes(substructure: &Substructure, pairs: &EigenPairs, count: usize) -> Self {
        let count = count.min(pairs.values.len());
        let vectors = pairs.vectors.subcols(0, count).to_owned();
        Self {
            participation: substructure.follow_transposed(&vectors).transpose().to_owned(),
            values: pairs.values[..count].to_vec(),
            vectors,
            residual_vectors: 0,
            complete_below: pairs.values.get(count).copied().unwrap_or(f64::INFINITY),
        }
    }

    /// Number of vectors q.
    pub fn count(&self) -> usize {
        self.values.len()
    }

    /// Ritz values `q_j^T K_ii q_j`, 1/s^2, ascending; those of a basis of modes are their squared frequencies.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Eigenvalue up to which a mode of the coupled structure is quasi-static, 1/s^2.
    pub(super) fn quasi_static(&self) -> f64 {
        QUASI_STATIC * self.lowest_value()
    }

    /// The lowest fixed-interface eigenvalue, kept or left out, 1/s^2.
    pub(super) fn lowest_value(&self) -> f64 {
        let kept = self.values.first().copied().unwrap_or(f64::INFINITY);
        kept.min(self.complete_below)
    }

    /// The basis with further vectors `z` [interior x k], made orthogonal to it and to each other. Vectors that it
    /// contains add nothing.
    ///
    /// # Errors
    /// [`ReductionError::Linalg`] for vectors that are not finite.
    pub(crate) fn extended(&self, substructure: &Substructure, mut z: DenseMatrix) -> Result<Self, ReductionError> {
        // what is left of vectors that lie almost in the basis is made long again, and with it what round-off left in
        // the basis; twice is enough (Parlett, The Symmetric Eigenvalue Problem, section 6.9)
        for _ in 0..2 {
            z = self.independent(substructure, z)?;
        }
        self.joined(substructure, &z)
    }

    /// Of vectors `z` [interior x k] what is orthogonal to the basis, orthonormal.
    fn independent(&self, substructure: &Substructure, mut z: DenseMatrix) -> Result<DenseMatrix, ReductionError> {
        let before = lengths(&substructure.interior.mass_times(&z), &z);
        let inside = times(self.vectors.transpose(), substructure.interior.mass_times(&z).as_ref());
        z -= times(self.vectors.as_ref(), inside.as_ref());
        let after = lengths(&substructure.interior.mass_times(&z), &z);
        let new: Vec<usize> = (0..z.ncols()).filter(|&column| after[column] > CONTAINED * before[column]).collect();
        let z = DenseMatrix::from_fn(z.nrows(), new.len(), |row, column| z[(row, new[column])] / after[new[column]]);
        let gram = times(z.transpose(), substructure.interior.mass_times(&z).as_ref());
        Ok(times(z.as_ref(), normalised(&gram, DEPENDENT)?.as_ref()))
    }

    /// The basis with orthonormal vectors that are orthogonal to it, turned to its Ritz vectors.
    fn joined(&self, substructure: &Substructure, z: &DenseMatrix) -> Result<Self, ReductionError> {
        let q = self.count();
        let stiff = substructure.interior.stiffness_times(z);
        let coupling = times(self.vectors.transpose(), stiff.as_ref());
        let own = times(z.transpose(), stiff.as_ref());
        let stiffness = faer::concat![[diagonal(&self.values), coupling], [coupling.transpose(), symmetric(&own)]];
        let ritz = symmetric_eigen(&stiffness)?;
        let (old, new) = (ritz.vectors.subrows(0, q), ritz.vectors.subrows(q, z.ncols()));
        let of_new = substructure.follow_transposed(z);
        Ok(Self {
            vectors: times(self.vectors.as_ref(), old) + times(z.as_ref(), new),
            participation: old.transpose() * &self.participation + new.transpose() * of_new.transpose(),
            values: ritz.values,
            residual_vectors: self.residual_vectors + z.ncols(),
            complete_below: self.complete_below,
        })
    }
}

/// Root of `x^T (M x)` of every column.
fn lengths(moved: &DenseMatrix, x: &DenseMatrix) -> Vec<f64> {
    (0..x.ncols())
        .map(|column| {
            let (x, moved) = (x.col_as_slice(column), moved.col_as_slice(column));
            let square: f64 = x.iter().zip(moved).map(|(x, y)| x * y).sum();
            square.max(0.0).sqrt()
        })
        .collect()
}

/// What is attached to an interface: a bearing's ring with its springs.
#[derive(Debug, Clone, Copy)]
pub struct Attached<'a> {
    /// Stiffness [interface x interface], N/m.
    pub stiffness: &'a DenseMatrix,
    /// Mass [interface x interface], kg.
    pub mass: &'a DenseMatrix,
}

/// k_bb and m_bb of a housing with what is attached [interface x interface].
pub(super) fn interface_matrices(substructure: &Substructure, attached: Option<Attached<'_>>) -> [DenseMatrix; 2] {
    let (k, m) = (substructure.stiffness(), &substructure.mass);
    attached.map_or_else(|| [k.clone(), m.clone()], |part| [k + part.stiffness, m + part.mass])
}

/// Matrices k, m of an interface, on `c` coordinates [c x c], and a basis, whose amplitudes come after them; `driven` is how
/// the coordinates' accelerations drive these [q x c].
pub(super) fn with_amplitudes(
    [k_cc, m_cc]: [MatRef<'_, f64>; 2],
    basis: &InteriorBasis,
    driven: MatRef<'_, f64>,
) -> [DenseMatrix; 2] {
    let q = basis.count();
    let none = DenseMatrix::zeros(k_cc.nrows(), q);
    let unit = DenseMatrix::identity(q, q);
    [
        faer::concat![[k_cc, none], [none.transpose(), diagonal(basis.values())]],
        faer::concat![[m_cc, driven.transpose()], [driven, unit]],
    ]
}

/// Matrices k, m [order x order] of a basis: the interface first, then the amplitudes of the interior's vectors.
pub(super) fn reduced_matrices(
    substructure: &Substructure,
    basis: &InteriorBasis,
    attached: Option<Attached<'_>>,
) -> [DenseMatrix; 2] {
    let [k_bb, m_bb] = interface_matrices(substructure, attached);
    with_amplitudes([k_bb.as_ref(), m_bb.as_ref()], basis, basis.participation.as_ref())
}

/// All modes of a condensed housing with what is attached to it.
pub(super) fn coupled_modes(
    substructure: &Substructure,
    basis: &InteriorBasis,
    attached: Option<Attached<'_>>,
) -> Result<SymmetricSpectrum, ReductionError> {
    let [k, m] = reduced_matrices(substructure, basis, attached);
    Ok(symmetric_generalised_eigen(&k, &m)?)
}

/// Inertia of the interior per unit of squared frequency, `A u_b + M_ii Q eta` [interior x k], of motions of the condensed
/// housing [order x k].
pub(super) fn interior_inertia(
    substructure: &Substructure,
    basis: &InteriorBasis,
    coordinates: &DenseMatrix,
) -> DenseMatrix {
    let interface = substructure.interface_dof();
    let amplitudes = coordinates.subrows(interface, basis.count());
    substructure.follow(&coordinates.subrows(0, interface).to_owned())
        + substructure.interior.mass_times(&times(basis.vectors.as_ref(), amplitudes))
}

/// What the interior's equations lack, for modes `chosen` of `modes` [interior x chosen]:
///
/// ```text
/// r = lambda (M_ib u_b + M_ii u_i) - (K_ib u_b + K_ii u_i)     with u_i = Psi u_b + Q eta
///   = lambda (A u_b + M_ii Q eta) - K_ii Q eta
/// ```
///
/// The interface's equations hold exactly. `K_ii^-1 r` is what the interior would move further: the residual vector.
pub(super) fn interior_residuals(
    substructure: &Substructure,
    basis: &InteriorBasis,
    modes: &SymmetricSpectrum,
    chosen: &[usize],
) -> DenseMatrix {
    let coordinates =
        DenseMatrix::from_fn(modes.vectors.nrows(), chosen.len(), |row, column| modes.vectors[(row, chosen[column])]);
    let mut residual = interior_inertia(substructure, basis, &coordinates);
    let amplitudes = coordinates.subrows(substructure.interface_dof(), basis.count());
    let stiff = substructure.interior.stiffness_times(&times(basis.vectors.as_ref(), amplitudes));
    for (column, &mode) in chosen.iter().enumerate() {
        let lambda = modes.values[mode];
        let stiff = stiff.col_as_slice(column);
        for (entry, stiff) in residual.col_as_slice_mut(column).iter_mut().zip(stiff) {
            *entry = lambda * *entry - stiff;
        }
    }
    residual
}

/// How many vectors a basis has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BasisSize {
    /// So many.
    Count(usize),
    /// Fixed-interface modes up to a frequency, Hz.
    UpTo(f64),
    /// The same, but no more than have so many numbers: modes times degrees of freedom of the interior.
    AtMost(f64, usize),
    /// As few as keep the estimated relative error of the frequencies in the band below this.
    Auto(f64),
}

/// What is asked of a basis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BasisChoice {
    /// Its size.
    pub size: BasisSize,
    /// Whether residual vectors are among it: of `Count` every second one, to `UpTo` one for each elastic mode of the
    /// coupled structure in the band.
    pub enhanced: bool,
    /// Top of the band of interest, Hz.
    pub band_hz: f64,
}

/// Modes computed at first when nobody says how many.
const FIRST_MODES: usize = 8;

/// A basis with residual vectors up to `count`; `modes_of` gives at least as many modes of the coupled structure beyond the
/// quasi-static ones as its second argument says, if there are.
pub(super) fn filled(
    substructure: &Substructure,
    mut basis: InteriorBasis,
    count: usize,
    modes_of: impl Fn(&InteriorBasis, usize) -> Result<SymmetricSpectrum, ReductionError>,
) -> Result<InteriorBasis, ReductionError> {
    // an interface of few coordinates has few residual vectors; those of the basis with them are further ones
    while basis.count() < count {
        let missing = count - basis.count();
        let spectrum = modes_of(&basis, missing)?;
        let elastic = elastic(&basis, &spectrum);
        let more = corrected(substructure, &basis, &spectrum, elastic..elastic + missing)?;
        if more.count() == basis.count() {
            break;
        }
        basis = more;
    }
    Ok(basis)
}

/// The lowest modes, and one more to say up to where they are complete.
pub(super) fn modes(
    substructure: &Substructure,
    count: usize,
    watch: &dyn Watch,
) -> Result<EigenPairs, ReductionError> {
    substructure.lowest_modes_watched((count + 1).min(substructure.interior_dof()), watch)
}

/// Modes of which at least one and `beyond` more are above an eigenvalue, and how many are not; `most` of these at most.
pub(super) fn modes_to(
    substructure: &Substructure,
    value: f64,
    beyond: usize,
    most: usize,
    watch: &dyn Watch,
) -> Result<(EigenPairs, usize), ReductionError> {
    let mut asked = FIRST_MODES + beyond;
    loop {
        let pairs = modes(substructure, asked, watch)?;
        let below = pairs.values.partition_point(|&found| found <= value);
        if below > most {
            return Ok((pairs, most));
        }
        if below + beyond < pairs.values.len() || pairs.values.len() == substructure.interior_dof() {
            return Ok((pairs, below));
        }
        asked = (2 * asked).max(below + beyond);
        // beyond the most one more says up to where they are complete
        asked = asked.min(most.saturating_add(1 + beyond));
    }
}

/// How many modes of the coupled structure are quasi-static: those beyond are elastic.
pub(super) fn elastic(basis: &InteriorBasis, spectrum: &SymmetricSpectrum) -> usize {
    let limit = basis.quasi_static();
    spectrum.values.partition_point(|&value| value <= limit)
}

/// A basis with residual vectors of those of the chosen modes of the coupled structure that there are.
pub(super) fn corrected(
    substructure: &Substructure,
    basis: &InteriorBasis,
    spectrum: &SymmetricSpectrum,
    chosen: impl IntoIterator<Item = usize>,
) -> Result<InteriorBasis, ReductionError> {
    let mut chosen: Vec<usize> = chosen.into_iter().collect();
    chosen.retain(|&mode| spectrum.values.get(mode).is_some_and(|value| value.is_finite()));
    if chosen.is_empty() {
        return Ok(basis.clone());
    }
    let residual = interior_residuals(substructure, basis, spectrum, &chosen);
    basis.extended(substructure, substructure.solve_interior(residual)?)
}
