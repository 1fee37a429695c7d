//! The interior of a housing while its interface is held: solutions, products and modes.
//!
//! Driven parts of the interface are not in the interior at all. A mean over free nodes holds it by p equations
//!
//! ```text
//! W u = 0         (W [p x interior], full on the nodes of the bores)
//! ```
//!
//! Of the bores' unknowns p are chosen, d, that follow the others h by them: `u_d = G u_h`, `G = -W_d^-1 W_h`. With
//! `P = [1; G]` all that lives in `W u = 0` is `u = P u_h`, and what acts on it there is `P^T f`:
//!
//! ```text
//! P^T K P phi_h = w^2 P^T M P phi_h      is      K phi + W^T lambda = w^2 M phi,   W phi = 0
//! ```
//!
//! `P^T K P` has a dense block on the bores that is never formed (see `numerics::linalg::followers`): one sparse factor of K_hh
//! serves solutions, modes and the count of modes. A motion c of the
//! means begins as `u = E c`, `E = W^T (W W^T)^-1`: of means with equal weights the bore moves as a rigid body. So the strains that
//! the interior then takes off are small.
//!
//! The d are those columns of an orthonormal basis of the rows of W that are the longest, one after the other, each less what
//! the ones before have of it (QR with pivoting; Golub and Van Loan, *Matrix Computations*, section 5.4.2). So `W_d` is
//! well-conditioned, and holding d holds the rigid motions of the body.

use super::ReductionError;
use super::parts::{columns_of, dense, rows_of, symmetric};
use crate::fe::assembly::SystemMatrices;
use crate::fe::model::HousingPartition;
use crate::numerics::Told;
use crate::numerics::linalg::{
    DenseMatrix, EigenPairs, EigenProblem, FactorChoice, Followers, LinalgError, Ordering, Pattern, SparseCholesky,
    SparseMatrix, TripletBuilder, sparse_times_dense, submatrix, symmetric_eigen, transpose_times_dense,
};
use faer::prelude::*;
use std::sync::Arc;

/// Relative error of static solutions above which an interior is refused: fixed-interface eigenvalues are right to as much,
/// their frequencies to half of it.
const LARGEST_CONTRACTION: f64 = 1e-4;

/// Steps of refinement of static solutions where means are held.
const REFINEMENTS: usize = 2;

/// Smallest eigenvalue of the scaled Gram matrix of the rows of W, below which they say the same twice.
const DEPENDENT: f64 = 1e-12;

/// Stiffness and mass of the interior with the factor of the stiffness, and what holds it.
#[derive(Debug, Clone)]
pub(crate) struct Interior {
    /// Number of interface coordinates.
    interface: usize,
    factor: SparseCholesky,
    /// K and M over the unknowns that do not follow.
    problem: EigenProblem,
    held: Option<Means>,
}

/// Means that are held.
#[derive(Debug, Clone)]
struct Means {
    /// Places of h and d in the interior.
    free: Vec<usize>,
    followers: Vec<usize>,
    /// `G^T` [h x p].
    follow: Arc<SparseMatrix>,
    /// `[K_hd; K_dd]` and the same of M [interior x p].
    columns: [SparseMatrix; 2],
    /// Motions of the interior by unit interface coordinates, `E C` [interior x interface], C which of them the means are.
    lift: SparseMatrix,
    /// `K E C` and `M E C` [interior x interface].
    lifted: [SparseMatrix; 2],
    /// `W^T C` [interior x interface].
    weights: SparseMatrix,
}

