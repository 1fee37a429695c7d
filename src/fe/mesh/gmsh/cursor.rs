//! A position in the bytes of a file: words, lines, and the place that messages name.

use super::MshError;
use std::fmt;

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
    pub(super) bytes: &'a [u8],
    pub(super) position: usize,
    /// Where the number or line read last began.
    pub(super) mark: usize,
    pub(super) encoding: Encoding,
    /// Name of the section being read, for messages.
    pub(super) section: String,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { bytes, position: 0, mark: 0, encoding: Encoding::Ascii, section: String::new() }
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        &self.bytes[self.position..]
    }

    pub(super) fn is_binary(&self) -> bool {
        self.encoding != Encoding::Ascii
    }

    /// Where the number or line read last began. Lines are counted now, not on the way.
    pub(super) fn place(&self) -> String {
        if self.is_binary() {
            return format!("byte {}", self.mark);
        }
        let before = &self.bytes[..self.mark];
        format!("line {}", 1 + before.iter().filter(|&&byte| byte == b'\n').count())
    }

    /// Makes the current position the place that messages name.
    pub(super) fn set_mark(&mut self) {
        self.mark = self.position;
    }

    /// Goes forward, never past the end, and returns what was passed over.
    fn advance(&mut self, count: usize) -> &'a [u8] {
        let end = self.position.saturating_add(count).min(self.bytes.len());
        let passed = &self.bytes[self.position..end];
        self.position = end;
        passed
    }

    /// Passes over blanks; what follows is the place that messages name.
    #[inline]
    pub(super) fn skip_blanks(&mut self) {
        while self.bytes.get(self.position).is_some_and(u8::is_ascii_whitespace) {
            self.position += 1;
        }
        self.set_mark();
    }

    /// The rest of the line without its end, which is passed over.
    pub(super) fn take_line(&mut self) -> &'a [u8] {
        self.set_mark();
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

    /// Passes over a section that is not read, to the line after its end.
    pub(super) fn skip_section(&mut self) -> Result<(), MshError> {
        let end = format!("$End{}", self.section);
        loop {
            if self.rest().starts_with(end.as_bytes()) {
                self.take_line();
                return Ok(());
            }
            if self.rest().is_empty() {
                return Err(self.truncated(end));
            }
            self.take_line();
        }
    }

    /// The end of the section that the cursor is in.
    pub(super) fn close_section(&mut self) -> Result<(), MshError> {
        let end = format!("$End{}", self.section);
        self.skip_blanks();
        let word = self.take_word();
        if word == end.as_bytes() {
            match self.take_line() {
                b"" => Ok(()),
                after => Err(self.malformed(format!("nothing after {end}"), after)),
            }
        } else if self.rest().is_empty() && end.as_bytes().starts_with(word) {
            Err(self.truncated(end))
        } else {
            Err(self.malformed(end, word))
        }
    }

    /// What is wrong where the number or line read last began.
    #[cold]
    pub(super) fn fault(&self, what: impl fmt::Display) -> MshError {
        MshError(format!("${}, {}: {what}", self.section, self.place()))
    }

    pub(super) fn malformed(&self, expected: impl fmt::Display, found: &[u8]) -> MshError {
        self.fault(format_args!("expected {expected}, found {}", quoted(found)))
    }

    /// The file ends before what was expected.
    #[cold]
    pub(super) fn truncated(&self, expected: impl fmt::Display) -> MshError {
        MshError(format!("the file ends inside ${}: expected {expected}; is it complete?", self.section))
    }

    /// A feature of gmsh that is not read, and what to do about it.
    pub(super) fn feature(&self, feature: &str, advice: &str) -> MshError {
        self.fault(format_args!("{feature} cannot be read; {advice}"))
    }
}

/// The first 40 characters of a text that may be of any length, without those that control a terminal.
pub(in crate::fe::mesh) fn short(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    // a character takes four bytes at most
    let start = &bytes[..bytes.len().min(4 * LONGEST)];
    String::from_utf8_lossy(start).chars().filter(|c| !c.is_control()).take(LONGEST).collect()
}

/// The beginning of some bytes, for a message.
pub(in crate::fe::mesh) fn quoted(bytes: &[u8]) -> String {
    let shown = short(bytes);
    if bytes.is_empty() {
        "nothing".to_owned()
    } else if shown.is_empty() {
        let digits: Vec<String> = bytes.iter().take(8).map(|b| format!("{b:02x}")).collect();
        format!("the bytes {}", digits.join(" "))
    } else {
        format!("\"{shown}\"")
    }
}
