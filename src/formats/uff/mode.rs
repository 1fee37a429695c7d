//! One dataset 55: a mode, or results of another kind, which are passed over.

use std::collections::HashSet;
use std::f64::consts::TAU;

use super::cursor::Cursor;
use crate::files::Fault;

/// A mode as it stands in the file, complex shapes already made real.
#[derive(Debug)]
pub(super) struct Mode {
    pub(super) frequency_hz: f64,
    pub(super) displacements: Vec<(u64, [f64; 3])>,
}

/// Most values a node that are believed.
const MOST_VALUES: i64 = 1000;

/// Reads a dataset 55 after its number, to the line that ends it; `None` if it holds no displacements of a mode.
pub(super) fn read_mode(cursor: &mut Cursor) -> Result<Option<Mode>, Fault> {
    const DEFINITION: &str = "six whole numbers that define the data";
    for _ in 0..5 {
        cursor.expect("five identification lines")?.within("five identification lines")?;
    }
    let line = cursor.expect_text(DEFINITION)?;
    let &[_, analysis, characteristic, _, data, values, ..] = line.integers(DEFINITION)?.as_slice() else {
        return Err(line.fault(DEFINITION));
    };
    let moves = matches!(characteristic, 2 | 3) || (characteristic == 0 && matches!(values, 3 | 6));
    if !matches!(analysis, 2 | 3 | 7) || !moves {
        cursor.skip()?;
        return Ok(None);
    }
    if !(3..=MOST_VALUES).contains(&values) {
        return Err(line.fault("3 or 6 values a node (sixth number)"));
    }
    let complex = match data {
        2 | 4 => false,
        5 | 6 => true,
        _ => return Err(line.fault("data type 2 or 4 (real), 5 or 6 (complex) (fifth number)")),
    };
    let eigenvalue = specific(cursor)?;
    let step = if complex { 2 } else { 1 };
    let width = if data == 2 || data == 5 { 13 } else { 25 };
    let (mut shape, mut seen, mut tags) = (Vec::new(), HashSet::new(), Vec::new());
    while let Some(line) = cursor.entry("a node or -1")? {
        const NODE: &str = "the label of a node, once a mode";
        let label = line.integers(NODE)?.first().copied().unwrap_or(-1);
        let tag = u64::try_from(label).map_err(|_| line.fault(NODE))?;
        if !seen.insert(tag) {
            return Err(line.fault(NODE));
        }
        let numbers = cursor.reals(values as usize * step, width, "values at a node")?;
        tags.push(tag);
        shape.push([0, 1, 2].map(|axis| [numbers[axis * step], if complex { numbers[axis * step + 1] } else { 0.0 }]));
    }
    let frequency_hz = match (analysis, eigenvalue.as_slice()) {
        (2, &[frequency, ..]) => frequency,
        // one of a pair of conjugates
        (3 | 7, &[_, imaginary, ..]) if imaginary < 0.0 => return Ok(None),
        (3 | 7, &[real, imaginary, ..]) => real.hypot(imaginary) / TAU,
        _ => return Err(line.fault("a mode with its frequency or eigenvalue")),
    };
    let shape = real_part(&shape);
    Ok(Some(Mode { frequency_hz, displacements: tags.into_iter().zip(shape).collect() }))
}

/// Records 7 and 8: how many whole and real numbers, the whole ones, the real ones. Returns the real ones.
fn specific(cursor: &mut Cursor) -> Result<Vec<f64>, Fault> {
    const WHOLE: &str = "the mode's whole numbers";
    const COUNTS: &str = "how many whole numbers (1 to 10) and real numbers (1 to 12) the mode has";
    let line = cursor.expect_text(COUNTS)?;
    let counts = line.integers(COUNTS)?;
    let (whole, real) = match counts[..] {
        [whole, real, ..] if (1..=10).contains(&whole) && (1..=12).contains(&real) => (whole, real),
        _ => return Err(line.fault(COUNTS)),
    };
    let mut missing = whole - (counts.len() - 2) as i64;
    while missing > 0 {
        let line = cursor.expect_text(WHOLE)?.within(WHOLE)?;
        missing -= line.integers(WHOLE)?.len() as i64;
    }
    cursor.reals(real as usize, 13, "the mode's real numbers, its frequency among them")
}

/// Real part of a complex shape turned by the angle that makes its imaginary part least.
///
/// For `phi exp(-i a)` the sum of squared imaginary parts is `(sum |phi|^2 - Re(exp(-2 i a) sum phi^2)) / 2`, least at
/// `a = arg(sum phi^2) / 2`. Real shapes are left as they are.
fn real_part(shape: &[[[f64; 2]; 3]]) -> Vec<[f64; 3]> {
    let values = || shape.iter().flatten();
    // so that squares neither overflow nor vanish
    let largest = values().flatten().fold(0.0_f64, |a, b| a.max(b.abs()));
    let scale = if largest > 0.0 { largest } else { 1.0 };
    let [mut real, mut imaginary] = [0.0, 0.0];
    for [re, im] in values() {
        let (re, im) = (re / scale, im / scale);
        real += re * re - im * im;
        imaginary += 2.0 * re * im;
    }
    let (sine, cosine) = (imaginary.atan2(real) / 2.0).sin_cos();
    let turned = |[re, im]: [f64; 2]| re * cosine + im * sine;
    shape.iter().map(|point| point.map(turned)).collect()
}