impl Interior {
    /// The interior of a partition.
    ///
    /// # Errors
    /// [`ReductionError::FloatingInterior`] if the stiffness is singular, [`ReductionError::SoftInterior`] if it nearly is,
    /// [`ReductionError::Refused`] for means that depend on each other.
    pub(super) fn new(matrices: &SystemMatrices, partition: &HousingPartition) -> Result<Self, ReductionError> {
        let i = &partition.interior;
        let held = if partition.mean.is_empty() { None } else { Some(Means::new(matrices, partition)?) };
        let places: Vec<usize> = match &held {
            Some(means) => means.free.iter().map(|&place| i[place]).collect(),
            None => i.clone(),
        };
        let soft =
            |dof, contraction| ReductionError::SoftInterior { dof, error: contraction, limit: LARGEST_CONTRACTION };
        let floating = |error| match error {
            LinalgError::NotPositiveDefinite { pivot, .. } => {
                ReductionError::FloatingInterior { interior: i.len(), dof: pivot }
            }
            LinalgError::IllConditioned { row, contraction, .. } => soft(row, contraction),
            other => other.into(),
        };
        let SystemMatrices { stiffness, mass, .. } = matrices;
        let pattern = Pattern::of(stiffness);
        let ordering = match &matrices.ordering {
            Some(of_all) => of_all.restricted(pattern, &places)?,
            None => Ordering::of_part(pattern, &places)?,
        };
        let followers = held.as_ref().map(|means| [0, 1].map(|which| means.followers(which)));
        let followers = followers.as_ref().map(|[of_k, of_m]| [of_k, of_m]);
        let (problem, factor) = EigenProblem::factorised([stiffness, mass], ordering, followers).map_err(floating)?;
        if factor.contraction() > LARGEST_CONTRACTION {
            return Err(soft(factor.weakest_row(), factor.contraction()));
        }
        Ok(Self { interface: partition.tie.cols(), factor, problem, held })
    }

    /// Who factorises, if not our own factor.
    pub(super) fn factor_choice(&self) -> Option<FactorChoice> {
        self.problem.factor_choice()
    }

    /// Whether the interface holds means of the interior.
    pub(super) fn holds_means(&self) -> bool {
        self.held.is_some()
    }

    /// Number of independent motions of the interior while the interface is held.
    pub(super) fn independent(&self) -> usize {
        self.problem.order()
    }

    /// `K X` for any `X` [interior x k].
    pub(crate) fn stiffness_times(&self, x: &DenseMatrix) -> DenseMatrix {
        self.product(x, 0, &|x| self.problem.stiffness_times(x))
    }

    /// `M X` for any `X` [interior x k].
    pub(crate) fn mass_times(&self, x: &DenseMatrix) -> DenseMatrix {
        self.product(x, 1, &|x| self.problem.mass_times(x))
    }

    /// `A X` by that of `P^T A P`, which alone is kept: `x = E c + P y_h`, c its means. `A E c` is known. `A P y_h` is
    /// `P^T A P y_h` less `G^T` times its rows d. Without E the followers would move by c times the number of nodes. Of a rigid
    /// motion, which costs nothing, the round-off of that would be left.
    fn product(&self, x: &DenseMatrix, which: usize, inside: &dyn Fn(&DenseMatrix) -> DenseMatrix) -> DenseMatrix {
        let Some(means) = &self.held else {
            return inside(x);
        };
        let c = transpose_times_dense(&means.weights, x);
        let y_h = rows_of(&(x - sparse_times_dense(&means.lift, &c)), &means.free);
        // rows d, by symmetry
        let of_d = transpose_times_dense(&means.columns[which], &means.spread(&y_h));
        let of_h = inside(&y_h) - sparse_times_dense(&means.follow, &of_d);
        let mut product = sparse_times_dense(&means.lifted[which], &c);
        for column in 0..x.ncols() {
            for (places, rows) in [(&means.free, &of_h), (&means.followers, &of_d)] {
                places.iter().zip(rows.col_as_slice(column)).for_each(|(&place, row)| product[(place, column)] += row);
            }
        }
        product
    }

    /// Motions with the interface held, of forces `R` [interior x k]: `K X + W^T lambda = R`, `W X = 0`.
    ///
    /// # Errors
    /// [`LinalgError::Shape`].
    pub(super) fn solve(&self, mut r: DenseMatrix) -> Result<DenseMatrix, ReductionError> {
        let Some(means) = &self.held else {
            self.factor.solve_columns(&mut r)?;
            return Ok(r);
        };
        let forces = means.gathered(&r);
        let mut x = forces.clone();
        self.factor.solve_columns(&mut x)?;
        // single unknowns hold h more softly than the means do: refinement takes that round-off away
        for _ in 0..REFINEMENTS {
            let mut rest = &forces - self.problem.stiffness_times(&x);
            self.factor.solve_columns(&mut rest)?;
            x += rest;
        }
        Ok(means.spread(&x))
    }

