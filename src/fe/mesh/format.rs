//! How a mesh file was written.

use std::fmt;

use schemars::JsonSchema;
use serde::{Serialize, Serializer};

/// Version of gmsh's MSH format.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum MshVersion {
    /// 2.2, which gmsh wrote until version 3 and many programs still write.
    V22,
    /// 4.1, which gmsh has written since version 4.1.
    V41,
}

/// Version and encoding of an MSH file.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, JsonSchema)]
pub struct MshFormat {
    /// Version of the format.
    #[schemars(with = "String")]
    pub version: MshVersion,
    /// Binary numbers, not decimal digits.
    pub binary: bool,
}

impl fmt::Display for MshVersion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::V22 => "2.2",
            Self::V41 => "4.1",
        })
    }
}

impl fmt::Display for MshFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let encoding = if self.binary { "binary" } else { "ASCII" };
        write!(f, "MSH {} {encoding}", self.version)
    }
}

/// As in the file: "2.2" or "4.1".
impl Serialize for MshVersion {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formats_are_named_as_gmsh_names_them() {
        let format = MshFormat { version: MshVersion::V22, binary: true };
        assert_eq!(format.to_string(), "MSH 2.2 binary");
        assert_eq!(MshVersion::V41.to_string(), "4.1");
    }
}
