//! An array whose values come in pieces.

use std::marker::PhantomData;

use super::{NpzElement, NpzError, NpzWriter};

/// An array that is being written piece by piece; made by [`NpzWriter::begin`].
#[derive(Debug)]
#[must_use = "an array is complete only after `end`"]
pub struct NpzArray<'a, T> {
    writer: &'a mut NpzWriter,
    element: PhantomData<T>,
    name: String,
    shape: Vec<usize>,
    expected: usize,
    written: usize,
}

impl<'a, T: NpzElement> NpzArray<'a, T> {
    /// An array of which nothing is written but its header; `expected` is the product of its shape.
    pub(super) fn new(
        writer: &'a mut NpzWriter,
        name: &str,
        shape: &[usize],
        expected: usize,
    ) -> Self {
        Self {
            writer,
            element: PhantomData,
            name: name.to_owned(),
            shape: shape.to_vec(),
            expected,
            written: 0,
        }
    }

    /// Writes the next values.
    ///
    /// # Errors
    /// [`NpzError::Shape`] if there are more than the shape holds, [`NpzError::Io`].
    pub fn extend(&mut self, values: &[T]) -> Result<(), NpzError> {
        self.written += values.len();
        if self.written > self.expected {
            return Err(self.shape_error());
        }
        let mut bytes = Vec::with_capacity(512 * T::BYTES);
        for piece in values.chunks(512) {
            bytes.clear();
            for &value in piece {
                value.extend_bytes(&mut bytes);
            }
            self.writer.write(&bytes)?;
        }
        Ok(())
    }

    /// Ends the array.
    ///
    /// # Errors
    /// [`NpzError::Shape`] if values are missing.
    pub fn end(self) -> Result<(), NpzError> {
        if self.written == self.expected {
            self.writer.incomplete = None;
            Ok(())
        } else {
            Err(self.shape_error())
        }
    }

    fn shape_error(&self) -> NpzError {
        NpzError::Shape {
            name: self.name.clone(),
            shape: self.shape.clone(),
            expected: self.expected,
            found: self.written,
        }
    }
}
