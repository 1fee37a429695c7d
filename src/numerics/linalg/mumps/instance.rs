//! One matrix's place in MUMPS: its controls, and the jobs on it.
//!
//! With the feature `mumps-mpi`, each job is one that all processes of `mpirun` join: [`super::world`] tells the others before rank 0
//! begins. The matrix, right-hand sides and solutions are those of rank 0.

use super::ffi::{self, Job, Real};
use super::structure::{Structure, VERSION};
#[cfg(feature = "mumps-mpi")]
use super::world;
use std::ffi::c_int;
use std::ptr::NonNull;

/// A failure as MUMPS tells it: INFOG(1) and INFOG(2).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Failure(pub c_int, pub c_int);

/// The lower triangle of a matrix for one job, rows and columns counted from 1; `values` are empty for the analysis.
pub(super) struct Entries<'a, T> {
    pub rows: &'a mut [c_int],
    pub columns: &'a mut [c_int],
    pub values: &'a mut [T],
}

/// One matrix's place in MUMPS.
pub(super) struct Instance<T: Real> {
    structure: Box<Structure<T>>,
    /// By what name the other processes know it.
    #[cfg(feature = "mumps-mpi")]
    name: world::Message,
}

impl<T: Real> Instance<T> {
    /// Begins an instance for symmetric matrices, definite or not, with a folder for factors out of core (at most [`ffi::LONGEST_PATH`]
    /// bytes).
    ///
    /// # Errors
    /// [`Failure`]; `Failure(0, 0)` for a library of another version.
    pub(super) fn new(definite: bool, folder: &[u8]) -> Result<Self, Failure> {
        let symmetry = if definite { 1 } else { 2 };
        let mut instance = Self {
            structure: ffi::empty(symmetry, folder),
            #[cfg(feature = "mumps-mpi")]
            name: world::name(T::DOUBLE, symmetry, folder),
        };
        instance.run(Job::Begin)?;
        let found = &instance.structure.version_number;
        let known = found.iter().zip(VERSION.bytes()).all(|(&found, expected)| found as u8 == expected);
        if known { Ok(instance) } else { Err(Failure(0, 0)) }
    }

    /// Sets ICNTL, counted from 1.
    pub(super) fn set(&mut self, control: usize, value: c_int) {
        self.structure.icntl[control - 1] = value;
    }

    /// Sets CNTL, counted from 1.
    pub(super) fn set_real(&mut self, control: usize, value: f64) {
        self.structure.cntl[control - 1] = T::of(value);
    }

    /// INFOG, counted from 1.
    pub(super) fn info(&self, place: usize) -> c_int {
        self.structure.infog[place - 1]
    }

    fn run(&mut self, job: Job) -> Result<(), Failure> {
        let _turn = ffi::turn();
        #[cfg(feature = "mumps-mpi")]
        world::tell(&self.name, job);
        ffi::run(&mut self.structure, job);
        let [first, second, ..] = self.structure.infog;
        // warnings are positive
        if first < 0 { Err(Failure(first, second)) } else { Ok(()) }
    }

    /// Analyses a pattern that is factorised in an order, place by place; `blocks` say where runs of unknowns with one pattern
    /// begin, counted from 1, and end with one more than unknowns.
    pub(super) fn analyse(
        &mut self,
        entries: Entries<'_, T>,
        mut order: Vec<c_int>,
        mut blocks: Vec<c_int>,
    ) -> Result<(), Failure> {
        self.structure.n = order.len() as c_int;
        self.structure.perm_in = first(&mut order);
        self.structure.nblk = blocks.len() as c_int - 1;
        self.structure.blkptr = first(&mut blocks);
        let done = self.on(entries, Job::Analyse);
        (self.structure.perm_in, self.structure.blkptr) = (None, None);
        done
    }

    /// Factorises a matrix with the analysed pattern.
    pub(super) fn factorise(&mut self, entries: Entries<'_, T>) -> Result<(), Failure> {
        self.on(entries, Job::Factorise)
    }

    fn on(&mut self, entries: Entries<'_, T>, job: Job) -> Result<(), Failure> {
        self.structure.nnz = entries.rows.len() as i64;
        (self.structure.irn, self.structure.jcn) = (first(entries.rows), first(entries.columns));
        self.structure.a = first(entries.values);
        let done = self.run(job);
        (self.structure.irn, self.structure.jcn, self.structure.a) = (None, None, None);
        done
    }

    /// Solves for right-hand sides one behind the other, in place.
    pub(super) fn solve(&mut self, sides: &mut [T]) -> Result<(), Failure> {
        let order = self.structure.n;
        (self.structure.lrhs, self.structure.nrhs) = (order, (sides.len() / (order as usize).max(1)) as c_int);
        self.structure.rhs = first(sides);
        let done = self.run(Job::Solve);
        self.structure.rhs = None;
        done
    }
}

impl<T: Real> Drop for Instance<T> {
    fn drop(&mut self) {
        // frees what MUMPS holds and removes its files; a failure of that changes no result
        let _ = self.run(Job::End);
    }
}

/// The pointer that C knows a slice by.
fn first<T>(slice: &mut [T]) -> Option<NonNull<T>> {
    NonNull::new(slice.as_mut_ptr()).filter(|_| !slice.is_empty())
}
