//! Debian's ARPACK behind one safe function.
//!
//! **Life cycle.** `dsaupd_c` is called again and again with the same buffers until it sets
//! `ido = 99`; between calls it asks for a product with `(K - sigma M)^-1` or with `M` on a part of
//! `workd` that `ipntr` names. `dseupd_c` then forms the eigenvectors from the same, untouched
//! buffers. All buffers live in [`shift_invert`] from the first call to the last, so no pointer
//! outlives what it points to, and their lengths are those that the ARPACK users' guide (Lehoucq,
//! Sorensen, Yang 1998, section 2) asks for.
//!
//! **State.** ARPACK keeps Fortran `SAVE` variables between calls: it is not re-entrant. One lock
//! covers a whole iteration, first call to last.
//!
//! **Reproducibility.** The start vector is ours (`info = 1`), not ARPACK's random one: the same
//! problem gives the same bits. BLAS works on one thread.

use super::{LinalgError, blas};
use std::ffi::{c_char, c_double, c_int};
use std::sync::{Mutex, PoisonError};

unsafe extern "C" {
    fn dsaupd_c(
        ido: *mut c_int,
        bmat: *const c_char,
        n: c_int,
        which: *const c_char,
        nev: c_int,
        tol: c_double,
        resid: *mut c_double,
        ncv: c_int,
        v: *mut c_double,
        ldv: c_int,
        iparam: *mut c_int,
        ipntr: *mut c_int,
        workd: *mut c_double,
        workl: *mut c_double,
        lworkl: c_int,
        info: *mut c_int,
    );
    fn dseupd_c(
        rvec: c_int,
        howmny: *const c_char,
        select: *const c_int,
        d: *mut c_double,
        z: *mut c_double,
        ldz: c_int,
        sigma: c_double,
        bmat: *const c_char,
        n: c_int,
        which: *const c_char,
        nev: c_int,
        tol: c_double,
        resid: *mut c_double,
        ncv: c_int,
        v: *mut c_double,
        ldv: c_int,
        iparam: *mut c_int,
        ipntr: *mut c_int,
        workd: *mut c_double,
        workl: *mut c_double,
        lworkl: c_int,
        info: *mut c_int,
    );
}

static ONE_ITERATION_AT_A_TIME: Mutex<()> = Mutex::new(());

/// Restarts after which the iteration gives up; modal problems need two to ten.
const MAX_RESTARTS: c_int = 300;

/// Relative tolerance of the Ritz values. Eigenvalues converge with its square, and the residuals are verified
/// afterwards; tolerance zero costs 2.7 times the solves for nothing.
const TOLERANCE: f64 = 1e-10;

