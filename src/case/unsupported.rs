//! Keys of the case-file format that this version cannot honour. They are refused by name, never ignored.

use super::document::Document;
use super::error::CaseError;
use super::path::{Step, format_path};
use super::tree::{Mark, Node};

/// A key path and what to write instead.
struct Unsupported {
    path: &'static [&'static str],
    instead: &'static str,
}

const UNSUPPORTED: [Unsupported; 1] = [Unsupported {
    path: &["analysis", "scalogram"],
    instead: "leave the key out",
}];

/// Returns an error for the first thing in the document that this version cannot honour.
///
/// # Errors
/// [`CaseError::NotSupported`].
pub(super) fn refuse(document: &Document<'_>) -> Result<(), CaseError> {
    for entry in &UNSUPPORTED {
        let mut walked = Vec::new();
        if let Some(mark) = find(&document.root, entry.path, &mut walked) {
            return Err(CaseError::NotSupported {
                place: document.marked(Some(mark)),
                key: format_path(&walked),
                instead: entry.instead,
            });
        }
    }
    Ok(())
}

/// Returns the mark of what stands at a path below `node`; `walked` is then the path to it.
fn find(node: &Node, path: &'static [&'static str], walked: &mut Vec<Step>) -> Option<Mark> {
    let Some((first, rest)) = path.split_first() else {
        return Some(node.mark);
    };
    let step = Step::Key((*first).to_owned());
    let child = node.child(&step)?;
    walked.push(step);
    find(child, rest, walked)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{FULL, read};
    use super::UNSUPPORTED;

    /// One argument for each entry of the table, and the key that the error names.
    const SAMPLES: [(&str, &str); UNSUPPORTED.len()] =
        [("analysis.scalogram={from=2.2,to=2.5}", "analysis.scalogram")];

    #[test]
    fn every_entry_is_refused_by_name() {
        for ((argument, key), entry) in SAMPLES.into_iter().zip(&UNSUPPORTED) {
            let error = read(FULL, &[argument]).unwrap_err();
            assert_eq!(
                error.to_string(),
                format!("--set {argument}: `{key}` is not supported yet by this version")
            );
            assert_eq!(error.help().as_deref(), Some(entry.instead));
        }
    }

    #[test]
    fn its_line_is_found() {
        let text = FULL.replace(
            "[analysis]\n",
            "[analysis]\nscalogram = { from = 2.2, to = 2.5 }\n",
        );
        let is_it = |line: &str| line.starts_with("scalogram");
        let line = 1 + text.lines().position(is_it).unwrap();
        assert_eq!(
            read(&text, &[]).unwrap_err().to_string(),
            format!(
                "folder/case.toml:{line}: `analysis.scalogram` is not supported yet by this version"
            )
        );
    }

    #[test]
    fn a_word_that_no_version_knows_is_misspelt_not_unsupported() {
        let error = read(FULL, &["transient.method=newmrk-explicit"]).unwrap_err();
        assert!(
            error
                .help()
                .unwrap()
                .starts_with("did you mean `newmark-explicit`?")
        );
    }
}
