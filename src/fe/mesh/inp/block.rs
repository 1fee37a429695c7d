//! A keyword of an input file with its lines, and the items of these.

use super::MshError;

/// An error at a line of the file.
#[cold]
pub(super) fn fault(line: usize, keyword: &str, what: impl std::fmt::Display) -> MshError {
    MshError(format!("line {line}, *{keyword}: {what}"))
}

/// Where a keyword stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Scope {
    /// In a file without parts, or outside of them.
    #[default]
    File,
    /// In the part of this number.
    Part(u32),
    /// In the assembly, outside of its instance.
    Assembly,
    /// In the instance itself.
    Instance,
}

/// A keyword that is read, with its data.
pub(super) struct Block<'a> {
    /// The keyword line with its continuations.
    pub(super) head: &'a [u8],
    /// What follows; the data end at the next keyword.
    pub(super) rest: Lines<'a>,
    /// Line of the keyword, from 1.
    pub(super) line: usize,
    pub(super) scope: Scope,
    /// The step that it stands in, from 1; 0: before the first.
    pub(super) step: usize,
}

/// Lines with their numbers, blank ones and comments left out.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    pub(super) bytes: &'a [u8],
    /// Where the line read last begins, and the next one.
    pub(super) start: usize,
    pub(super) next: usize,
    /// Number of the next line, from 1.
    pub(super) line: usize,
}

impl<'a> Iterator for Lines<'a> {
    type Item = (usize, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        while let rest @ [_, ..] = &self.bytes[self.next..] {
            let length = rest.iter().position(|&byte| byte == b'\n').map_or(rest.len(), |end| end + 1);
            let line = self.line;
            (self.start, self.next, self.line) = (self.next, self.next + length, line + 1);
            let text = rest[..length].trim_ascii();
            if !text.is_empty() && !text.starts_with(b"**") {
                return Some((line, text));
            }
        }
        None
    }
}

impl<'a> Block<'a> {
    /// Its lines with their numbers.
    pub(super) fn lines(&self) -> impl Iterator<Item = (usize, &'a [u8])> + use<'a> {
        self.rest.clone().take_while(|(_, text)| !text.starts_with(b"*"))
    }

    /// The keyword, in capitals without blanks.
    pub(super) fn keyword(&self) -> String {
        keyword(self.head)
    }

    /// A parameter as it is written, without quotes; empty if it has no value.
    pub(super) fn parameter(&self, name: &str) -> Option<String> {
        pieces(self.head).skip(1).find_map(|piece| {
            let mut sides = piece.splitn(2, |&byte| byte == b'=');
            let is_asked = capitals(sides.next()?) == name;
            let value = String::from_utf8_lossy(sides.next().unwrap_or_default());
            is_asked.then(|| value.trim().trim_matches('"').trim().to_owned())
        })
    }

    /// The same of a parameter that must be there.
    pub(super) fn required(&self, name: &str) -> Result<String, MshError> {
        let found = self.parameter(name).filter(|value| !value.is_empty());
        found.ok_or_else(|| self.fault(self.line, format_args!("expected {name}=..., found none")))
    }

    /// An error at one of its lines.
    pub(super) fn fault(&self, line: usize, what: impl std::fmt::Display) -> MshError {
        fault(line, &self.keyword(), what)
    }
}

/// The items of a line, between commas; a last comma has nothing behind it.
pub(super) fn items(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let line = line.strip_suffix(b",").unwrap_or(line);
    line.split(|&byte| byte == b',').map(<[u8]>::trim_ascii)
}

/// The parts of a keyword line between commas that are not in quotes.
fn pieces(head: &[u8]) -> impl Iterator<Item = &[u8]> {
    let mut quoted = false;
    head.split(move |&byte| {
        quoted ^= byte == b'"';
        byte == b',' && !quoted
    })
}

/// Text in capitals without blanks, as keywords and names are compared.
pub(super) fn capitals(text: &[u8]) -> String {
    let text = String::from_utf8_lossy(text);
    text.chars().filter(|c| !c.is_whitespace() && *c != '"').flat_map(char::to_uppercase).collect()
}

/// The keyword of a line, in capitals without blanks.
pub(super) fn keyword(head: &[u8]) -> String {
    let word = pieces(head).next().unwrap_or_default();
    capitals(&word[..word.len().min(LONGEST_KEYWORD)]).trim_start_matches('*').to_owned()
}

/// Longest keyword that messages and lists repeat.
const LONGEST_KEYWORD: usize = 40;
