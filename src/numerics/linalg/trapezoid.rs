//! How columns of a triangle are stored.

/// Columns that are factorised at once.
pub(super) const PANEL: usize = 128;

/// Columns of a lower triangle, stored in blocks of `width` columns from the diagonal down, one behind the other.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trapezoid {
    pub rows: usize,
    pub columns: usize,
    pub width: usize,
}

impl Trapezoid {
    /// The columns of a supernode.
    pub(super) fn of_columns(columns: usize, below: usize) -> Self {
        Self { rows: columns + below, columns, width: PANEL }
    }

    pub(super) fn blocks(&self) -> usize {
        self.columns.div_ceil(self.width)
    }

    /// First column of a block, which is its first row too, and how many columns it has.
    pub(super) fn block(&self, index: usize) -> (usize, usize) {
        let first = index * self.width;
        (first, self.width.min(self.columns - first))
    }

    /// Where the entries of a block begin.
    pub(super) fn begin(&self, index: usize) -> usize {
        let full = index * self.width * self.rows;
        full - self.width * self.width * (index * index.saturating_sub(1) / 2)
    }

    /// Number of entries.
    pub(super) fn len(&self) -> usize {
        match self.blocks() {
            0 => 0,
            blocks => {
                let (first, columns) = self.block(blocks - 1);
                self.begin(blocks - 1) + columns * (self.rows - first)
            }
        }
    }
}