/// Shift-invert Lanczos (ARPACK mode 3) for `count` eigenpairs of `K x = lambda M x` near the shift sigma (1/s^2), with a
/// basis of `count < basis <= n` vectors. Gives the eigenvalues ascending, 1/s^2, and the M-normalised eigenvectors, column
/// after column.
///
/// `solve(b, y)` sets `y = (K - sigma M)^-1 b`, `mass(x, y)` sets `y = M x`; both on slices of
/// length n.
///
/// # Errors
/// [`LinalgError::TooManyModes`] if the sizes do not fit, [`LinalgError::Iteration`], [`LinalgError::Refused`] where BLAS has no
/// memory.
pub(super) fn shift_invert(
    [n, count, basis]: [usize; 3],
    sigma: f64,
    mut solve: impl FnMut(&[f64], &mut [f64]),
    mut mass: impl FnMut(&[f64], &mut [f64]),
) -> Result<(Vec<f64>, Vec<f64>), LinalgError> {
    let too_large = n > i32::MAX as usize / 4 || basis * (basis + 8) > i32::MAX as usize;
    if count == 0 || count >= basis || basis > n || too_large {
        return Err(LinalgError::TooManyModes { asked: count, available: n });
    }
    let _guard = ONE_ITERATION_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
    let _threads = blas::work_on(1)?;
    let (mut residual, mut basis_vectors) = (start_vector(n), vec![0.0; n * basis]);
    let (mut workd, mut workl) = (vec![0.0; 3 * n], vec![0.0; basis * (basis + 8)]);
    let (mut iparam, mut ipntr): ([c_int; 11], [c_int; 11]) = ([0; 11], [0; 11]);
    iparam[0] = 1; // exact shifts
    iparam[2] = MAX_RESTARTS;
    iparam[6] = 3; // shift-invert
    let (bmat, which) = (c"G", c"LM");
    let mut ido: c_int = 0;
    let mut info: c_int = 1;
    let mut scratch = vec![0.0; n];
    loop {
        // SAFETY: every buffer has the length that ARPACK asks for (n, n*ncv, 3n, ncv*(ncv+8), 11,
        // 11), belongs to this function, and is not touched through another reference during the call.
        unsafe {
            dsaupd_c(
                &mut ido,
                bmat.as_ptr(),
                n as c_int,
                which.as_ptr(),
                count as c_int,
                TOLERANCE,
                residual.as_mut_ptr(),
                basis as c_int,
                basis_vectors.as_mut_ptr(),
                n as c_int,
                iparam.as_mut_ptr(),
                ipntr.as_mut_ptr(),
                workd.as_mut_ptr(),
                workl.as_mut_ptr(),
                workl.len() as c_int,
                &mut info,
            );
        }
        let part = |pointer: c_int| pointer as usize - 1..pointer as usize - 1 + n;
        match ido {
            -1 => {
                mass(&workd[part(ipntr[0])], &mut scratch);
                solve(&scratch, &mut workd[part(ipntr[1])]);
            }
            1 => {
                scratch.copy_from_slice(&workd[part(ipntr[2])]);
                solve(&scratch, &mut workd[part(ipntr[1])]);
            }
            2 => {
                scratch.copy_from_slice(&workd[part(ipntr[0])]);
                mass(&scratch, &mut workd[part(ipntr[1])]);
            }
            _ => break,
        }
    }
    if info == 1 || (info == 0 && (iparam[4] as usize) < count) {
        let [converged, restarts] = [4, 2].map(|place| iparam[place].max(0) as usize);
        return Err(LinalgError::not_converged(count, converged, restarts));
    }
    if info != 0 {
        return Err(refused("dsaupd", info));
    }
    let mut values = vec![0.0; count];
    let mut vectors = vec![0.0; n * count];
    let select = vec![0 as c_int; basis];
    // SAFETY: the buffers are what the last `dsaupd_c` left; `values`, `vectors` and `select` have the
    // lengths nev, n*nev and ncv that `dseupd_c` asks for.
    unsafe {
        dseupd_c(
            1,
            c"A".as_ptr(),
            select.as_ptr(),
            values.as_mut_ptr(),
            vectors.as_mut_ptr(),
            n as c_int,
            sigma,
            bmat.as_ptr(),
            n as c_int,
            which.as_ptr(),
            count as c_int,
            TOLERANCE,
            residual.as_mut_ptr(),
            basis as c_int,
            basis_vectors.as_mut_ptr(),
            n as c_int,
            iparam.as_mut_ptr(),
            ipntr.as_mut_ptr(),
            workd.as_mut_ptr(),
            workl.as_mut_ptr(),
            workl.len() as c_int,
            &mut info,
        );
    }
    if info == 0 { Ok((values, vectors)) } else { Err(refused("dseupd", info)) }
}

/// ARPACK refused its input; an error of this program.
fn refused(routine: &str, info: c_int) -> LinalgError {
    LinalgError::Iteration(format!("ARPACK routine {routine} returned info = {info}"))
}

/// A fixed start vector without symmetry, so that no mode is orthogonal to it by accident: the
/// fractional parts of multiples of the golden ratio, in (-1/2, 1/2).
fn start_vector(n: usize) -> Vec<f64> {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    (1..=n).map(|index| (index as f64 * golden).fract() - 0.5).collect()
}
