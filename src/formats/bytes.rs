//! Numbers in the bytes of a file, of either order.

/// Which byte of a number comes first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ByteOrder {
    /// The lowest.
    Little,
    /// The highest.
    Big,
}

impl ByteOrder {
    /// The first bytes, lowest first; those that are missing are zero.
    pub(super) fn lowest_first<const N: usize>(self, bytes: &[u8]) -> [u8; N] {
        let mut own = [0; N];
        own.iter_mut().zip(bytes).for_each(|(to, from)| *to = *from);
        if self == Self::Big {
            own.reverse();
        }
        own
    }

    /// The first four bytes as a number.
    pub(super) fn u32(self, bytes: &[u8]) -> u32 {
        u32::from_le_bytes(self.lowest_first(bytes))
    }
}

/// A type of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum NumberType {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
    I64,
    U64,
}

impl NumberType {
    /// Bytes a number.
    pub(super) fn width(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 | Self::I64 | Self::U64 => 8,
        }
    }

    /// A number from so many bytes; whole ones beyond 2^53 are rounded.
    pub(super) fn value(self, bytes: &[u8], order: ByteOrder) -> f64 {
        match self {
            Self::I8 => f64::from(i8::from_le_bytes(order.lowest_first(bytes))),
            Self::U8 => f64::from(u8::from_le_bytes(order.lowest_first(bytes))),
            Self::I16 => f64::from(i16::from_le_bytes(order.lowest_first(bytes))),
            Self::U16 => f64::from(u16::from_le_bytes(order.lowest_first(bytes))),
            Self::I32 => f64::from(i32::from_le_bytes(order.lowest_first(bytes))),
            Self::U32 => f64::from(order.u32(bytes)),
            Self::F32 => f64::from(f32::from_le_bytes(order.lowest_first(bytes))),
            Self::F64 => f64::from_le_bytes(order.lowest_first(bytes)),
            Self::I64 => i64::from_le_bytes(order.lowest_first(bytes)) as f64,
            Self::U64 => u64::from_le_bytes(order.lowest_first(bytes)) as f64,
        }
    }
}
