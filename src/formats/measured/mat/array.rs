//! Arrays of numbers in a variable: in itself, or in the fields of structs.

use std::ops::Range;

use super::super::names::{is_bare_rate, is_rate, speed_unit};
use super::element::{Element, Elements, MATRIX, fault, of_array};
use crate::files::Fault;
use crate::formats::bytes::{ByteOrder, NumberType};

/// Deepest struct in a struct.
const DEEPEST: usize = 32;
/// Most signals and named numbers a file.
const MOST: usize = 1 << 16;
/// Names with the structs around them are shorter, bytes; longer ones are left out, as memory goes with their sum.
const LONGEST_PATH: usize = 256;
/// Longest field name, bytes: MATLAB's own limit is 2048 characters and a zero.
const LONGEST_FIELD: usize = 4096;
/// Most dimensions: those of NumPy.
const DIMENSIONS: usize = 64;

/// Bits of the word that has the class in its lowest byte.
const COMPLEX: u32 = 0x0800;

/// Extent of an array.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Shape {
    /// One number.
    Scalar(f64),
    /// So many numbers in a row or a column.
    Vector(usize),
    /// Both above 1; numbers of a column are next to each other.
    Matrix { rows: usize, columns: usize },
}

/// An array of numbers that is a signal, or a number that says something of one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Array {
    /// Name with the structs around it, as MATLAB writes it: `s.x`, `s(2).x`.
    pub(super) path: String,
    /// Which variable of the file it is in.
    pub(super) variable: usize,
    pub(super) shape: Shape,
    pub(super) complex: bool,
    pub(super) numbers: NumberType,
    /// Where its numbers are in that variable.
    pub(super) data: Range<usize>,
}

impl Array {
    /// The struct that it is a field of, empty for none, and its own name.
    pub(super) fn scope_and_name(&self) -> (&str, &str) {
        self.path.rsplit_once('.').unwrap_or(("", &self.path))
    }
}

/// Looks for arrays.
#[derive(Debug)]
pub(super) struct Search<'a> {
    /// What the variable lies in.
    pub(super) whole: &'a [u8],
    pub(super) order: ByteOrder,
    pub(super) variable: usize,
    pub(super) found: &'a mut Vec<Array>,
    /// Signals and named numbers that were found.
    pub(super) count: &'a mut usize,
}

