//! METIS's nested dissection behind one safe function.
//!
//! **Life cycle.** One call; METIS allocates and frees its own workspace and keeps nothing of ours.
//!
//! **State.** METIS 5 has no global state but the C library's random generator, which every call seeds anew (option -1:
//! its own fixed seed). Calls take turns: the same graph gives the same order, whatever other threads order.

use std::ffi::c_int;
use std::sync::{Mutex, PoisonError};

/// Whose turn it is.
static TURN: Mutex<()> = Mutex::new(());

/// Nodes above which separators are refined from both sides. Operations of a factorisation, GFlop, from one side and from
/// both, by seeds: 394 to 446 and 367 to 401 with 80 000 nodes, 1846 (one seed) and 1643 to 1685 with 160 000, 10.9 (one
/// seed) and 11.5 to 12.1 with 20 000. The difference is hardly larger than METIS's luck.
const LARGE: usize = 50_000;

/// An undirected graph: the neighbours of node i are `neighbours[starts[i]..starts[i + 1]]`, without i itself; each
/// edge is stored at both ends.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Graph {
    /// Where each node's neighbours begin, one more than nodes.
    pub starts: Vec<c_int>,
    /// Neighbours of all nodes.
    pub neighbours: Vec<c_int>,
    /// Number of unknowns of each node, at least 1.
    pub weights: Vec<c_int>,
}

/// Nested dissection order of a graph: `order[new] = old` (Karypis and Kumar, SIAM J. Sci. Comput. 20 (1998)
/// 359-392); `None` if METIS does not return one.
///
/// `METIS_NodeND` would take the process's handlers of SIGTERM and SIGABRT while it works, and jump back into METIS from any thread
/// that such a signal reaches. `METIS_NodeNDP`, its twin for ParMETIS, leaves them alone.
pub(super) fn nested_dissection(graph: &Graph) -> Option<Vec<usize>> {
    let nodes = graph.weights.len();
    if graph.neighbours.is_empty() {
        return Some((0..nodes).collect());
    }
    let count = c_int::try_from(nodes).ok()?;
    let mut options = [-1; metis_sys::METIS_NOPTIONS as usize];
    let (mut order, mut place) = (vec![0; nodes], vec![0; nodes]);
    // for one process: of parts and separators, of which none is asked for, the whole alone
    let mut sizes = [0];
    // METIS takes what it only reads by mutable pointers; copies keep the graph untouched whatever it does
    let (mut starts, mut neighbours, mut weights) =
        (graph.starts.clone(), graph.neighbours.clone(), graph.weights.clone());
    let _turn = TURN.lock().unwrap_or_else(PoisonError::into_inner);
    // SAFETY: `starts` has count + 1 entries that end at the length of `neighbours`, whose entries are below count
    // (checked by whoever makes a `Graph`: `ordering::graph`); `weights`, `order` and `place` have count entries, `options`
    // METIS_NOPTIONS and `sizes` 2 * 1 - 1; all outlive the call.
    let status = unsafe {
        metis_sys::METIS_SetDefaultOptions(options.as_mut_ptr());
        if nodes > LARGE {
            options[metis_sys::moptions_et_METIS_OPTION_RTYPE as usize] =
                metis_sys::mrtype_et_METIS_RTYPE_SEP2SIDED as c_int;
        }
        metis_sys::METIS_NodeNDP(
            count,
            starts.as_mut_ptr(),
            neighbours.as_mut_ptr(),
            weights.as_mut_ptr(),
            1,
            options.as_mut_ptr(),
            order.as_mut_ptr(),
            place.as_mut_ptr(),
            sizes.as_mut_ptr(),
        )
    };
    let found: Vec<usize> = order.iter().map(|&old| old as usize).collect();
    (status == metis_sys::rstatus_et_METIS_OK).then_some(found)
}
