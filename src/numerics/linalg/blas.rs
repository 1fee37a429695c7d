//! The BLAS that ARPACK and MUMPS compute with, where it is OpenBLAS: on how many threads it works, and whether it has memory.
//!
//! OpenBLAS works in a buffer a thread, which it keeps once it has it. Where the system refuses one, as beyond `ulimit -v`, version
//! 0.3.21 asks again without end. So the memory is asked for here first, and a small product then makes OpenBLAS take it.
//!
//! **State.** OpenBLAS has one number of threads for the process; it is put back afterwards.
//!
//! **Limitations**: two computations that begin BLAS's work at the same time secure one buffer between them.

use super::{LinalgError, loaded};
use std::ffi::{c_double, c_int, c_void};
use std::hint::black_box;
use std::mem::transmute;
use std::sync::{Mutex, PoisonError};

/// Bytes of a buffer on x86-64 and ARM, and what lies around it.
const BUFFER: usize = (128 << 20) + (1 << 20);

/// Threads whose buffers are known to be there, the caller's own among them.
static SECURED: Mutex<usize> = Mutex::new(0);

/// `cblas_dsyrk`: order, triangle, transposition, n, k, alpha, A, its columns' distance, beta, C, its columns' distance.
type Product = unsafe extern "C" fn(
    c_int,
    c_int,
    c_int,
    c_int,
    c_int,
    c_double,
    *const c_double,
    c_int,
    c_double,
    *mut c_double,
    c_int,
);

/// OpenBLAS's calls.
#[derive(Debug, Clone, Copy)]
struct OpenBlas {
    get: unsafe extern "C" fn() -> c_int,
    set: unsafe extern "C" fn(c_int),
    product: Product,
}

impl OpenBlas {
    /// It, if it is in the process.
    fn found() -> Option<Self> {
        let [get, set, product] =
            [c"openblas_get_num_threads", c"openblas_set_num_threads", c"cblas_dsyrk"].map(loaded::function);
        // SAFETY: functions of these names have had these signatures since OpenBLAS has had them.
        unsafe {
            Some(Self {
                get: transmute::<*mut c_void, unsafe extern "C" fn() -> c_int>(get?.as_ptr()),
                set: transmute::<*mut c_void, unsafe extern "C" fn(c_int)>(set?.as_ptr()),
                product: transmute::<*mut c_void, Product>(product?.as_ptr()),
            })
        }
    }

    fn use_threads(self, threads: usize) {
        // SAFETY: it takes any number of threads.
        unsafe { (self.set)(threads.clamp(1, 1024) as c_int) };
    }

    /// The square of one number, which needs the caller's buffer.
    fn take_buffer(self) {
        let (factor, mut square) = (2.0, 0.0);
        let (by_columns, upper, as_it_is) = (102, 121, 111);
        // SAFETY: both matrices have one entry, which is as far as one row and one column reach.
        unsafe { (self.product)(by_columns, upper, as_it_is, 1, 1, 1.0, &factor, 1, 0.0, &mut square, 1) };
        black_box(square);
    }
}

/// BLAS works as [`work_on`] said until this is dropped.
#[derive(Debug)]
pub(super) struct Threads(Option<(OpenBlas, usize)>);

impl Drop for Threads {
    fn drop(&mut self) {
        if let Some((blas, before)) = self.0 {
            blas.use_threads(before);
        }
    }
}

/// Lets BLAS work on so many threads, or on one where their buffers find no memory.
///
/// # Errors
/// [`LinalgError::Refused`] where not even one thread's does.
pub(super) fn work_on(threads: usize) -> Result<Threads, LinalgError> {
    let Some(blas) = OpenBlas::found() else { return Ok(Threads(None)) };
    // SAFETY: it reads a number.
    let before = usize::try_from(unsafe { (blas.get)() }).unwrap_or(1);
    let mut secured = SECURED.lock().unwrap_or_else(PoisonError::into_inner);
    for threads in [threads.max(1), 1] {
        let known = threads <= *secured;
        if known || has_room(threads * BUFFER) {
            blas.use_threads(threads);
            if !known {
                blas.take_buffer();
                *secured = threads;
            }
            return Ok(Threads(Some((blas, before))));
        }
    }
    let fewer = if before > 1 { " set OPENBLAS_NUM_THREADS=1," } else { "" };
    Err(LinalgError::Refused(format!(
        "OpenBLAS, with which ARPACK and MUMPS compute, has no memory for its buffer of {} MiB; raise its limit (ulimit -v, -d),{fewer} or install another BLAS (libblas3)",
        BUFFER >> 20
    )))
}

/// Whether the system gives so many bytes.
fn has_room(bytes: usize) -> bool {
    let mut asked = Vec::<u8>::new();
    let given = asked.try_reserve_exact(bytes).is_ok();
    // an allocation that nobody looks at may never be made
    black_box(&asked);
    given
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_is_asked_for() {
        assert!(has_room(BUFFER));
        assert!(!has_room(1 << 60));
    }
}
