//! An input file cut at its keywords, and the items of its lines.

use super::scope::{Scope, Scopes};
use super::{MshError, fault};
use crate::fe::mesh::gmsh::quoted;
use std::collections::BTreeMap;

/// Keywords that are read.
const READ: [&str; 5] = ["NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"];
/// Keywords that make nodes and elements, or change them: without these the mesh would be another one.
const MAKERS: [&str; 9] =
    ["NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "PARAMETER", "SYSTEM", "SYMMETRICMODELGENERATION"];
/// Keywords that hold nodes together or add mass and stiffness: results differ without them.
pub(super) const JOINTS: [&str; 18] = [
    "TIE",
    "MPC",
    "EQUATION",
    "RIGIDBODY",
    "COUPLING",
    "KINEMATICCOUPLING",
    "DISTRIBUTINGCOUPLING",
    "CONTACTPAIR",
    "CONTACT",
    "EMBEDDEDELEMENT",
    "PRE-TENSIONSECTION",
    "CYCLICSYMMETRYMODEL",
    "SPRING",
    "DASHPOT",
    "MASS",
    "NONSTRUCTURALMASS",
    "SHELLTOSOLIDCOUPLING",
    "FASTENER",
];

/// Distinct keywords that are listed as passed over.
const LISTED: usize = 64;

/// A keyword that is read, with its data.
pub(super) struct Block<'a> {
    /// The keyword line with its continuations.
    head: &'a [u8],
    /// What follows; the data end at the next keyword.
    rest: Lines<'a>,
    /// Line of the keyword, from 1.
    pub(super) line: usize,
    pub(super) scope: Scope,
}

/// The model data of a file.
pub(super) struct Deck<'a> {
    /// In the order of the file; of a file of several parts those of the instance.
    pub(super) blocks: Vec<Block<'a>>,
    /// Name of the one instance.
    pub(super) instance: Option<String>,
    /// Keywords that were passed over, with the line of the first of each.
    pub(super) passed_over: BTreeMap<String, usize>,
}

/// Lines with their numbers, blank ones and comments left out.
#[derive(Clone)]
struct Lines<'a> {
    bytes: &'a [u8],
    /// Where the line read last begins, and the next one.
    start: usize,
    next: usize,
    /// Number of the next line, from 1.
    line: usize,
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

fn keyword(head: &[u8]) -> String {
    let word = pieces(head).next().unwrap_or_default();
    capitals(&word[..word.len().min(LONGEST_KEYWORD)]).trim_start_matches('*').to_owned()
}

/// Longest keyword that messages and lists repeat.
const LONGEST_KEYWORD: usize = 40;

/// Whether a keyword line that ends in a comma goes on in this one: by its parameters, which no data have.
fn continues(line: &[u8]) -> bool {
    let flags = ["GENERATE", "UNSORTED", "INTERNAL"];
    !line.starts_with(b"*") && (line.contains(&b'=') || flags.contains(&capitals(line).trim_end_matches(',')))
}

impl<'a> Deck<'a> {
    /// Cuts a file up to its first step.
    ///
    /// # Errors
    /// What stands before the first keyword, other files that it includes, keywords that make nodes, and anything but one
    /// part in one place.
    pub(super) fn cut(bytes: &'a [u8]) -> Result<Self, MshError> {
        let mut deck = Self { blocks: Vec::new(), instance: None, passed_over: BTreeMap::new() };
        let mut scopes = Scopes::default();
        let mut lines = Lines { bytes, start: 0, next: 0, line: 1 };
        let mut before_first = true;
        while let Some((line, text)) = lines.next() {
            if !text.starts_with(b"*") {
                if before_first {
                    let found = quoted(text);
                    return Err(MshError(format!("line {line}: expected a keyword (*NODE, ...), found {found}")));
                }
                scopes.data(line, text)?;
                continue;
            }
            before_first = false;
            let (start, mut last) = (lines.start, text);
            while last.ends_with(b",") {
                let mut ahead = lines.clone();
                match ahead.next() {
                    Some((_, next)) if continues(next) => (last, lines) = (next, ahead),
                    _ => break,
                }
            }
            let head = bytes[start..lines.next].trim_ascii();
            let block = Block { head, rest: lines.clone(), line, scope: scopes.now };
            if keyword(head) == "STEP" {
                break;
            }
            deck.take(block, &mut scopes)?;
        }
        let instance = scopes.instance()?;
        deck.blocks.retain(|block| scopes.holds(block.scope));
        deck.instance = instance;
        Ok(deck)
    }

    /// The keywords of one kind, in the order of the file.
    pub(super) fn of(&self, keyword: &'static str) -> impl Iterator<Item = &Block<'a>> {
        self.blocks.iter().filter(move |block| block.keyword() == keyword)
    }

    /// The same without those of the assembly, whose nodes are reference points.
    pub(super) fn of_mesh(&self, keyword: &'static str) -> impl Iterator<Item = &Block<'a>> {
        self.of(keyword).filter(|block| !self.is_in_assembly(block))
    }

    /// Whether a keyword stands in the assembly, outside of its instance.
    pub(super) fn is_in_assembly(&self, block: &Block<'_>) -> bool {
        self.instance.is_some() && block.scope == Scope::Assembly
    }

    /// Keeps a keyword that is read, and refuses one that would make another mesh.
    fn take(&mut self, block: Block<'a>, scopes: &mut Scopes) -> Result<(), MshError> {
        let name = block.keyword();
        scopes.at_keyword(&name, &block)?;
        if READ.contains(&name.as_str()) {
            if block.parameter("INPUT").is_some() {
                return Err(include(&block));
            }
            self.blocks.push(block);
        } else if name == "INCLUDE" {
            return Err(include(&block));
        } else if MAKERS.contains(&name.as_str()) {
            let advice = "write the mesh out in full with the program that made it";
            return Err(
                block.fault(block.line, format_args!("nodes and elements that are generated cannot be read; {advice}"))
            );
        } else if self.passed_over.len() < LISTED {
            self.passed_over.entry(name).or_insert(block.line);
        }
        Ok(())
    }
}

fn include(block: &Block<'_>) -> MshError {
    let file = block.parameter("INPUT").unwrap_or_default();
    let file = quoted(file.as_bytes());
    block.fault(
        block.line,
        format_args!("found another file, {file}: expected the mesh in one file; put its text here, or name that file if it holds the whole mesh"),
    )
}
