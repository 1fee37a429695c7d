//! What a computation under way remembers, as words of 64 bits: numbers come back to the last bit, infinities and NaN too.

use thiserror::Error;

/// Words in the order in which they were written.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Snapshot {
    pub(crate) words: Vec<u64>,
}

/// Reads a [`Snapshot`] in the order in which it was written.
#[derive(Debug, Clone)]
pub struct SnapshotReader<'a> {
    words: &'a [u64],
}

/// A snapshot of something else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum SnapshotError {
    /// It ends too early.
    #[error("the snapshot ends too early")]
    Short,
    /// It goes on after the last thing that was expected.
    #[error("the snapshot has {left} words more than expected")]
    Long {
        /// Words that nobody asked for.
        left: usize,
    },
    /// Something in it has another size or value than the system that it is for.
    #[error("the snapshot is of another system: {what} expected {expected}, found {found}")]
    Other {
        /// What.
        what: &'static str,
        /// Of the system.
        expected: u64,
        /// In the snapshot.
        found: u64,
    },
}

impl Snapshot {
    /// Reads from the start.
    #[must_use]
    pub(crate) fn reader(&self) -> SnapshotReader<'_> {
        SnapshotReader { words: &self.words }
    }

    /// Writes a whole number.
    pub(crate) fn count(&mut self, value: u64) {
        self.words.push(value);
    }

    /// Writes whether something holds.
    pub(crate) fn flag(&mut self, value: bool) {
        self.count(u64::from(value));
    }

    /// Writes a number.
    pub fn number(&mut self, value: f64) {
        self.words.push(value.to_bits());
    }

    /// Writes a number that may be missing.
    pub(crate) fn option(&mut self, value: Option<f64>) {
        self.flag(value.is_some());
        self.number(value.unwrap_or(0.0));
    }

    /// Writes numbers and how many they are.
    pub(crate) fn numbers(&mut self, values: &[f64]) {
        self.count(values.len() as u64);
        self.words.extend(values.iter().map(|value| value.to_bits()));
    }
}

impl SnapshotReader<'_> {
    /// Reads a whole number.
    ///
    /// # Errors
    /// [`SnapshotError::Short`].
    pub(crate) fn count(&mut self) -> Result<u64, SnapshotError> {
        let (first, rest) = self.words.split_first().ok_or(SnapshotError::Short)?;
        self.words = rest;
        Ok(*first)
    }

    /// Reads whether something holds.
    ///
    /// # Errors
    /// [`SnapshotError::Short`], [`SnapshotError::Other`].
    pub(crate) fn flag(&mut self) -> Result<bool, SnapshotError> {
        match self.count()? {
            found @ 0..=1 => Ok(found == 1),
            found => Err(SnapshotError::Other { what: "flag", expected: 1, found }),
        }
    }

    /// Reads a number.
    ///
    /// # Errors
    /// [`SnapshotError::Short`].
    pub fn number(&mut self) -> Result<f64, SnapshotError> {
        self.count().map(f64::from_bits)
    }

    /// Reads a number that may be missing.
    ///
    /// # Errors
    /// As [`flag`](Self::flag).
    pub(crate) fn option(&mut self) -> Result<Option<f64>, SnapshotError> {
        let there = self.flag()?;
        let value = self.number()?;
        Ok(there.then_some(value))
    }

    /// Reads numbers.
    ///
    /// # Errors
    /// [`SnapshotError::Short`].
    pub(crate) fn numbers(&mut self) -> Result<Vec<f64>, SnapshotError> {
        let length = usize::try_from(self.count()?).map_err(|_| SnapshotError::Short)?;
        let (values, rest) = self.words.split_at_checked(length).ok_or(SnapshotError::Short)?;
        self.words = rest;
        Ok(values.iter().map(|&word| f64::from_bits(word)).collect())
    }

    /// Reads as many numbers as there is room for.
    ///
    /// # Errors
    /// [`SnapshotError::Short`], [`SnapshotError::Other`] if they are more or fewer.
    pub(crate) fn numbers_into(&mut self, what: &'static str, values: &mut [f64]) -> Result<(), SnapshotError> {
        let found = self.numbers()?;
        if found.len() != values.len() {
            return Err(SnapshotError::Other { what, expected: values.len() as u64, found: found.len() as u64 });
        }
        values.copy_from_slice(&found);
        Ok(())
    }

    /// Ends reading.
    ///
    /// # Errors
    /// [`SnapshotError::Long`].
    pub(crate) fn end(self) -> Result<(), SnapshotError> {
        match self.words.len() {
            0 => Ok(()),
            left => Err(SnapshotError::Long { left }),
        }
    }
}

