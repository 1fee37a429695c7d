//! What a computation hands back, and how it is shown.

use std::io::Write;
use std::path::PathBuf;

use super::{CliError, Options, emit};

/// What a command computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// A few lines for a reader, without a line end after the last.
    pub summary: String,
    /// The content of the command's result file.
    pub result: serde_json::Value,
    /// The files that were written, the most useful last.
    pub written: Vec<PathBuf>,
    /// What is bad about the answer, or wrong in some of the input; results are written all the same.
    pub verdict: Result<(), CliError>,
}

impl Outcome {
    /// Writes the result: as JSON if asked for, else summary and files, else (quiet) nothing.
    ///
    /// # Errors
    /// [`CliError`] when `to` cannot be written; a closed pipe is none.
    pub(crate) fn show(&self, options: &Options, to: &mut impl Write) -> Result<(), CliError> {
        if options.json {
            return emit(to, &format!("{:#}", self.result));
        }
        if options.quiet {
            return Ok(());
        }
        emit(to, &self.summary)?;
        for path in &self.written {
            emit(to, &format!("wrote {}", path.display()))?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use super::{Options, Outcome};

    fn shown(options: &Options) -> String {
        let outcome = Outcome {
            summary: "8.2 kHz\n11.3 kHz".to_owned(),
            result: serde_json::json!({ "command": "modes" }),
            written: vec![PathBuf::from("out/a/modes.json")],
            verdict: Ok(()),
        };
        let mut written = Vec::new();
        outcome.show(options, &mut written).unwrap();
        String::from_utf8(written).unwrap()
    }

    #[test]
    fn summary_json_or_nothing() {
        let plain = Options::default();
        assert_eq!(shown(&plain), "8.2 kHz\n11.3 kHz\nwrote out/a/modes.json\n");
        let json = Options { json: true, quiet: true, ..Options::default() };
        assert_eq!(shown(&json), "{\n  \"command\": \"modes\"\n}\n");
        let quiet = Options { quiet: true, ..Options::default() };
        assert_eq!(shown(&quiet), "");
    }
}
