//! Parts, instances and the assembly of a file of Abaqus/CAE: one instance is read, moved but not turned.

use super::MshError;
use super::block::{Block, Scope, capitals, fault, items};
use super::numbers::coordinate;
use crate::fe::mesh::gmsh::quoted;

/// What has been seen of parts and instances.
#[derive(Default)]
pub(super) struct Scopes {
    pub(super) now: Scope,
    /// Names of the parts, in capitals.
    parts: Vec<String>,
    /// Name of the instance, number of its part.
    instance: Option<(String, Option<u32>)>,
    /// Lines of `*INSTANCE` that were seen, if those that follow are its own.
    moves: Option<usize>,
    /// How far the instance is moved, in the file's unit.
    pub(super) shift: [f64; 3],
}

impl Scopes {
    pub(super) fn at_keyword(&mut self, keyword: &str, block: &Block<'_>) -> Result<(), MshError> {
        self.moves = (keyword == "INSTANCE").then_some(0);
        self.now = match keyword {
            "PART" => {
                self.parts.push(capitals(block.required("NAME")?.as_bytes()));
                Scope::Part(self.parts.len() as u32 - 1)
            }
            "ASSEMBLY" | "ENDINSTANCE" => Scope::Assembly,
            "INSTANCE" => {
                let name = block.required("NAME")?;
                let part = block.required("PART")?;
                let own = self.parts.iter().position(|known| *known == capitals(part.as_bytes()));
                if let Some((first, _)) = &self.instance {
                    return Err(block.fault(
                        block.line,
                        format_args!("found a second instance, {} after {}: expected one; merge the instances into one part and write the file again", quoted(name.as_bytes()), quoted(first.as_bytes())),
                    ));
                }
                self.instance = Some((name, own.map(|part| part as u32)));
                Scope::Instance
            }
            "ENDPART" | "ENDASSEMBLY" => Scope::File,
            _ => self.now,
        };
        Ok(())
    }

    /// A line that is no keyword: the first one of an instance is how far it is moved, the second how it is turned.
    pub(super) fn data(&mut self, line: usize, text: &[u8]) -> Result<(), MshError> {
        let Some(lines) = &mut self.moves else { return Ok(()) };
        *lines += 1;
        if *lines > 1 {
            let advice = "turn the part itself and write the file again";
            return Err(fault(line, "INSTANCE", format_args!("an instance that is turned cannot be read; {advice}")));
        }
        for (moved, word) in self.shift.iter_mut().zip(items(text)).filter(|(_, word)| !word.is_empty()) {
            *moved = coordinate(word).ok_or_else(|| {
                fault(line, "INSTANCE", format_args!("expected a translation, found {}", quoted(word)))
            })?;
        }
        Ok(())
    }

    /// Name of the instance, if there are parts.
    ///
    /// # Errors
    /// Several parts and no instance that says which.
    pub(super) fn instance(&self) -> Result<Option<String>, MshError> {
        if self.instance.is_none() && self.parts.len() > 1 {
            let count = self.parts.len();
            return Err(MshError(format!(
                "the file has {count} parts and no *INSTANCE: expected one part, or one instance that says which"
            )));
        }
        Ok(self.instance.as_ref().map(|(name, _)| name.clone()))
    }

    /// Whether what stands there belongs to the mesh.
    pub(super) fn holds(&self, scope: Scope) -> bool {
        match (&self.instance, scope) {
            (Some((_, part)), Scope::Part(number)) => *part == Some(number),
            _ => true,
        }
    }
}