    /// Motions of the interior by `width` interface coordinates from `first` on with the right means, `E C` [interior x width];
    /// `None` without means.
    pub(super) fn lift(&self, first: usize, width: usize) -> Option<DenseMatrix> {
        self.held.as_ref().map(|means| columns_of(&means.lift, first, width))
    }

    /// Forces on the interface by forces on the interior [interior x k] that the means carry: `(E C)^T R` [interface x k].
    pub(super) fn lifted(&self, forces: &DenseMatrix) -> DenseMatrix {
        match &self.held {
            Some(means) => transpose_times_dense(&means.lift, forces),
            None => DenseMatrix::zeros(self.interface, forces.ncols()),
        }
    }

    /// What forces on the interior [interior x k] do where it is free: `P^T R`, without the part that holds the means.
    pub(super) fn working(&self, forces: &DenseMatrix) -> DenseMatrix {
        self.held.as_ref().map_or_else(|| forces.clone(), |means| means.gathered(forces))
    }

    /// The lowest pairs; `told` hears which part is found.
    ///
    /// # Errors
    /// What the eigenvalue iteration reports.
    pub(super) fn lowest(&self, count: usize, told: Told<'_>) -> Result<EigenPairs, ReductionError> {
        let mut pairs = self.problem.lowest_told(count, told)?;
        if let Some(means) = &self.held {
            pairs.vectors = means.spread(&pairs.vectors);
        }
        Ok(pairs)
    }
}

impl Means {
    fn new(matrices: &SystemMatrices, partition: &HousingPartition) -> Result<Self, ReductionError> {
        let (i, mean) = (&partition.interior, &partition.mean);
        let p = mean.coordinates.len();
        // W^T over the unknowns that any mean takes, in the order of the interior
        let mut taken: Vec<usize> = mean.weights.iter().map(|(_, (dof, _))| dof).collect();
        taken.sort_unstable();
        taken.dedup();
        let inside: Option<Vec<usize>> = taken.iter().map(|dof| i.binary_search(dof).ok()).collect();
        let Some(inside) = inside else {
            let what = "a mean over nodes takes one that is fixed, tied or driven: expected free nodes; keep the bore apart from supports, links and other interfaces";
            return Err(ReductionError::Refused(what.to_owned()));
        };
        let mut w = DenseMatrix::zeros(taken.len(), p);
        for (&weight, (dof, column)) in &mean.weights {
            if let Ok(row) = taken.binary_search(&dof) {
                w[(row, column)] = weight;
            }
        }
        let q = orthonormal(&w)?;
        let chosen = pivots(&q);
        let q_d = rows_of(&q, &chosen);
        let others: Vec<usize> = (0..taken.len()).filter(|row| !chosen.contains(row)).collect();
        let inverse = |a: &DenseMatrix, b: &DenseMatrix| a.partial_piv_lu().solve(b);
        // -G = W_d^-1 W_h, the same for all bases of the rows of W
        let g = inverse(&q_d.transpose().to_owned(), &rows_of(&q, &others).transpose().to_owned());
        // W^T = Q S
        let s = q.transpose() * &w;
        let e = inverse(&s, &q.transpose().to_owned());
        let followers: Vec<usize> = chosen.iter().map(|&row| inside[row]).collect();
        let mut is_follower = vec![false; i.len()];
        followers.iter().for_each(|&place| is_follower[place] = true);
        let free: Vec<usize> = (0..i.len()).filter(|&place| !is_follower[place]).collect();
        let mut follow = TripletBuilder::new(free.len(), p);
        for (column, &row) in others.iter().enumerate() {
            // places are ascending
            if let Ok(place) = free.binary_search(&inside[row]) {
                (0..p).for_each(|follower| follow.add(place, follower, -g[(follower, column)]));
            }
        }
        let interface = partition.tie.cols();
        let mut lift = TripletBuilder::new(i.len(), interface);
        let mut of_taken = TripletBuilder::new(taken.len(), interface);
        let mut weights = TripletBuilder::new(i.len(), interface);
        for (row, &place) in inside.iter().enumerate() {
            for (column, &to) in mean.coordinates.iter().enumerate() {
                lift.add(place, to, e[(column, row)]);
                of_taken.add(row, to, e[(column, row)]);
                weights.add(place, to, w[(row, column)]);
            }
        }
        let of_taken = of_taken.build();
        let both = [&matrices.stiffness, &matrices.mass];
        let lifted = both.map(|a| (&submatrix(a, i, &taken) * &of_taken).to_csc());
        let of_followers: Vec<usize> = followers.iter().map(|&place| i[place]).collect();
        let columns = both.map(|a| submatrix(a, i, &of_followers));
        let (follow, lift, weights) = (Arc::new(follow.build()), lift.build(), weights.build());
        Ok(Self { free, followers, follow, columns, lift, lifted, weights })
    }

