//! The processes of `mpirun`: rank 0 runs the program, the others join its jobs of MUMPS and write nothing.
//!
//! **Life cycle.** [`joined`] begins MPI where `mpirun` or `srun` started the program. On rank 0 it returns at once, and whatever way
//! the program ends, at its exit the others are told and MPI ends. On the others it returns when rank 0 has ended.
//!
//! **State.** One message a job, from rank 0 to each other: [`Message`]. Between jobs the others sleep, and look for one
//! every few milliseconds, where MPI itself would take a whole core to wait.
//!
//! **Limitations**: OpenMPI, whose names of communicators and types these are.

use super::ffi::{self, Job, LONGEST_PATH, Real};
use super::files::MACHINE;
use super::structure::Structure;
use crate::numerics::linalg::{blas, launched};
use std::collections::HashMap;
use std::ffi::{OsStr, c_int, c_void};
use std::io::Write;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::DirBuilderExt;
use std::path::PathBuf;
use std::ptr::null_mut;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::time::Duration;
use std::{fs, io, thread};

/// Something of OpenMPI's that only its address is known of.
#[repr(C)]
struct Opaque([u8; 0]);

#[allow(non_upper_case_globals)]
unsafe extern "C" {
    static ompi_mpi_comm_world: Opaque;
    static ompi_mpi_byte: Opaque;
    fn MPI_Init_thread(argc: *mut c_int, argv: *mut c_void, required: c_int, provided: *mut c_int) -> c_int;
    fn MPI_Comm_rank(communicator: *const Opaque, rank: *mut c_int) -> c_int;
    fn MPI_Comm_size(communicator: *const Opaque, size: *mut c_int) -> c_int;
    fn MPI_Send(
        data: *const c_void,
        count: c_int,
        kind: *const Opaque,
        to: c_int,
        tag: c_int,
        communicator: *const Opaque,
    ) -> c_int;
    fn MPI_Recv(
        data: *mut c_void,
        count: c_int,
        kind: *const Opaque,
        from: c_int,
        tag: c_int,
        communicator: *const Opaque,
        status: *mut c_void,
    ) -> c_int;
    fn MPI_Iprobe(
        from: c_int,
        tag: c_int,
        communicator: *const Opaque,
        found: *mut c_int,
        status: *mut c_void,
    ) -> c_int;
    fn MPI_Finalize() -> c_int;
    fn MPI_Abort(communicator: *const Opaque, code: c_int) -> c_int;
    fn atexit(call: extern "C" fn()) -> c_int;
}

/// `MPI_THREAD_SERIALIZED`: calls come from any thread, one at a time.
const SERIALIZED: c_int = 2;

/// Tag of messages, which MUMPS's own communicators never see.
const TAG: c_int = 71;

/// How long a process that waits sleeps.
const PAUSE: Duration = Duration::from_millis(2);

static WORLD: OnceLock<World> = OnceLock::new();

/// Whether the others have been told that rank 0 ends.
static ENDED: AtomicBool = AtomicBool::new(false);

#[derive(Debug, Clone, Copy)]
struct World {
    rank: c_int,
    ranks: c_int,
}

/// A job for the other processes.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub(super) struct Message {
    /// A [`Job`], or [`LEAVE`].
    job: c_int,
    /// By what name the instance is known.
    name: c_int,
    double: c_int,
    symmetry: c_int,
    /// On how many BLAS works.
    threads: c_int,
    folder: [u8; LONGEST_PATH + 1],
}

/// In a message: the process may end.
const LEAVE: c_int = -3;

const LEAVING: Message =
    Message { job: LEAVE, name: 0, double: 0, symmetry: 0, threads: 1, folder: [0; LONGEST_PATH + 1] };

const LENGTH: c_int = size_of::<Message>() as c_int;

/// Begins MPI, if nobody has.
fn world() -> World {
    *WORLD.get_or_init(|| {
        let mut world = World { rank: 0, ranks: 1 };
        let mut provided = 0;
        // SAFETY: MPI begins once, by the cell; arguments may be null; the results are integers that outlive the calls.
        unsafe {
            MPI_Init_thread(null_mut(), null_mut(), SERIALIZED, &mut provided);
            MPI_Comm_rank(&raw const ompi_mpi_comm_world, &mut world.rank);
            MPI_Comm_size(&raw const ompi_mpi_comm_world, &mut world.ranks);
            if world.rank == 0 {
                atexit(end);
            }
        }
        world
    })
}

/// Number of processes that compute together: 1 if nothing started several.
pub(in crate::numerics::linalg) fn ranks() -> usize {
    WORLD.get().map_or(1, |world| world.ranks as usize)
}

