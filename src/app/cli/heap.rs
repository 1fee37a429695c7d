//! The C library's heap: how it keeps the memory that a computation frees, and what the program says when there is none left.
//!
//! By default glibc gives each thread a heap of its own, which hands freed matrices back to the system at once. The next matrix
//! then takes new pages, and the system clears each: a tenth of a condensation's time.
//!
//! **State.** Global to the process; set once, before the first thread starts. `GLIBC_TUNABLES` counts no more for these three.

use signal_hook::consts::SIGABRT;
use std::ffi::{c_int, c_void};
use std::io;

/// Parameters of `mallopt` (glibc manual, section 3.2.3.7).
const TRIM_THRESHOLD: c_int = -1;
const MMAP_THRESHOLD: c_int = -3;
const ARENA_MAX: c_int = -8;

/// Freed bytes at the end of the heap from which on the system gets them back.
const KEPT: c_int = 256 << 20;

/// Bytes from which on a block has pages of its own, which the system gets back when it is freed. With larger values two
/// threads leave gaps: 2.7 instead of 2.3 GB at 244 242 degrees of freedom.
const OWN_PAGES: c_int = 32 << 20;

/// What an abort says: an allocation that fails ends so, after Rust has told its size. Another thread may have told half of its
/// own, hence the line break.
const ABORTED: &str = "\nerror: the program was aborted; most likely the memory does not suffice\n\
    help: raise its limit (ulimit -v, a container's), use fewer --threads, or compute a coarser mesh\n";

unsafe extern "C" {
    fn mallopt(parameter: c_int, value: c_int) -> c_int;
    fn write(file: c_int, bytes: *const c_void, count: usize) -> isize;
}

/// All threads share one heap, which keeps freed memory for the next matrix.
pub(super) fn keep_freed_memory() {
    for (parameter, value) in [(ARENA_MAX, 1), (MMAP_THRESHOLD, OWN_PAGES), (TRIM_THRESHOLD, KEPT)] {
        // SAFETY: `mallopt` takes two integers and changes where later blocks come from; blocks that exist stay valid. Parameters
        // that it does not know it refuses.
        unsafe { mallopt(parameter, value) };
    }
}

/// Lets an abort say what to do, and end with exit code 1.
///
/// # Errors
/// When the system does not let signals be caught.
pub(super) fn explain_aborts() -> io::Result<()> {
    let say = || {
        // SAFETY: `write` is safe in a signal handler; the text is as long as it says, and lives as long as the program.
        unsafe { write(2, ABORTED.as_ptr().cast(), ABORTED.len()) };
        signal_hook::low_level::exit(1);
    };
    // SAFETY: the action allocates nothing, takes no lock and cannot panic; exit is safe in a signal handler.
    unsafe { signal_hook::low_level::register(SIGABRT, say) }.map(|_| ())
}
