//! The head of a document that is handed on: where the results come from, and who answers for them.

use serde::{Deserialize, Serialize};

/// A mesh file that the results rest on.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshFile {
    /// Its path as the case names it.
    pub path: String,
    /// Its hash with the name of the method ("SHA-256 9f86d0..."), if known.
    pub hash: Option<String>,
}

/// What stands in the head of a report beside title, date and version.
///
/// ```
/// use plummer::report::Document;
/// let head = Document::new().case("pedestal.toml").mesh("pedestal.msh", None).signed_by("Prepared by");
/// assert_eq!(head.signatures, ["Prepared by"]);
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Document {
    /// Case file.
    pub case: Option<String>,
    /// Mesh files.
    pub meshes: Vec<MeshFile>,
    /// Lines to be signed by hand on paper ("Prepared by", "Checked by").
    pub signatures: Vec<String>,
}

impl Document {
    /// A head without entries.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The head with the case file.
    #[must_use]
    pub fn case(mut self, path: impl Into<String>) -> Self {
        self.case = Some(path.into());
        self
    }

    /// The head with a mesh file more.
    #[must_use]
    pub fn mesh(mut self, path: impl Into<String>, hash: Option<String>) -> Self {
        self.meshes.push(MeshFile {
            path: path.into(),
            hash,
        });
        self
    }

    /// The head with a line more to be signed.
    #[must_use]
    pub fn signed_by(mut self, role: impl Into<String>) -> Self {
        self.signatures.push(role.into());
        self
    }
}

/// Text as a CSS string; only letters and digits are written as they are, so that it can end neither the string nor
/// the style element.
pub(super) fn css_string(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        if c.is_ascii_alphanumeric() || c == ' ' {
            out.push(c);
        } else {
            out.push_str(&format!("\\{:x} ", u32::from(c)));
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn css_strings_hold_what_is_in_them() {
        assert_eq!(css_string("Fan 2"), "\"Fan 2\"");
        assert_eq!(
            css_string("a\"}</style>"),
            "\"a\\22 \\7d \\3c \\2f style\\3e \""
        );
    }
}
