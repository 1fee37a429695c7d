//! Numbers one after the other, from ASCII or binary, with the place where each was found.

use super::{MshError, Place};

/// How the numbers of a file are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    /// Decimal digits between blanks.
    Ascii,
    /// 4-byte int, 8-byte double, `size_bytes` (4 or 8) for size_t.
    Binary { big_endian: bool, size_bytes: usize },
}

/// A position in the bytes of a file, inside a section.
#[derive(Debug, Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    position: usize,
    /// Line of `position`, from 1; counted in ASCII files and between sections.
    line: usize,
    pub(super) encoding: Encoding,
    /// Name of the section being read, for messages.
    pub(super) section: String,
    /// Where the number read last began.
    place: Place,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            position: 0,
            line: 1,
            encoding: Encoding::Ascii,
            section: String::new(),
            place: Place::Line(1),
        }
    }

    pub(super) fn position(&self) -> usize {
        self.position
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    /// Where the number read last began.
    pub(super) fn place(&self) -> Place {
        self.place
    }

    fn here(&self) -> Place {
        match self.encoding {
            Encoding::Ascii => Place::Line(self.line),
            Encoding::Binary { .. } => Place::Byte(self.position),
        }
    }

    /// Makes the current position the place that messages name.
    pub(super) fn mark(&mut self) {
        self.place = self.here();
    }

    /// Goes forward, never past the end, and returns what was passed over.
    pub(super) fn advance(&mut self, count: usize) -> &'a [u8] {
        let end = self.position.saturating_add(count).min(self.bytes.len());
        let passed = &self.bytes[self.position..end];
        self.line += passed.iter().filter(|&&byte| byte == b'\n').count();
        self.position = end;
        passed
    }

    pub(super) fn skip_blanks(&mut self) {
        let rest = self.rest();
        let blanks = rest.iter().take_while(|byte| byte.is_ascii_whitespace());
        self.advance(blanks.count());
        self.mark();
    }

    /// The rest of the line without its end, which is passed over.
    pub(super) fn take_line(&mut self) -> &'a [u8] {
        self.mark();
        let rest = self.rest();
        let length = rest.iter().position(|&byte| byte == b'\n');
        let line = self.advance(length.map_or(rest.len(), |length| length + 1));
        line.trim_ascii_end()
    }

    /// The next run of bytes that are not blank; empty at the end of the file.
    pub(super) fn take_word(&mut self) -> &'a [u8] {
        self.skip_blanks();
        let rest = self.rest();
        let word = rest.iter().take_while(|byte| !byte.is_ascii_whitespace());
        self.advance(word.count())
    }

    pub(super) fn malformed(&self, expected: impl Into<String>, found: &[u8]) -> MshError {
        MshError::Malformed {
            section: self.section.clone(),
            place: self.place,
            expected: expected.into(),
            found: quoted(found),
        }
    }

    pub(super) fn truncated(&self, expected: impl Into<String>) -> MshError {
        MshError::Truncated {
            section: self.section.clone(),
            expected: expected.into(),
        }
    }

    fn binary<const N: usize>(&mut self, what: &str) -> Result<[u8; N], MshError> {
        self.mark();
        let bytes = self.rest().first_chunk().copied();
        // lines are not counted inside binary numbers
        self.position = self.position.saturating_add(N).min(self.bytes.len());
        bytes.ok_or_else(|| self.truncated(what))
    }

    /// A decimal number that `accepts` and that fits its type.
    fn ascii<T: std::str::FromStr>(
        &mut self,
        what: &str,
        accepts: fn(&[u8]) -> bool,
    ) -> Result<T, MshError> {
        let word = self.take_word();
        if word.is_empty() {
            return Err(self.truncated(what));
        }
        let text = std::str::from_utf8(word).ok().filter(|_| accepts(word));
        text.and_then(|text| text.parse().ok())
            .ok_or_else(|| self.malformed(what, word))
    }

    /// gmsh's size_t.
    pub(super) fn size(&mut self, what: &str) -> Result<u64, MshError> {
        match self.encoding {
            Encoding::Ascii => self.ascii(what, |word| word.iter().all(u8::is_ascii_digit)),
            Encoding::Binary {
                big_endian,
                size_bytes: 4,
            } => {
                let bytes = self.binary(what)?;
                let pick = if big_endian {
                    u32::from_be_bytes
                } else {
                    u32::from_le_bytes
                };
                Ok(u64::from(pick(bytes)))
            }
            Encoding::Binary { big_endian, .. } => {
                let bytes = self.binary(what)?;
                let pick = if big_endian {
                    u64::from_be_bytes
                } else {
                    u64::from_le_bytes
                };
                Ok(pick(bytes))
            }
        }
    }

    /// gmsh's int.
    pub(super) fn int(&mut self, what: &str) -> Result<i32, MshError> {
        match self.encoding {
            Encoding::Ascii => self.ascii(what, |word| {
                let digits = word.strip_prefix(b"-").unwrap_or(word);
                digits.iter().all(u8::is_ascii_digit)
            }),
            Encoding::Binary { big_endian, .. } => {
                let bytes = self.binary(what)?;
                let pick = if big_endian {
                    i32::from_be_bytes
                } else {
                    i32::from_le_bytes
                };
                Ok(pick(bytes))
            }
        }
    }

    /// gmsh's double; may be infinite or not a number.
    pub(super) fn float(&mut self, what: &str) -> Result<f64, MshError> {
        match self.encoding {
            Encoding::Ascii => self.ascii(what, |_| true),
            Encoding::Binary { big_endian, .. } => {
                let bytes = self.binary(what)?;
                let pick = if big_endian {
                    f64::from_be_bytes
                } else {
                    f64::from_le_bytes
                };
                Ok(pick(bytes))
            }
        }
    }

    /// A count of items that take at least `numbers` numbers each, checked against what is left of the
    /// file: nothing is allocated for a count that cannot be true.
    pub(super) fn count(&mut self, what: &str, numbers: usize) -> Result<usize, MshError> {
        let declared = self.size(what)?;
        let remaining = self.rest().len();
        // a number takes a digit and a blank, or at least four bytes
        let bytes = match self.encoding {
            Encoding::Ascii => 2,
            Encoding::Binary { .. } => 4,
        };
        usize::try_from(declared)
            .ok()
            .filter(|&count| count <= remaining / (bytes * numbers.max(1)) + 1)
            .ok_or_else(|| MshError::Count {
                section: self.section.clone(),
                place: self.place,
                what: what.to_owned(),
                declared,
                remaining,
            })
    }
}

/// The beginning of some bytes, for a message.
pub(super) fn quoted(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let shown: String = String::from_utf8_lossy(bytes)
        .chars()
        .filter(|c| !c.is_control())
        .take(LONGEST)
        .collect();
    if bytes.is_empty() {
        "nothing".to_owned()
    } else {
        format!("\"{shown}\"")
    }
}
