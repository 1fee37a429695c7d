//! An input file cut at its keywords.

use super::MshError;
use super::block::{Block, Lines, Scope, capitals, keyword};
use super::scope::Scopes;
use crate::fe::mesh::gmsh::quoted;
use std::collections::BTreeMap;

/// Keywords that are read.
const READ: [&str; 5] = ["NODE", "ELEMENT", "NSET", "ELSET", "SURFACE"];
/// Keywords that say something of the case.
const OF_CASE: [&str; 6] = ["MATERIAL", "DENSITY", "ELASTIC", "SOLIDSECTION", "BOUNDARY", "TRANSFORM"];
/// Keywords in place of `*ELASTIC`. CalculiX 2.20 takes the last of all of these, and Abaqus refuses two.
pub(super) const OTHER_LAWS: [&str; 7] = [
    "HYPERELASTIC",
    "ANISOTROPICHYPERELASTIC",
    "HYPERFOAM",
    "HYPOELASTIC",
    "POROUSELASTIC",
    "DEFORMATIONPLASTICITY",
    "USERMATERIAL",
];
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

/// The model data of a file.
pub(super) struct Deck<'a> {
    /// In the order of the file; of a file of several parts those of the instance.
    pub(super) blocks: Vec<Block<'a>>,
    /// Name of the one instance, in capitals.
    pub(super) instance: Option<String>,
    /// How far it is moved, in the file's unit.
    pub(super) shift: [f64; 3],
    /// Keywords that were passed over, with the line of the first of each.
    pub(super) passed_over: BTreeMap<String, usize>,
    /// Number of steps, and the first that has *FREQUENCY.
    pub(super) steps: usize,
    pub(super) frequency: Option<usize>,
}

/// Whether a keyword line that ends in a comma goes on in this one: by its parameters, which no data have.
fn continues(line: &[u8]) -> bool {
    let flags = ["GENERATE", "UNSORTED", "INTERNAL"];
    !line.starts_with(b"*") && (line.contains(&b'=') || flags.contains(&capitals(line).trim_end_matches(',')))
}

impl<'a> Deck<'a> {
    /// Cuts a file up to its first step; of the steps boundaries and their axes alone are kept.
    ///
    /// # Errors
    /// Other files that it includes, keywords that make nodes, and anything but one
    /// part in one place.
    pub(super) fn cut(bytes: &'a [u8]) -> Result<Self, MshError> {
        let mut deck = Self {
            blocks: Vec::new(),
            instance: None,
            shift: [0.0; 3],
            passed_over: BTreeMap::new(),
            steps: 0,
            frequency: None,
        };
        let mut scopes = Scopes::default();
        let mut lines = Lines { bytes, start: 0, next: 0, line: 1 };
        while let Some((line, text)) = lines.next() {
            // what stands before the first keyword is passed over, as CalculiX does
            if !text.starts_with(b"*") {
                if deck.steps == 0 {
                    scopes.data(line, text)?;
                }
                continue;
            }
            let (start, mut last) = (lines.start, text);
            while last.ends_with(b",") {
                let mut ahead = lines.clone();
                match ahead.next() {
                    Some((_, next)) if continues(next) => (last, lines) = (next, ahead),
                    _ => break,
                }
            }
            let head = bytes[start..lines.next].trim_ascii();
            let block = Block { head, rest: lines.clone(), line, scope: scopes.now, step: deck.steps };
            match keyword(head).as_str() {
                "STEP" => deck.steps += 1,
                "BOUNDARY" | "TRANSFORM" | "INCLUDE" if deck.steps > 0 => deck.blocks.push(block),
                "FREQUENCY" if deck.steps > 0 => deck.frequency = deck.frequency.or(Some(deck.steps)),
                _ if deck.steps > 0 => {}
                _ => deck.take(block, &mut scopes)?,
            }
        }
        let instance = scopes.instance()?.map(|name| capitals(name.as_bytes()));
        deck.blocks.retain(|block| scopes.holds(block.scope));
        (deck.instance, deck.shift) = (instance, scopes.shift);
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
        let is_mesh = READ.contains(&name.as_str());
        if is_mesh && block.parameter("INPUT").is_some() {
            return Err(include(&block));
        }
        if is_mesh || OF_CASE.contains(&name.as_str()) || OTHER_LAWS.contains(&name.as_str()) {
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