    /// What the followers add to stiffness (0) or mass (1).
    fn followers(&self, which: usize) -> Followers {
        let columns = &self.columns[which];
        let all = dense(&submatrix(columns, &self.followers, &numbered(columns.cols())));
        let coupling = submatrix(columns, &self.free, &numbered(columns.cols()));
        Followers::new(Arc::clone(&self.follow), coupling, symmetric(&all))
    }

    /// `P^T R` [h x k] for `R` [interior x k].
    fn gathered(&self, r: &DenseMatrix) -> DenseMatrix {
        rows_of(r, &self.free) + sparse_times_dense(&self.follow, &rows_of(r, &self.followers))
    }

    /// `P X` [interior x k] for `X` [h x k].
    fn spread(&self, x: &DenseMatrix) -> DenseMatrix {
        let following = transpose_times_dense(&self.follow, x);
        let mut all = DenseMatrix::zeros(self.free.len() + self.followers.len(), x.ncols());
        for column in 0..x.ncols() {
            let to = all.col_as_slice_mut(column);
            self.free.iter().zip(x.col_as_slice(column)).for_each(|(&place, &value)| to[place] = value);
            let following = following.col_as_slice(column);
            self.followers.iter().zip(following).for_each(|(&place, &value)| to[place] = value);
        }
        all
    }
}

fn numbered(count: usize) -> Vec<usize> {
    (0..count).collect()
}

/// Orthonormal combinations of the columns of `a` [n x p], as many.
fn orthonormal(a: &DenseMatrix) -> Result<DenseMatrix, ReductionError> {
    let lengths: Vec<f64> = (0..a.ncols()).map(|column| a.col(column).norm_l2()).collect();
    let unit = DenseMatrix::from_fn(a.nrows(), a.ncols(), |row, column| a[(row, column)] / lengths[column]);
    let gram = symmetric_eigen(&(unit.transpose() * &unit))?;
    // what is not a number is dependent, too
    let independent = gram.values.iter().all(|value| *value > DEPENDENT);
    if !independent {
        let what = "two means over nodes of the interface say the same, so that their coordinates are not independent: expected each node in one of them";
        return Err(ReductionError::Refused(what.to_owned()));
    }
    let turned = unit * &gram.vectors;
    Ok(DenseMatrix::from_fn(a.nrows(), a.ncols(), |row, column| turned[(row, column)] / gram.values[column].sqrt()))
}

/// Rows of an orthonormal `q` [n x p], p of them, whose square is well-conditioned.
fn pivots(q: &DenseMatrix) -> Vec<usize> {
    let mut rest = q.clone();
    let mut chosen = Vec::with_capacity(q.ncols());
    for _ in 0..q.ncols() {
        let length = |row: usize| rest.row(row).squared_norm_l2();
        let Some(longest) = (0..q.nrows()).max_by(|&a, &b| length(a).total_cmp(&length(b))) else {
            break;
        };
        let unit: Vec<f64> = (0..q.ncols()).map(|k| rest[(longest, k)] / length(longest).sqrt()).collect();
        for row in 0..q.nrows() {
            let share: f64 = unit.iter().enumerate().map(|(k, u)| u * rest[(row, k)]).sum();
            unit.iter().enumerate().for_each(|(k, u)| rest[(row, k)] -= share * u);
        }
        chosen.push(longest);
    }
    chosen
}
