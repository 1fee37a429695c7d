//! Factors by MUMPS, for matrices whose own factor does not fit into the memory, and for several processes by MPI.
//!
//! In comes a symmetric matrix in its fill-reducing order; out goes a factor that solves and counts negative eigenvalues like
//! [`super::numeric::NumericFactor`]. Read [`MumpsFactor`] first; `ffi` holds the calls.
//!
//! **Limitations**: MUMPS 5.5; at most 2^31 rows; right-hand sides and matrix are on one process.

#[allow(unsafe_code)]
mod ffi;
mod files;
mod instance;
mod probe;
mod structure;
mod way;
#[cfg(feature = "mumps-mpi")]
#[allow(unsafe_code)]
mod world;

use super::dense::pseudo_random;
use super::{Kind, LinalgError, SymmetricMatrix, blas, gigabytes};
use faer::MatMut;
use faer::prelude::{Reborrow, ReborrowMut};
use files::Folder;
use instance::{Entries, Failure, Instance};
use probe::Probe;
use std::ffi::c_int;
use std::sync::{Mutex, OnceLock, PoisonError};

use ffi::Real;
pub(super) use files::check_root;
pub(super) use way::Way;
#[cfg(feature = "mumps-mpi")]
pub(super) use world::ranks;
#[cfg(feature = "mumps-mpi")]
pub(crate) use world::{joined, leave};

/// Number of processes that compute together.
#[cfg(not(feature = "mumps-mpi"))]
pub(super) fn ranks() -> usize {
    1
}

/// Removes files and ends the other processes: the program ends without dropping what it holds.
pub(crate) fn abandon() {
    files::remove_all();
    #[cfg(feature = "mumps-mpi")]
    world::abort();
}

/// Error of a low-rank block, relative to the largest entry of the scaled matrix.
const LOW_RANK: f64 = 1e-5;

/// Room for pivots that are put off, in hundredths of what the analysis expects, one try after the other.
const ROOM: [c_int; 3] = [20, 60, 200];

/// Right-hand sides that are solved for at once.
const TOGETHER: usize = 32;

/// A factor that MUMPS holds.
pub(super) struct MumpsFactor<T: Real> {
    instance: Mutex<Instance<T>>,
    /// `1 / sqrt |a_ii|`.
    scale: Vec<f64>,
    negative: usize,
    way: Way,
    /// Of the first solve that failed.
    failure: OnceLock<LinalgError>,
    /// Its files, if any, and what tells whether they still are what was written; removed after the instance.
    on_disk: Option<(Folder, Probe<T>)>,
}

impl<T: Real> std::fmt::Debug for MumpsFactor<T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MumpsFactor").field("order", &self.scale.len()).field("negative", &self.negative).finish()
    }
}

