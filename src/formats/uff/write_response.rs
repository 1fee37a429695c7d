//! Writes dataset 58, functions at nodal degrees of freedom.

use std::io::{self, Write};
use std::path::Path;

use super::super::FormatError;
use super::super::fortran::exponential;
use super::response::{FrequencyResponse, REFERENCE, RESPONSE, ResponsePoint};
use super::write::{begin, check_label, end, identification, write_head};
use crate::files::{Fault, write_atomic};

/// Digits after the point of frequencies, which the format has in single precision.
const DIGITS: usize = 5;
/// What five digits after the point round off at most, as a part.
const ROUNDING: f64 = 5e-6;

/// Writes frequency responses, whole or not at all: header, SI units, one dataset 58 each (complex, double precision: 13
/// digits).
///
/// The format has frequencies in six digits. They are written as first frequency and step where that gives each as closely
/// as six digits of its own would, else one by one. Directions that are not along an axis are written as unknown.
/// Identification lines: the name; the kind with its unit; no date, so that the same results give the same bytes; the names
/// of both points.
///
/// # Errors
/// [`FormatError::Data`] for one that contradicts itself, for uneven frequencies that are the same in six digits and for
/// nodes of more than ten digits; [`FormatError::File`].
pub fn write_responses_uff(path: &Path, description: &str, responses: &[FrequencyResponse]) -> Result<(), FormatError> {
    let mut spacings = Vec::with_capacity(responses.len());
    for (index, response) in responses.iter().enumerate() {
        response.check_as(index)?;
        let points = [&response.from, &response.to];
        check_label(points.into_iter().filter_map(|point| point.node))?;
        let frequencies = &response.frequency_hz;
        let spacing = spacing(frequencies);
        let same = frequencies.windows(2).find(|pair| spacing.is_none() && rounded(pair[0]) >= rounded(pair[1]));
        if let Some(pair) = same {
            let expected = "uneven frequencies that differ in six digits";
            let fault = Fault::new(expected, format_args!("two like {} Hz", pair[0]));
            return Err(fault.within(format!("frequency response {index}")).into());
        }
        spacings.push(spacing);
    }
    Ok(write_atomic(path, |to| {
        write_head(to, description)?;
        let mut responses = (1..).zip(responses.iter().zip(spacings));
        responses.try_for_each(|(number, (response, spacing))| write_response(to, number, response, spacing))
    })?)
}

impl FrequencyResponse {
    /// Without the frequencies that the six digits of the format do not tell from the one before, as those of two resonances
    /// close together; evenly spaced ones stay as they are.
    #[must_use]
    pub(crate) fn told_apart(mut self) -> Self {
        if spacing(&self.frequency_hz).is_some() {
            return self;
        }
        let mut last = f64::NEG_INFINITY;
        let pairs = self.frequency_hz.iter().copied().zip(self.value);
        (self.frequency_hz, self.value) = pairs
            .filter(|&(hz, _)| {
                let new = rounded(hz) > last;
                last = last.max(rounded(hz));
                new
            })
            .unzip();
        self
    }
}

/// As it comes back from the file.
fn rounded(value: f64) -> f64 {
    format!("{value:.DIGITS$e}").parse().unwrap_or(value)
}

/// First frequency and step as the file has them, if they give every frequency.
fn spacing(frequencies: &[f64]) -> Option<(f64, f64)> {
    let &[first, .., last] = frequencies else {
        return None;
    };
    let (begin, step) = (rounded(first), rounded((last - first) / (frequencies.len() - 1) as f64));
    let close = |(place, &own): (usize, &f64)| (begin + step * place as f64 - own).abs() <= ROUNDING * own;
    frequencies.iter().enumerate().all(close).then_some((begin, step))
}

fn write_response(
    to: &mut impl Write,
    number: usize,
    response: &FrequencyResponse,
    spacing: Option<(f64, f64)>,
) -> io::Result<()> {
    let single = |value| exponential(value, 13, DIGITS, 'E');
    let double = |value| exponential(value, 20, 12, 'E');
    let (name, quantity, numerator, unit) = response.kind.numerator();
    begin(to, 58)?;
    writeln!(to, "{}", identification(&response.name))?;
    writeln!(to, "{name}, {unit}/N")?;
    writeln!(to, "NONE")?;
    writeln!(to, "{REFERENCE}{}", identification(&response.from.name))?;
    writeln!(to, "{RESPONSE}{}", identification(&response.to.name))?;
    // frequency response, number, version, single excitation
    write!(to, "{:>5}{number:>10}{:>5}{:>10}", 4, 0, 0)?;
    for point in [&response.to, &response.from] {
        write_point(to, point)?;
    }
    let (even, (first, step)) = (u8::from(spacing.is_some()), spacing.unwrap_or_default());
    let count = response.frequency_hz.len();
    // complex, double precision
    write!(to, "\n{:>10}{count:>10}{even:>10}", 6)?;
    writeln!(to, "{}{}{}", single(first), single(step), single(0.0))?;
    let mut axis =
        |kind: u32, label: &str, unit: &str| writeln!(to, "{kind:>10}{:>5}{:>5}{:>5} {label:<20} {unit:<20}", 0, 0, 0);
    axis(18, "Frequency", "Hz")?;
    axis(numerator, quantity, unit)?;
    axis(13, "Force", "N")?;
    axis(0, "NONE", "NONE")?;
    if spacing.is_some() {
        for pair in response.value.chunks(2) {
            for &part in pair.as_flattened() {
                write!(to, "{}", double(part))?;
            }
            writeln!(to)?;
        }
    } else {
        for (&frequency, &[re, im]) in response.frequency_hz.iter().zip(&response.value) {
            writeln!(to, "{}{}{}", single(frequency), double(re), double(im))?;
        }
    }
    end(to)
}

/// Name in ten characters, node, direction.
fn write_point(to: &mut impl Write, point: &ResponsePoint) -> io::Result<()> {
    let name: String = identification(&point.name).chars().take(10).collect();
    let (node, direction) = (point.node.unwrap_or(0), point.signed_axis());
    write!(to, " {name:<10}{node:>10}{direction:>4}")
}