/// Begins MPI where a launcher started the program. Whether this process has joined another one's jobs, until their end: it
/// has nothing left to do.
pub(crate) fn joined() -> bool {
    if !launched() || world().rank == 0 {
        return false;
    }
    serve();
    // SAFETY: MPI has begun, and this is its last call.
    unsafe { MPI_Finalize() };
    true
}

/// A name for a new instance, with what the others need to begin theirs.
pub(super) fn name(double: bool, symmetry: c_int, folder: &[u8]) -> Message {
    static NAMES: AtomicI32 = AtomicI32::new(0);
    // MUMPS needs MPI on one process too
    world();
    let mut path = [0; LONGEST_PATH + 1];
    path.iter_mut().take(LONGEST_PATH).zip(folder).for_each(|(to, &from)| *to = from);
    let name = NAMES.fetch_add(1, Ordering::Relaxed);
    let (double, threads) = (c_int::from(double), rayon::current_num_threads() as c_int);
    Message { job: Job::Begin as c_int, name, double, symmetry, threads, folder: path }
}

/// Tells the other processes of a job that this one begins next.
pub(super) fn tell(named: &Message, job: Job) {
    send(&Message { job: job as c_int, ..*named });
}

fn send(message: &Message) {
    for rank in 1..world().ranks {
        // SAFETY: MPI has begun; the message has as many bytes as are said, all of them initialised (integers and bytes without gaps).
        unsafe {
            MPI_Send(
                (&raw const *message).cast(),
                LENGTH,
                &raw const ompi_mpi_byte,
                rank,
                TAG,
                &raw const ompi_mpi_comm_world,
            );
        }
    }
}

fn received() -> Message {
    let mut message = LEAVING;
    loop {
        let mut found = 0;
        // SAFETY: MPI has begun; a status may be null; the message has room for as many bytes as are received, each of which is a
        // valid part of an integer or a byte.
        unsafe {
            MPI_Iprobe(0, TAG, &raw const ompi_mpi_comm_world, &mut found, null_mut());
            if found != 0 {
                let world = &raw const ompi_mpi_comm_world;
                MPI_Recv((&raw mut message).cast(), LENGTH, &raw const ompi_mpi_byte, 0, TAG, world, null_mut());
                return message;
            }
        }
        thread::sleep(PAUSE);
    }
}

/// Joins jobs until rank 0 ends.
fn serve() {
    let (mut single, mut double) = (HashMap::new(), HashMap::new());
    loop {
        let message = received();
        if message.job == LEAVE {
            break;
        }
        if message.double != 0 {
            join::<f64>(&mut double, &message);
        } else {
            join::<f32>(&mut single, &message);
        }
    }
}

fn join<T: Real>(instances: &mut HashMap<c_int, Box<Structure<T>>>, message: &Message) {
    let length = message.folder.iter().position(|&byte| byte == 0).unwrap_or(LONGEST_PATH);
    let folder = &message.folder[..length];
    let path = (length > 0).then(|| PathBuf::from(OsStr::from_bytes(folder)));
    let job = [Job::Begin, Job::End, Job::Analyse, Job::Factorise, Job::Solve];
    let Some(job) = job.into_iter().find(|job| *job as c_int == message.job) else { return };
    if job == Job::Begin {
        // on another machine it is not there yet
        if let Some(path) = &path
            && fs::DirBuilder::new().mode(0o700).create(path).is_ok()
        {
            let _ = fs::write(path.join(MACHINE), "of another");
        }
        instances.insert(message.name, ffi::empty(message.symmetry, folder));
    }
    if let Some(structure) = instances.get_mut(&message.name) {
        match blas::work_on(message.threads as usize) {
            Ok(_threads) => ffi::run(structure, job),
            Err(error) => {
                let _ = writeln!(io::stderr(), "error: process {} of {}: {error}", world().rank, world().ranks);
                abort();
            }
        }
    }
    if job == Job::End {
        instances.remove(&message.name);
        if let Some(path) = path {
            let _ = fs::remove_dir_all(path);
        }
    }
}

/// Ends the other processes and MPI before rank 0 ends.
pub(crate) fn leave() {
    if WORLD.get().is_some_and(|world| world.rank == 0) {
        end();
    }
}

/// The same, where the program exits before it comes to that.
extern "C" fn end() {
    if ENDED.swap(true, Ordering::SeqCst) {
        return;
    }
    match ffi::turn_at_once() {
        Some(_turn) => {
            send(&LEAVING);
            // SAFETY: MPI has begun, and nobody is in it: this is its last call.
            unsafe { MPI_Finalize() };
        }
        None => abort(),
    }
}

/// Ends all processes in the middle of a job.
pub(super) fn abort() {
    if WORLD.get().is_some_and(|world| world.ranks > 1) {
        // SAFETY: MPI has begun; this call is allowed at any time.
        unsafe { MPI_Abort(&raw const ompi_mpi_comm_world, 1) };
    }
}