impl<T: Real> MumpsFactor<T> {
    /// Factorises a matrix in the order in which it is, by one of MUMPS's ways.
    ///
    /// # Errors
    /// [`LinalgError::NotPositiveDefinite`] for [`Kind::Definite`], [`LinalgError::NearlySingular`] for a pivot of zero,
    /// [`LinalgError::Library`] where memory, disk or the library do not suffice, [`LinalgError::Refused`] where BLAS has no memory.
    pub(super) fn new(a: &SymmetricMatrix, kind: Kind, way: Way) -> Result<Self, LinalgError> {
        let order = a.order();
        let failed = |failure| told(failure, order, way);
        let mut folder = if way == Way::OutOfCore { Some(Folder::new()?) } else { None };
        let path = folder.as_ref().map_or(&[][..], Folder::bytes);
        let _threads = blas::work_on(rayon::current_num_threads())?;
        let mut instance = Instance::<T>::new(kind == Kind::Definite, path).map_err(failed)?;
        // no checks and no scaling by MUMPS: the matrix is scaled here, and its order is given
        for (control, value) in
            [(6, 0), (7, 1), (8, 0), (10, 0), (11, 0), (12, 1), (13, 1), (15, 1), (27, TOGETHER as c_int)]
        {
            instance.set(control, value);
        }
        instance.set(22, c_int::from(way == Way::OutOfCore));
        // low rank throughout, or for the work alone where the entries go to files
        let low_rank = !T::DOUBLE && way != Way::InCore && ffi::low_rank_is_safe();
        instance.set(
            35,
            if !low_rank {
                0
            } else if way == Way::LowRank {
                2
            } else {
                3
            },
        );
        instance.set_real(7, LOW_RANK);
        let (mut rows, mut columns) = (Vec::with_capacity(a.rows.len()), Vec::with_capacity(a.rows.len()));
        for column in 0..order {
            for (row, _) in a.column(column) {
                rows.push(row as c_int + 1);
                columns.push(column as c_int + 1);
            }
        }
        let pattern = Entries { rows: &mut rows, columns: &mut columns, values: &mut [] };
        instance.analyse(pattern, (1..=order as c_int).collect(), blocks(a)).map_err(failed)?;
        let scale: Vec<f64> = a
            .stored_diagonal()
            .into_iter()
            .map(|entry| if entry == 0.0 { 1.0 } else { entry.abs().sqrt().recip() })
            .collect();
        let mut values = Vec::with_capacity(a.rows.len());
        for column in 0..order {
            values.extend(a.column(column).map(|(row, value)| T::of(scale[row] * value * scale[column])));
        }
        let mut done = Ok(());
        for room in ROOM {
            instance.set(14, room);
            let entries = Entries { rows: &mut rows, columns: &mut columns, values: &mut values };
            done = instance.factorise(entries);
            if !matches!(done, Err(Failure(-8 | -9 | -14 | -15 | -17 | -20, _))) {
                break;
            }
        }
        done.map_err(failed)?;
        let negative = usize::try_from(instance.info(12)).unwrap_or_default();
        // on one process MUMPS counts them without a word
        if kind == Kind::Definite && negative > 0 {
            return Err(LinalgError::NotPositiveDefinite { order, pivot: 0 });
        }
        if let Some(folder) = &mut folder {
            folder.written();
        }
        let on_disk = folder.map(|folder| {
            let answer = pseudo_random(order, 1, 0);
            let mut side = vec![0.0; order];
            for ((&row, &column), &value) in rows.iter().zip(&columns).zip(&values) {
                let (row, column) = (row as usize - 1, column as usize - 1);
                side[row] += value.value() * answer[(column, 0)];
                if row != column {
                    side[column] += value.value() * answer[(row, 0)];
                }
            }
            (folder, Probe::new(answer, side))
        });
        Ok(Self { instance: Mutex::new(instance), scale, negative, way, failure: OnceLock::new(), on_disk })
    }

    /// `A^-1 B` in place for `B` [n x k]; no numbers where MUMPS failed, which [`MumpsFactor::check`] tells.
    pub(super) fn solve(&self, mut b: MatMut<'_, f64>) {
        let order = self.scale.len();
        let mut sides = vec![T::default(); order * b.ncols()];
        for (column, side) in sides.chunks_exact_mut(order.max(1)).enumerate() {
            for ((to, &from), scale) in side.iter_mut().zip(b.rb().col(column).iter()).zip(&self.scale) {
                *to = T::of(scale * from);
            }
        }
        if let Some((_, probe)) = &self.on_disk {
            sides.extend(probe.side());
        }
        // one thread's buffer is there since the factorisation
        let _threads = blas::work_on(rayon::current_num_threads());
        let solved = self.instance.lock().unwrap_or_else(PoisonError::into_inner).solve(&mut sides);
        let answered = sides.split_off(order * b.ncols());
        let failure = match (solved, &self.on_disk) {
            (Err(_), Some((folder, _))) if !folder.is_whole() => Some(self.useless(&format!(
                "its files in {} are gone: something removed them; set MUMPS_OOC_TMPDIR to a folder that nothing clears, and compute again",
                folder.path().display()
            ))),
            (Err(failure), _) => Some(told(failure, order, self.way)),
            (Ok(()), Some((folder, probe))) if !probe.holds(&answered) => Some(self.useless(&format!(
                "solutions no longer satisfy their equations: the factor's files in {} are damaged; set MUMPS_OOC_TMPDIR to a folder on a sound disk that nothing else writes to, and compute again",
                folder.path().display()
            ))),
            (Ok(()), _) => None,
        };
        for (column, side) in sides.chunks_exact(order.max(1)).enumerate() {
            for ((to, from), scale) in b.rb_mut().col_mut(column).iter_mut().zip(side).zip(&self.scale) {
                *to = if failure.is_none() { scale * from.value() } else { f64::NAN };
            }
        }
        if let Some(failure) = failure {
            self.failure.get_or_init(|| failure);
        }
    }

    fn useless(&self, reason: &str) -> LinalgError {
        LinalgError::Library { order: self.scale.len(), by: by(self.way), reason: reason.to_owned() }
    }

