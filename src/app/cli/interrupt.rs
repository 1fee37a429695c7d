//! Signals: Ctrl-C and an end asked for by the system, the first of which asks a run to keep a checkpoint and stop, the second ends the
//! program; memory and file sizes that run out, which are failures like any other.

use super::CliError;
use crate::app::commands::run::unfinished::StopRequest;
use signal_hook::consts::{SIGABRT, SIGINT, SIGTERM, SIGXFSZ};
use signal_hook::flag;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

fn not_caught(error: io::Error) -> CliError {
    CliError::failed(format!("cannot catch interrupts: {error}"))
}

/// A request that the signals set. As long as nobody listens to it, a signal ends the program as if it were not caught.
///
/// # Errors
/// When the system does not let signals be caught.
pub(super) fn stop_request() -> Result<StopRequest, CliError> {
    let stop = StopRequest::default();
    stop.deaf.store(true, Ordering::SeqCst);
    for signal in [SIGINT, SIGTERM] {
        // in this order: the first signal finds nobody deaf, and leaves everybody so
        flag::register_conditional_default(signal, Arc::clone(&stop.deaf)).map_err(not_caught)?;
        flag::register(signal, Arc::clone(&stop.asked)).map_err(not_caught)?;
        flag::register(signal, Arc::clone(&stop.deaf)).map_err(not_caught)?;
    }
    Ok(stop)
}

/// Lets limits of the system end in exit code 1: an allocation that fails, which Rust answers by an abort after saying its size, and a
/// file that may not grow further, which then fails like any other writing.
///
/// # Errors
/// When the system does not let signals be caught.
pub(super) fn fail_at_limits() -> Result<(), CliError> {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        // matrices say so by a panic, whose backtrace would need memory too
        let payload = panic.payload();
        let text = payload.downcast_ref::<String>().map(String::as_str);
        let text = text.or_else(|| payload.downcast_ref::<&str>().copied());
        let text = text.unwrap_or_default();
        if text.contains("AllocError") {
            let _ = io::stderr().write_all(b"error: the memory does not suffice for a matrix\nhelp: raise its limit (ulimit -v), or use fewer --threads\n");
            signal_hook::low_level::exit(1);
        }
        usual(panic);
    }));
    let always = Arc::new(AtomicBool::new(true));
    flag::register_conditional_shutdown(SIGABRT, 1, Arc::clone(&always)).map_err(not_caught)?;
    flag::register(SIGXFSZ, always).map_err(not_caught)?;
    Ok(())
}
