//! Numbers as elements hold them. An array of any class may be stored in a narrower type that its values fit in.

use super::element::ByteOrder;

/// A type of numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Numbers {
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Single,
    Double,
    Int64,
    UInt64,
}

impl Numbers {
    /// The type of an element; `None` if it holds no numbers.
    pub(super) fn of(kind: u32) -> Option<Self> {
        Some(match kind {
            1 => Self::Int8,
            2 => Self::UInt8,
            3 => Self::Int16,
            4 => Self::UInt16,
            5 => Self::Int32,
            6 => Self::UInt32,
            7 => Self::Single,
            9 => Self::Double,
            12 => Self::Int64,
            13 => Self::UInt64,
            _ => return None,
        })
    }

    /// Bytes a number.
    pub(super) fn width(self) -> usize {
        match self {
            Self::Int8 | Self::UInt8 => 1,
            Self::Int16 | Self::UInt16 => 2,
            Self::Int32 | Self::UInt32 | Self::Single => 4,
            Self::Double | Self::Int64 | Self::UInt64 => 8,
        }
    }

    /// A number from so many bytes.
    pub(super) fn value(self, bytes: &[u8], order: ByteOrder) -> f64 {
        match self {
            Self::Int8 => f64::from(i8::from_le_bytes(order.lowest_first(bytes))),
            Self::UInt8 => f64::from(u8::from_le_bytes(order.lowest_first(bytes))),
            Self::Int16 => f64::from(i16::from_le_bytes(order.lowest_first(bytes))),
            Self::UInt16 => f64::from(u16::from_le_bytes(order.lowest_first(bytes))),
            Self::Int32 => f64::from(i32::from_le_bytes(order.lowest_first(bytes))),
            Self::UInt32 => f64::from(order.u32(bytes)),
            Self::Single => f64::from(f32::from_le_bytes(order.lowest_first(bytes))),
            Self::Double => f64::from_le_bytes(order.lowest_first(bytes)),
            // beyond 2^53 rounded
            Self::Int64 => i64::from_le_bytes(order.lowest_first(bytes)) as f64,
            Self::UInt64 => u64::from_le_bytes(order.lowest_first(bytes)) as f64,
        }
    }
}
