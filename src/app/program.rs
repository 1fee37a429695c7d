//! Which program this is: the file of its code, the words that call it again, and the arguments it was given.
//!
//! The command line is the process itself unless a host says otherwise: a Python interpreter has loaded this library, and
//! neither its own file nor its arguments are this program's.

use std::ffi::OsString;
use std::io;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

/// What a host tells of the program that it has loaded.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Program {
    /// The file that holds the code; results that are kept for later belong to its content.
    pub code: PathBuf,
    /// The words that start the program again; its arguments follow them.
    pub call: Vec<OsString>,
}

static HOST: OnceLock<Program> = OnceLock::new();
static ARGUMENTS: OnceLock<Vec<OsString>> = OnceLock::new();

impl Program {
    /// Says once for this process which program it is. A second call changes nothing.
    pub fn declare(self) {
        let _ = HOST.set(self);
    }

    /// The program that was declared, else the process's own file.
    ///
    /// # Errors
    /// What the system says when it does not know the process's file.
    pub(crate) fn this() -> io::Result<Self> {
        match HOST.get() {
            Some(host) => Ok(host.clone()),
            None => {
                let own = std::env::current_exe()?;
                Ok(Self { call: vec![own.clone().into_os_string()], code: own })
            }
        }
    }

    /// A process of this program, its arguments still to be given.
    pub(in crate::app) fn command(&self) -> Command {
        let mut words = self.call.iter();
        let mut command = Command::new(words.next().map_or(self.code.as_os_str(), OsString::as_os_str));
        command.args(words);
        command
    }
}

/// Says once which arguments the command line has; without it they are the process's.
pub(in crate::app) fn declare_arguments(arguments: Vec<OsString>) {
    let _ = ARGUMENTS.set(arguments);
}

/// The arguments of the command line, the program's name left out.
pub(in crate::app) fn arguments() -> Vec<OsString> {
    ARGUMENTS.get().cloned().unwrap_or_else(|| std::env::args_os().skip(1).collect())
}
