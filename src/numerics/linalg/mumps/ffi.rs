//! Calls of MUMPS (Amestoy, Duff, L'Excellent, Koster, SIAM J. Matrix Anal. Appl. 23 (2001) 15-41), and what its libraries need.
//!
//! **Life cycle.** A structure begins by job -1 and ends by job -2; between them come jobs 1 (analysis), 2 (factorisation) and 3
//! (solution). It stays on the heap at one place. MUMPS keeps its own copies of what it points to.
//!
//! **State.** MUMPS keeps variables between calls and is not re-entrant: [`turn`] is held for each.

use super::super::loaded;
use super::structure::Structure;
use std::ffi::{c_char, c_int, c_void};
use std::sync::{Mutex, MutexGuard, PoisonError};

unsafe extern "C" {
    fn smumps_c(structure: *mut Structure<f32>);
    fn dmumps_c(structure: *mut Structure<f64>);
}

/// Fortran's name of all processes, to MUMPS.
const WORLD: c_int = -987_654;

/// Bytes of a path that MUMPS keeps, its end's zero not counted.
pub(super) const LONGEST_PATH: usize = 255;

static ONE_CALL_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Numbers that MUMPS computes with.
pub(in crate::numerics::linalg) trait Real: Copy + Default + Send + Sync + 'static {
    /// Whether it is double precision.
    const DOUBLE: bool;
    /// A number rounded to this precision.
    fn of(value: f64) -> Self;
    /// The number.
    fn value(self) -> f64;
    /// A job of MUMPS on this process.
    fn call(structure: &mut Structure<Self>)
    where
        Self: Sized;
}

impl Real for f32 {
    const DOUBLE: bool = false;

    fn of(value: f64) -> Self {
        value as f32
    }

    fn value(self) -> f64 {
        f64::from(self)
    }

    fn call(structure: &mut Structure<Self>) {
        // SAFETY: the structure is laid out as MUMPS's (checked at compile time and by its version), and its pointers are null or
        // those of slices as long as the job asks for, which are borrowed for the call.
        unsafe { smumps_c(structure) }
    }
}

impl Real for f64 {
    const DOUBLE: bool = true;

    fn of(value: f64) -> Self {
        value
    }

    fn value(self) -> f64 {
        self
    }

    fn call(structure: &mut Structure<Self>) {
        // SAFETY: as for `f32`.
        unsafe { dmumps_c(structure) }
    }
}

/// What MUMPS is to do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Job {
    Begin = -1,
    End = -2,
    Analyse = 1,
    Factorise = 2,
    Solve = 3,
}

// SAFETY: the structure's pointers belong to MUMPS, which keeps nothing that is bound to a thread; calls take turns.
unsafe impl<T: Real> Send for Structure<T> {}

/// A structure of zeros, silent, with a symmetry and a folder for factors out of core.
pub(super) fn empty<T: Real>(symmetry: c_int, folder: &[u8]) -> Box<Structure<T>> {
    let mut structure = Box::<Structure<T>>::new_uninit();
    // SAFETY: zero is a valid value of every field: numbers, characters, and pointers that may be null.
    let mut structure = unsafe {
        structure.as_mut_ptr().write_bytes(0, 1);
        structure.assume_init()
    };
    (structure.sym, structure.par, structure.comm_fortran) = (symmetry, 1, WORLD);
    for (to, &from) in structure.ooc_tmpdir.iter_mut().take(LONGEST_PATH).zip(folder) {
        *to = from as c_char;
    }
    structure
}

/// Runs a job on this process, whose turn it must be.
pub(super) fn run<T: Real>(structure: &mut Structure<T>, job: Job) {
    structure.job = job as c_int;
    let folder = structure.ooc_tmpdir;
    T::call(structure);
    if job == Job::Begin {
        // which forgets it
        structure.ooc_tmpdir = folder;
        // units of Fortran for errors, warnings and statistics, and how much is said
        structure.icntl[..4].fill(0);
    }
}

/// What `SCOTCH_graphInit` is.
type GraphInit = unsafe extern "C" fn(*mut c_void) -> c_int;

/// What `SCOTCH_graphBuild` is.
type GraphBuild = unsafe extern "C" fn(
    *mut c_void,
    c_int,
    c_int,
    *const c_int,
    *const c_int,
    *const c_int,
    *const c_int,
    c_int,
    *const c_int,
    *const c_int,
) -> c_int;

/// Stands before SCOTCH's routine of this name. MUMPS 5.5 calls it for low-rank blocks with a graph that it did not begin by
/// `SCOTCH_graphInit`; SCOTCH 7 then reads a flag of whatever was in that memory, and every second analysis ends by a segmentation
/// fault. Here the graph is begun first.
///
/// # Safety
/// As SCOTCH's: all pointers are valid, and arrays that are the same one stand for absent ones.
#[unsafe(no_mangle)]
unsafe extern "C" fn scotchfgraphbuild_(
    graph: *mut c_void,
    base: *const c_int,
    vertices: *const c_int,
    starts: *const c_int,
    ends: *const c_int,
    loads: *const c_int,
    labels: *const c_int,
    edges: *const c_int,
    neighbours: *const c_int,
    edge_loads: *const c_int,
    failed: *mut c_int,
) {
    let unless = |array: *const c_int, same: *const c_int| if array == same { std::ptr::null() } else { array };
    // SAFETY: the functions have had these signatures since SCOTCH 4; MUMPS, which calls this routine, is linked with them.
    unsafe {
        let [init, build] = [c"SCOTCH_graphInit", c"SCOTCH_graphBuild"].map(loaded::function);
        *failed = match (init, build) {
            (Some(init), Some(build)) => {
                let init: GraphInit = std::mem::transmute(init.as_ptr());
                let build: GraphBuild = std::mem::transmute(build.as_ptr());
                init(graph);
                build(
                    graph,
                    *base,
                    *vertices,
                    starts,
                    ends,
                    unless(loads, starts),
                    unless(labels, starts),
                    *edges,
                    neighbours,
                    unless(edge_loads, neighbours),
                )
            }
            _ => 1,
        };
    }
}

/// Whether MUMPS finds that routine: it does unless the program was linked in an unusual way. Without it there is no low rank.
pub(super) fn low_rank_is_safe() -> bool {
    loaded::function(c"scotchfgraphbuild_")
        .is_some_and(|found| std::ptr::eq(found.as_ptr(), scotchfgraphbuild_ as *const c_void))
}

/// The turn to call MUMPS, which is waited for.
pub(super) fn turn() -> MutexGuard<'static, ()> {
    ONE_CALL_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The same if nobody has it.
#[cfg(feature = "mumps-mpi")]
pub(super) fn turn_at_once() -> Option<MutexGuard<'static, ()>> {
    ONE_CALL_AT_A_TIME.try_lock().ok()
}