    /// # Errors
    /// [`LinalgError::Library`] if a solve has failed, as by a disk that does not answer.
    fn check(&self) -> Result<(), LinalgError> {
        self.failure.get().map_or(Ok(()), |failure| Err(failure.clone()))
    }
}

/// Where runs of unknowns begin whose columns have one pattern, as those of a mesh node, counted from 1, and one more than unknowns:
/// the analysis of their graph takes a quarter of the time.
fn blocks(a: &SymmetricMatrix) -> Vec<c_int> {
    let below = |column: usize| {
        let rows = &a.rows[a.offsets[column] as usize..a.offsets[column + 1] as usize];
        rows.strip_prefix(&[column as u32]).unwrap_or(rows)
    };
    let begins = |&column: &usize| {
        column == 0 || below(column - 1).strip_prefix(&[column as u32]).is_none_or(|rest| rest != below(column))
    };
    (0..a.order()).filter(begins).chain([a.order()]).map(|first| first as c_int + 1).collect()
}

/// A factor in either precision.
#[derive(Debug)]
pub(super) enum Numbers {
    Single(MumpsFactor<f32>),
    Double(MumpsFactor<f64>),
}

impl Numbers {
    /// Factorises a matrix, in double precision with all entries.
    ///
    /// # Errors
    /// As [`MumpsFactor::new`].
    pub(super) fn new(a: &SymmetricMatrix, kind: Kind, way: Way, double: bool) -> Result<Self, LinalgError> {
        if double {
            MumpsFactor::new(a, kind, way.exact()).map(Self::Double)
        } else {
            MumpsFactor::new(a, kind, way).map(Self::Single)
        }
    }

    /// Whether its entries are in double precision.
    pub(super) fn is_double(&self) -> bool {
        matches!(self, Self::Double(_))
    }

    /// `A^-1 B` in place for `B` [n x k].
    pub(super) fn solve(&self, b: MatMut<'_, f64>) {
        match self {
            Self::Single(factor) => factor.solve(b),
            Self::Double(factor) => factor.solve(b),
        }
    }

    /// # Errors
    /// [`LinalgError::Library`] if a solve has failed.
    pub(super) fn check(&self) -> Result<(), LinalgError> {
        match self {
            Self::Single(factor) => factor.check(),
            Self::Double(factor) => factor.check(),
        }
    }

    /// Number of negative eigenvalues of the factorised matrix.
    pub(super) fn negative(&self) -> usize {
        match self {
            Self::Single(factor) => factor.negative,
            Self::Double(factor) => factor.negative,
        }
    }
}

/// Who factorised, in the middle of a sentence.
fn by(way: Way) -> String {
    format!("MUMPS, {way},")
}

/// What a failure of MUMPS means to who reads it (users' guide of version 5.5, section 8).
fn told(Failure(code, detail): Failure, order: usize, way: Way) -> LinalgError {
    let refused = |reason: String| LinalgError::Library { order, by: by(way), reason };
    match code {
        0 => refused("its library has another version; expected 5.5, with which the program was built".to_owned()),
        -40 => LinalgError::NotPositiveDefinite { order, pivot: 0 },
        -10 => LinalgError::NearlySingular { order, contraction: f64::INFINITY },
        -90..=-88 => refused(format!(
            "its files cannot be written or read (INFO {code}); expected some GB for each million unknowns on the disk of {}; set MUMPS_OOC_TMPDIR to a larger one",
            files::root().display()
        )),
        -92 => refused(format!(
            "its thread for files cannot be started (INFO {code}); free memory, or raise the limits of memory and threads (ulimit -v, -d, -u)"
        )),
        -5 | -7 | -13 | -22 => {
            // in units of entries, or of millions of them
            let entries = if detail < 0 { 1_000_000 * i64::from(detail).unsigned_abs() } else { detail as u64 };
            refused(format!(
                "{} more of memory are not there (INFO {code}); free memory, raise its limit (ulimit -v, -d), use more processes (mpirun), or a coarser mesh",
                gigabytes(4 * entries)
            ))
        }
        -8 | -9 | -11 | -14 | -15 | -20..=-17 => refused(format!(
            "its memory does not suffice (INFO {code}, {detail}); free memory, raise its limit (ulimit -v, -d), use more processes (mpirun), or a coarser mesh"
        )),
        _ => refused(format!("INFO {code}, {detail}; see the users' guide of MUMPS, section 8")),
    }
}

#[cfg(test)]
mod tests;
