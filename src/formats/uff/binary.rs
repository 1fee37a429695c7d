//! Binary functions, dataset 58b.

use super::super::bytes::{ByteOrder, NumberType};
use super::cursor::{Cursor, Line};
use super::function::Form;
use crate::files::Fault;

/// What a dataset 58b has.
pub(super) struct Binary<'a> {
    /// Its lines of text, those of a dataset 58 before the values.
    pub(super) lines: Vec<Line>,
    /// The bytes of its numbers.
    pub(super) bytes: &'a [u8],
    order: ByteOrder,
    /// Whether the numbers are those of IEEE 754.
    pub(super) ieee: bool,
}

/// Reads a dataset 58b, whose first line is `head`, to the line that ends it.
///
/// Some programs give the bytes of half a complex function. Where the dataset does not end after as many bytes as its head
/// says, those are taken that its form asks for.
pub(super) fn read_binary<'a>(cursor: &mut Cursor<'a>, head: &Line) -> Result<Binary<'a>, Fault> {
    // fields after 58b: byte order, number format, lines of text, bytes of numbers
    let words: Vec<&str> = head.text.split_ascii_whitespace().collect();
    let number = |place: usize| words.get(place).and_then(|word| word.parse().ok());
    let (Some(count_lines), Some(bytes)) = (number(3), number(4)) else {
        return Err(head.fault("lines and bytes of a dataset 58b"));
    };
    let text = (0..usize::min(count_lines, 20)).map(|_| cursor.expect("text of a dataset 58b"));
    let lines = text.collect::<Result<Vec<Line>, Fault>>()?;
    let form = lines.get(6).and_then(Form::read);
    let mut sizes = std::iter::once(bytes).chain(form.iter().flat_map(sizes_of));
    let ends = sizes.find(|&bytes| cursor.delimiter_after(bytes));
    let bytes = cursor.take(ends.unwrap_or(bytes));
    cursor.skip()?;
    let order = if number(1) == Some(2) { ByteOrder::Big } else { ByteOrder::Little };
    Ok(Binary { lines, bytes, order, ieee: number(2) == Some(2) })
}

impl Binary<'_> {
    /// The numbers, in single or double precision; a rest that is no whole number is left out.
    pub(super) fn numbers(&self, single: bool) -> Vec<f64> {
        let real = if single { NumberType::F32 } else { NumberType::F64 };
        self.bytes.chunks_exact(real.width()).map(|bytes| real.value(bytes, self.order)).collect()
    }
}

/// Bytes of a function's numbers; an uneven abscissa has single precision, or that of the values.
fn sizes_of(form: &Form) -> [usize; 2] {
    let real = if form.single { 4 } else { 8 };
    let value = if form.complex { 2 * real } else { real };
    let abscissas = match form.even {
        Some(_) => [0, 0],
        None => [4, real],
    };
    abscissas.map(|abscissa| form.count.saturating_mul(abscissa + value))
}