/// Words on their way into a snapshot or out of one: what a method remembers is listed once for both ways.
pub(crate) enum Exchange<'a, 'w> {
    /// Writes each value.
    Write(&'a mut Snapshot),
    /// Sets each value.
    Read(&'a mut SnapshotReader<'w>),
}

impl<'w> Exchange<'_, 'w> {
    fn one<T: Copy>(
        &mut self,
        value: &mut T,
        write: fn(&mut Snapshot, T),
        read: fn(&mut SnapshotReader<'w>) -> Result<T, SnapshotError>,
    ) -> Result<(), SnapshotError> {
        match self {
            Self::Write(snapshot) => write(snapshot, *value),
            Self::Read(snapshot) => *value = read(snapshot)?,
        }
        Ok(())
    }

    /// A whole number.
    pub(crate) fn count(&mut self, value: &mut u64) -> Result<(), SnapshotError> {
        self.one(value, Snapshot::count, SnapshotReader::count)
    }

    /// Whether something holds.
    pub(crate) fn flag(&mut self, value: &mut bool) -> Result<(), SnapshotError> {
        self.one(value, Snapshot::flag, SnapshotReader::flag)
    }

    /// A number.
    pub(crate) fn number(&mut self, value: &mut f64) -> Result<(), SnapshotError> {
        self.one(value, Snapshot::number, SnapshotReader::number)
    }

    /// A number that may be missing.
    pub(crate) fn option(&mut self, value: &mut Option<f64>) -> Result<(), SnapshotError> {
        self.one(value, Snapshot::option, SnapshotReader::option)
    }

    /// As many numbers as there is room for.
    pub(crate) fn numbers(&mut self, what: &'static str, values: &mut [f64]) -> Result<(), SnapshotError> {
        match self {
            Self::Write(snapshot) => snapshot.numbers(values),
            Self::Read(snapshot) => snapshot.numbers_into(what, values)?,
        }
        Ok(())
    }

    /// Numbers, however many they are.
    pub(crate) fn list(&mut self, values: &mut Vec<f64>) -> Result<(), SnapshotError> {
        match self {
            Self::Write(snapshot) => snapshot.numbers(values),
            Self::Read(snapshot) => *values = snapshot.numbers()?,
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_comes_back_to_the_last_bit() {
        let odd = [-0.0, f64::NAN, f64::INFINITY, 0.1 + 0.2, f64::MIN_POSITIVE / 3.0];
        let mut written = Snapshot::default();
        written.count(u64::MAX);
        written.flag(true);
        written.numbers(&odd);
        written.option(None);
        written.option(Some(-0.0));
        written.number(1.0 / 3.0);
        let read = Snapshot { words: written.words.clone() };
        let mut reader = read.reader();
        assert_eq!(reader.count(), Ok(u64::MAX));
        assert_eq!(reader.flag(), Ok(true));
        let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&reader.numbers().unwrap()), bits(&odd));
        assert_eq!(reader.option(), Ok(None));
        assert!(reader.option().unwrap().unwrap().is_sign_negative());
        assert_eq!(reader.number().unwrap().to_bits(), (1.0_f64 / 3.0).to_bits());
        assert_eq!(reader.end(), Ok(()));
    }

    #[test]
    fn what_does_not_fit_is_told() {
        let mut snapshot = Snapshot::default();
        snapshot.numbers(&[1.0, 2.0]);
        let mut room = [0.0; 3];
        let error = snapshot.reader().numbers_into("states", &mut room);
        assert_eq!(error.unwrap_err().to_string(), "the snapshot is of another system: states expected 3, found 2");
        let long = snapshot.reader().end().unwrap_err().to_string();
        assert_eq!(long, "the snapshot has 3 words more than expected");
        let mut cut = Snapshot { words: vec![u64::MAX, 0] };
        assert_eq!(cut.reader().numbers(), Err(SnapshotError::Short));
        cut.count(7);
        assert!(cut.reader().flag().is_err());
        assert_eq!(Snapshot::default().reader().count(), Err(SnapshotError::Short));
    }
}
