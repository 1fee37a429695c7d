//! Keys and values of the case-file format that this version cannot honour. They are refused by name, never ignored.

use super::document::Document;
use super::error::CaseError;
use super::path::{Step, format_path};
use super::tree::{Mark, Node, Value};

/// What under a key is not supported.
#[derive(Debug, Clone, Copy)]
enum Extent {
    /// The key at all.
    Key,
    /// This word.
    Word(&'static str),
}

/// A key path, what of it is refused, and what to write instead.
struct Unsupported {
    path: &'static [&'static str],
    extent: Extent,
    instead: &'static str,
}

const fn refused(
    path: &'static [&'static str],
    extent: Extent,
    instead: &'static str,
) -> Unsupported {
    Unsupported {
        path,
        extent,
        instead,
    }
}

const OTHER_METHOD: &str = "use \"auto\", \"exponential\", \"exponential-adams\", \"newmark-explicit\", \"newmark\", \"generalized-alpha\" or \"splitting\"";

const UNSUPPORTED: [Unsupported; 3] = [
    refused(&["transient", "ensemble"], Extent::Key, "leave the key out"),
    refused(
        &["transient", "method"],
        Extent::Word("dop853"),
        OTHER_METHOD,
    ),
    refused(&["analysis", "scalogram"], Extent::Key, "leave the key out"),
];

/// Returns an error for the first thing in the document that this version cannot honour.
///
/// # Errors
/// [`CaseError::NotSupported`].
pub(super) fn refuse(document: &Document<'_>) -> Result<(), CaseError> {
    for entry in &UNSUPPORTED {
        let mut walked = Vec::new();
        if let Some(mark) = find(&document.root, entry.path, entry.extent, &mut walked) {
            let path = format_path(&walked);
            return Err(CaseError::NotSupported {
                place: document.marked(Some(mark)),
                key: match entry.extent {
                    Extent::Word(word) => format!("{path} = \"{word}\""),
                    Extent::Key => path,
                },
                instead: entry.instead,
            });
        }
    }
    Ok(())
}

/// Returns the mark of a match below `node`; `walked` is then the path to it.
fn find(
    node: &Node,
    path: &'static [&'static str],
    extent: Extent,
    walked: &mut Vec<Step>,
) -> Option<Mark> {
    let Some((first, rest)) = path.split_first() else {
        let matches = match extent {
            Extent::Key => true,
            Extent::Word(word) => matches!(&node.value, Value::Text(text) if text == word),
        };
        return matches.then_some(node.mark);
    };
    let step = Step::Key((*first).to_owned());
    let child = node.child(&step)?;
    walked.push(step);
    find(child, rest, extent, walked)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{FULL, read};
    use super::UNSUPPORTED;

    /// One argument for each entry of the table, and the key that the error names.
    const SAMPLES: [(&str, &str); UNSUPPORTED.len()] = [
        ("transient.ensemble={runs=64}", "transient.ensemble"),
        ("transient.method=dop853", "transient.method = \"dop853\""),
        ("analysis.scalogram={from=2.2,to=2.5}", "analysis.scalogram"),
    ];

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
        let text = FULL.replace("[transient]\n", "[transient]\nensemble = { runs = 64 }\n");
        let is_it = |line: &str| line.starts_with("ensemble");
        let line = 1 + text.lines().position(is_it).unwrap();
        assert_eq!(
            read(&text, &[]).unwrap_err().to_string(),
            format!(
                "folder/case.toml:{line}: `transient.ensemble` is not supported yet by this version"
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
