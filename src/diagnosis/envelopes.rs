//! The envelopes of a signal that a verdict is sought in.

use crate::series::TimeSeries;
use crate::signal::{Emphasis, SignalError, squared, whiten};

/// An envelope of a signal.
#[derive(Debug, Clone, PartialEq)]
pub struct JudgedEnvelope {
    /// What it is.
    pub name: &'static str,
    /// Its values.
    pub series: TimeSeries,
}

/// The envelopes of a signal.
#[derive(Debug, Clone, PartialEq)]
pub struct Envelopes {
    /// Of the signal itself: whether what is found has the shape of bursts is asked of it too.
    pub plain: TimeSeries,
    /// Those that a verdict is sought in.
    pub judged: Vec<JudgedEnvelope>,
}

/// Envelopes of a signal, `envelope` being what filters it and takes its envelope: of the whitened signal, and of that with its
/// impulsive frequencies emphasised; each as it is and squared.
///
/// No single one is best. Whitening makes many weak resonances count, the emphasis finds the band that noise leaves;
/// the square has the lines of strong bursts above a floor of steady noise (R. B. Randall and J. Antoni, Rolling element
/// bearing diagnostics: a tutorial, Mechanical Systems and Signal Processing 25 (2011) 485-520), the envelope itself suffers less from
/// single strong ones.
///
/// # Errors
/// Of [`whiten`] and of `envelope`.
pub fn judged_envelopes(
    signal: &TimeSeries,
    envelope: impl Fn(&TimeSeries) -> Result<TimeSeries, SignalError>,
) -> Result<Envelopes, SignalError> {
    let mut judged = Vec::with_capacity(4);
    for (emphasis, name, name_of_square) in [
        (
            Emphasis::Even,
            "envelope of the whitened signal",
            "squared envelope of the whitened signal",
        ),
        (
            Emphasis::Impulsive,
            "envelope of the signal's impulsive frequencies",
            "squared envelope of the signal's impulsive frequencies",
        ),
    ] {
        let series = envelope(&whiten(signal, emphasis)?)?;
        let square = squared(&series)?;
        judged.push(JudgedEnvelope { name, series });
        judged.push(JudgedEnvelope {
            name: name_of_square,
            series: square,
        });
    }
    let plain = envelope(signal)?;
    Ok(Envelopes { plain, judged })
}