impl Search<'_> {
    /// An array: a variable, or a field of this path. Cells, text, objects, functions and sparse arrays are passed over.
    pub(super) fn array(&mut self, part: Range<usize>, field: Option<String>, depth: usize) -> Result<(), Fault> {
        let mut parts = Elements::new(self.whole, part, self.order);
        // an empty field has nothing at all
        if parts.is_empty() {
            return Ok(());
        }
        let at = parts.place();
        let flags = parts.take("flags of an array")?;
        let flags = &self.whole[flags.data];
        if flags.len() < 8 {
            return Err(fault(at, "8 bytes of flags of an array", format_args!("{} bytes", flags.len())));
        }
        let flags = self.order.u32(flags);
        let class = flags & 0xff;
        match class {
            2 | 6..=15 => {}
            1 | 3..=5 | 16 | 17 => return Ok(()),
            _ => return Err(fault(at, "a class of arrays from 1 to 17", class)),
        }
        let at = parts.place();
        let sizes = parts.take("sizes of an array")?;
        let sizes = self.sizes(at, &sizes)?;
        let name = parts.take("the name of an array")?;
        let path = field.unwrap_or_else(|| plain(&self.whole[name.data]));
        // a variable without a name is what MATLAB keeps for objects and functions
        if path.is_empty() || path.len() >= LONGEST_PATH {
            return Ok(());
        }
        let inside = match class {
            2 => self.structs(parts, &sizes, &path, depth),
            _ => self.numbers(parts, &sizes, &path, flags & COMPLEX != 0),
        };
        inside.map_err(|fault| of_array(fault, &path))
    }

    /// Length in each dimension.
    fn sizes(&self, at: usize, element: &Element) -> Result<Vec<usize>, Fault> {
        let bytes = &self.whole[element.data.clone()];
        let words = bytes.chunks_exact(4).map(|size| self.order.u32(size));
        let sizes: Option<Vec<usize>> = words.map(|size| Some(i32::try_from(size).ok()? as usize)).collect();
        let usual = sizes.filter(|sizes| (2..=DIMENSIONS).contains(&sizes.len()));
        usual.ok_or_else(|| {
            let found = format!("{} bytes, or a size below 0", bytes.len());
            fault(at, format!("2 to {DIMENSIONS} sizes of an array"), found)
        })
    }

    /// A struct, or an array of them.
    fn structs(&mut self, mut parts: Elements<'_>, sizes: &[usize], path: &str, depth: usize) -> Result<(), Fault> {
        let at = parts.place();
        if depth == DEEPEST {
            return Err(fault(at, format!("structs in structs, up to {DEEPEST} deep"), "a deeper one"));
        }
        let length = parts.take("the length of field names")?;
        let length = self.order.u32(&self.whole[length.data]) as usize;
        let names = parts.take("field names")?;
        let names = &self.whole[names.data];
        if names.is_empty() {
            return Ok(());
        }
        if !(1..=LONGEST_FIELD).contains(&length) || !names.len().is_multiple_of(length) {
            let expected = format!("field names of 1 to {LONGEST_FIELD} bytes each");
            return Err(fault(at, expected, format_args!("{} bytes of names of {length}", names.len())));
        }
        let fields = names.len() / length;
        // a field takes a tag at least
        let room = parts.left() / 8 / fields;
        let count = product(sizes).filter(|&count| count <= room).ok_or_else(|| {
            fault(at, format!("structs of sizes {sizes:?}"), format_args!("{fields} fields in {} bytes", parts.left()))
        })?;
        for number in 1..=count {
            let one = match count {
                1 => path.to_owned(),
                _ => format!("{path}({number})"),
            };
            for name in names.chunks_exact(length) {
                let at = parts.place();
                let element = parts.take("a field of a struct")?;
                if element.kind != MATRIX {
                    return Err(fault(at, "a field of a struct", format_args!("an element of type {}", element.kind)));
                }
                // names are looked at only for fields that have something
                if element.data.is_empty() {
                    continue;
                }
                let name = plain(name);
                if one.len() + name.len() < LONGEST_PATH {
                    self.array(element.data, Some(format!("{one}.{name}")), depth + 1)?;
                }
            }
        }
        Ok(())
    }

    /// An array of numbers.
    fn numbers(&mut self, mut parts: Elements<'_>, sizes: &[usize], path: &str, complex: bool) -> Result<(), Fault> {
        let at = parts.place();
        let element = parts.take("numbers")?;
        let numbers = number_type(element.kind)
            .ok_or_else(|| fault(at, "numbers", format_args!("an element of type {}", element.kind)))?;
        let (bytes, width) = (element.data.len(), numbers.width());
        let count = product(sizes).filter(|count| count.checked_mul(width) == Some(bytes)).ok_or_else(|| {
            fault(at, format!("{width} bytes each for sizes {sizes:?}"), format_args!("{bytes} bytes"))
        })?;
        let mut long = sizes.iter().copied().filter(|&size| size != 1);
        let shape = match (long.next(), long.next(), long.next()) {
            _ if count == 0 => return Ok(()),
            (None, ..) => Shape::Scalar(numbers.value(&self.whole[element.data.clone()], self.order)),
            (Some(length), None, _) => Shape::Vector(length),
            (Some(rows), Some(columns), None) => Shape::Matrix { rows, columns },
            // no more than a table is
            (Some(_), Some(_), Some(_)) => return Ok(()),
        };
        let array =
            Array { path: path.to_owned(), variable: self.variable, shape, complex, numbers, data: element.data };
        *self.count += match shape {
            Shape::Scalar(_) if !says_something(&array) => return Ok(()),
            Shape::Scalar(_) | Shape::Vector(_) => 1,
            Shape::Matrix { rows, columns } => rows.min(columns),
        };
        if *self.count > MOST {
            return Err(fault(at, format!("at most {MOST} signals"), "more"));
        }
        self.found.push(array);
        Ok(())
    }
}

/// Whether a number is a rate or a speed by its name.
fn says_something(array: &Array) -> bool {
    let (_, name) = array.scope_and_name();
    !array.complex && (is_rate(name) || is_bare_rate(name) || speed_unit(name).is_some())
}

/// The type of an element's numbers, which may be narrower than the array's class; `None` if it holds none.
fn number_type(element: u32) -> Option<NumberType> {
    Some(match element {
        1 => NumberType::I8,
        2 => NumberType::U8,
        3 => NumberType::I16,
        4 => NumberType::U16,
        5 => NumberType::I32,
        6 => NumberType::U32,
        7 => NumberType::F32,
        9 => NumberType::F64,
        12 => NumberType::I64,
        13 => NumberType::U64,
        _ => return None,
    })
}

fn product(sizes: &[usize]) -> Option<usize> {
    sizes.iter().try_fold(1_usize, |n, &size| n.checked_mul(size))
}

/// A name without the zeros behind it and without characters that a terminal would obey.
fn plain(bytes: &[u8]) -> String {
    let own = bytes.split(|&byte| byte == 0).next().unwrap_or_default();
    let text = String::from_utf8_lossy(own);
    let character = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    text.chars().map(character).collect()
}
