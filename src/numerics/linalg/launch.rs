//! How this process was started.

/// Variables of which each launcher of MPI sets one.
const LAUNCHED: [&str; 3] = ["OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK"];

/// Whether a launcher of MPI started this process, perhaps beside others.
pub(crate) fn launched() -> bool {
    LAUNCHED.iter().any(|name| std::env::var_os(name).is_some())
}
