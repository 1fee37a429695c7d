//! Ctrl-C and an end asked for by the system: the first asks a run to keep a checkpoint and stop, the second ends the program.

use crate::stages::StopRequest;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;
use std::io;
use std::sync::Arc;
use std::sync::atomic::Ordering;

/// A request that the signals set. As long as nobody listens to it, a signal ends the program as if it were not caught.
///
/// # Errors
/// When the system does not let signals be caught.
pub(super) fn stop_request() -> io::Result<StopRequest> {
    let stop = StopRequest::default();
    stop.deaf.store(true, Ordering::SeqCst);
    for signal in [SIGINT, SIGTERM] {
        // in this order: the first signal finds nobody deaf, and leaves everybody so
        flag::register_conditional_default(signal, Arc::clone(&stop.deaf))?;
        flag::register(signal, Arc::clone(&stop.asked))?;
        flag::register(signal, Arc::clone(&stop.deaf))?;
    }
    Ok(stop)
}
