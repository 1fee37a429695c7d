//! The threads that compute: a pool of this process, apart from rayon's global one, which a fork leaves without its threads.

use crate::errors;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, PoisonError};

/// Stack of each thread, bytes: what the program gives the one that computes.
const STACK: usize = 8 << 20;

/// How many threads are asked for, and the pool with the process that it is of.
struct Threads {
    asked: usize,
    pool: Option<(u32, Arc<ThreadPool>)>,
}

static THREADS: Mutex<Threads> = Mutex::new(Threads { asked: 0, pool: None });

/// The pool of this process, made when it is first needed.
pub(crate) fn pool(py: Python<'_>) -> PyResult<Arc<ThreadPool>> {
    let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    let process = std::process::id();
    match threads.pool.take() {
        Some((of, pool)) if of == process => {
            threads.pool = Some((of, Arc::clone(&pool)));
            return Ok(pool);
        }
        // of the process that this one was forked from: its threads are not here, and nothing can be said to them
        Some((_, pool)) => std::mem::forget(pool),
        None => {}
    }
    // a thread that begins without memory ends the process before anything can be said
    let mut room: Vec<u8> = Vec::new();
    if room.try_reserve_exact(threads.asked.saturating_mul(STACK)).is_err() {
        return Err(errors::failed(
            py,
            format_args!("{} threads cannot be started: the memory does not suffice", threads.asked),
        ));
    }
    drop(std::hint::black_box(room));
    let made = ThreadPoolBuilder::new().num_threads(threads.asked).stack_size(STACK).build();
    let pool =
        Arc::new(made.map_err(|error| {
            errors::failed(py, format_args!("the threads that compute cannot be started: {error}"))
        })?);
    threads.pool = Some((process, Arc::clone(&pool)));
    Ok(pool)
}

/// Lets go of the pool: the next computation makes another.
pub(crate) fn renew() {
    let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, pool)) = threads.pool.take() {
        // a thread that does not answer keeps it
        std::mem::forget(pool);
    }
}

/// Takes so many threads from now on; None: one for each core that the system gives. Results do not depend on it.
#[pyfunction]
pub(crate) fn set_threads(count: Option<NonZeroUsize>) {
    THREADS.lock().unwrap_or_else(PoisonError::into_inner).asked = count.map_or(0, NonZeroUsize::get);
    let mut threads = THREADS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((of, pool)) = threads.pool.take()
        && of != std::process::id()
    {
        std::mem::forget(pool);
    }
}

/// Number of threads.
#[pyfunction]
pub(crate) fn threads(py: Python<'_>) -> PyResult<usize> {
    Ok(pool(py)?.current_num_threads())
}
