//! Lines of a universal file, with their numbers.

use super::super::fortran::{columns, quoted, real, take_line};
use crate::files::Fault;

/// A line and its number, counted from 1.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Line {
    pub(super) number: u64,
    pub(super) text: String,
}

impl Line {
    /// Whether the line begins or ends a dataset.
    pub(super) fn is_delimiter(&self) -> bool {
        self.text.trim() == "-1"
    }

    pub(super) fn fault(&self, expected: &'static str) -> Fault {
        Fault::new(expected, quoted(&self.text)).line(self.number)
    }

    /// The line, unless it ends a dataset.
    pub(super) fn within(self, expected: &'static str) -> Result<Self, Fault> {
        if self.is_delimiter() { Err(self.fault(expected)) } else { Ok(self) }
    }

    /// Whole numbers, in columns of 10 where they run together.
    pub(super) fn integers(&self, expected: &'static str) -> Result<Vec<i64>, Fault> {
        const WIDTH: usize = 10;
        let words: Vec<&str> = self.text.split_ascii_whitespace().collect();
        let words = if words.iter().any(|word| word.len() > WIDTH) { columns(&self.text, WIDTH) } else { words };
        let numbers: Option<Vec<i64>> = words.iter().map(|word| word.parse().ok()).collect();
        numbers.ok_or_else(|| self.fault(expected))
    }

    /// Real numbers, in columns of `width` where they run together.
    pub(super) fn reals(&self, width: usize, expected: &'static str) -> Result<Vec<f64>, Fault> {
        let words: Option<Vec<f64>> = self.text.split_ascii_whitespace().map(real).collect();
        let columns = || columns(&self.text, width).into_iter().map(real).collect();
        words.or_else(columns).ok_or_else(|| self.fault(expected))
    }
}

/// Where reading is. Bytes, not text: a dataset 58b has binary numbers, comments may be in any encoding.
#[derive(Debug)]
pub(super) struct Cursor<'a> {
    rest: &'a [u8],
    line: u64,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes, line: 0 }
    }

    /// The next line, if there is one.
    pub(super) fn next(&mut self) -> Option<Line> {
        let line = take_line(&mut self.rest)?;
        self.line += 1;
        Some(Line { number: self.line, text: String::from_utf8_lossy(line).into_owned() })
    }

    /// The next line, or what was expected there.
    pub(super) fn expect(&mut self, expected: &'static str) -> Result<Line, Fault> {
        let line = self.line + 1;
        self.next().ok_or_else(|| Fault::new(expected, "the end of the file").line(line))
    }

    /// The next line that is not blank, or what was expected there.
    pub(super) fn expect_text(&mut self, expected: &'static str) -> Result<Line, Fault> {
        loop {
            let line = self.expect(expected)?;
            if !line.text.trim().is_empty() {
                return Ok(line);
            }
        }
    }

    /// The next line with text of a dataset; `None` at the line that ends it.
    pub(super) fn entry(&mut self, expected: &'static str) -> Result<Option<Line>, Fault> {
        Ok(Some(self.expect_text(expected)?).filter(|line| !line.is_delimiter()))
    }

    /// Real numbers from one or more lines, `count` of them; what follows them in the last line is left out.
    pub(super) fn reals(&mut self, count: usize, width: usize, expected: &'static str) -> Result<Vec<f64>, Fault> {
        let mut numbers = Vec::new();
        while numbers.len() < count {
            numbers.extend(self.expect_text(expected)?.within(expected)?.reals(width, expected)?);
        }
        numbers.truncate(count);
        Ok(numbers)
    }

    /// Goes past the line that ends a dataset.
    pub(super) fn skip(&mut self) -> Result<(), Fault> {
        while !self.expect("-1 at the end of a dataset")?.is_delimiter() {}
        Ok(())
    }

    /// The line with the next dataset's number, if there is one; text between datasets means nothing.
    pub(super) fn next_dataset(&mut self) -> Option<Line> {
        while !self.next()?.is_delimiter() {}
        std::iter::from_fn(|| self.next()).find(|line| !line.text.trim().is_empty())
    }

    /// Whether a line that begins or ends a dataset follows so many bytes.
    pub(super) fn delimiter_after(&self, bytes: usize) -> bool {
        let rest = self.rest.get(bytes..).unwrap_or_default();
        let mut lines = rest.trim_ascii_start().split(|&byte| byte == b'\n');
        lines.next().is_some_and(|line| line.trim_ascii() == b"-1")
    }

    /// Takes bytes that are no text: as many as there are at most.
    pub(super) fn take(&mut self, bytes: usize) -> &'a [u8] {
        let (taken, rest) = self.rest.split_at(bytes.min(self.rest.len()));
        self.rest = rest;
        taken
    }
}
