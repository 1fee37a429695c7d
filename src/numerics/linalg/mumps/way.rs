//! How MUMPS keeps a factor.

use std::fmt;

/// How MUMPS keeps a factor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::numerics::linalg) enum Way {
    /// All entries in memory.
    InCore,
    /// In memory, blocks far from the diagonal as products of low rank.
    LowRank,
    /// Entries in files, fronts in memory.
    OutOfCore,
}

impl Way {
    /// The way in which no entry is left out: files hold what low rank would have made small.
    pub(super) fn exact(self) -> Self {
        if self == Self::LowRank { Self::OutOfCore } else { self }
    }
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::InCore => "in core",
            Self::LowRank => "low rank",
            Self::OutOfCore => "out of core",
        })
    }
}
