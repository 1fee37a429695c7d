//! `--task K/N`: a share of what a study computes.

/// One of several equal shares of the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Share {
    /// Which one, from 1.
    pub number: usize,
    /// Of how many.
    pub of: usize,
}

impl Share {
    /// All points.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Whether a point belongs to it.
    #[must_use]
    pub(crate) fn has(self, point: usize) -> bool {
        point % self.of == self.number % self.of
    }
}

/// K/N with K from 1 to N.
pub(super) fn share(text: &str) -> Result<Share, String> {
    let parts = text.split_once('/');
    let numbers = parts.map(|(number, of)| (number.parse(), of.parse()));
    match numbers {
        Some((Ok(number), Ok(of))) if 1 <= number && number <= of => Ok(Share { number, of }),
        _ => Err(format!("expected K/N with K from 1 to N, found \"{text}\"")),
    }
}

#[cfg(test)]
mod tests {
    use super::{Share, share};

    #[test]
    fn shares_have_every_point_once() {
        for of in 1..5 {
            for point in 1..20 {
                let has = (1..=of).filter(|&number| Share { number, of }.has(point));
                assert_eq!(has.count(), 1, "{point} of {of}");
            }
        }
        assert!(Share { number: 2, of: 3 }.has(2) && Share { number: 3, of: 3 }.has(6));
        for wrong in ["0/2", "3/2", "1", "1/", "a/b", "1/0", "-1/2"] {
            let message = share(wrong).unwrap_err();
            assert!(message.contains("expected K/N with K from 1 to N"), "{message}");
        }
    }
}
