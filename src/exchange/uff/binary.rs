//! Goes past binary functions, dataset 58b.

use super::cursor::{Cursor, Fault, Line};
use super::read::skip;
use super::read_response::Form;

/// Goes past a dataset 58b, whose first line is `head`, to the line that ends it; returns its lines of text.
///
/// Some programs give the bytes of half a complex function. Where the dataset does not end after as many bytes as its head
/// says, those are taken that its form asks for.
pub(super) fn skip_binary(cursor: &mut Cursor, head: &Line) -> Result<Vec<Line>, Fault> {
    // fields after 58b: byte order, number format, lines of text, bytes of numbers
    let words: Vec<&str> = head.text.split_ascii_whitespace().collect();
    let number = |place: usize| words.get(place).and_then(|word| word.parse().ok());
    let (Some(count_lines), Some(bytes)) = (number(3), number(4)) else {
        return Err(head.fault("lines and bytes of a dataset 58b"));
    };
    let mut lines = Vec::new();
    for _ in 0..usize::min(count_lines, 20) {
        lines.push(cursor.expect("text of a dataset 58b")?);
    }
    let form = lines.get(6).and_then(Form::read);
    let mut sizes = vec![bytes];
    sizes.extend(form.iter().flat_map(sizes_of));
    let ends = sizes.iter().find(|&&bytes| cursor.delimiter_after(bytes));
    cursor.skip(ends.copied().unwrap_or(bytes));
    skip(cursor)?;
    Ok(lines)
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
