//! Frequencies at which a transform over scales is taken.

use super::SignalError;

/// Most frequencies offered.
const MOST: usize = 1 << 16;

/// Frequencies from the lowest to the highest, both included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrequencyAxis {
    /// Equal ratios: as a wavelet's bandwidth grows with its frequency, each is equally well resolved.
    Logarithmic {
        /// Lowest frequency, Hz.
        from_hz: f64,
        /// Highest frequency, Hz.
        to_hz: f64,
        /// Number of frequencies, at least 2.
        count: usize,
    },
    /// Equal distances.
    Linear {
        /// Lowest frequency, Hz.
        from_hz: f64,
        /// Highest frequency, Hz.
        to_hz: f64,
        /// Number of frequencies, at least 2.
        count: usize,
    },
}

impl FrequencyAxis {
    /// The frequencies, Hz, rising, between `lowest_hz` and `highest_hz` (the latter excluded).
    ///
    /// # Errors
    /// [`SignalError`] unless lowest <= from < to < highest and there are 2 to 65536.
    pub fn frequencies_hz(&self, lowest_hz: f64, highest_hz: f64) -> Result<Vec<f64>, SignalError> {
        let (Self::Logarithmic { from_hz, to_hz, count } | Self::Linear { from_hz, to_hz, count }) = *self;
        // a millionth for what is typed in decimal
        let is_inside = from_hz >= lowest_hz * (1.0 - 1e-6) && to_hz < highest_hz;
        if !(from_hz > 0.0 && from_hz < to_hz && is_inside && (2..=MOST).contains(&count)) {
            return Err(SignalError(format!(
                "frequencies must satisfy {lowest_hz} Hz <= from < to < {highest_hz} Hz and be 2 to {MOST}, found {count} \
                 from {from_hz} Hz to {to_hz} Hz"
            )));
        }
        let part = |k: usize| k as f64 / (count - 1) as f64;
        let frequency = |k: usize| match self {
            _ if k + 1 == count => to_hz,
            Self::Logarithmic { .. } => from_hz * (to_hz / from_hz).powf(part(k)),
            Self::Linear { .. } => from_hz + (to_hz - from_hz) * part(k),
        };
        Ok((0..count).map(frequency).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frequencies_go_from_end_to_end() {
        let (from_hz, to_hz, count) = (10.0, 1000.0, 5);
        let log = FrequencyAxis::Logarithmic { from_hz, to_hz, count };
        let linear = FrequencyAxis::Linear { from_hz, to_hz, count };
        let close = |axis: FrequencyAxis, expected: [f64; 5]| {
            let found = axis.frequencies_hz(10.0, 1001.0).expect("a valid axis");
            found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-14)
        };
        assert!(close(log, [10.0, 1e3_f64.sqrt(), 100.0, 1e5_f64.sqrt(), 1000.0]));
        assert!(close(linear, [10.0, 257.5, 505.0, 752.5, 1000.0]));
    }

    #[test]
    fn errors_fire_with_their_exact_messages() {
        let message = |from_hz, to_hz, count| {
            let axis = FrequencyAxis::Linear { from_hz, to_hz, count };
            axis.frequencies_hz(2.0, 50.0).expect_err("must fail").to_string()
        };
        let begin = "frequencies must satisfy 2 Hz <= from < to < 50 Hz and be 2 to 65536, found";
        assert_eq!(message(1.0, 10.0, 3), format!("{begin} 3 from 1 Hz to 10 Hz"));
        assert_eq!(message(3.0, 50.0, 3), format!("{begin} 3 from 3 Hz to 50 Hz"));
        assert_eq!(message(3.0, 3.0, 3), format!("{begin} 3 from 3 Hz to 3 Hz"));
        assert_eq!(message(3.0, 4.0, 1), format!("{begin} 1 from 3 Hz to 4 Hz"));
        assert!(message(3.0, 4.0, 65_537).contains("found 65537"));
        assert_eq!(message(f64::NAN, 4.0, 2), format!("{begin} 2 from NaN Hz to 4 Hz"));
    }
}
